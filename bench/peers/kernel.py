"""The package's own march, each trajectory to its end: nothing stops early once it is periodic."""

import math
import time
from importlib.metadata import version
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bench.peers.work import (
    CYCLES,
    RESTITUTION,
    START_VELOCITY,
    TURN,
    Cells,
    Outcome,
    Peer,
)
from rocksteady.kernels.cells import NO_LIMIT, harmonic_fates, harmonic_segment
from rocksteady.kernels.march import (
    ENDED_BY_IMPACT,
    LEAN,
    RATE,
    ROW_COLUMNS,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    SEGMENT_COLUMNS,
    March,
    march,
)
from rocksteady.kernels.march import RESTITUTION as SIDE_RESTITUTION


def peers() -> list[Peer]:
    """Return the march, compiled."""
    run(Cells(np.ones(1), np.ones(1), np.zeros(1, np.int64)))
    return [
        Peer(
            name="rocksteady",
            version=version("rocksteady"),
            settings="closed form, one cell after the other",
            thinned=1,
            run=run,
        )
    ]


def run(cells: Cells) -> Outcome:
    """March the cells."""
    count = len(cells.amplitude)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    zeros, final = np.zeros(count), np.empty((count, 3))
    restitution, velocity = np.full(count, RESTITUTION), np.full(count, START_VELOCITY)
    began = time.process_time()
    harmonic_fates(
        cells.amplitude,
        cells.frequency_ratio,
        restitution,
        zeros,
        velocity,
        zeros,
        CYCLES,
        status,
        impacts,
        final,
    )
    seconds = time.process_time() - began
    return Outcome(status=status, impacts=impacts, last_phase=None, seconds=seconds)


class Record(NamedTuple):
    """What a march that records its flights adds, one value a cell."""

    last_phase: NDArray[np.float64]  # of the last impact, in [0, 2 pi); NaN without one
    rested: NDArray[np.bool_]  # at some time


def record(cells: Cells) -> Record:
    """March the cells once more and record their flights."""
    count = len(cells.amplitude)
    last, rested = np.full(count, math.nan), np.zeros(count, bool)
    segments, sides = np.zeros((1, SEGMENT_COLUMNS)), np.zeros((2, 3))
    sides[:, LEAN] = sides[:, RATE] = 1.0
    sides[:, SIDE_RESTITUTION] = RESTITUTION
    start = March(1, 0.0, START_VELOCITY, 0, 0, 0.0, 0, 0)
    until = (2 * CYCLES, 0.0, math.inf, NO_LIMIT)
    for i in range(count):
        harmonic_segment(segments, cells.amplitude[i], cells.frequency_ratio[i], 0.0)
        _, end = march(segments, sides, start, *until, np.zeros((0, ROW_COLUMNS)))
        rows = np.zeros((end.flights, ROW_COLUMNS))
        march(segments, sides, start, *until, rows)
        rested[i] = bool((rows[:, ROW_SIDE] == 0).any())
        # An impact stands at the start of the row after the one that it ended.
        after = np.flatnonzero(rows[:-1, ROW_EVENT] == ENDED_BY_IMPACT) + 1
        if len(after):
            row = rows[after[-1]]
            last[i] = (math.pi * (row[ROW_HALF_CYCLES] % 2) + row[ROW_PHASE]) % TURN
    return Record(last, rested)
