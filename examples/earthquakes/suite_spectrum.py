"""
What does a suite do to blocks of all sizes?
============================================

Median and band of the largest rotation under 24 synthetic records, for three slendernesses, above
the share of the records that overturn the block. Both fall with size: of two blocks of one shape
the larger is the safer. See :doc:`/guides/spectra`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

suite = [each.scaled(1.5) for each in rs.motions.make_synthetic_suite(24)]
degrees, periods = (10.0, 15.0, 20.0), np.linspace(0.5, 8.0, 60)
spectra = rs.compute_rocking_spectrum(suite, alpha=np.radians(degrees), periods_s=periods)
summary = rs.measures.compute_suite_spectrum(spectra)
grid = {"figsize": (7.36, 5.0), "height_ratios": (2, 1), "layout": "constrained"}
fig, axes = plt.subplots(2, 3, sharex=True, sharey="row", **grid)
for column, alpha in enumerate(degrees):
    quantiles, (top, bottom) = summary.isel(alpha=column), axes[:, column]
    rs.plots.suite_spectrum(quantiles, top, legend="none").set(xlabel="", title=f"α = {alpha:.0f}°")
    rs.plots.share_that_falls(quantiles, bottom).set_ylabel("overturn [%]")
    if column:
        top.set_ylabel("")
        bottom.set_ylabel("")
