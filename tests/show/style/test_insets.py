"""Insets: what is a crowd, and that an inset hides neither marks nor lines nor its crowd."""

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady.show.style.insets import crowd_of, draw_inset, room_for_inset
from tests.every import every

Mark = tuple[float, float]
SIDE = np.linspace(0.0, 1.0, 50)


def axes_of(width: float = 360.0, height: float = 160.0) -> Axes:
    figure = Figure(figsize=(width / 72 / 0.8, height / 72 / 0.8))
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set(xlim=(0.0, 10.0), ylim=(0.0, 5.0))
    return axes


def row(count: int, *, apart: float = 6.0, at: tuple[float, float] = (7.0, 1.0)) -> list[Mark]:
    """Return marks side by side, so many points apart on axes of 360 points."""
    return [(at[0] + 10.0 * apart / 360.0 * k, at[1]) for k in range(count)]


@every(("width", "height", "room"), [(220.0, 120.0, True), (219.0, 300.0, False),
                                     (400.0, 119.0, False)])  # fmt: skip
def test_small_axes_have_no_room(width: float, height: float, room: bool) -> None:
    axes = axes_of(width + 1e-6, height + 1e-6)
    assert room_for_inset(axes) is room
    assert (crowd_of(axes, row(9, apart=3.0)) is not None) is room


def test_eight_marks_that_touch_are_a_crowd() -> None:
    assert crowd_of(axes_of(), row(7)) is None
    crowd = row(8)
    assert crowd_of(axes_of(), crowd) == pytest.approx((*crowd[0], *crowd[-1]))
    assert crowd_of(axes_of(), row(8, apart=11.9)) is not None
    assert crowd_of(axes_of(), row(8, apart=12.1)) is None
    # One that is wider than a quarter of the axes would hardly grow.
    assert crowd_of(axes_of(), row(16, apart=5.9)) is not None
    assert crowd_of(axes_of(), row(16, apart=6.1)) is None


def test_the_largest_crowd_counts_and_what_lies_outside_does_not() -> None:
    few, many = row(8, at=(1.0, 4.0)), row(9, at=(7.0, 1.0))
    found = crowd_of(axes_of(), [*few, *many])
    assert found == pytest.approx((*many[0], *many[-1]))
    outside = row(20, apart=1.0, at=(10.5, 1.0))
    assert crowd_of(axes_of(), outside) is None
    assert crowd_of(axes_of(), [*few, *outside]) == pytest.approx((*few[0], *few[-1]))
    edge = [(10.0 - 0.1 * k, 5.0) for k in range(8)]
    assert crowd_of(axes_of(), edge) is not None


def test_an_inset_stands_where_nothing_is_drawn() -> None:
    axes, marks = axes_of(), row(9)
    crowd = crowd_of(axes, marks)
    assert crowd is not None
    line = np.column_stack([10.0 * SIDE, 1.0 + 0.5 * SIDE])
    inset = draw_inset(axes, crowd, [line], marks)
    assert inset is not None
    axes.figure.canvas.draw()
    box = inset.get_position()
    whole = axes.get_position()
    low = (box.y0 - whole.y0) / whole.height
    assert low * 5.0 > 1.5
    assert whole.x0 < box.x0 < box.x1 <= whole.x1
    assert box.y1 <= whole.y1
    (left, right), (bottom, top) = inset.get_xlim(), inset.get_ylim()
    width = crowd[2] - crowd[0]
    assert (left, right) == pytest.approx((crowd[0] - 0.12 * width, crowd[2] + 0.12 * width))
    assert (bottom, top) == pytest.approx((0.95, 1.05))  # of one height: a twentieth of it


def test_an_inset_does_not_reach_below_the_axes() -> None:
    axes, marks = axes_of(), row(9, at=(7.0, 0.0))
    made = draw_inset(axes, (7.0, 0.0, 8.0, 1.0), [np.array([[0.0, 0.0], [10.0, 0.0]])], marks)
    assert made is not None
    assert made.get_ylim() == pytest.approx((0.0, 1.12))


def test_lines_without_marks_have_an_inset_too() -> None:
    made = draw_inset(axes_of(), (7.0, 1.0, 8.0, 1.1), [np.array([[7.0, 1.0], [8.0, 1.1]])], [])
    assert made is not None


def test_where_all_is_full_there_is_none() -> None:
    axes, marks = axes_of(), row(9)
    full = [np.column_stack([10.0 * SIDE, np.full(50, height)]) for height in 5.0 * SIDE]
    assert draw_inset(axes, (7.0, 1.0, 8.0, 1.1), full, marks) is None
    # Samples close together are no more ink than those far apart.
    dense = np.column_stack([np.linspace(6.9, 8.2, 5000), np.full(5000, 1.0)])
    assert draw_inset(axes, (7.0, 1.0, 8.0, 1.1), [dense], marks) is not None
