"""Plots of fragility: shares of runs and curves, of a damage state or of all."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.confidence import CONFIDENCE, share_interval
from rocksteady.results.doubts import marked
from rocksteady.results.numbers import number, plural
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.seismic.measures.scalar import GIVEN
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import (
    LegendPlace,
    draw_legend,
    line_scale,
    place_of,
)
from rocksteady.show.style.line_colours import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Curve = FragilityCurve | TwoStageCurve

SAMPLES = 400
"""Points of a curve."""
BEYOND = 1.35
"""Factor by which a picture goes beyond the intensities that were run."""
EVENTS = {"uplift": "uplift", "overturned": "overturning"}
"""What damage states are called after "probability of"."""
NO_CURVE = {
    "never": "never in any run",
    "always": "in every run",
    "not-rising": "no curve: not more frequent with intensity",
}
"""Legend entries of data without a curve."""
NO_BREAK = "\N{NO-BREAK SPACE}"


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawn:
    """One damage state of a picture."""

    name: str
    best: Curve
    plain: FragilityCurve
    given: str = ""

    @property
    def records(self) -> int:
        """The number of records."""
        return self.plain.records

    @property
    def label(self) -> str:
        """The abscissa with its unit."""
        name, unit = self.best.measure
        label = f"{name} [{unit}]" if unit else name
        return f"{label}, {self.given}" if self.given else label


@checked
def plot_fragility(
    fragility: Fragility | FragilityCurve | TwoStageCurve,
    ax: "Axes | None" = None,
    *,
    state: str | None = None,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the fragility of a damage state: shares of runs, curves, range of the runs.

    A curve is solid over the intensities that were run and dashed beyond. Bars are 90 % Wilson
    intervals of as many trials as there are records, since runs on one record depend on each other.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, `rocksteady.risk.fit_two_stages` or
        `rocksteady.risk.fit_curve`.
    ax
        Axes to draw on; default: axes of a new figure.
    state
        Name of the damage state; the last, which is the worst, by default.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: intensity, logarithmic where the levels are spaced like that, and probability.

    Raises
    ------
    InputError
        If there is no such state, or no run.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.risk import fit_curve
    >>> curve = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4, measure=("PGV", "m/s"))
    >>> axes = plot_fragility(curve, Figure().add_subplot())
    >>> axes.get_xlabel()
    'PGV [m/s]'
    """
    drawn = _states_of(fragility)
    names = [each.name for each in drawn]
    if state is not None and state not in names:
        raise InputError(
            "state", state, "the damage states are " + ", ".join(names), "name one of them"
        )
    shown = drawn[-1] if state is None else drawn[names.index(state)]
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    limits = _prepare(axes, [shown])
    size = line_scale(axes)
    band = _draw_band(axes, shown.best, limits, inks)
    handles: list[Any] = []
    if shown.plain is not shown.best:
        thin = {"color": inks.lines[1], "lw": 1.0 * size, "zorder": 2.6}
        handles += _draw_curve(axes, shown.plain, limits, _words(shown.plain, "one curve"), thin)
    thick = {"color": inks.lines[0], "lw": 2.0 * size, "zorder": 2.8}
    words = "in two stages" if isinstance(shown.best, TwoStageCurve) else shown.plain.family
    handles[:0] = _draw_curve(axes, shown.best, limits, _words(shown.best, words), thick)
    if band is not None:
        handles.append(band)
    handles += _draw_gate(axes, shown.best, limits, inks)
    handles += _draw_beyond(axes, shown.best, limits, inks)
    points = _draw_points(axes, shown, inks, size)
    handles = [points, *handles] if points is not None else handles
    draw_legend(axes, place, handles=handles, corner=_corner(shown, limits))
    event = EVENTS.get(shown.name, shown.name)
    axes.set_ylabel(greek(f"probability of {event}" if event else "probability"))
    return axes


@checked
def plot_fragility_states(
    fragility: Fragility | FragilityCurve | TwoStageCurve,
    ax: "Axes | None" = None,
    *,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the fragility of all damage states: shares of runs, and their curves.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, or a curve.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default to their right, or
        below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, as for `plots.fragility`.

    Raises
    ------
    InputError
        If there is no run.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.risk import fit_curve
    >>> curve = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40, 40, 40, 40])
    >>> axes = plot_fragility_states(curve, Figure().add_subplot())
    >>> axes.get_ylabel()
    'probability'
    """
    drawn = _states_of(fragility)
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "right")
    limits = _prepare(axes, drawn)
    size = line_scale(axes)
    handles: list[Any] = []
    for number_, each in enumerate(drawn):
        colour = inks.lines[number_ % len(inks.lines)]
        mark = palette.MARKS[number_ % len(palette.MARKS)]
        # Worse states are thinner: the curve of one that never differs from the next is seen.
        width = max(1.0, 2.2 - 0.3 * number_) * size
        style = {"color": colour, "lw": width, "zorder": 2.8}
        at, shares, _ = _shares(each)
        axes.plot(at, shares, mark, color=colour, ms=3.6 * size, mew=0.0, alpha=0.75, zorder=2.9)
        name = greek(marked(each.name or "fragility", each.best.misfit))
        lines = _draw_curve(axes, each.best, limits, name, style)
        lines[0].set(marker=mark, markevery=[], markersize=4.0 * size)
        handles += lines
    handles += _draw_beyond(axes, drawn[-1].best, limits, inks)
    draw_legend(axes, place, handles=handles)
    axes.set_ylabel("probability")
    return axes


def _states_of(fragility: Fragility | Curve) -> list[Drawn]:
    """Return the damage states of a fragility, or the one of a curve."""
    if isinstance(fragility, TwoStageCurve):
        return [Drawn(name="", best=fragility, plain=fragility.plain)]
    if isinstance(fragility, FragilityCurve):
        return [Drawn(name="", best=fragility, plain=fragility)]
    return [
        Drawn(
            name=each.state.name,
            best=each.curve,
            plain=each.plain if isinstance(each.curve, TwoStageCurve) else each.curve,
            given=GIVEN if each.given_uplift else "",
        )
        for each in fragility.states
    ]


def _shares(shown: Drawn) -> tuple[Floats, Floats, Floats]:
    """Return intensities, shares, and numbers of trials of the stripes."""
    rows = [(at, failures / trials, trials) for at, trials, failures, _ in shown.best.stripes]
    at, shares, trials = np.array(rows, dtype=np.float64).reshape(-1, 3).T
    return at, shares, trials


def _prepare(axes: "Axes", drawn: Sequence[Drawn]) -> tuple[float, float]:
    """Give the abscissa its scale, limits and label, and return what is shown of it."""
    lows, highs = zip(*(each.best.sampled for each in drawn), strict=True)
    low, high = min(lows), max(highs)
    if high <= 0.0:
        raise InputError("fragility", Words("is of no run"), "a picture needs runs", "give another")
    levels = np.unique(np.concatenate([_shares(each)[0] for each in drawn]))
    if low > 0.0 and (len(levels) < 3 or spaced_by_ratio(levels)):
        limits = low / BEYOND, high * BEYOND
        axes.set_xscale("log")
        axes.set_xlim(*limits)
        plain_ticks(axes)
    else:
        limits = 0.0, high * BEYOND
        axes.set_xlim(*limits)
    axes.set(ylim=(-0.03, 1.03), xlabel=greek(drawn[-1].label))
    return limits


def _words(curve: Curve, name: str) -> str:
    """Return the legend entry of a curve: its median, and the beta of one that has one."""
    unit = _unit(curve)
    if isinstance(curve, FragilityCurve):
        if curve.step is not None:
            return f"step {_between_words(curve.step)}{unit}"
        if curve.status in NO_CURVE:
            return NO_CURVE[curve.status]
        words = rf"{name}, median {number(curve.median)}{unit}, $\beta$ {curve.beta:.2f}"
        return marked(words, curve.misfit)
    if not math.isfinite(curve.median):
        return f"{name}, no median"
    return marked(f"{name}, median {number(curve.median)}{unit}", curve.misfit)


def _between_words(step: tuple[float, float]) -> str:
    """Return where a step lies: between two numbers, or at one."""
    ends = list(dict.fromkeys(map(number, step)))
    return f"between {' and '.join(ends)}" if len(ends) > 1 else f"at {ends[0]}"


def _unit(curve: Curve) -> str:
    """Return the unit after a number, from which no line break parts it."""
    return f"{NO_BREAK}{curve.measure[1]}" if curve.measure[1] else ""


def _draw_curve(
    axes: "Axes", curve: Curve, limits: tuple[float, float], label: str, style: dict[str, Any]
) -> list[Any]:
    """Draw a curve, solid where it was sampled and dashed beyond; return its entry."""
    low, high = curve.sampled
    spans = (
        (limits[0], low, (0, (3.0, 2.0))),
        (low, high, "-"),
        (high, limits[1], (0, (3.0, 2.0))),
    )
    entry: list[Any] = []
    for begin, end, dash in spans:
        if end <= begin:
            continue
        at = _between(begin, end)
        values = curve.probability(at)
        if not np.isfinite(values).any():
            continue
        solid = dash == "-"
        lines = axes.plot(
            at, values, ls=dash, label=label if solid else "_", solid_capstyle="butt", **style
        )
        if solid:
            entry = lines
    return entry or list(axes.plot([], [], ls="none", label=label))


def _between(begin: float, end: float) -> Floats:
    """Return intensities that draw a curve smoothly on either kind of axis."""
    even = np.linspace(begin, end, SAMPLES)
    if begin <= 0.0:
        return even
    return np.unique(np.concatenate([even, np.geomspace(begin, end, SAMPLES)]))


def _draw_beyond(axes: "Axes", curve: Curve, limits: tuple[float, float], inks: Inks) -> list[Any]:
    """Shade what was not run on both sides; return its entry."""
    spans = [(limits[0], curve.sampled[0]), (curve.sampled[1], limits[1])]
    shades = [
        axes.axvspan(*span, color=inks.faint, alpha=0.16, lw=0.0, zorder=0.5, label="not run")
        for span in spans
        if span[1] > span[0]
    ]
    return shades[:1]


def _draw_band(axes: "Axes", curve: Curve, limits: tuple[float, float], inks: Inks) -> Any:
    """Shade the confidence band over what was sampled; return its entry, None without one."""
    at = _between(max(curve.sampled[0], limits[0]), curve.sampled[1])
    band = curve.probability_band(at)
    if band is None:
        return None
    options = curve.plain.bands if isinstance(curve, TwoStageCurve) else curve.bands
    words = "band" if options is None else f"{100.0 * options.confidence:g} % band"
    return axes.fill_between(
        at, band[0], band[1], color=inks.lines[0], alpha=0.2, lw=0.0, label=words, zorder=2.2
    )


def _draw_gate(axes: "Axes", curve: Curve, limits: tuple[float, float], inks: Inks) -> list[Any]:
    """Draw the uplift limit, or where uplift is no step its curve; return its entry."""
    if not isinstance(curve, TwoStageCurve):
        return []
    uplift = curve.uplift
    style: dict[str, Any] = {"color": inks.base, "lw": 1.2, "zorder": 2.4}
    if uplift.step is not None:
        unit = _unit(curve)
        words = f"uplift {_between_words(uplift.step)}{unit}"
        return [axes.axvline(uplift.median, ls=(0, (1, 1.2)), label=words, **style)]
    if uplift.status != "fitted":
        return []
    at = _between(*limits)
    return list(axes.plot(at, uplift.probability(at), ls=(0, (1, 1.2)), label="uplift", **style))


def _draw_points(axes: "Axes", shown: Drawn, inks: Inks, size: float) -> Any:
    """Draw the shares of the stripes with their intervals; return their entry."""
    at, shares, trials = _shares(shown)
    if not len(at):
        return None
    low, high = share_interval(shares, np.minimum(trials, max(shown.records, 1)))
    words = f"share of runs, {100.0 * CONFIDENCE:g} % bar of "
    words += plural(shown.records, "record").replace(" ", NO_BREAK)
    axes.vlines(at, low, high, color=inks.faint, lw=0.9 * size, zorder=2.3)
    (points,) = axes.plot(
        at, shares, "o", ms=4.2 * size, color=inks.ink, mec=inks.paper, mew=0.5, label=words,
        zorder=3.0,
    )  # fmt: skip
    return points


def _corner(shown: Drawn, limits: tuple[float, float]) -> str:
    """Return the corner that a rising curve leaves free."""
    middle = 0.5 * limits[1] if limits[0] <= 0.0 else math.sqrt(limits[0] * limits[1])
    half = shown.best.median
    late = half > middle if math.isfinite(half) else shown.plain.status != "always"
    return "upper left" if late else "lower right"
