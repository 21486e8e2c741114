"""
What does the annual risk depend on?
====================================

The annual rate at which a cabinet falls, with one input at a time at its low and its high value. A
hazard that is known to a factor of two outweighs the rest; a few centimetres of width come next.
The hazard is made up. See :doc:`/guides/hazard`.
"""

import numpy as np

import rocksteady as rs


def rate(width=0.32, height=1.8, median=0.757, beta=0.592, hazard=1.0):
    levels = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6])
    rates = hazard * np.array([0.16, 0.045, 0.014, 0.0038, 0.00081, 0.00012, 0.000012])
    curve = rs.risk.HazardCurve(measure="pgv_m_s", levels=levels, rates=rates)
    block = rs.Block.rectangle(width=width, height=height)
    return rs.compute_risk((median, beta), curve, measure="p_pgv_per_uplift", block=block)


ranges = {"width": (0.28, 0.36), "height": (1.7, 1.9), "beta": (0.46, 0.7), "hazard": (0.5, 2.0)}
rows = [
    (f"{name} {low:g} to {high:g}", *(rate(**{name: end}).annual_rate for end in (low, high)))
    for name, (low, high) in ranges.items()
]
ax = rs.plots.tornado(rows, rate().annual_rate, label="falls a year")
