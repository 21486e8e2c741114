"""Rest: when uplift ends it, and when chatter is proved to have died out.

A block at rest stays at rest while the base acceleration is below the uplift value of either side
(|a| < 1 for a symmetric block); it lifts at the next node at which one side's forcing turns
positive.

**Chatter** is an infinite number of ever smaller bounces in finite time.  With velocity v after an
impact, let c > 0 be the least of -r over both sides and a window of length T, and L the largest
|dr/dt|.  While ``y'' <= y - c`` a bounce rises to ``Y = c - sqrt(c^2 - v^2)`` at most and lasts no
longer than ``2 v / sqrt(c^2 - v^2)``.  The square of its landing velocity exceeds v^2 by twice the
integral of ``r y'``, that is of ``-r' y``, so by no more than 2 L Y times that duration: it is at
most ``1 + 4 L v / (c sqrt(c^2 - v^2))`` times v^2, since ``Y <= v^2/c``.  With
``kappa^2 = restitution^2 (1 + ...) < 1`` the bounces shrink at least geometrically and all are over
within ``2 v / (sqrt(c^2 - v^2) (1 - kappa))``.  If that is less than T, no uplift can come first (c
is positive throughout T), and the block is at rest at the end of it.  This is a bound, not an
estimate: where it does not fit, the march goes on bouncing.  restitution = 1 gives kappa >= 1.

A bounce that is left out has a top and a landing.  The landings are slower than the one before the
first bounce, since kappa < 1, and the tops lie below Y of the first bounce to either side.  So
chatter ends only where Y is no higher than the highest angle so far, if the peaks of a march count.

**Impacts** count that leave with `kernels.core.tables.COUNTED` or more; a march whose chatter ends
above that has others to come.  On a base that stands still a block lands as fast as it left, so
that their number is known: velocities are those of a geometric series (`impacts_on_still_base`).
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.forcing import (
    HALF_PI,
    LINE,
    MIXED,
    SINE,
    TWO_PI,
    Forcing,
    largest_forcing,
    mixed_node,
    starts_positive,
    steepest_forcing,
)
from rocksteady.kernels.core.harmonics import level_of, lifts_at, next_lift
from rocksteady.kernels.core.scatter import is_scattered, restitution_of
from rocksteady.kernels.core.tables import COUNTED, LEAN, RATE, RESTITUTION, Floats, free_side
from rocksteady.kernels.core.typed import FALSE, MINUS_ONE, ONE
from rocksteady.kernels.elementary.logarithm import log
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.nonlinear.proofs import linear_bounds

# A bounce this slow lasts less than any clock resolves, and its square underflows.
STILL = 1e-100


@compiled
def uplift_time(forcing: Forcing, phase: float, span: float) -> float:
    """Return the first time in [0, span) at which the forcing is or turns positive, or infinity."""
    if starts_positive(forcing, phase):
        return 0.0
    time = math.inf
    if forcing.kind == SINE:
        ahead = forcing.rising - phase
        if ahead < 0.0:
            ahead += TWO_PI
        time = ahead / forcing.frequency
    elif forcing.kind == LINE:
        if forcing.slope > 0.0:
            time = -forcing.constant / forcing.slope
    elif forcing.kind == MIXED:
        time = mixed_node(forcing, phase, 0.0, FALSE, span)
    return time if time < span else math.inf


@compiled
def next_uplift(
    positive: Forcing,
    negative: Forcing,
    sides: Floats,
    half: int,
    phase: float,
    frequency: float,
    span: float,
) -> tuple[int, float]:
    """Return the side that lifts first and when; side 0 and `span` where none lifts before that.

    A block against a wall lifts to its free side alone.
    """
    if span <= 0.0:
        return 0, 0.0
    plus_phase, _ = side_phase(half, phase, ONE, frequency)
    minus_phase, _ = side_phase(half, phase, MINUS_ONE, frequency)
    plus = uplift_time(positive, plus_phase, span * sides[0, RATE]) / sides[0, RATE]
    minus = uplift_time(negative, minus_phase, span * sides[1, RATE]) / sides[1, RATE]
    free = free_side(sides)
    if free > 0:
        minus = math.inf
    elif free < 0:
        plus = math.inf
    if min(plus, minus) >= span:
        return 0, span
    return (1, plus) if plus <= minus else (-1, minus)


@compiled
def series_uplift(
    positive: Forcing,
    negative: Forcing,
    free: int,
    shares: Floats,
    lifts: Floats2,
    half: int,
    phase: float,
) -> tuple[int, float, int, float]:
    """Return the side that a Fourier series lifts first, by which turn of its phase, and the clock.

    Side 0 and an infinite turn where it lifts none.  The clock is set to the phase of `lifts`, so
    that nothing is left of what was before the rest.
    """
    seen, _ = side_phase(half, phase, ONE, 1.0)
    odd = half % 2
    here = odd * math.pi + phase
    if free >= 0 and lifts_at(shares, 1.0, level_of(positive), lifts[0], seen):
        return 1, 0.0, half, phase
    if free <= 0 and lifts_at(shares, -1.0, level_of(negative), lifts[1], seen):
        return -1, 0.0, half, phase
    side, least, until, periods = 0, math.inf, 0.0, 0
    if free >= 0:
        until, periods = next_lift(lifts[0], here)
        least = until - here + TWO_PI * periods
        side = 1 if least < math.inf else 0
    if free <= 0:
        other, later = next_lift(lifts[1], here)
        turn = other - here + TWO_PI * later
        if turn < least:
            side, least, until, periods = -1, turn, other, later
    if side == 0:
        return 0, math.inf, half, phase
    turned, rest = clock(until)
    return side, least, half - odd + turned + 2 * periods, rest


class Bounce(NamedTuple):
    """How a bounce begins on a side, in the units of the side."""

    forcing: Forcing
    phase: float  # of the forcing, as seen from the side
    speed: float
    rate: float  # of the side's clock, over that of reference time


@inlined
def chatter_ends(
    restitution: float,
    span: float,
    here: Bounce,
    there: Bounce,
    sine: float,
    crosses: bool,
    highest: float,
) -> bool:
    """Return whether the bounces that start now are proved to die out within `span`.

    `here` is the first bounce, `sine` that of its phase, and `there` the one after it, with the
    phase of `here`.  Where an impact does not change the side, `crosses` is false and `there` is
    `here`.  No bounce may rise above `highest`.
    """
    if here.speed < STILL:
        return True
    # Most impacts are decided here.  The bound needs shaking below uplift and, with the pull of
    # now in place of the least one to come, bounces that shrink.
    pull_here = -(here.forcing.constant + here.forcing.amplitude * sine)
    sine_there = -sine if crosses else sine
    pull_there = -(there.forcing.constant + there.forcing.amplitude * sine_there)
    if pull_here <= here.speed or pull_there <= there.speed:
        return False
    shrunk = restitution * restitution
    drift_here = 4.0 * steepest_forcing(here.forcing) * here.speed
    drift_there = 4.0 * steepest_forcing(there.forcing) * there.speed
    if (
        shrunk * (pull_here * pull_here + drift_here) >= pull_here * pull_here
        or shrunk * (pull_there * pull_there + drift_there) >= pull_there * pull_there
    ):
        return False
    phase = here.phase
    if crosses:
        phase += math.pi if phase < HALF_PI else -math.pi
    later = Bounce(there.forcing, phase, there.speed, there.rate)
    return settles(restitution, span, here, later, highest)


@compiled
def settles(restitution: float, span: float, here: Bounce, there: Bounce, highest: float) -> bool:
    """Return whether the coming bounces are proved to end before an uplift and within `span`.

    `here` is the first bounce.  Both have one velocity of the base, seen from either side; `span`
    is in reference time, and `restitution` the larger of the two sides'.  Nor may they rise above
    an angle of `highest`, which is infinite where no peak counts.
    """
    if restitution >= 1.0:
        return False
    pull_here = -largest_forcing(here.forcing, here.phase, 0.0)
    pull_there = -largest_forcing(there.forcing, there.phase, 0.0)
    if pull_here <= here.speed or pull_there <= there.speed:
        return False
    longer = max(here.speed / (pull_here * here.rate), there.speed / (pull_there * there.rate))
    window = 4.0 * longer / (1.0 - restitution)
    if window > span:
        return False
    growth_here, duration_here, top_here = bounce_bounds(here, window * here.rate)
    growth_there, duration_there, top_there = bounce_bounds(there, window * there.rate)
    kappa = restitution * math.sqrt(max(growth_here, growth_there))
    return (
        kappa < 1.0
        and max(duration_here, duration_there) <= (1.0 - kappa) * window
        and max(top_here, top_there) <= highest
    )


@compiled
def bounce_bounds(bounce: Bounce, window: float) -> tuple[float, float, float]:
    """Return upper bounds of a bounce's growth of velocity squared, its duration and its top."""
    forcing, phase, velocity, rate = bounce
    pull = -largest_forcing(forcing, phase, window)
    return linear_bounds(pull, steepest_forcing(forcing), velocity, rate)


@compiled
def impacts_on_still_base(sides: Floats, side: int, speed: float, impacts: int, most: int) -> int:
    """Return the impacts of chatter on a still base, those before it included.

    Parameters
    ----------
    sides
        Table of the block's sides.
    side, speed
        With which the next bounce begins.
    impacts
        Impacts that have counted before.
    most
        Impacts after which it ends, where restitution scatters and each is drawn.
    """
    row = 0 if side > 0 else 1
    there = row if free_side(sides) != 0 else 1 - row
    least_there = COUNTED * (sides[there, LEAN] * sides[there, RATE])
    least_here = COUNTED * (sides[row, LEAN] * sides[row, RATE])
    if is_scattered(sides):
        for _ in range(most):
            if speed < min(least_here, least_there):
                break
            speed *= abs(restitution_of(sides, row, impacts + 1))
            impacts += 1 if speed >= least_there else 0
            row, there = there, row
            least_here, least_there = least_there, least_here
        return impacts
    first = abs(sides[row, RESTITUTION])
    both = first * abs(sides[there, RESTITUTION])
    return impacts + terms(speed * first, both, least_there) + terms(speed * both, both, least_here)


@compiled
def terms(first: float, ratio: float, least: float) -> int:
    """Return how many terms of a falling geometric series reach a value."""
    if first < least:
        return 0
    if ratio == 0.0:
        return 1
    return 1 + int(log(first / least) / -log(ratio))
