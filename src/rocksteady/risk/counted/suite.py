"""Motions of the ground as a demand wants them: each with its peaks, led to a floor."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import quantity
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.seismic.measures.scalar import Measure, compute_measure

Motion = Record | BaseMotion
PGA: Final = Measure("pga_g")
PGV: Final = Measure("pgv_m_s")
DIGITS: Final = 9
"""Decimals over the peak to which the samples of copies agree."""
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


@dataclass(frozen=True, kw_only=True, eq=False)
class Suite:
    """Motions of the ground, and the floor that they reach an object through.

    Attributes
    ----------
    motions
        Records, or motions of two components.
    floor
        None of the ground.
    built_in
        Whether no earthquake made them.
    copies
        How many more were given, with the samples of another.
    """

    motions: Sequence[Motion]
    floor: Floor | None = None
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

    def at(self, demand: Peaks, *, stretch: bool = True) -> "Shaking":
        """Return the motions with the peaks of a demand.

        Both given, accelerations are multiplied and the time axis is stretched, so that every
        motion has both.  One given, accelerations alone are multiplied to it.

        Parameters
        ----------
        demand
            One peak at least.
        stretch
            Whether time is stretched; else motions are scaled to the PGA, and keep their own PGV.

        Raises
        ------
        InputError
            If a motion that is to be stretched is that of a floor already.
        """
        (pga, pgv), motions = self.peaks, list(self.motions)
        stretches, beside = np.ones(len(pga)), None
        stretched = stretch and demand.pga_g is not None and demand.pgv_m_s is not None
        measure, value = (PGV, demand.pgv_m_s) if demand.pga_g is None else (PGA, demand.pga_g)
        assert value is not None
        levels, others = (pga, pgv) if measure is PGA else (pgv, pga)
        scales = value / levels
        felt = any(across(each).ground is not None for each in motions)
        if felt and (stretched or self.floor is not None):
            raise InputError(
                "motions",
                Words("are those of a floor"),
                "motions of the ground are stretched in time, and reach a floor then",
                "give motions of the ground and the floor beside them, or one peak alone",
            )
        if stretched:
            stretches = np.asarray((demand.pgv_m_s or 0.0) / pgv / scales)
            motions = [
                changed(each, *pair)
                for each, *pair in zip(motions, scales.tolist(), stretches.tolist(), strict=True)
            ]
        else:
            low, high = np.quantile(scales * others, MIDDLE).tolist()
            beside = (PGV if measure is PGA else PGA, low, high)
        if self.floor is not None:
            motions = [self.floor.motion(each) for each in motions]
        return Shaking(
            motions=motions,
            measure=measure,
            level=value,
            scales=scales,
            stretches=stretches,
            other=beside,
            stretched=stretched,
            demand=demand,
        )


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
        Whether both peaks are matched.
    demand
        The demand.
    """

    motions: Sequence[Motion]
    measure: Measure
    level: float
    scales: Floats
    stretches: Floats
    other: tuple[Measure, float, float] | None
    stretched: bool
    demand: Peaks

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


def has_vertical(motion: Motion) -> bool:
    """Return whether a motion has a vertical component."""
    return getattr(motion, "vertical", None) is not None


def distinct(motions: Sequence[Motion]) -> list[Motion]:
    """Return motions without copies: those with the samples of another but for sign and scale."""
    kept: dict[object, Motion] = {}
    for motion in motions:
        kept.setdefault(_shape(motion), motion)
    return list(kept.values())


def _shape(motion: Motion) -> object:
    """Return what motions share that differ by sign and scale alone."""
    record = across(motion)
    samples = record.acceleration_m_s2
    peak = samples[np.argmax(np.abs(samples))]
    up = motion.vertical if isinstance(motion, BaseMotion) else None
    parts = [samples, *([up.acceleration_m_s2] if isinstance(up, Record) else [])]
    signs = [peak, *([abs(peak)] if len(parts) > 1 else [])]
    shapes = [np.round(part / sign, DIGITS) + 0.0 for part, sign in zip(parts, signs, strict=True)]
    return record.dt_s, record.ground, *(shape.tobytes() for shape in shapes)


def folds(factors: Floats) -> Floats:
    """Return factors as folds of 1 or more: 2 of a half, and of two.

    Examples
    --------
    >>> folds(np.array([0.5, 4.0])).tolist()
    [2.0, 4.0]
    """
    return np.maximum(factors, 1.0 / factors)


def median_fold(factors: Floats) -> float:
    """Return the median of the folds of some factors."""
    return float(np.median(folds(factors)))


def across(motion: Motion) -> Record:
    """Return the horizontal record of a motion."""
    record = motion.horizontal if isinstance(motion, BaseMotion) else motion
    assert isinstance(record, Record)
    return record


def changed(motion: Motion, scale: float, stretch: float) -> Motion:
    """Return a motion with its accelerations multiplied and its time axis stretched."""
    if isinstance(motion, BaseMotion):
        up = motion.vertical
        across_it = _changed(motion.horizontal, scale, stretch)
        return BaseMotion(across_it, None if up is None else _changed(up, scale, stretch))
    return _changed(motion, scale, stretch)


def _changed(record: object, scale: float, stretch: float) -> Record:
    """Return a record changed likewise."""
    assert isinstance(record, Record)
    return replace(record.scaled(scale), dt_s=stretch * record.dt_s)
