"""Acceleration and displacement of the base at any time, from the table of segments.

Times are pivot times s = p t since the start; accelerations are in units of alpha g and
displacements in units of alpha g/p^2.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.motions import fill_bounds
from rocksteady.kernels.elementary.arrays import acos, sin, sincos

SAME_TIME = 1e-12
"""Part of a time by which it may miss a segment's start and still be there."""
CELLS = 64
"""Parts of the shortest wave of a series in which its crests are looked for."""


def segment_starts(segments: Floats) -> Floats:
    """Return the pivot time at which each segment starts."""
    return np.concatenate([[0.0], np.cumsum(segments[:-1, columns.DURATION])])


def refuse_endless(table: Floats, motion: object) -> None:
    """Refuse a base motion that has no end.

    Raises
    ------
    InputError
        If the base still moves in the last segment of its table.
    """
    if table[-1, columns.CONSTANT : columns.CEILING].any():
        raise InputError(
            "motion",
            motion,
            "it must come to an end",
            "give a Record or a Pulse, or end it: rs.motions.cut(motion, at=...)",
        )


def at_segment_starts(table: Floats, times: ArrayLike) -> Floats:
    """Return pivot times, moved to the start of a segment that rounding alone separates."""
    given = np.asarray(times, dtype=np.float64)
    starts = segment_starts(table)
    start = starts[np.searchsorted(starts, given * (1.0 + SAME_TIME), side="right") - 1]
    return np.where(np.abs(given - start) <= SAME_TIME * start, start, given)


def motion_after(table: Floats, time: float) -> Floats:
    """Return the segments of a motion from a pivot time on, with the still base after it.

    Parameters
    ----------
    table
        The motion, with the still base after it, which may carry an impulse too.
    time
        From 0 on; an impulse of the motion at that very time is still to come.
    """
    starts = segment_starts(table)
    time = float(at_segment_starts(table, time))
    index = int(np.searchsorted(starts, time, side="right")) - 1
    rest = table[index:].copy()
    since = time - float(starts[index])
    first = rest[0]
    first[columns.DURATION] -= since
    if since > 0.0:
        first[columns.JUMP] = 0.0
    first[columns.CONSTANT] += first[columns.SLOPE] * since
    first[columns.PHASE] += first[columns.FREQUENCY] * since
    if rest.shape[1] > columns.LIFT:
        first[columns.LIFT] += first[columns.LIFT_SLOPE] * since
    fill_bounds(rest)
    return np.ascontiguousarray(rest)


def pulse_times(segments: Floats, per_period: int) -> list[Floats]:
    """Return evenly spaced times in each sinusoid that ends and is quicker than pivot time."""
    starts = segment_starts(segments)
    turns = segments[:-1, columns.FREQUENCY] / (2.0 * math.pi)
    quick = (segments[:-1, columns.AMPLITUDE] > 0.0) & (turns > 1.0)
    counts = np.ceil(per_period * turns * segments[:-1, columns.DURATION]).astype(np.int64)
    return [np.linspace(starts[i], starts[i + 1], counts[i] + 1) for i in np.flatnonzero(quick)]


def pulse_turns(segments: Floats) -> float:
    """Return how many periods all sinusoids that end have together."""
    turns = segments[:-1, columns.FREQUENCY] / (2.0 * math.pi)
    return float((turns * segments[:-1, columns.DURATION]).sum())


def base_course(segments: Floats, s: Floats) -> tuple[Floats, Floats]:
    """Return pivot times with base accelerations, both values where a segment begins with a step.

    Parameters
    ----------
    segments
        The table.
    s
        Times in order; steps between the first and the last of them are added.
    """
    starts = segment_starts(segments)[1:]
    starts = starts[(starts > s[0]) & (starts <= s[-1])]
    times = np.union1d(s, np.concatenate([starts, np.nextafter(starts, 0.0)]))
    return times, base_acceleration(segments, times)


def impulses(segments: Floats) -> tuple[Floats, Floats]:
    """Return the pivot times of impulses and their changes of velocity, in units of alpha g/p."""
    struck = np.flatnonzero(segments[:, columns.JUMP])
    return segment_starts(segments)[struck], segments[struck, columns.JUMP]


def base_acceleration(segments: Floats, s: ArrayLike) -> Floats:
    """Return the base acceleration at pivot times, in units of alpha g."""
    index, since = _place(segments, s)
    row = segments[index]
    return _acceleration(row, since)


def lift(segments: Floats, s: ArrayLike) -> Floats:
    """Return the vertical base acceleration over g at pivot times; 0 where a table has none."""
    index, since = _place(segments, s)
    if segments.shape[1] <= columns.LIFT:
        return np.zeros(np.shape(index))
    row = segments[index]
    result: Floats = row[..., columns.LIFT] + row[..., columns.LIFT_SLOPE] * since
    return result


def accelerations_in(
    segments: Floats, starts: Floats, index: NDArray[np.int64], s: Floats
) -> tuple[Floats, Floats]:
    """Return horizontal [alpha g] and vertical acceleration [g] in given segments at pivot times.

    `starts` are those of `segment_starts`.

    At the end of a segment it is the value there, not that with which the next one begins.
    """
    row, since = segments[index], s - starts[index]
    across = _acceleration(row, since)
    if segments.shape[1] <= columns.LIFT:
        return across, np.zeros(len(row))
    return across, row[:, columns.LIFT] + row[:, columns.LIFT_SLOPE] * since


def peak_acceleration(segments: Floats) -> float:
    """Return the largest |base acceleration| of a motion that ends, in units of alpha g."""
    peak = 0.0
    for row in segments:
        lasting, slope, amplitude = row[[columns.DURATION, columns.SLOPE, columns.AMPLITUDE]]
        if not math.isfinite(lasting):
            lasting = 0.0
        frequency, phase = row[[columns.FREQUENCY, columns.PHASE]]
        at = np.array([0.0, lasting])
        if amplitude and _is_series(row):
            at = np.concatenate([at, _crests(row, lasting)])
        elif amplitude:
            # Where slope + amplitude frequency cos(turned) is 0.
            level = acos(np.clip(-slope / (amplitude * frequency), -1.0, 1.0))
            turns = np.arange(
                math.floor(phase / (2.0 * math.pi)),
                math.ceil((phase + frequency * lasting) / (2.0 * math.pi)) + 1,
            )
            turned = np.concatenate([2.0 * math.pi * turns + level, 2.0 * math.pi * turns - level])
            inner = (turned - phase) / frequency
            at = np.concatenate([at, inner[(inner > 0.0) & (inner < lasting)]])
        value = _acceleration(row, at)
        peak = max(peak, float(np.abs(value).max()))
    return peak


def largest_acceleration(segments: Floats) -> float:
    """Return an upper bound of |base acceleration| over all segments, in units of alpha g."""
    lasting = np.where(segments[:, columns.SLOPE] == 0.0, 0.0, segments[:, columns.DURATION])
    start = segments[:, columns.CONSTANT]
    ends = np.maximum(np.abs(start), np.abs(start + segments[:, columns.SLOPE] * lasting))
    return float((ends + segments[:, columns.AMPLITUDE]).max())


@np.errstate(under="ignore")
def swinging_course(segments: Floats, s: ArrayLike) -> tuple[Floats, Floats]:
    """Return velocity and displacement of a base in endless shaking, to and fro about 0."""
    a, w, phase = segments[0, [columns.AMPLITUDE, columns.FREQUENCY, columns.PHASE]]
    turned = w * np.asarray(s, dtype=np.float64) + phase
    velocity: Floats = np.zeros(np.shape(turned))
    displacement: Floats = np.zeros(np.shape(turned))
    for order, p, q in _waves(segments[0]):
        sine, cosine = sincos(order * turned)
        velocity = velocity - a / w * (p * cosine - q * sine) / order
        displacement = displacement - a / (w * w) * (p * sine + q * cosine) / (order * order)
    return velocity, displacement


@np.errstate(under="ignore")
def course_from_rest(segments: Floats, s: ArrayLike) -> tuple[Floats, Floats]:
    """Return velocity and displacement of a base that starts from rest at 0.

    They are the integrals of the base acceleration, with the impulses that its jumps of velocity
    stand for, in closed form on each segment.
    """
    lasting = segments[:-1, columns.DURATION]
    faster, further = _gains(segments[:-1], lasting)
    entering = np.cumsum(segments[:, columns.JUMP]) + np.concatenate([[0.0], np.cumsum(faster)])
    place = np.concatenate([[0.0], np.cumsum(entering[:-1] * lasting + further)])
    index, since = _place(segments, s)
    gained, moved = _gains(segments[index], since)
    return entering[index] + gained, place[index] + entering[index] * since + moved


def _place(segments: Floats, s: ArrayLike) -> tuple[NDArray[np.intp], Floats]:
    """Return in which segment each time lies, and how long after its start."""
    times = np.asarray(s, dtype=np.float64)
    starts = segment_starts(segments)
    index = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
    return index, times - starts[index]


@np.errstate(under="ignore")
def _gains(rows: Floats, since: Floats) -> tuple[Floats, Floats]:
    """Return velocity and displacement that segments starting from rest give in a time."""
    constant, slope = rows[..., columns.CONSTANT], rows[..., columns.SLOPE]
    phase, frequency = rows[..., columns.PHASE], rows[..., columns.FREQUENCY]
    w = np.where(frequency > 0.0, frequency, 1.0)  # without one there is no amplitude
    velocity = since * (constant + since * slope / 2.0)
    displacement = since * since * (constant / 2.0 + since * slope / 6.0)
    for order, p, q in _waves(rows):
        turn = order * w
        swing = rows[..., columns.AMPLITUDE] / turn
        sine, cosine = sincos(order * phase)
        late_sine, late_cosine = sincos(order * (w * since + phase))
        faster, slower = cosine - late_cosine, late_sine - sine
        velocity = velocity + swing * (p * faster + q * slower)
        displacement = displacement + swing * (
            p * (since * cosine - slower / turn) + q * (faster / turn - since * sine)
        )
    return velocity, displacement


@np.errstate(under="ignore")
def _acceleration(rows: Floats, since: Floats) -> Floats:
    """Return the base acceleration in segments a time after their start."""
    turned = rows[..., columns.FREQUENCY] * since + rows[..., columns.PHASE]
    if not _is_series(rows):
        swing = sin(turned)
    else:
        swing = np.zeros(np.shape(turned))
        for order, p, q in _waves(rows):
            sine, cosine = sincos(order * turned)
            swing = swing + (p * sine + q * cosine)
    result: Floats = (
        rows[..., columns.CONSTANT]
        + rows[..., columns.SLOPE] * since
        + rows[..., columns.AMPLITUDE] * swing
    )
    return result


def _is_series(rows: Floats) -> bool:
    """Return whether a Fourier series is in a table of segments, or in one of them."""
    return bool(rows.shape[-1] > columns.ORDERS)


def _waves(rows: Floats) -> Iterator[tuple[int, Floats | float, Floats | float]]:
    """Yield the orders of shaking, and the shares of their sine and cosine in each segment."""
    if not _is_series(rows):
        yield 1, 1.0, 0.0
        return
    single = rows[..., columns.ORDERS] == 0.0
    for at in range(columns.SHARES, rows.shape[-1], 2):
        order = 1 + (at - columns.SHARES) // 2
        p, q = rows[..., at], rows[..., at + 1]
        if p.any() or q.any() or order == 1:
            yield order, np.where(single, 1.0, p) if order == 1 else p, q


def _crests(row: Floats, lasting: float) -> Floats:
    """Return the times inside a segment at which a Fourier series is stationary."""
    w, orders = row[columns.FREQUENCY], max(row[columns.ORDERS], 1.0)
    count = math.ceil(CELLS * orders * max(w * lasting / (2.0 * math.pi), 1.0))
    low = np.linspace(0.0, lasting, count + 1)
    rate = _rate(row, low)
    inside = np.flatnonzero((rate[:-1] > 0.0) != (rate[1:] > 0.0))
    low, high, rising = low[inside], low[inside + 1], rate[inside] > 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        before = (_rate(row, middle) > 0.0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return low


def _rate(row: Floats, since: Floats) -> Floats:
    """Return the derivative of a Fourier series by the phase, over its bound."""
    turned = row[columns.FREQUENCY] * since + row[columns.PHASE]
    rate = np.zeros(np.shape(turned))
    for order, p, q in _waves(row):
        sine, cosine = sincos(order * turned)
        rate = rate + order * (p * cosine - q * sine)
    return rate
