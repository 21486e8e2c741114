"""Courses of hilltop saddles: extrema against closed forms, and what a course obeys."""

import math

import numpy as np
import pytest

from rocksteady.dynamics.edges._courses import (
    Course,
    extrema_of,
    linear_course,
    nonlinear_course,
    valued,
)
from tests.every import every


@every(("swing", "turn"), [(0.3, 0.7), (2.0, 3.1), (5.0, 0.2)])
def test_extrema_of_the_linear_model_are_those_of_its_sine(swing: float, turn: float) -> None:
    beta = swing / (1.0 + turn * turn)
    assert extrema_of(linear_course(swing, turn)) == pytest.approx((1.0 - beta, 1.0 + beta))


@every("shift", [0.0, 3e-4, 1.1, 4.7])
def test_extrema_between_phases_are_found(shift: float) -> None:
    phase = 2.0 * math.pi / 16 * np.arange(16) + shift
    flat = np.zeros(16)
    course = Course(2.0 - 1e3 * np.sin(phase), flat, flat, flat)
    # Between two of 4,096 phases a sine of this size lies up to 3e-4 below its crest.
    assert extrema_of(course) == pytest.approx((-998.0, 1002.0), abs=1e-7, rel=0.0)
    assert extrema_of(Course(flat + 0.4, flat, flat, flat)) == (0.4, 0.4)


@every(("swing", "turn", "alpha"), [(0.5, 1.0, 0.2), (1.5, 2.5, 0.5), (3.0, 4.0, 0.05)])
def test_a_course_of_the_nonlinear_model_obeys_its_equation(
    swing: float, turn: float, alpha: float
) -> None:
    solved = nonlinear_course(swing, turn, alpha)
    assert solved is not None
    course, _ = solved
    count = len(course.angle)
    fine = np.linspace(0.0, 2.0 * math.pi, 257)
    orders = np.fft.fftfreq(count, 1.0 / count)
    # d/dt is turn d/dpsi.
    rates = np.fft.ifft(1j * orders * turn * np.fft.fft(course.angle)).real
    assert valued(course.velocity, fine) == pytest.approx(valued(rates, fine), abs=1e-9)
    for rate in (course.leaving, course.entering):
        slope = np.fft.ifft(1j * orders * turn * np.fft.fft(rate)).real
        # r' + r^2 = q, which both rates share.
        stiffness = slope + rate * rate
        assert stiffness == pytest.approx(_stiffness(course, swing, alpha), abs=1e-8)
    low, high = extrema_of(course)
    seen = valued(course.angle, fine)
    assert low <= seen.min() + 1e-12
    assert high >= seen.max() - 1e-12
    assert (low, high) == pytest.approx((seen.min(), seen.max()), abs=1e-3)


def _stiffness(course: Course, swing: float, alpha: float) -> np.ndarray:
    """Return d/dy of y'' = -sin(tilt)/alpha + swing sin(psi) cos(tilt), tilt = alpha (1 - y)."""
    psi = 2.0 * math.pi / len(course.angle) * np.arange(len(course.angle))
    tilt = alpha * (1.0 - course.angle)
    stiffness: np.ndarray = np.cos(tilt) + alpha * swing * np.sin(psi) * np.sin(tilt)
    return stiffness
