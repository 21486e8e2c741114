"""Pictures of a facade's page, each with the words for those who do not see it."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from rocksteady.facades.checks.facade_check import FacadeCheck
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.page._facade_tables import length, places
from rocksteady.facades.plots.capacity import plot_facade_capacity
from rocksteady.facades.plots.languages import Language
from rocksteady.facades.plots.run_displacements import plot_facade_runs
from rocksteady.facades.plots.section import plot_facade_section
from rocksteady.show.report import PHONE, picture, twins
from rocksteady.show.style.page import Page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SECTION, CAPACITY = (3.4, 3.7), (4.7, 4.3)
"""Width and height of the two pictures that stand side by side [inches]."""
ROW, MOST_ROWS = 0.3, 40
"""Height of a record's row [inches]; more rows than these are drawn narrower."""


def pictures_of(check: FacadeCheck, words: Language) -> dict[str, dict[str, str]]:
    """Return addresses and alternative text of each picture.

    Each is drawn for a page ("source") and, with larger letters, for a phone ("narrow").
    """
    code = words.code
    pictures = {
        "section": _beside(
            lambda axes: plot_facade_section(check.facade, axes, language=code),
            SECTION, _words_of_section(check, words),
        ),
        "capacity": _beside(
            lambda axes: plot_facade_capacity(check, axes, language=code),
            CAPACITY, _words_of_capacity(check, words),
        ),
    }  # fmt: skip
    runs = check.runs
    if isinstance(runs, FacadeRuns):
        pictures["runs"] = picture(
            lambda axes: plot_facade_runs(runs, axes, language=code),
            1.3 + ROW * min(len(runs.records), MOST_ROWS),
            _words_of_runs(runs, words),
        )
    return pictures


def _beside(
    draw: "Callable[[Axes], object]", size: tuple[float, float], words: str
) -> dict[str, str]:
    """Return a picture that stands beside another, drawn again for a phone."""

    def make(page: Page) -> "Figure":
        natural = (PHONE.width(7.2), size[1]) if page is PHONE else size
        with page.figure(*natural, "") as figure:
            draw(figure.add_subplot())
        return figure

    return twins(make, words)


def _words_of_section(check: FacadeCheck, words: Language) -> str:
    """Return what the section shows."""
    facade = check.facade
    return words(
        "alt_section",
        **places(facade, words),
        thickness=length(facade.thickness_m, words),
        height=length(facade.height_m, words),
        inset=length(facade.hinge_inset_m, words),
        **{group: len(getattr(facade, group)) for group in ("loads", "masses", "ties", "thrusts")},
    )


def _words_of_capacity(check: FacadeCheck, words: Language) -> str:
    """Return what the capacity curve shows."""
    mechanism = check.mechanism
    demands = [
        words(
            "alt_demand",
            state=f"{each.limit_state}, {words[f'method_{each.method}']}",
            demand=words["beyond_all"] if math.isinf(each.demand) else length(each.demand, words),
        )
        for each in check.checks
        if each.unit == "m" and each.demand is not None
    ]
    drops = words.joined([length(place, words) for place, _ in mechanism.after])
    return words(
        "alt_capacity",
        a0=words.quantity(mechanism.capacity_g(0.0), "g"),
        d0=length(mechanism.d0_m, words),
        slv=length(mechanism.d_slv_m, words),
        slc=length(mechanism.d_slc_m, words),
        drops=words("alt_drops", places=drops) if drops else "",
        demands=words("alt_demands", demands="; ".join(demands)) if demands else "",
    )


def _words_of_runs(runs: FacadeRuns, words: Language) -> str:
    """Return what the bars show."""
    mean = runs.mean_m
    if mean is None:
        text = words["alt_no_mean"]
    else:
        known = words["beyond_all"] if math.isinf(mean) else length(mean, words)
        text = words("alt_mean", mean=known)
    return words(
        "alt_runs",
        records=len(runs.records),
        signs=len(runs.directions),
        beyond=len(runs.beyond),
        mean=text,
    )
