"""Probabilities of a fall from few runs each: gains in strata, and what neighbours lend."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LENT = 30.0
"""Runs that the fitted share counts for beside the runs of a draw."""
NODES = 7
"""Of the quadrature over the gain."""
BETWEEN = 0.5
"""Part of the standard deviation that is integrated about each node, in closed form: between the
nodes of a steep curve alone the integral is a staircase."""
RIDGE = 0.05
"""Precision of the prior of each coefficient; columns have a standard deviation of about 1."""
STEPS = 25
MOST_RUNS = 3000
"""Runs that a curve of one test is fitted to: of more, a part of the gains of each draw."""
MOST_LOG_ODDS = 30.0


def normal_strata(draws: int, tests: int, count: int, rng: np.random.Generator) -> Floats:
    """Return standard normal numbers in equal strata, shape (tests, draws, count).

    Number k is the quantile of (k + u)/count with its own u, uniform, for each draw and test: so
    the share of falls is an unbiased estimate of its probability at each draw, and the errors of
    draws are independent of each other.  With the same quantiles at all draws the share were a
    staircase in the slenderness whose steps are wider than the posterior of many tests.
    """
    from scipy.special import ndtri

    u = rng.random((draws, tests)).T[:, :, np.newaxis]
    found: Floats = ndtri((np.arange(count) + np.maximum(u, 1e-12)) / count)
    return found


def lend(
    fell: Bools, gain: Floats, sigma: Floats, features: Floats, *, lent: float = LENT
) -> Floats:
    """Return the probability of a fall at each draw, with what the runs of all draws say.

    The runs of a draw are few, so that the share of them that fell is noise to a good part, and
    a likelihood of hundreds of such shares would pick the luckiest draw: of 200 synthetic tests it
    leaves about 10 effective draws of 1500, and some 400 with what is lent.  A logistic curve is
    fitted to the runs of each test, over ln(gain/tan alpha) and the other properties of the block,
    and integrated over the gain: by Gauss's nodes, and about each of them by the logistic curve of
    a normal odds [1].  The estimate is

        Q = (k + m E)/(K + m),

    k falls of K runs, E the fitted probability, m its worth in runs: a beta prior about E in place
    of one about 1/2, as (k + a)/(K + 2 a) has.

    Parameters
    ----------
    fell
        Shape (tests, draws, gains).
    gain
        ln of the gain of each run over that of its test, shape (tests, draws, gains).
    sigma
        Standard deviation of it, shape (tests, draws).
    features
        ln tan alpha, then others, shape (draws, features).
    lent
        m, default 30.

    Returns
    -------
    ndarray
        Shape (draws, tests).

    References
    ----------
    .. [1] D. J. C. MacKay, Neural Computation 4, 720-736 (1992).
    """
    tests, draws, count = fell.shape
    found: Floats = fell.mean(axis=2).T
    lean, others = features[:, 0], features[:, 1:]
    others = others[:, others.std(axis=0) > 1e-9]
    others = (others - others.mean(axis=0)) / others.std(axis=0)
    picked = min(count, max(1, MOST_RUNS // draws))
    # Other strata at each draw, so that all of them are there evenly.
    column = (np.arange(draws)[:, np.newaxis] + (count * np.arange(picked)) // picked) % count
    row = np.arange(draws)[:, np.newaxis]
    wide = np.repeat(others, picked, axis=0).T
    nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
    nodes, weights = np.sqrt(1.0 - BETWEEN**2) * nodes, weights / weights.sum()
    for test in range(tests):
        if lent == 0.0 or (fell[test] == fell[test, 0, 0]).all():
            continue
        load = gain[test] - lean[:, np.newaxis]
        middle, width = float(load.mean()), float(load.std())
        if width < 1e-6:  # one gain of one block
            width = 1.0
        x = ((load[row, column] - middle) / width).ravel()
        design = np.vstack([np.ones_like(x), x, 0.5 * (x * x - 1.0), wide, x * wide])
        at = _logistic(design, fell[test, row, column].ravel())
        size = others.shape[1]
        constant, slope = at[0] + others @ at[3 : 3 + size], at[1] + others @ at[3 + size :]
        y = (sigma[test][:, np.newaxis] * nodes - lean[:, np.newaxis] - middle) / width
        odds = constant[:, np.newaxis] + slope[:, np.newaxis] * y + 0.5 * at[2] * (y * y - 1.0)
        steep = (slope[:, np.newaxis] + at[2] * y) * (BETWEEN * sigma[test] / width)[:, np.newaxis]
        odds /= np.sqrt(1.0 + 0.125 * np.pi * steep * steep)
        fitted = (1.0 / (1.0 + np.exp(-np.clip(odds, -MOST_LOG_ODDS, MOST_LOG_ODDS)))) @ weights
        found[:, test] = (count * found[:, test] + lent * fitted) / (count + lent)
    return found


def _logistic(design: Floats, fell: Bools) -> Floats:
    """Return the coefficients of a logistic curve by Newton's method with a small ridge.

    Parameters
    ----------
    design
        Shape (coefficients, runs), the first row 1.
    fell
        Shape (runs,).
    """
    ridge = np.full(len(design), RIDGE)
    ridge[0] *= 0.1
    at = np.zeros(len(design))
    target = fell.astype(np.float64)
    for _ in range(STEPS):
        odds = np.clip(at @ design, -MOST_LOG_ODDS, MOST_LOG_ODDS)
        p = 1.0 / (1.0 + np.exp(-odds))
        slope = design @ (target - p) - ridge * at
        bend = (design * (p * (1.0 - p))) @ design.T + np.diag(ridge)
        step = np.linalg.solve(bend, slope)
        largest = float(np.abs(step).max())
        if largest > 0.0:
            at += step * min(1.0, 3.0 / largest)
        if largest < 1e-2:
            break
    return at
