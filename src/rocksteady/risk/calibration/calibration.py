"""Calibration: posteriors of objects, held-out scores, and predictions of other tests."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Model
from rocksteady.results.answer import Answer, doubt, left_out
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import FEWEST_DRAWS
from rocksteady.results.numbers import chance, interval, number, number_or_none, plural
from rocksteady.results.result import Result
from rocksteady.risk.calibration._identified import LIMIT, MEANINGS
from rocksteady.risk.calibration._predicting import Source, digest_of, listed, predict_all
from rocksteady.risk.calibration.held_out.folds import Evidence
from rocksteady.risk.calibration.held_out.learning import Trial
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.risk.calibration.held_out.recalibration import Platt
from rocksteady.risk.calibration.held_out.rivals import measures_of
from rocksteady.risk.calibration.held_out.scores import Scores
from rocksteady.risk.calibration.held_out.validate import Validation, validate_trial
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import DrawOptions
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import NOISE, Prior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

LONGEST_NAME = 20
"""Letters of an object in a table of parameters."""
Folds = Literal["group", "record", "test", "session"]
MOST = 3
"""Rows of an answer."""
FOLDS: tuple[Folds, ...] = ("group", "record", "test", "session")


@checked
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Calibration(Result):
    """Posteriors, verdicts and held-out scores, from `rocksteady.calibrate`.

    Attributes
    ----------
    tests, prior, sampling, model
        Inputs of the calibration.
    folds
        Tests that are held out together.
    temper
        Exponent of the likelihood, 1 for none.
    tempered_by_choice
        Whether held-out tests have chosen it.
    posteriors
        Weighted draws by object; each object has its own.
    parameters
        A row for each parameter and derived number of each object: `prior_low`, `prior_high`,
        `median`, `low`, `high` (90 %), `sd_ratio` (standard deviation over the prior's),
        `verdict`, and of alpha `outline`, `bound` and `bound_side`.
    validation
        Held-out scores, and predictions of each test without its group.
    flips
        Number of fates of the median blocks that change, by how records are processed and solved.
    warnings
        Sentences on what limits the answer.
    evidence
        What the draws make of the tests, for other folds.
    recalibrate
        Whether held-out predictions are recalibrated; None where that helps.
    """

    tests: Observations
    prior: Prior
    sampling: DrawOptions
    model: Model
    folds: Folds
    temper: float
    tempered_by_choice: bool
    posteriors: Mapping[str, Posterior]
    parameters: tuple[dict[str, Any], ...]
    validation: Validation
    flips: Mapping[str, int]
    warnings: tuple[str, ...]
    evidence: tuple[Evidence, ...]
    recalibrate: bool | None = None

    @property
    def temper_scores(self) -> Mapping[float, Scores]:
        """Held-out scores by temper; empty without scores."""
        return self.validation.temper_scores

    @property
    def mc_error(self) -> float:
        """Largest Monte Carlo error of a held-out prediction."""
        return float(np.max(self.validation.predictions.mc_error))

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
        return predict_all(
            listed(tests),
            {test.name: digest_of(test) for test in self.tests.tests},
            self.validation.predictions,
            Source(
                posteriors=self.posteriors,
                sampling=self.sampling,
                model=self.model,
                recalibration=self.validation.recalibration,
            ),
            run,
        )

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
        temper = None if self.tempered_by_choice else self.temper
        trial = make_trial(self.tests, self.evidence, codes, temper, self.recalibrate)
        return validate_trial(trial, self.tests.tests, names, folds=folds, seed=self.sampling.seed)

    def describe(self) -> Description:
        """Return scores, parameters with their verdicts, and what limits them."""
        validation = self.validation
        counts = self.tests.describe().to_dict()["counts"]
        rows = validation.rows
        best = rows.get("calibrated")
        scored = (
            "no held-out scores"
            if best is None
            else f"held-out accuracy {chance(best.accuracy[0], best.tests)}, "
            f"Brier score {number(best.brier[0])}"
        )
        effective = {name: each.effective_draws for name, each in self.posteriors.items()}
        facts = [
            Fact("seed", self.sampling.seed),
            Fact("tests", len(self.tests), "tests"),
            Fact("counts", counts),
            Fact("folds", self.folds, "held out together"),
            Fact("temper", self.temper, "temper of the likelihood"),
            Fact("model", self.model.name, "model"),
            Fact("tolerance", getattr(self.model, "tolerance", None)),
            *(
                Fact(key, None if name not in rows else rows[name].values())
                for key, name in (
                    ("scores", "calibrated"),
                    ("untempered", "untempered"),
                    ("base_rate", "base rate"),
                    ("logistic", "logistic"),
                )
            ),
            Fact("draws", self.sampling.draws, "draws"),
            Fact("gains", self.sampling.gains),
            Fact("error", self.sampling.error),
            Fact("effective_draws", effective, "effective draws", _words(effective)),
            Fact(
                "pareto_k",
                {name: number_or_none(each.pareto_k) for name, each in self.posteriors.items()},
                "Pareto k of the weights",
                _words({name: each.pareto_k for name, each in self.posteriors.items()}),
            ),
            Fact(
                "recalibration",
                {"intercept": self._line.intercept, "slope": self._line.slope},
                "recalibration of the log odds",
                f"{number(self._line.intercept)} + {number(self._line.slope)} logit p",
            ),
            Fact(
                "sessions",
                {name: list(each.sessions) for name, each in self.posteriors.items()},
            ),
            Fact("mc_error", self.mc_error, "largest Monte Carlo error"),
            Fact("flips", dict(self.flips), "flips", _words(self.flips)),
            Fact(
                "inputs",
                {
                    "objects": {
                        name: {key: str(spread) for key, spread in each.space.block.spreads.items()}
                        for name, each in self.posteriors.items()
                    },
                    "noise": {key: str(getattr(self.prior.noise, key)) for key in NOISE},
                },
            ),
            Fact("trained", {test.name: digest_of(test) for test in self.tests.tests}),
            Fact("hashes", {**self.tests.sources, **self.prior.sources}),
            Fact("warnings", list(self.warnings)),
        ]
        of_scores, *others = validation.describe().tables
        tables = [
            self._table(),
            Table("score_rows", of_scores.rows, of_scores.columns, title=of_scores.title),
            *others,
        ]
        notes = [*self.warnings, *self._remarks()]
        tables += self._sessions()
        few = min(self.posteriors.values(), key=lambda each: each.effective_draws)
        if not few.identified:
            scored = (
                f"no answer yet: it rests on {few.effective_draws:.0f} effective draws of "
                f"{len(few.values):,} (at least {FEWEST_DRAWS:g} needed)"
            )
        return Description(
            headline=f"calibration of {plural(len(self.posteriors), 'object')} by "
            f"{plural(len(self.tests), 'test')}: {scored}",
            facts=facts,
            tables=tables,
            notes=notes,
            answer=self._answer(few),
        )

    @property
    def _line(self) -> Platt:
        return self.validation.recalibration

    def _answer(self, few: Posterior) -> Answer:
        """Return how well held-out tests are predicted, and what outcomes show of each parameter.

        Parameters
        ----------
        few
            The posterior of the fewest effective draws.
        """
        best, base = (self.validation.rows.get(name) for name in ("calibrated", "base rate"))
        held = "no score: tests of several groups are needed"
        sentence = f"No answer yet: {held}."
        if best is not None and base is not None:
            _, low, high = best.accuracy
            band = interval(None if np.isnan(low) else (low, high), 0.9)
            share, rate = (chance(each.accuracy[0], each.tests) for each in (best, base))
            share += "" if " of " in share else " of"
            held = f"{share} tests predicted; by the base rate {rate}"
            sentence = f"{share} held-out tests are predicted{band}."
        if not few.identified:
            sentence = (
                f"No answer yet: it rests on {few.effective_draws:.0f} effective draws of "
                f"{len(few.values):,} (at least {FEWEST_DRAWS:g} needed)."
            )
            held += ", provisional"
        facts = [("held out", held)]
        several, rows = len(self.posteriors) > 1, []
        for row in self.parameters:
            name = str(row["parameter"])
            if name != "alpha_rad" and (several or name != "restitution"):
                continue
            label = f"{row['object']}, alpha" if several else name.removesuffix("_rad")
            words = (
                f"not identified by so few draws; prior {_range(row, 'prior_low', 'prior_high')}"
            )
            if row["median"] is not None:
                words = f"{number(row['median'])} (90 %: {_range(row, 'low', 'high')}); "
                words += str(row["verdict"])
            rows.append((label, words))
        limits = [str(row["parameter"]) for row in self.parameters if row["verdict"] == LIMIT]
        if limits:
            facts.append(
                ("prior's limit", f"reached by {', '.join(dict.fromkeys(limits))}: doubt it")
            )
        facts[:0] = [*rows[:MOST], left_out(max(len(rows) - MOST, 0))]
        facts.append(("doubt", doubt(self.warnings)))
        return Answer(sentence, facts)

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
        if self.temper != 1.0:
            remarks.append(
                f"The likelihood is taken to the power {number(self.temper)}, which held-out tests "
                "prefer; that is no Bayesian posterior, and the untempered scores stand beside."
            )
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
        If it is none of the four, or a test has no session.
    """
    if not isinstance(folds, str) or folds not in FOLDS:  # type: ignore[redundant-expr]
        raise InputError("folds", folds, f"it must be one of {', '.join(FOLDS)}", "give one")
    names = []
    for test in tests:
        if folds == "session" and test.session is None:
            raise InputError(
                "folds",
                "session",
                f"test {test.name!r} has no session",
                "give each test one, or hold out by group",
            )
        name = {
            "group": test.group,
            "record": test.record.name or test.group,
            "test": test.name,
            "session": test.session,
        }[folds]
        names.append(str(name))
    order = {name: place for place, name in enumerate(dict.fromkeys(names))}
    return list(order), np.array([order[name] for name in names])


def why_not(fell: Floats, codes: Integers, folds: str) -> str:
    """Return why tests cannot be held out; an empty text where they can."""
    known = np.isfinite(fell)
    if not known.any():
        return "no test has an outcome: there is nothing to score"
    if len(np.unique(codes[known])) < 2:
        return f"all tests with an outcome are of one {folds}: none is left to predict it from"
    return ""


def make_trial(
    tests: Observations,
    evidence: Sequence[Evidence],
    codes: Integers,
    temper: float | None,
    recalibrate: bool | None,
) -> Trial:
    """Return all that scores need."""
    names = list(tests.objects)
    return Trial(
        evidence=[each.by_groups(codes) for each in evidence],
        marginal=evidence,
        codes=codes,
        objects=np.array([names.index(test.object) for test in tests.tests]),
        fell=tests.fell,
        measures=measures_of(tests.tests, tests.objects),
        temper=temper,
        recalibrate=recalibrate,
    )


def _words(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {number(float(value))}" for name, value in values.items())


def _shortened(name: str) -> str:
    """Return a name that leaves room for numbers beside it."""
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
