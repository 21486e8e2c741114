"""Levels of an assessment: the usual span, cut where vertical motion takes the base away."""

from collections.abc import Sequence

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.risk.assess._demand_level import horizontal
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.sweep.cases.spacing import in_equal_ratios

MOST_LOST = 0.01
"""Share of the runs that may lose contact with the base: what a fit accepts."""


def levels_of(
    intensity: Measure, block: Block, motions: Sequence[Record | BaseMotion], count: int
) -> Levels:
    """Return levels over the usual span, the last one low enough for the vertical motion.

    A base that falls at g ends a run without an answer.  The last level is the highest at which no
    more than 1 % of all runs can end so.
    """
    usual = Levels(intensity).levels_for([block])
    low, high = usual[0], usual[-1]
    lost = contact_levels(intensity, block, motions)
    tops = [high, *sorted((float(top) for top in lost if low < top < high), reverse=True)]
    chosen = next((top for top in tops if _share_lost(low, top, count, lost) <= MOST_LOST), high)
    if chosen == high and count == len(usual):
        return Levels(intensity)
    return Levels(intensity, list(in_equal_ratios(low, chosen, count)))


def contact_levels(
    intensity: Measure, block: Block, motions: Sequence[Record | BaseMotion]
) -> Floats:
    """Return the level of each motion at which its base falls at g; infinite without vertical."""
    at_one = Levels(intensity).at_scale_one([horizontal(each) for each in motions], [block])[0]
    falling = np.array([_falling(each) for each in motions])
    with np.errstate(divide="ignore"):
        return np.asarray(at_one * block.gravity / falling)


def _falling(motion: Record | BaseMotion) -> float:
    """Return the largest downward acceleration of the base [m/s^2]; 0 without vertical motion."""
    up = motion.vertical if isinstance(motion, BaseMotion) else None
    if not isinstance(up, Record):
        return 0.0
    return max(0.0, -float(np.min(up.acceleration_m_s2)))


def _share_lost(low: float, top: float, count: int, lost: Floats) -> float:
    """Return the largest share of runs that can lose contact; half of them have vertical motion."""
    levels = np.array(in_equal_ratios(low, top, count))
    return 0.5 * float((levels > lost[:, np.newaxis] * (1.0 + 1e-12)).mean())
