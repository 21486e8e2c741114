"""Runs of an ensemble counted: trials, uplifts and falls of a block, by record and level."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.confidence import share_interval
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.risk.ensemble.contact_levels import ANSWERS
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve, fit_two_stages
from rocksteady.seismic.measures.scalar import VELOCITIES, Measure
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

Motions = Sequence[Record | BaseMotion]

Basis = Literal["curve", "count", "statics"]
"""What a probability is from: a fitted curve, the share of runs, or what lifts or slides."""
MULTIPLES = (0.63, 0.8, 1.0, 1.25, 1.6)
"""Levels about a demand at which a changed object is run: a third of an octave apart."""
OWN = RestitutionBand(draws=1)
"""A block's own restitution, alone."""
THE_DEMAND = MULTIPLES.index(1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Counts:
    """Runs of one block, over record and level.

    Attributes
    ----------
    levels
        Levels of the measure, shape (levels,).
    trials, lifted, fell
        Numbers of runs with an answer, shape (records, levels).
    without
        Number of runs without an answer: the vertical motion of their base falls at g.
    measure
        Name and unit of the levels.
    given_uplift
        Whether probabilities are of the runs that lift, as over PGV.
    """

    levels: Floats
    trials: Integers
    lifted: Integers
    fell: Integers
    without: int
    measure: tuple[str, str]
    given_uplift: bool

    @property
    def tried(self) -> Integers:
        """Runs behind a probability: runs that lift, or all."""
        return self.lifted if self.given_uplift else self.trials

    def totals(self, level: int) -> tuple[int, int]:
        """Return falls and the runs that they are of at a level."""
        return int(self.fell[:, level].sum()), int(self.tried[:, level].sum())

    def share_band(self, level: int) -> tuple[float, float] | None:
        """Return the 90 % interval of the share that falls at a level; None without a run.

        Wilson's of as many trials as records have a run there: runs of one record say little more
        than one of them, and no resampling of the records doubts a share of none or of all.
        """
        fell, tried = self.totals(level)
        if not tried:
            return None
        low, high = share_interval(fell / tried, int((self.tried[:, level] > 0).sum()))
        return float(low), float(high)

    def curve(self) -> FragilityCurve | TwoStageCurve:
        """Return the curve to use, without a band."""
        records, levels = self.trials.shape
        return fit_two_stages(
            np.tile(self.levels, records),
            self.lifted.ravel(),
            self.fell.ravel(),
            self.trials.ravel(),
            groups=np.repeat(np.arange(records), levels),
            measure=self.measure,
        ).over(self.given_uplift)


def is_fitted(curve: FragilityCurve | TwoStageCurve) -> bool:
    """Return whether failure, given uplift, has a fitted curve and not a step, or none."""
    stage = curve.given_uplift if isinstance(curve, TwoStageCurve) else curve
    return stage.status == "fitted"


def count_runs(ensemble: "xarray.Dataset", blocks: Sequence[Block]) -> list[Counts]:
    """Return the counts of each block; for a symmetric one mirror images are counted once."""
    order = ("block", "record", "level", "direction", "vertical", "draw")
    runs = ensemble[["status", "peak_angle"]].transpose(*order)
    status = runs["status"].values
    fell, answered = status == int(Status.OVERTURNED), np.isin(status, ANSWERS)
    lifted = (runs["peak_angle"].values > 0.0) & answered
    level = ensemble["level"]
    levels = np.asarray(level.values, dtype=np.float64)
    unit = str(level.attrs["units"])
    measure = str(level.attrs["long_name"]), "" if unit == "1" else unit
    counts = []
    for place, block in enumerate(blocks):
        kept = slice(0, 1) if block.symmetric else slice(None)
        own_fell, own_lifted, tried = (each[place, :, :, kept] for each in (fell, lifted, answered))
        counts.append(
            Counts(
                levels=levels,
                trials=tried.sum((2, 3, 4), dtype=np.int64),
                lifted=own_lifted.sum((2, 3, 4), dtype=np.int64),
                fell=own_fell.sum((2, 3, 4), dtype=np.int64),
                without=int(tried.size - tried.sum()),
                measure=measure,
                given_uplift=str(ensemble.attrs["measure"]) in VELOCITIES,
            )
        )
    return counts


def run_at(
    blocks: Sequence[Block],
    motions: Motions,
    measure: str | Measure,
    levels: Sequence[float],
    *,
    restitution: RestitutionBand = OWN,
    vertical: bool = False,
    run: Execution | None = None,
) -> list[Counts]:
    """Run blocks at some levels, and count.

    Parameters
    ----------
    blocks, motions
        Every block meets every motion, as recorded and reversed.
    measure, levels
        As for `Levels`.
    restitution
        By default the blocks' own alone.
    vertical
        Whether vertical components shake too; default False.
    run
        As for `run_ensemble`.
    """
    ensemble = run_ensemble(
        list(blocks),
        list(motions),
        levels=Levels(measure, list(levels), beside=()),
        restitution=restitution,
        ways=Ways(vertical=vertical),
        run=run,
    )
    return count_runs(ensemble, blocks)
