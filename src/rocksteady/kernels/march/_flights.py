"""Loop of the march, from flight to flight, compiled once for each model.

It is inlined with the model as a constant, so that the linear one keeps its speed.  Divisions and
logarithms that few flights need are in functions of their own, because the compiler hoists them
into every flight otherwise.  Searches called once a flight are inlined, which saves copying tuples.
"""

import math

import numpy as np

from rocksteady.kernels.core.clock import (
    elapsed_time,
    later_clock,
    segment_end,
    segment_start,
    side_clock,
    side_phase,
    uplift_clock,
)
from rocksteady.kernels.core.forcing import make_forcing, side_forcing
from rocksteady.kernels.core.harmonics import fill_lifts, level_of
from rocksteady.kernels.core.impacts import rebound
from rocksteady.kernels.core.rides import is_held
from rocksteady.kernels.core.scatter import is_scattered, largest_restitution, restitution_of
from rocksteady.kernels.core.tables import (
    ALIKE,
    AT_REST,
    CEILING,
    COUNTED,
    DURATION,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    FOUND,
    FREQUENCY,
    JUMP,
    LEAN,
    LIFT,
    LIFT_CEILING,
    LOST_CONTACT,
    NO_RETURN,
    OVERTURNED,
    PASSAGE_COLUMNS,
    PEAK_ANGLE,
    PEAK_SPEED,
    RATE,
    RESTITUTION,
    ROCKING,
    SHARES,
    SLOPE,
    STALLED,
    UNDECIDED,
    Floats,
    March,
    Rise,
    end_of_run,
    free_side,
    is_series,
    keep_passage,
    left_out_of,
    write_row,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.core.typed import MINUS_ONE, ONE, ZERO
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.linear.extrema import keep_peaks
from rocksteady.kernels.linear.flight import make_flight
from rocksteady.kernels.linear.zeros import next_zero
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.march._runs import fly_on, rest_on
from rocksteady.kernels.march.rest import (
    STILL,
    Bounce,
    chatter_ends,
    impacts_on_still_base,
    next_uplift,
    series_uplift,
)
from rocksteady.kernels.nonlinear.drive import (
    SteppedFlight,
    foot_forcing,
    jump_share,
    loss_of_contact,
    side_drive,
)
from rocksteady.kernels.nonlinear.flight import fly
from rocksteady.kernels.nonlinear.proofs import bounces_settle, point_of_no_return, stepped_bounce
from rocksteady.kernels.nonlinear.series import load_shares


@inlined
def march_in_model(
    tables: Tables,
    start: March,
    until: Until,
    kept: Kept,
    work: Floats,
    lifts: Floats,
    ride: Floats,
    nonlinear: bool,
    periodic: bool,
) -> tuple[int, March]:
    """March; inlined once for each model, so that each loop holds the branches of its own alone.

    A third one is `periodic`: it holds those of both models, and of a Fourier series.  With a
    `ride` of `kernels.core.rides` the march ends as soon as that holds a flight.
    """
    segments, sides = tables
    stop_half_cycles, stop_phase, rest_velocity, limit = until
    rows, peaks = kept
    side, angle, velocity, segment, half, phase, impacts, flights = start
    record, watch, keeps = len(rows) > 0, len(peaks) > 0, len(peaks) >= PASSAGE_COLUMNS
    scattered, free = is_scattered(sides), free_side(sides)
    last = len(segments) - 1
    summed = rest_velocity >= COUNTED  # impacts on a still base are, and need no flights
    # Lanes, which leave chatter out at any speed, tell periods by the number of all impacts.
    slowest = COUNTED if rest_velocity < math.inf else 0.0
    rest_velocity = max(rest_velocity, STILL)
    still = False  # the base, for ever
    since, contact_lost = 0.0, math.inf  # nonlinear model: time on the segment, and to its loss

    loaded = -1  # the segment that the following belong to
    positive = negative = make_forcing(0.0, 0.0, 0.0, 0.0)
    frequency, sloped, endless = 0.0, False, False
    first_half, first_phase, end_half, end_phase = ZERO, 0.0, ZERO, 0.0
    sine, cosine, turned_side = 0.0, 1.0, False  # of the phase, known after an impact
    guess = -1.0
    series = False  # the segment is one: flights are steps, and the phase is that of the base
    bounced = False  # off an impact so slow that the block may be coming to rest

    while True:
        if flights >= limit:
            return UNDECIDED, March(side, angle, velocity, segment, half, phase, impacts, flights)
        if segments[segment, ALIKE] > 0.0 and not bounced and (side != 0 or phase == 0.0):
            # Into the first sample that needs what follows: an uplift, a doubt, an end of chatter.
            behind = end_of_run(segments, segment)
            state = March(side, angle, velocity, segment, half, phase, impacts, flights)
            if side == 0:
                segment, flights = rest_on(tables, segment, flights, limit, rows, nonlinear)
            else:
                resting = Until(stop_half_cycles, stop_phase, rest_velocity, limit)
                state, fallen, bounced = fly_on(tables, state, resting, kept, work, ride, nonlinear)
                side, angle, velocity, segment, half, phase, impacts, flights = state
                if fallen:
                    return OVERTURNED, state
                if is_held(ride):
                    return UNDECIDED, state
            if segment == behind:
                half, phase = segment_start(segments, segment)
                continue
            if flights >= limit:
                continue
        if segment != loaded:
            loaded = segment
            frequency = segments[segment, FREQUENCY]
            sloped = segments[segment, SLOPE] != 0.0
            contact_lost = loss_of_contact(segments, segment) if nonlinear else math.inf
            endless = segments[segment, DURATION] == math.inf
            still = endless and segments[segment, CEILING] == 0.0
            if nonlinear:
                still &= segments[segment, LIFT] == 0.0 and segments[segment, LIFT_CEILING] == 0.0
            first_half, first_phase = segment_start(segments, segment)
            end_half, end_phase = stop_half_cycles, stop_phase
            if not endless:
                end_half, end_phase = segment_end(segments, segment)
            # Not 0 where the march begins within a segment.
            since = elapsed_time(half, phase, first_half, first_phase, frequency)
            if not nonlinear:
                positive = side_forcing(segments, segment, sides, ONE, since)
                negative = side_forcing(segments, segment, sides, MINUS_ONE, since)
            if periodic:
                series = is_series(segments, segment)
                if series:
                    if nonlinear:
                        positive = foot_forcing(side_drive(segments, segment, sides, ONE, since))
                        negative = foot_forcing(
                            side_drive(segments, segment, sides, MINUS_ONE, since)
                        )
                    load_shares(segments[segment, SHARES:], work)
                    fill_lifts(segments[segment, SHARES:], 1.0, level_of(positive), lifts[0])
                    fill_lifts(segments[segment, SHARES:], -1.0, level_of(negative), lifts[1])
        elif sloped or nonlinear:
            since = elapsed_time(half, phase, first_half, first_phase, frequency)
            if not nonlinear:  # a slope is counted from the start of the flight
                positive = side_forcing(segments, segment, sides, ONE, since)
                negative = side_forcing(segments, segment, sides, MINUS_ONE, since)
        span = elapsed_time(end_half, end_phase, half, phase, frequency)
        leaving = nonlinear and contact_lost - since < span
        if leaving:
            span = max(contact_lost - since, 0.0)

        # 1. At rest: wait for uplift, for the next segment, or for the end of the run.
        if side == 0:
            lifted_half, lifted_phase = half, phase
            if series:
                side, wait, lifted_half, lifted_phase = series_uplift(
                    positive, negative, free, segments[segment, SHARES:], lifts, half, phase
                )
                wait /= frequency
                if wait >= span:
                    side, wait = 0, span
            else:
                if nonlinear:
                    positive = foot_forcing(side_drive(segments, segment, sides, ONE, since))
                    negative = foot_forcing(side_drive(segments, segment, sides, MINUS_ONE, since))
                side, wait = next_uplift(positive, negative, sides, half, phase, frequency, span)
            if side != 0 and wait == 0.0:
                continue  # into flight, with angle and velocity 0
            if record:
                event = ENDED_BY_SPAN if side == 0 else ENDED_BY_UPLIFT
                state = March(0, 0.0, 0.0, segment, half, phase, impacts, flights)
                write_row(rows, state, wait, event)
            flights += 1
            if side != 0 and series:
                half, phase = lifted_half, lifted_phase
                continue
            if side != 0:
                half, phase = uplift_clock(
                    half, phase, frequency, wait, side, positive if side > 0 else negative
                )
                continue
            if leaving:
                half, phase = later_clock(half, phase, frequency, wait)
                return LOST_CONTACT, March(0, 0.0, 0.0, segment, half, phase, impacts, flights)
            half, phase = end_half, end_phase
            if segment == last:
                return AT_REST, March(0, 0.0, 0.0, segment, half, phase, impacts, flights)
            segment += 1
            half, phase = segment_start(segments, segment)
            velocity = segments[segment, JUMP]
            if velocity * free < 0.0:  # an impulse into the wall, as any push, moves nothing
                velocity = 0.0
            if velocity != 0.0:
                side = 1 if velocity > 0.0 else -1
                rate = sides[0 if side > 0 else 1, RATE]
                velocity *= rate * rate
                if nonlinear:
                    velocity *= jump_share(sides, side, 0.0)
            continue

        # 2. A flight, in the units of its side.
        row = 0 if side > 0 else 1
        next_side = -side if free == 0 else side  # after an impact
        next_row = 0 if next_side > 0 else 1
        lean, rate = sides[row, LEAN], sides[row, RATE]
        forcing = positive if side > 0 else negative
        stepped = nonlinear or series
        seen_phase, seen_half = side_phase(half, phase, ONE if series else side, frequency)
        if not turned_side:
            sine, cosine = 0.0, 1.0
            if frequency != 0.0:
                sine, cosine = sincos_near(seen_phase)
        turned_side = False
        if bounced:
            bounced = False
            highest = peaks[PEAK_ANGLE] if watch else math.inf
            if stepped:
                there_phase, _ = side_phase(half, phase, ONE if series else next_side, frequency)
                dies_out = abs(velocity) < STILL * lean * rate or bounces_settle(
                    largest_restitution(sides),
                    span,
                    stepped_bounce(tables, segment, side, since, abs(velocity), seen_phase),
                    stepped_bounce(tables, segment, next_side, since, abs(velocity), there_phase),
                    highest,
                    segments[segment, SHARES:],
                )
            else:
                there = sides[next_row, LEAN] * sides[next_row, RATE]
                opposite = positive if next_side > 0 else negative
                dies_out = chatter_ends(
                    largest_restitution(sides),
                    span,
                    Bounce(forcing, seen_phase, abs(velocity) / (lean * rate), rate),
                    Bounce(opposite, seen_phase, abs(velocity) / there, sides[next_row, RATE]),
                    sine,
                    next_side != side,
                    highest,
                )
            if dies_out:
                if still:
                    impacts = impacts_on_still_base(
                        sides, side, abs(velocity), impacts, limit - flights
                    )
                velocity = 0.0
                side = 0
                continue
        state = March(side, angle, velocity, segment, half, phase, impacts, flights)
        top_angle = top_speed = 0.0
        if keeps:
            top_angle, top_speed = peaks[PEAK_ANGLE], peaks[PEAK_SPEED]
        lifting = angle == 0.0 and velocity == 0.0
        y, v = side * angle / lean, side * velocity / (lean * rate)
        if stepped:
            # What is still to come bounds the linear motion on segments that end, too.
            lasting = endless or (series and not nonlinear)
            lost = point_of_no_return(segments, segment, sides, side) if lasting else math.inf
            drive = side_drive(segments, segment, sides, side, since)
            stepping = SteppedFlight(drive, seen_phase, y, v, span * rate, left_out_of(sides))
            zero = fly(stepping, lasting, lost, lifting, peaks, lean, rate, work, work[:0])
            duration = zero.time / rate
            if zero.event == STALLED:
                return UNDECIDED, state
        else:
            flight = make_flight(forcing, y, v, seen_phase, sine, cosine)
            zero = next_zero(flight, forcing, span * rate, endless, lifting, guess)
            duration = math.inf if zero.event == NO_RETURN else zero.time / rate
            if watch:
                keep_peaks(flight, forcing, zero, lean, rate, peaks)
        if record:
            write_row(rows, state, duration, zero.event)
        flights += 1
        if keeps and zero.event != FOUND:
            later = math.inf if zero.event == NO_RETURN else zero.angle
            ceiling = segments[segment, CEILING] / lean
            rise = Rise(y, side * velocity, later, span * rate, ceiling)
            keep_passage(peaks, state, top_angle, top_speed, rise)
        if zero.event == NO_RETURN:
            return OVERTURNED, March(side, angle, velocity, segment, half, phase, impacts, flights)

        if zero.event == FOUND:
            # 3. Impact: the velocity is multiplied by the restitution (eq 9), the pivot changes.
            # A wall's restitution is negative: the block turns back about the pivot that it has.
            guess = zero.time
            if frequency == 0.0:
                phase += zero.time / rate
            else:
                turned, phase = side_clock(zero.phase, seen_half)
                half += turned - seen_half + 2 * zero.cycle
                sine, cosine, turned_side = zero.sine, zero.cosine, True
                if free == 0:
                    sine, cosine = -sine, -cosine
            side, velocity, impacts, bounced = rebound(
                sides, side, zero.velocity, impacts, rest_velocity
            )
            angle = 0.0
            if still and (summed or flights + 1 >= limit):
                bounced = True
            continue

        # 4. The segment or the run ended in mid flight.
        angle = side * zero.angle * lean
        velocity = side * zero.velocity * lean * rate
        if zero.angle <= 0.0:  # it has only just lifted off, and rounding put it into the floor
            angle, velocity = 0.0, side * max(zero.velocity, 0.0) * lean * rate
        if leaving:
            half, phase = later_clock(half, phase, frequency, span)
            return LOST_CONTACT, March(
                side, angle, velocity, segment, half, phase, impacts, flights
            )
        half, phase = end_half, end_phase
        if segment == last:
            return ROCKING, March(side, angle, velocity, segment, half, phase, impacts, flights)
        segment += 1
        half, phase = segment_start(segments, segment)
        # An impulse of the base turns each side by its own p^2, as any acceleration does.
        jump = segments[segment, JUMP] * (rate * rate)
        beyond = lean + segments[segment, CEILING]
        if nonlinear:
            if jump != 0.0:
                jump *= jump_share(sides, side, side * angle / lean)
            if abs(angle) > lean:  # nearer than the point of balance it is not lost
                beyond = lean * point_of_no_return(segments, segment, sides, side)
        velocity += jump
        if angle == 0.0:  # the velocity alone says where it goes
            side = int(np.sign(velocity))
            if side * free < 0:  # into the wall
                turned_back = sides[row, RESTITUTION]
                if scattered:
                    turned_back = restitution_of(sides, row, impacts + 1)
                velocity *= turned_back
                if abs(velocity) >= slowest * (lean * rate):
                    impacts += 1
                side = free if velocity != 0.0 else 0
        if abs(angle) > beyond and velocity * side >= 0.0:
            # Nothing that is still to come can bring it back.
            return OVERTURNED, March(side, angle, velocity, segment, half, phase, impacts, flights)
        guess = -1.0
