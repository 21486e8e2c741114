"""
How often does a cabinet fall?
==============================

The hazard of a site, the probability that the cabinet falls, and the part of the annual rate that
each level of shaking adds (filled): moderate shaking, which is frequent, counts more than the
strongest. The hazard is made up. See :doc:`/guides/hazard`.
"""

import numpy as np

import rocksteady as rs

levels = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6])
rates = np.array([0.16, 0.045, 0.014, 0.0038, 0.00081, 0.00012, 0.000012])
hazard = rs.risk.HazardCurve(measure="pgv_m_s", levels=levels, rates=rates, name="made up")
cabinet = rs.Block.rectangle(width=0.32, height=1.8)
median, beta = 0.757, 0.592
risk = rs.compute_risk(
    (median, beta), hazard, measure="p_pgv_per_uplift", block=cabinet, beta_u=0.3
)
ax = rs.plots.risk(risk)
