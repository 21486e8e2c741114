"""Words of bifurcation diagrams and of their bifurcations."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.diagram import Bifurcation, BifurcationDiagram
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.dynamics.orbits.return_map import has_mirror_images
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Model
from rocksteady.model.facts import AnyBlock, case_text, solved_text, tilt_text
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.outcomes import AttractorKind
from rocksteady.results.datasets import ColumnWords, Variable, variables_of
from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import describes
from rocksteady.words._branch_cases import (
    SHORT,
    UNITS,
    block_fact,
    fixed_values,
    in_si,
    kept_text,
    kind_word,
    model_facts_over,
    model_text,
    orders_text,
    scale_of,
    series_facts,
)
from rocksteady.words.attractors import start_text, sweep_table
from rocksteady.words.branches import (
    EXTREMES,
    MOST_ROWS,
    PARAMETER_WORDS,
    bifurcations_table,
    branch_values,
    branches_dataset,
    cascade_notes,
    cascade_table,
    point_row,
    point_values,
    stable_ranges,
    stable_text,
)
from rocksteady.words.resting import diagram_row, resting_table

if TYPE_CHECKING:
    import xarray


MOST_STABLE = 2
"""Stable ranges that an answer lists."""
CHANGES = {
    "symmetry-breaking": "symmetry breaks",
    "period-doubling": "period doubles",
    "fold": "folds",
    "grazing": "grazes",
}
"""What ends a stable stretch, in words."""
FEIGENBAUM = "Feigenbaum 4.6692"
ENDS = {
    "symmetry-breaking": "breaking",
    "period-doubling": "doubling",
    "grazing": "graze",
    "end-of-range": "range end",
}
"""The ends of branches, shorter."""


@describes(BifurcationDiagram)
def describe_diagram(diagram: BifurcationDiagram) -> Description:
    """Return the bifurcations, the branches, what the sweeps met, and the cascade."""
    search, parameter = diagram.search, diagram.parameter
    points = [
        {
            "branch": each.branches[0],
            "branches": list(each.branches),
            **point_values(each.point, diagram.branches[each.branches[0] - 1].lean, diagram.block),
        }
        for each in diagram.points
    ]
    branches = [
        {"branch": place, **branch_values(branch)}
        for place, branch in enumerate(diagram.branches, start=1)
    ]
    sweeps = [
        {
            "direction": sweep.direction,
            "start": start_text(sweep.start),
            "values": len(sweep.values),
            "counts": sweep.values_by_kind(),
            "runs": sweep.run_rows(),
        }
        for sweep in diagram.sweeps
    ]
    reach = f" up to {plural(search.longest, 'period')}"
    reach += f" and {plural(search.max_impacts, 'impact')}"
    facts = [
        *case_facts(diagram.block, diagram.motion, parameter, diagram.within, diagram.model),
        Fact("orders", list(search.orders)),
        Fact("max_period", search.longest),
        Fact("max_impacts", search.max_impacts),
        Fact("max_branches", search.max_branches),
        Fact("complete", diagram.complete),
        Fact("", label="found", text=counts_of(diagram, reach)),
    ]
    tables = [
        bifurcations_table(points, parameter, diagram.block, key="points"),
        branches_table(branches, parameter),
        resting_table(diagram.resting, key="resting"),
        *(sweep_table(sweep) for sweep in diagram.sweeps),
    ]
    facts.append(Fact("sweeps", sweeps))
    notes = []
    if search.doublings:
        cascade = diagram.cascade
        facts.append(Fact("cascade", None if cascade is None else cascade.values_by_name()))
        if cascade is None:
            notes.append("no cascade: no branch has a period doubling in this range")
        else:
            tables.append(cascade_table(cascade))
            notes += cascade_notes(cascade)
    unit = "" if isinstance(diagram.block, Block) else "Angles are in units of alpha. "
    images = (
        "One of each pair of mirror images is followed. "
        if has_mirror_images(diagram.block, diagram.motion)
        else ""
    )
    notes.append(
        f"{unit}{images}Branches that hang together with none of the "
        "starts are missed: a search everywhere starts from more."
    )
    sentence, screen = diagram_answer(diagram)
    headline = diagram_headline(diagram)
    return Description(headline, [*screen, *facts], tables, notes, sentence)


def diagram_headline(diagram: BifurcationDiagram) -> str:
    """Return the parameters of a diagram in a line."""
    case = motion_text(diagram.block, diagram.motion, diagram.parameter, diagram.within)
    return f"Periodic motions: {case}, {model_text(diagram.block, diagram.model)}"


def diagram_line(diagram: BifurcationDiagram) -> str:
    """Return the headline with the numbers of branches and bifurcations."""
    count = len(diagram.branches)
    branches = "1 branch" if count == 1 else f"{count} branches"
    return f"{diagram_headline(diagram)}, {branches}, {plural(len(diagram.points), 'bifurcation')}"


def diagram_rows(diagram: BifurcationDiagram) -> Iterator[dict[str, object]]:
    """Yield one row per point, in SI too where the block has a size."""
    for place, branch in enumerate(diagram.branches, start=1):
        for point in branch.points:
            row = point_row(place, point, branch.lean, diagram.block)
            yield {**row, "rest_phases": 0}
    for place, resting in enumerate(diagram.resting, start=len(diagram.branches) + 1):
        for rests in resting.points:
            yield {**diagram_row(place, rests), "rest_phases": resting.rest_phases}


def motion_text(
    block: AnyBlock, motion: PeriodicMotion, parameter: str, within: tuple[float, float]
) -> str:
    """Return the three parameters of a diagram in a few words."""
    parts = []
    for name, value in fixed_values(block, motion, [parameter]).items():
        symbol, equals = SYMBOLS[name], " " if name == "restitution" else " = "
        if value is None:
            parts.append(f"{symbol} from {within[0]:.6g} to {within[1]:.6g}")
        else:
            text = kept_text(block) if name == "restitution" else f"{value:.6g}"
            parts.append(f"{symbol}{equals}{text}")
    return ", ".join(parts) + orders_text(harmonics_of(motion))


def case_facts(
    block: AnyBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: tuple[float, float],
    model: Model,
) -> list[Fact]:
    """Return what moves in a diagram, between what, and what else is fixed."""
    scales = {"amplitude": motion.amplitude, "frequency_ratio": motion.frequency_ratio}
    over = f"{SYMBOLS[parameter]} from {number(within[0], 6)} to {number(within[1], 6)}"
    fixed = fixed_values(block, motion, [parameter])
    facts = [Fact(name, value) for name, value in fixed.items()]
    facts += series_facts(harmonics_of(motion))
    if isinstance(block, Block):
        facts.append(block_fact(block, [parameter]))
        si = in_si(block, **scales)
        for name, (key, unit) in UNITS.items():
            if name == parameter:
                low, high = (number(in_si(block, **{**scales, name: end})[key]) for end in within)
                over = f"{low} to {high} {unit} ({over})"
                facts.append(Fact(key, None))
            else:
                label = {"g": "amplitude", "Hz": "frequency"}[unit]
                facts.append(Fact(key, si[key], label, f"{number(si[key])} {unit}"))
    return [
        Fact("parameter", parameter),
        Fact("within", list(within), "over", over),
        *facts,
        *model_facts_over(block, model, [parameter]),
    ]


def branches_table(branches: Sequence[dict[str, object]], parameter: str) -> Table:
    """Return branches for people and for JSON."""

    def end(values: dict[str, object]) -> str:
        kind = str(values["type"])
        return ENDS.get(kind, kind)

    columns = [
        Column("branch", "branch"),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("symmetric", "kind", kind_word, left=True),
        Column("begin", "from", end, left=True),
        Column("end", "to", end, left=True),
        Column("stable_ranges", f"stable in {SHORT[parameter]}", stable_text, left=True),
    ]
    return Table(
        "branches",
        branches,
        columns,
        most=MOST_ROWS,
        kind=lambda row: kind_word(row["symmetric"]),
    )


def diagram_answer(diagram: BifurcationDiagram) -> tuple[str, list[Fact]]:
    """Return where a stable steady motion exists over a parameter, and what the sweeps meet.

    Parameters
    ----------
    diagram
        The diagram.
    """
    place = _Place(diagram.block, diagram.parameter)
    cascade = diagram.cascade
    stable = sorted(
        (*ends, number_of)
        for number_of, branch in enumerate(diagram.branches, start=1)
        for ends in stable_ranges(branch)
    )
    ranges = [(first, last) for first, last, _ in stable]
    ranges += [(float(each.within[0]), float(each.within[1])) for each in diagram.resting]
    if cascade is not None and len(cascade.points) > 1:
        ends = sorted((float(cascade.values[0]), float(cascade.values[-1])))
        ranges.append((ends[0], ends[1]))
    rows = []
    for first, last, number_of in sorted(stable, key=lambda each: each[0] - each[1])[:MOST_STABLE]:
        branch = diagram.branches[number_of - 1]
        kind = "symmetric" if branch.symmetric else "unsymmetric"
        low, high = (_end(diagram, number_of, end, place) for end in (first, last))
        label = kind if branch.period == 1 else f"{kind} {branch.period}"
        rows.append(line(label, f"stable {low} to {high}{place.unit}"))
    doublings = "none: no branch doubles its period here" if diagram.search.doublings else ""
    if cascade is not None:
        limit = f"{place.name}{number(place.factor * float(cascade.values[-1]), 7)}{place.unit}"
        doublings = f"{plural(len(cascade.points), 'doubling')} to {limit}"
        if len(cascade.points) > 2:
            doublings += f"; last ratio {cascade.ratios[-1]:.2f} ({FEIGENBAUM})"
    computed = diagram.model.name
    if diagram.parameter != "restitution":
        computed += f"; {case_text(diagram.block)}"
    facts = [
        line("unfinished", "" if diagram.complete else "stopped at --max-branches: more may begin"),
        *rows,
        line("cascade", doublings),
        *(line(f"sweep {sweep.direction}", _met(sweep, place)) for sweep in diagram.sweeps),
        left_out(len(stable) - len(rows), "narrower stable ranges"),
        line("found", counts_of(diagram)),
        line("computed", computed),
    ]
    sentence = _stability(_joined(ranges), diagram.within, place).removesuffix(".")
    return f"{solved_text(sentence, diagram.block)}.", facts


def counts_of(diagram: BifurcationDiagram, reach: str = "") -> str:
    """Return how many branches and bifurcations a diagram has, in words.

    Parameters
    ----------
    diagram
        The diagram.
    reach
        What the search for branches covers, after their number; by default nothing.
    """
    resting = len(diagram.resting)
    parts = [
        plural(len(diagram.branches), "branch").replace("branchs", "branches") + reach,
        *([f"{resting:,} of orbits that come to rest"] if resting else []),
        plural(len(diagram.points), "bifurcation"),
    ]
    return ", ".join(parts)


class _Place:
    """Values of a parameter in the unit of an answer."""

    def __init__(self, block: AnyBlock, parameter: str) -> None:
        self.factor, symbol, self.unit = scale_of(block, parameter)
        self.name = f"{symbol} = " if symbol else ""

    def bare(self, value: float) -> str:
        """Return a value in five figures."""
        return number(self.factor * value, 5)

    def at(self, value: float) -> str:
        """Return a value with its symbol or its unit."""
        return f"{self.name}{self.bare(value)}{self.unit}"

    def between(self, low: float, high: float) -> str:
        """Return a range with its symbol or its unit."""
        return f"{self.name}{self.bare(low)} to {self.bare(high)}{self.unit}"


def _stability(
    ranges: Sequence[tuple[float, float]], within: tuple[float, float], place: _Place
) -> str:
    """Return where a steady motion is stable, in a sentence."""
    low, high = within
    if not ranges:
        return f"No steady motion was found to be stable for {place.between(low, high)}."
    (first, last), *others = ranges
    if not others and first <= low and last >= high:
        return f"A steady motion is stable throughout, for {place.between(low, high)}."
    if not others and last >= high:
        return f"No steady motion was found to be stable below {place.at(first)}."
    if not others and first <= low:
        return f"No steady motion was found to be stable above {place.at(last)}."
    more = f" and in {plural(len(others), 'other range')}" if others else ""
    return f"A steady motion is stable for {place.between(first, last)}{more}."


def _joined(ranges: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return ranges without overlap, in their order; ranges that touch are joined."""
    merged: list[tuple[float, float]] = []
    for low, high in sorted(ranges):
        if merged and low <= merged[-1][1] * (1.0 + 1e-9):
            merged[-1] = (merged[-1][0], max(merged[-1][1], high))
        else:
            merged.append((low, high))
    return merged


def _end(diagram: BifurcationDiagram, number_of: int, end: float, place: _Place) -> str:
    """Return an end of a stable range, and what happens to the branch there."""
    near = 1e-6 * (diagram.within[1] - diagram.within[0])
    types = [
        each.point.type.value
        for each in diagram.points
        if each.branches[0] == number_of
        and abs(getattr(each.point, diagram.parameter) - end) <= near
    ]
    changes = [CHANGES[kind] for kind in types if kind in CHANGES]
    return place.bare(end) + (f" ({changes[0]})" if changes else "")


def _met(sweep: AttractorSweep, place: _Place) -> str:
    """Return where a sweep falls, and how often it does not settle."""
    falls = [row for row in sweep.run_rows() if row["kind"] == AttractorKind.OVERTURNED.value]
    words = "falls nowhere"
    if falls:
        longest = max(falls, key=lambda row: row["values"])
        others = sum(row["values"] for row in falls) - longest["values"]
        more = f" and at {plural(others, 'other value')}" if others else ""
        words = f"falls for {place.between(longest['from'], longest['to'])}{more}"
        if longest["values"] == len(sweep.values):
            words = "falls at every value"
    strange = ("aperiodic", "undecided")
    counts = {kind: n for kind, n in sweep.values_by_kind().items() if kind in strange}
    return ", ".join([words, *(f"{kind} at {plural(n, 'value')}" for kind, n in counts.items())])


def bifurcation_variables(points: Sequence[Bifurcation]) -> dict[str, Variable]:
    """Return the bifurcations of a diagram along a dimension of their own."""
    rows = [
        {
            "bifurcation_type": each.point.type.value,
            **{f"bifurcation_{name}": getattr(each.point, name) for name in PARAMETER_WORDS},
            "bifurcation_branch": each.branches[0],
            "bifurcation_highest": each.highest,
            "bifurcation_lowest": each.lowest,
        }
        for each in points
    ]
    branch = ColumnWords(long_name="number of the first branch that it lies on", missing=0)
    words = {
        "type": ColumnWords(long_name="type of the bifurcation", flags=tuple(PointType)),
        **PARAMETER_WORDS,
        "branch": branch,
        **EXTREMES,
    }
    named = {f"bifurcation_{name}": value for name, value in words.items()}
    return variables_of(rows, "bifurcation", named)


def diagram_dataset(diagram: BifurcationDiagram) -> "xarray.Dataset":
    """Return branches and bifurcations, as `BifurcationDiagram.to_dataset` states."""
    data = branches_dataset(diagram.branches, diagram.block)
    return data.assign(bifurcation_variables(diagram.points)).assign_attrs(
        parameter=diagram.parameter, within=list(diagram.within), model=diagram.model.name
    )


@describes(Bifurcation)
def describe_bifurcation(bifurcation: Bifurcation) -> Description:
    """Return the point, on which branches it lies, and how far its orbit tilts."""
    point = bifurcation.point.describe()
    numbers = ", ".join(map(str, bifurcation.branches))
    return Description(
        headline=f"{point.headline}; branches {numbers}",
        facts=[
            *point.facts,
            Fact("branches", list(bifurcation.branches), "branches", numbers),
            Fact(
                "highest",
                bifurcation.highest,
                "highest",
                tilt_text(bifurcation.point.block, bifurcation.highest),
            ),
            Fact(
                "lowest",
                bifurcation.lowest,
                "lowest",
                tilt_text(bifurcation.point.block, bifurcation.lowest),
            ),
        ],
        notes=point.notes,
    )
