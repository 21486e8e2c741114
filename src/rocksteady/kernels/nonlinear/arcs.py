"""Arc of the nonlinear model: a flight between two impacts of known phase.

Between the phases psi0 and psi1 the angle is 0 at both ends::

    y'' = h cos(alpha (1 - y)) - sin(alpha (1 - y))/alpha,    y(0) = y(T) = 0,

a boundary value problem, which is solved by multiple shooting: the arc is cut into pieces of a
pivot time or less, each of them flown by Taylor steps with its derivatives
(`rocksteady.kernels.nonlinear._pieces`), and Newton's method closes the gaps between them.  It
begins at the arc of the linear model (`rocksteady.kernels.linear.arcs`).  What a piece knows of
its ends is kept in the form in which nothing grows, speeds at the two ends by angles at the two
ends::

    y'(0) = -k11 y(0) + k12 y(T),    y'(T) = -k12 y(0) + k22 y(T),

which for a linear flight is k11 = k22 = coth T, k12 = 1/sinh T; two pieces join into one by a
quotient of positive numbers.  With the speeds at take-off and landing, w and l, and the
acceleration r of a block on its base (`rocksteady.kernels.nonlinear.drive`) the derivatives are::

    d w/d psi1 = k12 l/Omega,     d w/d psi0 =  (k11 w + r(psi0))/Omega,
    d l/d psi0 = -k12 w/Omega,    d l/d psi1 = -(k22 l + r(psi1))/Omega.

All of it is smooth through grazes and durations of 0, as the linear arc is: one of negative
duration is the arc of the reversed motion, from pi - psi0 on.
"""

import math

import numpy as np

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sin
from rocksteady.kernels.linear.arcs import Arc, arc_flight
from rocksteady.kernels.linear.flight import flight_state
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.nonlinear import _pieces as piece
from rocksteady.kernels.nonlinear._pieces import fly_piece, taylor_step
from rocksteady.kernels.nonlinear.drive import Drive, foot_forcing, swing_at
from rocksteady.kernels.nonlinear.series import (
    SHARES,
    TERMS,
    angle_at,
    make_work,
    speed_at,
    third_bound,
)

PIECE = 1.0
"""Longest piece, in pivot time of the side."""
LONGEST = 2000.0
"""Longest arc."""
STEPS = 30
"""Most steps of Newton's method."""
NEARLY = 1e-7
"""Part of the motion by which the last but one step may move it: the next one is exact."""
NARROWEST = 1e-9
"""Part of a step in which a touch of the speed at 0 is no extremum."""
DEPTH = 64
"""Of a search by halves."""


@compiled
def pieces_of(duration: float) -> int:
    """Return the number of pieces of an arc."""
    return max(1, math.ceil(duration / PIECE))


@compiled
def seed(drive: Drive, duration: float, first: float, last: float, table: Floats) -> None:
    """Write the times of the pieces, and the states of the linear arc as a first guess."""
    pieces = len(table) - 1
    forcing = make_forcing(-1.0, 0.0, drive.amplitude, drive.frequency)
    flight = arc_flight(forcing, duration, first, last)
    for k in range(pieces + 1):
        time = duration if k == pieces else duration * k / pieces
        phase = first + drive.frequency * time
        angle, velocity = flight_state(
            flight, forcing, time, sin(phase), sin(phase + 0.5 * math.pi)
        )
        table[k, piece.TIME], table[k, piece.ANGLE_THERE], table[k, piece.SPEED_THERE] = (
            time,
            angle,
            velocity,
        )
    table[0, piece.ANGLE_THERE] = table[pieces, piece.ANGLE_THERE] = 0.0


@compiled
def seed_series(
    drive: Drive, duration: float, first: float, last: float, table: Floats, work: Floats
) -> None:
    """Do what `seed` does under a Fourier series: its linear arc is the sum of those of its parts.

    A cosine is a sine a quarter of a period later.
    """
    pieces = len(table) - 1
    still = Drive(drive.alpha, 0.0, 0.0, 0.0, drive.frequency, 0.0, 0.0, 0.0)
    seed(still, duration, first, last, table)
    size = drive.series * drive.amplitude
    for order in range(1, len(work) - SHARES + 1):
        turn = order * drive.frequency
        for quarter in range(2):
            share = size * work[SHARES + order - 1, quarter]
            if share == 0.0:
                continue
            begin = order * first + 0.5 * math.pi * quarter
            end = order * last + 0.5 * math.pi * quarter
            forcing = make_forcing(0.0, 0.0, share, turn)
            flight = arc_flight(forcing, duration, begin, end)
            for k in range(pieces + 1):
                phase = begin + turn * table[k, piece.TIME]
                angle, velocity = flight_state(
                    flight, forcing, table[k, piece.TIME], sin(phase), sin(phase + 0.5 * math.pi)
                )
                table[k, piece.ANGLE_THERE] += angle
                table[k, piece.SPEED_THERE] += velocity
    table[0, piece.ANGLE_THERE] = table[pieces, piece.ANGLE_THERE] = 0.0


@compiled
def corrected(table: Floats) -> float:
    """Move the states by a step of Newton's method; return its length over the motion's size."""
    pieces = len(table) - 1
    slant = shift = 0.0
    for k in range(pieces):
        # What keeps the start on the floor is a straight line of states, at each later time too.
        table[k, piece.SLANT], table[k, piece.SHIFT] = slant, shift
        below = table[k, piece.M21] * slant + table[k, piece.M22]
        above = table[k, piece.M11] * slant + table[k, piece.M12]
        slant_after = above / below
        shift = (
            table[k, piece.M11] * shift
            + table[k, piece.MISSED_ANGLE]
            - slant_after * (table[k, piece.M21] * shift + table[k, piece.MISSED_SPEED])
        )
        slant = slant_after
    move = -shift / slant  # of the speed at the end, whose angle stays 0
    size, moved = abs(table[pieces, piece.SPEED_THERE]), 0.0
    table[pieces, piece.SPEED_THERE] += move
    moved = abs(move)
    for k in range(pieces - 1, -1, -1):
        below = table[k, piece.M21] * table[k, piece.SLANT] + table[k, piece.M22]
        move = (
            move - table[k, piece.M21] * table[k, piece.SHIFT] - table[k, piece.MISSED_SPEED]
        ) / below
        size = max(size, abs(table[k, piece.SPEED_THERE]), abs(table[k, piece.ANGLE_THERE]))
        table[k, piece.SPEED_THERE] += move
        if k > 0:
            turn = table[k, piece.SLANT] * move + table[k, piece.SHIFT]
            table[k, piece.ANGLE_THERE] += turn
            moved = max(moved, abs(turn))
        moved = max(moved, abs(move))
    return moved / size if size > 0.0 else moved


@compiled
def solve(
    drive: Drive,
    duration: float,
    first: float,
    last: float,
    full: bool,
    table: Floats,
    work: Floats,
    spare: Floats,
) -> bool:
    """Fill the table of an arc of positive duration; return whether it was found.

    With `full` the derivatives by amplitude and frequency stand in it too.
    """
    pieces = len(table) - 1
    if drive.series != 0.0:
        seed_series(drive, duration, first, last, table, work)
    else:
        seed(drive, duration, first, last, table)
    near = False
    for _ in range(STEPS):
        for k in range(pieces):
            if not fly_piece(drive, first, table, k, full and near, work, spare):
                return False
        length = corrected(table)
        if near:
            return length < NEARLY
        near = length < NEARLY
    return False


@compiled
def nothing_known() -> Arc:
    """Return an arc that was not found."""
    no = math.nan
    return Arc(no, no, no, no, no, no, no, no, no, no)


@allocating
def nonlinear_arc(
    drive: Drive, duration: float, first: float, last: float, shares: Floats | None
) -> Arc:
    """Return the arc between two phases of its side's shaking; nan where none is found.

    Parameters
    ----------
    drive
        The side and its shaking; without slenderness the linear model, under a Fourier series.
    duration
        T > 0; a negative one continues the formulae.
    first, last
        psi0 and psi1, whole periods left out as one likes.
    shares
        Of a Fourier series; None of a sinusoid.
    """
    w = drive.frequency
    foot = foot_forcing(drive)
    begin = foot.constant + foot.amplitude * swing_at(drive, shares, first)
    end = foot.constant + foot.amplitude * swing_at(drive, shares, last)
    if duration == 0.0:  # the speeds vanish like T/2 times the acceleration, upwards negative
        half, other = 0.5 * begin / w, 0.5 * end / w
        return Arc(0.0, 0.0, half, -other, half, -other, 0.0, 0.0, 0.0, 0.0)
    if not abs(duration) <= LONGEST:
        return nothing_known()
    forwards = duration > 0.0
    sign = 1.0 if forwards else -1.0
    length = abs(duration)
    table = np.empty((pieces_of(length) + 1, piece.PIECE_COLUMNS))
    work, spare = make_work(shares), np.empty((piece.SPARE_ROWS, TERMS))
    head, tail = first, last
    if not forwards:
        # Backwards in time the shaking is sin(pi - psi), or the series S(-psi).
        turned = 0.0 if drive.series != 0.0 else math.pi
        head, tail = turned - first, turned - last
        for k in range(SHARES, len(work)):
            work[k, 0] = -work[k, 0]
    if not solve(drive, length, head, tail, True, table, work, spare):
        return nothing_known()
    k11, k12, k22, a0, a1, w0, w1 = joined(table)
    start = sign * table[0, piece.SPEED_THERE]
    landing = -sign * table[len(table) - 1, piece.SPEED_THERE]
    k11, k12, k22 = sign * k11, sign * k12, sign * k22
    # At constant phases the duration changes with the frequency: so does the angle at its end.
    lag = -landing * duration / w
    return Arc(
        start,
        landing,
        (k11 * start + begin) / w,
        k12 * landing / w,
        -k12 * start / w,
        -(k22 * landing + end) / w,
        sign * a0,
        -sign * a1,
        sign * w0 + k12 * lag,
        -(sign * w1 + k22 * lag) + end * duration / w,
    )


@compiled
def joined(table: Floats) -> tuple[float, float, float, float, float, float, float]:
    """Return k11, k12, k22 of a whole arc, and its speeds at both ends by A and by Omega."""
    k11 = k12 = k22 = a0 = a1 = w0 = w1 = 0.0
    for k in range(len(table) - 1):
        inverse = 1.0 / table[k, piece.M12]
        n11, n12, n22 = table[k, piece.M11] * inverse, inverse, table[k, piece.M22] * inverse
        b0 = -table[k, piece.BY_A] * inverse
        b1 = table[k, piece.BY_A + 1] - table[k, piece.M22] * table[k, piece.BY_A] * inverse
        c0 = -table[k, piece.BY_W] * inverse
        c1 = table[k, piece.BY_W + 1] - table[k, piece.M22] * table[k, piece.BY_W] * inverse
        if k == 0:
            k11, k12, k22, a0, a1, w0, w1 = n11, n12, n22, b0, b1, c0, c1
            continue
        both = 1.0 / (k22 + n11)
        a0, a1 = a0 + k12 * (b0 - a1) * both, b1 - n12 * (b0 - a1) * both
        w0, w1 = w0 + k12 * (c0 - w1) * both, c1 - n12 * (c0 - w1) * both
        k11, k12, k22 = k11 - k12 * k12 * both, k12 * n12 * both, n22 - n12 * n12 * both
    return k11, k12, k22, a0, a1, w0, w1


@allocating
def nonlinear_extrema(
    drive: Drive, duration: float, first: float, last: float, shares: Floats | None
) -> tuple[float, float, float]:
    """Return the largest extremum inside an arc of positive duration, the least minimum, its time.

    Where there is none they are -inf, inf and nan; all are nan of an arc that is not found.
    """
    if not 0.0 < duration <= LONGEST:
        return math.nan, math.nan, math.nan
    table = np.empty((pieces_of(duration) + 1, piece.PIECE_COLUMNS))
    work, spare = make_work(shares), np.empty((piece.SPARE_ROWS, TERMS))
    if not solve(drive, duration, first, last, False, table, work, spare):
        return math.nan, math.nan, math.nan
    largest, lowest, when = -math.inf, math.inf, math.nan
    waiting = np.empty((DEPTH, 2))
    for k in range(len(table) - 1):
        time, end = table[k, piece.TIME], table[k + 1, piece.TIME]
        angle, velocity = table[k, piece.ANGLE_THERE], table[k, piece.SPEED_THERE]
        while time < end:
            degree, step, after = taylor_step(drive, first, time, end, angle, velocity, work)
            third = third_bound(work, degree, step)
            waiting[0, 0], waiting[0, 1] = 0.0, step
            count = 1
            while count > 0:
                count -= 1
                low, high = waiting[count, 0], waiting[count, 1]
                middle, half = 0.5 * (low + high), 0.5 * (high - low)
                speed, bend = speed_at(work, degree, middle)
                if abs(speed) > (abs(bend) + 0.5 * third * half) * half:
                    continue
                if abs(bend) > third * half:  # the speed is monotone
                    before, _ = speed_at(work, degree, low)
                    later, _ = speed_at(work, degree, high)
                    if (before > 0.0) == (later > 0.0):
                        continue
                    there = turning(work, degree, low, high, before > 0.0)
                    height, _ = angle_at(work, degree, there)
                    largest = max(largest, height)
                    if later > 0.0 and height < lowest:
                        lowest, when = height, time + there
                elif half > NARROWEST * step and count + 2 <= DEPTH:
                    waiting[count, 0], waiting[count, 1] = middle, high
                    waiting[count + 1, 0], waiting[count + 1, 1] = low, middle
                    count += 2
            angle, velocity = angle_at(work, degree, step)
            time = after
    return largest, lowest, when


@compiled
def turning(work: Floats, degree: int, low: float, high: float, falling: bool) -> float:
    """Return where a speed that is monotone between two times passes 0."""
    there = 0.5 * (low + high)
    for _ in range(200):
        speed, bend = speed_at(work, degree, there)
        if speed == 0.0:
            break
        if (speed > 0.0) == falling:
            low = there
        else:
            high = there
        guess = there - speed / bend if bend != 0.0 else 0.5 * (low + high)
        if not low < guess < high:
            guess = 0.5 * (low + high)
        if guess == there or not low < guess < high:
            break
        there = guess
    return there
