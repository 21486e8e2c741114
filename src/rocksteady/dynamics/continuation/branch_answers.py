"""Answers of bifurcation diagrams and of bifurcation curves."""

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import AnyBlock, case_text, solved_text
from rocksteady.outcomes import AttractorKind
from rocksteady.results.answer import Answer, aligned, left_out
from rocksteady.results.numbers import number, plural

MOST, MOST_STABLE = 3, 2
"""Rows of an answer."""
CHANGES = {
    "symmetry-breaking": "symmetry breaks",
    "period-doubling": "period doubles",
    "fold": "folds",
    "grazing": "grazes",
}
"""What ends a stable stretch, in words."""
FEIGENBAUM = "Feigenbaum 4.6692"


def scale_of(block: AnyBlock, parameter: str) -> tuple[float, str, str]:
    """Return by what a parameter is multiplied in an answer, its symbol and its unit.

    Parameters
    ----------
    block
        The block; of one with a size amplitudes are in g, frequencies in Hz.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    """
    if isinstance(block, Block) and parameter == "amplitude":
        return in_g(block.uplift_acceleration), "", " g"
    if isinstance(block, Block) and parameter == "frequency_ratio":
        return block.p / (2.0 * math.pi), "", " Hz"
    return 1.0, SYMBOLS[parameter].replace("Ω", "W"), ""


def diagram_answer(diagram: Any) -> Answer:
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
        for ends in _stable(branch)
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
        rows.append((label, f"stable {low} to {high}{place.unit}"))
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
        ("unfinished", "" if diagram.complete else "stopped at --max-branches: more may begin"),
        *rows,
        ("cascade", doublings),
        *((f"sweep {sweep.direction}", _met(sweep, place)) for sweep in diagram.sweeps),
        left_out(len(stable) - len(rows), "narrower stable ranges"),
        ("found", counts_of(diagram)),
        ("computed", computed),
    ]
    sentence = _stability(_joined(ranges), diagram.within, place).removesuffix(".")
    return Answer(f"{solved_text(sentence, diagram.block)}.", facts)


def counts_of(diagram: Any, reach: str = "") -> str:
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


def _stable(branch: Any) -> list[tuple[float, float]]:
    """Return the stable ranges of a branch."""
    ends = [
        sorted((float(branch.values[part.first]), float(branch.values[part.last])))
        for part in branch.stretches
        if part.stable
    ]
    return [(low, high) for low, high in ends]


def _joined(ranges: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return ranges without overlap, in their order; ranges that touch are joined."""
    merged: list[tuple[float, float]] = []
    for low, high in sorted(ranges):
        if merged and low <= merged[-1][1] * (1.0 + 1e-9):
            merged[-1] = (merged[-1][0], max(merged[-1][1], high))
        else:
            merged.append((low, high))
    return merged


def _end(diagram: Any, number_of: int, end: float, place: _Place) -> str:
    """Return an end of a stable range of a branch, and what happens to the branch there."""
    near = 1e-6 * (diagram.within[1] - diagram.within[0])
    types = [
        each.point.type.value
        for each in diagram.points
        if each.branches[0] == number_of
        and abs(getattr(each.point, diagram.parameter) - end) <= near
    ]
    changes = [CHANGES[kind] for kind in types if kind in CHANGES]
    return place.bare(end) + (f" ({changes[0]})" if changes else "")


def _met(sweep: Any, place: _Place) -> str:
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


def curves_answer(curves: Any) -> Answer:
    """Return how many bifurcation curves cross a plane, and where they meet.

    Parameters
    ----------
    curves
        The curves.
    """
    scales = [scale_of(curves.block, name) for name in curves.parameters]
    count, meet = len(curves.curves), curves.points
    verb = "crosses" if count == 1 else "cross"
    sentence = f"{plural(count, 'bifurcation curve')} {verb} this plane"
    sentence += f" and meet in {plural(len(meet), 'special point')}." if meet else "; none meet."
    if not count:
        sentence = "No bifurcation curve was found in this plane."
    rows = [
        (
            "" if row else "meet at",
            *(
                f"{symbol[:1]} {number(factor * getattr(each.point, name), 5)}{unit}".strip()
                for name, (factor, symbol, unit) in zip(curves.parameters, scales, strict=True)
            ),
            f"period {each.point.period}",
            f"{each.point.type.value.replace('-', ' ')}, curves {', '.join(map(str, each.curves))}",
        )
        for row, each in enumerate(meet[:MOST])
    ]
    left = Counter(each.point.type.value.replace("-", " ") for each in meet[MOST:])
    kinds = ", ".join(f"{number_of} {kind}" for kind, number_of in left.items())
    types = Counter(curve.type.value.replace("-", " ") for curve in curves.curves)
    listed = ", ".join(f"{number_of} {kind}" for kind, number_of in types.most_common())
    solved = solved_text(curves.model.name, curves.block)
    facts = [
        ("unfinished", "" if curves.complete else "stopped at --max-curves or --max-branches"),
        *aligned(rows),
        left_out(sum(left.values()), kinds),
        ("curves", listed),
        ("missed", "curves off every line across the plane: more lines find more"),
        ("computed", f"{solved}; up to {plural(curves.search.longest, 'period')}"),
    ]
    return Answer(sentence, facts)
