"""Forces on the base of a rocking block, by Newton's law of its mass centre.

Over the weight of the block, with ``y = |theta|/alpha`` and time in the units of the side, and h
and l of the base as in `rocksteady.kernels.nonlinear.drive`::

    across = |c alpha (cos(x) y'' + alpha sin(x) y'^2) - alpha h|,
    down = 1 + l + c alpha (sin(x) y'' - alpha cos(x) y'^2),    x = alpha (1 - y),

where ``c = R p^2/g`` of a mass centre at R from the pivot.  Impacts last no time: they are left
out.
"""

import math

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import Floats, slenderness
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from rocksteady.kernels.march.facts import base_in
from rocksteady.kernels.march.replay import fill_states, row_start
from rocksteady.kernels.nonlinear.drive import Drive, acceleration

STEP = 0.02
"""Longest time between two looks at the forces, in pivot time, or in phase of a quicker base."""
MOST_STEPS = 10_000
"""Looks at one flight at most."""
NEAR = 1e-4
"""Part of the largest force by which that of a flight may fall short and be looked at finer."""
ROUNDS = 4
"""Of refinement: the last step is some 1e-6 of the first."""
FINER = 41
"""Looks in a round, between the neighbours of the largest one."""

ACROSS, DOWN, FRICTION = 0, 1, 2  # the last one is across over down, infinite where down is not > 0
FORCES = 3


@compiled
def force_of(
    tables: Tables,
    rows: Floats,
    centres: Floats,
    row: int,
    since: float,
    angle: float,
    velocity: float,
) -> tuple[float, float, float]:
    """Return the forces at a time since the start of a row, of a state in reference units."""
    segments, sides = tables
    start = row_start(segments, sides, rows, row)
    across, lift = base_in(segments, start.segment, start.since + since)
    side = 0 if start.side > 0 else 1
    y, v = start.side * angle / start.lean, start.side * velocity / (start.lean * start.rate)
    h = start.side * across / start.lean
    drive = Drive(slenderness(sides, side), h, 0.0, 0.0, 0.0, lift, 0.0)
    turn = acceleration(drive, 0.0, y, 0.0)
    alpha = centres[side, 0]
    reach = centres[side, 1] * alpha
    sine, cosine = sincos_near(alpha * (1.0 - y))
    square = alpha * (v * v)
    sideways = abs(reach * (cosine * turn + sine * square) - alpha * h)
    down = 1.0 + lift + reach * (sine * turn - cosine * square)
    return sideways, down, sideways / down if down > 0.0 else math.inf


@allocating
def fill_forces(
    tables: Tables, rows: Floats, index: Integers1, since: Floats1, centres: Floats, forces: Floats
) -> None:
    """Fill the forces over the weight, shape (3, times), of flights.

    Parameters
    ----------
    tables, rows
        A recorded march.
    index, since
        As for `rocksteady.kernels.march.replay.fill_states`.
    centres
        Alpha [rad] and R p^2/g of either side, shape (2, 2).
    forces
        Receives ACROSS, DOWN and FRICTION.
    """
    fill_states(tables.segments, tables.sides, rows, index, since, forces)
    for i in range(len(index)):
        found = force_of(tables, rows, centres, index[i], since[i], forces[0, i], forces[1, i])
        forces[ACROSS, i], forces[DOWN, i], forces[FRICTION, i] = found


@allocating
def largest_forces(
    tables: Tables, rows: Floats2, last: float, centres: Floats2, largest: Floats1
) -> None:
    """Fill the largest forces over the weight in a recorded march; nan where it never rocks.

    Each flight is looked at in even steps, and those with the largest values finer.

    Parameters
    ----------
    tables, rows, centres
        As for `fill_forces`.
    last
        Replaces the duration of the last row.
    largest
        Shape (3,), receives the largest ACROSS, DOWN and FRICTION.
    """
    index, since, forces = np.empty(FINER, np.int64), np.empty(FINER), np.empty((FORCES, FINER))
    tops, times = np.zeros((len(rows), FORCES)), np.zeros((len(rows), FORCES))
    largest[:] = math.nan
    for row in range(len(rows)):
        if rows[row, columns.ROW_SIDE] == 0.0:
            continue
        duration, steps = lasting(tables, rows, row, last)
        step = duration / steps
        angle, velocity = rows[row, columns.ROW_ANGLE], rows[row, columns.ROW_VELOCITY]
        found = force_of(tables, rows, centres, row, 0.0, angle, velocity)
        forces[ACROSS, 0], forces[DOWN, 0], forces[FRICTION, 0] = found
        note(tops, times, row, forces, 1, 0.0, step)
        looks = steps
        if row + 1 < len(rows) and rows[row, columns.ROW_EVENT] == columns.ENDED_BY_SPAN:
            # The next row begins with the state, though perhaps not with the base, of the end.
            angle, velocity = rows[row + 1, columns.ROW_ANGLE], rows[row + 1, columns.ROW_VELOCITY]
            found = force_of(tables, rows, centres, row, duration, angle, velocity)
            forces[ACROSS, 0], forces[DOWN, 0], forces[FRICTION, 0] = found
            note(tops, times, row, forces, 1, duration, step)
            looks -= 1
        done = 0
        while done < looks:
            count = min(looks - done, FINER)
            for k in range(count):
                index[k], since[k] = row, (done + k + 1) * step
            fill_forces(tables, rows, index[:count], since[:count], centres, forces)
            note(tops, times, row, forces, count, since[0], step)
            done += count
        for kind in range(FORCES):
            if not tops[row, kind] <= largest[kind]:
                largest[kind] = tops[row, kind]
    for row in range(len(rows)):
        for kind in range(FORCES):
            if not tops[row, kind] < largest[kind] * (1.0 - NEAR) and largest[kind] < math.inf:
                finer = look_finer(tables, rows, row, last, centres, kind, times[row, kind])
                largest[kind] = max(largest[kind], finer)


@allocating
def look_finer(
    tables: Tables, rows: Floats, row: int, last: float, centres: Floats, kind: int, middle: float
) -> float:
    """Return the largest force of a kind about a time since the start of a row; 0 at rest."""
    index, since, forces = np.empty(FINER, np.int64), np.empty(FINER), np.empty((FORCES, FINER))
    largest = 0.0
    if rows[row, columns.ROW_SIDE] == 0.0:
        return largest
    duration, steps = lasting(tables, rows, row, last)
    step = duration / steps
    for _ in range(ROUNDS):
        begin, step = max(middle - step, 0.0), step * (2.0 / (FINER - 1))
        for k in range(FINER):
            index[k], since[k] = row, min(begin + k * step, duration)
        fill_forces(tables, rows, index, since, centres, forces)
        for k in range(FINER):
            if forces[kind, k] > largest:
                largest, middle = forces[kind, k], since[k]
    return largest


@compiled
def lasting(tables: Tables, rows: Floats, row: int, last: float) -> tuple[float, int]:
    """Return how long a row lasts, and in how many steps its forces are looked at."""
    duration = last if row == len(rows) - 1 else float(rows[row, columns.ROW_DURATION])
    segment = int(rows[row, columns.ROW_SEGMENT])
    quickest = max(tables.segments[segment, columns.FREQUENCY], tables.sides[0, columns.RATE])
    return duration, min(max(math.ceil(duration * quickest / STEP), 1), MOST_STEPS)


@inlined
def note(
    tops: Floats, times: Floats, row: int, forces: Floats, count: int, first: float, step: float
) -> None:
    """Note the largest of some forces of a row, in even steps from a first time on."""
    for kind in range(FORCES):
        for k in range(count):
            if forces[kind, k] > tops[row, kind]:
                tops[row, kind], times[row, kind] = forces[kind, k], first + k * step
