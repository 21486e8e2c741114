"""The restitutions of an ensemble: a band, and scatter from impact to impact."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Impacts, Restitution
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import LARGEST_SEED, RESTITUTION, Bounds, Whole
from rocksteady.model.checks.validation import in_range
from rocksteady.seismic.measures.free_sides import impact_ratios

HIGHEST: Final = 0.98
"""Default upper end of a band, where the root of the block's own restitution is above it."""
SCATTER: Final = Bounds(0.0, 0.5, "[]", "give a standard deviation, as 0.05")
MOST_DRAWS: Final = 1000


@checked
@dataclass(frozen=True, kw_only=True)
class RestitutionBand:
    """Band of restitutions that an ensemble covers.

    Restitutions in tests lie on both sides of Housner's value and scatter: so no single value is
    the answer.  For a block against a wall the band is that of the wall.

    Parameters
    ----------
    low
        Lower end: in (0, 1], or in [0, 1] for blocks against a wall, "housner" or ("housner",
        0.965) for a factor of each block's own value by angular momentum; by default the block's
        own restitution e.
    high
        Upper end, of the same forms; default min(0.98, sqrt(e)), which lies below e for the
        most slender blocks.
    draws
        Values in equal steps from `low` to `high`, ends included; a single draw is `low`.
        Default 5.
    scatter
        Standard deviation of the restitution from impact to impact, about the value of its draw;
        default 0.
    seed
        Seed of the scatter, from 0 to 2^64 - 1; default 0.

    Raises
    ------
    InputError
        If an end is outside (0, 1], `low` is above `high`, or another number is outside its range.

    Examples
    --------
    >>> from rocksteady import Block
    >>> from rocksteady.risk import RestitutionBand
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> RestitutionBand(draws=3).ratios(block).round(4).tolist()
    [[0.9118, 0.9118], [0.9333, 0.9333], [0.9549, 0.9549]]
    """

    low: Restitution | None = None
    high: Restitution | None = None
    draws: Annotated[int, Whole(1, MOST_DRAWS, "give the number of values in the band, as 5")] = 5
    scatter: Annotated[float, SCATTER] = 0.0
    seed: Annotated[int, Whole(0, LARGEST_SEED, "give a whole number, as 7")] = 0

    def __post_init__(self) -> None:
        """Validate."""
        for name in ("low", "high"):
            value = getattr(self, name)
            if value is not None and Impacts.of(value).factor is None:
                hint = "give the ratio of the angular velocities after and before an impact"
                ratio = in_range(name, value, 0.0, 1.0, "[]", hint=hint)
                object.__setattr__(self, name, ratio)
        _check_order(self.low, self.high)

    def ratios(self, block: Block) -> Floats:
        """Return the restitutions of a block's sides, shape (draws, 2).

        Examples
        --------
        >>> from rocksteady import Block
        >>> from rocksteady.risk import RestitutionBand
        >>> band = RestitutionBand(low=0.8, high=0.9, draws=2)
        >>> band.ratios(Block.from_p(alpha=0.2, p=2.0)).tolist()
        [[0.8, 0.8], [0.9, 0.9]]

        For a block against a wall it is twice that of the wall.

        Raises
        ------
        InputError
            If an end is 0 and the block rocks to both sides, or `low` is above `high`.
        """
        for name in ("low", "high"):
            if not block.one_sided and getattr(self, name) == 0.0:
                RESTITUTION(name, 0.0)  # refused
        low = block if self.low is None else block.with_restitution(self.low)
        lows = impact_ratios(low)
        highs: Sequence[float] = [min(HIGHEST, math.sqrt(e)) for e in impact_ratios(block)]
        if self.high is not None:
            highs = impact_ratios(block.with_restitution(self.high))
            if self.low is not None:
                _check_order(max(lows), max(highs))
        columns = [np.linspace(*ends, self.draws) for ends in zip(lows, highs, strict=True)]
        return np.stack(columns, axis=1)


def _check_order(low: Restitution | None, high: Restitution | None) -> None:
    """Refuse a band upside down, as far as its ends can be compared without a block."""
    first, second = Impacts.of(low).factor, Impacts.of(high).factor
    if first is None and isinstance(low, float) and isinstance(high, float):
        first, second = low, high
    if first is not None and second is not None and first > second:
        raise InputError(
            "low", low, f"it is the lower end of a band up to {high}", "exchange the two"
        )
