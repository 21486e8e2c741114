"""Proofs that a nonlinear motion will overturn or come to rest.

**Overturning.**  A block that has turned by pi/2 lies on its side.  Before that it is lost where
nothing to come can bring it back.  With |h| <= H and |l| <= L < 1 for ever, and ``w = alpha (y -
1)`` in (0, pi/2)::

    alpha y'' = (1 + l) sin w + alpha h cos w >= (1 - L) sin w - alpha H cos w,

which is positive for ``tan w > alpha H/(1 - L)``: from there on a block that does not come back
never does.  On a base that stands still for ever the energy decides: from ``|y'| = 2 sin(alpha |1 -
y|/2)/alpha``, on which it would reach the upright position and stay there, a block that is faster
towards that position passes it, and one beyond that is slower does not come back.

**Rest.**  The argument is that of `kernels.march.rest`.  With c > 0 the least of -r and K the
largest of ``max(1, k + c alpha^2/2)`` over the window, ``y'' <= -c + K y`` while 0 <= y <= 1, since
``cos x >= 1 - x^2/2`` and ``sin x <= x``.  So a bounce with velocity v rises to ``Y = v^2/(c +
sqrt(c^2 - K v^2))`` at most, for which v^2/c has to be below 1, and lasts no longer than ``2
v/sqrt(c^2 - K v^2)``; the square of its landing velocity exceeds v^2 by twice the integral of ``r'
sin(alpha y)/alpha + k' (1 - cos(alpha y))/alpha^2``, which is at most ``2 (max |r'| + max |k'|) Y``
times the duration.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.forcing import Forcing, largest_forcing
from rocksteady.kernels.core.harmonics import largest_ahead
from rocksteady.kernels.core.tables import Floats, slenderness
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.elementary.circular import sin, sincos_near
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear.drive import (
    Drive,
    acceleration,
    foot_forcing,
    side_drive,
    swing_at,
)

HALF_PI = 0.5 * math.pi


@compiled
def point_of_no_return(segments: Floats, index: int, sides: Floats, side: int) -> float:
    """Return the y beyond which a block that moves on never comes back, from a segment's start on.

    Infinite where the base may yet fall away under the block, or a jump is to come.
    """
    row = 0 if side > 0 else 1
    alpha = slenderness(sides, row)
    ceiling: float = segments[index, columns.CEILING] / sides[row, columns.LEAN]
    weight = 1.0 - segments[index, columns.LIFT_CEILING]
    if weight <= 0.0 or ceiling == math.inf:
        return math.inf
    if alpha == 0.0:
        return 1.0 + ceiling
    return 1.0 + atan2(alpha * ceiling, weight) / alpha


@compiled
def falls_on_still_base(alpha: float, angle: float, velocity: float) -> bool:
    """Return whether energy proves that a block overturns on a base that stands still for ever."""
    barrier = 2.0 * sin(0.5 * alpha * abs(1.0 - angle)) / alpha
    if angle <= 1.0:
        return velocity > barrier
    return velocity > -barrier


class SteppedBounce(NamedTuple):
    """How a bounce that is flown in steps begins on a side, in the units of the side."""

    drive: Drive
    phase: float  # of the shaking: of a sinusoid as seen from the side, of a series as it is
    speed: float
    rate: float  # of the side's clock, over that of reference time


@inlined
def stepped_bounce(
    tables: Tables, index: int, side: int, elapsed: float, speed: float, phase: float
) -> SteppedBounce:
    """Return a bounce on a segment, so long after its start, with a speed in reference units."""
    segments, sides = tables
    row = 0 if side > 0 else 1
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    drive = side_drive(segments, index, sides, side, elapsed)
    return SteppedBounce(drive, phase, speed / (lean * rate), rate)


@compiled
def bounces_settle(
    restitution: float,
    span: float,
    here: SteppedBounce,
    there: SteppedBounce,
    highest: float,
    shares: Floats | None = None,
) -> bool:
    """Return whether the coming bounces are proved to end before an uplift and within `span`.

    The parameters are those of `rocksteady.kernels.march.rest.settles`, with drives for forcings.
    """
    if restitution >= 1.0:
        return False
    # Most impacts are decided here.
    pull_here: float = -acceleration(here.drive, 0.0, 0.0, swing_at(here.drive, shares, here.phase))
    if pull_here <= here.speed:
        return False
    pull_there = -acceleration(there.drive, 0.0, 0.0, swing_at(there.drive, shares, there.phase))
    if pull_there <= there.speed:
        return False
    longer = max(here.speed / (pull_here * here.rate), there.speed / (pull_there * there.rate))
    window = 4.0 * longer / (1.0 - restitution)
    if window > span:
        return False
    growth_here, lasts_here, top_here = bounce_bounds(here, window * here.rate, shares)
    growth_there, lasts_there, top_there = bounce_bounds(there, window * there.rate, shares)
    kappa: float = restitution * math.sqrt(max(growth_here, growth_there))
    return (
        kappa < 1.0
        and max(lasts_here, lasts_there) <= (1.0 - kappa) * window
        and max(top_here, top_there) <= highest
    )


@compiled
def bounce_bounds(
    bounce: SteppedBounce, window: float, shares: Floats | None = None
) -> tuple[float, float, float]:
    """Return upper bounds of a bounce's growth of velocity squared, its duration and its top."""
    drive, phase, velocity, rate = bounce
    forcing = foot_forcing(drive)
    pull, steepest = shaking_bounds(drive, forcing, phase, window, shares)
    alpha = drive.alpha
    if alpha == 0.0:
        return linear_bounds(pull, forcing.amplitude * steepest, velocity, rate)
    sine, cosine = sincos_near(alpha)
    shaking = abs(drive.constant) + abs(drive.slope) * window + drive.amplitude
    weight = 1.0 + abs(drive.lift) + abs(drive.lift_slope) * window
    stiffness = max(1.0, weight * cosine + alpha * sine * shaking + 0.5 * pull * alpha * alpha)
    faster = math.sqrt(stiffness) * velocity
    if pull <= faster or velocity * velocity >= pull:
        return math.inf, math.inf, math.inf
    root = math.sqrt((pull - faster) * (pull + faster))
    drift = (
        abs(forcing.slope)
        + forcing.amplitude * steepest
        + abs(drive.lift_slope) * (cosine + sine / alpha)
        + alpha * sine * (abs(drive.slope) + drive.amplitude * steepest)
    )
    growth = 1.0 + 4.0 * drift * velocity / (pull * root)
    return growth, 2.0 * velocity / (root * rate), velocity * velocity / (pull + root)


@compiled
def shaking_bounds(
    drive: Drive, forcing: Forcing, phase: float, window: float, shares: Floats | None
) -> tuple[float, float]:
    """Return a lower bound of -r over a window, and an upper one of the shaking's rate over A."""
    if shares is None:
        return -largest_forcing(forcing, phase, window), drive.frequency
    if drive.series == 0.0:
        return -largest_forcing(forcing, phase, window), drive.frequency
    turn = drive.frequency * window
    swing, steepest = largest_ahead(shares, drive.series, phase, turn)
    return -(forcing.constant + forcing.amplitude * swing), drive.frequency * steepest


@compiled
def linear_bounds(
    pull: float, steepest: float, velocity: float, rate: float
) -> tuple[float, float, float]:
    """Return what `bounce_bounds` does in the linear model: c is `pull`, L `steepest`."""
    if pull <= velocity:
        return math.inf, math.inf, math.inf
    root = math.sqrt((pull - velocity) * (pull + velocity))
    growth = 1.0 + 4.0 * steepest * velocity / (pull * root)
    return growth, 2.0 * velocity / (root * rate), velocity * velocity / (pull + root)
