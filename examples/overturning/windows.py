"""
Does a stronger pulse overturn more?
====================================

Not always: the blue regions are pulses under which a block falls after an impact, and above them
lie gaps in which a stronger pulse of the same kind leaves it standing. In the grey region it falls
without an impact. The curve is the closed form. See :doc:`/guides/overturning`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
ratios = np.geomspace(0.5, 8.0, 110)
fig, axes = plt.subplots(1, 2, sharey=True, figsize=(7.36, 4.0), layout="constrained")
for ax, shape in zip(axes, ("one-sine", "one-cosine"), strict=True):
    windows = rs.find_overturning_windows(block, shape, ratios, within=(1.0, 12.0))
    rs.plots.overturning(windows, ax)
    ax.set_title(f"{shape} pulse, restitution 0.9")
    handles = ax.get_legend().legend_handles
    ax.get_legend().remove()
axes[1].set_ylabel("")
fig.legend(handles=handles, loc="outside lower center", ncols=3)
