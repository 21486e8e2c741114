"""The exact flow between two phases of harmonic shaking, forward and backward in time.

Both equations of motion are those of a force that depends on the angle and the time alone, so that
a flight run backward is a flight: with the velocity turned round, and under shaking of phase
``pi - phi``, since ``sin(pi - (phi - Omega s)) = sin(phi - Omega s)``.  An impact run backward
divides by the restitution.  So the flow backward is the march of a block whose restitutions are
the inverse ones, each at the impact from the other side; it needs no equation of its own, and
a restitution above 0.  What has come to rest has no past: a rest forgets it.
"""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.batch.harmonic import harmonic_segment
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import fill_states, last_crossing
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.motions.segments import Harmonic

MOST_FLIGHTS = 100_000
"""Of one motion: without an end chatter backward would take for ever."""
FAR = 1e6
"""|u| beyond which a falling block is nowhere: the linear model means nothing there."""
NO_ROWS = np.zeros((0, columns.ROW_COLUMNS))
NO_PEAKS = np.zeros(0)


class Reached(NamedTuple):
    """State that a motion has come to.

    Attributes
    ----------
    angle, velocity
        u and du/d(pt); nan where the block has fallen to the ground.
    phase
        Phase of the shaking, as unbounded as that of the start.
    side
        +1, -1, or 0 at rest.
    impacts
        On the way, as `rocksteady.histories.Impacts` counts them.
    fallen
        Whether it is proved that no impact follows.
    rested
        Whether it is at rest.
    """

    angle: float
    velocity: float
    phase: float
    side: int
    impacts: int
    fallen: bool
    rested: bool


class Flow:
    """The exact motion of a block under harmonic shaking, forward or backward in time.

    Parameters
    ----------
    block, motion, model
        Block and base motion; the phase of `motion` does not count.
    backward
        Whether time runs backward; default False.

    Raises
    ------
    ModelError
        If time runs backward and an impact leaves nothing of the velocity.
    """

    def __init__(
        self,
        block: Block | DimensionlessBlock,
        motion: Harmonic,
        model: Model,
        *,
        backward: bool = False,
    ) -> None:
        self.block, self.motion, self.model = block, motion, model
        self.backward = backward
        self.sides = model.sides(block)
        if backward:
            self.sides = inverse_sides(self.sides)
        self.segments = np.zeros((1, columns.NONLINEAR_SEGMENT_COLUMNS))
        harmonic_segment(self.segments, motion.amplitude, motion.frequency_ratio, 0.0)

    def carried(
        self, angle: float, velocity: float, phase: float, end: float, *, side: int = 0
    ) -> Reached:
        """Return the state at another phase of the shaking.

        Parameters
        ----------
        angle, velocity
            u and du/d(pt) at the start; at angle 0 just after an impact in the flow's direction.
        phase, end
            Phases of the shaking at the start and at the end [rad], unbounded; the end is later, of
            a flow backward earlier.
        side
            Side to which a block with angle and velocity 0 lifts off; default at rest.
        """
        begin = self._begin(angle, velocity, phase, side)
        stop_half, stop_phase = clock(math.pi - end if self.backward else end)
        status, last = self._march(begin, stop_half, stop_phase, MOST_FLIGHTS, NO_ROWS)
        fallen = status == columns.OVERTURNED
        if fallen:
            u, v = self._falling(begin, stop_half, stop_phase, last.flights)
        elif status in (columns.ROCKING, columns.AT_REST):
            u, v = last.angle, last.velocity
        else:
            u = v = math.nan
        return Reached(
            u,
            -v if self.backward else v,
            end,
            last.side,
            last.impacts,
            fallen,
            status == columns.AT_REST,
        )

    def after(
        self, angle: float, velocity: float, phase: float, impacts: int, *, longest: float
    ) -> Reached:
        """Return the state just after a number of impacts that count, nan where there are fewer.

        Parameters
        ----------
        angle, velocity, phase
            As for `carried`.
        impacts
            Number of impacts, 1 or more.
        longest
            Phase of the shaking within which they must come [rad].
        """
        begin = self._begin(angle, velocity, phase, 0)
        stop_half, stop_phase = clock(begin.half_cycles * math.pi + begin.phase + longest)
        status, last = self._march(begin, stop_half, stop_phase, impacts, NO_ROWS)
        if status != columns.UNDECIDED or last.impacts != impacts:
            return Reached(
                math.nan, math.nan, math.nan, 0, last.impacts, status == columns.OVERTURNED, False
            )
        end = last.half_cycles * math.pi + last.phase
        velocity = -last.velocity if self.backward else last.velocity
        if self.backward:
            end = math.pi - end
        return Reached(0.0, velocity, end, last.side, impacts, False, False)

    def _begin(self, angle: float, velocity: float, phase: float, side: int) -> columns.March:
        if self.backward:
            velocity, phase = -velocity, math.pi - phase
        half, rest = clock(phase)
        leaning = angle or velocity or float(side)
        here = 0 if leaning == 0.0 else 1 if leaning > 0.0 else -1
        if angle == 0.0 and self.sides[0, columns.RESTITUTION] <= 0.0:
            here = 1 if velocity != 0.0 else here  # off a wall
            velocity = abs(velocity)
        return columns.March(here, angle, velocity, 0, half, rest, 0, 0)

    def _march(
        self,
        begin: columns.March,
        stop_half: int,
        stop_phase: float,
        limit: int,
        rows: Floats,
    ) -> tuple[int, columns.March]:
        tables = Tables(self.segments, self.sides)
        until = Until(stop_half, stop_phase, columns.COUNTED, limit)
        result: tuple[int, columns.March] = march(tables, begin, until, Kept(rows, NO_PEAKS))
        return result

    def _falling(
        self, begin: columns.March, stop_half: int, stop_phase: float, flights: int
    ) -> tuple[float, float]:
        """Return angle and velocity on an endless flight; nan once the block is on the ground."""
        rows = np.zeros((flights, columns.ROW_COLUMNS))
        self._march(begin, stop_half, stop_phase, flights + 1, rows)
        row = rows[-1:]
        halves = stop_half - row[0, columns.ROW_HALF_CYCLES]
        since = halves * math.pi + (stop_phase - row[0, columns.ROW_PHASE])
        since /= self.motion.frequency_ratio
        if columns.is_nonlinear(self.sides):
            alpha = self.sides[0 if row[0, columns.ROW_SIDE] > 0.0 else 1, columns.ALPHA]
            _, landed = last_crossing(self.segments, self.sides, row, 0.5 * math.pi / float(alpha))
            if since >= landed > 0.0:
                return math.nan, math.nan
        states = np.empty((3, 1))
        fill_states(
            self.segments, self.sides, row, np.zeros(1, dtype=np.int64), np.array([since]), states
        )
        u, v = float(states[0, 0]), float(states[1, 0])
        return (u, v) if abs(u) < FAR else (math.nan, math.nan)


def inverse_sides(sides: Floats) -> Floats:
    """Return the side table of the motion backward in time.

    Raises
    ------
    ModelError
        If an impact leaves nothing of the velocity.
    """
    inverse = sides.copy()
    ratios = sides[:, columns.RESTITUTION]
    if ratios[0] <= 0.0:  # a wall's
        ratios = ratios[:1]
    if (ratios == 0.0).any():
        raise ModelError(
            "block",
            Words("has restitution 0"),
            "a motion that an impact stops cannot be followed backward",
            "give a restitution above 0, or ask for the unstable manifold",
        )
    if len(ratios) == 1:
        inverse[0, columns.RESTITUTION] = 1.0 / ratios[0]
    else:
        inverse[:, columns.RESTITUTION] = 1.0 / ratios[::-1]
    return inverse
