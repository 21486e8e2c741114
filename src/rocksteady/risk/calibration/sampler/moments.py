"""What draws say of errors and gains of sessions: a mean and a deviation at each draw."""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.risk.calibration.sampler.exact import log_sum_exp, rounded
from rocksteady.risk.calibration.sampler.rounds import Fit


def error_moments(fit: Fit) -> dict[str, Floats]:
    """Return mean and deviation of each error at each draw, by name, shape (draws, 2)."""
    like, shares = fit.likelihood, _shares(fit)
    nodes = {"sigma_ln": like.sigma, "session_ln": like.between, "outliers": like.outliers}
    if not like.sessions:
        del nodes["session_ln"]
    axes = {"sigma_ln": (2, 3), "session_ln": (1, 3), "outliers": (1, 2)}
    moments = {}
    for name, at in nodes.items():
        mean, deviation = _moments(shares.sum(axis=axes[name]), at).T
        prior = getattr(like.noise, name)
        cell = (prior.high - prior.low) / len(at)  # that a node stands for
        moments[name] = np.stack([mean, np.sqrt(deviation**2 + cell**2 / 12.0)], axis=1)
    return moments


def session_moments(fit: Fit) -> dict[str, Floats]:
    """Return mean and deviation of ln(gain) of each session at each draw, shape (draws, 2)."""
    like, shares = fit.likelihood, _shares(fit).sum(axis=3)
    pairs = {name: np.zeros((len(fit.values), 2)) for name in like.sessions}
    if not pairs:
        return pairs
    heavy, every = np.flatnonzero(fit.weights > 0.0), np.arange(len(like.member))
    outliers = float(like.outliers[len(like.outliers) // 2])
    for part in like.parts(len(heavy)):
        places = heavy[part]
        falls = like.falls(fit.surfaces, fit.features[places])
        sums, _ = like.sums(like.logs(falls, outliers), every)
        after = exp(sums - sums.max(axis=-1, keepdims=True))[:, :, :, np.newaxis] * like.prior
        after /= after.sum(axis=-1, keepdims=True)
        after *= shares[places][:, np.newaxis, :, :, np.newaxis]
        for number, name in enumerate(like.sessions):
            pairs[name][places] = _moments(after[:, number].sum(axis=(1, 2)), like.gains)
    return pairs


def _shares(fit: Fit) -> Floats:
    """Return the share of each node of the errors at each draw, shape (draws, *grid)."""
    logs = fit.cells + fit.likelihood.grid
    total = log_sum_exp(logs.reshape(len(logs), -1))
    return exp(logs - total[:, np.newaxis, np.newaxis, np.newaxis])


def _moments(shares: Floats, values: Floats) -> Floats:
    """Return means and deviations of values with these shares, on a grid."""
    mean = rounded((shares * values).sum(axis=1), 30)
    square = (shares * np.square(values - mean[:, np.newaxis])).sum(axis=1)
    return np.stack([mean, rounded(np.sqrt(square), 30)], axis=1)
