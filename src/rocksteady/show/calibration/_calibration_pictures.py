"""Pictures of a calibration's page, each with the words for those who do not see it."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.results.numbers import number, plural
from rocksteady.results.rendering import printable
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.validate import Validation
from rocksteady.show.calibration._calibration_tables import FIRST, ordered
from rocksteady.show.plots.observations.ladders import MOST, plot_test_ladders, rungs_of
from rocksteady.show.plots.observations.posteriors import plot_posterior
from rocksteady.show.plots.observations.reliability import plot_reliability
from rocksteady.show.plots.observations.residuals import MOST as MOST_RESIDUALS
from rocksteady.show.plots.observations.residuals import plot_residuals
from rocksteady.show.plots.observations.scores import plot_learning
from rocksteady.show.report import picture
from rocksteady.show.style.page import Page

HALF = Page(width_mm=94.0)
"""Of two pictures beside each other."""
ROW = 0.2
"""Height of a row [inches]."""
MOST_PICTURES = 4
"""Pictures of records: the rest are in the table of predictions."""
MOST_OBJECTS = 6
"""Objects whose parameters are drawn."""

Picture = dict[str, str]


def pictures_of(calibration: Calibration) -> dict[str, Any]:
    """Return the pictures of a calibration's page by their places; lists where there are more."""
    pictures: dict[str, Any] = {
        "ladders": _ladders(calibration),
        "posteriors": _posteriors(calibration),
    }
    validation = calibration.validation
    if not validation.rows:
        return pictures
    pictures["reliability"] = picture(
        partial(plot_reliability, calibration), 3.7, _words_of_reliability(validation)
    )
    if len(validation.learning) > 1:
        first, last = (validation.learning[place]["groups"] for place in (0, -1))
        pictures["learning"] = picture(
            partial(plot_learning, calibration),
            3.1,
            f"Held-out accuracy after {first} to {last} groups, of the block, of a logistic on "
            "intensity and of the base rate.",
        )
    for by in ("record", "session"):
        rows = validation.residuals[by]
        if len(rows) > 1:
            pictures[by] = picture(
                partial(plot_residuals, calibration, by=by),
                1.1 + ROW * min(len(rows), MOST_RESIDUALS),
                f"Falls less those predicted, of {plural(len(rows), by)}.",
            )
    return pictures


def _ladders(calibration: Calibration) -> list[Picture]:
    """Return pictures of the records, some rows each."""
    rungs, label = rungs_of(calibration)
    starts = range(0, len(rungs), MOST)[:MOST_PICTURES]
    return [
        picture(
            partial(plot_test_ladders, calibration, first=first),
            1.2 + ROW * len(rungs[first : first + MOST]),
            f"Outcomes over the {label} of {plural(len(rungs[first : first + MOST]), 'record')}, "
            "with the predicted probability as shade.",
        )
        for first in starts
    ]


def _interval_words(row: Mapping[str, Any]) -> str:
    """Return median and interval of a parameter, or that it has none."""
    if row["low"] is None:
        return NOT_IDENTIFIED
    return (
        f"median {number(row['median'])}, 90 % from {number(row['low'])} to {number(row['high'])}"
    )


def _posteriors(calibration: Calibration) -> list[Picture]:
    """Return a picture of each parameter, or of the alpha of the first objects."""
    names = list(calibration.posteriors)[:MOST_OBJECTS]
    several = len(calibration.posteriors) > 1
    return [
        picture(
            partial(_posterior, calibration, row["parameter"], row["object"], several),
            3.0,
            f"{row['parameter']} of {printable(row['object'])}: {_interval_words(row)}; before, "
            f"from {number(row['prior_low'])} to {number(row['prior_high'])}.",
            phone=False,
            page=HALF,
        )
        for row in ordered(calibration.parameters)
        if row["object"] in names
        and row["parameter"] in calibration.posteriors[row["object"]].columns
        and (not several or row["parameter"] == FIRST)
    ]


def _posterior(
    calibration: Calibration, parameter: str, body: str, several: bool, axes: Any
) -> None:
    from rocksteady.show.style import palette
    from rocksteady.show.style.escaping import literal

    plot_posterior(calibration, axes, parameter=parameter, object=body)
    if several:
        axes.set_title(literal(palette.shortened(body)))


def _words_of_reliability(validation: Validation) -> str:
    """Return what the reliability plot shows."""
    points = ", ".join(
        f"{number(each['observed'], 2)} at {number(each['predicted'], 2)}"
        for each in validation.reliability
    )
    return f"Share that fell at the predicted probability, held out: {points}."
