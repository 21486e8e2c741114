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
from rocksteady.results.result import Result, words_module
from rocksteady.risk.assess._remedies import is_helped, remedies_of
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.facts import ObjectFacts, compute_object_facts
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.judging import Judged, judge_objects
from rocksteady.risk.assess.placed_objects import place_objects
from rocksteady.risk.assess.rates import curve_of, is_curved, site_of, with_rate, without_rate
from rocksteady.risk.assess.remedy import Remedy
from rocksteady.risk.assess.sensitivity import Case, bars_of, vary
from rocksteady.risk.counted.suite import Suite
from rocksteady.risk.counted.verdict import CODES, Decision, Target
from rocksteady.risk.ensemble.qualification import forces_of_rocking, most_of_rocking
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard.failure_risk import Risk
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.screens.screen import KINDS
from rocksteady.risk.screens.screens import Screens, screen_block
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
        words = words_module(Assessment)
        sentence: str = words.screen_of(self.described, self.judged, self.suite).sentence
        return sentence

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
