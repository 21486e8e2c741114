"""Binomial log-likelihoods, their gradients and Hessians, and their maximum."""

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats

SQRT_2 = math.sqrt(2.0)
ROOT_OF_2_BY_PI = math.sqrt(2.0 / math.pi)


@dataclass(frozen=True)
class Family:
    """A cumulative distribution F of the predictor eta, in forms that are exact in both tails.

    Attributes
    ----------
    cdf, log_cdf, quantile
        F, ln F and the inverse of F; 1 - F(eta) = F(-eta).
    hazard
        F'(eta)/F(eta).
    fall
        -d hazard/d eta at (eta, hazard).
    """

    cdf: Callable[[Floats], Floats]
    log_cdf: Callable[[Floats], Floats]
    quantile: Callable[[Floats], Floats]
    hazard: Callable[[Floats], Floats]
    fall: Callable[[Floats, Floats], Floats]


@functools.cache
def family_of(name: str) -> Family:
    """Return the distribution of a family: "lognormal" or "logistic"."""
    from scipy import special

    def hazard_of_normal(eta: Floats) -> Floats:
        hazard: Floats = ROOT_OF_2_BY_PI / special.erfcx(-eta / SQRT_2)
        return hazard

    families: Mapping[str, Family] = {
        "lognormal": Family(
            special.ndtr,
            special.log_ndtr,
            special.ndtri,
            hazard_of_normal,
            lambda eta, hazard: hazard * (hazard + eta),
        ),
        "logistic": Family(
            special.expit,
            special.log_expit,
            special.logit,
            lambda eta: special.expit(-eta),
            lambda _, hazard: hazard * (1.0 - hazard),
        ),
    }
    return families[name]


def log_likelihood_of(family: Family, eta: Floats, failures: Floats, trials: Floats) -> float:
    """Return sum(k ln F + (n - k) ln(1 - F)), without binomial coefficients."""
    stood = trials - failures
    return float(failures @ family.log_cdf(eta) + stood @ family.log_cdf(-eta))


def slopes(family: Family, eta: Floats, failures: Floats, trials: Floats) -> tuple[Floats, Floats]:
    """Return the first and the negative second derivative of each term with respect to eta."""
    up, down = family.hazard(eta), family.hazard(-eta)
    stood = trials - failures
    first = failures * up - stood * down
    second = failures * family.fall(eta, up) + stood * family.fall(-eta, down)
    return first, second


def maximise(
    family: Family, design: Floats, failures: Floats, trials: Floats, start: Floats
) -> Floats:
    """Return the coefficients of the largest likelihood, where it has one.

    The log-likelihood is concave in the coefficients [1].  SciPy's trust region comes near to its
    maximum from anywhere; MINPACK's hybrid method then solves the equations of the score, which
    rounding of the likelihood does not limit.

    Parameters
    ----------
    family
        F of P = F(design @ coefficients).
    design
        Shape (n, q).
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
        return -log_likelihood_of(family, design @ at, failures, trials) / size

    def gradient(at: Floats) -> Floats:
        row: Floats = -(slopes(family, design @ at, failures, trials)[0] @ design) / size
        return row

    def hessian(at: Floats) -> Floats:
        second = slopes(family, design @ at, failures, trials)[1]
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
    solved = solve_score(family, design, failures, trials, near)
    return near if solved is None else solved


def solve_score(
    family: Family, design: Floats, failures: Floats, trials: Floats, start: Floats
) -> Floats | None:
    """Return the coefficients at which the score is 0, from near them; None if not found."""
    from scipy.optimize import root

    size = float(trials.sum())

    def score(at: Floats) -> tuple[Floats, Floats]:
        first, second = slopes(family, design @ at, failures, trials)
        return first @ design / size, (design * (second / -size)[:, None]).T @ design

    result = root(score, start, jac=True, method="lm", options={"xtol": 1e-11, "ftol": 1e-24})
    # At the last digits it may report no progress where it is as near as rounding lets it be.
    arrived = bool(np.abs(result.fun).max() < 1e-9) and bool(np.isfinite(result.x).all())
    return result.x if arrived else None
