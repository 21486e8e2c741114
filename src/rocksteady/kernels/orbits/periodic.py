"""Periodic orbits of the return map, found by Newton's method (multiple shooting).

An orbit of m passages and n forcing periods is m states, each of which the map takes to the next
and the last to the first, 2 pi n later.  Newton's method solves for all of them together (multiple
shooting), with the exact Jacobians: where an orbit is so unstable that a run from its first state
leaves it before it is round, each single passage still is accurate.  The linear system needs no
matrix: carried forward, ``d[k+1] = J[k] d[k] + R[k]``, it becomes ``(P - 1) d[0] = -q`` with the
product P of all Jacobians, whose eigenvalues are the orbit's multipliers.  From 96 by 96 starts the
search finds all 22 orbits of A = 1, Omega = 2, restitution 0.8 with up to 3 periods and 6 impacts;
solved for the first state alone it found 19, in three times the time.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, ONE, TRUE, ZERO
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers2
from rocksteady.kernels.orbits.return_map import (
    FALL,
    GRAZE,
    STAY,
    STUCK,
    UPLIFT,
    Jacobian,
    Passage,
    Section,
    guess_after,
    highest_after,
    highest_of,
    identity,
    next_passage,
    phase_between,
    product,
    shifted,
)
from rocksteady.kernels.orbits.systems import System, is_mirrored

STEPS = 30
"""Most steps of Newton's method."""
CLOSED = 1e-12
"""Residual up to which an orbit counts as found."""
EXACT = 1e-15
"""Residual that rounding does not let one improve."""
LARGEST_STEP = 0.3
"""Of the phase [rad], and of a speed relative to itself: longer steps are shortened."""
SMALLEST_SPEED = 1e-3
"""Errors of smaller speeds are measured against this."""
SAME = 1e-7
"""Distance up to which two states of orbits are one."""

# Columns of the table of an orbit, one row a passage.
SIDE = 0
HALF_CYCLES = 1
PHASE = 2  # within the half cycle
SPEED = 3  # after the impact; 0 at an uplift
TIME = 4  # pivot time of the passage that follows
LANDING = 5  # speed before the impact that ends it
PHASE_BY_PHASE = 6
PHASE_BY_SPEED = 7
SPEED_BY_PHASE = 8
SPEED_BY_SPEED = 9
PHASE_ERROR = 10
SPEED_ERROR = 11
PEAK = 12  # largest |theta|/alpha on the way, on the side of the state ...
OTHER_PEAK = 13  # ... and on the other, where bounces come to rest
ORBIT_COLUMNS = 14


class Fixed(NamedTuple):
    """An attempt to find an orbit."""

    found: bool
    residual: float  # largest error of a passage: phase [rad], or speed relative to itself
    jacobian: Jacobian  # of the whole orbit
    rests: int
    grazes: int


@compiled
def put(table: Floats2, row: int, state: Section) -> None:
    """Write a state into the table of an orbit."""
    table[row, SIDE] = state.side
    table[row, HALF_CYCLES] = state.half_cycles
    table[row, PHASE] = state.phase
    table[row, SPEED] = state.speed


@compiled
def state_at(table: Floats2, row: int) -> Section:
    """Return a state from the table of an orbit."""
    return Section(
        int(table[row, SIDE]), int(table[row, HALF_CYCLES]), table[row, PHASE], table[row, SPEED]
    )


@compiled
def distance(one: Section, other: Section) -> float:
    """Return how far apart two states are, whole periods not counted; infinite on unlike sides."""
    if one.side != other.side:
        return math.inf
    apart = phase_between(one, other)
    apart -= TWO_PI * round(apart / TWO_PI)
    return max(abs(apart), abs(one.speed - other.speed) / max(one.speed, SMALLEST_SPEED))


@compiled
def laid_out(
    system: System, state: Section, passages: int, halves: int, guess: float, table: Floats2
) -> Fixed:
    """Fill a table with the states that follow one, as `closed_after` leaves it.

    `guess` is a time near which the first impact may be.  From an uplift on the states are those
    that any motion takes, to the last bit: near the end of a chatter a rounding decides how many
    bounces there are, and on what follows.
    """
    put(table, ZERO, Section(state.side, state.half_cycles % 2, state.phase, state.speed))
    return passed_through(system, passages, halves, guess, TRUE, table)


@compiled
def measured(system: System, passages: int, periods: int, table: Floats2) -> Fixed:
    """Return by what the states of a table fail to be an orbit, and fill in its derivatives."""
    return closed_after(system, passages, 2 * periods, table)


@compiled
def closed_after(system: System, passages: int, halves: int, table: Floats2) -> Fixed:
    """Do so for states that come back after so many half periods, odd ones to the mirror image."""
    return passed_through(system, passages, halves, -1.0, FALSE, table)


@inlined
def passed_through(
    system: System, passages: int, halves: int, guess: float, follows: bool, table: Floats2
) -> Fixed:
    """Take the passages from the states of a table; `follows` writes each next state first."""
    total = identity()
    residual = 0.0
    rests = grazes = 0
    for k in range(passages):
        if not follows:
            guess = table[k, TIME] if table[k, TIME] > 0.0 else -1.0
        step = next_passage(system, state_at(table, k), guess)
        if step.kind in (FALL, STAY, STUCK):
            return Fixed(False, math.inf, total, rests, grazes)
        rests += 1 if step.kind == UPLIFT else 0
        grazes += 1 if step.kind == GRAZE else 0
        if k + 1 == passages:
            target = later(state_at(table, ZERO), halves)
        else:
            if follows:
                put(table, k + 1, step.state)
            target = state_at(table, k + 1)
        if step.state.side != target.side:
            return Fixed(False, math.inf, total, rests, grazes)
        residual = max(residual, missed(table, k, step, target))
        total = product(step.jacobian, total)
        guess = guess_after(step)
    return Fixed(residual <= CLOSED, residual, total, rests, grazes)


@compiled
def later(state: Section, halves: int) -> Section:
    """Return a state some half periods later; after an odd number of them its mirror image."""
    if halves % 2 == 1:
        return mirror(state, halves)
    return Section(state.side, state.half_cycles + halves, state.phase, state.speed)


@compiled
def missed(table: Floats2, row: int, step: Passage, target: Section) -> float:
    """Write a passage into its row of a table; return by what it misses the next state."""
    phase = phase_between(target, step.state)
    speed = step.state.speed - target.speed
    table[row, TIME], table[row, LANDING] = step.time, step.landing
    table[row, PHASE_BY_PHASE] = step.jacobian.phase_by_phase
    table[row, PHASE_BY_SPEED] = step.jacobian.phase_by_speed
    table[row, SPEED_BY_PHASE] = step.jacobian.speed_by_phase
    table[row, SPEED_BY_SPEED] = step.jacobian.speed_by_speed
    table[row, PHASE_ERROR], table[row, SPEED_ERROR] = phase, speed
    return max(abs(phase), abs(speed) / max(target.speed, SMALLEST_SPEED))


@compiled
def moved(table: Floats, passages: int, whole: Jacobian) -> bool:
    """Move the states of a table by a step of Newton's method; False where there is none."""
    # What the last state would be off by if the first stayed.
    phase = speed = 0.0
    for k in range(passages):
        phase, speed = carried(table, k, phase, speed)
    a, b = whole.phase_by_phase - 1.0, whole.phase_by_speed
    c, d = whole.speed_by_phase, whole.speed_by_speed - 1.0
    determinant = a * d - b * c
    if determinant == 0.0 or not math.isfinite(determinant):
        return False
    first_phase = -(d * phase - b * speed) / determinant
    first_speed = -(a * speed - c * phase) / determinant
    longest = 0.0
    phase, speed = first_phase, first_speed
    for k in range(passages):
        size = max(table[k, SPEED], SMALLEST_SPEED)
        longest = max(longest, abs(phase) / LARGEST_STEP, abs(speed) / (LARGEST_STEP * size))
        phase, speed = carried(table, k, phase, speed)
    if not math.isfinite(longest):
        return False
    part = 1.0 / max(1.0, longest)
    phase, speed = first_phase, first_speed
    for k in range(passages):
        state = state_at(table, k)
        next_phase, next_speed = carried(table, k, phase, speed)
        there = shifted(state, part * phase, part * speed)
        put(table, k, Section(there.side, there.half_cycles, there.phase, max(there.speed, 0.0)))
        phase, speed = next_phase, next_speed
    return True


@compiled
def carried(table: Floats, row: int, phase: float, speed: float) -> tuple[float, float]:
    """Return a displacement one passage on, with the error of that passage added."""
    return (
        table[row, PHASE_BY_PHASE] * phase
        + table[row, PHASE_BY_SPEED] * speed
        + table[row, PHASE_ERROR],
        table[row, SPEED_BY_PHASE] * phase
        + table[row, SPEED_BY_SPEED] * speed
        + table[row, SPEED_ERROR],
    )


@compiled
def polish(system: System, state: Section, passages: int, periods: int, table: Floats2) -> Fixed:
    """Find the orbit of m passages and n periods near a state, and leave its states in a table.

    Parameters
    ----------
    system
        The shaken block.
    state
        Where the search begins: the states that follow it are the first guess.  At an uplift they
        are the orbit, where they come back to it.
    passages, periods
        m and n.
    table
        Room, shape (m or more, ORBIT_COLUMNS).
    """
    nothing = Fixed(False, math.inf, identity(), 0, 0)
    found = laid_out(system, state, passages, 2 * periods, -1.0, table)
    if state.speed == 0.0 and found.found and found.rests > 0:
        # From an uplift to the same again there is nothing to improve: a step of Newton's method
        # would only carry roundings along, and on a long way between two rests they grow too far.
        return found
    for _ in range(STEPS):
        if found.residual <= EXACT:
            break
        if not math.isfinite(found.residual) or not moved(table, passages, found.jacobian):
            return nothing
        before = found.residual
        found = measured(system, passages, periods, table)
        if before <= CLOSED and found.residual >= 0.5 * before:  # rounding
            break
    return found


@compiled
def multipliers(jacobian: Jacobian, determinant: float) -> tuple[complex, complex]:
    """Return the eigenvalues of an orbit's Jacobian, the larger in modulus first.

    `determinant` is the exact one, the product of the squared restitutions of its impacts, or 0
    where the orbit rests.
    """
    half = 0.5 * (jacobian.phase_by_phase + jacobian.speed_by_speed)
    # A quarter of the discriminant; this form of it does not cancel.
    lean = 0.5 * (jacobian.phase_by_phase - jacobian.speed_by_speed)
    square = lean * lean + jacobian.phase_by_speed * jacobian.speed_by_phase
    if determinant == 0.0:
        return complex(2.0 * half, 0.0), complex(0.0, 0.0)
    if square >= 0.0:
        first = half + math.copysign(math.sqrt(square), half)
        second = determinant / first if first != 0.0 else 0.0
        return complex(first, 0.0), complex(second, 0.0)
    root = math.sqrt(max(determinant - half * half, 0.0))
    return complex(half, root), complex(half, -root)


@compiled
def loss(system: System, side: int, passages: int, rests: int) -> float:
    """Return the exact determinant of the Jacobian of an orbit that starts towards a side.

    It is the product of the squared restitutions of its impacts, all on one side against a wall.
    """
    if rests > 0:
        return 0.0
    total = 1.0
    row = 0 if side > 0 else 1
    for _ in range(passages):
        total *= system.restitution[row] * system.restitution[row]
        if system.free == 0:
            row = 1 - row
    return total


@compiled
def primitive(table: Floats, passages: int, periods: int) -> tuple[int, int]:
    """Return passages and periods after which an orbit is first back at its start."""
    start = state_at(table, ZERO)
    for k in range(1, passages):
        if passages % k != 0 or periods % (passages // k) != 0:
            continue
        if distance(start, state_at(table, k)) < SAME:
            return k, periods // (passages // k)
    return passages, periods


@compiled
def is_symmetric(system: System, table: Floats2, passages: int, periods: int) -> bool:
    """Return whether half of an orbit turns it into its mirror image.

    Of a block whose sides differ, or that has one, or under shaking that half a period does not
    turn round, the mirror image of a motion is none, and one that comes near its own by chance is
    not symmetric.
    """
    if not is_mirrored(system):
        return False
    if passages % 2 == 1 or periods % 2 == 0:
        return False
    start, half = state_at(table, ZERO), state_at(table, passages // 2)
    return distance(mirror(start, periods), half) < SAME


@compiled
def mirror(state: Section, half_cycles: int) -> Section:
    """Return the mirror image of a state: the other side, an odd number of half periods later."""
    return Section(-state.side, state.half_cycles + half_cycles, state.phase, state.speed)


@compiled
def fill_peaks(system: System, passages: int, table: Floats2) -> None:
    """Fill the largest |theta|/alpha of each passage of an orbit that has been measured."""
    for k in range(passages):
        state = state_at(table, k)
        if table[k, LANDING] > 0.0:
            table[k, PEAK], table[k, OTHER_PEAK] = highest_of(system, state, table[k, TIME]), 0.0
            continue
        step = next_passage(system, state, table[k, TIME])
        table[k, PEAK], table[k, OTHER_PEAK] = highest_after(system, state, step)


class Sought(NamedTuple):
    """What a search for orbits goes through.

    Attributes
    ----------
    phases, speeds
        The grid; every state goes to the positive side, since an orbit without rest goes to either
        side in turn, or to the one side of a block against a wall.
    most_passages, most_periods
        Longest orbits.
    mirrors
        Whether mirror images are orbits too, as of a symmetric block, and one is enough.
    """

    phases: Floats1
    speeds: Floats1
    most_passages: int
    most_periods: int
    mirrors: bool


class Orbits(NamedTuple):
    """Receives orbits: phase in [0, 2 pi) and speed, and passages and periods, shape (room, 2)."""

    states: Floats2
    shape: Integers2


@compiled
def search(system: System, sought: Sought, table: Floats2, orbits: Orbits, count: int) -> int:
    """Search for orbits by Newton's method from a grid of states after an impact.

    Parameters
    ----------
    system
        The shaken block.
    sought
        The grid, and which orbits.
    table
        Room, shape (most_passages or more, ORBIT_COLUMNS).
    orbits
        Receives the orbits.
    count
        How many are there already.

    Returns
    -------
    int
        How many there are now; not more than there is room.
    """
    phases, speeds, most_passages, most_periods, mirrors = sought
    found, shape = orbits
    side = -1 if system.free < 0 else 1
    for i in range(len(phases)):
        for j in range(len(speeds)):
            start = shifted(Section(side, 0, 0.0, speeds[j]), phases[i], 0.0)
            here = start
            for passages in range(1, most_passages + 1):
                step = next_passage(system, here, -1.0)
                if step.kind in (FALL, STAY, STUCK):
                    break
                here = step.state
                if here.side != start.side:
                    continue
                periods = round(phase_between(start, here) / TWO_PI)
                if not 1 <= periods <= most_periods:
                    continue
                fixed = polish(system, start, passages, periods, table)
                if not fixed.found or fixed.rests > 0 or fixed.grazes > 0:
                    continue
                if primitive(table, passages, periods)[0] != passages:
                    continue
                if known(passages, periods, side, mirrors, table, orbits, count):
                    continue
                if count == len(found):
                    return count
                half, phase = clock(table[0, HALF_CYCLES] * math.pi + table[0, PHASE])
                found[count, 0] = (half % 2) * math.pi + phase
                found[count, 1] = table[0, SPEED]
                shape[count, 0] = passages
                shape[count, 1] = periods
                count += 1
    return count


@compiled
def known(
    passages: int,
    periods: int,
    side: int,
    mirrors: bool,
    table: Floats,
    orbits: Orbits,
    count: int,
) -> bool:
    """Return whether the orbit of a table, started anywhere, is among those found."""
    found, shape = orbits
    for i in range(count):
        if shape[i, 0] != passages or shape[i, 1] != periods:
            continue
        other = shifted(Section(side, 0, 0.0, found[i, 1]), found[i, 0], 0.0)
        for k in range(passages):
            state = state_at(table, k)
            if distance(other, state) < SAME:
                return True
            if mirrors and distance(other, mirror(state, ONE)) < SAME:
                return True
    return False
