"""Rows of the tables of a calibration's page, in words."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.results.doubts import FEWEST_DRAWS, NOT_IDENTIFIED
from rocksteady.results.numbers import number, plural
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.scores import NAMES, WORDS, Scores
from rocksteady.show.style.wording import NOTHING, greek, percent, span

Row = dict[str, Any]

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
    NOT_IDENTIFIED: ("raised", f"fewer than {FEWEST_DRAWS:g} effective draws: make more draws"),
    "identified": ("agrees", "the tests narrow it inside what was known before"),
    "narrowed": ("open", "narrower than before, though outcomes alone identify alpha only"),
    "prior returned": ("open", "it comes back as it was put in, and the tests do not inform it"),
    "bound": ("raised", "all outcomes are alike and bound it from one side, at 90 %"),
    "at the prior's limit": (
        "raised",
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
    words = (
        f"Predicted without the tests of its own group, {right} of {plural(mine.tests, 'outcome')} "
        f"({percent(mine.accuracy[0])}) came as the calibrated block expects; the more frequent "
        f"outcome alone is right in {percent(base.accuracy[0])}"
    )
    logistic = percent(rows["logistic"].accuracy[0])
    return f"{words}, a logistic on intensity in {logistic}."


def score_rows(rows: Mapping[str, Scores]) -> list[Row]:
    """Return a row for each predictor: scores with their bands."""
    return [
        {
            "name": LABELS.get(key, key),
            "scores": [
                {
                    "name": WORDS[name],
                    "short": SHORT[name],
                    "value": number(value[0]),
                    "band": _band(value),
                }
                for name, value in ((name, getattr(scores, name)) for name in NAMES)
            ],
        }
        for key, scores in rows.items()
    ]


def _band(value: Sequence[float]) -> str:
    """Return the interval of a score; nothing where it has none."""
    low, high = _score(value[1]), _score(value[2])
    return (low if low == high else f"{low} to {high}") if math.isfinite(value[1]) else ""


def _score(value: float) -> str:
    """Return a score; what is left of rounding is 0."""
    return number(0.0 if abs(value) < LEAST_SCORE else value)


def parameter_rows(calibration: Calibration) -> list[Row]:
    """Return a row for each parameter of each object."""
    several = len(calibration.posteriors) > 1
    rows = ordered(calibration.parameters)
    return [
        {
            "object": each["object"] if several and each["parameter"] == FIRST else "",
            "name": parameter_words(each["parameter"]),
            "prior": span(each["prior_low"], each["prior_high"]),
            "median": NOTHING if each["median"] is None else number(each["median"]),
            "interval": NOTHING if each["low"] is None else span(each["low"], each["high"]),
            "outline": NOTHING if each.get("outline") is None else number(each["outline"]),
            "verdict": each["verdict"],
            "look": VERDICTS[each["verdict"]][0],
            "meaning": greek(VERDICTS[each["verdict"]][1]),
            "bound": _bound(each),
        }
        for each in rows
    ]


def ordered(rows: Sequence[Row]) -> list[Row]:
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
    predictions, tests = calibration.validation.predictions, calibration.tests.tests
    rows = []
    for place, test in enumerate(tests):
        if test.fell is None or not math.isfinite(predictions.p[place]):
            continue
        p = float(predictions.p[place])
        chance = p if test.fell else 1.0 - p
        if chance < 0.5:
            rows.append(
                {
                    "name": test.name,
                    "record": test.record.name or "",
                    "object": test.object,
                    "gain": number(test.gain),
                    "outcome": "fell" if test.fell else "stood",
                    "p": number(p),
                    "band": NOTHING
                    if math.isnan(predictions.low[place])
                    else span(float(predictions.low[place]), float(predictions.high[place])),
                    "error": number(float(predictions.mc_error[place]), 2),
                    "chance": chance,
                }
            )
    return sorted(rows, key=lambda row: row["chance"])


def residual_rows(calibration: Calibration, by: str) -> list[Row]:
    """Return a row for each record or session, the largest misfit first."""
    residuals = calibration.validation.residuals.get(by, ())
    rows = sorted(residuals, key=lambda each: (-abs(each["z"]), each["name"]))
    return [
        {
            "name": each["name"],
            "tests": f"{each['tests']}",
            "fell": f"{each['fell']}",
            "expected": number(each["expected"]),
            "z": number(each["z"], 2),
        }
        for each in rows
    ]
