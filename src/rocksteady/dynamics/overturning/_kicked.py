"""Fates of a block after kicks of many sizes, from a state, under what is left of a motion."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.history.lowering import only_side
from rocksteady.dynamics.history.simulate import ELASTIC_TIME, LONGEST_REST
from rocksteady.dynamics.overturning.scan import Fates
from rocksteady.dynamics.overturning.window_cells import FLIGHT_LIMIT, REST_VELOCITY
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.march.march import march
from rocksteady.kernels.nonlinear.drive import jump_share

Floats = NDArray[np.float64]


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
    still
        The still base after it.
    sides
        Sides of the block.
    """

    angle: float
    velocity: float
    direction: int
    table: Floats
    still: Floats
    sides: Floats


def kicked_fates(size: Floats, *, kicked: Kicked, impacts: int = 0) -> Fates:
    """Return the fates of a block after kicks of some sizes, in units of alpha g/p.

    Their margin is 1 or -1: borders are found by halving.

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
        np.array(margin),
    )


def _fate(kicked: Kicked, size: float) -> tuple[bool, bool, int, int, int, float]:
    """Return the fields of `Fates` after one kick."""
    sides = kicked.sides
    jump = kicked.direction * size
    walled = only_side(sides) > 0
    leaning = kicked.angle or kicked.velocity + jump
    row = 0 if leaning > 0.0 or walled else 1
    lean, rate = float(sides[row, columns.LEAN]), float(sides[row, columns.RATE])
    turned = jump * rate * rate
    if columns.is_nonlinear(sides):
        turned *= jump_share(sides, 1 if row == 0 else -1, abs(kicked.angle) / lean)
    velocity = kicked.velocity + turned
    if walled and kicked.angle == 0.0 and velocity < 0.0:
        # Into the wall: it holds a block at rest, and turns one back that leaves it.
        velocity *= float(sides[0, columns.RESTITUTION]) if kicked.velocity > 0.0 else 0.0
        velocity += 0.0  # no -0
    standing = kicked.angle == 0.0 and velocity == 0.0
    side = 0 if standing else 1 if (kicked.angle or velocity) > 0.0 else -1
    begin = columns.March(side, kicked.angle, velocity, 0, 0, 0.0, 0, 0)
    status, during = columns.ROCKING, 1 + side
    for table in (kicked.table, kicked.still):
        if not len(table):
            continue
        half, phase = segment_start(table, 0)
        begin = begin._replace(segment=0, half_cycles=half, phase=phase, flights=0)
        elastic = bool((np.abs(sides[:, columns.RESTITUTION]) == 1.0).all())
        afterwards = ELASTIC_TIME if elastic else LONGEST_REST
        status, begin = march(
            table,
            sides,
            begin,
            0,
            afterwards,
            REST_VELOCITY,
            len(table) + FLIGHT_LIMIT,
            np.zeros((0, columns.ROW_COLUMNS)),
            np.zeros(0),
        )
        if table is kicked.table:
            during = 3 * begin.impacts + 1 + begin.side
        if status == columns.OVERTURNED:
            return True, True, begin.impacts, begin.side, during, 1.0
        if status not in (columns.AT_REST, columns.ROCKING):
            return False, False, begin.impacts, 0, during, -1.0
    return False, True, begin.impacts, 0, during, -1.0
