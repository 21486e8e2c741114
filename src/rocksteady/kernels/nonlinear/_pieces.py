"""Pieces of a nonlinear arc: flown by Taylor steps with their derivatives, through the floor too.

An event does not end a piece: it takes a state at its start to that at its end, and knows what
moves the end.  The derivatives D of y obey the equation of motion's own derivative::

    D'' = K D + F,    K = C + alpha^2 h S,

with S and C of `rocksteady.kernels.nonlinear.series`.  F is 0 for the derivatives by the state at
the start, ``sin(psi) C`` for that by the amplitude, and ``A t cos(psi) C`` for that by the
frequency, with the time t since the start of the arc.
"""

import math

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear.drive import Drive, Instant
from rocksteady.kernels.nonlinear.series import (
    COSINE,
    HIGHEST,
    SHAKING,
    SINE,
    TWICE_SHARED,
    angle_at,
    expand_linear,
    expand_series,
    fill_shaking,
)

LEFT_OUT = 1e-17
"""Part of the motion that a step leaves out: derivatives, with fewer terms, have 15 digits."""
MOST_STEPS = 100_000
"""Of one piece: more are taken of no number alone."""

# Columns of the table of an arc: one row a piece, one more for the end.
TIME = 0  # since the start of the arc
ANGLE_THERE = 1  # y and y' where the piece begins
SPEED_THERE = 2
MISSED_ANGLE = 3  # the state at its end less that where the next one begins
MISSED_SPEED = 4
M11 = 5  # derivative of the state at its end by that where it begins
M12 = 6
M21 = 7
M22 = 8
BY_A = 9  # and, of y and y' each, by the amplitude
BY_W = 11  # and by the frequency
SLANT = 13  # of a displacement that keeps the start of the arc on the floor: dy = SLANT dy' + SHIFT
SHIFT = 14
PIECE_COLUMNS = 15

# Rows of the working space of the derivatives, shape (7, TERMS): Taylor coefficients.
STIFFNESS = 0  # of K
SWING = 1  # of sin(psi)
TURN = 2  # of A t cos(psi)
SOLUTIONS = 3  # of the derivatives by y and by y' at the start, by amplitude and by frequency
SPARE_ROWS = 7


@compiled
def fly_piece(
    drive: Drive,
    first: float,
    table: Floats,
    piece: int,
    full: bool,
    work: Floats,
    spare: Floats,
) -> bool:
    """Fly a piece and write what it misses and its derivatives; `full` by the parameters too.

    Returns
    -------
    bool
        Whether all is finite.
    """
    time, end = table[piece, TIME], table[piece + 1, TIME]
    angle, velocity = table[piece, ANGLE_THERE], table[piece, SPEED_THERE]
    m11, m12, m21, m22 = 1.0, 0.0, 0.0, 1.0
    a1 = a2 = w1 = w2 = 0.0
    steps = 0
    while time < end:
        if not (abs(angle) < 1e6 and abs(velocity) < 1e6) or steps > MOST_STEPS:
            return False
        steps += 1
        degree, step, time_after = taylor_step(drive, first, time, end, angle, velocity, work)
        angle, velocity = angle_at(work, degree, step)
        count = 4 if full else 2
        fill_derivatives(drive, first, time, degree, count, work, spare)
        s11, s21 = value_at(spare, SOLUTIONS, degree, step)
        s12, s22 = value_at(spare, SOLUTIONS + 1, degree, step)
        if full:
            by1, by2 = value_at(spare, SOLUTIONS + 2, degree, step)
            a1, a2 = by1 + s11 * a1 + s12 * a2, by2 + s21 * a1 + s22 * a2
            by1, by2 = value_at(spare, SOLUTIONS + 3, degree, step)
            w1, w2 = by1 + s11 * w1 + s12 * w2, by2 + s21 * w1 + s22 * w2
        m11, m21 = s11 * m11 + s12 * m21, s21 * m11 + s22 * m21
        m12, m22 = s11 * m12 + s12 * m22, s21 * m12 + s22 * m22
        time = time_after
    table[piece, MISSED_ANGLE] = angle - table[piece + 1, ANGLE_THERE]
    table[piece, MISSED_SPEED] = velocity - table[piece + 1, SPEED_THERE]
    table[piece, M11], table[piece, M12] = m11, m12
    table[piece, M21], table[piece, M22] = m21, m22
    table[piece, BY_A], table[piece, BY_A + 1] = a1, a2
    table[piece, BY_W], table[piece, BY_W + 1] = w1, w2
    return bool(abs(angle) < math.inf and abs(velocity) < math.inf)


@compiled
def taylor_step(
    drive: Drive,
    first: float,
    time: float,
    end: float,
    angle: float,
    velocity: float,
    work: Floats,
) -> tuple[int, float, float]:
    """Fill the coefficients of a step; return their degree, its length, and the time after it."""
    sine, cosine = sincos_near(first + drive.frequency * time)
    at = Instant(0.0, angle, velocity, sine, cosine, FALSE)
    if drive.alpha == 0.0:
        work[SINE, :], work[COSINE, :] = 0.0, 0.0
        work[COSINE, 0] = 1.0
        degree, step = expand_linear(drive, at, end - time, LEFT_OUT, work)
    else:
        degree, step = expand_series(drive, at, end - time, LEFT_OUT, work)
    after = time + step
    return degree, step, end if step >= end - time else after


@compiled
def fill_derivatives(
    drive: Drive,
    first: float,
    time: float,
    degree: int,
    count: int,
    work: Floats,
    spare: Floats,
) -> None:
    """Fill the coefficients of the first `count` derivatives over a step."""
    last = min(degree, HIGHEST) - 1  # of the coefficients of S, C and h
    square = drive.alpha * drive.alpha
    for n in range(last):
        total = work[COSINE, n]
        for j in range(n + 1):
            total += square * work[SHAKING, j] * work[SINE, n - j]
        spare[STIFFNESS, n] = total
    for k in range(count):
        row = SOLUTIONS + k
        spare[row, 0] = 1.0 if k == 0 else 0.0
        spare[row, 1] = 1.0 if k == 1 else 0.0
    if count > 2:
        if drive.series != 0.0:
            fill_series_shares(drive, first, time, last, work, spare)
        else:
            fill_shares(drive, first, time, last, spare)
    for n in range(last):
        for k in range(count):
            row = SOLUTIONS + k
            total = 0.0
            for j in range(n + 1):
                total += spare[STIFFNESS, j] * spare[row, n - j]
            if k > 1:
                source = SWING if k == 2 else TURN
                for j in range(n + 1):
                    total += spare[source, j] * work[COSINE, n - j]
            spare[row, n + 2] = total * TWICE_SHARED[n + 2]


@compiled
def fill_shares(drive: Drive, first: float, time: float, last: int, spare: Floats) -> None:
    """Fill the coefficients of sin(psi) and of A t cos(psi) over a step."""
    sine, cosine = sincos_near(first + drive.frequency * time)
    before = 0.0
    for n in range(last):
        # The derivatives of the two over the factorials.
        spare[SWING, n] = sine
        spare[TURN, n] = drive.amplitude * (time * cosine + before)
        before = cosine
        share = drive.frequency / (n + 1)
        sine, cosine = cosine * share, -sine * share


@compiled
def fill_series_shares(
    drive: Drive, first: float, time: float, last: int, work: Floats, spare: Floats
) -> None:
    """Fill what `fill_shares` does, with S(psi) for the sine; the row of h is written over."""
    sine, cosine = sincos_near(first + drive.frequency * time)
    unit = Drive(drive.alpha, 0.0, 0.0, 1.0, drive.frequency, 0.0, 0.0, drive.series)
    fill_shaking(unit, sine, cosine, work)
    before = 0.0
    for n in range(last):
        slope = (n + 1) * work[SHAKING, n + 1] / drive.frequency  # a coefficient of S'
        spare[SWING, n] = work[SHAKING, n]
        spare[TURN, n] = drive.amplitude * (time * slope + before)
        before = slope


@inlined
def value_at(spare: Floats, row: int, degree: int, time: float) -> tuple[float, float]:
    """Return the polynomial of a row and its derivative."""
    value, slope = spare[row, degree], 0.0
    for n in range(degree - 1, -1, -1):
        slope = slope * time + value
        value = value * time + spare[row, n]
    return value, slope
