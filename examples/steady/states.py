"""
What does a run stand for?
==========================

The steady motions of a block over the frequency, what some shakings settle to, and a run beside its
26 neighbours: scale, size and restitution a little different. See :doc:`/how-to/does-it-fall`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.4, height=1.8)
states = rs.find_steady_states(
    rs.DimensionlessBlock(restitution=0.8), rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
)
settled = rs.orbits.find_attractors(np.linspace(0.5, 6.0, 12), 4.0, 0.8)
pulse = rs.Pulse.from_si(cabinet, shape="one-sine", acceleration_m_s2=6.0, frequency_hz=1.5)
fig, axes = plt.subplots(3, 1, figsize=(7.4, 9.0), layout="constrained")
rs.plots.steady_states(states, axes[0])
rs.plots.attractor_kinds(settled, axes[1])
rs.plots.neighbours(rs.check_neighbours(rs.simulate(cabinet, pulse)), axes[2])
