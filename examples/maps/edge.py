"""
What stands between two outcomes?
=================================

A motion on the border between two outcomes is tracked from period to period; it settles to the
edge state, an unstable motion. Left, between rest and the fall it balances upright. Right, between
rest and steady rocking it is the small steady orbit that no experiment shows. See
:doc:`/theory/edges`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=0.25, frequency_ratio=2.0)
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.2), layout="constrained")
rs.plots.edge_state(rs.find_edge_state(block, shaking), left)
rocking = rs.State(angle=0.0, velocity=0.6)
rs.plots.edge_state(rs.find_edge_state(block, shaking, other=rocking), right)
