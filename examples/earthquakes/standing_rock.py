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
rates = np.array([0.02, 0.0082, 0.0026, 0.0006, 0.000085, 0.0000085])
branches = [
    rs.risk.HazardCurve(measure="pga_g", levels=levels, rates=factor * rates, name=name)
    for name, factor in (("low", 0.1), ("middle", 0.3), ("high", 1.0), ("highest", 3.0))
]
rock = rs.Block.rectangle(width=0.4, height=1.2)
suite = rs.motions.make_synthetic_suite(28)
shares = rs.compute_fragility(rock, suite, levels=rs.risk.Levels("pga_g"))
tested = rs.risk.check_hazard_branches(shares, branches, 10_000.0)
ax = rs.plots.rows(tested)
