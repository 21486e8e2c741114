"""Draws of the parameters in rounds, and the density that they came from."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.calibration.held_out.folds import LADDER, effective, normalised

FREEDOM = 5.0
"""Of the t distribution of a refined round."""
WIDER = 1.4
"""Its scale over that of the posterior."""
LEAST_TAIL = 5
"""Weights of a tail that a law is fitted to."""
MOST_SHAPE = 0.7
LEAST_EFFECTIVE = 40.0
"""Draws that a round is fitted to: with fewer the likelihood is tempered until there are."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Proposal:
    """A density of normal scores: multivariate t, or the standard normal of the prior.

    Attributes
    ----------
    draws
        Number of draws that come from it.
    centre, root
        Middle of the t distribution, and the Cholesky factor of its scale; None for the prior.
    """

    draws: int
    centre: Floats | None = None
    root: Floats | None = None

    def sample(self, size: int, seed: Sequence[int]) -> Floats:
        """Return draws from scrambled Sobol points, shape (draws, size)."""
        from scipy.special import gammaincinv, ndtri
        from scipy.stats import qmc

        heavy = self.centre is not None
        rng = np.random.default_rng(list(seed))
        sobol = qmc.Sobol(size + heavy, rng=rng)
        exponent = max(0, int(np.ceil(np.log2(self.draws))))
        points = np.clip(sobol.random_base2(exponent)[: self.draws], 1e-9, 1.0 - 1e-9)
        scores: Floats = ndtri(points[:, :size])
        if self.centre is None or self.root is None:
            return scores
        chi = 2.0 * gammaincinv(0.5 * FREEDOM, points[:, size])
        heavier: Floats = scores @ self.root.T / np.sqrt(chi / FREEDOM)[:, np.newaxis]
        return self.centre + heavier

    def log_density(self, scores: Floats) -> Floats:
        """Return ln of the density over that of the prior, a constant of both left out."""
        squares = np.square(scores).sum(axis=1)
        if self.centre is None or self.root is None:
            return np.zeros(len(scores))
        from scipy.linalg import solve_triangular
        from scipy.special import gammaln

        size = scores.shape[1]
        apart = solve_triangular(self.root, (scores - self.centre).T, lower=True)
        distance = np.square(apart).sum(axis=0)
        constant = (
            gammaln(0.5 * (FREEDOM + size))
            - gammaln(0.5 * FREEDOM)
            - 0.5 * size * np.log(0.5 * FREEDOM)
            - np.log(np.diag(self.root)).sum()
        )
        heavy = constant - 0.5 * (FREEDOM + size) * np.log1p(distance / FREEDOM)
        density: Floats = heavy + 0.5 * squares
        return density


def base_weights(scores: Floats, proposals: Sequence[Proposal]) -> Floats:
    """Return ln(prior/mixture of all rounds) of each draw [1], shape (draws,).

    The prior is the standard normal of the scores.  It is one of the mixture, so that no weight is
    larger than the number of draws over those of the prior.

    References
    ----------
    .. [1] A. Owen and Y. Zhou, J. Am. Stat. Assoc. 95, 135-143 (2000).
    """
    total = sum(each.draws for each in proposals)
    parts = [np.log(each.draws / total) + each.log_density(scores) for each in proposals]
    weights: Floats = -np.logaddexp.reduce(parts, axis=0)
    return weights


def refine(scores: Floats, base: Floats, log_likelihood: Floats, draws: int) -> Proposal:
    """Return the proposal of the next round, from the weights of all draws until now.

    It is fitted to the posterior at the largest temper that leaves enough effective draws.
    """
    weights = normalised(base[:, np.newaxis])[:, 0]
    for temper in (*LADDER, 0.02, 0.01):
        weights = normalised((base + temper * log_likelihood)[:, np.newaxis])[:, 0]
        if effective(weights) >= min(LEAST_EFFECTIVE, 0.2 * len(weights)):
            break
    centre = weights @ scores
    apart = scores - centre
    spread = (apart.T * weights) @ apart + 1e-6 * np.eye(scores.shape[1])
    root: Floats = np.asarray(WIDER * np.linalg.cholesky(spread), dtype=np.float64)
    return Proposal(draws=draws, centre=centre, root=root)


def smoothed(weights: Floats) -> tuple[Floats, float]:
    """Return weights whose largest follow a Pareto law, and its shape k [1].

    The largest 3 sqrt(draws) weights, a fifth of all at most, become quantiles of a generalised
    Pareto law that is fitted to them [2].  Above a k of 0.7 no estimate from the weights is to be
    trusted, and they stay.  With too few weights, or equal ones, they stay, and k is nan.

    References
    ----------
    .. [1] A. Vehtari, D. Simpson, A. Gelman, Y. Yao and J. Gabry, J. Mach. Learn. Res. 25, 72
       (2024).
    .. [2] J. Zhang and M. A. Stephens, Technometrics 51, 316-325 (2009).
    """
    count = int(min(0.2 * len(weights), 3.0 * np.sqrt(len(weights))))
    order = np.argsort(weights, kind="stable")
    if count < LEAST_TAIL:
        return weights, np.nan
    tail, cut = order[-count:], float(weights[order[-count - 1]])
    x = weights[tail] - cut
    quarter = float(x[int(count / 4 + 0.5) - 1])
    if quarter <= 1e-12 * float(weights.max()):
        return weights, np.nan
    number = 30 + int(np.sqrt(count))
    b = (1.0 - np.sqrt(number / (np.arange(1, number + 1) - 0.5))) / (3.0 * quarter) + 1.0 / x[-1]
    k = np.log1p(-b[:, np.newaxis] * x).mean(axis=1)
    profile = count * (np.log(-b / k) - k - 1.0)
    b_mean = float(normalised(profile[:, np.newaxis])[:, 0] @ b)
    raw = float(np.log1p(-b_mean * x).mean())
    scale, shape = -raw / b_mean, (count * raw + 5.0) / (count + 10.0)
    p = (np.arange(count) + 0.5) / count
    if shape > MOST_SHAPE:
        return weights, shape
    made = weights.copy()
    law = scale * np.expm1(-shape * np.log1p(-p)) / shape
    made[tail] = np.minimum(cut + law, weights.max())
    return made / made.sum(), shape
