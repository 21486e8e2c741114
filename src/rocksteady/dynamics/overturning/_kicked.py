"""Fates of a block after kicks of many sizes, from a state, under what is left of a motion."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.history.base_motion import segment_starts
from rocksteady.dynamics.history.lowering import ceilings, samples_alike
from rocksteady.dynamics.overturning.scan import Fates
from rocksteady.dynamics.overturning.window_cells import FLIGHT_LIMIT, REST_VELOCITY
from rocksteady.kernels.batch._still_base import fate_on_still_base
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.march.march import march
from rocksteady.kernels.nonlinear.drive import jump_share

Floats = NDArray[np.float64]

LOST = 1.0
"""Margin of a block that is lost before the motion ends."""


@dataclass(frozen=True, kw_only=True)
class Kicked:
    """A block that is kicked.

    Attributes
    ----------
    angle, velocity
        Its state just before, in units of alpha and p.
    direction
        +1 or -1, the sign of the kick.
    table
        The motion from then on, without the still base after it; no row where it has ended.
    sides
        Of the block.
    """

    angle: float
    velocity: float
    direction: int
    table: Floats
    sides: Floats


def motion_after(table: Floats, time: float) -> Floats:
    """Return the segments of a motion from a pivot time on, without the still base after it.

    An impulse of the motion at that very time is left out: the state has it already.
    """
    starts = segment_starts(table)
    index = int(np.searchsorted(starts, time, side="right")) - 1
    rest = table[index:-1].copy()
    if not len(rest):
        return rest
    since = max(time - float(starts[index]), 0.0)
    first = rest[0]
    first[columns.DURATION] -= since
    first[columns.JUMP] = 0.0
    first[columns.CONSTANT] += first[columns.SLOPE] * since
    first[columns.PHASE] += first[columns.FREQUENCY] * since
    if rest.shape[1] > columns.LIFT:
        first[columns.LIFT] += first[columns.LIFT_SLOPE] * since
    rest[:, columns.CEILING] = ceilings(rest)
    rest[:, columns.ALIKE] = samples_alike(rest)
    return np.ascontiguousarray(rest)


def kicked_fates(size: Floats, *, kicked: Kicked, impacts: int = 0) -> Fates:
    """Return the fates of a block after kicks of some sizes, in units of alpha g/p.

    `impacts` are added to those after the kick.
    """
    each = [_fate(kicked, value) for value in size.tolist()]
    falls, decided, bounces, side, during, margin = zip(*each, strict=True)
    return Fates(
        np.array(falls, dtype=np.bool_),
        np.array(decided, dtype=np.bool_),
        np.array(bounces, dtype=np.int64) + impacts,
        np.array(side, dtype=np.int64),
        np.array(during, dtype=np.int64),
        np.minimum(np.array(margin), 1e200),
    )


def _fate(kicked: Kicked, size: float) -> tuple[bool, bool, int, int, int, float]:
    """Return the fields of `Fates` after one kick."""
    sides, table = kicked.sides, kicked.table
    jump = kicked.direction * size
    leaning = kicked.angle or kicked.velocity + jump
    row = 0 if leaning > 0.0 else 1
    lean, rate = float(sides[row, columns.LEAN]), float(sides[row, columns.RATE])
    turned = jump * rate * rate
    if columns.is_nonlinear(sides):
        turned *= jump_share(sides, 1 if row == 0 else -1, abs(kicked.angle) / lean)
    velocity = kicked.velocity + turned
    standing = kicked.angle == 0.0 and velocity == 0.0
    side = 0 if standing else 1 if (kicked.angle or velocity) > 0.0 else -1
    half, phase = (0, 0.0) if not len(table) else segment_start(table, 0)
    end = columns.March(side, kicked.angle, velocity, 0, half, phase, 0, 0)
    if len(table):
        code, end = march(
            table,
            sides,
            end,
            0,
            0.0,
            REST_VELOCITY,
            len(table) + FLIGHT_LIMIT,
            np.zeros((0, columns.ROW_COLUMNS)),
            np.zeros(0),
        )
        during = 3 * end.impacts + 1 + end.side
        if code == columns.OVERTURNED:
            return True, True, end.impacts, end.side, during, LOST
        if code not in (columns.AT_REST, columns.ROCKING):
            return False, False, end.impacts, 0, during, -1.0
    during = 3 * end.impacts + 1 + end.side
    if end.side == 0:
        return False, True, end.impacts, 0, during, -1.0
    row = 0 if end.side > 0 else 1
    lean, unit = (
        float(sides[row, columns.LEAN]),
        float(sides[row, columns.LEAN] * sides[row, columns.RATE]),
    )
    after = fate_on_still_base(
        sides, end.side, end.side * end.angle / lean, end.side * end.velocity / unit
    )
    falls = bool(after.margin > 0.0)
    margin = float(after.margin)
    if math.isnan(margin):
        return False, False, end.impacts, 0, during, -1.0
    return (
        falls,
        True,
        end.impacts + (after.impacts if falls else 0),
        after.side if falls else 0,
        during,
        margin,
    )
