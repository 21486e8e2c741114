"""Slow, independent answers to what the kernels compute fast.

Nothing here calls a kernel.  There are three: a search for the first zero of a flight that steps
below a parabola (compiled, float64), the same and a whole march in 50 digits (mpmath), and a march
by an adaptive integrator of differential equations (scipy).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import mpmath
import numba
import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

mp = mpmath.mp.clone()
mp.dps = 110  # the closed form of a bounce of velocity 1e-30 cancels 60 of them

Floats = NDArray[np.float64]
Number = Any  # of mpmath, which has no types


# --------------------------------------------------------------- the first zero, in float64


@numba.njit(error_model="numpy")
def flight_in_double(
    constant: float,
    slope: float,
    amplitude: float,
    frequency: float,
    angle: float,
    velocity: float,
    phase: float,
    time: float,
) -> tuple[float, float]:
    """Angle and velocity at `time` of y'' = y + constant + slope t + amplitude sin(psi)."""
    beta = amplitude / (1.0 + frequency * frequency)
    a = velocity + slope + beta * frequency * math.cos(phase)
    b = angle + constant + beta * math.sin(phase)
    half = math.sinh(0.5 * time)
    rise, sinh = 2.0 * half * half, math.sinh(time)
    turn = 0.5 * frequency * time
    chord, middle = 2.0 * beta * math.sin(turn), phase + turn
    y = angle + a * sinh + b * rise - slope * time - chord * math.cos(middle)
    v = velocity + a * rise + b * sinh + frequency * chord * math.sin(middle)
    return y, v


@numba.njit(error_model="numpy")
def first_zero_in_double(
    constant: float,
    slope: float,
    amplitude: float,
    frequency: float,
    angle: float,
    velocity: float,
    phase: float,
    span: float,
    sign: float,
) -> tuple[float, float]:
    """Return the first zero of a flight, or infinity, and the least |y| met before it.

    Conservative advancement: F = sign y obeys F'' >= least, the least of sign r over the span, as
    long as F >= 0, so that F stays above a parabola.  Each step ends where the parabola reaches
    zero, which F cannot have done before.
    """
    least = (
        min(sign * constant, sign * (constant + slope * span)) - amplitude
        if math.isfinite(span)
        else sign * constant - amplitude
    )
    rest = abs(constant) + amplitude + abs(slope) * (span if slope != 0.0 else 0.0)
    time, y, v = 0.0, sign * angle, sign * velocity
    closest = math.inf
    for _ in range(1_000_000):
        if least < 0.0:
            step = (v + math.sqrt(max(0.0, v * v - 2.0 * least * y))) / -least
        elif v < 0.0:
            step = -y / v
        else:
            return math.inf, closest
        if time > 0.0 and (step <= 1e-13 * time or y <= 0.0):
            return time, closest
        if time + step >= span:
            return math.inf, closest
        if y >= rest + 1.0 and v >= 0.0:
            return math.inf, closest  # y'' > 0 for ever
        time += step
        y, v = flight_in_double(constant, slope, amplitude, frequency, angle, velocity, phase, time)
        y, v = sign * y, sign * v
        if v >= 0.0 or abs(v) < 1e-4:
            closest = min(closest, y)
    return math.nan, closest


# ------------------------------------------------------------------------------- 50 digits


@dataclass(frozen=True)
class ExactFlight:
    """One flight: y'' = y + constant + slope t + amplitude sin(phase + frequency t)."""

    constant: Number
    slope: Number
    amplitude: Number
    frequency: Number
    angle: Number
    velocity: Number
    phase: Number

    def state(self, time: Number) -> tuple[Number, Number]:
        """Angle and velocity by the closed form."""
        t = mp.mpf(time)
        w = mp.mpf(self.frequency)
        beta = mp.mpf(self.amplitude) / (1 + w * w)
        first, last = mp.mpf(self.phase), mp.mpf(self.phase) + w * t
        a = self.velocity + mp.mpf(self.slope) + beta * w * mp.cos(first)
        b = self.angle + mp.mpf(self.constant) + beta * mp.sin(first)
        sinh, cosh = mp.sinh(t), mp.cosh(t)
        y = a * sinh + b * cosh - self.constant - self.slope * t - beta * mp.sin(last)
        v = a * cosh + b * sinh - self.slope - beta * w * mp.cos(last)
        return y, v

    def forcing(self, time: Number) -> Number:
        return (
            self.constant
            + mp.mpf(self.slope) * time
            + self.amplitude * mp.sin(mp.mpf(self.phase) + mp.mpf(self.frequency) * time)
        )

    def zero_near(self, time: Number) -> Number:
        """Polish a zero by Newton's method."""
        time = mp.mpf(time)
        for _ in range(8):
            y, v = self.state(time)
            time -= y / v
        return time

    def first_zero(self, span: Number, sign: int = 1, most: int = 100_000) -> Number | None:
        """Return the first zero in (0, span], by conservative advancement; None where none is."""
        ends = [sign * mp.mpf(self.constant), sign * (self.constant + mp.mpf(self.slope) * span)]
        least = min(ends) - self.amplitude
        time, y, v = mp.mpf(0), sign * mp.mpf(self.angle), sign * mp.mpf(self.velocity)
        for _ in range(most):
            if least < 0:
                step = (v + mp.sqrt(v * v - 2 * least * y)) / -least
            elif v < 0:
                step = -y / v
            else:
                return None
            if time > 0 and step <= mp.mpf(10) ** -40 * time:
                return time
            if time + step > span:
                return None
            time += step
            y, v = self.state(time)
            y, v = sign * y, sign * v
            if y <= 0:
                return time
        raise RuntimeError("no decision")


@dataclass
class ExactSegment:
    """c0 + c1 s + A sin(Omega s + phi) from `start` on; the velocity jumps at its start."""

    start: Number
    constant: Number = 0
    slope: Number = 0
    amplitude: Number = 0
    frequency: Number = 0
    phase: Number = 0
    jump: Number = 0


@dataclass
class ExactImpact:
    time: Number
    side: int  # before the impact
    velocity: Number  # after it, in reference units


@dataclass
class ExactMarch:
    """What a march in 50 digits met."""

    impacts: list[ExactImpact] = field(default_factory=list)
    uplifts: list[Number] = field(default_factory=list)
    flights: list[tuple[Number, int, ExactFlight]] = field(default_factory=list)
    overturned: bool = False
    side: int = 0
    angle: Number = 0
    velocity: Number = 0


STILL = mp.mpf(10) ** -30  # a bounce that leads to rest: its chatter lasts some 1e-30


def exact_march(
    segments: Sequence[ExactSegment],
    until: Number,
    *,
    side: int = 0,
    angle: Number = 0,
    velocity: Number = 0,
    restitution: tuple[Number, Number] = (1, 1),
    lean: tuple[Number, Number] = (1, 1),
    rate: tuple[Number, Number] = (1, 1),
    most_impacts: int = 100_000,
) -> ExactMarch:
    """March in 50 digits: each flight is sampled in double precision and its zero then refined.

    Rest begins where a bounce is slower than 1e-30 and the base below uplift.  A restitution of 0
    or less is minus a wall's, which sends the block back to its side; the other side's lean is then
    infinite.
    """
    found = ExactMarch(side=side, angle=mp.mpf(angle), velocity=mp.mpf(velocity))
    until = mp.mpf(until)
    for index, segment in enumerate(segments):
        now = mp.mpf(segment.start)
        last = index + 1 == len(segments)
        end = until if last else min(until, mp.mpf(segments[index + 1].start))
        if index > 0:
            if found.side == 0 and segment.jump != 0:
                found.side = 1 if segment.jump > 0 else -1
            # theta'' = p^2 (... + a/g): each side takes an impulse by its own p^2.
            found.velocity += segment.jump * mp.mpf(rate[0 if found.side > 0 else 1]) ** 2
        while now < end:
            if len(found.impacts) >= most_impacts:
                return found
            if found.side == 0:
                now, found.side = _exact_uplift(segment, now, end, lean)
                if found.side != 0:
                    found.uplifts.append(now)
                continue
            now = _exact_flight(found, segment, now, end, last, restitution, lean, rate)
            if found.overturned:
                return found
        if end >= until:
            break
    return found


def _exact_flight(
    found: ExactMarch,
    segment: ExactSegment,
    now: Number,
    end: Number,
    last: bool,
    restitution: tuple[Number, Number],
    lean: tuple[Number, Number],
    rate: tuple[Number, Number],
) -> Number:
    """Fly from `now` to an impact or to `end`, whichever comes first; return the time."""
    s, row = found.side, 0 if found.side > 0 else 1
    to_lean, to_rate = mp.mpf(lean[row]), mp.mpf(rate[row])
    since = now - segment.start
    flight = ExactFlight(
        s * (segment.constant + segment.slope * since) / to_lean - 1,
        s * segment.slope / (to_lean * to_rate),
        mp.mpf(segment.amplitude) / to_lean,
        mp.mpf(segment.frequency) / to_rate,
        s * found.angle / to_lean,
        s * found.velocity / (to_lean * to_rate),
        segment.phase + segment.frequency * since + (mp.pi if s < 0 else 0),
    )
    found.flights.append((now, s, flight))
    span = (end - now) * to_rate
    zero = sampled_zero(flight, span)
    if zero is None:
        y, v = flight.state(span)
        bound = 1 + abs(flight.constant + 1) + flight.amplitude
        found.overturned = bool(last and flight.slope == 0 and y > bound and v > 0)
        found.angle, found.velocity = s * y * to_lean, s * v * to_lean * to_rate
        return end
    _, v = flight.state(zero)
    now += zero / to_rate
    found.angle = mp.mpf(0)
    found.velocity = s * v * to_lean * to_rate * restitution[row]
    found.impacts.append(ExactImpact(now, s, found.velocity))
    found.side = s if restitution[row] <= 0 else -s
    at = now - segment.start
    base = segment.constant + segment.slope * at
    base += segment.amplitude * mp.sin(segment.phase + segment.frequency * at)
    if abs(found.velocity) < STILL and base < lean[0] and -base < lean[1]:
        found.side, found.velocity = 0, mp.mpf(0)
    return now


def sampled_zero(flight: ExactFlight, span: Number) -> Number | None:
    """Return the first zero of a flight that starts at or above zero: sampling, then refinement.

    Samples are so dense that F leaves the parabola of the worst acceleration by little; minima
    between samples are refined too.
    """
    w = float(flight.frequency)
    least = float(flight.constant) - float(flight.amplitude)
    # A short bounce is sampled on its own scale, the first samples geometrically.
    first = float(flight.velocity) / max(1.0, -least)
    if float(flight.angle) > 0.0:
        first = max(first, math.sqrt(float(flight.angle) / max(1.0, -least)))
    step = min(0.02, 2 * math.pi / w / 100 if w > 0 else 0.02)
    if first < 1e-6:
        zero = _tiny_bounce(flight, span)
        if zero is not None:
            return zero
    first = min(first if first > 0.0 else step / 16, step)
    begin, edge = 0.0, float(span)
    while begin < edge:
        stop = min(edge, begin + 400 * step)
        times = np.arange(begin, stop, step)
        if begin == 0.0:
            # A flight that starts on the floor leaves out that zero of its own.
            started = times[1:] if flight.angle == 0 else times
            times = np.union1d(np.geomspace(first / 4, step, 24), started)
        times = np.append(times, stop)
        y, v = states_in_double(flight, times)
        for i in range(1, len(times)):
            if y[i] <= 0.0:
                zero = _descending(flight, times[i - 1], mp.mpf(float(times[i])))
                return zero if zero <= span else None
            deepest = y[i - 1] + v[i - 1] * (times[i] - times[i - 1])
            if v[i - 1] < 0.0 < v[i] and deepest <= 0.0:
                left, right = mp.mpf(float(times[i - 1])), mp.mpf(float(times[i]))
                for _ in range(80):
                    middle = (left + right) / 2
                    left, right = (middle, right) if flight.state(middle)[1] < 0 else (left, middle)
                if flight.state(right)[0] <= 0:
                    return _descending(flight, times[i - 1], right)
        if y[-1] > 2.0 + abs(float(flight.constant)) + float(flight.amplitude) and v[-1] > 0.0:
            return None
        begin = stop
    return None


def _tiny_bounce(flight: ExactFlight, span: Number) -> Number | None:
    """Return the landing of a bounce so short that the forcing hardly changes over it."""
    pull = flight.forcing(0) + flight.angle
    if pull >= 0 or flight.angle != 0:
        return None
    guess = -2 * flight.velocity / pull
    if guess > span or guess > 1e-3:
        return None
    time = flight.zero_near(guess)
    landed = abs(time - guess) < guess / 4 and flight.state(time)[1] < 0
    return time if landed and time <= span else None


def _descending(flight: ExactFlight, low: Number, high: Number) -> Number:
    """Bisect down to a simple zero, then polish it by Newton's method."""
    low, high = mp.mpf(low), mp.mpf(high)
    for _ in range(300):
        for _ in range(12):
            middle = (low + high) / 2
            if flight.state(middle)[0] > 0:
                low = middle
            else:
                high = middle
        time = high
        for _ in range(8):
            y, v = flight.state(time)
            if v >= 0:
                break
            time -= y / v
            # A sample at or below zero may be so by rounding only: then the zero follows at once.
            near = low <= time <= high * (1 + mp.mpf(10) ** -12)
            if abs(y / v) < mp.mpf(10) ** -60 * time and near:
                return time
    raise RuntimeError("not a descending zero")


def states_in_double(flight: ExactFlight, times: Floats) -> tuple[Floats, Floats]:
    """Angle and velocity at many times, to some 1e-15 of the coefficients."""
    w = float(flight.frequency)
    beta = mp.mpf(flight.amplitude) / (1 + mp.mpf(flight.frequency) ** 2)
    cosine, sine = mp.cos(flight.phase), mp.sin(flight.phase)
    a = flight.velocity + flight.slope + beta * flight.frequency * cosine
    b = flight.angle + flight.constant + beta * sine
    up, down = float((a + b) / 2), float((b - a) / 2)
    c, k, q = float(flight.constant), float(flight.slope), float(beta)
    psi = float(mp.fmod(flight.phase, 2 * mp.pi)) + w * times
    rising, falling = up * np.exp(times), down * np.exp(-times)
    y = rising + falling - c - k * times - q * np.sin(psi)
    v = rising - falling - k - q * w * np.cos(psi)
    short = times < (1e-3 if abs(float(flight.velocity)) > 1e-3 else 0.05)
    if short.any():
        exact = [flight.state(float(t)) for t in times[short]]
        y[short] = [float(state[0]) for state in exact]
        v[short] = [float(state[1]) for state in exact]
    return y, v


def _exact_uplift(
    segment: ExactSegment, now: Number, end: Number, lean: tuple[Number, Number]
) -> tuple[Number, int]:
    """Return when and to which side a block at rest lifts; `end` and 0 where it does not."""

    def base(time: Number) -> Number:
        at = time - segment.start
        swing = segment.amplitude * mp.sin(segment.phase + segment.frequency * at)
        return segment.constant + segment.slope * at + swing

    def excess(time: Number) -> Number:
        a = base(time)
        return max(a - lean[0], -a - lean[1])

    nudge = mp.mpf(10) ** -45
    if excess(now + nudge) > 0:
        return now, 1 if base(now) > 0 else -1
    step = (
        mp.mpf(min(0.02, 2 * math.pi / float(segment.frequency) / 400))
        if (segment.frequency > 0)
        else mp.mpf("0.02")
    )
    low = now
    while low < end:
        high = min(low + step, end)
        if excess(high) > 0:
            for _ in range(170):
                middle = (low + high) / 2
                if excess(middle) > 0:
                    high = middle
                else:
                    low = middle
            return high, 1 if base(high) > 0 else -1
        low = high
    return end, 0


# ------------------------------------------------------------------- differential equations


def integrated_impacts(
    base: Callable[[float], float],
    until: float,
    *,
    side: int,
    velocity: float,
    restitution: tuple[float, float],
    lean: tuple[float, float] = (1.0, 1.0),
    rate: tuple[float, float] = (1.0, 1.0),
    longest_step: float = math.inf,
) -> list[tuple[float, float]]:
    """Return times and velocities after impacts by Runge-Kutta of order 8 with events."""
    now, impacts = 0.0, []

    def landing(_time: float, state: Floats) -> float:
        return float(state[0])

    landing.terminal = True  # type: ignore[attr-defined]
    landing.direction = 0.0  # type: ignore[attr-defined]
    while now < until:
        row = 0 if side > 0 else 1
        square, edge = rate[row] ** 2, side * lean[row]

        def motion(
            time: float, state: Floats, square: float = square, edge: float = edge
        ) -> list[float]:
            return [state[1], square * (state[0] - edge + base(time))]

        # A first step by Taylor's series leaves the zero at the start.
        tiny = 1e-4
        pull = square * (base(now) - edge)
        later = square * (velocity + (base(now + tiny) - base(now - tiny)) / (2.0 * tiny))
        angle = tiny * (velocity + tiny * (pull / 2.0 + tiny * later / 6.0))
        speed = velocity + tiny * (pull + tiny * later / 2.0)
        run = solve_ivp(
            motion,
            (now + tiny, until),
            [angle, speed],
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
            events=landing,
            max_step=longest_step,
        )
        assert run.t_events is not None
        assert run.y_events is not None
        if len(run.t_events[0]) == 0:
            break
        now = float(run.t_events[0][0])
        velocity = restitution[row] * float(run.y_events[0][0][1])
        side = -side
        impacts.append((now, velocity))
    return impacts
