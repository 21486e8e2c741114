"""
Is the border of the safe starts fractal?
=========================================

On the left, the entropy of the ends that starts in a small box have, over the amplitude of the
shaking: above the dashed line the border is fractal, below it may be. On the right, the share of
starts that an error of some cells sends elsewhere, at the last amplitude. A smooth border has the
slope 1; on this one a start that is known twice as well helps far less. See
:doc:`/theory/basin-measures`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=4.0)
window = np.linspace(-1.2, 1.2, 200)
sampling = rs.basins.SamplingOptions(angles=window, velocities=window, max_cycles=200)
amplitudes = np.linspace(0.4, 1.6, 17)
shares = rs.basins.compute_basin_shares(block, shaking, "amplitude", amplitudes, sampling=sampling)
_, (left, right) = plt.subplots(1, 2, layout="constrained")
rs.plots.basin_entropies(shares.entropies(10), left)
rs.plots.uncertainty(rs.basins.compute_uncertainty_exponent(shares.label[-1]), right)
