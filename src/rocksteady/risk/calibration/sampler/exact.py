"""Sums and products with the same bits on every processor and with any number of threads.

A product of matrices adds in an order of its own.  Where all factors are whole multiples of powers
of two, and no sum needs more than 53 bits, every sum is exact, and its order does not matter.
"""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import exp, log

WEIGHT_BITS = 40
"""Of weights that sum to 1 or are 1 at most, of up to 8,192 of them."""


def rounded(values: Floats, bits: int) -> Floats:
    """Return the nearest whole multiples of 2^-bits."""
    scale = 2.0**bits
    rounds: Floats = np.rint(values * scale) / scale
    return rounds


def softmax(logs: Floats) -> Floats:
    """Return weights that sum to 1 from their logarithms, of any shape."""
    parts = rounded(exp(logs - logs.max()), WEIGHT_BITS)
    return np.asarray(parts / parts.sum())


def log_sum_exp(logs: Floats) -> Floats:
    """Return ln of the sum of exponentials over the last axis."""
    most = logs.max(axis=-1, keepdims=True)
    sums = rounded(exp(logs - most), WEIGHT_BITS).sum(axis=-1)
    total: Floats = log(sums) + most[..., 0]
    return total


def effective(weights: Floats) -> float:
    """Return how many equal weights are worth as much, (sum w)^2/sum(w^2)."""
    share = weights / weights.sum()
    return float(1.0 / rounded(share * share, 50).sum())


def cholesky(matrices: Floats) -> Floats:
    """Return lower triangular roots of positive definite matrices, shape (n, n, count)."""
    root = matrices.copy()
    for column in range(len(root)):
        root[column, column] = np.sqrt(root[column, column])
        root[column + 1 :, column] /= root[column, column]
        root[column, column + 1 :] = 0.0
        for right in range(column + 1, len(root)):
            root[right:, right] -= root[right:, column] * root[right, column]
    return root


def forward(root: Floats, right: Floats) -> Floats:
    """Return solutions of triangular systems.

    Parameters
    ----------
    root
        From `cholesky`, shape (n, n, count).
    right
        Right sides, shape (n, ..., count).
    """
    solution = right.copy()
    for row in range(len(root)):
        solution[row] /= root[row, row]
        for below in range(row + 1, len(root)):
            solution[below] -= root[below, row] * solution[row]
    return solution


def solve(root: Floats, right: Floats) -> Floats:
    """Return solutions of systems whose matrices have these roots, shape (n, count)."""
    solution = forward(root, right)
    for row in range(len(root) - 1, -1, -1):
        solution[row] /= root[row, row]
        solution[:row] -= root[row, :row] * solution[row]
    return solution


def inverse_diagonal(root: Floats) -> Floats:
    """Return the diagonals of the inverses of matrices with these roots, shape (n, count)."""
    size, _, count = root.shape
    unit = np.broadcast_to(np.eye(size)[:, :, np.newaxis], (size, size, count))
    return np.asarray(np.square(forward(root, unit)).sum(axis=0))
