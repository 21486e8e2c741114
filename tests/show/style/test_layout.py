"""Layout: corners for legends, labels beside points, and logarithmic and percentage ticks."""

import itertools
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady.show.style.layout import (
    CORNERS,
    emptiest_corner,
    extent,
    percent_ticks,
    plain_ticks,
    put_beside,
    spaced_by_ratio,
)
from tests.every import every


def axes_of(width: float = 360.0, height: float = 160.0, **keys: Any) -> Axes:
    """Return axes of a size in points."""
    figure = Figure(figsize=((width + 80) / 72, (height + 60) / 72), dpi=100)
    box = (40 / (width + 80), 30 / (height + 60), width / (width + 80), height / (height + 60))
    axes = figure.add_axes(box)
    axes.set(**{"xlim": (0.0, 1.0), "ylim": (0.0, 1.0), **keys})
    return axes


def test_a_legend_stands_in_the_corner_that_hides_fewest_points() -> None:
    assert emptiest_corner(axes_of(), [[], []], (0.4, 0.3)) == "upper left"
    places = {name: (0.1 + 0.8 * x, 0.1 + 0.8 * y) for name, (x, y) in CORNERS.items()}
    for free in CORNERS:
        taken = np.array([place for name, place in places.items() if name != free]).T
        assert emptiest_corner(axes_of(), list(taken), (0.4, 0.3)) == free
    # Equal corners come in their order, and points outside of the axes or the legend hide nothing.
    for count, first in enumerate(CORNERS):
        taken = np.array([places[name] for name in list(CORNERS)[:count]]).reshape(-1, 2).T
        assert emptiest_corner(axes_of(), list(taken), (0.4, 0.3)) == first
    beyond = np.array([[-0.1, 0.9], [0.1, 1.1], [0.41, 0.9], [0.1, 0.69]]).T
    assert emptiest_corner(axes_of(), list(beyond), (0.4, 0.3)) == "upper left"
    for inside in ((0.0, 1.0), (0.39, 0.71)):
        one = np.array([inside]).T
        assert emptiest_corner(axes_of(), list(one), (0.4, 0.3)) == "upper right"


def test_labels_are_clear_of_marks_of_one_another_and_of_the_edge() -> None:
    axes = axes_of()
    rng = np.random.default_rng(4)
    marks = rng.uniform(0.0, 1.0, (2, 12))
    labels = [(str(10 * k), *marks[:, k]) for k in range(12)]
    put_beside(axes, [*labels, ("", 0.5, 0.5)], list(marks))
    assert [text.get_text() for text in axes.texts] == [text for text, _, _ in labels]
    boxes = []
    for text in axes.texts:
        at = np.array(text.xy) * (360.0, 160.0) + np.array(text.xyann)  # type: ignore[attr-defined]
        half = np.array([2.4 * len(text.get_text()) + 0.6, 4.0])
        assert (at - half >= -half - 1.0).all()
        assert ((at >= 0.0) & (at <= (360.0, 160.0))).all()
        boxes.append((at, half))
    for (one, half), (other, wide) in itertools.combinations(boxes, 2):
        assert (np.abs(one - other) >= half + wide - 1e-6).any()
    for at, half in boxes:
        for mark in marks.T * (360.0, 160.0):
            assert (np.abs(at - mark) >= half + 4.0 - 1e-6).any()


def test_a_label_alone_stands_above_its_point_and_in_a_corner_inwards() -> None:
    """Half as wide as 3 and as high as 4, beside a mark of 4: aslant 8.5 is not yet clear."""
    inwards = 12.0 / np.sqrt(2.0)
    for x, y, offset in (
        (0.5, 0.5, (0.0, 8.5)),
        (0.999, 0.999, (-inwards, -inwards)),
        (0.001, 0.999, (inwards, -inwards)),
        (0.5, 0.999, (0.0, -8.5)),
    ):
        axes = axes_of()
        put_beside(axes, [("a", x, y)], [[x], [y]])
        assert axes.texts[0].xyann == pytest.approx(offset, abs=1e-9), (x, y)  # type: ignore[attr-defined]


def test_a_size_is_a_part_of_the_axes_and_at_most_all_of_them() -> None:
    assert extent(axes_of(), width=90.0, height=40.0) == pytest.approx((0.25, 0.25))
    assert extent(axes_of(), width=900.0, height=400.0) == (1.0, 1.0)


@every(
    ("values", "powers"),
    [
        (np.linspace(1.0, 9.0, 9), False),
        (np.geomspace(0.1, 10.0, 9), True),
        ([0.0, 0.1, 1.0, 10.0, 100.0], False),
        ([-1.0, 0.1, 1.0, 10.0, 100.0], False),
        ([1.0, 1.99, 5.0], True),
        ([1.0, 2.0, 5.0], False),
        ([3.0, 3.0], False),
    ],
)
def test_values_are_spaced_by_ratio_where_half_lie_in_the_lowest_quarter(
    values: Any, powers: bool
) -> None:
    assert spaced_by_ratio(values) is powers


@every(("length", "sparse"), [(123.0, True), (125.0, False)])
def test_a_decade_has_one_tick_below_62_points(length: float, sparse: bool) -> None:
    for which in ("x", "y"):
        size: dict[str, Any] = {"width": 400.0, "height": 400.0}
        size |= {{"x": "width", "y": "height"}[which]: length}
        size |= {f"{which}scale": "log", f"{which}lim": (0.1, 10.0)}
        axes = axes_of(**size)
        plain_ticks(axes)
        axis = axes.xaxis if which == "x" else axes.yaxis
        shown = [each for each in axis.get_majorticklocs() if 0.099 < each < 10.1]
        every_one = [0.1, 1.0, 10.0] if sparse else [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0]
        assert shown == pytest.approx(every_one)
        assert [axis.get_major_formatter()(each) for each in shown] == [
            f"{each:g}" for each in every_one
        ]
        other = axes.yaxis if which == "x" else axes.xaxis
        assert other.get_scale() == "linear"


@pytest.mark.parametrize("which", ["x", "y"])
def test_probabilities_are_shown_from_0_to_100_per_cent(which: Any) -> None:
    axes = axes_of(xlim=(5.0, 6.0), ylim=(5.0, 6.0))
    percent_ticks(axes, which)
    axis, other = (axes.xaxis, axes.yaxis) if which == "x" else (axes.yaxis, axes.xaxis)
    assert [text.get_text() for text in axis.get_ticklabels()] == [
        f"{each}\N{NO-BREAK SPACE}%" for each in (0, 25, 50, 75, 100)
    ]
    low, high = axis.get_view_interval()
    assert low < 0.0
    assert high > 1.0
    assert 1.0 - low == pytest.approx(high)
    assert tuple(other.get_view_interval()) == (5.0, 6.0)
