"""Demand on a block: peak acceleration and velocity, and a response spectrum."""

from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import compare_by_value
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number, quantity
from rocksteady.risk.spectra.tabulated import read_table, tabulated
from rocksteady.seismic.measures.response_spectrum import ResponseSpectrum
from rocksteady.seismic.measures.time_course import integrate_record

PGA = Bounds(0.0, LARGEST, "(]", "give the peak in g; 0.3 is usual")
PGV = Bounds(0.0, LARGEST, "(]", "give the peak in m/s; 0.4 is usual")
VERTICAL = {
    "vertical_g": Bounds(
        0.0, 10.0, "[]", "give the peak without a sign: the worse direction counts"
    ),
    "vertical_share": Bounds(
        0.0, 1.0, "[]", "give the share that acts at the horizontal peak, as 0.4"
    ),
}
SPECTRAL_RATIO = Bounds(0.0, 10.0, "[]", "give the ratio of the spectra, as 0.67")


@checked
@compare_by_value
@dataclass(frozen=True, kw_only=True)
class Demand:
    """Shaking at the base of a block, of the ground or of a floor.

    Parameters
    ----------
    pga_g
        Peak acceleration [g]; None (default) where it is not known.  Screens then take that of a
        spectrum's row at period 0.
    pgv_m_s
        Peak velocity [m/s]; None (default) where it is not known.
    spectrum
        Horizontal response spectrum: rows of period in s and spectral acceleration in g, shape
        (periods, 1 + dampings), or a file of such rows; a `ResponseSpectrum` or a `Record`, which
        is exact at any damping.  None by default.
    spectrum_damping
        Damping of the table, 1 being critical, or one for each of its columns.  Without, what a
        file states in a comment, as ``# 5 % damping``.
    sa_v_per_sa_h
        Ratio of vertical to horizontal spectral acceleration; None (default) for the ratio of the
        peaks, `vertical_g` over `pga_g`.
    vertical_g
        Peak vertical acceleration of the base [g], default 0.  A magnitude: its direction at the
        horizontal peak is not known, and the worse one, downwards, counts.
    vertical_share
        Share of it that acts at the horizontal peak, in [0, 1]; default 1, 0.4 by the 100-40-40
        rule of ASCE 4.

    Raises
    ------
    InputError
        If a number is outside its range, or the spectrum is no table.

    Examples
    --------
    >>> Demand(pga_g=0.35, pgv_m_s=0.4).pga_g
    0.35
    """

    pga_g: Annotated[float | None, PGA] = None
    pgv_m_s: Annotated[float | None, PGV] = None
    spectrum: Any = None
    spectrum_damping: Any = None
    sa_v_per_sa_h: Annotated[float | None, SPECTRAL_RATIO] = None
    vertical_g: Annotated[float, VERTICAL["vertical_g"]] = 0.0
    vertical_share: Annotated[float, VERTICAL["vertical_share"]] = 1.0

    def __post_init__(self) -> None:
        """Validate the spectrum, and read a file."""
        given = self.spectrum
        if isinstance(given, str | PathLike):
            table, damping = read_table(Path(given), self.spectrum_damping)
            object.__setattr__(self, "spectrum", table)
            object.__setattr__(self, "spectrum_damping", damping)
        if self._is_table:
            tabulated(self.spectrum, self.spectrum_damping, shown=given)
        elif self.spectrum_damping is not None:
            valid = "it is the damping of a table, and there is none"
            raise InputError("spectrum_damping", self.spectrum_damping, valid, "leave it out")

    @property
    def _is_table(self) -> bool:
        """Whether the spectrum is a table: neither missing nor that of a record."""
        return not isinstance(self.spectrum, ResponseSpectrum | Record | None)

    def with_peak(self) -> "Demand":
        """Return the demand with the PGA of its table at period 0, where none is given."""
        if self.pga_g is not None or not self._is_table:
            return self
        period, *values = self.spectrum[0]
        return replace(self, pga_g=float(max(values))) if period == 0.0 else self

    @classmethod
    def from_record(
        cls,
        record: Record,
        *,
        sa_v_per_sa_h: float | None = None,
        vertical_g: float = 0.0,
        vertical_share: float = 1.0,
    ) -> "Demand":
        """Return the demand of a record: its PGA, PGV and spectrum.

        Parameters
        ----------
        record
            The record, whose ground begins at rest.
        sa_v_per_sa_h, vertical_g, vertical_share
            As for the class.

        Raises
        ------
        InputError
            If the record is beyond 1e50 m/s^2.
        """
        course = integrate_record(record)
        return cls(
            pga_g=abs(course.peak_acceleration.value) / STANDARD_GRAVITY,
            pgv_m_s=abs(course.peak_velocity.value),
            spectrum=record,
            sa_v_per_sa_h=sa_v_per_sa_h,
            vertical_g=vertical_g,
            vertical_share=vertical_share,
        )

    @property
    def vertical_at_peak_g(self) -> float:
        """Vertical acceleration that acts at the horizontal peak [g], without a sign."""
        return self.vertical_share * self.vertical_g

    @property
    def spectral_ratio(self) -> float | None:
        """SA_V/SA_H, stated or of the peaks; None for a vertical peak without a horizontal one."""
        if self.sa_v_per_sa_h is not None or not self.vertical_g:
            return self.sa_v_per_sa_h or 0.0
        return None if self.pga_g is None else self.vertical_g / self.pga_g

    @property
    def vertical_words(self) -> str:
        """That acceleration in words; empty where there is none."""
        if not self.vertical_at_peak_g:
            return ""
        words = f"{quantity(self.vertical_at_peak_g, 'g')} of vertical motion downwards at the peak"
        if self.vertical_share == 1.0:
            return words
        return f"{words} ({number(self.vertical_share)} of {quantity(self.vertical_g, 'g')})"
