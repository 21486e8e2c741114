"""Predictions of tests that were not in the training, from posteriors."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, Words
from rocksteady.model.equations import Model
from rocksteady.results.numbers import number, plural
from rocksteady.risk.calibration._draw_runs import run_draws
from rocksteady.risk.calibration._shares import pooled_shares
from rocksteady.risk.calibration.held_out.folds import HeldOut, predict_with
from rocksteady.risk.calibration.held_out.predictions import Predictions, predictions_of
from rocksteady.risk.calibration.held_out.recalibration import PLAIN, Platt
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import DrawOptions
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

KEPT = 0.9999
"""Weight of the draws that are run; the rest weigh nothing and are left out."""
STREAM = 104_729
"""Keeps the gains of predictions apart from those of the training."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Source:
    """What predictions of other tests are made of.

    Attributes
    ----------
    posteriors
        By object.
    sampling
        Gains, seed, and the Monte Carlo error that is small enough.
    model
        The equations of motion.
    recalibration
        Line over the log odds.
    """

    posteriors: Mapping[str, Posterior]
    sampling: DrawOptions
    model: Model
    recalibration: Platt = PLAIN


def predict_all(
    given: Sequence[ShakingTest],
    trained: Mapping[str, str],
    before: Predictions,
    source: Source,
    run: Execution | None,
) -> Predictions:
    """Return predictions of training tests without their groups, and of others by all tests.

    Parameters
    ----------
    given
        The tests.
    trained
        Digest of each training test by its name, in the order of `before`.
    before
        Held-out predictions of the training tests.
    source
        What others are predicted from.
    run
        Executor and workers.
    """
    rows = {name: place for place, name in enumerate(before.test)}
    places = np.array(
        [rows[test.name] if trained.get(test.name) == digest_of(test) else -1 for test in given]
    )
    new = None
    if (places < 0).any():
        fresh = [test for test, place in zip(given, places.tolist(), strict=True) if place < 0]
        new = _predict_new(fresh, source, run)
    columns = {}
    names = {"p": "p", "low": "low", "high": "high", "error": "mc_error"}
    for key, name in (names | {"effective": "effective_draws"}).items():
        column = np.full(len(given), np.nan)
        column[places >= 0] = getattr(before, name)[places[places >= 0]]
        if new is not None:
            column[places < 0] = getattr(new, key)
        columns[key] = column
    return predictions_of(
        given,
        HeldOut(**columns),
        [test.group or "" for test in given],
        held_out=(places >= 0).tolist(),
        warnings=error_warnings(columns["error"], columns["effective"], source.sampling.error),
    )


def error_warnings(error: Floats, effective: Floats, limit: float) -> list[str]:
    """Return sentences on Monte Carlo errors that are too large."""
    large = int((error > limit).sum())
    if not large:
        return []
    words = (
        f"the Monte Carlo error of {large} of {plural(len(error), 'prediction')} is above "
        f"{limit:g}, {number(float(error.max()), 2)} at most, with {effective.min():.0f} effective "
        "draws at least: make more draws"
    )
    return [words]


def digest_of(test: ShakingTest) -> str:
    """Return a hash (SHA-256) of all that decides a test's fate, except its outcome."""
    digest = hashlib.sha256()
    parts = (test.object, test.gain, test.reversed, test.sigma_ln)
    digest.update(repr(parts).encode())
    for record in (test.record, test.vertical):
        if record is not None:
            digest.update(repr(record.dt_s).encode() + record.acceleration_m_s2.tobytes())
    return digest.hexdigest()


def listed(tests: Observations | Sequence[ShakingTest]) -> list[ShakingTest]:
    """Return tests as a list.

    Raises
    ------
    InputError
        If there is none.
    """
    rows = tests.tests if isinstance(tests, Observations) else tests
    if (
        not isinstance(rows, Sequence)  # type: ignore[redundant-expr]
        or not rows
        or not all(isinstance(test, ShakingTest) for test in rows)  # before they are listed
    ):
        raise InputError(
            "tests", tests, "it must be Observations, or one ShakingTest or more", "give some"
        )
    return list(rows)


def _predict_new(tests: Sequence[ShakingTest], source: Source, run: Execution | None) -> HeldOut:
    """Return predictions of tests by all of the posterior of their objects.

    Raises
    ------
    InputError
        If an object of a test has no posterior.
    """
    posteriors, sampling = source.posteriors, source.sampling
    for test in tests:
        if test.object not in posteriors:
            raise InputError(
                "tests",
                Words(f"has {test.object!r}, the object of test {test.name!r}"),
                f"the calibrated objects are {', '.join(posteriors)}",
                "give tests of one of them",
            )
    keys = ("p", "low", "high", "error", "effective")
    columns = {key: np.full(len(tests), np.nan) for key in keys}
    for place, (name, posterior) in enumerate(posteriors.items()):
        rows = [row for row, test in enumerate(tests) if test.object == name]
        if not rows:
            continue
        order = np.argsort(-posterior.weights, kind="stable")
        heavy = int(np.searchsorted(np.cumsum(posterior.weights[order]), KEPT)) + 1
        kept = np.sort(order[:heavy])
        weights, values = posterior.weights[kept], posterior.values[kept]
        picked = [tests[row] for row in rows]
        shift = _session_gains(posterior, picked, kept)
        runs = run_draws(
            posterior.space,
            values,
            picked,
            gains=sampling.gains,
            seed=(sampling.seed, place, STREAM),
            model=source.model,
            run=run,
            shift=shift,
        )
        share = pooled_shares(
            runs.fell, runs.gain, runs.sigma, posterior.space.features(values), shift[0]
        )
        outliers = posterior.space.outliers(values)[:, np.newaxis]
        share = (1.0 - outliers) * share + 0.5 * outliers
        for key, column in predict_with((weights / weights.sum())[:, np.newaxis], share).items():
            ends = key in ("p", "low", "high")
            columns[key][rows] = source.recalibration.of(column) if ends else column
    return HeldOut(**columns)


def _session_gains(
    posterior: Posterior, tests: Sequence[ShakingTest], kept: Integers
) -> tuple[Floats, Floats]:
    """Return mean and deviation of ln(gain) of each test's session, shape (tests, draws).

    Of a session that was not in the training they are 0 and the spread between sessions.
    """
    between = posterior.space.between(posterior.values[kept])
    unknown = np.column_stack([np.zeros(len(kept)), between])
    pairs = np.array(
        [
            unknown if known is None else known[kept]
            for known in (posterior.sessions.get(test.session or "") for test in tests)
        ]
    )
    return pairs[..., 0], pairs[..., 1]
