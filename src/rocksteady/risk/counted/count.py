"""Runs at one level counted, record by record."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Integers
from rocksteady.model.checks.arrays import guard_result
from rocksteady.outcomes import Status
from rocksteady.risk.counted.band import mean_of, share_band

if TYPE_CHECKING:
    import xarray

ANSWERS = (Status.ROCKING, Status.AT_REST, Status.OVERTURNED)
"""Outcomes that say whether a block falls."""
DIMENSIONS = ("record", "block", "direction", "vertical", "draw", "level")


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Count:
    """Runs of some records at one level.

    Attributes
    ----------
    fell, answered
        How many runs of each record reach a state, as a fall, and how many have an answer, shape
        (records,).
    ways
        Runs of each record.
    """

    fell: Integers
    answered: Integers
    ways: int

    @property
    def records(self) -> int:
        """How many records have an answer."""
        return int((self.answered > 0).sum())

    @property
    def runs(self) -> int:
        """How many runs have an answer."""
        return int(self.answered.sum())

    @property
    def falls(self) -> int:
        """How many runs reach the state."""
        return int(self.fell.sum())

    @property
    def without(self) -> int:
        """How many runs have no answer."""
        return self.ways * len(self.fell) - self.runs

    @property
    def share(self) -> float:
        """Mean of the records' shares; nan without a record."""
        return mean_of(self._shares) if self.records else float("nan")

    @cached_property
    def band(self) -> tuple[float, float]:
        """The 90 % interval of the share; from 0 to 1 without a record."""
        return share_band(self._shares, self.ways) if self.records else (0.0, 1.0)

    @property
    def _shares(self) -> NDArray[np.float64]:
        """Share of each record with an answer."""
        some = self.answered > 0
        shares: NDArray[np.float64] = self.fell[some] / self.answered[some]
        return shares

    def among(self, kept: NDArray[np.bool_]) -> "Count":
        """Return the runs of some records alone."""
        return Count(fell=self.fell[kept], answered=self.answered[kept], ways=self.ways)

    def if_they_fell(self, *, fell: bool) -> "Count":
        """Return the count if all runs without an answer had fallen, or all had stood."""
        whole = np.full_like(self.answered, self.ways)
        more = self.fell + (whole - self.answered) * fell
        return Count(fell=more, answered=whole, ways=self.ways)


def outcomes_of(
    ensemble: "xarray.Dataset",
) -> tuple[NDArray[np.int8], NDArray[np.float64], NDArray[np.bool_]]:
    """Return status, peak and which runs have an answer, over records, runs of each, and levels.

    Returns
    -------
    tuple of ndarray, shape (records, ways, levels)
    """
    runs = without_mirrors(ensemble)[["status", "peak_angle"]].transpose(*DIMENSIONS)
    status = runs["status"].values
    shape = (status.shape[0], -1, status.shape[-1])
    flat = status.reshape(shape)
    return flat, runs["peak_angle"].values.reshape(shape), np.isin(flat, ANSWERS)


def without_mirrors(ensemble: "xarray.Dataset") -> "xarray.Dataset":
    """Return an ensemble without mirror images: of symmetric blocks one direction counts."""
    if {"negative_alpha", "one_sided"} & set(ensemble.coords):
        return ensemble
    return ensemble.isel(direction=slice(0, 1))


def count_falls(ensemble: "xarray.Dataset") -> list[Count]:
    """Return how many runs of an ensemble fall, at each of its levels."""
    status, _, answered = outcomes_of(ensemble)
    return counts_of(status == int(Status.OVERTURNED), answered)


def counts_of(reached: NDArray[np.bool_], answered: NDArray[np.bool_]) -> list[Count]:
    """Return the count at each level of runs that reach a state, shape (records, ways, levels)."""
    fell = (reached & answered).sum(axis=1, dtype=np.int64)
    tried = answered.sum(axis=1, dtype=np.int64)
    return [
        Count(fell=fell[:, place], answered=tried[:, place], ways=answered.shape[1])
        for place in range(answered.shape[2])
    ]
