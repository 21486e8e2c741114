"""What the kernels are given: cells of a map, or blocks on a record, as many as are asked for."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady import Block, Linear, Nonlinear, Record
from rocksteady.dynamics.batch.left_over import in_threads
from rocksteady.kernels.batch.attractors import REAL_COLUMNS, WHOLE_COLUMNS
from rocksteady.kernels.core.tables import LEAN, RATE
from rocksteady.kernels.core.tuples import (
    Blocks,
    Cells,
    Fates,
    Outcomes,
    PeakFates,
    Starts,
    States,
    SymmetricCells,
)
from rocksteady.kernels.entries import ENTRIES
from rocksteady.model.linear_tables import record_table
from tests.records import synthetic

CYCLES = 200
RESTITUTION = 0.8
MOST = 10**6
AMPLITUDES, FREQUENCIES = (1.0, 6.0), (1.0, 12.0)
VELOCITY = 0.3
BLOCK = Block.from_p(alpha=0.2, p=1.0, restitution=RESTITUTION)
SAMPLES, STEP, PEAK = 5400, 0.01, 3.4

Arguments = tuple[Any, ...]
Floats = NDArray[np.float64]

SECONDS = {
    "lane_fates": 3e-6,
    "nonlinear_lane_fates": 6e-5,
    "lane_attractors": 5e-6,
    "nonlinear_lane_attractors": 1e-4,
    "settle_cells": 1e-4,
    "nonlinear_settle_cells": 3e-3,
    "record_fates": 1e-4,
    "nonlinear_record_fates": 8e-4,
}
"""About what a cell takes one core of a processor, by the form's name: how many cells are a batch,
and for how many there is time to compute them there as well."""


def host_kernel(name: str) -> Any:
    """Return the host kernel that a form, by its name, does the work of."""
    return ENTRIES[name if name in ENTRIES else name.removeprefix("nonlinear_")]


def work(name: str, count: int, seed: int = 0) -> Arguments:
    """Return the arguments of a host kernel, by its form's name, for so many cells.

    Cells of a map of amplitude and frequency ratio as in B1, or blocks from rest on one record.
    With a seed the corner of the map is drawn, so that no cell comes twice.
    """
    nonlinear = name.startswith("nonlinear_")
    if name.endswith("record_fates"):
        return _records(count, nonlinear=nonlinear)
    amplitude, frequency = _map(count, seed)
    zeros = np.zeros(count)
    columns = 5 if nonlinear else 3
    model = Nonlinear() if nonlinear else Linear()
    sides = np.broadcast_to(model.sides(BLOCK), (count, 2, columns)).copy()
    ratio = np.full(count, RESTITUTION)
    fates = Fates(np.empty(count, np.int64), np.empty(count, np.int64), np.empty((count, 3)))
    begin = Starts(zeros, np.full(count, VELOCITY), zeros.copy())
    blocks = Cells(amplitude, frequency, sides)
    alike = SymmetricCells(amplitude, frequency, ratio)
    if name.endswith("lane_fates"):
        return blocks, begin, CYCLES, True, MOST, fates
    side, half = np.ones(count, np.int64), np.zeros(count, np.int64)
    states = States(side, begin.angle, begin.velocity, half, begin.phase)
    table = np.empty((count, WHOLE_COLUMNS), np.int64)
    outcomes = Outcomes(table, np.empty((count, REAL_COLUMNS)))
    return alike if name == "lane_attractors" else blocks, states, CYCLES, outcomes


def _map(count: int, seed: int) -> tuple[Floats, Floats]:
    """Return amplitudes and frequency ratios of a map, row by row of one amplitude."""
    rows = max(1, math.isqrt(count))
    columns = -(-count // rows)
    off = np.random.default_rng(seed).random(2) if seed else np.zeros(2)
    frequency, amplitude = np.meshgrid(
        FREQUENCIES[0] + np.ptp(FREQUENCIES) * (np.arange(columns) + off[0]) / columns,
        AMPLITUDES[0] + np.ptp(AMPLITUDES) * (np.arange(rows) + off[1]) / rows,
    )
    return amplitude.ravel()[:count].copy(), frequency.ravel()[:count].copy()


def _records(count: int, *, nonlinear: bool) -> Arguments:
    """Return blocks from 0.5 to 3.3 m/s^2 of uplift acceleration and p from 1 to 8/s on noise."""
    values = synthetic(np.random.default_rng(1940), SAMPLES, STEP, PEAK)
    record = Record(acceleration_m_s2=values, dt_s=STEP)
    rows = max(1, math.isqrt(count))
    rate, uplift = np.meshgrid(
        np.linspace(1.0, 8.0, -(-count // rows)), np.linspace(0.5, 3.3, rows)
    )
    model = Nonlinear() if nonlinear else Linear()
    block = Block.from_p(alpha=0.2, p=1.0, restitution=0.9)
    sides = np.broadcast_to(model.sides(block), (count, 2, 5 if nonlinear else 3)).copy()
    sides[:, :, LEAN] = uplift.ravel()[:count, np.newaxis]
    sides[:, :, RATE] = rate.ravel()[:count, np.newaxis]
    segments = Nonlinear().lower(block, record).segments if nonlinear else record_table(record)
    fates = PeakFates(np.empty(count, np.int64), np.empty(count, np.int64), np.empty((count, 2)))
    return segments, Blocks(sides, np.full(count, 1e15)), 10**7, fates


def impacts_of(name: str, arguments: Arguments) -> int | None:
    """Return the impacts of all cells; None where a kernel does not count them."""
    if name.endswith(("lane_attractors", "settle_cells")):
        return None
    fates: Fates | PeakFates = arguments[-1]
    return int(fates.impacts[fates.status >= 0].sum())


def classes(arguments: Arguments) -> NDArray[np.int64]:
    """Return the class of each cell: the status code, or the outcome of an attractor."""
    first: NDArray[np.int64] = arguments[-1][0]
    return first if first.ndim == 1 else first[:, 0]


def on_host(name: str, arguments: Arguments, workers: int) -> Arguments:
    """Return the arguments with the results of the host kernel, computed in threads."""
    *taken, results = arguments
    given = (*taken, type(results)(*(np.empty_like(each) for each in results)))
    in_threads(host_kernel(name), given, workers)
    return given
