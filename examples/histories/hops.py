"""
How does a block rock that rests in each period?
================================================

The shaking lifts the block, which hops, bounces and comes to rest until it is lifted again, to the
other side. Each rest wipes out the past: two blocks that start apart move as one after it. See
:doc:`/theory/resting`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.5)
shaking = rs.Harmonic(amplitude=1.1, frequency_ratio=1.0)
attractor = rs.find_attractor(block, shaking)
run = rs.simulate(block, shaking, start=attractor.start, cycles=3)
ax = rs.plots.trajectory(run)
