"""
How long does a block swing?
============================

The period of free rocking grows without bound as the amplitude nears the slenderness. Two blocks
that are let go run down the curve, faster with every impact: the marks are their peaks. See
:doc:`/guides/overturning`.
"""

import rocksteady as rs

ax = rs.plots.free_rocking([0.95, 0.8])
ax.set_title("Free rocking of two blocks, restitution 0.95 and 0.8")
