"""Measures of hazard curves and of fragilities: as texts, with periods, and as multiples."""

import math
from typing import Any

import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.risk.hazard.hazard_measures import (
    fragility_factor,
    ground_measure,
    intensity_named,
    written,
)
from tests.every import every

BLOCK = Block.asymmetric(left=0.3, right=0.2, height=1.6, gravity=9.0)
SIDE = BLOCK.negative  # which lifts first
OWN = 2.0 * math.pi / SIDE.p


@every("text", ["pga_g", "pgv_m_s", "sa_g:0.5", "sa_avg_g:1.25", "sa_g:1e-06"])
def test_a_text_gives_its_measure_and_the_measure_its_text(text: str) -> None:
    measure = ground_measure("measure", text)
    name, _, period = text.partition(":")
    assert (measure.name, measure.period_s) == (name, float(period) if period else None)
    assert written(measure) == text
    assert ground_measure("measure", measure) is measure


NONE_OF_THE_GROUND = (
    *("pga_g:1.0", "pgv_m_s:1", "sa_g", "sa_avg_g", "sa_g:", "sa_g:x", "sa_g:9e-7", "sa_g:61"),
    *("p_pgv_per_uplift", "pgv_per_pga_s", "", 3, None, Measure("sa_g")),
)


@every("given", NONE_OF_THE_GROUND)
def test_a_hazard_is_of_the_ground_with_a_period_where_one_belongs(given: Any) -> None:
    with pytest.raises(InputError, match="a hazard curve is over one of pga_g, pgv_m_s, sa_g:PER"):
        ground_measure("hazard", given)


def test_a_fragility_may_be_over_measures_of_a_block_too() -> None:
    assert intensity_named("measure", "pga_per_uplift") == Measure("pga_per_uplift")
    assert intensity_named("measure", Measure("sa_g")) == Measure("sa_g")
    with pytest.raises(InputError, match="its period must be a number"):
        intensity_named("measure", "sa_g:soon")
    with pytest.raises(InputError, match=r"^name = "):
        intensity_named("name", 0.4)


@every(
    ("measure", "hazard", "factor"),
    [
        ("pga_g", "pga_g", 1.0),
        ("pgv_m_s", "pgv_m_s", 1.0),
        ("pga_per_uplift", "pga_g", 9.80665 / (9.0 * 0.25)),
        ("p_pgv_per_uplift", "pgv_m_s", SIDE.p / (9.0 * 0.25)),
        ("sa_g:0.5", "sa_g:0.5", 1.0),
        ("sa_g:0.5", "sa_g:0.50000049", 1.0),
        ("sa_g", f"sa_g:{OWN:.7g}", 1.0),
        ("sa_avg_g", f"sa_avg_g:{OWN!r}", 1.0),
    ],
)
def test_a_fragility_meets_the_hazard_that_it_is_a_multiple_of(
    measure: str, hazard: str, factor: float
) -> None:
    """tan alpha = .25; a period may be written with seven digits."""
    found = fragility_factor(
        intensity_named("measure", measure), ground_measure("hazard", hazard), BLOCK
    )
    assert found == pytest.approx(factor, rel=1e-12)


@every(
    ("measure", "hazard"),
    [
        ("pga_g", "pgv_m_s"),
        ("pga_per_uplift", "pgv_m_s"),
        ("p_pgv_per_uplift", "pga_g"),
        ("sa_g:0.5", "sa_g:0.500001"),
        ("sa_g:0.5", "sa_avg_g:0.5"),
        ("sa_g", "sa_g:0.5"),
        ("pga_g", "sa_g:0.5"),
        ("pgv_per_pga_s", "pgv_m_s"),
    ],
)
def test_measures_of_different_things_are_not_converted(measure: str, hazard: str) -> None:
    with pytest.raises(InputError, match="the two cannot be converted"):
        fragility_factor(
            intensity_named("measure", measure), ground_measure("hazard", hazard), BLOCK
        )


@every("measure", ["p_pgv_per_uplift", "pga_per_uplift", "sa_g"])
def test_what_is_measured_with_a_block_needs_it(measure: str) -> None:
    hazard = ground_measure("hazard", "pgv_m_s")
    with pytest.raises(InputError, match="give block="):
        fragility_factor(intensity_named("measure", measure), hazard, None)
    assert fragility_factor(Measure("pgv_m_s"), hazard, None) == 1.0
