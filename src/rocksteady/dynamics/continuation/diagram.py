"""Bifurcation diagram: branches over a parameter, both sweeps, and the cascade of doublings."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.continuation._branch_facts import (
    bifurcations_table,
    branch_values,
    branches_table,
    cascade_notes,
    cascade_table,
    case_facts,
    case_text,
    extremes,
    point_row,
    point_values,
)
from rocksteady.dynamics.continuation.branches import SAME_PLACE, BranchSearch, find_branches
from rocksteady.dynamics.continuation.cascade import DoublingCascade, longest_cascade
from rocksteady.dynamics.continuation.points import Branch, BranchPoint
from rocksteady.dynamics.history.start import Rest, Start, Steady, initial_march
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep, sweep_attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import bare_block, harmonic
from rocksteady.dynamics.orbits.search import find_orbits
from rocksteady.dynamics.parameters import PARAMETERS, moved_to
from rocksteady.dynamics.steady.states import refuse_asymmetric
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import is_pair, whole_number
from rocksteady.model.equations import OfLinear
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd

Floats = NDArray[np.float64]

PLACES = 9
"""Values over the range at which closed forms are asked for orbits."""
SAME_ANGLE = 1e-5
"""Difference of the highest |u| of one bifurcation on two branches."""
LONGEST_SWEEP = 20_000
"""Values of a sweep; each takes about a millisecond, a motion that does not settle several."""
VALUES = 400
"""Default number of values of a sweep."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Bifurcation:
    """A bifurcation of a diagram.

    Attributes
    ----------
    point
        On the first of the branches that it lies on.
    branches
        Their numbers, from 1.
    highest, lowest
        Extrema of u = theta/alpha; of two mirror images those of the one that leans to the
        positive side.
    """

    point: BranchPoint
    branches: tuple[int, ...]
    highest: float
    lowest: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BifurcationDiagram(OfLinear, Result):
    """Periodic motions over a parameter, with their bifurcations, sweeps and cascade.

    Attributes
    ----------
    block, motion
        What moves, and by what; their own value of the parameter does not count.
    parameter, within
        What moves, and its range.
    search
        Which branches there are.
    branches
        In the order in which they were found: a branch comes after the one it branches off.
    sweeps
        Upwards and downwards; none without values.
    cascade
        The longest; None where no branch comes to a period doubling, or `doublings` is 0.
    complete
        Whether all branches were followed: False where `max_branches` ended the work.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    parameter: str
    within: tuple[float, float]
    search: BranchSearch
    branches: tuple[Branch, ...]
    sweeps: tuple[AttractorSweep, ...]
    cascade: DoublingCascade | None
    complete: bool

    @cached_property
    def points(self) -> tuple[Bifurcation, ...]:
        """Every bifurcation once, with all branches that it lies on."""
        near = SAME_PLACE * (self.within[1] - self.within[0])
        listed: list[Bifurcation] = []
        for place, branch in enumerate(self.branches, start=1):
            for point in branch.bifurcations:
                high, low = extremes(point, branch.lean)
                for index, known in enumerate(listed):
                    if (
                        known.point.type is point.type
                        and abs(self._value(known.point) - self._value(point)) <= near
                        and abs(max(known.highest, -known.lowest) - max(high, -low)) <= SAME_ANGLE
                    ):
                        if place not in known.branches:
                            listed[index] = replace(known, branches=(*known.branches, place))
                        break
                else:
                    listed.append(
                        Bifurcation(point=point, branches=(place,), highest=high, lowest=low)
                    )
        return tuple(listed)

    def _value(self, point: BranchPoint) -> float:
        value: float = getattr(point, self.parameter)
        return value

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield a row a point of each branch, in SI too where the block has a size."""
        for place, branch in enumerate(self.branches, start=1):
            for point in branch.points:
                yield point_row(place, point, branch.lean, self.block)

    @property
    def columns(self) -> list[str]:
        """Names of the values of each row."""
        return next((list(row) for row in self.rows()), ["branch"])

    def to_dataframe(self) -> "pd.DataFrame":
        """Return a row a point of each branch, in SI too where the block has a size."""
        import pandas as pd

        return pd.DataFrame(list(self.rows()), columns=self.columns)

    def describe(self) -> Description:
        """Return the bifurcations, the branches, what the sweeps met, and the cascade."""
        search, parameter = self.search, self.parameter
        points = [
            {
                "branch": each.branches[0],
                "branches": list(each.branches),
                **point_values(each.point, self.branches[each.branches[0] - 1].lean, self.block),
            }
            for each in self.points
        ]
        branches = [
            {"branch": place, **branch_values(branch)}
            for place, branch in enumerate(self.branches, start=1)
        ]
        sweeps = [
            {
                "direction": sweep.direction,
                "start": sweep.start_text,
                "values": len(sweep.values),
                "counts": sweep.values_by_kind(),
                "runs": sweep.run_rows(),
            }
            for sweep in self.sweeps
        ]
        found = (
            f"{plural(len(branches), 'branch').replace('branchs', 'branches')} up to "
            f"{plural(int(search.max_period or 0), 'period')} and "
            f"{plural(search.max_impacts, 'impact')}, {plural(len(points), 'bifurcation')}"
        )
        facts = [
            *case_facts(self.block, self.motion, parameter, self.within),
            Fact("order", search.order),
            Fact("max_period", search.max_period),
            Fact("max_impacts", search.max_impacts),
            Fact("max_branches", search.max_branches),
            Fact("complete", self.complete),
            Fact("", label="found", text=found),
        ]
        tables = [
            bifurcations_table(points, parameter, self.block, key="points"),
            branches_table(branches, parameter),
            *(sweep.table() for sweep in self.sweeps),
        ]
        facts.append(Fact("sweeps", sweeps))
        notes = []
        if search.doublings:
            cascade = None if self.cascade is None else self.cascade.values_by_name()
            facts.append(Fact("cascade", cascade))
            if cascade is None:
                notes.append("no cascade: no branch comes to a period doubling in this range")
            else:
                tables.append(cascade_table(cascade, parameter))
                notes += cascade_notes(cascade)
        unit = "" if isinstance(self.block, Block) else "Angles are in units of alpha. "
        notes.append(
            f"{unit}Of mirror images one is followed. Branches that hang together with none of the "
            "starts are missed: a search everywhere starts from more."
        )
        case = case_text(self.block, self.motion, parameter, self.within)
        return Description(f"Periodic motions: {case}, linear model", facts, tables, notes)


@checked
def find_bifurcations(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    *,
    within: tuple[float, float] | None = None,
    values: ArrayLike | None = None,
    start: Start | None = None,
    search: BranchSearch | None = None,
    max_cycles: int = 2000,
) -> BifurcationDiagram:
    """Find the periodic motions over a parameter, with all bifurcations that connect them.

    Branches start from the symmetric motions in closed form, and from what two sweeps, upwards and
    downwards, settle to.  They are followed around their folds, and so is every branch that begins
    at a bifurcation.  Of mirror images one is followed.

    Parameters
    ----------
    block
        Its sides are alike; its restitution counts.
    motion
        Its phase is that at the start of each sweep.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    within
        Its range (low, high); by default the ends of `values`, or from half to twice its own value.
    values
        Of the sweeps: their number (default 400; 0 for no sweeps), or the values themselves.
    start
        Of each sweep; by default the steady state, or rest where there is none.
    search
        Which branches are followed; by default `BranchSearch()`.
    max_cycles
        Forcing periods at each value of a sweep, as for `find_attractor`.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, or the sides of the block differ.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> diagram = find_bifurcations(block, motion, "frequency_ratio", within=(1.8, 2.4), values=7)
    >>> for each in diagram.points:
    ...     print(each.point.type, f"{each.point.frequency_ratio:.6f}", each.branches)
    symmetry-breaking 1.948378 (1, 2)
    """
    bare_block(block)
    refuse_asymmetric(block, "block", "a branch")
    shaken, asked = harmonic(motion), BranchSearch() if search is None else search
    if parameter not in PARAMETERS:
        valid = "orbits are followed over " + ", ".join(PARAMETERS)
        raise InputError("parameter", parameter, valid, "name one of them")
    (low, high), steps = _range_of(block, shaken, parameter, within, values)
    sweeps = tuple(
        _swept(block, shaken, parameter, way, start or Steady(order=asked.order), max_cycles)
        for way in ((steps, steps[::-1]) if steps.size else ())
    )
    origins = [
        *_symmetric_orbits(block, shaken, parameter, (low, high), asked),
        *_settled_orbits(sweeps, asked),
    ]
    if asked.everywhere:
        origins += _searched_orbits(block, shaken, parameter, (low, high), asked)
    branches = find_branches(
        origins,
        parameter,
        (low, high),
        max_period=int(asked.max_period or 0),
        max_impacts=asked.max_impacts,
        max_branches=asked.max_branches + 1,
    )
    complete = len(branches) <= asked.max_branches  # one more says that more would have begun
    branches = branches[: asked.max_branches]
    cascade = longest_cascade(branches, (low, high), asked.doublings) if asked.doublings else None
    return BifurcationDiagram(
        block=block,
        motion=shaken,
        parameter=parameter,
        within=(low, high),
        search=asked,
        branches=branches,
        sweeps=sweeps,
        cascade=cascade,
        complete=complete,
    )


def _range_of(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: object,
    values: ArrayLike | None,
) -> tuple[tuple[float, float], Floats]:
    """Return the range of a diagram, and the values of its upward sweep.

    Raises
    ------
    InputError
        If they are none, or too many.
    """
    chosen = VALUES if values is None else values
    given, count = np.atleast_1d(real_array("values", chosen)), np.ndim(chosen) == 0
    if within is None and not count and given.size > 1:
        within = (float(given.min()), float(given.max()))
    if within is None:
        if parameter == "restitution":
            here = block.dimensionless().restitution
            within = (0.5 * here, min(2.0 * here, 1.0))
        else:
            here = float(getattr(motion, parameter))
            within = (0.5 * here, 2.0 * here)
    if not is_pair(within) or not float(within[0]) < float(within[1]):
        raise InputError(
            "within", within, "its lower end must be below its upper end", "give a pair (low, high)"
        )
    low, high = (float(end) for end in within)
    for end in (low, high):
        moved_to(block, motion, parameter, end)  # refuses what is outside its range
    if not count:
        steps = np.sort(given)
    else:
        hint = "give a number of values, as 400, or 0 for no sweeps"
        many = whole_number("values", np.asarray(chosen).item(), at_least=0, hint=hint)
        steps = np.linspace(low, high, min(many, LONGEST_SWEEP + 1)) if many else np.zeros(0)
    if steps.size > LONGEST_SWEEP:
        raise InputError(
            "values", steps.size, f"sweeps go through at most {LONGEST_SWEEP}", "take fewer"
        )
    return (low, high), steps


def _swept(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    steps: Floats,
    start: Start,
    max_cycles: int,
) -> AttractorSweep:
    """Return a sweep; from rest where it should begin on a steady state that does not exist."""
    body, shaken = moved_to(block, motion, parameter, float(steps[0]))
    if isinstance(start, Steady):
        try:
            initial_march(start, body.dimensionless(), shaken)
        except ModelError:
            start = Rest()
    return sweep_attractor(body, shaken, parameter, steps, start=start, max_cycles=max_cycles)


def _symmetric_orbits(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: tuple[float, float],
    search: BranchSearch,
) -> Iterator[Orbit]:
    """Yield the symmetric orbits of an order at several values, where they are motions."""
    low, high = within
    for place in range(PLACES):
        share = place / (PLACES - 1)
        here = moved_to(block, motion, parameter, (1.0 - share) * low + share * high)
        for orbit in find_orbits(*here, max_period=search.order, max_impacts=2, seeds=1):
            if orbit.branch is not None and orbit.period == search.order and orbit.admissible:
                yield orbit


def _searched_orbits(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    parameter: str,
    within: tuple[float, float],
    search: BranchSearch,
) -> Iterator[Orbit]:
    """Yield all orbits without rest that a search finds at both ends and in the middle."""
    low, high = within
    for value in (low, 0.5 * (low + high), high):
        here = moved_to(block, motion, parameter, value)
        longest = int(search.max_period or 0)
        for orbit in find_orbits(*here, max_period=longest, max_impacts=search.max_impacts):
            if orbit.admissible and not orbit.rest_phases:
                yield orbit


def _settled_orbits(sweeps: Iterable[AttractorSweep], search: BranchSearch) -> list[Orbit]:
    """Return an orbit in the middle of every run of one kind that sweeps met, short ones first.

    Those that come to rest have no branch.
    """
    found = [run[len(run) // 2].orbit for sweep in sweeps for _, _, run in sweep.runs()]
    fitting = [
        (orbit.period, orbit.impacts, orbit)
        for orbit in found
        if orbit is not None and orbit.impacts is not None
    ]
    return [
        orbit
        for period, impacts, orbit in sorted(fitting, key=lambda each: each[:2])
        if period <= int(search.max_period or 0) and impacts <= search.max_impacts
    ]
