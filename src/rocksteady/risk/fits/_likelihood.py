"""Binomial log-likelihood of probits, its gradient and Hessian, and its maximum."""

import math

import numpy as np

from rocksteady.arrays import Floats

SQRT_2 = math.sqrt(2.0)
ROOT_OF_2_BY_PI = math.sqrt(2.0 / math.pi)


def log_likelihood_of(eta: Floats, failures: Floats, trials: Floats) -> float:
    """Return sum(k ln F + (n - k) ln(1 - F)), without binomial coefficients."""
    from scipy.special import log_ndtr

    return float(failures @ log_ndtr(eta) + (trials - failures) @ log_ndtr(-eta))


def slopes(eta: Floats, failures: Floats, trials: Floats) -> tuple[Floats, Floats]:
    """Return the first and the negative second derivative of each term with respect to eta.

    The inverse Mills ratio F'/F is exact in both tails, and its derivative is -F'/F (F'/F + eta).
    """
    from scipy.special import erfcx

    up, down = (ROOT_OF_2_BY_PI / erfcx(-side / SQRT_2) for side in (eta, -eta))
    stood = trials - failures
    first = failures * up - stood * down
    second = failures * up * (up + eta) + stood * down * (down - eta)
    return first, second


def maximise(design: Floats, failures: Floats, trials: Floats, start: Floats) -> Floats:
    """Return the coefficients of the largest likelihood, where it has one.

    The log-likelihood is concave in the coefficients [1].  SciPy's trust region comes near to its
    maximum from anywhere; MINPACK's hybrid method then solves the equations of the score, which
    rounding of the likelihood does not limit.

    Parameters
    ----------
    design
        Of P = F(design @ coefficients), F the normal distribution; shape (n, q).
    failures, trials
        Shape (n,).
    start
        First guess, shape (q,).

    References
    ----------
    .. [1] J. W. Pratt, Journal of the American Statistical Association 76, 103-106 (1981).
    """
    from scipy.optimize import minimize

    size = float(trials.sum())

    def loss(at: Floats) -> float:
        return -log_likelihood_of(design @ at, failures, trials) / size

    def gradient(at: Floats) -> Floats:
        row: Floats = -(slopes(design @ at, failures, trials)[0] @ design) / size
        return row

    def hessian(at: Floats) -> Floats:
        second = slopes(design @ at, failures, trials)[1]
        matrix: Floats = (design * second[:, None]).T @ design / size
        return matrix

    near = minimize(
        loss,
        start,
        method="trust-exact",
        jac=gradient,
        hess=hessian,
        options={"gtol": 1e-9, "maxiter": 500},
    ).x
    solved = solve_score(design, failures, trials, near)
    return near if solved is None else solved


def solve_score(design: Floats, failures: Floats, trials: Floats, start: Floats) -> Floats | None:
    """Return the coefficients at which the score is 0, from near them; None if not found."""
    from scipy.optimize import root

    size = float(trials.sum())

    def score(at: Floats) -> tuple[Floats, Floats]:
        first, second = slopes(design @ at, failures, trials)
        return first @ design / size, (design * (second / -size)[:, None]).T @ design

    result = root(score, start, jac=True, method="lm", options={"xtol": 1e-11, "ftol": 1e-24})
    # At the last digits it may report no progress where it is as near as rounding lets it be.
    arrived = bool(np.abs(result.fun).max() < 1e-9) and bool(np.isfinite(result.x).all())
    return result.x if arrived else None
