"""Hazard curves: the annual rate at which shaking exceeds each level of an intensity measure."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import in_range
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.hazard.hazard_measures import ground_measure
from rocksteady.seismic.measures.scalar import Measure

LOWEST, HIGHEST = 1e-100, 1e100
"""Of levels and rates: their logarithms and powers are numbers."""


def _row(name: str, values: ArrayLike) -> Floats:
    """Return positive numbers, two or more, as an array that cannot be changed."""
    row = np.array(real_array(name, values))
    if row.ndim != 1 or row.size < 2:
        raise InputError(name, row.shape, "there must be a row of two or more", "give more points")
    bad = ~((row >= LOWEST) & (row <= HIGHEST))
    if bad.any():
        raise InputError(
            name,
            row[bad][0].item(),
            f"it must lie in [{LOWEST:g}, {HIGHEST:g}]",
            "leave out levels and rates of 0",
        )
    row.setflags(write=False)
    return row


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class HazardCurve(Result):
    """Annual rates at which shaking exceeds levels of an intensity measure.

    Between two levels the curve is straight in logarithms of both.  Beyond them it is unknown.

    Parameters
    ----------
    measure
        An `Measure` of the ground, or its text: ``"pga_g"``, ``"pgv_m_s"``, ``"sa_g:1.0"`` with
        a period in seconds, ``"sa_avg_g:1.0"``.
    levels
        Levels of the measure, ascending, in units of 9.80665 m/s^2 or in m/s, shape (levels,).
    rates
        Annual rate of exceedance of each [1/year], nowhere rising, above 0.
    name
        Name of the quantile or of the branch of the logic tree; none by default.
    weight
        Weight of the branch, in (0, 1]; none by default.
    site
        Longitude and latitude [degrees]; none by default.
    remarks
        What was left out when the curve was read.

    Raises
    ------
    InputError
        If there are fewer than two levels, they do not rise, a rate is not positive, or rates rise.

    Examples
    --------
    >>> curve = HazardCurve(measure="pga_g", levels=[0.1, 0.4], rates=[0.01, 0.000625])
    >>> curve
    <HazardCurve: Hazard of PGA from 0.1 to 0.4 g: 0.01 to 0.000625 a year>
    >>> float(curve.rate(0.2).round(6))
    0.0025
    """

    measure: Annotated[Measure | str, ground_measure]
    levels: Annotated[Floats, _row]
    rates: Annotated[Floats, _row]
    name: str = ""
    weight: Annotated[
        float | None,
        Bounds(0.0, 1.0, "(]", "give the branch's weight"),
        Label("Weight of the branch", optional=True),
    ] = None
    site: Annotated[tuple[float, float] | None, Label("Longitude, latitude [°]", optional=True)] = (
        None
    )
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Validate and copy."""
        levels, rates = self.levels, self.rates
        if levels.size != rates.size:
            raise InputError(
                "rates",
                rates.size,
                f"there must be one for each of {levels.size} levels",
                "give as many rates as levels",
            )
        at = np.flatnonzero(np.diff(levels) <= 0.0)
        if at.size:
            raise InputError(
                "levels",
                levels[at[0] + 1].item(),
                f"it follows {levels[at[0]]:g}, and levels must rise",
                "sort the levels, and give each once",
            )
        at = np.flatnonzero(np.diff(rates) > 0.0)
        if at.size:
            raise InputError(
                "rates",
                rates[at[0] + 1].item(),
                f"it is more than the rate {rates[at[0]]:g} of the level below it",
                "give rates of exceedance, which never rise with the level",
            )
        if self.site is not None:
            lon, lat = self.site
            hint = "give longitude and latitude in degrees"
            place = in_range("site", lon, -360.0, 360.0, "[]", hint=hint)
            object.__setattr__(
                self, "site", (place, in_range("site", lat, -90.0, 90.0, "[]", hint=hint))
            )

    @property
    def intensity(self) -> Measure:
        """The measure."""
        return ground_measure("measure", self.measure)

    @property
    def label(self) -> str:
        """Words of the measure, as ``Sa(0.5 s)``."""
        return self.intensity.label

    @property
    def unit(self) -> str:
        """Unit of the levels."""
        return self.intensity.unit

    @property
    def slopes(self) -> Floats:
        """Exponent k of the power law of each stretch between two levels, shape (levels - 1,)."""
        slopes: Floats = -np.diff(np.log(self.rates)) / np.diff(np.log(self.levels))
        return slopes

    @checked
    def rate(self, level: ArrayLike) -> Floats:
        """Return the annual rate of exceedance of levels [1/year], of their shape.

        Raises
        ------
        InputError
            If a level is outside the curve.
        """
        wanted = real_array("level", level)
        low, high = self.levels[0], self.levels[-1]
        bad = ~((wanted >= low) & (wanted <= high))
        if bad.any():
            raise InputError(
                "level",
                wanted[bad].flat[0].item(),
                f"the curve reaches from {low:g} to {high:g} {self.unit}",
                "stay inside",
            )
        rates: Floats = np.exp(np.interp(np.log(wanted), np.log(self.levels), np.log(self.rates)))
        return rates
