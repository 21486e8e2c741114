"""
How often does this cabinet fall?
=================================

Runs of a cabinet under thirty motions that all have the peaks of the demand, and the same at other
levels. The share that falls at the demand and at 1.1 times it stands above, beside what is
accepted. See :doc:`/guides/objects`.
"""

import rocksteady as rs

cabinet = rs.risk.DescribedObject(
    values={
        "name": "cabinet",
        "geometry": {"width_m": 0.45, "height_m": 1.8},
        "demand": {"pga_g": 0.35, "pgv_m_s": 0.4},
    }
)
found = rs.assess_object(cabinet, rs.motions.make_synthetic_suite(30))
ax = rs.plots.assessment(found)
