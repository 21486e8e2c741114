"""Calibration: posteriors of objects, held-out scores, and predictions of other tests."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Model
from rocksteady.results.answer import Answer, doubt, left_out
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import ANSWER_DRAWS
from rocksteady.results.numbers import chance, interval, number, number_or_none, plural
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.learning import Trial
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.risk.calibration.held_out.scores import Scores
from rocksteady.risk.calibration.held_out.validate import Validation, validate_trial, why_not
from rocksteady.risk.calibration.identified import LIMIT, MEANINGS
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.rounds import Fit
from rocksteady.risk.calibration.stored_posterior import StoredPosterior, digest_of
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import Prior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.sweep.run import Execution

LONGEST_NAME = 20
"""Letters of an object in a table of parameters."""
Folds = Literal["group", "record", "test", "session"]
MOST = 3
"""Rows of an answer."""
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

    def describe(self) -> Description:
        """Return scores, parameters with their verdicts, and what limits them."""
        rows = self.validation.rows
        effective = {name: each.effective_draws for name, each in self.posteriors.items()}
        answer = self._answer()
        facts = [
            Fact("seed", self.seed),
            Fact("tests", len(self.tests), "tests"),
            Fact("counts", self.tests.describe().to_dict()["counts"]),
            Fact("folds", self.folds, "held out together"),
            Fact("model", self.model.name, "model"),
            Fact("tolerance", getattr(self.model, "tolerance", None)),
            Fact("scores", {name: each.values() for name, each in rows.items()}),
            Fact(
                "new_day",
                None
                if self.new_day is None
                else {name: each.values() for name, each in self.new_day.rows.items()},
            ),
            Fact("most_runs", self.most_runs),
            Fact("runs", self.runs, "runs of a test", _words(self.runs)),
            Fact("effective_draws", effective, "effective draws", _words(effective)),
            Fact(
                "pareto_k",
                {name: number_or_none(each.pareto_k) for name, each in self.posteriors.items()},
                "Pareto k of the weights",
                _words({name: each.pareto_k for name, each in self.posteriors.items()}),
            ),
            Fact(
                "conflicts",
                [asdict(each) | {"prior": str(each.prior)} for each in self.conflicts],
            ),
            Fact("curve", asdict(self.validation.curve)),
            Fact("stack", asdict(self.validation.stack)),
            Fact("sessions", {name: list(each.sessions) for name, each in self.posteriors.items()}),
            Fact("mc_error", self.mc_error, "largest Monte Carlo error"),
            Fact("flips", dict(self.flips), "flips", _words(self.flips)),
            Fact(
                "inputs",
                {
                    "objects": {
                        name: {key: str(spread) for key, spread in each.space.block.spreads.items()}
                        for name, each in self.posteriors.items()
                    },
                    "noise": {
                        name: {key: str(spread) for key, spread in each.noise.items()}
                        for name, each in self.posteriors.items()
                    },
                },
            ),
            Fact("trained", self._trained),
            Fact("hashes", {**self.tests.sources, **self.prior.sources}),
            Fact("warnings", list(self.warnings)),
        ]
        of_scores, *others = self.validation.describe().tables
        tables = [
            self._table(),
            Table("score_rows", of_scores.rows, of_scores.columns, title=of_scores.title),
            *others,
            *self._sessions(),
        ]
        return Description(
            headline=f"calibration of {plural(len(self.posteriors), 'object')} by "
            f"{plural(len(self.tests), 'test')}: {answer.sentence[0].lower()}"
            f"{answer.sentence[1:].removesuffix('.')}",
            facts=facts,
            tables=tables,
            notes=[*self.warnings, *self._remarks()],
            answer=answer,
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

    def _answer(self) -> Answer:
        """Return how well held-out tests are predicted, and what outcomes show of parameters."""
        rows = self.validation.rows
        few = [name for name, each in self.posteriors.items() if not each.identified]
        sentence = f"{self.validation.warnings[0]}." if not rows else ""
        sentence = f"{sentence[:1].upper()}{sentence[1:]}"
        if rows:
            best = rows["predicted"]
            _, low, high = best.accuracy
            band = interval(None if np.isnan(low) else (low, high), 0.9)
            share = chance(best.accuracy[0], best.tests)
            share += "" if " of " in share else " of"
            least = min(each.effective_draws for each in self.posteriors.values())
            sentence = (
                f"{share} tests are predicted{band} on {self._unseen} not seen before, by "
                f"{least:.0f} effective draws."
            )
        bounds = [row for row in self.parameters if row["bound_side"] is not None]
        silent = [fit.bench.space.block.name for fit in self.fits if self._silent(fit)]
        if silent:
            sentence = (
                f"No answer: in each test of {silent[0]} all draws fall, or all stand: check units "
                "and gains."
            )
        elif few:
            sentence = f"No answer: {self._missing(few[0])}."
        elif bounds:
            side = "at most" if bounds[0]["bound_side"] == "upper" else "at least"
            outcome = "fell" if bounds[0]["bound_side"] == "upper" else "stood"
            sentence = (
                f"A bound and no fit: all tests of {bounds[0]['object']} {outcome}, so that alpha "
                f"is {side} {number(bounds[0]['bound'])} rad (90 %)."
            )
        elif self.conflicts:
            first = self.conflicts[0].sentence
            sentence = f"{first[0].upper()}{first[1:]}. {sentence}"
        several, lines = len(self.posteriors) > 1, []
        for row in self.parameters:
            name = str(row["parameter"])
            if name != "alpha_rad" and (several or name != "restitution"):
                continue
            label = f"{row['object']}, alpha" if several else name.removesuffix("_rad")
            words = f"no estimate yet; prior {_range(row, 'prior_low', 'prior_high')}"
            if row["median"] is not None:
                words = f"{number(row['median'])} (90 %: {_range(row, 'low', 'high')}); "
                words += str(row["verdict"])
            lines.append((label, words))
        # A short screen drops facts from the end.
        facts = [("held out", self._compared(rows))] if rows else []
        facts += [*lines[: MOST if several else 1], left_out(max(len(lines) - MOST, 0))]
        facts.append(("doubt", doubt(self.warnings[len(self.conflicts) :])))
        if self.new_day is not None and self.new_day.rows:
            day = self.new_day.rows["predicted"].accuracy[0]
            facts.append(("new day", f"{chance(day)}; {self._compared(self.new_day.rows)}"))
        if rows and not few and not bounds:
            facts.append(("use", self._use()))
        return Answer(sentence, facts if several else [*facts, *lines[1:]])

    @property
    def _unseen(self) -> str:
        """What is held out together, in words."""
        plain = all(test.group == test.record.name for test in self.tests.tests)
        kind = "record" if self.folds == "group" and plain else self.folds
        return f"{kind}s"

    def _compared(self, rows: Mapping[str, Scores]) -> str:
        """Return the Brier score of each way to predict."""
        words = ", ".join(f"{name} {number(each.brier[0], 2)}" for name, each in rows.items())
        return f"Brier score {words.removeprefix('predicted ')}"

    def _use(self) -> str:
        """Return which way to predict is better where it is clearly not the block's."""
        value = {name: each.brier[0] for name, each in self.validation.rows.items()}
        if not value["logistic"] < self.validation.rows["block"].brier[1]:
            return ""
        best = "the logistic" if value["logistic"] < value["predicted"] else "block and logistic"
        return f"{best} to predict such tests; the block for what it says of the object"

    def _table(self) -> Table:
        before = (
            Column("prior_low", "prior 5 %", number),
            Column("prior_high", "prior 95 %", number),
        )
        names = (Column("object", "object", _shortened, left=True),)
        columns = [
            *(names if len(self.posteriors) > 1 else ()),
            Column("parameter", "parameter", left=True),
            *(() if len(self.posteriors) > 1 else before),  # 80 columns have no room for both
            Column("median", "median", number),
            Column("low", "5 %", number),
            Column("high", "95 %", number),
            Column("verdict", "verdict", left=True),
        ]
        return Table("parameters", self.parameters, columns)

    def _sessions(self) -> list[Table]:
        """Return the gain of each session of each object, with its interval of 90 %."""
        ends = ("gain", "low", "high")
        rows = [
            {"object": name, "session": session}
            | dict(zip(ends, posterior.session_gain(session), strict=True))
            for name, posterior in self.posteriors.items()
            for session in posterior.sessions
        ]
        columns = (
            Column("object", "object", _shortened, left=True),
            Column("session", "session", left=True),
            *(
                Column(key, words, number)
                for key, words in zip(ends, ("gain", "5 %", "95 %"), strict=True)
            ),
        )
        return [Table("session_gains", rows, columns, title="gains of sessions")] if rows else []

    def _remarks(self) -> list[str]:
        """Return what the verdicts and the temper mean."""
        used = dict.fromkeys(row["verdict"] for row in self.parameters)
        remarks = [f"{verdict}: {MEANINGS[verdict]}." for verdict in used]
        if len(self.posteriors) > 1:
            remarks.append("Each object has its own posterior and its own errors.")
        return remarks


def _range(row: Mapping[str, Any], low: str, high: str) -> str:
    """Return two ends of a row in words."""
    return f"{number(row[low])} to {number(row[high])}"


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


def _words(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {number(float(value))}" for name, value in values.items())


def _shortened(name: str) -> str:
    """Return a name that leaves room for numbers beside it."""
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
