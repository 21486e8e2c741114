"""Plots of steady states: orbits, regions and response curves."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.steady.regions import RegionMap
from rocksteady.dynamics.steady.response import ResponseCurve
from rocksteady.dynamics.steady.states import SteadyOrbit
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import non_negative, positive, whole_number
from rocksteady.show.style import palette
from rocksteady.show.style.layout import (
    axes_or_new,
    emptiest_corner,
    extent,
    region_centres,
    spaced_by_ratio,
)
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, text_size
from rocksteady.show.style.line_colours import LIGHT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOGARITHMIC_SPAN = 30.0
"""Factor between the ends of an amplitude or peak axis from which on it is logarithmic."""


@checked
def plot_steady_orbit(
    orbit: SteadyOrbit, ax: "Axes | None" = None, *, label: str = "", series: int = 0
) -> "Axes":
    """Draw one period of a symmetric steady state.

    Parameters
    ----------
    orbit
        From `rocksteady.orbits.compute_steady_orbit`.
    ax
        Axes to draw on; default: axes of a new figure.
    label
        For a legend, which the caller makes when every orbit is drawn.
    series
        0, 1, 2, ...: which colour and dash of the palette.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: time since impact in forcing periods, u = theta/alpha.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.orbits import compute_steady_orbit
    >>> axes = Figure().add_subplot()
    >>> for branch in (1, 2):
    ...     orbit = compute_steady_orbit(0.75, 4.0, 0.5, branch=branch)
    ...     axes = plot_steady_orbit(orbit, axes, label=f"branch {branch}", series=branch - 1)
    >>> print(len(axes.lines), axes.get_xlim()[1])
    2 1.0
    """
    series = whole_number("series", series, at_least=0, hint="give 0, 1, 2, ...")
    axes = axes_or_new(ax)
    axes.plot(
        orbit.tau / (2.0 * math.pi),
        orbit.angle,
        color=inks_of(axes).lines[series % len(palette.LINES)],
        ls=palette.DASHES[series % len(palette.DASHES)],
        label=label,
    )
    axes.set(
        xlabel=palette.LABELS["half_cycle"],
        ylabel=palette.LABELS["angle"],
        xlim=(0.0, float(orbit.tau[-1]) / (2.0 * math.pi)),
    )
    return axes


@checked
def plot_steady_regions(
    curves: RegionMap,
    ax: "Axes | None" = None,
    *,
    point: tuple[float, float] | None = None,
    top: float | None = None,
    key: Literal["inside", "beside"] = "inside",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the regions of symmetric steady states with their boundaries (Figs 3 and 4).

    The frequency axis is logarithmic where the map's frequencies are spaced by ratio, as
    `numpy.geomspace` does; the amplitude axis where `top` is above 30.

    Parameters
    ----------
    curves
        From `rocksteady.orbits.compute_region_map`.
    ax
        Axes to draw on; default: axes of a new figure.
    point
        A (frequency_ratio, amplitude) to mark.
    top
        Upper end of the amplitude axis, A = a_max/(alpha g); default 6, or above the point.
    key
        Where the legend goes by default: inside the axes, in the emptiest corner, or to their
        right; below narrow ones.
    legend
        "inside" the axes, to their "right", "below" them or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: Omega = omega/p, A = a_max/(alpha g).

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.orbits import compute_region_map
    >>> curves = compute_region_map(np.linspace(0.1, 14.0, 300), 0.5)
    >>> axes = plot_steady_regions(curves, Figure().add_subplot(), point=(4.0, 2.0))
    >>> print(axes.get_ylim()[1], [number.get_text() for number in axes.texts])
    6.0 ['1', '2', '4']
    """
    from matplotlib.patheffects import withStroke

    top = None if top is None else positive("top", top, hint="give where the axis ends")
    axes = axes_or_new(ax)
    default: LegendPlace = "inside" if key == "inside" else "right"
    place = place_of(axes, legend, default, width=125.0)
    w = curves.frequency_ratio
    ceiling = top if top is not None else max(6.0, 1.3 * point[1] if point is not None else 0.0)
    floor = 0.0
    if ceiling > LOGARITHMIC_SPAN:
        axes.set_yscale("log")
        floor = 0.3 * max(float(curves.existence.min()), 1e-6 * ceiling)
    if spaced_by_ratio(w):
        axes.set_xscale("log")
    ends = [float(w[0]), float(w[-1])]
    if point is not None:
        point = (
            positive("point", point[0], hint="give (frequency ratio, amplitude)"),
            non_negative("point", point[1], hint="give (frequency ratio, amplitude)"),
        )
        ends = [min(ends[0], point[0]), max(ends[1], point[0])]
    axes.set(
        xlabel=palette.LABELS["frequency_ratio"],
        ylabel=palette.LABELS["amplitude"],
        xlim=ends,
        ylim=(floor, ceiling),
    )
    sky = np.full(w.shape, ceiling)
    low, high = np.minimum(curves.kind, curves.sign), np.maximum(curves.kind, curves.sign)
    fills = palette.REGION_FILLS
    axes.fill_between(w, floor, curves.existence, color=fills[4], lw=0)
    axes.fill_between(w, curves.existence, low, color=fills[3], lw=0)
    axes.fill_between(w, low, high, where=curves.sign >= curves.kind, color=fills[1], lw=0)
    axes.fill_between(w, low, high, where=curves.sign < curves.kind, color=fills[5], lw=0)
    axes.fill_between(w, high, np.maximum(sky, high), color=fills[2], lw=0)
    lines = (
        (curves.existence, "existence (23)", "-", palette.INK),
        (curves.kind, "kind (25)", (0, (6, 2)), palette.INK),
        (curves.sign, "sign (24)", (0, (1, 1.2)), palette.INK),
        (curves.symmetry_breaking, "symmetry breaking", "-", palette.LINES[1]),
        (curves.heteroclinic, "heteroclinic", (0, (4, 1.5, 1, 1.5)), palette.LINES[3]),
    )
    for values, label, dash, colour in lines:
        axes.plot(w, values, color=colour, ls=dash, lw=1.2, label=label)
    seen = [np.tile(w, len(lines)), np.concatenate([values for values, *_ in lines])]
    if point is not None:
        axes.plot(
            *point, "o", ms=7, color=palette.LINES[0], mec="white", mew=1.2, zorder=5, clip_on=False
        )
        # The point outweighs every curve.
        seen = [
            np.append(values, np.full(seen[0].size, x))
            for values, x in zip(seen, point, strict=True)
        ]
    size = extent(axes, width=125.0, height=72.0)
    corner = emptiest_corner(axes, seen, size)
    taken = (corner, size) if place == "inside" else None
    drawn = draw_legend(axes, place, corner=corner)
    if drawn is not None:  # whose lines are those on the light fills
        drawn.get_frame().set(facecolor=LIGHT.paper, alpha=0.85, visible=True)
        for text in drawn.get_texts():
            text.set_color(LIGHT.ink)
    for region, where in region_centres(curves, ceiling, floor, taken=taken, point=point).items():
        axes.annotate(
            str(region),
            where,
            ha="center",
            va="center",
            fontsize=9.5,
            color=palette.NUMBER,
            path_effects=[withStroke(linewidth=2.5, foreground="white")],
            zorder=4.0,
        )
    return axes


@checked
def plot_response(
    curves: ResponseCurve | Sequence[ResponseCurve],
    ax: "Axes | None" = None,
    *,
    hertz: bool = False,
    labels: Sequence[str] | None = None,
    top: float | None = None,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw peaks against frequency, solid where stable and dashed where unstable (Figs 5 to 7).

    The peak axis is logarithmic where peaks span more than a factor of 30, the frequency axis where
    frequencies are spaced by ratio, as `numpy.geomspace` does.

    Parameters
    ----------
    curves
        One or several of `rocksteady.compute_response_curve`.
    ax
        Axes to draw on; default: axes of a new figure.
    hertz
        Whether the abscissa is in Hz, for curves of a `rocksteady.Block`.
    labels
        Legend entries, one per curve; by default amplitude and, where they differ, order and
        branch.
    top
        Upper end of a linear peak axis; default: everything is shown, with room for the legend.
    legend
        "inside" the axes, to their "right", "below" them or "none"; inside by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: Omega = omega/p or Hz, and the peak of |theta|/alpha.

    Raises
    ------
    InputError
        If the legend has no such place.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, compute_response_curve
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> w = np.linspace(1.0, 8.0, 100)
    >>> curves = [compute_response_curve(block, a, frequency_ratio=w) for a in (1.0, 2.0)]
    >>> axes = plot_response(curves, Figure().add_subplot())
    >>> print(axes.get_yscale(), [entry.get_text() for entry in axes.get_legend().get_texts()])
    log ['A = 1', 'A = 2']
    """
    if isinstance(curves, ResponseCurve):
        curves = [curves]
    if not curves:
        raise InputError(
            "curves",
            curves,
            "there must be one or more",
            "give what compute_response_curve(...) returns, in a list",
        )
    top = _checked_top(top, labels, len(curves))
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    columns = 1 if len(curves) < 4 else 2
    place = place_of(axes, legend, "inside", width=90.0 * columns)
    mixed = len({(curve.branch, int(curve.states.order.flat[0])) for curve in curves}) > 1
    peaks = np.concatenate([curve.peak for curve in curves])
    peaks = peaks[peaks > 0.0]
    highest = float(peaks.max()) if peaks.size else 1.0
    abscissas = []
    for number, curve in enumerate(curves):
        x = (
            curve.frequency_hz
            if hertz and curve.frequency_hz is not None
            else curve.frequency_ratio
        )
        abscissas.append(x)
        label = f"A = {float(curve.states.amplitude.flat[0]):g}"
        if labels is not None:
            label = labels[number]
        elif mixed:
            order = int(curve.states.order.flat[0])
            label += f", n = {order}, branch {curve.branch}"
        _draw_response(axes, x, curve, number, label)
    ends = np.concatenate(abscissas)
    if spaced_by_ratio(ends):
        axes.set_xscale("log")
    balance = highest > 0.6 and (top is None or top > 1.0)
    lowest = float(peaks.min()) if peaks.size else highest
    highest = max(highest, 1.0) if balance else highest
    # Above the curves and the line there is room for the legend.
    rows = 1 + math.ceil(len(curves) / columns)
    part = min(0.6, extent(axes, width=1.0, height=12.0 * rows + 18.0)[1])
    part = part if place == "inside" else 0.05
    if top is not None:
        axes.set_ylim(0.0, top)
    elif highest > LOGARITHMIC_SPAN * lowest:
        span = highest / lowest
        axes.set_yscale("log")
        axes.set_ylim(lowest / span**0.05, highest * span ** (part / (1.0 - part)))
    else:
        axes.set_ylim(0.0, highest / (1.0 - part))
    if balance:
        axes.axhline(1.0, color=inks.faint, lw=0.8, zorder=1.0)
        axes.annotate(
            r"$|\theta| = \alpha$",
            (1.0, 1.0),
            (-2.0, 2.0),
            xycoords=axes.get_yaxis_transform(),
            textcoords="offset points",
            ha="right",
            va="bottom",
            fontsize=text_size(axes, 8.0),
            color=inks.number,
        )
    axes.set(
        xlabel=palette.LABELS["frequency_hz" if hertz else "frequency_ratio"],
        ylabel=palette.LABELS["peak"],
    )
    if ends.min() < ends.max():
        axes.set_xlim(float(ends.min()), float(ends.max()))
    draw_legend(
        axes,
        place,
        corner="upper right",
        columns=columns,
        title="solid: stable, dashed: unstable",
    )
    return axes


def _draw_response(
    axes: "Axes", x: NDArray[np.float64], curve: ResponseCurve, number: int, label: str
) -> None:
    """Draw a response curve; more of them than there are colours have marks too."""
    lines = inks_of(axes).lines
    again, colour = divmod(number, len(lines))
    marks: dict[str, Any] = {}
    if again:
        every = max(1, len(x) // 12)
        mark = palette.MARKS[(again - 1) % len(palette.MARKS)]
        marks = {"marker": mark, "ms": 3.5, "markevery": (number % every, every)}
    unstable = ~curve.stable
    touching = unstable.copy()  # one sample beyond either end, so that no gap is left
    touching[1:] |= unstable[:-1]
    touching[:-1] |= unstable[1:]
    stable = np.where(curve.stable, curve.peak, math.nan)
    axes.plot(x, stable, color=lines[colour], label=label, **marks)
    dashed = np.where(touching, curve.peak, math.nan)
    axes.plot(x, dashed, color=lines[colour], ls=(0, (3, 2)), lw=1.0, **marks)


def _checked_top(top: float | None, labels: Sequence[str] | None, curves: int) -> float | None:
    """Return where the axis ends, and refuse labels that are not one for each curve."""
    if labels is not None and len(labels) != curves:
        raise InputError(
            "labels",
            labels,
            f"there must be one for each of the {curves} curves",
            "give a list of texts, or leave them out",
        )
    return None if top is None else positive("top", top, hint="give where the axis ends")
