"""Attractor of a motion: detected by recurrence, refined by Newton's method, accepted if stable.

The motion is followed from impact to impact.  Every so often its last state is compared with those
before it; where one is nearly the same, some passages and forcing periods earlier, Newton's method
looks for the orbit behind it.  The orbit counts if it is stable by its exact multipliers and if the
motion, followed on, comes as near to it as `ARRIVED`: what a motion passes by it does not settle
to, and an unstable orbit is never the answer.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import ZERO, whole
from rocksteady.kernels.elementary.lengths import hypot
from rocksteady.kernels.elementary.logarithm import LN2, log
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.orbits.periodic import (
    Fixed,
    distance,
    loss,
    multipliers,
    polish,
    primitive,
    put,
    state_at,
)
from rocksteady.kernels.orbits.return_map import (
    FALL,
    GRAZE,
    IMPACT,
    STAY,
    STUCK,
    UPLIFT,
    AnyState,
    Jacobian,
    Section,
    first_passage,
    guess_after,
    next_passage,
    phase_between,
)
from rocksteady.kernels.orbits.systems import System

# How a motion ended.
PERIODIC = 0
STAYS = 1  # at rest for ever
FALLS = 2
UNSETTLED = whole(3)  # no orbit in the time given; its Lyapunov exponent tells chaos from slowness

MEMORY = 256
"""Passages that are remembered: an orbit with more, and without rest, is not recognised."""
LONGEST_ORBIT = 2**17
"""Passages of the longest orbit, which a table has to hold: of some thousand forcing periods with a
chatter in each half of them."""
ROUNDED = 27.631021115928547  # ln 1e12
"""Growth of a small difference between two rests from which on rounding decides what comes next."""
NEAR = 1e-2
"""Difference of a state from an earlier one that is worth a search for an orbit."""
ARRIVED = 1e-7
"""Distance to an orbit at which a motion has settled to it."""
FIRST_LOOK = 16
"""Forcing periods before the first comparison."""
SEARCHES = 12
"""Most searches for an orbit in one comparison."""
TINY, HUGE = 1e-280, 1e280  # between them the square of a length has all its digits
WILD = 4.605170185988092  # ln 100
"""Growth of a small difference over a return from which on no stable orbit is looked for there.
Near one it shrinks; a chaotic motion comes back often, and each search would be in vain."""
GROWN = 4
"""Column of the memory for the growth of a small difference so far, a logarithm."""
GENERIC = (0.6, 0.8)
"""A direction of (phase, speed) that no flight forgets: one from an uplift forgets the phase."""
MOST_RETURNS = 200_000
"""Returns for which the approach to a weakly attracting orbit is followed ..."""
MOST_PASSAGES = 2_000_000
"""... and passages: a second."""
SLOW = 70.0
"""Returns in which the distance to a weakly attracting orbit halves."""
MEASURED = 100
"""Fewest forcing periods over which a Lyapunov exponent means something."""


class Settled(NamedTuple):
    """What a motion settles to."""

    outcome: int
    state: Section  # on the orbit; of other outcomes the last one
    passages: int  # of the orbit; without one those from a rest to the same, if that is no orbit
    periods: int
    residual: float
    rests: int
    lyapunov: float  # largest exponent per forcing period; of a periodic motion its orbit's
    least: float  # the smaller of its values over the two last quarters of an unsettled run
    after: int  # forcing periods until it was recognised, or until the end
    growth: float  # logarithm of the largest growth of a small difference on the way


class Near(NamedTuple):
    """A search for a stable orbit near a state."""

    found: bool
    orbit: Section
    largest: float  # modulus of its multipliers
    fixed: Fixed


class Stretch(NamedTuple):
    """How the tangent vector of a motion has grown since some time."""

    phase: float  # its direction
    speed: float
    logarithm: float  # of its growth
    since: int  # half cycles of the shaking at its start


@compiled
def settle(
    system: System, start: AnyState, most_periods: int, memory: Floats2, table: Floats2
) -> Settled:
    """Follow a motion from any state until it is known what it settles to.

    Parameters
    ----------
    system
        The shaken block.
    start
        The state.
    most_periods
        Forcing periods after which it counts as unsettled.
    memory
        Room for the last states, shape (MEMORY, 5 or more).
    table
        Receives the orbit, shape (LONGEST_ORBIT, ORBIT_COLUMNS); with fewer rows, MEMORY or more,
        the outcome is LEFT_OVER where they may not be enough.
    """
    half_cycles = start.half_cycles
    step = first_passage(system, start)
    count, look, forgotten = 0, FIRST_LOOK, ZERO  # passages so far; before which they are forgotten
    lifted_half, lifted_count = (-1, -1), (-1, -1)  # of the last uplift to either side
    third = fourth = Stretch(GENERIC[0], GENERIC[1], 0.0, half_cycles)  # quarters of the run
    whole = third  # since the start or the last rest
    growth = 0.0
    between = 0.0  # the largest growth since the last rest
    on_the_way = (0.0, 0.0)  # and of such since the last uplift to either side
    rested = True  # in the second half, or the run is not that long
    while True:
        state = step.state
        passed = (state.half_cycles - half_cycles) // 2
        if step.kind in (FALL, STAY, STUCK):
            outcome = FALLS if step.kind == FALL else (STAYS if step.kind == STAY else UNSETTLED)
            return unsettled(outcome, state, math.nan, math.nan, passed, growth)
        if step.kind == UPLIFT:
            # A rest forgets everything: an uplift to the same side again closes an orbit.
            row = 0 if state.side > 0 else 1
            if lifted_count[row] >= 0:
                passages = count - lifted_count[row]
                periods = (state.half_cycles - lifted_half[row]) // 2
                largest = max(on_the_way[row], between)
                # It repeats itself, but no table holds it, or rounding decides how.
                if passages > LONGEST_ORBIT or largest > ROUNDED:
                    return Settled(
                        UNSETTLED,
                        state,
                        passages,
                        periods,
                        math.nan,
                        0,
                        math.nan,
                        math.nan,
                        passed,
                        growth,
                    )
                if passages > len(table):
                    return unsettled(LEFT_OVER, state, math.nan, math.nan, passed, growth)
                fixed = polish(system, state, passages, periods, table)
                if fixed.found:
                    return Settled(
                        PERIODIC,
                        state,
                        passages,
                        periods,
                        fixed.residual,
                        fixed.rests,
                        -math.inf,
                        -math.inf,
                        passed,
                        growth,
                    )
            # A block that lifts as it starts does so at any phase, to which no rest leads back.
            if step.time == 0.0:
                pass
            elif row == 0:
                lifted_half = (state.half_cycles, lifted_half[1])
                lifted_count = (count, lifted_count[1])
                on_the_way = (0.0, max(on_the_way[1], between))
            else:
                lifted_half = (lifted_half[0], state.half_cycles)
                lifted_count = (lifted_count[0], count)
                on_the_way = (max(on_the_way[0], between), 0.0)
            between = 0.0
            forgotten = count
            rested = True
            whole = Stretch(GENERIC[0], GENERIC[1], 0.0, state.half_cycles)
        put(memory, count % MEMORY, state)
        memory[count % MEMORY, GROWN] = whole.logarithm
        count += 1
        over = passed >= most_periods
        if passed >= look or over:
            look = passed + passed // 2
            found = recognised(system, memory, count, forgotten, passed, table, growth)
            if found.outcome == PERIODIC:
                return found
        if over:
            third_rate, third_periods = rate_of(third, fourth.since)
            fourth_rate, fourth_periods = rate_of(fourth, state.half_cycles)
            measured = third_periods + fourth_periods
            if rested or measured < MEASURED:
                return unsettled(UNSETTLED, state, math.nan, math.nan, passed, growth)
            mean = (third.logarithm + fourth.logarithm) / measured
            least = min(third_rate, fourth_rate)
            return unsettled(UNSETTLED, state, mean, least, passed, growth)
        step = next_passage(system, state, guess_after(step))
        if step.kind == GRAZE:  # no derivative exists there, nor an exponent of what holds it
            third = Stretch(third.phase, third.speed, math.nan, third.since)
            fourth = Stretch(fourth.phase, fourth.speed, math.nan, fourth.since)
        if step.kind != IMPACT:
            continue
        whole = stretched(whole, step.jacobian)
        growth = max(growth, whole.logarithm)
        between = max(between, whole.logarithm)
        if 4 * passed < 3 * most_periods:
            if 2 * passed < most_periods:
                rested = False
                third = Stretch(third.phase, third.speed, 0.0, step.state.half_cycles)
            third = stretched(third, step.jacobian)
            fourth = Stretch(third.phase, third.speed, 0.0, step.state.half_cycles)
        else:
            fourth = stretched(fourth, step.jacobian)


@compiled
def stretched(stretch: Stretch, jacobian: Jacobian) -> Stretch:
    """Return a tangent vector after a passage, at length 1."""
    phase = jacobian.phase_by_phase * stretch.phase + jacobian.phase_by_speed * stretch.speed
    speed = jacobian.speed_by_phase * stretch.phase + jacobian.speed_by_speed * stretch.speed
    square = phase * phase + speed * speed
    size = math.sqrt(square) if TINY < square < HUGE else hypot(phase, speed)
    if size == 0.0:  # the one direction that a flight from an uplift forgets
        return Stretch(GENERIC[0], GENERIC[1], stretch.logarithm, stretch.since)
    return Stretch(phase / size, speed / size, stretch.logarithm + log(size), stretch.since)


@compiled
def rate_of(stretch: Stretch, until: int) -> tuple[float, float]:
    """Return the exponent of a stretch per forcing period, and the periods that it took."""
    periods = 0.5 * (until - stretch.since)
    return (stretch.logarithm / periods if periods > 0.0 else math.nan), periods


@compiled
def unsettled(
    outcome: int, state: Section, lyapunov: float, least: float, after: int, growth: float
) -> Settled:
    """Return an outcome without an orbit."""
    return Settled(outcome, state, 0, 0, math.nan, 0, lyapunov, least, after, growth)


@compiled
def recognised(
    system: System,
    memory: Floats,
    count: int,
    forgotten: int,
    passed: int,
    table: Floats,
    growth: float,
) -> Settled:
    """Return the stable orbit without rest that the last states approach, if there is one.

    States before `forgotten` do not count: a rest lies between them and the last one.
    """
    last = state_at(memory, (count - 1) % MEMORY)
    nothing = unsettled(UNSETTLED, last, math.nan, math.nan, passed, growth)
    searches = 0
    grown = memory[(count - 1) % MEMORY, GROWN]
    for passages in range(1, min(count - forgotten, MEMORY)):
        earlier = state_at(memory, (count - 1 - passages) % MEMORY)
        if distance(earlier, last) > NEAR:
            continue
        if grown - memory[(count - 1 - passages) % MEMORY, GROWN] > WILD:
            continue
        periods = round(phase_between(earlier, last) / TWO_PI)
        if periods < 1:
            continue
        searches += 1
        if searches > SEARCHES:
            break
        near = stable_orbit(system, last, passages, periods, table)
        if not near.found:
            continue
        if not arrives(system, last, near.orbit, passages, near.largest):
            return nothing  # what comes next are multiples of it
        return settled_to(near, passages, periods, passed, growth, table)
    return nothing


@compiled
def stable_orbit(
    system: System, last: Section, passages: int, periods: int, table: Floats2
) -> Near:
    """Look for a stable orbit without rest near a state, and leave it in a table."""
    return judged(system, last, passages, polish(system, last, passages, periods, table), table)


@compiled
def judged(system: System, last: Section, passages: int, fixed: Fixed, table: Floats2) -> Near:
    """Return whether the orbit in a table, found from a state, is near, without rest and stable."""
    orbit = state_at(table, ZERO)
    if not fixed.found or fixed.grazes > 0 or distance(orbit, last) > 10.0 * NEAR:
        return Near(False, orbit, math.inf, fixed)
    determinant = loss(system, orbit.side, passages, fixed.rests)
    first, _ = multipliers(fixed.jacobian, determinant)
    largest = hypot(first.real, first.imag)
    # Without loss nothing is attracted, whatever rounding makes of a modulus of 1.
    return Near(determinant < 1.0 and largest < 1.0, orbit, largest, fixed)


@compiled
def settled_to(
    near: Near, passages: int, periods: int, passed: int, growth: float, table: Floats
) -> Settled:
    """Return what a motion settles to that comes back after so many passages and periods."""
    first, of = primitive(table, passages, periods)
    exponent = log(near.largest) / periods if near.largest > 0.0 else -math.inf
    rests = near.fixed.rests * first // passages
    return Settled(
        PERIODIC,
        near.orbit,
        first,
        of,
        near.fixed.residual,
        rests,
        exponent,
        exponent,
        passed,
        growth,
    )


@compiled
def returns_to(passages: int, largest: float) -> int:
    """Return for how many returns the approach to a stable orbit is followed."""
    return min(MOST_RETURNS, 20 + int(30.0 / (1.0 - largest)), MOST_PASSAGES // passages)


@compiled
def arrives(system: System, state: Section, orbit: Section, passages: int, largest: float) -> bool:
    """Return whether the motion comes to within `ARRIVED` of an orbit by following it on.

    Of a weakly attracting orbit it is enough that the distance halves in as many returns as the
    multiplier says, half of them more or less.  What bends the approach, and could turn it back, is
    of higher order in the distance: it was less than the linear part and only becomes smaller.
    """
    near = distance(orbit, state)
    returns = returns_to(passages, largest)
    halving = -LN2 / log(largest) if largest > 0.0 else 0.0
    half, since = 0.5 * near, 0
    for count in range(returns):
        apart = distance(orbit, state)
        if apart <= ARRIVED:
            return True
        slow = halving > SLOW and apart < NEAR
        if slow and apart <= half and abs(count - since - halving) <= 0.5 * halving:
            return True
        if apart <= half or apart > 2.0 * half:  # at first it may grow
            half, since = 0.5 * apart, count
        if apart > 100.0 * near + ARRIVED:
            return False
        for _ in range(passages):
            step = next_passage(system, state, -1.0)
            if step.kind in (FALL, STAY, STUCK):
                return False
            state = step.state
        if state.side != orbit.side:
            return False
    return False
