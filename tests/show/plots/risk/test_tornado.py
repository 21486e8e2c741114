"""Pictures of what matters: bars end where the numbers are, the longest on top."""

from typing import Any

import pytest
from matplotlib.axes import Axes
from matplotlib.container import BarContainer
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.show.style.legends import figure_of
from rocksteady.show.style.page import Page
from tests.every import every

ROWS = [
    ("vertical motion", 0.395, 0.41),
    ("restitution", 0.31, 0.47),
    ("width -5 %", 0.46, 0.40),
    ("mass centre", 0.28, 0.55),
    ("model", 0.44, 0.42),
]


def axes() -> Axes:
    return Figure().add_subplot()


def bars(drawn: Axes) -> list[list[Rectangle]]:
    found = [each for each in drawn.containers if isinstance(each, BarContainer)]
    return [list(each.patches) for each in found]


def test_bars_reach_from_the_base_to_both_ends_and_the_longest_is_on_top() -> None:
    drawn = plots.tornado(ROWS, 0.4, axes())
    names = [text.get_text() for text in drawn.get_yticklabels()]
    assert names == ["mass centre", "restitution", "width −5 %", "model", "vertical motion"]
    low, high = drawn.get_ylim()
    assert low > high, "the first row is on top"
    of = {name: ends for name, *ends in ROWS}
    for container, column in zip(bars(drawn), (0, 1), strict=True):
        for name, bar in zip(names, container, strict=True):
            box = bar.get_bbox()
            end = of[name.replace("−", "-")][column]
            assert sorted((box.x0, box.x1)) == pytest.approx(sorted((0.4, end)))


def test_two_ends_on_one_side_stand_beside_each_other_with_their_numbers() -> None:
    drawn = plots.tornado([("model", 0.44, 0.42)], 0.4, axes())
    first, second = (container[0].get_bbox() for container in bars(drawn))
    assert first.y1 <= second.y0
    assert [text.get_text() for text in drawn.texts] == ["as described, 40 %", "44 %", "42 %"]


@every("width", [84.0, None])
@every(
    ("rows", "base", "keys", "words"),
    [
        (ROWS, 0.4, {}, {f"{share} %" for share in (28, 31, 40, 41, 42, 44, 46, 47, 55)}),
        (
            [("hazard 0.5 to 2", 0.000631, 0.00252), ("width 0.28 to 0.36", 0.00168, 0.000972)],
            0.00126,
            {"label": "falls a year"},
            {"0.000631", "0.00252", "0.00168", "0.000972"},
        ),
    ],
)
def test_numbers_stand_inside_the_axes(
    width: float | None, rows: Any, base: float, keys: dict[str, Any], words: set[str]
) -> None:
    with Page(width_mm=width).figure(6.6, 3.6, "") as figure:
        drawn = plots.tornado(rows, base, figure.add_subplot(), **keys)
    figure.draw_without_rendering()
    line, *numbers = drawn.texts
    assert line.get_text() == f"as described, {'0.00126' if keys else '40 %'}"
    assert {text.get_text() for text in numbers} == words
    for text in drawn.texts:
        box = text.get_window_extent()
        assert drawn.bbox.x0 - 1.0 <= box.x0
        assert box.x1 <= drawn.bbox.x1 + 6.0
        assert float(text.get_fontsize()) >= 6.5


def test_rows_that_are_none_or_not_numbers_are_refused() -> None:
    with pytest.raises(InputError, match="rows are none"):
        plots.tornado([], 0.4, axes())
    with pytest.raises(InputError, match="NaN"):
        plots.tornado([("model", float("nan"), 0.4)], 0.4, axes())
    with pytest.raises(InputError, match="base = -1e\\+308"):
        plots.tornado([("model", 0.3, 0.4)], -1e308, axes(), label="falls a year")


def test_a_share_is_written_in_per_cent_on_its_whole_scale() -> None:
    drawn = plots.tornado([("model", 0.3, 0.0)], 0.044, axes())
    assert drawn.get_xlabel() == "share of runs that fall"
    assert drawn.get_xlim()[1] == pytest.approx(1.04)
    assert [text.get_text() for text in drawn.texts] == ["as described, 4.4 %", "30 %", "none"]
    figure_of(drawn).draw_without_rendering()
    assert "50 %" in [tick.get_text() for tick in drawn.get_xticklabels()]
    small = plots.tornado([("model", 0.01, 0.02)], 0.01, axes())
    assert small.get_xlim()[1] < 0.1
    other = plots.tornado([("model", 0.3, 0.44)], 0.4, axes(), label="largest tilt")
    assert other.get_xlim()[1] < 0.6
    with pytest.raises(InputError, match="base = 40"):
        plots.tornado([("model", 30.0, 44.0)], 40.0, axes())
