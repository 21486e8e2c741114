"""Growth of a small initial difference along a time history."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.grazing import grazes
from rocksteady.dynamics.history.base_motion import lift
from rocksteady.dynamics.history.samples import Impacts
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.elementary.arrays import cos, exp, log, sin
from rocksteady.kernels.march.replay import fill_states
from rocksteady.model.linear_tables import only_side

LARGEST_LOGARITHM = 700.0
"""Of a growth that is still a float."""

STEP = 0.1
"""Longest step of the variational equation, in the side's pivot time."""

TURN = 0.25
"""Largest part of a radian that the shaking turns in a step."""

LONGEST_FLIGHT = 1e4
"""In a flight longer than this [pivot time] the block balances: any difference grows beyond all."""

BATCH = 200_000
"""Steps that are taken together: some tens of megabytes."""

Matrix = tuple[float, float, float, float]


class Course(NamedTuple):
    """The tables of a time history, as `kernels.march.march` has them, and its times."""

    rows: Floats
    segments: Floats
    sides: Floats
    durations: Floats
    """Of the flights, shape (flights,); the last one up to the end of the history."""
    starts: Floats
    """Pivot times at which they begin."""


def growth_of(course: Course, impacts: Impacts) -> float:
    """Return the largest factor by which a small difference at the start has grown.

    In a flight differences of angle and velocity follow ``x'' = K x``.  In the linear model K is
    the square of the side's rate rho, so that a flight of duration t multiplies them by ``[[cosh,
    sinh/rho], [rho sinh, cosh]]`` of ``rho t``, whatever the base does; in the nonlinear one K
    follows the motion (`_nonlinear_flights`).  Through an impact they follow ``[[r, 0], [(b - r
    a)/v, r]]``, with the velocity v before it, the restitution r, and the block's acceleration a
    before and b after it.  For a block against a wall r is minus the wall's, and b is a.

    Parameters
    ----------
    course
        The time history.
    impacts
        Those that end a flight.
    """
    nonlinear = is_nonlinear(course.sides)
    flights = _nonlinear_flights(course) if nonlinear else _linear_flights(course)
    turns = _impacts(course, impacts)
    first, second = (1.0, 0.0), (0.0, 1.0)  # images of a unit of angle and of velocity
    gone = largest = 0.0  # logarithms: of what has been divided out, and of the growth
    resting = (course.rows[:, columns.ROW_SIDE] == 0.0).tolist()
    for row, (left_out, (a, b, c, d)) in enumerate(flights):
        if resting[row]:
            first, second, gone = (1.0, 0.0), (0.0, 1.0), 0.0
            continue
        gone += left_out
        first, second = ((a * u + b * v, c * u + d * v) for u, v in (first, second))
        if row in turns:
            ratio, kink = turns[row]
            if ratio == 0.0 and resting[row + 1 : row + 2] == [True]:
                continue  # a wall that takes all of the velocity keeps the block, and no difference
            first, second = ((ratio * u, kink * u + ratio * v) for u, v in (first, second))
        (u, v), (x, y) = first, second
        size = math.sqrt(u * u + v * v + x * x + y * y)
        if not 0.0 < size < math.inf:
            return math.inf
        gone += log(size)
        first, second = (u / size, v / size), (x / size, y / size)
        largest = max(largest, gone)
    return exp(largest) if largest < LARGEST_LOGARITHM else math.inf


def _linear_flights(course: Course) -> Iterator[tuple[float, Matrix]]:
    """Yield what each flight multiplies a difference by: a matrix, and a logarithm put aside."""
    rates = course.sides[np.where(course.rows[:, columns.ROW_SIDE] > 0.0, 0, 1), columns.RATE]
    turned = course.durations * rates
    left = exp(-2.0 * turned)
    # cosh and sinh times exp(-rho t), which is put aside.
    cosh, sinh = 0.5 * (1.0 + left), 0.5 * (1.0 - left)
    matrices = zip(
        *(part.tolist() for part in (cosh, sinh / rates, rates * sinh, cosh)), strict=True
    )
    return zip(turned.tolist(), matrices, strict=True)


def _nonlinear_flights(course: Course) -> Iterator[tuple[float, Matrix]]:
    """Yield the same in the nonlinear model.

    There ``K = rho^2 ((1 + l) cos(x) + alpha h sin(x))`` of the side, ``x = alpha - |theta|``, with
    the vertical acceleration l of the base over g and the horizontal one h over alpha g towards the
    side.  A step takes K at its two Gauss nodes: Magnus' expansion of fourth order.
    """
    rows, segments, sides, durations, _ = course
    side = np.where(rows[:, columns.ROW_SIDE] > 0.0, 0, 1)
    rates = sides[side, columns.RATE]
    flying = (rows[:, columns.ROW_SIDE] != 0.0) & (durations * rates <= LONGEST_FLIGHT)
    index = rows[:, columns.ROW_SEGMENT].astype(np.int64)
    quickest = segments[index, columns.FREQUENCY]
    if segments.shape[1] > columns.ORDERS:
        quickest = quickest * np.maximum(segments[index, columns.ORDERS], 1.0)
    turned = durations * np.maximum(rates / STEP, quickest / TURN)
    steps = np.where(flying, np.maximum(np.ceil(np.where(flying, turned, 0.0)), 1.0), 0.0)
    counts = steps.astype(np.int64)
    first = 0
    while first < len(rows):
        # As many flights as fit into a batch, and at least one.
        total = np.cumsum(counts[first:])
        last = first + max(1, int(np.searchsorted(total, BATCH, side="right")))
        part = np.arange(first, last)
        logs, matrices = _products(course, part, counts[part])
        logs[~flying[part]] = math.inf  # a rest's is not looked at
        yield from zip(logs.tolist(), map(tuple, matrices.T.tolist()), strict=True)
        first = last


def _products(
    course: Course, part: NDArray[np.int64], counts: NDArray[np.int64]
) -> tuple[Floats, Floats]:
    """Return logarithms and matrices, shape (4, flights), of some nonlinear flights."""
    logs, whole = np.zeros(len(part)), np.zeros((4, len(part)))
    whole[0] = whole[3] = 1.0
    if not counts.any():
        return logs, whole
    flight = np.repeat(np.arange(len(part)), counts)
    ends = np.cumsum(counts)
    step = np.arange(ends[-1]) - np.repeat(ends - counts, counts)
    row = part[flight]
    h = course.durations[row] / counts[flight]
    node = math.sqrt(3.0) / 6.0
    early, late = (_stiffness(course, row, (step + 0.5 + shift) * h) for shift in (-node, node))
    # exp [[-skew, h], [h K, skew]], of determinant 1.
    skew = h * h * (node / 2.0) * (late - early)
    stiff = 0.5 * h * (early + late)
    square = skew * skew + h * stiff
    root = np.sqrt(np.abs(square))
    swings = square < 0.0
    capped = np.minimum(root, LARGEST_LOGARITHM)
    even = np.where(swings, cos(root), 0.5 * (exp(capped) + exp(-capped)))
    small = root < 1e-4
    safe = np.where(small, 1.0, root)
    odd = np.where(swings, sin(root), 0.5 * (exp(capped) - exp(-capped))) / safe
    odd = np.where(small, 1.0 + square / 6.0, odd)
    a, b, c, d = even - skew * odd, h * odd, stiff * odd, even + skew * odd
    # Step by step through all flights at once, those with the most steps first.
    order = np.argsort(-counts, kind="stable")
    begin = (ends - counts)[order]
    for k in range(int(counts.max())):
        live = order[: int(np.searchsorted(-counts[order], -k, side="left"))]
        at = begin[: len(live)] + k
        p, q, r, s = whole[:, live]
        now = np.array(
            [
                a[at] * p + b[at] * r,
                a[at] * q + b[at] * s,
                c[at] * p + d[at] * r,
                c[at] * q + d[at] * s,
            ]
        )
        size = np.sqrt((now * now).sum(axis=0))
        logs[live] += log(size)
        whole[:, live] = now / size
    return logs, whole


def _stiffness(course: Course, row: NDArray[np.int64], since: Floats) -> Floats:
    """Return K at times since the start of some rows of the nonlinear model."""
    rows, segments, sides, _, starts = course
    states = np.empty((3, len(row)))
    fill_states(segments, sides, rows, row, since, states)
    sign = rows[row, columns.ROW_SIDE]
    lean, rate, alpha = sides[np.where(sign > 0.0, 0, 1)][
        :, [columns.LEAN, columns.RATE, columns.ALPHA]
    ].T
    left = alpha * (1.0 - np.abs(states[0]) / lean)
    # What drives the block is left when its own pull is taken off its acceleration.
    weight = 1.0 + lift(segments, starts[row] + since)
    cosine, sine = cos(left), sin(left)
    towards = sign * states[2] / (lean * rate * rate)
    # y'' = h cos(x) - (1 + l) sin(x)/alpha, so that alpha h = (alpha y'' + (1 + l) sin(x))/cos(x).
    driven = (alpha * towards + weight * sine) / cosine
    stiffness: Floats = rate * rate * (weight * cosine + driven * sine)
    return stiffness


def _impacts(course: Course, impacts: Impacts) -> dict[int, tuple[float, float]]:
    """Return restitution and kink of the impact that ends each row, by the row."""
    rows, segments, sides, _, _ = course
    ended = np.flatnonzero(rows[:, columns.ROW_EVENT] == columns.ENDED_BY_IMPACT)
    landing = np.empty((3, len(ended)))
    fill_states(segments, sides, rows, ended, rows[ended, columns.ROW_DURATION], landing)
    before = landing[2]
    weight = 1.0 + lift(segments, impacts.pt)
    here = np.where(impacts.side > 0, 0, 1)
    # At the foot of a side: acceleration = rho^2 (base * share - sign * pull).
    shares, pulls = np.ones(2), sides[:, columns.LEAN]
    if is_nonlinear(sides):
        alpha = sides[:, columns.ALPHA]
        shares, pulls = cos(alpha), pulls * sin(alpha) / alpha
    squares = np.square(sides[:, columns.RATE])
    base = (before / squares[here] + impacts.side * weight * pulls[here]) / shares[here]
    side_after = here if only_side(sides) else 1 - here
    back = 1.0 if only_side(sides) else -1.0  # the side after the impact over that before it
    after = squares[side_after] * (
        base * shares[side_after] - back * impacts.side * weight * pulls[side_after]
    )
    ratios = sides[here, columns.RESTITUTION]
    forces = segments[rows[ended, columns.ROW_SEGMENT].astype(np.int64)]
    shaking = forces[:, [columns.AMPLITUDE, columns.FREQUENCY]].tolist()
    speeds = np.abs(impacts.velocity_before)
    grazing = [grazes(speed, *force) for speed, force in zip(speeds.tolist(), shaking, strict=True)]
    kinks = np.full(len(ended), math.inf)
    np.divide(
        after - ratios * before, impacts.velocity_before, out=kinks, where=~np.array(grazing, bool)
    )
    pairs = zip(ratios.tolist(), kinks.tolist(), strict=True)
    return dict(zip(ended.tolist(), pairs, strict=True))
