"""Returns of lanes to earlier states, and judgement of the orbits behind them.

A lane of either model remembers its last states after impacts and looks at the same times as
`rocksteady.kernels.orbits.settle.settle` whether it has come back near one of them.  If so it flies
on, until it comes back much closer; the scalar code then finds the orbit in a step or two of
Newton's method and judges it (`computed`).  Whatever else happens (a rest, a motion that does not
settle, a return that leads to no stable orbit) is left to the scalar code from the start: a cell
that lanes settle has the answer of that, but for roundings on the way to the orbit.
"""

import math

from rocksteady.kernels.batch.arrival import FALLEN, LEAVE, LOOKING, SETTLED, Places, Room
from rocksteady.kernels.batch.attractors import OUTCOME, note_attractor
from rocksteady.kernels.batch.known_orbits import answer, is_known, keep, key_of, recalled, row_of
from rocksteady.kernels.core.clock import clock, side_phase
from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.law import Law, put_law
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import Floats, March
from rocksteady.kernels.core.tuples import Outcomes
from rocksteady.kernels.core.typed import MINUS_ONE, ONE, ZERO, whole
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import (
    Floats2,
    Floats3,
)
from rocksteady.kernels.orbits.periodic import (
    ORBIT_COLUMNS,
    SMALLEST_SPEED,
    Fixed,
    closed_after,
    distance,
    fill_peaks,
    laid_out,
    mirror,
    moved,
    put,
    state_at,
)
from rocksteady.kernels.orbits.return_map import (
    FALL,
    IMPACT,
    STAY,
    UPLIFT,
    AnyState,
    Jacobian,
    Section,
    first_passage,
    identity,
    next_passage,
    product,
)
from rocksteady.kernels.orbits.settle import (
    ARRIVED,
    FALLS,
    MEMORY,
    NEAR,
    STAYS,
    Near,
    arrives,
    judged,
    returns_to,
    settled_to,
    stable_orbit,
    unsettled,
)
from rocksteady.kernels.orbits.systems import System

MOST_RETURNS = 100
"""Returns after a look for which an orbit is approached; then it is computed from afar."""
WITHIN = 3.0 * NEAR
"""Distance to an orbit from which Newton's method is taken to lead there ..."""
BENT = 0.1
"""... if what bends the map displaces the orbit by this part of the distance at most."""
STEPS = 4
"""Most steps of Newton's method from a state that is close."""
ALIKE = 1e-5
"""Distance of a state from the mirror image half a return earlier of which that is made use."""
ROUNDING = 4e-15
"""Residual of an orbit that is due to rounding."""
TAME = 80.0
"""Growth of a small difference over a return to an orbit up to which it is below 100 nearby, from
which on `settle` looks for no orbit."""

# What becomes of a lane that has waited.
OVER = ZERO  # its row is written
ONWARD = ONE  # as it stands
FLOWN = whole(2)  # from the state after one more passage

# Columns of the table of watched returns.
PERIODS = 0
PASSED = 1  # forcing periods until the look
FIRST = 2  # impacts at the look
PHASE_THEN = 3  # the state at the look ...
VELOCITY_THEN = 4
PHASE_BEFORE = 5  # ... and the one that it came back to
VELOCITY_BEFORE = 6
RETURN_COLUMNS = 7


@compiled
def begun(system: System, start: AnyState, cell: int, table: Floats2, outcomes: Outcomes) -> March:
    """Return the first flight of a motion from the floor, after as many impacts as it has.

    Their number is -1 where it is over without one, with its row written, or is left over.
    """
    side, half_cycles, phase, angle, velocity = start
    if angle == 0.0 and side * velocity > 0.0:
        return march_from(Section(side, half_cycles, phase, side * velocity), ZERO)
    first = first_passage(system, start)
    if first.kind in (IMPACT, UPLIFT):
        return march_from(first.state, ONE)
    if first.kind in (FALL, STAY):
        outcome = FALLS if first.kind == FALL else STAYS
        after = (first.state.half_cycles - half_cycles) // 2
        found = unsettled(outcome, first.state, math.nan, math.nan, after, 0.0)
        note_attractor(system, found, table, outcomes, cell)
    else:
        outcomes.whole[cell, OUTCOME] = LEFT_OVER
    return march_from(first.state, MINUS_ONE)


@compiled
def march_from(state: Section, impacts: int) -> March:
    """Return a march at a state after so many impacts."""
    side, half_cycles, phase, speed = state
    return March(side, 0.0, side * speed, ZERO, half_cycles, phase, impacts, ZERO)


@compiled
def section_of(march: March) -> Section:
    """Return the state of a march at the start of a flight from the floor."""
    return Section(march.side, march.half_cycles, march.phase, abs(march.velocity))


@compiled
def attended(
    lanes: Floats,
    j: int,
    places: Places,
    room: Room,
    system: System,
    march: March,
    start: int,
    cycles: int,
    outcomes: Outcomes,
) -> tuple[int, March]:
    """Help a waiting lane on; return what becomes of it, `OVER`, `ONWARD` or `FLOWN`, and where.

    Parameters
    ----------
    lanes, j, places
        The lane.
    room
        What lanes share.
    system, march
        Its block, and the state at the start of its flight.
    start, cycles
        Half cycles of the shaking at the start, and how many periods it is followed at most.
    outcomes
        Receive its row.
    """
    stage = lanes[places.stage + j]
    cell = int(lanes[places.cell + j])
    here = section_of(march)
    passed = (here.half_cycles - start) // 2
    free = lanes[places.lag + j] == 0.0
    falls = stage == FALLEN and free
    if stage == LOOKING:
        if returning(lanes, j, places, room, passed):
            return ONWARD, march
        if passed < cycles:
            lanes[places.look + j] = 2.0 * min(passed + passed // 2, cycles)
            return ONWARD, march
    if stage == LEAVE:
        after = next_passage(system, here, -1.0)
        if after.kind == IMPACT:
            return FLOWN, march_from(after.state, march.impacts + 1)
        falls = after.kind == FALL and free
    if stage == SETTLED and computed(lanes, j, places, room, system, here, outcomes):
        return OVER, march
    if falls:
        found = unsettled(FALLS, here, math.nan, math.nan, passed, 0.0)
        note_attractor(system, found, room.table, outcomes, cell)
    else:
        outcomes.whole[cell, OUTCOME] = LEFT_OVER
    return OVER, march


@compiled
def returning(lanes: Floats, j: int, places: Places, room: Room, passed: int) -> bool:
    """Return whether a lane has come back near an earlier state, from now on to be watched.

    As `settle` looks, but that the orbit is left to be found when the motion is nearer.
    """
    memory, returns = room.memory, room.returns
    count = int(lanes[places.impacts + j])
    phase, left, velocity = (
        lanes[places.phase + j],
        lanes[places.left + j],
        lanes[places.velocity + j],
    )
    # The states on the same side; a motion without rest changes sides with each impact.
    for passages in range(2, min(count, MEMORY), 2):
        row = (count - 1 - passages) & (MEMORY - 1)
        earlier_phase, earlier_velocity = memory[j, row, 0], memory[j, row, 2]
        between = (memory[j, row, 1] - left) * math.pi + (phase - earlier_phase)
        periods = round(between / TWO_PI)
        slower = abs(earlier_velocity - velocity) / max(earlier_velocity, SMALLEST_SPEED)
        if max(abs(between - TWO_PI * periods), slower) > NEAR or periods < 1:
            continue
        returns[j, PERIODS], returns[j, PASSED], returns[j, FIRST] = periods, passed, count
        returns[j, PHASE_THEN], returns[j, VELOCITY_THEN] = phase, velocity
        returns[j, PHASE_BEFORE], returns[j, VELOCITY_BEFORE] = earlier_phase, earlier_velocity
        lanes[places.ref_phase + j], lanes[places.ref_velocity + j] = phase, velocity
        lanes[places.lag + j] = passages
        put_law(lanes, places.law + j, places.width, Law(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0))
        lanes[places.known + j] = 0.0
        lanes[places.next + j] = count + passages
        lanes[places.limit + j] = count + MOST_RETURNS * passages
        lanes[places.look + j] = math.inf
        return True
    return False


@compiled
def computed(
    lanes: Floats,
    j: int,
    places: Places,
    room: Room,
    system: System,
    here: Section,
    outcomes: Outcomes,
) -> bool:
    """Return whether a motion that is close settles to what `settle` would find; write it."""
    memory, returns, known, table = room
    passages, periods = int(lanes[places.lag + j]), int(returns[j, PERIODS])
    guess = lanes[places.time + j]
    # Of an orbit that is its own mirror image one half is enough.
    folded = mirrored(lanes, j, places, memory, passages, periods)
    key = key_of(system, here, passages, periods, folded)
    row = row_of(key, known)
    again = is_known(known, row, key)
    near = Near(False, here, math.inf, Fixed(False, math.inf, identity(), ZERO, ZERO))
    if again:
        near = recalled(known, row)
    elif folded:
        fixed = refined(system, here, passages // 2, periods, guess, table)
        whole_way = product(fixed.jacobian, fixed.jacobian)
        fixed = Fixed(fixed.found, fixed.residual, whole_way, 2 * fixed.rests, 2 * fixed.grazes)
        near = judged(system, here, passages, fixed, table)
    if not near.found:
        folded = False
        fixed = refined(system, here, passages, 2 * periods, guess, table)
        near = judged(system, here, passages, fixed, table)
    if near.found and not in_reach(returns, j, system, near):
        row, again, folded = MINUS_ONE, False, False
        turns, phase = clock(returns[j, PHASE_THEN])
        half = turns if here.side > 0 else turns + 1
        then = Section(here.side, half, phase, returns[j, VELOCITY_THEN])
        near = stable_orbit(system, then, passages, periods, table)
    if not near.found or growth_over(near.fixed.jacobian) > TAME:
        return False
    since = (int(lanes[places.impacts + j]) - int(returns[j, FIRST])) // passages
    if since >= returns_to(passages, near.largest):
        return False
    if distance(near.orbit, here) > ARRIVED and not arrives(
        system, here, near.orbit, passages, near.largest
    ):
        return False
    passed, cell = int(returns[j, PASSED]), int(lanes[places.cell + j])
    if again:
        answer(known, row, passed, cell, outcomes)
        return True
    if folded:
        fill_peaks(system, passages // 2, table)
        unfold(table, passages // 2, periods)
    else:
        fill_peaks(system, passages, table)
    found = settled_to(near, passages, periods, passed, 0.0, table)
    note_attractor(system, found, table, outcomes, cell)
    if row >= 0:
        keep(known, row, key, near, cell, outcomes)
    return True


@compiled
def mirrored(
    lanes: Floats, j: int, places: Places, memory: Floats3, passages: int, periods: int
) -> bool:
    """Return whether half of a return was nearly the mirror image of the other half."""
    half = passages // 2
    if half % 2 == 0 or periods % 2 == 0:
        return False
    row = (int(lanes[places.impacts + j]) - 1 - half) & (MEMORY - 1)
    # As seen from the side of the flight a mirror image is the same state.
    between = (memory[j, row, 1] - lanes[places.left + j]) * math.pi
    between += (lanes[places.phase + j] - memory[j, row, 0]) - periods * math.pi
    velocity, earlier = lanes[places.velocity + j], memory[j, row, 2]
    slower = abs(earlier - velocity) / max(earlier, SMALLEST_SPEED)
    return bool(max(abs(between), slower) < ALIKE)


@compiled
def unfold(table: Floats, half: int, periods: int) -> None:
    """Fill in the second half of an orbit, the mirror image of the first."""
    for k in range(half):
        for column in range(ORBIT_COLUMNS):
            table[half + k, column] = table[k, column]
        put(table, half + k, mirror(state_at(table, k), periods))


@compiled
def refined(
    system: System, state: Section, passages: int, halves: int, guess: float, table: Floats2
) -> Fixed:
    """Find the orbit next to a state, as `polish` does, in no more steps than that takes."""
    found = laid_out(system, state, passages, halves, guess, table)
    for _ in range(STEPS):
        if found.residual <= ROUNDING or not math.isfinite(found.residual):
            break
        if not moved(table, passages, found.jacobian):
            return Fixed(False, math.inf, found.jacobian, found.rests, found.grazes)
        found = closed_after(system, passages, halves, table)
    return found


@compiled
def in_reach(returns: Floats, j: int, system: System, near: Near) -> bool:
    """Return whether Newton's method leads from the state at the look to an orbit.

    It does if what bends the map, measured on the return before the look, displaces the fixed point
    by a part of the distance to it only.
    """
    orbit, jacobian = near.orbit, near.fixed.jacobian
    phase, _ = side_phase(orbit.half_cycles, orbit.phase, orbit.side, system.frequency)
    then_phase = turned(returns[j, PHASE_THEN] - phase)
    then_speed = returns[j, VELOCITY_THEN] - orbit.speed
    before_phase = turned(returns[j, PHASE_BEFORE] - phase)
    before_speed = returns[j, VELOCITY_BEFORE] - orbit.speed
    bent_phase = then_phase - (
        jacobian.phase_by_phase * before_phase + jacobian.phase_by_speed * before_speed
    )
    bent_speed = then_speed - (
        jacobian.speed_by_phase * before_phase + jacobian.speed_by_speed * before_speed
    )
    a, b = jacobian.phase_by_phase - 1.0, jacobian.phase_by_speed
    c, d = jacobian.speed_by_phase, jacobian.speed_by_speed - 1.0
    determinant = a * d - b * c  # (1 - mu_1)(1 - mu_2) > 0 of a stable orbit
    unit = max(orbit.speed, SMALLEST_SPEED)
    off = max(abs(d * bent_phase - b * bent_speed), abs(a * bent_speed - c * bent_phase) / unit)
    apart = max(abs(then_phase), abs(then_speed) / unit)
    return bool(apart <= WITHIN and off <= determinant * max(BENT * apart, ARRIVED))


@compiled
def turned(phase: float) -> float:
    """Return a phase less the nearest whole turns."""
    return phase - TWO_PI * round(phase / TWO_PI)


@compiled
def growth_over(jacobian: Jacobian) -> float:
    """Return a bound of how much longer a Jacobian makes any direction (Frobenius)."""
    a, b = jacobian.phase_by_phase, jacobian.phase_by_speed
    c, d = jacobian.speed_by_phase, jacobian.speed_by_speed
    return math.sqrt((a * a + b * b) + (c * c + d * d))
