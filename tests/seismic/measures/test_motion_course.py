"""Histories of motions: how far and how finely, and both sides of steps."""

import math

import numpy as np
import pytest

from rocksteady import Harmonic
from rocksteady.model.motions.segments import Piecewise, Segment, Still
from rocksteady.seismic.measures.motion_course import motion_course
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
