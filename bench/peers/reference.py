"""The tight reference: the same march in many digits, with impacts that cannot be missed.

It shares no code with the package. Above the floor y'' = y + r >= -1 - A, so y stays above the
parabola of that acceleration through where it is now; the march advances to the zero of one
parabola after the other and thereby, from the left, to the first zero of y.
"""

from typing import Any, NamedTuple

import mpmath

from bench.peers.work import CYCLES, OVERTURNED, RESTITUTION, ROCKING, START_VELOCITY

STILL = 1e-30  # a bounce this slow, with the base below uplift, is rest
CLOSE = 1e-40  # relative advance that counts as arrived


class Fate(NamedTuple):
    """How one cell ends."""

    status: int
    impacts: int
    rested: bool  # at some time: the number of impacts is then a matter of the rest rule
    last_phase: float  # of the last impact, in [0, 2 pi); NaN without one


def exact_fate(amplitude: float, frequency_ratio: float, digits: int) -> Fate:
    """March one cell of B1 in so many digits, at least 60."""
    mp = mpmath.mp.clone()
    mp.dps = digits
    big_a, omega, restitution = mp.mpf(amplitude), mp.mpf(frequency_ratio), mp.mpf(RESTITUTION)
    beta, least = big_a / (1 + omega * omega), -1 - big_a
    still, close, turn = mp.mpf(STILL), mp.mpf(CLOSE), 2 * mp.pi
    end = turn * CYCLES
    tau, side, velocity, last = mp.mpf(0), 1, mp.mpf(START_VELOCITY), mp.nan
    impacts, rested = 0, False

    def ended(status: int) -> Fate:
        return Fate(status, impacts, rested, float(last % turn) if impacts else float("nan"))

    while True:
        time = mp.mpf(0)  # since the start of the flight
        if velocity == 0:
            rested = True
            if big_a <= 1:
                return ended(ROCKING)
            tau, side, time = _lifted(mp, big_a, omega, tau)
        span = (end - tau) / omega
        if time >= span:
            return ended(ROCKING)
        sine, cosine = side * mp.sin(tau), side * mp.cos(tau)
        grow = (velocity + beta * omega * cosine - 1 + beta * sine) / 2
        decay = grow - velocity - beta * omega * cosine
        y, v = mp.mpf(0), velocity
        while True:
            if time > 0:
                exponential = mp.exp(time)
                sine = side * mp.sin(tau + omega * time)
                cosine = side * mp.cos(tau + omega * time)
                y = grow * exponential + decay / exponential + 1 - beta * sine
                v = grow * exponential - decay / exponential - beta * omega * cosine
                if y <= 0:
                    break
                if y >= 1 + big_a and v >= 0:
                    return ended(OVERTURNED)
            step = (v + mp.sqrt(v * v - 2 * least * y)) / -least
            if step <= close * time:
                break
            time += step
            if time >= span:
                return ended(ROCKING)
        impacts += 1
        tau += omega * time
        last, side, velocity = tau, -side, -restitution * v
        if velocity < still and big_a * abs(mp.sin(tau)) < 1:
            velocity = mp.mpf(0)


def _lifted(mp: Any, big_a: Any, omega: Any, tau: Any) -> tuple[Any, int, Any]:
    """Return when a block at rest lifts, on which side, and for how long it then only rises."""
    turn = 2 * mp.pi
    rise, phase = mp.asin(1 / big_a), tau % turn
    if big_a * abs(mp.sin(phase)) >= 1:
        side = 1 if mp.sin(phase) > 0 else -1
    else:
        right, left = (rise - phase) % turn, (rise + mp.pi - phase) % turn
        side = 1 if right < left else -1
        tau += min(right, left)
    # It rises as long as the base pulls harder than gravity, and lands after that.
    seen = tau + (0 if side > 0 else mp.pi)
    return tau, side, ((mp.pi - rise - seen) % turn) / omega
