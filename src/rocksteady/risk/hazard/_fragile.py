"""A fragility as the hazard sees it: probabilities over the hazard curve's own measure."""

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.validation import non_negative, positive

Q05 = 1.6448536269514722
"""Standard normal quantile of .95."""
_KNOTS = (1e-9, 1e-6, 1e-3, 0.02, 0.16, 0.5, 0.84, 0.98, 0.999)
"""Probabilities at whose intensities the integral is divided."""
UNKNOWN_OUTSIDE = {"never", "always"}
"""Statuses of curves that have no probability at intensities without runs."""


class Fragile(Protocol):
    """What has a probability of failure at each intensity: a curve, of one stage or of two."""

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of failure at intensities, of their shape."""

    def quantile(self, p: float) -> Any:
        """Return the intensity at which the probability of failure is `p`."""


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

        Where no run fails, or all do, it is unknown outside the runs, and taken to be 1.

        Raises
        ------
        InputError
            If the curve returns anything but probabilities.
        """
        at = self.factor * intensity
        probability = np.asarray(self.curve.probability(at), dtype=np.float64)
        if self.statuses & UNKNOWN_OUTSIDE:
            probability = np.ones_like(intensity)
            for stage in self.stages[1:] or self.stages:
                above = np.maximum(at - self._offset(stage), 0.0)
                known = np.asarray(stage.probability(above), dtype=np.float64)
                probability = probability * np.where(np.isnan(known), 1.0, known)
        valid = probability.shape == intensity.shape and bool(
            np.all((probability >= 0.0) & (probability <= 1.0))
        )
        if not valid:
            raise InputError(
                "fragility",
                type(self.curve).__name__,
                "its probabilities must lie in [0, 1] at each intensity",
                "give a fitted curve, or (median, beta)",
            )
        return probability

    @property
    def stages(self) -> list[Any]:
        """The curve, and the two whose product it is, where there are such."""
        parts = (getattr(self.curve, name, None) for name in ("uplift", "given_uplift"))
        return [self.curve, *(part for part in parts if part is not None)]

    def _offset(self, stage: Any) -> float:
        """Return the intensity from which a stage counts, that of a gate."""
        second = stage is getattr(self.curve, "given_uplift", None)
        return float(getattr(self.curve, "offset", 0.0)) if second else 0.0

    @property
    def statuses(self) -> set[str]:
        """How each stage was fitted."""
        return {str(getattr(stage, "status", "")) for stage in self.stages}

    def band(self, intensity: Floats) -> tuple[Floats, Floats] | None:
        """Return the band of the probability at intensities; None where there is none."""
        band = getattr(self.curve, "probability_band", None)
        limits = band(self.factor * intensity) if callable(band) else None
        if limits is None:
            return None
        low, high = (np.clip(np.asarray(side, dtype=np.float64), 0.0, 1.0) for side in limits)
        return None if bool(np.isnan(low).any() or np.isnan(high).any()) else (low, high)

    def quantile(self, p: float) -> float:
        """Return the intensity of a probability; nan where there is none."""
        return _quantile(self.curve, p) / self.factor

    @property
    def beta(self) -> float:
        """Standard deviation of the logarithm: of other curves that from median to 5 %."""
        beta = getattr(self.curve, "beta", None)
        family = getattr(self.curve, "family", "lognormal")
        if family == "lognormal" and isinstance(beta, float) and math.isfinite(beta):
            return beta
        return math.log(self.quantile(0.5) / self.quantile(0.05)) / Q05

    @property
    def sampled(self) -> tuple[float, float] | None:
        """Intensities between which the fragility rests on runs; None where it has none."""
        range_sampled = getattr(self.curve, "sampled", None)
        if not (isinstance(range_sampled, tuple) and len(range_sampled) == 2):
            return None
        return range_sampled[0] / self.factor, range_sampled[1] / self.factor

    @property
    def knots(self) -> Floats:
        """Logarithms of intensities at which the probability changes fast, steps among them."""
        knots = [self._offset(stage) + _quantile(stage, p) for stage in self.stages for p in _KNOTS]
        inside = [value / self.factor for value in knots if 0.0 < value < math.inf]
        inside += [value for value in self.sampled or () if 0.0 < value < math.inf]
        return np.log(np.array(inside)) if inside else np.empty(0)


def _quantile(curve: Any, p: float) -> float:
    """Return the intensity of a probability; nan where a curve has none."""
    try:
        return float(curve.quantile(p))
    except (InputError, TypeError):
        return math.nan
