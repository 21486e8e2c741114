"""The 90 % interval of a share that was counted over records."""

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.results.numbers import CONFIDENCE

TAIL: Final = 0.5 * (1.0 - CONFIDENCE)
"""Probability beyond each end of an interval."""
MOST_TRIALS: Final = 2
"""Trials that one record stands for at most: its runs depend on each other."""


def share_band(shares: ArrayLike, ways: int) -> tuple[float, float]:
    """Return both ends of the interval of the mean of some records' shares.

    Clopper and Pearson's [1]_ of an effective number of trials, ``p (1 - p)`` over the variance of
    the mean [2]_, held between one and two of each record.  It is never tighter than that of as
    many records of which none falls, or all.

    Parameters
    ----------
    shares
        Share of the runs of each record, shape (records,), one at least.
    ways
        Runs of a record.

    References
    ----------
    .. [1] C. J. Clopper, E. S. Pearson, Biometrika 26, 404-413 (1934).
    .. [2] E. L. Korn, B. I. Graubard, Survey Methodology 24, 193-201 (1998).

    Examples
    --------
    >>> low, high = share_band([0.0] * 56, 5)
    >>> print(f"{low:.3f} to {high:.3f}")
    0.000 to 0.052
    """
    from scipy.special import betaincinv

    each = np.asarray(shares, dtype=np.float64)
    count, share = len(each), mean_of(each)
    # Sums are exact, so that the order of the records does not matter.
    spread = math.fsum((value - share) ** 2 for value in each.tolist()) / max(count - 1, 1)
    trials = float(count)
    if 0.0 < share < 1.0 and count > 1:
        most = float(min(MOST_TRIALS, ways) * count)
        pure = count * share * (1.0 - share)
        trials = most if pure >= most * spread else max(pure / spread, trials)
    fell = share * trials
    low = high = share
    if share > 0.0:
        low = float(betaincinv(fell, trials - fell + 1.0, TAIL))
    if share < 1.0:
        high = float(betaincinv(fell + 1.0, trials - fell, 1.0 - TAIL))
    least = upper_of_none(count)
    return min(low, 1.0 - least), max(high, least)


def mean_of(shares: Floats) -> float:
    """Return the mean of some records' shares, whatever their order."""
    return math.fsum(shares.tolist()) / len(shares)


def upper_of_none(records: int) -> float:
    """Return the upper end of the interval of a share of none of some records.

    Examples
    --------
    >>> print(f"{upper_of_none(11):.2f} {upper_of_none(56):.3f}")
    0.24 0.052
    """
    return float(1.0 - TAIL ** (1.0 / records))


def records_to_show(target: float) -> int:
    """Return the fewest records of which none may fall to show a share below a target.

    Examples
    --------
    >>> [records_to_show(target) for target in (0.1, 0.05, 0.02, 0.01)]
    [29, 59, 149, 299]
    """
    count = max(1, math.floor(math.log(TAIL) / math.log1p(-target)))
    return count if upper_of_none(count) < target else count + 1
