"""Calls of the kernels that loop over cells, in any number of them."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.attractors import REAL_COLUMNS, WHOLE_COLUMNS
from rocksteady.kernels.core.tables import (
    ALPHA,
    CEILING,
    DURATION,
    LEAN,
    PEAK_COLUMNS,
    RATE,
    RESTITUTION,
)
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.kernels.nonlinear._expansion import BRIEF
from rocksteady.model.equations import Nonlinear
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.pulses import Pulse
from tools.aot.calls.drawn import CENTRES, PULSES, SLENDER, Drawn
from tools.aot.calls.recorder import Recorder

MOST = 10_000
"""Flights after which a motion is given up."""
AFTERWARDS = 1e4
"""Pivot time for which a block is followed after a record."""


def record_fates(call: Recorder, name: str, count: int, *, nonlinear: bool, leaping: bool) -> None:
    """Record the fates of blocks under harmonic shaking, by flights and by lanes.

    Parameters
    ----------
    call
        Keeps the records.
    name
        Decides the random numbers.
    count
        Number of cells.
    nonlinear
        Whether the blocks are those of the nonlinear model.
    leaping
        Whether lanes leap over the periods of periodic motions.
    """
    drawn = Drawn.by_name(name)
    a, w, angle, velocity, phase = _starts(drawn, count)
    sides = drawn.sides(count, nonlinear=nonlinear)
    cycles = int(drawn.between(20, 60))
    call("fates_of_sides", a, w, sides, angle, velocity, phase, cycles, MOST, *_fates(count))
    start = angle, velocity, phase, cycles, leaping, MOST
    lanes = "nonlinear_lane_fates" if nonlinear else "lane_fates"
    call(lanes, a, w, sides, *start, *_fates(count))


def record_attractors(
    call: Recorder, name: str, count: int, *, nonlinear: bool, chatter: bool = False
) -> None:
    """Record what motions settle to.

    Parameters
    ----------
    call, name, count, nonlinear
        As for `record_fates`.
    chatter
        Whether they start at rest and come to rest again and again.
    """
    drawn = Drawn.by_name(name)
    a, w, angle, velocity, phase = _starts(drawn, count)
    sides = drawn.sides(count, nonlinear=nonlinear)
    if chatter:  # slow shaking, lossy impacts: orbits that rest
        w = drawn.rng.uniform(1.0, 4.0, count)
        a = 1.02 + 0.15 * w * drawn.rng.random(count)
        sides[:, :, RESTITUTION] -= 0.3
        angle, velocity = 0.0 * angle, 0.0 * velocity
    half, rest = np.zeros(count, np.int64), np.zeros(count)
    call.quietly("fill_clocks", phase, half, rest)
    side = np.where(angle != 0.0, np.sign(angle), np.sign(velocity)).astype(np.int64)
    whole = np.zeros((count, WHOLE_COLUMNS), np.int64)
    real = np.zeros((count, REAL_COLUMNS))
    begin = side, angle, velocity, half, rest
    call("settle_cells", a, w, sides, *begin, 100, whole, real)
    if nonlinear:
        given = a, w, sides, *begin, 100, np.zeros_like(whole), np.zeros_like(real)
        call("nonlinear_lane_attractors", *given)
    else:
        r = sides[:, 0, RESTITUTION].copy()
        call("lane_attractors", a, w, r, *begin, 100, np.zeros_like(whole), np.zeros_like(real))


def record_steady_states(call: Recorder, name: str, count: int, *, shapes: bool) -> None:
    """Record steady states and their curves, over ranges beyond those of any picture.

    Parameters
    ----------
    call, name, count
        As for `record_fates`.
    shapes
        Whether peaks and admissibility are wanted.
    """
    drawn = Drawn.by_name(name)
    rng = drawn.rng
    a = exp(rng.uniform(math.log(1e-2), math.log(30.0), count))
    w = exp(rng.uniform(math.log(0.05), math.log(50.0), count))
    r = rng.uniform(0.05, 1.0, count)
    order = 1 + 2 * rng.integers(0, 3, count)
    out = (np.zeros((2, count)) for _ in range(4))
    call(
        "fill_steady",
        *(a, w, r, order, shapes, np.zeros(count, np.int64), np.zeros((3, count))),
        *out,
        *(np.zeros((2, count), np.int64), np.zeros((2, count), np.bool_)),
    )
    call("fill_curves", w, 0.999 * r, order, np.zeros((5, count)))


def record_records(
    call: Recorder,
    name: str,
    count: int,
    *,
    nonlinear: bool,
    samples: int,
    scattered: bool = False,
    brief: bool = False,
) -> None:
    """Record the fates of blocks under a record.

    Parameters
    ----------
    call, name, count, nonlinear
        As for `record_fates`.
    samples
        Of the record.
    scattered
        Whether restitution scatters from impact to impact.
    brief
        Whether the blocks are so large that all their samples are brief steps.
    """
    drawn = Drawn.by_name(name)
    segments = drawn.segments("record", nonlinear=nonlinear, samples=samples)
    sides = drawn.sides(count, nonlinear=nonlinear, scattered=scattered)
    sides[:, :, LEAN] *= drawn.rng.uniform(0.5, 3.0, count)[:, np.newaxis]
    sides[:, :, RATE] *= drawn.rng.uniform(0.3, 3.0, count)[:, np.newaxis]
    if brief:
        sides[:, :, RATE] *= BRIEF / (segments[:-1, DURATION].max() * sides[:, :, RATE].max())
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    after = np.full(count, AFTERWARDS)
    peaks = np.zeros((count, PEAK_COLUMNS))
    call("record_fates", segments, sides, after, 2000, status, impacts, peaks)
    centres = np.tile(CENTRES, (count, 1, 1))
    call("record_forces", segments, sides, after, centres, 2000, np.zeros((count, 2)))
    call("fill_hardest", segments, nonlinear, np.zeros(len(segments) - 1))


def record_pulses(call: Recorder, name: str, count: int, *, nonlinear: bool) -> None:
    """Record the fates of a block under pulses; parameters as for `record_fates`."""
    drawn = Drawn.by_name(name)
    shape = str(drawn.rng.choice(PULSES))
    pulse = Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0, tolerance=3e-2)
    segments = np.ascontiguousarray(segment_table(pulse)[:-1])
    sides = drawn.sides(1, nonlinear=nonlinear)[0]
    if nonlinear:
        segments = np.ascontiguousarray(Nonlinear().lower(SLENDER, pulse).segments[:-1])
        segments[:, CEILING] = math.inf
    uplift = math.tan(sides[0, ALPHA]) / sides[0, ALPHA] if nonlinear else 1.0
    amplitude = uplift * exp(drawn.rng.uniform(-0.3, 3.0, count))
    ratio = exp(drawn.rng.uniform(math.log(0.3), math.log(12.0), count))
    out = (np.zeros(count, np.int64) for _ in range(4))
    call("pulse_fates", segments, sides, amplitude, ratio, 1e-3, 2000, *out, np.zeros(count))


def _starts(drawn: Drawn, count: int) -> tuple[NDArray[Any], ...]:
    """Return amplitudes, frequency ratios, angles, velocities and phases of cells."""
    rng = drawn.rng
    w = exp(rng.uniform(math.log(0.5), math.log(12.0), count))
    a = rng.uniform(0.8, 1.2 + 0.5 * w)
    angle = np.where(rng.random(count) < 0.5, 0.0, rng.uniform(-0.6, 0.6, count))
    velocity = np.where(rng.random(count) < 0.2, 0.0, rng.uniform(-0.5, 0.5, count))
    return a, w, angle, velocity, rng.uniform(-math.pi, math.pi, count)


def _fates(count: int) -> tuple[NDArray[Any], ...]:
    """Return room for status, impacts and final states."""
    return np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros((count, 3))
