"""What a block settles to, in the paper's words, and how that depends on where it starts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from rocksteady import (
    AttractorKind,
    DimensionlessBlock,
    Harmonic,
    Orbit,
    Rest,
    State,
    Steady,
    attractor,
    simulate,
)


class Kind(StrEnum):
    """What became of a block."""

    REST = "at rest"
    SYMMETRIC = "symmetric harmonic"
    UNSYMMETRIC = "unsymmetric harmonic"
    SUBHARMONIC = "subharmonic"
    OVERTURNED = "overturned"
    UNSETTLED = "not settled"


@dataclass(frozen=True, kw_only=True)
class Fate:
    """What a block settles to.

    Attributes
    ----------
    kind
        What became of it.
    orbit
        The periodic motion; None where it rests, overturns or does not settle.
    overturned_after
        Excitation periods until it passes |theta| = alpha for good; nan unless it does.
    """

    kind: Kind
    orbit: Orbit | None = None
    overturned_after: float = math.nan

    @property
    def period(self) -> int:
        """Excitation periods after which the motion repeats itself; 0 unless it does."""
        return 0 if self.orbit is None else self.orbit.period

    @property
    def symmetric(self) -> bool:
        """Whether half of that turns it into its mirror image."""
        return self.orbit is not None and self.orbit.symmetric

    @property
    def highest(self) -> float:
        """Highest theta/alpha of the motion; nan where there is none."""
        return math.nan if self.orbit is None else self.orbit.highest

    @property
    def lowest(self) -> float:
        """Lowest theta/alpha of the motion; nan where there is none."""
        return math.nan if self.orbit is None else self.orbit.lowest

    @property
    def label(self) -> str:
        """What became of the block, in a few words."""
        if self.kind is Kind.OVERTURNED:
            return f"overturns after {self.overturned_after:.1f} periods"
        if self.kind is Kind.SUBHARMONIC:
            shape = "symmetric" if self.symmetric else "unsymmetric"
            return f"{shape} 1/{self.period} subharmonic"
        return self.kind.value

    @property
    def bias(self) -> int:
        """Side to which an unsymmetric motion leans, +1 or -1; 0 for every other."""
        if self.orbit is None or self.symmetric:
            return 0
        return 1 if self.highest > -self.lowest else -1


def settle(
    restitution: float, shaking: Harmonic, start: Rest | State | Steady, *, side: int = 1
) -> Fate:
    """Return what a block settles to from a start.

    Parameters
    ----------
    restitution
        Of the block, in (0, 1].
    shaking
        The base motion; a `Steady` start decides on its phase.
    start
        Where the block begins.
    side
        +1 or -1, on which an unstable steady state is left.
    """
    block = DimensionlessBlock(restitution=restitution)
    found = attractor(block, shaking, start=start, side=side)
    if found.orbit is not None:
        kind = Kind.SUBHARMONIC
        if found.orbit.period == 1:
            kind = Kind.SYMMETRIC if found.orbit.symmetric else Kind.UNSYMMETRIC
        return Fate(kind=kind, orbit=found.orbit)
    if found.kind is AttractorKind.REST:
        return Fate(kind=Kind.REST)
    if found.kind is AttractorKind.OVERTURNED:
        # The block may still go on for some periods after its last impact.
        run = simulate(block, shaking, start=start, side=side, cycles=found.after + 1000)
        assert run.overturn_tau is not None
        return Fate(kind=Kind.OVERTURNED, overturned_after=run.overturn_tau / (2.0 * math.pi))
    return Fate(kind=Kind.UNSETTLED)


def fates_over_kicks(
    restitution: float, shaking: Harmonic, start: Steady, *, side: int, kicks: Sequence[float]
) -> list[Fate]:
    """Return what a block settles to for each distance at which it leaves a steady state."""
    return [
        settle(
            restitution,
            shaking,
            Steady(branch=start.branch, order=start.order, kick=kick),
            side=side,
        )
        for kick in kicks
    ]
