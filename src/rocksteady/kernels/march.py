"""The march: flights strung together by impacts, uplifts and segment ends.

A motion is a table of segments, the block two rows of side parameters (`rocksteady.kernels.tables`
has the columns).  Time is kept as (segment, half cycles, phase): whole half periods of the
segment's sinusoid as an integer and the phase within the current one, so that a change of side adds
exactly pi and nothing drifts over millions of cycles.  A segment without sinusoid counts plain time
in place of the phase.  Runs of samples, segments alike without one, are passed through at a few
products each (`rocksteady.kernels.samples`).
"""

import math

import numpy as np

from rocksteady.kernels.compilation import compiled, inlined
from rocksteady.kernels.extrema import flight_peaks
from rocksteady.kernels.flight import Flight, make_flight
from rocksteady.kernels.forcing import HALF_PI, SINE, Forcing, make_forcing, steepest_forcing
from rocksteady.kernels.rest import settles, uplift_time
from rocksteady.kernels.samples import fly_through, rest_through
from rocksteady.kernels.tables import (
    ALIKE,
    AMPLITUDE,
    AT_REST,
    CEILING,
    CONSTANT,
    DURATION,
    ENDED_BY_IMPACT,
    ENDED_BY_NO_RETURN,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    FREQUENCY,
    JUMP,
    LEAN,
    OVERTURNED,
    PEAK_ANGLE,
    PEAK_SPEED,
    PHASE,
    RATE,
    RESTITUTION,
    ROCKING,
    ROW_ANGLE,
    ROW_COLUMNS,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SEGMENT,
    ROW_SIDE,
    ROW_VELOCITY,
    SEGMENT_COLUMNS,
    SLOPE,
    UNDECIDED,
    Floats,
    March,
    write_row,
)
from rocksteady.kernels.zeros import FOUND, NO_RETURN, Zero, next_zero

# The columns too: whoever marches needs them.
__all__ = [
    "ALIKE",
    "AMPLITUDE",
    "AT_REST",
    "CEILING",
    "CONSTANT",
    "DURATION",
    "ENDED_BY_IMPACT",
    "ENDED_BY_NO_RETURN",
    "ENDED_BY_SPAN",
    "ENDED_BY_UPLIFT",
    "FREQUENCY",
    "JUMP",
    "LEAN",
    "OVERTURNED",
    "PHASE",
    "RATE",
    "RESTITUTION",
    "ROCKING",
    "ROW_ANGLE",
    "ROW_COLUMNS",
    "ROW_DURATION",
    "ROW_EVENT",
    "ROW_HALF_CYCLES",
    "ROW_PHASE",
    "ROW_SEGMENT",
    "ROW_SIDE",
    "ROW_VELOCITY",
    "SEGMENT_COLUMNS",
    "SLOPE",
    "STILL",
    "UNDECIDED",
    "Floats",
    "March",
    "chatter_ends",
    "clock",
    "elapsed_time",
    "march",
    "next_uplift",
    "segment_end",
    "segment_start",
    "side_forcing",
    "side_phase",
    "uplift_clock",
]

PI_HIGH = math.pi
PI_LOW = 1.2246467991473532e-16  # pi - PI_HIGH
# A bounce this slow lasts less than any clock resolves, and its square underflows.
STILL = 1e-100


@compiled
def side_forcing(segments: Floats, index: int, sides: Floats, side: int, elapsed: float) -> Forcing:
    """Return the forcing of a segment seen from one side, its slope counted from `elapsed`."""
    row = 0 if side > 0 else 1
    lean, rate = sides[row, LEAN], sides[row, RATE]
    constant = segments[index, CONSTANT] + segments[index, SLOPE] * elapsed
    return make_forcing(
        side * constant / lean - 1.0,
        side * segments[index, SLOPE] / (lean * rate),
        segments[index, AMPLITUDE] / lean,
        segments[index, FREQUENCY] / rate,
    )


@inlined
def clock(phase: float, moved: int = 0) -> tuple[int, float]:
    """Split an unbounded phase into whole half cycles and a rest in [0, pi).

    `moved` is the number of half cycles by which `side_phase` had moved it: it added as many times
    the double next to pi, and as much is taken away again.
    """
    # np.floor stays a float; math.floor would go through an integer and back.
    half = float(np.floor(phase * (1.0 / math.pi)))
    rest = (phase - half * PI_HIGH) - (half - moved) * PI_LOW
    if rest < 0.0:
        rest = 0.0
    elif rest >= math.pi:
        half += 1.0
        rest = 0.0
    return int(half), rest


@inlined
def side_phase(half: int, phase: float, side: int, frequency: float) -> tuple[float, int]:
    """Return the phase seen from a side, in [-pi/2, 3 pi/2), and its half cycle less `half`."""
    if frequency == 0.0:
        return 0.0, 0
    if (half % 2 == 0) == (side > 0):
        return phase, 0
    if phase < HALF_PI:
        return phase + math.pi, 1
    return phase - math.pi, -1


@compiled
def segment_start(segments: Floats, index: int) -> tuple[int, float]:
    """Return half cycles and phase (or time) at the start of a segment."""
    if segments[index, FREQUENCY] == 0.0:
        return 0, 0.0
    return clock(segments[index, PHASE])


@compiled
def segment_end(segments: Floats, index: int) -> tuple[int, float]:
    """Return half cycles and phase (or time) at the end of a segment of finite duration."""
    duration, frequency = segments[index, DURATION], segments[index, FREQUENCY]
    if frequency == 0.0:
        return 0, duration
    return clock(segments[index, PHASE] + frequency * duration)


@inlined
def elapsed_time(
    half_cycles: int, phase: float, from_half: int, from_phase: float, frequency: float
) -> float:
    """Return the pivot time between two clock readings on one segment."""
    if frequency == 0.0:
        return phase - from_phase
    return ((half_cycles - from_half) * math.pi + (phase - from_phase)) / frequency


@compiled
def march(
    segments: Floats,
    sides: Floats,
    start: March,
    stop_half_cycles: int,
    stop_phase: float,
    rest_velocity: float,
    limit: int,
    rows: Floats,
    peaks: Floats,
) -> tuple[int, March]:
    """March from `start` to the stop, to overturning, or to the limit.

    Parameters
    ----------
    segments, sides
        Tables of shape (segments, 9) and (2, 3).
    start
        Where to begin.  At rest `side` is 0; a side with angle and velocity 0 is just lifting off.
    stop_half_cycles, stop_phase
        The clock reading on the last segment at which the run ends, where that is endless.
    rest_velocity
        Chatter slower than this comes to rest as soon as the bound of
        `rocksteady.kernels.rest` proves that it will.
    limit
        Flights and rests after which the march gives up as UNDECIDED.
    rows
        Array of shape (flights, 8) that receives the flights, as many as a first march without
        rows (0, 8) has counted: a march does not depend on whether it is recorded.
    peaks
        Array of shape (2,) in which the largest |angle| and |velocity| are kept, those that it
        comes with included, up to the end or the proof of overturning; or of shape (0,).

    Returns
    -------
    tuple
        Status (ROCKING, AT_REST, OVERTURNED or UNDECIDED) and final state.
    """
    side, angle, velocity = start.side, start.angle, start.velocity
    segment, half, phase = start.segment, start.half_cycles, start.phase
    impacts, flights = start.impacts, start.flights
    record, watch = len(rows) > 0, len(peaks) > 0
    last = len(segments) - 1

    loaded = -1  # the segment that the following belong to
    positive = side_forcing(segments, segment, sides, 1, 0.0)
    negative = positive
    frequency, sloped, endless = 0.0, False, False
    first_half, first_phase, end_half, end_phase = 0, 0.0, 0, 0.0
    sine, cosine, turned_side = 0.0, 1.0, False  # of the phase, known after an impact
    guess = -1.0
    rest_velocity = max(rest_velocity, STILL)
    bounced = False  # off an impact so slow that the block may be coming to rest

    while True:
        if flights >= limit:
            return UNDECIDED, March(side, angle, velocity, segment, half, phase, impacts, flights)
        if segment != loaded:
            if segments[segment, ALIKE] > 0.0 and phase == 0.0:
                # Into the first sample that needs what follows: an impact, an uplift, a doubt.
                if side == 0:
                    segment, flights = rest_through(segments, sides, segment, flights, limit, rows)
                else:
                    segment, angle, velocity, flights, fallen = fly_through(
                        segments, sides, side, angle, velocity, segment, flights, limit, rows, peaks
                    )
                    if fallen:
                        return OVERTURNED, March(
                            side, angle, velocity, segment, half, phase, impacts, flights
                        )
                if flights >= limit:
                    continue
            loaded = segment
            frequency = segments[segment, FREQUENCY]
            sloped = segments[segment, SLOPE] != 0.0
            endless = segments[segment, DURATION] == math.inf
            first_half, first_phase = segment_start(segments, segment)
            end_half, end_phase = stop_half_cycles, stop_phase
            if not endless:
                end_half, end_phase = segment_end(segments, segment)
            positive = side_forcing(segments, segment, sides, 1, 0.0)
            negative = side_forcing(segments, segment, sides, -1, 0.0)
        elif sloped:  # a slope is counted from the start of the flight
            since = elapsed_time(half, phase, first_half, first_phase, frequency)
            positive = side_forcing(segments, segment, sides, 1, since)
            negative = side_forcing(segments, segment, sides, -1, since)
        span = elapsed_time(end_half, end_phase, half, phase, frequency)

        # 1. At rest: wait for uplift, for the next segment, or for the end of the run.
        if side == 0:
            side, wait = next_uplift(positive, negative, sides, half, phase, frequency, span)
            if side != 0 and wait == 0.0:
                continue  # into flight, with angle and velocity 0
            if record:
                event = ENDED_BY_SPAN if side == 0 else ENDED_BY_UPLIFT
                write_row(rows, flights, segment, half, phase, 0, 0.0, 0.0, wait, event)
            flights += 1
            if side != 0:
                half, phase = uplift_clock(
                    half, phase, frequency, wait, side, positive if side > 0 else negative
                )
                continue
            half, phase = end_half, end_phase
            if segment == last:
                return AT_REST, March(0, 0.0, 0.0, segment, half, phase, impacts, flights)
            segment += 1
            half, phase = segment_start(segments, segment)
            velocity = segments[segment, JUMP]
            if velocity != 0.0:
                side = 1 if velocity > 0.0 else -1
                velocity *= sides[0 if side > 0 else 1, RATE] ** 2
            continue

        # 2. A flight, in the units of its side.
        row = 0 if side > 0 else 1
        lean, rate = sides[row, LEAN], sides[row, RATE]
        forcing = positive if side > 0 else negative
        seen_phase, seen_half = side_phase(half, phase, side, frequency)
        if not turned_side:
            sine, cosine = math.sin(seen_phase), math.cos(seen_phase)
        turned_side = False
        if bounced:
            bounced = False
            if chatter_ends(
                max(sides[0, RESTITUTION], sides[1, RESTITUTION]),
                abs(velocity) / (lean * rate),
                abs(velocity) / (sides[1 - row, LEAN] * sides[1 - row, RATE]),
                rate,
                sides[1 - row, RATE],
                span,
                forcing,
                negative if side > 0 else positive,
                seen_phase,
                sine,
            ):
                velocity = 0.0
                side = 0
                continue
        lifting = angle == 0.0 and velocity == 0.0
        flight = make_flight(
            forcing, side * angle / lean, side * velocity / (lean * rate), seen_phase, sine, cosine
        )
        zero = next_zero(flight, forcing, span * rate, endless, lifting, guess)
        if record:
            duration = math.inf if zero.event == NO_RETURN else zero.time / rate
            write_row(
                rows, flights, segment, half, phase, side, angle, velocity, duration, zero.event
            )
        flights += 1
        if watch:
            keep_peaks(flight, forcing, zero, lean, rate, peaks)
        if zero.event == NO_RETURN:
            return OVERTURNED, March(side, angle, velocity, segment, half, phase, impacts, flights)

        if zero.event == FOUND:
            # 3. Impact: the velocity shrinks, the pivot changes.
            impacts += 1
            guess = zero.time
            if frequency == 0.0:
                phase += zero.time / rate
            else:
                turned, phase = clock(zero.phase, seen_half)
                half += turned - seen_half + 2 * zero.cycle
                sine, cosine, turned_side = -zero.sine, -zero.cosine, True
            velocity = sides[row, RESTITUTION] * side * zero.velocity * lean * rate
            angle = 0.0
            side = -side
            bounced = abs(velocity) <= rest_velocity
            continue

        # 4. The segment or the run ended in mid flight.
        angle = side * zero.angle * lean
        velocity = side * zero.velocity * lean * rate
        if zero.angle <= 0.0:  # it has only just lifted off, and rounding put it into the floor
            angle, velocity = 0.0, side * max(zero.velocity, 0.0) * lean * rate
        half, phase = end_half, end_phase
        if segment == last:
            return ROCKING, March(side, angle, velocity, segment, half, phase, impacts, flights)
        segment += 1
        half, phase = segment_start(segments, segment)
        # An impulse of the base turns each side by its own p^2, as any acceleration does.
        velocity += segments[segment, JUMP] * (rate * rate)
        if angle == 0.0:  # the velocity alone says where it goes
            side = int(np.sign(velocity))
        if abs(angle) > lean + segments[segment, CEILING] and velocity * side >= 0.0:
            # Nothing that is still to come can bring it back.
            return OVERTURNED, March(side, angle, velocity, segment, half, phase, impacts, flights)
        guess = -1.0


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
    """Return the side that lifts first and when; side 0 and `span` where none lifts before that."""
    if span <= 0.0:
        return 0, 0.0
    plus_phase, _ = side_phase(half, phase, 1, frequency)
    minus_phase, _ = side_phase(half, phase, -1, frequency)
    plus = uplift_time(positive, plus_phase, span * sides[0, RATE]) / sides[0, RATE]
    minus = uplift_time(negative, minus_phase, span * sides[1, RATE]) / sides[1, RATE]
    if min(plus, minus) >= span:
        return 0, span
    return (1, plus) if plus <= minus else (-1, minus)


@compiled
def uplift_clock(
    half: int, phase: float, frequency: float, wait: float, side: int, forcing: Forcing
) -> tuple[int, float]:
    """Return the clock reading after a wait for uplift; exact where the node has a closed form."""
    if frequency == 0.0:
        return half, phase + wait
    if forcing.kind != SINE:
        turned, phase = clock(phase + frequency * wait)
        return half + turned, phase
    seen_phase, seen_half = side_phase(half, phase, side, frequency)
    turned, phase = clock(forcing.rising)
    if forcing.rising < seen_phase:
        turned += 2
    return half + turned - seen_half, phase


@inlined
def chatter_ends(
    restitution: float,
    speed_here: float,
    speed_there: float,
    rate_here: float,
    rate_there: float,
    span: float,
    forcing_here: Forcing,
    forcing_there: Forcing,
    seen_phase: float,
    sine: float,
) -> bool:
    """Return whether the bounces that start now are proved to die out within `span`.

    `seen_phase` and its `sine` are those of the forcing seen from the side of the first bounce.
    """
    if speed_here < STILL:
        return True
    # Most impacts are told apart here.  The bound needs shaking below uplift and, with the pull of
    # now in place of the least one to come, bounces that shrink.
    pull_here = -(forcing_here.constant + forcing_here.amplitude * sine)
    pull_there = -(forcing_there.constant - forcing_there.amplitude * sine)
    if pull_here <= speed_here or pull_there <= speed_there:
        return False
    shrunk = restitution * restitution
    drift_here = 4.0 * steepest_forcing(forcing_here) * speed_here
    drift_there = 4.0 * steepest_forcing(forcing_there) * speed_there
    if (
        shrunk * (pull_here * pull_here + drift_here) >= pull_here * pull_here
        or shrunk * (pull_there * pull_there + drift_there) >= pull_there * pull_there
    ):
        return False
    phase_there = seen_phase + math.pi if seen_phase < HALF_PI else seen_phase - math.pi
    return settles(
        restitution,
        span,
        forcing_here,
        seen_phase,
        speed_here,
        rate_here,
        forcing_there,
        phase_there,
        speed_there,
        rate_there,
    )


@compiled
def keep_peaks(
    flight: Flight, forcing: Forcing, zero: Zero, lean: float, rate: float, peaks: Floats
) -> None:
    """Raise `peaks` to the largest angle and speed of a flight, in reference units."""
    top_angle, top_speed = peaks[PEAK_ANGLE] / lean, peaks[PEAK_SPEED] / (lean * rate)
    angle, speed = flight_peaks(
        flight, forcing, zero.time, zero.angle, zero.velocity, top_angle, top_speed
    )
    peaks[PEAK_ANGLE] = max(peaks[PEAK_ANGLE], angle * lean)
    peaks[PEAK_SPEED] = max(peaks[PEAK_SPEED], speed * lean * rate)
