"""
Which starts are safe?
======================

Each point is a state at the same moment of the shaking; its colour is where the motion ends.
Crosses mark the two motions that balance upright. Their stable manifolds (red) are the border of
the states that fall; along the unstable ones (violet) states leave. See :doc:`/theory/basins` and
:doc:`/theory/edges`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=0.5, frequency_ratio=2.0)
u, v = np.linspace(-1.5, 1.5, 200), np.linspace(-1.3, 1.1, 200)
ax = rs.plots.basins(rs.compute_basins(block, shaking, angles=u, velocities=v, max_cycles=200))
manifolds = [
    rs.basins.compute_manifold(saddle, kind, length=8.0)
    for saddle in rs.basins.find_hilltop_saddles(block, shaking)
    for kind in ("stable", "unstable")
]
rs.plots.manifolds(manifolds, ax).set_title("A = 0.5, Ω = 2, restitution 0.9")
