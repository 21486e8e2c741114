"""Logistic regressions by the hundreds, all of one design.

Tests compare them with statsmodels.  scikit-learn would be a large dependency for two formulas.
"""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.risk.calibration.sampler.exact import (
    cholesky,
    inverse_diagonal,
    rounded,
    solve,
)

DESIGN_BITS, AT_BITS, PAIR_BITS = 13, 14, 18
"""Grids of the design, whose numbers are below 64, of coefficients, and of products of columns."""
MOST_LOG_ODDS = 30.0
LONGEST_STEP = 2.0
"""Of a coefficient in one step of Newton's method."""


def probability(odds: Floats) -> Floats:
    """Return probabilities from log odds."""
    clipped = np.clip(odds, -MOST_LOG_ODDS, MOST_LOG_ODDS)
    return np.asarray(1.0 / (1.0 + exp(-clipped)))


def fit_logistics(
    design: Floats,
    fell: Floats,
    weight: Floats,
    *,
    precision: Floats,
    mean: Floats,
    start: Floats | None = None,
    steps: int = 12,
    close: float = 0.02,
) -> tuple[Floats, Floats]:
    """Return coefficients of logistic regressions by Newton's method, and their variances.

    With one design the Newton matrices of all regressions are one product of matrices: weights
    times products of columns.

    Parameters
    ----------
    design
        Shape (cases, coefficients), numbers below 64.
    fell, weight
        Outcomes and weights from 0 to 1, shape (regressions, cases).
    precision, mean
        Of the normal prior of coefficients, a row for all regressions or a row for each.
    start
        Where to begin, shape (regressions, coefficients); default `mean`.
    steps, close
        Most steps, and the step that ends them.

    Returns
    -------
    tuple
        Both of shape (regressions, coefficients).
    """
    size = design.shape[1]
    design = rounded(design, DESIGN_BITS)
    first, second = np.triu_indices(size)
    pairs = rounded(design[:, first] * design[:, second], PAIR_BITS)
    shape = (len(fell), size)
    at = rounded(np.broadcast_to(mean if start is None else start, shape), AT_BITS)
    bend = root = np.empty((size, size, len(fell)))
    for _ in range(steps):
        p = probability(at @ design.T)
        slope = rounded(weight * (fell - p), 17) @ design - precision * (at - mean)
        packed = (rounded(weight * p * (1.0 - p), 12) @ pairs).T
        bend[second, first] = packed
        bend[np.arange(size), np.arange(size)] += np.broadcast_to(precision, shape).T
        root = cholesky(bend)
        step = solve(root, slope.T.copy()).T
        largest = np.abs(step).max(axis=1, keepdims=True)
        at = rounded(
            at + step * np.minimum(1.0, LONGEST_STEP / np.maximum(largest, 1e-12)), AT_BITS
        )
        if largest.max() < close:
            break
    return at, inverse_diagonal(root).T
