"""Rows of the tables of a calibration's page, in words."""

import math
import re
from collections.abc import Mapping, Sequence
from operator import itemgetter
from typing import Any

from markupsafe import Markup

from rocksteady.results.doubts import FEWEST_DRAWS, NOT_IDENTIFIED
from rocksteady.results.numbers import chance, number, plural
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.scores import NAMES, WORDS, Scores
from rocksteady.show.style.markup import Cell, Row, badge, beside, figure, isolated, named, under
from rocksteady.show.style.wording import NOTHING, greek, sentence, span

LEAST_SCORE = 5e-5
LABELS = {
    "calibrated": "calibrated block",
    "untempered": "the same, untempered",
    "base rate": "base rate",
    "logistic": "logistic on intensity",
}
SHORT = {
    "accuracy": "accuracy",
    "f1": "F1",
    "brier": "Brier",
    "log_score": "log score",
    "ece": "calibration error",
}
"""Headings of the scores."""
FIRST = "alpha_rad"
"""Parameter that stands on top of an object's."""
PARAMETERS = {
    "alpha_rad": "α [rad]",
    "p_rad_s": "p [rad/s]",
    "housner_factor": "restitution over that of Housner",
    "sigma_ln": "amplitude error σ",
    "outliers": "outliers ε",
    "scatter": "scatter of restitution",
    "base": "base over outline",
}
VERDICTS = {
    NOT_IDENTIFIED: ("differs", f"fewer than {FEWEST_DRAWS:g} effective draws: make more draws"),
    "identified": ("agrees", "the tests narrow it inside what was known before"),
    "narrowed": ("open", "narrower than before, though outcomes alone identify alpha only"),
    "prior returned": ("open", "it comes back as it was put in, and the tests do not inform it"),
    "bound": ("differs", "all outcomes are alike and bound it from one side, at 90 %"),
    "at the prior's limit": (
        "differs",
        "the tests push it to an end of what was thought possible: widen that, or doubt the model",
    ),
}
"""Look and meaning of each verdict; verdicts that limit the answer stand out."""
MOST_ROWS = 12
"""Rows of the table of tests that were not expected."""


def sentence_of(calibration: Calibration) -> str:
    """Return the answer in one sentence: how many outcomes are called, and by less than physics."""
    if not calibration.validation.rows:
        count = plural(len(calibration.tests), "test")
        return f"By {count}, none of which can be held out: their predictions cannot be scored."
    rows = calibration.validation.rows
    mine, base = rows["calibrated"], rows["base rate"]
    right = round(mine.accuracy[0] * mine.tests)
    share = f" ({chance(mine.accuracy[0])})" if 0 < right < mine.tests else ""
    words = (
        f"Predicted without the tests of its own group, {right} of {plural(mine.tests, 'outcome')}"
        f"{share} came as the calibrated block expects; the more frequent outcome alone is right "
        f"in {chance(base.accuracy[0], base.tests)}"
    )
    logistic = chance(rows["logistic"].accuracy[0], mine.tests)
    return f"{words}, a logistic on intensity in {logistic}."


def score_rows(rows: Mapping[str, Scores]) -> list[Row]:
    """Return a row for each predictor: scores with their bands."""
    return [
        {
            "predictor": Cell(LABELS.get(key, key), "name"),
            **{SHORT[name]: _score_cell(name, getattr(scores, name)) for name in NAMES},
        }
        for key, scores in rows.items()
    ]


def _score_cell(name: str, value: Sequence[float]) -> Cell:
    """Return a score with its band."""
    return figure(beside(number(value[0]), under(_band(value))), WORDS[name])


def _band(value: Sequence[float]) -> str | None:
    """Return the interval of a score; None where it has none."""
    if not math.isfinite(value[1]):
        return None
    low, high = _score(value[1]), _score(value[2])
    return low if low == high else f"{low} to {high}"


def _score(value: float) -> str:
    """Return a score; what is left of rounding is 0."""
    return number(0.0 if abs(value) < LEAST_SCORE else value)


def parameter_rows(calibration: Calibration) -> list[Row | str]:
    """Return a row for each parameter of each object, below the object's name if there are more."""
    rows: list[Row | str] = []
    for each in ordered(calibration.parameters):
        if len(calibration.posteriors) > 1 and each["parameter"] == FIRST:
            rows.append(each["object"])
        look, _ = VERDICTS[each["verdict"]]
        rows.append(
            {
                "parameter": parameter_words(each["parameter"]),
                "before": figure(span(each["prior_low"], each["prior_high"])),
                "median": figure(NOTHING if each["median"] is None else number(each["median"])),
                Markup("90&nbsp;% of it"): figure(
                    NOTHING if each["low"] is None else span(each["low"], each["high"]),
                    "90 % of it",
                ),
                "outline": figure(
                    NOTHING if each.get("outline") is None else number(each["outline"])
                ),
                "verdict": beside(badge(each["verdict"], look), _bound(each)),
            }
        )
    return rows


def verdict_words(calibration: Calibration) -> str:
    """Return the meaning of each verdict that a parameter has."""
    verdicts = dict.fromkeys(each["verdict"] for each in ordered(calibration.parameters))
    return " ".join(sentence(f"{each}: {greek(VERDICTS[each][1])}") for each in verdicts)


def ordered(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the rows of parameters, of each object alpha first."""
    names = list(dict.fromkeys(each["object"] for each in rows))
    return sorted(rows, key=lambda each: (names.index(each["object"]), each["parameter"] != FIRST))


def parameter_words(name: str) -> str:
    """Return the name of a parameter in words, with its unit.

    Examples
    --------
    >>> parameter_words("alpha_rad"), parameter_words("width_m")
    ('α [rad]', 'width [m]')
    """
    if name in PARAMETERS:
        return PARAMETERS[name]
    return re.sub(r" m$", " [m]", name.replace("_", " "))


def _bound(row: Mapping[str, Any]) -> str:
    """Return the bound of a parameter in words; nothing where it has two sides."""
    if row.get("bound") is None:
        return ""
    word = "at most" if row["bound_side"] == "upper" else "at least"
    return f"{word} {number(row['bound'])}"


def unexpected_rows(calibration: Calibration) -> list[Row]:
    """Return the tests whose outcome was least expected, those of less than an even chance."""
    predictions, several = calibration.validation.predictions, len(calibration.posteriors) > 1
    unlikely: list[tuple[float, Row]] = []
    for place, test in enumerate(calibration.tests.tests):
        p, low, high = (
            float(each[place]) for each in (predictions.p, predictions.low, predictions.high)
        )
        chance = p if test.fell else 1.0 - p
        if test.fell is None or not chance < 0.5:
            continue
        row: Row = {
            "test": named(test.name, more=under(isolated(test.object) if several else None)),
            "record": isolated(test.record.name or ""),
            "gain": figure(number(test.gain)),
            "outcome": "fell" if test.fell else "stood",
            "predicted": figure(number(p)),
            Markup("90&nbsp;% of draws"): figure(
                NOTHING if math.isnan(low) else span(low, high), "90 % of draws"
            ),
            "± by draws": figure(number(float(predictions.mc_error[place]), 2)),
        }
        unlikely.append((chance, row))
    return [row for _, row in sorted(unlikely, key=itemgetter(0))]


def session_rows(calibration: Calibration) -> list[Row]:
    """Return a row for each session, the largest misfit first."""
    residuals = calibration.validation.residuals.get("session", ())
    return [
        {
            "session": named(each["name"]),
            "tests": figure(f"{each['tests']}"),
            "fell": figure(f"{each['fell']}"),
            "predicted": figure(number(each["expected"])),
            "over its deviation": figure(number(each["z"], 2)),
        }
        for each in sorted(residuals, key=lambda each: (-abs(each["z"]), each["name"]))
    ]
