"""Bands of any status: redrawn suites of a curve, the sides of a step, bounds of one-sided data."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.results.doubts import FEWEST_RECORDS
from rocksteady.results.numbers import plural
from rocksteady.risk.fits._bootstrap import Replicates, draw_replicates
from rocksteady.risk.fits._maximum import Maximum
from rocksteady.risk.fits._status import ALWAYS, FITTED, NEVER, NOT_RISING, SEPARATED
from rocksteady.risk.fits.bands import BandOptions

MOST_LEFT_OUT = 0.05
"""Share of redrawn suites without a curve, above which there is a warning."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PriorRange:
    """Band of the probability of one stage or of the product of two.

    Attributes
    ----------
    drawn
        Redrawn suites of the stages that are fitted; None where none is.
    others
        Stages without a curve.
    confidence
        Confidence of the band.
    """

    drawn: Replicates | None
    others: tuple[Maximum, ...]
    confidence: float

    def probability(self, at: Floats) -> tuple[Floats, Floats]:
        """Return the lower and the upper end at intensities."""
        low, high = np.ones(at.shape), np.ones(at.shape)
        if self.drawn is not None:
            low, high = self.drawn.probability(at)
        for stage in self.others:
            least, most = _bounds(stage, at, self.confidence)
            low, high = low * least, high * most
        return low, high


def _bounds(stage: Maximum, at: Floats, confidence: float) -> tuple[Floats, Floats]:
    """Return bounds of a probability that does not fall with intensity.

    A step lies between its sides.  Where none of n records fails, the bound is that of Clopper and
    Pearson, 1 - (1 - confidence)^(1/n), n being those whose trials reach the intensity; where all
    fail, the same of survival.
    """
    nothing, everything = np.zeros(at.shape), np.ones(at.shape)
    if stage.step is not None:
        above, beyond = at > stage.step[0], at >= stage.step[1]
        return np.where(above & beyond, 1.0, 0.0), np.where(above | beyond, 1.0, 0.0)
    tried = stage.counts.trials.toarray() > 0.0
    present = tried.any(axis=1)
    weight = stage.counts.multiplicity[present]
    if stage.status == NEVER:
        place = tried.shape[1] - 1 - np.argmax(tried[present][:, ::-1], axis=1)
        reached = stage.counts.levels[place][:, None] >= at.ravel()
    else:
        reached = stage.counts.levels[np.argmax(tried[present], axis=1)][:, None] <= at.ravel()
    count = (weight @ reached).reshape(at.shape)
    bound = np.where(count > 0.0, (1.0 - confidence) ** (1.0 / np.maximum(count, 1.0)), 0.0)
    return (nothing, 1.0 - bound) if stage.status == NEVER else (bound, everything)


def spread_of(
    stages: Sequence[Maximum], bands: BandOptions | None
) -> tuple[PriorRange | None, list[str]]:
    """Return the band of the product of stages, and sentences on its limits."""
    if bands is None or not bands.replicates or any(stage.status == NOT_RISING for stage in stages):
        return None, []
    fitted = [stage for stage in stages if stage.status == FITTED]
    known = {SEPARATED, NEVER, ALWAYS}
    others = tuple(stage for stage in stages if stage.status in known)
    records = min(stage.counts.records for stage in stages)
    if records < FEWEST_RECORDS:
        reason = f"{plural(records, 'record')}, and it needs {FEWEST_RECORDS}"
        return None, [f"there is no confidence band: {reason}"]
    if not fitted:
        return PriorRange(drawn=None, others=others, confidence=bands.confidence), []
    drawn = draw_replicates(fitted, bands)
    left_out = bands.replicates - len(drawn.values)
    words = f"{left_out:,} of {plural(bands.replicates, 'redrawn suite')} have no curve"
    if left_out > 0.5 * bands.replicates:
        return None, [f"there is no confidence band: {words}"]
    few = left_out > MOST_LEFT_OUT * bands.replicates
    sentences = [f"{words} and are left out of the band, which is too narrow"] if few else []
    return PriorRange(drawn=drawn, others=others, confidence=bands.confidence), sentences
