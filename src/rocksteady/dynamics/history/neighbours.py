"""Neighbours of a verdict: the same case with a slightly different motion and block.

They are a full factorial of three steps in scale, restitution and slenderness: 26 runs besides the
case, some 60 ms.  Both signs would repeat each run of a symmetric block from rest.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.history.start import Rest, Start, State
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.elementary.arrays import cos
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.sides import Side, body_p
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import (
    Motion,
    Piecewise,
    Segment,
    Still,
    segments_of,
)
from rocksteady.outcomes import Status
from rocksteady.results.result import Result

SCALES = (0.95, 1.0, 1.05)
"""Of the horizontal motion."""

RESTITUTION = 0.03
"""Change of the restitution."""

SLENDERNESS = 0.02
"""Relative change of alpha."""

STEP = 0.02
"""Step of the factors of the motion at which block and neighbours are followed."""


@checked_result
@dataclass(frozen=True, kw_only=True)
class Neighbour:
    """One neighbour of a case, and how it ended.

    Attributes
    ----------
    scale
        Factor of the horizontal motion.
    restitution, alpha
        Restitution and alpha [rad] of the positive side, or restitution of the wall.
    sign
        +1, or -1 where the horizontal motion is reversed.
    status
        How it ended.
    peak
        Largest |theta|/alpha, in its own alpha.
    """

    scale: float
    restitution: float
    alpha: float
    sign: int
    status: Status
    peak: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Neighbours(Result):
    """Neighbours of a case, and which of them fall.

    Attributes
    ----------
    case
        The given case.
    cases
        The neighbours: 26, or 27 where the sign of the motion matters.
    """

    case: Trajectory
    cases: tuple[Neighbour, ...]

    @property
    def model(self) -> Model:
        """The equations of motion of all of them."""
        return self.case.model

    @property
    def runs(self) -> int:
        """Number of neighbours."""
        return len(self.cases)

    @property
    def fall(self) -> int:
        """Number of neighbours that overturn."""
        return sum(neighbour.status is Status.OVERTURNED for neighbour in self.cases)

    @property
    def agree(self) -> bool:
        """Whether all of them end as the case does: all overturn, or none."""
        falls = self.case.status is Status.OVERTURNED
        return self.fall == (self.runs if falls else 0)

    @cached_property
    def stands_at(self) -> float | None:
        """Largest factor of the motion at which it stands and no neighbour falls, by steps of 2 %.

        None if there is none down to 2 %, or no neighbour falls at 1.
        """
        if not self.fall and self.agree:
            return None
        steps = round(1.0 / STEP)
        for step in range(steps - 1, 0, -1):
            scale = step / steps
            case = _scaled(self.case, scale)
            if case.status is not Status.OVERTURNED and not any(
                each.status is Status.OVERTURNED for each in _neighbours(case, _sized(case))
            ):
                return scale
        return None


@checked
def check_neighbours(trajectory: Trajectory) -> Neighbours:
    """Run a case again with slightly different motions and blocks.

    The horizontal motion times .95, 1 and 1.05; restitution -.03, as it is and +.03, but at least
    half of it and at most half-way to 1; alpha x .98, as it is and x 1.02, at the same height of
    the mass centre and radius of gyration: all 26 combinations but the case itself.  Where the sign
    of the motion matters, for an asymmetric block, one against a wall or one that does not start at
    rest, the reversed case is the 27th.  Model, vertical motion and the angle and velocity of the
    start, in radians and seconds, are those of the case.

    Parameters
    ----------
    trajectory
        The case: a `Block` on a record, a pulse or another motion that ends.

    Returns
    -------
    Neighbours
        How many fall, and each with its changes.

    Raises
    ------
    ModelError
        If the block has no size, or the base stands still or never stops.

    Examples
    --------
    >>> from rocksteady import Block, Pulse, check_neighbours, simulate
    >>> block = Block.rectangle(width=0.6, height=1.8)
    >>> pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=12.0, frequency_hz=1.0)
    >>> neighbours = check_neighbours(simulate(block, pulse))
    >>> print(neighbours.fall, "of", neighbours.runs)
    26 of 26
    """
    motion = trajectory.motion
    if not isinstance(trajectory.block, Block) or isinstance(motion, PeriodicMotion | Still):
        block = trajectory.block
        raise ModelError(
            "trajectory",
            Words(f"has {block.describe().headline} on a {type(motion).__name__} motion"),
            "neighbours are those of a Block on a motion that ends",
            "simulate a Block on a Record or a Pulse",
        )
    return Neighbours(case=trajectory, cases=tuple(_neighbours(trajectory, _sized(trajectory))))


def _sized(case: Trajectory) -> Block:
    """Return the block of a case that has neighbours."""
    assert isinstance(case.block, Block)
    return case.block


def _scaled(case: Trajectory, factor: float) -> Trajectory:
    """Return the case on a part of its horizontal motion."""
    block = _sized(case)
    across = _in_units_of(block, block, case.motion, factor)
    base = BaseMotion(across, case.vertical)
    return simulate(block, base, start=case.start, model=case.model)


def _neighbours(case: Trajectory, block: Block) -> Iterator[Neighbour]:
    """Yield the neighbours of a case."""
    shapes = [_with_slenderness(block, 1.0 + d) for d in (-SLENDERNESS, SLENDERNESS)]
    bodies = [
        block if change == 0.0 and shape is block else _with_restitutions(shape, change)
        for shape in (block, *shapes)
        for change in (0.0, -RESTITUTION, RESTITUTION)
    ]
    changes = [(1, scale, body) for body in bodies for scale in SCALES]
    changes.remove((1, 1.0, block))
    if not (block.symmetric and isinstance(case.start, Rest)):  # else its mirror image
        changes.append((-1, 1.0, block))
    for sign, scale, body in changes:
        across = _in_units_of(body, block, case.motion, sign * scale)
        up = None if case.vertical is None else _in_units_of(body, block, case.vertical, 1.0)
        run = simulate(
            body,
            BaseMotion(across, up),
            start=_start_of(body, block, case.start),
            model=case.model,
        )
        yield Neighbour(
            scale=scale,
            restitution=body.restitution,
            alpha=body.alpha,
            sign=sign,
            status=run.status,
            peak=run.peak,
        )


def _with_restitutions(block: Block, change: float) -> Block:
    """Return the block with both restitutions changed, half-way to 0 or 1 at most."""
    sides = (block,) if block.one_sided else (block.positive, block.negative)
    ratios = [
        min(max(side.restitution + change, 0.5 * side.restitution), 0.5 * (1.0 + side.restitution))
        for side in sides
    ]
    return block.with_restitution((ratios[0], ratios[-1]) if len(ratios) > 1 else ratios[0])


def _with_slenderness(block: Block, factor: float) -> Block:
    """Return the block with other alphas, the height of its mass centre and its gyration kept."""
    positive, negative = (
        _tilted(side, factor, block.gravity) for side in (block.positive, block.negative)
    )
    return replace(block, positive=positive, negative=negative)


def _tilted(side: Side, factor: float, gravity: float) -> Side:
    """Return a side with another alpha, at most half-way to a right angle."""
    alpha = min(factor * side.alpha, 0.5 * (side.alpha + 0.5 * math.pi))
    gyration = max(gravity * side.radius / (side.p * side.p) - side.radius * side.radius, 0.0)
    radius = side.centre_height / float(cos(alpha))
    p = body_p(gravity, radius, gyration + radius * radius)
    return replace(side, alpha=alpha, radius=radius, p=p)


def _in_units_of(
    body: Block, block: Block, motion: Motion | Record, factor: float
) -> Motion | Record:
    """Return a motion times a factor, in the units of another block."""
    if isinstance(motion, Record):
        return motion.scaled(factor)
    size = factor * block.alpha / body.alpha
    rate = block.p / body.p  # pivot time passes this much slower
    pieces = tuple(
        Segment(
            duration=piece.duration / rate,
            constant=size * piece.constant,
            slope=size * rate * piece.slope,
            jump=size / rate * piece.jump,
            amplitude=size * piece.amplitude,
            frequency=rate * piece.frequency,
            phase=piece.phase,
            harmonics=piece.harmonics,
        )
        for piece in segments_of(motion)
    )
    return Piecewise(pieces=pieces)


def _start_of(body: Block, block: Block, start: Start) -> Start:
    """Return a start of the same angle and velocity in the units of another block."""
    if not isinstance(start, State):
        return start
    size = block.alpha / body.alpha
    return State(angle=size * start.angle, velocity=size * (block.p / body.p) * start.velocity)
