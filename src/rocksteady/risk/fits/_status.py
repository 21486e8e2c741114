"""Whether a likelihood has its maximum at a curve: separated and one-sided data have none."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats

FITTED, SEPARATED, NEVER, ALWAYS, NOT_RISING = (
    "fitted",
    "separated",
    "never",
    "always",
    "not-rising",
)
LEAST_RISE = 1e-12
"""Slope of the likelihood at a flat curve, over the number of trials, that rounding can make."""


@dataclass(frozen=True, eq=False)
class Kinds:
    """Status of each row of counts, and the levels between which a step lies.

    Attributes
    ----------
    status
        Shape (b,).
    stood, failed
        Index of the highest level at which one or more stood, and of the lowest at which one or
        more failed, shape (b,).
    """

    status: NDArray[np.str_]
    stood: NDArray[np.intp]
    failed: NDArray[np.intp]


def kinds_of(log_levels: Floats, failures: Floats, trials: Floats) -> Kinds:
    """Return the status of rows of counts at ascending levels, shape (b, l).

    The log-likelihood is concave, so that its maximum has a slope above 0 where its derivative
    with respect to the slope is above 0 at the best flat curve: where failures lie at higher
    intensities than trials do.  A maximum exists where levels of failures and of survivals overlap
    by more than one shared level [1].

    References
    ----------
    .. [1] A. Albert and J. A. Anderson, Biometrika 71, 1-10 (1984).
    """
    width = failures.shape[1]
    survivals = trials - failures
    stood = width - 1 - np.argmax(survivals[:, ::-1] > 0.0, axis=1)
    failed = np.argmax(failures > 0.0, axis=1)
    all_trials, all_failures = trials.sum(axis=1), failures.sum(axis=1)
    flat = (all_failures / np.maximum(all_trials, 1.0))[:, None] * trials
    rise = (failures - flat) @ (log_levels - log_levels.mean())
    status = np.full(len(failures), FITTED, dtype="U10")
    status[stood <= failed] = SEPARATED
    status[rise <= LEAST_RISE * all_trials] = NOT_RISING
    status[all_failures == all_trials] = ALWAYS
    status[all_failures == 0.0] = NEVER
    return Kinds(status, stood, failed)
