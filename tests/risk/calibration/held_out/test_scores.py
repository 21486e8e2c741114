"""Scores against values by hand and against definitions written out."""

import math

import numpy as np
import pytest

from rocksteady.calibration import compute_scores
from rocksteady.errors import InputError
from tests.every import every


def test_scores_of_four_tests_by_hand() -> None:
    found = compute_scores([0.9, 0.35, 0.62, 0.2], [1, 1, 0, 0], replicates=0)
    assert found.accuracy[0] == 0.5
    assert found.f1[0] == 2 * 1 / (2 + 2)
    assert found.brier[0] == pytest.approx((0.01 + 0.4225 + 0.3844 + 0.04) / 4)
    assert found.log_score[0] == pytest.approx(-math.log(0.9 * 0.35 * 0.38 * 0.8) / 4)
    assert found.ece[0] == pytest.approx((0.1 + 0.65 + 0.62 + 0.2) / 4)
    assert (found.tests, found.groups) == (4, 4)
    assert compute_scores([0.5], [1], replicates=0).accuracy[0] == 1.0


def test_calibration_error_is_that_of_bins() -> None:
    rng = np.random.default_rng(1)
    p = rng.random(500)
    fell = (rng.random(500) < p**2).astype(float)
    expected = 0.0
    for low in np.arange(10) / 10:
        own = (p >= low) & (p < low + 0.1)
        expected += own.mean() * abs(p[own].mean() - fell[own].mean())
    assert compute_scores(p, fell, replicates=0).ece[0] == pytest.approx(expected, rel=1e-6)


def test_interval_of_independent_tests_is_that_of_a_share() -> None:
    rng = np.random.default_rng(2)
    fell = (rng.random(400) < 0.9).astype(float)
    value, low, high = compute_scores(np.ones(400), fell).accuracy
    error = math.sqrt(value * (1 - value) / 400)
    assert (high - low) / (2 * 1.645 * error) == pytest.approx(1.0, abs=0.1)


def test_tests_that_stay_together_widen_the_interval() -> None:
    rng = np.random.default_rng(3)
    fell = np.repeat((rng.random(40) < 0.7).astype(float), 10)
    groups = [str(place // 10) for place in range(400)]
    alone = compute_scores(np.full(400, 0.7), fell).accuracy
    together = compute_scores(np.full(400, 0.7), fell, groups=groups).accuracy
    ratio = (together[2] - together[1]) / (alone[2] - alone[1])
    assert ratio == pytest.approx(math.sqrt(10), rel=0.2)


def test_one_group_has_no_interval_and_no_fall_no_f1() -> None:
    found = compute_scores([0.1, 0.2], [0, 0], groups=["a", "a"])
    assert math.isnan(found.accuracy[1])
    assert math.isnan(found.f1[0])


@every(("p", "fell"), [([], []), ([0.5], [1, 0]), ([1.2], [1]), ([0.5], [2]), ([np.nan], [1])])
def test_what_cannot_be_scored_is_refused(p: list[float], fell: list[int]) -> None:
    with pytest.raises(InputError, match=r"probabilities|fell"):
        compute_scores(p, fell)


def test_the_calibration_error_is_that_of_tenths() -> None:
    """Two tests of one tenth are joined, and neighbours across its end are not."""
    for p, fell, error in (
        ([0.005, 0.095], [1, 0], abs(0.005 - 1.0 + 0.095) / 2.0),
        ([0.095, 0.105], [1, 0], (0.905 + 0.105) / 2.0),
        ([0.1, 0.199], [1, 0], abs(0.1 - 1.0 + 0.199) / 2.0),
        ([0.9, 1.0], [1, 0], abs(0.9 - 1.0 + 1.0) / 2.0),
        ([0.899, 0.9], [1, 0], (0.101 + 0.9) / 2.0),
    ):
        result = compute_scores(p, fell, replicates=0)
        assert result.ece[0] == pytest.approx(error), p
    assert compute_scores([0.5], [1], replicates=0).accuracy[0] == 1.0
    assert compute_scores([0.4999], [1], replicates=0).accuracy[0] == 0.0
    sure = compute_scores([0.0, 1.0], [1, 1], replicates=0)
    assert sure.log_score[0] == pytest.approx(-0.5 * math.log(1e-12))
    assert (sure.tests, sure.groups) == (2, 2)
    assert np.isnan(sure.accuracy[1:]).all()
    assert compute_scores([0.5, 0.5], [1, 0], groups=["a", "a"], replicates=0).groups == 1
    none = compute_scores([0.1, 0.2], [0, 0], replicates=0)
    assert np.isnan(none.f1[0])
    for wrong, given in (([0.5], [0.5]), ([1.1], [1]), ([-0.1], [1]), ([], []), ([0.5, 0.5], [1])):
        with pytest.raises(InputError):
            compute_scores(wrong, given)
    with pytest.raises(InputError, match="there are 1 tests; name each one's group"):
        compute_scores([0.5], [1], groups=["a", "b"])
    with pytest.raises(InputError, match=r"^replicates = "):
        compute_scores([0.5], [1], replicates=100_001)


def test_scores_in_words_and_in_columns() -> None:
    result = compute_scores([0.9, 0.2, 0.6], [1, 0, 0], replicates=0)
    (table,) = result.describe().tables
    assert [(column.heading, column.left) for column in table.columns] == [
        *(("score", True), ("value", False), ("5 %", False), ("95 %", False)),
    ]
    values = result.values()
    assert list(values) == ["accuracy", "f1", "brier", "log_score", "ece"]
    assert values["brier"]["value"] == pytest.approx((0.01 + 0.04 + 0.36) / 3.0)
    assert "Brier score 0.137 of 3 tests" in repr(result)
