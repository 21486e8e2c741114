"""Complete figures of single results, as the command line saves them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocksteady.show.style import palette
from rocksteady.show.style.legends import draw_legend
from rocksteady.show.style.page import SCREEN, Page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rocksteady.dynamics.basins.basins import Basins
    from rocksteady.dynamics.basins.erosion import Erosion, IntegrityDrop
    from rocksteady.dynamics.basins.fate_basins import FateBasins
    from rocksteady.dynamics.basins.over.shares import BasinShares
    from rocksteady.dynamics.continuation.curves.bifurcation_curves import BifurcationCurves
    from rocksteady.dynamics.continuation.diagram import BifurcationDiagram
    from rocksteady.dynamics.edges.edge_state import EdgeState
    from rocksteady.dynamics.edges.manifold import Manifold
    from rocksteady.dynamics.history.trajectory import Trajectory
    from rocksteady.dynamics.orbits.orbit import Orbit
    from rocksteady.dynamics.overturning.kicks import FatalKicks
    from rocksteady.dynamics.overturning.windows import OverturningWindows
    from rocksteady.dynamics.steady.regions import RegionMap
    from rocksteady.dynamics.steady.response import ResponseCurve
    from rocksteady.dynamics.steady.states import SteadyOrbit
    from rocksteady.model.facts import AnyBlock
    from rocksteady.seismic.measures.response_spectrum import ResponseSpectrum
    from rocksteady.seismic.measures.time_course import IntegratedRecord
    from rocksteady.seismic.spectra.overturning_scales import OverturningScales
    from rocksteady.show.plots.records import Quantity

NO_MOTION = "no periodic motion found"


def simulation_figure(trajectory: "Trajectory", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of a time history, its base motion and its phase portrait."""
    with page.figure(9.6, 4.4, title, stacked=1.5) as figure:
        panels = _panels_of_motion(figure, page.stacks(9.6), (2.3, 1.0))
        _draw_motion(trajectory, panels, page, mark="start")
    return figure


def orbit_figure(
    orbit: "Orbit", course: "Trajectory", title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of one period of an orbit: history, base, phase portrait and multipliers.

    Parameters
    ----------
    orbit
        The periodic motion.
    course
        One period of it.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    from rocksteady.show.plots.orbits import plot_multipliers

    with page.figure(11.6, 4.2, title, stacked=2.2) as figure:
        panels = _panels_of_motion(figure, page.stacks(11.6), (1.25, 0.9, 1.0))
        _draw_motion(course, panels, page, mark="impacts")
        plot_multipliers([orbit], panels[-1], legend=page.legend)
    return figure


def cloud_figure(
    whole: "Trajectory", part: "Trajectory", *, since: float, title: str = "", page: Page = SCREEN
) -> "Figure":
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
    page
        Width of the figure, and place of its legends.
    """
    from rocksteady.show.plots.orbits import plot_poincare_section

    with page.figure(11.6, 4.2, title, stacked=2.2) as figure:
        panels = _panels_of_motion(figure, page.stacks(11.6), (1.25, 0.9, 1.0))
        _draw_motion(part, panels, page, mark="impacts")
        plot_poincare_section(whole, panels[-1], since=since, legend=page.legend)
    return figure


def orbits_figure(orbits: "Sequence[Orbit]", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of orbits: their Poincare section beside their multipliers."""
    from rocksteady.show.plots.orbits import plot_multipliers, plot_poincare_section

    with page.figure(10.4, 4.8, title, stacked=1.75) as figure:
        if page.stacks(10.4):
            section, plane = figure.subplots(2, 1, height_ratios=(1.0, 1.2))
        else:
            section, plane = figure.subplots(1, 2, width_ratios=(1.3, 1.0))
        plot_poincare_section(orbits, section, legend=page.legend)
        plot_multipliers(orbits, plane, legend=page.legend)
        if not any(orbit.admissible for orbit in orbits):
            _write_across(section, NO_MOTION)
    return figure


def _panels_of_motion(figure: "Figure", stacked: bool, shape: Sequence[float]) -> "list[Axes]":
    """Return axes of a time history above its base, and of what stands beside or below them.

    Parameters
    ----------
    figure
        Figure of the axes.
    stacked
        Whether all stand one above the other.
    shape
        Widths of the columns, where they do not.
    """
    if stacked:
        grid = figure.add_gridspec(len(shape) + 1, 1, height_ratios=(1.0, 0.5, *shape[1:]))
        places = [grid[k, 0] for k in range(len(shape) + 1)]
    else:
        grid = figure.add_gridspec(2, len(shape), width_ratios=shape, height_ratios=(3.0, 1.0))
        places = [grid[0, 0], grid[1, 0], *(grid[:, k] for k in range(1, len(shape)))]
    history = figure.add_subplot(places[0])
    base = figure.add_subplot(places[1], sharex=history)
    return [history, base, *map(figure.add_subplot, places[2:])]


def _draw_motion(
    course: "Trajectory",
    panels: "Sequence[Axes]",
    page: Page,
    *,
    mark: Literal["start", "impacts"],
) -> None:
    """Draw a time history above its base motion, which share the time axis, and its portrait."""
    from rocksteady.show.plots.motion import plot_base, plot_phase_portrait, plot_trajectory

    history, base, portrait = panels[:3]
    plot_trajectory(course, history, legend=page.legend)
    history.set_xlabel("")
    history.tick_params(labelbottom=False)
    plot_base(course, base, legend=page.legend)
    plot_phase_portrait(course, portrait, mark=mark, legend=page.legend)
    portrait.locator_params(axis="x", nbins=5)


def steady_figure(
    orbits: "Sequence[tuple[str, SteadyOrbit]]",
    curves: "RegionMap",
    *,
    point: tuple[float, float],
    block: "AnyBlock | None" = None,
    title: str = "",
    page: Page = SCREEN,
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
    block
        The block in whose units everything is drawn, if it has a known size.
    title
        Above both panels.
    page
        Width of the figure, and place of its legends.
    """
    from rocksteady.show.plots.steady import LOGARITHMIC_SPAN, draw_orbit, draw_regions
    from rocksteady.show.style.tokens import inks_of

    with page.figure(9.6, 4.4, title, stacked=1.75) as figure:
        motion, base, plane = _panels_of_motion(figure, page.stacks(9.6), (1.0, 1.0))
        motion.axhline(0.0, color=inks_of(motion).edge, lw=0.7)
        for number, (label, orbit) in enumerate(orbits):
            draw_orbit(motion, orbit, label=label, series=number, block=block)
            draw_orbit(base, orbit, label=label, series=number, block=block, base=True)
        if orbits:
            drawn = draw_legend(motion, page.legend or "inside", corner="lower left")
            if drawn is not None and page.legend is None:
                # Above the axes, and clear of the tick labels' common power of ten at their left.
                drawn.set_bbox_to_anchor((0.1, 1.0), motion.transAxes)
        else:
            _write_across(motion, "no symmetric steady state here")
            motion.set_ylabel(palette.LABELS["angle"])
            base.set(xlabel=palette.LABELS["half_cycle"], ylabel=palette.LABELS["base"])
        motion.set_xlabel("")
        motion.tick_params(labelbottom=False)
        # The curves level out; above twice the sign boundary's level there is only region 2.
        top = max(2.2 * float(np.median(curves.sign)), 1.4 * point[1])
        if top > LOGARITHMIC_SPAN:
            top *= 20.0
        place = page.legend or ("below" if page.stacks(9.6) else "inside")
        draw_regions(plane, curves, place, point=point, top=top, block=block)
    return figure


def response_figure(
    curves: "Sequence[ResponseCurve]", *, hertz: bool = False, title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of response curves."""
    from rocksteady.show.plots.steady import plot_response

    return page.panel(7.2, 4.4, title, plot_response, curves, hertz=hertz)


def basins_figure(basins: "Basins", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of basins of attraction."""
    from rocksteady.show.plots.portraits.basins import plot_basins

    return page.panel(7.6, 4.8, title, plot_basins, basins)


def edge_figure(
    edge: "EdgeState", manifolds: "Sequence[Manifold]" = (), title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of an edge state, and of the manifolds of its saddle where given."""
    from rocksteady.show.plots.portraits.edges import plot_edge_state
    from rocksteady.show.plots.portraits.manifolds import plot_manifolds

    with page.figure(7.0, 5.2, title) as figure:
        axes = figure.add_subplot()
        if manifolds:
            plot_manifolds(manifolds, axes, legend="none")
        plot_edge_state(edge, axes, legend=page.legend)
    return figure


def shares_figure(shares: "BasinShares", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of the shares of basins over a parameter."""
    from rocksteady.show.plots.portraits.shares import plot_basin_shares

    return page.panel(7.6, 4.4, title, plot_basin_shares, shares)


def fate_basins_figure(fates: "FateBasins", title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of the fates over a window of initial states."""
    from rocksteady.show.plots.portraits.fate_basins import plot_fate_basins

    return page.panel(7.6, 4.8, title, plot_fate_basins, fates)


def erosion_figure(
    erosion: "Erosion", drops: "Sequence[IntegrityDrop]" = (), title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of the measures of integrity, and of up to three safe basins below them.

    These are the last before the heteroclinic tangency (of the nonlinear model the first of all),
    the first after the first drop, and the last of all; one where two of them are the same.
    """
    from rocksteady.show.plots.portraits.basins import plot_erosion, plot_safe_basin

    last = len(erosion.amplitude) - 1
    tangency = erosion.heteroclinic
    before = 0 if tangency is None else int((erosion.amplitude <= tangency).sum()) - 1
    fallen = [int((erosion.amplitude < drop.high).sum()) for drop in drops]
    shown = sorted({max(before, 0), min([*fallen, last]), last})
    with page.figure(8.4, 6.4, title, stacked=1.05) as figure:
        grid = figure.add_gridspec(2, len(shown), height_ratios=(1.25, 1.0))
        plot_erosion(erosion, figure.add_subplot(grid[0, :]), drops=drops, legend=page.legend)
        for column, index in enumerate(shown):
            axes = plot_safe_basin(erosion, index, figure.add_subplot(grid[1, column]))
            axes.locator_params(axis="x", nbins=3 if page.stacks(8.4) else 5)
            if column:
                axes.set_ylabel("")
                axes.tick_params(labelleft=False)
    return figure


def overturning_figure(
    windows: "OverturningWindows", title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of an overturning spectrum."""
    from rocksteady.show.plots.overturning import plot_overturning

    return page.panel(8.0, 4.6, title, plot_overturning, windows)


def fatal_figure(
    result: "OverturningScales | FatalKicks", title: str = "", page: Page = SCREEN
) -> "Figure":
    """Return a figure of the scales of records, or of the kicks, that overturn a block."""
    from rocksteady.seismic.spectra.overturning_scales import OverturningScales
    from rocksteady.show.plots.overturning_scales import plot_fatal_kicks, plot_overturning_scales

    height = 2.0 + 0.3 * len(result.names) if isinstance(result, OverturningScales) else 3.8
    with page.figure(8.0, height, title) as figure:
        axes = figure.add_subplot()
        if isinstance(result, OverturningScales):
            plot_overturning_scales(result, axes, legend=page.legend)
        else:
            plot_fatal_kicks(result, axes, legend=page.legend)
    return figure


def bifurcation_figure(
    diagram: "BifurcationDiagram",
    *,
    top: float | None = None,
    title: str = "",
    page: Page = SCREEN,
) -> "Figure":
    """Return a figure of branches over a parameter, with sweeps beneath them."""
    from rocksteady.show.plots.branches.bifurcations import plot_bifurcations

    with page.figure(8.8, 4.8, title or diagram.describe().headline) as figure:
        axes = figure.add_subplot()
        if diagram.branches or diagram.sweeps:
            plot_bifurcations(diagram, ax=axes, top=top, legend=page.legend)
        else:
            parameter = diagram.parameter
            axes.set(xlabel=palette.LABELS[parameter], ylabel=palette.LABELS["flight_peak"])
            _write_across(axes, NO_MOTION)
    return figure


def curves_figure(curves: "BifurcationCurves", *, title: str = "", page: Page = SCREEN) -> "Figure":
    """Return a figure of the bifurcation curves of a plane."""
    from rocksteady.show.plots.branches.curves import plot_bifurcation_curves

    with page.figure(8.0, 5.4, title or curves.describe().headline) as figure:
        axes = figure.add_subplot()
        plot_bifurcation_curves(curves, axes, legend=page.legend)
        if not curves.curves:
            _write_across(axes, "no bifurcation found")
    return figure


def record_figure(
    courses: "Sequence[IntegratedRecord]",
    spectra: "Sequence[ResponseSpectrum]",
    title: str = "",
    page: Page = SCREEN,
) -> "Figure":
    """Return a figure of a record: its course, Husid's curve and spectrum; of several, spectra.

    Parameters
    ----------
    courses, spectra
        One of each a record.
    title
        Above the panels.
    page
        Width of the figure, and place of its legends.
    """
    from rocksteady.show.plots.records import (
        plot_husid,
        plot_integrated_record,
        plot_response_spectra,
    )

    if len(courses) > 1:
        return page.panel(7.2, 4.8, title, plot_response_spectra, spectra)
    with page.figure(10.4, 5.6, title, stacked=2.2) as figure:
        if page.stacks(10.4):
            grid = figure.add_gridspec(5, 1, height_ratios=(1.0, 1.0, 1.0, 1.4, 1.6))
            rows = [figure.add_subplot(grid[k]) for k in range(5)]
        else:
            outer = figure.add_gridspec(1, 2, width_ratios=(1.7, 1.0))
            left, right = outer[0].subgridspec(3, 1), outer[1].subgridspec(2, 1)
            places = [*(left[k] for k in range(3)), right[0], right[1]]
            rows = [figure.add_subplot(place) for place in places]
        quantities: tuple[Quantity, ...] = ("acceleration", "velocity", "displacement")
        for axes, quantity in zip(rows, quantities, strict=False):
            plot_integrated_record(courses[0], axes, quantity=quantity)
        for axes in rows[:2]:
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
        figure.align_ylabels(rows[:3])
        plot_husid(courses[0], rows[3])
        plot_response_spectra(spectra, rows[4])
    return figure


def _write_across(axes: "Axes", words: str) -> None:
    """Write in the middle of axes that nothing is drawn on."""
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center")
