"""
Do the formulas agree?
======================

The peak ground velocity from which a block of 1.8 m overturns, over its width, by a fit to
thousands of computed runs and by Ishiyama's bound. The bound lies at about half of the median: it
marks where overturning begins, not where half of the blocks fall. See :doc:`/guides/screens`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

widths = np.linspace(0.2, 0.8, 31)
blocks = [rs.Block.rectangle(width=width, height=1.8) for width in widths]
demand = rs.Demand(pga_g=0.6, pgv_m_s=0.6)
bound = [rs.screen_block(each, demand).row("Ishiyama bound").value for each in blocks]
runs = [rs.risk.assess_by_formula(each, 0.6, 0.6) for each in blocks]
fig, ax = plt.subplots(layout="constrained")
for name, values in (
    ("published runs", [each.median_pgv_m_s for each in runs]),
    ("Ishiyama's bound", bound),
):
    ax.plot(widths, values, "C4--")
    ax.text(0.81, values[-1], name, va="center")
ax.set(xlabel="width of a block of 1.8 m [m]", ylabel="peak ground velocity [m/s]")
ax.set(xlim=(0.2, 1.0), ylim=(0, 1.4))
