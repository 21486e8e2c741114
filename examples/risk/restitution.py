"""
How much velocity does an impact leave?
=======================================

Left, the peaks of three releases into free rocking, near a straight line on a logarithmic axis and
far below that of Housner's restitution (dashed). Right, the restitution of each impact over its
amplitude. The releases are made up, with impacts that scatter. See :doc:`/guides/restitution`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.Block.rectangle(width=0.05, height=0.5)
rng = np.random.default_rng(5)
releases = []
for name, start in (("first", 0.7), ("second", 0.5), ("third", 0.6)):
    peaks = [start]
    for ratio in 0.952 + 0.02 * rng.standard_normal(18):
        peaks.append(rs.formulas.free_rocking_peaks(peaks[-1], ratio, 1, alpha=block.alpha)[1])
    measured = block.alpha * np.array(peaks) + 3e-4 * rng.standard_normal(19)
    releases.append(rs.histories.Release(peaks_rad=measured, sigma_rad=3e-4, name=name))
fit = rs.fit_restitution(releases, block)
fig, axes = plt.subplots(1, 2, figsize=(7.36, 4.0), layout="constrained")
for ax, panel in zip(axes, ("peaks", "impacts"), strict=True):
    rs.plots.restitution(fit, ax, panel=panel)
