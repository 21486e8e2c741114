"""What the base of a block that rests on it must hold by friction."""

import math
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import base_course, lift, segment_starts
from rocksteady.dynamics.history.samples import Flights
from rocksteady.kernels.core import tables as columns

STEP: Final = 0.02
"""Phase of a sinusoid between two looks at the base."""
MOST_LOOKS: Final = 1_000_000


def resting_ratio(segments: Floats, flights: Flights, until: float, *, one_sided: bool) -> float:
    """Return the largest horizontal acceleration over the vertical force of a block at rest.

    In units of alpha g over the weight; infinite where the vertical force vanishes, 0 of a block
    that never rests.  Samples are looked at where they begin and end, sinusoids in even steps.

    Parameters
    ----------
    segments
        The base motion.
    flights
        Flights and rests.
    until
        Pivot time at which the run ends.
    one_sided
        Whether a wall takes what drives the block into it.
    """
    rests = flights.side == 0
    begins = flights.pt[rests]
    ends = np.minimum(begins + flights.duration[rests], until)
    if not len(begins):
        return 0.0
    times, across = base_course(
        segments, np.unique(np.concatenate([begins, ends, _looks(segments, until)]))
    )
    row = np.searchsorted(begins, times, side="right") - 1
    resting = (row >= 0) & (times <= ends[np.maximum(row, 0)])
    driven = np.maximum(across, 0.0) if one_sided else np.abs(across)
    down = 1.0 + lift(segments, times)
    held = np.divide(driven, down, out=np.full(len(times), math.inf), where=down > 0.0)
    return float(held[resting & (driven > 0.0)].max(initial=0.0))


def _looks(segments: Floats, until: float) -> Floats:
    """Return times in the sinusoids of a motion, as far as it is followed."""
    starts = np.minimum(segment_starts(segments), until)
    ends = np.append(starts[1:], until)
    phases = np.where(segments[:, columns.AMPLITUDE] > 0.0, segments[:, columns.FREQUENCY], 0.0)
    counts = np.ceil(phases * (ends - starts) / STEP)
    coarser = max(1.0, float(counts.sum()) / MOST_LOOKS)
    parts = [
        np.linspace(starts[place], ends[place], int(counts[place] / coarser) + 2)
        for place in np.flatnonzero(counts)
    ]
    return np.concatenate([np.empty(0), *parts])
