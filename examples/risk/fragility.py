"""
How likely does shaking overturn this cabinet?
==============================================

Above, the probability that a cabinet lifts, rocks beyond half its slenderness, and overturns, over
the peak ground velocity. Below, overturning alone: the shares of the runs that the curve is fitted
to, and its band; where no runs were made, the page is grey. See :doc:`/guides/fragility`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.45, height=1.8)
fragility = rs.compute_fragility(
    cabinet,
    rs.motions.make_synthetic_suite(16),
    levels=rs.risk.Levels("pgv_m_s", [0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2], beside=()),
    restitution=rs.risk.RestitutionBand(draws=2),
    fitting=rs.risk.FitOptions(
        states=["uplift", 0.5, "overturned"], bands=rs.risk.BandOptions(replicates=200)
    ),
)
fig, (top, bottom) = plt.subplots(2, figsize=(7.36, 6.6), layout="constrained")
rs.plots.fragility_states(fragility, top).set_title(
    "Cabinet of 0.45 m x 1.8 m, 16 synthetic records"
)
rs.plots.fragility(fragility, bottom, legend="right").set_title("")
