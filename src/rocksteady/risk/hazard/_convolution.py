r"""The risk integral: probability of failure over the rate of shaking.

.. math:: \lambda = \int P(x)\,|dH(x)|

Over a stretch of a hazard curve that is straight in logarithms, :math:`H = H_i (x/x_i)^{-k}`, so
that with :math:`u = \ln x` it is the integral of :math:`P(e^u)\,k H(u)` over u, by Gauss's rule on
pieces that are halved until they agree.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.hazard.hazard_curve import LARGEST_EXPONENT, HazardCurve

ACCURACY = 1e-12
"""Of a piece, over the whole integral."""
NODES = 12
MOST_HALVINGS = 48
REACH = 60.0
"""Largest width of a lower tail in units of ln(intensity), and of an upper one in those of 1/k."""
FURTHEST = 300.0
"""Largest logarithm of an intensity at which a probability is computed."""
NEGLIGIBLE = 1e-9
"""Share of the last unit of a lower tail in all of it, below which it has an end."""


@dataclass(frozen=True, kw_only=True)
class Integral:
    """A risk integral in pieces.

    Parameters
    ----------
    ends
        Logarithms of the intensities between which the pieces are, ascending, shape (pieces, 2).
    values
        Rate of each piece [1/year].
    lump
        Rate beyond the last level of a curve without tails, times the probability there [1/year].
    below, above
        What lies beyond the ends with power-law tails [1/year]; infinite where it has no bound.
    density
        The integrand over the logarithm of the intensity.
    """

    ends: Floats
    values: Floats
    lump: float
    below: float
    above: float
    density: Callable[[Floats], Floats]

    @property
    def total(self) -> float:
        """The annual rate [1/year]."""
        return math.fsum(self.values) + self.lump

    def quantile(self, share: float) -> float:
        """Return the intensity below which a share of the integral lies; infinite in the lump."""
        if not self.total > 0.0:  # what risk there is lies above the last level
            return math.inf
        wanted = share * self.total
        sums = np.cumsum(self.values)
        if not sums.size or wanted > sums[-1]:
            return math.inf
        at = int(np.searchsorted(sums, wanted))
        before = sums[at] - self.values[at]
        left, right = self.ends[at]
        low, high = left, right
        for _ in range(MOST_HALVINGS):
            middle = 0.5 * (low + high)
            part = _gauss(self.density, np.array([left]), np.array([middle]))[0]
            low, high = (middle, high) if before + part < wanted else (low, middle)
        return math.exp(0.5 * (low + high))

    def share_outside(self, span: tuple[float, float], last: float) -> float:
        """Return the share of the integral at intensities outside a span.

        Parameters
        ----------
        span
            Lowest and highest intensity; edges of pieces.
        last
            The last level of the hazard curve, where the lump is.
        """
        middles = np.exp(0.5 * self.ends.sum(axis=1))
        outside = self.values[(middles < span[0]) | (middles > span[1])].sum()
        total = self.total
        return float(outside + self.lump * (last >= span[1])) / total if total > 0.0 else 0.0

    def between(self, levels: Floats) -> Floats:
        """Return the integral below the first level, between each two, and above the last."""
        middles = 0.5 * self.ends.sum(axis=1)
        at = np.searchsorted(np.log(levels), middles)
        sums = np.bincount(at, weights=self.values, minlength=levels.size + 1)
        sums[-1] += self.lump
        return np.asarray(sums, dtype=np.float64)


def convolve(
    probability: Callable[[Floats], Floats], knots: Floats, hazard: HazardCurve
) -> Integral:
    """Return the risk integral of a probability of failure over a hazard curve.

    Parameters
    ----------
    probability
        Probability of failure, at intensities of the hazard curve.
    knots
        Logarithms of intensities at which it changes fast, or is not smooth.
    hazard
        Without tails the rate of its last level counts with the probability there, which is a
        lower bound of what lies above it, and nothing counts below its first level.
    """
    x, y, slopes = np.log(hazard.levels), np.log(hazard.rates), hazard.slopes
    low, high = hazard.end_slopes
    k = np.array([low, *slopes, high])
    start = np.array([x[0], *x])
    height = np.array([y[0], *y])

    def density(u: Floats) -> Floats:
        at = np.searchsorted(x, u)
        exponent = np.clip(height[at] - k[at] * (u - start[at]), -LARGEST_EXPONENT, None)
        rate = np.exp(np.minimum(exponent, LARGEST_EXPONENT))
        values: Floats = k[at] * rate * probability(np.exp(np.clip(u, -FURTHEST, FURTHEST)))
        return values

    inside = _integrate(density, _edges(x, knots))
    first = x[0] - np.arange(REACH + 1.0)[::-1]
    below = _integrate(density, _edges(first, knots)) if low > 0.0 else _nothing()
    diverges = low > 0.0 and _last(below) > NEGLIGIBLE * below[1].sum()
    lump = float(hazard.rates[-1] * probability(hazard.levels[-1:])[0])
    beyond = x[-1] + REACH / high * np.linspace(0.0, 1.0, 25) ** 2 if high > 0.0 else x[-1:]
    above = _integrate(density, _edges(beyond, knots)) if high > 0.0 else _nothing()
    parts = [below, inside, above] if hazard.tail == "power-law" else [inside]
    return Integral(
        ends=np.concatenate([ends for ends, _ in parts]),
        values=np.concatenate([values for _, values in parts]),
        lump=0.0 if hazard.tail == "power-law" else lump,
        below=math.inf if diverges else math.fsum(below[1]),
        above=math.fsum(above[1]) if high > 0.0 else math.inf if lump else 0.0,
        density=density,
    )


def _nothing() -> tuple[Floats, Floats]:
    """Return an integral of no pieces."""
    return np.empty((0, 2)), np.empty(0)


def _last(integral: tuple[Floats, Floats]) -> float:
    """Return the part of an integral in the first unit of its width."""
    ends, values = integral
    return float(values[ends[:, 1] <= ends[0, 0] + 1.0 + 1e-9].sum())


def _edges(ends: Floats, knots: Floats) -> Floats:
    """Return the ends of stretches, and what else divides the range, ascending."""
    inside = knots[(knots > ends[0]) & (knots < ends[-1])]
    return np.unique(np.concatenate([ends, inside]))


def _integrate(density: Callable[[Floats], Floats], edges: Floats) -> tuple[Floats, Floats]:
    """Return the pieces of an integral and their values, ascending."""
    left, right = edges[:-1], edges[1:]
    whole = _gauss(density, left, right)
    done: list[tuple[Floats, Floats, Floats]] = []
    total = 0.0
    for count in range(MOST_HALVINGS):
        middle = 0.5 * (left + right)
        first, second = _gauss(density, left, middle), _gauss(density, middle, right)
        integral = first + second
        largest = abs(total + float(integral.sum()))
        agrees = (np.abs(integral - whole) <= ACCURACY * largest) | (count == MOST_HALVINGS - 1)
        done.append((left[agrees], right[agrees], integral[agrees]))
        total += float(integral[agrees].sum())
        more = ~agrees
        if not more.any():
            break
        left, right = (
            np.concatenate([left[more], middle[more]]),
            np.concatenate([middle[more], right[more]]),
        )
        whole = np.concatenate([first[more], second[more]])
    lefts, rights, values = (np.concatenate(parts) for parts in zip(*done, strict=True))
    order = np.argsort(lefts)
    return np.stack([lefts, rights], axis=1)[order], values[order]


@lru_cache(maxsize=1)
def _rule() -> tuple[Floats, Floats]:
    """Return the nodes in [-1, 1] and the weights of Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return nodes, weights


def _gauss(density: Callable[[Floats], Floats], left: Floats, right: Floats) -> Floats:
    """Return the integral over each piece by one rule."""
    nodes, weights = _rule()
    half = 0.5 * (right - left)
    at = 0.5 * (left + right)[:, np.newaxis] + half[:, np.newaxis] * nodes
    integral: Floats = half * (density(at.ravel()).reshape(at.shape) @ weights)
    return integral
