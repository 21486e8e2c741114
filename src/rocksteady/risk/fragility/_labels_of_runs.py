"""Labels of an ensemble's runs as counts: trials, uplifts and failures of each record and level."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, Words
from rocksteady.outcomes import Status
from rocksteady.risk.ensemble.contact_levels import ANSWERS, MOST_WITHOUT
from rocksteady.risk.fragility.damage_states import DamageState, exceeding
from rocksteady.seismic.measures.scalar import DEFAULT, Measure

if TYPE_CHECKING:
    import xarray


DIMENSIONS = ("block", "record", "direction", "vertical", "draw", "level")
VARIANTS = (2, 3, 4)
"""Axes of the runs of one block on one record at one level."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Labels:
    """Runs of an ensemble, by block, record and level.

    Attributes
    ----------
    ensemble
        The runs.
    status, peak_angle
        Over all dimensions.
    answered
        Which runs have an answer; where all blocks are symmetric, of one direction.
    without
        Number of runs without an answer.
    """

    ensemble: "xarray.Dataset"
    status: NDArray[np.int8]
    peak_angle: Floats
    answered: NDArray[np.bool_]
    without: int

    @property
    def trials(self) -> Integers:
        """Runs with an answer, shape (blocks, records, levels)."""
        return _counted(self.answered)

    def count(self, state: DamageState) -> Integers:
        """Return how many exceed a damage state, shape (blocks, records, levels)."""
        return _counted(exceeding(state, self.status, self.peak_angle) & self.answered)

    @property
    def groups(self) -> Integers:
        """The record of each count, shape (blocks, records, levels)."""
        blocks, records, levels = self.trials.shape
        whole = np.arange(records)[np.newaxis, :, np.newaxis]
        return np.array(np.broadcast_to(whole, (blocks, records, levels)))

    def intensity(self, measure: Measure) -> Floats:
        """Return a measure of the motions as they were scaled, shape (blocks, records, levels)."""
        scale = self.ensemble["scale"].transpose("block", "record", "level").values
        if self.ensemble.attrs["measure"] == measure.key:
            return np.array(np.broadcast_to(self.ensemble["level"].values, scale.shape))
        name = f"im_{measure.key}"
        if name not in self.ensemble.coords:
            kept = ", ".join(each.key for each in kept_measures(self.ensemble)) or "none"
            raise InputError(
                "measures",
                measure.key,
                f"the ensemble has no such measure beside it; it has {kept}",
                "add it to `beside` of its Stripes",
            )
        at_one = self.ensemble[name].transpose("block", "record").values[:, :, np.newaxis]
        return np.array(at_one * scale if measure.scales else np.broadcast_to(at_one, scale.shape))


def labels_of(ensemble: "xarray.Dataset") -> Labels:
    """Return the labels of an ensemble.

    Raises
    ------
    InputError
        If the dataset is no ensemble, or more than 1 % of its runs have no answer.
    """
    if ensemble.attrs.get("kind") != "rocking ensemble":
        raise InputError(
            "ensemble",
            Words("is no ensemble"),
            "it must come from run_ensemble",
            "give run_ensemble(blocks, motions)",
        )
    status = ensemble["status"].transpose(*DIMENSIONS).values
    answered, kept = np.isin(status, ANSWERS), np.ones(status.shape, dtype=np.bool_)
    if not {"negative_alpha", "one_sided"} & set(ensemble.coords):
        kept[:, :, 1:] = False  # mirror images; beside other blocks they give each the same weight
    share = 1.0 - float(answered.mean())
    if share > MOST_WITHOUT:
        lost, open_ = (float((status == s).mean()) for s in (Status.LOST_CONTACT, Status.UNDECIDED))
        raise InputError(
            "ensemble",
            Words(f"has {share:.1%} of its runs without an answer"),
            f"{lost:.1%} lost contact with the base and {open_:.1%} are undecided; a curve is "
            f"fitted where at most {MOST_WITHOUT:.0%} have none",
            "take lower levels, or leave the vertical components out",
        )
    return Labels(
        ensemble=ensemble,
        status=status,
        peak_angle=ensemble["peak_angle"].transpose(*DIMENSIONS).values,
        answered=answered & kept,
        without=int((kept & ~answered).sum()),
    )


def kept_measures(ensemble: "xarray.Dataset") -> tuple[Measure, ...]:
    """Return the measures that an ensemble holds of its records."""
    kept = [values.attrs for name, values in ensemble.coords.items() if "measure" in values.attrs]
    return tuple(Measure(each["measure"], each.get("period_s")) for each in kept)


def measure_of(ensemble: "xarray.Dataset") -> Measure:
    """Return the measure that its curves are over: that of its levels, or the default one."""
    key = ensemble.attrs["measure"]
    kept = {each.key: each for each in kept_measures(ensemble)}
    if key in kept:
        return kept[key]
    default = Measure(DEFAULT)
    return kept.get(default.key) or (next(iter(kept.values())) if kept else default)


def _counted(labels: NDArray[np.bool_]) -> Integers:
    """Return how many runs of one block, record and level have a label."""
    counts: Integers = labels.sum(axis=VARIANTS, dtype=np.int64)
    return counts
