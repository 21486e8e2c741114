"""Fate of one run proved: a block at rest falls, or stands, under a pulse or a record."""

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from rocksteady.certify.balls import (
    above,
    arb,
    ball,
    below,
    ctx,
    decimal_of,
    halves,
    hull,
    mid,
    precision,
    size,
)
from rocksteady.certify.certificate import (
    PROVED,
    UNDECIDED,
    Certificate,
    Numbers,
    attempts,
    check_model,
    harmonic_numbers,
    place,
)
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Linear
from rocksteady.model.motions._pulse_shapes import pieces_of
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Fact
from rocksteady.results.numbers import plural

MOST_BITS = 4096
"""Default precision at which the proof of a fate gives up."""
FALLS, STANDS = "falls", "stands"
BISECTIONS = 100
"""Bisections of a stretch of a flight after which a landing is undecided."""
SLOW = 0.2
"""Speed after an impact from which down a proof of rest is tried."""


class UndecidedError(Exception):
    """A comparison of balls is undecided: more bits are needed."""


class Span(NamedTuple):
    """A stretch of base acceleration c + c' t + A sin(phase + Omega t) over alpha g."""

    duration: arb
    constant: arb
    slope: arb
    amplitude: arb | None = None
    ratio: arb | None = None
    phase: arb | None = None

    def base(self, t: arb) -> arb:
        """Return the base acceleration."""
        line = self.constant + self.slope * t
        if self.amplitude is None:
            return line
        return line + self.amplitude * (self.phase + self.ratio * t).sin()

    def rate(self, t: arb) -> arb:
        """Return its derivative."""
        if self.amplitude is None:
            return self.slope
        return self.slope + self.amplitude * self.ratio * (self.phase + self.ratio * t).cos()

    def forced(self, t: arb, side: int) -> tuple[arb, arb]:
        """Return q + q' and q - q' of the forced part q of a flight on a side."""
        level = 1 - side * (self.constant + self.slope * t)
        rise = -side * self.slope
        if self.amplitude is not None and self.ratio is not None:
            beta = side * self.amplitude / (1 + self.ratio * self.ratio)
            sine, cosine = (self.phase + self.ratio * t).sin_cos()
            level, rise = level - beta * sine, rise - beta * self.ratio * cosine
        return level + rise, level - rise


class Flight(NamedTuple):
    """A flight in a span: time, side, and y + y' and y - y' there; `grounded` where y is 0.

    `lifting` says that it begins at rest, where the acceleration turns upwards.
    """

    time: arb
    side: int
    growing: arb
    decaying: arb
    grounded: bool = False
    lifting: bool = False


class Fate(NamedTuple):
    """How a run ends, after how many impacts, and by which argument."""

    outcome: str
    impacts: int
    by: str


@dataclass(frozen=True)
class March:
    """A run from rest under spans of base acceleration, followed by a still base."""

    spans: Sequence[Span]
    restitution: arb

    def run(self) -> Fate:
        """Return the fate.

        Raises
        ------
        UndecidedError
            If a comparison is undecided.
        """
        impacts = 0
        index, flight = self._uplift(0, arb(0))
        while flight is not None:
            if index == len(self.spans):
                return self._on_still_base(flight, impacts)
            time = self._landing(index, flight)
            if time is None:
                flight = self._end_of(index, flight)
                index += 1
                if self._gone(index, flight):
                    return Fate(FALLS, impacts, "no acceleration to come brings it back")
                continue
            growing, decaying = self._state(index, flight, time)
            speed = self.restitution * (decaying - growing) / 2
            if not speed > 0:
                raise UndecidedError
            impacts += 1
            time = flight.time + time
            if self._rests(index, time, speed):
                index, flight = self._uplift(index, time)
            else:
                flight = Flight(time, -flight.side, speed, -speed, grounded=True)
        return Fate(STANDS, impacts, "at rest when the motion ends")

    @cached_property
    def ceilings(self) -> list[arb]:
        """Largest base acceleration still to come, at the start of each span of lines."""
        highest = arb(0)
        found = [highest]
        for span in reversed(self.spans):
            ends = (abs(span.base(arb(0))), abs(span.base(span.duration)))
            here = ends[0].max(ends[1]) if span.amplitude is None else arb.pos_inf()
            highest = highest.max(here)
            found.append(highest)
        return found[::-1]

    @cached_property
    def growths(self) -> dict[int, arb]:
        """The exponential of each duration, once for all samples of a record."""
        durations = {id(span.duration): span.duration for span in self.spans}
        return {key: duration.exp() for key, duration in durations.items()}

    def _state(self, index: int, flight: Flight, passed: arb | None) -> tuple[arb, arb]:
        """Return y + y' and y - y' after a time, or after a whole span."""
        span = self.spans[index]
        start = span.forced(flight.time, flight.side)
        if passed is None:
            growth = self.growths[id(span.duration)]
            end = span.forced(span.duration, flight.side)
        else:
            growth = passed.exp()
            end = span.forced(flight.time + passed, flight.side)
        growing = growth * (flight.growing - start[0]) + end[0]
        return growing, (flight.decaying - start[1]) / growth + end[1]

    def _end_of(self, index: int, flight: Flight) -> Flight:
        """Return a flight at the end of a span in which it does not land."""
        whole = flight.time.is_zero()
        left = None if whole else self.spans[index].duration - flight.time
        return Flight(arb(0), flight.side, *self._state(index, flight, left))

    def _landing(self, index: int, flight: Flight) -> arb | None:
        """Return the time of the first landing in a span since the start of a flight, if any."""
        span, side = self.spans[index], flight.side
        left = span.duration - flight.time
        if span.amplitude is None:
            pulls = (1 - side * span.base(t) for t in (flight.time, span.duration))
            pull = max_of(arb(0), *pulls)
            height = arb(0) if flight.grounded else (flight.growing + flight.decaying) / 2
            speed = (flight.growing - flight.decaying) / 2
            low = height + (speed - pull * left / 2) * left
            if low > 0 and (flight.grounded or height > 0):
                return None
            if flight.lifting and side * span.slope > 0:
                return None

        def curve(u: arb, *, slope: bool) -> arb:
            growing, decaying = self._state(index, flight, u)
            return (growing - decaying if slope else growing + decaying) / 2

        def rises(u: arb) -> bool:
            t = flight.time + u
            pushed = side * span.base(t) > 1 or side * span.rate(t) > 0
            return bool(pushed) if flight.lifting else bool(curve(u, slope=True) > 0)

        time = first_zero(curve, hull(0, above(left)), rises if flight.grounded else None)
        if time is None or time > left:
            return None
        if not time < left:
            raise UndecidedError
        return time

    def _uplift(self, index: int, time: arb) -> tuple[int, Flight | None]:
        """Return the next uplift of a block at rest and its span; no flight if there is none."""
        for number in range(index, len(self.spans)):
            span = self.spans[number]
            found = []
            for side in (1, -1):
                moment = _crossing(span, time, side)
                if moment is not None:
                    found.append((moment, side))
            if len(found) == 2 and not (found[0][0] < found[1][0] or found[1][0] < found[0][0]):
                raise UndecidedError
            if found:
                moment, side = found[0] if len(found) == 1 or found[0][0] < found[1][0] else found[1]
                still = arb(0)
                flight = Flight(moment, side, still, still, grounded=True, lifting=True)
                return number, flight
            time = arb(0)
        return len(self.spans), None

    def _gone(self, index: int, flight: Flight) -> bool:
        """Return whether a flight cannot come back, whatever acceleration is still to come."""
        height = (flight.growing + flight.decaying) / 2
        return bool(flight.growing > flight.decaying and height > 1 + self.ceilings[index])

    def _on_still_base(self, flight: Flight, impacts: int) -> Fate:
        """Return the fate of a flight after the motion, by its growing part and its energy."""
        growing, decaying = flight.growing, flight.decaying
        if growing > 1:
            return Fate(FALLS, impacts, "it leaves the balance in free flight")
        if growing < 1:
            speed = self.restitution * (growing + decaying - growing * decaying).sqrt()
            if speed < 1:
                return Fate(STANDS, impacts, "its energy is below that of the balance")
            if speed > 1:
                return Fate(FALLS, impacts + 1, "its energy takes it over the balance")
        raise UndecidedError

    def _rests(self, index: int, time: arb, speed: arb) -> bool:
        """Return whether all bounces from an impact on are proved to die out before an uplift.

        By the theorem of docs/theory/march.md, "Rest and chatter", in one window.
        """
        now = abs(self.spans[index].base(time))
        if not (speed < SLOW and now < 1 and self.restitution < 1):
            return False
        window = above(4 * speed / ((1 - now) * (1 - self.restitution)))
        if not window < 100:
            return False
        highest, steepest, start, left = now, arb(0), time, window
        for span in self.spans[index:]:
            end = start + left
            over = not end < span.duration
            part = hull(below(start), above(span.duration if over else end))
            highest = max_of(highest, abs(span.base(part)))
            steepest = max_of(steepest, abs(span.rate(part)))
            if not over:
                break
            start, left = arb(0), above(end - span.duration)
        pull = 1 - above(highest)
        if not pull > speed:
            return False
        least = (pull * pull - speed * speed).sqrt()
        kept = self.restitution * (1 + 4 * steepest * speed / (pull * least)).sqrt()
        return bool(kept < 1 and 2 * speed / (least * (1 - kept)) <= window)


def _crossing(span: Span, time: arb, side: int) -> arb | None:
    """Return when the base acceleration first lifts a block at rest towards a side, if it does."""
    first, last = side * span.base(time), side * span.base(span.duration)
    if first > 1:
        if time.is_zero():
            return time
        raise UndecidedError
    if span.amplitude is None:
        if last <= 1 and first <= 1:
            return None
        if not (last > 1 and first < 1):
            raise UndecidedError
        return (side - span.constant) / span.slope

    def curve(u: arb, *, slope: bool) -> arb:
        return -side * span.rate(u) if slope else 1 - side * span.base(u)

    if abs(span.constant) + abs(span.slope) * span.duration + abs(span.amplitude) <= 1:
        return None
    return first_zero(curve, hull(below(time), above(span.duration)), None)


def first_zero(
    curve: Callable[..., arb], whole: arb, rises: Callable[[arb], bool] | None
) -> arb | None:
    """Return the first zero of curves that begin above 0, all of them falling there; None if none.

    Parameters
    ----------
    curve
        Returns the value over a ball of times, or the slope there.
    whole
        The times.
    rises
        Decides that the curves are above 0 after their start, where they begin at 0.

    Raises
    ------
    UndecidedError
        If curves touch 0, or the balls are too wide.
    """
    stack = [(whole, BISECTIONS, rises is not None)]
    while stack:
        u, left, grounded = stack.pop()
        if curve(u, slope=False) > 0 or (grounded and rises is not None and rises(u)):
            continue
        slope, centre = curve(u, slope=True), mid(u)
        if not grounded:
            if curve(centre, slope=False) + slope * (u - centre) > 0:
                continue
            if slope < 0:
                end = curve(above(u), slope=False)
                if end > 0:
                    continue
                if end < 0:
                    return _contracted(curve, u, slope)
        if left == 0 or size(u - centre) < 2.0 ** (-ctx.prec):
            raise UndecidedError
        early, late = halves(u)
        stack += [(late, left - 1, False), (early, left - 1, grounded)]
    return None


def _contracted(curve: Callable[..., arb], u: arb, slope: arb) -> arb:
    """Return the zeros of curves that fall through 0 in a ball, by Newton's method in balls."""
    while True:
        centre = mid(u)
        narrow = u.intersection(centre - curve(centre, slope=False) / slope)
        if not size(narrow - mid(narrow)) < 0.7 * size(u - centre):
            return narrow
        u, slope = narrow, curve(narrow, slope=True)
        if not slope < 0:
            raise UndecidedError


def max_of(first: arb, *others: arb) -> arb:
    """Return the largest of numbers in balls."""
    for other in others:
        first = first.max(other)
    return first


def pulse_spans(pulse: Pulse, amplitude: arb, ratio: arb) -> list[Span]:
    """Return the spans of a pulse that is exact: its pieces last whole quarters of its period.

    Raises
    ------
    ModelError
        If it is sampled, or its phase has no closed form.
    """
    pieces = () if pulse.shape.startswith("type-c") else pieces_of(pulse.shape)
    if not pieces:
        raise ModelError(
            "motion",
            Words(f"is a {pulse.shape} pulse"),
            "proofs lack an enclosure of its samples or of its phase",
            "take one of half a period or of a period, as one-sine",
        )
    size_of = -amplitude if pulse.reverse else amplitude
    spans = []
    for piece in pieces:
        duration = quarters(piece.turn) / ratio
        line = size_of * piece.constant, size_of * piece.slope / duration
        wave = (size_of * piece.size, ratio * piece.turns, quarters(piece.phase))
        spans.append(Span(duration, *line, *(wave if piece.size else ())))
    return spans


def quarters(angle: float) -> arb:
    """Return the multiple of pi/2 that an angle is the double of."""
    return arb.pi() * round(2.0 * angle / float(arb.pi().mid())) / 2


def record_spans(record: Record, dt: arb, unit: arb) -> list[Span]:
    """Return the spans of a record: lines between its samples, in units of alpha g."""
    samples = [arb(x) / unit for x in record.acceleration_m_s2.tolist()]
    pairs = zip(samples[:-1], samples[1:], strict=True)
    return [Span(dt, here, (then - here) / dt) for here, then in pairs]


def digest(record: Record) -> str:
    """Return the SHA-256 of a record's samples, as doubles of eight bytes, lowest byte first."""
    return hashlib.sha256(record.acceleration_m_s2.astype("<f8").tobytes()).hexdigest()


def prove_fate(
    spans: Callable[[list[arb]], list[Span]], numbers: Numbers, most_bits: int = MOST_BITS
) -> tuple[Fate | None, int, Numbers]:
    """Return the fate of a run, the bits that decided it, and of which numbers it is that.

    Parameters
    ----------
    spans
        Returns the spans for the numbers in balls.
    numbers
        The numbers of the claim; the last one is the restitution.
    most_bits
        Precision at which the proof gives up.
    """
    bits, given = 0, numbers
    for bits, given in attempts(numbers, most_bits):
        with precision(bits):
            balls = [ball(texts) for texts in given.values()]
            try:
                return March(spans(balls[:-1]), balls[-1]).run(), bits, given
            except (UndecidedError, ValueError, ZeroDivisionError):
                continue
    return None, bits, given


@checked
def certify_fate(
    block: Block | DimensionlessBlock, motion: Pulse | Record, *, most_bits: int = MOST_BITS
) -> Certificate:
    """Prove whether a block at rest falls or stands.

    Each first impact is found and proved in balls, rest by the theorem of docs/theory/march.md,
    and the end by the growing part of a flight or by its energy.  A record's samples are the
    doubles that it holds, and the block's numbers are doubles.

    Parameters
    ----------
    block
        A block of equal sides; its equations are the linear ones.
    motion
        A record, or a pulse whose shape is exact.
    most_bits
        Precision at which the proof gives up.

    Raises
    ------
    ModelError
        If no proof is written for the block or the motion.

    Examples
    --------
    >>> import rocksteady as rs
    >>> block = rs.DimensionlessBlock(restitution=0.9)
    >>> pulse = rs.Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=2.0)
    >>> certify_fate(block, pulse).claim
    'the block falls: one-sine pulse, A = 2.0, W = 2.0, restitution = 0.9'
    """
    check_model(block, Linear())
    if isinstance(motion, Pulse):
        numbers = harmonic_numbers(motion.amplitude, motion.frequency_ratio, block.restitution)
        what = f"{'reversed ' * motion.reverse}{motion.shape} pulse"
        content: dict[str, object] = {"pulse": motion.shape, "reverse": motion.reverse}
        fate, bits, given = prove_fate(
            lambda balls: pulse_spans(motion, *balls), numbers, most_bits
        )
    else:
        if not isinstance(block, Block):
            raise ModelError(
                "motion",
                Words("is a record"),
                "a record in seconds and m/s^2 needs a block with sizes",
                "give a Block, which has p and alpha g",
            )
        doubles = {
            "alpha": block.alpha,
            "p": block.p,
            "gravity": block.gravity,
            "dt_s": motion.dt_s,
            "restitution": block.restitution,
        }
        numbers = {name: (decimal_of(Fraction(x)),) for name, x in doubles.items()}
        what = f"record{f' {motion.name}' if motion.name else ''}"
        content = {"samples": len(motion.acceleration_m_s2), "sha256": digest(motion)}
        fate, bits, given = prove_fate(
            lambda balls: record_spans(motion, balls[1] * balls[3], balls[0] * balls[2]),
            numbers,
            most_bits,
        )
    if isinstance(motion, Pulse):
        what = f"{what}, {place(given)}"
    if fate is None:
        reason = f"a landing, a rest or the end is undecided with {bits} bits"
        return Certificate(
            kind="fate",
            verdict=UNDECIDED,
            claim=f"the block falls or stands: {what}",
            model=given,
            bits=bits,
            content={},
            reason=reason,
        )
    content |= {"bits": bits, "claim": {"outcome": fate.outcome, "impacts": fate.impacts}}
    return Certificate(
        kind="fate",
        verdict=PROVED,
        claim=f"the block {fate.outcome}: {what}",
        model=given,
        bits=bits,
        content=content,
        facts=(
            Fact("outcome", fate.outcome),
            Fact("impacts", fate.impacts, "impacts", plural(fate.impacts, "impact")),
            Fact("by", fate.by, "because", fate.by),
        ),
    )
