"""The probability that an object falls at a demand, by one method for files and tables."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.results.doubts import MOST_MISFIT, far_above
from rocksteady.results.numbers import chance, number, plural
from rocksteady.risk.assess._counts import Basis, Motions, count_runs, is_fitted
from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess._sensitivity import MOST_DRAWS, band_of
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.ensemble.contact_levels import levels_in_contact
from rocksteady.risk.ensemble.levels import DEFAULT_MEASURES, Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_each
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.fragility.damage_states import OVERTURNED
from rocksteady.risk.fragility.fit_fragility import fit_fragility
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.screens.friction import (
    MODES,
    FrictionNeed,
    Mode,
    first_motion,
    needed_friction,
)
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

EXTRAPOLATED = "extrapolated beyond the runs"
"""Of a probability by a curve at a demand outside the levels that were run."""
NO_FRICTION = 100.0
"""Friction of an object whose own is not given: only uplift is judged."""


@dataclass(frozen=True, kw_only=True)
class Onset:
    """What the peak acceleration of a demand begins, at the worst end of each range of an object.

    Attributes
    ----------
    motion
        None without a PGA.
    friction_needed
        To rock without sliding; None without a PGA.
    """

    motion: Mode | None
    friction_needed: FrictionNeed | None

    @property
    def slides(self) -> bool:
        """Whether rocking alone is no answer."""
        return self.motion in ("slides", "slides and rocks")


def onset_of(described: DescribedObject) -> Onset:
    """Return what the peak acceleration of an object's demand begins."""
    demand, friction = described.demand, described.given.friction
    pga, vertical = demand.pga_g, demand.vertical_at_peak_g
    if pga is None:
        return Onset(motion=None, friction_needed=None)
    least = NO_FRICTION if friction is None else bounds_of(friction)[0]
    blocks = [described.block, *(variant.block for variant in described.variants())]
    motions = [first_motion(block, pga, least, vertical) for block in blocks]
    needs = [needed_friction(block, pga, vertical) for block in blocks]
    return Onset(
        motion=max(motions, key=MODES.index),
        friction_needed=max(needs, key=lambda need: need.largest),
    )


@dataclass(frozen=True, kw_only=True)
class Probability:
    """A probability of falling, and what it is from.

    Attributes
    ----------
    value
        None of an object that slides, or that no run lifts.
    by_curve
        That of the fitted curve; None without one.
    band
        Interval of 90 % of the value, over records: of a curve by resampling, of a count as
        `Counts.share_band`; None without one.
    basis
        "curve", "count" or "statics"; None of an object that slides.
    method
        The same in words, with the restitutions.
    """

    value: float | None
    by_curve: float | None = None
    band: tuple[float, float] | None = None
    basis: Basis | None = None
    method: str = "none: it slides"

    @property
    def extrapolated(self) -> bool:
        """Whether it is by a curve at a demand outside the levels that were run."""
        return EXTRAPOLATED in self.method


NO_ANSWER = Probability(value=None)
"""Of an object that slides."""


def probability_of(
    described: DescribedObject,
    onset: Onset,
    fragility: Fragility,
    level: DemandLevel,
    counted: float,
    share_band: tuple[float, float] | None,
) -> Probability:
    """Return the probability of falling at a demand.

    It is that of the curve through all levels; where no curve can be fitted, or the share counted
    in the runs at the demand is far above it, that share; 0 where the demand does not lift the
    object.

    Parameters
    ----------
    described, onset, fragility, level
        The object that does not slide, what its demand begins, its curves, and the demand.
    counted
        Share of its runs at the demand that fall, over PGV of the runs that lift; nan without any.
    share_band
        Interval of that share.
    """
    if onset.motion == "rest":
        return Probability(value=0.0, basis="statics", method="statics: the PGA does not lift it")
    curve, block = fragility.state(OVERTURNED).curve, described.block
    if math.isnan(counted) and not is_fitted(curve):
        return Probability(value=None, basis="count", method="none: no run lifts at the demand")
    if not is_fitted(curve):  # a step, or no curve: the runs at the demand are what there is
        words = f"share of the runs at the demand, {_restitutions(described, MOST_DRAWS)}"
        return Probability(value=counted, band=share_band, basis="count", method=words)
    at = np.array([level.of(fragility.measure, block)])
    by_curve = float(curve.probability(at)[0])
    if far_above(by_curve, counted) > by_curve:
        words = (
            f"share of the runs at the demand, {_restitutions(described, MOST_DRAWS)}; "
            f"it is more than {100.0 * MOST_MISFIT:g} points above the curve's {chance(by_curve)}"
        )
        return Probability(
            value=counted, by_curve=by_curve, band=share_band, basis="count", method=words
        )
    band = curve.probability_band(at)
    levels = plural(fragility.ensemble.sizes["level"], "level")
    if is_outside(fragility, level, block):
        levels += f", {EXTRAPOLATED}"
    draws = described.given.assessment.draws
    return Probability(
        value=by_curve,
        by_curve=by_curve,
        band=None if band is None else (float(band[0][0]), float(band[1][0])),
        basis="curve",
        method=f"curve through the runs at {levels}, {_restitutions(described, draws)}",
    )


def is_outside(fragility: Fragility, level: DemandLevel, block: Block) -> bool:
    """Return whether a demand lies outside the levels of the runs."""
    low, high = fragility.state(OVERTURNED).curve.sampled
    return not low <= level.of(fragility.measure, block) <= high


def _restitutions(described: DescribedObject, most: int) -> str:
    """Return the restitutions of an object's runs in words."""
    band = band_of(described, most=most)
    ratios = band.ratios(described.block)
    low, high = number(float(ratios.min())), number(float(ratios.max()))
    if len(ratios) == 1:
        return f"restitution {low}"
    return f"{len(ratios)} restitutions from {low} to {high}"


def fit_fragilities(
    objects: Sequence[DescribedObject],
    motions: Sequence[Motions],
    intensities: Sequence[Measure],
    fitting: FitOptions,
    *,
    run: Execution | None = None,
) -> list[Fragility]:
    """Run each object on its motions at all levels of it, and fit the curves of each.

    Beside the measure of the levels only measures that `fitting` compares are computed: no curve
    depends on them, and all of them take longer than the runs.

    Objects on one floor of one measure and restitution are run in one sweep, those with different
    sides in another.  The first sweep is kept in the store of `run`, further ones beside it: in
    runs-2.zarr, runs-3.zarr and so on beside runs.zarr.
    """
    beside = DEFAULT_MEASURES if fitting.measures is None else fitting.measures
    levels = [
        levels_in_contact(
            Levels(intensity, beside=beside),
            [described.block],
            moved,
            count=described.given.assessment.levels,
        )
        for described, moved, intensity in zip(objects, motions, intensities, strict=True)
    ]
    bands = [band_of(each, most=each.given.assessment.draws) for each in objects]
    ensembles = _run_objects(objects, motions, levels, bands, run=run)
    return [fit_fragility(ensemble, fitting=fitting) for ensemble in ensembles]


def fitted_probability(
    described: DescribedObject,
    block: Block,
    motions: Motions,
    level: DemandLevel,
    *,
    run: Execution | None = None,
) -> float:
    """Return the probability at a demand by the curve of a changed object; nan without a curve.

    Its levels and restitutions are those of `fit_fragilities`.
    """
    options, measure = described.given.assessment, level.measure
    levels = levels_in_contact(Levels(measure, beside=()), [block], motions, count=options.levels)
    band = band_of(described, most=options.draws)
    (ensemble,) = run_each([block], motions, levels=[levels], restitution=band, run=run)
    fitting = FitOptions(states=[OVERTURNED], bands=None, measures=())
    try:
        curve = fit_fragility(ensemble, fitting=fitting).state(OVERTURNED).curve
    except InputError:  # under vertical motion too many of its runs lose contact
        return math.nan
    if not is_fitted(curve):
        return math.nan
    return float(curve.probability(np.array([level.of(measure, block)]))[0])


def _run_objects(
    objects: Sequence[DescribedObject],
    motions: Sequence[Motions],
    levels: Sequence[Levels],
    bands: Sequence[RestitutionBand],
    *,
    ways: Ways | None = None,
    run: Execution | None = None,
) -> list["xarray.Dataset"]:
    """Return the ensemble of each object, of all like ones on one floor in a sweep."""
    groups: dict[object, list[int]] = {}
    for place, (described, wanted) in enumerate(zip(objects, levels, strict=True)):
        count = len(wanted.levels_for([described.block]))
        # Beside a block with different sides a symmetric one has cells for its mirror images.
        like = described.block.symmetric
        key = (id(motions[place]), wanted.measure, count, bands[place], like)
        groups.setdefault(key, []).append(place)
    ensembles: dict[int, xarray.Dataset] = {}
    for places, sweep_run in zip(groups.values(), _runs_for(run, len(groups)), strict=True):
        made = run_each(
            [objects[place].block for place in places],
            motions[places[0]],
            levels=[levels[place] for place in places],
            restitution=bands[places[0]],
            ways=ways,
            run=sweep_run,
        )
        ensembles |= dict(zip(places, made, strict=True))
    return [ensembles[place] for place in range(len(objects))]


class AtDemand(NamedTuple):
    """Runs of an object at its demand: how many fell, of how many, and how many lifted.

    Over PGV `tried` are the runs that lift, otherwise all; `band` is the interval of the share.
    """

    fell: int
    tried: int
    lifted: int
    trials: int
    band: tuple[float, float] | None

    @property
    def share(self) -> float:
        """Share of the runs tried that fell; nan without any."""
        return self.fell / self.tried if self.tried else math.nan


def count_at_demand(
    objects: Sequence[DescribedObject],
    motions: Sequence[Motions],
    levels: Sequence[DemandLevel],
    *,
    run: Execution | None = None,
) -> list[AtDemand]:
    """Return the runs of each object at its demand, without vertical motion, counted."""
    at = [Levels(each.measure, [each.value], beside=()) for each in levels]
    bands = [band_of(each, most=MOST_DRAWS) for each in objects]
    ensembles = _run_objects(objects, motions, at, bands, ways=Ways(vertical=False), run=run)
    counted = []
    for described, ensemble in zip(objects, ensembles, strict=True):
        (counts,) = count_runs(ensemble, [described.block])
        lifted, trials = int(counts.lifted.sum()), int(counts.trials.sum())
        counted.append(AtDemand(*counts.totals(0), lifted, trials, counts.share_band(0)))
    return counted


def _runs_for(run: Execution | None, count: int) -> list[Execution | None]:
    """Return how each of some sweeps is run, each with a store of its own, checked."""
    place = None if run is None else run.place
    if run is None or place is None:
        return [run] * count
    path = place.folder
    beside = [path.with_name(f"{path.stem}-{k}{path.suffix}") for k in range(2, count + 1)]
    stores = [place, *(replace(place, path=each) for each in beside)][:count]
    for store in stores[1:]:
        store.check()
    return [replace(run, store=store) for store in stores]
