"""
Where is there steady symmetric rocking?
========================================

Below the lowest curve no motion with one impact a half cycle exists (4); above it there are two (3,
1), and above the sign curve one (2). At the kind curve the first of them changes from in phase to
out of phase with the shaking. Above "symmetry breaking" it is unstable; above "heteroclinic" the
border of the states that fall is fractal. See :doc:`/theory/steady`.
"""

import numpy as np

import rocksteady as rs

ratios = np.linspace(0.1, 12.0, 600)
ax = rs.plots.steady_regions(rs.orbits.compute_region_map(ratios, 0.5), top=6.0, key="beside")
ax.set_title("Symmetric steady rocking, restitution 0.5")
