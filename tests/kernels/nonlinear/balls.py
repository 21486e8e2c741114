"""The nonlinear equation of motion in ball arithmetic: flights whose errors are proved.

The equation is that of the pendulum on an accelerated base, eq (B) of docs/theory/nonlinear.md, and
nothing here comes from the kernels.  A step is Taylor's polynomial with its remainder: the highest
coefficient, taken over balls that hold the motion during the whole step, which Picard's iteration
has proved.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

Ball = Any  # flint.arb has no types

ORDERS = {0.01: 14, math.inf: 30}  # of steps up to so many natural lengths
BITS = 256
SMALL = 1e-40  # what a step leaves out, as a part of its motion


@dataclass(frozen=True)
class Base:
    """Base motion from one side, in the units of the side, time from the start of a flight."""

    alpha: Ball
    constant: Ball = 0
    slope: Ball = 0
    amplitude: Ball = 0
    phase: Ball = 0
    frequency: Ball = 0
    lift: Ball = 0
    lift_slope: Ball = 0

    def horizontal(self, time: Ball) -> Ball:
        turned = arb(self.phase) + arb(self.frequency) * time
        return arb(self.constant) + arb(self.slope) * time + arb(self.amplitude) * turned.sin()

    def weight(self, time: Ball) -> Ball:
        return 1 + arb(self.lift) + arb(self.lift_slope) * time

    def acceleration(self, time: Ball, angle: Ball) -> Ball:
        """Return y''."""
        tilt = arb(self.alpha) * (1 - angle)
        return self.horizontal(time) * tilt.cos() - self.weight(time) * tilt.sin() / arb(self.alpha)

    def foot(self, time: Ball) -> Ball:
        """Return r, the acceleration of a block that stands on its base."""
        return self.acceleration(time, arb(0))

    def coefficients(self, time: Ball, angle: Ball, velocity: Ball, count: int) -> list[Ball]:
        """Return the Taylor coefficients of y."""
        alpha, frequency = arb(self.alpha), arb(self.frequency)
        tilt = alpha * (1 - angle)
        sines, cosines = [tilt.sin() / alpha], [tilt.cos()]
        turned = arb(self.phase) + frequency * time
        sine, cosine = turned.sin(), turned.cos()
        wave = [sine, cosine, -sine, -cosine]
        factor, base = arb(self.amplitude), []
        for n in range(count):
            base.append(factor * wave[n % 4])
            factor = factor * frequency / (n + 1)
        base[0] += arb(self.constant) + arb(self.slope) * time
        base[1] += arb(self.slope)
        weight, weight_slope = self.weight(time), arb(self.lift_slope)
        y, rates = [angle, velocity], [velocity]
        for n in range(count - 2):
            pull = sum((base[j] * cosines[n - j] for j in range(n + 1)), arb(0))
            pull -= weight * sines[n]
            if n:
                pull -= weight_slope * sines[n - 1]
            y.append(pull / ((n + 1) * (n + 2)))
            rates.append((n + 2) * y[n + 2])
            into_sine = sum((rates[j] * cosines[n - j] for j in range(n + 1)), arb(0))
            into_cosine = sum((rates[j] * sines[n - j] for j in range(n + 1)), arb(0))
            sines.append(-into_sine / (n + 1))
            cosines.append(alpha * alpha * into_cosine / (n + 1))
        return y


@dataclass(frozen=True)
class Step:
    """One step of a flight, proved."""

    start: Ball
    length: Ball
    powers: list[Ball]  # of y, the last one over the whole step
    rates: list[Ball]  # of y', likewise
    pull: Ball  # y'' over the whole step

    def angle(self, after: Ball) -> Ball:
        return horner(self.powers, after)

    def velocity(self, after: Ball) -> Ball:
        return horner(self.rates, after)

    def crossing(self, falling: list[Ball]) -> Ball:
        """Return the time after the start at which a polynomial falls through zero.

        It is the only one where the polynomial is concave or falls throughout.
        """
        low, high = self.length, self.length
        while not horner(falling, low) > 0:
            low = low / 2
            assert low > self.length * 1e-60
        for _ in range(12):
            middle = ((low + high) / 2).mid()
            low, high = (middle, high) if horner(falling, middle) > 0 else (low, middle)
        # From there Newton's method finds what the signs on either side then prove.
        slopes = [n * power for n, power in enumerate(falling)][1:]
        at = low
        for _ in range(7):
            at = (at - horner(falling, at) / horner(slopes, at)).mid()
        width = at * SMALL
        while not (horner(falling, at - width) > 0 and horner(falling, at + width) < 0):
            width = 4 * width
            assert width < at
        return (at - width).union(at + width)


def horner(powers: list[Ball], at: Ball) -> Ball:
    total = powers[-1]
    for power in reversed(powers[:-1]):
        total = total * at + power
    return total


def step_of(base: Base, time: Ball, angle: Ball, velocity: Ball, length: float) -> Step:
    """Return a step, shortened until Picard's iteration proves it and its remainder is small."""
    tau = arb(length)
    while True:
        share = float(tau) / natural_step(base, velocity)
        order = next(each for limit, each in ORDERS.items() if share <= limit)
        span = tau.union(arb(0))
        around, fast = angle + span * velocity, velocity
        for _ in range(12):
            pull = base.acceleration(time + span, around)
            faster = velocity + span * pull
            wider = angle + span * faster
            if around.contains(wider) and fast.contains(faster):
                point = base.coefficients(time, angle, velocity, order + 1)
                over = base.coefficients(time + span, wider, faster, order + 2)
                powers = [*point[:order], over[order]]
                rates = [(n + 1) * point[n + 1] for n in range(order)]
                rates.append((order + 1) * over[order + 1])
                left_out = abs(powers[order]) * tau**order
                if left_out < SMALL * (abs(angle) + abs(velocity) * tau):
                    return Step(time, tau, powers, rates, base.acceleration(time + span, wider))
                break
            slack = arb(0, 0.1)
            around = wider.union(around) + slack * wider.rad()
            fast = faster.union(fast) + slack * faster.rad()
        tau = tau / 2
        assert tau > 1e-60


def natural_step(base: Base, velocity: Ball = 0) -> float:
    """Return a length over which the motion changes little."""
    rate: float = max(
        1.0,
        float(arb(base.frequency)),
        float(arb(base.alpha) * abs(arb(velocity))),
        float(abs(base.weight(arb(0)))) ** 0.5,
        float(arb(base.alpha) * (abs(base.horizontal(arb(0))) + arb(base.amplitude))) ** 0.5,
    )
    return 0.5 / rate


@dataclass(frozen=True)
class Bounce:
    """What a bounce from the base does."""

    duration: Ball
    landing: Ball  # y' at its end
    height: Ball


def bounce(base: Base, velocity: Ball, longest: Ball) -> Bounce | None:
    """Return the bounce that starts with a velocity, or None where none is proved to end.

    y'' < 0 is proved for all of it, so that it ends at its first and only zero.
    """
    time, angle, height = arb(0), arb(0), None
    speed = arb(velocity)
    pull = -base.foot(time)
    if not pull > 0:
        return None
    while time < longest:
        step = step_of(
            base, time, angle, speed, min(natural_step(base), float(3 * arb(velocity) / pull))
        )
        if not step.pull < 0:
            step = step_of(base, time, angle, speed, float(step.length) / 8)
            if not step.pull < 0:
                return None
        angle, speed = step.angle(step.length), step.velocity(step.length)
        if height is None and speed < 0:
            height = step.angle(step.crossing(step.rates))
        if angle < 0:
            at = step.crossing(step.powers)
            assert height is not None
            return Bounce(time + at, step.velocity(at), height)
        if not angle > 0:
            return None
        time += step.length
    return None


def seen(base: Base, row: NDArray[np.float64], side: int, elapsed: Ball) -> Base:
    """Return a base motion in reference units as a side sees it from some time on."""
    _, lean, rate, alpha, _ = (arb(float(value)) for value in row)
    turned = arb(base.phase) + arb(base.frequency) * elapsed
    return Base(
        alpha,
        side * (arb(base.constant) + arb(base.slope) * elapsed) / lean,
        side * arb(base.slope) / (lean * rate),
        arb(base.amplitude) / lean,
        turned if side > 0 else turned + arb.pi(),
        arb(base.frequency) / rate,
        arb(base.lift) + arb(base.lift_slope) * elapsed,
        arb(base.lift_slope) / rate,
    )


def chatter(
    base: Base, sides: NDArray[np.float64], side: int, speed: Ball, longest: float
) -> Ball | None:
    """Return when a block that bounces is at rest, or None where it lifts off or may do so.

    It bounces until its speed is 1e-9 of the first; what is left takes no longer than one and a
    half times the geometric sum of the bounces on a base that keeps still from there on.
    """
    time, speed = arb(0), arb(speed)
    least = speed * 1e-9
    loss = 1 - arb(float(sides[:, 0].max()))
    while time < longest:
        row = sides[0 if side > 0 else 1]
        unit = arb(float(row[1])) * arb(float(row[2]))
        found = bounce(seen(base, row, side, time), speed / unit, arb(longest) * float(row[2]))
        if found is None:
            return None
        after = time + found.duration / float(row[2])
        if not stays_down(base, sides, time, after):
            return None
        time, side, speed = after, -side, abs(found.landing) * unit * float(row[0])
        if speed < least:
            pulls = [
                -seen(base, sides[k], sign, time).foot(arb(0)) * float(np.prod(sides[k, 1:3] ** 2))
                for k, sign in enumerate((1, -1))
            ]
            end = time + 3 * speed / (min(pulls) * loss)
            return end if stays_down(base, sides, time, end) else None
    return None


def stays_down(base: Base, sides: NDArray[np.float64], start: Ball, end: Ball) -> bool:
    """Return whether neither side's foot is pulled up in a time, proved in pieces."""
    open_pieces = [(start, end, 0)]
    while open_pieces:
        low, high, depth = open_pieces.pop()
        now = low.union(high)
        feet = [seen(base, sides[k], sign, now).foot(arb(0)) for k, sign in enumerate((1, -1))]
        if all(foot < 0 for foot in feet):
            continue
        if depth == 10:
            return False
        middle = (low + high) / 2
        open_pieces += [(low, middle, depth + 1), (middle, high, depth + 1)]
    return True
