"""Calibration: posteriors of objects, held-out scores, and predictions of other tests."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Model
from rocksteady.results.doubts import ANSWER_DRAWS
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.learning import Trial
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.risk.calibration.held_out.validate import Validation, validate_trial, why_not
from rocksteady.risk.calibration.identified import LIMIT
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.rounds import Fit
from rocksteady.risk.calibration.stored_posterior import StoredPosterior, digest_of
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import Prior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.sweep.run import Execution

Folds = Literal["group", "record", "test", "session"]
FOLDS: tuple[Folds, ...] = ("group", "record", "test", "session")
TOWARDS = {"lower": "towards lower values", "upper": "towards higher values"}


@dataclass(frozen=True, kw_only=True)
class Conflict:
    """A prior that the tests contradict.

    Attributes
    ----------
    object, parameter
        Names.
    side
        "lower" or "upper": the end of the prior that outcomes lie beyond.
    prior
        The prior that is contradicted.
    widened
        Whether it is a default, which has been widened; a prior that was given is kept.
    """

    object: str
    parameter: str
    side: str
    prior: PriorRange
    widened: bool

    @property
    def sentence(self) -> str:
        """Prior, direction and what was done."""
        kind, end = ("default", "was widened") if self.widened else ("given prior", "was kept")
        ends = f"{number(self.prior.low)} to {number(self.prior.high)}"
        return (
            f"tests contradict the {kind} of {self.parameter} ({ends}) {TOWARDS[self.side]}; "
            f"it {end}"
        )


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Calibration(Result):
    """Posteriors, verdicts and held-out scores, from `rocksteady.calibrate`.

    Attributes
    ----------
    tests, prior, seed, most_runs, model
        Inputs of the calibration; of the objects every number has its prior.
    posteriors
        Weighted draws by object; each object has its own.
    parameters
        A row for each parameter, derived number and error of each object: `prior_low`,
        `prior_high`, `median`, `low`, `high` (90 %), `sd_ratio` (standard deviation over the
        prior's), `verdict`, and of alpha `outline`, `bound` and `bound_side`.
    validation
        Held-out scores, and predictions of each test without its group.
    new_day
        The same with the tests of a session held out together; None without sessions.
    conflicts
        Priors that the tests contradict.
    flips
        Number of fates of the median blocks that change, by how records are processed and solved.
    fits
        Draws with their surfaces, for other folds.
    measures
        Logarithms of intensity measures of each test, for the logistic, shape (tests, measures).
    """

    tests: Observations
    prior: Prior
    seed: int
    most_runs: int
    model: Model
    posteriors: Mapping[str, Posterior]
    parameters: tuple[Mapping[str, Any], ...]
    validation: Validation
    new_day: Validation | None
    conflicts: tuple[Conflict, ...]
    flips: Mapping[str, int]
    fits: tuple[Fit, ...]
    measures: Floats

    @property
    def folds(self) -> str:
        """What is held out together."""
        return self.validation.folds

    @property
    def identified(self) -> bool:
        """Whether outcomes say something, and all posteriors have the draws of an answer."""
        silent = any(self._silent(fit) for fit in self.fits) or np.isnan(self.tests.fell).all()
        return not silent and all(each.identified for each in self.posteriors.values())

    @staticmethod
    def _silent(fit: Fit) -> bool:
        """Return whether in each test of an object all draws fall, or all stand."""
        falls, runs = np.nansum(fit.bench.fell, axis=1), np.isfinite(fit.bench.fell).sum(axis=1)
        return bool(((falls == 0) | (falls == runs)).all())

    @property
    def mc_error(self) -> float:
        """Largest Monte Carlo error of a held-out prediction."""
        return float(np.max(self.validation.predictions.mc_error))

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what limits the answer."""
        sentences = [each.sentence for each in self.conflicts]
        sentences += self.tests.warnings
        settled = {(each.object, each.parameter) for each in self.conflicts if not each.widened}
        for row in self.parameters:
            name = str(row["object"])
            if row["verdict"] == LIMIT and (name, row["parameter"]) not in settled:
                sentences.append(
                    f"{row['parameter']} of {name} lies at the limit of its prior: doubt the model"
                )
            if row["bound_side"] is not None:
                outcome = "fell" if row["bound_side"] == "upper" else "stood"
                sentences.append(
                    f"all tests of {name} {outcome}: {row['bound']:.4g} rad is the "
                    f"{row['bound_side']} bound of alpha at 90 %, and no estimate"
                )
        for fit in self.fits:
            bench, name = fit.bench, fit.bench.space.block.name
            if not self.posteriors[name].identified:
                sentences.append(f"{name}: {self._missing(name)}")
            if self._silent(fit):
                sentences.append(
                    f"no test of {name} is informative: in each of them all draws fall, or all "
                    "stand"
                )
            if bench.unknown:
                runs = int(np.isfinite(bench.fell).sum())
                sentences.append(
                    f"{bench.unknown:,} of {runs:,} runs of {name} have no answer, and count as "
                    "standing"
                )
        sentences += self.validation.warnings
        return tuple(dict.fromkeys(sentences))

    @property
    def more_runs_help(self) -> bool:
        """Whether an answer is missing that more runs are likely to give."""
        return any(
            not self.posteriors[fit.bench.space.block.name].identified
            and (len(fit.rounds) < 2 or fit.rounds[-1].temper >= 1.0
                 or fit.rounds[-1].temper > 1.2 * fit.rounds[-2].temper)
            for fit in self.fits
        )  # fmt: skip

    def predict(
        self, tests: Observations | Sequence[ShakingTest], *, run: Execution | None = None
    ) -> Predictions:
        """Predict tests: a training test without its group, any other by all tests.

        Probabilities include the amplitude error of the test, or the prior's, and outliers.

        Parameters
        ----------
        tests
            Tests of calibrated objects; outcomes are not needed, and do not change the answer.
        run
            Executor and workers; default `Execution()`.

        Returns
        -------
        Predictions
            A row for each test; `held_out` is True of training tests.

        Raises
        ------
        InputError
            If there is no test, or an object of one is not calibrated.
        """
        stored = StoredPosterior(
            posteriors=self.posteriors,
            predictions=self.validation.predictions,
            trained=self._trained,
            seed=self.seed,
            model=self.model,
            curve=self.validation.curve,
            stack=self.validation.stack,
        )
        return stored.predict(tests, run=run)

    @property
    def _trained(self) -> dict[str, str]:
        """Hash of each training test, by its name."""
        return {test.name: digest_of(test) for test in self.tests.tests}

    def validate(self, folds: Folds = "record") -> Validation:
        """Validate with other tests held out together, from the same draws.

        Parameters
        ----------
        folds
            "record" (default), "group", "test" or "session".

        Raises
        ------
        ModelError
            If fewer than two groups have an outcome.
        """
        names, codes = codes_of(self.tests.tests, folds)
        reason = why_not(self.tests.fell, codes, folds)
        if reason:
            raise ModelError(
                "folds", Words(f"are by {folds}"), reason, "give tests of several groups"
            )
        return validation_of(
            self.tests, self.fits, self.measures, names, codes, folds=folds, seed=self.seed
        )

    @property
    def runs(self) -> dict[str, int]:
        """Runs of a test of each object."""
        return {fit.bench.space.block.name: fit.bench.runs for fit in self.fits}

    def _missing(self, name: str) -> str:
        """Return what is missing of an answer."""
        posterior, runs = self.posteriors[name], self.runs[name]
        effective = posterior.effective_draws
        draws = plural(round(effective), "effective draw")
        missing = f"{draws} of the {ANSWER_DRAWS:g} that it takes"
        if effective >= ANSWER_DRAWS:
            missing = f"Pareto's k of its weights is {number(posterior.pareto_k, 2)}, above 0.7"
        return f"{missing}, after {runs:,} runs of a test"


def codes_of(tests: Sequence[ShakingTest], folds: Folds) -> tuple[list[str], Integers]:
    """Return the names of what is held out together, and the number of it for each test.

    Raises
    ------
    InputError
        If it is none of the four, or by session and no test has one.
    """
    if not isinstance(folds, str) or folds not in FOLDS:  # type: ignore[redundant-expr]
        raise InputError("folds", folds, f"it must be one of {', '.join(FOLDS)}", "give one")
    if folds == "session" and not any(test.session for test in tests):
        raise InputError(
            "folds", folds, "no test has a session", "give tests theirs, or hold out by group"
        )
    names = [
        {
            "group": test.group or "",
            "record": test.record.name or test.group or "",
            "test": test.name,
            "session": test.session or test.name,
        }[folds]
        for test in tests
    ]
    order = {name: place for place, name in enumerate(sorted(set(names)))}
    return list(order), np.array([order[name] for name in names])


def validation_of(
    tests: Observations,
    fits: Sequence[Fit],
    measures: Floats,
    names: Sequence[str],
    codes: Integers,
    *,
    folds: str,
    seed: int,
    learning: bool = True,
) -> Validation:
    """Return held-out scores; `names` are those of the groups, and `codes` their numbers."""
    objects = list(tests.objects)
    of_object = np.array([objects.index(test.object) for test in tests.tests])
    trial = Trial(
        fits=fits,
        tests=[np.flatnonzero(of_object == number) for number in range(len(objects))],
        codes=codes,
        objects=of_object,
        fell=tests.fell,
        measures=measures,
        seed=seed,
    )
    return validate_trial(trial, tests.tests, names, folds=folds, learning=learning)
