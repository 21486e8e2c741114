"""
Which furniture falls at 0.35 g and 0.4 m/s?
============================================

Lines of equal probability that a free-standing rectangle falls, over width and height, from the two
peaks of the ground motion alone. Shape decides whether it lifts, size whether it falls: of two
blocks on one line through the origin the larger is the safer. See :doc:`/guides/screens`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

widths, heights = np.linspace(0.2, 0.8, 21), np.linspace(0.9, 3.0, 21)
blocks = [[rs.Block.rectangle(width=w, height=h) for w in widths] for h in heights]
falls = [[rs.risk.assess_by_formula(b, 0.35, 0.4).probability for b in row] for row in blocks]
fig, ax = plt.subplots(layout="constrained")
lines = ax.contour(widths, heights, falls, levels=np.linspace(0.1, 0.9, 9), colors="C3")
ax.clabel(lines, fmt=lambda p: f"{100 * p:.0f} %")
for name, w, h in (("bookcase", 0.35, 1.9), ("fridge", 0.6, 1.8), ("statue", 0.5, 2.4)):
    ax.plot(w, h, "C4o")
    ax.annotate(name, (w, h), (7, -12), textcoords="offset points")
ax.set(xlabel="width [m]", ylabel="height [m]", title="probability of falling")
