"""Parameters of one object: those of its block, and those of the errors of its tests."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.risk.observations.spread import PriorRange

ALPHA, RATE, RATIO = 0, 2, 3
"""Columns of the sides of an object: slenderness, p, restitution."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Space:
    """What is free of an object, in a fixed order.

    Attributes
    ----------
    block
        What is known of the object.
    noise
        What is known of the errors of its tests.
    sessions
        Whether its tests come in sessions, each with a gain of its own.
    """

    block: ObjectPrior
    noise: OutcomeErrors
    sessions: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters: of the block, then those of the errors that are not exact."""
        return (*self.block.parameters, *(name for name, _ in self._free_noise()))

    @property
    def size(self) -> int:
        """How many there are."""
        return len(self.names)

    def spread(self, name: str) -> PriorRange:
        """Return the prior of a parameter."""
        prior = dict(self._free_noise()).get(name)
        return self.block.spreads[name] if prior is None else prior

    def values_of(self, scores: Floats) -> Floats:
        """Return values from normal scores: those of the prior are standard normal."""
        from scipy.special import ndtr

        shares = ndtr(scores)
        count = len(self.block.parameters)
        noise = [
            spread.quantile(shares[:, count + place])
            for place, (_, spread) in enumerate(self._free_noise())
        ]
        return np.column_stack([self.block.draw(shares[:, :count]), *noise])

    def block_values(self, values: Floats) -> Floats:
        """Return the columns of the block."""
        return values[:, : len(self.block.parameters)]

    def sigma(self, values: Floats, tests: Sequence[ShakingTest]) -> Floats:
        """Return the amplitude error of each test and draw, shape (tests, draws)."""
        general = self._noise("sigma_ln", values)
        rows = [
            general if test.sigma_ln is None else np.full(len(values), test.sigma_ln)
            for test in tests
        ]
        return np.array(rows)

    def between(self, values: Floats) -> Floats:
        """Return the deviation of ln(gain) between sessions of each draw, shape (draws,)."""
        return self._noise("session_ln", values) if self.sessions else np.zeros(len(values))

    def outliers(self, values: Floats) -> Floats:
        """Return the share of outliers of each draw, shape (draws,)."""
        return self._noise("outliers", values)

    def derived(self, values: Floats) -> dict[str, Floats]:
        """Return slenderness, p and restitution of each draw, of the side that lifts first."""
        sides = self.block.sides(self.block_values(values))
        first = sides[np.arange(len(sides)), np.argmin(sides[:, :, ALPHA], axis=1)]
        return {
            "alpha_rad": first[:, ALPHA],
            "p_rad_s": first[:, RATE],
            "restitution": first[:, RATIO],
        }

    def features(self, values: Floats) -> Floats:
        """Return what fates depend on most, ln tan alpha first, shape (draws, features)."""
        sides = self.block.sides(self.block_values(values))
        lean = np.log(tan(sides[:, :, ALPHA]))
        return np.column_stack(
            [
                lean.min(axis=1),
                lean[:, 0] - lean[:, 1],
                np.log(sides[:, :, RATE].mean(axis=1)),
                sides[:, :, RATIO].mean(axis=1),
                self.block.scatter_of(self.block_values(values)),
            ]
        )

    def _free_noise(self) -> list[tuple[str, PriorRange]]:
        pairs = [("sigma_ln", self.noise.sigma_ln), ("outliers", self.noise.outliers)]
        if self.sessions:
            pairs.append(("session_ln", self.noise.session_ln))
        return [(name, spread) for name, spread in pairs if not spread.fixed]

    def _noise(self, name: str, values: Floats) -> Floats:
        if name in self.names:
            return values[:, self.names.index(name)]
        given: PriorRange = getattr(self.noise, name)
        return np.full(len(values), given.low)
