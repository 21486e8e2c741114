"""Demands as levels: of peaks, of spectra, and of motions where none is given."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block
from rocksteady.errors import ModelError
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess._demand_level import DemandLevel, demand_level
from rocksteady.risk.assess.described.schema import ObjectDemand, ObjectSpectrum
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from tests.every import every

SUITE = make_synthetic_suite(4)
BLOCK = Block.asymmetric(left=0.3, right=0.2, height=1.6, gravity=9.0)
SIDE = BLOCK.negative  # which lifts first
TABLE = ObjectSpectrum(period_s=[0.5, 1.0, 4.0], sa_g=[0.8, 0.4, 0.05], damping=0.05)


def level(measure: Measure | str, **demand: Any) -> DemandLevel:
    intensity = measure if isinstance(measure, Measure) else Measure(measure)
    return demand_level(intensity, ObjectDemand(**demand), SUITE, BLOCK, "statue.toml")


@every(
    ("name", "words"),
    [
        ("pgv_m_s", "PGV of 0.5 m/s"),
        ("p_pgv_per_uplift", "PGV of 0.5 m/s"),
        ("pga_g", "PGA of 0.3 g"),
        ("pga_per_uplift", "PGA of 0.3 g"),
    ],
)
def test_a_peak_is_a_level_in_its_own_unit_and_in_that_of_the_block(name: str, words: str) -> None:
    found = level(name, pga_g=0.3, pgv_m_s=0.5)
    assert (found.words, found.assumed) == (words, False)
    uplift = 9.0 * math.tan(SIDE.alpha)
    values = {
        "pgv_m_s": 0.5,
        "p_pgv_per_uplift": 0.5 * SIDE.p / uplift,
        "pga_g": 0.3,
        "pga_per_uplift": 0.3 * 9.80665 / uplift,
    }
    assert found.of(Measure(name), BLOCK) == pytest.approx(values[name], rel=1e-13)


@every("measure", [Measure("pgv_m_s"), Measure("pga_per_uplift"), Measure("sa_g", 0.7),
                   Measure("sa_avg_g", 0.7), Measure("sa_g")])  # fmt: skip
def test_without_a_demand_it_is_the_median_of_the_motions(measure: Measure) -> None:
    found = level(measure)
    values = sorted(compute_measure(record, found.measure) for record in SUITE)
    assert found.assumed
    assert found.value == pytest.approx(0.5 * (values[1] + values[2]))
    own = 2.0 * math.pi / SIDE.p
    periods = {"sa_g": measure.period_s or own, "sa_avg_g": 0.7}
    assert found.measure.period_s == pytest.approx(periods.get(found.measure.name))


@every(("period", "value"), [(0.5, 0.8), (1.0, 0.4), (4.0, 0.05), (2.0, 0.4 * 8.0**-0.5)])
def test_a_spectrum_is_straight_in_logarithms_and_reaches_both_its_ends(
    period: float, value: float
) -> None:
    found = level(Measure("sa_g", period), spectrum=TABLE)
    assert found.value == pytest.approx(value, rel=1e-12)
    assert not found.assumed
    assert found.words.startswith(f"Sa({period:g} s) of ")


@every(
    ("measure", "demand", "words"),
    [
        (Measure("sa_g", 0.49), {"spectrum": TABLE}, "does not reach 0.49 s"),
        (Measure("sa_g", 4.01), {"spectrum": TABLE}, "it goes from 0.5 to 4 s"),
        (Measure("sa_avg_g", 1.0), {"spectrum": TABLE}, "spectrum is missing"),
        (Measure("sa_g", 1.0), {"pga_g": 0.3}, "spectrum is missing"),
        (Measure("pgv_m_s"), {"pga_g": 0.3}, "pgv_m_s is missing"),
        (Measure("pga_per_uplift"), {"spectrum": TABLE}, "pga_g is missing"),
    ],
)
def test_a_demand_of_something_else_is_not_taken(
    measure: Measure, demand: dict[str, Any], words: str
) -> None:
    with pytest.raises(ModelError) as refusal:
        level(measure, **demand)
    assert words in str(refusal.value)
    assert "statue.toml" in str(refusal.value)


def test_a_period_of_the_block_is_that_of_the_side_that_lifts_first() -> None:
    spectrum = ObjectSpectrum(period_s=[0.1, 10.0], sa_g=[1.0, 0.01], damping=0.05)
    found = level("sa_g", spectrum=spectrum)
    period = 2.0 * math.pi / SIDE.p
    assert found.value == pytest.approx(0.1 / period)
    assert np.isclose(found.measure.period_s or 0.0, period)
