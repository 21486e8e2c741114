"""The package's own march: side by side in vector lanes, the same leaping, and one by one."""

import math
import time
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bench.peers.work import (
    CYCLES,
    OVERTURNED,
    RESTITUTION,
    START_VELOCITY,
    TURN,
    Cells,
    Outcome,
    Peer,
)
from rocksteady.kernels.batch.harmonic import harmonic_segment
from rocksteady.kernels.core.tables import (
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
)
from rocksteady.kernels.core.tables import RESTITUTION as SIDE_RESTITUTION
from rocksteady.kernels.core.tuples import Fates, Kept, Tables, Until
from rocksteady.kernels.march.march import march
from tests.kernels.fates import NO_LIMIT, fates_in_lanes, harmonic_fates


def peers() -> list[Peer]:
    """Return the march in its three ways, compiled."""
    one = Cells(np.ones(1), np.ones(1), np.zeros(1, np.int64))
    ways = {
        "rocksteady": (run, "vector lanes, every trajectory to its end"),
        "rocksteady, leaping": (
            leaping,
            "vector lanes, over the periods of periodic motions",
        ),
        "rocksteady, scalar": (scalar, "one trajectory after the other, to its end"),
    }
    for way, _ in ways.values():
        way(one)
    return [
        Peer(name=name, version=version("rocksteady"), settings=settings, thinned=1, run=way)
        for name, (way, settings) in ways.items()
    ]


def run(cells: Cells) -> Outcome:
    """March the cells in lanes, each to its end: what all others are compared with."""
    return timed(partial(_in_lanes, False), cells)


def leaping(cells: Cells) -> Outcome:
    """March the cells in lanes, over the periods of those that have become periodic."""
    return timed(partial(_in_lanes, True), cells)


def scalar(cells: Cells) -> Outcome:
    """March the cells one after the other."""
    return timed(harmonic_fates, cells)


def _in_lanes(leaping: bool, *given: Any) -> None:
    """Call `fates_in_lanes` with the arguments of `harmonic_fates`."""
    *columns, cycles, status, impacts, final = given
    fates_in_lanes(np.array(columns), cycles, leaping, Fates(status, impacts, final))


def timed(fates: Callable[..., None], cells: Cells) -> Outcome:
    """Run a kernel."""
    count = len(cells.amplitude)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    zeros, final = np.zeros(count), np.empty((count, 3))
    restitution, velocity = np.full(count, RESTITUTION), np.full(count, START_VELOCITY)
    start = (zeros, velocity, zeros)
    shaken = (cells.amplitude, cells.frequency_ratio, restitution)
    began = time.process_time()
    fates(*shaken, *start, CYCLES, status, impacts, final)
    seconds = time.process_time() - began
    return Outcome(status=status, impacts=impacts, last_phase=None, seconds=seconds, final=final)


def last_phases(cells: Cells, outcome: Outcome, flights: "Record") -> NDArray[np.float64]:
    """Return the phase of the last impact, by Newton's method back from the state at the end.

    Runs that overturn have none that their end would tell.
    """
    assert outcome.final is not None
    angle, velocity = outcome.final[:, 0], outcome.final[:, 1]
    side = np.sign(angle)
    y, v = side * angle, side * velocity
    a, w = cells.amplitude, cells.frequency_ratio
    beta = a / (1.0 + w * w)
    # The run ends at a phase of whole turns, as seen from the positive side.
    swing = side * beta * w
    # Where a run overturned there is nothing to go back from.
    time = np.where(outcome.status == OVERTURNED, -1.0, np.nan_to_num(-flights.since, nan=-1.0))
    for _ in range(3):
        grown = np.expm1(time)
        decayed = grown / (1.0 + grown)  # 1 - e^-t
        sinh, rise = 0.5 * (grown + decayed), 0.5 * grown * decayed
        there = y + (v + swing) * sinh + (y - 1.0) * rise - side * beta * np.sin(w * time)
        speed = v + (v + swing) * rise + (y - 1.0) * sinh + swing * (1.0 - np.cos(w * time))
        time = time - there / speed
    phases: NDArray[np.float64] = (w * time) % TURN
    return np.where(outcome.status == OVERTURNED, flights.last_phase, phases)


class Record(NamedTuple):
    """What a march that records its flights adds, one value a cell."""

    last_phase: NDArray[np.float64]  # of the last impact, in [0, 2 pi); NaN without one
    since: NDArray[np.float64]  # pivot time from it to the end of a run of whole length
    rested: NDArray[np.bool_]  # at some time


def record(cells: Cells) -> Record:
    """March the cells once more and record their flights."""
    count = len(cells.amplitude)
    last, since, rested = np.full(count, math.nan), np.full(count, math.nan), np.zeros(count, bool)
    segments, sides = np.zeros((1, SEGMENT_COLUMNS)), np.zeros((2, 3))
    sides[:, LEAN] = sides[:, RATE] = 1.0
    sides[:, SIDE_RESTITUTION] = RESTITUTION
    start = March(1, 0.0, START_VELOCITY, 0, 0, 0.0, 0, 0)
    tables, until = Tables(segments, sides), Until(2 * CYCLES, 0.0, math.inf, NO_LIMIT)
    nothing = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    for i in range(count):
        harmonic_segment(segments, cells.amplitude[i], cells.frequency_ratio[i], 0.0)
        _, end = march(tables, start, until, Kept(*nothing))
        rows = np.zeros((end.flights, ROW_COLUMNS))
        march(tables, start, until, Kept(rows, nothing[1]))
        rested[i] = bool((rows[:, ROW_SIDE] == 0).any())
        # An impact stands at the start of the row after the one that it ended.
        after = np.flatnonzero(rows[:-1, ROW_EVENT] == ENDED_BY_IMPACT) + 1
        if len(after):
            row = rows[after[-1]]
            last[i] = (math.pi * (row[ROW_HALF_CYCLES] % 2) + row[ROW_PHASE]) % TURN
            left = math.pi * (2 * CYCLES - row[ROW_HALF_CYCLES]) - row[ROW_PHASE]
            since[i] = left / cells.frequency_ratio[i]
    return Record(last, since, rested)
