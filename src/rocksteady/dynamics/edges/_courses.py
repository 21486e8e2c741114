"""Course of a hilltop saddle over a period of the shaking, and its rates of growth.

On one side, in its own units, ``y'' = f(y, psi)`` has near y = 1 one motion that is periodic with
the shaking.  In the linear model it is ``y = 1 - beta sin(psi)``.  In the nonlinear one it is found
by Newton's method on its values at equally spaced phases, differentiated as the trigonometric
polynomial through them.  Small differences obey ``eta'' = q(psi) eta`` with ``q = df/dy``; their
rates ``r = eta'/eta`` obey ``r' = q - r^2``, which has one periodic solution above 0 and one below,
found in the same way.  Directions are (1, r), and multipliers exp of the integral of r over a
period, exp(+-2 pi/Omega) in the linear model.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import cos, sin, tan

FEWEST, MOST = 16, 1024
"""Phases at which a motion of the nonlinear model is sought: doubled until they suffice."""
SUFFICES = 1e-13
"""Part of the largest Fourier coefficient below which the last ones are rounding."""
FINE = 4096
"""Phases at which extrema are looked for."""
STEPS = 40
"""Most steps of Newton's method."""
CLOSED = 1e-12
"""Step of Newton's method after which it has come to its end."""


class Course(NamedTuple):
    """What a saddle does over a period, at equally spaced phases seen from its side.

    Attributes
    ----------
    angle, velocity
        y and dy/dt in the side's units.
    leaving, entering
        Rates r of small differences, above and below 0, in the side's time.
    """

    angle: Floats
    velocity: Floats
    leaving: Floats
    entering: Floats


def valued(samples: Floats, phase: ArrayLike) -> Floats:
    """Return the trigonometric polynomial through values at equally spaced phases, at others."""
    count = len(samples)
    coefficients = np.fft.rfft(samples) / count
    orders = np.arange(len(coefficients))
    weights = np.where(orders == 0, 1.0, 2.0)
    if count % 2 == 0:
        weights[-1] = 1.0
    angle = np.multiply.outer(np.asarray(phase, dtype=np.float64), orders)
    real, imaginary = weights * coefficients.real, weights * coefficients.imag
    values: Floats = (cos(angle) * real - sin(angle) * imaginary).sum(axis=-1)
    return values


def extrema_of(course: Course) -> tuple[float, float]:
    """Return the smallest and the largest angle, from the parabola through the nearest phases."""
    fine = valued(course.angle, 2.0 * math.pi / FINE * np.arange(FINE))
    ends = []
    for sign in (-1.0, 1.0):
        at = int(np.argmax(sign * fine))
        before, here, after = (float(fine[(at + k) % FINE]) for k in (-1, 0, 1))
        bend = before - 2.0 * here + after
        ends.append(here - 0.125 * (after - before) * (after - before) / bend if bend else here)
    return ends[0], ends[1]


def linear_course(swing: float, turn: float) -> Course:
    """Return the motion of the linear model, in the units of its side."""
    phase = 2.0 * math.pi / FEWEST * np.arange(FEWEST)
    beta = swing / (1.0 + turn * turn)
    unit = np.ones(FEWEST)
    return Course(1.0 - beta * sin(phase), -beta * turn * cos(phase), unit, -unit)


def nonlinear_course(swing: float, turn: float, alpha: float) -> tuple[Course, float] | None:
    """Return the motion of the nonlinear model in the units of its side; None where none."""
    count = FEWEST
    while count <= MOST:
        solved = _sought(swing, turn, alpha, count)
        if solved is not None:
            course, _ = solved
            if all(_resolved(each) for each in (course.angle, course.leaving, course.entering)):
                return solved
        count *= 2
    return None


def _sought(swing: float, turn: float, alpha: float, count: int) -> tuple[Course, float] | None:
    """Return the motion as it follows from a number of phases."""
    phase = 2.0 * math.pi / count * np.arange(count)
    shaking = swing * sin(phase)
    slope = turn * _derivative(count)
    bend = slope @ slope

    def pull(y: Floats) -> tuple[Floats, Floats]:
        tilt = alpha * (1.0 - y)
        force = shaking * cos(tilt) - sin(tilt) / alpha
        return force, cos(tilt) + alpha * shaking * sin(tilt)

    def motion(y: Floats) -> tuple[Floats, Floats]:
        force, stiffness = pull(y)
        return bend @ y - force, -stiffness

    begin = 1.0 - swing / (1.0 + turn * turn) * sin(phase)
    angle, error = _newton(begin, bend, motion)
    if angle is None:
        return None
    stiffness = pull(angle)[1]

    def growth(r: Floats) -> tuple[Floats, Floats]:
        return slope @ r - stiffness + r * r, 2.0 * r

    rates = []
    for sign in (1.0, -1.0):
        rate, last = _newton(np.full(count, sign), slope, growth)
        if rate is None or (sign * rate <= 0.0).any():
            return None
        error = max(error, last)
        rates.append(rate)
    return Course(angle, slope @ angle, *rates), error


def _newton(
    begin: Floats, operator: Floats, equation: Callable[[Floats], tuple[Floats, Floats]]
) -> tuple[Floats | None, float]:
    """Return a root of an equation whose Jacobian is an operator plus a diagonal, and its error."""
    values, size = begin, math.inf
    for _ in range(STEPS):
        error, diagonal = equation(values)
        try:
            step = np.linalg.solve(operator + np.diag(diagonal), error)
        except np.linalg.LinAlgError:
            return None, math.inf
        before, size = size, float(np.abs(step).max())
        if not math.isfinite(size):
            return None, math.inf
        values = values - step * min(1.0, 0.5 / size) if size > 0.5 else values - step
        if (size <= CLOSED and size >= 0.25 * before) or size <= 1e-15:
            return values, size
    return (values, size) if size <= 1e-10 else (None, size)


def _derivative(count: int) -> Floats:
    """Return the matrix that differentiates by phase the trigonometric polynomial of values."""
    apart = np.arange(count)
    half = 0.5 * (2.0 * math.pi / count) * apart[1:]
    row = np.zeros(count)
    row[1:] = -0.5 * (1.0 - 2.0 * (apart[1:] % 2)) / tan(half)
    matrix: Floats = row[(apart[np.newaxis, :] - apart[:, np.newaxis]) % count]
    return matrix


def _resolved(values: Floats) -> bool:
    """Return whether the highest Fourier coefficients are rounding."""
    sizes = np.abs(np.fft.rfft(values))
    return bool(sizes[-len(sizes) // 4 :].max() <= SUFFICES * sizes.max())
