"""
Does it matter when the shaking sets in?
========================================

The fate of a block at rest after 30 periods, over the phase at which shaking sets in and its
amplitude. It matters most where the block is about to fall: there the same shaking overturns it or
not, depending on the phase alone, and a stronger one may spare it. See :doc:`/guides/sweeps`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
axes = {"amplitude": np.linspace(0.5, 5.0, 240), "phase": np.linspace(0.0, 2.0 * np.pi, 300)}
shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=3.0)
cells = rs.map_fates(block, shaking, axes=axes, cycles=30)
ax = rs.plots.outcomes(cells)
ax.set_title("Ω = 3, restitution 0.9, from rest")
