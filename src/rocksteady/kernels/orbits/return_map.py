"""The return map of periodic shaking: from just after one impact to just after the next.

A block that rocks under periodic shaking is known at each impact by the side it goes to, the phase
of the shaking and its speed just after; a block against a wall always goes to the same side.
`next_passage` takes such a state to the next one with the exact derivative; everything about
orbits, attractors and their stability is built from it alone, so that another model needs another
`next_passage` and nothing else.

Two passages are not a plain impact.  Chatter that is proved to die out ends in a **rest**, from
which the block lifts at a phase of its own whatever came before: the state after it is that uplift,
with speed 0, and its derivative is 0.  And where the block only **grazes** its base, the derivative
does not exist.

**Two kinds of shaking.**  A `System` is harmonic.  A `SeriesSystem` has the same fields and the
shape of a Fourier series besides; its flights are Taylor steps in either model.  What takes a
system takes both: the compiler makes two versions of it, each with the branches of its own kind.
Mirrored in the block's middle plane, harmonic shaking is itself half a period later, so that a
flight to the negative side is one to the positive side at another phase.  A series has no such
image: the phase is that of the base on both sides, and the negative side sees minus the series.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.clock import clock, side_clock, side_phase, uplift_clock
from rocksteady.kernels.core.forcing import SINE, Forcing, grazes, starts_positive
from rocksteady.kernels.core.harmonics import level_of, lifts_at
from rocksteady.kernels.core.tables import FOUND, NO_RETURN, Floats
from rocksteady.kernels.core.typed import MINUS_ONE, ONE, TRUE
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.linear.extrema import highest_angle
from rocksteady.kernels.linear.flight import Flight, make_flight
from rocksteady.kernels.linear.landing import landing_jacobian
from rocksteady.kernels.linear.zeros import next_zero
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.march.rest import Bounce, chatter_ends, series_uplift, uplift_time
from rocksteady.kernels.nonlinear.drive import SteppedFlight
from rocksteady.kernels.nonlinear.landing import fly_to_landing, landing_derivative
from rocksteady.kernels.nonlinear.proofs import SteppedBounce, bounces_settle
from rocksteady.kernels.nonlinear.replay import peaks_of
from rocksteady.kernels.orbits.systems import (
    EitherSystem,
    System,
    drive_of,
    forcing_of,
    next_side,
    seen_from,
    sign_in,
)

# What a passage was.
IMPACT = 0
UPLIFT = 1  # chatter came to rest, and the block lifts again
GRAZE = 2  # an impact so slow that no derivative exists
FALL = 3  # no impact follows: the block overturns
STAY = 4  # chatter came to rest, and nothing lifts the block again
STUCK = 5  # the search for the next impact did not end

AT_NODE = 1e-12
"""Difference of a phase from that of uplift which is rounding."""
LONGEST_FLIGHT = 2000.0
"""Pivot time for which the next impact is looked for.  The smallest growing part that a double can
hold is past every bound after 745; only a flight without one, upright to the last bit, goes on."""
ENDLESS = 1e15
"""Pivot time in which chatter may come to rest: no end, in effect."""


class AnyState(NamedTuple):
    """Any state of a block, as `rocksteady.kernels.core.tables.March` has it."""

    side: int  # 0 at rest
    half_cycles: int
    phase: float
    angle: float
    velocity: float


class Section(NamedTuple):
    """A state just after an impact, or (with speed 0) at an uplift."""

    side: int  # +1 or -1: the side to which the block goes
    half_cycles: int  # whole half periods of the shaking ...
    phase: float  # ... and the phase within the next, in [0, pi)
    speed: float  # |d(theta/alpha)/ds|


class Jacobian(NamedTuple):
    """Derivative of (phase, speed) after a passage by (phase, speed) before it."""

    phase_by_phase: float
    phase_by_speed: float
    speed_by_phase: float
    speed_by_speed: float


class Passage(NamedTuple):
    """One step of the return map."""

    kind: int
    state: Section  # after it; of a fall or a stay the one before
    time: float  # pivot time that it took, the rest before an uplift included
    landing: float  # speed just before the impact; 0 at an uplift
    jacobian: Jacobian


@inlined
def identity() -> Jacobian:
    """Return the derivative of standing still."""
    return Jacobian(1.0, 0.0, 0.0, 1.0)


@inlined
def product(after: Jacobian, before: Jacobian) -> Jacobian:
    """Return the derivative of one passage after another."""
    return Jacobian(
        after.phase_by_phase * before.phase_by_phase + after.phase_by_speed * before.speed_by_phase,
        after.phase_by_phase * before.phase_by_speed + after.phase_by_speed * before.speed_by_speed,
        after.speed_by_phase * before.phase_by_phase + after.speed_by_speed * before.speed_by_phase,
        after.speed_by_phase * before.phase_by_speed + after.speed_by_speed * before.speed_by_speed,
    )


@compiled
def flight_from(system: System, state: Section) -> Flight:
    """Return the flight that a state begins, in the units of its side."""
    row = 0 if state.side > 0 else 1
    seen, _ = seen_from(system.shares, state.half_cycles, state.phase, state.side, system.frequency)
    unit = system.lean[row] * system.rate[row]
    sine, cosine = sincos_near(seen)
    return make_flight(forcing_of(system, state.side), 0.0, state.speed / unit, seen, sine, cosine)


@compiled
def next_passage(system: System, state: Section, guess: float) -> Passage:
    """Return the passage that follows a state; `guess` is a time near which the impact may be."""
    row = 0 if state.side > 0 else 1
    flight = flight_from(system, state)
    if state.speed > 0.0:
        if comes_to_rest(system, state, flight.sine):
            return uplift_after(system, state.half_cycles, state.phase)
    elif not lifts_in(system, system.shares, row, flight.phase):  # it touches its base and stays
        return uplift_after(system, state.half_cycles, state.phase)
    return passage_of(system, state, flight, guess)


@compiled
def guess_after(step: Passage) -> float:
    """Return a time near which the impact after a passage may be; -1 for none.

    A rest forgets everything, this included.
    """
    return -1.0 if step.kind == UPLIFT else step.time


@compiled
def lifts(forcing: Forcing, phase: float) -> bool:
    """Return whether a block without speed lifts to a side, at a phase of its forcing."""
    return starts_positive(forcing, phase) or (
        forcing.kind == SINE and abs(phase - forcing.rising) < AT_NODE
    )


@compiled
def lifts_in(system: EitherSystem, shares: Floats | None, row: int, phase: float) -> bool:
    """Return whether a block without speed lifts to the side of a row, at a phase seen from it."""
    forcing = system.positive if row == 0 else system.negative
    if shares is None:
        return lifts(forcing, phase)
    return lifts_at(shares, sign_in(shares, row), level_of(forcing), system.lifts[row], phase)


@compiled
def first_passage(system: System, state: AnyState) -> Passage:
    """Return the passage from any state.

    The derivative is that by phase and speed at angle 0 and means nothing for another angle.
    """
    side, half_cycles, phase, angle, velocity = state
    if side == 0:
        return uplift_after(system, half_cycles, phase)
    row = 0 if side > 0 else 1
    seen, _ = seen_from(system.shares, half_cycles, phase, side, system.frequency)
    lean, rate = system.lean[row], system.rate[row]
    sine, cosine = sincos_near(seen)
    y, v = side * angle / lean, side * velocity / (lean * rate)
    flight = make_flight(forcing_of(system, side), y, v, seen, sine, cosine)
    return passage_of(system, Section(side, half_cycles, phase, abs(velocity)), flight, -1.0)


@compiled
def passage_of(system: System, state: Section, flight: Flight, guess: float) -> Passage:
    """Return the passage at the end of a flight that begins in a state, at any angle."""
    side, half_cycles, phase, _ = state
    row, forcing = 0 if side > 0 else 1, forcing_of(system, side)
    lifting = flight.angle == 0.0 and flight.velocity == 0.0
    derivative = (0.0, 0.0, 0.0, 0.0)
    if system.left_out > 0.0:
        stepping = stepped(system, row, flight, LONGEST_FLIGHT)
        zero, derivative = fly_to_landing(stepping, system.shares)
    else:
        zero = next_zero(flight, forcing, LONGEST_FLIGHT, TRUE, lifting, guess)
    lean, rate = system.lean[row], system.rate[row]
    unit = lean * rate
    if zero.event != FOUND:
        kind = FALL if zero.event == NO_RETURN else STUCK
        here = Section(side, half_cycles, phase, abs(flight.velocity) * unit)
        return Passage(kind, here, math.inf, 0.0, Jacobian(0.0, 0.0, 0.0, 0.0))
    restitution = system.restitution[row]
    _, seen_half = seen_from(system.shares, half_cycles, phase, side, system.frequency)
    turned, landed = side_clock(zero.phase, seen_half)
    half = half_cycles + turned - seen_half + 2 * zero.cycle
    landing = abs(zero.velocity) * unit
    after = Section(next_side(system, side), half, landed, abs(restitution) * landing)
    if grazes(landing, forcing.amplitude, forcing.frequency):
        return Passage(GRAZE, after, zero.time / rate, landing, Jacobian(0.0, 0.0, 0.0, 0.0))
    if system.left_out > 0.0:
        drive = drive_of(system, row)
        j11, j12, j21, j22 = landing_derivative(
            drive, abs(restitution), flight.phase, zero, derivative, system.shares
        )
    else:
        j11, j12, j21, j22 = landing_jacobian(forcing, abs(restitution), flight, zero)
    return Passage(
        IMPACT, after, zero.time / rate, landing, Jacobian(j11, j12 / unit, j21 * unit, j22)
    )


@compiled
def stepped(system: System, row: int, flight: Flight, span: float) -> SteppedFlight:
    """Return a flight on the side of a row as one in steps."""
    drive = drive_of(system, row)
    return SteppedFlight(drive, flight.phase, flight.angle, flight.velocity, span, system.left_out)


@compiled
def comes_to_rest(system: System, state: Section, sine: float) -> bool:
    """Return whether the bounces that a state begins are proved to die out.

    `sine` is that of the phase of the forcing, seen from the side of the state.
    """
    row = 0 if state.side > 0 else 1
    across_side = next_side(system, state.side)
    other = 0 if across_side > 0 else 1
    largest = abs(system.restitution[row])
    if system.free == 0:
        largest = max(largest, system.restitution[other])
    seen, _ = seen_from(system.shares, state.half_cycles, state.phase, state.side, system.frequency)
    speed_here = state.speed / (system.lean[row] * system.rate[row])
    speed_there = state.speed / (system.lean[other] * system.rate[other])
    if system.left_out > 0.0:
        across, _ = seen_from(
            system.shares, state.half_cycles, state.phase, across_side, system.frequency
        )
        return bounces_settle(
            largest,
            ENDLESS,
            SteppedBounce(drive_of(system, row), seen, speed_here, system.rate[row]),
            SteppedBounce(drive_of(system, other), across, speed_there, system.rate[other]),
            math.inf,
            system.shares,
        )
    return chatter_ends(
        largest,
        ENDLESS,
        Bounce(forcing_of(system, state.side), seen, speed_here, system.rate[row]),
        Bounce(forcing_of(system, across_side), seen, speed_there, system.rate[other]),
        sine,
        across_side != state.side,
        math.inf,
    )


@compiled
def uplift_after(system: System, half_cycles: int, phase: float) -> Passage:
    """Return the uplift that ends a rest, or that nothing does."""
    return uplift_of(system, system.shares, half_cycles, phase)


@compiled
def uplift_of(
    system: EitherSystem, shares: Floats | None, half_cycles: int, phase: float
) -> Passage:
    """Return the same; of a series, which has shares, by its table of uplifts."""
    nothing = Jacobian(0.0, 0.0, 0.0, 0.0)
    if shares is not None:
        side, wait, half, lifted = series_uplift(
            system.positive,
            system.negative,
            system.free,
            shares,
            system.lifts,
            half_cycles,
            phase,
        )
        if side == 0:
            return Passage(STAY, Section(0, half_cycles, phase, 0.0), math.inf, 0.0, nothing)
        wait /= system.frequency
        return Passage(UPLIFT, Section(side, half, lifted, 0.0), wait, 0.0, nothing)
    plus_phase, _ = side_phase(half_cycles, phase, ONE, system.frequency)
    minus_phase, _ = side_phase(half_cycles, phase, MINUS_ONE, system.frequency)
    plus = uplift_time(system.positive, plus_phase, math.inf) / system.rate[0]
    minus = uplift_time(system.negative, minus_phase, math.inf) / system.rate[1]
    if system.free > 0:
        minus = math.inf
    elif system.free < 0:
        plus = math.inf
    wait = min(plus, minus)
    if wait == math.inf:
        return Passage(STAY, Section(0, half_cycles, phase, 0.0), math.inf, 0.0, nothing)
    side = 1 if plus <= minus else -1
    half, lifted = half_cycles, phase
    if wait > 0.0:
        forcing = forcing_of(system, side)
        half, lifted = uplift_clock(half_cycles, phase, system.frequency, wait, side, forcing)
    return Passage(UPLIFT, Section(side, half, lifted, 0.0), wait, 0.0, nothing)


@compiled
def phase_between(earlier: Section, later: Section) -> float:
    """Return the phase of the shaking that passes from one state to another."""
    halves = later.half_cycles - earlier.half_cycles
    return halves * math.pi + (later.phase - earlier.phase)


@compiled
def shifted(state: Section, phase: float, speed: float) -> Section:
    """Return a state with its phase and speed moved."""
    halves, rest = clock(state.phase + phase)
    return Section(state.side, state.half_cycles + halves, rest, state.speed + speed)


@compiled
def highest_after(system: System, state: Section, passage: Passage) -> tuple[float, float]:
    """Return the largest |theta|/alpha of the passage after a state, on its side and the other.

    Of bounces that come to rest the first one on either side is the largest; a block against a wall
    has but one side.
    """
    if passage.kind != UPLIFT:
        return highest_of(system, state, passage.time), 0.0
    if state.speed == 0.0:
        return 0.0, 0.0
    bounce = passage_of(system, state, flight_from(system, state), -1.0)
    if bounce.kind != IMPACT:
        return 0.0, 0.0
    here = highest_of(system, state, bounce.time)
    if system.free != 0:
        return here, 0.0
    state = bounce.state
    bounce = passage_of(system, state, flight_from(system, state), -1.0)
    if bounce.kind != IMPACT:
        return here, 0.0
    return here, highest_of(system, state, bounce.time)


@compiled
def highest_of(system: System, state: Section, time: float) -> float:
    """Return the largest |theta|/alpha of the flight that a state begins, up to a pivot time."""
    row = 0 if state.side > 0 else 1
    if system.left_out > 0.0:
        flight = stepped(system, row, flight_from(system, state), time * system.rate[row])
        highest, _ = peaks_of(flight, flight.angle, math.inf, system.shares)
        return highest * system.lean[row]
    angle, _ = highest_angle(
        flight_from(system, state), forcing_of(system, state.side), time * system.rate[row]
    )
    return angle * system.lean[row]
