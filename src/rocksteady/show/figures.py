"""Whole figures, as the command line saves them."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.basins import Basins
from rocksteady.dynamics.continuation.points import Branch
from rocksteady.dynamics.erosion import Drop, Erosion
from rocksteady.dynamics.orbit import Orbit
from rocksteady.dynamics.overturning.windows import OverturningWindows
from rocksteady.dynamics.regions import RegionMap
from rocksteady.dynamics.response import ResponseCurve
from rocksteady.dynamics.steady import SteadyOrbit
from rocksteady.dynamics.trail import AttractorTrail
from rocksteady.dynamics.trajectory import Trajectory
from rocksteady.seismic.ground_course import GroundCourse
from rocksteady.seismic.response_spectrum import ResponseSpectrum
from rocksteady.show import palette
from rocksteady.show.plots.basins import plot_basins, plot_erosion, plot_safe_basin
from rocksteady.show.plots.bifurcations import plot_bifurcations
from rocksteady.show.plots.motion import plot_base, plot_phase_portrait, plot_trajectory
from rocksteady.show.plots.orbits import plot_multipliers, plot_section
from rocksteady.show.plots.overturning import plot_overturning
from rocksteady.show.plots.records import (
    Quantity,
    plot_ground_course,
    plot_husid,
    plot_response_spectra,
)
from rocksteady.show.plots.steady import (
    LOGARITHMIC_SPAN,
    plot_orbit,
    plot_regions,
    plot_response,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def simulation_figure(trajectory: Trajectory, title: str = "") -> "Figure":
    """Return a figure of a time history, its base motion and its phase portrait."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(9.6, 4.4))
        grid = figure.add_gridspec(2, 2, width_ratios=(2.3, 1.0), height_ratios=(3.0, 1.0))
        history = figure.add_subplot(grid[0, 0])
        base = figure.add_subplot(grid[1, 0], sharex=history)
        portrait = figure.add_subplot(grid[:, 1])
        _draw_history(trajectory, history, base)
        plot_phase_portrait(trajectory, portrait)
        portrait.locator_params(axis="x", nbins=5)
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def orbit_figure(orbit: Orbit, course: Trajectory, title: str = "") -> "Figure":
    """Return a figure of one period of an orbit: history, base, phase portrait and multipliers.

    Parameters
    ----------
    orbit
        The periodic motion.
    course
        One period of it.
    title
        Above the panels.
    """
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(11.6, 4.2))
        grid = figure.add_gridspec(2, 3, width_ratios=(1.25, 0.9, 1.0), height_ratios=(3.0, 1.0))
        history = figure.add_subplot(grid[0, 0])
        base = figure.add_subplot(grid[1, 0], sharex=history)
        _draw_history(course, history, base)
        portrait = figure.add_subplot(grid[:, 1])
        plot_phase_portrait(course, portrait, mark="impacts")
        portrait.locator_params(axis="x", nbins=5)
        plot_multipliers([orbit], figure.add_subplot(grid[:, 2]))
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def cloud_figure(whole: Trajectory, part: Trajectory, *, since: float, title: str = "") -> "Figure":
    """Return a figure of a motion that does not repeat: a part of it, and the section it fills.

    Parameters
    ----------
    whole
        A long run.
    part
        What time history and phase portrait show.
    since
        Pivot time of the long run from which on its impacts are drawn.
    title
        Above the panels.
    """
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(11.6, 4.2))
        grid = figure.add_gridspec(2, 3, width_ratios=(1.25, 0.9, 1.0), height_ratios=(3.0, 1.0))
        history = figure.add_subplot(grid[0, 0])
        base = figure.add_subplot(grid[1, 0], sharex=history)
        _draw_history(part, history, base)
        portrait = figure.add_subplot(grid[:, 1])
        plot_phase_portrait(part, portrait, mark="impacts")
        portrait.locator_params(axis="x", nbins=5)
        plot_section(whole, figure.add_subplot(grid[:, 2]), since=since)
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def orbits_figure(orbits: Sequence[Orbit], title: str = "") -> "Figure":
    """Return a figure of orbits: their Poincare section beside their multipliers."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(10.4, 4.8))
        section, plane = figure.subplots(1, 2, width_ratios=(1.3, 1.0))
        plot_section(orbits, section)
        plot_multipliers(orbits, plane)
        if not any(orbit.admissible for orbit in orbits):
            section.text(
                0.5, 0.5, "no periodic motion found", transform=section.transAxes, ha="center"
            )
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def _draw_history(trajectory: Trajectory, history: "Axes", base: "Axes") -> None:
    """Draw a time history above its base motion, which share the time axis."""
    plot_trajectory(trajectory, history)
    history.set_xlabel("")
    history.tick_params(labelbottom=False)
    plot_base(trajectory, base)


def steady_figure(
    orbits: Sequence[tuple[str, SteadyOrbit]],
    curves: RegionMap,
    *,
    point: tuple[float, float],
    title: str = "",
) -> "Figure":
    """Return a figure of the steady states at a point beside the map in which it lies.

    Parameters
    ----------
    orbits
        Legend entry and period of each solution; may be empty.
    curves
        The map.
    point
        (frequency_ratio, amplitude).
    title
        Above both panels.
    """
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(9.6, 4.4))
        grid = figure.add_gridspec(2, 2, height_ratios=(3.0, 1.0))
        motion = figure.add_subplot(grid[0, 0])
        base = figure.add_subplot(grid[1, 0], sharex=motion)
        plane = figure.add_subplot(grid[:, 1])
        motion.axhline(0.0, color=palette.INK, lw=0.7)
        for number, (label, orbit) in enumerate(orbits):
            plot_orbit(orbit, motion, label=label, series=number)
            base.plot(
                orbit.tau / (2.0 * math.pi),
                orbit.excitation,
                color=palette.LINES[number],
                ls=palette.DASHES[number],
                lw=1.0,
            )
        if orbits:
            # Above the axes, and clear of the tick labels' common power of ten at their left end.
            motion.legend(loc="lower left", bbox_to_anchor=(0.1, 1.0), borderaxespad=0.2)
        else:
            motion.text(
                0.5, 0.5, "no symmetric steady state here", transform=motion.transAxes, ha="center"
            )
            motion.set_ylabel(palette.LABELS["angle"])
        motion.set_xlabel("")
        motion.tick_params(labelbottom=False)
        base.set(xlabel=palette.LABELS["half_cycle"], ylabel=palette.LABELS["base"])
        # The curves level out; above twice the sign boundary's level there is only region 2.
        top = max(2.2 * float(np.median(curves.sign)), 1.4 * point[1])
        if top > LOGARITHMIC_SPAN:
            top *= 20.0
        plot_regions(curves, plane, point=point, top=top)
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def response_figure(
    curves: Sequence[ResponseCurve], *, hertz: bool = False, title: str = ""
) -> "Figure":
    """Return a figure of response curves."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(7.2, 4.4))
        plot_response(curves, figure.add_subplot(), hertz=hertz)
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def basins_figure(basins: Basins, title: str = "") -> "Figure":
    """Return a figure of basins of attraction."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(7.6, 4.8))
        plot_basins(basins, figure.add_subplot())
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def erosion_figure(erosion: Erosion, drops: Sequence[Drop] = (), title: str = "") -> "Figure":
    """Return a figure of the measures of integrity, and of up to three safe basins below them.

    These are the last before the heteroclinic tangency (of the nonlinear model the first of all),
    the first after the first drop, and the last of all; one where two of them are the same.
    """
    from matplotlib.figure import Figure

    last = len(erosion.amplitude) - 1
    tangency = erosion.heteroclinic
    before = 0 if tangency is None else int((erosion.amplitude <= tangency).sum()) - 1
    fallen = [int((erosion.amplitude < drop.high).sum()) for drop in drops]
    shown = sorted({max(before, 0), min([*fallen, last]), last})
    with palette.style():
        figure = Figure(figsize=(8.4, 6.4))
        grid = figure.add_gridspec(2, len(shown), height_ratios=(1.25, 1.0))
        plot_erosion(erosion, figure.add_subplot(grid[0, :]), drops=drops)
        for column, index in enumerate(shown):
            axes = plot_safe_basin(erosion, index, figure.add_subplot(grid[1, column]))
            axes.locator_params(axis="x", nbins=5)
            if column:
                axes.set_ylabel("")
                axes.tick_params(labelleft=False)
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def overturning_figure(windows: OverturningWindows, title: str = "") -> "Figure":
    """Return a figure of an overturning spectrum."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(8.0, 4.6))
        plot_overturning(windows, figure.add_subplot())
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def bifurcation_figure(
    branches: Sequence[Branch],
    trails: Sequence[AttractorTrail],
    parameter: str,
    *,
    top: float | None = None,
    title: str = "",
) -> "Figure":
    """Return a figure of branches over a parameter, with sweeps beneath them."""
    from matplotlib.figure import Figure

    with palette.style():
        figure = Figure(figsize=(8.8, 4.8))
        axes = figure.add_subplot()
        if branches or trails:
            plot_bifurcations(branches, trails, axes, top=top)
        else:
            axes.set(xlabel=palette.LABELS[parameter], ylabel=palette.LABELS["flight_peak"])
            axes.text(0.5, 0.5, "no periodic motion found", transform=axes.transAxes, ha="center")
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def record_figure(
    courses: Sequence[GroundCourse], spectra: Sequence[ResponseSpectrum], title: str = ""
) -> "Figure":
    """Return a figure of a record: its course, Husid's curve and spectrum; of several, spectra.

    Parameters
    ----------
    courses, spectra
        One of each a record.
    title
        Above the panels.
    """
    from matplotlib.figure import Figure

    with palette.style():
        if len(courses) > 1:
            figure = Figure(figsize=(7.2, 4.8))
            plot_response_spectra(spectra, figure.add_subplot())
        else:
            figure = Figure(figsize=(10.4, 5.6))
            outer = figure.add_gridspec(1, 2, width_ratios=(1.7, 1.0))
            left, right = outer[0].subgridspec(3, 1), outer[1].subgridspec(2, 1)
            quantities: tuple[Quantity, ...] = ("acceleration", "velocity", "displacement")
            rows = [figure.add_subplot(left[k]) for k in range(3)]
            for axes, quantity in zip(rows, quantities, strict=True):
                plot_ground_course(courses[0], axes, quantity=quantity)
            for axes in rows[:2]:
                axes.set_xlabel("")
                axes.tick_params(labelbottom=False)
            figure.align_ylabels(rows)
            plot_husid(courses[0], figure.add_subplot(right[0]))
            plot_response_spectra(spectra, figure.add_subplot(right[1]))
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure
