"""Rows of the tables of a calibration's page, in words."""

import math
import re
from collections.abc import Mapping, Sequence
from operator import itemgetter
from typing import Any

from markupsafe import Markup

from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.results.numbers import chance, number, plural
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.scores import NAMES
from rocksteady.risk.calibration.identified import BOUND, IDENTIFIED, LIMIT, MEANINGS
from rocksteady.show.style.markup import Cell, Row, badge, beside, figure, isolated, named, under
from rocksteady.show.style.wording import NOTHING, greek, sentence, span
from rocksteady.words.predictions import WORDS

LEAST_SCORE = 5e-5
LABELS = {
    "predicted": "block and logistic",
    "block": "block alone",
    "logistic": "logistic alone",
    "base rate": "base rate",
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
    "housner_factor": "restitution over Housner’s",
    "sigma_ln": "amplitude error σ",
    "outliers": "outliers ε",
    "scatter": "scatter of restitution",
    "gyration_m": "radius of gyration [m]",
    "session_ln": "deviation between sessions",
    "base": "base over outline",
    "offset": "offset over half the base",
    "orientation_rad": "orientation [rad]",
}
LOOKS = {NOT_IDENTIFIED: "differs", BOUND: "differs", LIMIT: "differs", IDENTIFIED: "agrees"}
"""Badges of verdicts; the highlighted ones limit the answer."""
MOST_ROWS = 12
"""Rows of the table of tests that were not expected."""


def sentence_of(calibration: Calibration) -> str:
    """Return how many outcomes are predicted, by block and logistic and by each rule alone."""
    rows, tests = calibration.validation.rows, plural(len(calibration.tests), "test")
    if not rows:
        return f"By {tests}, none of which can be held out: their predictions cannot be scored."
    best = rows["predicted"]
    right = round(best.accuracy[0] * best.tests)
    share = f" ({chance(best.accuracy[0])})" if 0 < right < best.tests else ""
    block, logistic, base = (
        chance(rows[name].accuracy[0], best.tests) for name in ("block", "logistic", "base rate")
    )
    use = dict(calibration.describe().screen).get("use")
    return (
        f"Predicted without the tests of its own group, {right} of "
        f"{plural(best.tests, 'outcome')}{share} came as block and logistic together expect; "
        f"the block alone is right in {block}, the logistic alone in {logistic}, the more frequent "
        f"outcome in {base}.{f' Use {use}.' if use else ''}"
    )


def score_rows(calibration: Calibration) -> list[Row | str]:
    """Return a row for each predictor, scores with their bands; those of a new day below."""
    rows: list[Row | str] = []
    new = calibration.new_day
    for heading, validation in (("", calibration.validation), ("on a new day", new)):
        scores = {} if validation is None else validation.rows
        rows += [heading] if heading and scores else []
        rows += [
            {
                "predictor": Cell(LABELS[key], "name"),
                **{SHORT[name]: _score_cell(name, getattr(each, name)) for name in NAMES},
            }
            for key, each in scores.items()
        ]
    return rows


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
                "verdict": beside(
                    badge(each["verdict"], LOOKS.get(each["verdict"], "open")), _bound(each)
                ),
            }
        )
    return rows


def verdict_words(calibration: Calibration) -> str:
    """Return the meaning of each verdict that a parameter has."""
    verdicts = dict.fromkeys(each["verdict"] for each in ordered(calibration.parameters))
    return " ".join(sentence(f"{each}: {greek(MEANINGS[each])}") for each in verdicts)


def ordered(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
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
            **{
                key: figure(NOTHING if math.isnan(at[place]) else number(float(at[place])))
                for key, at in (("block", predictions.block), ("logistic", predictions.logistic))
            },
        }
        unlikely.append((chance, row))
    return [row for _, row in sorted(unlikely, key=itemgetter(0))]


def session_rows(calibration: Calibration) -> list[Row]:
    """Return a row for each session, the largest misfit first; of one object with its gain."""
    (first, *others) = calibration.posteriors.values()
    known = {} if others or not first.identified else first.sessions
    gains = {name: first.session_gain(name) for name in known}
    residuals = calibration.validation.residuals.get("session", ())
    rows = []
    for each in sorted(residuals, key=lambda each: (-abs(each["z"]), each["name"])):
        row: Row = {
            "session": named(each["name"]),
            "tests": figure(f"{each['tests']}"),
            "fell": figure(f"{each['fell']}"),
            "predicted": figure(number(each["expected"])),
        }
        if each["name"] in gains:
            gain, low, high = gains[each["name"]]
            row["gain"] = figure(beside(number(gain), under(span(low, high))))
        rows.append(row)
    return rows
