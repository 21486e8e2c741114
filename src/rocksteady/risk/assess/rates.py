"""Rates: counted shares of an object over levels, and how often it falls at its site."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.results.numbers import quantity
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.described.schema import own_states
from rocksteady.risk.assess.judging import Judged, band_of, unfit_of
from rocksteady.risk.assess.placed_objects import demand_of
from rocksteady.risk.counted.motions import Motion, across, folds
from rocksteady.risk.counted.reach import reaching_levels
from rocksteady.risk.counted.sliding import friction_at, sliding_level
from rocksteady.risk.counted.suite import PGA, PGV, Shaking
from rocksteady.risk.counted.verdict import (
    LEAST,
    MARGIN,
    NEAR,
    YEARS,
    Decision,
    RateEvidence,
    Reason,
    decide_rate,
)
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.fragility.compute_fragility import count_fragility
from rocksteady.risk.fragility.damage_states import DEFAULT_STATES, OVERTURNED, DamageState
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.risk.hazard.failure_risk import Risk, in_years, risk_of, why_unknown
from rocksteady.risk.hazard.fragile import fragile_of
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import written
from rocksteady.seismic.measures.scalar import compute_measure
from rocksteady.sweep.run import Execution


def curve_of(
    described: DescribedObject,
    shaking: Shaking,
    hazard: HazardCurve | None = None,
    run: Execution | None = None,
) -> Fragility | None:
    """Return counted shares over levels that hold the demand, up to the end of a hazard curve.

    None of what slides before it lifts.
    """
    try:
        slides_above = _sliding(described, shaking)
    except ModelError:
        return None
    block, band = described.block, band_of(described)
    through = (shaking.level, MARGIN * shaking.level)
    motions: list[Motion] = list(shaking.motions)
    levels = reaching_levels(
        Levels(shaking.measure),
        [block],
        motions,
        restitution=band,
        ways=shaking.ways,
        also=through,
        least=0.0 if hazard is None else float(hazard.levels[-1]),
    )
    ensemble = run_ensemble(
        block, motions, levels=levels, restitution=band, ways=shaking.ways, run=run
    )
    fragility = count_fragility(ensemble, states=_states(described))
    states = [
        replace(each, curve=replace(each.curve, through=through)) for each in fragility.states
    ]
    fragility = replace(fragility, states=tuple(states))
    if slides_above >= levels.values[-1]:
        return fragility
    words = sliding_words(quantity(slides_above, shaking.measure.unit))
    warnings = (*fragility.warnings, words)
    return replace(fragility, slides_above=slides_above, warnings=warnings)


def sliding_words(level: str) -> str:
    """Return what shares above a level are, at which it slides."""
    return f"Above {level} it slides under the strongest record: shares there are of rocking alone."


def _sliding(described: DescribedObject, shaking: Shaking) -> float:
    """Return the level above which an object slides under some motion; inf where none does.

    Raises
    ------
    ModelError
        If it slides before it lifts.
    """
    if described.given.friction is None:
        return math.inf
    motions, block = list(shaking.motions), described.block
    ones = Levels(shaking.measure).at_scale_one([across(each) for each in motions], [block])
    return sliding_level([block], motions, ones, bounds_of(described.given.friction)[0])


def _states(described: DescribedObject) -> Sequence[DamageState | float | str]:
    """Return the damage states of the file, overturning among them."""
    states = [
        name if peak is None else DamageState(name, peak)
        for name, peak in own_states(described.given.assessment)
    ]
    if not states:
        return DEFAULT_STATES
    return [*states, *([] if OVERTURNED in states else [OVERTURNED])]


def is_curved(judged: Judged, site: HazardCurve | None, *, curves: bool) -> bool:
    """Return whether shares are counted over levels: of what is counted, or for a rate."""
    if judged.decision.verdict in ("slides", "no-answer") or judged.shaking is None:
        return False
    return site is not None or (curves and judged.count is not None)


def site_of(
    described: DescribedObject, hazard: HazardCurve | None, *, stretch: bool
) -> HazardCurve | None:
    """Return a hazard curve over the measure that an object's motions are scaled by.

    With both peaks given PGV over PGA is kept, so that a curve over PGV is one over PGA.

    Raises
    ------
    InputError
        If the two are of different measures, the demand is that of a floor, or there is none for a
        target in 50 years.
    """
    demand = demand_of(described)
    if hazard is None:
        if described.target.years is not None:
            raise InputError(
                "hazard",
                Words("is missing"),
                f"{described.name} has a target of {described.target.words}",
                "give the hazard curve of the site, or a target at the demand",
            )
        return None
    if described.given.demand.place == "floor":
        raise InputError(
            "hazard",
            Words("is that of the ground"),
            f"the demand of {described.name} is that of its floor",
            "give the demand of the ground and the floor, or leave the hazard curve out",
        )
    measure = PGV if demand.pga_g is None else PGA
    if hazard.intensity == measure:
        return hazard
    if hazard.intensity == PGV and demand.pga_g and demand.pgv_m_s and stretch:
        factor = demand.pga_g / demand.pgv_m_s
        return replace(hazard, measure=PGA, levels=np.asarray(hazard.levels) * factor)
    raise InputError(
        "hazard",
        Words(f"is over {written(hazard.intensity)}"),
        f"the demand of {described.name} is {demand.words}",
        f"give a hazard curve over {written(measure)}"
        + ", or both peaks of the demand" * (hazard.intensity in (PGA, PGV) and stretch),
    )


def with_rate(
    described: DescribedObject,
    judged: Judged,
    fragility: Fragility | None,
    hazard: HazardCurve,
    *,
    built_in: bool,
) -> Judged:
    """Return a judged object with its annual rate of falling, which a target in years is for.

    `hazard` is that of `site_of`.  Levels above which it would slide count as without runs.
    """
    if fragility is None:
        judged = replace(judged, no_rate="it slides before it lifts")
        if described.target.years is None:
            return judged
        return replace(judged, decision=Decision(verdict="slides"))
    shaking, state = judged.shaking, fragility.states[-1]
    assert shaking is not None
    if fragility.records < LEAST:
        return without_rate(described, judged)
    last = math.inf if fragility.slides_above is None else fragility.slides_above
    risk = _risk(state, hazard, last)
    block, given = described.block, described.given.friction
    records = [across(each) for each in shaking.motions]
    peaks = np.array([compute_measure(each, PGA) for each in records])
    (ones,) = Levels(shaking.measure).at_scale_one(records, [block])
    need = friction_at([block], risk.contributing[-1] / ones * peaks)
    judged = replace(judged, risk=risk, friction_of_rate=need)
    if not risk.is_known:
        judged = replace(judged, no_rate=why_unknown(risk))
    if described.target.years is None:
        return judged
    near = None
    kept = folds(shaking.stretches) < NEAR
    if shaking.stretched and not built_in and kept.sum() >= LEAST:
        counts = [count.among(kept) for count in state.curve.counts]
        curve = replace(state.curve, counts=counts)
        rate = _risk(replace(state, curve=curve), hazard, last).annual_rate
        near = in_years(rate, described.target.years)
    verdict, reason = decide_rate(
        RateEvidence(
            target=described.target.share,
            band=risk.probability_band,
            near=near,
            is_known=risk.is_known,
            friction_known=given is not None and need.largest <= bounds_of(given)[0],
            built_in=built_in,
            unfit=unfit_of(described, shaking),
        )
    )
    decision = judged.decision
    if decision.verdict not in ("slides", "no-answer"):
        decision = replace(decision, verdict=verdict, reason=reason)
    return replace(judged, decision=decision)


def without_rate(described: DescribedObject, judged: Judged) -> Judged:
    """Return a judged object of too few records for a rate."""
    decision = judged.decision
    if decision.verdict in ("slides", "no-answer"):
        return judged
    reason: Reason = "few-records" if judged.shaking is not None else "few-vertical"
    if described.target.years is not None:
        return replace(judged, decision=Decision(verdict="no-answer", reason=reason))
    return replace(judged, no_rate=f"a rate is of {LEAST} records or more")


def _risk(state: StateFragility, hazard: HazardCurve, last: float) -> Risk:
    """Return the rate of a damage state of which nothing is counted above a level."""
    fragile = fragile_of(state, hazard, None, None)
    if last < fragile.last:
        fragile = replace(fragile, last=last, slides=True)
    return risk_of(fragile, hazard, YEARS)
