"""Confidence of intervals: one default for all, and Wilson's interval of a share."""

from typing import Annotated, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.numbers import CONFIDENCE

Confidence = Annotated[float, Bounds(0.0, 1.0, "()", "give 0.9 for 90 %")]
CONFIDENCE_TEXT: Final = f"{100.0 * CONFIDENCE:g} % interval"
"""Heading of an interval of that confidence."""


def share_interval(
    shares: ArrayLike, trials: ArrayLike, confidence: float = CONFIDENCE
) -> tuple[Floats, Floats]:
    """Return both ends of Wilson's score interval of shares of trials.

    Parameters
    ----------
    shares
        Successes over trials.
    trials
        Number of trials, at least 1.
    confidence
        Confidence of the interval, in (0, 1).

    References
    ----------
    E. B. Wilson, J. Am. Stat. Assoc. 22, 209-212 (1927).

    Examples
    --------
    >>> low, high = share_interval([0.0, 0.3], 10)
    >>> print(low.round(4), high.round(4))
    [0.     0.1269] [0.2129 0.5583]
    """
    from scipy.special import ndtri

    share, count = np.asarray(shares, np.float64), np.asarray(trials, np.float64)
    z = float(ndtri(0.5 + 0.5 * confidence))
    scale = 1.0 + z * z / count
    centre = (share + 0.5 * z * z / count) / scale
    shift = 0.5 * z / count
    half = z * np.sqrt(share * (1.0 - share) / count + shift * shift) / scale
    # Rounded, an end may lie a hair beyond the share of no trial or of all.
    low, high = np.maximum(centre - half, 0.0), np.minimum(centre + half, 1.0)
    return np.where(share == 0.0, 0.0, low), np.where(share == 1.0, 1.0, high)
