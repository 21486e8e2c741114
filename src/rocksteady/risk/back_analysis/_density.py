"""Posterior over records and scales as a smooth density in two measures, and intervals of each.

A record draws a line in the logarithms of two measures, as its ratio of the two is fixed.  So the
plane has the logarithm x of the first measure, in which scales lie, and that of the ratio, y.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rocksteady.arrays import Floats

ALONG = 0.1
"""Width of the normal kernel along a record: of ln(first measure)."""
ACROSS = 0.6
"""Of that across records: over the spread of ln(ratio) times records^(-1/5), Silverman's power."""
NARROWEST = 0.05
FINENESS = 8
"""Cells in a width of a kernel."""
RATIOS = 64
"""Ratios of the grid."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Plane:
    """Logarithms of the first measure and of the others over it.

    Attributes
    ----------
    nodes
        Logarithms of the first measure, shape (nodes,).
    ratios
        ln(measure/first measure) of each record, shape (records, measures); the first are 0.
    """

    nodes: Floats
    ratios: Floats

    @cached_property
    def across(self) -> Floats:
        """Width of the kernel in each ratio, shape (measures,); 0 of the first."""
        spread = self.ratios.std(axis=0)
        widths = np.maximum(NARROWEST, ACROSS * spread * len(self.ratios) ** -0.2)
        widths[0] = 0.0
        return np.asarray(widths)

    @cached_property
    def ordinates(self) -> Floats:
        """Ratios of the second measure to the first on the grid, logarithms, shape (ratios,)."""
        second, beyond = self.ratios[:, 1], 3.0 * self.across[1]
        return np.linspace(second.min() - beyond, second.max() + beyond, RATIOS)

    @property
    def cell(self) -> float:
        """Area of a cell of the grid."""
        return float((self.nodes[1] - self.nodes[0]) * (self.ordinates[1] - self.ordinates[0]))

    def masses(self, weights: Floats) -> Floats:
        """Return the probability of each cell of the grid.

        Parameters
        ----------
        weights
            Weights of records and nodes, whose sum is 1, shape (..., records, nodes).

        Returns
        -------
        numpy.ndarray
            Shape (..., nodes, ratios).
        """
        along = _kernel(self.nodes, self.nodes, ALONG)
        across = _kernel(self.ratios[:, 1], self.ordinates, float(self.across[1]))
        smooth = weights @ along
        return np.asarray(np.swapaxes(smooth, -1, -2) @ across)

    def local_mean(self, values: Floats) -> Floats:
        """Return the mean of values over records of like ratio, at each cell of the grid.

        Parameters
        ----------
        values
            Values of records and nodes, shape (records, nodes).

        Returns
        -------
        numpy.ndarray
            Shape (nodes, ratios).
        """
        near = _kernel(self.ordinates, self.ratios[:, 1], float(self.across[1]))
        return np.asarray((near @ values).T)

    def distribution(self, weights: Floats, measure: int, at: Floats) -> Floats:
        """Return the probability that a measure is below some values.

        Parameters
        ----------
        weights
            Shape (surveys, records, nodes).
        measure
            Number of the measure, from 0.
        at
            Logarithms of values, shape (surveys, values).

        Returns
        -------
        numpy.ndarray
            Shape (surveys, values).
        """
        from scipy.special import ndtr

        width = float(np.hypot(ALONG, self.across[measure]))
        total = np.zeros(at.shape)
        for record, ratio in enumerate(self.ratios[:, measure].tolist()):
            z = (at[:, :, np.newaxis] - ratio - self.nodes) / width
            total += np.einsum("svn,sn->sv", ndtr(z), weights[:, record])
        return total

    def quantiles(self, weights: Floats, measure: int, shares: Floats) -> Floats:
        """Return values of a measure, shape (shares,), below which shares of weights lie."""
        width = float(np.hypot(ALONG, self.across[measure]))
        points = self.nodes + self.ratios[:, measure, np.newaxis]
        step, reach = width / FINENESS, 4 * FINENESS
        count = int(np.ceil((points.max() - points.min()) / step)) + 1 + 2 * reach
        values = points.min() + step * (np.arange(count) - reach)
        at = (points - values[0]) / step
        left = at.astype(np.int64)
        counted = np.zeros(count + 1)
        np.add.at(counted, left, weights * (1.0 - (at - left)))
        np.add.at(counted, left + 1, weights * (at - left))
        kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / FINENESS) ** 2)
        density = np.convolve(counted[:count], kernel / kernel.sum(), mode="same")
        # Half of a cell lies below its middle.
        below = np.cumsum(density) - 0.5 * density
        return np.asarray(np.exp(np.interp(shares, below / density.sum(), values)))


def level_of(values: Floats, share: float) -> float:
    """Return the value of the least likely cell of the smallest region with a share of the sum."""
    ordered = np.sort(values.ravel())[::-1]
    place = int(np.searchsorted(np.cumsum(ordered), share * ordered.sum()))
    return float(ordered[min(place, len(ordered) - 1)])


@np.errstate(under="ignore")
def tempered(log_likelihood: Floats, temper: float) -> Floats:
    """Return posterior weights of records and nodes, both signs together, whose sum is 1.

    Parameters
    ----------
    log_likelihood
        Shape (surveys, signs, records, nodes).
    temper
        Exponent of the likelihood.

    Returns
    -------
    numpy.ndarray
        Shape (surveys, records, nodes).
    """
    top = log_likelihood.max(axis=(1, 2, 3), keepdims=True)
    weights = np.exp(temper * (log_likelihood - top)).sum(axis=1)
    return np.asarray(weights / weights.sum(axis=(1, 2), keepdims=True))


@np.errstate(under="ignore")
def _kernel(points: Floats, grid: Floats, width: float) -> Floats:
    """Return a normal density about each point on a grid, shape (points, grid), each of sum 1."""
    z = (points[:, np.newaxis] - grid) / width
    density = np.exp(-0.5 * z * z)
    return np.asarray(density / density.sum(axis=1, keepdims=True))
