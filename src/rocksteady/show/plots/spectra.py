"""Plots of rocking spectra: curves or a map for one record, bands for a suite."""

from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.outcomes import Status
from rocksteady.show.style import palette
from rocksteady.show.style.areas import area_style, draw_pattern, swatch, write_words
from rocksteady.show.style.axes import (
    Spacing,
    lane_of,
    name_lane,
    prepare_axis,
    runs,
    spacing_of,
)
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import (
    GAP,
    LegendPlace,
    checked_place,
    draw_legend,
    figure_of,
)
from rocksteady.show.style.limits import name_level_end
from rocksteady.show.style.line_ends import LineEnd, name_line_ends
from rocksteady.show.style.tokens import DASHED, DOUBT, inks_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

Quantity = Literal["peak_angle", "peak_velocity"]

LABELS = {"peak_angle": palette.LABELS["peak"], "peak_velocity": palette.LABELS["peak_velocity"]}
MOST_CURVES = 6
"""Most slendernesses drawn as curves; more are drawn as a map."""
TIPPING = "tipping angle"
"""Name of the line at a peak of alpha."""


@checked
def plot_rocking_spectrum(
    dataset: "xarray.Dataset",
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "peak_angle",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the rocking spectrum of a record, one curve per slenderness.

    Each curve has its slenderness at its end.  Where a block falls its curve has a gap, and a
    hatched bar along the upper edge, in a row of its own that has the slenderness too.

    Parameters
    ----------
    dataset
        From `rocksteady.compute_rocking_spectrum`, of one record and one scale, over two periods
        or more, of at most six slendernesses.
    ax
        Axes to draw on; default: axes of a new figure.
    quantity
        "peak_angle" or "peak_velocity".
    legend
        "inside" the axes, to their "right", "below" them or "none"; default: names at the ends of
        the curves.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: 2 pi/p in seconds, and the peak.

    Raises
    ------
    InputError
        If it is no such spectrum, or the quantity another one.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record, compute_rocking_spectrum
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.2)
    >>> spectrum = compute_rocking_spectrum(shock, alpha=[0.1, 0.2], periods_s=[2.0, 3.0, 5.0, 8.0])
    >>> axes = plot_rocking_spectrum(spectrum, Figure().add_subplot())
    >>> [text.get_text() for text in axes.texts]
    ['falls, 5.73°', 'falls, 11.5°', 'α = 11.5°', 'α = 5.73°']
    """
    _check_quantity(quantity)
    spectrum = drawable(dataset)
    if "alpha" not in spectrum.dims:
        spectrum = spectrum.expand_dims("alpha")
    if spectrum.sizes["alpha"] > MOST_CURVES:
        raise InputError(
            "dataset",
            Words(f"has {spectrum.sizes['alpha']} slendernesses"),
            f"up to {MOST_CURVES} are drawn as curves",
            "draw a map of them with plot_spectrum_map, or select some with .sel",
        )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), checked_place(legend)
    spacing = _prepare(axes, spectrum)
    fell = spectrum["status"].transpose("alpha", "period").values == Status.OVERTURNED
    peaks = spectrum[quantity].transpose("alpha", "period").values
    peaks = np.where(
        _answered(spectrum["status"].transpose("alpha", "period").values), peaks, np.nan
    )
    handles: list[Artist] = []
    periods = spectrum["period"].values
    lanes = [row for row in range(len(peaks)) if fell[row].any()]
    height = lane_of(axes)
    top = 1.0 - height * len(lanes)
    slenderness = spectrum["alpha"].values.tolist()
    colours = inks.series("motion", len(slenderness))
    for row, (alpha, colour) in enumerate(zip(slenderness, colours, strict=True)):
        # A peak between two falls has no line: its dot would be lost without a mark.
        alone = _alone(peaks[row])
        handles += axes.plot(periods, peaks[row], label=slenderness_text(alpha), color=colour)
        axes.plot(periods[alone], peaks[row, alone], "o", ms=2.2, color=colour)
        if fell[row].any():
            lane = 1.0 - height * (lanes.index(row) + 1)
            bars = runs(fell[row], spacing.edges)
            edges = axes.get_xaxis_transform()
            style = area_style(inks, "falls") | {"linewidth": 0.4}
            axes.broken_barh(bars, (lane, 0.8 * height), transform=edges, zorder=4.5, **style)
            words = "falls" if len(slenderness) == 1 else f"falls, {_degrees(alpha)}"
            name_lane(axes, words, bars, lane + 0.4 * height, colour)
    highest = float(np.nanmax(peaks, initial=0.0)) or 1.0
    axes.set_ylim(0.0, highest / (top - 0.03))
    if quantity == "peak_angle" and highest > 0.9:  # where a block balances
        axes.axhline(1.0, color=inks.limit, lw=0.8, ls=DASHED, zorder=1.2)
        name_level_end(axes, 1.0, TIPPING, below=True)
    axes.set_ylabel(LABELS[quantity])
    if place is None:
        names = zip(slenderness, peaks, colours, strict=True)
        ends = [
            LineEnd(f"α = {_degrees(alpha)}", row, colour)
            for alpha, row, colour in names
            if np.isfinite(row).any()
        ]
        name_line_ends(axes, ends, most=min(1.0, top) - 0.5 * height)
        return axes
    if lanes:
        handles.append(swatch(inks, "falls", "falls"))
    draw_legend(axes, place, handles=handles, gap=50.0 if lanes else GAP)
    return axes


@checked
def plot_spectrum_map(
    dataset: "xarray.Dataset",
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "peak_angle",
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the rocking spectrum of a record over slenderness and size, as filled cells.

    Where the block falls cells are hatched, where it rests throughout pale, and where there is no
    answer (undecided, lost contact) grey with a crosshatch.

    Parameters
    ----------
    dataset
        From `rocksteady.compute_rocking_spectrum`, of one record and one scale, over two periods
        and two slendernesses or more.
    ax
        Axes to draw on; default: axes of a new figure.
    quantity
        "peak_angle" or "peak_velocity".
    legend
        "inside" the axes, to the "right" of the bar of colours, "below" the axes or "none"; above
        them by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: 2 pi/p in seconds, and alpha; a bar of colours beside them.

    Raises
    ------
    InputError
        If it is no such spectrum, or the quantity another one.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record, compute_rocking_spectrum
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.2)
    >>> spectrum = compute_rocking_spectrum(
    ...     shock, alpha=[0.1, 0.2, 0.3], periods_s=[2.0, 3.0, 5.0, 8.0]
    ... )
    >>> axes = plot_spectrum_map(spectrum, Figure().add_subplot())
    >>> for entry in axes.get_legend().get_texts():
    ...     print(entry.get_text())
    falls  25 %
    """
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap

    _check_quantity(quantity)
    spectrum = drawable(dataset)
    if spectrum.sizes.get("alpha", 1) < 2:
        raise InputError(
            "dataset",
            Words("has one slenderness"),
            "a map has two or more",
            "draw a curve with plot_rocking_spectrum",
        )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), checked_place(legend)
    spectrum = spectrum.sortby("alpha").transpose("alpha", "period", ...)
    across = _prepare(axes, spectrum)
    axes.set_xlim(across.edges[0], across.edges[-1])
    slenderness = spectrum["alpha"].values
    up = spacing_of(slenderness)
    prepare_axis(axes, "y", "alpha", slenderness, up)
    status, peaks = spectrum["status"].values, spectrum[quantity].values
    fell, still = status == Status.OVERTURNED, _answered(status) & (peaks == 0.0)
    rocked = _answered(status) & ~still
    colours = LinearSegmentedColormap.from_list("peaks", inks.rocks_ramp)
    highest = 1.0 if quantity == "peak_angle" else float(np.max(peaks[rocked], initial=0.0)) or 1.0
    places = across.edges, up.edges
    drawn = axes.pcolormesh(
        *places, np.where(rocked, peaks, np.nan), cmap=colours, vmin=0.0, vmax=highest
    )
    drawn.set_rasterized(True)
    handles = []
    codes = np.where(rocked, 0, np.where(fell, 1, np.where(still, 2, 3)))
    named = {}
    for code, (role, words) in enumerate(AREAS, 1):
        which = codes == code
        if not which.any():
            continue
        style = area_style(inks, role)
        cells = np.ma.masked_array(np.ones(which.shape), ~which)
        fill = ListedColormap([style["facecolor"]])
        axes.pcolormesh(*places, cells, cmap=fill, rasterized=True)
        draw_pattern(axes, places, which, style["hatch"] or "", style["edgecolor"])
        named[code] = (words, style["facecolor"])
        handles.append(swatch(inks, role, f"{words}  {100.0 * which.mean():.3g} %"))
    write_words(axes, places, codes, named)
    axes.grid(visible=False)
    bar = figure_of(axes).colorbar(drawn, ax=axes, pad=0.02)
    bar.set_label(LABELS[quantity], color=inks.ink)
    bar.ax.tick_params(colors=inks.ink)
    if place is None:
        above = draw_legend(
            axes, "inside", handles=handles, corner="lower left", columns=3, handleheight=1.3
        )
        if above is not None:
            above.set_bbox_to_anchor((0.0, 1.0), axes.transAxes)
    else:
        draw_legend(axes, place, handles=handles, corner="upper right", gap=60.0)
    return axes


AREAS = (("falls", "falls"), ("rest", "comes to rest"), ("undecided", "undecided"))
"""Roles and words of what has no peak."""


@checked
def plot_suite_spectrum(
    summary: "xarray.Dataset",
    ax: "Axes | None" = None,
    *,
    quantity: Quantity = "peak_angle",
    legend: LegendPlace | None = None,
) -> "Axes":
    r"""Draw the rocking spectrum of a suite for one slenderness: median and band.

    A quantile at which the block falls is drawn up to the upper edge: no peak is as large.

    Parameters
    ----------
    summary
        From `rocksteady.measures.compute_suite_spectrum`, of one slenderness and scale and three
        quantiles.
    ax
        Axes to draw on; default: axes of a new figure.
    quantity
        "peak_angle" or "peak_velocity".
    legend
        "inside" the axes, to their "right", "below" them or "none"; default: names at the ends of
        line and band.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: 2 pi/p in seconds, and the peak.

    Raises
    ------
    InputError
        If it is no such summary, or the quantity another one.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Record, compute_rocking_spectrum
    >>> from rocksteady.measures import compute_suite_spectrum
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.2)
    >>> suite = [shock.scaled(factor) for factor in (0.6, 0.8, 1.0)]
    >>> spectrum = compute_rocking_spectrum(suite, alpha=0.2, periods_s=[3.0, 5.0, 8.0])
    >>> axes = plot_suite_spectrum(compute_suite_spectrum(spectrum), Figure().add_subplot())
    >>> [text.get_text() for text in axes.texts]
    ['median of\n3 records', '16 to 84 %']
    """
    _check_quantity(quantity)
    curve, quantiles = _one_slenderness(summary)
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), checked_place(legend)
    _prepare(axes, curve)
    values = curve[quantity].transpose("quantile", "period").values
    if quantity == "peak_angle":
        ceiling = 1.0
    else:
        ceiling = 1.05 * float(np.max(values[np.isfinite(values)], initial=0.0)) or 1.0
    low, middle, high = np.minimum(values, 2.0 * ceiling)
    periods = curve["period"].values
    words = f"{100 * quantiles[0]:.3g} to {100 * quantiles[2]:.3g} %"
    name = "median" if quantiles[1] == 0.5 else f"{100 * quantiles[1]:.3g} %"
    axes.fill_between(
        periods, low, high, color=inks.motion, alpha=DOUBT, lw=0.0, label=words, zorder=1.5
    )
    axes.plot(
        periods,
        middle,
        color=inks.motion,
        lw=1.8,
        label=f"{name} of {summary.attrs['records']} records",
    )
    axes.set(ylim=(0.0, ceiling), ylabel=LABELS[quantity])
    if place is None:
        median = f"{name} of\n{summary.attrs['records']} records"
        ends = LineEnd(median, middle, inks.motion), LineEnd(words, high, inks.motion)
        name_line_ends(axes, ends)
        return axes
    handles, labels = axes.get_legend_handles_labels()
    draw_legend(axes, place, handles=handles[::-1], labels=labels[::-1])
    return axes


@checked
def plot_share_that_falls(summary: "xarray.Dataset", ax: "Axes | None" = None) -> "Axes":
    """Draw the share of records under which blocks of one slenderness fall.

    Parameters
    ----------
    summary
        As for `plots.suite_spectrum`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: 2 pi/p in seconds, and the share in percent.

    Raises
    ------
    InputError
        If it is no such summary.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import compute_rocking_spectrum
    >>> from rocksteady.measures import compute_suite_spectrum
    >>> from rocksteady.motions import make_synthetic_suite
    >>> spectra = compute_rocking_spectrum(make_synthetic_suite(3), alpha=0.2, periods_s=[1.0, 2.0])
    >>> axes = plot_share_that_falls(compute_suite_spectrum(spectra), Figure().add_subplot())
    >>> axes.get_ylabel()
    'share of records that fall [%]'
    """
    curve, _ = _one_slenderness(summary)
    axes = axes_or_new(ax)
    _prepare(axes, curve)
    share = 100.0 * curve["overturned"].values
    axes.plot(curve["period"].values, share, color=inks_of(axes).risk, lw=1.8, clip_on=False)
    axes.set(ylim=(-3.0, 103.0), ylabel=palette.LABELS["overturned_share"], yticks=(0, 50, 100))
    return axes


def drawable(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Return a spectrum over periods that ascend, and over slendernesses at most.

    Raises
    ------
    InputError
        If it is no spectrum, has several records or scales, or a single period.
    """
    given: object = dataset
    if not hasattr(given, "data_vars") or not {"status", *LABELS} <= set(dataset.data_vars):
        raise InputError(
            "dataset",
            sorted(map(str, getattr(given, "data_vars", {}))) or given,
            "it is the result of compute_rocking_spectrum",
            "compute compute_rocking_spectrum(record, alpha=..., periods_s=...)",
        )
    line = dataset.squeeze([name for name in ("record", "scale") if dataset.sizes.get(name) == 1])
    several = [name for name in ("record", "scale") if name in line.dims]
    if several:
        raise InputError(
            "dataset",
            Words(f"has {line.sizes[several[0]]} values of {several[0]}"),
            "one record and one scale are drawn",
            "select one with .isel, or draw the compute_suite_spectrum of the records",
        )
    _check_periods(line)
    return line.sortby("period")


def slenderness_text(alpha: float) -> str:
    """Return a slenderness in radians and degrees."""
    return f"α = {alpha:.4g} rad = {np.degrees(alpha):.3g}°"


def _degrees(alpha: float) -> str:
    """Return a slenderness in degrees."""
    return f"{np.degrees(alpha):.3g}°"


def _one_slenderness(summary: "xarray.Dataset") -> tuple["xarray.Dataset", list[float]]:
    """Return a summary over periods that ascend and three quantiles alone, and these."""
    given: object = summary
    if not hasattr(given, "dims") or "quantile" not in summary.dims or "overturned" not in summary:
        raise InputError(
            "summary",
            given,
            "it is the result of compute_suite_spectrum",
            "compute rs.measures.compute_suite_spectrum(compute_rocking_spectrum(records, ...))",
        )
    curve = summary.squeeze([name for name in ("alpha", "scale") if summary.sizes.get(name) == 1])
    if set(curve.dims) - {"quantile", "period"} or curve.sizes["quantile"] != 3:
        sizes = ", ".join(f"{size} of {name}" for name, size in curve.sizes.items())
        raise InputError(
            "summary",
            sizes,
            "three quantiles of one slenderness and one scale are drawn",
            "select with .isel, as summary.isel(alpha=0)",
        )
    _check_periods(curve)
    curve = curve.sortby("period").sortby("quantile")
    return curve, curve["quantile"].values.tolist()


def _check_periods(one: "xarray.Dataset") -> None:
    if one.sizes.get("period", 1) < 2:
        raise InputError(
            "dataset",
            Words("has one period"),
            "a spectrum is drawn over two periods or more",
            "compute compute_rocking_spectrum over several periods_s",
        )


def _check_quantity(quantity: object) -> None:
    if quantity not in LABELS:
        raise InputError(
            "quantity", quantity, "a spectrum has " + " and ".join(LABELS), "name one of them"
        )


def _prepare(axes: "Axes", spectrum: "xarray.Dataset") -> Spacing:
    """Give the axes their periods, and return the cells around them."""
    periods = spectrum["period"].values
    spacing = spacing_of(periods)
    prepare_axis(axes, "x", "period", periods, spacing)
    axes.set(xlim=(periods[0], periods[-1]), xlabel=palette.LABELS["rocking_period"])
    return spacing


def _answered(status: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Return where the largest motion is known: the block stands, or rocks on."""
    known: NDArray[np.bool_] = (status == Status.AT_REST) | (status == Status.ROCKING)
    return known


def _alone(values: Floats) -> NDArray[np.bool_]:
    """Return which values have no neighbour to draw a line to."""
    finite = np.pad(np.isfinite(values), 1)
    alone: NDArray[np.bool_] = finite[1:-1] & ~finite[:-2] & ~finite[2:]
    return alone
