"""Pictures of what matters: bars end where the numbers are, the longest on top."""

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.container import BarContainer
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.risk import Efficiency, FitOptions, Fragility
from rocksteady.seismic.measures.scalar import MEASURES
from rocksteady.show.style.page import Page

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
    assert [text.get_text() for text in drawn.texts] == ["as described, 0.4", "0.44", "0.42"]


@pytest.mark.parametrize("width", [84.0, None])
def test_numbers_stand_inside_the_axes(width: float | None) -> None:
    with Page(width_mm=width).figure(6.6, 3.6, "") as figure:
        drawn = plots.tornado(ROWS, 0.4, figure.add_subplot())
    figure.draw_without_rendering()
    line, *numbers = drawn.texts
    assert line.get_text() == "as described, 0.4"
    shown = sorted(float(text.get_text()) for text in numbers)
    assert shown == [0.28, 0.31, 0.395, 0.41, 0.42, 0.44, 0.46, 0.47, 0.55]
    for text in drawn.texts:
        box = text.get_window_extent()
        assert drawn.bbox.x0 - 1.0 <= box.x0
        assert box.x1 <= drawn.bbox.x1 + 6.0
        assert float(text.get_fontsize()) >= 6.5


@pytest.mark.parametrize("width", [84.0, None])
def test_long_numbers_have_their_room_too(width: float | None) -> None:
    rows = [("hazard 0.5 to 2", 0.000631, 0.00252), ("width 0.28 to 0.36", 0.00168, 0.000972)]
    with Page(width_mm=width).figure(6.6, 3.6, "") as figure:
        drawn = plots.tornado(rows, 0.00126, figure.add_subplot())
    figure.draw_without_rendering()
    assert {text.get_text() for text in drawn.texts} == {
        "0.000631", "0.00252", "0.00168", "0.000972", "as described, 0.00126",
    }  # fmt: skip
    for text in drawn.texts:
        box = text.get_window_extent()
        assert drawn.bbox.x0 <= box.x0
        assert box.x1 <= drawn.bbox.x1 + 6.0


def test_rows_that_are_none_or_not_numbers_are_refused() -> None:
    with pytest.raises(InputError, match="rows are none"):
        plots.tornado([], 0.4, axes())
    with pytest.raises(InputError, match="NaN"):
        plots.tornado([("model", float("nan"), 0.4)], 0.4, axes())
    with pytest.raises(InputError, match="base = -1e\\+308"):
        plots.tornado([("model", 0.3, 0.4)], -1e308, axes())


def ranked(*rows: tuple[tuple[str, ...], float, float]) -> Fragility:
    ranking = tuple(
        Efficiency(
            measure=tuple(Measure(name) for name in names),
            state="overturned",
            status="fitted",
            median=1.0,
            beta=beta,
            log_likelihood=-0.5 * aic,
            aic=aic,
        )
        for names, beta, aic in rows
    )
    return Fragility(
        ensemble=xarray.Dataset(),
        measure=Measure("pga_g"),
        states=(),
        ranking=ranking,
        fitting=FitOptions(bands=None),
        warnings=(),
        records=3,
        runs=3,
        scale_factor_max=1.0,
        seconds=0.0,
    )


def test_measures_are_ranked_by_akaikes_criterion_beside_their_beta() -> None:
    found = ranked(
        (("p_pgv_per_uplift",), 0.4551, 1000.0),
        (("pgv_m_s", "pga_g"), np.nan, 1020.0),
        (("pgv_m_s",), 0.52, 1133.0),
        (("pga_g",), 1.12, 2500.0),
        (("sa_g",), np.nan, np.nan),
    )
    drawn = plots.measure_efficiency(found, axes())
    assert [text.get_text() for text in drawn.get_yticklabels()] == [
        "p PGV/(g tan α)", "PGV and PGA", "PGV", "PGA",
    ]  # fmt: skip
    assert [bar.get_bbox().width for bar in drawn.patches if isinstance(bar, Rectangle)] == [
        0.0, 20.0, 133.0, 1500.0,
    ]  # fmt: skip
    assert [text.get_text() for text in drawn.texts] == [
        "best, β 0.455", "+20", "+133, β 0.52", "+1500, β 1.12",
    ]  # fmt: skip
    pairs = [((name, "significant_5_75_s"), np.nan, 1e3) for name in (*MEASURES, "pga_g")]
    many = ranked((("pga_g", "pgv_m_s"), np.nan, 900.0), *pairs, (("pga_g",), 0.5, 2000.0))
    with Page(width_mm=84.0).figure(6.6, 2.0, "") as figure:
        narrow = plots.measure_efficiency(many, figure.add_subplot())
    figure.draw_without_rendering()
    assert len(narrow.patches) == 2
    assert narrow.get_xlabel().endswith("\n10 pairs left out")
    assert len(plots.measure_efficiency(many, axes()).patches) == 12
    with pytest.raises(InputError, match="no ranking"):
        plots.measure_efficiency(ranked(), axes())


def test_a_probability_of_falling_has_its_whole_scale() -> None:
    drawn = plots.tornado([("model", 0.3, 0.44)], 0.4, axes())
    assert drawn.get_xlim() == pytest.approx((-0.04, 1.04))
    other = plots.tornado([("model", 0.3, 0.44)], 0.4, axes(), label="largest tilt")
    assert other.get_xlim()[1] < 0.6
