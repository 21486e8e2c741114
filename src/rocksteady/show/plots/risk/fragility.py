"""Plots of fragility: shares of runs and curves, of a damage state or of all."""

import math
import textwrap
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
from rocksteady.risk.ensemble.gates import GIVEN_UPLIFT, condition_of
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.risk.fragility.damage_states import OVERTURNED
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style.layout import (
    axes_or_new,
    percent_ticks,
    plain_ticks,
    spaced_by_ratio,
)
from rocksteady.show.style.legends import (
    LETTER,
    SMALL,
    LegendPlace,
    draw_legend,
    figure_of,
    line_scale,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.tokens import DOTTED, DOUBT, MARKS, Inks, inks_of
from rocksteady.show.style.wording import state_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Curve = FragilityCurve | TwoStageCurve

SAMPLES = 120
"""Points of a curve."""
NOT_RUN = 0.2
"""Opacity of the shade over intensities that were not run."""
BEYOND = 1.35
"""Factor by which a picture goes beyond the intensities that were run."""
FALLS = ("", OVERTURNED)
"""Names of the state in which it falls."""
EVENTS = {"uplift": ("lifting", "lift"), "overturned": ("falling", "fall")}
"""Words for damage states after "probability of" and after "half"."""
HEIGHTS = (0.78, 0.7, 0.62, 0.54, 0.46, 0.38, 0.3, 0.22, 0.14)
"""Probabilities beside which the name of a curve or a band may stand, in order of preference."""
NO_CURVE = {
    "never": "never in any run",
    "always": "in every run",
    "not-rising": "no curve: not more frequent with intensity",
}
"""Legend entries of data without a curve."""
NO_BREAK = "\N{NO-BREAK SPACE}"
LEAST_LETTERS = 10
"""Letters of a line of text beside the uplift limit, at least."""


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
        return f"{name} [{unit}]" if unit else name


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
    points = _draw_points(axes, shown, inks, size)
    handles: list[Any] = [] if points is None else [points]
    thick = {"color": inks.risk, "lw": 2.0 * size, "zorder": 2.8}
    words = "in two stages" if isinstance(shown.best, TwoStageCurve) else shown.plain.family
    named = _draw_half(axes, shown, limits, inks)
    entries = _draw_curve(axes, shown.best, limits, _words(shown.best, words, named), thick)
    entries += _draw_band(axes, shown.best, limits, inks)
    if place == "none" or not _name_beside(axes, shown, limits, entries, inks):
        handles += entries
    if shown.plain is not shown.best:
        thin = {"color": inks.series("risk", 3)[2], "lw": 1.0 * size, "zorder": 2.6}
        handles += _draw_curve(axes, shown.plain, limits, _words(shown.plain, "one curve"), thin)
    handles += _draw_gate(axes, shown.best, limits, inks)
    handles += _draw_beyond(axes, shown.best, limits, inks)
    draw_legend(axes, place, handles=handles, corner=_corner(shown, limits))
    event = EVENTS.get(shown.name, (shown.name, ""))[0]
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
    # The worst state is the darkest, and a fall alone has the colour of risk.
    colours = inks.series("motion", len(drawn))[::-1]
    grid, earlier = _between(*limits), dict[str, Floats]()
    for place_, each in enumerate(drawn):
        colour = inks.risk if each.name in FALLS else colours[place_]
        mark = MARKS[place_ % len(MARKS)]
        # Worse states are thinner: the curve of one that never differs from the next is seen.
        width = max(1.0, 2.2 - 0.3 * place_) * size
        style = {"color": colour, "lw": width, "zorder": 2.8}
        at, shares, _ = _shares(each)
        dot: dict[str, Any] = {"mfc": inks.observed, "mec": inks.paper, "mew": 0.4}
        axes.plot(at, shares, mark, ls="none", ms=4.2 * size, zorder=2.9, **dot)
        words = state_words(each.name) or "fragility"
        if each.given and not _all_given(drawn):
            words += f", {GIVEN_UPLIFT}"
        name = greek(marked(words, each.best.misfit))
        values = each.best.probability(grid)
        same = [word for word, curve in earlier.items() if np.allclose(values, curve, atol=0.01)]
        earlier[name] = values
        name = ", as ".join([name, *same[:1]])
        lines = _draw_curve(axes, each.best, limits, name, style)
        lines[0].set(marker=mark, markevery=[], markersize=4.2 * size, **dot)
        handles += lines
    handles += _draw_beyond(axes, drawn[-1].best, limits, inks)
    if figure_of(axes).get_layout_engine() is not None:
        figure_of(axes).draw_without_rendering()  # a legend below needs the place of the axes
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
            given=condition_of(fragility.ensemble) if each.given_uplift else "",
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
    label = drawn[-1].label
    if drawn[-1].given and _all_given(drawn):
        label += f", {drawn[-1].given}"
    axes.set_xlabel(greek(label))
    percent_ticks(axes, "y")
    return limits


def _all_given(drawn: Sequence[Drawn]) -> bool:
    """Return whether all curves have the same condition; else it stands with their names."""
    return len({each.given for each in drawn}) == 1


def _words(curve: Curve, name: str, named: bool = False) -> str:
    """Return the legend entry of a curve: its median if none is named, and the beta if any."""
    unit = _unit(curve)
    median = "" if named else f", median {number(curve.median)}{unit}"
    if isinstance(curve, FragilityCurve):
        if curve.step is not None:
            return f"step {_between_words(curve.step)}{unit}"
        if curve.status in NO_CURVE:
            return NO_CURVE[curve.status]
        words = f"{name}{median}, β {number(curve.beta)}"
        return marked(words, curve.misfit)
    if not math.isfinite(curve.median):
        return f"{name}, no median"
    return marked(f"{name}{median}", curve.misfit)


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
    return [
        axes.axvspan(*span, color=inks.edge, alpha=NOT_RUN, lw=0.0, zorder=0.5, label="not run")
        for span in spans
        if span[1] > span[0]
    ][:1]


def _draw_band(axes: "Axes", curve: Curve, limits: tuple[float, float], inks: Inks) -> list[Any]:
    """Shade the confidence band over what was sampled; return its entry."""
    at = _between(max(curve.sampled[0], limits[0]), curve.sampled[1])
    band = curve.probability_band(at)
    if band is None:
        return []
    options = curve.plain.bands if isinstance(curve, TwoStageCurve) else curve.bands
    words = "band" if options is None else f"{100.0 * options.confidence:g} % band"
    style: dict[str, Any] = {"color": inks.risk, "alpha": DOUBT, "lw": 0.0, "zorder": 2.2}
    return [axes.fill_between(at, band[0], band[1], label=words, **style)]


def _draw_half(axes: "Axes", shown: Drawn, limits: tuple[float, float], inks: Inks) -> bool:
    """Draw the median as a limit with its name; return whether there is one in the picture."""
    curve, median = shown.best, shown.best.median
    step = shown.plain.step if curve is shown.plain else None
    if step is not None or not limits[0] < median < limits[1]:
        return False
    axes.plot(
        [limits[0], median, median], [0.5, 0.5, -0.03],
        color=inks.quiet, lw=0.8, zorder=2.5,
    )  # fmt: skip
    verb = EVENTS.get(shown.name, ("", "reach it" if shown.name else "fall"))[1]
    text = f"half {verb} at {number(median)}{_unit(curve)}"
    style: dict[str, Any] = {"textcoords": "offset points", "fontsize": text_size(axes, 8.0)}
    style |= {"color": inks.limit, "va": "bottom", "zorder": 3.6}
    band = curve.probability_band(np.array([*_between(limits[0], median)]))
    edge = median
    if band is not None and (band[1] > 0.4).any():
        edge = float(_between(limits[0], median)[np.argmax(band[1] > 0.4)])
    if isinstance(curve, TwoStageCurve) and math.isfinite(curve.uplift.median):
        edge = min(edge, curve.uplift.median)
    room = _across(axes, edge) * size_of(axes)[0]
    if LETTER * text_size(axes, 8.0) * len(text) + 10.0 < room:
        axes.annotate(text, (limits[0], 0.5), (5.0, 2.0), **style)
    else:  # below the curve
        axes.annotate(text, (median, 0.0), (5.0, 2.0), **style)
    return True


def _across(axes: "Axes", x: float) -> float:
    """Return the place of an abscissa in parts of the axes."""
    return float(axes.transAxes.inverted().transform(axes.transData.transform((x, 0.0)))[0])


def _name_beside(
    axes: "Axes", shown: Drawn, limits: tuple[float, float], entries: list[Any], inks: Inks
) -> bool:
    """Name the fitted curve and its band beside them; return whether there is room."""
    if not np.isfinite(shown.best.probability(np.array(limits))).all():
        return False
    if 72.0 * figure_of(axes).get_figwidth() < SMALL:
        return False
    (wide, high), size = size_of(axes), text_size(axes, 8.0)
    first, *more = str(entries[0].get_label()).split(", ")
    texts = ["\n".join(["fitted curve", first, *([", ".join(more)] if more else [])])]
    texts += [str(entries[1].get_label())] if len(entries) > 1 else []
    at = _between(*limits)
    band = shown.best.probability_band(at)
    lower, upper = band if band is not None else (shown.best.probability(at),) * 2
    bars = _bars(shown)
    if isinstance(shown.best, TwoStageCurve):
        uplift = shown.best.uplift.probability(at)
        bars += list(zip(at.tolist(), uplift.tolist(), uplift.tolist(), strict=True))
        if shown.best.uplift.step is not None:
            bars.append((shown.best.uplift.median, 0.0, 1.0))
    taken: list[tuple[float, float, float, float]] = []
    for text in texts:
        lines = text.split("\n")
        across = LETTER * size * max(map(len, lines)) / wide
        half = 0.5 * (1.25 * size * len(lines) + 4.0) / high * 1.06

        def free(x: float, y: float, across: float = across, half: float = half) -> bool:
            """Return whether a text hides no bar and no other text."""
            inside = x > 0.01 and x + across < 0.99 and y - half > -0.02
            crossed = any(
                x - 0.01 < _across(axes, place) < x + across + 0.01
                and low < y + half
                and top > y - half
                for place, low, top in bars
            )
            apart = all(
                x > x1 or x + across < x0 or y - half > y1 or y + half < y0
                for x0, x1, y0, y1 in taken
            )
            return inside and not crossed and apart

        places = [
            (x, y)
            for y in HEIGHTS
            for x in (
                _across(axes, float(at[np.argmax(lower > y + half)])) + 10.0 / wide
                if (lower > y + half).any()
                else 1.0,
                _across(axes, float(at[np.argmax(upper > y - half)])) - 10.0 / wide - across
                if y - half > 0.6
                else -1.0,
            )
            if free(x, y)
        ]
        if not places:
            for each in axes.texts[len(axes.texts) - len(taken) :]:
                each.remove()
            return False
        x, y = places[0]
        taken.append((x, x + across, y - half, y + half))
        left = float(axes.transData.inverted().transform(axes.transAxes.transform((x, 0.0)))[0])
        axes.text(
            left, y, text, color=inks.risk, fontsize=size, va="center", linespacing=1.25, zorder=3.6
        )
    return True


def _draw_gate(axes: "Axes", curve: Curve, limits: tuple[float, float], inks: Inks) -> list[Any]:
    """Draw the uplift limit, or where uplift is no step its curve; return its entry if unnamed."""
    if not isinstance(curve, TwoStageCurve) or curve.uplift.status not in ("fitted", "separated"):
        return []
    uplift = curve.uplift
    style: dict[str, Any] = {"color": inks.limit, "lw": 1.0, "ls": DOTTED, "zorder": 2.4}
    if uplift.step is not None:
        line = axes.axvline(uplift.median, **style)
        words, at = f"uplift {_between_words(uplift.step)}{_unit(curve)}", uplift.median
    else:
        across = _between(*limits)
        values = uplift.probability(across)
        (line,) = axes.plot(across, values, **style)
        words, at = "uplift", float(across[np.argmax(values > 0.9)])
    # Nothing falls left of it.
    size = text_size(axes, 8.0)
    letters = int((_across(axes, at) * size_of(axes)[0] - 6.0) / (LETTER * size))
    if letters < min(LEAST_LETTERS, len(words)):
        line.set_label(words)
        return [line]
    axes.annotate(
        textwrap.fill(words.replace(NO_BREAK, " "), letters), (at, 0.97), (-4.0, 0.0),
        textcoords="offset points", ha="right", va="top", fontsize=size, color=inks.limit,
        zorder=3.6,
    )  # fmt: skip
    return []


def _bars(shown: Drawn) -> list[tuple[float, float, float]]:
    """Return the place of each share, and the ends of its interval."""
    at, shares, trials = _shares(shown)
    low, high = share_interval(shares, np.minimum(trials, max(shown.records, 1)))
    return list(zip(at.tolist(), low.tolist(), high.tolist(), strict=True))


def _draw_points(axes: "Axes", shown: Drawn, inks: Inks, size: float) -> Any:
    """Draw the shares of the stripes with their intervals; return their entry."""
    at, shares, _ = _shares(shown)
    if not len(at):
        return None
    words = f"share of runs, {100.0 * CONFIDENCE:g} % bar of "
    words += plural(shown.records, "record").replace(" ", NO_BREAK)
    places, low, high = zip(*_bars(shown), strict=True)
    axes.vlines(places, low, high, color=inks.observed, lw=0.8 * size, zorder=2.9)
    (points,) = axes.plot(
        at, shares, "o", ms=4.2 * size, color=inks.observed, mec=inks.paper, mew=0.5, label=words,
        zorder=3.0,
    )  # fmt: skip
    return points


def _corner(shown: Drawn, limits: tuple[float, float]) -> str:
    """Return the corner that a rising curve leaves free."""
    middle = 0.5 * limits[1] if limits[0] <= 0.0 else math.sqrt(limits[0] * limits[1])
    half = shown.best.median
    late = half > middle if math.isfinite(half) else shown.plain.status != "always"
    return "upper left" if late else "lower right"
