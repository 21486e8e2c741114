"""Default levels under vertical motion: they end where the base of too many runs falls at g."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.results.numbers import number
from rocksteady.risk.ensemble.levels import COUNT, Levels
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.seismic.spectra.batch import GroundShaking
from rocksteady.seismic.spectra.grounds import grounds_of
from rocksteady.sweep.cases.spacing import in_equal_ratios

Motions = Record | BaseMotion | Sequence[Record | BaseMotion]

ANSWERS = (Status.ROCKING, Status.AT_REST, Status.OVERTURNED)
"""Outcomes that say whether a block falls."""
MOST_WITHOUT = 0.01
"""Share of the runs that may end without an answer."""
JUST_BELOW = 1.0 - 1e-9
"""Part of the level at which a base falls at g: there a run has an answer."""
NARROWEST = 2.0
"""Least ratio of the last level to the first."""


def levels_in_contact(
    levels: Levels,
    blocks: Sequence[Block],
    motions: Motions,
    *,
    count: int = COUNT,
    ways: Ways | None = None,
) -> Levels:
    """Return levels at which no more than 1 % of all runs can lose contact with the base.

    A base that falls at g ends a run without an answer.  The last level is the highest of the usual
    span at which no more can end so; where that is near its first level, or below, all are lower.

    Parameters
    ----------
    levels
        Returned as they are where they are given, or where no motion is vertical.
    blocks, motions, ways
        As for `run_ensemble`.
    count
        Number of levels.
    """
    if levels.levels is not None:
        return levels
    usual = levels.levels_for(blocks)
    low, high = usual[0], usual[-1]
    chosen = Ways() if ways is None else ways
    shaken = {"both": 0.5, True: 1.0, False: 0.0}[chosen.vertical]
    lost = contact_levels(levels, blocks, motions) * JUST_BELOW
    tops = [high, *sorted((float(top) for top in lost.ravel() if top < high), reverse=True)]
    spans = [in_equal_ratios(min(low, top / NARROWEST), top, count) for top in tops]
    wanted = next(
        span
        for span in spans
        if shaken * np.mean(np.array(span) > lost[..., np.newaxis]) <= MOST_WITHOUT
    )
    if wanted[-1] == high and count == len(usual):
        return levels
    return replace(levels, levels=wanted)


def contact_levels(levels: Levels, blocks: Sequence[Block], motions: Motions) -> Floats:
    """Return the level of each motion at which its base falls at g, shape (blocks, motions).

    It is infinite without vertical motion.
    """
    grounds = grounds_of(motions)
    at_one = levels.at_scale_one([each.record for each in grounds], blocks)
    falling = np.array([_falling(each) for each in grounds])
    with np.errstate(divide="ignore"):
        return np.asarray(at_one * blocks[0].gravity / falling)


def words_of_shorter(levels: Levels, blocks: Sequence[Block], last: float) -> list[str]:
    """Return a sentence where the levels of an ensemble end below the usual ones."""
    usual = levels.levels_for(blocks)[-1]
    if levels.levels is not None or last >= usual * (1.0 - 1e-9):
        return []
    measure = levels.intensity
    named, unit = ("scale", "") if measure is None else (measure.label, measure.unit)
    return [
        f"The levels end at {named} {number(last)} {unit}".rstrip()
        + f", not at {number(usual)}: the vertical motion of stronger records falls at g, and "
        "such runs have no answer."
    ]


def _falling(ground: GroundShaking) -> float:
    """Return the largest downward acceleration of the base [m/s^2]; 0 without vertical motion."""
    if ground.vertical is None:
        return 0.0
    return max(0.0, -float(np.min(ground.vertical.acceleration_m_s2)))
