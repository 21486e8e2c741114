"""
Do the formulas agree?
======================

The peak ground velocity from which a block of 1.8 m overturns, over its width, by two fits to
thousands of computed runs and by Ishiyama's bound. The bound lies at about half of the medians: it
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
ax.plot(widths, [each.median_pgv_m_s for each in runs], label="published runs")
ax.plot(widths, [each.other_median_pgv_m_s for each in runs], "--", label="runs of this package")
ax.plot(widths, bound, ":", label="Ishiyama's bound")
ax.set(xlabel="width of a block of 1.8 m [m]", ylabel="peak ground velocity [m/s]", ylim=(0, 1.4))
ax.legend(loc="upper left")
