"""Chances that objects fall, with errors and outliers, and the likelihood of a survey.

The chance is ``P = (1 - eps) E_z[Q(x + sigma z)] + eps/2`` of the share Q of draws that fall at the
logarithm x of the level.  Amplitude errors of objects are independent of each other, so that the
mean over the spread of sigma and of eps is exact.
"""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.observations.prior import OutcomeErrors

SIGMAS = 5
"""Amplitude errors that stand for their spread."""
NORMALS = 101
"""Standard normal numbers that stand for their density."""
REACH = 2.5
"""Standard deviations by which levels reach beyond the limits."""
FINER = 3
"""Nodes of the posterior for each level."""
LEAST = 1e-12
"""Least chance: without outliers one surprise would refuse every shaking."""


@dataclass(frozen=True, kw_only=True)
class Levels:
    """Levels of a measure in equal ratios: between limits, and beyond them by what errors reach.

    Attributes
    ----------
    nodes
        Logarithms of the first measure between the limits, shape (nodes,).
    simulated
        Logarithms of the levels that are simulated, shape (levels,).
    """

    nodes: Floats
    simulated: Floats

    @classmethod
    def between(cls, low: float, high: float, count: int, noise: OutcomeErrors) -> "Levels":
        """Return a number of levels for two limits."""
        ends = np.log([low, high])
        beyond = REACH * noise.sigma_ln.high
        return cls(
            nodes=np.linspace(ends[0], ends[1], FINER * (count - 1) + 1),
            simulated=np.linspace(ends[0] - beyond, ends[1] + beyond, count),
        )


def chances(shares: Floats, levels: Levels, noise: OutcomeErrors) -> Floats:
    """Return the chance that each object falls, at every node.

    Parameters
    ----------
    shares
        Shares of draws that fall, shape (..., levels).
    levels, noise
        The levels, and the errors.

    Returns
    -------
    numpy.ndarray
        Shape (..., nodes).
    """
    from scipy.special import ndtri

    middles = (np.arange(SIGMAS) + 0.5) / SIGMAS
    normal = ndtri((np.arange(NORMALS) + 0.5) / NORMALS)
    errors = np.outer(noise.sigma_ln.quantile(middles), normal).ravel()
    step = levels.simulated[1] - levels.simulated[0]
    at = (levels.nodes[:, np.newaxis] + errors - levels.simulated[0]) / step
    at = np.clip(at, 0.0, len(levels.simulated) - 1.0)
    # Lines between levels: each node is a weighted mean of levels.
    left = np.minimum(at.astype(np.int64), len(levels.simulated) - 2)
    weights = np.zeros((len(levels.nodes), len(levels.simulated)))
    rows = np.arange(len(levels.nodes))[:, np.newaxis]
    np.add.at(weights, (rows, left), 1.0 - (at - left))
    np.add.at(weights, (rows, left + 1), at - left)
    outliers = float(np.mean(noise.outliers.quantile(middles)))
    probabilities = (1.0 - outliers) * (shares @ weights.T / errors.size) + 0.5 * outliers
    return np.asarray(np.clip(probabilities, LEAST, 1.0 - LEAST))


def log_likelihoods(outcomes: Floats, chance: Floats) -> Floats:
    """Return the logarithm of the likelihood of surveys under every shaking.

    Parameters
    ----------
    outcomes
        1 of an object that fell, 0 of one that stood, shape (surveys, objects).
    chance
        Shape (objects, signs, records, nodes).

    Returns
    -------
    numpy.ndarray
        Shape (surveys, signs, records, nodes).
    """
    flat = chance.reshape(len(chance), -1)
    total = outcomes @ np.log(flat) + (1.0 - outcomes) @ np.log1p(-flat)
    return np.asarray(total.reshape(len(outcomes), *chance.shape[1:]))
