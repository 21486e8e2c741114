"""What runs say of objects at their demands: counted, with the friction that they need, judged."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.blocks.block import Block
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.described.schema import Range
from rocksteady.risk.assess.placed_objects import PlacedObjects
from rocksteady.risk.assess.remedy import Remedy
from rocksteady.risk.counted.count import Count, count_falls
from rocksteady.risk.counted.motions import folds, median_fold
from rocksteady.risk.counted.sliding import friction_at
from rocksteady.risk.counted.suite import Shaking
from rocksteady.risk.counted.verdict import MARGIN, NEAR, Decision, Evidence, Unfit, decide
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.screens.friction import (
    MODES,
    FrictionNeed,
    first_motion,
    lifts,
    uplift_acceleration_g,
)
from rocksteady.risk.spectra.design_spectrum import PLATEAU
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

ROUNDING = 1e-9
"""Part of a peak that scaling may add to it."""
NO_SLIDING = 100.0
"""Friction of an object whose own is not given: only uplift is judged."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Judged:
    """An object at its demand.

    Attributes
    ----------
    decision
        Verdict and reason.
    shaking
        Motions that it was counted with; None where there is none.
    friction
        Friction that it needs under the worst motion.
    uplift_g
        Acceleration that lifts it where it stands, at the worst end of each range [g].
    stands, friction_known
        Whether statics says that nothing lifts it, and whether its friction is given.
    lifted
        How many of the motions lift it at the demand; None without motions.
    count, beyond, near
        Runs at the demand, at 1.1 times it, and at the demand of records that are hardly stretched;
        None without.
    plain
        Of a demand with a vertical motion the runs of all motions without one; else None.
    runs
        The runs at the demand; None without.
    risk
        Annual rate of falling; None without a hazard curve or runs.
    no_rate
        Why the rate is not known, where there is a hazard curve.
    friction_of_rate
        Friction that it needs up to the level below which 95 % of the rate lie.
    remedies
        Least changes with which it meets its target at the demand.
    """

    decision: Decision
    shaking: Shaking | None
    friction: FrictionNeed
    uplift_g: float
    stands: bool
    friction_known: bool
    lifted: int | None
    count: Count | None = None
    beyond: Count | None = None
    near: Count | None = None
    plain: Count | None = None
    runs: "xarray.Dataset | None" = None
    risk: Risk | None = None
    no_rate: str = ""
    friction_of_rate: FrictionNeed | None = None
    remedies: tuple[Remedy, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Onset:
    """What the peaks of a demand begin, at the worst end of each range of an object.

    Attributes
    ----------
    friction
        Friction that it needs to rock without sliding.
    uplift_g
        Acceleration that lifts it [g].
    slides, stands
        Whether its friction is too low, and whether nothing lifts it, by statics.
    margin_lifts
        Whether 1.1 times a demand that does not lift it would.
    """

    friction: FrictionNeed
    uplift_g: float
    slides: bool
    stands: bool
    margin_lifts: bool


def onset_of(described: DescribedObject, shaking: Shaking) -> Onset:
    """Return what the demand of an object begins."""
    demand, friction = described.demand, described.given.friction
    peaks, vertical = shaking.floor_pga_g, demand.vertical_at_peak_g
    least = NO_SLIDING if friction is None else bounds_of(friction)[0]
    blocks = [described.block, *described.corners()]
    worst = float(peaks.max()) * (1.0 - ROUNDING)
    motions = [first_motion(block, worst, least, vertical) for block in blocks]
    slides = max(motions, key=MODES.index) in ("slides", "slides and rocks")
    by_statics = demand.pga_g is not None and not described.on_floor and not shaking.is_lifted
    pga = demand.pga_g or 0.0
    rests = by_statics and not any(lifts(block, pga, vertical) for block in blocks)
    return Onset(
        friction=friction_at(blocks, peaks, vertical),
        uplift_g=min(uplift_acceleration_g(block, vertical) for block in blocks),
        slides=slides,
        stands=rests,
        margin_lifts=any(lifts(block, MARGIN * pga, MARGIN * vertical) for block in blocks),
    )


def judge_objects(placed: PlacedObjects, *, run: Execution | None = None) -> list[Judged]:
    """Return every object at its demand, each kind of object run once."""
    pairs = list(zip(placed.objects, placed.shakings, placed.plain, strict=True))
    onsets = [onset_of(each, _any(shaking, beside)) for each, shaking, beside in pairs]
    wanted: list[tuple[int, bool]] = []
    for place, (onset, (_, shaking, beside)) in enumerate(zip(onsets, pairs, strict=True)):
        if onset.slides or (onset.stands and not onset.margin_lifts):
            continue
        if shaking is not None:
            wanted.append((place, False))
        if beside is not None:
            wanted.append((place, True))
    asked = [
        (placed.objects[place], _any(*pairs[place][1:][:: -1 if plain else 1]))
        for place, plain in wanted
    ]
    ways = [Ways(vertical=False) if plain else None for _, plain in wanted]
    counted = dict(
        zip(
            wanted,
            run_at_demand(
                [(each.block, shaking, band_of(each)) for each, shaking in asked],
                ways=ways,
                multiples=(1.0, MARGIN),
                run=run,
            ),
            strict=True,
        )
    )
    return [
        _judged(
            each,
            onset,
            shaking,
            placed,
            counted.get((place, False)),
            counted.get((place, True)),
            vertical=beside is not None,
        )
        for place, ((each, shaking, beside), onset) in enumerate(zip(pairs, onsets, strict=True))
    ]


def _any(first: Shaking | None, second: Shaking | None) -> Shaking:
    """Return the first of two that there is."""
    shaking = second if first is None else first
    assert shaking is not None
    return shaking


def _judged(
    described: DescribedObject,
    onset: Onset,
    shaking: Shaking | None,
    placed: PlacedObjects,
    runs: "xarray.Dataset | None",
    plain: "xarray.Dataset | None",
    *,
    vertical: bool,
) -> Judged:
    """Return an object with the verdict on its counts."""
    counts = None if runs is None else count_falls(runs)
    known = described.given.friction is not None
    evidence = evidence_of(
        described,
        onset,
        shaking,
        counts,
        built_in=placed.suite.built_in,
        vertical=vertical,
        friction_known=known,
    )
    lifted = None
    if runs is not None and shaking is not None:
        lifted = 0 if onset.stands else int(_lifting(runs).sum())
    return Judged(
        decision=decide(evidence),
        shaking=shaking,
        friction=onset.friction,
        uplift_g=onset.uplift_g,
        friction_known=known,
        stands=onset.stands,
        lifted=lifted,
        count=evidence.count,
        beyond=evidence.beyond,
        near=evidence.near,
        plain=None if plain is None else count_falls(plain)[0],
        runs=None if runs is None else runs.isel(level=0),
    )


def evidence_of(
    described: DescribedObject,
    onset: Onset,
    shaking: Shaking | None,
    counts: Sequence[Count] | None,
    *,
    built_in: bool,
    vertical: bool,
    friction_known: bool,
) -> Evidence:
    """Return what the verdict on an object rests on; `counts` are those at 1 and 1.1 times."""
    count, beyond = (None, None) if counts is None else counts
    near, fold = None, 1.0
    if shaking is not None and not built_in:
        fold = max(median_fold(shaking.scales), median_fold(shaking.stretches))
        if shaking.stretched and count is not None:
            near = count.among(folds(shaking.stretches) < NEAR)
    return Evidence(
        target=described.target.share,
        count=count,
        beyond=beyond,
        near=near,
        stands=onset.stands,
        slides=onset.slides,
        friction_known=friction_known,
        built_in=built_in,
        for_vertical=vertical,
        fold=fold,
        unfit=unfit_of(described, shaking),
    )


def unfit_of(described: DescribedObject, shaking: Shaking | None) -> Unfit:
    """Return why motions on a spectrum are never green; empty of none, and of peaks."""
    if shaking is None or shaking.placing is None:
        return ""
    of_floor, spectrum = described.given.demand.place == "floor", shaking.placing.spectrum
    if spectrum.peak_words and (spectrum.plateau < PLATEAU[0] or not of_floor):
        return "odd-peak"
    if of_floor:
        return "floor-spectrum"
    return "far-off" if shaking.placing.is_far_off else ""


def _lifting(runs: "xarray.Dataset") -> np.ndarray:
    """Return which records lift it at the first level of some runs."""
    scale = runs["scale"].isel(block=0, level=0)
    lifted = (scale > runs["uplift_scale"].isel(block=0)).any(["direction", "vertical"])
    return np.asarray(lifted.values)


def run_at_demand(
    asked: Sequence[tuple[Block, Shaking, RestitutionBand]],
    *,
    ways: Sequence[Ways | None] = (),
    multiples: Sequence[float] = (1.0,),
    run: Execution | None = None,
) -> list["xarray.Dataset"]:
    """Return the runs of blocks at multiples of demands, equal ones run once.

    Parameters
    ----------
    asked
        Block, motions and restitutions of each.
    ways
        How verticals act, for each; by default as the motions have them.
    multiples
        Multiples of the demand, rising.
    run
        As for `run_ensemble`.
    """
    groups: dict[object, dict[Block, list[int]]] = {}
    kinds = ways or [None] * len(asked)
    for place, ((block, shaking, band), way) in enumerate(zip(asked, kinds, strict=True)):
        like = (block.symmetric, block.one_sided)
        key = (id(shaking), band, like, way)
        groups.setdefault(key, {}).setdefault(block, []).append(place)
    ensembles: dict[int, xarray.Dataset] = {}
    for members in groups.values():
        first = next(iter(members.values()))[0]
        _, shaking, band = asked[first]
        ensemble = run_ensemble(
            list(members),
            list(shaking.motions),
            levels=Levels(
                shaking.measure, [factor * shaking.level for factor in multiples], beside=()
            ),
            restitution=band,
            ways=kinds[first] or shaking.ways,
            run=None if run is None else replace(run, store=None),
        )
        for number, places in enumerate(members.values()):
            single = ensemble.isel(block=slice(number, number + 1))
            ensembles |= dict.fromkeys(places, single)
    return [ensembles[place] for place in range(len(asked))]


def band_of(described: DescribedObject) -> RestitutionBand:
    """Return the restitutions of an object: a band of its file, its one value, or the usual one."""
    given, draws = described.given.restitution, described.given.assessment.draws
    if isinstance(given, Range):
        return RestitutionBand(low=given.low, high=given.high, draws=draws)
    if given == "housner":
        return RestitutionBand(draws=draws)
    return RestitutionBand(draws=1)
