"""Plots of recorded ground motions: time histories, Husid's curve, response spectra."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.seismic.measures.intensity import Measures
from rocksteady.seismic.measures.response_spectrum import ResponseSpectrum
from rocksteady.seismic.measures.time_course import IntegratedRecord, integrate_record
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new, plain_ticks, spaced_by_ratio
from rocksteady.show.style.legends import (
    LETTER,
    LegendPlace,
    draw_legend,
    place_of,
    size_of,
    text_size,
)
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

Quantity = Literal["acceleration", "velocity", "displacement"]

PEAKS = {"acceleration": "PGA", "velocity": "PGV", "displacement": "PGD"}
"""What a quantity's largest value is called."""
LEGEND_HOLDS = 6
"""Spectra that have a legend entry each; more are drawn alike."""

LONGEST_NAME = 0.3
"""Longest name at the end of a line, in parts of the width of the axes."""
LEAST_SHOWN = 3.0e-4
"""Smallest ordinate over the largest that an axis of powers shows."""


@checked
def plot_integrated_record(
    course: IntegratedRecord | Measures,
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "acceleration",
) -> "Axes":
    """Draw ground acceleration, velocity or displacement, with its largest value marked.

    Parameters
    ----------
    course
        From `rocksteady.measures.integrate_record`; or the measures of a record.
    ax
        Axes to draw on; default: axes of a new figure.
    quantity
        "acceleration", "velocity" or "displacement".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: seconds, and g, m/s or m.

    Raises
    ------
    InputError
        If there is no such quantity.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record
    >>> from rocksteady.measures import integrate_record
    >>> course = integrate_record(Record(acceleration_m_s2=[0.0, 3.0, -2.0, 0.0], dt_s=0.1))
    >>> axes = plot_integrated_record(course, Figure().add_subplot(), quantity="velocity")
    >>> axes.get_ylabel(), axes.texts[0].get_text()
    ('velocity [m/s]', 'PGV = 0.24 m/s')
    """
    refuse_unknown(quantity)
    if isinstance(course, Measures):
        course = integrate_record(course.record)
    axes = axes_or_new(ax)
    values, peak, scale, unit = {
        "acceleration": (course.acceleration_m_s2, course.peak_acceleration, STANDARD_GRAVITY, "g"),
        "velocity": (course.velocity_m_s, course.peak_velocity, 1.0, "m/s"),
        "displacement": (course.displacement_m, course.peak_displacement, 1.0, "m"),
    }[quantity]
    values, size = values / scale, peak.value / scale
    inks = inks_of(axes)
    axes.axhline(0.0, color=inks.edge, lw=0.6)
    axes.plot(course.t_s, values, color=inks.base, lw=0.8)
    axes.plot(peak.t_s, size, "o", ms=4.5, color=inks.base, mec=inks.paper, mew=0.6, zorder=3.0)
    late = peak.t_s > 0.6 * float(course.t_s[-1])
    axes.annotate(
        f"{PEAKS[quantity]} = {abs(size):.3g} {unit}",
        (peak.t_s, size),
        (-6.0 if late else 6.0, 0.0),
        textcoords="offset points",
        ha="right" if late else "left",
        va="center",
        fontsize=text_size(axes, 8.0),
        color=inks.ink,
    )
    low, high = min(float(values.min()), size, 0.0), max(float(values.max()), size, 0.0)
    room = 0.08 * (high - low)
    axes.set(
        xlabel=palette.LABELS["seconds"],
        ylabel=palette.LABELS[f"ground_{quantity}"],
        xlim=(0.0, float(course.t_s[-1])),
        ylim=(low - room, high + room),
    )
    return axes


def refuse_unknown(quantity: object) -> None:
    """Refuse what is no quantity of a base motion.

    Raises
    ------
    InputError
        If there is no such quantity.
    """
    if quantity not in PEAKS:
        raise InputError(
            "quantity",
            quantity,
            "it must be one of " + ", ".join(PEAKS),
            "leave it out for the acceleration",
        )


@checked
def plot_husid(course: IntegratedRecord, ax: "Axes | None" = None) -> "Axes":
    """Draw Husid's curve, the normalised Arias intensity against time, with 5, 75 and 95 % marked.

    Parameters
    ----------
    course
        From `rocksteady.measures.integrate_record`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: seconds, and parts from 0 to 1.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record
    >>> from rocksteady.measures import integrate_record
    >>> course = integrate_record(Record(acceleration_m_s2=[0.0, 3.0, -2.0, 0.0], dt_s=0.1))
    >>> axes = plot_husid(course, Figure().add_subplot())
    >>> axes.get_ylabel()
    'part of Arias intensity'
    """
    axes = axes_or_new(ax)
    begin, most, end = (course.time_of_arias(part) for part in (0.05, 0.75, 0.95))
    inks, small = inks_of(axes), text_size(axes, 8.0)
    axes.plot(course.t_s, course.husid, color=inks.base)
    parts = [0.05, 0.75, 0.95]
    axes.plot([begin, most, end], parts, "o", ms=4.5, color=inks.base, mec=inks.paper, mew=0.6)
    for at, part in zip((begin, most, end), parts, strict=True):
        early = at < 0.15 * float(course.t_s[-1])
        axes.annotate(
            f"{100.0 * part:.0f} %",
            (at, part),
            (6.0 if early else -5.0, 0.0),
            textcoords="offset points",
            ha="left" if early else "right",
            va="center" if early else "bottom",
            fontsize=small,
            color=inks.ink,
        )
    words = (
        f"Arias intensity {float(course.arias_m_s[-1]):.3g} m/s\n"
        f"5 to 75 %: {most - begin:.3g} s\n5 to 95 %: {end - begin:.3g} s"
    )
    # The curve rises: below its end nothing is drawn.
    style: dict[str, Any] = {"ha": "right", "va": "bottom", "fontsize": small, "color": inks.ink}
    axes.text(0.98, 0.06, words, transform=axes.transAxes, **style)
    axes.set(
        xlabel=palette.LABELS["seconds"],
        ylabel=palette.LABELS["husid"],
        xlim=(0.0, float(course.t_s[-1])),
        ylim=(-0.03, 1.03),
    )
    return axes


@checked
def plot_response_spectra(
    spectra: ResponseSpectrum | Sequence[ResponseSpectrum],
    ax: "Axes | None" = None,
    *,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw pseudo-acceleration against period, with the geometric mean of several records.

    Up to six records have their names at the ends of their lines, where these are short enough.

    Parameters
    ----------
    spectra
        One or several of `rocksteady.measures.compute_response_spectrum`, at the same periods.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        Legend of several records: "inside" the axes, to their "right", "below" them or "none"; by
        default inside, or below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: seconds and g, logarithmic where the periods are spaced like that.

    Raises
    ------
    InputError
        If there are none, or they have different periods.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record
    >>> from rocksteady.measures import compute_response_spectrum
    >>> record = Record(acceleration_m_s2=[0.0, 3.0, -2.0, 0.0], dt_s=0.1, name="three")
    >>> spectrum = compute_response_spectrum(record, [0.1, 0.5, 1.0])
    >>> axes = plot_response_spectra(spectrum, Figure().add_subplot())
    >>> axes.get_xlabel()
    'period  $T$ [s]'
    """
    if isinstance(spectra, ResponseSpectrum):
        spectra = [spectra]
    if not spectra or any(
        not np.array_equal(spectrum.periods_s, spectra[0].periods_s) for spectrum in spectra
    ):
        raise InputError(
            "spectra",
            Words(f"are {len(spectra)}"),
            "there must be one or more, all at the same periods",
            "compute_response_spectrum of each record at one array of periods",
        )
    axes = axes_or_new(ax)
    periods = spectra[0].periods_s
    values = np.array(
        [spectrum.pseudo_acceleration_m_s2 / STANDARD_GRAVITY for spectrum in spectra]
    )
    few = len(spectra) <= LEGEND_HOLDS
    inks, place = inks_of(axes), place_of(axes, legend, "inside", width=160.0)
    colours = inks.series("base", len(spectra)) if few else [inks.base] * len(spectra)
    lines: list[Line2D] = []
    for number, (spectrum, row) in enumerate(zip(spectra, values, strict=True)):
        name = spectrum.record.name or f"record {number + 1}"
        lines += axes.plot(
            periods,
            row,
            color=colours[number],
            lw=1.0 if few else 0.6,
            alpha=1.0 if few else 0.4,
            label=literal(palette.shortened(name, 40)),
        )
    handles = lines
    if len(spectra) > 1:
        mean = np.exp(np.log(values).mean(axis=0))
        drawn = axes.plot(
            periods, mean, color=inks.base, lw=2.4, label="geometric mean", zorder=3.0
        )
        if not few:
            lines[0].set_label(f"{len(spectra)} records")
        handles = [*(lines if few else lines[:1]), *drawn]
    if spaced_by_ratio(periods):
        axes.set_xscale("log")
        axes.set_yscale("log")
        low, high = float(values.min()), float(values.max())
        axes.set_ylim(0.8 * max(low, high * LEAST_SHOWN), 1.3 * high)
        plain_ticks(axes)
    else:
        axes.set_ylim(0.0, 1.05 * float(values.max()))
    axes.set(
        xlabel=palette.LABELS["period"],
        ylabel=palette.LABELS["pseudo_acceleration"],
        xlim=(float(periods.min()), float(periods.max())) if len(periods) > 1 else None,
    )
    damping = f"{100.0 * spectra[0].damping:g} % damping"
    small = text_size(axes, 8.0)
    names = [str(line.get_label()) for line in handles]
    room = LONGEST_NAME * size_of(axes)[0]
    fit = max(map(len, names)) * LETTER * small <= room
    if few and len(spectra) > 1 and legend is None and fit:
        name_line_ends(
            axes,
            [
                LineEnd(name, line.get_ydata(), str(line.get_color()))
                for name, line in zip(names, handles, strict=True)
            ],
        )
        handles = []
    if len(spectra) > 1 and handles:
        draw_legend(axes, place, handles=handles, corner="lower left", title=damping)
    else:  # spectra fall to the right
        style: dict[str, Any] = {"fontsize": small, "color": inks.ink}
        axes.text(0.02, 0.04, damping, transform=axes.transAxes, **style)
    return axes
