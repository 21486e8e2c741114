"""Plots of maps of attractors: each cell shows what was found in it, where it was found."""

from collections.abc import Mapping
from functools import cache
from io import BytesIO
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from rocksteady import DimensionlessBlock, InputError, Steady, attractor_map, plot_map
from rocksteady.dynamics.settled import KIND_FLAGS
from rocksteady.show import palette
from rocksteady.show.classes import BLANK, LOOKS, CellClass, map_cells
from rocksteady.show.facets import map_figure
from rocksteady.show.files import figure_bytes
from rocksteady.show.plots import maps
from rocksteady.show.spacing import picked, spacing_of

BLOCK = DimensionlessBlock(restitution=0.8)
CLASS_OF = {
    "symmetric": "symmetric",
    "unsymmetric": "unsymmetric",
    "rest": "at rest",
    "overturned": "overturned",
    "aperiodic": "aperiodic",
    "undecided": "undecided",
    "no-start": "no such start",
}
"""Words of the legend by those of the dataset, written out once more."""
AXES = (
    *("amplitude", "frequency_ratio", "phase", "acceleration_m_s2", "frequency_hz", "restitution"),
    *("alpha", "radius", "p", "width", "height", "angle", "velocity", "kick"),
)


@cache
def found() -> xarray.Dataset:
    """A map of 24 x 30 cells with five classes."""
    amplitude, frequency_ratio = np.linspace(0.2, 6.0, 24), np.linspace(0.5, 8.0, 30)
    return attractor_map(BLOCK, axes={"amplitude": amplitude, "frequency_ratio": frequency_ratio})


def drawn_up(
    axes: Mapping[str, ArrayLike], kind: ArrayLike = 2, period: ArrayLike = 0
) -> xarray.Dataset:
    """A map with any axes and kinds."""
    shape = tuple(len(np.asarray(values)) for values in axes.values())
    names = tuple(axes)
    flags = {
        "flag_values": np.array(list(KIND_FLAGS), dtype=np.int8),
        "flag_meanings": " ".join(KIND_FLAGS.values()),
    }
    return xarray.Dataset(
        {
            "kind": (names, np.broadcast_to(np.asarray(kind, dtype=np.int8), shape), flags),
            "period": (names, np.broadcast_to(np.asarray(period, dtype=np.int32), shape)),
            "highest": (names, np.full(shape, 0.5)),
            "lowest": (names, np.full(shape, -0.5)),
        },
        coords=dict(axes),
    )


def random_map(axes: Mapping[str, ArrayLike], seed: int = 1) -> xarray.Dataset:
    shape = [len(np.asarray(values)) for values in axes.values()]
    rng = np.random.default_rng(seed)
    kind = rng.choice([*KIND_FLAGS, BLANK], shape)
    return drawn_up(axes, kind, np.where(kind < 2, rng.integers(1, 4, shape), 0))


def words_at(data: xarray.Dataset, **place: float) -> str:
    """What the legend calls a cell of a map."""
    cell = data.sel(place)
    code = int(cell.kind)
    if code == BLANK:
        return "not computed"
    word = CLASS_OF[KIND_FLAGS[code]]
    again = word in ("symmetric", "unsymmetric") and int(cell.period) > 1
    return "subharmonic (period ≥ 2)" if again else word


FILL_OF = {look.words: look.fill for look in LOOKS.values()}


def colour_at(axes: Axes, x: float, y: float) -> str:
    """The colour of what is drawn at a place, by the edges of the artist."""
    if axes.images:
        (image,) = axes.images
        left, right, low, high = image.get_extent()
        array = np.asarray(image.get_array())
        at_x = np.log10(x) if axes.get_xscale() == "log" else x
        at_y = np.log10(y) if axes.get_yscale() == "log" else y
        row = int((at_y - low) / (high - low) * array.shape[0])
        column = int((at_x - left) / (right - left) * array.shape[1])
        assert image.origin == "lower"
        return to_hex(image.to_rgba(array)[row, column])
    (mesh,) = [one for one in axes.collections if isinstance(one, QuadMesh)]
    corners = np.asarray(mesh.get_coordinates())
    row = int(np.searchsorted(corners[:, 0, 1], y)) - 1
    column = int(np.searchsorted(corners[0, :, 0], x)) - 1
    return to_hex(mesh.to_rgba(np.asarray(mesh.get_array()))[row, column])


def assert_drawn(axes: Axes, data: xarray.Dataset, right: str, up: str) -> None:
    """Every cell has its fill at its place."""
    for x in data[right].values:
        for y in data[up].values:
            words = words_at(data, **{right: x, up: y})
            assert colour_at(axes, float(x), float(y)) == FILL_OF[words], (x, y)
    assert axes.get_xlabel() == palette.axis_label(right)
    assert axes.get_ylabel() == palette.axis_label(up)


def test_each_cell_has_the_fill_of_its_class_at_its_place() -> None:
    axes = Figure().add_subplot()
    assert plot_map(found(), axes) is axes
    assert_drawn(axes, found(), "frequency_ratio", "amplitude")
    assert len(map_cells(found()).shares()) >= 4


@pytest.mark.parametrize(
    "spread",
    [
        (np.linspace(0.5, 2.0, 7), np.linspace(1.0, 9.0, 5)),
        (np.geomspace(0.1, 20.0, 7), np.linspace(1.0, 9.0, 5)),
        (np.linspace(0.5, 2.0, 7), np.geomspace(0.2, 90.0, 9)),
        (np.geomspace(0.1, 20.0, 7), np.geomspace(0.2, 90.0, 9)),
        (np.array([0.5, 0.6, 0.9, 2.0, 2.1]), np.linspace(1.0, 9.0, 5)),
        (np.array([0.1, 0.12, 0.5, 5.0, 40.0]), np.geomspace(0.2, 90.0, 9)),
        (np.linspace(2.0, 0.5, 7), np.array([3.0, 1.0, 9.0, 5.0])),
        (np.array([1.0, 2.0]), np.array([3.0, 1.0])),
    ],
    ids=["even", "log up", "log right", "log", "uneven", "uneven log", "in any order", "two"],
)
@pytest.mark.parametrize("turned", [False, True], ids=["as given", "turned"])
def test_every_spacing_and_order_is_drawn_where_it_belongs(
    spread: tuple[NDArray[np.float64], NDArray[np.float64]], turned: bool
) -> None:
    data = random_map({"amplitude": spread[0], "frequency_ratio": spread[1]})
    given = data.transpose("frequency_ratio", "amplitude") if turned else data
    axes = plot_map(given, Figure().add_subplot())
    assert_drawn(axes, data, "frequency_ratio", "amplitude")
    for scale, limits, values in (
        (axes.get_xscale(), axes.get_xlim(), spread[1]),
        (axes.get_yscale(), axes.get_ylim(), spread[0]),
    ):
        assert scale == ("log" if max(values) > 30.0 * min(values) else "linear")
        assert 0.0 <= limits[0] < min(values) < max(values) < limits[1]


@pytest.mark.parametrize(("up", "right"), [(a, b) for a in (0.1, 0.0) for b in (0.2, 0.0)])
def test_the_picture_itself_has_each_cell_where_the_axes_say(up: float, right: float) -> None:
    """Through the renderer: on logarithmic axes an image is easily put elsewhere."""
    spaced = {
        "amplitude": np.geomspace(up, 20.0, 6) if up else np.linspace(1.0, 9.0, 6),
        "frequency_ratio": np.geomspace(right, 90.0, 8) if right else np.linspace(1.0, 9.0, 8),
    }
    kind = np.random.default_rng(3).choice([0, 1, 2, 3, 4], (6, 8))
    data = drawn_up(spaced, kind, np.where(kind < 2, 1, 0))
    figure = Figure(figsize=(5.0, 4.0), dpi=100.0)
    axes = plot_map(data, figure.add_axes((0.2, 0.2, 0.5, 0.7)))
    stream = BytesIO()
    figure.savefig(stream, format="rgba", dpi=100.0)
    pixels = np.frombuffer(stream.getvalue(), dtype=np.uint8).reshape(400, 500, 4)
    for y in spaced["amplitude"]:
        for x in spaced["frequency_ratio"]:
            across, above = axes.transData.transform((x, y))
            seen = pixels[pixels.shape[0] - 1 - int(above), int(across)]
            words = words_at(data, amplitude=y, frequency_ratio=x)
            assert to_hex(tuple((seen / 255.0).tolist())) == FILL_OF[words], (x, y)


def test_cells_reach_half_way_to_their_neighbours() -> None:
    assert spacing_of([1.0, 2.0, 3.0]).edges == pytest.approx([0.5, 1.5, 2.5, 3.5])
    assert spacing_of([0.1, 1.0, 10.0]).edges == pytest.approx(10.0 ** np.arange(-1.5, 2.0))
    uneven = spacing_of([1.0, 2.0, 4.0, 4.5])
    assert uneven.edges == pytest.approx([0.5, 1.5, 3.0, 4.25, 4.75])
    assert not uneven.even
    assert not uneven.logarithmic
    assert spacing_of([0.5, 1.5]).edges == pytest.approx([0.0, 1.0, 2.0])


def test_the_limits_are_the_edges_and_no_amplitude_is_negative() -> None:
    axes = plot_map(
        drawn_up({"amplitude": [0.5, 2.5, 4.5], "frequency_ratio": [1.0, 2.0, 3.0]}),
        Figure().add_subplot(),
    )
    assert axes.get_xlim() == pytest.approx((0.5, 3.5))
    assert axes.get_ylim() == pytest.approx((0.0, 5.5))
    signed = drawn_up({"angle": [-1.0, 0.0, 1.0], "velocity": [0.0, 1.0, 2.0]})
    axes = plot_map(signed, Figure().add_subplot())
    assert axes.get_xlim() == pytest.approx((-1.5, 1.5))
    assert axes.get_ylim() == pytest.approx((-0.5, 2.5))
    assert axes.get_xlabel() == palette.axis_label("angle")


def test_without_a_frequency_the_first_axis_goes_upwards() -> None:
    data = random_map({"restitution": [0.7, 0.8, 0.9], "amplitude": [1.0, 2.0]})
    assert_drawn(plot_map(data, Figure().add_subplot()), data, "amplitude", "restitution")
    data = random_map({"frequency_hz": [0.5, 1.0, 1.5], "acceleration_m_s2": [1.0, 2.0]})
    axes = plot_map(data, Figure().add_subplot())
    assert_drawn(axes, data, "frequency_hz", "acceleration_m_s2")


@pytest.mark.parametrize("name", AXES)
def test_every_axis_of_a_map_has_a_label(name: str) -> None:
    label = palette.axis_label(name)
    assert label in palette.LABELS.values()
    units = {
        "phase": "rad",
        "acceleration_m_s2": "m/s$^2$",
        "frequency_hz": "Hz",
        "alpha": "rad",
        "radius": "m",
        "p": "rad/s",
        "width": "m",
        "height": "m",
    }
    assert label.partition(" [")[2] == (f"{units[name]}]" if name in units else "")


@pytest.mark.parametrize("data", [found(), random_map({"phase": range(7), "kick": range(9)})])
def test_the_legend_has_each_class_that_occurs_with_its_share(data: xarray.Dataset) -> None:
    legend = plot_map(data, Figure().add_subplot()).get_legend()
    assert legend is not None
    entries = [text.get_text().rsplit("  ", 1) for text in legend.get_texts()]
    names = [str(name) for name in data.dims]
    cells = [
        words_at(data, **dict(zip(names, place, strict=True)))
        for place in (
            (a, b) for a in data[names[0]].values.tolist() for b in data[names[1]].values.tolist()
        )
    ]
    assert {words for words, _ in entries} == set(cells)
    order = [look.words for look in LOOKS.values()]
    assert [order.index(words) for words, _ in entries] == sorted(
        order.index(words) for words, _ in entries
    )
    for words, share in entries:
        assert float(share.removesuffix(" %")) == pytest.approx(
            100.0 * cells.count(words) / len(cells), abs=0.051
        )
    total = sum(float(share.removesuffix(" %")) for _, share in entries)
    assert total == pytest.approx(100.0, abs=0.05 * len(entries))


def test_what_has_no_answer_has_a_pattern_and_a_legend_entry_with_it() -> None:
    kind = np.repeat([2, 5, 6, BLANK], 3)[:, np.newaxis]
    data = drawn_up(
        {"amplitude": np.arange(1.0, 13.0), "frequency_ratio": np.arange(1.0, 6.0)}, kind
    )
    axes = plot_map(data, Figure().add_subplot())
    hatches = [one.hatches for one in axes.collections if hasattr(one, "hatches")]
    assert sorted(hatches) == sorted([[LOOKS[c].hatch] for c in CellClass if LOOKS[c].hatch])
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == [
        "at rest  25.0 %",
        "undecided  25.0 %",
        "no such start  25.0 %",
        "not computed  25.0 %",
    ]
    # A pattern lies within the cells of its class.
    classes = (CellClass.UNDECIDED, CellClass.NO_START, CellClass.NOT_COMPUTED)
    lowest = {LOOKS[one].hatch: edge for one, edge in zip(classes, (3.5, 6.5, 9.5), strict=True)}
    for one in axes.collections:
        (path,) = [path for path in one.get_paths() if np.size(path.vertices)]
        heights = np.asarray(path.vertices)[:, 1]
        low, high = heights.min(), heights.max()
        assert high - low == pytest.approx(3.0)
        assert lowest[getattr(one, "hatches", [""])[0]] == pytest.approx(low)


def test_a_steady_start_that_does_not_exist_is_not_rest() -> None:
    axes = {"amplitude": [0.05, 1.0], "frequency_ratio": [1.0, 3.0]}
    data = attractor_map(BLOCK, axes=axes, start=Steady())
    legend = plot_map(data, Figure().add_subplot()).get_legend()
    assert legend is not None
    assert any(text.get_text().startswith("no such start") for text in legend.get_texts())


def test_missing_values_count_as_not_computed() -> None:
    data = drawn_up({"amplitude": [1.0, 2.0], "frequency_ratio": [1.0, 2.0]})
    kind = data.kind.astype(float)
    kind[0, 1] = np.nan
    cells = map_cells(data.assign(kind=kind))
    assert cells.classes.tolist() == [[CellClass.REST, CellClass.NOT_COMPUTED], [0, 0]]


@given(count=st.integers(1, 9000), most=st.integers(1, 3000))
def test_picked_cells_are_real_ones_each_in_the_middle_of_what_it_stands_for(
    count: int, most: int
) -> None:
    edges = np.arange(count + 1.0)
    cells, borders = picked(edges, most)
    assert len(cells) == min(count, most) == len(borders) - 1
    assert borders[0] == 0.0
    assert borders[-1] == count
    assert (np.abs(cells + 0.5 - 0.5 * (borders[1:] + borders[:-1])) <= 0.5).all()
    widths = np.diff(borders)
    assert widths.max() - widths.min() <= 1.0


@pytest.mark.parametrize("even", [True, False])
def test_of_too_many_cells_some_are_drawn_and_all_are_counted(
    even: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(maps, "MOST_DRAWN", 20)
    monkeypatch.setattr(maps, "MOST_MESHED", 20)
    up, right = np.linspace(1.0, 2.0, 53), np.linspace(1.0, 3.0, 71)
    data = random_map({"amplitude": up if even else up**2, "frequency_ratio": right})
    axes = plot_map(data, Figure().add_subplot())
    artist: Any = axes.images[0] if even else axes.collections[0]
    drawn = np.asarray(artist.get_array())
    assert drawn.shape == (20, 20)
    cells = map_cells(data)
    rows, columns = (picked(np.arange(n + 1.0), 20)[0] for n in cells.classes.shape)
    assert np.array_equal(drawn, cells.classes[rows][:, columns])
    assert axes.get_xlim() == pytest.approx(spacing_of(right).edges[[0, -1]])
    assert sum(cells.shares().values()) == pytest.approx(1.0)
    assert cells.shares()[CellClass.NOT_COMPUTED] == float((data.kind == BLANK).mean())


@cache
def line() -> xarray.Dataset:
    """A map of one axis along which the block overturns, and rocks in three ways."""
    frequency_ratio = np.linspace(1.6, 3.2, 161)
    return attractor_map(BLOCK, axes={"amplitude": [2.0], "frequency_ratio": frequency_ratio})


def test_over_one_axis_the_extrema_of_each_orbit_are_dots_of_its_class() -> None:
    axes = plot_map(line(), Figure().add_subplot())
    assert axes.get_title(loc="left") == "amplitude = 2"
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    seen = {
        (float(x), float(y), to_hex(str(dots.get_color())))
        for dots in axes.lines
        for x, y in zip(np.asarray(dots.get_xdata()), np.asarray(dots.get_ydata()), strict=True)
        if np.isfinite(y)
    }
    dot_of = {look.words: look.dot for look in LOOKS.values()}
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
    axes = plot_map(line(), Figure().add_subplot())
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
    data = drawn_up({"amplitude": [1.0, 2.0, 3.0], "phase": [0.0]}, [[3], [6], [BLANK]])
    axes = plot_map(data, Figure().add_subplot())
    drawn = np.concatenate([np.asarray(dots.get_xdata()) for dots in axes.lines])
    assert set(drawn.tolist()) <= {1.0}
    assert axes.get_title(loc="left") == "phase at the start = 0 rad"


def test_axes_with_one_value_and_selected_values_stand_in_the_title() -> None:
    data = drawn_up(
        {"amplitude": [1.0, 2.0], "phase": [0.5], "radius": [2.0], "frequency_ratio": [1.0, 2.0]}
    )
    axes = plot_map(data, Figure().add_subplot())
    assert axes.get_title(loc="left") == "phase at the start = 0.5 rad, half-diagonal = 2 m"
    axes = Figure().add_subplot()
    axes.set_title("mine", loc="left")
    assert plot_map(found(), axes).get_title(loc="left") == "mine"
    chosen = random_map({"restitution": [0.7, 0.8], "amplitude": [1, 2], "frequency_ratio": [1, 2]})
    axes = plot_map(chosen.sel(restitution=0.7), Figure().add_subplot())
    assert axes.get_title(loc="left") == "restitution = 0.7"


@pytest.mark.parametrize("count", [2, 3, 5, 12])
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


@pytest.mark.parametrize(
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
    with pytest.raises(InputError, match="map_figure"):
        plot_map(of_axes(2, 2, 2))
    assert plt.get_fignums() == before
    with pytest.raises(InputError, match="highest"):
        plot_map(of_axes(3).drop_vars("highest"), Figure().add_subplot())


def test_an_unknown_kind_is_refused() -> None:
    data = of_axes(2, 2)
    data.kind.attrs["flag_meanings"] = "symmetric unsymmetric rest flying aperiodic undecided x"
    with pytest.raises(InputError, match="flying"):
        plot_map(data, Figure().add_subplot())


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
    plot_map(data, axes)
    assert {name for name, array in stored.items() if array.read} == {"kind", "period"}
    assert stored["kind"].read == stored["period"].read == 1
    assert_drawn(axes, found(), "frequency_ratio", "amplitude")


def test_a_plot_makes_axes_of_its_own_and_leaves_the_settings() -> None:
    settings = dict(mpl.rcParams)
    axes = plot_map(found())
    try:
        assert plt.gcf() is axes.figure
        assert dict(mpl.rcParams) == settings
    finally:
        plt.close("all")


def test_neighbouring_classes_differ_in_lightness_or_in_their_pattern() -> None:
    answers = {one for one, look in LOOKS.items() if not look.hatch}
    fates = {CellClass.REST, CellClass.ROCKING, CellClass.OVERTURNED}
    for together in (answers - {CellClass.ROCKING}, fates):
        light = [lightness(LOOKS[one].fill) for one in together]
        assert min(abs(a - b) for k, a in enumerate(light) for b in light[:k]) > 8.0
    patterns = [look.hatch for look in LOOKS.values() if look.hatch]
    assert len(set(patterns)) == len(patterns) == 3


def lightness(colour: str) -> float:
    """CIE L* of a colour."""
    channels = np.array(to_rgba(colour)[:3])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return 116.0 * float(np.cbrt(linear @ (0.2126, 0.7152, 0.0722))) - 16.0
