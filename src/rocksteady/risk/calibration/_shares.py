"""Probabilities of a fall from few runs each: gains in strata, and shrinkage to a fitted curve."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

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
RATIO = 2
"""Column of the restitution after ln tan alpha among the features."""
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


def pooled_shares(
    fell: Bools, gain: Floats, sigma: Floats, features: Floats, mean: Floats | None = None
) -> Floats:
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
    mean
        Mean of the gains, shape (tests, draws); default 0.

    Returns
    -------
    ndarray
        Shape (draws, tests).

    References
    ----------
    .. [1] D. J. C. MacKay, Neural Computation 4, 720-736 (1992).
    .. [2] B. Efron and C. Morris, J. Am. Stat. Assoc. 70, 311-319 (1975).
    """
    return fit_curves(fell, gain, sigma, features, mean).shares


@dataclass(frozen=True, kw_only=True, eq=False)
class Curves:
    """Curves of the probability of a fall, one for each motion, fitted to the runs of all draws.

    Attributes
    ----------
    shares
        Probability of a fall at each draw, its runs counted, shape (draws, motions).
    lean, others
        ln tan alpha, shape (draws,), and the other properties in standard deviations.
    scale
        Standard deviation of the ratio that `at` moves; 0 where all draws have one.
    ratio
        Column of it in `others`.
    fits
        Middle and width of the load, and coefficients, of each motion; None where all runs are
        alike.
    """

    shares: Floats
    lean: Floats
    others: Floats
    scale: float
    ratio: int
    fits: Sequence[tuple[float, float, Floats] | None]

    def at(self, motion: int, shift: Floats, ratio: Floats, sigma: Floats) -> Floats:
        """Return the probability of a fall of a motion that is moved, shape (draws, nodes).

        It is the curve alone: what few runs of a draw have beside it is noise to a likelihood of
        many tests, which would leave the luckiest draw all of the weight.

        Parameters
        ----------
        motion
            Its number.
        shift, ratio
            Added to ln(gain) and to the restitution, shape (draws, nodes) or one that fits it.
        sigma
            Standard deviation of ln(gain), shape (draws,).
        """
        fit = self.fits[motion]
        if fit is None:
            wide = np.broadcast_shapes(shift.shape, ratio.shape)
            return np.broadcast_to(self.shares[:, motion, np.newaxis], wide)
        moved = ratio / self.scale if self.scale else 0.0 * ratio
        return self._expected(*fit, shift, moved, sigma)

    def _expected(
        self, middle: float, width: float, at: Floats, shift: Floats, moved: Floats, sigma: Floats
    ) -> Floats:
        """Return the curve's own probability, integrated over the gain."""
        nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
        nodes, weights = np.sqrt(1.0 - BETWEEN**2) * nodes, weights / weights.sum()
        size, column = self.others.shape[1], self.ratio
        constant, slope = (
            at[0] + self.others @ at[3 : 3 + size],
            at[1] + self.others @ at[3 + size :],
        )
        constant, slope = (each[:, np.newaxis] for each in (constant, slope))
        if self.scale:
            constant = constant + at[3 + column] * moved
            slope = slope + at[3 + size + column] * moved
        deviation, total = sigma[:, np.newaxis], 0.0
        start = (shift - self.lean[:, np.newaxis] - middle) / width
        for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
            y = start + deviation * (node / width)
            odds = constant + slope * y + 0.5 * at[2] * (y * y - 1.0)
            steep = (slope + at[2] * y) * (BETWEEN / width) * deviation
            odds /= np.sqrt(1.0 + 0.125 * np.pi * steep * steep)
            total = total + weight / (1.0 + np.exp(-np.clip(odds, -MOST_LOG_ODDS, MOST_LOG_ODDS)))
        return np.asarray(total)


def fit_curves(
    fell: Bools, gain: Floats, sigma: Floats, features: Floats, mean: Floats | None = None
) -> Curves:
    """Return the curves of `pooled_shares`, which has the arguments and the equations."""
    tests, draws, count = fell.shape
    shares: Floats = fell.mean(axis=2).T
    lean, others = features[:, 0], features[:, 1:]
    varied = others.std(axis=0) > 1e-9
    ratio = int(varied[:RATIO].sum())
    scale = float(others[:, RATIO].std()) if varied[RATIO : RATIO + 1].any() else 0.0
    others = others[:, varied]
    others = (others - others.mean(axis=0)) / others.std(axis=0)
    curves = Curves(shares=shares, lean=lean, others=others, scale=scale, ratio=ratio, fits=())
    picked = min(count, max(1, MOST_RUNS // draws))
    # Other strata at each draw, so that all of them occur evenly.
    column = (np.arange(draws)[:, np.newaxis] + (count * np.arange(picked)) // picked) % count
    row = np.arange(draws)[:, np.newaxis]
    wide = np.repeat(others, picked, axis=0).T
    none = np.zeros((draws, 1))
    fits: list[tuple[float, float, Floats] | None] = []
    middles = np.zeros((tests, draws, 1)) if mean is None else mean[..., np.newaxis]
    for test in range(tests):
        if (fell[test] == fell[test, 0, 0]).all():
            fits.append(None)
            continue
        load = gain[test] - lean[:, np.newaxis]
        middle, width = float(load.mean()), float(load.std())
        if width < 1e-6:  # one gain of one block
            width = 1.0
        x = ((load[row, column] - middle) / width).ravel()
        design = np.vstack([np.ones_like(x), x, 0.5 * (x * x - 1.0), wide, x * wide])
        at = _logistic(design, fell[test, row, column].ravel())
        fitted = curves._expected(middle, width, at, middles[test], none, sigma[test])[:, 0]
        strata = count if sigma[test].any() else 1  # without an error of the gain all runs are one
        part = (strata * fitted) % 1.0
        explained = float((part * (1.0 - part)).mean()) / strata**2
        apart = float(np.square(shares[:, test] - fitted).mean())
        weight = min(1.0, explained / apart) if apart > 0.0 else 1.0
        shares[:, test] += weight * (fitted - shares[:, test])
        fits.append((middle, width, at))
    return replace(curves, fits=fits)


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
