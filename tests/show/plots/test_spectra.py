"""Plots of rocking spectra: each shows the numbers it was given."""

from collections.abc import Callable
from functools import cache

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rocksteady import Status, compute_rocking_spectrum, plots
from rocksteady.errors import InputError
from rocksteady.measures import compute_suite_spectrum
from rocksteady.model.equations import Linear
from rocksteady.show.figures.spectra import spectrum_figure, suite_figure
from rocksteady.show.plots.spectra import MOST_CURVES, Quantity
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import HATCHES, LIGHT
from tests.every import every
from tests.seismic.grounds import ground

PERIODS = np.linspace(0.6, 6.0, 28)


@cache
def found(slendernesses: int = 3) -> xarray.Dataset:
    alpha = np.linspace(0.12, 0.4, slendernesses)
    # In descending order: pictures sort them.
    return compute_rocking_spectrum(
        ground(), alpha=alpha, periods_s=PERIODS[::-1], scales=1.5, model=Linear()
    )


@cache
def summary() -> xarray.Dataset:
    suite = [ground(seed, peak) for seed, peak in ((1, 3.0), (2, 4.0), (3, 6.0), (4, 9.0))]
    return compute_suite_spectrum(
        compute_rocking_spectrum(suite, alpha=[0.15, 0.25], periods_s=PERIODS, model=Linear())
    )


PLOTS: dict[str, Callable[[Axes | None], Axes]] = {
    "curves": lambda ax: plots.rocking_spectrum(found(), ax),
    "speeds": lambda ax: plots.rocking_spectrum(found(), ax, quantity="peak_velocity"),
    "one": lambda ax: plots.rocking_spectrum(found().isel(alpha=0), ax),
    "map": lambda ax: plots.spectrum_map(found(9), ax),
    "suite": lambda ax: plots.suite_spectrum(summary().isel(alpha=0), ax),
    "share": lambda ax: plots.share_that_falls(summary().isel(alpha=0), ax),
}
drawings = every("draw", PLOTS.values())


@drawings
def test_a_plot_draws_on_the_axes_it_is_given_with_its_labels(
    draw: Callable[[Axes | None], Axes],
) -> None:
    axes = Figure().add_subplot()
    assert draw(axes) is axes
    for label in (axes.get_xlabel(), axes.get_ylabel()):
        assert label in palette.LABELS.values()
    assert np.isfinite([*axes.get_xlim(), *axes.get_ylim()]).all()


@drawings
def test_a_plot_makes_its_own_axes_where_none_are_given(
    draw: Callable[[Axes | None], Axes],
) -> None:
    import matplotlib.pyplot as plt

    before = len(plt.get_fignums())
    axes = draw(None)
    assert len(plt.get_fignums()) == before + 1
    plt.close(axes.figure)  # type: ignore[arg-type]


def curves(axes: Axes) -> list[Line2D]:
    return [line for line in axes.lines if str(line.get_label()).startswith("α")]


def test_curves_are_the_peaks_with_gaps_where_blocks_overturn() -> None:
    quantities: tuple[Quantity, ...] = ("peak_angle", "peak_velocity")
    for quantity in quantities:
        axes = plots.rocking_spectrum(found(), Figure().add_subplot(), quantity=quantity)
        drawn = curves(axes)
        assert len(drawn) == 3
        for line, alpha in zip(drawn, found().alpha.values, strict=True):
            one = found().sel(alpha=alpha).sortby("period")
            np.testing.assert_array_equal(line.get_xdata(), one.period.values)
            expected = one[quantity].where(one.status != Status.OVERTURNED).values
            np.testing.assert_array_equal(line.get_ydata(), expected)


def test_bars_stand_where_blocks_overturn_a_row_a_slenderness() -> None:
    axes = plots.rocking_spectrum(found(), Figure().add_subplot())
    bars = [one for one in axes.collections if isinstance(one, PolyCollection)]
    fell = (found().sortby("period").status == Status.OVERTURNED).transpose("alpha", "period")
    rows = [row for row in fell.values if row.any()]
    assert len(rows) == len(bars) > 1
    for row, bar in zip(rows, bars, strict=True):
        assert to_hex(tuple(np.asarray(bar.get_facecolor())[0])) == LIGHT.falls
        assert bar.get_hatch() == HATCHES["falls"]
        boxes = [path.get_extents() for path in bar.get_paths()]
        covered = [any(box.x0 < period < box.x1 for box in boxes) for period in PERIODS]
        assert covered == row.tolist()
    names = [text.get_text() for text in axes.texts]
    assert sum(name.startswith("falls, ") for name in names) == len(bars)
    assert sum(name.startswith("α = ") for name in names) == 3
    drawn = [line.get_color() for line in curves(axes)]
    assert drawn == LIGHT.series("motion", 3)
    legend = plots.rocking_spectrum(found(), Figure().add_subplot(), legend="inside").get_legend()
    assert "falls" in [text.get_text() for text in legend.get_texts()]  # type: ignore[union-attr]


def test_a_spectrum_without_a_fall_says_nothing_of_falls() -> None:
    safe = compute_rocking_spectrum(ground(), alpha=0.4, periods_s=PERIODS, model=Linear())
    axes = plots.rocking_spectrum(safe, Figure().add_subplot())
    assert not axes.collections
    assert not any("falls" in text.get_text() for text in axes.texts)
    assert curves(axes)[0].get_color() == LIGHT.motion


def test_a_map_has_the_peaks_and_the_shares() -> None:
    whole = found(9)
    axes = plots.spectrum_map(whole, Figure().add_subplot())
    meshes = [one for one in axes.collections if isinstance(one, QuadMesh)]
    drawn = np.ma.MaskedArray(meshes[0].get_array())
    peaks = drawn.filled(np.nan).reshape(9, len(PERIODS))
    one = whole.sortby("period").transpose("alpha", "period")
    rocked = (one.status == Status.AT_REST) & (one.peak_angle > 0.0)
    np.testing.assert_array_equal(peaks, one.peak_angle.where(rocked).values)
    share = 100.0 * float((whole.status == Status.OVERTURNED).mean())
    words = [text.get_text() for text in axes.get_legend().get_texts()]  # type: ignore[union-attr]
    assert words[0] == f"falls  {share:.3g} %"


def test_the_suite_has_its_median_and_shares() -> None:
    part = summary().isel(alpha=1)
    axes = plots.suite_spectrum(part, Figure().add_subplot())
    median = part.peak_angle.sel(quantile=0.5).values
    drawn = np.asarray(axes.lines[0].get_ydata())
    finite = np.isfinite(median)
    np.testing.assert_array_equal(drawn[finite], np.minimum(median[finite], 2.0))
    assert (drawn[~finite] > axes.get_ylim()[1]).all()
    words = [text.get_text() for text in axes.texts]
    assert sorted(words) == ["16 to 84 %", "median of\n4 records"]
    share = plots.share_that_falls(part, Figure().add_subplot())
    (line,) = share.lines
    np.testing.assert_allclose(np.asarray(line.get_ydata(), dtype=float), 100.0 * part.overturned)
    assert line.get_color() == LIGHT.risk
    low, high = share.get_ylim()
    assert low < 0.0
    assert high > 100.0


def test_figures_have_both_peaks_or_a_column_a_slenderness() -> None:
    for dataset in (found(), found(MOST_CURVES + 1)):
        figure = spectrum_figure(dataset, "one")
        labels = {axes.get_ylabel() for axes in figure.axes}
        assert palette.LABELS["peak_velocity"] in labels
        assert figure.get_suptitle() == "one"
    figure = suite_figure(summary(), "many")
    assert len(figure.axes) == 4
    assert len(suite_figure(summary().isel(alpha=0)).axes) == 2


@every(
    ("draw", "words"),
    [
        (lambda: plots.rocking_spectrum(summary()), "result of compute_rocking_spectrum"),
        (lambda: plots.rocking_spectrum(found(MOST_CURVES + 1)), "drawn as curves"),
        (lambda: plots.rocking_spectrum(found().isel(period=0)), "two periods"),
        (lambda: plots.rocking_spectrum(found(), quantity="impacts"), "'peak_angle' or"),  # type: ignore[arg-type]
        (lambda: plots.spectrum_map(found().isel(alpha=0)), "two or more"),
        (lambda: plots.suite_spectrum(summary()), "one slenderness"),
        (lambda: plots.suite_spectrum(found()), "result of compute_suite_spectrum"),
        (
            lambda: plots.rocking_spectrum(
                compute_rocking_spectrum(
                    [ground(1), ground(2)], alpha=0.2, periods_s=[1.0, 2.0], model=Linear()
                )
            ),
            "one record and one scale",
        ),
    ],
)
def test_what_cannot_be_drawn_is_said(draw: Callable[[], Axes], words: str) -> None:
    with pytest.raises(InputError, match=words):
        draw()
