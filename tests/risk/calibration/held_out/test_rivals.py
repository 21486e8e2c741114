"""The logistic against searches with each ridge, measures against their own module."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from scipy import special
from scipy.optimize import minimize

from rocksteady import compute_measures
from rocksteady.arrays import Bools, Floats
from rocksteady.calibration import ObjectPrior, ShakingTest
from rocksteady.risk.calibration.held_out import rivals
from rocksteady.risk.calibration.held_out.rivals import Stack, logistic_curve, logistic_of
from rocksteady.risk.calibration.sampler.exact import rounded
from rocksteady.risk.calibration.sampler.logistic import DESIGN_BITS, probability
from rocksteady.seismic.measures.response_spectrum import compute_response_spectrum
from tests.risk.calibration.cases import make_records

RECORD = make_records(1)[0]
COLUMN = ObjectPrior(name="column", width_m=0.2, height_m=0.8)
TEST = ShakingTest(name="t", record=RECORD, object="column", gain=1.7)


def test_base_rate_is_of_the_object_and_of_the_training() -> None:
    fell = np.array([1.0, 0.0, 1.0, 1.0, np.nan, 0.0])
    objects = np.array([0, 0, 0, 1, 1, 1])
    train = np.array([True, False, True, True, True, False])
    assert rivals.base_rate(fell, objects, train).tolist() == [0.75] * 3 + [2.0 / 3.0] * 3
    assert rivals.base_rate(fell, objects, ~train).tolist() == [1.0 / 3.0] * 6


def test_measures_are_those_of_the_record_as_it_acts() -> None:
    (row,) = rivals.measures_of([TEST], {"column": COLUMN})
    acting = RECORD.scaled(1.7)
    found = compute_measures(acting)
    expected = [found.pga_m_s2, found.pgv_m_s, found.cav_m_s, found.arias_m_s]
    expected += compute_response_spectrum(
        acting, rivals.PERIODS_S
    ).pseudo_acceleration_m_s2.tolist()
    expected += [found.significant_5_95_s, found.mean_period_s]
    assert np.exp(row) == pytest.approx(expected, rel=1e-6)
    double = rivals.measures_of([replace(TEST, gain=3.4)], {"column": COLUMN})[0] - row
    assert double == pytest.approx(np.log(2.0) * np.array(rivals.POWERS), abs=1e-9)
    other = ObjectPrior(name="other", alpha_rad=0.3, p_rad_s=4.0)
    both = rivals.measures_of(
        [TEST, replace(TEST, object="other")], {"column": COLUMN, "other": other}
    )
    assert both[:, :-1] == pytest.approx(np.array([row, row]))
    assert np.exp(both[:, -1]) == pytest.approx([0.25, np.tan(0.3)])


def outcomes(count: int = 80, groups: int = 16) -> tuple[Floats, Floats, np.ndarray]:
    """Return measures in different units, outcomes that follow two of them, and groups."""
    rng = np.random.default_rng(8)
    z = rng.normal(size=(count, 4))
    fell = (rng.random(count) < special.expit(3.0 * z[:, 0] - z[:, 1])).astype(float)
    fell[::13] = np.nan
    return z * [1.0, 5.0, 0.1, 2.0] + [0.0, 30.0, 1.0, -4.0], fell, np.arange(count) % groups


def searched(measures: Floats, fell: Floats, train: Bools, ridge: float) -> Floats:
    """Return the log odds of all tests by a search for the likeliest slopes."""
    z = (measures - measures.mean(axis=0)) / measures.std(axis=0)
    design = np.column_stack([np.ones(len(z)), z])
    known = train & np.isfinite(fell)

    def lost(b: Floats) -> float:
        odds = design[known] @ b
        likely = (np.logaddexp(0.0, odds) - fell[known] * odds).sum()
        return float(likely + 0.5 * ridge * (b[1:] @ b[1:]) + 0.005 * b[0] ** 2)

    odds: Floats = np.clip(design @ minimize(lost, np.zeros(5), tol=1e-9).x, -5.3, 5.3)
    return odds


def test_the_ridge_is_chosen_inside_the_training() -> None:
    measures, fell, codes = outcomes()
    train = codes != 3
    inner = np.unique(np.where(train, codes, -1), return_inverse=True)[1] % rivals.INNER
    scores = []
    for ridge in rivals.RIDGES:
        score = 0.0
        for fold in range(rivals.INNER):
            odds = searched(measures, fell, train & (inner != fold), ridge)
            asked = train & (inner == fold) & np.isfinite(fell)
            signed = np.where(fell[asked] > 0.0, odds[asked], -odds[asked])
            score += special.log_expit(signed).sum()
        scores.append(score)
    best = rivals.RIDGES[int(np.argmax(scores))]
    assert rivals.RIDGES[0] < best < rivals.RIDGES[-1]
    (found,) = logistic_of(measures, fell, codes, train[np.newaxis])
    expected = special.expit(searched(measures, fell, train, best))
    assert found == pytest.approx(expected, abs=2e-3)


def test_a_curve_never_sees_the_group_that_is_held_out() -> None:
    measures, fell, codes = outcomes()
    trains = np.arange(16)[:, np.newaxis] != codes
    first = logistic_of(measures, fell, codes, trains)
    for group in (0, 7):
        turned = np.where(codes == group, 1.0 - fell, fell)
        second = logistic_of(measures, turned, codes, trains)
        assert (first[group] == second[group]).all()
        assert (first[group - 1] != second[group - 1]).any()


def test_the_curve_of_all_tests_predicts_others_to_the_last_bit() -> None:
    """Log odds are sums of exact products, whatever adds them."""
    measures, fell, codes = outcomes()
    curve = logistic_curve(measures, fell, codes)
    z = rounded((measures - np.array(curve.middle)) / np.array(curve.width), DESIGN_BITS)
    slopes = [Fraction(slope) for slope in curve.slopes]
    sums = [
        sum((s * Fraction(x) for s, x in zip(slopes, row, strict=True)), Fraction(curve.intercept))
        for row in z.tolist()
    ]
    expected = probability(np.clip(np.array(sums, dtype=np.float64), -5.3, 5.3))
    (found,) = logistic_of(measures, fell, codes, np.ones((1, 80), dtype=bool))
    assert (found == expected).all()
    assert (curve.of(measures) == expected).all()


def test_both_are_put_together_by_what_tests_say() -> None:
    """Half of the log odds each: of many tests that is found, of few the block predicts alone."""
    rng = np.random.default_rng(9)
    odds = rng.normal(0.0, 2.0, size=(2, 4000))
    block, logistic = special.expit(odds)
    exact = special.expit(0.5 * odds.sum(axis=0) + 0.3)
    fell = (rng.random(4000) < exact).astype(float)
    trains = np.arange(4000) < np.array([[4000], [12], [0]])
    many, few, none = rivals.stacks_of(block, logistic, fell, trains)
    assert (many.intercept, many.block, many.logistic) == pytest.approx((0.3, 0.5, 0.5), abs=0.12)
    assert np.abs(many.of(block, logistic) - exact).mean() < 0.02
    assert (few.intercept, few.block, few.logistic) == pytest.approx((0.0, 1.0, 0.0), abs=0.12)
    assert none == Stack()
    sure = np.clip(block, 0.001, 0.999)
    assert none.of(block, logistic) == pytest.approx(sure, abs=1e-5)
