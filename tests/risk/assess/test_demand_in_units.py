"""The demand in the measure of a fragility, and the peak that is 1 of it, by hand."""

import math
from dataclasses import replace
from typing import Any

import pytest

from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess.assessment import Assessment, assess_object
from rocksteady.risk.assess.demand_in_units import demand_in_measure, unit_of
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.seismic.measures.intensity import compute_measures
from rocksteady.seismic.measures.scalar import Measure

WIDTH, HEIGHT, G = 0.34, 1.8, 9.80665
TANGENT = WIDTH / HEIGHT
P = math.sqrt(3.0 * G / (4.0 * 0.5 * math.hypot(WIDTH, HEIGHT)))
UNITS = {
    "p_pgv_per_uplift": G * TANGENT / P,
    "pga_per_uplift": TANGENT,
    "pgv_m_s": 1.0,
    "pga_g": 1.0,
}
SUITE = make_synthetic_suite(3)

pytestmark = pytest.mark.usefixtures("no_remedies")


def assessed(**keys: Any) -> Assessment:
    values = {
        "name": "statue",
        "friction": 0.9,
        "geometry": {"width_m": WIDTH, "height_m": HEIGHT, "mass_kg": 200.0},
        "assessment": {"draws": 1, "levels": 4, "replicates": 0, "intensity_measure": "pgv_m_s"},
    }
    return assess_object(DescribedObject(values=values | keys), SUITE)


def measured(found: Assessment, measure: str) -> Assessment:
    assert found.fragility is not None
    return replace(found, fragility=replace(found.fragility, measure=Measure(measure)))


def test_the_demand_is_the_peak_in_units_of_what_uplift_takes() -> None:
    found = assessed(demand={"pga_g": 0.4, "pgv_m_s": 0.45})
    for measure, unit in UNITS.items():
        peak = 0.45 if "pgv" in measure else 0.4
        assert unit_of(measured(found, measure)) == pytest.approx(unit), measure
        assert demand_in_measure(measured(found, measure)) == pytest.approx(peak / unit), measure
    assert math.isnan(demand_in_measure(measured(found, "sa_avg_g")))


def test_without_a_demand_it_is_the_median_of_the_motions() -> None:
    peaks = sorted(compute_measures(record).pgv_m_s for record in SUITE)
    found = measured(assessed(), "p_pgv_per_uplift")
    assert demand_in_measure(found) == pytest.approx(peaks[1] * P / (G * TANGENT))
