"""Risk: published figures, counted shares, bands over records, simulated lives, and refusals."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtr

from rocksteady import Block, compute_fragility, compute_risk
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Fragility, HazardCurve, Levels, RestitutionBand, fit_curve
from rocksteady.risk.hazard.failure_risk import risk_of, why_unknown
from rocksteady.risk.hazard.fragile import fragile_of
from tests.every import every

BLOCK = Block.rectangle(width=0.32, height=1.8)
LEVELS = np.geomspace(0.02, 4.0, 12)
HAZARD = HazardCurve(measure="pga_g", levels=LEVELS, rates=3e-4 * LEVELS**-1.8 / (1.0 + LEVELS))


def power_law(k: float, measure: str = "pgv_m_s") -> HazardCurve:
    levels = np.geomspace(1e-4, 1e3, 8)
    return HazardCurve(measure=measure, levels=levels, rates=1e-4 * levels**-k)


def counted(
    records: int = 30, seed: int = 0, levels: list[float] | None = None, measure: str = "pga_g"
) -> Fragility:
    return compute_fragility(
        BLOCK,
        make_synthetic_suite(records, seed=seed),
        levels=Levels(measure, levels, beside=()),
        restitution=RestitutionBand(draws=2),
    )


def test_the_cabinet_of_the_brief() -> None:
    # practice.md: .32 x 1.8 m, median .4653 m/s; the rate is H(median) exp(k^2 .592^2/2).
    risk = compute_risk((0.757, 0.592), power_law(2.0), measure="p_pgv_per_uplift", block=BLOCK)
    exact = 1e-4 * 0.46527**-2.0 * math.exp(0.5 * 4.0 * 0.592**2)
    assert risk.annual_rate == pytest.approx(exact, rel=2e-5)
    assert risk.probability == pytest.approx(1.0 - math.exp(-50.0 * exact), rel=2e-5)
    assert (risk.band, risk.probability_band, risk.outside) == (None, None, 0.0)


def test_of_an_asymmetric_block_the_side_that_lifts_first_counts() -> None:
    block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
    weak = min(math.tan(block.positive.alpha), math.tan(block.negative.alpha))
    hazard = power_law(2.0, "pga_g")
    scaled = compute_risk((1.0, 0.4), hazard, measure="pga_per_uplift", block=block)
    assert scaled.annual_rate == pytest.approx(
        compute_risk((weak, 0.4), hazard).annual_rate, rel=1e-9
    )


def test_units_do_not_matter() -> None:
    other = dataclasses.replace(HAZARD, levels=HAZARD.levels * 37.0)
    one, two = compute_risk((0.4, 0.5), HAZARD), compute_risk((0.4 * 37.0, 0.5), other)
    assert two.annual_rate == pytest.approx(one.annual_rate, rel=1e-9)
    assert two.contributing == pytest.approx(tuple(37.0 * x for x in one.contributing), rel=0.02)
    faster = dataclasses.replace(HAZARD, rates=HAZARD.rates * 12.0)
    assert compute_risk((0.4, 0.5), faster).annual_rate == pytest.approx(
        12.0 * one.annual_rate, rel=1e-11
    )


def test_simulated_lives_survive_as_often() -> None:
    """Shaking by a Poisson process, each strong enough one a draw: 40,000 lives of 50 years."""
    rng = np.random.default_rng(22)
    levels = np.geomspace(0.02, 8.0, 12)
    hazard = HazardCurve(
        measure="pgv_m_s", levels=levels, rates=0.01 * levels**-1.2 / (1.0 + levels)
    )
    risk = compute_risk((0.5, 0.6), hazard)
    lives = 40_000
    events = rng.poisson(hazard.rates[0] * 50.0, lives)
    exceeded = hazard.rates[0] * rng.random(int(events.sum()))
    # Beyond the last level the intensity is unknown, and counts as that level.
    at = np.exp(np.interp(np.log(exceeded), np.log(hazard.rates[::-1]), np.log(levels[::-1])))
    fails = rng.random(at.size) < ndtr(np.log(at / 0.5) / 0.6)
    life = np.repeat(np.arange(lives), events)
    survived = 1.0 - np.unique(life[fails]).size / lives
    spread = math.sqrt(survived * (1.0 - survived) / lives)
    assert 0.2 < survived < 0.8
    assert abs(1.0 - survived - risk.probability) < 4.0 * spread
    # And what toppled them: 5, 50 and 95 % of the failures are below the stated levels.
    below = [np.mean(at[fails] < x) for x in risk.contributing]
    assert below == pytest.approx([0.05, 0.5, 0.95], abs=0.02)


# ------------------------------------------------------------------------------ counted shares


def test_the_rate_of_counted_shares_is_a_sum_over_small_steps() -> None:
    fragility = counted()
    risk = compute_risk(fragility, HAZARD)
    curve = fragility.states[-1]
    levels = np.geomspace(LEVELS[0], LEVELS[-1], 400_001)
    levels[[0, -1]] = LEVELS[[0, -1]]
    middle = np.sqrt(levels[1:] * levels[:-1])
    total = float(curve.share(middle) @ -np.diff(HAZARD.rate(levels)))
    total += float(HAZARD.rates[-1] * curve.share(LEVELS[-1]))
    assert risk.annual_rate == pytest.approx(total, rel=1e-4)
    assert compute_risk(curve, HAZARD).annual_rate == risk.annual_rate
    assert sum(risk.to_dict()["contributions"][k]["share"] for k in range(12)) == pytest.approx(1.0)


def test_the_band_is_that_of_records_drawn_anew() -> None:
    """By a slow sum over other draws, of each of which the whole curve is made again."""
    fragility = counted()
    risk = compute_risk(fragility, HAZARD)
    assert risk.band is not None
    low, high = risk.band
    assert low < risk.annual_rate < high
    counts = fragility.states[-1].curve.counts
    rng, rates = np.random.default_rng(7), []
    for _ in range(300):
        drawn = rng.integers(0, 30, 30)
        some = [count.among(drawn) for count in counts]  # type: ignore[arg-type]
        curve = dataclasses.replace(fragility.states[-1].curve, counts=some)
        state = dataclasses.replace(fragility.states[-1], curve=curve)
        rates.append(compute_risk(state, HAZARD).annual_rate)
    assert np.quantile(rates, (0.05, 0.95)) == pytest.approx((low, high), rel=0.06)
    chances = risk.probability_band
    assert chances == pytest.approx((-math.expm1(-50.0 * low), -math.expm1(-50.0 * high)))
    assert compute_risk(counted(27), HAZARD).band is None


def test_shares_over_a_measure_of_the_block_have_the_rate_of_those_over_its_pga() -> None:
    """And the same part beyond the runs: none below the lowest uplift, all that is rarer above."""
    levels = [0.25, 0.5, 0.8, 1.2]
    ratios = [level * 1.8 / 0.32 for level in levels]
    risk, scaled = (
        risk_of(fragile_of(each, HAZARD, None, BLOCK), HAZARD, 50.0)
        for each in (counted(levels=levels), counted(levels=ratios, measure="pga_per_uplift"))
    )
    for key in ("annual_rate", "band", "outside", "unknown", "contributing"):
        assert getattr(scaled, key) == pytest.approx(getattr(risk, key), rel=1e-9), key
    between = float(HAZARD.rate(0.32 / 1.8) - HAZARD.rate(0.25)) * float(risk.fragile.at(0.25))
    beyond = between + float(HAZARD.rate(1.2)) * (1.0 - float(risk.fragile.at(1.2)))
    assert risk.outside == pytest.approx(beyond / risk.annual_rate, rel=1e-9)
    assert why_unknown(scaled) == why_unknown(risk)


def test_what_lies_above_the_runs_is_stated_and_a_tenth_is_too_much() -> None:
    level = 1.2
    risk = compute_risk(counted(levels=[0.2, 0.3, 0.5, 0.8, level]), HAZARD)
    part = float(HAZARD.rate(level)) * (1.0 - float(risk.fragile.at(level))) / risk.annual_rate
    assert risk.outside == pytest.approx(part, rel=0.02)
    assert 0.0 < risk.outside < 0.1
    with pytest.raises(InputError) as refusal:
        compute_risk(counted(levels=[0.2, 0.3]), HAZARD)
    assert "nothing is counted above 0.3 g, where " in str(refusal.value)
    assert str(refusal.value).endswith("count at further levels")


# -------------------------------------------------------------------------- sentences, refusals


@every(
    ("levels", "rates", "line"),
    [
        ([0.1, 0.3], [0.01, 0.001], "ends at 0.3 g, where 24 % fall"),
        ([0.01, 0.1], [0.1, 0.01], "ends at 0.1 g, where < 0.1 % fall"),
    ],
)
def test_a_hazard_curve_that_ends_early_gives_no_rate(
    levels: list[float], rates: list[float], line: str
) -> None:
    short = HazardCurve(measure="pga_g", levels=np.array(levels), rates=np.array(rates))
    with pytest.raises(InputError) as refusal:
        compute_risk((0.4, 0.4), short)
    assert f"hazard gives no rate: the hazard curve {line}" in str(refusal.value)
    assert str(refusal.value).endswith("give a hazard curve that reaches further")


def test_a_hazard_curve_or_counts_that_begin_late_give_no_rate() -> None:
    """What falls at their first level falls below it too, at shaking that is more frequent."""
    late = HazardCurve(
        measure="pga_g", levels=np.array([0.8, 2.0]), rates=np.array([8.5e-5, 3.1e-6])
    )
    with pytest.raises(InputError, match=r"begins at 0\.8 g, where > 99 % fall"):
        compute_risk((0.3, 0.3), late)
    fragility = counted(levels=[0.5, 0.8, 2.0])
    assert fragility.states[-1].curve.shares[0] > 0.1
    with pytest.raises(InputError, match=r"nothing is counted below 0\.5 g, where"):
        compute_risk(fragility, HAZARD)


def test_separated_data_fail_at_the_rate_of_the_step() -> None:
    curve = fit_curve([0.2, 0.4, 0.8, 1.6], [0, 0, 40, 40], [40] * 4)
    risk = compute_risk(curve, HAZARD)
    assert risk.annual_rate == pytest.approx(float(HAZARD.rate(curve.median)), rel=1e-12)


def test_rows_and_json_add_up() -> None:
    risk = compute_risk((0.4, 0.5), HAZARD)
    told = risk.to_dict()
    assert sum(row["share"] for row in told["contributions"]) == pytest.approx(1.0)
    assert sum(row["annual_rate"] for row in told["contributions"]) == pytest.approx(
        told["annual_rate"]
    )
    assert told["return_period_years"] == pytest.approx(1.0 / told["annual_rate"])
    assert told["contributing"] == sorted(told["contributing"])
    rows = told["contributions"]
    assert [row["high"] for row in rows[:-1]] == [row["low"] for row in rows[1:]]
    assert rows[-1]["high"] is None


@every("options", [{"years": 0.0}, {"years": 1e10}, {"hazard": "site.csv"}])
def test_what_is_no_time_and_no_curve_is_refused(options: dict[str, Any]) -> None:
    given: dict[str, Any] = {"fragility": (0.4, 0.5), "hazard": HAZARD, **options}
    with pytest.raises(InputError, match=next(iter(options))):
        compute_risk(**given)
