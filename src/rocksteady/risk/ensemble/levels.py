"""Levels of an ensemble: every record is scaled to each, so that they stand in stripes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.motions.record import Record
from rocksteady.seismic.measures.scalar import DEFAULT, Measure, compute_measure
from rocksteady.seismic.spectra.grounds import axis_values

SCALE: Final = "scale"
"""Levels that are plain factors."""
MOST_LEVELS: Final = 1000

DEFAULT_MEASURES: Final = tuple(
    Measure(name)
    for name in (
        "pga_g",
        "pgv_m_s",
        "p_pgv_per_uplift",
        "sa_g",
        "sa_avg_g",
        "pgv_per_pga_s",
        "significant_5_75_s",
    )
)


@checked
@dataclass(frozen=True)
class Levels:
    """Levels to which every record of an ensemble is scaled.

    Parameters
    ----------
    measure
        What the levels are in: an `Measure` that scaling changes, or its name; default
        ``pgv_m_s``.  ``p_pgv_per_uplift`` suits several blocks, ``"scale"`` is plain factors.
    levels
        Above 0, no two alike, shape (levels,).  By default `rocksteady.compute_fragility` reaches
        by itself from where nothing lifts to where nearly all fall; `rocksteady.run_ensemble` needs
        them.
    beside
        Measures of each record, as it is, that are kept beside the runs; by default PGA, PGV, Sa
        and more.

    Raises
    ------
    InputError
        If scaling does not change the measure, a level is not above 0, or there are more than 1000.

    Examples
    --------
    >>> from rocksteady.risk import Levels
    >>> Levels("pga_g", [0.2, 0.4, 0.8]).levels
    (0.2, 0.4, 0.8)
    """

    measure: Measure | str = DEFAULT
    levels: ArrayLike | None = None
    beside: Sequence[Measure] = DEFAULT_MEASURES

    def __post_init__(self) -> None:
        """Validate."""
        if self.measure != SCALE and not isinstance(self.measure, Measure):
            object.__setattr__(self, "measure", Measure(self.measure))
        intensity = self.intensity
        if intensity is not None and not intensity.scales:
            raise InputError(
                "measure",
                intensity.name,
                "scaling a record does not change it, so that it has no levels",
                "take another, as pgv_m_s; this one may stand beside it",
            )
        object.__setattr__(self, "beside", tuple(self.beside))
        if self.levels is not None:
            hint = "give levels in the unit of the measure, as [0.2, 0.5, 1.0]"
            given = axis_values("levels", self.levels)
            if len(given) > MOST_LEVELS:
                raise InputError(
                    "levels",
                    Words(f"has {len(given):,} values"),
                    f"an ensemble takes {MOST_LEVELS} at most",
                    "give fewer",
                )
            levels = [
                in_range("levels", level, 1.0 / LARGEST, LARGEST, "[]", hint=hint)
                for level in given
            ]
            object.__setattr__(self, "levels", tuple(levels))

    @property
    def intensity(self) -> Measure | None:
        """The measure; None for plain factors."""
        return self.measure if isinstance(self.measure, Measure) else None

    @property
    def key(self) -> str:
        """The measure's name in files."""
        return SCALE if self.intensity is None else self.intensity.key

    @property
    def values(self) -> tuple[float, ...]:
        """The levels.

        Raises
        ------
        InputError
            If none are given.
        """
        if self.levels is None:
            raise InputError(
                "levels",
                Words("has no values"),
                "an ensemble runs at levels that are given; compute_fragility alone finds its own",
                "give values in the unit of the measure, as [0.2, 0.5, 1.0]",
            )
        return tuple(np.asarray(self.levels).tolist())

    def at_scale_one(self, records: Sequence[Record], blocks: Sequence[Block]) -> Floats:
        """Return the measure of each record as it is, shape (blocks, records)."""
        if self.intensity is None:
            return np.ones((len(blocks), len(records)))
        return measured(self.intensity, records, blocks)


def measured(intensity: Measure, records: Sequence[Record], blocks: Sequence[Block]) -> Floats:
    """Return a measure of records as they are, shape (blocks, records)."""
    bodies: Sequence[Block | None] = blocks if intensity.needs_block else [None]
    rows = [
        [compute_measure(record.reference, intensity, body) for record in records]
        for body in bodies
    ]
    return np.array(np.broadcast_to(np.array(rows), (len(blocks), len(records))))
