"""The tight reference of the nonlinear model: Taylor series in many digits, no impact missed.

It shares no code with the package. Above the floor y'' >= -sin(alpha)/alpha - A, so y stays above
the parabola of that acceleration through where it is now, and so does the series, on which the
march advances to the zero of one parabola after the other as in `bench/peers/reference.py`.
"""

import math
from typing import Any

import flint
from flint import arb

from bench.peers.reference import STILL, Fate
from bench.peers.work import CYCLES, OVERTURNED, RESTITUTION, ROCKING, START_VELOCITY

ORDER_A_DIGIT = 1.15  # of the series: the least work


class Pendulum:
    """A block under harmonic shaking, its numbers in many digits."""

    def __init__(self, alpha: float, amplitude: float, frequency_ratio: float, digits: int) -> None:
        self.order = round(ORDER_A_DIGIT * digits)
        self.left_out = 10.0 ** (-digits / self.order)
        self.close = 10.0**-digits
        self.alpha, self.amplitude = arb(alpha), arb(amplitude)
        self.omega, self.end = arb(frequency_ratio), 2 * arb.pi() * CYCLES
        self.least = -self.alpha.sin() / self.alpha - self.amplitude
        self.lost = 1 + (self.alpha * self.amplitude).atan() / self.alpha
        self.threshold = self.alpha.tan() / self.alpha / self.amplitude

    def series(self, tau: Any, side: int, y: Any, v: Any) -> list[Any]:
        """Return the Taylor coefficients of y in the time from the phase tau on."""
        tilt = self.alpha * (1 - y)
        sines, cosines = [tilt.sin() / self.alpha], [tilt.cos()]
        sine, cosine = side * self.amplitude * tau.sin(), side * self.amplitude * tau.cos()
        base, turn = [], arb(1)
        for n in range(self.order):
            base.append(turn * (sine, cosine, -sine, -cosine)[n % 4])
            turn = turn * self.omega / (n + 1)
        powers, rates, square = [y, v], [v], self.alpha * self.alpha
        for n in range(self.order - 1):
            pull = sum(map(arb.__mul__, base[: n + 1], reversed(cosines)), -sines[n])
            powers.append((pull / ((n + 1) * (n + 2))).mid())
            rates.append((n + 2) * powers[-1])
            into_sine = sum(map(arb.__mul__, rates, reversed(cosines)), arb(0))
            into_cosine = sum(map(arb.__mul__, rates, reversed(sines)), arb(0))
            sines.append((-into_sine / (n + 1)).mid())
            cosines.append((square * into_cosine / (n + 1)).mid())
        return powers

    def reach(self, powers: list[Any]) -> float:
        """Return how long a series is exact to the digits."""
        size = max(abs(float(power)) for power in powers[:4])
        steps = (
            (size / abs(float(powers[n]))) ** (1.0 / n) * self.left_out
            for n in (self.order - 1, self.order)
            if float(powers[n]) != 0.0
        )
        return min(steps, default=1.0)

    def lifted(self, tau: Any) -> tuple[Any, int, Any]:
        """Return when a block at rest lifts, on which side, and for how long it then only rises."""
        turn = 2 * arb.pi()
        rise = self.threshold.asin()
        if tau.sin() >= self.threshold or -tau.sin() >= self.threshold:
            side = 1 if tau.sin() > 0 else -1
        else:
            right, left = wrapped(rise - tau, turn), wrapped(rise + arb.pi() - tau, turn)
            side = 1 if right < left else -1
            tau += min(right, left)
        seen = tau if side > 0 else tau + arb.pi()
        return tau.mid(), side, (wrapped(arb.pi() - rise - seen, turn) / self.omega).mid()


def exact_nonlinear_fate(
    alpha: float, amplitude: float, frequency_ratio: float, digits: int
) -> Fate:
    """March one cell of B1 in so many digits, at least 30."""
    with flint.ctx.workdps(digits + 10):
        return _fate(Pendulum(alpha, amplitude, frequency_ratio, digits))


def _fate(block: Pendulum) -> Fate:
    turn, restitution = 2 * arb.pi(), arb(RESTITUTION)
    tau, side, velocity, last = arb(0), 1, arb(START_VELOCITY), arb(0)
    impacts, rested = 0, False

    def ended(status: int) -> Fate:
        return Fate(status, impacts, rested, float(wrapped(last, turn)) if impacts else math.nan)

    while True:
        rises = arb(0)
        if velocity == 0:
            rested = True
            if not block.threshold < 1:
                return ended(ROCKING)
            tau, side, rises = block.lifted(tau)
        y, v = arb(0), velocity
        while True:  # the steps of one flight
            if tau >= block.end:
                return ended(ROCKING)
            powers = block.series(tau, side, y, v)
            after, landed = _advance(block, powers, rises, arb(block.reach(powers)))
            y, v = _values(powers, after)
            tau, rises = (tau + block.omega * after).mid(), max(rises - after, arb(0))
            if landed:
                break
            if y >= block.lost and v >= 0 and tau < block.end:
                return ended(OVERTURNED)
        if tau >= block.end:
            return ended(ROCKING)
        impacts += 1
        last, side, velocity = tau, -side, (-restitution * v).mid()
        if velocity < STILL and abs(tau.sin()) < block.threshold:
            velocity = arb(0)


def _advance(block: Pendulum, powers: list[Any], rises: Any, reach: Any) -> tuple[Any, bool]:
    """Return how far the motion goes on a series, and whether it then lands."""
    time = min(rises, reach)
    while time < reach:
        y, v = _values(powers, time)
        if y < 0 or (y == 0 and time > 0):
            return time, True
        step = ((v + (v * v - 2 * block.least * y).sqrt()) / -block.least).mid()
        if step <= block.close * time or step == 0:
            return time, True
        time = (time + step).mid()
    return reach, False


def _values(powers: list[Any], time: Any) -> tuple[Any, Any]:
    """Return y and y'."""
    y, v = arb(0), arb(0)
    for power in reversed(powers):
        v = v * time + y
        y = y * time + power
    return y.mid(), v.mid()


def wrapped(angle: Any, turn: Any) -> Any:
    """Return an angle from 0 to a turn."""
    return (angle - turn * (angle / turn).mid().floor()).mid()
