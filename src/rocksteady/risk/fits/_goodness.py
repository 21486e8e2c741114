"""Goodness of fit with clustered trials: a score test against a skewed curve."""

import math

import numpy as np

from rocksteady.results.doubts import FEWEST_RECORDS
from rocksteady.risk.fits._likelihood import slopes
from rocksteady.risk.fits._maximum import Maximum
from rocksteady.risk.fits._status import FITTED

LEAST_SCATTER = 1e-9
"""Of the scores, below which an added term is as good as a sum of the others."""


def goodness_of(best: Maximum) -> float | None:
    """Return the p-value of a curve: small where the shares have another shape.

    The predictor a + b z is tested against a + b z + c P^2, P being the fitted probability: a gate,
    a floor and two kinds of records skew the curve so [1].  The score of c, without what a and b
    explain, is summed by record; its mean over the records is compared with its scatter from record
    to record [2] by Student's t, so that the dependence of a record's trials does not matter.

    It sees neither tails that are heavier on both sides alike nor departures from stripe to stripe
    without a trend, and has little power with few records.  It is None below 11 records, without a
    curve and at two levels.

    References
    ----------
    .. [1] D. Pregibon, Applied Statistics 29, 15-24 (1980), tests of a link by an added term.
    .. [2] D. D. Boos, The American Statistician 46, 327-333 (1992), generalised score tests.
    """
    from scipy.special import stdtr

    counts, family = best.counts, best.family
    records = counts.records
    if best.status != FITTED or records < FEWEST_RECORDS or len(counts.levels) < 3:
        return None
    eta = best.design @ best.coefficients
    wide = np.column_stack([best.design, np.square(family.cdf(eta))])
    second = slopes(family, eta, *counts.totals)[1]
    hessian = (wide * second[:, None]).T @ wide
    scores = counts.failures @ (family.hazard(eta)[:, None] * wide)
    scores -= (counts.trials - counts.failures) @ (family.hazard(-eta)[:, None] * wide)
    left = scores[:, 2] - scores[:, :2] @ np.linalg.solve(hessian[:2, :2], hessian[:2, 2])
    weight = counts.multiplicity
    mean = float(weight @ left) / records
    scatter = math.sqrt(float(weight @ np.square(left - mean)) / (records - 1))
    if scatter < LEAST_SCATTER * math.sqrt(float(weight @ np.square(scores).sum(axis=1))):
        return None
    return float(2.0 * stdtr(records - 1, -abs(mean) / scatter * math.sqrt(records)))
