"""Types of points on branches of orbits with rest, and reasons why there is none."""

from enum import StrEnum


class RestingPointType(StrEnum):
    """Type of a point on a branch of orbits with rest."""

    REGULAR = "regular"
    GRAZING = "grazing"
    """A flight touches the base: on one side of the point there are two impacts more.  The orbit
    and its branch go on, and all angles are continuous."""
    UPLIFT = "uplift"
    """The shaking just lifts the block to a side: beyond, it does not, and the flights to this side
    vanish at the point."""
    REST_END = "end-of-rest"
    """The bounces die out exactly when a side lifts: beyond, the block still bounces then."""
    RANGE_END = "end-of-range"
    """The branch leaves the range of its parameter."""
    UNDECIDED = "undecided"
    """Beyond, a small difference grows by more than 1e12 between two rests: rounding decides."""


class NoRest(StrEnum):
    """Why no orbit with rest passes through an uplift."""

    BELOW_UPLIFT = "below-uplift"
    """The shaking never lifts the block."""
    OVERTURNS = "overturns"
    """Lifted from rest, the block falls."""
    NOT_WITHIN = "no-rest"
    """It does not rest, or not in the same way again, within the longest period."""
    UNDECIDED = "undecided"
    """A small difference grows by more than 1e12 before the rest: rounding decides."""
    ELSEWHERE = "elsewhere"
    """The motion leads to an orbit with rest that passes through the other side's uplift."""
