"""Legends: where they go, what they are written in, and that none leaves the picture."""

from typing import Any

import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady.errors import InputError
from rocksteady.show.style.legends import (
    _broken,
    checked_place,
    draw_legend,
    figure_of,
    height_needed,
    line_scale,
    place_of,
    settle,
    size_of,
    text_size,
)
from tests.every import every


def axes_of(width: float, *, part: float = 0.8, lines: int = 3) -> Axes:
    """Return axes that take a part of a figure of a width in points."""
    figure = Figure(figsize=(width / 72, 220 / 72))
    axes = figure.add_axes((0.1, 0.3, part, 0.6))
    for place in range(lines):
        axes.plot([0, 1], [place, 1], label=f"line {place}")
    return axes


def test_the_figure_of_axes_is_the_whole_one() -> None:
    whole = Figure()
    part = whole.add_subfigure(whole.add_gridspec(1, 2)[0])
    assert figure_of(part.add_subplot()) is whole


def test_sizes_are_those_of_the_axes_in_points() -> None:
    assert size_of(axes_of(400.0)) == pytest.approx((320.0, 132.0))


@every(("width", "usual", "size"), [(300.0, 8.0, 8.0), (299.9, 8.0, 7.0), (299.9, 7.0, 6.5)])
def test_text_is_smaller_in_a_narrow_figure_and_stays_legible(
    width: float, usual: float, size: float
) -> None:
    assert text_size(axes_of(width), usual) == size


def test_lines_are_thinner_in_a_narrow_figure() -> None:
    assert line_scale(axes_of(300.0)) == 1.0
    assert line_scale(axes_of(299.0)) == pytest.approx(0.75)


@every(
    ("width", "default", "wide", "place"),
    [
        (400.0, "right", 0.0, "right"),
        (290.0 / 0.8 - 0.1, "right", 0.0, "below"),
        (290.0 / 0.8 + 0.1, "right", 0.0, "right"),
        (200.0, "none", 0.0, "none"),
        (200.0, "inside", 0.0, "inside"),
        (200.0, "inside", 160.0 / 1.2 - 0.1, "inside"),
        (200.0, "inside", 160.0 / 1.2 + 0.1, "below"),
    ],
)
def test_a_legend_goes_below_narrow_axes(
    width: float, default: Any, wide: float, place: str
) -> None:
    axes = axes_of(width)
    assert place_of(axes, None, default, width=wide) == place
    for chosen in ("inside", "right", "below", "none"):
        assert place_of(axes, chosen, default, width=wide) == chosen
    for wrong in ("left", 3, "Right"):
        with pytest.raises(InputError, match="a legend is one of inside, right, below, none"):
            checked_place(wrong)


@every("place", ["right", "below", "inside"])
@every("width", [240.0, 500.0])
def test_a_legend_is_within_the_picture_and_clear_of_its_axes(place: Any, width: float) -> None:
    axes = axes_of(width, lines=6)
    before = axes.get_position().bounds
    legend = draw_legend(axes, place)
    assert legend is not None
    figure = axes.figure
    figure.canvas.draw()
    box, whole = legend.get_window_extent(), figure.bbox
    assert box.x1 <= whole.width + 1e-6
    assert box.y0 >= -1e-6
    area = axes.get_window_extent()
    if place == "right":
        assert box.x0 == pytest.approx(area.x1 + 6.0 * figure.dpi / 72.0, abs=1.0)
        assert box.y1 == pytest.approx(area.y1, abs=1.0)
    elif place == "below":
        assert box.y1 < area.y0 - 6.0
        assert box.x0 == pytest.approx(area.x0, abs=1.0)
    else:
        assert axes.get_position().bounds == before
    assert [text.get_text() for text in legend.get_texts()] == [f"line {k}" for k in range(6)]


def test_no_legend_is_drawn_for_nothing_and_an_old_one_goes() -> None:
    axes = axes_of(400.0)
    assert draw_legend(axes, "inside") is not None
    assert draw_legend(axes, "none") is None
    assert axes.get_legend() is None
    assert draw_legend(axes_of(400.0, lines=0), "inside") is None


def test_a_figure_grows_by_what_a_legend_needs() -> None:
    axes = axes_of(400.0, lines=2)
    assert height_needed(axes) == 0.0
    draw_legend(axes, "inside")
    assert height_needed(axes) == 0.0
    below = draw_legend(axes, "below")
    assert below is not None
    high = below.get_window_extent().height / axes.figure.dpi
    assert height_needed(axes) == pytest.approx(high)
    short = axes_of(400.0, lines=2)
    draw_legend(short, "right")
    assert height_needed(short) == 0.0
    tall = axes_of(400.0, lines=14)
    legend = draw_legend(tall, "right")
    assert legend is not None
    over = legend.get_window_extent().height / tall.figure.dpi - size_of(tall)[1] / 90.0
    assert height_needed(tall) == pytest.approx(over)
    assert over > 0.0


def test_a_legend_below_follows_labels_that_are_written_later() -> None:
    axes = axes_of(400.0)
    legend = draw_legend(axes, "below")
    assert legend is not None
    before = legend.get_window_extent().y1
    axes.set_xlabel("two\nlines")
    settle(axes.figure)  # type: ignore[arg-type]
    axes.figure.canvas.draw()
    labels = axes.xaxis.get_tightbbox()
    assert labels is not None
    assert legend.get_window_extent().y1 < before
    assert legend.get_window_extent().y1 == pytest.approx(
        labels.y0 - 6.0 * axes.figure.dpi / 72.0, abs=1.0
    )


def test_a_long_label_is_broken_and_mathematics_stays_whole() -> None:
    assert _broken("12 letters..", 12) == "12 letters.."
    assert _broken("one two three", 12) == "one two\nthree"
    assert _broken("$" + "x" * 30 + "$", 12) == "$" + "x" * 30 + "$"
    assert _broken("falls in 90 % of them", 11) == "falls in\n90\N{NO-BREAK SPACE}% of\nthem"
