"""
Which furniture falls at 0.35 g and 0.4 m/s?
============================================

The probability that a free-standing rectangle overturns, over its width and height, from the two
peaks of the ground motion alone. Shape decides whether it lifts, size whether it falls: of two
blocks on one line through the origin the larger is the safer. See :doc:`/guides/screens`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

widths, heights = np.linspace(0.2, 0.8, 21), np.linspace(0.9, 3.0, 21)
percent = [
    [
        100.0
        * rs.risk.assess_by_formula(rs.Block.rectangle(width=w, height=h), 0.35, 0.4).probability
        for w in widths
    ]
    for h in heights
]
fig, ax = plt.subplots(layout="constrained")
filled = ax.contourf(widths, heights, percent, levels=np.arange(0, 101, 10), cmap="YlOrRd")
fig.colorbar(filled, label="probability of overturning [%]")
for name, w, h in (("bookcase", 0.35, 1.9), ("fridge", 0.6, 1.8), ("statue", 0.5, 2.4)):
    ax.plot(w, h, "ko")
    ax.annotate(name, (w, h), (6, 4), textcoords="offset points")
ax.set(xlabel="width [m]", ylabel="height [m]")
