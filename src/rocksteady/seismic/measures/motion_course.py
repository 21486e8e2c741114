"""History of any base motion: acceleration, velocity and displacement."""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history import base_motion
from rocksteady.kernels.core import tables as columns
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Motion

PERIODS = 3
"""Of an endless motion, that its history has."""
PER_PERIOD = 100
"""Rows of a history in a period of its fastest sinusoid."""
FEWEST = 200
"""Rows of a history."""
STEP = 1e-9
"""Change of acceleration over its largest value from which on it is a step."""


class MotionCourse(NamedTuple):
    """History of the base over pivot time: units of alpha g, alpha g/p and alpha g/p^2."""

    pt: Floats
    acceleration: Floats
    velocity: Floats
    displacement: Floats


def motion_course(motion: Motion) -> MotionCourse:
    """Return the history of a dimensionless motion; of an endless one the first 3 periods.

    Harmonic shaking goes to and fro about 0; any other motion starts from rest at 0.  Where
    acceleration or velocity has a step both of its values have a row.
    """
    table = segment_table(motion)
    times = _times(table)
    starts = base_motion.segment_starts(table)[1:]
    before = np.nextafter(starts, 0.0)
    rises = np.abs(
        np.subtract(*(base_motion.base_acceleration(table, t) for t in (starts, before)))
    )
    largest = base_motion.largest_acceleration(table)
    struck = table[1:, columns.JUMP] != 0.0
    times = np.union1d(times, before[struck | (rises > STEP * largest)])
    return course_at(table, times, swings=isinstance(motion, PeriodicMotion))


def course_at(table: Floats, times: Floats, *, swings: bool) -> MotionCourse:
    """Return the history of a table of segments at pivot times.

    Parameters
    ----------
    table
        From `segment_table`.
    times
        In order.
    swings
        Whether the base goes to and fro about 0, as in endless harmonic shaking; else it starts
        from rest at 0.
    """
    integrals = base_motion.swinging_course if swings else base_motion.course_from_rest
    return MotionCourse(
        times, base_motion.base_acceleration(table, times), *integrals(table, times)
    )


def _times(table: Floats) -> Floats:
    """Return the times of a history, the start of each segment among them."""
    starts = base_motion.segment_starts(table)
    waves = np.where(table[:, columns.AMPLITUDE] > 0.0, table[:, columns.FREQUENCY], 0.0)
    orders = table[:, columns.ORDERS] if table.shape[1] > columns.ORDERS else np.ones(len(table))
    # After the last segment a motion that ends is still, or goes on at the velocity of an impulse.
    after = 2.0 * math.pi * PERIODS / waves[-1] if waves[-1] else 0.1 * starts[-1] or 1.0
    spans = np.append(np.diff(starts), after)
    turns = spans * waves * np.maximum(orders, 1.0) / (2.0 * math.pi)
    counts = np.maximum(np.ceil(PER_PERIOD * turns), math.ceil(FEWEST / len(table)))
    parts = [
        start + span * np.arange(count) / count
        for start, span, count in zip(starts, spans, counts, strict=True)
    ]
    return np.append(np.concatenate(parts), starts[-1] + after)
