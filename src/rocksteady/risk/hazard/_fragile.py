"""A fragility as the hazard sees it: probabilities over the hazard curve's own measure."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.validation import non_negative, positive
from rocksteady.risk.fits.fragility_curve import FragilityCurve

Q05 = 1.6448536269514722
"""Standard normal quantile of .95."""
_KNOTS = (1e-9, 1e-6, 1e-3, 0.02, 0.16, 0.5, 0.84, 0.98, 0.999)
"""Probabilities at whose intensities the integral is divided."""


@dataclass(frozen=True)
class Lognormal:
    """A lognormal fragility of a median and a standard deviation of the logarithm."""

    median: float
    beta: float

    def __post_init__(self) -> None:
        """Validate."""
        hint = "give the fragility as (median, beta)"
        object.__setattr__(self, "median", positive("median", self.median, hint=hint))
        object.__setattr__(self, "beta", non_negative("beta", self.beta, hint=hint))
        if not (1e-50 <= self.median <= 1e50 and self.beta <= 20.0):
            valid = "median must lie in [1e-50, 1e50] and beta in [0, 20]"
            raise InputError("fragility", (self.median, self.beta), valid, hint)

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return Phi(ln(intensity/median)/beta); without beta a step, 1 from the median on."""
        from scipy.special import ndtr

        x = np.log(np.asarray(intensity, dtype=np.float64) / self.median)
        if self.beta < 1e-12:
            return np.where(x >= 0.0, 1.0, 0.0)
        values: Floats = ndtr(x / self.beta)
        return values

    def quantile(self, p: float) -> float:
        """Return the intensity of a probability."""
        from scipy.special import ndtri

        return self.median * math.exp(self.beta * float(ndtri(p)))


Fragile = Lognormal | FragilityCurve


@dataclass(frozen=True)
class Converted:
    """A fragility over a multiple of its own measure.

    Parameters
    ----------
    curve
        The fragility.
    factor
        What an intensity of the hazard curve is multiplied by to be one of the fragility.
    """

    curve: Fragile
    factor: float

    def probability(self, intensity: Floats) -> Floats:
        """Return the probability of failure at intensities of the hazard curve.

        Where no trial fails, or all do, it is unknown outside the trials, and taken to be 1.
        """
        probability: Floats = self.curve.probability(self.factor * intensity)
        return np.where(np.isnan(probability), 1.0, probability)

    def quantile(self, p: float) -> float:
        """Return the intensity of a probability; nan where there is none."""
        return self.curve.quantile(p) / self.factor

    @property
    def beta(self) -> float:
        """Standard deviation of the logarithm: of other curves that from median to 5 %."""
        logistic = isinstance(self.curve, FragilityCurve) and self.curve.family == "logistic"
        if not logistic and math.isfinite(self.curve.beta):
            return self.curve.beta
        return math.log(self.quantile(0.5) / self.quantile(0.05)) / Q05

    @property
    def sampled(self) -> tuple[float, float] | None:
        """Intensities between which the fragility rests on trials; None where it has none."""
        if isinstance(self.curve, Lognormal):
            return None
        low, high = self.curve.sampled
        return low / self.factor, high / self.factor

    @property
    def knots(self) -> Floats:
        """Logarithms of intensities at which the probability changes fast, steps among them."""
        knots = [*map(self.quantile, _KNOTS), *(self.sampled or ())]
        return np.array([math.log(value) for value in knots if 0.0 < value < math.inf])
