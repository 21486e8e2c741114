"""Straight lines in place of a smooth motion: the bound on their error, and how many there are."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady import Piecewise
from rocksteady.errors import InputError
from rocksteady.model.motions._sampled import polyline, straight_lines
from tests.model.motions.test_pulses import acceleration
from tests.strategies import logarithmic


@given(logarithmic(0.1, 30.0), st.floats(-3.0, 3.0), logarithmic(1e-5, 1e-1), st.floats(0.2, 9.0))
@settings(max_examples=60)
def test_the_lines_keep_their_tolerance_and_are_no_more_than_that_takes(
    w: float, phase: float, tolerance: float, duration: float
) -> None:
    lines = polyline(
        lambda s: np.sin(w * s + phase), [(duration, w * w)], tolerance=tolerance, size=2.0
    )
    s = np.linspace(0.0, duration, 20_011)[:-1]
    error = acceleration(Piecewise(pieces=lines), s) - 2.0 * np.sin(w * s + phase)
    assert np.abs(error).max() <= 2.0 * tolerance * (1.0 + 1e-9)
    assert math.fsum(line.duration for line in lines) == pytest.approx(duration, rel=1e-12)
    if len(lines) > 1:
        longer = duration / (len(lines) - 1)
        assert (w * longer) ** 2 / 8.0 > tolerance * (1.0 - 1e-9), "one line less would not do"


def test_each_part_has_lines_of_its_own_length_within_the_tolerance() -> None:
    lines = polyline(lambda s: s**4, [(0.5, 3.0), (0.5, 12.0)], tolerance=1e-5)
    s = np.linspace(0.0, 1.0, 20_011)[:-1]
    assert np.abs(acceleration(Piecewise(pieces=lines), s) - s**4).max() <= 1e-5
    first, second = (0.5 / math.ceil(0.5 * math.sqrt(bend / 8e-5)) for bend in (3.0, 12.0))
    assert {line.duration for line in lines} == {first, second}
    assert math.fsum(line.duration for line in lines) == pytest.approx(1.0, rel=1e-12)


def test_a_motion_without_curvature_is_one_line() -> None:
    (line,) = polyline(lambda s: 1.0 + 2.0 * s, [(3.0, 0.0)], tolerance=1e-6)
    assert (line.duration, line.constant, line.slope) == (3.0, 1.0, 2.0)


def test_lines_pass_through_their_samples() -> None:
    first, second = straight_lines(np.array([1.0, -1.0, 0.5]), 0.5)
    assert (first.duration, first.constant, first.slope) == (0.5, 1.0, -4.0)
    assert (second.duration, second.constant, second.slope) == (0.5, -1.0, 3.0)


def test_too_many_lines_are_refused_before_they_are_made() -> None:
    with pytest.raises(
        InputError, match=r"^tolerance = 1e-12 .*1e\+06 straight.*give 2.5e-11 or more"
    ):
        polyline(np.sin, [(0.5, 8.0), (0.5, 8.0)], tolerance=1e-12)
