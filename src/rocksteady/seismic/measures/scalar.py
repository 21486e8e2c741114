"""Measures of intensity, one number for a record, in which levels and curves are counted."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, NamedTuple

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.seismic.measures.response_spectrum import (
    compute_average_acceleration,
    compute_response_spectrum,
)
from rocksteady.seismic.measures.time_course import integrate_record


class Words(NamedTuple):
    """What a measure is called."""

    label: str
    unit: str
    scales: bool = True
    """Whether it grows with the accelerations."""
    of_block: bool = False
    """Whether a block is needed."""
    of_period: bool = False
    """Whether it has a period, which that of a block may be."""


DEFAULT: Final = "pgv_m_s"
"""Measure of levels and answers where none is named."""
VELOCITIES: Final = ("pgv_m_s", "p_pgv_per_uplift")
"""Measures whose curves are of the runs that lift."""
LONGEST_S = 60.0
"""Longest period that is measured: what is longer is a slip of the pen."""

MEASURES: Final = {
    "pga_g": Words("PGA", "g"),
    "pgv_m_s": Words("PGV", "m/s"),
    "p_pgv_per_uplift": Words("p PGV/(g tan alpha)", "", of_block=True),
    "pga_per_uplift": Words("PGA/(g tan alpha)", "", of_block=True),
    "sa_g": Words("Sa", "g", of_period=True),
    "sa_avg_g": Words("Sa_avg", "g", of_period=True),
    "pgv_per_pga_s": Words("PGV/PGA", "s", scales=False),
    "significant_5_75_s": Words("significant duration, 5-75 %", "s", scales=False),
    "significant_5_95_s": Words("significant duration, 5-95 %", "s", scales=False),
}
"""All measures by their names."""


@checked
@dataclass(frozen=True)
class Measure:
    """Measure of intensity of a ground motion, by its name.

    Parameters
    ----------
    name
        ``pga_g``, ``pgv_m_s``, ``p_pgv_per_uplift`` for p PGV/(g tan alpha), ``pga_per_uplift`` for
        PGA/(g tan alpha), ``sa_g`` for the pseudo-acceleration of 5 % damping at a period,
        ``sa_avg_g`` for its geometric mean over ten periods, 0.2 to 3 times that one; and what no
        scaling changes, ``pgv_per_pga_s``, ``significant_5_75_s`` and ``significant_5_95_s``.
    period_s
        Period of ``sa_g`` and ``sa_avg_g`` [s]; default 2 pi/p of the block.

    Raises
    ------
    InputError
        If there is no such measure, or a measure without a period is given one.

    Examples
    --------
    >>> from rocksteady.measures import Measure
    >>> print(Measure("sa_g", 0.5))
    Sa(0.5 s) [g]
    >>> Measure("pgv_per_pga_s").scales
    False
    """

    name: str
    period_s: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        if self.name not in MEASURES:
            raise InputError(
                "name",
                self.name,
                f"the measures are {', '.join(MEASURES)}",
                "give one of them, as 'pgv_m_s'",
            )
        if self.period_s is None:
            return
        if not self._words.of_period:
            raise InputError(
                "period_s",
                self.period_s,
                f"{self.name} has no period; sa_g and sa_avg_g have one",
                "leave it out",
            )
        period = in_range(
            "period_s", self.period_s, 0.0, LONGEST_S, "(]", hint="give a period in seconds"
        )
        object.__setattr__(self, "period_s", period)

    @property
    def _words(self) -> Words:
        return MEASURES[self.name]

    @property
    def key(self) -> str:
        """Its name, with its period where it has one: ``sa_g_0.5s``."""
        return self.name if self.period_s is None else f"{self.name}_{self.period_s:.6g}s"

    @property
    def label(self) -> str:
        """Name of the measure in texts."""
        label = self._words.label
        if not self._words.of_period:
            return label
        period = "2 pi/p" if self.period_s is None else f"{number(self.period_s)} s"
        return f"{label}({period})"

    @property
    def unit(self) -> str:
        """Its unit; empty of a ratio."""
        return self._words.unit

    @property
    def scales(self) -> bool:
        """Whether it grows in proportion to the accelerations."""
        return self._words.scales

    @property
    def given_uplift(self) -> bool:
        """Whether its curves are of runs that lift: uplift is a matter of PGA, not of PGV."""
        return self.name in VELOCITIES

    @property
    def needs_block(self) -> bool:
        """Whether it needs a block."""
        return self._words.of_block or (self._words.of_period and self.period_s is None)

    def __str__(self) -> str:
        """Return label and unit, as an axis has them."""
        return f"{self.label} [{self.unit}]" if self.unit else self.label


@checked
def compute_measure(record: Record, intensity: Measure | str, block: Block | None = None) -> float:
    """Measure one intensity of a record as it is.

    Parameters
    ----------
    record
        The record, whose ground begins at rest.
    intensity
        The measure, or its name.
    block
        Block of the dimensionless measures and of the default period; of its sides that which lifts
        first counts.  Default none.

    Returns
    -------
    float
        The value in the unit of the measure, all exact for lines between samples.

    Raises
    ------
    InputError
        If the measure needs a block and there is none, or the record is beyond 1e50 m/s^2.

    Examples
    --------
    >>> from rocksteady import Block, Record
    >>> from rocksteady.measures import compute_measure
    >>> record = Record(acceleration_m_s2=[0.0, 2.0, -2.0, 0.0], dt_s=0.2)
    >>> print(f"{compute_measure(record, 'pgv_m_s'):.3f}")
    0.300
    >>> block = Block.rectangle(width=0.32, height=1.8)
    >>> print(f"{compute_measure(record, 'p_pgv_per_uplift', block):.4f}")
    0.4881
    """
    measure = intensity if isinstance(intensity, Measure) else Measure(intensity)
    if block is None and measure.needs_block:
        raise InputError(
            "block",
            None,
            f"{measure.label} is measured with a block's slenderness and p",
            "give the block",
        )
    if measure.name in ("sa_g", "sa_avg_g"):
        period = measure.period_s
        if period is None:
            assert block is not None
            period = 2.0 * math.pi / first_side(block).p
        return _spectral(record, measure.name, period)
    pga, pgv, shorter, longer = _plain(record)
    if measure.name in ("pga_per_uplift", "p_pgv_per_uplift"):
        assert block is not None
        side = first_side(block)
        uplift = block.gravity * tan(side.alpha)
        return pga / uplift if measure.name == "pga_per_uplift" else side.p * pgv / uplift
    return {
        "pga_g": pga / STANDARD_GRAVITY,
        "pgv_m_s": pgv,
        "pgv_per_pga_s": pgv / pga,
        "significant_5_75_s": shorter,
        "significant_5_95_s": longer,
    }[measure.name]


@lru_cache(maxsize=4096)
def _plain(record: Record) -> tuple[float, float, float, float]:
    """Return PGA [m/s^2], PGV [m/s] and both significant durations [s]."""
    course = integrate_record(record)
    begin, most, end = (course.time_of_arias(part) for part in (0.05, 0.75, 0.95))
    pga, pgv = abs(course.peak_acceleration.value), abs(course.peak_velocity.value)
    return pga, pgv, most - begin, end - begin


@lru_cache(maxsize=65536)
def _spectral(record: Record, name: str, period: float) -> float:
    """Return Sa or Sa_avg at a period [g]."""
    if name == "sa_avg_g":
        return compute_average_acceleration(record, period) / STANDARD_GRAVITY
    spectrum = compute_response_spectrum(record, [period])
    return float(spectrum.pseudo_acceleration_m_s2[0]) / STANDARD_GRAVITY
