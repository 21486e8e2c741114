"""Posteriors that predict tests: those of the training, and others."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Model
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.leaving_out import HeldOut, blank, fill, weighed
from rocksteady.risk.calibration.held_out.predictions import Predictions, predictions_of
from rocksteady.risk.calibration.held_out.rivals import LogisticCurve, Stack, measures_of
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.bench import GAINS, Bench
from rocksteady.risk.calibration.sampler.exact import rounded
from rocksteady.risk.calibration.sampler.logistic import DESIGN_BITS, fit_logistics, probability
from rocksteady.risk.calibration.sampler.surfaces import FAR, moments, quadratic
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest, distinct
from rocksteady.sweep.run import Execution

DRAWS = 512
"""Draws that other tests are predicted with, each with the same weight."""
STREAM = 104_729
"""Keeps the runs of predictions apart from those of the training."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class StoredPosterior(Result):
    """Posteriors of a calibration, from its folder.

    Attributes
    ----------
    posteriors
        Weighted draws by object, without the fates of the training tests.
    predictions
        Predictions of the training tests, each without its group.
    trained
        Hash (SHA-256) of each training test, by its name.
    seed, model
        Seed and model of the calibration.
    curve, stack
        The logistic on intensity measures, and how block and logistic predict together.
    """

    posteriors: Mapping[str, Posterior]
    predictions: Predictions
    trained: Mapping[str, str]
    seed: int
    model: Model
    curve: LogisticCurve
    stack: Stack

    def predict(
        self, tests: Observations | Sequence[ShakingTest], *, run: Execution | None = None
    ) -> Predictions:
        """Predict tests as the calibration itself does; see `Calibration.predict`."""
        given = listed(tests, self.posteriors)
        rows = {name: place for place, name in enumerate(self.predictions.test)}
        places = np.array(
            [
                rows[test.name] if self.trained.get(test.name) == digest_of(test) else -1
                for test in given
            ]
        )
        fresh = np.flatnonzero(places < 0)
        new = [given[place] for place in fresh.tolist()]
        held, logistic = blank(len(given)), np.full(len(given), np.nan)
        if len(fresh):
            fill(held, fresh, _predict_new(new, self, run))
            priors = {name: each.space.block for name, each in self.posteriors.items()}
            logistic[fresh] = self.curve.of(measures_of(new, priors))
        made = predictions_of(
            given,
            held,
            [test.group or "" for test in given],
            logistic=logistic,
            stacks=[self.stack] * len(given),
        )
        keys = ("p", "low", "high", "block", "logistic", "mc_error", "effective_draws")
        columns = {
            key: np.where(places >= 0, getattr(self.predictions, key)[places], getattr(made, key))
            for key in keys
        }
        changed = [test.name for test in new if test.name in rows]
        words = (
            f"{plural(len(changed), 'test')} of the calibration, as {', '.join(changed[:1])}: "
            "another motion, gain or cleaning now, predicted as new though their outcomes are in it"
        )
        return replace(
            made,
            **columns,
            held_out=tuple((places >= 0).tolist()),
            warnings=(words,) if changed else (),
        )


def digest_of(test: ShakingTest) -> str:
    """Return a hash (SHA-256) of all that decides a test's fate, except its outcome."""
    digest = hashlib.sha256()
    parts = (test.object, test.gain, test.reversed, test.sigma_ln)
    digest.update(repr(parts).encode())
    for record in (test.record, test.transverse, test.vertical):
        if record is None:
            digest.update(b"-")
        else:
            digest.update(repr(record.dt_s).encode() + record.acceleration_m_s2.tobytes())
    return digest.hexdigest()


def listed(
    tests: Observations | Sequence[ShakingTest], posteriors: Mapping[str, Posterior]
) -> list[ShakingTest]:
    """Return tests as a list.

    Raises
    ------
    InputError
        If there is none, two have one name, or an object has other sizes than the calibrated one.
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
    objects = tests.objects if isinstance(tests, Observations) else {}
    for name, given in objects.items():
        known = posteriors[name].space.block.spreads if name in posteriors else {}
        for key, spread in given.spreads.items():
            if key in known and key not in given.defaults and known[key] != spread:
                raise InputError(
                    f"objects: {name}, {key}",
                    str(spread),
                    f"the calibrated object has {known[key]}, and only that one is predicted",
                    "give the table of objects of the calibration, or calibrate this object",
                )
    return list(distinct(rows))


def _predict_new(
    tests: Sequence[ShakingTest], source: StoredPosterior, run: Execution | None
) -> HeldOut:
    """Return predictions of tests by all of the posterior of their objects.

    Raises
    ------
    InputError
        If an object of a test has no posterior.
    """
    for test in tests:
        if test.object not in source.posteriors:
            raise InputError(
                "tests",
                Words(f"has {test.object!r}, the object of test {test.name!r}"),
                f"the calibrated objects are {', '.join(source.posteriors)}",
                "give tests of one of them",
            )
    held = blank(len(tests))
    for number, (name, posterior) in enumerate(source.posteriors.items()):
        rows = np.array([row for row, test in enumerate(tests) if test.object == name])
        if not len(rows):
            continue
        below = np.cumsum(posterior.weights)
        wanted = (np.arange(DRAWS) + 0.5) / DRAWS * below[-1]
        kept = np.minimum(np.searchsorted(below, wanted), len(below) - 1)
        picked = [tests[row] for row in rows.tolist()]
        bench = Bench(posterior.space, picked, source.model, run)
        part = _count(bench, posterior, kept, (source.seed, number, STREAM))
        carried = np.full(len(rows), min(posterior.effective_draws, DRAWS))
        fill(held, rows, replace(part, effective=carried))
    return held


def _count(bench: Bench, posterior: Posterior, kept: Integers, seed: Sequence[int]) -> HeldOut:
    """Return predictions by the share of runs that fall, at gains with all errors of their own.

    The band is that of a logistic curve of the block, fitted to these runs and moved to the share.
    """
    from scipy.special import ndtri

    tests = bench.tests
    uniform = np.array(
        [
            np.random.default_rng([*seed, int(digest_of(test)[:8], 16)]).random(GAINS * len(kept))
            for test in tests  # so that a prediction does not depend on those beside it
        ]
    )
    strata = np.tile(np.arange(GAINS), len(kept)) + np.maximum(uniform, 1e-9)
    z = rounded(np.asarray(ndtri(strata / GAINS)), 20)
    draws = np.repeat(kept, GAINS)
    mean, deviation = _gains(posterior, tests, draws)
    gain = rounded(mean + deviation * z, 20) - bench.shift[:, np.newaxis]
    values = posterior.values[draws]
    fell = np.vstack(
        [
            bench.fates(bench.motion[[place]], values, gain[place], seed[0])[0]
            for place in range(len(tests))
        ]
    )
    fall = fell.reshape(len(tests), len(kept), GAINS).mean(axis=2)
    error = fall.std(axis=1) / np.sqrt(len(kept) - 1.0)
    features = posterior.space.features(values)
    middle, width = moments(features, np.full(len(features), 1.0 / len(features)))
    design = quadratic(np.clip((features - middle) / width, -FAR, FAR))
    at, _ = fit_logistics(
        design,
        fell,
        np.ones(fell.shape),
        precision=np.ones(design.shape[1]),
        mean=np.zeros(design.shape[1]),
    )
    share = probability(rounded(design[::GAINS], DESIGN_BITS) @ at.T)
    share = np.clip(share + fall.mean(axis=1) - rounded(share, 20).mean(axis=0), 0.0, 1.0)
    outliers = posterior.errors["outliers"][kept, :1]
    part = weighed(np.full(len(kept), 1.0 / len(kept)), (1.0 - outliers) * share + 0.5 * outliers)
    p = ((1.0 - outliers) * fall.T + 0.5 * outliers).mean(axis=0)
    return replace(part, p=p, error=error)


def _gains(
    posterior: Posterior, tests: Sequence[ShakingTest], draws: Integers
) -> tuple[Floats, Floats]:
    """Return mean and deviation of ln(gain) of each test and draw, shape (tests, draws).

    The gain of a session that was in the training is known from it; that of another one has the
    deviation between sessions, and that of a test without a session has none.
    """
    pairs = []
    between = posterior.errors["session_ln"][draws, 0] if posterior.sessions else 0.0
    for test in tests:
        mean, apart = np.zeros(len(draws)), np.zeros(len(draws))
        if test.session is not None and test.session in posterior.sessions:
            mean, apart = posterior.sessions[test.session][draws].T
        elif test.session is not None:
            apart = apart + between
        error = posterior.errors["sigma_ln"][draws, 0]
        if test.sigma_ln is not None:
            error = np.full(len(draws), test.sigma_ln)
        pairs.append((mean, np.sqrt(error * error + apart * apart)))
    means, deviations = zip(*pairs, strict=True)
    return np.array(means), np.array(deviations)
