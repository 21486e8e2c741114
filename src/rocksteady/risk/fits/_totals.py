"""Observations as a likelihood needs them: failures and trials by distinct intensity."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words

SAME_LEVEL = 1e-12
"""Relative difference of intensities that rounding makes."""


class Totals(NamedTuple):
    """Distinct intensities with trials, ascending, and failures and trials at each."""

    levels: Floats
    failures: Floats
    trials: Floats


def totals_of(intensity: ArrayLike, failures: ArrayLike, trials: ArrayLike | None) -> Totals:
    """Return failures and trials by level; without their number a trial is 1 each.

    A level that was reached by scaling each record differs by rounding from record to record.

    Raises
    ------
    InputError
        If a row or a number in it is not valid, with its place.
    """
    at = _row("intensity", intensity, positive=True)
    tried = np.ones_like(at) if trials is None else _row("trials", trials)
    failed = _row("failures", failures)
    for name, row in (("trials", tried), ("failures", failed)):
        if len(row) != len(at):
            raise InputError(
                name,
                Words(f"has {len(row)} values"),
                f"it must have one for each of the {len(at)} intensities",
                "give rows of one length",
            )
    if (failed > tried).any():
        place = int(np.argmax(failed > tried))
        raise InputError(
            f"failures[{place}]",
            int(failed[place]),
            f"it must not be above trials[{place}] = {int(tried[place])}",
            "give how many of them",
        )
    some = tried > 0.0
    if not some.any():
        raise InputError(
            "trials",
            Words("has no trial"),
            "there must be one or more",
            "give the number of runs",
        )
    distinct, place_of = np.unique(at[some], return_inverse=True)
    first = np.append(True, distinct[1:] * (1.0 - SAME_LEVEL) > distinct[:-1])
    level = (np.cumsum(first) - 1)[place_of]
    sums = np.zeros((2, int(first.sum())))
    for row, counts in zip(sums, (failed, tried), strict=True):
        np.add.at(row, level, counts[some])
    return Totals(distinct[first], *sums)


def _row(name: str, given: ArrayLike, *, positive: bool = False) -> Floats:
    """Return a row of numbers, or raise with the place of the first that is not valid."""
    array = np.asarray(given, dtype=np.float64)
    if array.ndim != 1 or array.size == 0:
        problem = Words(f"has the shape {array.shape}")
        raise InputError(name, problem, "it must be a row of numbers", "give one for each trial")
    bad = ~np.isfinite(array)
    valid = "it must be finite and above 0" if positive else "it must be a whole number from 0"
    bad |= array <= 0.0 if positive else (array < 0.0) | (np.where(bad, 0.0, array) % 1.0 != 0.0)
    if bad.any():
        place = int(np.argmax(bad))
        hint = "leave such trials out" if positive else "give a count"
        raise InputError(f"{name}[{place}]", float(array[place]), valid, hint)
    return array
