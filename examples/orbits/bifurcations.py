"""
How does a motion lose its symmetry?
====================================

Lines are periodic motions over the frequency, solid where stable and dashed where unstable;
triangles are what sweeps up and down meet. Towards low frequencies a motion that leans to one side
branches off; its high and its low flights part, its period doubles again and again, and the block
falls. See :doc:`/theory/continuation`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0)
search = rs.branches.BranchOptions(max_period=4, doublings=3)
diagram = rs.find_bifurcations(
    block, shaking, "frequency_ratio", within=(1.75, 2.1), values=120, search=search
)
ax = diagram.plot()
ax.set_title("A = 2, restitution 0.8")
