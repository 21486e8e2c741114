"""Plot of response spectra of floors, with the formulas of codes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.record import Record
from rocksteady.risk.screens.floors import HEIGHT_RATIO, PERIOD, floor_accelerations
from rocksteady.seismic.measures.response_spectrum import compute_response_spectrum
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import draw_legend
from rocksteady.show.style.tokens import DASHED, DOTTED, DOUBT, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PERIODS = np.geomspace(0.05, 4.0, 60)
STYLES = (DASHED, DOTTED, "-.")
"""Of the lines of the codes."""


@checked
def plot_floor_spectra(
    floors: Sequence[Record],
    ax: "Axes | None" = None,
    *,
    building_period_s: Annotated[float, PERIOD],
    height_ratio: Annotated[float, HEIGHT_RATIO],
) -> "Axes":
    """Draw the spectra of a floor over the ground's peak, with three codes.

    Parameters
    ----------
    floors
        Records of the floor, from `rocksteady.floor_motion`, one or more.
    ax
        Axes to draw on; default: axes of a new figure.
    building_period_s, height_ratio
        T_1 [s] and z/H for `rocksteady.codes.floor_accelerations`.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: period, and acceleration of 5 % damping over the ground's peak.

    Raises
    ------
    InputError
        If there is no record, or a number is outside its range.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import floor_motion
    >>> from rocksteady.motions import make_synthetic_suite
    >>> suite = make_synthetic_suite(2)
    >>> floors = [floor_motion(each, frequencies_hz=2.0, shapes=1.3) for each in suite]
    >>> axes = plot_floor_spectra(
    ...     floors, Figure().add_subplot(), building_period_s=0.5, height_ratio=1.0
    ... )
    >>> [line.get_label() for line in axes.lines]
    ['median floor spectrum', 'ASCE 7-22, peak of the floor', 'EN 1998-1', 'NTC 2018']
    """
    if not floors:
        raise InputError("floors", floors, "there must be one or more", "give floor_motion(...)")
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    shares = [
        compute_response_spectrum(floor, PERIODS).acceleration_m_s2
        / floor.reference.peak_acceleration_m_s2
        for floor in floors
    ]
    low, middle, high = np.quantile(shares, (0.16, 0.5, 0.84), axis=0)
    axes.fill_between(
        PERIODS,
        low,
        high,
        color=inks.base,
        alpha=DOUBT,
        lw=0.0,
        label=f"16 to 84 % of {len(floors):,} records",
    )
    axes.plot(PERIODS, middle, color=inks.base, label="median floor spectrum")
    codes = floor_accelerations(
        PERIODS, pga_g=1.0, building_period_s=building_period_s, height_ratio=height_ratio
    )
    for (code, values), style in zip(codes.items(), STYLES, strict=True):
        name = code + ", peak of the floor" * code.startswith("ASCE")
        axes.plot(PERIODS, values, color=inks.limit, ls=style, lw=1.2, label=name)
    axes.set(
        xscale="log",
        xlim=(PERIODS[0], PERIODS[-1]),
        ylim=(0.0, None),
        xlabel=r"period of the component  $T_a$ [s]",
        ylabel="acceleration on the floor / PGA",
    )
    plain_ticks(axes)
    draw_legend(axes, "below")
    return axes
