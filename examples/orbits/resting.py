"""
When does a block rest between two pushes?
==========================================

Just above the amplitude that lifts it, a block rocks for a part of each period and rests for the
other. Each line is the peak of one of its flights, each smaller than the one before. The motion
begins at A = 1 and ends where no time of rest is left. See :doc:`/theory/resting`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.5)
shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=1.0)
branches = rs.branches.find_resting_branches(
    block, shaking, "amplitude", (0.98, 1.126), resolution=0.01
)
ax = rs.plots.bifurcations(branches)
ax.set_title("Ω = 1, restitution 0.5")
