"""Plot of the symmetric steady states of the closed form: their tilt over what varies."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.steady.states import SteadyStates, orbit_of
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import number
from rocksteady.show.plots.steady import plot_steady_orbit
from rocksteady.show.style.layout import axes_or_new, spaced_by_ratio
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of
from rocksteady.show.style.scales import draw_far_axes, scale_of
from rocksteady.show.style.tokens import DASHED, DOTTED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AXES = ("frequency_ratio", "amplitude", "restitution", "order")
"""Inputs, that which is the abscissa first."""
MOST = 6
"""Curves of a picture."""
NO_MOTION = "no motion: passes through the base"
STABLE = {True: "stable", False: "unstable"}
DASHES = (*STABLE.values(), NO_MOTION)
"""What dashes mean, in the order of the legend."""
SYMBOLS = {"amplitude": "A", "frequency_ratio": "Ω", "restitution": "r", "order": "n"}


@checked
def plot_steady_states(
    states: SteadyStates, ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw the largest tilt of both symmetric steady states over the input that varies.

    Stable ones are solid, unstable ones dashed, and solutions that are no motion dotted. Of a grid
    the curves of six values of the other input at most are drawn; of one point a period of each
    motion.

    Parameters
    ----------
    states
        From `rocksteady.find_steady_states` or `rocksteady.formulas.steady_states`.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the input that varies, the frequency where it does, and the largest tilt; of one
        point time and tilt.

    Raises
    ------
    InputError
        If nothing exists there, or the shapes were not computed.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.formulas import steady_states
    >>> states = steady_states(2.0, np.linspace(2.0, 8.0, 50), 0.8)
    >>> len(plot_steady_states(states, Figure().add_subplot()).lines) > 1
    True
    """
    if states.peak is None or not np.isfinite(states.peak).any():
        raise InputError(
            "states",
            Words("have no tilt"),
            "there must be a solution, with its shape",
            "give a larger amplitude, or leave shapes as it is",
        )
    from matplotlib.lines import Line2D

    axes = axes_or_new(ax)
    if states.region.size == 1:
        return _orbits(states, axes, legend)
    inks = inks_of(axes)
    inputs = {name: getattr(states, name).ravel() for name in AXES}
    varying = [name for name in AXES if np.ptp(inputs[name]) > 0.0] or [AXES[0]]
    name, others = varying[0], varying[1:]
    across = scale_of(name, states.block) if name in AXES[:3] else None
    up = scale_of("angle", states.block)
    keys = list(zip(*(inputs[each].tolist() for each in others), strict=True))
    keys = keys or [()] * states.region.size
    kept = sorted(set(keys))
    if len(kept) > MOST:
        kept = [kept[at] for at in np.linspace(0, len(kept) - 1, MOST).round().astype(int)]
    drawn: dict[str, Any] = {}
    lowest = 0.0
    for key, colour in zip(kept, inks.series("motion", len(kept)), strict=True):
        mine = np.array([each == key for each in keys])
        x = inputs[name][mine] * (1.0 if across is None else across.factor)
        order = np.argsort(x, kind="stable")
        for branch in range(2):
            peak, stable, admissible = (
                np.asarray(values)[branch].ravel()[mine][order]
                for values in (states.peak * up.factor, states.stable, states.admissible)
            )
            for label, which, dash in (
                (STABLE[True], stable, "-"),
                (STABLE[False], admissible & ~stable, DASHED),
                (NO_MOTION, ~admissible, DOTTED),
            ):
                shown = np.where(which, peak, np.nan)
                if not np.isfinite(shown).any():
                    continue
                axes.plot(x[order], shown, color=colour, ls=dash, lw=1.6)
                alone = _alone(shown)
                if np.isfinite(alone).any():
                    axes.plot(x[order], alone, ".", color=colour, ms=4.0)
                lowest = min(lowest, float(np.nanmin(shown)))
                drawn.setdefault(label, Line2D([], [], color=inks.motion, ls=dash))
        if key:
            words = zip(others, key, strict=True)
            name_of = ", ".join(f"{SYMBOLS[each]} = {number(value)}" for each, value in words)
            drawn[name_of] = Line2D([], [], color=colour)
    axes.set(
        xlabel="order n" if across is None else across.label,
        ylabel=up.label,
        xscale="log" if spaced_by_ratio(np.unique(inputs[name])) else "linear",
    )
    if lowest == 0.0:  # a solution that is no motion may lie below the base
        axes.set_ylim(bottom=0.0)
    draw_far_axes(axes, across, up)
    place = place_of(axes, legend, "below")
    entries = {name: drawn[name] for name in (*DASHES, *drawn) if name in drawn}
    draw_legend(axes, place, handles=[*entries.values()], labels=[*entries])
    return axes


def _alone(values: Floats) -> Floats:
    """Return those values that no line shows, as both neighbours are NaN, and NaN elsewhere."""
    beside = np.pad(np.isfinite(values), 1)
    return np.where(beside[:-2] | beside[2:], np.nan, values)


def _orbits(states: SteadyStates, axes: "Axes", legend: LegendPlace | None) -> "Axes":
    """Draw one period of each motion of a point: stable solid, unstable dashed."""
    assert states.admissible is not None
    for branch in (1, 2):
        if not states.admissible[branch - 1].item():
            continue
        orbit = orbit_of(states, branch)
        stable = bool(states.stable[branch - 1].item())
        plot_steady_orbit(orbit, axes, label=f"branch {branch}, {STABLE[stable]}")
        axes.lines[-1].set(color=inks_of(axes).motion, ls="-" if stable else DASHED)
    draw_legend(axes, place_of(axes, legend, "below"))
    return axes
