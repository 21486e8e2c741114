"""Scores against values by hand and against definitions written out."""

import math

import numpy as np
import pytest
from numpy.typing import ArrayLike

from rocksteady.risk.calibration.held_out.scores import Scores, scores_of


def scored(p: ArrayLike, fell: ArrayLike, **options: int) -> Scores:
    """Score tests of which each is its own group."""
    return scores_of(np.asarray(p), np.asarray(fell, float), np.arange(np.size(p)), **options)


def test_scores_of_four_tests_by_hand() -> None:
    found = scored([0.9, 0.35, 0.62, 0.2], [1, 1, 0, 0])
    assert found.accuracy[0] == 0.5
    assert found.f1[0] == 2 * 1 / (2 + 2)
    assert found.brier[0] == pytest.approx((0.01 + 0.4225 + 0.3844 + 0.04) / 4)
    assert found.log_score[0] == pytest.approx(-math.log(0.9 * 0.35 * 0.38 * 0.8) / 4)
    assert found.ece[0] == pytest.approx((0.1 + 0.65 + 0.62 + 0.2) / 4)
    assert (found.tests, found.groups) == (4, 4)


def test_tests_that_stay_together_widen_the_interval() -> None:
    rng = np.random.default_rng(3)
    fell = np.repeat((rng.random(40) < 0.7).astype(float), 10)
    alone = scored(np.full(400, 0.7), fell).accuracy
    together = scores_of(np.full(400, 0.7), fell, np.arange(400) // 10).accuracy
    ratio = (together[2] - together[1]) / (alone[2] - alone[1])
    assert ratio == pytest.approx(math.sqrt(10), rel=0.2)


def test_one_group_has_no_interval_and_no_fall_no_f1() -> None:
    found = scores_of(np.array([0.1, 0.2]), np.zeros(2), np.zeros(2, int))
    assert math.isnan(found.accuracy[1])
    assert math.isnan(found.f1[0])


def test_the_calibration_error_is_that_of_tenths() -> None:
    """Two tests of one tenth are joined, and neighbours across its end are not."""
    for p, fell, error in (
        ([0.005, 0.095], [1, 0], abs(0.005 - 1.0 + 0.095) / 2.0),
        ([0.095, 0.105], [1, 0], (0.905 + 0.105) / 2.0),
        ([0.1, 0.199], [1, 0], abs(0.1 - 1.0 + 0.199) / 2.0),
        ([0.9, 1.0], [1, 0], abs(0.9 - 1.0 + 1.0) / 2.0),
        ([0.899, 0.9], [1, 0], (0.101 + 0.9) / 2.0),
    ):
        result = scored(p, fell)
        assert result.ece[0] == pytest.approx(error), p
    assert scored([0.5], [1]).accuracy[0] == 1.0
    assert scored([0.4999], [1]).accuracy[0] == 0.0
    sure = scored([0.0, 1.0], [1, 1])
    assert sure.log_score[0] == pytest.approx(-0.5 * math.log(1e-12))
