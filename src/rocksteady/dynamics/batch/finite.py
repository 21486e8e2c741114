"""Fates of many motions under base motions that end: for each the march that `simulate` makes."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import motion_after, refuse_endless
from rocksteady.dynamics.history.samples import COUNTED_IMPACTS
from rocksteady.dynamics.history.simulate import FLIGHT_LIMIT
from rocksteady.dynamics.history.start import set_going
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.elementary.arrays import atan2, exp, hypot, sincos
from rocksteady.kernels.march.facts import ELASTIC_TIME, LONGEST_REST
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import peaks_until_overturning
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import in_range
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import LONGEST_DURATION, Motion
from rocksteady.outcomes import Status
from rocksteady.sweep.cases.outputs import Output

FATE = Output(
    name="fate",
    dtype=np.int8,
    long_name="what becomes of the block",
    flags={int(status): status.label for status in Status},
)
OUTPUTS = (
    FATE,
    Output(name="side", dtype=np.int8, long_name="side to which the block overturns, 0 of others"),
    Output(name="impacts", dtype=np.int64, long_name=COUNTED_IMPACTS),
    Output(name="peak", long_name="largest |theta|/alpha, until overturning"),
)
BATCH = 256
"""The most motions of one call: some tenths of a second, for which an interruption waits."""


class Fate(NamedTuple):
    """What becomes of a block: status, side to which it overturns, impacts and peak."""

    status: int
    side: int
    impacts: int
    peak: float


def fate_of(segments: Floats, sides: Floats, angle: float, velocity: float) -> Fate:
    """Return what becomes of a block from a state on, as `simulate` finds it.

    All but the peak is the same to the last bit, on a record where `Trajectory.growth` is below
    some 1e12, beyond which rounding decides; the peak is to within rounding, because it is
    kept on the way and not read off a history.

    Parameters
    ----------
    segments
        Table of the motion, with the still base after it.
    sides
        Sides of the block, shape (2, 3) or (2, 5).
    angle, velocity
        theta/alpha and its derivative by pivot time, before an impulse of the base at time 0.
    """
    jump = float(segments[0, columns.JUMP])
    side, later = set_going(angle, velocity, jump, sides)
    half, phase = segment_start(segments, 0)
    start = columns.March(side, angle, later, 0, half, phase, 0, 0)
    elastic = bool((np.abs(sides[:, columns.RESTITUTION]) == 1.0).all())
    most = ELASTIC_TIME if elastic else LONGEST_REST
    tables = Tables(segments, sides)
    peaks = np.zeros(columns.PASSAGE_COLUMNS)
    kept = Kept(np.zeros((0, columns.ROW_COLUMNS)), peaks)
    status, end = march(tables, start, Until(0, most, columns.COUNTED, FLIGHT_LIMIT), kept)
    if status != columns.OVERTURNED:
        return Fate(int(status), 0, end.impacts, float(peaks[columns.PEAK_ANGLE]))
    # Its peak counts until it passes its slenderness for good: in the last flight that rose above
    # it, unless it may have come back to it since, as an impulse may do unseen, or began there.
    again, flights, before = start, end.flights, 0.0
    passed = peaks[columns.PASSING_SIDE] != 0.0 and peaks[columns.PASSING_AGAIN] == 0.0
    if passed and not segments[:, columns.JUMP].any():
        again, flights, before = _kept(peaks), 1, peaks[columns.BEFORE_ANGLE]
    rows = np.zeros((flights, columns.ROW_COLUMNS))
    march(tables, again, Until(0, most, columns.COUNTED, flights), Kept(rows, np.zeros(0)))
    positive, negative, _ = peaks_until_overturning(segments, sides, rows)
    return Fate(int(status), end.side, end.impacts, float(max(before, positive, negative)))


def _kept(peaks: Floats) -> columns.March:
    """Return the state at the start of the flight that last rose above the slenderness."""
    side, angle, velocity, segment, half, phase = peaks[
        columns.PASSING_SIDE : columns.PASSING_AGAIN
    ].tolist()
    return columns.March(int(side), angle, velocity, int(segment), int(half), phase, 0, 0)


def fates_of(
    segments: Floats, sides: Floats, angle: Floats, velocity: Floats
) -> dict[str, NDArray[Any]]:
    """Return what becomes of one block from many states on, under the names of `OUTPUTS`."""
    states = zip(angle.tolist(), velocity.tolist(), strict=True)
    return collected([fate_of(segments, sides, *state) for state in states])


def collected(fates: list[Fate]) -> dict[str, NDArray[Any]]:
    """Return fates as arrays, under the names of `OUTPUTS`."""
    status, side, impacts, peak = zip(*fates, strict=True) if fates else ((), (), (), ())
    return {
        "fate": np.array(status, dtype=np.int8),
        "side": np.array(side, dtype=np.int8),
        "impacts": np.array(impacts, dtype=np.int64),
        "peak": np.array(peak, dtype=np.float64),
    }


def finite_table(
    motion: Motion | Record | BaseMotion,
    block: Block | DimensionlessBlock,
    model: Model,
    *,
    time_pt: float = 0.0,
) -> Floats:
    """Return the table of a base motion that ends, from a moment on, as `simulate` makes it.

    Raises
    ------
    InputError
        If it has no end, or the moment is outside [0, 1e6].
    ModelError
        As for `simulate`.
    """
    base = motion if isinstance(motion, BaseMotion) else BaseMotion(motion)
    table = model.lower(block, base.horizontal, base.vertical).segments
    refuse_endless(table, motion)
    hint = "give the pivot time p t of the states, 0 for the start of the motion"
    moment = in_range("time_pt", time_pt, 0.0, LONGEST_DURATION, "[]", hint=hint)
    return motion_after(table, moment)


def thrust(table: Floats, rate: float) -> float:
    """Return how far a motion shifts the states from which a flight grows, in units of alpha g.

    That is the integral of its acceleration over exp(rate s), with its impulses: a state of the
    linear model whose flight is to hold no exp(rate s) has u + (du/ds)/rate = 1 less this.
    """
    total, begun = 0.0, 0.0
    for row in table:
        lasting = float(row[columns.DURATION])
        weight = float(exp(-rate * begun))
        left = 0.0 if math.isinf(lasting) else float(exp(-rate * lasting))
        constant, slope = float(row[columns.CONSTANT]), float(row[columns.SLOPE])
        part = constant * (1.0 - left) / rate
        if slope:
            part += slope * ((1.0 - left) / rate - lasting * left) / rate
        for size, turn, phase in _waves(row):
            ends = []
            for time, share in ((0.0, 1.0), (0.0 if math.isinf(lasting) else lasting, left)):
                sine, cosine = sincos(phase + turn * time)
                ends.append(share * (rate * float(sine) + turn * float(cosine)))
            part += size * (ends[0] - ends[1]) / (rate * rate + turn * turn)
        total += weight * (rate * part + rate * float(row[columns.JUMP]))
        begun += lasting
        if weight < 1e-16:
            break
    return total


def _waves(row: Floats) -> Iterator[tuple[float, float, float]]:
    """Yield amplitude, frequency and phase of each sinusoid of a segment."""
    size, turn, phase = row[[columns.AMPLITUDE, columns.FREQUENCY, columns.PHASE]].tolist()
    if len(row) <= columns.ORDERS or row[columns.ORDERS] == 0.0:
        if size:
            yield size, turn, phase
        return
    orders = int(row[columns.ORDERS])
    shares = row[columns.SHARES : columns.SHARES + 2 * orders].reshape(orders, 2)
    for order, (sine, cosine) in enumerate(shares.tolist(), start=1):
        yield (
            size * float(hypot(sine, cosine)),
            order * turn,
            order * phase + float(atan2(cosine, sine)),
        )
