"""Calls of the kernels under periodic shaking that is a Fourier series."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.attractors import REAL_COLUMNS, WHOLE_COLUMNS
from rocksteady.kernels.core.tables import RESTITUTION, left_out_of
from rocksteady.kernels.orbits.chains import CHAIN_COLUMNS
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import FALL, STAY, STUCK, Section
from rocksteady.kernels.orbits.settle import MEMORY, PERIODIC
from rocksteady.kernels.orbits.systems import SeriesSystem
from rocksteady.model.motions.fourier import shares_of
from tools.aot.calls.drawn import Drawn
from tools.aot.calls.recorder import Recorder

Floats = NDArray[np.float64]

WAVES = ((1, 1.0, 0.0), (2, 0.4, 0.7), (5, 0.1, -1.2))
CASES = ((2.0, 4.0, 0.8), (1.6, 2.0, 0.6))
"""Amplitude, frequency ratio and restitution."""
CELLS = 6
CYCLES = 40


def record_series(call: Recorder) -> None:
    """Record fates, attractors, passages, orbits and chains of both models."""
    for k, nonlinear in enumerate((False, True)):
        a, w, r = CASES[k]
        drawn = Drawn.by_name(f"series, {nonlinear}")
        sides = drawn.sides(1, nonlinear=nonlinear, alike=1.0)[0]
        sides[:, RESTITUTION] = r
        total, shares = shares_of(WAVES)
        system = call.quietly("make_system", total * a, w, sides)
        lifts = np.zeros((2, len(shares) // 2))
        call("fill_uplifts", system, shares, lifts)
        series = SeriesSystem._make([*system[:9], left_out_of(sides), shares, lifts])
        _record_cells(call, drawn, np.full(CELLS, total * a), w, shares, sides)
        _record_orbit(call, drawn, series)
        places = np.array([0.2, 1.3, 2.9, 4.4])
        turns = np.floor(places / math.pi).astype(np.int64)
        phases, table = places - turns * math.pi, np.zeros((4, CHAIN_COLUMNS))
        call("series_fill_chain", series, turns, phases, 2, table)
        call("series_fill_arcs", series, turns, phases, table, np.zeros((4, 3)))


def _record_cells(
    call: Recorder,
    drawn: Drawn,
    amplitude: Floats,
    frequency_ratio: float,
    shares: Floats,
    sides: Floats,
) -> None:
    """Record fates and attractors of some cells."""
    ratios, blocks = np.full(CELLS, frequency_ratio), np.stack([sides] * CELLS)
    angle, velocity = drawn.rng.uniform(-0.6, 0.6, (2, CELLS))
    phase = drawn.rng.uniform(0.0, 3.0, CELLS)
    ends = np.zeros((2, CELLS), dtype=np.int64)
    shaken = amplitude, ratios, shares, blocks
    call(
        "series_fates",
        *shaken,
        angle.copy(),
        velocity.copy(),
        phase,
        CYCLES,
        100_000,
        ends[0].copy(),
        ends[1].copy(),
        np.zeros((CELLS, 3)),
    )
    side = np.where(angle >= 0.0, 1, -1)
    half = np.zeros(CELLS, dtype=np.int64)
    whole, real = np.zeros((CELLS, WHOLE_COLUMNS), np.int64), np.zeros((CELLS, REAL_COLUMNS))
    begin = side, angle.copy(), velocity.copy(), half, phase
    call("settle_series_cells", *shaken, *begin, CYCLES, whole, real)


def _record_orbit(call: Recorder, drawn: Drawn, system: SeriesSystem) -> None:
    """Record passages, what a motion settles to, and how its orbit is found and measured again."""
    call("series_uplift_after", system, 0, drawn.between(0.0, 3.0))
    for speed in (0.05, 0.4):
        state = Section(1, 0, drawn.between(0.0, 3.0), speed)
        step = call("series_next_passage", system, state, -1.0)
        if step.kind not in (FALL, STAY, STUCK):
            call("series_highest_after", system, state, step)
    phases, speeds = np.linspace(0.1, 6.0, 5), np.linspace(0.05, 0.8, 4)
    table, found = np.zeros((8, ORBIT_COLUMNS)), np.zeros((6, 2))
    shape = np.zeros((6, 2), np.int64)
    call("series_search", system, phases, speeds, 4, 3, False, table, found, shape, 0)
    memory, table = np.zeros((MEMORY, 5)), np.zeros((MEMORY, ORBIT_COLUMNS))
    start = (0, 0, 0.0, 0.0, 0.0, 200)  # from rest
    settled = call("series_settle", system, *start, memory, table)
    if settled.outcome != PERIODIC:
        message = "a motion of this case does not settle: draw another one"
        raise ValueError(message)
    passages, periods, near = settled.passages, settled.periods, settled.state
    table = table[:passages].copy()
    rows = np.zeros((passages, ORBIT_COLUMNS))
    fixed = call("series_polish", system, near, passages, periods, rows)
    call("series_measured", system, passages, periods, table)
    call("series_fill_peaks", system, passages, table)
    call("series_is_symmetric", system, table, passages, periods)
    call("series_loss", system, near.side, passages, fixed.rests)
