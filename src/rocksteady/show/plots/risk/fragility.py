"""Pictures of fragility: counted shares with their intervals, monotone lines, uplift as a step."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import CONFIDENCE, number
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.damage_states import OVERTURNED, UPLIFT
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.show.plots.risk._words import greek
from rocksteady.show.style.layout import axes_or_new, percent_ticks, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import figure_of, line_scale
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import MARKS, Inks, inks_of
from rocksteady.show.style.wording import state_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SAMPLES = 200
"""Points of a curve."""
BEYOND, ALONE = 0.06, 2.5
"""What a picture shows beyond levels: part of the logarithm of their range; factor of one alone."""
DODGE = 0.9
"""Distance of the points of a state from those of the next worse at one level [points]."""
STEP = "━"
"""Before the name of uplift, which has no points: its thresholds are known without a run."""
GLYPHS = dict(zip(MARKS, "●■◆▲▼✚✖⬟⬢★", strict=True))
"""Markers in a text."""
NO_CURVE = {
    "never": "never in any run",
    "always": "in every run",
    "not-rising": "no curve:\ndoes not rise",
}
"""What stands in place of median and beta."""


@checked
def plot_fragility(
    fragility: Fragility | StateFragility | FragilityCurve, ax: "Axes | None" = None
) -> "Axes":
    """Draw counted shares over levels, each with its 90 % interval, and a line through them.

    The line is the monotone one nearest to the counts, straight over the logarithm of the level;
    of uplift it is the exact step at the thresholds of the records.  A curve of
    `rocksteady.risk.fit_curve` is drawn over the shares that it was fitted to.

    Parameters
    ----------
    fragility
        From `rocksteady.compute_fragility`, one of its states, or a fitted curve.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: level, and share of the runs, with the name of each state at the end of its line.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, compute_fragility
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import Levels, RestitutionBand
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.3, height=1.5),
    ...     make_synthetic_suite(3),
    ...     levels=Levels("pga_g", [0.2, 0.5, 1.0]),
    ...     restitution=RestitutionBand(draws=1),
    ...     states=["uplift", "overturned"],
    ... )
    >>> axes = plot_fragility(fragility, Figure().add_subplot())
    >>> axes.get_xlabel(), [text.get_text() for text in axes.texts]
    ('PGA [g]', ['● falls', '━ lifts'])
    """
    axes = axes_or_new(ax)
    if isinstance(fragility, FragilityCurve):
        _draw_fitted(axes, fragility)
    else:
        draw_states(axes, fragility.states if isinstance(fragility, Fragility) else [fragility])
    return axes


def draw_states(
    axes: "Axes", states: Sequence[StateFragility], others: Sequence[LineEnd] = ()
) -> None:
    """Draw damage states, each of which contains the next, and name them with other lines."""
    inks, width = inks_of(axes), line_scale(axes)
    levels, measure = states[-1].curve.levels, states[-1].measure
    axes.set(xscale="log", xlim=_limits(levels))
    percent_ticks(axes, "y")
    plain_ticks(axes)
    names = []
    for place, (state, colour) in enumerate(zip(states, state_colours(states, inks), strict=True)):
        worse = len(states) - 1 - place
        style: dict[str, Any] = {"color": colour, "zorder": 2.8 - 0.01 * worse}
        marker = MARKS[worse % len(MARKS)]
        at = _abscissas(state)
        axes.plot(at, state.share(at), lw=(1.3 if worse else 1.8) * width, **style)
        glyph = STEP
        if state.state.name != UPLIFT:
            glyph = GLYPHS[marker]
            _draw_counts(axes, state, marker, DODGE * worse, style)
        end = state.share(levels[-1])
        names.append(LineEnd(f"{glyph} {greek(state_words(state.state.name))}", end, colour))
    name_line_ends(axes, [*names[::-1], *others])
    axes.set(
        xlabel="factor of the records" if measure is None else greek(str(measure)),
        ylabel=f"share of runs (bars: {100.0 * CONFIDENCE:g} %)",
    )


def state_colours(states: Sequence[StateFragility], inks: Inks) -> list[str]:
    """Return a colour for each state: the worse, the stronger; a fall has the hue of risk."""
    count = len(states)
    colours = inks.series("motion", count)[::-1]
    if states[-1].state.name == OVERTURNED:
        colours[-1] = inks.series("risk", count)[0]
    return colours


def _draw_counts(
    axes: "Axes", state: StateFragility, marker: str, left: float, style: dict[str, Any]
) -> None:
    """Draw counted shares and their intervals, some points to the left of their level."""
    from matplotlib.transforms import ScaledTranslation

    width, curve = line_scale(axes), state.curve
    shift = ScaledTranslation(-left * width / 72.0, 0.0, figure_of(axes).dpi_scale_trans)
    at: dict[str, Any] = {"transform": axes.transData + shift}
    low, high = np.transpose([count.band for count in curve.counts])
    axes.vlines(curve.levels, low, high, lw=0.7 * width, alpha=0.6, **style, **at)
    paper: dict[str, Any] = {"mec": inks_of(axes).paper, "mew": 0.3}
    axes.plot(curve.levels, curve.shares, marker, ls="none", ms=3.4 * width, **paper, **style, **at)


def _limits(levels: Floats) -> tuple[float, float]:
    """Return what is shown of an axis of levels."""
    low, high = levels[[0, -1]].tolist()
    beyond = (high / low) ** BEYOND if high > low else ALONE
    return low / beyond, high * beyond


def _abscissas(state: StateFragility) -> Floats:
    """Return levels at which a line bends, and both sides of each of its steps."""
    levels, steps = state.curve.levels, state.curve.lifts_at
    below = _limits(levels)[0]
    if state.state.name != UPLIFT and state.share(levels[0]) > 0.0:
        below = float(levels[0])  # under it nothing was counted
    steps = steps[(steps >= below) & (steps < levels[-1])]
    even = np.geomspace(below, levels[-1], SAMPLES)
    return np.unique(np.concatenate([levels, steps, np.nextafter(steps, np.inf), even]))


def _draw_fitted(axes: "Axes", curve: FragilityCurve) -> None:
    """Draw a fitted curve over the shares that it was fitted to."""
    inks, width = inks_of(axes), line_scale(axes)
    at, trials, failures = np.array([row[:3] for row in curve.stripes], dtype=np.float64).T
    low, high = curve.sampled
    percent_ticks(axes, "y")
    across = np.linspace(low, high, SAMPLES)
    if len(at) < 3 or spaced_by_ratio(at):
        axes.set(xscale="log", xlim=_limits(at))
        across = np.geomspace(low, high, SAMPLES)
    plain_ticks(axes)
    if curve.step is not None:
        across = np.union1d(across, np.nextafter(curve.median, [0.0, np.inf]))
    shares, fitted = failures / trials, curve.probability(across)
    axes.plot(across, fitted, color=inks.risk, lw=1.8 * width, zorder=2.8)
    axes.plot(
        at, shares, "o", ls="none", ms=4.2 * width, color=inks.observed, mec=inks.paper, mew=0.5,
        zorder=2.9,
    )  # fmt: skip
    end = fitted if np.isfinite(fitted).any() else shares
    name_line_ends(axes, [LineEnd(_fit_words(curve), end, inks.risk)])
    name, unit = curve.measure
    axes.set(xlabel=greek(f"{name} [{unit}]" if unit else name), ylabel="share of trials")


def _fit_words(curve: FragilityCurve) -> str:
    """Return a fit in words."""
    unit = f" {curve.measure[1]}".rstrip()
    if curve.status in NO_CURVE:
        return NO_CURVE[curve.status]
    if curve.step is not None:
        low, high = map(number, curve.step)
        return f"step between\n{low} and {high}{unit}"
    return f"lognormal\nmedian {number(curve.median)}{unit}\nβ {number(curve.beta)}"
