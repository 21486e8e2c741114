"""Words of predictions of tests, of their scores, and of held-out validation."""

import numpy as np

from rocksteady.results.description import Column, Description, Fact, Table, doubt, left_out, line
from rocksteady.results.doubts import ANSWER_DRAWS
from rocksteady.results.numbers import chance, counted, interval, number, plural
from rocksteady.results.result import describes
from rocksteady.risk.calibration.held_out.predictions import Predictions
from rocksteady.risk.calibration.held_out.scores import NAMES, Scores
from rocksteady.risk.calibration.held_out.validate import Row, Validation

SHOWN = 4
"""Tests that an answer lists."""
LONGEST_NAME = 30
"""Letters of a test in a table."""


@describes(Predictions)
def describe_predictions(predictions: Predictions) -> Description:
    """Return a row for each test."""
    columns = (
        Column("test", "test", _shortened, left=True),
        Column("p", "p", number),
        Column("low", "5 %", number),
        Column("high", "95 %", number),
        Column("block", "block", number),
        Column("logistic", "logistic", number),
        *([Column("held_out", "held out")] if any(predictions.held_out) else []),
        *([Column("outcome", "outcome", left=True)] if set(predictions.fell) - {None} else []),
    )
    likely = int((predictions.p >= 0.5).sum())
    sentence, screen = _answer(predictions, likely)
    return Description(
        headline=_likely(predictions, likely),
        facts=[
            *screen,
            Fact("tests", len(predictions.test), "tests"),
            Fact("mc_error", float(np.max(predictions.mc_error)), "largest Monte Carlo error"),
            Fact("warnings", list(predictions.warnings)),
        ],
        tables=[
            Table(
                "predictions",
                predictions.rows,
                columns,
                severity=lambda row: row["p"],
                kind=lambda row: f"likely to {'fall' if row['p'] >= 0.5 else 'stand'}",
            )
        ],
        notes=predictions.warnings,
        sentence=sentence,
    )


def _likely(predictions: Predictions, count: int) -> str:
    """Return the number of tests that fall with more than even chance, in words."""
    return f"{counted(count, plural(len(predictions.test), 'test'), 'more likely fall')} than not"


def _answer(predictions: Predictions, likely: int) -> tuple[str, list[Fact]]:
    """Return the probabilities, the highest first; provisional of too few draws."""
    rows = sorted(predictions.rows, key=lambda row: row["p"], reverse=True)
    words = [
        chance(row["p"]) + interval(None if row["low"] is None else (row["low"], row["high"]), 0.9)
        for row in rows
    ]
    few = not predictions.identified
    fall = _likely(predictions, likely)
    sentence = f"{fall[0].upper()}{fall[1:]}."
    if len(rows) == 1:
        sentence = f"It falls in {rows[0]['test']} with {words[0]}."
    if few:
        sentence = (
            f"No answer, provisional: {predictions.effective_draws.min():.0f} effective draws of "
            f"the {ANSWER_DRAWS:g} that it takes."
        )
    left = rows[SHOWN:]
    falling = sum(row["p"] >= 0.5 for row in left)
    kinds = f"{falling} likely to fall, {len(left) - falling} to stand"
    names = [_shortened(row["test"]) for row in rows]
    shown = [line(*pair) for pair in zip(names, words, strict=True)][:SHOWN]
    facts = [
        *(shown if len(rows) > 1 or few else ()),
        left_out(len(left), kinds),
        line("doubt", doubt(predictions.warnings)),
    ]
    return sentence, facts


def _shortened(name: str) -> str:
    """Return a name that leaves room for numbers beside it; its middle is left out."""
    half = LONGEST_NAME // 2
    return name if len(name) <= LONGEST_NAME else f"{name[:half]}…{name[1 - half :]}"


WORDS = {
    "accuracy": "accuracy",
    "f1": "F1 of falls",
    "brier": "Brier score",
    "log_score": "log score",
    "ece": "calibration error",
}


@describes(Scores)
def describe_scores(scores: Scores) -> Description:
    """Return the five scores."""
    rows = [
        {"score": key, "value": value, "low": low, "high": high}
        for key, (value, low, high) in ((key, getattr(scores, key)) for key in NAMES)
    ]
    columns = (
        Column("score", "score", lambda key: WORDS[key], left=True),
        Column("value", "value", number),
        Column("low", "5 %", number),
        Column("high", "95 %", number),
    )
    return Description(
        headline=f"accuracy {chance(scores.accuracy[0], scores.tests)}, Brier score "
        f"{number(scores.brier[0])} of {scores.tests} tests",
        facts=[
            Fact("tests", scores.tests, "tests"),
            Fact("groups", scores.groups, "groups that the bootstrap draws"),
        ],
        tables=[Table("scores", rows, columns)],
    )


@describes(Validation)
def describe_validation(validation: Validation) -> Description:
    """Return the scores, one row for each rule."""
    rows = [{"rule": name} | _plain(scores) for name, scores in validation.rows.items()]
    residuals = [{"by": by, **row} for by, rows in validation.residuals.items() for row in rows]
    columns = (
        Column("rule", "predicted by", left=True),
        Column("accuracy", "accuracy", number),
        Column("f1", "F1", number),
        Column("brier", "Brier", number),
        Column("log_score", "log score", number),
        Column("ece", "ECE", number),
    )
    best = validation.rows.get("predicted")
    words = "no scores"
    if best is not None:
        share, low, high = best.accuracy
        span = interval(None if np.isnan(low) else (low, high), 0.9)
        words = f"accuracy {chance(share, best.tests)}{span}, "
        words += f"Brier score {number(best.brier[0])}"
    return Description(
        headline=f"held out by {validation.folds}: {words}",
        facts=[
            Fact("folds", validation.folds, "held out together"),
            Fact("groups", 0 if best is None else best.groups, "groups"),
            Fact("tests", 0 if best is None else best.tests, "tests"),
            Fact("warnings", list(validation.warnings)),
        ],
        tables=[
            Table("scores", rows, columns, title="scores of tests that were held out"),
            Table("reliability", validation.reliability),
            Table("residuals", residuals),
            Table("learning", validation.learning),
        ],
        notes=validation.warnings,
    )


def _plain(scores: Scores) -> Row:
    """Return scores and their ends as values of a row."""
    row: Row = {}
    for key in NAMES:
        value, low, high = getattr(scores, key)
        row |= {key: value, f"{key}_low": low, f"{key}_high": high}
    return row
