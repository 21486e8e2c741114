"""Intervals of a parameter in which an orbit with rest keeps its uplifts, and their borders."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from rocksteady.dynamics.continuation.resting._legs import (
    Pattern,
    Sample,
    Uplifts,
    apart,
    bend,
    first_jump,
)
from rocksteady.dynamics.continuation.resting.resting_types import NoRest, RestingPointType

HALVINGS = 3
"""Times that a step is halved where its ends differ, before the border between them is located."""
CELLS = 32
"""Steps into which a branch is divided at least."""
LEAST = 0.125
"""Part of a step: into branches shorter than that no gap is looked for."""
BENT = 0.02
"""Departure of the impacts from straight lines between two points of a branch [rad]."""
FINEST = 2.0**-14
"""Part of a branch below which a step is not halved for that."""
JUMP = 1e-5
"""Difference of an impact's phase on either side of a value from which on it is a jump [rad]."""
BESIDE = 1e-9
"""Part of an interval, beside a border, in which rounding may decide."""


class Span(NamedTuple):
    """Values over which an orbit with rest keeps its pattern."""

    low: float
    high: float
    pattern: Pattern
    begin: RestingPointType
    end: RestingPointType


class Spot(NamedTuple):
    """A value at which a branch has a point."""

    value: float
    type: RestingPointType
    gains: int = 0  # of a graze: 1 where impacts are added as the parameter grows, -1 removed
    touch: tuple[int, int] = (-1, -1)  # leg and impact that touches


class Tracer:
    """Orbits with rest through one uplift over a parameter.

    Parameters
    ----------
    uplifts
        What follows from the uplifts.
    side
        The side of the uplift.
    """

    def __init__(self, uplifts: Uplifts, side: int) -> None:
        self.uplifts, self.side = uplifts, side
        self._samples: dict[float, Sample] = {}

    def sample(self, value: float) -> Sample:
        """Return the orbit at a value, computed once."""
        if value not in self._samples:
            self._samples[value] = self.uplifts.sample(value, self.side)
        return self._samples[value]

    def pattern(self, value: float) -> Pattern:
        """Return the pattern of the orbit at a value; empty where there is none."""
        sample = self.sample(value)
        return sample.pattern if sample.failure is None else ()

    def looked(self, low: float, high: float) -> list[float]:
        """Return the values between two at which it was looked for an orbit."""
        return [value for value in self._samples if low < value < high]

    def failure(self, value: float) -> NoRest | None:
        """Return why there is no orbit at a value."""
        return self.sample(value).failure

    def spans(self, low: float, high: float, largest_step: float) -> list[Span]:
        """Return the intervals of a range in which there is an orbit, in order."""
        count, least = max(1, math.ceil((high - low) / largest_step)), LEAST * largest_step
        even = [low + (high - low) * (k / count) for k in range(count)] + [high]
        values = [low]
        for a, b in pairwise(even):
            values += [*self._between(a, b, HALVINGS), b]
        spans: list[Span] = []
        begin, kind = low, RestingPointType.RANGE_END
        for a, b in pairwise(values):
            here, pattern_end = self.pattern(a), self.pattern(b)
            if here == pattern_end:
                continue
            if here:
                end, _, why = self.edge(a, b)
                spans += self._whole(Span(begin, end, here, kind, why), least)
            if pattern_end:
                begin, _, kind = self.edge(b, a)
        if self.pattern(high):
            last = Span(begin, high, self.pattern(high), kind, RestingPointType.RANGE_END)
            spans += self._whole(last, least)
        return spans

    def thresholds(self, low: float, high: float, largest_step: float) -> list[float]:
        """Return the largest values on one side of which the shaking begins to lift the block."""

        def lifts(value: float) -> bool:
            return any(self.uplifts.lifted(value))

        def lies_still(value: float) -> bool:
            return not lifts(value)

        count = max(1, math.ceil((high - low) / largest_step))
        even = [low + (high - low) * (k / count) for k in range(count)] + [high]
        return [
            bisected(a, b, lifts if lifts(a) else lies_still)[0]
            for a, b in pairwise(even)
            if lifts(a) != lifts(b)
        ]

    def span_around(self, value: float, low: float, high: float, step: float) -> Span:
        """Return the interval around a value at which there is an orbit."""
        pattern, ends = self.pattern(value), [value, value]
        types = [RestingPointType.RANGE_END] * 2
        for place, limit in enumerate((low, high)):
            count = math.ceil(abs(limit - value) / step)
            for k in range(1, count + 1):
                value_at = limit if k == count else value + (limit - value) * (k / count)
                if self.pattern(value_at) != pattern:
                    ends[place], _, types[place] = self.edge(ends[place], value_at)
                    break
                ends[place] = value_at
        whole = Span(ends[0], ends[1], pattern, types[0], types[1])
        return next(
            each for each in self._whole(whole, step * LEAST) if each.low <= value <= each.high
        )

    def _between(self, a: float, b: float, depth: int) -> Iterator[float]:
        """Yield values between two that differ."""
        if depth == 0 or self.pattern(a) == self.pattern(b):
            return
        middle = 0.5 * (a + b)
        yield from self._between(a, middle, depth - 1)
        yield middle
        yield from self._between(middle, b, depth - 1)

    def _whole(self, span: Span, least: float) -> list[Span]:
        """Return the parts of an interval that it falls into where a gap in it was overlooked.

        Into an interval shorter than `least` it does not look.
        """
        if span.high - span.low < least:
            return [span]
        values = [spot.value for spot in self._spots(span)]
        matching = [value for value in values if self.sample(value).pattern == span.pattern]
        hole = next((value for value in values if value not in matching), None)
        if hole is None:
            return [span]
        before = max(value for value in matching if value < hole)
        after = min(value for value in matching if value > hole)
        left, beyond, end = self.edge(before, hole)
        right, short, begin = self.edge(after, hole)
        parts = self._whole(span._replace(high=left, end=end), least)
        if self.pattern(hole):
            low, _, first = self.edge(hole, beyond)
            high, _, last = self.edge(hole, short)
            parts += self._whole(Span(low, high, self.pattern(hole), first, last), least)
        return parts + self._whole(span._replace(low=right, begin=begin), least)

    def edge(self, inside: float, outside: float) -> tuple[float, float, RestingPointType]:
        """Return the last value at which an orbit has its pattern, the next one, and the type."""
        pattern = self.sample(inside).pattern
        # A motion that is longer is another one, and is not followed to its end.
        period = sum(half_cycles for _, half_cycles in pattern) // 2
        only = Tracer(replace(self.uplifts, longest=period), self.side)

        def same(value: float) -> bool:
            return only.sample(value).pattern == pattern

        def kept(value: float) -> bool:
            return only.pattern(value) == pattern  # and by more than rounding

        if same(outside):
            return *bisected(inside, outside, kept), RestingPointType.UNDECIDED
        last, beyond = bisected(inside, outside, same)
        near = last + BESIDE * (inside - last)
        if not only.sample(near).decided:
            return *bisected(inside, near, kept), RestingPointType.UNDECIDED
        lifts = self.uplifts.lifted(last) != self.uplifts.lifted(beyond)
        return last, beyond, RestingPointType.UPLIFT if lifts else RestingPointType.REST_END

    def spots(self, span: Span) -> list[Spot]:
        """Return the values at which a branch has points, grazes included."""
        return [s for s in self._spots(span) if self.sample(s.value).pattern == span.pattern]

    def _spots(self, span: Span) -> list[Spot]:
        """Return these values, and those where a gap was overlooked."""
        width = span.high - span.low
        if width == 0.0:
            return [Spot(span.low, span.begin)]
        even = [span.low + width * (k / CELLS) for k in range(CELLS)] + [span.high]
        spots = [Spot(span.low, span.begin)]
        for a, b in pairwise(even):
            spots += [
                *self._curved(a, b, FINEST * width, span.pattern),
                Spot(b, RestingPointType.REGULAR),
            ]
        spots[-1] = Spot(span.high, span.end)
        unique = {spot.value: spot for spot in spots if spot.type is RestingPointType.REGULAR}
        unique |= {spot.value: spot for spot in spots if spot.type is not RestingPointType.REGULAR}
        return [unique[value] for value in sorted(unique)]

    def _curved(self, a: float, b: float, finest: float, pattern: Pattern) -> Iterator[Spot]:
        """Yield values between two where the impacts do not lie on straight lines."""
        middle = 0.5 * (a + b)
        if not a < middle < b:
            return
        low, high = self.sample(a), self.sample(b)
        between = self.sample(middle)
        if {low.pattern, high.pattern, between.pattern} != {pattern}:
            if between.pattern != pattern:  # a gap that was overlooked
                yield Spot(middle, RestingPointType.REGULAR)
            return
        if bend(low, between, high) <= BENT:
            return
        if b - a > finest:
            yield from self._curved(a, middle, finest, pattern)
            yield Spot(middle, RestingPointType.REGULAR)
            yield from self._curved(middle, b, finest, pattern)
            return
        left, right = a, b
        while left < (middle := 0.5 * (left + right)) < right:
            near, here, far = self.sample(left), self.sample(middle), self.sample(right)
            if here.pattern != near.pattern:  # a gap, and narrow
                yield Spot(middle, RestingPointType.REGULAR)
                return
            if apart(near, here) >= apart(here, far):
                right = middle
            else:
                left = middle
        jump = first_jump(self.sample(left), self.sample(right), JUMP)
        if jump is not None:
            row, k, change = jump
            # The side on which the impact comes earlier has the touch.
            gains = 1 if change < 0.0 else -1
            ends = [Spot(end, RestingPointType.REGULAR) for end in (left, right)]
            place = 1 if gains > 0 else 0
            ends[place] = Spot(ends[place].value, RestingPointType.GRAZING, gains, (row, k))
            yield from ends


def bisected(inside: float, outside: float, holds: Callable[[float], bool]) -> tuple[float, float]:
    """Return neighbouring numbers between which something ceases to hold."""
    while True:
        middle = 0.5 * (inside + outside)
        if middle in (inside, outside):
            return inside, outside
        if holds(middle):
            inside = middle
        else:
            outside = middle
