"""
Does this motion ever repeat?
=============================

It does not. Each mark is an impact of one motion over 4000 periods of the shaking: its phase, and
the speed after it. The marks lie on a thin set with a fine structure, a strange attractor; the
Lyapunov exponent in the title is positive, so that neighbouring motions part. See
:doc:`/theory/orbits`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
shaking = rs.Harmonic(amplitude=2.5755, frequency_ratio=4.0377)
start = rs.State(angle=0.0, velocity=0.2)
attractor = rs.find_attractor(block, shaking, start=start, max_cycles=1000)
run = rs.simulate(block, shaking, start=start, cycles=4000)
ax = rs.plots.poincare_section(run, since=200.0)
ax.set(ylim=(0.15, 0.52), title=f"{attractor.kind}, exponent {attractor.lyapunov:.2f} a period")
