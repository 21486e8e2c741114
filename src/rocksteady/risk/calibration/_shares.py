"""Probabilities of a fall from few runs each: gains in strata, and shrinkage to a fitted curve."""

import numpy as np

from rocksteady.arrays import Bools, Floats

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
    strata: Floats = ndtri((np.arange(count) + np.maximum(u, 1e-12)) / count)
    return strata


def pooled_shares(fell: Bools, gain: Floats, sigma: Floats, features: Floats) -> Floats:
    """Return the probability of a fall at each draw, shrunk to a curve fitted to all draws.

    The runs of a draw are few, so that the share of them that fell is noise to a good part, and
    a likelihood of hundreds of such shares would pick the luckiest draw: of 200 synthetic tests it
    leaves about 10 effective draws of 1500.  A logistic curve is fitted to the runs of each test,
    over ln(gain/tan alpha) and the other properties of the block, and integrated over the gain: by
    Gauss's nodes, and about each of them by the logistic curve of a normal odds [1].  The estimate
    is

        Q = (1 - w) k/K + w E,    w = min(1, V/S),

    with k falls of K runs, E the fitted probability, S the mean square of k/K - E over the draws,
    and V the part of S that the sampling of the gains explains: f (1 - f)/K^2, f the fraction of
    K E, since one gain lies in each stratum.  So w is the weight of least square error [2]: where
    the curve misses what the runs show, the runs count.

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

    Returns
    -------
    ndarray
        Shape (draws, tests).

    References
    ----------
    .. [1] D. J. C. MacKay, Neural Computation 4, 720-736 (1992).
    .. [2] B. Efron and C. Morris, J. Am. Stat. Assoc. 70, 311-319 (1975).
    """
    tests, draws, count = fell.shape
    shares: Floats = fell.mean(axis=2).T
    lean, others = features[:, 0], features[:, 1:]
    others = others[:, others.std(axis=0) > 1e-9]
    others = (others - others.mean(axis=0)) / others.std(axis=0)
    picked = min(count, max(1, MOST_RUNS // draws))
    # Other strata at each draw, so that all of them occur evenly.
    column = (np.arange(draws)[:, np.newaxis] + (count * np.arange(picked)) // picked) % count
    row = np.arange(draws)[:, np.newaxis]
    wide = np.repeat(others, picked, axis=0).T
    nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
    nodes, weights = np.sqrt(1.0 - BETWEEN**2) * nodes, weights / weights.sum()
    for test in range(tests):
        if (fell[test] == fell[test, 0, 0]).all():
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
        strata = count if sigma[test].any() else 1  # without an error of the gain all runs are one
        part = (strata * fitted) % 1.0
        explained = float((part * (1.0 - part)).mean()) / strata**2
        apart = float(np.square(shares[:, test] - fitted).mean())
        weight = min(1.0, explained / apart) if apart > 0.0 else 1.0
        shares[:, test] += weight * (fitted - shares[:, test])
    return shares


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
