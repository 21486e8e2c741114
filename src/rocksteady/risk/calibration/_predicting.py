"""Predictions of tests that were not in the training, from posteriors."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, Words
from rocksteady.model.equations import Model
from rocksteady.risk.calibration._draw_runs import run_draws
from rocksteady.risk.calibration._shares import lend
from rocksteady.risk.calibration.held_out.folds import HeldOut, predict_with
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import Sampling
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Run

Floats = NDArray[np.float64]
KEPT = 0.9999
"""Weight of the draws that are run; the rest weigh nothing and are left out."""
STREAM = 104_729
"""Keeps the gains of predictions apart from those of the training."""


def predict_new(
    posteriors: Mapping[str, Posterior],
    tests: Sequence[ShakingTest],
    sampling: Sampling,
    *,
    model: Model | None,
    run: Run | None,
) -> HeldOut:
    """Return predictions of tests by all of the posterior of their objects.

    Raises
    ------
    InputError
        If an object of a test has no posterior.
    """
    for test in tests:
        if test.object not in posteriors:
            raise InputError(
                "tests",
                Words(f"has {test.object!r}, the object of test {test.name!r}"),
                f"the calibrated objects are {', '.join(posteriors)}",
                "give tests of one of them",
            )
    keys = ("p", "low", "high", "error", "effective")
    found = {key: np.full(len(tests), np.nan) for key in keys}
    for number, (name, posterior) in enumerate(posteriors.items()):
        own = [place for place, test in enumerate(tests) if test.object == name]
        if not own:
            continue
        order = np.argsort(-posterior.weights, kind="stable")
        heavy = int(np.searchsorted(np.cumsum(posterior.weights[order]), KEPT)) + 1
        kept = np.sort(order[:heavy])
        weights, values = posterior.weights[kept], posterior.values[kept]
        runs = run_draws(
            posterior.space,
            values,
            [tests[place] for place in own],
            gains=sampling.gains,
            seed=(sampling.seed, number, STREAM),
            model=model,
            run=run,
        )
        share = lend(runs.fell, runs.gain, runs.sigma, posterior.space.features(values))
        outliers = posterior.space.outliers(values)[:, np.newaxis]
        share = (1.0 - outliers) * share + 0.5 * outliers
        for key, column in predict_with((weights / weights.sum())[:, np.newaxis], share).items():
            found[key][own] = column
    return HeldOut(**found)
