r"""Sums over a hazard curve: levels, and how often a year the shaking is near each.

The rate of falling is :math:`\lambda = \int P(x)\,|dH(x)|`.  Between two levels the hazard curve is
straight in logarithms, :math:`H = H_i (x/x_i)^{-k}`, so that with :math:`u = \ln x` it is the
integral of :math:`P(e^u)\,k H(u)` over u, here by Gauss's rule on short pieces.
"""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.hazard.hazard_curve import HazardCurve

NODES = 6
"""Of Gauss's rule on a piece."""
WIDEST = 0.1
"""Of a piece, in ln(level)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mass:
    """How often a year the shaking is near each of some levels.

    Attributes
    ----------
    levels
        Levels of the hazard curve, rising, shape (levels,); its last level comes last.
    rates
        Part of the hazard at each [1/year]; at the last level all that lies above it.
    """

    levels: Floats
    rates: Floats


def mass_of(hazard: HazardCurve, edges: Floats) -> Mass:
    """Return the levels and rates of a hazard curve.

    Parameters
    ----------
    hazard
        The curve.
    edges
        Levels at which what is summed jumps or bends, of any order.
    """
    x, y = np.log(hazard.levels), np.log(hazard.rates)
    count = int(np.ceil((x[-1] - x[0]) / WIDEST)) + 1
    ends = np.concatenate([x, np.log(edges), np.linspace(x[0], x[-1], count)])
    ends = np.unique(ends[(ends >= x[0]) & (ends <= x[-1])])
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    half, middle = 0.5 * np.diff(ends)[:, np.newaxis], 0.5 * (ends[1:] + ends[:-1])[:, np.newaxis]
    at = (middle + half * nodes).ravel()
    slopes = hazard.slopes[np.searchsorted(x, at).clip(1, len(x) - 1) - 1]
    rates = (half * weights).ravel() * slopes * np.exp(np.interp(at, x, y))
    return Mass(
        levels=np.append(np.exp(at), hazard.levels[-1]),
        rates=np.append(rates, hazard.rates[-1]),
    )
