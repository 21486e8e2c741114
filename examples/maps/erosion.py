"""
How fast do the safe states vanish?
===================================

Above, two measures of how much of the safe basin is left as the shaking grows; below, the basin at
three amplitudes. The drop begins at the amplitude at which the manifolds of the two upright
motions touch. See :doc:`/theory/basins`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
window = np.linspace(-1.4, 1.4, 120)
erosion = rs.compute_erosion(
    block, shaking, np.linspace(0.0, 1.6, 33), angles=window, velocities=window, cycles=50
)
fig, axes = plt.subplot_mosaic("aaa;bcd", figsize=(7.36, 5.6), layout="constrained")
rs.plots.erosion(erosion, axes["a"])
for name, index in zip("bcd", (4, 12, 20), strict=True):
    rs.plots.safe_basin(erosion, index, axes[name])
