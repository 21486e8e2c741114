"""
How high does a block rock where it stands?
===========================================

The peak of the motion that a block settles to, over the frequency of the shaking and the
restitution. The peak grows towards low frequencies, up to a border beyond which the block falls.
The wedge on the right is another, slower motion. See :doc:`/guides/sweeps`.
"""

import numpy as np

import rocksteady as rs

axes = {"restitution": np.linspace(0.5, 0.96, 160), "frequency_ratio": np.linspace(0.5, 6.0, 240)}
shaking = rs.Harmonic(amplitude=1.5, frequency_ratio=1.0)
start = rs.State(angle=0.4, velocity=0.0)
cells = rs.map_attractors(
    rs.DimensionlessBlock(restitution=0.8), shaking, axes=axes, start=start, max_cycles=200
)
ax = rs.plots.outcomes(cells, by="peak")
ax.set_title("A = 1.5, started from θ = 0.4 α")
