"""
Which blocks does this record overturn?
=======================================

Left, the largest rotation over the size of the block for three slendernesses; bars along the top
mark the blocks that overturn. Right, the same over slenderness and size: small slender blocks
fall, with islands in which a smaller or more slender one stands. See :doc:`/guides/spectra`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

record = rs.motions.make_synthetic_suite(12)[4].scaled(2.0)
periods = np.linspace(0.5, 8.0, 240)
three, slendernesses = np.radians([10.0, 15.0, 20.0]), np.linspace(0.08, 0.45, 90)
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.8), layout="constrained")
curves = rs.compute_rocking_spectrum(record, alpha=three, periods_s=periods)
rs.plots.rocking_spectrum(curves, left, legend="below")
plane = rs.compute_rocking_spectrum(record, alpha=slendernesses, periods_s=periods[::2])
rs.plots.spectrum_map(plane, right)
