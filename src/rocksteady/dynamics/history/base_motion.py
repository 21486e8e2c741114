"""Acceleration and displacement of the base at any time, from the table of segments.

Times are pivot times s = p t since the start; accelerations are in units of alpha g and
displacements in units of alpha g/p^2.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.elementary.arrays import acos, sin, sincos

Floats = NDArray[np.float64]


def segment_starts(segments: Floats) -> Floats:
    """Return the pivot time at which each segment starts."""
    return np.concatenate([[0.0], np.cumsum(segments[:-1, columns.DURATION])])


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
    both = np.union1d(s, np.concatenate([starts, np.nextafter(starts, 0.0)]))
    return both, base_acceleration(segments, both)


def impulses(segments: Floats) -> tuple[Floats, Floats]:
    """Return the pivot times of impulses and their changes of velocity, in units of alpha g/p."""
    struck = np.flatnonzero(segments[:, columns.JUMP])
    return segment_starts(segments)[struck], segments[struck, columns.JUMP]


def base_acceleration(segments: Floats, s: ArrayLike) -> Floats:
    """Return the base acceleration at pivot times, in units of alpha g."""
    index, since = _place(segments, s)
    row = segments[index]
    result: Floats = (
        row[..., columns.CONSTANT]
        + row[..., columns.SLOPE] * since
        + row[..., columns.AMPLITUDE]
        * sin(row[..., columns.FREQUENCY] * since + row[..., columns.PHASE])
    )
    return result


def lift(segments: Floats, s: ArrayLike) -> Floats:
    """Return the vertical base acceleration over g at pivot times; 0 where a table has none."""
    index, since = _place(segments, s)
    if segments.shape[1] <= columns.LIFT:
        return np.zeros(np.shape(index))
    row = segments[index]
    result: Floats = row[..., columns.LIFT] + row[..., columns.LIFT_SLOPE] * since
    return result


def accelerations_in(
    segments: Floats, index: NDArray[np.int64], s: Floats
) -> tuple[Floats, Floats]:
    """Return horizontal [alpha g] and vertical acceleration [g] in given segments at pivot times.

    At the end of a segment it is the value there, not that with which the next one begins.
    """
    row, since = segments[index], s - segment_starts(segments)[index]
    across: Floats = (
        row[:, columns.CONSTANT]
        + row[:, columns.SLOPE] * since
        + row[:, columns.AMPLITUDE] * sin(row[:, columns.FREQUENCY] * since + row[:, columns.PHASE])
    )
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
        if amplitude:
            # Where slope + amplitude frequency cos(turned) is 0.
            level = acos(np.clip(-slope / (amplitude * frequency), -1.0, 1.0))
            turns = np.arange(
                math.floor(phase / (2.0 * math.pi)),
                math.ceil((phase + frequency * lasting) / (2.0 * math.pi)) + 1,
            )
            turned = np.concatenate([2.0 * math.pi * turns + level, 2.0 * math.pi * turns - level])
            inner = (turned - phase) / frequency
            at = np.concatenate([at, inner[(inner > 0.0) & (inner < lasting)]])
        value = row[columns.CONSTANT] + slope * at + amplitude * sin(frequency * at + phase)
        peak = max(peak, float(np.abs(value).max()))
    return peak


def largest_acceleration(segments: Floats) -> float:
    """Return an upper bound of |base acceleration| over all segments, in units of alpha g."""
    lasting = np.where(segments[:, columns.SLOPE] == 0.0, 0.0, segments[:, columns.DURATION])
    start = segments[:, columns.CONSTANT]
    ends = np.maximum(np.abs(start), np.abs(start + segments[:, columns.SLOPE] * lasting))
    return float((ends + segments[:, columns.AMPLITUDE]).max())


def swinging_displacement(segments: Floats, s: ArrayLike) -> Floats:
    """Return the displacement of a base in endless harmonic shaking, to and fro about 0."""
    a, w, phase = segments[0, [columns.AMPLITUDE, columns.FREQUENCY, columns.PHASE]]
    result: Floats = -a / (w * w) * sin(w * np.asarray(s, dtype=np.float64) + phase)
    return result


def displacement_from_rest(segments: Floats, s: ArrayLike) -> Floats:
    """Return the displacement of a base that starts from rest at 0.

    It is the base acceleration, with the impulses that its jumps of velocity stand for, integrated
    twice, in closed form on each segment.
    """
    lasting = segments[:-1, columns.DURATION]
    faster, further = _gains(segments[:-1], lasting)
    velocity = np.cumsum(segments[:, columns.JUMP]) + np.concatenate([[0.0], np.cumsum(faster)])
    place = np.concatenate([[0.0], np.cumsum(velocity[:-1] * lasting + further)])
    index, since = _place(segments, s)
    result: Floats = place[index] + velocity[index] * since + _gains(segments[index], since)[1]
    return result


def _place(segments: Floats, s: ArrayLike) -> tuple[NDArray[np.intp], Floats]:
    """Return in which segment each time lies, and how long after its start."""
    times = np.asarray(s, dtype=np.float64)
    starts = segment_starts(segments)
    index = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
    return index, times - starts[index]


def _gains(rows: Floats, since: Floats) -> tuple[Floats, Floats]:
    """Return velocity and displacement that segments starting from rest give in a time."""
    constant, slope = rows[..., columns.CONSTANT], rows[..., columns.SLOPE]
    phase, frequency = rows[..., columns.PHASE], rows[..., columns.FREQUENCY]
    w = np.where(frequency > 0.0, frequency, 1.0)  # without one there is no amplitude
    swing = rows[..., columns.AMPLITUDE] / w
    turned = w * since + phase
    (sine, cosine), (late_sine, late_cosine) = sincos(phase), sincos(turned)
    velocity = since * (constant + since * slope / 2.0) + swing * (cosine - late_cosine)
    displacement = since * since * (constant / 2.0 + since * slope / 6.0) + swing * (
        since * cosine - (late_sine - sine) / w
    )
    return velocity, displacement
