"""Plots of maps over one axis, in panels and of stores; what cannot be drawn."""

import itertools
from functools import cache
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from rocksteady import map_attractors, plots
from rocksteady.dynamics.maps.cell_classes import BLANK, CellClass
from rocksteady.errors import InputError
from rocksteady.outcomes import NO_START
from rocksteady.show.export.files import figure_bytes
from rocksteady.show.figures.maps import map_figure
from rocksteady.show.plots import maps
from rocksteady.show.plots.map_classes import LOOKS
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT
from tests.every import every
from tests.show.drawn_maps import (
    AXES,
    BLOCK,
    FILL_OF,
    assert_drawn,
    colour_at,
    drawn_up,
    found,
    random_map,
    words_at,
)


@cache
def line() -> xarray.Dataset:
    """A map of one axis along which the block overturns, and rocks in three ways."""
    frequency_ratio = np.linspace(1.6, 3.2, 161)
    return map_attractors(BLOCK, axes={"amplitude": [2.0], "frequency_ratio": frequency_ratio})


def test_over_one_axis_the_extrema_of_each_orbit_are_dots_of_its_class() -> None:
    axes = plots.outcomes(line(), Figure().add_subplot())
    assert axes.get_title(loc="left") == "amplitude = 2"
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    seen = {
        (float(x), float(y), to_hex(str(dots.get_color())))
        for dots in axes.lines
        for x, y in zip(np.asarray(dots.get_xdata()), np.asarray(dots.get_ydata()), strict=True)
        if np.isfinite(y)
    }
    dot_of = {look.words: getattr(LIGHT, look.line) for look in LOOKS.values()}
    expected = set()
    for cell in range(161):
        one = line().isel(amplitude=0, frequency_ratio=cell)
        words = words_at(line(), amplitude=2.0, frequency_ratio=float(one.frequency_ratio))
        for extreme in (one.highest, one.lowest):
            if np.isfinite(extreme):
                expected.add((float(one.frequency_ratio), float(extreme), dot_of[words]))
    assert seen == expected
    assert max(y for _, y, _ in seen) < axes.get_ylim()[1] * (1.0 - maps.STRIP)


def test_the_strip_has_the_class_of_each_value() -> None:
    axes = plots.outcomes(line(), Figure().add_subplot())
    for cell in range(161):
        x = float(line().frequency_ratio[cell])
        covering = {
            to_hex(tuple(np.asarray(bars.get_facecolor())[0].tolist()))
            for bars in axes.collections
            for path in bars.get_paths()
            if np.asarray(path.vertices)[:, 0].min() < x < np.asarray(path.vertices)[:, 0].max()
        }
        assert covering == {FILL_OF[words_at(line(), amplitude=2.0, frequency_ratio=x)]}


def test_nothing_is_drawn_of_cells_that_hold_nothing() -> None:
    data = drawn_up({"amplitude": [1.0, 2.0, 3.0], "phase": [0.0]}, [[3], [NO_START], [BLANK]])
    axes = plots.outcomes(data, Figure().add_subplot())
    drawn = np.concatenate([np.asarray(dots.get_xdata()) for dots in axes.lines])
    assert set(drawn.tolist()) <= {1.0}
    assert axes.get_title(loc="left") == "phase at the start = 0 rad"


def test_axes_with_one_value_and_selected_values_stand_in_the_title() -> None:
    data = drawn_up(
        {"amplitude": [1.0, 2.0], "phase": [0.5], "radius": [2.0], "frequency_ratio": [1.0, 2.0]}
    )
    axes = plots.outcomes(data, Figure().add_subplot())
    assert axes.get_title(loc="left") == "phase at the start = 0.5 rad, half-diagonal = 2 m"
    axes = Figure().add_subplot()
    axes.set_title("mine", loc="left")
    assert plots.outcomes(found(), axes).get_title(loc="left") == "mine"
    chosen = random_map({"restitution": [0.7, 0.8], "amplitude": [1, 2], "frequency_ratio": [1, 2]})
    axes = plots.outcomes(chosen.sel(restitution=0.7), Figure().add_subplot())
    assert axes.get_title(loc="left") == "restitution = 0.7"


@pytest.mark.slow
@every("count", [2, 5])
def test_a_third_axis_becomes_panels_with_one_legend(count: int) -> None:
    values = np.linspace(0.7, 0.9, count)
    data = random_map(
        {
            "amplitude": np.linspace(1.0, 2.0, 13),
            "restitution": values,
            "frequency_ratio": np.linspace(1.0, 3.0, 14),
        }
    )
    figure = map_figure(data, "a title")
    assert len(figure.axes) == count
    for axes, value in zip(figure.axes, values, strict=True):
        assert axes.get_title(loc="left") == f"restitution = {value:.4g}"
        assert axes.get_legend() is None
        part = data.sel(restitution=value)
        for x in part.frequency_ratio.values:
            for y in part.amplitude.values:
                words = words_at(part, frequency_ratio=x, amplitude=y)
                assert colour_at(axes, float(x), float(y)) == FILL_OF[words]
        assert axes.get_xlim() == figure.axes[0].get_xlim()
    (legend,) = figure.legends
    assert len(legend.get_texts()) == len(CellClass) - 1  # all but those of fates alone
    assert figure.get_suptitle() == "a title"
    figure_bytes(figure, "png")


def test_a_plane_of_few_values_stays_a_plane() -> None:
    data = random_map({"amplitude": [1, 2, 3], "frequency_ratio": [1, 2, 3], "phase": [0, 1, 2]})
    titles = [axes.get_title(loc="left") for axes in map_figure(data).axes]
    assert titles == [f"phase at the start = {value} rad" for value in (0, 1, 2)]


def test_figures_of_one_and_two_axes_have_one_panel() -> None:
    for data in (line(), found()):
        figure = map_figure(data, "a title")
        assert len(figure.axes) == 1
        assert figure.get_suptitle() == "a title"
        assert figure_bytes(figure, "svg")


def of_axes(*counts: int) -> xarray.Dataset:
    return drawn_up({name: np.arange(1.0, n + 1.0) for name, n in zip(AXES, counts, strict=False)})


@every(
    ("data", "line"),
    [
        (of_axes(1, 1), "needs an axis with two values or more"),
        (of_axes(2, 0), "needs an axis with two values or more"),
        (of_axes(13, 14, 13), "the axis with the fewest becomes panels, at most 12"),
        (of_axes(2, 2, 2, 2), "at most three axes with several values; select"),
        (of_axes(2, 2).drop_vars("period"), "a dataset with kind and period"),
        (of_axes(2, 2).kind, "a dataset with kind and period"),
        (np.zeros((2, 2)), "a dataset with kind and period"),
        (of_axes(2, 2).drop_attrs(), "kind without flag_meanings"),
        (of_axes(2, 2).assign(kind=of_axes(2, 2).kind.copy(data=[[9, 2], [2, 2]])), "kind is one"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_one_line(data: Any, line: str) -> None:
    with pytest.raises(InputError, match=line) as caught:
        map_figure(data)
    assert "\n" not in str(caught.value)


def test_three_axes_on_one_pair_of_axes_are_refused_before_a_figure_is_made() -> None:
    before = plt.get_fignums()
    with pytest.raises(InputError, match="draw panels with rocksteady map"):
        plots.outcomes(of_axes(2, 2, 2))
    assert plt.get_fignums() == before
    with pytest.raises(InputError, match="highest"):
        plots.outcomes(of_axes(3).drop_vars("highest"), Figure().add_subplot())


def test_an_unknown_kind_is_refused() -> None:
    data = of_axes(2, 2)
    data.kind.attrs["flag_meanings"] = "symmetric unsymmetric rest flying aperiodic undecided x"
    with pytest.raises(InputError, match="flying"):
        plots.outcomes(data, Figure().add_subplot())


class Stored(BackendArray):
    """An array in a store, which counts how often it is read."""

    def __init__(self, array: NDArray[Any]) -> None:
        self.array, self.shape, self.dtype, self.read = array, array.shape, array.dtype, 0

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        def read(index: Any) -> NDArray[Any]:
            self.read += 1
            return np.asarray(self.array[index])

        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.BASIC, read
        )


def test_of_a_store_only_kind_and_period_are_read_and_once() -> None:
    stored = {str(name): Stored(found()[name].values) for name in found().data_vars}
    data = found().assign(
        {
            name: (found().kind.dims, indexing.LazilyIndexedArray(array), found()[name].attrs)
            for name, array in stored.items()
        }
    )
    axes = Figure().add_subplot()
    plots.outcomes(data, axes)
    assert {name for name, array in stored.items() if array.read} == {"kind", "period"}
    assert stored["kind"].read == stored["period"].read == 1
    assert_drawn(axes, found(), "frequency_ratio", "amplitude")


def test_a_plot_makes_axes_of_its_own_and_leaves_the_settings() -> None:
    settings = dict(mpl.rcParams)
    axes = plots.outcomes(found())
    try:
        assert plt.gcf() is axes.figure
        assert dict(mpl.rcParams) == settings
    finally:
        plt.close("all")


def test_neighbouring_classes_differ_in_lightness_or_in_their_pattern() -> None:
    fates = {CellClass.REST, CellClass.ROCKING, CellClass.OVERTURNED}
    for together in (set(CellClass) - {CellClass.ROCKING}, fates):
        looks = [LOOKS[one] for one in together]
        for one, other in itertools.combinations(looks, 2):
            for inks in (LIGHT, DARK):
                fills = [lightness(getattr(inks, look.fill)) for look in (one, other)]
                assert one.hatch != other.hatch or abs(fills[0] - fills[1]) > 8.0, (one, other)
    patterns = [look.hatch for look in LOOKS.values() if look.hatch]
    assert len(set(patterns)) == len(patterns) == 7


def lightness(colour: str) -> float:
    """CIE L* of a colour."""
    channels = np.array(to_rgba(colour)[:3])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return 116.0 * float(np.cbrt(linear @ (0.2126, 0.7152, 0.0722))) - 16.0
