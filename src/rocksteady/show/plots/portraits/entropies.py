"""Plots of how mixed basins are: entropies over a parameter, uncertain states over precision."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.basins.measures.entropy import BasinEntropies
from rocksteady.dynamics.basins.measures.uncertainty import UncertaintyExponent
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.show.style import palette
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import line_scale, text_size
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NATS = "entropy [nats]"
"""Label of an axis of entropies."""
FRACTAL = (math.log(2.0), "fractal\nabove ln 2")
"""Boundary entropy above which a boundary is fractal, and the name of its line."""


@checked
def plot_basin_entropies(entropies: BasinEntropies, ax: "Axes | None" = None) -> "Axes":
    """Draw the entropy of all boxes and of those on a boundary over a parameter.

    A boundary is fractal where the entropy of its boxes is above ln 2, the dashed line; below it
    either is possible. Where no box has two basins the boundary has no entropy.

    Parameters
    ----------
    entropies
        From `rocksteady.basins.BasinShares.entropies`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: the parameter, and entropy [nats].

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import SamplingOptions, compute_basin_shares
    >>> window = np.linspace(-1.0, 1.0, 20)
    >>> shares = compute_basin_shares(
    ...     DimensionlessBlock(restitution=0.9),
    ...     Harmonic(amplitude=1.0, frequency_ratio=4.0),
    ...     "amplitude",
    ...     [0.5, 1.0],
    ...     sampling=SamplingOptions(angles=window, velocities=window),
    ... )
    >>> axes = plot_basin_entropies(shares.entropies(5), Figure().add_subplot())
    >>> axes.get_ylabel()
    'entropy [nats]'
    """
    axes = axes_or_new(ax)
    inks, size = inks_of(axes), line_scale(axes)
    curves = {"boundary\nboxes": entropies.boundary_entropy, "all\nboxes": entropies.entropy}
    colours = inks.series("motion", len(curves))
    ends = []
    for mark, colour, (name, values) in zip("os", colours, curves.items(), strict=True):
        axes.plot(
            entropies.values, values, color=colour, marker=mark, ms=3.0 * size, lw=1.3 * size,
            clip_on=False, zorder=2.5,
        )  # fmt: skip
        if np.isfinite(values).any():
            ends.append(LineEnd(name, values, colour))
    level, words = FRACTAL
    top = max(level, *(float(np.nanmax(end.values)) for end in ends))
    ends.append(LineEnd(words, level, inks.limit))
    axes.axhline(level, color=inks.limit, lw=size, ls=DASHED, zorder=2.0)
    axes.set(ylim=(0.0, 1.12 * top), xlabel=palette.axis_label(entropies.parameter), ylabel=NATS)
    name_line_ends(axes, ends)
    return axes


@checked
def plot_uncertainty(exponent: UncertaintyExponent, ax: "Axes | None" = None) -> "Axes":
    """Draw the share of uncertain states or boxes over the error, with the fit.

    The smoother the boundary, the steeper the line: of slope 1 for a smooth one. Sizes at which
    nothing is uncertain have no dot.

    Parameters
    ----------
    exponent
        From `rocksteady.basins.compute_uncertainty_exponent`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: error of a state, or side of a box, in cells, and share; both logarithmic.

    Raises
    ------
    ModelError
        If nothing is uncertain.

    Examples
    --------
    >>> import numpy as np
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.basins import compute_uncertainty_exponent
    >>> x, y = np.meshgrid(np.arange(200), np.arange(200))
    >>> axes = plot_uncertainty(compute_uncertainty_exponent(x > 120), Figure().add_subplot())
    >>> axes.texts[0].get_text()
    'exponent 1.000 ± 0.000'
    """
    seen = exponent.uncertain > 0
    if not seen.any():
        words, hint = Words(f"has no uncertain {exponent.by}"), "take a window with two basins"
        raise ModelError("exponent", words, "the picture is of those near a boundary", hint)
    axes = axes_or_new(ax)
    inks, size = inks_of(axes), line_scale(axes)
    at, share = exponent.size[seen], exponent.share[seen]
    text = NOT_IDENTIFIED
    if not math.isnan(exponent.exponent):
        text = f"exponent {exponent.exponent:.3f} ± {exponent.standard_error:.3f}"
        axes.plot(at, exponent.fitted[seen], color=inks.quiet, lw=1.2 * size, zorder=2.0)
    axes.plot(at, share, "o", color=inks.motion, ms=4.5 * size, zorder=2.5)
    style: dict[str, Any] = {"fontsize": text_size(axes, 8.0), "color": inks.ink, "va": "top"}
    axes.text(0.03, 0.97, text, transform=axes.transAxes, **style)  # lines rise to the right
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="error of a state [cells]" if exponent.by == "states" else "side of a box [cells]",
        ylabel=f"share of uncertain {exponent.by}",
    )
    plain_ticks(axes)
    return axes
