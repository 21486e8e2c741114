"""Levels of a relative measure as a peak velocity or acceleration, which a reader knows."""

import numpy as np

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.seismic.measures.free_sides import first_side

PEAKS = {
    "p_pgv_per_uplift": ("pgv_m_s", "m/s of PGV"),
    "pga_per_uplift": ("pga_g", "g of PGA"),
    "pgv_m_s": ("pgv_m_s", "m/s of PGV"),
    "pga_g": ("pga_g", "g of PGA"),
}
"""Peak that each measure is made of, and its unit."""


def unit_of(assessment: Assessment) -> float:
    """Return the peak that is 1 of the measure of the fragility; NaN of other measures."""
    fragility, side = assessment.fragility, first_side(assessment.facts.block)
    if fragility is None:
        return float("nan")
    uplift = assessment.facts.block.gravity * tan(side.alpha)
    return {
        "p_pgv_per_uplift": uplift / side.p,
        "pga_per_uplift": uplift / STANDARD_GRAVITY,
        "pgv_m_s": 1.0,
        "pga_g": 1.0,
    }.get(fragility.measure.name, float("nan"))


def demand_in_measure(assessment: Assessment) -> float:
    """Return the demand in the measure of the fragility; NaN where it is no peak.

    Without a demand it is the median of the motions as they are.
    """
    if assessment.fragility is None or assessment.fragility.measure.name not in PEAKS:
        return float("nan")
    key, _ = PEAKS[assessment.fragility.measure.name]
    peak = getattr(assessment.described.given.demand, key)
    if peak is None:
        peak = float(np.median([row[key] for row in assessment.to_dict()["inputs"]]))
    return float(peak) / unit_of(assessment)
