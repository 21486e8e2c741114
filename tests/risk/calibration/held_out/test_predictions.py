"""Predictions: the highest probability first; an interval that does not exist is null."""

import numpy as np
import pytest
from scipy import special

from rocksteady.calibration import Predictions, ShakingTest
from rocksteady.risk.calibration.held_out.leaving_out import HeldOut
from rocksteady.risk.calibration.held_out.predictions import predictions_of
from rocksteady.risk.calibration.held_out.rivals import Stack
from tests.risk.calibration.cases import make_records

(RECORD,) = make_records(1)


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


def test_block_and_logistic_are_put_together_with_their_bands() -> None:
    tests = [ShakingTest(name=f"t{k}", record=RECORD, object="o", fell=k > 0) for k in range(2)]
    numbers = (np.array(each) for each in ([0.4, 0.6], [0.2, 0.5], [0.7, np.nan], [0.01, 0.02]))
    p, low, high, error = numbers
    held = HeldOut(p=p, low=low, high=high, error=error, effective=np.full(2, 300.0))
    logistic = np.array([0.9, 0.3])
    stacks = [Stack(intercept=0.1, block=0.5, logistic=0.5), Stack()]
    made = predictions_of(tests, held, ["g", "h"], logistic=logistic, stacks=stacks)
    odds = 0.1 + 0.5 * special.logit([0.4, 0.2, 0.7]) + 0.5 * special.logit(0.9)
    assert [made.p[0], made.low[0], made.high[0]] == pytest.approx(special.expit(odds).tolist())
    assert [made.p[1], made.low[1]] == pytest.approx([0.6, 0.5])
    assert np.isnan(made.high[1])
    assert (made.block.tolist(), made.logistic.tolist()) == ([0.4, 0.6], [0.9, 0.3])
    alone = predictions_of(tests, held, ["g", "h"], logistic=logistic)
    assert (alone.p.tolist(), alone.held_out, alone.fell) == (
        [0.4, 0.6],
        (True,) * 2,
        (False, True),
    )
