"""
How does a statue fall?
=======================

A film at half speed, above the rotation of the statue. The first half of a sine pulse lifts it,
the second half throws it back; it strikes the ground with its other corner and falls to the other
side. See :doc:`/guides/overturning`; ``film.save("statue.gif", writer="pillow")`` saves a film.
"""

import rocksteady as rs

statue = rs.Block.rectangle(width=0.5, height=2.0)
pulse = rs.Pulse(shape="one-sine", amplitude=3.5, frequency_ratio=4.0)
film = rs.plots.animate(rs.simulate(statue, pulse), fps=20, speed=0.5)
