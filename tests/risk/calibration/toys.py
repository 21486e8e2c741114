"""Tests whose surfaces are known functions, in place of runs."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy import special

from rocksteady.arrays import Floats, Integers
from rocksteady.calibration import ObjectPrior, OutcomeErrors, ShakingTest
from rocksteady.risk.calibration.sampler.bench import Bench
from rocksteady.risk.calibration.sampler.outcome_likelihood import Likelihood
from rocksteady.risk.calibration.sampler.space import Space
from tests.risk.calibration.cases import LINEAR, make_records

LEVELS = np.array([-1.4, -1.2, -1.5, -1.1, -1.3, -1.45, -1.25, -1.35])
BLOCK = ObjectPrior(name="block", alpha_rad="0.17:0.33", p_rad_s="3:5")
FEATURES = np.column_stack([np.linspace(-1.7, -0.9, 9), np.zeros((9, 5))])
"""Of nine draws that differ in slenderness."""


def chance(motion: Any, moved: Any, lean: Any) -> Any:
    """Return P(fall) of a block of ln tan alpha `lean`, ln of the gain moved."""
    return special.expit(9.0 * (moved - lean + LEVELS[motion]))


class Known:
    """Surfaces of that function."""

    def curves(self, features: Floats, motion: Integers, moved: Floats) -> Any:
        """Return P(fall), shape (draws, curves, moves)."""
        return chance(motion[:, np.newaxis], moved, features[:, 0, np.newaxis, np.newaxis])


def make_toy(
    sessions: Sequence[str | None],
    fell: Sequence[bool | None],
    *,
    sigma_ln: Sequence[float | None] | None = None,
    noise: OutcomeErrors | None = None,
    tests: Sequence[ShakingTest] | None = None,
) -> Any:
    """Return the likelihood of a test of each of some motions, which nothing has run."""
    sigmas = [None] * len(fell) if sigma_ln is None else sigma_ln
    if tests is None:
        tests = [
            ShakingTest(name=record.name or "", record=record, object="block")
            for record in make_records(len(fell))
        ]
    made = [
        replace(test, session=session, fell=end, sigma_ln=sigma)
        for test, session, end, sigma in zip(tests, sessions, fell, sigmas, strict=True)
    ]
    bench = Bench(Space(block=BLOCK), made, LINEAR, None)
    return Likelihood(bench, OutcomeErrors() if noise is None else noise)
