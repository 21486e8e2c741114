"""Flights of the linear model from an uplift on, in 80 digits, independent of the package.

A flight is searched on a fine grid in closed form: an impact is a change of sign, or a minimum
below the base.  Bounces are followed until they are slower than `STILL`; the block rests if that is
before the next uplift.
"""

from dataclasses import dataclass, field
from typing import Any

from mpmath import mp, mpf

DIGITS = 80
STILL = 1e-18
GRID = 0.02
MOST = 3000


@dataclass
class Way:
    """From an uplift to the rest, or to the first uplift that the block is not at rest for."""

    phases: list[Any] = field(default_factory=list)  # of impacts, from the uplift on
    speeds: list[Any] = field(default_factory=list)  # after them
    rests: bool = False
    end: Any = None  # phase at which the bounces have died out
    until: Any = None  # phase of the uplift that follows


def way_from_uplift(
    amplitude: Any, frequency: Any, restitution: Any, *, half_cycles: int = 1, impacts: int = MOST
) -> Way:
    """Return what follows from the uplift to the positive side, up to so many half cycles."""
    with mp.workdps(DIGITS):
        a, w, loss = mpf(amplitude), mpf(frequency), mpf(restitution)
        lifted = mp.asin(1 / a)
        way = Way(until=half_cycles * mp.pi)
        passed, speed, side = mpf(0), mpf(0), 1
        while len(way.phases) < impacts:
            seen = lifted + passed + (0 if side > 0 else mp.pi)
            time, speed = _landing(a, w, seen, speed, (way.until - passed) / w)
            if time is None:
                return way
            passed, side = passed + w * time, -side
            speed = loss * speed
            if passed >= way.until:
                return way
            way.phases.append(passed)
            way.speeds.append(speed)
            if speed < STILL:
                pull = 1 - side * a * mp.sin(lifted + passed)
                other = 1 + side * a * mp.sin(lifted + passed)
                left = 2 * speed * (1 / pull + loss / other) / (1 - loss * loss)
                way.rests, way.end = True, passed + w * left
                return way
        return way


def _landing(a: Any, w: Any, seen: Any, speed: Any, span: Any) -> tuple[Any, Any]:
    """Return how long a flight lasts, and the speed with which it lands; None after a span."""
    beta = a / (1 + w * w)
    cosh_part = beta * mp.sin(seen) - 1
    sinh_part = speed + beta * w * mp.cos(seen)

    def height(t: Any) -> Any:
        wave = beta * mp.sin(seen + w * t)
        return 1 - wave + sinh_part * mp.sinh(t) + cosh_part * mp.cosh(t)

    def velocity(t: Any) -> Any:
        return -beta * w * mp.cos(seen + w * t) + sinh_part * mp.cosh(t) + cosh_part * mp.sinh(t)

    pull = 1 - a * mp.sin(seen)
    step = mpf(GRID)
    if pull > 0 and speed > 0:
        step = min(step, speed / pull / 8)
    t = step
    while t < span:
        later = t + step
        if height(t) > 0 >= height(later):
            zero = mp.findroot(height, (t, later), solver="anderson", tol=mpf(10) ** (-140))
            return zero, -velocity(zero)
        if velocity(t) < 0 < velocity(later):
            lowest = mp.findroot(velocity, (t, later), solver="anderson", tol=mpf(10) ** (-140))
            if height(lowest) <= 0:
                zero = mp.findroot(height, (t, lowest), solver="anderson", tol=mpf(10) ** (-140))
                return zero, -velocity(zero)
        t = later
    return None, None
