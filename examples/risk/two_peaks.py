"""
Does the peak velocity tell enough?
===================================

Each dot is a record at a level: its peak ground acceleration, its peak ground velocity, and the
share of its runs in which the cabinet falls. Along the lines the probability is 10, 50 and 90 %. If
they were level, the velocity alone would tell; their slope is what the acceleration adds. The
diamond is a demand whose two peaks are known. See :doc:`/guides/fragility`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.45, height=1.8)
fragility = rs.compute_fragility(
    cabinet,
    rs.motions.make_synthetic_suite(16),
    levels=rs.risk.Levels("pgv_m_s", [0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2]),
    restitution=rs.risk.RestitutionBand(draws=2),
    fitting=rs.risk.FitOptions(states=["overturned"], bands=None),
)
fig, ax = plt.subplots(figsize=(7.36, 4.6), layout="constrained")
rs.plots.fragility_surface(fragility, ax, pga_g=0.5, pgv_m_s=0.5)
