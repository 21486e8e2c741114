"""Calibrations of synthetic tests, and of tests that say little or nothing."""

import math
from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.special import ndtri

from rocksteady import Execution, Linear, Nonlinear, Status, calibrate, plots
from rocksteady.calibration import (
    DrawOptions,
    ObjectPrior,
    Observations,
    OutcomeErrors,
    Prior,
    PriorRange,
    ShakingTest,
    compute_test_fates,
)
from rocksteady.errors import InputError
from rocksteady.risk.calibration._identified import LIMIT
from rocksteady.risk.calibration.calibrate import _warnings
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.folds import weighted_quantiles
from tests.risk.calibration.trials import CASES, Case, coverage, make_records, make_tests

FEW = DrawOptions(draws=90, gains=3, rounds=3)
LINEAR = Linear()


def shaken(
    fell: Sequence[bool | None], *, gain: float = 1.0, block: ObjectPrior | None = None
) -> Observations:
    """Return a test on each of some motions."""
    given = ObjectPrior(name="block", alpha_rad="0.17:0.33", p_rad_s="3:5")
    tests = [
        ShakingTest(name=record.name or "", record=record, object="block", fell=own, gain=gain)
        for record, own in zip(make_records(len(fell)), fell, strict=True)
    ]
    return Observations(tests=tests, objects={"block": given if block is None else block})


def row_of(found: Calibration, name: str) -> dict[str, Any]:
    return next(row for row in found.parameters if row["parameter"] == name)


@pytest.fixture(scope="module")
def tests() -> Observations:
    return make_tests(Case("40 tests"), 3)[0]


@pytest.fixture(scope="module")
def found(tests: Observations) -> Calibration:
    return calibrate(tests, sampling=FEW, model=LINEAR)


def test_outcomes_move_alpha_towards_the_truth_and_leave_the_rest(found: Calibration) -> None:
    truth = make_tests(Case("40 tests"), 3)[1]
    alpha, posterior = row_of(found, "alpha_rad"), found.posteriors["block"]
    prior_width = alpha["prior_high"] - alpha["prior_low"]
    values, weights = posterior.of("alpha_rad")[:, np.newaxis], posterior.weights[:, np.newaxis]
    median, low, high = weighted_quantiles(values, weights, (0.5, 0.05, 0.95))[:, 0]
    assert high - low < 0.75 * prior_width
    assert abs(median - truth) < 0.5 * prior_width
    assert not any(row["verdict"] == "identified" for row in found.parameters)


def test_held_out_scores_beat_the_base_rate(found: Calibration) -> None:
    rows = found.validation.rows
    assert set(rows) == {"calibrated", "untempered", "base rate", "logistic"}
    assert rows["calibrated"].brier[0] < rows["base rate"].brier[0]
    assert found.validation.predictions.held_out == (True,) * 40
    assert [row["groups"] for row in found.validation.learning] == [1, 2, 4, 8]
    assert set(found.flips) == {
        "half the sampling interval", "linear baseline removed", "high-pass at 0.1 Hz"
    }  # fmt: skip


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bits_with_any_workers(
    tests: Observations, found: Calibration
) -> None:
    again = calibrate(tests, sampling=FEW, model=LINEAR, run=Execution(executor="serial"))
    assert again.to_dict() == found.to_dict()
    other = calibrate(tests, sampling=replace(FEW, seed=1), model=LINEAR)
    assert other.validation.predictions.p.tolist() != found.validation.predictions.p.tolist()


def test_a_training_test_is_predicted_without_its_group(tests: Observations) -> None:
    """Other outcomes of a group, in one round at a fixed temper: the same predictions of it."""
    once = DrawOptions(draws=60, gains=3, rounds=1)
    changed = [
        replace(test, fell=not test.fell) if test.group == tests.tests[0].group else test
        for test in tests.tests
    ]
    first = calibrate(tests, sampling=once, model=LINEAR, temper=1.0)
    second = calibrate(replace(tests, tests=changed), sampling=once, model=LINEAR, temper=1.0)
    own = tests.groups == tests.tests[0].group
    p, q = first.validation.predictions.p, second.validation.predictions.p
    assert p[own] == pytest.approx(q[own], abs=1e-12)
    assert p[~own].tolist() != q[~own].tolist()


def test_predict_holds_training_tests_out_and_others_not(found: Calibration) -> None:
    known, new = found.tests.tests[5], replace(found.tests.tests[5], name="new", gain=0.01)
    row = found.predict([new, known])
    assert row.held_out == (False, True)
    assert row.p[1] == found.validation.predictions.p[5]
    assert row.p[0] == pytest.approx(0.5 * 0.03, abs=0.01)  # nothing lifts: outliers alone
    assert np.isnan(row.low[0]) == (row.effective_draws[0] < 50.0)
    assert row.mc_error[0] < 0.01
    # The outcome of a test changes nothing, and neither do outcomes of new ones.
    other = found.predict([replace(known, fell=not known.fell)])
    assert (other.held_out, other.p[0]) == ((True,), row.p[1])


@pytest.mark.slow
@pytest.mark.parametrize(("fell", "side", "gain"), [(True, "upper", 0.8), (False, "lower", 1.2)])
def test_outcomes_of_one_kind_give_a_bound(fell: bool, side: str, gain: float) -> None:
    many = DrawOptions(draws=1500, gains=3, rounds=3)
    found = calibrate(shaken([fell] * 12, gain=gain), sampling=many, model=LINEAR)
    row = row_of(found, "alpha_rad")
    assert (row["verdict"], row["bound_side"]) == ("bound", side)
    assert not any(each["verdict"] == "identified" for each in found.parameters)
    values, weights = found.posteriors["block"].of("alpha_rad"), found.posteriors["block"].weights
    beyond = values > row["bound"] if fell else values < row["bound"]
    assert weights[beyond].sum() <= 0.1
    assert any("bound of alpha" in sentence for sentence in found.warnings)


ALONE = ObjectPrior(
    name="block", alpha_rad="0.17:0.33", p_rad_s=4.0, housner_factor=1.0, scatter=0.0
)
EXACT = Prior(
    noise=OutcomeErrors(sigma_ln=PriorRange.exactly(0.2), outliers=PriorRange.exactly(0.03))
)


def on_a_grid(tests: Observations) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return 100 alphas, and the probability of a fall of each test there, by 40 gains."""
    alphas = 0.17 + 0.16 * (np.arange(100) + 0.5) / 100
    found = compute_test_fates(
        ALONE.blocks(alphas[:, np.newaxis]),
        tests,
        gains=np.exp(0.2 * ndtri((np.arange(40) + 0.5) / 40)),
        outputs=("status",),
        model=LINEAR,
    )
    fell = found["status"].transpose("block", "test", "gain", "draw").values == Status.OVERTURNED
    return alphas, 0.97 * fell[..., 0].mean(axis=2) + 0.015


def test_posterior_and_predictions_are_those_of_a_dense_grid() -> None:
    """Alpha alone is unknown: its quantiles, and each prediction without its group, by sums."""
    tests = replace(make_tests(Case("16 tests", tests=16), 4)[0], objects={"block": ALONE})
    alphas, p = on_a_grid(tests)
    logs = np.where(tests.fell > 0.0, np.log(p), np.log(1.0 - p))
    found = calibrate(tests, EXACT, sampling=DrawOptions(draws=450), model=LINEAR, temper=1.0)
    weights = np.exp(logs.sum(axis=1))
    ends = np.interp([0.5, 0.05, 0.95], np.cumsum(weights) / weights.sum(), alphas + 0.0008)
    assert found.posteriors["block"].interval("alpha_rad") == pytest.approx(ends, abs=0.01)
    for place, group in enumerate(tests.groups):
        weights = np.exp(logs[:, tests.groups != group].sum(axis=1))
        exact = float(weights @ p[:, place] / weights.sum())
        assert found.validation.predictions.p[place] == pytest.approx(exact, abs=0.08)
    assert found.validation.predictions.p.std() > 0.1


@pytest.mark.parametrize(("fell", "gain", "share"), [(True, 0.8, 0.9), (False, 1.2, 0.1)])
def test_the_bound_of_outcomes_of_one_kind_is_that_of_a_grid(
    fell: bool, gain: float, share: float
) -> None:
    tests = shaken([fell] * 8, gain=gain, block=ALONE)
    alphas, p = on_a_grid(tests)
    weights = np.prod(p if fell else 1.0 - p, axis=1)
    exact = float(np.interp(share, np.cumsum(weights) / weights.sum(), alphas + 0.0008))
    found = calibrate(tests, EXACT, sampling=DrawOptions(draws=450), model=LINEAR, temper=1.0)
    bound = row_of(found, "alpha_rad")["bound"]
    assert bound == pytest.approx(exact, abs=0.008)
    prior = 0.17 + 0.16 * share
    assert abs(prior - exact) > 0.01


def test_unknown_outcomes_return_the_prior() -> None:
    found = calibrate(shaken([None] * 3), sampling=FEW, model=LINEAR)
    assert {row["verdict"] for row in found.parameters} == {"prior returned"}
    assert found.validation.rows == {}
    assert any("no test has an outcome" in sentence for sentence in found.warnings)
    assert len(found.validation.predictions) == 3


def test_one_test_alone_is_predicted_by_the_prior() -> None:
    found = calibrate(shaken([True]), sampling=FEW, model=LINEAR)
    assert any("of one group" in sentence for sentence in found.warnings)
    before = calibrate(shaken([None]), sampling=FEW, model=LINEAR)
    assert found.validation.predictions.p[0] == pytest.approx(
        before.validation.predictions.p[0], abs=0.1
    )


def test_tests_that_lift_nothing_say_nothing() -> None:
    found = calibrate(shaken([False] * 4, gain=1e-3), sampling=FEW, model=LINEAR)
    assert any("is informative" in sentence for sentence in found.warnings)
    row = row_of(found, "alpha_rad")
    assert row["verdict"] == "bound"
    assert row["bound"] == pytest.approx(0.17 + 0.1 * 0.16, abs=0.01)  # the prior's own 10 %


def test_an_object_that_is_known_exactly_is_calibrated() -> None:
    block = ObjectPrior(name="block", alpha_rad=0.25, p_rad_s=4.0, housner_factor=1.0, scatter=0.0)
    noise = OutcomeErrors(sigma_ln=PriorRange.exactly(0.2), outliers=PriorRange.exactly(0.02))
    prior = Prior(noise=noise)
    found = calibrate(shaken([True, False, True], block=block), prior, sampling=FEW, model=LINEAR)
    posterior = found.posteriors["block"]
    assert posterior.names == ()
    assert posterior.effective_draws == pytest.approx(len(posterior.weights))
    assert ((found.validation.predictions.p > 0.0) & (found.validation.predictions.p < 1.0)).all()


@pytest.mark.slow
def test_objects_have_posteriors_of_their_own(tests: Observations) -> None:
    half = [
        replace(test, object="other") if place % 2 else test
        for place, test in enumerate(tests.tests)
    ]
    other = ObjectPrior(name="other", alpha_rad="0.1:0.2", p_rad_s=4.0)
    both = Observations(tests=half, objects={**tests.objects, "other": other})
    found = calibrate(both, sampling=FEW, model=LINEAR)
    assert list(found.posteriors) == ["block", "other"]
    assert found.posteriors["other"].of("alpha_rad").max() <= 0.2
    assert any("own posterior" in note for note in found.describe().notes)


def test_other_folds_and_refusals(found: Calibration) -> None:
    by_test = found.validate("test")
    assert by_test.rows["calibrated"].groups == 40
    with pytest.raises(InputError, match="session"):
        found.validate("session")
    with pytest.raises(InputError, match="temper"):
        calibrate(found.tests, temper=0.0)
    nothing: tuple[Any, ...] = ([], 3.0, np.array(1.0))
    for none in nothing:
        with pytest.raises(InputError, match="tests"):
            found.predict(none)
    with pytest.raises(InputError, match=r"there are .*alpha_rad"):
        found.posteriors["block"].interval("beta")
    for wrong in (1.0, {"alpha_rad"}):
        with pytest.raises(InputError, match=r"name = .* is not valid"):
            found.posteriors["block"].interval(wrong)  # type: ignore[arg-type]
    stranger = replace(found.tests.tests[0], object="stranger", name="new")
    with pytest.raises(InputError, match="stranger"):
        found.predict([stranger])


def test_a_measured_peak_narrows_alpha() -> None:
    """A block that rocked to a known angle, in a test without an amplitude error."""
    record = make_records(1)[0]
    given = ObjectPrior(
        name="block", alpha_rad="0.17:0.33", p_rad_s=4.0, housner_factor=1.0, scatter=0.0
    )
    plain = ShakingTest(name="t", record=record, object="block", fell=False, gain=0.6, sigma_ln=0.0)
    tests = [plain, replace(plain, peak_rad=0.02, sigma_rad=0.003)]
    widths = []
    for test in tests:
        shaken_once = Observations(tests=[test], objects={"block": given})
        found = calibrate(shaken_once, sampling=DrawOptions(draws=300, gains=1), model=LINEAR)
        posterior = found.posteriors["block"]
        values, weights = posterior.of("alpha_rad")[:, np.newaxis], posterior.weights[:, np.newaxis]
        low, high = weighted_quantiles(values, weights, (0.05, 0.95))[:, 0]
        widths.append(high - low)
    assert widths[1] < 0.85 * widths[0]


def test_numbers_of_runs_have_their_ranges() -> None:
    for name, low, high in (("draws", 30, 100_000), ("gains", 1, 1000)):
        for value in (low - 1, high + 1):
            with pytest.raises(InputError, match=f"^{name} = .* from {low} to {high}"):
                DrawOptions(**{name: value})
    for draws, rounds in ((30, 1), (250, 2), (1500, 6)):
        assert len(DrawOptions(draws=draws).per_round) == rounds


def test_below_fifty_effective_draws_nothing_is_identified(tests: Observations) -> None:
    """Of the draws of a concentrated posterior a handful count: no number follows from them."""
    once = DrawOptions(draws=40, gains=2, rounds=1)
    found = calibrate(tests, EXACT, sampling=once, model=LINEAR, temper=1.0)
    posterior = found.posteriors["block"]
    assert posterior.effective_draws < 50.0
    assert all(map(math.isnan, posterior.interval("alpha_rad")))
    for row in found.parameters:
        assert row["verdict"] == "not identified"
        assert (row["median"], row["low"], row["high"], row["bound"]) == (None, None, None, None)
    headline = found.describe().headline
    assert f"no answer yet: it rests on {posterior.effective_draws:.0f} effective draws" in headline
    assert "too few: not identified" in posterior.describe().headline
    predicted = found.validation.predictions
    low = predicted.effective_draws < 50.0
    assert low.any()
    assert np.isnan(predicted.low[low]).all()
    assert all(row["low"] is None for row, few in zip(predicted.rows, low, strict=True) if few)
    drawn = plots.posterior(found, Figure().add_subplot())
    legend = drawn.get_legend()
    assert legend is not None
    assert "not identified" in [
        text.get_text() for text in (legend.get_title(), *legend.get_texts())
    ]


def test_full_equations_count_flips_of_their_tolerance() -> None:
    found = calibrate(shaken([True, False]), sampling=DrawOptions(draws=30, gains=1, rounds=1))
    assert isinstance(found.model, Nonlinear)
    assert "tolerance 1e-06" in found.flips


@pytest.mark.slow
def test_intervals_of_alpha_cover_at_their_rate() -> None:
    """Forty tests, gain error .2: 10 trials, whose share has a standard error of .095."""
    case = next(case for case in CASES if case.sigma == "0.2")
    assert coverage(case, 10, sampling=DrawOptions(draws=450))["covered"] >= 0.6


def test_a_limit_is_said_of_the_object_that_meets_it() -> None:
    outcomes = np.array([[[True, False]]])
    fit = SimpleNamespace(runs=SimpleNamespace(fell=outcomes, unknown=0))
    fine = {"parameter": "alpha_rad", "verdict": "identified", "bound_side": None}
    met = {**fine, "verdict": LIMIT}
    predictions = SimpleNamespace(mc_error=np.zeros(1), effective_draws=np.full(1, 99.0))
    calibration: Any = SimpleNamespace(
        tests=SimpleNamespace(warnings=()),
        posteriors=dict.fromkeys("ab", SimpleNamespace(effective_draws=99.0)),
        parameters=[{**fine, "object": "a"}, {**met, "object": "b"}],
        validation=SimpleNamespace(predictions=predictions, warnings=()),
        sampling=SimpleNamespace(error=0.01),
    )
    fits: Any = [fit, fit]
    (sentence,) = _warnings(calibration, fits)
    assert "alpha_rad of b lies at the limit" in sentence
