"""Risk: published figures, limits, units, fitted curves, simulated lives, and refusals."""

import dataclasses
import math
import re
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtr

from rocksteady import Block, compute_fragility, compute_risk
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import HazardCurve, Levels, RestitutionBand, fit_curve
from tests.every import every
from tools.namespace import THINGS

BLOCK = Block.rectangle(width=0.32, height=1.8)
LEVELS = np.geomspace(0.02, 2.0, 12)
HAZARD = HazardCurve(measure="pgv_m_s", levels=LEVELS, rates=3e-4 * LEVELS**-1.8 / (1.0 + LEVELS))


def power_law(k: float, measure: str = "pgv_m_s") -> HazardCurve:
    levels = np.geomspace(1e-4, 1e3, 8)
    return HazardCurve(measure=measure, levels=levels, rates=1e-4 * levels**-k)


def test_the_cabinet_of_the_brief() -> None:
    # practice.md: .32 x 1.8 m, median .4653 m/s; the rate is H(median) exp(k^2 .592^2/2).
    risk = compute_risk((0.757, 0.592), power_law(2.0), measure="p_pgv_per_uplift", block=BLOCK)
    assert risk.median == pytest.approx(0.4653, abs=5e-5)
    exact = 1e-4 * 0.46527**-2.0 * math.exp(0.5 * 4.0 * 0.592**2)
    assert risk.annual_rate == pytest.approx(exact, rel=2e-5)
    assert risk.closed_form_rate == pytest.approx(risk.annual_rate, rel=1e-6)
    assert risk.k == pytest.approx(2.0, rel=1e-9)
    assert risk.probability == pytest.approx(1.0 - math.exp(-50.0 * exact), rel=2e-5)
    assert risk.survival + risk.probability == pytest.approx(1.0, rel=1e-15)


@every(("beta_r", "beta_u"), [(0.592, 0.0), (0.3, 0.25), (0.0, 0.0)])
def test_the_capacity_of_high_confidence_and_low_probability(beta_r: float, beta_u: float) -> None:
    risk = compute_risk((0.4653, beta_r), HAZARD, beta_u=beta_u)
    assert risk.hclpf == pytest.approx(0.4653 * math.exp(-1.645 * (beta_r + beta_u)), rel=1e-12)
    # 95 % sure that the median is above m; for an object of that median 5 % fail at the HCLPF.
    if beta_r > 0.0:
        weak = 0.4653 * math.exp(-1.645 * beta_u)
        assert ndtr(math.log(risk.hclpf / weak) / beta_r) == pytest.approx(0.05, abs=2e-5)


@pytest.mark.parametrize(
    ("measure", "of", "factor"),
    [
        ("p_pgv_per_uplift", "pgv_m_s", BLOCK.positive.p / (9.80665 * 0.32 / 1.8)),
        ("pga_per_uplift", "pga_g", 1.8 / 0.32),
    ],
)
def test_the_same_risk_in_the_measure_of_the_block_and_of_the_ground(
    measure: str, of: str, factor: float
) -> None:
    hazard = dataclasses.replace(HAZARD, measure=of)
    ground = compute_risk((0.4, 0.5), hazard)
    scaled = compute_risk((0.4 * factor, 0.5), hazard, measure=measure, block=BLOCK)
    assert scaled.factor == pytest.approx(factor, rel=1e-12)
    for name in ("annual_rate", "hclpf", "median", "closed_form_rate"):
        assert getattr(scaled, name) == pytest.approx(getattr(ground, name), rel=1e-9), name
    assert scaled.contributing == pytest.approx(ground.contributing, rel=1e-9)


def test_of_an_asymmetric_block_the_side_that_lifts_first_counts() -> None:
    block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
    risk = compute_risk((1.0, 0.4), power_law(2.0, "pga_g"), measure="pga_per_uplift", block=block)
    weak = min(math.tan(block.positive.alpha), math.tan(block.negative.alpha))
    assert risk.median == pytest.approx(weak, rel=1e-12)


def test_units_do_not_matter() -> None:
    other = dataclasses.replace(HAZARD, levels=HAZARD.levels * 37.0)
    one, two = compute_risk((0.4, 0.5), HAZARD), compute_risk((0.4 * 37.0, 0.5), other)
    assert two.annual_rate == pytest.approx(one.annual_rate, rel=1e-11)
    assert two.contributing == pytest.approx(tuple(37.0 * x for x in one.contributing), rel=1e-9)
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
    survived = lives - np.unique(life[fails]).size
    spread = math.sqrt(risk.survival * risk.probability / lives)
    assert 0.2 < risk.survival < 0.8
    assert abs(survived / lives - risk.survival) < 4.0 * spread
    # And what toppled them: 5, 50 and 95 % of the failures are below the stated intensities.
    below = [np.mean(at[fails] < x) for x in risk.contributing]
    assert below == pytest.approx([0.05, 0.5, 0.95], abs=4.0 * 0.5 / math.sqrt(fails.sum()))


# ------------------------------------------------------------------------------- fitted curves


def test_a_fitted_curve_is_its_median_and_beta() -> None:
    curve = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4, measure=("PGV", "m/s"))
    fitted, plain = compute_risk(curve, HAZARD), compute_risk((curve.median, curve.beta), HAZARD)
    assert fitted.annual_rate == pytest.approx(plain.annual_rate, rel=1e-10)
    assert (fitted.median, fitted.beta) == (curve.median, curve.beta)
    assert fitted.unsampled is not None
    assert plain.unsampled is None
    exact = _share_outside(curve.median, curve.beta, (0.2, 1.6))
    assert fitted.unsampled == pytest.approx(exact, rel=2e-4)


def _share_outside(median: float, beta: float, span: tuple[float, float]) -> float:
    """Return the share of the risk outside a span of intensities, by a sum over small steps."""
    levels = np.geomspace(LEVELS[0], LEVELS[-1], 200_001)[1:-1]
    levels = np.unique(np.concatenate([levels, LEVELS, span]))
    middle = np.sqrt(levels[1:] * levels[:-1])
    parts = ndtr(np.log(middle / median) / beta) * -np.diff(HAZARD.rate(levels))
    lump = float(HAZARD.rates[-1] * ndtr(math.log(LEVELS[-1] / median) / beta))
    outside = parts[(middle < span[0]) | (middle > span[1])].sum() + lump
    return float(outside / (parts.sum() + lump))


def test_separated_data_fail_at_the_rate_of_the_step() -> None:
    curve = fit_curve([0.2, 0.4, 0.8, 1.6], [0, 0, 40, 40], [40] * 4)
    assert curve.status == "separated"
    risk = compute_risk(curve, HAZARD)
    assert risk.annual_rate == pytest.approx(float(HAZARD.rate(curve.median)), rel=1e-12)


@pytest.mark.parametrize(("failures", "bound"), [([0, 0, 0], 0.8), ([40, 40, 40], 0.02)])
def test_without_failures_or_survivals_the_rate_is_an_upper_bound(
    failures: list[int], bound: float
) -> None:
    curve = fit_curve([0.2, 0.4, 0.8], failures, [40] * 3)
    risk = compute_risk(curve, HAZARD)
    assert risk.annual_rate == pytest.approx(float(HAZARD.rate(bound)), rel=1e-9)
    assert "upper bound" in risk.summary()
    assert risk.to_dict()["median"] is None


def test_what_never_fails_below_the_last_level_has_no_rate_and_its_risk_above() -> None:
    """A step of 4 m/s, beyond a hazard curve that ends at 1 m/s."""
    hazard = HazardCurve(
        measure="pgv_m_s", levels=np.array([0.1, 0.5, 1.0]), rates=np.array([0.1, 0.01, 0.001])
    )
    risk = compute_risk(fit_curve([1.0, 2.0, 4.0], [0, 0, 0], [40] * 3), hazard)
    assert risk.annual_rate == 0.0
    assert risk.contributing == (math.inf,) * 3
    assert "above 1" in risk.summary()


def test_what_is_no_fragility_is_refused_by_the_names_of_public_things() -> None:
    for given in ("x", None, RestitutionBand(), [0.4, 0.5], (0.4,), (0.4, 0.5, 0.6)):
        with pytest.raises(InputError) as caught:
            compute_risk(given, HAZARD)  # type: ignore[arg-type]
        named = re.findall(
            r"\b[A-Z][a-z]+[A-Z]\w+|\bFragil\w+", str(caught.value).partition(": ")[2]
        )
        assert named
        assert set(named) <= THINGS.keys(), str(caught.value)


def test_counted_shares_have_no_rate_and_their_fit_has() -> None:
    fragility = compute_fragility(
        BLOCK,
        make_synthetic_suite(3),
        levels=Levels("pgv_m_s", [0.2, 0.4, 0.8, 1.6], beside=()),
        restitution=RestitutionBand(draws=1),
    )
    with pytest.raises(InputError, match="not of counted shares") as caught:
        compute_risk(fragility, HAZARD)  # type: ignore[arg-type]
    assert str(caught.value).startswith("fragility is counted: ")
    curve = fragility.state("overturned").lognormal
    assert compute_risk(curve, HAZARD).median == curve.median


# -------------------------------------------------------------------------- sentences, refusals


def test_what_lies_beyond_the_hazard_is_stated() -> None:
    short = HazardCurve(measure="pga_g", levels=np.array([0.1, 0.3]), rates=np.array([0.01, 0.001]))
    risk = compute_risk((0.4, 0.4), short, measure="pga_g")
    assert risk.share_outside > 0.5
    assert risk.contributing[2] == math.inf
    text = " ".join(risk.summary().split())
    assert "would lie outside: compute the curve further out" in text
    assert "above 0.3" in text
    told = risk.to_dict()
    assert told["contributing"][2] is None
    assert told["contributions"][-1]["high"] is None
    tailed = compute_risk((0.4, 0.4), short.extended(), measure="pga_g")
    k = math.log(10.0) / math.log(3.0)
    exact = 0.01 * 4.0**-k * math.exp(0.5 * (0.4 * k) ** 2)
    assert tailed.annual_rate == pytest.approx(exact, rel=1e-9)
    # Counting what is above with the probability at the last level is less than all of it.
    assert risk.annual_rate < tailed.annual_rate
    assert math.isnan(risk.closed_form_rate)
    assert tailed.closed_form_rate == pytest.approx(exact, rel=1e-9)


def test_a_curve_over_pgv_says_that_it_has_no_threshold() -> None:
    notes = " ".join(compute_risk((0.4, 0.5), HAZARD).describe().notes)
    assert "no threshold of uplift" in notes
    assert "too high rather than too low" in notes
    assert "No measure is given" in notes
    over = compute_risk((0.4, 0.5), power_law(2.0, "pga_g"), measure="pga_g")
    assert not any("threshold" in note or "No measure" in note for note in over.describe().notes)


@every("at", [0.02, 0.021, 0.1, 0.7, 2.0, 0.004, 9.0])
def test_the_density_is_the_probability_times_the_fall_of_the_hazard(at: float) -> None:
    """By a difference of the hazard in the logarithm; at an end of the levels on its inner side."""
    tailed = HAZARD.extended()
    risk = compute_risk((0.4, 0.5), tailed)
    ends = np.array([at * (1.0 - 1e-6 * (at != 0.02)), at * (1.0 + 1e-6 * (at != 2.0))])
    slope = -float(np.diff(tailed.rate(ends))[0]) / math.log(ends[1] / ends[0])
    expected = slope * float(ndtr(math.log(at / 0.4) / 0.5))
    near = pytest.approx(expected, rel=1e-5, abs=0.0)  # it may be far below 1e-12
    assert float(risk.density(at)) == near
    if 0.02 <= at <= 2.0:
        assert float(compute_risk((0.4, 0.5), HAZARD).density(at)) == near
    with pytest.raises(InputError, match="level"):
        risk.density(0.0)


def test_rows_and_json_add_up() -> None:
    risk = compute_risk((0.4, 0.5), HAZARD)
    told = risk.to_dict()
    assert sum(row["share"] for row in told["contributions"]) == pytest.approx(1.0)
    assert sum(row["annual_rate"] for row in told["contributions"]) == pytest.approx(
        told["annual_rate"]
    )
    assert told["return_period_years"] == pytest.approx(1.0 / told["annual_rate"])
    assert told["contributing"] == sorted(told["contributing"])


@every(
    ("options", "line"),
    [
        ({"measure": "pga_g"}, "fit the fragility over sa_g:1.0"),
        ({"measure": "sa_g:0.5"}, "fit the fragility over sa_g:1.0"),
        ({"measure": "p_pgv_per_uplift", "block": BLOCK}, "fit the fragility over sa_g:1.0"),
        ({"measure": "velocity"}, "measure = 'velocity' is not valid"),
        ({"years": 0.0}, "years = 0.0 is not valid"),
        ({"beta_u": -0.1}, "beta_u = -0.1 is not valid"),
        ({"fragility": (0.0, 0.5)}, "median = 0.0 is not valid"),
        ({"fragility": (0.4, -0.5)}, "beta = -0.5 is not valid"),
    ],
)
def test_what_does_not_fit_is_refused_with_the_way_out(options: dict[str, Any], line: str) -> None:
    given: dict[str, Any] = {"fragility": (0.4, 0.5), "hazard": power_law(2.0, "sa_g:1")}
    with pytest.raises(InputError) as refusal:
        compute_risk(**{**given, **options})
    assert line in str(refusal.value)


def test_a_dimensionless_fragility_needs_its_block() -> None:
    with pytest.raises(InputError, match="give block="):
        compute_risk((0.757, 0.592), HAZARD, measure="p_pgv_per_uplift")
    curve = fit_curve([0.2, 0.4, 0.8], [2, 20, 38], [40] * 3, measure=("p PGV/(g tan alpha)", ""))
    with pytest.raises(InputError, match=r"a curve over p PGV/\(g tan alpha\)"):
        compute_risk(curve, HAZARD)
    assert compute_risk(curve, HAZARD, measure="p_pgv_per_uplift", block=BLOCK).annual_rate > 0.0


def test_a_curve_that_does_not_rise_is_refused() -> None:
    curve = fit_curve([0.2, 0.4, 0.8], [30, 20, 10], [40] * 3)
    assert curve.status == "not-rising"
    with pytest.raises(InputError, match="does not rise with the intensity"):
        compute_risk(curve, HAZARD)


def test_a_tail_of_infinite_risk_is_refused() -> None:
    curve = fit_curve([0.2, 0.4, 0.8], [10, 20, 30], [40] * 3, family="logistic")
    with pytest.raises(InputError, match="rises faster than the fragility falls"):
        compute_risk(curve, power_law(4.0).extended())
    assert compute_risk(curve, power_law(4.0)).annual_rate > 0.0


def test_notes_say_what_is_to_be_known_of_the_figures() -> None:
    risk = compute_risk((0.4, 0.4), HAZARD)
    notes = " ".join(risk.describe().notes)
    assert "Failures are a Poisson process: independent, at a constant rate, the object" in notes
    ground = HazardCurve(measure="pga_g", levels=LEVELS, rates=3e-4 * LEVELS**-1.8)
    assert "tails" not in " ".join(compute_risk((0.4, 0.4), ground).describe().notes)
    tailed = " ".join(compute_risk((0.4, 0.4), ground.extended()).describe().notes)
    assert "The hazard curve has power-law tails: " in tailed
    for unsampled, said in ((None, False), (0.0, False), (0.5, True)):
        some = " ".join(dataclasses.replace(risk, unsampled=unsampled).describe().notes)
        assert ("% of the risk are from intensities that no trial" in some) == said
    values = risk.to_dict()
    assert values["years"] == 50.0
    rows = values["contributions"]
    assert (rows[0]["low"], rows[-1]["high"]) == (None, None)
    assert [row["high"] for row in rows[:-1]] == [row["low"] for row in rows[1:]]
