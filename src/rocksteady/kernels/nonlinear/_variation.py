"""Derivatives of a nonlinear flight by its initial state, step by step along with it.

The derivatives D of y by the phase and by the velocity at the start obey the equation of motion's
own derivative::

    D'' = K D + F,    K = (1 + l) C + alpha^2 h S,

with S and C of `rocksteady.kernels.nonlinear.series`; F is C dh/dpsi for the derivative by the
phase and 0 for that by the velocity.  Their Taylor coefficients follow from those of the flight by
sums of products.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear import series
from rocksteady.kernels.nonlinear.drive import Drive
from rocksteady.kernels.nonlinear.series import TWICE_SHARED

SHARE = 0.01
"""Of what may be left out of the motion: the derivatives have one term less and are larger."""

# Rows of the working space, shape (7, 48).  Coefficients stand at the end of their row where they
# are shifted, with zeros in front.
STATE = 0  # derivatives of y and of y' by the phase, then of both by the velocity
SINE_LATER = 1  # coefficients of S, shifted
COSINE_LATER = 2  # of C, shifted
STIFFNESS = 3  # of K
STIFFNESS_LATER = 4  # the same, shifted
BY_PHASE = 5  # sums for the derivative by the phase, and behind them its coefficients
BY_SPEED = 6  # for that by the velocity
ROWS = 7
COLUMNS = 2 * series.TERMS


@compiled
def begin(course: Floats) -> None:
    """Write the derivatives at the start of a flight."""
    course[STATE, 0] = course[STATE, 1] = course[STATE, 2] = 0.0
    course[STATE, 3] = 1.0


@compiled
def advance(drive: Drive, work: Floats, degree: int, step: float, course: Floats) -> None:
    """Take the derivatives to the end of a step of harmonic shaking.

    Parameters
    ----------
    drive
        The side and its shaking.
    work
        The step, as the series has filled it.
    degree, step
        Of its polynomial, and its length.
    course
        Working space, shape (7, 48).
    """
    share = 1.0 / drive.frequency
    last = degree - 1  # the coefficients of the shaking are known up to one less than of y
    for n in range(series.TERMS):
        course[SINE_LATER, n] = course[COSINE_LATER, n] = course[STIFFNESS_LATER, n] = 0.0
        course[SINE_LATER, series.TERMS + n] = work[series.SINE, n]
        course[COSINE_LATER, series.TERMS + n] = work[series.COSINE, n]
        course[STIFFNESS, n] = work[series.COSINE, n]
        course[BY_PHASE, n] = course[BY_SPEED, n] = 0.0
    # Sums of products one factor at a time: each adds to all sums alike, side by side.
    for i in range(last - 1):
        by_sine = drive.alpha * drive.alpha * work[series.SHAKING, i]
        by_cosine = share * (i + 1) * work[series.SHAKING, i + 1]
        shift = (series.TERMS - i) & series.ROW
        for n in range(series.TERMS):
            course[STIFFNESS, n] += by_sine * course[SINE_LATER, shift + n]
            course[BY_PHASE, n] += by_cosine * course[COSINE_LATER, shift + n]
    for n in range(series.TERMS):
        course[STIFFNESS_LATER, series.TERMS + n] = course[STIFFNESS, n]
    for i in range(last + 1):
        phase, speed = course[STATE, i & 1], course[STATE, 2 + (i & 1)]
        if i > 1:
            phase = course[BY_PHASE, i - 2] * TWICE_SHARED[i]
            speed = course[BY_SPEED, i - 2] * TWICE_SHARED[i]
        course[BY_PHASE, series.TERMS + i], course[BY_SPEED, series.TERMS + i] = phase, speed
        shift = (series.TERMS - i) & series.ROW
        for n in range(series.TERMS):
            course[BY_PHASE, n] += phase * course[STIFFNESS_LATER, shift + n]
            course[BY_SPEED, n] += speed * course[STIFFNESS_LATER, shift + n]
    course[STATE, 0], course[STATE, 1] = at(course, BY_PHASE, last, step)
    course[STATE, 2], course[STATE, 3] = at(course, BY_SPEED, last, step)


@inlined
def at(course: Floats, row: int, degree: int, time: float) -> tuple[float, float]:
    """Return the polynomial of a row and its derivative."""
    value, slope = course[row, series.TERMS + degree], 0.0
    for n in range(degree - 1, -1, -1):
        slope = slope * time + value
        value = value * time + course[row, series.TERMS + n]
    return value, slope
