"""
How far may a block lean before an earthquake?
==============================================

The fate of each state at the beginning of a record. Inside the dashed line the block would come to
rest on a still base; under the record, rings of states inside it fall to either side. See
:doc:`/guides/overturning`.
"""

import numpy as np

import rocksteady as rs

block = rs.Block.rectangle(width=0.6, height=2.4)
record = rs.motions.make_synthetic_suite(12)[4].scaled(2.0)
window = np.linspace(-1.5, 1.5, 200)
fates = rs.compute_fate_basins(block, record, angles=window, velocities=window, model=rs.Linear())
ax = rs.plots.fate_basins(fates)
ax.set_title("Block of 0.6 m x 2.4 m, a synthetic record doubled")
