"""Plots of overturning spectra and of free rocking: each shows the numbers it was given."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.path import Path

from rocksteady import (
    Block,
    DimensionlessBlock,
    Pulse,
    Record,
    find_overturning_scales,
    find_overturning_windows,
    plots,
)
from rocksteady.errors import InputError
from rocksteady.formulas import free_rocking_period, overturning_amplitude
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.equations import Nonlinear
from rocksteady.motions import Floor
from rocksteady.overturning import OverturningWindows
from rocksteady.show.figures.single import overturning_figure
from rocksteady.show.plots.overturning import MODES
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, HATCHES, LIGHT
from tests.every import every


@cache
def found(shape: str = "one-sine", top: float = 12.0, count: int = 15) -> OverturningWindows:
    block, ratios = DimensionlessBlock(restitution=0.9), np.linspace(1.0, 8.0, count)
    return find_overturning_windows(block, shape, ratios, within=(1.0, top))


PLOTS: dict[str, Callable[[Axes | None], Axes]] = {
    "sine": lambda ax: plots.overturning(found(), ax),
    "cosine": lambda ax: plots.overturning(found("one-cosine"), ax),
    "wavelet": lambda ax: plots.overturning(found("type-c1"), ax),
    "short": lambda ax: plots.overturning(found("half-sine", 3.0), ax),
    "free": lambda ax: plots.free_rocking([0.9, 0.7], ax),
    "bare": lambda ax: plots.free_rocking((), ax),
}
drawings = every("draw", PLOTS.values())


@pytest.mark.slow
@drawings
def test_a_plot_draws_on_the_axes_it_is_given_with_its_labels(
    draw: Callable[[Axes | None], Axes],
) -> None:
    axes = Figure().add_subplot()
    assert draw(axes) is axes
    for label in (axes.get_xlabel(), axes.get_ylabel()):
        assert label in palette.LABELS.values()
    assert np.isfinite([*axes.get_xlim(), *axes.get_ylim()]).all()


@pytest.mark.slow
@drawings
def test_a_plot_makes_axes_of_its_own_and_leaves_the_settings(
    draw: Callable[[Axes | None], Axes],
) -> None:
    settings = dict(mpl.rcParams)
    axes = draw(None)
    try:
        assert plt.gcf() is axes.figure
        assert dict(mpl.rcParams) == settings
    finally:
        plt.close("all")


def hatch_at(axes: Axes, x: float, y: float) -> str | None:
    """The pattern of the one piece that covers a point, all of which fall; None where it stands."""
    covering = [
        collection.get_hatch()
        for collection in axes.collections
        if isinstance(collection, PolyCollection)
        for outline in collection.get_paths()
        if Path(outline.vertices).contains_point((x, y))
    ]
    assert len(set(covering)) <= 1
    return covering[0] if covering else None


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
def test_every_point_has_the_fill_of_its_way_of_overturning(shape: str) -> None:
    windows = found(shape, count=36)
    axes = plots.overturning(windows, Figure().add_subplot())
    pattern = {least: hatch for _, hatch, least in MODES}
    fills = [each for each in axes.collections if isinstance(each, PolyCollection)]
    assert {to_hex(np.asarray(each.get_facecolor())[0].tolist()) for each in fills} == {LIGHT.falls}
    seen = set()
    for index in range(1, 35):
        w = float(windows.frequency_ratio[index])
        for a in np.linspace(1.05, 11.9, 60).tolist():
            inside = [one for one in windows.at(index) if one.low < a < one.high]
            expected = pattern[min(inside[0].impacts, 2)] if inside else None
            assert hatch_at(axes, w, a) == expected, (w, a)
            seen.add(expected)
    assert len(seen) >= 3


@pytest.mark.slow
def test_windows_left_out_are_not_drawn_as_standing() -> None:
    windows = find_overturning_windows(
        DimensionlessBlock(restitution=0.9), "type-c2", [0.7, 3.0], resolution=0.01
    )
    listed = windows.intervals(0)
    hidden = next(
        middle
        for middle in (0.5 * (low + high) for low, high in windows.unlisted(0))
        if not any(low <= middle <= high for low, high in listed)
    )
    axes = plots.overturning(windows, Figure().add_subplot())
    assert hatch_at(axes, 0.71, hidden) == HATCHES["undecided"]
    legend = axes.get_legend()
    assert legend is not None
    assert "narrower windows, not listed" in [text.get_text() for text in legend.get_texts()]


@pytest.mark.slow
def test_rims_of_narrow_windows_lie_beneath_what_falls() -> None:
    windows = find_overturning_windows(DimensionlessBlock(restitution=0.9), "type-c2", [0.7, 3.0])
    with palette.on_paper(DARK), palette.style():
        axes = plots.overturning(windows, Figure().add_subplot())
    falls = next(each for each in axes.collections if isinstance(each, PolyCollection))
    rims = [
        each
        for each in axes.collections
        if isinstance(each, LineCollection)
        and len(each.get_segments())
        and to_hex(np.asarray(each.get_edgecolor(), float)[0]) == DARK.edge
    ]
    beneath = [each for each in rims if each.get_zorder() < falls.get_zorder()]
    assert beneath
    assert len(beneath) < len(rims)
    widths = {each: float(np.ravel(each.get_linewidth())[0]) for each in rims}
    assert max(widths[each] for each in beneath) < min(
        width for each, width in widths.items() if each not in beneath
    )


@pytest.mark.slow
def test_on_a_floor_falls_are_of_one_kind_from_the_least_amplitude_on() -> None:
    block = Block.rectangle(width=0.5, height=2.0)
    windows = find_overturning_windows(
        block, "one-sine", [2.4, 2.8], resolution=0.05, floor=Floor(frequencies_hz=1.7)
    )
    axes = plots.overturning(windows, Figure().add_subplot(), legend="right")
    assert not axes.lines
    written = [text.get_text() for text in axes.texts]
    if legend := axes.get_legend():
        written += [text.get_text() for text in legend.get_texts()]
    assert "falls" in written
    assert not any("impact" in text for text in written)
    low = windows.within[0] * block.uplift_acceleration / STANDARD_GRAVITY
    assert axes.get_ylim()[0] == pytest.approx(low)


def test_the_closed_form_is_drawn_where_there_is_one() -> None:
    (line,) = plots.overturning(found(), Figure().add_subplot()).lines
    x, y = (np.asarray(data, dtype=np.float64) for data in line.get_data())
    np.testing.assert_array_equal(y, overturning_amplitude("one-sine", x))
    assert not plots.overturning(found(), Figure().add_subplot(), closed_form=False).lines
    assert not plots.overturning(found("type-c1"), Figure().add_subplot()).lines


def test_of_the_full_equations_the_curve_is_that_of_the_linear_model() -> None:
    block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    full = find_overturning_windows(block, "one-sine", [4.0, 5.0], model=Nonlinear())
    axes = plots.overturning(full, Figure().add_subplot())
    (line,) = axes.lines
    assert line.get_label() == "closed form of the linear model"
    assert line.get_linestyle() == "--"
    g, hertz = block.uplift_acceleration / block.gravity, block.p / (2.0 * np.pi)
    for index, w in enumerate((4.01, 4.99)):
        for window in full.at(index):
            pattern = {least: hatch for _, hatch, least in MODES}[window.impacts]
            assert hatch_at(axes, w * hertz, 0.5 * (window.low + window.high) * g) == pattern
    assert axes.get_xlabel() == palette.LABELS["freq_hz"]
    assert axes.get_xlim() == pytest.approx((4.0 * hertz, 5.0 * hertz))
    assert axes.get_ylabel() == palette.LABELS["accel_g"]


def test_areas_and_legend_name_what_is_there_once_in_the_same_words() -> None:
    def words(shape: str, top: float) -> list[str]:
        axes = plots.overturning(found(shape, top), Figure().add_subplot())
        legend = axes.get_legend()
        assert legend is not None
        texts = [*legend.get_texts(), *axes.texts]
        return sorted(text.get_text().removeprefix("falls ") for text in texts)

    modes = [name.removeprefix("falls ") for name, *_ in MODES]
    others = ["closed form, without an impact", "stands"]
    assert words("one-sine", 12.0) == sorted([*modes[:2], *others])
    assert modes[1] not in words("half-sine", 3.0)


def test_a_tall_range_is_logarithmic_and_a_short_one_is_not() -> None:
    assert plots.overturning(found(), Figure().add_subplot()).get_yscale() == "log"
    assert (
        plots.overturning(found("half-sine", 3.0), Figure().add_subplot()).get_yscale() == "linear"
    )


def test_one_frequency_is_no_spectrum() -> None:
    one = find_overturning_windows(DimensionlessBlock(restitution=0.9), "one-sine", [2.0])
    with pytest.raises(InputError, match="two or more"):
        plots.overturning(one, Figure().add_subplot())


def test_the_curve_of_free_rocking_is_the_closed_form_with_its_marks_on_it() -> None:
    curve, *marks = plots.free_rocking([0.9, 0.7], Figure().add_subplot()).lines
    for line in (curve, *marks):
        x, y = (np.asarray(data, dtype=np.float64) for data in line.get_data())
        np.testing.assert_allclose(y, free_rocking_period(x), rtol=1e-14)
    assert len(marks) == 2


def test_a_figure_has_its_title() -> None:
    figure = overturning_figure(found(), "one-sine pulse")
    assert figure.get_suptitle() == "one-sine pulse"


def drawn(*ends: tuple[float, float, int, float, float, int]) -> Axes:
    """Plot windows of two frequencies: ends and impacts at the first, then at the second."""
    rows = np.array(ends, dtype=np.float64).reshape(-1, 2, 3).transpose(1, 0, 2)
    windows = replace(
        found(),
        frequency_ratio=np.array([2.0, 3.0]),
        low=rows[..., 0],
        high=rows[..., 1],
        impacts=rows[..., 2].astype(int),
        side=np.ones(rows.shape[:2], dtype=int),
        first=rows[:, 0, 0],
        opposite=rows[:, 0, 0],
    )
    return plots.overturning(windows, Figure().add_subplot())


def test_a_narrow_window_that_leans_is_drawn_through_to_the_next_frequency() -> None:
    leans = drawn((2.0, 2.1, 0, 2.3, 2.4, 0), (5.0, 6.0, 1, 5.0, 6.0, 1))
    assert hatch_at(leans, 2.5, 2.2) == MODES[0][1]
    jumps = drawn((2.0, 2.1, 0, 3.0, 3.1, 0), (5.0, 6.0, 1, 5.0, 6.0, 1))
    assert hatch_at(jumps, 2.5, 2.55) is None
    alone = drawn((2.0, 2.1, 0, 2.3, 2.4, 0))
    assert hatch_at(alone, 2.5, 2.2) == MODES[0][1]


def test_windows_of_one_way_that_touch_are_one_piece() -> None:
    axes = drawn((2.0, 3.0, 2, 2.0, 3.0, 2), (2.2, 2.5, 3, 2.2, 2.5, 3), (3.0, 4.0, 5, 3.0, 4.0, 5))
    pieces = [
        path
        for collection in axes.collections
        if isinstance(collection, PolyCollection)
        for path in collection.get_paths()
    ]
    (piece,) = pieces
    heights = np.asarray(piece.vertices)[:, 1]
    assert (heights.min(), heights.max()) == (2.0, 4.0)


@every(("low", "point"), [(4.0, 6.0), (0.25, 1.5)])
def test_a_window_that_ends_comes_to_a_point_at_the_middle_of_its_amplitudes(
    low: float, point: float
) -> None:
    """The middle is that of the logarithm.  The next window is far away."""
    axes = drawn((low, 9.0, 0, 900.0, 1000.0, 1))
    vertices = [
        tuple(vertex)
        for collection in axes.collections
        if isinstance(collection, PolyCollection)
        for path in collection.get_paths()
        for vertex in np.round(np.asarray(path.vertices), 12).tolist()
    ]
    assert (2.5, point) in vertices


def test_no_spectrum_says_stands_where_the_reversed_pulse_fells_the_block() -> None:
    block, ratios = DimensionlessBlock(restitution=0.8, negative_restitution=0.95), [2, 3, 4, 5, 6]
    windows = find_overturning_windows(block, "one-sine", ratios)
    back = Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0, reverse=True)
    least = find_overturning_windows(block, back, ratios).first
    axes = plots.overturning(windows, Figure().add_subplot())
    paths = [line.get_xydata() for line in axes.get_lines()]
    assert any(
        path.shape == (5, 2) and np.allclose(path, np.column_stack([ratios, least]))
        for path in map(np.asarray, paths)
    )
    texts = {text.get_text(): text for text in axes.texts}
    assert "↑ falls the other way" in texts
    place = axes.transAxes.transform(texts["stands"].get_position())
    ratio, amplitude = axes.transData.inverted().transform(place)
    assert amplitude < np.interp(ratio, ratios, least)


def test_scales_of_a_record_show_the_least_of_the_reversed() -> None:
    block = Block.asymmetric(left=0.22, right=0.16, height=1.5)
    record = Record(acceleration_m_s2=np.array([0.0, 4.0, -3.0, 0.0]), dt_s=0.3)
    scales, back = (
        find_overturning_scales(block, each, within=(0.2, 2.0))
        for each in (record, record.reversed())
    )
    axes = plots.overturning_scales(scales, Figure().add_subplot())
    marked = {float(np.asarray(line.get_xdata())[0]) for line in axes.get_lines()}
    assert any(abs(mark / back.first[0] - 1.0) < 1e-9 for mark in marked)
    assert "falls the other way →" in [text.get_text() for text in axes.texts]
    legend = axes.get_legend()
    assert legend is not None
    assert "stands, left of the line" in [text.get_text() for text in legend.get_texts()]
