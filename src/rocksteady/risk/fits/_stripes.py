"""Stripes: counted shares at an intensity beside the curve."""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.results.numbers import number_or_none
from rocksteady.risk.fits._totals import Totals

Row = tuple[float, int, int, float | None]
FEWEST = 10
"""Trials of a stripe, on average, and the number of stripes that are made otherwise."""


def compare_stripes(totals: Totals, probability: Floats) -> tuple[tuple[Row, ...], float]:
    """Return intensity, trials, failures and probability by stripe, and the largest misfit.

    Levels are stripes where they have ten trials each on average; of scattered intensities,
    neighbours are joined to about ten stripes, each at the mean of ln im and with the mean of the
    probabilities.
    """
    levels, failures, trials = totals
    total, place = trials.sum(), np.arange(len(trials))
    if total < FEWEST * len(trials):
        number_of = max(1, min(FEWEST, int(total) // FEWEST))
        middle = np.cumsum(trials) - 0.5 * trials
        place = np.unique((number_of * middle / total).astype(np.intp), return_inverse=True)[1]
    weight = np.bincount(place, weights=trials)
    at = np.exp(np.bincount(place, weights=trials * np.log(levels)) / weight)
    failed = np.bincount(place, weights=failures)
    curve = np.bincount(place, weights=trials * probability) / weight
    rows = zip(at.tolist(), weight.tolist(), failed.tolist(), curve.tolist(), strict=True)
    return (
        tuple((x, int(n), int(k), number_or_none(p)) for x, n, k, p in rows),
        float(np.abs(failed / weight - curve).max()),
    )
