"""
Which symmetric steady motions exist?
=====================================

A full cycle of each symmetric motion of one block under the same shaking. That of order 1 repeats
in each period of the shaking and comes in two branches, of which the smaller is unstable (dashed);
that of order 3 takes three periods and rises four times as high. The block may rest as well, since
the amplitude is below 1. See :doc:`/theory/steady`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

fig, ax = plt.subplots()
for series, (order, branch) in enumerate(((1, 1), (1, 2), (3, 1))):
    orbit = rs.orbits.compute_steady_orbit(0.8, 5.0, 0.9, branch=branch, order=order)
    rs.plots.steady_orbit(orbit, ax, label=f"order {order}, branch {branch}", series=series)
ax.legend(loc="upper right")
ax.set_title("A = 0.8, Ω = 5, restitution 0.9")
