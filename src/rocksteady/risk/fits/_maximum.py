"""Curve of the largest likelihood of one stage."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.fits._likelihood import Family, family_of, log_likelihood_of, maximise
from rocksteady.risk.fits._status import (
    FITTED,
    NEVER,
    NOT_RISING,
    SEPARATED,
    kinds_of,
)
from rocksteady.risk.fits._trial_counts import Counts

LARGEST_LOG = 690.0
"""Of a median: exp of more is beyond the floats."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Maximum:
    """Curve of the largest likelihood: P = F(a + b z), z = (ln im - centre)/scale.

    Attributes
    ----------
    name
        Name of its family.
    counts
        Inputs of the fit.
    centre, scale
        Mean and standard deviation of ln im over the trials.
    status
        As for `FragilityCurve`.
    coefficients
        a and b; NaN where there is no curve.
    step
        Levels between which a step lies; None without.
    """

    name: str
    counts: Counts
    centre: float
    scale: float
    status: str
    coefficients: Floats
    step: tuple[float, float] | None = None

    @property
    def family(self) -> Family:
        """Its F."""
        return family_of(self.name)

    @property
    def design(self) -> Floats:
        """Columns 1 and z at the levels."""
        z = (np.log(self.counts.levels) - self.centre) / self.scale
        return np.column_stack([np.ones_like(z), z])

    @property
    def shares(self) -> Floats:
        """Share of failures that the model gives to each level."""
        failures, trials = self.counts.totals
        if self.status == FITTED:
            return self.family.cdf(self.design @ self.coefficients)
        levels = self.counts.levels
        if self.step is not None:
            sides = [levels < self.step[1], levels > self.step[0]]
            return np.select(sides, [0.0, 1.0], failures / trials)
        return np.full(len(trials), failures.sum() / max(trials.sum(), 1.0))

    @property
    def log_likelihood(self) -> float:
        """Of single trials; for a flat curve where the likelihood does not rise."""
        failures, trials = self.counts.totals
        if self.status == FITTED:
            eta = self.design @ self.coefficients
            return log_likelihood_of(self.family, eta, failures, trials)
        return log_likelihood_of_shares(self.shares, failures, trials)

    @property
    def deviance(self) -> float:
        """Twice what the log-likelihood of the shares of each level has above the curve's."""
        failures, trials = self.counts.totals
        best = log_likelihood_of_shares(failures / trials, failures, trials)
        return max(2.0 * (best - self.log_likelihood), 0.0)


def log_likelihood_of_shares(shares: Floats, failures: Floats, trials: Floats) -> float:
    """Return the log-likelihood of single trials at the given probabilities."""
    from scipy.special import xlog1py, xlogy

    return float((xlogy(failures, shares) + xlog1py(trials - failures, -shares)).sum())


def maximum_of(counts: Counts, family: str) -> Maximum:
    """Return the curve of the largest likelihood, or the status of data without one."""
    function = family_of(family)
    failures, trials = counts.totals
    logs = np.log(counts.levels)
    size = max(float(trials.sum()), 1.0)
    centre = float(trials @ logs) / size
    scale = math.sqrt(float(trials @ np.square(logs - centre)) / size)
    none = np.full(2, math.nan)
    if not len(logs):
        status, step = NEVER, None
    else:
        kind = kinds_of(logs, failures[None], trials[None])
        status, step = str(kind.status[0]), None
        if status == SEPARATED:
            step = (float(counts.levels[kind.stood[0]]), float(counts.levels[kind.failed[0]]))
    maximum = Maximum(
        name=family,
        counts=counts,
        centre=centre,
        scale=scale or 1.0,
        status=status,
        coefficients=none,
        step=step,
    )
    if status != FITTED:
        return maximum
    start = np.array([float(function.quantile(failures.sum() / trials.sum())), 1.0])
    a, b = maximise(function, maximum.design, failures, trials, start)
    if b <= 0.0 or abs(centre - scale * a / b) > LARGEST_LOG:
        return replace(maximum, status=NOT_RISING)
    return replace(maximum, coefficients=np.array([a, b]))
