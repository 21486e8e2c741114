"""
Which measure tells best what falls?
====================================

How far each measure of intensity is behind the best one by Akaike's criterion, the most efficient
first, with the spread of its fragility curve: the smaller the spread, the fewer records are needed.
Pairs of measures have no single spread. Velocity tells more than acceleration. Below, both at once:
each dot is a record at a level, with the share of its runs that fall; were the lines level, the
velocity alone would tell. See :doc:`/guides/fragility` and :doc:`/guides/measures`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.45, height=1.8)
fragility = rs.compute_fragility(
    cabinet,
    rs.motions.make_synthetic_suite(16),
    restitution=rs.risk.RestitutionBand(draws=2),
    fitting=rs.risk.FitOptions(states=["overturned"], bands=None),
)
fig, ax = plt.subplots(layout="constrained")
rs.plots.measure_efficiency(fragility, ax).set_title(
    "Cabinet of 0.45 m x 1.8 m, 16 synthetic records"
)
beside, ax = plt.subplots(figsize=(7.36, 4.6), layout="constrained")
rs.plots.fragility_surface(fragility, ax, pga_g=0.5, pgv_m_s=0.5)
