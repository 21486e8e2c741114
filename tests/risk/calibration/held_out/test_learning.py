"""Scores over sizes of training sets."""

import numpy as np
import pytest

from rocksteady.risk.calibration.held_out.folds import Evidence
from rocksteady.risk.calibration.held_out.learning import _mean, best_temper
from rocksteady.risk.calibration.held_out.scores import NAMES, Scores
from tests.every import every


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


@every(
    ("outcomes", "shares", "expected"), [((1, 0), (0.9, 0.1), 1.0), ((1, 1, 0), (0.9,) * 3, 0.05)]
)
def test_the_temper_is_small_where_the_favoured_draw_predicts_worse_than_chance(
    outcomes: tuple[int, ...], shares: tuple[float, ...], expected: float
) -> None:
    groups, each = 12, len(outcomes)
    share = np.tile([shares, (0.5,) * each], groups)
    logs = np.tile([[np.log(0.9)], [np.log(0.5)]], groups * each)
    evidence = Evidence(
        base=np.zeros(2), log_likelihood=logs, share=share, tests=np.arange(groups * each)
    )
    codes, fell = np.repeat(np.arange(groups), each), np.tile(np.array(outcomes, float), groups)
    assert best_temper([evidence], codes, fell) == expected
