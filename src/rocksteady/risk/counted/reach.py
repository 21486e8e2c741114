"""Levels that reach by themselves: from where nothing lifts to where nearly all runs fall."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.risk.counted.count import count_falls
from rocksteady.risk.counted.motions import Motion
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.ensemble.uplift import uplift_scales
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.seismic.spectra.grounds import grounds_of
from rocksteady.seismic.spectra.many import DIRECTIONS, chosen

SPAN: Final = 64.0
"""Ratio of the highest level to the lowest at most."""
MOST: Final = 32
"""Steps from the lowest to the highest level, in equal ratios."""
RATIO: Final = SPAN ** (1.0 / MOST)
FALLEN: Final = 0.95
"""Share that falls at the last level."""
MOST_WITHOUT: Final = 0.01
"""Share of the runs without an answer above which a level is none."""
STRIDE: Final = 4
"""Steps between levels that are tried first."""
BELOW: Final = 1.0 - 1e-6
"""Part of the lowest level that lifts, at which levels begin."""


def reaching_levels(
    levels: Levels,
    blocks: Sequence[Block],
    motions: Sequence[Motion],
    *,
    restitution: RestitutionBand | None = None,
    ways: Ways | None = None,
    also: Sequence[float] = (),
    least: float = 0.0,
    most: float = np.inf,
) -> Levels:
    """Return levels from just below the lowest that lifts to where 95 % fall.

    They end sooner where over 1 % of the runs have no answer, or at 64 times the first.

    Parameters
    ----------
    levels
        The measure; levels that are given are returned as they are.
    blocks, motions, restitution, ways
        As for `run_ensemble`.
    also
        Levels that are to be among them, as that of a demand.
    least
        Level that they reach even where more than 95 % fall before; none by default.
    most
        Level beyond which there is none; none by default.

    Raises
    ------
    InputError
        If no motion lifts a block, however strong.
    """
    if levels.levels is not None:
        return levels
    bare = replace(levels, beside=())
    at = lifting_levels(bare, blocks, motions, ways=ways)
    first = float(at.min()) * BELOW
    if not np.isfinite(first):
        raise InputError(
            "motions",
            Words("never lift it"),
            "a wall stands on the side that they drive it to",
            "give motions that drive it the other way too",
        )
    rising = [first]
    while len(rising) <= MOST:
        step = [rising[-1] * RATIO]
        for _ in range(STRIDE - 1):
            step.append(step[-1] * RATIO)
        rising += [level for level in step if level <= most]
        if rising[-1] != step[-1]:
            break
        if rising[-1] < least:  # they go on, whatever falls
            continue
        (count,) = count_falls(
            run_ensemble(
                list(blocks),
                list(motions),
                levels=replace(bare, levels=[rising[-1]]),
                restitution=restitution,
                ways=ways,
            )
        )
        whole = count.runs + count.without
        if count.without > MOST_WITHOUT * whole or count.share >= FALLEN:
            break
    return replace(levels, levels=sorted({*rising, *also}))


def lifting_levels(
    levels: Levels,
    blocks: Sequence[Block],
    motions: Sequence[Motion],
    *,
    ways: Ways | None = None,
) -> Floats:
    """Return the level above which each motion lifts each block, exactly; inf where none does.

    Returns
    -------
    ndarray, shape (blocks, records, directions, verticals)
    """
    grounds = grounds_of(list(motions))
    asked = Ways() if ways is None else ways
    signs = chosen(asked.reverse, DIRECTIONS)
    lifts = chosen(asked.vertical, ("without", "with"))
    scales = uplift_scales(blocks, grounds, signs, lifts, linear=False)
    at_one = levels.at_scale_one([each.record for each in grounds], blocks)
    return np.asarray(at_one[:, :, np.newaxis, np.newaxis] * scales)
