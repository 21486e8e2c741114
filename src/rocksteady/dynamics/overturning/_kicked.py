"""Fates of a block after kicks of many sizes, from a state, under what is left of a motion."""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.start import set_going
from rocksteady.dynamics.overturning.scan import Fates
from rocksteady.dynamics.overturning.window_cells import FLIGHT_LIMIT
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.facts import ELASTIC_TIME, LONGEST_REST
from rocksteady.kernels.march.march import march


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
        The motion from then on, with the still base after it; an impulse at its start comes with
        the kick.
    sides
        Sides of the block.
    """

    angle: float
    velocity: float
    direction: int
    table: Floats
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
    elastic = bool((np.abs(sides[:, columns.RESTITUTION]) == 1.0).all())
    afterwards = ELASTIC_TIME if elastic else LONGEST_REST
    motion, still = kicked.table[:-1], kicked.table[-1:]
    begin = columns.March(0, kicked.angle, kicked.velocity, 0, 0, 0.0, 0, 0)
    impulse, during = kicked.direction * size, 0
    nothing = Kept(np.zeros((0, columns.ROW_COLUMNS)), np.zeros(0))
    for table in (motion, still) if len(motion) else (still,):
        # A march leaves the impulse at its start to what begins it.
        side, velocity = set_going(
            begin.angle, begin.velocity, impulse + float(table[0, columns.JUMP]), sides
        )
        half, phase = segment_start(table, 0)
        begin = columns.March(side, begin.angle, velocity, 0, half, phase, begin.impacts, 0)
        impulse, during = 0.0, 3 * begin.impacts + 1 + side
        until = Until(0, afterwards, columns.COUNTED, len(table) + FLIGHT_LIMIT)
        status, begin = march(Tables(table, sides), begin, until, nothing)
        if status == columns.OVERTURNED:
            return True, True, begin.impacts, begin.side, during, 1.0
        if status not in (columns.AT_REST, columns.ROCKING):
            return False, False, begin.impacts, 0, during, -1.0
    return False, True, begin.impacts, 0, during, -1.0
