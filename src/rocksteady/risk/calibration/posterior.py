"""Posterior of one object: weighted draws of its parameters, with its predictions' shares."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import FEWEST_DRAWS, NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import number
from rocksteady.results.result import Result
from rocksteady.risk.calibration._importance import smoothed
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.calibration.held_out.folds import effective, weighted_quantiles

ENDS = (0.5, 0.05, 0.95)
NORMAL_95 = 1.6448536269514722
"""95 % quantile of the normal law."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Posterior(Result):
    """Weighted draws of the parameters of one object.

    Each object has its own draws, its own noise among them: nothing is shared between objects.

    Attributes
    ----------
    object
        Name of the object.
    space
        Its parameters and their prior.
    values
        Shape (draws, parameters), in the order of `names`.
    weights, untempered_weights, prior_weights
        Weights of the draws, each summing to 1, shape (draws,): with the likelihood to the power of
        the temper, with the likelihood itself, and without it.
    fates
        Share of the runs of each draw and test that fell, shape (draws, tests of the object).
    sessions
        By session mean and deviation of ln(gain) at each draw, shape (draws, 2); none without
        sessions.
    """

    object: str
    space: Space
    values: Floats
    weights: Floats
    untempered_weights: Floats
    prior_weights: Floats
    fates: Floats
    sessions: Mapping[str, Floats] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.space.names

    @cached_property
    def effective_draws(self) -> float:
        """How many draws of equal weight are worth as much, 1/sum(w^2)."""
        return float(effective(self.weights))

    @property
    def identified(self) -> bool:
        """Whether there are enough effective draws for an estimate, 50 or more."""
        return self.effective_draws >= FEWEST_DRAWS

    @cached_property
    def untempered_effective_draws(self) -> float:
        """The same of the untempered weights."""
        return float(effective(self.untempered_weights))

    @cached_property
    def pareto_k(self) -> float:
        """Shape of the Pareto law of the largest untempered weights; above 0.7 doubt them."""
        return smoothed(self.untempered_weights)[1]

    def session_gain(self, name: str) -> tuple[float, float, float]:
        """Return median, 5 % and 95 % of the gain of a session, as a factor.

        Raises
        ------
        InputError
            If there is no session of that name.
        """
        if name not in self.sessions:
            known = ", ".join(self.sessions) or "none"
            raise InputError("name", name, f"sessions are {known}", "give one of them")
        pair = self.sessions[name]
        mean = float(self.weights @ pair[:, 0])
        deviation = float(np.sqrt(self.weights @ (np.square(pair).sum(axis=1)) - mean * mean))
        ends = (mean, mean - NORMAL_95 * deviation, mean + NORMAL_95 * deviation)
        median, low, high = (math.exp(each) for each in ends)
        return median, low, high

    @cached_property
    def columns(self) -> dict[str, Floats]:
        """Each parameter and each derived number by its name, shape (draws,)."""
        columns = {name: self.values[:, place] for place, name in enumerate(self.names)}
        return columns | self.space.derived(self.values)

    def of(self, name: str) -> Floats:
        """Return the draws of a parameter, or of a derived number, by its name.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        columns = self.columns
        if name not in columns:
            raise InputError("name", name, f"there are {', '.join(columns)}", "give one of them")
        return columns[name]

    def interval(self, name: str, *, untempered: bool = False) -> tuple[float, float, float]:
        """Return the median, the 5 % and the 95 % quantile of a number by its name.

        NaN below 50 effective draws: the number is not identified by so few.

        Raises
        ------
        InputError
            If there is none of that name, or `untempered` is not True or False.
        """
        weights = self.untempered_weights if untempered else self.weights
        column = self.of(name)[:, np.newaxis]
        if effective(weights) < FEWEST_DRAWS:
            return math.nan, math.nan, math.nan
        median, low, high = weighted_quantiles(column, weights[:, np.newaxis], ENDS)[:, 0]
        return float(median), float(low), float(high)

    def median_values(self) -> Floats:
        """Return the weighted median of each parameter, shape (parameters,)."""
        wide = np.broadcast_to(self.weights[:, np.newaxis], self.values.shape)
        medians: Floats = weighted_quantiles(self.values, wide, (0.5,))[0]
        return medians

    def describe(self) -> Description:
        """Return the median and the 90 % interval of each number."""
        rows = []
        for name in self.columns:
            ends = (None if math.isnan(each) else each for each in self.interval(name))
            rows.append(
                dict(zip(("parameter", "median", "low", "high"), (name, *ends), strict=True))
            )
        few = "" if self.identified else f", {TOO_FEW}: {NOT_IDENTIFIED}"
        columns = (
            Column("parameter", "parameter", left=True),
            Column("median", "median", number),
            Column("low", "5 %", number),
            Column("high", "95 %", number),
        )
        return Description(
            headline=f"{self.object}: {len(self.values):,} draws, "
            f"{self.effective_draws:.0f} effective{few}",
            facts=[
                Fact("object", self.object, "object"),
                Fact("effective_draws", self.effective_draws, "effective draws"),
                Fact(
                    "untempered_effective_draws",
                    self.untempered_effective_draws,
                    "effective draws without tempering",
                ),
            ],
            tables=[Table("parameters", rows, columns)],
        )
