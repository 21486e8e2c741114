"""Elastic acceleration spectrum of NTC 2018 at the ground (3.2.3.2.1)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Final, Literal

from rocksteady.errors import ModelError, Words
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds

Soil = Literal["A", "B", "C", "D", "E"]
Topography = Literal["T1", "T2", "T3", "T4"]

SOIL_FACTORS: Final[Mapping[str, tuple[float, float, float, float]]] = {
    "A": (1.0, 1.0, 0.0, 1.0),
    "B": (1.0, 1.4, 0.4, 1.2),
    "C": (1.0, 1.7, 0.6, 1.5),
    "D": (0.9, 2.4, 1.5, 1.8),
    "E": (1.0, 2.0, 1.1, 1.6),
}
"""Of S_S, min <= top - slope F0 a_g/g <= max: min, top, slope, max (NTC 2018 Table 3.2.IV)."""
SOIL_PERIODS: Final[Mapping[str, tuple[float, float]]] = {
    "A": (1.0, 0.0),
    "B": (1.1, -0.2),
    "C": (1.05, -0.33),
    "D": (1.25, -0.5),
    "E": (1.15, -0.4),
}
"""Of C_C = factor TC*^power: factor, power (NTC 2018 Table 3.2.IV)."""
TOPOGRAPHY_FACTORS: Final[Mapping[str, float]] = {"T1": 1.0, "T2": 1.2, "T3": 1.2, "T4": 1.4}
"""S_T at the top of the slope (NTC 2018 Table 3.2.V)."""

LONGEST_NTC_S: Final = 4.0
"""Period to which NTC 2018 gives its spectrum [s]."""
LONGEST_S: Final = 60.0
"""Longest period that is answered [s]."""

PERIOD: Final = Bounds(0.0, LONGEST_S, "[]", "give a period in seconds, as 1.9")
DAMPING: Final = Bounds(0.0, 1.0, "()", "give it over the critical one: 0.08 for 8 %")

LIMITS: Final = {
    "ag_g": Bounds(0.001, 1.0, "[]", "give a_g in g, as 0.2: divide m/s^2 by 9.81"),
    "f0": Bounds(1.5, 5.0, "[]", "give F0 of the site, as 2.5"),
    "tc_star_s": Bounds(0.05, 1.0, "[]", "give TC* of the site in seconds, as 0.35"),
    "soil_factor": Bounds(0.5, 4.0, "[]", "give S_S, as 1.2"),
    "cc": Bounds(0.5, 4.0, "[]", "give C_C, as 1.4"),
    "topography": Bounds(1.0, 2.0, "[]", "give T1, T2, T3 or T4, or S_T as a number, as 1.2"),
}


@checked
@dataclass(frozen=True, kw_only=True)
class ElasticSpectrum:
    """Horizontal elastic spectrum of NTC 2018 of a site and a limit state.

    With ``S = S_S S_T``, ``TC = C_C TC*``, ``TB = TC/3`` and ``TD = 4 a_g/g + 1.6 s``::

        S_e = a_g S eta F0 [T/TB + (1 - T/TB)/(eta F0)]   to TB
        S_e = a_g S eta F0   to TC,   times TC/T to TD,   times TC TD/T^2 beyond

    and ``eta = sqrt(10/(5 + xi)) >= 0.55``, xi in per cent.

    Parameters
    ----------
    ag_g
        Peak acceleration on rock a_g [g].
    f0
        Largest amplification F0.
    tc_star_s
        TC*, where the constant velocity begins on rock [s].
    soil
        Category of the ground, "A" to "E"; None (default) with `soil_factor` and `cc`.
    topography
        Category "T1" (default), "T2", "T3" or "T4" at the top of a slope, or S_T as a number.
    soil_factor, cc
        S_S and C_C as numbers in place of the category; default None.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If the ground is given twice or not at all, or TC is not below TD.

    References
    ----------
    Norme tecniche per le costruzioni 2018, 3.2.3.2.1, Tables 3.2.IV and 3.2.V.

    Examples
    --------
    >>> rock = ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.3, soil="A")
    >>> print(f"{rock.sa_g(0.0, 0.05):.3f} {rock.sa_g(0.2, 0.05):.3f} {rock.sa_g(1.0, 0.05):.3f}")
    0.200 0.500 0.150
    """

    ag_g: Annotated[float, LIMITS["ag_g"]]
    f0: Annotated[float, LIMITS["f0"]]
    tc_star_s: Annotated[float, LIMITS["tc_star_s"]]
    soil: Soil | None = None
    topography: Topography | float = "T1"
    soil_factor: float | None = None
    cc: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        for key in ("soil_factor", "cc"):
            value = getattr(self, key)
            if value is not None:
                object.__setattr__(self, key, LIMITS[key](key, value))
        if not (isinstance(self.topography, str) and self.topography in TOPOGRAPHY_FACTORS):
            factor = LIMITS["topography"]("topography", self.topography)
            object.__setattr__(self, "topography", factor)
        self._check_ground()
        if self.tc_s >= self.td_s:
            raise ModelError(
                "tc_star_s",
                self.tc_star_s,
                f"TC = C_C TC* = {self.tc_s:.3g} s must be below TD = {self.td_s:.3g} s",
                "check TC* and C_C",
            )

    def _check_ground(self) -> None:
        """Refuse a ground that is given twice, in part or not at all."""
        numbers = [key for key in ("soil_factor", "cc") if getattr(self, key) is not None]
        if self.soil is not None and numbers:
            raise ModelError(
                "soil",
                Words(f"and {numbers[0]} are both given"),
                "the ground is a category, or soil_factor and cc",
                f"leave soil or {' and '.join(numbers)} out",
            )
        if self.soil is None and len(numbers) < 2:
            raise ModelError(
                "soil",
                Words("is missing" if not numbers else f"is missing beside {numbers[0]} alone"),
                "the ground is a category from A to E, or soil_factor and cc",
                "give soil, as 'B'",
            )

    @property
    def ss(self) -> float:
        """Factor of the soil S_S."""
        if self.soil_factor is not None:
            return self.soil_factor
        assert self.soil is not None
        low, top, slope, high = SOIL_FACTORS[self.soil]
        return min(max(top - slope * self.f0 * self.ag_g, low), high)

    @property
    def st(self) -> float:
        """Factor of the topography S_T."""
        if isinstance(self.topography, str):
            return TOPOGRAPHY_FACTORS[self.topography]
        return self.topography

    @property
    def peak_g(self) -> float:
        """Peak acceleration of the ground a_g S_S S_T [g]."""
        return self.ag_g * self.ss * self.st

    @property
    def tc_s(self) -> float:
        """Period TC where the constant velocity begins [s]."""
        if self.cc is not None:
            return self.cc * self.tc_star_s
        assert self.soil is not None
        factor, power = SOIL_PERIODS[self.soil]
        return factor * float(exp((1.0 + power) * log(self.tc_star_s)))

    @property
    def td_s(self) -> float:
        """Period TD where the constant displacement begins [s]."""
        return 4.0 * self.ag_g + 1.6

    def sa_g(self, period_s: float, damping: float) -> float:
        """Return the spectral acceleration S_e [g] at a period.

        Parameters
        ----------
        period_s
            T [s], from 0 to 60; NTC 2018 gives its spectrum to 4 s.
        damping
            1 being critical, in (0, 1), as 0.08.

        Raises
        ------
        InputError
            If a number is outside its range.
        """
        t, xi = PERIOD("period_s", period_s), DAMPING("damping", damping)
        eta = damping_factor(xi)
        tc, td = self.tc_s, self.td_s
        plateau = self.peak_g * eta * self.f0
        rise = 3.0 * t / tc
        if rise < 1.0:
            return plateau * (rise + (1.0 - rise) / (eta * self.f0))
        if t <= tc:
            return plateau
        return plateau * tc / t if t <= td else plateau * tc * td / (t * t)

    def displacement_m(self, period_s: float, damping: float) -> float:
        """Return the demand of displacement S_e T^2/(4 pi^2) [m] (C8.7.1.12).

        Parameters and errors are those of `sa_g`.
        """
        return displacement_of(self.sa_g(period_s, damping), period_s)


def displacement_of(sa_g: float, period_s: float) -> float:
    """Return the displacement [m] of a spectral acceleration [g] at a period [s]."""
    rate = 2.0 * math.pi
    return sa_g * STANDARD_GRAVITY * period_s * period_s / (rate * rate)


def damping_factor(damping: float) -> float:
    """Return eta = sqrt(10/(5 + xi)), xi in per cent, at least 0.55 (EN 1998-1:2004 eq. 3.6).

    Examples
    --------
    >>> print(f"{damping_factor(0.05)} {damping_factor(0.02):.4f} {damping_factor(0.5)}")
    1.0 1.1952 0.55
    """
    return max(0.55, math.sqrt(10.0 / (5.0 + 100.0 * damping)))
