"""One release of a block into free rocking: the peaks that were measured."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import nonempty_text
from rocksteady.model.checks.validation import in_range, side_value

MOST_PEAKS = 100_000


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class Release:
    """One release of a block into free rocking on a still base.

    Parameters
    ----------
    peaks_rad
        Largest abs(theta) of successive half cycles [rad], shape (peaks,); two or more.
    sides
        Side of each peak, 1 (positive) or -1; by default they alternate, the first positive.  One
        number for all: the peaks of one side, two impacts apart.  Two peaks of one side in a row
        are two impacts apart.
    sigma_rad
        Measuring error as a standard deviation [rad], for all or for each peak; by default it is
        estimated.
    times_s
        Time of each peak [s], for a comparison of half periods; none by default.
    name
        Name of the test; default "release".

    Raises
    ------
    InputError
        If there are fewer than two peaks, a peak is not in (0, pi/2), an error is negative, the
        times do not rise, or the lengths differ.

    Examples
    --------
    >>> Release(peaks_rad=[0.08, 0.06, 0.05]).sides.tolist()
    [1, -1, 1]
    """

    peaks_rad: ArrayLike
    sides: Sequence[int] | int | None = None
    sigma_rad: ArrayLike | None = None
    times_s: ArrayLike | None = None
    name: Annotated[str, nonempty_text] = "release"

    def __post_init__(self) -> None:
        """Validate."""
        peaks = real_array("peaks_rad", self.peaks_rad)
        if peaks.ndim != 1 or not 2 <= peaks.size <= MOST_PEAKS:
            raise InputError(
                "peaks_rad",
                Words(f"of {self.name} have shape {peaks.shape}"),
                f"an impact needs the peaks before and after it, and {MOST_PEAKS} are the most",
                "give the peaks of successive half cycles in a list",
            )
        hint = "give abs(theta) of each half cycle in radians: 1 degree is 0.01745"
        for peak in peaks.tolist():
            in_range("peaks_rad", peak, 0.0, 0.5 * math.pi, "()", hint=hint)
        values: dict[str, NDArray[Any]] = {
            "peaks_rad": peaks.copy(),
            "sides": self._sides(peaks.size),
        }
        if self.sigma_rad is not None:
            sigma = real_array("sigma_rad", self.sigma_rad)
            hint = "give the standard deviation of the measured angles in radians"
            for value in sigma.ravel().tolist():
                in_range("sigma_rad", value, 0.0, 0.5 * math.pi, "[)", hint=hint)
            values["sigma_rad"] = self._fitting("sigma_rad", sigma, peaks.size, or_one=True)
        if self.times_s is not None:
            times = real_array("times_s", self.times_s)
            values["times_s"] = self._fitting("times_s", times, peaks.size)
            if not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
                raise InputError(
                    "times_s",
                    Words(f"of {self.name} do not rise"),
                    "each peak comes after the one before it",
                    "give the time of each peak in seconds",
                )
        for key, array in values.items():
            array.flags.writeable = False
            object.__setattr__(self, key, array)

    def _sides(self, count: int) -> NDArray[np.int64]:
        """Return the side of each peak."""
        given = self.sides
        if given is None:
            return np.where(np.arange(count) % 2 == 0, 1, -1)
        if not isinstance(given, list | tuple | np.ndarray) or np.ndim(given) == 0:
            return np.full(count, side_value("sides", given))
        sides = np.array([side_value("sides", side) for side in given])
        return self._fitting("sides", sides, count)

    def _fitting(
        self, key: str, values: NDArray[Any], count: int, *, or_one: bool = False
    ) -> NDArray[Any]:
        """Return one value for each peak."""
        if or_one and values.ndim == 0:
            values = np.full(count, values.item())
        if values.shape != (count,):
            raise InputError(
                key,
                Words(f"of {self.name} has shape {values.shape}"),
                f"there are {count} peaks",
                "give one value for each peak" + (", or one for all" if or_one else ""),
            )
        return values.copy()
