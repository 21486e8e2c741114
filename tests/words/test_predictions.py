"""Words of predictions and of scores: the likeliest to fall first, and few draws."""

import numpy as np
import pytest

from rocksteady.calibration import Predictions
from tests.risk.calibration.held_out.test_scores import scored


def predictions(*p: float, effective: float = 300.0) -> Predictions:
    """Return predictions of some tests."""
    names = tuple(f"test {place}" for place in range(len(p)))
    at = np.array(p)
    known = effective >= 50.0
    return Predictions(
        test=names,
        object=("column",) * len(p),
        group=names,
        p=at,
        low=0.9 * at if known else np.full(len(p), np.nan),
        high=np.minimum(1.0, 1.1 * at) if known else np.full(len(p), np.nan),
        block=at,
        logistic=np.full(len(p), np.nan),
        mc_error=np.full(len(p), 0.001),
        effective_draws=np.full(len(p), effective),
        held_out=(False,) * len(p),
        fell=(None,) * len(p),
    )


def test_the_likeliest_to_fall_comes_first_and_few_draws_are_no_answer() -> None:
    lines = predictions(0.02, 0.98, 0.4, 0.6, 0.1, 0.3, 0.2).summary().splitlines()
    assert lines[0] == "2 of 7 tests more likely fall than not."
    assert [line.split()[1] for line in lines[1:5]] == ["1", "3", "2", "5"]
    assert "3 more with --more: 0 likely to fall, 3 to stand" in lines[5]
    for p, words in (
        ((0.39,), "It falls in test 0 with 39 % (90 %: 35 to 43 %)."),
        ((0.9, 0.2), "1 of 2 tests more likely falls than not."),
        ((0.1, 0.2), "None of 2 tests more likely fall than not."),
    ):
        assert predictions(*p).summary().splitlines()[0] == words
    (row,) = predictions(0.5).rows
    assert (row["low"], row["block"], row["high"]) == pytest.approx((0.45, 0.5, 0.55))
    few = predictions(0.39, effective=12.0)
    assert few.summary().startswith("No answer, provisional: 12 effective draws of the 200")
    (row,) = few.rows
    assert (row["low"], row["high"], row["logistic"], row["outcome"]) == (None,) * 3 + ("unknown",)


def test_scores_in_words() -> None:
    result = scored([0.9, 0.2, 0.6], [1, 0, 0])
    assert list(result.values()) == ["accuracy", "f1", "brier", "log_score", "ece"]
    assert result.values()["brier"]["value"] == pytest.approx((0.01 + 0.04 + 0.36) / 3.0)
    assert "Brier score 0.137 of 3 tests" in repr(result)
