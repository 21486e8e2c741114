"""Checks of a facade side by side: each limit state by each method, and why methods disagree."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final, Literal

from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_demand import FacadeDemand, LimitState
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.checks.mechanism import SHARE_SLV, Mechanism
from rocksteady.facades.checks.remark import Remark
from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import length, number, plural, quantity
from rocksteady.results.result import Result

Method = Literal["linear", "nonlinear static", "dynamic"]

PAGES: Final = "272-277"
"""Pages of the circular."""
IN_TABLE: Final = ("no_demand", "q", "mean_of_runs", "eta")
"""Remarks that a text leaves out: its table shows them, or they follow from a formula."""
MECHANISM: Final = (Column("name", "quantity", left=True), Column("value", "value", left=True))
"""Columns of the table of the mechanism."""


KEYS = (
    "limit_state", "method", "formula", "page", "demand_name", "capacity_name", "unit", "demand",
    "capacity", "satisfied", "remark",
)  # fmt: skip
"""Columns of a row of JSON and CSV."""


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
        parts = [f"{_joined(states)} {words}" for words, states in outcomes.items()]
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

    def describe(self) -> Description:
        """Return the verdict, a row for each check, the mechanism, the reasons and remarks."""
        mechanism = self.mechanism.describe()
        rows = [_row(check) for check in self.checks]
        shown = [
            {
                **row,
                "check": check.name,
                "compared": f"{check.demand_name} <= {check.capacity_name}",
                "demand": _words(check, check.demand),
                "capacity": _words(check, check.capacity),
            }
            for check, row in zip(self.checks, rows, strict=True)
        ]
        columns = [
            Column("check", "check", left=True),
            Column("compared", "compared", left=True),
            Column("demand", "demand"),
            Column("capacity", "capacity"),
            Column("satisfied", "satisfied"),
        ]
        # People read the checks first: the facts are a table below them.
        facts = [replace(fact, label="") for fact in mechanism.facts]
        facts.append(Fact("verdict", self.sentence))
        facts.append(Fact("ending", [each.name for each in self.facade.ending]))
        curve = [{"displacement_m": d, "capacity_g": a} for d, a in self.mechanism.curve]
        sizes = [
            {"name": fact.label, "value": fact.words}
            for fact in mechanism.facts
            if fact.label and fact.key not in ("name", "d_slv_m", "d_slc_m")
        ]
        if self.runs is not None:
            facts.append(Fact("runs", self.runs.describe().to_dict()))
        sentence, screen, decided = self._answer()
        return Description(
            headline=self.verdict,
            facts=[*screen, *facts],
            tables=[
                Table("checks", rows),
                Table("", shown, columns),
                Table("", sizes, MECHANISM, title="Mechanism"),
                Table("capacity_curve", curve),
            ],
            notes=[*map(str, self.reasons), *self._of_checks(), *map(str, self.remarks)],
            sentence=sentence,
            rows=decided,
        )

    def _answer(self) -> tuple[str, list[Fact], list[tuple[str, str]]]:
        """Return the verdict, the checks, and runs beyond d0."""
        decided = [check for check in self.checks if check.satisfied is not None]
        decided.sort(key=lambda check: (check.satisfied is True, -_ratio(check)))
        sentence = self.verdict
        if not decided:
            sentence = "No answer yet: no check has a demand, capacity alone is known"
        refused = [
            str(remark)
            for check in self.checks
            for remark in check.remarks
            if check.satisfied is None and remark.key == "weak_records"
        ]
        sentence += "; no verdict by runs" if refused and decided else ""
        if self.runs is not None and self.runs.refusal is not None:
            refused = [self.runs.refusal]
        facts = [line("runs", " ".join(refused))]
        if self.runs is not None and self.runs.beyond:
            records = plural(len(self.runs.records), "record")
            facts.append(line("beyond d0", f"runs under {len(self.runs.beyond)} of {records}"))
        if self.runs is None:
            d0, slv = length(self.mechanism.d0_m), length(self.mechanism.d_slv_m)
            facts.append(line("d0", f"{d0}, and d_SLV = {SHARE_SLV:g} d0 = {slv}"))
        open_states = {each.limit_state: None for each in self.checks if each.satisfied is None}
        missing = _joined([each for each in open_states if each not in self.states])
        facts.append(line("no demand", f"for {missing}" if missing else ""))
        facts.append(line("not counted", ", ".join(each.name for each in self.facade.ending)))
        rows = [(each.name, self._compared(each)) for each in decided]
        return f"{sentence}.", facts, rows

    def _compared(self, check: LimitStateCheck) -> str:
        """Return demand and capacity of a check with their names and their ratio."""
        if check.demand == math.inf:
            return f"beyond d0 = {length(self.mechanism.d0_m)}: not satisfied"
        demand = f"{check.demand_name} {_words(check, check.demand)}"
        capacity = f"{check.capacity_name} {_words(check, check.capacity)}"
        ratio = number(_ratio(check), 2)
        return f"{demand} of {capacity} ({ratio}){'' if check.satisfied else ': not satisfied'}"

    def _of_checks(self) -> Iterator[str]:
        """Yield how demands were made, as far as the table does not show it."""
        missing = [
            check.limit_state
            for check in self.checks
            if any(remark.key == "no_demand" for remark in check.remarks)
        ]
        if missing:
            yield f"No demand is given for {_joined(list(dict.fromkeys(missing)))}: capacity alone."
        for check in self.checks:
            words = "; ".join(str(each) for each in check.remarks if each.key not in IN_TABLE)
            if words:
                yield f"{check.name}: {words}."


def _row(check: LimitStateCheck) -> dict[str, object]:
    """Return a check as plain values."""
    row = {key: getattr(check, key) for key in KEYS}
    return {**row, "demand": None if check.demand == math.inf else check.demand}


def _ratio(check: LimitStateCheck) -> float:
    """Return demand over capacity of a check with a demand."""
    assert check.ratio is not None
    return check.ratio


def _texts(*values: float) -> tuple[str, ...]:
    """Return numbers as a remark has them."""
    return tuple(f"{value:.3g}" for value in values)


def _listed(checks: tuple[LimitStateCheck, ...]) -> str:
    """Return the methods of checks."""
    return ", ".join(check.method for check in checks)


def _joined(names: list[str]) -> str:
    """Return an enumeration."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _words(check: LimitStateCheck, value: float | None) -> str:
    """Return a demand or a capacity of a check as people read it."""
    if value is None:
        return "—"
    if value == math.inf:
        return "beyond d0"
    return quantity(value, "g") if check.unit == "g" else length(value)
