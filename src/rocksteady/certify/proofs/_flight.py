"""Flights between impact phases, in balls or floats, in the side frame of docs/theory/march.md.

A flight is known by the phases of its two impacts and its duration (E2), and a chain of flights is
a motion where each impact fits the flights before and after it (E3): the forms of
docs/theory/proofs.md, of which no term grows with the length of the flight.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

from flint import arb

from rocksteady.certify.proofs._balls import Stated, above, ball, halves, hull, mid

DEPTH = 60
"""Bisections of a flight after which its height above the floor is undecided."""


@dataclass(frozen=True)
class Shaking:
    """Amplitude, frequency ratio and restitution: balls, power series of balls, or floats."""

    amplitude: Any
    ratio: Any
    restitution: Any
    pi: Any = field(default_factory=arb.pi)

    @classmethod
    def of(cls, numbers: dict[str, Stated]) -> "Shaking":
        """Return the balls of the numbers of a claim, in the order of the attributes."""
        return cls(*map(ball, numbers.values()))

    @cached_property
    def beta(self) -> Any:
        """A/(1 + Omega^2), the amplitude of the forced part."""
        return self.amplitude * (1 / (1 + self.ratio * self.ratio))

    def duration(self, phase: Any, next_phase: Any, half_periods: int) -> Any:
        """Return the duration of a flight from one impact phase to the next."""
        return (next_phase - phase + half_periods * self.pi) * (1 / self.ratio)


class Factors(NamedTuple):
    """coth T, 1/sinh T and tanh T/2 of a duration."""

    coth: Any
    csch: Any
    tanh: Any


class Phase(NamedTuple):
    """Sine and cosine of an impact phase."""

    sine: Any
    cosine: Any


class Row(NamedTuple):
    """The mismatch e of an impact, and its derivatives by the phases before, at and after it."""

    mismatch: Any
    before: Any
    at: Any
    after: Any


def factors(decay: Any) -> Factors:
    """Return the factors of a duration T, from the decaying exponential e^-T."""
    square = decay * decay
    scale = 1 / (1 - square)
    return Factors((1 + square) * scale, 2 * decay * scale, (1 - decay) / (1 + decay))


def liftoff(shaking: Shaking, here: Phase, then: Phase, flight: Factors) -> Any:
    """Return the speed w at the start of a flight."""
    beta = shaking.beta
    push = (1 - beta * here.sine) * flight.coth - (1 + beta * then.sine) * flight.csch
    return push - beta * shaking.ratio * here.cosine


def landing(shaking: Shaking, here: Phase, then: Phase, flight: Factors) -> Any:
    """Return the speed V at the end of a flight."""
    beta = shaking.beta
    push = (1 + beta * then.sine) * flight.coth - (1 - beta * here.sine) * flight.csch
    return push - beta * shaking.ratio * then.cosine


def row(shaking: Shaking, ends: list[Phase], first: Factors, second: Factors) -> Row:
    """Return (E3) at an impact: e = (restitution V - w)/beta, with V before and w after it.

    Parameters
    ----------
    shaking
        Its parameters.
    ends
        The impact phases before, at and after it.
    first, second
        Factors of the flight before it and of the one after it.
    """
    last, here, then = ends
    beta, ratio, loss = shaking.beta, shaking.ratio, shaking.restitution
    coths = loss * first.coth + second.coth
    inverse = 1 / beta
    mismatch = (
        here.sine * coths
        + loss * last.sine * first.csch
        + then.sine * second.csch
        + (1 - loss) * ratio * here.cosine
        - (second.tanh - loss * first.tanh) * inverse
    )
    scale = inverse * (1 / ratio)
    early = (1 - beta * last.sine) * first.coth - (1 + beta * here.sine) * first.csch
    late = (1 + beta * then.sine) * second.coth - (1 - beta * here.sine) * second.csch
    at = (
        here.cosine * coths
        - (1 - loss) * ratio * here.sine
        + (loss * early * first.csch + late * second.csch) * scale
    )
    # w before and V after, in which the phases at the far ends stand alone
    before = loss * (last.cosine - early * (1 / (beta * ratio))) * first.csch
    after = (then.cosine - late * (1 / (beta * ratio))) * second.csch
    return Row(mismatch, before, at, after)


class Arc(NamedTuple):
    """A flight: phases of its ends, and its duration."""

    phase: arb
    next_phase: arb
    duration: arb


def stays_above(shaking: Shaking, arc: Arc, depth: int = DEPTH) -> bool | None:
    """Return whether flights are above the floor between their ends; None where undecided.

    By (E2), from both ends towards the middle, with y' where y begins or ends at 0.
    """
    beta = shaking.beta
    first, last = 1 - beta * arc.phase.sin(), 1 + beta * arc.next_phase.sin()
    ends = (arc.phase, 1, first, last), (arc.next_phase - arb.pi(), -1, last, first)
    parts = [_rises(shaking, arc.duration, *end, depth=depth) for end in ends]
    return False if False in parts else (None if None in parts else True)


def _rises(
    shaking: Shaking, duration: arb, phase: arb, sense: int, near: arb, far: arb, *, depth: int
) -> bool | None:
    """Return whether half of a flight is above the floor, counted from one of its ends."""
    beta, speed, span = shaking.beta, sense * shaking.ratio, 1 - (-2 * duration).exp()

    def state(u: arb) -> tuple[arb, arb]:
        decay, back = (-u).exp(), (u - 2 * duration).exp()
        up, down = (u - duration).exp(), (-u - duration).exp()
        sine, cosine = (phase + speed * u).sin_cos()
        height = 1 - beta * sine - (near * (decay - back) + far * (up - down)) / span
        return height, (near * (decay + back) - far * (up + down)) / span - beta * speed * cosine

    stack = [(hull(0, above(duration) / 2), True, depth)]
    while stack:
        u, lead, left = stack.pop()
        height, slope = state(u)
        if height > 0 or (lead and slope > 0):
            continue
        centre = mid(u)
        middle = state(centre)[0]
        if not lead and middle + slope * (u - centre) > 0:
            continue
        if middle < 0:
            return False
        if left == 0:
            return None
        early, late = halves(u)
        stack += [(late, False, left - 1), (early, lead, left - 1)]
    return True
