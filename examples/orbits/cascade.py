"""
Do period doublings follow Feigenbaum's law?
============================================

Each period doubling begins on the branch that the one before created. Their distances shrink by a
ratio that approaches 4.669, the constant of all such cascades. See :doc:`/theory/continuation`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0)
origin = rs.find_orbits(block, shaking, max_period=1)[0]
cascade = rs.branches.find_cascade(origin, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=6)
ax = rs.plots.cascade(cascade)
ax.set_title("A = 2, restitution 0.8")
