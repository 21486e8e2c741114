"""Motions of the ground: their components and copies, and what scale and stretch make of them."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record

Motion = Record | BaseMotion
DIGITS: Final = 9
"""Decimals over the peak to which the samples of copies agree."""


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


def with_vertical_peak(motion: Motion, peak_g: float) -> Motion:
    """Return a motion with its vertical component, if any, scaled to a peak [g]."""
    up = motion.vertical if isinstance(motion, BaseMotion) else None
    if not isinstance(up, Record) or not up.peak_acceleration_m_s2:
        return motion
    factor = peak_g * STANDARD_GRAVITY / up.peak_acceleration_m_s2
    return BaseMotion(across(motion), up.scaled(factor))
