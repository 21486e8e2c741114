"""
How often does a cabinet fall?
==============================

The hazard of a site, the counted share of runs in which the cabinet falls, and the part of the
annual rate that each level of shaking adds (filled): moderate shaking, which is frequent, counts
more than the strongest. The hazard is made up. See :doc:`/guides/hazard`.
"""

import rocksteady as rs

levels = [0.05, 0.1, 0.2, 0.4, 0.8, 1.6]
rates = [0.02, 0.0082, 0.0026, 0.0006, 0.000085, 0.0000085]
hazard = rs.risk.HazardCurve(measure="pga_g", levels=levels, rates=rates, name="made up")
cabinet = rs.Block.rectangle(width=0.45, height=2.0)
suite = rs.motions.make_synthetic_suite(28)
shares = rs.compute_fragility(cabinet, suite, levels=rs.risk.Levels("pga_g"))
risk = rs.compute_risk(shares, hazard)
ax = rs.plots.risk(risk)
