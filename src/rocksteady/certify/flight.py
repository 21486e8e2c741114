"""Flights between impact phases in balls, in the side frame of docs/theory/march.md.

A flight is known by the phases of its two impacts and its duration (E2), and a chain of flights is
a motion where each impact fits the flights before and after it (E3): the forms of
docs/theory/proofs.md, of which no term grows with the length of the flight.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from rocksteady.certify.balls import Stated, above, arb, ball, below, halves, hull, mid

DEPTH = 60
"""Bisections of a flight after which its height above the floor is undecided."""


@dataclass(frozen=True)
class Shaking:
    """Amplitude, frequency ratio and restitution, as balls or as power series of balls."""

    amplitude: Any
    ratio: arb
    restitution: arb

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
        return (next_phase - phase + half_periods * arb.pi()) * (1 / self.ratio)


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


def factors(duration: Any) -> Factors:
    """Return the factors of one duration, from the decaying exponential."""
    decay = (-duration).exp()
    square = decay * decay
    scale = 1 / (1 - square)
    return Factors((1 + square) * scale, 2 * decay * scale, (1 - decay) / (1 + decay))


def factors_from(duration: arb) -> Factors:
    """Return the factors of all durations from the least of a ball on."""
    coth, csch, tanh = factors(duration)
    return Factors(hull(1, coth), hull(0, csch), hull(tanh, 1))


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


def row(
    shaking: Shaking, last: Phase, here: Phase, then: Phase, *flights: Factors
) -> Row:
    """Return (E3) at an impact: e = (restitution V - w)/beta, with V before and w after it.

    Parameters
    ----------
    shaking
        Its parameters.
    last, here, then
        The impact phases before, at and after it.
    flights
        Factors of the flight before it and of the one after it.
    """
    first, second = flights
    beta, ratio, loss = shaking.beta, shaking.ratio, shaking.restitution
    both = loss * first.coth + second.coth
    inverse = 1 / beta
    mismatch = (
        here.sine * both
        + loss * last.sine * first.csch
        + then.sine * second.csch
        + (1 - loss) * ratio * here.cosine
        - (second.tanh - loss * first.tanh) * inverse
    )
    scale = inverse * (1 / ratio)
    early = (1 - beta * last.sine) * first.coth - (1 + beta * here.sine) * first.csch
    late = (1 + beta * then.sine) * second.coth - (1 - beta * here.sine) * second.csch
    at = (
        here.cosine * both
        - (1 - loss) * ratio * here.sine
        + (loss * early * first.csch + late * second.csch) * scale
    )
    # w before and V after, in which the phases at the far ends stand alone
    before = loss * (last.cosine - early * (1 / (beta * ratio))) * first.csch
    after = (then.cosine - late * (1 / (beta * ratio))) * second.csch
    return Row(mismatch, before, at, after)


class Arc(NamedTuple):
    """A flight, or all flights from a duration on: phases of its ends, and the (least) duration."""

    phase: arb
    next_phase: arb
    duration: arb
    longer: bool = False


def stays_above(shaking: Shaking, arc: Arc, depth: int = DEPTH) -> bool | None:
    """Return whether flights are above the floor between their ends; None where undecided.

    By (E2), from both ends towards the middle, with y' where y begins or ends at 0.
    """
    beta, least = shaking.beta, arc.duration
    first, last = 1 - beta * arc.phase.sin(), 1 + beta * arc.next_phase.sin()
    middle = below(least) / 2 if arc.longer else above(least) / 2
    span = 1 - (-2 * least).exp()
    if arc.longer:
        if not 1 - beta - 2 * hull(first, last) * (-middle).exp() / span > 0:
            return None
        span = hull(span, 1)
    ends = (arc.phase, 1, first, last), (arc.next_phase - arb.pi(), -1, last, first)
    found = [_rises(shaking, arc, span, middle, *end, depth=depth) for end in ends]
    return False if False in found else (None if None in found else True)


def _rises(  # noqa: PLR0917 -- the six numbers of a half of a flight
    shaking: Shaking,
    arc: Arc,
    span: arb,
    middle: arb,
    phase: arb,
    sense: int,
    near: arb,
    far: arb,
    *,
    depth: int,
) -> bool | None:
    """Return whether half of a flight is above the floor, counted from one of its ends."""
    beta, least = shaking.beta, arc.duration
    speed = sense * shaking.ratio

    def shrunk(value: arb) -> arb:
        return hull(0, value) if arc.longer else value

    def state(u: arb, *, slope: bool) -> arb:
        decay, back = (-u).exp(), shrunk((u - 2 * least).exp())
        up, down = (u - least).exp(), (-u - least).exp()
        sine, cosine = (phase + speed * u).sin_cos()
        if slope:
            return (near * (decay + back) - far * shrunk(up + down)) / span - beta * speed * cosine
        return 1 - beta * sine - (near * (decay - back) + far * shrunk(up - down)) / span

    return bisected(hull(0, middle), state, depth)


def bisected(whole: arb, state: Callable[..., arb], depth: int) -> bool | None:
    """Return whether a function that is 0 at 0 is positive on (0, end]; None where undecided."""
    stack = [(whole, True, depth)]
    while stack:
        u, lead, left = stack.pop()
        if state(u, slope=False) > 0:
            continue
        slope = state(u, slope=True)
        if lead and slope > 0:
            continue
        centre = mid(u)
        if not lead and state(centre, slope=False) + slope * (u - centre) > 0:
            continue
        if state(centre, slope=False) < 0:
            return False
        if left == 0:
            return None
        early, late = halves(u)
        stack += [(late, False, left - 1), (early, lead, left - 1)]
    return True
