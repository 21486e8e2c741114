"""Histories of motions: how far and how finely, both sides of steps, and what is told of them."""

import math

import numpy as np
import pytest

from rocksteady import BaseMotion, Harmonic, Record
from rocksteady.model.motions.segments import Piecewise, Segment, Still
from rocksteady.seismic.measures.motion_course import describe, motion_course, to_dataframe
from tests.every import every

PERIOD = 2.0 * math.pi / 5.0
HARMONIC = Harmonic(amplitude=2.0, frequency_ratio=5.0, phase=0.3)
BOX = Piecewise(pieces=(Segment(duration=1.0, constant=1.5), Segment(duration=3.0, constant=-0.5)))


def test_an_endless_motion_has_three_periods_of_a_hundred_rows() -> None:
    course = motion_course(HARMONIC)
    assert course.pt[0] == 0.0
    assert course.pt[-1] == pytest.approx(3.0 * PERIOD, rel=1e-14)
    assert np.diff(course.pt) == pytest.approx(np.full(300, PERIOD / 100.0), rel=1e-9)
    wave = 5.0 * course.pt + 0.3
    assert course.acceleration == pytest.approx(2.0 * np.sin(wave), abs=1e-12)
    # It goes to and fro about 0, and does not start from rest.
    assert course.velocity == pytest.approx(-0.4 * np.cos(wave), abs=1e-12)
    assert course.displacement == pytest.approx(-0.08 * np.sin(wave), abs=1e-12)


@every("orders", [(1, 4), (7,)])
def test_the_fastest_wave_of_a_period_has_a_hundred_rows_too(orders: tuple[int, ...]) -> None:
    waves = tuple((order, 1.0 / order, 0.1 * order) for order in orders)
    series = Segment(duration=math.inf, amplitude=1.0, frequency=5.0, harmonics=waves)
    course = motion_course(Piecewise(pieces=(series,)))
    assert course.pt[-1] == pytest.approx(3.0 * PERIOD)
    assert np.diff(course.pt).max() == pytest.approx(PERIOD / max(orders) / 100.0)


def test_a_motion_that_ends_has_a_tenth_more_and_each_step_from_both_sides() -> None:
    course = motion_course(BOX)
    assert course.pt[-1] == pytest.approx(1.1 * 4.0)
    assert 200 <= len(course.pt) <= 210
    for at, before, after in ((1.0, 1.5, -0.5), (4.0, -0.5, 0.0)):
        row = int(np.flatnonzero(course.pt == at)[0])
        assert course.pt[row - 1] == np.nextafter(at, 0.0)
        assert course.acceleration[row - 1 : row + 1].tolist() == [before, after]
    steps = np.diff(course.pt)
    assert (steps > 0.0).all()
    assert steps.max() < 4.0 / 60.0
    # v = 1.5 s, then 2 - 0.5 s, 0 at the end; the ground has moved 0.75 and then 2.25.
    assert course.velocity[course.pt == 1.0] == pytest.approx(1.5)
    assert course.velocity[course.pt >= 4.0] == pytest.approx(0.0, abs=1e-14)
    assert course.displacement[-1] == pytest.approx(0.75 + 2.25)


def test_lines_that_meet_have_one_row_where_they_do() -> None:
    """A step of rounding is none; of a billionth of the largest acceleration and more it is one."""
    for step, twice in ((0.0, False), (4e-10, False), (4e-9, True)):
        pieces = (
            Segment(duration=1.0, slope=2.0),
            Segment(duration=1.0, constant=2.0 + step, slope=-2.0),
        )
        pt = motion_course(Piecewise(pieces=pieces)).pt
        assert (np.nextafter(1.0, 0.0) in pt) is twice


def test_an_impulse_has_a_row_on_each_side_and_a_base_that_is_still_has_a_unit() -> None:
    pieces = (Segment(duration=2.0, slope=0.5), Segment(duration=1.0, constant=1.0, jump=3.0))
    course = motion_course(Piecewise(pieces=pieces))
    row = int(np.flatnonzero(course.pt == 2.0)[0])
    assert course.pt[row - 1] == np.nextafter(2.0, 0.0)
    assert abs(course.velocity[row] - course.velocity[row - 1]) == pytest.approx(3.0)
    still = motion_course(Still())
    assert still.pt[-1] == 1.0
    assert len(still.pt) == 201
    assert not np.any([still.acceleration, still.velocity, still.displacement])


def test_the_rows_of_a_motion_are_shared_among_its_segments() -> None:
    """Two hundred at least in all, and a whole number of each."""
    for count in (1, 3, 7, 250):
        pieces = tuple(Segment(duration=1.0, slope=1.0) for _ in range(count))
        pt = motion_course(Piecewise(pieces=pieces)).pt
        kinds, numbers = np.unique(np.floor(pt[pt < count - 1e-6] + 1e-9), return_counts=True)
        assert len(kinds) == count
        assert set(numbers.tolist()) <= {math.ceil(200 / (count + 1)) + extra for extra in (0, 1)}


def test_what_is_told_of_a_motion_that_ends_and_of_one_that_does_not() -> None:
    told = {fact.key: fact for fact in describe(BOX).facts}
    assert told["duration_pt"].value == 4.0
    assert told["duration_pt"].text == "pt = 4"
    assert told["peak_acceleration"].value == 1.5
    assert told["peak_velocity"].value == pytest.approx(1.5)
    assert told["peak_displacement"].value == pytest.approx(3.0)
    assert "alpha g/p^2" in told["peak_displacement"].text
    endless = {fact.key: fact for fact in describe(HARMONIC).facts}
    assert endless["duration_pt"].value is None
    assert endless["duration_pt"].text == "endless"
    assert endless["peak_acceleration"].value == pytest.approx(2.0, rel=2e-3)
    constant = Piecewise(pieces=(Segment(duration=math.inf, constant=1.0),))
    assert {f.key: f.text for f in describe(constant).facts}["duration_pt"] == "endless"


def test_velocity_that_is_left_over_moves_the_ground_no_further_in_what_is_told() -> None:
    """The largest displacement is until the end, and not that of the rows after it."""
    push = Piecewise(pieces=(Segment(duration=2.0, constant=1.0),))
    told = {fact.key: fact.value for fact in describe(push).facts}
    assert told["peak_displacement"] == pytest.approx(2.0)
    assert motion_course(push).displacement[-1] == pytest.approx(2.0 + 2.0 * 0.2)
    # Without a step at the end there is no row just before it: the end itself counts.
    pieces = Segment(duration=1.0, slope=1.0), Segment(duration=1.0, constant=1.0, slope=-1.0)
    told = {fact.key: fact.value for fact in describe(Piecewise(pieces=pieces)).facts}
    peaks = [told[f"peak_{name}"] for name in ("acceleration", "velocity", "displacement")]
    assert peaks == pytest.approx([1.0, 1.0, 1.0], rel=1e-12)


def record(count: int, dt_s: float, name: str) -> Record:
    values = np.sin(np.arange(1.0, count + 1.0))
    return Record(acceleration_m_s2=values, dt_s=dt_s, name=name)


def test_both_components_are_told_and_tabled_under_their_names() -> None:
    across, up = record(30, 0.02, "across"), record(45, 0.01, "up")
    told = describe(BaseMotion(across, up))
    keys = [fact.key for fact in told.facts]
    single = [fact.key for fact in describe(across).facts]
    assert keys == [*single, *(f"vertical_{key}" for key in single)]
    values = {fact.key: fact.value for fact in told.facts}
    assert values["vertical_pga_m_s2"] == up.peak_acceleration_m_s2
    assert "vertical PGA" in [fact.label for fact in told.facts]
    assert told.headline.endswith(", with a vertical motion")
    assert describe(BaseMotion(across)) == describe(across)
    table = to_dataframe(BaseMotion(across, up))
    assert "arias_m_s" not in table
    assert table["t_s"].is_monotonic_increasing
    assert len(table) == len(set(0.02 * np.arange(30)) | set(0.01 * np.arange(45)))
    known = table["vertical_acceleration_m_s2"].dropna()
    assert known.tolist() == up.acceleration_m_s2.tolist()
    assert to_dataframe(BaseMotion(across)).equals(to_dataframe(across))


def test_the_history_of_a_motion_is_its_table() -> None:
    frame = HARMONIC.to_dataframe()
    assert list(frame) == ["pt", "acceleration", "velocity", "displacement"]
    for name, values in motion_course(HARMONIC)._asdict().items():
        assert frame[name].tolist() == values.tolist()
