"""Posterior of one object: weighted draws of its parameters, with its predictions' shares.

Tests of one object tell nothing of another's mass and edges.  Objects are therefore separate
problems of few dimensions, which importance sampling needs.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.doubts import ANSWER_DRAWS
from rocksteady.results.result import Result
from rocksteady.risk.calibration.held_out.leaving_out import weighted_quantiles
from rocksteady.risk.calibration.sampler.exact import effective
from rocksteady.risk.calibration.sampler.mixture import MOST_K, pareto_k
from rocksteady.risk.calibration.sampler.space import Space
from rocksteady.risk.observations.spread import PriorRange

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
    weights, prior_weights
        Weights of the draws, with the likelihood and without it, each summing to 1, shape (draws,).
    errors
        Mean and deviation of `sigma_ln`, `outliers` and `session_ln` at each draw, by name, shape
        (draws, 2).
    noise
        Priors of these errors, by name.
    sessions
        By session mean and deviation of ln(gain) at each draw, shape (draws, 2); none without
        sessions.
    """

    object: str
    space: Space
    values: Floats
    weights: Floats
    prior_weights: Floats
    errors: Mapping[str, Floats]
    noise: Mapping[str, PriorRange]
    sessions: Mapping[str, Floats] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.space.names

    @cached_property
    def effective_draws(self) -> float:
        """How many draws of equal weight are worth as much, 1/sum(w^2)."""
        return float(effective(self.weights))

    @cached_property
    def pareto_k(self) -> float:
        """Shape of the Pareto law of the largest weights; above 0.7 doubt them."""
        return pareto_k(self.weights)

    @property
    def identified(self) -> bool:
        """Whether 200 effective draws or more, with k below 0.7, allow for an estimate."""
        return self.effective_draws >= ANSWER_DRAWS and not self.pareto_k >= MOST_K

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
        median, low, high = (math.exp(each) for each in self._normal(self.sessions[name]))
        return median, low, high

    def _normal(self, pair: Floats) -> tuple[float, float, float]:
        """Return mean, 5 % and 95 % of what has a mean and a deviation at each draw."""
        mean = float((self.weights * pair[:, 0]).sum())
        square = float((self.weights * np.square(pair).sum(axis=1)).sum()) - mean * mean
        far = NORMAL_95 * math.sqrt(max(square, 0.0))
        return mean, mean - far, mean + far

    @cached_property
    def columns(self) -> Mapping[str, Floats]:
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

    def interval(self, name: str) -> tuple[float, float, float]:
        """Return the median, the 5 % and the 95 % quantile of a number by its name.

        Of an error mean and ends of a normal law, inside its prior.  NaN of too few draws.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        if name in self.errors:
            low, high = self.noise[name].low, self.noise[name].high
            ends = [min(max(each, low), high) for each in self._normal(self.errors[name])]
        else:
            column = self.of(name)[:, np.newaxis]
            ends = weighted_quantiles(column, self.weights, ENDS)[:, 0].tolist()
        median, below, above = ends if self.identified else (math.nan,) * 3
        return median, below, above

    def deviation(self, name: str) -> float:
        """Return the standard deviation of a number by its name."""
        if name in self.errors:
            mean, _, high = self._normal(self.errors[name])
            return (high - mean) / NORMAL_95
        values = self.of(name)
        mean = float((self.weights * values).sum())
        return math.sqrt(float((self.weights * np.square(values - mean)).sum()))

    def median_values(self) -> Floats:
        """Return the weighted median of each parameter, shape (parameters,)."""
        medians: Floats = weighted_quantiles(self.values, self.weights, (0.5,))[0]
        return medians
