"""Plots of what follows from tests for a block: a parameter before and after them."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.limits import draw_limit
from rocksteady.show.style.tokens import DASHED, DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes


WITHIN = 10
"""Bars between the ends of the interval of 90 %."""
LEAST_BARS, MOST_BARS = 20, 120
AXIS = {
    "alpha_rad": palette.LABELS["alpha"],
    "p_rad_s": palette.LABELS["p"],
    "restitution": "restitution",
    "housner_factor": "restitution over Housner's value",
    "base": "base that rocks over the outline's",
    "offset": "mass centre off the middle over half the base",
    "scatter": "scatter of the restitution",
    "orientation_rad": "orientation [rad]",
}
"""Labels of parameters; those in metres have their own names."""


@checked
def plot_posterior(
    calibration: Calibration,
    ax: "Axes | None" = None,
    *,
    parameter: str = "alpha_rad",
    object: str | None = None,  # noqa: A002 -- the word of every table
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw a parameter before and after the tests, with its interval of 90 %.

    The alpha of the outline is marked: the calibrated one is that of rocking, and may differ from
    the measured one.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    parameter
        Name of a parameter of the block; default "alpha_rad".
    object
        Name of the object; default the first.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the parameter, and its density.

    Raises
    ------
    InputError
        If there is no such object, or no such parameter.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_posterior(calibration, Figure().add_subplot())
    >>> axes.get_ylabel()
    'density'
    """
    from matplotlib.patches import Patch

    objects = list(calibration.posteriors)
    name = objects[0] if object is None else object
    if name not in objects:
        raise InputError("object", name, "the objects are " + ", ".join(objects), "name one")
    posterior = calibration.posteriors[name]
    if parameter not in posterior.columns:
        valid = "the parameters are " + ", ".join(posterior.columns)
        raise InputError("parameter", parameter, valid, "name one")
    (row,) = (
        each
        for each in calibration.parameters
        if (each["object"], each["parameter"]) == (name, parameter)
    )
    axes = axes_or_new(ax)
    inks, place, size = inks_of(axes), place_of(axes, legend, "below"), line_scale(axes)
    values = posterior.of(parameter)
    known = row["low"] is not None
    edges = _edges(
        values,
        row["low"] if known else row["prior_low"],
        row["high"] if known else row["prior_high"],
    )
    after, _ = np.histogram(values, edges, weights=posterior.weights, density=True)
    before, _ = np.histogram(values, edges, weights=posterior.prior_weights, density=True)
    bars = axes.stairs(
        after, edges, fill=True, color=inks.motion, alpha=DOUBT, lw=0.0, label="after the tests",
        zorder=2.0,
    )  # fmt: skip
    axes.stairs(after, edges, color=inks.motion, lw=1.2 * size, zorder=2.4)
    line = axes.stairs(
        before, edges, color=inks.quiet, lw=1.1 * size, ls=DASHED, label="before them",
        zorder=2.6,
    )  # fmt: skip
    top = float(max(after.max(), before.max()))
    handles: list[Artist] = [bars, line]
    if known:
        handles += axes.plot(
            [row["low"], row["high"]], [0.0, 0.0], color=inks.motion, lw=3.2 * size,
            solid_capstyle="butt", label="90\N{NO-BREAK SPACE}% interval and median", zorder=3.0,
            clip_on=False,
        )  # fmt: skip
        axes.plot(
            row["median"], 0.0, "o", ms=5.0 * size, color=inks.paper, mec=inks.motion,
            mew=1.4 * size, zorder=3.2, clip_on=False,
        )  # fmt: skip
    else:
        handles.append(Patch(fc="none", ec="none", label=NOT_IDENTIFIED))
    outline = row.get("outline")
    if outline is not None and np.isfinite(outline):
        draw_limit(axes, outline, "alpha of the outline", zorder=2.8)
    axes.set(
        xlabel=AXIS.get(parameter, parameter.replace("_m", " [m]").replace("_", " ")),
        ylabel="density",
        ylim=(0.0, 1.08 * top),
    )
    axes.set_yticks([])
    axes.grid(visible=False, axis="y")
    draw_legend(axes, place, handles=handles)
    return axes


def _edges(values: Floats, low: float, high: float) -> Floats:
    """Return edges of bars over all draws, some ten of them in the interval."""
    first, last = float(values.min()), float(values.max())
    if not last > first:
        half = 0.01 * abs(first) or 0.01
        return np.array([first - half, first + half])
    width = min(max((high - low) / WITHIN, (last - first) / MOST_BARS), (last - first) / LEAST_BARS)
    return np.linspace(first, last, int(np.ceil((last - first) / width)) + 1)
