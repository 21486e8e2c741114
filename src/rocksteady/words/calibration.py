"""Words of calibrations, and of the posterior of each object."""

import math
from collections.abc import Mapping
from dataclasses import asdict

import numpy as np

from rocksteady.results.description import Column, Description, Fact, Table, doubt, left_out, line
from rocksteady.results.doubts import NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import chance, interval, number, number_or_none, plural
from rocksteady.results.result import describes
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.scores import Scores
from rocksteady.risk.calibration.identified import MEANINGS
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.stored_posterior import StoredPosterior

LONGEST_NAME = 20
"""Letters of an object in a table of parameters."""
MOST = 3
"""Rows of an answer."""


@describes(Calibration)
def describe_calibration(calibration: Calibration) -> Description:
    """Return scores, parameters with their verdicts, and what limits them."""
    rows = calibration.validation.rows
    effective = {name: each.effective_draws for name, each in calibration.posteriors.items()}
    sentence, screen = _answer(calibration)
    facts = [
        Fact("seed", calibration.seed),
        Fact("tests", len(calibration.tests), "tests"),
        Fact("counts", calibration.tests.describe().to_dict()["counts"]),
        Fact("folds", calibration.folds, "held out together"),
        Fact("model", calibration.model.name, "model"),
        Fact("tolerance", getattr(calibration.model, "tolerance", None)),
        Fact("scores", {name: each.values() for name, each in rows.items()}),
        Fact(
            "new_day",
            None
            if calibration.new_day is None
            else {name: each.values() for name, each in calibration.new_day.rows.items()},
        ),
        Fact("most_runs", calibration.most_runs),
        Fact("runs", calibration.runs, "runs of a test", _words(calibration.runs)),
        Fact("effective_draws", effective, "effective draws", _words(effective)),
        Fact(
            "pareto_k",
            {name: number_or_none(each.pareto_k) for name, each in calibration.posteriors.items()},
            "Pareto k of the weights",
            _words({name: each.pareto_k for name, each in calibration.posteriors.items()}),
        ),
        Fact(
            "conflicts",
            [asdict(each) | {"prior": str(each.prior)} for each in calibration.conflicts],
        ),
        Fact("curve", asdict(calibration.validation.curve)),
        Fact("stack", asdict(calibration.validation.stack)),
        Fact(
            "sessions", {name: list(each.sessions) for name, each in calibration.posteriors.items()}
        ),
        Fact("mc_error", calibration.mc_error, "largest Monte Carlo error"),
        Fact("flips", dict(calibration.flips), "flips", _words(calibration.flips)),
        Fact(
            "inputs",
            {
                "objects": {
                    name: {key: str(spread) for key, spread in each.space.block.spreads.items()}
                    for name, each in calibration.posteriors.items()
                },
                "noise": {
                    name: {key: str(spread) for key, spread in each.noise.items()}
                    for name, each in calibration.posteriors.items()
                },
            },
        ),
        Fact("trained", calibration._trained),
        Fact("hashes", {**calibration.tests.sources, **calibration.prior.sources}),
        Fact("warnings", list(calibration.warnings)),
    ]
    of_scores, *others = calibration.validation.describe().tables
    tables = [
        _table(calibration),
        Table("score_rows", of_scores.rows, of_scores.columns, title=of_scores.title),
        *others,
        *_sessions(calibration),
    ]
    return Description(
        headline=f"calibration of {plural(len(calibration.posteriors), 'object')} by "
        f"{plural(len(calibration.tests), 'test')}: {sentence[0].lower()}"
        f"{sentence[1:].removesuffix('.')}",
        facts=[*screen, *facts],
        tables=tables,
        notes=[*calibration.warnings, *_remarks(calibration)],
        sentence=sentence,
    )


def _answer(calibration: Calibration) -> tuple[str, list[Fact]]:
    """Return how well held-out tests are predicted, and what outcomes show of parameters."""
    rows = calibration.validation.rows
    few = [name for name, each in calibration.posteriors.items() if not each.identified]
    sentence = f"{calibration.validation.warnings[0]}." if not rows else ""
    sentence = f"{sentence[:1].upper()}{sentence[1:]}"
    if rows:
        best = rows["predicted"]
        _, low, high = best.accuracy
        band = interval(None if np.isnan(low) else (low, high), 0.9)
        share = chance(best.accuracy[0], best.tests)
        share += "" if " of " in share else " of"
        least = min(each.effective_draws for each in calibration.posteriors.values())
        sentence = (
            f"{share} tests are predicted{band} on {_unseen(calibration)} not seen before, by "
            f"{least:.0f} effective draws."
        )
    bounds = [row for row in calibration.parameters if row["bound_side"] is not None]
    silent = [fit.bench.space.block.name for fit in calibration.fits if calibration._silent(fit)]
    if silent:
        sentence = (
            f"No answer: in each test of {silent[0]} all draws fall, or all stand: check units "
            "and gains."
        )
    elif few:
        sentence = f"No answer: {calibration._missing(few[0])}."
    elif bounds:
        side = "at most" if bounds[0]["bound_side"] == "upper" else "at least"
        outcome = "fell" if bounds[0]["bound_side"] == "upper" else "stood"
        sentence = (
            f"A bound and no fit: all tests of {bounds[0]['object']} {outcome}, so that alpha "
            f"is {side} {number(bounds[0]['bound'])} rad (90 %)."
        )
    elif calibration.conflicts:
        first = calibration.conflicts[0].sentence
        sentence = f"{first[0].upper()}{first[1:]}. {sentence}"
    several, lines = len(calibration.posteriors) > 1, []
    for row in calibration.parameters:
        name = str(row["parameter"])
        if name != "alpha_rad" and (several or name != "restitution"):
            continue
        label = f"{row['object']}, alpha" if several else name.removesuffix("_rad")
        words = f"no estimate yet; prior {_range(row['prior_low'], row['prior_high'])}"
        if row["median"] is not None:
            words = f"{number(row['median'])} (90 %: {_range(row['low'], row['high'])}); "
            words += str(row["verdict"])
        lines.append(line(label, words))
    # A short screen drops facts from the end.
    facts = [line("held out", _compared(rows))] if rows else []
    facts += [*lines[: MOST if several else 1], left_out(max(len(lines) - MOST, 0))]
    facts.append(line("doubt", doubt(calibration.warnings[len(calibration.conflicts) :])))
    if calibration.new_day is not None and calibration.new_day.rows:
        day = calibration.new_day.rows["predicted"].accuracy[0]
        facts.append(line("new day", f"{chance(day)}; {_compared(calibration.new_day.rows)}"))
    if rows and not few and not bounds:
        facts.append(line("use", _use(calibration)))
    return sentence, facts if several else [*facts, *lines[1:]]


def _unseen(calibration: Calibration) -> str:
    """Return in words what is held out together."""
    plain = all(test.group == test.record.name for test in calibration.tests.tests)
    kind = "record" if calibration.folds == "group" and plain else calibration.folds
    return f"{kind}s"


def _compared(rows: Mapping[str, Scores]) -> str:
    """Return the Brier score of each way to predict."""
    words = ", ".join(f"{name} {number(each.brier[0], 2)}" for name, each in rows.items())
    return f"Brier score {words.removeprefix('predicted ')}"


def _use(calibration: Calibration) -> str:
    """Return which way to predict is better where it is clearly not the block's."""
    value = {name: each.brier[0] for name, each in calibration.validation.rows.items()}
    if not value["logistic"] < calibration.validation.rows["block"].brier[1]:
        return ""
    best = "the logistic" if value["logistic"] < value["predicted"] else "block and logistic"
    return f"{best} to predict such tests; the block for what it says of the object"


def _table(calibration: Calibration) -> Table:
    before = (
        Column("prior_low", "prior 5 %", number),
        Column("prior_high", "prior 95 %", number),
    )
    names = (Column("object", "object", _shortened, left=True),)
    columns = [
        *(names if len(calibration.posteriors) > 1 else ()),
        Column("parameter", "parameter", left=True),
        *(() if len(calibration.posteriors) > 1 else before),  # 80 columns have no room for both
        Column("median", "median", number),
        Column("low", "5 %", number),
        Column("high", "95 %", number),
        Column("verdict", "verdict", left=True),
    ]
    return Table("parameters", calibration.parameters, columns)


def _sessions(calibration: Calibration) -> list[Table]:
    """Return the gain of each session of each object, with its interval of 90 %."""
    ends = ("gain", "low", "high")
    rows = [
        {"object": name, "session": session}
        | dict(zip(ends, posterior.session_gain(session), strict=True))
        for name, posterior in calibration.posteriors.items()
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


def _remarks(calibration: Calibration) -> list[str]:
    """Return what the verdicts and the temper mean."""
    used = dict.fromkeys(row["verdict"] for row in calibration.parameters)
    remarks = [f"{verdict}: {MEANINGS[verdict]}." for verdict in used]
    if len(calibration.posteriors) > 1:
        remarks.append("Each object has its own posterior and its own errors.")
    return remarks


def _range(low: float, high: float) -> str:
    """Return two ends in words."""
    return f"{number(low)} to {number(high)}"


def _words(values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {number(float(value))}" for name, value in values.items())


def _shortened(name: str) -> str:
    """Return a name that leaves room for numbers beside it."""
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"


@describes(Posterior)
def describe_posterior(posterior: Posterior) -> Description:
    """Return the median and the 90 % interval of each number."""
    rows = []
    for name in (*posterior.columns, *posterior.errors):
        ends = (None if math.isnan(each) else each for each in posterior.interval(name))
        rows.append(dict(zip(("parameter", "median", "low", "high"), (name, *ends), strict=True)))
    few = "" if posterior.identified else f", {TOO_FEW}: {NOT_IDENTIFIED}"
    columns = (
        Column("parameter", "parameter", left=True),
        Column("median", "median", number),
        Column("low", "5 %", number),
        Column("high", "95 %", number),
    )
    return Description(
        headline=f"{posterior.object}: {len(posterior.values):,} draws, "
        f"{posterior.effective_draws:.0f} effective{few}",
        facts=[
            Fact("object", posterior.object, "object"),
            Fact("effective_draws", posterior.effective_draws, "effective draws"),
            Fact("pareto_k", number_or_none(posterior.pareto_k), "Pareto k of the weights"),
        ],
        tables=[Table("parameters", rows, columns)],
    )


@describes(StoredPosterior)
def describe_stored(stored: StoredPosterior) -> Description:
    """Return objects and draws."""
    draws = {name: len(each.values) for name, each in stored.posteriors.items()}
    return Description(
        headline=f"posterior of {plural(len(draws), 'object')} from "
        f"{plural(len(stored.trained), 'test')}",
        facts=[
            Fact("objects", list(draws), "objects"),
            Fact("draws", draws),
            Fact("tests", len(stored.trained), "tests"),
            Fact("seed", stored.seed, "seed"),
        ],
    )
