"""What a point on a branch or on a curve of bifurcations may be, and why curves end."""

from enum import StrEnum


class PointType(StrEnum):
    """Type of a point on a branch."""

    REGULAR = "regular"
    FOLD = "fold"
    """Two orbits of one kind meet and the branch turns back: a multiplier passes 1."""
    SYMMETRY_BREAKING = "symmetry-breaking"
    """Two orbits that lean, mirror images of each other, branch off a symmetric one: half of it
    has the multiplier -1."""
    PERIOD_DOUBLING = "period-doubling"
    """A multiplier passes -1, and an orbit of twice the period branches off."""
    GRAZING = "grazing"
    """The block touches its base between two impacts, or two impacts merge: beyond, the solution
    passes through the floor.  A branch loses its admissibility in no other way."""
    CUSP = "cusp"
    """Two fold curves meet: three motions of one kind become one."""
    GENERALISED_BREAKING = "generalised-breaking"
    """Symmetry breaking meets fold: beyond, what branches off does so to the other side."""
    GENERALISED_DOUBLING = "generalised-doubling"
    """Period doubling meets the fold of the motions that branch off."""
    FOLD_GRAZE = "fold-graze"
    """The motion at a fold grazes."""
    BREAKING_GRAZE = "breaking-graze"
    """The motion whose symmetry breaks grazes."""
    DOUBLING_GRAZE = "doubling-graze"
    """The motion whose period doubles grazes."""
    DOUBLE_GRAZE = "double-graze"
    """A motion that grazes touches its base a second time, or two other impacts of it merge."""
    RESONANT_GRAZE = "resonant-graze"
    """Fold and flip of the motion with two impacts more meet at a graze: elsewhere they cannot."""
    RANGE_END = "end-of-range"
    """The branch leaves the range of its parameter."""
    CLOSED = "closed"
    """The branch is back where it began."""
    LIMIT = "limit"
    """The largest number of points was followed."""
    LOST = "lost"
    """The branch could not be followed on."""
    STALLED = "stalled"
    """The branch could be followed on in steps only that get nowhere."""


REASONS = {
    PointType.RANGE_END: "a parameter leaves its range",
    PointType.CLOSED: "it is back where it began",
    PointType.LIMIT: "the largest number of points was followed",
    PointType.LOST: "no next point satisfies its equations, however near",
    PointType.STALLED: "200 steps together were shorter than the largest one: the equations are "
    "near to singular there, or rounding is as large as their tolerance",
    PointType.GRAZING: "beyond, the solution passes through the floor",
    PointType.FOLD_GRAZE: "beyond, the solution at the fold passes through the floor",
    PointType.BREAKING_GRAZE: "beyond, the solution passes through the floor",
    PointType.DOUBLING_GRAZE: "beyond, the solution passes through the floor",
    PointType.DOUBLE_GRAZE: "beyond, the solution passes through the floor elsewhere",
    PointType.RESONANT_GRAZE: "two impacts merge, and beyond, the solution passes through the "
    "floor",
    PointType.GENERALISED_BREAKING: "the fold meets the symmetry breaking from which its "
    "motions branch off",
    PointType.GENERALISED_DOUBLING: "the fold meets the period doubling from which its motions "
    "branch off",
}
"""Why a branch or a curve ends at a point of a type."""


BIFURCATIONS = (
    PointType.FOLD,
    PointType.SYMMETRY_BREAKING,
    PointType.PERIOD_DOUBLING,
    PointType.GRAZING,
)
GRAZES = (
    PointType.GRAZING,
    PointType.FOLD_GRAZE,
    PointType.BREAKING_GRAZE,
    PointType.DOUBLING_GRAZE,
    PointType.DOUBLE_GRAZE,
    PointType.RESONANT_GRAZE,
)
"""Where the block touches its base, and rounding may not decide on admissibility."""
CODIMENSION_TWO = (
    PointType.CUSP,
    PointType.GENERALISED_BREAKING,
    PointType.GENERALISED_DOUBLING,
    *GRAZES[1:],
)
"""Points of a bifurcation curve at which a second condition is met."""
MARGINAL = (
    *BIFURCATIONS[:3],
    *(kind for kind in CODIMENSION_TWO if kind is not PointType.DOUBLE_GRAZE),
)
"""Where a multiplier lies on the unit circle, and rounding may not decide on stability."""
