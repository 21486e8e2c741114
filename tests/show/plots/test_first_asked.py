"""Pictures of results that people ask for first: they show what was computed, in role colours."""

import math
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

import rocksteady as rs
from rocksteady.errors import InputError
from rocksteady.outcomes import Status
from rocksteady.risk import HazardCurve
from rocksteady.show.style.tokens import LIGHT
from tests.every import every

CABINET = rs.Block.rectangle(width=0.32, height=1.8)


def axes() -> Axes:
    """Return new axes of a picture of the usual size."""
    return Figure(figsize=(6.4, 4.2)).add_subplot()


def words(drawn: Axes) -> list[str]:
    """Return the texts beside what is drawn."""
    return [text.get_text() for text in drawn.texts]


# ------------------------------------------------------------------------------------- screens


def test_bars_of_screens_are_demand_over_threshold() -> None:
    screens = rs.screen_block(CABINET, rs.Demand(pga_g=0.35, pgv_m_s=0.4), friction=0.4)
    drawn = screens.plot(axes())
    bars = [bar.get_width() for bar in drawn.patches]
    assert bars == sorted(bars, reverse=True)
    names = [label.get_text() for label in drawn.get_yticklabels()]
    uplift = screens.row("uplift")
    assert uplift.value is not None
    assert bars[names.index("uplift")] == pytest.approx(0.35 / uplift.value)
    assert "1.97, no verdict" in words(drawn)
    assert {row.name for row in screens.rows if screens.ratio(row) is None} >= {
        "ASCE 43-05 rocking"
    }


def test_screens_without_a_peak_have_no_picture() -> None:
    screens = rs.screen_block(CABINET, rs.Demand())
    with pytest.raises(InputError, match="threshold"):
        screens.plot(axes())


# ---------------------------------------------------------------------------------- hazard curves


def test_hazard_curves_are_their_rates_and_carry_their_names() -> None:
    rates = np.array([1e-1, 1e-2, 1e-4])
    levels = np.array([0.05, 0.2, 1.0])
    curves = [
        HazardCurve(measure="pgv_m_s", levels=levels, rates=factor * rates, name=name)
        for factor, name in ((0.5, "16 %"), (1.0, "mean"))
    ]
    drawn = rs.plots.hazard_curve(curves, axes())
    for line, curve in zip(drawn.lines, curves, strict=False):
        assert np.array_equal(np.asarray(line.get_ydata()), curve.rates)
    assert words(drawn)[:2] == ["16 %", "mean"]
    assert "once in 475 years" in words(drawn)
    assert len(curves[0].plot(axes()).lines) == 2
    other = HazardCurve(measure="pga_g", levels=levels, rates=rates)
    with pytest.raises(InputError, match="2 measures"):
        rs.plots.hazard_curve([curves[0], other], axes())


def test_names_of_curves_that_end_together_do_not_cover_each_other() -> None:
    rates = np.array([1e-1, 1e-2, 1e-4])
    levels = np.array([0.05, 0.2, 1.0])
    curves = [
        HazardCurve(measure="pgv_m_s", levels=levels, rates=factor * rates, name=name)
        for factor, name in ((1.0, "mean"), (1.01, "50 %"), (1.02, "n" * 100))
    ]
    drawn = rs.plots.hazard_curve(curves, axes())
    names = [text for text in drawn.texts if "once" not in text.get_text()]
    assert [len(text.get_text()) for text in names] == [4, 4, 31]
    boxes = [text.get_window_extent() for text in names]
    assert all(low.y1 <= high.y0 for low, high in pairwise(boxes))


# -------------------------------------------------------------------------------------- neighbours


@every(
    "block",
    [
        rs.Block.rectangle(width=0.5, height=2.0),
        rs.Block.asymmetric(left=0.23, right=0.27, height=2.0),
    ],
)
def test_each_neighbour_is_a_square_at_the_place_of_its_changes(block: rs.Block) -> None:
    pulse = rs.Pulse.from_si(block, shape="one-sine", acceleration_m_s2=3.2, frequency_hz=1.0)
    found = rs.check_neighbours(rs.simulate(block, pulse))
    drawn = found.plot(axes())
    *squares, outline = (patch for patch in drawn.patches if isinstance(patch, Rectangle))
    assert len(squares) == found.runs + 1
    assert 0 < found.fall < found.runs
    falls = [square for square in squares if to_hex(square.get_facecolor()) == LIGHT.falls]
    assert len(falls) == found.fall + (found.case.status is Status.OVERTURNED)
    assert all(square.get_hatch() for square in falls)
    middle = 0.5 * (squares[0].get_x() + max(s.get_x() for s in squares[:27]) + 0.92)
    assert outline.get_y() == 1.0
    assert math.isclose(outline.get_x(), 4.35, abs_tol=1e-9)
    assert middle > outline.get_x()
    # Slender blocks fall before stout ones, and weak motion before strong: more falls at the left.
    across = {square.get_x() for square in falls}
    assert min(across) < outline.get_x()
    for text, each in zip(
        (text for text in drawn.texts if text.get_text()[:1].isdigit()),
        (each for each in found.cases if each.status is not Status.OVERTURNED),
        strict=False,
    ):
        assert float(text.get_text()) < 2.0
        assert math.isfinite(each.peak)


# ------------------------------------------------------------------------------------ steady states


def test_stable_steady_states_are_solid_and_unstable_ones_dashed() -> None:
    ratios = np.linspace(0.8, 6.0, 120)
    states = rs.formulas.steady_states(2.0, ratios, 0.8)
    drawn = states.plot(axes())
    solid = [line for line in drawn.lines if line.get_linestyle() == "-"]
    assert states.peak is not None
    for line in solid:
        y = np.asarray(line.get_ydata(), dtype=np.float64)
        kept = np.isfinite(y)
        branch = 0 if np.array_equal(kept, states.stable[0]) else 1
        assert np.array_equal(kept, states.stable[branch])
        assert np.array_equal(y[kept], states.peak[branch][kept])
    assert {to_hex(str(line.get_color())) for line in drawn.lines} == {LIGHT.motion}


def test_a_grid_has_a_curve_for_each_amplitude_and_a_sized_block_its_own_units() -> None:
    block = rs.Block.rectangle(width=0.5, height=2.0)
    ratios = np.linspace(3.0, 8.0, 40)
    states = rs.formulas.steady_states(np.array([[0.5], [1.0]]), ratios, 0.8).for_block(block)
    drawn = states.plot(axes())
    legend = drawn.get_legend()
    assert legend is not None
    assert {"A = 0.5", "A = 1"} <= {text.get_text() for text in legend.get_texts()}
    assert "Hz" in drawn.get_xlabel()
    assert "°" in drawn.get_ylabel()


def test_what_the_legend_of_steady_states_names_is_seen() -> None:
    states = rs.formulas.steady_states(2.0, np.linspace(2.0, 8.0, 5), 0.8)
    drawn = states.plot(axes())
    assert states.peak is not None
    assert states.peak[1].max() < 0.0, "a solution that passes through the base"
    assert drawn.get_ylim()[0] < states.peak[1].min()
    # One frequency of another stability than both beside it is a dot: a line of one has no length.
    pair = rs.formulas.steady_states(4.0, np.array([2.0, 8.0]), 0.8)
    assert pair.stable[0].tolist() == [False, True]
    dots = [line for line in pair.plot(axes()).lines if line.get_marker() == "."]
    assert [np.isfinite(line.get_ydata()).sum() for line in dots] == [1, 1]


def test_a_point_is_drawn_as_a_period_of_its_motions() -> None:
    drawn = rs.formulas.steady_states(2.0, 4.0, 0.8).plot(axes())
    assert [line.get_label() for line in drawn.lines] == ["branch 1, stable"]
    with pytest.raises(InputError, match="tilt"):
        rs.formulas.steady_states(0.01, 4.0, 0.8).plot(axes())


# --------------------------------------------------------------- kinds, curves and measures


def test_attractors_are_counted_by_kind() -> None:
    found = rs.orbits.find_attractors([0.5, 2.0, 2.1, 6.0], 4.0, 0.8)
    drawn = found.plot(axes())
    assert [bar.get_width() for bar in drawn.patches] == [2.0, 1.0, 1.0]
    assert words(drawn)[0] == "2 of 4"
    assert [row["kind"] for row in found.to_dict()["attractors"]] == found.labels.tolist()


@pytest.mark.parametrize("width", [3.3, 6.4])
def test_no_text_is_cut_off(width: float) -> None:
    screens = rs.screen_block(CABINET, rs.Demand(pga_g=0.35, pgv_m_s=0.4), friction=0.4)
    figure = Figure(figsize=(width, 2.6), layout="constrained")
    drawn = screens.plot(figure.add_subplot())
    figure.draw_without_rendering()
    for text in (*drawn.texts, *drawn.get_yticklabels()):
        if text.get_text():
            extent = text.get_window_extent()
            assert extent.x0 >= figure.bbox.x0 - 1.0, text
            assert extent.x1 <= figure.bbox.x1 + 1.0, text
