"""
How often does shaking overturn this cabinet?
=============================================

The share of the runs in which a cabinet lifts, tilts beyond half of what it can bear, and falls,
over the peak ground velocity. Points are counted, with their 90 % intervals; the lines are the
monotone shares nearest to them. Uplift is known without a run: it steps at the threshold of each
record. See :doc:`/guides/fragility`.
"""

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.45, height=1.8)
fragility = rs.compute_fragility(
    cabinet,
    rs.motions.make_synthetic_suite(28),
    levels=rs.risk.Levels("pgv_m_s"),
    restitution=rs.risk.RestitutionBand(draws=3),
    states=["uplift", 0.5, "overturned"],
)
ax = rs.plots.fragility(fragility)
ax.set_title("Cabinet of 0.45 m x 1.8 m, 28 synthetic records")
