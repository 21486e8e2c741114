"""
How likely is each motion?
==========================

The share of a window of initial states that comes to each motion, over the amplitude of the
shaking. Rest gives way to rocking with the period of the shaking, and is gone above A = 1; between
rocking and the fall lies a motion three times as slow. See :doc:`/theory/basin-measures`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=4.0)
window = np.linspace(-1.0, 1.0, 50)
sampling = rs.basins.SamplingOptions(angles=window, velocities=window, max_cycles=200, seed=1)
amplitudes = np.linspace(0.3, 1.6, 40)
shares = rs.basins.compute_basin_shares(block, shaking, "amplitude", amplitudes, sampling=sampling)
ax = rs.plots.basin_shares(shares)
ax.set_title("Ω = 4, restitution 0.9")
