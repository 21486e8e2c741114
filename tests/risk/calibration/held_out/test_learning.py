"""Scores over sizes of training sets."""

import numpy as np
import pytest

from rocksteady.risk.calibration.held_out.learning import _mean
from rocksteady.risk.calibration.held_out.scores import NAMES, Scores
from tests.risk.calibration.cases import narrow


def test_a_mean_score_is_that_of_the_parts_with_their_quantiles() -> None:
    values = [0.2, 0.4, 0.9, np.nan]
    parts = [
        Scores(**dict.fromkeys(NAMES, (value, -1.0, 2.0)), tests=tests, groups=3)
        for value, tests in zip(values, (10, 20, 30, 20), strict=True)
    ]
    found = _mean(parts)
    for name in NAMES:
        low, high = np.quantile(values[:3], [0.05, 0.95])
        assert getattr(found, name) == pytest.approx((0.5, low, high))
    assert (found.tests, found.groups) == (20, 3)


def test_few_groups_predict_worse_than_many() -> None:
    rows = narrow().validation.learning
    assert [row["groups"] for row in rows] == [1, 2, 4, 8]
    tests = [row["tests"] for row in rows]
    assert tests == pytest.approx([4.0, 8.0, 16.0, 32.0], rel=0.01)  # 60 tests on 15 records
    block = [row["block"].brier[0] for row in rows]
    assert block[-1] < 0.9 * block[0]
    assert block[0] < rows[0]["base rate"].brier[0]
    assert rows[0]["block"].tests == 56
