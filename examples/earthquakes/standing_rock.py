"""
Which hazard models does a standing rock reject?
================================================

A slender rock has stood for 10,000 years. Each bar is the probability, on one branch of a hazard
model, that it would have fallen by now. A branch beyond the dashed line is rejected. Rock and
hazard are made up. See :doc:`/guides/hazard`.
"""

import numpy as np

import rocksteady as rs

levels = np.array([0.05, 0.1, 0.2, 0.4, 0.8, 1.6])
rates = np.array([4.5e-2, 1.4e-2, 3.8e-3, 8.1e-4, 1.2e-4, 1.2e-5])
branches = [
    rs.risk.HazardCurve(measure="pgv_m_s", levels=levels, rates=factor * rates, name=name)
    for name, factor in (("low", 0.1), ("middle", 0.3), ("high", 1.0), ("highest", 3.0))
]
median, beta = 0.8, 0.4
tested = rs.risk.check_hazard_branches((median, beta), branches, 10_000.0)
ax = rs.plots.rows(tested)
