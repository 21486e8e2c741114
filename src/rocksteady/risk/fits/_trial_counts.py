"""Observations as a likelihood needs them: counts by distinct intensity and by record."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.validation import span_value

if TYPE_CHECKING:
    from scipy.sparse import csr_array

SAME_LEVEL = 1e-12
"""Relative difference of intensities that rounding makes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Counts:
    """Failures and trials of one curve.

    Attributes
    ----------
    levels
        Distinct intensities with trials, ascending; shape (l,).
    failures, trials
        By cluster and level, sparse; shape (c, l).
    multiplicity
        Number of times that a cluster is in the suite, shape (c,): 1 for a record.
    """

    levels: Floats
    failures: "csr_array"
    trials: "csr_array"
    multiplicity: Floats

    @property
    def totals(self) -> tuple[Floats, Floats]:
        """Failures and trials by level."""
        return self.multiplicity @ self.failures, self.multiplicity @ self.trials

    @property
    def records(self) -> int:
        """Records that have trials."""
        present = self.trials.sum(axis=1) > 0.0
        return int(self.multiplicity[present].sum())


def values_of(name: str, given: ArrayLike, *, positive: bool = False) -> Floats:
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


def counts_of(
    intensity: Floats,
    given: Sequence[tuple[str, ArrayLike | None]],
    groups: ArrayLike | Sequence[str] | None,
    within: tuple[float, float] | None = None,
) -> list[Counts]:
    """Return the counts of each stage.

    Parameters
    ----------
    intensity
        Intensity of each observation, shape (n,).
    given
        Name and counts of what contains the next: trials, then (uplifted, then) failures; trials
        without counts are 1 each.
    groups
        Record of each observation; without, each trial is a record of its own.
    within
        Lowest and highest intensity that enter.

    Returns
    -------
    list of Counts
        Counts of each stage within the stage before it, over the same clusters.
    """
    nested = [
        np.ones_like(intensity) if counts is None else values_of(name, counts)
        for name, counts in given
    ]
    for (name, _), counts in zip(given, nested, strict=True):
        same_length(name, len(counts), len(intensity))
    for outer, inner in itertools.pairwise(range(len(nested))):
        more = nested[inner] > nested[outer]
        if more.any():
            place = int(np.argmax(more))
            raise InputError(
                f"{given[inner][0]}[{place}]",
                int(nested[inner][place]),
                f"it must not be above {given[outer][0]}[{place}] = {int(nested[outer][place])}",
                "give how many of them",
            )
    names = None if groups is None else _names(groups, len(intensity))
    inside = nested[0] > 0.0
    if within is not None:
        low, high = span_value("within", within, 0.0, np.inf, hint="give (lowest, highest)")
        inside &= (intensity >= low) & (intensity <= high)
    if not inside.any():
        problem = Words("has no trial" if within is None else "has no trial within the limits")
        raise InputError("trials", problem, "there must be one or more", "give the number of runs")
    intensity, nested = intensity[inside], [counts[inside] for counts in nested]
    levels, level = _levels(intensity)
    if names is None:
        cells, multiplicity = _cells(level, nested, len(levels))
    else:
        cells, multiplicity = _by_group(level, nested, len(levels), names[inside])
    return [
        _stage(levels, outer, inner, multiplicity) for outer, inner in itertools.pairwise(cells)
    ]


def _levels(intensity: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """Return distinct intensities and the place of each observation among them.

    A stripe that was reached by scaling each record differs by rounding from record to record.
    """
    distinct, place = np.unique(intensity, return_inverse=True)
    first = np.append(True, distinct[1:] * (1.0 - SAME_LEVEL) > distinct[:-1])
    return distinct[first], (np.cumsum(first) - 1)[place]


def same_length(name: str, length: int, needed: int) -> None:
    """Refuse a row that has not one value for each intensity."""
    if length != needed:
        raise InputError(
            name,
            Words(f"has {length} values"),
            f"it must have one for each of the {needed} intensities",
            "give rows of one length",
        )


def _names(groups: ArrayLike | Sequence[str], needed: int) -> NDArray[Any]:
    """Return the record of each observation."""
    names: NDArray[Any] = np.asarray(groups)
    if names.ndim != 1:
        problem = Words(f"has the shape {names.shape}")
        raise InputError("groups", problem, "it must be a row", "give the record of each intensity")
    same_length("groups", len(names), needed)
    if names.dtype.kind == "f" and not np.isfinite(names).all():
        place = int(np.argmax(~np.isfinite(names)))
        raise InputError(
            f"groups[{place}]", float(names[place]), "it must be finite", "number the records"
        )
    return names


def _by_group(
    level: NDArray[np.intp], nested: list[Floats], width: int, names: NDArray[Any]
) -> tuple[list["csr_array"], Floats]:
    """Return each count by record and level."""
    from scipy.sparse import coo_array

    known, code = np.unique(names, return_inverse=True)
    shape = (len(known), width)
    cells = [coo_array((counts, (code, level)), shape=shape).tocsr() for counts in nested]
    return cells, np.ones(len(known))


def _cells(
    level: NDArray[np.intp], nested: list[Floats], width: int
) -> tuple[list["csr_array"], Floats]:
    """Return clusters of one trial each: one for each level and outcome, as often as it occurs."""
    from scipy.sparse import coo_array

    sums = [np.bincount(level, weights=counts, minlength=width) for counts in nested]
    alone = [outer - inner for outer, inner in zip(sums, [*sums[1:], 0.0 * sums[0]], strict=True)]
    places = [np.flatnonzero(counts) for counts in alone]
    first = np.cumsum([0, *(len(place) for place in places)])
    cells = []
    for depth in range(len(nested)):
        column = np.concatenate(places[depth:])
        row = np.arange(first[depth], first[-1])
        shape = (int(first[-1]), width)
        cells.append(coo_array((np.ones(len(row)), (row, column)), shape=shape).tocsr())
    return cells, np.concatenate([c[p] for c, p in zip(alone, places, strict=True)])


def _stage(levels: Floats, trials: "csr_array", inner: "csr_array", weight: Floats) -> Counts:
    """Return one stage without the levels that have no trial."""
    tried = np.flatnonzero(weight @ trials > 0.0)
    return Counts(
        levels=levels[tried],
        failures=inner[:, tried],
        trials=trials[:, tried],
        multiplicity=weight,
    )
