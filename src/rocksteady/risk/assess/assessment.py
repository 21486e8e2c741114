"""The whole assessment of one object: counted runs, verdict, sensitivity, formulas, curve."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.record import Record
from rocksteady.results.answer import Answer
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import force_words, number, number_or_none
from rocksteady.results.result import Result
from rocksteady.results.stated import Stated, facts_stated
from rocksteady.risk.assess._assessment_tables import tables_of
from rocksteady.risk.assess._judging import Judged, judge_objects
from rocksteady.risk.assess._remedies import is_helped, remedies_of
from rocksteady.risk.assess._remedy import Remedy
from rocksteady.risk.assess._sensitivity import Case, bars_of, vary
from rocksteady.risk.assess._sentences import Screen
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.facts import ObjectFacts, compute_object_facts
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.placed_objects import demand_of, place_objects
from rocksteady.risk.assess.rates import curve_of, is_curved, site_of, with_rate, without_rate
from rocksteady.risk.counted.motions import folds, median_fold
from rocksteady.risk.counted.suite import Demanded, Peaks, Shaking, Suite
from rocksteady.risk.counted.verdict import CODES, LEAST, Decision, Target
from rocksteady.risk.ensemble.qualification import (
    OF_ROCKING,
    forces_of_rocking,
    most_of_rocking,
    rocking_words,
)
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.screens.screen import KINDS
from rocksteady.risk.screens.screens import Screens, screen_block
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Assessment(Result):
    """Assessment of an object, from `rocksteady.assess_object`.

    Attributes
    ----------
    described, facts, screens
        The object, what follows from its geometry, and published formulas side by side.
    judged
        Counts at the demand, friction, and the verdict.
    suite
        Motions of the ground.
    fragility
        Counted shares over levels that hold the demand; None where nothing was counted.
    cases
        One thing changed at a time, counted at the demand; the first is the object as described.
    seconds
        Time that it took [s].
    """

    described: DescribedObject
    facts: ObjectFacts
    screens: Screens
    judged: Judged
    suite: Suite
    fragility: Fragility | None = None
    cases: tuple[Case, ...] = ()
    seconds: float = 0.0

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear()

    @property
    def decision(self) -> Decision:
        """Verdict and reason."""
        return self.judged.decision

    @property
    def verdict(self) -> str:
        """The verdict: "green", "red", "stands", "slides", "not-shown" or "no-answer"."""
        return self.decision.verdict

    @property
    def exit_code(self) -> int:
        """Exit code of a command that checks the verdict."""
        return CODES[self.decision.verdict]

    @property
    def share(self) -> float | None:
        """Share that falls at the demand: counted, 0 of what stands by statics; else None."""
        if self.judged.stands and self.verdict != "slides":
            return 0.0
        return self.judged.count.share if self._is_counted and self.judged.count else None

    @property
    def band(self) -> tuple[float, float] | None:
        """The 90 % interval of the share; None without one."""
        if self.judged.stands and self.verdict != "slides":
            return 0.0, 0.0
        return self.judged.count.band if self._is_counted and self.judged.count else None

    @property
    def _is_counted(self) -> bool:
        """Whether counted runs are the answer."""
        return self.verdict in ("green", "red", "not-shown")

    @property
    def target(self) -> Target:
        """Share that is accepted, at the demand or in 50 years."""
        return self.described.target

    @property
    def risk(self) -> Risk | None:
        """Annual rate of falling; None without a hazard curve or runs."""
        return self.judged.risk

    @property
    def remedies(self) -> tuple[Remedy, ...]:
        """Least changes with which it meets its target at the demand."""
        return self.judged.remedies

    @property
    def sentence(self) -> str:
        """The answer in a sentence."""
        return self.screen.sentence

    @property
    def demand(self) -> str:
        """The demand in words."""
        return where_words(self.described, self.judged.shaking).partition(" ")[2]

    @cached_property
    def screen(self) -> Screen:
        """Sentence and lines."""
        return screen_of(self.described, self.judged, self.suite)

    @cached_property
    def qualification(self) -> Mapping[str, float | None]:
        """Top and clearance [m] and edge speed [m/s] of most runs that rock and stand.

        84 % of them do not exceed it at the demand; empty where nothing was counted.
        """
        runs = self._at_demand
        return {} if runs is None else most_of_rocking(runs)

    @cached_property
    def base_force_kn(self) -> tuple[float, float] | None:
        """Horizontal and vertical force on the base [kN] of most runs that rock and stand.

        84 % of one run under each motion at the demand, with the object's own restitution, do not
        exceed them.  None without the object's mass, or such runs.
        """
        runs, facts, shaking = self._at_demand, self.facts, self.judged.shaking
        if runs is None or shaking is None:
            return None
        (force,) = forces_of_rocking([runs], [facts.block], shaking.motions, [facts.mass_kg])
        return force

    @property
    def _at_demand(self) -> "xarray.Dataset | None":
        """The runs at the demand; None where there are none."""
        return None if self.judged.stands else self.judged.runs

    @property
    def bars(self) -> list[tuple[str, float, float]]:
        """What is varied alone, and the shares at its low and high ends, the widest first."""
        bars = bars_of(self.cases)
        return [(f"{bar.parameter}, {bar.ends}", bar.low, bar.high) for bar in bars]

    @property
    def scope_words(self) -> str:
        """Which published formulas stand beside the answer, and a kind that chooses none."""
        kind = self.described.given.kind
        words = f"Published formulas, {': '.join(self.screens.scope)}."
        if self.screens.kind is not None or kind == "other":
            return words
        return f"Kind {kind!r} chooses no formulas; {', '.join(KINDS)} do. {words}"

    def describe(self) -> Description:
        """Return the sentence, facts, sensitivity, formulas, caveats and inputs."""
        facts = self.facts.describe()
        kept = [fact for fact in facts.facts if fact.key != "name"]
        return Description(
            headline=self.sentence,
            facts=[*self._answer(), *kept],
            tables=tables_of(
                self.screens, self.cases, self.suite, self.judged.shaking, self.remedies
            ),
            notes=[*self.facts.warnings, *self._warnings(), *CAVEATS, self.scope_words],
            answer=Answer(self.sentence, facts_stated(self.lines)),
        )

    @property
    def lines(self) -> list[Stated]:
        """The facts below the sentence."""
        lines = list(self.screen.lines)
        for bar in bars_of(self.cases)[:1]:
            if words := bar.words:
                words = f"{bar.parameter}, {bar.ends}: {words}"
                lines.append(Stated(quantity="matters most", text=words))
        if parts := self.facts.block.parts:
            words = f"{parts} as one body"
            names = [line.quantity for line in lines]
            if "lifts at" in names:  # where there is room
                place = names.index("lifts at")
                condition = lines[place].condition
                lines[place] = replace(lines[place], condition=f"{condition}; {words}".lstrip("; "))
            else:
                lines.append(Stated(quantity="one body", text=words))
        return lines

    def _answer(self) -> list[Fact]:
        """Return the facts of the answer."""
        judged, target = self.judged, self.target
        words = rocking_words(self.qualification) if self.qualification else ""
        moved = ("top moves", words) if words else ("", "")
        force = self.base_force_kn
        pushed = (
            ("force on base", f"{force_words(force, 'kN')}, {OF_ROCKING}") if force else ("", "")
        )
        return [
            Fact("name", self.described.name, "object"),
            Fact("sentence", self.sentence),
            *(Fact("", label=label, text=text) for label, text in facts_stated(self.lines)),
            *answer_facts(judged, target, built_in=self.suite.built_in),
            Fact("copies", self.suite.copies),
            *target_facts(target),
            *demand_facts(self.judged.shaking, demand_of(self.described), self.demand),
            Fact("vertical_g", self.described.demand.vertical_g),
            Fact("vertical_share", self.described.demand.vertical_share),
            Fact("model", self.model.name, "model"),
            Fact("qualification", self.qualification or None, *moved),
            Fact("base_force_kn", force and list(force), *pushed),
            Fact("seconds", self.seconds),
        ]

    def _warnings(self) -> list[str]:
        """Return what limits the runs, and least changes beside others that would do."""
        warnings = [] if self.fragility is None else list(self.fragility.warnings)
        shaking = self.judged.shaking
        if shaking is not None and shaking.stretched and self.fragility is not None:
            words = f"The curve is over multiples of the demand: {shaking.demand.kept}."
            warnings.append(words)
        demand = demand_of(self.described)
        warnings += [demand.remark] if isinstance(demand, DesignSpectrum) else []
        if shaking is not None and shaking.placing is not None:
            warnings.append(shaking.placing.remark)
        warnings += [each.warning for each in self.remedies if each.warning]
        warnings += [] if self.risk is None else self.risk.hazard.remarks
        return [*filter(None, dict.fromkeys(warnings))]


def answer_facts(judged: Judged, target: Target, *, built_in: bool) -> list[Fact]:
    """Return what a judgement is in JSON, under the keys that others rely on."""
    decision, shaking = judged.decision, judged.shaking
    counted = decision.verdict in ("green", "red", "not-shown") and not judged.stands
    count = judged.count if counted else None
    stands = judged.stands and decision.verdict != "slides"
    low, high = (0.0, 0.0) if stands else count.band if count else (None, None)
    by, in_years = None, target.years is not None
    if decision.verdict == "slides" or (judged.stands and not in_years):
        by = "statics"
    elif count is not None or decision.verdict in ("green", "red", "not-shown"):
        by = "built-in motions" if built_in else "runs"
    beyond = judged.beyond if judged.beyond is not None and judged.beyond.records >= LEAST else None
    near = judged.near
    conditions = []
    if not judged.friction_known and decision.verdict != "no-answer":
        conditions.append(f"friction at least {number(judged.friction.largest)}")
        if judged.friction_of_rate is not None:
            need = number(judged.friction_of_rate.largest)
            conditions.append(f"friction at least {need} for the rate")
    return [
        Fact("verdict", decision.verdict),
        Fact("reason", decision.reason or None),
        Fact("doubts", list(decision.doubts)),
        Fact("conditions", conditions),
        Fact("by", by),
        Fact("share", 0.0 if stands else count and number_or_none(count.share)),
        Fact("low", low),
        Fact("high", high),
        Fact("share_1_1", beyond and number_or_none(beyond.share)),
        Fact("records", 0 if judged.count is None else judged.count.records),
        Fact("runs", 0 if judged.count is None else judged.count.runs),
        Fact("fall", 0 if judged.count is None else judged.count.falls),
        Fact("without_answer", 0 if judged.count is None else judged.count.without),
        Fact("lifted", judged.lifted),
        Fact("share_near", near.share if near and near.records >= LEAST else None),
        Fact("records_near", near and near.records),
        Fact("median_scale", None if shaking is None else median_fold(shaking.scales)),
        Fact("median_stretch", None if shaking is None else median_fold(shaking.stretches)),
        Fact("largest_stretch", None if shaking is None else float(folds(shaking.stretches).max())),
        Fact("stretched", shaking is not None and shaking.stretched),
        Fact("friction_needed", judged.friction.largest),
        Fact("friction_cause", judged.friction.cause),
        *_rate_facts(judged),
    ]


def _rate_facts(judged: Judged) -> list[Fact]:
    """Return the rate of falling in JSON; None where it is not known."""
    risk, need = judged.risk, judged.friction_of_rate
    known = risk if risk is not None and risk.is_known else None
    low, high = known.band if known and known.band else (None, None)
    return [
        Fact("no_rate", judged.no_rate or None),
        Fact("rate_per_year", known and known.annual_rate),
        Fact("rate_low", low),
        Fact("rate_high", high),
        Fact("rate_outside", risk and risk.outside),
        Fact("rate_unknown", risk and number_or_none(risk.unknown)),
        Fact("probability_50_years", known and known.probability),
        Fact("friction_needed_of_rate", need and need.largest),
    ]


def demand_facts(shaking: Shaking | None, demand: Demanded | None, words: str) -> list[Fact]:
    """Return a demand, None of several, and how motions lie on its spectrum."""
    kind = None if demand is None else "peaks" if isinstance(demand, Peaks) else "spectrum"
    values = demand.values if isinstance(demand, DesignSpectrum) else None
    if shaking is not None and shaking.placing is not None:
        values = shaking.placing.values
    return [
        Fact(
            "demand",
            {"kind": kind, "words": words},
            "demand",
            words,
        ),
        Fact("spectrum", values),
    ]


def target_facts(target: Target) -> list[Fact]:
    """Return a target in JSON and in words."""
    at_demand = target.years is None
    return [
        Fact("target_probability", target.share if at_demand else None, "target", target.words),
        Fact("target_50_years", None if at_demand else target.share),
    ]


def where_words(described: DescribedObject, shaking: Shaking | None) -> str:
    """Return the demand of an object in words after a verb, as far as its motions have it."""
    demand = demand_of(described)
    words = demand.where
    if shaking is not None and not shaking.stretched and demand.kept:
        words = f"{Peaks(pga_g=demand.pga_g).where} with each record's own PGV"
    if described.on_floor:
        words += " of ground motion"
    if vertical := described.demand.vertical_words:
        words += f" with {vertical}"
    return words


def screen_of(described: DescribedObject, judged: Judged, suite: Suite) -> Screen:
    """Return sentence and lines of an object."""
    friction = described.given.friction
    return Screen(
        judged,
        target=described.target,
        friction=None if friction is None else bounds_of(friction)[0],
        where=where_words(described, judged.shaking),
        suite=suite,
        on_floor=described.on_floor,
        of_floor=described.given.demand.place == "floor",
        idle_spectrum=described.spectrum is not None and not described.is_on_spectrum,
    )


@checked
def assess_object(
    described: DescribedObject,
    motions: Sequence[Record | BaseMotion] | Suite | None = None,
    *,
    buildings: Sequence[Building] = (),
    floor: Floor | None = None,
    stretch: bool = True,
    hazard: HazardCurve | None = None,
    run: Execution | None = None,
) -> Assessment:
    """Count the runs in which an object falls at its demand, and judge what that shows.

    Every motion is given both peaks of the demand, or placed on its design spectrum: its
    accelerations are multiplied, its time axis is stretched.  All are run by the full equations,
    with restitutions of a band; the answer is the share that falls, with its 90 % interval.

    Parameters
    ----------
    described
        The object, with a spectrum or one peak of its demand at least.
    motions
        Records of the ground, with a vertical one beside them as `BaseMotion`; by default those of
        `make_built_in_suite`, which no earthquake made and which are never green.
    buildings
        Building of the object, whose floor it then stands on; the motions and its demand are those
        of the ground.  None by default.
    floor
        Floor of an object that states none; None (default) for the ground.
    stretch
        Whether time is stretched (default); else motions are scaled to the PGA alone.
    hazard
        Hazard curve of the site, over the PGA or the PGV of the ground; with it the annual rate of
        falling is summed, which a target in 50 years needs.  None by default.
    run
        Executor, workers, store and progress of the ensemble; default `Execution()`.

    Returns
    -------
    Assessment
        With the fragility and its runs.

    Raises
    ------
    InputError, ModelError
        If the object states no peak, or one alone without motions, a motion is of another type, the
        object's building is not given or has no such floor, or the hazard curve is over another
        measure or missing.

    Examples
    --------
    >>> from rocksteady import assess_object
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> cabinet = DescribedObject(
    ...     values={
    ...         "name": "cabinet",
    ...         "friction": 0.1,
    ...         "geometry": {"width_m": 0.4, "height_m": 1.8},
    ...         "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
    ...     }
    ... )
    >>> assessment = assess_object(cabinet, make_synthetic_suite(2))
    >>> assessment.verdict, assessment.share is None
    ('slides', True)
    """
    began = time.perf_counter()
    site = site_of(described, hazard, stretch=stretch)
    placed = place_objects([described], motions, buildings, floor=floor, stretch=stretch)
    (standing,) = placed.objects
    inner = None if run is None else replace(run, store=None, progress=None)
    (judged,) = judge_objects(placed, run=inner)
    facts = compute_object_facts(standing)
    friction = None if standing.given.friction is None else bounds_of(standing.given.friction)[0]
    kind = KINDS.get(standing.given.kind.strip().lower())
    assessment = Assessment(
        described=standing,
        facts=facts,
        screens=screen_block(facts.block, standing.demand, friction=friction, object_kind=kind),
        judged=judged,
        suite=placed.suite,
    )
    built_in, shaking = placed.suite.built_in, judged.shaking
    if shaking is not None and is_curved(judged, site, curves=True):
        fragility = curve_of(standing, shaking, site, run)
        if is_helped(judged, standing, built_in=built_in):
            (remedies,) = remedies_of([(standing, shaking)], run=inner)
            judged = replace(judged, remedies=remedies)
        if site is not None:
            judged = with_rate(standing, judged, fragility, site, built_in=built_in)
        assessment = replace(
            assessment,
            judged=judged,
            fragility=fragility,
            cases=() if judged.stands else vary(standing, shaking, run=inner),
        )
    elif site is not None:
        assessment = replace(assessment, judged=without_rate(standing, judged))
    return replace(assessment, seconds=time.perf_counter() - began)
