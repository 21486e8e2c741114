"""Words and patterns upon areas: within their class, clear of marks, and none where none fits."""

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from rocksteady.show.style.areas import (
    _roomiest,
    area_style,
    draw_pattern,
    pattern_ink,
    swatch,
    word_ink,
    write_words,
)
from rocksteady.show.style.tokens import DARK, LIGHT, contrast
from tests.every import every

FILL = LIGHT.falls


def axes_of(width: float = 360.0, height: float = 180.0) -> Axes:
    figure = Figure(figsize=(width / 72 / 0.8, height / 72 / 0.8), dpi=72)
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set(xlim=(0.0, 10.0), ylim=(0.0, 5.0))
    return axes


def words_module(
    codes: np.ndarray, words: dict[int, str], marks: object = ()
) -> dict[str, tuple[float, float]]:
    """Return where words stand on cells that fill the axes, in fractions of these."""
    axes, (rows, columns) = axes_of(), codes.shape
    edges = np.linspace(0.0, 10.0, columns + 1), np.linspace(0.0, 5.0, rows + 1)
    write_words(axes, edges, codes, {code: (word, FILL) for code, word in words.items()}, marks)  # type: ignore[arg-type]
    for text in axes.texts:
        axes.figure.canvas.draw()
        box, whole = text.get_window_extent(), axes.bbox
        assert whole.x0 <= box.x0 < box.x1 <= whole.x1
        assert whole.y0 <= box.y0 < box.y1 <= whole.y1
    return {text.get_text(): text.get_position() for text in axes.texts}


def test_a_word_stands_in_the_middle_of_its_class() -> None:
    halves = np.zeros((10, 20), dtype=int)
    halves[:, 10:] = 1
    found = words_module(halves, {0: "rests", 1: "falls"})
    assert found["rests"] == pytest.approx((0.25, 0.5), abs=0.02)
    assert found["falls"] == pytest.approx((0.75, 0.5), abs=0.02)
    upper = np.zeros((10, 20), dtype=int)
    upper[7:] = 1
    assert words_module(upper, {1: "falls"})["falls"] == pytest.approx((0.5, 0.85), abs=0.02)
    assert words_module(upper, {2: "none"}) == {}


@every(("letters", "fits"), [(4, True), (11, True), (14, False), (40, False)])
def test_a_word_that_is_wider_than_its_class_is_none(letters: int, fits: bool) -> None:
    """A quarter of 360 points; a letter takes 0.82 of 8.5 points, and one and a half are air."""
    quarter = np.ones((10, 40), dtype=int)
    quarter[:, 10:] = 0
    assert 0.82 * 8.5 * (11 + 1.5) < 90.0 < 0.82 * 8.5 * (14 + 1.5)
    assert bool(words_module(quarter, {1: "w" * letters})) is fits


@every(("height", "fits"), [(0.08, False), (0.1, True)])
def test_a_word_needs_the_height_of_two_lines(height: float, fits: bool) -> None:
    """1.9 of 8.5 points are 16.2 of 180."""
    band = np.zeros((100, 10), dtype=int)
    band[40 : 40 + round(100 * height)] = 1
    assert bool(words_module(band, {1: "falls"})) is fits


def test_words_keep_clear_of_marks_and_of_what_is_not_covered() -> None:
    whole = np.ones((10, 20), dtype=int)
    assert words_module(whole, {1: "falls"})["falls"] == pytest.approx((0.5, 0.5), abs=0.02)
    moved = words_module(whole, {1: "falls"}, [(5.0, 2.5)])["falls"]
    assert math.hypot(360.0 * (moved[0] - 0.5), 180.0 * (moved[1] - 0.5)) > 6.0
    axes = axes_of()
    left = np.linspace(0.0, 5.0, 11), np.linspace(0.0, 5.0, 11)
    write_words(axes, left, np.ones((10, 10), dtype=int), {1: ("falls", FILL)})
    assert axes.texts[0].get_position() == pytest.approx((0.25, 0.5), abs=0.02)


def test_the_roomiest_place_of_a_box_is_inside_and_as_far_from_the_border_as_any() -> None:
    where = np.zeros((40, 60), dtype=bool)
    where[5:15, 4:24] = where[20:40, 30:56] = True
    assert _roomiest(where, (4, 4), np.ones(2)) == pytest.approx((29.5, 42.5), abs=4.0)
    assert _roomiest(where, (21, 4), np.ones(2)) is None
    assert _roomiest(where, (20, 26), np.ones(2)) is not None
    assert _roomiest(where[:18], (4, 18), np.ones(2)) == pytest.approx((9.5, 13.5), abs=1.0)


def test_a_pattern_ends_where_its_cells_do_and_leaves_out_what_is_narrow() -> None:
    where = np.zeros((8, 8), dtype=bool)
    where[2:5, 3:7] = True
    edges = np.linspace(0.0, 8.0, 9), np.linspace(0.0, 4.0, 9)
    axes = axes_of()
    draw_pattern(axes, edges, where, "////", "#123456", outline=0.7)
    drawn: Any = axes.collections[0]
    box = drawn.get_datalim(axes.transData)
    assert box.extents == pytest.approx([3.0, 1.0, 7.0, 2.5], abs=0.02)
    assert drawn.hatches == ["////"]
    assert to_hex(drawn.get_edgecolor()[0]) == "#123456"
    assert drawn.get_linewidth()[0] == 0.7
    for none in (np.zeros((8, 8), dtype=bool), None):
        bare = axes_of()
        draw_pattern(
            bare, edges, where if none is None else none, "" if none is None else "//", "k"
        )
        assert not bare.collections
    # Of 240 cells a side a stripe of one is too narrow for a pattern, unless it is wanted thin.
    fine = np.zeros((240, 240), dtype=bool)
    fine[:, 100] = True
    many = np.linspace(0.0, 8.0, 241), np.linspace(0.0, 4.0, 241)
    for thin, stripes in ((False, 0), (True, 1)):
        axes = axes_of()
        draw_pattern(axes, many, fine, "//", "k", thin=thin)
        assert len(axes.collections) == stripes
    fine[:, 98:103] = True
    axes = axes_of()
    draw_pattern(axes, many, fine, "//", "k")
    assert len(axes.collections) == 1


@every("inks", [LIGHT, DARK])
def test_words_and_patterns_differ_from_their_fill(inks: object) -> None:
    for role in ("falls", "rocks", "rest"):
        fill = getattr(inks, role)
        other = max(
            contrast(ink, fill)
            for ink in (inks.on_falls, inks.on_rocks)  # type: ignore[attr-defined]
        )
        assert contrast(word_ink(fill, inks), fill) == other > 3.0  # type: ignore[arg-type]
        style = area_style(inks, role)  # type: ignore[arg-type]
        assert style["facecolor"] == fill
        assert (style["edgecolor"] != fill) is bool(style["hatch"])
        patch = swatch(inks, role, "words")  # type: ignore[arg-type]
        assert patch.get_linewidth() == 0.6
        assert patch.get_label() == "words"
        if not style["hatch"]:
            assert to_hex(patch.get_edgecolor()) == inks.edge  # type: ignore[attr-defined]
        assert contrast(pattern_ink(fill), fill) > 1.2
