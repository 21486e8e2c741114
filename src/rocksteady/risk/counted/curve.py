"""Shares over levels as counted, and the monotone curve through them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.checks.arrays import guard_result
from rocksteady.risk.counted.count import Count

KEPT: Final = (1e12, 1e6)
"""Weights of the levels whose counts are kept, beside 1 of others."""
SAME: Final = 1e-9
"""Relative distance of levels that are the same."""


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """Counted shares of a state over levels, and what is known without a run.

    Attributes
    ----------
    levels
        Shape (levels,), rising.
    counts
        The count at each level.
    lifts_at
        Level at which each run first lifts, sorted, shape (runs,); infinite of one that never does.
    through
        Levels whose counts the monotone curve keeps, two at most, the first before the second: a
        demand and 1.1 times it.
    """

    levels: Floats
    counts: Sequence[Count]
    lifts_at: Floats
    through: tuple[float, ...] = ()

    @property
    def shares(self) -> Floats:
        """Counted share at each level."""
        return np.array([count.share for count in self.counts])

    @property
    def steps(self) -> Floats:
        """Monotone shares at the levels: those nearest to the counted ones."""
        return self.monotone(self.shares)

    def monotone(self, shares: Floats) -> Floats:
        """Return the monotone shares nearest to some at the levels."""
        weights = np.ones(len(self.levels))
        for level, weight in zip(self.through, KEPT, strict=False):
            weights[np.isclose(self.levels, level, rtol=SAME, atol=0.0)] = weight
        return monotone(shares, weights)

    @property
    def is_monotone(self) -> bool:
        """Whether no share is below one at a lower level."""
        return bool((np.diff(self.shares) >= 0.0).all())

    def lifting(self, level: ArrayLike) -> Floats:
        """Return the share of the runs that lift at some levels, exactly."""
        at = np.asarray(level, dtype=np.float64)
        return np.asarray(np.searchsorted(self.lifts_at, at, side="left") / len(self.lifts_at))

    def at(self, level: ArrayLike) -> Floats:
        """Return the share at some levels, on straight lines over the logarithm of the level.

        Below the lowest level that lifts it is 0, and above no level more than lift there; beyond
        the last level it is that of the last.
        """
        at = np.asarray(level, dtype=np.float64)
        return np.asarray(np.minimum(self.between(at, self.steps), self.lifting(at)))

    def between(self, level: Floats, shares: Floats) -> Floats:
        """Return what lies between monotone shares of the levels, from none at the first uplift."""
        levels, values, first = self.levels, shares, float(self.lifts_at[0])
        if first < levels[0]:
            levels, values = np.append(first, levels), np.append(0.0, shares)
        return np.interp(np.log(level), np.log(levels), values, left=0.0)


def monotone(shares: Floats, weights: Floats | None = None) -> Floats:
    """Return the rising values nearest to some shares, by their squares."""
    from scipy.optimize import isotonic_regression

    return np.asarray(isotonic_regression(shares, weights=weights).x)
