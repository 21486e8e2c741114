"""Plots of steady states: orbits, regions and response curves."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.steady.regions import RegionBoundaries, RegionMap
from rocksteady.dynamics.steady.response import ResponseCurve
from rocksteady.dynamics.steady.states import SteadyOrbit
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import non_negative, positive, whole_number
from rocksteady.show.export.components import text_value
from rocksteady.show.plots.branches.curve_labels import Words, explain, limit_entries
from rocksteady.show.plots.branches.curves import CURVES
from rocksteady.show.plots.branches.views import AnyBlock, shared_size
from rocksteady.show.style import palette
from rocksteady.show.style.layout import (
    CORNERS,
    LEAST_ROOM,
    axes_or_new,
    extent,
    region_centres,
    spaced_by_ratio,
)
from rocksteady.show.style.legends import (
    LETTER,
    LegendPlace,
    draw_legend,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.scales import Scale, draw_far_axes, fits_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, DOTTED, MARKS, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

LOGARITHMIC_SPAN = 30.0
"""Factor between the ends of an amplitude or peak axis from which on it is logarithmic."""
MOST_NAMED = 6
"""Response curves up to which each has its name on its line."""
LONGEST_NAME = 0.3
"""Longest name at the end of a line, in parts of the width of the axes."""
SHADES = 3
"""Lightness steps of orbits, in turn."""
BOUNDARIES: dict[str, tuple[str, Any]] = {
    "existence": ("existence (23)", CURVES[PointType.FOLD]),
    "kind": ("kind (25)", (0, (5, 2.5))),
    "sign": ("sign (24)", CURVES[PointType.GRAZING]),
    "symmetry_breaking": ("symmetry breaking", CURVES[PointType.SYMMETRY_BREAKING]),
    "heteroclinic": ("heteroclinic", (0, (7, 2, 1.2, 2, 1.2, 2))),
}
"""Name, with its equation in docs/theory/steady.md, and dashes of each boundary."""
KEY = (170.0, 60.0)
"""Width and height of the legend of the regions [points]."""
SOLUTIONS = (
    ("two symmetric motions", (1, 3)),
    ("one symmetric motion", (2, 5)),
    ("no symmetric motion", (4,)),
)
"""What there is in the regions, by their numbers."""


@checked
def plot_steady_orbit(
    orbit: SteadyOrbit, ax: "Axes | None" = None, *, label: str = "", series: int = 0
) -> "Axes":
    """Draw one period of a symmetric steady state: dashed if unstable, dotted if no motion.

    Parameters
    ----------
    orbit
        From `rocksteady.orbits.compute_steady_orbit`.
    ax
        Axes to draw on; default: axes of a new figure.
    label
        For a legend, which the caller makes when every orbit is drawn.
    series
        0, 1, 2, ...: which lightness of the colour of motion, three of them in turn.

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
    label = text_value("label", label)
    series = whole_number("series", series, at_least=0, hint="give 0, 1, 2, ...")
    axes = axes_or_new(ax)
    draw_orbit(axes, orbit, label=label, series=series)
    return axes


def draw_orbit(
    axes: "Axes",
    orbit: SteadyOrbit,
    *,
    label: str,
    series: int,
    block: AnyBlock | None = None,
    base: bool = False,
) -> None:
    """Draw the angle over a period, or the acceleration of the base, in the units of a block."""
    role = "base" if base else "motion"
    up = scale_of("amplitude" if base else "angle", block)
    if base:
        up = up._replace(label=palette.LABELS["base_g" if up.far else "base"])
    across = Scale(0.5 / math.pi, palette.LABELS["half_cycle"])
    if block is not None:
        seconds = scale_of("pt", block).factor / orbit.frequency_ratio
        across = Scale(seconds, palette.LABELS["half_cycle_s"])
    looks: dict[str, Any] = {"stable": "-", "neutral": "-", "inadmissible": DOTTED}
    axes.plot(
        across.factor * orbit.tau,
        up.factor * (orbit.excitation if base else orbit.angle),
        color=inks_of(axes).series(role, SHADES)[2 * series % SHADES],
        ls=looks.get(orbit.verdict, DASHED),
        lw=1.0 if base else None,
        label=label,
    )
    end = across.factor * float(orbit.tau[-1])
    axes.set(xlabel=across.label, ylabel=up.label, xlim=(0.0, end))


@checked
def plot_steady_regions(
    curves: RegionMap | RegionBoundaries,
    ax: "Axes | None" = None,
    *,
    point: tuple[float, float] | None = None,
    top: float | None = None,
    key: Literal["inside", "beside"] = "inside",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the regions of symmetric steady states with their boundaries (Figs 3 and 4).

    Regions are numbered as in the paper, and the darker the more of their solutions are motions:
    none in region 4, one in regions 2 and 5, two in regions 1 and 3.  Boundaries have their names
    along them where there is room, else in the legend.  The frequency axis is logarithmic where the
    map's frequencies are spaced by ratio, as `numpy.geomspace` does; the amplitude axis where `top`
    is above 30.

    Parameters
    ----------
    curves
        From `rocksteady.orbits.compute_region_map`; or boundaries alone over ascending frequencies,
        of one restitution and order.
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

    Raises
    ------
    InputError
        If boundaries are not over ascending frequencies, of one restitution and order.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.orbits import compute_region_map
    >>> curves = compute_region_map(np.linspace(0.1, 14.0, 300), 0.5)
    >>> axes = plot_steady_regions(curves, Figure().add_subplot(), point=(4.0, 2.0))
    >>> print(axes.get_ylim()[1], [name.get_text() for name in axes.texts[:4]])
    6.0 ['1', '2', '4', 'A = 2, Ω = 4']
    """
    top = None if top is None else positive("top", top, hint="give where the axis ends")
    if point is not None:
        point = (
            positive("point", point[0], hint="give (frequency ratio, amplitude)"),
            non_negative("point", point[1], hint="give (frequency ratio, amplitude)"),
        )
    if isinstance(curves, RegionBoundaries):
        curves = _mapped(curves)
    axes = axes_or_new(ax)
    place = place_of(axes, legend, "inside" if key == "inside" else "right", width=125.0)
    draw_regions(axes, curves, place, point=point, top=top)
    return axes


def _mapped(boundaries: RegionBoundaries) -> RegionMap:
    """Return boundaries as a map without further curves.

    Raises
    ------
    InputError
        If they are not over ascending frequencies, of one restitution and order.
    """
    ratios = boundaries.frequency_ratio
    single = len({*boundaries.restitution.flat}) == len({*boundaries.order.flat}) == 1
    if not single or ratios.ndim != 1 or len(ratios) < 2 or not (np.diff(ratios) > 0.0).all():
        raise InputError(
            "curves",
            boundaries,
            "a picture takes two or more ascending frequency ratios, one restitution and one order",
            "give one array of frequency ratios and one restitution",
        )
    none = np.full(ratios.shape, np.nan)
    return RegionMap(
        frequency_ratio=ratios, restitution=float(boundaries.restitution[0]),
        order=int(boundaries.order[0]), existence=boundaries.existence, sign=boundaries.sign,
        kind=boundaries.kind, symmetry_breaking=none, heteroclinic=none,
    )  # fmt: skip


def _known(curves: RegionMap, factor: float) -> dict[str, Floats]:
    """Return each boundary that a map has, times a factor."""
    bounds = {name: factor * getattr(curves, name) for name in BOUNDARIES}
    return {name: curve for name, curve in bounds.items() if np.isfinite(curve).any()}


def draw_regions(
    axes: "Axes",
    curves: RegionMap,
    place: LegendPlace,
    *,
    point: tuple[float, float] | None,
    top: float | None,
    block: AnyBlock | None = None,
) -> None:
    """Draw the regions over acceleration and frequency, in the units of a block."""
    inks = inks_of(axes)
    across, up = scale_of("frequency_ratio", block), scale_of("amplitude", block)
    w = across.factor * curves.frequency_ratio
    bounds = _known(curves, up.factor)
    existence, kind, sign = (bounds[name] for name in ("existence", "kind", "sign"))
    ceiling = top if top is not None else max(6.0, 1.3 * point[1] if point is not None else 0.0)
    floor = 0.0
    if ceiling > LOGARITHMIC_SPAN:
        axes.set_yscale("log")
        floor = 0.3 * max(float(curves.existence.min()), 1e-6 * ceiling)
    if spaced_by_ratio(w):
        axes.set_xscale("log")
    here: list[tuple[float, float]] = []
    if point is not None:
        here = [(across.factor * point[0], up.factor * point[1])]
    ends = [end([float(w[at]), *(x for x, _ in here)]) for end, at in ((min, 0), (max, -1))]
    sky = up.factor * ceiling
    axes.set(xlabel=across.label, ylabel=up.label, xlim=ends, ylim=(up.factor * floor, sky))
    axes.grid(visible=False)
    (low, high), (pale, deep) = np.sort([kind, sign], axis=0), inks.rocks_ramp[:2]
    for under, over, where, fill in (
        (existence, low, None, deep),
        (low, high, sign >= kind, deep),
        (low, high, sign < kind, pale),
        (high, np.maximum(sky, high), None, pale),
    ):
        axes.fill_between(w, under, over, where=where, color=fill, lw=0)
    handles = _draw_bounds(axes, w, bounds)
    if here:
        axes.plot(
            *here[0], "o", ms=6.5, color=inks.paper, mec=inks.ink, mew=1.6, zorder=5, clip_on=False
        )
    draw_far_axes(axes, across, up)
    fills = (deep, pale, inks.paper)
    if place == "right":  # the words need the final width of the axes
        entries = _region_entries(range(1, 6), fills, inks.edge)
        draw_legend(axes, place, handles=[*handles.values(), *entries])
    words = Words(axes, [np.column_stack([w, each]) for each in bounds.values()])
    words.take(here, 5.0)
    corner, taken = words.emptiest_corner(*KEY), (0.0, 0.0, 0.0, 0.0)
    if place == "inside":
        wide, tall = extent(axes, width=KEY[0], height=KEY[1])
        x, y = CORNERS[corner][0] * (1.0 - wide), CORNERS[corner][1] * (1.0 - tall)
        taken = x, y, x + wide, y + tall
        words.take_box(*taken)
    centres = {
        number: (across.factor * x, up.factor * y)
        for number, (x, y) in region_centres(
            curves,
            ceiling,
            floor,
            taken=taken,
            point=point,
            least=max(LEAST_ROOM, 0.75 * text_size(axes, 9.5) / size_of(axes)[1]),
        ).items()
    }
    _number_regions(axes, centres)
    words.take([*centres.values()], 6.0)
    if point is not None:
        words.beside(here[0], _shaking_text(point, across, up))
    named = words.along([*handles], [inks.ink] * len(handles), aside=True)
    left = [handle for name, handle in handles.items() if name not in named]
    entries = _region_entries([*centres], fills, inks.edge)
    draw_legend(axes, place, handles=[*left, *entries], corner=corner)


def _draw_bounds(axes: "Axes", w: Floats, bounds: Mapping[str, Floats]) -> "dict[str, Artist]":
    """Draw boundaries over the frequency, and return their entries by their names."""
    from matplotlib.lines import Line2D

    handles: dict[str, Artist] = {}
    for bound, curve in bounds.items():
        name, dash = BOUNDARIES[bound]
        look: dict[str, Any] = {"color": inks_of(axes).limit, "ls": dash, "lw": 1.1}
        axes.plot(w, curve, label=name, **look)
        handles[name] = Line2D([], [], label=name, **look)
    return handles


def _number_regions(axes: "Axes", centres: Mapping[int, tuple[float, float]]) -> None:
    """Write the numbers of regions."""
    from matplotlib.patheffects import withStroke

    inks = inks_of(axes)
    for region, where in centres.items():
        axes.annotate(
            str(region),
            where,
            ha="center",
            va="center",
            fontsize=text_size(axes, 9.5),
            color=inks.ink,
            path_effects=[withStroke(linewidth=2.5, foreground=inks.paper)],
            zorder=4.0,
        )


def _region_entries(shown: Sequence[int], fills: Sequence[str], edge: str) -> "list[Artist]":
    """Return the entries of a legend for the regions that have a number."""
    from matplotlib.patches import Patch

    entries: list[Artist] = []
    for fill, (solutions, numbers) in zip(fills, SOLUTIONS, strict=True):
        seen = " and ".join(str(number) for number in numbers if number in shown)
        if seen:
            entries.append(Patch(fc=fill, ec=edge, lw=0.6, label=f"{seen}: {solutions}"))
    return entries


def _shaking_text(point: tuple[float, float], across: Scale, up: Scale) -> str:
    """Return amplitude and frequency of a point in the units of the axes."""
    if across.far:
        return f"{up.factor * point[1]:.3g} g, {across.factor * point[0]:.3g} Hz"
    return f"A = {point[1]:g}, Ω = {point[0]:g}"


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

    Each curve has its name on its line, of six or fewer; else they are in the legend.  The peak
    axis is logarithmic where peaks span more than a factor of 30, the frequency axis where
    frequencies are spaced by ratio, as `numpy.geomspace` does.  For blocks of one known size
    frequencies are in Hz and peaks in degrees, with the dimensionless scales on the far sides.

    Parameters
    ----------
    curves
        One or several of `rocksteady.compute_response_curve`.
    ax
        Axes to draw on; default: axes of a new figure.
    hertz
        Whether the abscissa is in Hz for blocks whose sizes differ too.
    labels
        Names of the curves, one each; by default amplitude and, where they differ, order and
        branch.
    top
        Upper end of a linear peak axis, in units of alpha; default: everything is shown.
    legend
        Place of the legend of what has no name on its line: "inside" the axes, to their "right",
        "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: Omega = omega/p or Hz, and the peak of |theta|/alpha or in degrees.

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
    >>> print(axes.get_yscale(), [name.get_text() for name in axes.texts])
    log ['A = 1', 'A = 2', 'tipping angle']
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
    place = place_of(axes, legend, "below")
    block = shared_size(curve.block for curve in curves)
    across, up = scale_of("frequency_ratio", block), scale_of("peak", block)
    lines = [
        np.column_stack([across.factor * curve.frequency_ratio, up.factor * curve.peak])
        for curve in curves
    ]
    if block is None and hertz:
        across = across._replace(label=palette.LABELS["frequency_hz"])
        for line, curve in zip(lines, curves, strict=True):
            line[:, 0] = math.nan if curve.frequency_hz is None else curve.frequency_hz
    names = [*labels] if labels is not None else _response_names(curves, block)
    longest = (LETTER * text_size(axes, 7.0) * max(map(len, names)) + 10.0) / size_of(axes)[0]
    few = len(curves) <= MOST_NAMED and longest < LONGEST_NAME
    shades = inks_of(axes).series("motion", min(len(curves), MOST_NAMED))
    handles = [
        _draw_response(axes, line, curve.stable, name, number, shades)
        for number, (line, curve, name) in enumerate(zip(lines, curves, names, strict=True))
    ]
    everything = np.concatenate(lines)
    tipping = _set_peaks(axes, everything[:, 1], up, top)
    axes.set(xlabel=across.label, ylabel=up.label)
    _set_frequencies(axes, everything[:, 0])
    if across.far and fits_far_axes(axes):
        if few:  # whose names end at the far axis
            _widen(axes, longest)
        draw_far_axes(axes, across, up)
    unstable = any((~curve.stable & np.isfinite(curve.peak)).any() for curve in curves)
    note = "solid: stable, dashed: unstable" if unstable else ""
    explain(axes, place, [], note)
    words = Words(axes, [*lines, *tipping.values()])
    inks = [*(str(handle.get_color()) for handle in handles), inks_of(axes).ink]
    named = words.at_ends(names, inks[:-1]) if few else set()
    named |= words.along([""] * len(lines) + [*tipping], inks, aside=True)
    left = [handle for handle, name in zip(handles, names, strict=True) if name not in named]
    left += limit_entries(axes, [name for name in tipping if name not in named])
    explain(axes, place, left, note)
    return axes


def _set_frequencies(axes: "Axes", frequencies: NDArray[np.float64]) -> None:
    """Set scale and limits of the axis of frequencies."""
    if spaced_by_ratio(frequencies):
        axes.set_xscale("log")
    if frequencies.min() < frequencies.max():
        axes.set_xlim(float(frequencies.min()), float(frequencies.max()))


def _set_peaks(
    axes: "Axes", peaks: NDArray[np.float64], up: Scale, top: float | None
) -> dict[str, NDArray[np.float64]]:
    """Set scale and limits of the axis of peaks; return the line of the tipping angle by its name.

    There is none where peaks are far below.
    """
    peaks, tipping = peaks[peaks > 0.0], up.factor
    lowest, highest = (peaks.min(), peaks.max()) if peaks.size else (tipping, tipping)
    shown = bool(highest > 0.6 * tipping and (top is None or top > 1.0))
    highest = max(highest, tipping) if shown else highest
    if top is not None:
        axes.set_ylim(0.0, up.factor * top)
    elif highest > LOGARITHMIC_SPAN * lowest:
        axes.set_yscale("log")
        margin = (highest / lowest) ** 0.05
        axes.set_ylim(lowest / margin, highest * margin)
    else:
        axes.set_ylim(0.0, highest / 0.95)
    if not shown:
        return {}
    axes.axhline(tipping, color=inks_of(axes).limit, ls=DASHED, lw=0.8, zorder=1.0)
    name = "tipping angle" + (f" {tipping:.3g}°" if up.far else "")
    return {name: np.array([[x, tipping] for x in axes.get_xlim()])}


def _widen(axes: "Axes", part: float) -> None:
    """Extend an axis to the right to leave room for names."""
    end = axes.transAxes + axes.transData.inverted()
    axes.set_xlim(right=float(end.transform((1.0 / (1.0 - part), 0.0))[0]))


def _response_names(curves: Sequence[ResponseCurve], block: Block | None) -> list[str]:
    """Return the amplitude of each curve and, where they differ, its order and branch."""
    several = len({(curve.branch, int(curve.states.order.flat[0])) for curve in curves}) > 1
    scale, names = scale_of("amplitude", block), []
    for curve in curves:
        amplitude = float(curve.states.amplitude.flat[0])
        name = f"{scale.factor * amplitude:.3g} g" if scale.far else f"A = {amplitude:g}"
        if several:
            name += f", n = {int(curve.states.order.flat[0])}, branch {curve.branch}"
        names.append(name)
    return names


def _draw_response(
    axes: "Axes",
    places: NDArray[np.float64],
    stable: NDArray[np.bool_],
    label: str,
    number: int,
    shades: Sequence[str],
) -> "Line2D":
    """Draw a response curve; more of them than there are shades have marks too."""
    from matplotlib.lines import Line2D

    x, peak = places.T
    again, shade = divmod(number, len(shades))
    look: dict[str, Any] = {"color": shades[shade]}
    if again:
        every = max(1, len(x) // 12)
        mark = MARKS[(again - 1) % len(MARKS)]
        look |= {"marker": mark, "ms": 3.5, "markevery": (number % every, every)}
    touching = ~stable  # one sample beyond either end, so that no gap is left
    touching[1:] |= ~stable[:-1]
    touching[:-1] |= ~stable[1:]
    axes.plot(x, np.where(stable, peak, math.nan), label=label, **look)
    axes.plot(x, np.where(touching, peak, math.nan), ls=DASHED, lw=1.0, **look)
    if not np.isfinite(peak).any():
        return Line2D([], [], ls="none", label=f"{label}: no motion")
    return Line2D([], [], label=label, **{**look, "markevery": None})


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
