"""Strong-shaking duration and cumulative absolute velocity, exact between samples."""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.motions.record import Record


@dataclass(frozen=True, kw_only=True)
class StrongShaking:
    """When the absolute acceleration is above a threshold.

    Attributes
    ----------
    bracketed_s
        Time between the first and the last moment above it [s]; 0 if it is not reached.
    uniform_s
        Time above it in all [s].
    """

    bracketed_s: float
    uniform_s: float


def strong_shaking(record: Record, threshold_m_s2: float) -> StrongShaking:
    """Return how long a record is above a threshold, with the crossings inside samples.

    Parameters
    ----------
    record
        The record.
    threshold_m_s2
        Threshold of the absolute acceleration [m/s^2], above 0.
    """
    a = record.acceleration_m_s2
    first, last = np.empty(0), np.empty(0)
    # A line may be above the threshold and below minus it in one sample: each sign by itself.
    for signed in (a, -a):
        above = _parts_above(signed[:-1], signed[1:], threshold_m_s2)
        here = np.flatnonzero(above[1] > above[0])
        first = np.concatenate([first, here + above[0][here]])
        last = np.concatenate([last, here + above[1][here]])
    if len(first) == 0:
        return StrongShaking(bracketed_s=0.0, uniform_s=0.0)
    return StrongShaking(
        bracketed_s=float(last.max() - first.min()) * record.dt_s,
        uniform_s=float(np.sum(last - first)) * record.dt_s,
    )


def absolute_velocity(record: Record) -> float:
    """Return the cumulative absolute velocity [m/s], the integral of the absolute acceleration."""
    a0, a1 = record.acceleration_m_s2[:-1], record.acceleration_m_s2[1:]
    size = np.abs(a0) + np.abs(a1)
    # Two triangles where the line crosses zero, else a trapezium.
    triangles = (a0 * a0 + a1 * a1) / np.where(size > 0.0, size, 1.0)
    return 0.5 * record.dt_s * float(np.sum(np.where(a0 * a1 < 0.0, triangles, size)))


def _parts_above(start: Floats, end: Floats, level: float) -> tuple[Floats, Floats]:
    """Return between which parts of their length, in [0, 1], lines are above a level."""
    rise = end - start
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        crossing = (level - start) / rise
    low = np.where(start >= level, 0.0, np.where(end > level, crossing, 1.0))
    high = np.where(end >= level, 1.0, np.where(start > level, crossing, 0.0))
    return low, high
