"""
What do the letters on a block mean?
====================================

The slenderness α is the angle between the side of the block and the line R from an edge to its
centre of mass: the tilt at which that centre stands above the edge. A tilt about the left edge is
positive. See :doc:`/theory/model`.
"""

import rocksteady as rs

block = rs.Block.rectangle(width=0.5, height=1.2)
ax = block.plot()
