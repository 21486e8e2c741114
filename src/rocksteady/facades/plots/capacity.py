"""Plot of a facade's capacity curve with its limits, periods and demands."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.facades.checks.check_facade import DAMPINGS
from rocksteady.facades.checks.facade_check import FacadeCheck, LimitStateCheck
from rocksteady.facades.checks.facade_demand import FacadeDemand
from rocksteady.facades.checks.mechanism import Mechanism
from rocksteady.facades.plots.languages import Language, decimal_marks, language_of, symbol
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of, text_size
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import DOTTED, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MM = 1000.0
MOST = 1.6
"""Largest demand that is drawn in its place, over d0; a farther one stands at the edge."""
PERIODS = 300
STATES = ("SLV", "SLD", "SLC")
"""Limit states in the order of their shades, the darkest first; the two with spectra are apart."""


@checked
def plot_facade_capacity(
    check: FacadeCheck | Mechanism,
    ax: "Axes | None" = None,
    *,
    language: str = "en",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the capacity curve of a facade over displacement, with limits, periods and demands.

    A line through the origin is a period T, of slope (2 pi/T)^2. A demand left of its limit is
    satisfied. Arrows at the right edge are demands beyond it.

    Parameters
    ----------
    check
        From `rocksteady.check_facade`; or a mechanism, without a demand.
    ax
        Axes to draw on; default: axes of a new figure.
    language
        "en", the default, or "it".
    legend
        "inside" the axes, to their "right", "below" them, the default, or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: displacement [mm], acceleration [g].

    Raises
    ------
    InputError
        If there is no such language.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import check_facade
    >>> from rocksteady.codes import Facade
    >>> wall = Facade(name="front", kind="wall", thickness_m=0.3, height_m=3.0)
    >>> axes = plot_facade_capacity(check_facade(wall), Figure().add_subplot())
    >>> axes.get_xlabel()
    'displacement d [mm]'
    """
    words = language_of(language)
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    mechanism, demand, checks = _parts(check)
    scale = line_scale(axes)
    d0 = MM * mechanism.d0_m
    curved = np.array(mechanism.curve)
    a0 = max(float(curved[:, 1].max()), mechanism.linear_g)
    demands = _demands(checks)
    at_zero = _accelerations(checks)
    widest = max([d0, *(min(d, MOST * d0) for *_, d in demands)])
    highest = max([a0, *(min(a, 2.0 * a0) for _, a in at_zero)])
    axes.set(xlim=(0.0, 1.12 * widest), ylim=(0.0, 1.2 * highest))
    (curve,) = axes.plot(
        MM * curved[:, 0], curved[:, 1], color=inks.motion, lw=2.0 * scale,
        label=words["capacity_curve"], zorder=3.0,
    )  # fmt: skip
    if not mechanism.free:  # its curve begins with the line of the own period
        axes.annotate(
            symbol("a_0"), (0.0, mechanism.a0_g), (6.0, 2.0), textcoords="offset points",
            color=inks.motion, fontsize=text_size(axes, 8.0), zorder=4.0,
        )  # fmt: skip
    handles: list[Any] = [curve]
    limits = {"SLV": MM * mechanism.d_slv_m, "SLC": MM * mechanism.d_slc_m}
    periods = {"SLV": mechanism.t_slv_s, "SLC": mechanism.t_slc_s}
    for k, (state, limit) in enumerate(limits.items()):
        draw_limit(axes, limit, symbol(f"d_{state}"), zorder=2.0)
        crossed = [*limits.values(), *(demand for *_, demand in demands)]
        _draw_period(axes, words, (state, periods[state]), crossed, inks)
        colour = inks.series("base", len(STATES))[k]
        handles += _draw_spectrum(axes, demand, words, (state, DAMPINGS[state], colour), scale)
    draw_limit(axes, d0, symbol("d_0"), zorder=2.0)
    handles += _draw_demands(axes, demands, words, inks, periods)
    handles += _draw_accelerations(axes, at_zero, words, inks)
    if at_zero:
        name = mechanism.linear_name.replace("alpha_0", r"$\alpha_0$").replace("a0", "$a_0$")
        handles += axes.plot(
            [0.0], [mechanism.linear_g], "o", mfc=inks.paper, mec=inks.motion, ms=6.0 * scale,
            ls="none", zorder=4.0, clip_on=False, label=f"{words['capacity_linear']}, {name}",
        )  # fmt: skip
    axes.set(xlabel=words["axis_displacement"], ylabel=words["axis_acceleration"])
    decimal_marks(axes, words)
    draw_legend(axes, place, handles=handles)
    return axes


def _parts(
    check: FacadeCheck | Mechanism,
) -> tuple[Mechanism, FacadeDemand, tuple[LimitStateCheck, ...]]:
    """Return mechanism, demand and checks; of a mechanism alone there is no demand."""
    if isinstance(check, Mechanism):
        return check, FacadeDemand(), ()
    return check.mechanism, check.demand, check.checks


def _demands(checks: Sequence[LimitStateCheck]) -> list[tuple[LimitStateCheck, str, float]]:
    """Return the displacement demands of the nonlinear static and dynamic checks [mm]."""
    return [
        (each, each.limit_state, MM * each.demand)
        for each in checks
        if each.unit == "m" and each.demand is not None and math.isfinite(each.demand)
    ]


def _accelerations(checks: Sequence[LimitStateCheck]) -> list[tuple[LimitStateCheck, float]]:
    """Return the acceleration demands of the linear checks [g]."""
    return [
        (each, float(each.demand))
        for each in checks
        if each.unit == "g" and each.demand is not None and math.isfinite(each.demand)
    ]


def _draw_period(
    axes: "Axes", words: Language, state: tuple[str, float], crossed: list[float], inks: Inks
) -> None:
    """Draw the line of a period through the origin, with its name clear of what crosses it."""
    name, period = state
    slope = (2.0 * math.pi / period) ** 2 / STANDARD_GRAVITY / MM
    (right, top), size = (axes.get_xlim()[1], axes.get_ylim()[1]), text_size(axes, 8.0)
    axes.plot([0.0, right], [0.0, slope * right], color=inks.quiet, lw=0.8, ls=DOTTED, zorder=1.9)
    end = min(right, top / slope)
    text = words("period_of", symbol=symbol(f"T_{name}"), period=words.quantity(period, "s"))
    at = max(
        np.linspace(0.5, 0.92, 43) * end,
        key=lambda x: min(abs(x - place) for place in (*crossed, right)),
    )
    axes.text(
        at, slope * at, text, ha="center", va="center", color=inks.quiet,
        fontsize=size, zorder=2.1, bbox={"facecolor": inks.paper, "lw": 0.0, "pad": 1.0},
    )  # fmt: skip


def _draw_spectrum(
    axes: "Axes",
    demand: FacadeDemand,
    words: Language,
    state: tuple[str, float, str],
    scale: float,
) -> Sequence[Any]:
    """Draw the demand spectrum of a limit state, acceleration over displacement."""
    name, damping, colour = state
    spectrum: Any = getattr(demand, name.lower())
    if spectrum is None:
        return []
    period = np.geomspace(0.02, 4.0, PERIODS)
    acceleration = np.array([float(spectrum.sa_g(each, damping)) for each in period.tolist()])
    displacement = MM * STANDARD_GRAVITY * acceleration * (period / (2.0 * np.pi)) ** 2
    return axes.plot(
        displacement, acceleration, color=colour, lw=1.2 * scale,
        zorder=1.8, label=words("spectrum_of", state=name, damping=words.number(100.0 * damping)),
    )  # fmt: skip


def _draw_demands(
    axes: "Axes",
    demands: list[tuple[LimitStateCheck, str, float]],
    words: Language,
    inks: Inks,
    periods: dict[str, float],
) -> list[Any]:
    """Draw each displacement demand on the line of its period; those of runs on the abscissa."""
    right, top = axes.get_xlim()[1], axes.get_ylim()[1]
    handles = []
    for check, state, demand in demands:
        dynamic = check.method == "dynamic"
        colour = inks.series("base", len(STATES))[STATES.index(state)]
        slope = (2.0 * math.pi / periods[state]) ** 2 / STANDARD_GRAVITY / MM
        beyond = demand > right
        at = (min(demand, 0.985 * right), 0.0 if dynamic else min(slope * demand, 0.97 * top))
        mark = ">" if beyond else ("D" if dynamic else "s")
        handles += axes.plot(
            [at[0]], [at[1]], mark, color=inks.paper if dynamic else colour, mec=colour, mew=1.4,
            ms=7.0 * line_scale(axes), ls="none", zorder=4.0, clip_on=False,
            label=words("demand_dynamic" if dynamic else "demand_static", state=state),
        )  # fmt: skip
    return handles


def _draw_accelerations(
    axes: "Axes", demands: list[tuple[LimitStateCheck, float]], words: Language, inks: Inks
) -> list[Any]:
    """Draw the acceleration demands of the linear checks on the ordinate."""
    top = axes.get_ylim()[1]
    handles = []
    for check, demand in demands:
        colour = inks.series("base", len(STATES))[STATES.index(check.limit_state)]
        handles += axes.plot(
            [0.0], [min(demand, 0.985 * top)], "^" if demand > top else "_", color=colour,
            mew=2.4, ms=11.0 * line_scale(axes), ls="none", zorder=4.0, clip_on=False,
            label=words("demand_linear", state=check.limit_state),
        )  # fmt: skip
    return handles
