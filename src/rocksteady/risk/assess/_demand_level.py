"""The level of an intensity measure that a demand is, and what the suite's records have there."""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number
from rocksteady.risk.assess._counts import Motions
from rocksteady.risk.assess.described.schema import ObjectDemand
from rocksteady.risk.observations.files.toml_tables import named
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.seismic.measures.scalar import Measure, compute_measure

PEAKS = {"pgv_m_s": "pgv_m_s", "p_pgv_per_uplift": "pgv_m_s",
         "pga_g": "pga_g", "pga_per_uplift": "pga_g"}  # fmt: skip
"""Key of the demand that each measure is made of."""


@dataclass(frozen=True, kw_only=True)
class DemandLevel:
    """A demand as a level of a physical measure, which is the same for every object.

    Attributes
    ----------
    measure
        ``pgv_m_s`` or ``pga_g``, or a spectral acceleration of a fixed period.
    value
        In its unit.
    words
        As "PGV of 0.4 m/s".
    assumed
        Whether it is the median of the records, as no demand is given.
    """

    measure: Measure
    value: float
    words: str
    assumed: bool = False

    def of(self, intensity: Measure, block: Block) -> float:
        """Return the demand in a measure that may be relative to the block."""
        side = first_side(block)
        uplift = block.gravity * tan(side.alpha)
        if intensity.name == "p_pgv_per_uplift":
            return side.p * self.value / uplift
        if intensity.name == "pga_per_uplift":
            return self.value * STANDARD_GRAVITY / uplift
        return self.value


def demand_level(
    intensity: Measure, demand: ObjectDemand, motions: Motions, block: Block, source: str
) -> DemandLevel:
    """Return the level of a demand; without one the median of the records as they are.

    Raises
    ------
    ModelError
        If the demand does not state what the measure needs, or its spectrum does not reach it.
    """
    key = PEAKS.get(intensity.name)
    given = demand.pga_g is not None or demand.pgv_m_s is not None or demand.spectrum is not None
    period = float(intensity.period_s or 2.0 * np.pi / first_side(block).p)
    measure = Measure(intensity.name, period) if key is None else Measure(key)
    value: float | None = None if key is None else getattr(demand, key)
    spectrum = demand.spectrum
    if key is None and intensity.name == "sa_g" and spectrum is not None:
        first, last = spectrum.period_s[0], spectrum.period_s[-1]
        if not first <= period <= last:
            raise ModelError(
                named(source, "demand.spectrum", "period_s"),
                Words(f"does not reach {number(period)} s, the measure's period"),
                f"it goes from {number(first)} to {number(last)} s and is not continued",
                "add points to the spectrum, or name another intensity_measure",
            )
        logs = np.interp(np.log(period), np.log(spectrum.period_s), np.log(spectrum.sa_g))
        value = float(np.exp(logs))
    assumed = False
    if value is None and given:
        raise ModelError(
            named(source, "demand", key or "spectrum"),
            Words("is missing"),
            f"the intensity measure {intensity.name} is made of it",
            "add it, or name another intensity_measure in [assessment]",
        )
    if value is None:
        value, assumed = float(np.median(measured(motions, measure))), True
    return DemandLevel(
        measure=measure,
        value=value,
        words=f"{measure.label} of {number(value)} {measure.unit}".strip(),
        assumed=assumed,
    )


def horizontal(motion: Record | BaseMotion) -> Record:
    """Return the horizontal record of a motion."""
    across = motion.horizontal if isinstance(motion, BaseMotion) else motion
    assert isinstance(across, Record)
    return across


def measured(motions: Motions, measure: Measure, block: Block | None = None) -> Floats:
    """Return a measure of each motion as it is, shape (motions,)."""
    return np.array(
        [compute_measure(horizontal(each).reference, measure, block) for each in motions]
    )
