"""Fate of a block on a base that stays still after a pulse, in closed form.

The energy of a flight is kept there: the linear block's is ``(v^2 - (1 - y)^2)/2``, the nonlinear
one's ``v^2/2 + (cos(alpha (1 - y)) - 1)/alpha^2``, both 0 for a block that reaches the upright
position, y = 1, and stays there.  With the signed ``b = 2 sin(alpha (y - 1)/2)/alpha``, which is
``y - 1`` in the linear model, it is ``(v - b)(v + b)/2``, so that a block with ``v + b > 0`` never
comes back.  One with ``v + b < 0`` lands with::

    v^2 + 4 sin(alpha y/2) sin(alpha (1 - y/2))/alpha^2,    linear: v^2 + y (2 - y),

for the square of its speed, and leaves that impact with a part of it, from y = 0: it overturns on
the other side where that is above the barrier there, ``2 sin(alpha/2)/alpha``, linear: 1.  Where it
is not, the next landing is at the speed of that launch and its own launch slower by the
restitution, in the units of the first side.  Of a symmetric block that is below the barrier; of one
whose sides differ it may be above.  After these two no later one is faster than the one before it
on the same side.  Against a wall all launches are to one side, and none is faster than the first.

**The margin** is the largest of v + b and of the two launches less their barriers, each over the
barrier: the block overturns where it is above 0, and -1 is that of a block at rest.  It does not
depend on when the pulse is said to end, nor jumps where an impact moves past that end or where a
flight grazes the floor: over the amplitude it is continuous, and fates change where it is zero.

**Lying.**  A nonlinear block that has turned by pi/2 while the pulse lasts lies on its side, and no
pulse raises it.  A flight that comes to that from one that just does not, a graze of that angle,
is no zero of the margin above.  So the margin of a block that lies is the speed at which it came to
lie, that of one that will lie on the still base at most the speed at which it will, and that of one
that stands at least as close to 0 as `NEAR` times the largest angle was to pi/2.  With these the
nonlinear margin too goes through zero where the fate changes, and jumps, if at all, from one number
above it to another.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import (
    ALPHA,
    LEAN,
    RATE,
    RESTITUTION,
    Floats,
    free_side,
    is_nonlinear,
)
from rocksteady.kernels.elementary.circular import sin
from rocksteady.kernels.machine_code.compilation import compiled

HALF_PI = 0.5 * math.pi
NEAR = 4.0
"""A block that has come to 1 - 1/NEAR of pi/2 is told from those that have not."""


class Afterwards(NamedTuple):
    """The fate of a block on a still base."""

    margin: float
    """Above 0 where it overturns."""
    impacts: int
    """Before that."""
    side: int
    """On which it overturns; that on which it is now where it does not."""


@compiled
def over_the_top(sides: Floats, row: int, angle: float) -> float:
    """Return b of the module's description, in units of a side; above 0 beyond the top."""
    if not is_nonlinear(sides):
        return angle - 1.0
    alpha: float = sides[row, ALPHA]
    return 2.0 * sin(0.5 * alpha * (angle - 1.0)) / alpha


@compiled
def gained_by_landing(sides: Floats, row: int, angle: float) -> float:
    """Return the square of the speed of landing less that of the speed at an angle."""
    if not is_nonlinear(sides):
        return angle * (2.0 - angle)
    alpha: float = sides[row, ALPHA]
    share = sin(0.5 * alpha * angle) * sin(alpha * (1.0 - 0.5 * angle))
    return 4.0 * share / (alpha * alpha)


@compiled
def speed_of_lying(sides: Floats, row: int, angle: float, velocity: float) -> float:
    """Return the speed at which a falling block comes to lie on its side; infinite if linear."""
    if not is_nonlinear(sides):
        return math.inf
    alpha: float = sides[row, ALPHA]
    # cos(alpha (1 - y)) is cos(alpha - pi/2) there; both sines are above 0 before that.
    up_to = 0.5 * (alpha * angle - alpha) + 0.5 * (HALF_PI - alpha)
    left = 0.5 * (HALF_PI - alpha) - 0.5 * (alpha * angle - alpha)
    gained = 4.0 * sin(up_to) * sin(left) / (alpha * alpha)
    return math.sqrt(max(velocity * velocity + gained, 0.0))


@compiled
def fate_on_still_base(sides: Floats, side: int, angle: float, velocity: float) -> Afterwards:
    """Return the fate of a block on a base that stands still from now on.

    Parameters
    ----------
    sides
        Of the block, shape (2, 3), or (2, 5) for the nonlinear model.
    side
        On which it is, +1 or -1.
    angle, velocity
        y >= 0 and y' on that side, in its own units.
    """
    here = 0 if side > 0 else 1
    one_sided = free_side(sides) != 0
    there = here if one_sided else 1 - here
    barrier_here = -over_the_top(sides, here, 0.0)
    barrier_there = -over_the_top(sides, there, 0.0)
    rising = velocity + over_the_top(sides, here, angle)
    if rising > 0.0:
        lying = speed_of_lying(sides, here, angle, velocity)
        return Afterwards(min(rising, lying) / barrier_here, 0, side)
    landing = math.sqrt(max(velocity * velocity + gained_by_landing(sides, here, angle), 0.0))
    scale = sides[here, LEAN] * sides[here, RATE] / (sides[there, LEAN] * sides[there, RATE])
    launch = abs(sides[here, RESTITUTION]) * landing
    first = launch * scale / barrier_there - 1.0
    second = abs(sides[there, RESTITUTION]) * launch / barrier_here - 1.0
    margin = max(rising / barrier_here, first, second)
    if first > 0.0:
        lying = speed_of_lying(sides, there, 0.0, launch * scale) / barrier_there
        return Afterwards(min(margin, lying), 1, side if one_sided else -side)
    if second > 0.0:
        lying = speed_of_lying(sides, here, 0.0, sides[there, RESTITUTION] * launch) / barrier_here
        return Afterwards(min(margin, lying), 2, side)
    return Afterwards(margin, 0, side)
