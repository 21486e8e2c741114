"""Predictions: the highest probability first; an interval that does not exist is null."""

import numpy as np
import pytest
from scipy import special

from rocksteady.calibration import ShakingTest
from rocksteady.risk.calibration.held_out.leaving_out import HeldOut
from rocksteady.risk.calibration.held_out.predictions import predictions_of
from rocksteady.risk.calibration.held_out.rivals import Stack
from tests.risk.calibration.cases import make_records

(RECORD,) = make_records(1)


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
