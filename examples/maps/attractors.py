"""
What becomes of a block after one push?
=======================================

Each point of the map is one frequency and one amplitude of the shaking; its colour is what the
block settles to after the same push. It falls where the shaking is slow and strong. Along the
border small changes decide, and motions slower than the shaking appear. See :doc:`/guides/sweeps`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
axes = {"amplitude": np.linspace(0.05, 6.0, 220), "frequency_ratio": np.linspace(0.5, 8.0, 280)}
start = rs.State(angle=0.0, velocity=0.3)
cells = rs.map_attractors(block, axes=axes, start=start, max_cycles=200)
ax = rs.plots.outcomes(cells)
ax.set_title("Restitution 0.8, velocity 0.3 αp at the start")
