"""Proposals of draws: the prior, then mixtures of t distributions; and how far weights carry."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import exp, log, log1p
from rocksteady.risk.calibration.sampler.exact import (
    cholesky,
    effective,
    forward,
    log_sum_exp,
    rounded,
    softmax,
)

FREEDOM = 6.0
"""Of the t distributions."""
SCORE_BITS = 20
"""Grid of the scores."""
STEPS = 15
"""Of expectation and maximisation."""
LEAST_SHARE = 0.02
LEAST_TAIL = 5
"""Weights of a tail that a law is fitted to."""
MOST_K = 0.7
"""Pareto's k above which no estimate from weights is to be trusted."""


@dataclass(frozen=True, eq=False)
class Mixture:
    """Mixture of t distributions of normal scores; without parts the prior, standard normal.

    Attributes
    ----------
    size
        Number of parameters.
    shares, centres, roots
        Share of each part, its centre, shape (parts, size), and the triangular root of its scale,
        shape (size, size, parts).
    """

    size: int
    shares: Floats | None = None
    centres: Floats | None = None
    roots: Floats | None = None

    def sample(self, draws: int, seed: Sequence[int]) -> Floats:
        """Return scores from scrambled Sobol points, shape (draws, size)."""
        from scipy.special import gammaincinv, ndtri
        from scipy.stats import qmc

        sobol = qmc.Sobol(self.size + 2, rng=np.random.default_rng(list(seed)))
        points = sobol.random_base2(max(int(draws - 1).bit_length(), 1))[:draws]
        points = np.clip(points, 1e-9, 1.0 - 1e-9)
        scores: Floats = np.asarray(ndtri(points[:, : self.size]))
        if self.shares is not None and self.centres is not None and self.roots is not None:
            chi = np.asarray(2.0 * gammaincinv(0.5 * FREEDOM, points[:, -2:-1]))
            scores = scores / np.sqrt(chi / FREEDOM)
            edges = np.cumsum(self.shares)[:-1]
            part = np.searchsorted(edges, points[:, -1])
            turned = np.einsum("ijn,nj->ni", self.roots[:, :, part], scores)
            scores = self.centres[part] + turned
        return rounded(scores, SCORE_BITS)

    def distances(self, scores: Floats) -> Floats:
        """Return squares of scaled distances from each centre, shape (parts, draws)."""
        assert self.centres is not None
        assert self.roots is not None
        apart = (scores - self.centres[:, np.newaxis]).transpose(2, 1, 0)
        return np.asarray(np.square(forward(self.roots, apart)).sum(axis=0).T)

    def log_density(self, scores: Floats) -> Floats:
        """Return ln of the density over that of the prior, shape (draws,)."""
        if self.shares is None or self.roots is None:
            return np.zeros(len(scores))
        from scipy.special import gammaln

        size = self.size
        turns = log(self.roots[np.arange(size), np.arange(size)]).sum(axis=0)
        constant = np.asarray(gammaln(0.5 * (FREEDOM + size)) - gammaln(0.5 * FREEDOM))
        constant = rounded(constant - 0.5 * size * log(0.5 * FREEDOM) - turns, 30)
        logs = log(self.shares) + constant
        far = log1p(self.distances(scores) / FREEDOM)
        parts = logs[:, np.newaxis] - 0.5 * (FREEDOM + size) * far
        return np.asarray(log_sum_exp(parts.T) + 0.5 * np.square(scores).sum(axis=1))

    def closeness(self, scores: Floats) -> Floats:
        """Return 1 within the reach of the parts, 0 far outside, and 1 of the prior."""
        if self.shares is None or self.size == 0:
            return np.ones(len(scores))
        far = self.distances(scores).min(axis=0)
        return np.asarray(np.clip(2.0 - far / (4.0 * self.size), 0.0, 1.0))


def fit_mixture(
    scores: Floats, weights: Floats, parts: int, seed: Sequence[int], *, widen: float = 1.15
) -> Mixture:
    """Return a mixture fitted to weighted scores by expectation and maximisation."""
    count, size = scores.shape
    if size == 0:
        return Mixture(0)
    rng = np.random.default_rng(list(seed))
    weights = rounded(weights, 30)
    middle = rounded(weights @ scores / weights.sum(), SCORE_BITS)
    whole = _spread(scores, middle, weights) + 1e-5 * np.eye(size)
    centres = scores[rng.choice(count, parts, p=weights / weights.sum())]
    shares, spreads = np.full(parts, 1.0 / parts), np.stack([whole] * parts, axis=2)
    for _ in range(STEPS):
        trial = Mixture(size, shares, centres, cholesky(spreads))
        assert trial.roots is not None
        turns = log(trial.roots[np.arange(size), np.arange(size)]).sum(axis=0)
        logs = (log(shares) - turns)[:, np.newaxis] - 0.5 * trial.distances(scores)
        belongs = rounded(exp(logs - log_sum_exp(logs.T)) * weights, 30)
        shares = belongs.sum(axis=1) + 1e-9
        centres = rounded(belongs @ scores / shares[:, np.newaxis], SCORE_BITS)
        worth = np.square(shares) / np.maximum(rounded(belongs * belongs, 50).sum(axis=1), 1e-15)
        lean = size / (size + worth)  # few points: towards the spread of all
        for part in range(parts):
            near = _spread(scores, centres[part], belongs[part])
            spreads[:, :, part] = (1.0 - lean[part]) * near + lean[part] * 0.3 * whole
        spreads[np.arange(size), np.arange(size)] += 1e-5
    shares = np.maximum(shares, LEAST_SHARE)
    return Mixture(size, shares / shares.sum(), centres, widen * cholesky(spreads))


def _spread(scores: Floats, centre: Floats, weights: Floats) -> Floats:
    """Return the weighted covariance of scores about a centre."""
    apart = np.clip(scores - centre, -16.0, 16.0)
    total = rounded(apart.T * weights, 24) @ apart
    return np.asarray(total / (weights.sum() + 1e-9))


def balance(scores: Floats, proposals: Sequence[Mixture], counts: Sequence[int]) -> Floats:
    """Return ln(prior/mixture of all proposals) of each draw [1], shape (draws,).

    The prior is one of them, so that no weight is larger than the number of draws over its own.

    References
    ----------
    .. [1] A. Owen and Y. Zhou, J. Am. Stat. Assoc. 95, 135-143 (2000).
    """
    shares = log(np.array(counts) / sum(counts))
    parts = [
        share + each.log_density(scores) for share, each in zip(shares, proposals, strict=True)
    ]
    return -log_sum_exp(np.stack(parts, axis=1))


def temper_of(base: Floats, joint: Floats, least: float) -> float:
    """Return the largest power of the likelihood that leaves so many effective draws."""
    if effective(softmax(base + joint)) >= least:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(24):
        middle = 0.5 * (low + high)
        good = effective(softmax(base + middle * joint)) >= least
        low, high = (middle, high) if good else (low, middle)
    return max(low, 1e-6)


def pareto_k(weights: Floats) -> float:
    """Return the shape k of a Pareto law of the largest weights [1]; above 0.7 doubt them.

    The law is fitted to the largest 3 sqrt(draws) weights, a fifth of all at most [2].  With too
    few weights, or equal ones, k is nan.

    References
    ----------
    .. [1] A. Vehtari, D. Simpson, A. Gelman, Y. Yao and J. Gabry, J. Mach. Learn. Res. 25, 72
       (2024).
    .. [2] J. Zhang and M. A. Stephens, Technometrics 51, 316-325 (2009).
    """
    count = int(min(0.2 * len(weights), 3.0 * np.sqrt(len(weights))))
    if count < LEAST_TAIL:
        return np.nan
    order = np.sort(weights)
    x = order[-count:] - order[-count - 1]
    quarter = float(x[int(count / 4 + 0.5) - 1])
    if quarter <= 1e-12 * float(order[-1]):
        return np.nan
    number = 30 + int(np.sqrt(count))
    b = (1.0 - np.sqrt(number / (np.arange(1, number + 1) - 0.5))) / (3.0 * quarter) + 1.0 / x[-1]
    k = log1p(-b[:, np.newaxis] * x).mean(axis=1)
    profile = softmax(count * (log(-b / k) - k - 1.0))
    shape = float(log1p(-float((profile * b).sum()) * x).mean())
    return (count * shape + 5.0) / (count + 10.0)
