"""The curve of the largest likelihood, or the status of data without one.

Separable data have no maximum: an optimiser would return whatever its last step was.  So separation
is decided before anything is fitted.
"""

import math
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.fits._likelihood import log_likelihood_of, maximise
from rocksteady.risk.fits._totals import Totals

FITTED, SEPARATED, NEVER, ALWAYS, NOT_RISING = (
    "fitted",
    "separated",
    "never",
    "always",
    "not-rising",
)
LEAST_RISE = 1e-12
"""Slope of the likelihood at a flat curve, over the number of trials, that rounding can make."""
LARGEST_LOG = 690.0
"""Of a median: exp of more is beyond the floats."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Maximum:
    """What of a `FragilityCurve` the largest likelihood determines.

    Attributes
    ----------
    status, median, beta, step, log_likelihood
        As there.
    shares
        Share of failures that the curve gives to each level; NaN without a curve.
    """

    status: str
    median: float = math.nan
    beta: float = math.nan
    step: tuple[float, float] | None = None
    log_likelihood: float
    shares: Floats


def maximum_of(totals: Totals) -> Maximum:
    """Return the lognormal curve of the largest likelihood, or the status of data without one."""
    status, step = _status_of(totals)
    best = _fitted(totals) if status == FITTED else None
    if best is not None:
        return best
    levels, failures, trials = totals
    if status in (FITTED, NOT_RISING):
        flat = np.full(len(levels), failures.sum() / trials.sum())
        return Maximum(
            status=NOT_RISING,
            log_likelihood=_likelihood(flat, totals),
            shares=np.full(len(levels), math.nan),
        )
    shares, median = failures / trials, math.nan
    if step is not None:
        low, high = step
        # At one level with both outcomes it is that level, to the last bit.
        median = low if low == high else math.sqrt(low) * math.sqrt(high)
        shares = np.select([levels < high, levels > low], [0.0, 1.0], shares)
    return Maximum(
        status=status,
        median=median,
        step=step,
        log_likelihood=_likelihood(shares, totals),
        shares=shares,
    )


def _status_of(totals: Totals) -> tuple[str, tuple[float, float] | None]:
    """Return the status of counts, and the levels between which a step lies.

    The log-likelihood is concave, so that its maximum has a slope above 0 where its derivative
    with respect to the slope is above 0 at the best flat curve: where failures lie at higher
    intensities than trials do.  A maximum exists where levels of failures and of survivals overlap
    by more than one shared level [1].

    References
    ----------
    .. [1] A. Albert and J. A. Anderson, Biometrika 71, 1-10 (1984).
    """
    levels, failures, trials = totals
    if not failures.any():
        return NEVER, None
    if (failures == trials).all():
        return ALWAYS, None
    logs = np.log(levels)
    rise = (failures - failures.sum() / trials.sum() * trials) @ (logs - logs.mean())
    if rise <= LEAST_RISE * trials.sum():
        return NOT_RISING, None
    stood = float(levels[np.flatnonzero(failures < trials)[-1]])
    failed = float(levels[np.flatnonzero(failures)[0]])
    return (SEPARATED, (stood, failed)) if stood <= failed else (FITTED, None)


def _fitted(totals: Totals) -> Maximum | None:
    """Return the maximum of overlapping counts: P = F(a + b z), z = (ln im - centre)/scale.

    None where rounding makes the curve flat, or its median is beyond the floats.
    """
    from scipy.special import ndtr, ndtri

    levels, failures, trials = totals
    logs, size = np.log(levels), trials.sum()
    centre = float(trials @ logs / size)
    scale = math.sqrt(float(trials @ np.square(logs - centre) / size))
    design = np.column_stack([np.ones_like(logs), (logs - centre) / scale])
    start = np.array([float(ndtri(failures.sum() / size)), 1.0])
    at = maximise(design, failures, trials, start)
    a, b = at.tolist()
    if b <= 0.0 or abs(centre - scale * a / b) > LARGEST_LOG:
        return None
    eta = design @ at
    return Maximum(
        status=FITTED,
        median=math.exp(centre - scale * a / b),
        beta=scale / b,
        log_likelihood=log_likelihood_of(eta, failures, trials),
        shares=ndtr(eta),
    )


def _likelihood(shares: Floats, totals: Totals) -> float:
    """Return the log-likelihood of single trials at the probabilities of the levels."""
    from scipy.special import xlog1py, xlogy

    _, failures, trials = totals
    return float((xlogy(failures, shares) + xlog1py(trials - failures, -shares)).sum())
