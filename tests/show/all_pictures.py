"""Every picture that is recorded: whole figures, each public plot, films and blocks alone."""

import contextlib
import tempfile
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.histories import Trajectory
from rocksteady.show.figures.facades import facade_figure
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
from rocksteady.show.style.page import Page
from tests.public.calls import calls
from tests.public.things import things
from tests.show.drawn_figures import BARE, BLOCK, makers, rocking, vertical_too

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
PAGES = {"": Page(), ", 84 mm": Page(width_mm=84.0)}
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
FRAMES = (0.0, 0.3, 0.8, 1.0)
"""Frames of films, as shares of their number."""


@cache
def room() -> Path:
    """Return the folder with the files of things, which are made there."""
    folder = Path(tempfile.mkdtemp(prefix="things-"))
    with contextlib.chdir(folder):
        things()
        calls()
    return folder


def figures() -> dict[str, Callable[..., Figure]]:
    """Return what draws every kind of whole figure for a page."""
    with contextlib.chdir(room()):
        of_things = {name: partial(draw, things()[name]) for name, draw in FIGURES.items()}
    return {**makers(), **of_things}


@cache
def pictures() -> dict[str, Callable[[], Figure]]:
    """Return what draws each picture, by its name."""
    found: dict[str, Callable[[], Figure]] = {
        f"{name}{width}": partial(draw, page=page)
        for name, draw in figures().items()
        for width, page in PAGES.items()
    }
    for label, call in calls().items():
        if label.startswith("plot_"):
            found[label] = partial(_of_axes, call.__call__)
    for name, block in BLOCKS.items():
        found[f"block {name}"] = partial(_of_axes, partial(rs.plots.block, block))
    for name, run in _runs().items():
        film = film_of(run)
        for share in FRAMES:
            found[f"film {name}, {share}"] = partial(_frame, film, share)
    return found


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
