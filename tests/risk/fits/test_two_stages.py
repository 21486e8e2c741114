"""Fragility in two stages: the product, its likelihood, its median and its band."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import statsmodels.api as sm
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.risk import BandOptions, TwoStageCurve, fit_curve, fit_two_stages
from rocksteady.risk.fits.two_stages import FARTHEST, _crossings
from tests.every import every

AT = np.geomspace(0.1, 4.0, 20)
GATE, MEDIAN, BETA = 0.33, 0.35, 0.8


def made(records: int, seed: int, *, gate_beta: float) -> tuple[np.ndarray, ...]:
    """Return intensity, uplifted, failures and record of records with both capacities."""
    rng = np.random.default_rng(seed)
    gate = GATE * np.exp(gate_beta * rng.normal(size=(records, 1)))
    capacity = MEDIAN * np.exp(BETA * rng.normal(size=(records, 1)))
    at = np.broadcast_to(AT, (records, len(AT)))
    uplifted = at >= gate
    failures = uplifted & (at >= capacity)
    number = np.repeat(np.arange(records), len(AT))
    return at.ravel(), uplifted.astype(int).ravel(), failures.astype(int).ravel(), number


def fitted(records: int = 60, *, gate_beta: float = 0.0, **options: Any) -> TwoStageCurve:
    at, uplifted, failures, record = made(records, 1, gate_beta=gate_beta)
    return fit_two_stages(at, uplifted, failures, groups=record, **options)


@pytest.mark.parametrize("gate_beta", [0.0, 0.2])
def test_stages_are_the_curves_of_their_own_trials(gate_beta: float) -> None:
    at, uplifted, failures, record = made(60, 1, gate_beta=gate_beta)
    found = fitted(gate_beta=gate_beta)
    first = fit_curve(at, uplifted, groups=record)
    lifted = uplifted == 1
    second = fit_curve(at[lifted], failures[lifted], groups=record[lifted])
    single = fit_curve(at, failures, groups=record)
    for mine, alone in ((found.uplift, first), (found.given_uplift, second), (found.plain, single)):
        assert (mine.status, mine.median, mine.beta) == (alone.status, alone.median, alone.beta)
        assert (mine.trials, mine.failures, mine.records) == (
            alone.trials,
            alone.failures,
            alone.records,
        )
    assert found.log_likelihood == pytest.approx(first.log_likelihood + second.log_likelihood)
    assert found.probability(AT) == pytest.approx(first.probability(AT) * second.probability(AT))


def test_the_likelihood_is_that_of_three_outcomes() -> None:
    at, uplifted, failures, _ = made(60, 1, gate_beta=0.2)
    found = fitted(gate_beta=0.2)
    up = stats.norm(math.log(found.uplift.median), found.uplift.beta)
    down = stats.norm(math.log(found.given_uplift.median), found.given_uplift.beta)
    logs = np.log(at)
    outcome = np.where(
        failures == 1,
        up.logcdf(logs) + down.logcdf(logs),
        np.where(uplifted == 1, up.logcdf(logs) + down.logsf(logs), up.logsf(logs)),
    )
    assert found.log_likelihood == pytest.approx(outcome.sum(), rel=1e-10)


def test_a_separated_gate_is_a_step_and_the_product_fits_better_than_one_curve() -> None:
    found = fitted()
    below, above = AT[AT < GATE].max(), AT[AT >= GATE].min()
    assert found.uplift.status == "separated"
    assert found.uplift.step == (below, above)
    assert found.probability(below) == 0.0
    assert found.probability(above) == found.given_uplift.probability(above)
    assert found.misfit < 0.6 * found.plain.misfit
    shares = {row[0]: row[2] / row[1] for row in found.stripes}
    gaps = [abs(share - float(found.probability(at))) for at, share in shares.items()]
    assert found.misfit == pytest.approx(max(gaps))
    assert f"{found.plain.misfit:.3g}" in found.summary()
    assert "uplift: failures and survivals are separated" in found.summary()


@every("gate_beta", [0.0, 0.2, 0.6])
def test_a_quantile_is_a_root_of_the_product(gate_beta: float) -> None:
    found = fitted(gate_beta=gate_beta)
    for p in (0.01, 0.3, 0.5, 0.7, 0.99):
        at = found.quantile(p)
        if gate_beta == 0.0 and at == found.uplift.median:  # the step jumps over the probability
            assert found.probability(0.999 * at) < p < found.probability(1.001 * at)
        else:
            assert found.probability(at) == pytest.approx(p, rel=1e-9)
    assert found.median == found.quantile(0.5)
    with pytest.raises(InputError, match="probability"):
        found.quantile(1.0)


@pytest.mark.parametrize("gate_beta", [0.0, 0.3])
def test_the_band_holds_the_curve_and_the_median(gate_beta: float) -> None:
    found = fitted(gate_beta=gate_beta, bands=BandOptions(replicates=400))
    at = AT[AT > 1.2 * GATE]
    low, high = found.probability_band(at) or (at, at)
    curve = found.probability(at)
    assert ((low < curve) & (curve < high)).all()
    assert found.median_band is not None
    least, most = found.median_band
    assert least < found.median < most
    ends = found.probability_band([least, most]) or (at, at)
    assert ends[0][1] == pytest.approx(0.5, abs=1e-6)
    assert ends[1][0] == pytest.approx(0.5, abs=1e-6) or least == pytest.approx(
        (found.uplift.step or (0.0, 0.0))[0]
    )
    assert (
        found.median_band
        == fitted(gate_beta=gate_beta, bands=BandOptions(replicates=400)).median_band
    )


def test_a_gate_far_below_leaves_the_band_of_the_second_stage() -> None:
    at, _, failures, record = made(40, 2, gate_beta=0.0)
    always = np.ones_like(failures)
    found = fit_two_stages(at, always, failures, groups=record, bands=BandOptions(replicates=300))
    alone = fit_curve(at, failures, groups=record, bands=BandOptions(replicates=300))
    assert found.uplift.status == "always"
    assert found.median == pytest.approx(alone.median)
    assert found.probability(0.5) == alone.probability(0.5)
    band, other = found.probability_band(0.5), alone.probability_band(0.5)
    assert band is not None
    assert other is not None
    # All 40 records lift: the lower end has the bound of that, the upper one is the same.
    assert band[1] == pytest.approx(float(other[1]))
    assert band[0] == pytest.approx(float(other[0]) * 0.1 ** (1 / 40))


@pytest.mark.slow
def test_bands_of_two_fitted_stages_cover_the_truth() -> None:
    """Of 15 suites, 90 % bands of P miss more than 6 with a chance below 1 in 1000."""
    at = 0.6
    truth = stats.norm.cdf(math.log(at / GATE) / 0.3) * stats.norm.cdf(math.log(at / MEDIAN) / BETA)
    missed = 0
    for seed in range(15):
        level, uplifted, failures, record = made(40, 100 + seed, gate_beta=0.3)
        counts = (level, uplifted, failures)
        found = fit_two_stages(*counts, groups=record, bands=BandOptions(replicates=200))
        low, high = found.probability_band(at) or (1.0, 0.0)
        missed += not low <= truth <= high
    assert missed <= 6


def test_stages_are_used_where_they_are_likelier_than_one_curve() -> None:
    draw = np.random.default_rng(35)
    gains = []
    for case in range(40):
        lifted = draw.binomial(40, stats.norm.cdf(np.log(AT / 0.3) / draw.uniform(0.05, 0.8)))
        failures = draw.binomial(lifted, stats.norm.cdf(np.log(AT / 0.8) / 0.4))
        uplifted = 0.09 if case % 4 == 0 else lifted
        found = fit_two_stages(AT, uplifted, failures, np.full(len(AT), 40))
        two, one = (
            float(np.sum(stats.binom.logpmf(failures, 40, curve.probability(AT))))
            for curve in (found, found.plain)
        )
        assert found.gain == pytest.approx(two - one, rel=1e-8, abs=1e-8)
        assert found.best is (found if case % 4 == 0 or two - one > 1e-6 else found.plain)
        gains.append(found.gain)
    assert min(gains) < 0.0 < max(gains)


def test_no_uplift_is_no_failure() -> None:
    none = [0, 0, 0]
    found = fit_two_stages([1.0, 2.0, 3.0], none, none, bands=BandOptions())
    assert (found.uplift.status, found.given_uplift.status) == ("never", "never")
    assert (found.given_uplift.trials, found.given_uplift.sampled) == (0, (0.0, 0.0))
    assert found.probability([1.0, 3.0]).tolist() == [0.0, 0.0]
    assert math.isnan(found.median)
    assert "there is no trial, and nothing is known" in found.summary()
    assert found.to_dict()["median"] is None


def test_single_trials_are_as_grouped_ones() -> None:
    at, uplifted, failures, _ = made(30, 4, gate_beta=0.2)
    sums = [np.bincount(np.searchsorted(AT, at), weights=w) for w in (uplifted, failures)]
    thirty = np.full(len(AT), 30)
    grouped = fit_two_stages(AT, sums[0], sums[1], thirty, bands=BandOptions(replicates=100))
    single = fit_two_stages(at, uplifted, failures, bands=BandOptions(replicates=100))
    assert grouped.to_dict() == single.to_dict()


def test_failures_above_uplifted_are_refused() -> None:
    with pytest.raises(InputError, match=r"failures\[1\] = 1 .*uplifted\[1\] = 0"):
        fit_two_stages([1.0, 2.0], [0, 0], [0, 1])
    with pytest.raises(InputError, match=r"uplifted\[0\] = 2 .*trials\[0\] = 1"):
        fit_two_stages([1.0, 2.0], [2, 0], [0, 0])


EXCESS = (0.277, 0.25, 0.9)
"""Gate, median of the excess over it, and beta."""
STRIPES = np.linspace(0.1, 1.5, 29)


def behind(
    gate: float, median: float, beta: float, *, records: int = 60, seed: int = 0
) -> tuple[np.ndarray, ...]:
    """Return intensity, failures and record of capacities gate + lognormal."""
    rng = np.random.default_rng(seed)
    capacity = gate + median * np.exp(beta * rng.normal(size=(records, 1)))
    at = np.broadcast_to(STRIPES, (records, len(STRIPES)))
    number = np.repeat(np.arange(records), len(STRIPES))
    return at.ravel(), (at >= capacity).astype(int).ravel(), number


def test_an_exact_gate_recovers_the_excess_that_was_drawn() -> None:
    gate, median, beta = EXCESS
    at, failures, record = behind(*EXCESS, records=400)
    found = fit_two_stages(at, gate, failures, groups=record, bands=BandOptions(replicates=200))
    given = found.given_uplift
    assert (found.gate, found.offset) == (gate, gate)
    # 400 capacities: five standard errors of the mean, and of the spread, of their logarithm.
    assert math.log(given.median / median) == pytest.approx(0.0, abs=5.0 * beta / 20.0)
    assert given.beta == pytest.approx(beta, abs=5.0 * beta / math.sqrt(800.0))
    truth = stats.norm.cdf(np.log((0.6 - gate) / median) / beta)
    assert found.probability(0.6) == pytest.approx(truth, abs=5.0 * 0.5 / 20.0)
    assert found.median == pytest.approx(gate + given.median, rel=1e-12)
    assert found.misfit < 0.05 < found.plain.misfit
    # Without the gate the second stage is a lognormal of the intensity, and less likely.
    unknown = fit_two_stages(at, (at > gate).astype(int), failures, groups=record)
    assert (unknown.gate, unknown.offset) == (None, 0.0)
    assert unknown.log_likelihood < found.log_likelihood - 5.0


@pytest.mark.parametrize("family", ["lognormal", "logistic"])
def test_the_second_stage_is_the_glm_of_the_logarithm_of_the_excess(family: Any) -> None:
    gate = EXCESS[0]
    at, failures, record = behind(*EXCESS)
    given = fit_two_stages(at, gate, failures, groups=record, family=family).given_uplift
    above = at > gate
    link = sm.families.links.Probit() if family == "lognormal" else sm.families.links.Logit()
    design = sm.add_constant(np.log(at[above] - gate))
    model = sm.GLM(failures[above], design, family=sm.families.Binomial(link=link))
    fit = model.fit(tol=1e-12, maxiter=200)
    constant, slope = fit.params
    assert given.beta == pytest.approx(1.0 / slope, rel=1e-6)
    assert given.median == pytest.approx(math.exp(-constant / slope), rel=1e-6)
    assert given.log_likelihood == pytest.approx(fit.llf, rel=1e-9)
    assert given.trials == int(above.sum())


def test_the_uplift_stage_is_the_exact_step() -> None:
    gate = EXCESS[0]
    at, failures, record = behind(*EXCESS)
    found = fit_two_stages(at, gate, failures, groups=record, bands=BandOptions(replicates=100))
    assert (found.uplift.status, found.uplift.step) == ("separated", (gate, gate))
    assert (found.uplift.median, found.uplift.failures) == (gate, int((at > gate).sum()))
    assert found.uplift.log_likelihood == 0.0
    assert found.log_likelihood == found.given_uplift.log_likelihood
    assert not any("separated" in sentence for sentence in found.warnings)
    assert found.probability([0.0, 0.5 * gate, gate]).tolist() == [0.0, 0.0, 0.0]
    # It is continuous at the gate, which a lognormal of the intensity is not.
    assert 0.0 < found.probability(gate + 1e-3) < 1e-6
    low, high = found.probability_band([0.5 * gate, gate, gate + 1e-3]) or (at, at)
    assert low.tolist()[:2] == high.tolist()[:2] == [0.0, 0.0]
    assert high[2] < 1e-3


def test_the_words_name_what_the_median_is_of() -> None:
    at, failures, record = behind(*EXCESS)
    found = fit_two_stages(at, EXCESS[0], failures, groups=record, measure=("PGA", "g"))
    given = found.given_uplift
    assert given.measure == ("PGA - 0.277 g", "g")
    labels = {fact.label: fact.text for fact in found.describe().facts if fact.label}
    assert labels["median of the excess over uplift, PGA - 0.277 g"] == f"{given.median:.3g} g"
    assert labels["second stage"].startswith("in the excess over uplift, PGA - 0.277 g")
    assert labels["uplift"] == "step in PGA at 0.277 g"
    values = found.to_dict()
    assert (values["gate"], values["offset"]) == (EXCESS[0], EXCESS[0])


def test_the_likelier_of_both_forms_is_kept() -> None:
    # Capacities are lognormal in the intensity, far above the gate for nearly all of them.
    at, failures, record = behind(0.0, 0.6, 0.25, records=200, seed=3)
    gate = 0.277
    found = fit_two_stages(
        at, gate, failures * (at > gate), groups=record, measure=("PGA", "g"), bands=BandOptions()
    )
    lifted = at > gate
    alone = fit_curve(at[lifted], failures[lifted], groups=record[lifted])
    excess = fit_curve(at[lifted] - gate, failures[lifted], groups=record[lifted])
    assert alone.log_likelihood > excess.log_likelihood
    assert (found.gate, found.offset) == (gate, 0.0)
    assert found.given_uplift.median == alone.median
    assert found.probability([gate, 0.6]).tolist() == [0.0, float(alone.probability(0.6))]
    assert found.quantile(0.5) == pytest.approx(alone.median, rel=1e-12)
    assert found.quantile(1e-9) == gate  # the step jumps over it
    assert found.median_band is not None
    assert found.median_band[0] < found.median < found.median_band[1]
    assert "in PGA, at least as likely as in the excess" in " ".join(found.summary().split())


@pytest.mark.slow
@given(
    gate=st.floats(0.02, 1.2),
    median=st.floats(0.05, 2.0),
    beta=st.floats(0.2, 1.5),
    seed=st.integers(0, 50),
    p=st.floats(0.02, 0.98),
)
@settings(max_examples=60, deadline=None)
def test_behind_any_gate_a_curve_rises_from_nothing(
    gate: float, median: float, beta: float, seed: int, p: float
) -> None:
    at, failures, record = behind(gate, median, beta, records=12, seed=seed)
    found = fit_two_stages(at, gate, failures, groups=record)
    excess, whole = (
        fit_curve(at[at > gate] - shift, failures[at > gate]).log_likelihood
        for shift in (gate, 0.0)
    )
    assert found.log_likelihood == pytest.approx(max(excess, whole), rel=1e-9, abs=1e-9)
    assert (found.probability(np.linspace(0.0, gate, 9)) == 0.0).all()
    if found.given_uplift.status == "fitted":
        rising = found.probability(gate + np.geomspace(1e-6, 10.0, 50))
        assert (np.diff(rising) >= 0.0).all()
        level = found.quantile(p)
        assert level >= gate
        if level > gate * (1.0 + 1e-6):
            assert found.probability(level) == pytest.approx(p, rel=1e-6)


def test_a_gate_and_failures_below_it_are_refused() -> None:
    with pytest.raises(InputError, match=r"failures\[0\] = 1 .*uplifted\[0\] = 0"):
        fit_two_stages([0.2, 0.4], 0.3, [1, 1])
    for bad in (0.0, -0.3, math.inf, math.nan):
        with pytest.raises(InputError, match=r"uplifted = .* above 0"):
            fit_two_stages([0.2, 0.4], bad, [0, 1])
    with pytest.raises(InputError, match="trials has 1 values"):
        fit_two_stages([0.2, 0.4], 0.3, [0, 1], [1])


@pytest.mark.parametrize("failures", [[0, 0, 0, 0], [0, 1, 1, 1]])
def test_behind_a_gate_no_failure_and_no_survival_have_their_status(failures: list[int]) -> None:
    found = fit_two_stages([0.2, 0.4, 0.6, 0.8], 0.3, failures)
    sure = float(failures[1])
    assert found.given_uplift.status == ("always" if sure else "never")
    assert found.probability([0.3, 0.4, 0.8]).tolist() == [0.0, sure, sure]
    assert (found.median == 0.3) if sure else math.isnan(found.median)


@every("away", [1e-3, 0.024, 0.026, 0.3, 2.9])
def test_the_band_of_the_median_is_where_its_ends_cross_one_half(away: float) -> None:
    # Ends that are lognormals of medians a known distance to either side.
    def ends(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        early, late = (stats.norm.cdf(np.log(at / MEDIAN) + shift) for shift in (away, -2.0 * away))
        return late, early

    spread: Any = SimpleNamespace(probability=ends)
    expected = (MEDIAN * math.exp(-away), MEDIAN * math.exp(2.0 * away))
    crossed = _crossings(spread, MEDIAN)
    assert crossed == (pytest.approx(expected, rel=1e-11) if 2.0 * away < FARTHEST else None)
