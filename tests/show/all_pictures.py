"""Every picture that is recorded: whole figures, each public plot, blocks, films; and pages."""

import contextlib
import inspect
from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any, Literal, get_args, get_origin

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.facades._figures import facade_figure
from rocksteady.facades.page._facade_page import facade_html
from rocksteady.facades.plots.languages import language_of
from rocksteady.histories import Trajectory
from rocksteady.show.assessment.object_report import report_html
from rocksteady.show.calibration._calibration_report import calibration_html
from rocksteady.show.export.manifest import make_manifest
from rocksteady.show.figures.observations import (
    back_analysis_figure,
    calibration_figure,
    predictions_figure,
    restitution_figure,
)
from rocksteady.show.figures.single import (
    curves_figure,
    edge_figure,
    fatal_figure,
    fate_basins_figure,
)
from rocksteady.show.film.animation import Film, film_of
from rocksteady.show.style.legends import PLACES
from rocksteady.show.style.page import Page
from tests.facades.page.checked_facades import SUITE, alone, thin, tied
from tests.public.calls import Call, calls, room
from tests.public.things import things
from tests.show.assessment.pages import drawn_once
from tests.show.calibrated import calibrated, unscored
from tests.show.drawn_figures import BARE, BLOCK, makers, rocking, vertical_too
from tests.show.varied_pictures import varied

FIGURES: dict[str, Callable[..., Figure]] = {
    "calibration": calibration_figure,
    "back analysis": back_analysis_figure,
    "predictions": predictions_figure,
    "restitution_fit": restitution_figure,
    "facade check": facade_figure,
    "edge": edge_figure,
    "fates": fate_basins_figure,
    "curves": curves_figure,
    "scales": fatal_figure,
    "kicks": fatal_figure,
}
"""Whole figures of things."""
SIDES = rs.Block.asymmetric(left=0.15, right=0.25, height=1.2)
FRAME = rs.Block.frame(columns=4, cap_mass_ratio=2.0, width=0.4, height=1.2)
BY_WALL = rs.DimensionlessBlock(restitution=0.8, one_sided=True)
BLOCKS: dict[str, Any] = {
    "rectangle": BLOCK,
    "sides": SIDES,
    "frame": FRAME,
    "bare": BARE,
    "bare sides": rs.DimensionlessBlock(restitution=0.8, alpha_ratio=1.8, p_ratio=0.9),
    "by a wall": BY_WALL,
}
FRAMES = (0.0, 0.3, 1.0)
"""Frames of films, as shares of their number."""


def figures() -> dict[str, Callable[..., Figure]]:
    """Return what draws every kind of whole figure for a page."""
    with contextlib.chdir(room()):
        of_things = {name: partial(draw, things()[name]) for name, draw in FIGURES.items()}
    return {**makers(), **of_things}


@cache
def usual_pictures() -> dict[str, Callable[[], Figure]]:
    """Return what draws each kind of figure and each public plot once, by its name."""
    found: dict[str, Callable[[], Figure]] = {
        name: partial(draw, page=Page()) for name, draw in figures().items()
    }
    for label, call in calls().items():
        if label.startswith("plot_"):
            found[label] = partial(_of_axes, partial(_called, call))
    return found


@cache
def pictures() -> dict[str, Callable[[], Figure]]:
    """Return what draws each picture, by its name."""
    found = dict(usual_pictures())
    for name, draw in figures().items():
        found[f"{name}, 84 mm"] = partial(draw, page=Page(width_mm=84.0))
    plots = [(label, call) for label, call in calls().items() if label.startswith("plot_")]
    for k, (label, call) in enumerate(plots):
        for option, value in _others(call, PLACES[k % len(PLACES)]):
            changed = partial(_called, call, **{option: value})
            found[f"{label}, {option} {value}"] = partial(_of_axes, changed)
    for name, block in BLOCKS.items():
        found[f"block {name}"] = partial(_of_axes, partial(rs.plots.block, block))
    with contextlib.chdir(room()):
        found |= {name: partial(_of_axes, draw) for name, draw in varied().items()}
    for name, run in _runs().items():
        film = film_of(run)
        for share in FRAMES:
            found[f"film {name}, {share}"] = partial(_frame, film, share)
    return found


def _called(call: Call, **changed: Any) -> Any:
    """Return the axes of a call; those of another place of the legend are small."""
    if "legend" in changed:
        changed["ax"] = Figure(figsize=(3.3, 2.4), layout="constrained").add_subplot()
    return call(**changed)


def _others(call: Call, place: str) -> Iterator[tuple[str, Any]]:
    """Yield other choices of the options of a call, and one place of its legend."""
    plot = inspect.unwrap(call.function)
    for name, parameter in inspect.signature(plot).parameters.items():
        if name == "legend":
            yield name, place
        elif isinstance(parameter.default, bool):
            yield name, not parameter.default
        elif name == "language":
            yield name, "it"
        elif get_origin(parameter.annotation) is Literal:
            taken = call.arguments.get(name, parameter.default)
            yield from ((name, value) for value in get_args(parameter.annotation) if value != taken)


def _runs() -> dict[str, Trajectory]:
    """Return runs to film."""
    strong = rs.Harmonic(amplitude=2.0, frequency_ratio=1.7)
    tilted = rs.State(angle=0.8, velocity=0.0)
    return {
        "bare": rocking(),
        "vertical": vertical_too(),
        "falling": rs.simulate(BLOCK, strong, start=rs.Steady(), cycles=40),
        "free": rs.simulate(FRAME, rs.Still(), start=tilted),
        "sides": rs.simulate(SIDES, rs.Pulse(shape="ricker", amplitude=2.5, frequency_ratio=3.0)),
        "by a wall": rs.simulate(BY_WALL, strong, cycles=4),
    }


def _of_axes(draw: Callable[..., Any]) -> Figure:
    """Return the figure of axes that a call returns."""
    with contextlib.chdir(room()):
        figure: Figure = draw().get_figure(root=True)
    plt.close("all")
    return figure


def _frame(film: Film, share: float) -> Figure:
    """Return the figure of a film at one of its frames."""
    film.show(round(share * (film.frames - 1)))
    return film.figure


@cache
def pages() -> dict[str, Callable[[], str]]:
    """Return what writes each page of a report, by its name."""
    with contextlib.chdir(room()):
        t = things()
    found: dict[str, Callable[..., str]] = {}
    for name in ("assessment", "assessed runs", "objects", "on floors"):
        found[name] = partial(report_html, t[name])
    for name, make in {"usual": calibrated, "unscored": unscored}.items():
        found[f"calibration {name}"] = partial(calibration_html, make())
    for name, check in {"tied": tied, "thin": thin, "alone": alone}.items():
        found[f"facade {name}"] = partial(facade_html, check(), words=language_of("en"))
    found["facade tied, it"] = partial(facade_html, tied(), words=language_of("it"))
    return {f"page {name}": partial(_page, write) for name, write in found.items()}


def _page(write: Callable[..., str]) -> str:
    """Return a page, each of its pictures drawn once."""
    with drawn_once():
        return write(manifest=make_manifest(SUITE, command="rocksteady"))
