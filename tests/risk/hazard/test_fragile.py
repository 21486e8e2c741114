"""Fragilities as a hazard curve sees them: lognormal, fitted and counted ones, and multiples."""

import math
import pickle
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady import Block, compute_fragility
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Fragility, HazardCurve, Levels, RestitutionBand, fit_curve
from rocksteady.risk.hazard.fragile import fragile_of, resampled
from tests.every import every

AT = np.array([0.01, 0.1, 0.4, 0.9, 5.0])
BLOCK = Block.rectangle(width=0.32, height=1.8)


def hazard(measure: str = "pgv_m_s") -> HazardCurve:
    return HazardCurve(measure=measure, levels=np.array([0.01, 10.0]), rates=np.array([0.1, 1e-6]))


def counted(records: int = 12, measure: str = "pga_g") -> Fragility:
    return compute_fragility(
        BLOCK,
        make_synthetic_suite(records),
        levels=Levels(measure, [0.2, 0.4, 0.8, 1.6], beside=()),
        restitution=RestitutionBand(draws=2),
    )


def test_a_lognormal_is_that_of_scipy() -> None:
    made = fragile_of((0.4, 0.5), hazard(), None, None)
    assert made.at(AT) == pytest.approx(stats.lognorm(0.5, scale=0.4).cdf(AT), rel=1e-12)
    step = fragile_of((0.4, 0.0), hazard(), None, None)
    assert step.at(AT).tolist() == [0.0, 0.0, 1.0, 1.0, 1.0]
    assert (made.last, made.counted) == (math.inf, None)
    assert pickle.loads(pickle.dumps(made)).at(0.4) == made.at(0.4)


@every(
    ("median", "beta", "fits"),
    [
        (1e-50, 0.0, True), (1e50, 20.0, True), (0.9e-50, 0.5, False), (1.1e50, 0.5, False),
        (0.4, 20.1, False), (0.4, -0.1, False), (0.0, 0.5, False), (math.nan, 0.5, False),
    ],
)  # fmt: skip
def test_medians_and_betas_have_bounds(median: float, beta: float, fits: bool) -> None:
    if fits:
        assert fragile_of((median, beta), hazard(), None, None).given == (median, beta)
        return
    with pytest.raises(InputError, match=r"give the fragility as \(median, beta\)"):
        fragile_of((median, beta), hazard(), None, None)


@every(
    ("measure", "of", "factor"),
    [
        ("p_pgv_per_uplift", "pgv_m_s", BLOCK.positive.p / (9.80665 * 0.32 / 1.8)),
        ("pga_per_uplift", "pga_g", 1.8 / 0.32),
    ],
)
def test_a_measure_of_the_block_is_a_multiple_of_one_of_the_ground(
    measure: str, of: str, factor: float
) -> None:
    scaled = fragile_of((0.4 * factor, 0.5), hazard(of), measure, BLOCK)
    assert scaled.factor == pytest.approx(factor, rel=1e-12)
    assert scaled.at(AT) == pytest.approx(
        fragile_of((0.4, 0.5), hazard(of), None, None).at(AT), rel=1e-9
    )


def test_of_counted_shares_the_last_state_counts_over_its_own_measure() -> None:
    fragility = counted()
    made = fragile_of(fragility, hazard("pga_g"), None, None)
    last = fragility.states[-1]
    assert made.given is last
    assert made.at([0.3, 0.8]).tolist() == last.share([0.3, 0.8]).tolist()
    assert made.last == 1.6
    first = fragile_of(fragility.state("uplift"), hazard("pga_g"), "pga_g", None)
    assert first.at([0.17, 0.19]).tolist() == [0.0, 1.0]


def test_records_that_are_drawn_once_each_give_the_shares_and_one_its_own() -> None:
    curve = counted().states[-1].curve
    at, size = np.array([0.3, 0.41, 1.0]), len(curve.counts[0].fell)
    draws = np.concatenate([np.ones((1, size), np.int64), size * np.eye(size, dtype=np.int64)])
    first, *others = resampled(curve, draws, at)
    assert first == pytest.approx(curve.at(at), rel=1e-12)
    assert np.mean([row[-1] for row in resampled(curve, draws[1:], curve.levels)]) == (
        pytest.approx(curve.shares[-1])
    )
    assert len(others) == size


NEVER = fit_curve([0.2, 0.4, 0.8], [0, 0, 0], [9] * 3)
OTHER = fit_curve([0.2, 0.4, 0.8], [2, 5, 8], [9] * 3, measure=("PGA", "g"))
FALLING = fit_curve([0.2, 0.4, 0.8], [8, 5, 2], [9] * 3)


@every(
    ("given", "over", "line"),
    [
        ({}, "sa_g:1", "fit the fragility over sa_g:1.0"),
        ({"measure": "velocity"}, "pga_g", "measure = 'velocity' is not valid"),
        ({"measure": "p_pgv_per_uplift"}, "pgv_m_s", "give block="),
        ({"fragility": NEVER}, "pgv_m_s", "fragility has no curve: its status is never: "),
        ({"fragility": FALLING}, "pgv_m_s", "its status is not-rising"),
        ({"fragility": OTHER}, "pgv_m_s", "fragility is a curve over PGA: the hazard curve is "),
        ({"fragility": "x"}, "pgv_m_s", "it is a Fragility, one of its states, a FragilityCurve"),
        ({"fragility": (0.4,)}, "pgv_m_s", "or (median, beta)"),
    ],
)
def test_what_does_not_fit_is_refused_with_the_way_out(
    given: dict[str, Any], over: str, line: str
) -> None:
    asked: dict[str, Any] = {"fragility": (0.4, 0.5), "measure": "pga_g" if not given else None}
    asked |= given
    with pytest.raises(InputError) as refusal:
        fragile_of(asked["fragility"], hazard(over), asked["measure"], None)
    assert line in str(refusal.value)


def test_counts_of_too_few_records_or_over_another_measure_have_no_rate() -> None:
    with pytest.raises(InputError, match=r"fragility is of 10 records: .* 11 records or more"):
        fragile_of(counted(10), hazard("pga_g"), None, None)
    with pytest.raises(InputError, match="fragility is of 10 records"):
        fragile_of(counted(10).states[0], hazard("pga_g"), None, None)
    with pytest.raises(InputError, match="the hazard curve is over PGV"):
        fragile_of(counted(), hazard(), None, None)
    with pytest.raises(InputError, match="the shares are over pga_g"):
        fragile_of(counted(), hazard(), "pgv_m_s", None)
    with pytest.raises(InputError, match="the shares are over factors"):
        fragile_of(
            compute_fragility(
                BLOCK,
                make_synthetic_suite(11),
                levels=Levels("scale", [0.5, 1.0], beside=()),
                restitution=RestitutionBand(draws=1),
            ),
            hazard(),
            None,
            None,
        )
