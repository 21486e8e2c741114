"""Fragility in two stages: the product, its likelihood, its median and its band."""

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady import Bands, InputError, TwoStageCurve, fit_curve, fit_two_stages

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


@pytest.mark.parametrize("gate_beta", [0.0, 0.2, 0.6])
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
    found = fitted(gate_beta=gate_beta, bands=Bands(replicates=400))
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
    assert found.median_band == fitted(gate_beta=gate_beta, bands=Bands(replicates=400)).median_band


def test_a_gate_far_below_leaves_the_band_of_the_second_stage() -> None:
    at, _, failures, record = made(40, 2, gate_beta=0.0)
    always = np.ones_like(failures)
    found = fit_two_stages(at, always, failures, groups=record, bands=Bands(replicates=300))
    alone = fit_curve(at, failures, groups=record, bands=Bands(replicates=300))
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
    """Of 30 suites, 90 % bands of P miss more than 9 with a chance below 1 in 1000."""
    at = 0.6
    truth = stats.norm.cdf(math.log(at / GATE) / 0.3) * stats.norm.cdf(math.log(at / MEDIAN) / BETA)
    missed = 0
    for seed in range(30):
        level, uplifted, failures, record = made(40, 100 + seed, gate_beta=0.3)
        counts = (level, uplifted, failures)
        found = fit_two_stages(*counts, groups=record, bands=Bands(replicates=200))
        low, high = found.probability_band(at) or (1.0, 0.0)
        missed += not low <= truth <= high
    assert missed <= 9


def test_no_uplift_is_no_failure() -> None:
    none = [0, 0, 0]
    found = fit_two_stages([1.0, 2.0, 3.0], none, none, bands=Bands())
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
    grouped = fit_two_stages(AT, sums[0], sums[1], thirty, bands=Bands(replicates=100))
    single = fit_two_stages(at, uplifted, failures, bands=Bands(replicates=100))
    assert grouped.to_dict() == single.to_dict()


def test_failures_above_uplifted_are_refused() -> None:
    with pytest.raises(InputError, match=r"failures\[1\] = 1 .*uplifted\[1\] = 0"):
        fit_two_stages([1.0, 2.0], [0, 0], [0, 1])
    with pytest.raises(InputError, match=r"uplifted\[0\] = 2 .*trials\[0\] = 1"):
        fit_two_stages([1.0, 2.0], [2, 0], [0, 0])
