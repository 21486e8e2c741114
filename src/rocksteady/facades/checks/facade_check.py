"""Checks of a facade side by side: each limit state by each method, and why methods disagree."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal

from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_demand import FacadeDemand, LimitState
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.checks.mechanism import Mechanism
from rocksteady.facades.checks.remark import Remark
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.result import Result

Method = Literal["linear", "nonlinear static", "dynamic"]

PAGES: Final = "272-277"
"""Pages of the circular."""


@checked_result
@dataclass(frozen=True, kw_only=True)
class LimitStateCheck:
    """One check of a facade: a limit state by a method.

    Attributes
    ----------
    limit_state
        "SLD", "SLV" or "SLC".
    method
        "linear", "nonlinear static" or "dynamic".
    formula
        Number of the formula or of the paragraph of the circular.
    page
        Its pages.
    demand_name, capacity_name
        Symbols of what is compared, as "S_D(T_SLV)" and "d_SLV".
    unit
        Unit of both: "g" of an acceleration, "m" of a displacement.
    demand
        Demand of the earthquake; None without a demand, infinite with a run beyond d0.
    capacity
        Capacity of the facade.
    satisfied
        Whether the demand is at most the capacity; None without a demand.
    remarks
        How the demand was made, or why there is none.
    """

    limit_state: LimitState
    method: Method
    formula: str
    page: str = PAGES
    demand_name: str
    capacity_name: str
    unit: Literal["g", "m"]
    demand: float | None
    capacity: float
    satisfied: bool | None
    remarks: tuple[Remark, ...] = ()

    @property
    def name(self) -> str:
        """Limit state and method, as "SLV dynamic"."""
        return f"{self.limit_state} {self.method}"

    @property
    def remark(self) -> str:
        """The remarks in English."""
        return "; ".join(map(str, self.remarks))

    @property
    def ratio(self) -> float | None:
        """Demand over capacity; None without a demand."""
        return None if self.demand is None else self.demand / self.capacity


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FacadeCheck(Result):
    """Checks of a facade by Circolare 2019 n. 7, C8.7.1, from `rocksteady.check_facade`.

    Attributes
    ----------
    facade, demand, runs
        Facade, demand and runs under records; None without.
    checks
        One for each limit state and method.
    """

    facade: Facade
    demand: FacadeDemand
    runs: FacadeRuns | None
    checks: tuple[LimitStateCheck, ...]

    @property
    def mechanism(self) -> Mechanism:
        """Overturning of the facade about its hinge."""
        return self.facade.mechanism

    def decided(self, limit_state: LimitState, satisfied: bool) -> tuple[LimitStateCheck, ...]:
        """Return the satisfied or the failed checks of a limit state.

        Parameters
        ----------
        limit_state
            "SLD", "SLV" or "SLC".
        satisfied
            True for satisfied checks, False for failed ones.
        """
        return tuple(
            check
            for check in self.checks
            if check.limit_state == limit_state and check.satisfied is satisfied
        )

    @property
    def states(self) -> tuple[LimitState, ...]:
        """The limit states with a verdict."""
        states = {check.limit_state: None for check in self.checks if check.satisfied is not None}
        return tuple(states)

    @property
    def reasons(self) -> tuple[Remark, ...]:
        """Why the methods disagree on a limit state; none where they agree."""
        return tuple(dict.fromkeys(self._reasons()))

    def _reasons(self) -> Iterator[Remark]:
        for state in self.states:
            passing = {check.method for check in self.decided(state, True)}
            failing = {check.method for check in self.decided(state, False)}
            pair = {"nonlinear static", "dynamic"}
            if pair <= passing | failing and not (pair <= passing or pair <= failing):
                period = self.mechanism.t_slc_s if state == "SLC" else self.mechanism.t_slv_s
                damping = "10" if state == "SLC" else "8"
                yield Remark("static_or_dynamic", (f"{period:.3g}", damping))
            if passing and failing and "linear" in passing | failing:
                free = self.facade.free
                yield Remark("free_or_displacement" if free else "linear_or_displacement")

    @property
    def verdict(self) -> str:
        """Outcome of each limit state, in a line; the methods where they disagree."""
        outcomes: dict[str, list[str]] = {}
        for state in self.states:
            passed, failed = self.decided(state, True), self.decided(state, False)
            if passed and failed:
                words = f"satisfied ({_listed(passed)}), not satisfied ({_listed(failed)})"
            else:
                words = "satisfied" if passed else "not satisfied"
            outcomes.setdefault(words, []).append(state)
        parts = [f"{enumerated(states)} {words}" for words, states in outcomes.items()]
        if self.runs is not None and not self.runs.enough:
            parts.append("no verdict by dynamic, which needs 7 records or more")
        return f"{self.facade.name}: {'; '.join(parts) or 'capacity alone, without a demand'}"

    @property
    def sentence(self) -> str:
        """The verdict, and why methods disagree where they do."""
        return " ".join([f"{self.verdict}.", *map(str, self.reasons)])

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """What a reader must know of the formulas."""
        mechanism, facade = self.mechanism, self.facade
        readings = (
            mechanism.a0_g,
            mechanism.e_star,
            mechanism.a0_lumped_g,
            mechanism.e_star_lumped,
        )
        remarks = []
        if facade.ending:
            names = ", ".join(each.name for each in facade.ending)
            remarks.append(Remark("ending", (names,)))
        key = "e_star_free" if facade.free else "e_star"
        remarks.append(
            Remark(key, _texts(*readings, *([mechanism.linear_g] if facade.free else [])))
        )
        if facade.kind == "gable" and not facade.free:
            remarks.append(Remark("gable_top"))
        remarks += [Remark("standard"), Remark("second_conditions")]
        if self.runs is not None:
            starts = (mechanism.uplift_g, mechanism.run_activation_g, mechanism.a0_g)
            remarks.append(Remark("uplift", _texts(*starts)))
            if facade.free:
                remarks.append(Remark("rigid_runs"))
            if facade.loads or facade.masses or facade.ties or facade.thrusts:
                remarks.append(Remark("in_line"))
        return tuple(remarks)


def _texts(*values: float) -> tuple[str, ...]:
    """Return numbers as a remark has them."""
    return tuple(f"{value:.3g}" for value in values)


def _listed(checks: tuple[LimitStateCheck, ...]) -> str:
    """Return the methods of checks."""
    return ", ".join(check.method for check in checks)


def enumerated(names: list[str]) -> str:
    """Return an enumeration."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
