"""The whole assessment of one object: screens, ensemble, fragility, sensitivity, risk, remedies."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.confidence import CONFIDENCE
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Description, Fact
from rocksteady.results.doubts import MOST_MISFIT, counted_otherwise, misfit_words
from rocksteady.results.numbers import (
    chance,
    counted,
    force_words,
    interval,
    number,
    number_or_none,
    quantity,
)
from rocksteady.results.result import Result
from rocksteady.risk.assess._answers import answer_of_object
from rocksteady.risk.assess._assessment_tables import tables_of
from rocksteady.risk.assess._counts import MULTIPLES, Basis, count_runs, is_fitted
from rocksteady.risk.assess._demand_level import DemandLevel, demand_level, measured
from rocksteady.risk.assess._probability import (
    NO_ANSWER,
    Probability,
    fit_fragilities,
    is_outside,
    onset_of,
    probability_of,
)
from rocksteady.risk.assess._remedies import Remedy, Search, cheapest, find_remedies
from rocksteady.risk.assess._sensitivity import (
    Case,
    by_one_method,
    tornado,
    vary,
)
from rocksteady.risk.assess._verdicts import MET, Findings, answer_of
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.building import Building, on_floors
from rocksteady.risk.assess.described.facts import ObjectFacts, compute_object_facts
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of, parameter_words
from rocksteady.risk.assess.described.schema import Options, own_states
from rocksteady.risk.ensemble.contact_levels import words_of_shorter
from rocksteady.risk.ensemble.gates import GIVEN_UPLIFT, uplift_of
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.qualification import (
    OF_ROCKING,
    forces_of_rocking,
    most_of_rocking,
    rocking_words,
    runs_near,
)
from rocksteady.risk.fits.bands import BandOptions
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve, fit_two_stages
from rocksteady.risk.fragility.damage_states import OVERTURNED, DamageState
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard.failure_risk import Risk, compute_risk
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.screens.screen import KINDS
from rocksteady.risk.screens.screens import Screens, screen_block
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


WHOLE_CURVE = "of the curve through all levels."
"""What a probability is of that is not counted."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Assessment(Result):
    """Assessment of an object, from `rocksteady.assess_object`.

    Attributes
    ----------
    described, facts, screens
        The object, what follows from its geometry, and published formulas side by side.
    friction_needed
        Friction with which it rocks without sliding at the demand's PGA; None without a PGA.
    friction_cause
        What needs that friction: "uplift" or "impacts"; None without a PGA.
    demand
        The demand in words.
    verdict
        "stands": the PGA does not lift it; "slides": rocking is no answer; "undecided": no run
        lifts at the demand; "below target" or "above target" of the probability.
    colour
        "green", "amber" or "red" of the probability; "grey" where there is none.
    sentence, reason
        The answer and why.
    probability, probability_band
        Probability of falling at the demand, and its interval of 90 % over records: of a curve by
        resampling them, of a count Wilson's of as many trials as there are records; None where
        there is none.
    by_curve
        The probability by the fitted curve, which is `probability` unless the share of the runs at
        the demand is more than 10 points above it; None without a curve.
    basis, method
        What the probability is from: "curve", "count" (of the runs at the demand) or "statics" (the
        demand does not lift it), None where it slides; and the same in words.
    fragility
        Curves of all damage states, with the runs; None where it slides.
    cases
        One thing changed at a time; the first is the object as described.
    remedies
        Width, ballast and friction cap, the least change first.
    risks
        Annual rate of falling for each hazard curve.
    motions
        The motions, as they were given.
    seconds
        Time that it took [s].
    """

    described: DescribedObject
    facts: ObjectFacts
    screens: Screens
    friction_needed: float | None
    friction_cause: str | None
    demand: str
    verdict: str
    colour: str
    sentence: str
    reason: str
    probability: float | None = None
    probability_band: tuple[float, float] | None = None
    by_curve: float | None = None
    basis: Basis | None = None
    method: str = ""
    fragility: Fragility | None = None
    cases: tuple[Case, ...] = ()
    remedies: tuple[Remedy, ...] = ()
    risks: tuple[Risk, ...] = ()
    motions: tuple[Record | BaseMotion, ...] = ()
    seconds: float = 0.0

    @property
    def model(self) -> Model | None:
        """Equations of motion of the runs; None where it slides."""
        return None if self.fragility is None else self.fragility.model

    @property
    def curve(self) -> FragilityCurve | TwoStageCurve | None:
        """The fragility curve of overturning; None where it slides."""
        return None if self.fragility is None else self.fragility.state(OVERTURNED).curve

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences on a curve that is extrapolated, or misses its shares or the count."""
        if self.curve is None or not self.probability:
            return ()
        poor = misfit_words(self.curve.misfit)
        sentences = [self.beyond] if self.beyond else []
        sentences += [f"The curve of falling is a {poor}."] if poor else []
        case = self.cases[0]
        if self.by_curve is not None and counted_otherwise(self.by_curve, case.counted):
            sentences.append(
                f"{counted(case.fell, f'{case.trials:,} runs')} at the demand, "
                f"{chance(case.counted, case.trials)}: "
                f"the curve's {number(100.0 * self.by_curve)} % is more than "
                f"{100.0 * MOST_MISFIT:g} points from that."
            )
        share = self.by_both_peaks
        if share is not None and counted_otherwise(self.probability, share):
            sentences.append(
                f"By PGA and PGV together {chance(share)} fall: more than "
                f"{100.0 * MOST_MISFIT:g} points from that of {self.level.measure.label} alone."
            )
        return tuple(sentences)

    @property
    def by_both_peaks(self) -> float | None:
        """The probability by the surface over PGA and PGV at the demand; None without both."""
        if self.fragility is None or self.probability is None or self.verdict == "stands":
            return None
        demand = self.described.given.demand
        return self.fragility.by_both_peaks(demand.pga_g, demand.pgv_m_s)

    @cached_property
    def level(self) -> DemandLevel:
        """The demand as a level of the measure of its curves."""
        given = self.described.given
        measure = Measure(given.assessment.intensity_measure, given.assessment.period_s)
        block, source = self.facts.block, self.described.source
        return demand_level(measure, given.demand, self.motions, block, source)

    @property
    def beyond(self) -> str:
        """A sentence where the curve is extrapolated to the demand; empty where it is not."""
        block = self.facts.block
        if self.fragility is None or self.basis != "curve":
            return ""
        if not is_outside(self.fragility, self.level, block):
            return ""
        measure = self.fragility.measure
        level = self.level.of(measure, block)
        low, high = self.fragility.state(OVERTURNED).curve.sampled
        return (
            f"The demand, {measure.label} {number(level)} {measure.unit}".rstrip()
            + f", lies outside the levels of the runs, {number(low)} to {number(high)}: the "
            "probability there is that of the curve alone."
        )

    @cached_property
    def qualification(self) -> dict[str, float | None]:
        """Top and clearance [m] and edge speed [m/s] of most runs that rock and stand.

        84 % of them do not exceed it, at the level of its runs nearest to the demand; empty where
        there are none.
        """
        runs = self._at_demand
        return {} if runs is None else most_of_rocking(runs)

    @cached_property
    def base_force_kn(self) -> tuple[float, float] | None:
        """Horizontal and vertical force on the base [kN] of most runs that rock and stand.

        84 % of one run under each motion, at the level of `qualification` and with the object's
        own restitution, do not exceed them.  None without the object's mass, or such runs.
        """
        runs, facts = self._at_demand, self.facts
        if runs is None:
            return None
        (force,) = forces_of_rocking([runs], [facts.block], self.motions, [facts.mass_kg])
        return force

    @property
    def _at_demand(self) -> "xarray.Dataset | None":
        """The runs of the level nearest to the demand; None where there are none."""
        if self.fragility is None or self.verdict == "stands":
            return None
        return runs_near(
            self.fragility.ensemble, self.level.of(self.fragility.measure, self.facts.block)
        )

    @property
    def meets_target(self) -> bool:
        """Whether the object stands, or is below the target."""
        return self.verdict in MET

    @property
    def pgv_percentile(self) -> float | None:
        """Share of the motions below the stated PGV, scaled to the stated PGA [%]; None without."""
        demand = self.described.given.demand
        if demand.pga_g is None or demand.pgv_m_s is None or not self.motions:
            return None
        ratios = measured(self.motions, Measure("pgv_per_pga_s")) * STANDARD_GRAVITY
        return 100.0 * float((ratios * demand.pga_g < demand.pgv_m_s).mean())

    @property
    def scope_words(self) -> str:
        """Which published formulas stand beside the answer, and a kind that chooses none."""
        kind = self.described.given.kind
        words = f"Published formulas, {': '.join(self.screens.scope)}."
        if self.screens.kind is not None or kind == "other":
            return words
        return f"Kind {kind!r} chooses no formulas; {', '.join(KINDS)} do. {words}"

    @property
    def percentile_words(self) -> str:
        """The same in words; empty without."""
        if self.pgv_percentile is None:
            return ""
        peaks = self.described.given.demand
        pga, pgv = quantity(peaks.pga_g or 0.0, "g"), quantity(peaks.pgv_m_s or 0.0, "m/s")
        return f"at {pga} a PGV of {pgv} is percentile {self.pgv_percentile:.0f} of the motions"

    @property
    def both_peaks_words(self) -> str:
        """The probability by both peaks, and what they explain of the runs; empty without."""
        if self.by_both_peaks is None or self.fragility is None:
            return ""
        return f"{chance(self.by_both_peaks)}; together they {self.fragility.surface_words}"

    @property
    def case_probabilities(self) -> list[float]:
        """Probability of each case, all by the method of the answer."""
        return by_one_method(self.cases, self.basis)

    @property
    def bars(self) -> list[tuple[str, float, float]]:
        """Parameter, lowest and highest probability, the widest first, as a tornado plot takes."""
        rows = tornado(self.cases, self.basis) if self.cases else []
        return [(parameter_words(row["parameter"]), row["low"], row["high"]) for row in rows]

    def describe(self) -> Description:
        """Return the sentence, facts, screens, sensitivity, remedies, risk, caveats and inputs."""
        facts = self.facts.describe()
        return Description(
            headline=self.sentence,
            facts=[*self._answer(), *(fact for fact in facts.facts if fact.key != "name")],
            tables=tables_of(
                self.screens, self.cases, self.basis, self.remedies, self.risks, self.motions
            ),
            notes=[*self.facts.warnings, *self._warnings(), *CAVEATS, self.scope_words],
            answer=answer_of_object(self),
        )

    def _answer(self) -> list[Fact]:
        """Return the facts of the answer."""
        of = self.cases[0].trials if self.basis == "count" else 0
        share = chance(self.probability, of)
        doubts = self.doubts
        share += interval(self.probability_band, CONFIDENCE)
        curve = self.curve
        target = self.described.given.assessment.target_probability
        facts = [
            Fact("name", self.described.name, "object"),
            Fact("verdict", self.verdict, "verdict", f"{self.verdict} ({self.colour})"),
            Fact("colour", self.colour),
            Fact("sentence", self.sentence),
            Fact("doubts", list(doubts)),
            *(Fact("", label="doubt", text=text) for text in doubts),
            Fact("reason", self.reason, "why"),
            Fact("probability", self.probability, "probability", share),
            Fact("probability_band", self.probability_band and list(self.probability_band)),
            Fact("by_curve", self.by_curve),
            Fact("by_both_peaks", self.by_both_peaks, "by PGA and PGV", self.both_peaks_words),
            Fact("basis", self.basis),
            Fact("method", self.method, "from", self.method),
            Fact("target_probability", target, "target", f"{number(100.0 * target)} %"),
            *(Fact("", label=each.name, text=each.result) for each in self.remedies),
            Fact("demand", self.demand, "demand"),
            Fact("vertical_g", self.described.demand.vertical_g),
            Fact("vertical_share", self.described.demand.vertical_share),
            Fact("friction_cause", self.friction_cause),
            Fact(
                "pgv_percentile",
                self.pgv_percentile,
                "PGV of the demand" if self.percentile_words else "",
                self.percentile_words,
            ),
            Fact("friction_needed", self.friction_needed),
        ]
        if self.friction_needed is not None:
            words = f"{number(self.friction_needed)} or more, to rock without sliding at the demand"
            if self.friction_cause == "impacts":
                words += ", for impacts"
            facts[-1] = Fact("friction_needed", self.friction_needed, "friction needed", words)
        if self.fragility is not None and curve is not None:
            median = float(curve.median)
            measure = self.fragility.measure
            words = f"{measure.label} {number(median)} {measure.unit}".rstrip()
            words += f", {GIVEN_UPLIFT}" * measure.given_uplift
            facts += [
                Fact("median", number_or_none(median), "half fall at", words),
                Fact("measure", measure.key),
                Fact("records", self.fragility.records, "records"),
                Fact("runs", self.fragility.runs, "runs"),
                Fact("model", self.fragility.model.name, "model"),
            ]
        words = rocking_words(self.qualification) if self.qualification else ""
        shown = ("top moves", words) if words else ("", "")
        facts.append(Fact("qualification", self.qualification or None, *shown))
        force = self.base_force_kn
        shown = (
            ("force on base", f"{force_words(force, 'kN')}, {OF_ROCKING}") if force else ("", "")
        )
        facts.append(Fact("base_force_kn", force and list(force), *shown))
        return [*facts, Fact("seconds", self.seconds)]

    def _warnings(self) -> list[str]:
        """Return what limits the fits, and what was noted of risk."""
        warnings = [] if self.fragility is None else list(self.fragility.warnings)
        if self.fragility is not None:
            unknown = self.described.given.demand.pga_g is None
            if self.fragility.measure.given_uplift and unknown:
                lift = quantity(self.facts.uplift_pga_g, "g")
                peak = "that of the floor" if self.described.on_floor else "it"
                warnings.append(
                    f"No PGA is given: the probability holds where {peak} is above {lift}."
                )
            last = float(self.fragility.ensemble["level"].values[-1])
            levels = Levels(self.fragility.measure)
            warnings += words_of_shorter(levels, [self.facts.block], last)
        if self.described.demand.vertical_at_peak_g:
            warnings.append(
                "The vertical motion of the demand decides on uplift and sliding; the runs have "
                "that of the records, where there is any."
            )
        if self.cases and self.curve is not None and not is_fitted(self.curve):
            warnings.append(
                "No curve of falling can be fitted to these runs: the probability is the share of "
                "the runs at the demand."
            )
        elif self.cases and self.probability:
            warnings.append(
                "What matters is fitted to runs at "
                f"{MULTIPLES[0]:g} to {MULTIPLES[-1]:g} times the demand alone, which give "
                f"{chance(self.cases[0].probability)} for the object as described; the "
                "probability is "
                + ("the share at the demand." if self.basis == "count" else WHOLE_CURVE)
            )
        warnings += [note for risk in self.risks for note in risk.describe().notes]
        return list(dict.fromkeys(filter(None, warnings)))


@checked
def assess_object(
    described: DescribedObject,
    motions: Sequence[Record | BaseMotion],
    *,
    buildings: Sequence[Building] = (),
    hazard: HazardCurve | Sequence[HazardCurve] | None = None,
    run: Execution | None = None,
) -> Assessment:
    """Compute the probability that an object falls, its sensitivity, and remedies.

    The steps of practice: check and derive; uplift and sliding first, and where friction governs no
    probability is given; published formulas side by side; an ensemble of runs by the full
    equations; fragility; one thing changed at a time; risk under hazard curves; remedies, each by
    runs of the changed object at all levels.

    Parameters
    ----------
    described
        The object.
    motions
        Records of the ground or the floor, with a vertical one beside them as `BaseMotion`.
    buildings
        Building of the object, whose floor it then stands on; the motions and its demand are those
        of the ground.  None by default.
    hazard
        A hazard curve or several; none by default.
    run
        Executor, workers, store and progress of the ensemble; default `Execution()`.

    Returns
    -------
    Assessment
        With the fragility and its runs.

    Raises
    ------
    InputError, ModelError
        If a measure needs a demand that the object does not state, a motion is of another type, or
        the object's building is not given or has no such floor.

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
    >>> assessment.verdict, assessment.probability is None
    ('slides', True)
    """
    began = time.perf_counter()
    curves = [hazard] if isinstance(hazard, HazardCurve) else [*(hazard or ())]
    suite = [*motions]
    if not suite:
        raise InputError("motions", [], "an assessment needs motions", "give records")
    (described,), (shaken,) = on_floors([described], suite, buildings)
    suite, given = [*shaken], described.given
    facts = compute_object_facts(described)
    block = facts.block
    intensity = Measure(given.assessment.intensity_measure, given.assessment.period_s)
    level = demand_level(intensity, given.demand, suite, block, described.source)
    friction = None if given.friction is None else bounds_of(given.friction)[0]
    kind = KINDS.get(given.kind.strip().lower())
    screens = screen_block(block, described.demand, friction=friction, object_kind=kind)
    onset = onset_of(described)
    findings = Findings(
        facts=facts,
        level=level,
        demand=_words_of(described, level),
        onset=onset,
        target=given.assessment.target_probability,
        on_floor=described.on_floor,
    )
    assessment = Assessment(
        described=described,
        facts=facts,
        screens=screens,
        friction_needed=onset.friction_needed and onset.friction_needed.largest,
        friction_cause=onset.friction_needed and onset.friction_needed.cause,
        demand=findings.demand,
        verdict="",
        colour="grey",
        sentence="",
        reason="",
        method=NO_ANSWER.method,
        motions=tuple(suite),
    )
    if not onset.slides:
        assessment, answer = _rocking(assessment, suite, intensity, findings, run)
        assessment = replace(assessment, risks=_risks(assessment, suite, curves))
        findings = replace(
            findings,
            answer=answer,
            cases=assessment.cases,
            remedy=cheapest(assessment.remedies),
        )
    words = answer_of(findings)._asdict()
    return replace(assessment, **words, seconds=time.perf_counter() - began)


def _rocking(
    assessment: Assessment,
    suite: list[Record | BaseMotion],
    intensity: Measure,
    findings: Findings,
    run: Execution | None,
) -> tuple[Assessment, Probability]:
    """Return the assessment with its ensemble, fragility, sensitivity, remedies; and its answer."""
    described, level = assessment.described, findings.level
    inner = None if run is None else replace(run, store=None, progress=None)
    fitting = _fitting(described.given.assessment)
    (fragility,) = fit_fragilities([described], [suite], [intensity], fitting, run=run)
    cases = vary(described, suite, level, run=inner)
    answer = probability_of(
        described, findings.onset, fragility, level, cases[0].counted, cases[0].band
    )
    remedies: tuple[Remedy, ...] = ()
    if answer.value and answer.value > findings.target:
        remedies = find_remedies(Search(described, suite, level, findings.target, inner))
    assessed = replace(
        assessment,
        fragility=fragility,
        cases=cases,
        probability=answer.value,
        probability_band=answer.band,
        by_curve=answer.by_curve,
        basis=answer.basis,
        method=answer.method,
        remedies=remedies,
    )
    return assessed, answer


def _fitting(options: Options) -> FitOptions:
    """Return the damage states of the file, overturning among them."""
    bands = BandOptions(replicates=options.replicates)
    states: list[DamageState | float | str] = [
        name if peak is None else DamageState(name, peak) for name, peak in own_states(options)
    ]
    if not states:
        return FitOptions(bands=bands)
    added = [] if OVERTURNED in states else [OVERTURNED]
    return FitOptions(states=[*states, *added], bands=bands)


def _words_of(described: DescribedObject, level: DemandLevel) -> str:
    """Return the demand in words."""
    given = described.given.demand
    if level.assumed:
        return f"{level.words}, the median of the motions as they are: none is given"
    peaks = [
        quantity(value, unit)
        for value, unit in ((given.pga_g, "g of PGA"), (given.pgv_m_s, "m/s of PGV"))
        if value is not None
    ]
    vertical = described.demand.vertical_words
    words = f"{' and '.join(peaks) or level.words}, of the {given.place}"
    if described.on_floor:
        words += f", up to {number(described.amplified[0])} times that on its floor"
    return f"{words}, with {vertical}" if vertical else words


def _risks(
    assessment: Assessment, suite: list[Record | BaseMotion], curves: list[HazardCurve]
) -> tuple[Risk, ...]:
    """Return the risk under each hazard curve, of a fragility over that curve's own measure."""
    fragility = assessment.fragility
    if fragility is None:
        return ()
    block = assessment.facts.block
    return tuple(
        compute_risk(
            _curve_over(hazard.intensity, fragility.ensemble, suite, block),
            hazard,
            measure=hazard.intensity,
        )
        for hazard in curves
    )


def _curve_over(
    measure: Measure,
    ensemble: "xarray.Dataset",
    suite: list[Record | BaseMotion],
    block: Block,
) -> FragilityCurve | TwoStageCurve:
    """Return the fragility of the same runs over another measure."""
    (counts,) = count_runs(ensemble, [block])
    scale = ensemble["scale"].isel(block=0).transpose("record", "level").values
    at = measured(suite, measure)[:, np.newaxis] * scale
    records = np.broadcast_to(np.arange(len(suite))[:, np.newaxis], at.shape)
    uplifted = uplift_of(
        ensemble, measure, intensity=at, lifted=counts.lifted, trials=counts.trials
    )
    return fit_two_stages(
        at.ravel(),
        uplifted if isinstance(uplifted, float) else uplifted.ravel(),
        counts.fell.ravel(),
        counts.trials.ravel(),
        groups=records.ravel(),
        measure=(measure.label, measure.unit),
    ).over(measure.given_uplift)
