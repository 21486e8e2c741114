"""
How likely does this cabinet fall?
==================================

Runs of a cabinet under thirty motions: the share that falls at each level of intensity, the curve
through them, and the demand at which it was assessed. See :doc:`/guides/objects`.
"""

import rocksteady as rs

cabinet = rs.risk.DescribedObject(
    values={
        "name": "cabinet",
        "geometry": {"width_m": 0.4, "height_m": 1.8},
        "demand": {"pga_g": 0.4, "pgv_m_s": 0.5},
        "assessment": {"draws": 2, "replicates": 100},
    }
)
found = rs.assess_object(cabinet, rs.motions.make_synthetic_suite(30))
ax = rs.plots.assessment(found)
ax.set_title(f"{100.0 * found.probability:.0f} % at the demand: {found.verdict}")
