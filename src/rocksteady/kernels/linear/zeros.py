"""First zero of a linear flight, isolated without sampling, so that it cannot be missed.

Let ``F = +-y`` be positive at the start, ``q = +-r`` its forcing (``F'' = F + q``) and
``g = F + F'``.  Then ``(e^-t g)' = e^-t q`` and ``(e^t F)' = e^t g``.  Between two nodes, where q
keeps its sign, e^-t g is monotone, so g changes sign at most once there; and while g keeps its
sign, e^t F is monotone.  From node to node, therefore:

* q < 0: e^t F may rise and then falls, or just falls.  A zero exists iff F(end) <= 0, and it is
  the only one.
* q > 0, entered with g >= 0: g stays positive, e^t F rises, no zero.
* q > 0, entered with g < 0: F is convex while it is positive.  F(end) <= 0: one first zero.
  Otherwise F can only dip and come back, for which F'(end) > 0 is needed; Newton's method from the
  left on a convex function never steps over its first zero, and either converges to it (grazing
  included) or reaches F' >= 0 (no contact).
* It never returns when F > 0, G > 0 and ``2 G e^t >= swing + constant``, since then
  ``g = 2 G e^t - constant - beta (sin psi + Omega cos psi) > 0`` for ever.

The last test follows the others at each node: before them it would lose impacts.  ``docs/theory``
has the proof in full; ``tests/kernels/linear/test_zeros.py`` holds it against an oracle that steps
below the parabola F'' >= -1 - max |a|.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core.forcing import (
    LINE,
    ONE_SIGN,
    SINE,
    TWO_PI,
    Forcing,
    mixed_node,
    starts_positive,
)
from rocksteady.kernels.core.tables import FOUND, NO_RETURN, SPAN_END
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.elementary.exponential import exp_clamped
from rocksteady.kernels.elementary.lengths import next_up
from rocksteady.kernels.elementary.logarithm import log1p
from rocksteady.kernels.linear.flight import (
    Flight,
    flight_acceleration,
    flight_state,
)
from rocksteady.kernels.machine_code.compilation import compiled, inlined

# A step of the reverted series is final once each of its terms is below 1e-3 of the one before,
# and the forcing turns little on the way.  The first term left out has coefficient 42: it is 4e-14
# of a step that is itself 2e-3 of |F'/F''| at most.
LARGEST_TURN = 0.03
ROTATION = 1e-3  # largest angle through which a sine and cosine are turned by polynomial
# Every fourth step halves the bracket, so that a long piece is crossed too: F grows like e^t over
# it, and Newton's method advances by one unit of time a step.
ITERATIONS = 400
# Newton from the left advances by at least about one unit of time a step where F decays like e^-t.
DIP_ITERATIONS = 10_000_000
GUESSES = 3  # steps from a guess before the end of the piece is asked


class Zero(NamedTuple):
    """Where a search ended: at the first zero, at the end of the span, or with no return proved."""

    event: int
    time: float
    cycle: int  # whole turns of the forcing since the start ...
    phase: float  # ... and the phase beyond them, in [-pi/2, 3 pi/2 + 2 pi)
    sine: float
    cosine: float
    angle: float
    velocity: float


class Piece(NamedTuple):
    """What lies between two nodes."""

    sign: float  # of y, which F has not
    cycle: int  # whole turns of the forcing before it
    start: float
    start_phase: float
    end: float


@inlined
def next_zero(
    flight: Flight, forcing: Forcing, span: float, endless: bool, lifting: bool, guess: float
) -> Zero:
    """Find the first zero of a flight after its start and up to `span`.

    A zero of the initial angle itself does not count.  `endless` says that the forcing goes on for
    ever, so that "no return" may be concluded; `lifting` that the block lifts off from rest at this
    instant, so that it starts into positive forcing whatever rounding says.  `guess` is a time near
    which the zero may be; it changes how fast it is found and not which.
    """
    angle, velocity, phase = flight.angle, flight.velocity, flight.phase
    if lifting:
        sign, positive = 1.0, True
    else:
        sign = 1.0
        if angle < 0.0 or (angle == 0.0 and velocity < 0.0):
            sign = -1.0
        positive = starts_positive(forcing, phase)
        if angle == 0.0 and velocity == 0.0 and not positive:
            sign = -1.0
    growing = sign * flight.parts.growing

    if span <= 0.0:  # rounding put an impact on or past the end
        return Zero(SPAN_END, 0.0, 0, phase, flight.sine, flight.cosine, angle, velocity)
    if endless and no_return(flight, forcing, sign, 0.0, angle, velocity):
        return Zero(NO_RETURN, 0.0, 0, phase, flight.sine, flight.cosine, angle, velocity)

    # The piece [start, end] between two nodes, and the state at its start.
    start, start_phase, cycle = 0.0, phase, ZERO
    end_phase, end_cycle = phase, 0
    sine, cosine = flight.sine, flight.cosine
    while True:
        # 1. The end of this piece.
        to_span = settled = False
        if forcing.kind == SINE:
            if positive:
                end_phase = math.pi - forcing.rising
                sine, cosine = forcing.node_sine, -forcing.node_cosine
            else:
                end_phase = forcing.rising
                sine, cosine = forcing.node_sine, forcing.node_cosine
                if phase > end_phase or cycle > 0 or start > 0.0:
                    end_cycle = cycle + 1
            end = ((end_phase - phase) + TWO_PI * end_cycle) / forcing.frequency
            if end >= span:
                to_span = True
        elif forcing.kind == ONE_SIGN:
            end, to_span = span, True
        elif forcing.kind == LINE:
            root = -forcing.constant / forcing.slope
            end, to_span = root, False
            if not (start < root < span):
                end, to_span = span, True
        else:
            end = mixed_node(forcing, phase, start, positive, span)
            to_span = end >= span
        if to_span:
            end = min(end, span)

        # 2. Is there a zero in it?  A guess that leads to one settles the matter where q < 0.
        up = positive == (sign > 0.0)  # q > 0
        if not up and start < guess < end:
            near = guess
            for _ in range(GUESSES):
                step = series_step(flight, forcing, sign, start, start_phase, near)
                if not (start < step.time <= end):
                    break
                if step.final:
                    return zero_at(step, cycle)
                near = step.time
        if forcing.kind == ONE_SIGN and endless:
            late = settling_time(flight, forcing)
            if late < span:
                end, settled = late, True
        if to_span or forcing.kind != SINE:
            end_cycle = cycle
            end_phase = start_phase + forcing.frequency * (end - start)
            sine, cosine = sine_cosine(forcing, end_phase)
        end_angle, end_velocity = flight_state(flight, forcing, end, sine, cosine)
        bracketed = sign * end_angle <= 0.0
        if not up:
            found = bracketed
        elif sign * (angle + velocity) >= 0.0:
            found = False
        elif bracketed:
            found = True
        else:
            found = False
            if sign * end_velocity > 0.0 and tangents_meet_below(
                sign * angle, sign * velocity, sign * end_angle, sign * end_velocity, end - start
            ):
                piece = Piece(sign, cycle, start, start_phase, end)
                dip = dip_contact(flight, forcing, piece, angle, velocity)
                if dip.event == FOUND:
                    return dip
        if found:
            piece = Piece(sign, cycle, start, start_phase, end)
            return polished(flight, forcing, piece, end_angle, end_velocity)

        # 3. No: on to the next piece, unless none can follow.
        if settled and growing == 0.0:  # balanced for ever: neither falls nor comes back
            end = span
            return Zero(SPAN_END, end, end_cycle, end_phase, sine, cosine, end_angle, end_velocity)
        if settled or (endless and no_return(flight, forcing, sign, end, end_angle, end_velocity)):
            return Zero(NO_RETURN, end, end_cycle, end_phase, sine, cosine, end_angle, end_velocity)
        if to_span:
            return Zero(SPAN_END, end, end_cycle, end_phase, sine, cosine, end_angle, end_velocity)
        start, start_phase, cycle = end, end_phase, end_cycle
        angle, velocity = end_angle, end_velocity
        positive = not positive


@compiled
def settling_time(flight: Flight, forcing: Forcing) -> float:
    """Return a time from which the growing part outweighs all the rest, for a single endless piece.

    From there on F keeps its sign.
    """
    growing, reference = abs(flight.parts.growing), flight.parts.reference
    rest = abs(flight.parts.decaying) + abs(forcing.constant) + forcing.beta + forcing.swing
    late = 50.0 + log1p(rest) if growing == 0.0 else reference + log1p(rest / growing)
    return max(late, 0.0) + 1e-3


@inlined
def no_return(
    flight: Flight, forcing: Forcing, sign: float, time: float, angle: float, velocity: float
) -> bool:
    """Return whether F > 0 now and g > 0 for ever after, on an endless forcing without slope."""
    growing = sign * flight.parts.growing
    if growing <= 0.0 or forcing.slope != 0.0:
        return False
    if sign * angle < 0.0 or (angle == 0.0 and sign * velocity <= 0.0):
        return False
    up = 2.0 * growing * exp_clamped(time - flight.parts.reference)
    return up >= forcing.swing + sign * forcing.constant


@compiled
def tangents_meet_below(
    left: float, left_slope: float, right: float, right_slope: float, width: float
) -> bool:
    """Return whether the end tangents of a dipping F cross at or below zero.

    Up to its first zero F is convex and lies above its left tangent, from its last zero on above
    the right one: were there zeros, the tangents would cross below.  `docs/theory` has the proof.
    """
    crossing = (right - left - right_slope * width) / (left_slope - right_slope)
    return left + left_slope * crossing <= 0.0


@compiled
def dip_contact(
    flight: Flight, forcing: Forcing, piece: Piece, angle: float, velocity: float
) -> Zero:
    """Newton from the left on the convex F, from a state at its start: its first zero, or none."""
    sign, cycle, start, start_phase, end = piece
    time, phase = start, start_phase
    sine, cosine = flight.sine, flight.cosine
    angle, velocity = sign * angle, sign * velocity
    for _ in range(DIP_ITERATIONS):
        if velocity >= 0.0:
            break
        later = time - angle / velocity
        if later <= time and angle > 0.0:
            later = next_up(time)  # a step too small to move: count it
        if later > end:
            break
        stuck = later - time <= 4e-16 * later
        time = later
        phase = start_phase + forcing.frequency * (time - start)
        sine, cosine = sine_cosine(forcing, phase)
        angle, velocity = flight_state(flight, forcing, time, sine, cosine)
        angle, velocity = sign * angle, sign * velocity
        if angle <= 0.0 or (stuck and velocity < 0.0):
            return Zero(FOUND, time, cycle, phase, sine, cosine, 0.0, sign * min(velocity, 0.0))
    return Zero(SPAN_END, time, cycle, phase, sine, cosine, sign * angle, sign * velocity)


@inlined
def polished(
    flight: Flight, forcing: Forcing, piece: Piece, end_angle: float, end_velocity: float
) -> Zero:
    """Polish the one descending zero between `start` and `end`, where F > 0 and F <= 0."""
    sign, cycle, start, start_phase, end = piece
    low, high = start, end
    # From the far end, where a falling F is usually concave; or, for a short bounce, from the
    # parabola that it nearly is.
    time = end - end_angle / end_velocity if sign * end_velocity < 0.0 else low
    if start == 0.0 and flight.angle == 0.0:
        pull = flight_acceleration(forcing, 0.0, 0.0, flight.sine)
        if sign * pull < 0.0:
            bounce = -2.0 * flight.velocity / pull
            if bounce < 0.1 and forcing.frequency * bounce < 0.5:
                time = bounce
    for iteration in range(ITERATIONS):
        if iteration % 4 == 3 or not (low < time < high):
            time = 0.5 * (low + high)
            if time <= low or time >= high:
                break  # no number lies between them
        step = series_step(flight, forcing, sign, start, start_phase, time)
        if step.final and low <= step.time <= high:
            return zero_at(step, cycle)
        if sign * step.angle > 0.0:
            low = time
        else:
            high = time
        time = step.time
    time = high
    phase = start_phase + forcing.frequency * (time - start)
    sine, cosine = sine_cosine(forcing, phase)
    _, velocity = flight_state(flight, forcing, time, sine, cosine)
    return Zero(FOUND, time, cycle, phase, sine, cosine, 0.0, velocity)


class Step(NamedTuple):
    """One step towards a zero: where it leads, and the angle at the point that it left."""

    final: bool  # the step landed on the zero, to rounding; what follows holds there
    time: float
    phase: float
    sine: float
    cosine: float
    velocity: float
    angle: float


@inlined
def zero_at(step: Step, cycle: int) -> Zero:
    """Return the zero on which a step has landed, so many whole turns after the start."""
    return Zero(FOUND, step.time, cycle, step.phase, step.sine, step.cosine, 0.0, step.velocity)


@inlined
def series_step(
    flight: Flight, forcing: Forcing, sign: float, start: float, start_phase: float, time: float
) -> Step:
    """Step from `time` towards a descending zero of F.

    Taylor's series of F is reverted to fifth order; its derivatives cost nothing, since
    ``F'' = F + q`` and those of q are known.  Where the series does not converge fast enough it is
    a step of Newton's method, and where F does not fall it leads nowhere.
    """
    phase = start_phase + forcing.frequency * (time - start)
    sine, cosine = sine_cosine(forcing, phase)
    y, v = flight_state(flight, forcing, time, sine, cosine)
    if sign * v >= 0.0:
        return Step(False, -1.0, phase, sine, cosine, v, y)
    w2 = forcing.frequency * forcing.frequency
    swing = forcing.amplitude * sine
    swing_rate = forcing.amplitude * forcing.frequency * cosine
    d2 = y + forcing.constant + forcing.slope * time + swing
    d3 = v + forcing.slope + swing_rate
    d4 = d2 - w2 * swing
    d5 = d3 - w2 * swing_rate
    newton, step, speed, exact = reverted(y, v, d2, d3, d4, d5)
    if not (exact and abs(forcing.frequency * newton) < LARGEST_TURN):
        return Step(False, time + step, phase, sine, cosine, v, y)
    v = speed
    turn = forcing.frequency * step
    phase += turn
    if abs(turn) > ROTATION:
        sine, cosine = sine_cosine(forcing, phase)
    else:
        square = turn * turn
        turn -= turn * square * (1.0 / 6.0) * (1.0 - square * (1.0 / 20.0))
        loss = square * (1.0 / 2.0) * (1.0 - square * (1.0 / 12.0))
        sine, cosine = (
            sine + (cosine * turn - sine * loss),
            cosine - (sine * turn + cosine * loss),
        )
    return Step(True, time + step, phase, sine, cosine, v, y)


@inlined
def reverted(
    y: float, v: float, d2: float, d3: float, d4: float, d5: float
) -> tuple[float, float, float, bool]:
    """Return Newton's step towards a zero, that of the reverted series, and the speed there.

    The last value tells whether the step lands on the zero, to rounding; the speed holds only then.
    """
    inverse = 1.0 / v
    z = -y * inverse
    z2 = z * z
    a2 = d2 * inverse * (z * (1.0 / 2.0))
    a3 = d3 * inverse * (z2 * (1.0 / 6.0))
    if abs(a2) > 0.1 or abs(a3) > 0.01:
        return z, z, v, False
    a4 = d4 * inverse * (z * z2 * (1.0 / 24.0))
    a5 = d5 * inverse * (z2 * z2 * (1.0 / 120.0))
    step = z * reversion(a2, a3, a4, a5)
    exact = abs(a2) < 1e-3 and abs(a3) < 1e-6 and abs(a4) < 1e-9 and abs(a5) < 1e-12
    v += step * (
        (d2 + step * (d3 * (1.0 / 2.0)))
        + step * step * (d4 * (1.0 / 6.0) + step * (d5 * (1.0 / 24.0)))
    )
    return z, step, v, exact


class Search(NamedTuple):
    """A search for the one zero of F between two times, where it falls from above 0."""

    low: float
    high: float
    time: float  # to look at next
    found: bool  # at that time, with this speed
    speed: float


@inlined
def looked_at(
    search: Search, time: float, y: float, v: float, d2: float, d3: float, d4: float, d5: float
) -> Search:
    """Return a search after a look at F and its derivatives at a time within its bracket."""
    low, high, _, _, _ = search
    near = -1.0
    if v < 0.0:
        _, step, speed, exact = reverted(y, v, d2, d3, d4, d5)
        near = time + step
        if exact and low <= near <= high:
            return Search(low, high, near, True, min(speed, 0.0))
    if y > 0.0:
        low = time
    else:
        high = time
    return Search(low, high, near, False, v)


@inlined
def place_in(search: Search, iteration: int) -> float:
    """Return the time to look at: that of the search, or now and then the middle of it."""
    if iteration & 3 == 3 or not (search.low < search.time < search.high):
        return 0.5 * (search.low + search.high)
    return search.time


@inlined
def sine_cosine(forcing: Forcing, phase: float) -> tuple[float, float]:
    """Return sine and cosine of the phase, of which a forcing without sinusoid needs none."""
    if forcing.amplitude == 0.0:
        return 0.0, 1.0
    return sincos_short(phase)


@inlined
def reversion(a2: float, a3: float, a4: float, a5: float) -> float:
    """Return x / z where x - z + a2 x^2/z + a3 x^3/z^2 + ... = 0, to fifth order in z.

    With ``a_n = y^(n) z^(n-1) / (n! y')`` and ``z = -y/y'`` each a_n is small of order n - 1.
    """
    square = a2 * a2
    small = (6.0 * a2 * a4 - a5) + (3.0 * a3 * a3 + 7.0 * square * (2.0 * square - 3.0 * a3))
    return (1.0 - a2) + ((2.0 * square - a3) + ((5.0 * a2 * (a3 - square) - a4) + small))
