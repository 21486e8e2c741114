"""Fragility of one damage state: counted shares over levels, and what summarises them."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.numbers import number_or_none
from rocksteady.results.result import Result
from rocksteady.risk.counted.curve import Curve, monotone
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.damage_states import UPLIFT, DamageState
from rocksteady.seismic.measures.scalar import Measure

HALF: Final = 0.5
GOOD: Final = 0.1
"""Misfit up to which a lognormal summarises the points."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class StateFragility(Result):
    """Counted shares of one damage state over levels of intensity.

    Attributes
    ----------
    state
        The damage state.
    measure
        What the levels are in; None of plain factors.
    curve
        The counts at the levels, and what is known without a run.
    lognormal
        Median and beta that summarise the counted shares; no answer is taken from them.

    Examples
    --------
    >>> from rocksteady import Block, compute_fragility
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import Levels, RestitutionBand
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.3, height=1.5),
    ...     make_synthetic_suite(3),
    ...     levels=Levels("pga_g", [0.2, 0.5, 1.0]),
    ...     restitution=RestitutionBand(draws=1),
    ... )
    >>> fragility.state("uplift").share([0.19, 0.3]).tolist()
    [0.0, 1.0]
    """

    state: DamageState
    measure: Measure | None
    curve: Curve
    lognormal: FragilityCurve

    def share(self, level: ArrayLike) -> Floats:
        """Return the share at some levels: 0 below uplift, and no more than lifts.

        Uplift is a step at the threshold of each record, known without a run.  Other states are
        monotone shares nearest to the counted ones, straight over the logarithm of the level.

        Parameters
        ----------
        level
            Levels, above 0.
        """
        return self.curve.lifting(level) if self.state.name == UPLIFT else self.curve.at(level)

    @property
    def is_lognormal(self) -> bool:
        """Whether median and beta summarise the points, to within 10 of them in 100."""
        best = self.lognormal
        return bool(best.misfit <= GOOD and np.isfinite(best.beta))

    @property
    def half(self) -> tuple[float, float | None, float | None] | None:
        """Level at which half reach the state, and the levels whose bands hold a half.

        None where no level reaches it; an end is None where the levels do not.
        """
        at = self.curve.lifts_at
        lifts = float(at[(len(at) - 1) // 2])
        if self.state.name == UPLIFT:
            return (lifts, None, None) if np.isfinite(lifts) else None
        bands = np.array([count.band for count in self.curve.counts])
        shares = self.curve.steps, monotone(bands[:, 1]), monotone(bands[:, 0])
        middle, first, last = (_crossing(self.curve.levels, each) for each in shares)
        if middle is None:
            return None
        middle = max(middle, lifts)  # no more fall than lift
        low = None if first is None else min(max(first, lifts), middle)
        high = None if last is None else max(last, middle)
        return middle, low, high

    @property
    def rows(self) -> list[dict[str, Any]]:
        """A row for each level, under the names of the JSON."""
        return [
            {
                "damage_state": self.state.name,
                "measure": "scale" if self.measure is None else self.measure.key,
                "level": level,
                "share": number_or_none(count.share),
                "low": count.band[0],
                "high": count.band[1],
                "runs": count.runs,
                "reached": count.falls,
                "records": count.records,
            }
            for level, count in zip(self.curve.levels.tolist(), self.curve.counts, strict=True)
        ]

    @property
    def summary_row(self) -> dict[str, Any]:
        """Median, beta and misfit, under the names of the JSON."""
        best = self.lognormal
        return {
            "damage_state": self.state.name,
            "median": number_or_none(best.median),
            "beta": number_or_none(best.beta),
            "misfit": number_or_none(best.misfit) if np.isfinite(best.beta) else None,
        }


def _crossing(levels: Floats, shares: Floats) -> float | None:
    """Return the level at which rising shares reach a half; None where none does, or the first."""
    reached = shares >= HALF
    place = int(np.argmax(reached))
    if not reached[place] or not place:
        return None
    before, after = float(shares[place - 1]), float(shares[place])
    part = (HALF - before) / (after - before)
    return float(levels[place - 1] * (levels[place] / levels[place - 1]) ** part)
