"""Motions of the ground as a demand wants them: each with its peaks, led to a floor."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import guard_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number, quantity
from rocksteady.risk.counted.motions import (
    Motion,
    across,
    changed,
    has_vertical,
    with_vertical_peak,
)
from rocksteady.risk.counted.placing import Placing, fit_stretches, shapes_of
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum, make_design_spectrum
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.seismic.spectra.grounds import grounds_of

PGA: Final = Measure("pga_g")
PGV: Final = Measure("pgv_m_s")
MIDDLE: Final = (0.1, 0.9)
"""Quantiles of the peak that is not given, between which its range is stated."""


@checked
@dataclass(frozen=True, kw_only=True)
class Peaks:
    """Peaks of the ground that are asked about.

    Parameters
    ----------
    pga_g, pgv_m_s
        Peak acceleration [g] and velocity [m/s], in (0, 10]; None of one that is not given.

    Raises
    ------
    InputError
        If there is none, or one is outside its range.

    Examples
    --------
    >>> Peaks(pga_g=0.4, pgv_m_s=0.45).words
    '0.4 g and 0.45 m/s'
    """

    pga_g: Annotated[float | None, Bounds(0.0, 10.0, "(]", "give the peak in g; 0.3 is usual")] = (
        None
    )
    pgv_m_s: Annotated[
        float | None, Bounds(0.0, 10.0, "(]", "give the peak in m/s; 0.4 is usual")
    ] = None

    def __post_init__(self) -> None:
        """Refuse no peak at all."""
        if self.pga_g is None and self.pgv_m_s is None:
            raise InputError(
                "pga_g, pgv_m_s", Words("are both missing"), "a demand has one peak or both",
                "give the PGA, the PGV or both",
            )  # fmt: skip

    @property
    def words(self) -> str:
        """The same, as "0.40 g and 0.45 m/s"."""
        pairs = ((self.pga_g, "g"), (self.pgv_m_s, "m/s"))
        return " and ".join(quantity(value, unit) for value, unit in pairs if value is not None)

    @property
    def where(self) -> str:
        """The same after a verb, as "at 0.40 g"."""
        return f"at {self.words}"

    @property
    def kept(self) -> str:
        """What is the same at all multiples of it; empty of one peak."""
        if self.pga_g is None or self.pgv_m_s is None:
            return ""
        return f"PGV over PGA is kept at {number(self.pgv_m_s / self.pga_g)} m/s per g"


Demanded = Peaks | DesignSpectrum
"""What motions are to have."""


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Suite:
    """Motions of the ground, each once.

    Attributes
    ----------
    motions
        Records, or motions of two components.
    built_in
        Whether no earthquake made them.
    copies
        How many more were given, with the samples of another.
    """

    motions: Sequence[Motion]
    built_in: bool = False
    copies: int = 0

    @cached_property
    def peaks(self) -> tuple[Floats, Floats]:
        """PGA [g] and PGV [m/s] of the motions as they are, shape (motions,) each."""
        pga, pgv = (
            np.array([compute_measure(across(each).reference, peak) for each in self.motions])
            for peak in (PGA, PGV)
        )
        return pga, pgv

    @cached_property
    def shapes(self) -> Floats:
        """Spectra of the motions over their PGA, as `shapes_of` returns them."""
        return shapes_of(self.motions)

    def at(
        self,
        demand: Demanded,
        *,
        floor: Floor | None = None,
        vertical_g: float = 0.0,
        stretch: bool = True,
    ) -> "Shaking":
        """Return the motions as a demand wants them, where an object stands.

        Of both peaks, or of a design spectrum, accelerations are multiplied and the time axis is
        stretched: every motion has both peaks, or the PGA and the spectrum as nearly as it can.  Of
        one peak accelerations alone are multiplied to it.

        Parameters
        ----------
        demand
            Peaks or a design spectrum.
        floor
            Floor that the motions reach the object through; None of the ground.
        vertical_g
            Peak of the vertical components [g], whose motions alone are then taken; by default they
            have the factors of the horizontal ones.
        stretch
            Whether time is stretched; else motions are scaled to the PGA, and keep their own PGV.

        Raises
        ------
        InputError
            If a motion that is to be stretched is that of a floor already.
        """
        kept = [n for n, each in enumerate(self.motions) if has_vertical(each) or not vertical_g]
        motions, (pga, pgv) = [self.motions[n] for n in kept], (peak[kept] for peak in self.peaks)
        stretches, beside, placing = np.ones(len(pga)), None, None
        stretched = isinstance(demand, DesignSpectrum) or (stretch and bool(demand.kept))
        measure, value = (PGV, demand.pgv_m_s) if demand.pga_g is None else (PGA, demand.pga_g)
        assert value is not None
        levels, others = (pga, pgv) if measure is PGA else (pgv, pga)
        scales = value / levels
        felt = any(across(each).ground is not None for each in motions)
        if felt and (stretched or floor is not None):
            raise InputError(
                "motions",
                Words("are those of a floor"),
                "motions of the ground are stretched in time, and reach a floor then",
                "give motions of the ground and the floor beside them, or one peak alone",
            )
        if isinstance(demand, DesignSpectrum):
            shapes = self.shapes[kept]
            stretches, misfits = fit_stretches(shapes, demand)
            placing = Placing(
                spectrum=demand,
                shapes=shapes,
                stretches=stretches,
                misfits=misfits,
                pgv_m_s=pgv * scales * stretches,
            )
        elif stretched:
            stretches = np.asarray((demand.pgv_m_s or 0.0) / pgv / scales)
        else:
            low, high = np.quantile(scales * others, MIDDLE).tolist()
            beside = (PGV if measure is PGA else PGA, low, high)
        if stretched:
            pairs = zip(motions, scales.tolist(), stretches.tolist(), strict=True)
            motions = [changed(each, *factors) for each, *factors in pairs]
        if vertical_g:
            left = np.ones(len(pga)) if stretched else scales
            motions = [
                with_vertical_peak(each, vertical_g / x)
                for each, x in zip(motions, left, strict=True)
            ]
        if floor is not None:
            motions = [floor.motion(each) for each in motions]
        return Shaking(
            motions=motions,
            measure=measure,
            level=value,
            scales=scales,
            stretches=stretches,
            other=beside,
            stretched=stretched,
            demand=demand,
            placing=placing,
        )


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Shaking:
    """Motions where an object stands, whose level is the demand.

    Attributes
    ----------
    motions
        As an ensemble takes them; stretched ones have the peaks of the demand as they are.
    measure, level
        Measure of the ground that the motions are scaled by, and its value at the demand.
    scales, stretches
        Factors of accelerations and of time that give the recorded motions the demand's peaks,
        shape (motions,).
    other
        The peak that is not matched, with the 10 and the 90 % quantile over the motions at the
        demand; None where both are.
    stretched
        Whether the factors are in the motions: both peaks are matched, or a spectrum is.
    demand
        The demand.
    placing
        How the motions lie on a design spectrum; None of peaks.
    """

    motions: Sequence[Motion]
    measure: Measure
    level: float
    scales: Floats
    stretches: Floats
    other: tuple[Measure, float, float] | None
    stretched: bool
    demand: Demanded
    placing: Placing | None = None

    @cached_property
    def floor_pga_g(self) -> Floats:
        """Peak acceleration of each motion at the demand where the object stands [g]."""
        factors = np.ones(len(self.scales)) if self.stretched else self.scales
        peaks = [compute_measure(across(each), PGA) for each in self.motions]
        return np.asarray(factors * np.array(peaks))

    @cached_property
    def amplified(self) -> tuple[float, float]:
        """By how much a floor multiplies PGA and PGV, the largest of the motions; 1 without one."""
        pga, pgv = (
            max(
                compute_measure(across(each), peak) / compute_measure(across(each).reference, peak)
                for each in self.motions
            )
            for peak in (PGA, PGV)
        )
        return float(pga), float(pgv)

    @property
    def is_lifted(self) -> bool:
        """Whether a motion has a vertical component."""
        return any(map(has_vertical, self.motions))

    @property
    def ways(self) -> Ways:
        """How an ensemble runs the motions: with the verticals that they have."""
        return Ways(vertical=True if self.is_lifted else "both")


@checked
def place_on_spectrum(motions: Sequence[Record | BaseMotion], spectrum: Any) -> Shaking:
    """Place motions on a design spectrum.

    Each is scaled to the peak acceleration of the spectrum, and stretched in time until its own 5 %
    spectrum lies there: least squares of ln Sa over ln T from 0.2 to 4 s.  Nothing is added to it.

    Parameters
    ----------
    motions
        Records of the ground, with a vertical one beside them as `BaseMotion`; one or more.
    spectrum
        A `DesignSpectrum`, or what `make_design_spectrum` takes: a file, a formula, rows.

    Returns
    -------
    Shaking
        Its ``motions`` as placed, their ``scales`` and ``stretches``, and ``placing`` with the
        ``misfits`` and ``pgv_m_s``.

    Raises
    ------
    InputError
        If there is no motion, one is that of a floor, or as for `make_design_spectrum`.

    Examples
    --------
    >>> from rocksteady.motions import make_synthetic_suite, place_on_spectrum
    >>> suite = make_synthetic_suite(3)
    >>> placed = place_on_spectrum(suite, "en1998-1:2004:type1:C:ag=0.25")
    >>> [f"{each.peak_acceleration_m_s2 / 9.80665:.3f}" for each in placed.motions]
    ['0.287', '0.287', '0.287']
    """
    if not motions:
        raise InputError("motions", motions, "there must be one or more", "give records")
    grounds_of(list(motions))  # refused where one is no record
    return Suite(motions=motions).at(make_design_spectrum(spectrum))
