"""Predictions of tests: probability of a fall, its band, its Monte Carlo error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.doubts import ANSWER_DRAWS, FEWEST_DRAWS
from rocksteady.results.numbers import number_or_none
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.leaving_out import HeldOut
from rocksteady.risk.calibration.held_out.rivals import Stack
from rocksteady.risk.observations.shaking_test import ShakingTest

OUTCOMES: Mapping[bool | None, str] = {True: "fell", False: "stood", None: "unknown"}


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Predictions(Result):
    """Probabilities of a fall in tests.

    Attributes
    ----------
    test, object, group
        Names, one for each row.
    p
        Probability of a fall by block and logistic together, shape (rows,).
    low, high
        5 and 95 % of it over the draws of the posterior, shape (rows,).
    block, logistic
        Probability by the calibrated block alone, outliers included, and by a logistic on intensity
        measures alone (nan where tests cannot be held out), shape (rows,).
    mc_error
        Monte Carlo error of `block`, shape (rows,).
    effective_draws
        Effective draws behind it, shape (rows,).
    held_out
        True of a test that was in the training and is predicted without its group, False of one
        that was not in it.
    fell
        Outcome, None where it is not known.
    warnings
        Sentences on what limits the answer.

    Examples
    --------
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> found = calibrate(tests, most_runs=200, model=Linear()).validation.predictions
    >>> len(found.p), all(found.held_out)
    (16, True)
    """

    test: tuple[str, ...]
    object: tuple[str, ...]
    group: tuple[str, ...]
    p: Floats
    low: Floats
    high: Floats
    block: Floats
    logistic: Floats
    mc_error: Floats
    effective_draws: Floats
    held_out: tuple[bool, ...]
    fell: tuple[bool | None, ...]
    warnings: tuple[str, ...] = ()

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.test)

    @property
    def identified(self) -> bool:
        """Whether there are draws enough: 50 of a fold, 200 of a posterior."""
        least = np.where(self.held_out, FEWEST_DRAWS, ANSWER_DRAWS)
        return bool((self.effective_draws >= least).all())

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One mapping of plain values for each test."""
        return [
            {
                "test": self.test[k],
                "p": float(self.p[k]),
                "low": number_or_none(self.low[k]),
                "high": number_or_none(self.high[k]),
                "block": float(self.block[k]),
                "logistic": number_or_none(self.logistic[k]),
                "mc_error": float(self.mc_error[k]),
                "held_out": self.held_out[k],
                "outcome": OUTCOMES[self.fell[k]],
                "object": self.object[k],
                "group": self.group[k],
                "effective_draws": float(self.effective_draws[k]),
            }
            for k in range(len(self.test))
        ]


def predictions_of(
    tests: Sequence[ShakingTest],
    held: HeldOut,
    groups: Sequence[str],
    *,
    logistic: Floats,
    stacks: Sequence[Stack] = (),
) -> Predictions:
    """Return predictions with the names and outcomes of their tests.

    Parameters
    ----------
    tests, groups
        The tests, and the group of each.
    held, logistic
        What block and logistic predict.
    stacks
        How both are put together for each test; by default the block predicts alone.
    """
    p, low, high = (
        np.array([stack.of(*pair) for stack, *pair in zip(stacks, block, logistic, strict=True)])
        if stacks
        else block
        for block in (held.p, held.low, held.high)
    )
    return Predictions(
        test=tuple(test.name for test in tests),
        object=tuple(test.object for test in tests),
        group=tuple(groups),
        p=p,
        low=low,
        high=high,
        block=held.p,
        logistic=logistic,
        mc_error=held.error,
        effective_draws=held.effective,
        held_out=(True,) * len(tests),
        fell=tuple(test.fell for test in tests),
    )
