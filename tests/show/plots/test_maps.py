"""Plots of maps of attractors: each cell shows what was found in it, where it was found."""

from collections import Counter
from io import BytesIO
from itertools import product
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.axes._secondary_axes import SecondaryAxis
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from numpy.typing import NDArray

from rocksteady import Block, Steady, map_attractors, plots
from rocksteady.dynamics.maps.cell_classes import BLANK, CellClass
from rocksteady.show.plots import maps
from rocksteady.show.plots.map_classes import LOOKS, map_cells
from rocksteady.show.style import palette
from rocksteady.show.style.axes import picked, spacing_of
from rocksteady.show.style.tokens import DARK, LIGHT, contrast
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


def test_each_cell_has_the_fill_of_its_class_at_its_place() -> None:
    axes = Figure().add_subplot()
    assert plots.outcomes(found(), axes) is axes
    assert_drawn(axes, found(), "frequency_ratio", "amplitude")
    assert len(map_cells(found()).shares()) >= 4


@pytest.mark.slow
@every(
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
)
@every("turned", [False, True])
def test_every_spacing_and_order_is_drawn_where_it_belongs(
    spread: tuple[NDArray[np.float64], NDArray[np.float64]], turned: bool
) -> None:
    data = random_map({"amplitude": spread[0], "frequency_ratio": spread[1]})
    given = data.transpose("frequency_ratio", "amplitude") if turned else data
    axes = plots.outcomes(given, Figure().add_subplot())
    assert_drawn(axes, data, "frequency_ratio", "amplitude")
    for scale, limits, values in (
        (axes.get_xscale(), axes.get_xlim(), spread[1]),
        (axes.get_yscale(), axes.get_ylim(), spread[0]),
    ):
        assert scale == ("log" if max(values) > 30.0 * min(values) else "linear")
        assert 0.0 <= limits[0] < min(values) < max(values) < limits[1]


@every(("up", "right"), [(a, b) for a in (0.1, 0.0) for b in (0.2, 0.0)])
def test_the_picture_itself_has_each_cell_where_the_axes_say(up: float, right: float) -> None:
    """Through the renderer: on logarithmic axes an image is easily put elsewhere."""
    spaced = {
        "amplitude": np.geomspace(up, 20.0, 6) if up else np.linspace(1.0, 9.0, 6),
        "frequency_ratio": np.geomspace(right, 90.0, 8) if right else np.linspace(1.0, 9.0, 8),
    }
    kind = np.random.default_rng(3).choice([0, 1, 2, 3, 4], (6, 8))
    data = drawn_up(spaced, kind, np.where(kind < 2, 1, 0))
    figure = Figure(figsize=(5.0, 4.0), dpi=100.0)
    axes = plots.outcomes(data, figure.add_axes((0.2, 0.2, 0.5, 0.7)))
    for word in list(axes.texts):
        word.remove()
    stream = BytesIO()
    figure.savefig(stream, format="rgba", dpi=100.0)
    pixels = np.frombuffer(stream.getvalue(), dtype=np.uint8).reshape(400, 500, 4)
    for y in spaced["amplitude"]:
        for x in spaced["frequency_ratio"]:
            across, above = axes.transData.transform((x, y)).astype(int).tolist()
            row = pixels.shape[0] - 1 - above
            words = words_at(data, amplitude=y, frequency_ratio=x)
            near = pixels[row - 4 : row + 5, across - 4 : across + 5].reshape(-1, 4) / 255.0
            seen = Counter(to_hex(tuple(pixel)) for pixel in near.tolist())
            assert FILL_OF[words] in seen, (x, y)
            assert not (set(FILL_OF.values()) - {FILL_OF[words]}) & set(seen), (x, y)


def test_cells_reach_half_way_to_their_neighbours() -> None:
    assert spacing_of([1.0, 2.0, 3.0]).edges == pytest.approx([0.5, 1.5, 2.5, 3.5])
    assert spacing_of([0.1, 1.0, 10.0]).edges == pytest.approx(10.0 ** np.arange(-1.5, 2.0))
    uneven = spacing_of([1.0, 2.0, 4.0, 4.5])
    assert uneven.edges == pytest.approx([0.5, 1.5, 3.0, 4.25, 4.75])
    assert not uneven.even
    assert not uneven.logarithmic
    assert spacing_of([0.5, 1.5]).edges == pytest.approx([0.0, 1.0, 2.0])


def test_the_limits_are_the_edges_and_no_amplitude_is_negative() -> None:
    axes = plots.outcomes(
        drawn_up({"amplitude": [0.5, 2.5, 4.5], "frequency_ratio": [1.0, 2.0, 3.0]}),
        Figure().add_subplot(),
    )
    assert axes.get_xlim() == pytest.approx((0.5, 3.5))
    assert axes.get_ylim() == pytest.approx((0.0, 5.5))
    signed = drawn_up({"angle": [-1.0, 0.0, 1.0], "velocity": [0.0, 1.0, 2.0]})
    axes = plots.outcomes(signed, Figure().add_subplot())
    assert axes.get_xlim() == pytest.approx((-1.5, 1.5))
    assert axes.get_ylim() == pytest.approx((-0.5, 2.5))
    assert axes.get_xlabel() == palette.axis_label("angle")


def test_without_a_frequency_the_first_axis_goes_upwards() -> None:
    data = random_map({"restitution": [0.7, 0.8, 0.9], "amplitude": [1.0, 2.0]})
    assert_drawn(plots.outcomes(data, Figure().add_subplot()), data, "amplitude", "restitution")
    data = random_map({"frequency_hz": [0.5, 1.0, 1.5], "acceleration_m_s2": [1.0, 2.0]})
    axes = plots.outcomes(data, Figure().add_subplot())
    in_g = data.assign_coords(accel_g=data["acceleration_m_s2"] / 9.80665)
    in_g = in_g.swap_dims(acceleration_m_s2="accel_g")
    assert_drawn(axes, in_g, "frequency_hz", "accel_g")


@every("name", AXES)
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
    legend = plots.outcomes(data, Figure().add_subplot()).get_legend()
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
    kind = np.repeat([2, 5, -1, BLANK], 3)[:, np.newaxis]
    data = drawn_up(
        {"amplitude": np.arange(1.0, 13.0), "frequency_ratio": np.arange(1.0, 6.0)}, kind
    )
    axes = plots.outcomes(data, Figure().add_subplot())
    classes = (CellClass.UNDECIDED, CellClass.NO_START, CellClass.NOT_COMPUTED)
    hatches = [one.hatches for one in axes.collections if hasattr(one, "hatches")]
    assert sorted(hatches) == sorted([LOOKS[one].hatch] for one in classes)
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == [
        "comes to rest  25.0 %",
        "undecided  25.0 %",
        "no such start  25.0 %",
        "not computed  25.0 %",
    ]
    # A pattern lies within the cells of its class.
    lowest = {LOOKS[one].hatch: edge for one, edge in zip(classes, (3.5, 6.5, 9.5), strict=True)}
    for one in axes.collections:
        (path,) = [path for path in one.get_paths() if np.size(path.vertices)]
        heights = np.asarray(path.vertices)[:, 1]
        low, high = heights.min(), heights.max()
        assert high - low == pytest.approx(3.0)
        assert lowest[getattr(one, "hatches", [""])[0]] == pytest.approx(low)


def test_a_steady_start_that_does_not_exist_is_not_rest() -> None:
    axes = {"amplitude": [0.05, 1.0], "frequency_ratio": [1.0, 3.0]}
    data = map_attractors(BLOCK, axes=axes, start=Steady())
    legend = plots.outcomes(data, Figure().add_subplot()).get_legend()
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
    axes = plots.outcomes(data, Figure().add_subplot())
    artist: Any = axes.images[0] if even else axes.collections[0]
    drawn = np.asarray(artist.get_array())
    assert drawn.shape == (20, 20)
    cells = map_cells(data)
    rows, columns = (picked(np.arange(n + 1.0), 20)[0] for n in cells.classes.shape)
    assert np.array_equal(drawn, cells.classes[rows][:, columns])
    assert axes.get_xlim() == pytest.approx(spacing_of(right).edges[[0, -1]])
    assert sum(cells.shares().values()) == pytest.approx(1.0)
    assert cells.shares()[CellClass.NOT_COMPUTED] == float((data.kind == BLANK).mean())


def test_a_block_of_known_size_has_its_axes_in_g_and_hz() -> None:
    block = Block.rectangle(width=0.4, height=2.0, restitution=0.8)
    spaced = {"amplitude": np.linspace(0.5, 3.0, 6), "frequency_ratio": np.linspace(1.0, 8.0, 7)}
    data = map_attractors(block, axes=spaced)
    axes = plots.outcomes(data, Figure(figsize=(7.0, 5.0)).add_subplot())
    g, hertz = block.uplift_acceleration / block.gravity, block.p / (2.0 * np.pi)
    for y, x in product(*spaced.values()):
        words = words_at(data, amplitude=y, frequency_ratio=x)
        assert colour_at(axes, x * hertz, y * g) == FILL_OF[words], (x, y)
    near = palette.LABELS["freq_hz"], palette.LABELS["accel_g"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == near
    top, right = (child for child in axes.get_children() if isinstance(child, SecondaryAxis))
    assert top.get_xlabel() == palette.LABELS["frequency_ratio"]
    assert right.get_ylabel() == palette.LABELS["amplitude"]
    axes.get_figure(root=True).draw_without_rendering()  # type: ignore[union-attr]
    assert np.asarray(right.get_ylim()) * g == pytest.approx(axes.get_ylim())
    narrow = plots.outcomes(data, Figure(figsize=(3.3, 3.0)).add_subplot())
    assert not any(isinstance(child, SecondaryAxis) for child in narrow.get_children())
    si = {"acceleration_m_s2": spaced["amplitude"] * block.uplift_acceleration}
    si |= {"frequency_hz": spaced["frequency_ratio"] * hertz}
    same = plots.outcomes(map_attractors(block, axes=si), Figure().add_subplot())
    assert (same.get_xlabel(), same.get_ylabel()) == near
    assert same.get_ylim() == pytest.approx(axes.get_ylim())


@every("dark", [False, True])
def test_words_stand_on_their_own_areas_and_are_legible(dark: bool) -> None:
    inks = DARK if dark else LIGHT
    figure = Figure(figsize=(6.0, 4.5), facecolor=inks.paper)
    axes = plots.outcomes(found(), figure.add_subplot(facecolor=inks.paper))
    assert {"comes to rest", "symmetric", "falls"} <= {word.get_text() for word in axes.texts}
    for word in axes.texts:
        x, y = axes.transData.inverted().transform(axes.transAxes.transform(word.get_position()))
        (look,) = (one for one in LOOKS.values() if one.words.startswith(word.get_text()))
        fill = colour_at(axes, float(x), float(y))
        assert fill == getattr(inks, look.fill)
        assert contrast(to_hex(str(word.get_color())), fill) >= 4.5
