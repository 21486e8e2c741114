"""Words of bifurcation curves and of the planes that they cross."""

from collections import Counter

import numpy as np

from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.curves.bifurcation_curves import (
    BifurcationCurve,
    BifurcationCurves,
)
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import solved_text
from rocksteady.results.description import Column, Description, Fact, Table, aligned, left_out, line
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import describes
from rocksteady.words._branch_cases import (
    SHORT,
    block_fact,
    fixed_values,
    kept_text,
    kind_word,
    model_facts,
    model_facts_over,
    model_text,
    multiplier_columns,
    orbit_values,
    scale_of,
)

MOST = 3
"""Special points that an answer lists."""


@describes(BifurcationCurves)
def describe_curves(curves: BifurcationCurves) -> Description:
    """Return the points of codimension two, the curves, and the regions that are known."""
    fixed = fixed_values(curves.block, curves.motion, curves.parameters)
    ranges = [
        f"{SYMBOLS[name]} from {number(low, 6)} to {number(high, 6)}"
        for name, (low, high) in zip(curves.parameters, curves.within, strict=True)
    ]
    constant = [
        f"restitution {kept_text(curves.block)}"
        if name == "restitution"
        else f"{SYMBOLS[name]} = {value:.6g}"
        for name, value in fixed.items()
        if value is not None
    ]
    points = [{**orbit_values(each.point), "curves": list(each.curves)} for each in curves.points]
    listed = [
        {"curve": place, "type": curve.type.value, **curve_values(curve)}
        for place, curve in enumerate(curves.curves, start=1)
    ]
    regions = [
        {
            **dict(zip(curves.parameters, each.place, strict=True)),
            "stable": list(each.motions),
        }
        for each in curves.regions
    ]
    facts = [
        Fact("parameters", list(curves.parameters), "over", ", ".join(ranges)),
        Fact("within", [list(ends) for ends in curves.within]),
        *(Fact(name, value) for name, value in fixed.items()),
    ]
    if isinstance(curves.block, Block):
        facts.append(block_fact(curves.block, curves.parameters))
    summary = f"{plural(len(listed), 'curve')}, {plural(len(points), 'point')} of codimension two"
    facts += [
        *model_facts_over(curves.block, curves.model, curves.parameters),
        Fact("orders", list(curves.search.orders)),
        Fact("lines", list(curves.search.lines)),
        Fact("max_period", curves.search.longest),
        Fact("max_impacts", curves.search.max_impacts),
        Fact("max_branches", curves.search.max_branches),
        Fact("max_curves", curves.search.max_curves),
        Fact("complete", curves.complete),
        Fact("", label="found", text=summary),
    ]
    images = "One of each pair of mirror images is followed. " if curves.block.symmetric else ""
    note = (
        f"{images}Curves that hang together with no bifurcation on "
        "the lines across the plane are missed: more lines find more."
    )
    sentence, screen = curves_answer(curves)
    named = {each.point.type.value for each in curves.points}
    return Description(
        f"Bifurcation curves: {', '.join([*ranges, *constant])}, "
        f"{model_text(curves.block, curves.model)}",
        [*screen, *facts],
        [
            _points_table(points, curves.parameters),
            _curves_table(listed, curves.parameters, named),
            Table("regions", regions),
        ],
        [note],
        sentence,
    )


def curves_answer(curves: BifurcationCurves) -> tuple[str, list[Fact]]:
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
        line("unfinished", "" if curves.complete else "stopped at --max-curves or --max-branches"),
        *aligned(rows),
        left_out(sum(left.values()), kinds),
        line("curves", listed),
        line("missed", "curves off every line across the plane: more lines find more"),
        line("computed", f"{solved}; up to {plural(curves.search.longest, 'period')}"),
    ]
    return sentence, facts


@describes(BifurcationCurve)
def describe_curve(curve: BifurcationCurve) -> Description:
    """Return what the curve is, where it begins and ends, and why."""
    values = curve_values(curve)
    low, high = curve.values.min(axis=0), curve.values.max(axis=0)
    over = [
        f"{SYMBOLS[name]} {number(float(a), 5)} to {number(float(b), 5)}"
        for name, a, b in zip(curve.parameters, low, high, strict=True)
    ]
    words = {
        "begin": ("from", curve.points[0].type.value.replace("-", " ")),
        "end": ("to", curve.points[-1].type.value.replace("-", " ")),
        "points": ("points", str(len(curve.points))),
    }
    kind = curve.type.value.replace("-", " ").capitalize()
    return Description(
        f"{kind} curve of {curve.kind} motions, {plural(curve.period, 'period')}, "
        f"{plural(curve.impacts, 'impact')}: {', '.join(over)}, "
        f"{model_text(curve.block, curve.model)}",
        [
            Fact("parameters", list(curve.parameters)),
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            *model_facts(curve.block, curve.model),
        ],
    )


def curve_values(curve: BifurcationCurve) -> dict[str, object]:
    """Return what motions a curve is of, where it begins and ends, and why."""
    begin, end = (
        {"type": point.type.value, **dict(zip(curve.parameters, place, strict=True))}
        for point, place in (
            (curve.points[0], curve.values[0].tolist()),
            (curve.points[-1], curve.values[-1].tolist()),
        )
    )
    return {
        "period": curve.period,
        "impacts": curve.impacts,
        "symmetric": curve.symmetric,
        "begin": begin,
        "end": end,
        "points": len(curve.points),
    }


def curve_rows(curve: BifurcationCurve, place: int = 1) -> list[dict[str, object]]:
    """Return one row per point of a curve, with the number of the curve."""
    return [
        {
            "curve": place,
            "bifurcation": curve.type.value,
            **orbit_values(point),
            **multiplier_columns(point.multipliers),
            "highest": float(np.nanmax(point.peaks)),
            "lowest": float(np.nanmin(point.peaks)),
            "arclength": point.arclength,
        }
        for point in curve.points
    ]


def _word(kind: object) -> str:
    return str(kind).replace("-", " ")


def _points_table(points: list[dict[str, object]], parameters: tuple[str, str]) -> Table:
    columns = [
        Column("type", "point", _word, left=True),
        *(Column(name, SHORT[name], lambda value: f"{value:.8f}") for name in parameters),
        Column("symmetric", "kind", kind_word, left=True),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("curves", "curves", left=True),
    ]
    return Table("points", points, columns, most=100, kind=lambda row: _word(row["type"]))


def _curves_table(
    curves: list[dict[str, object]], parameters: tuple[str, str], named: set[str]
) -> Table:
    """Return one row per curve; an end listed elsewhere has its place alone."""

    def place(end: dict[str, object]) -> str:
        values = ", ".join(f"{end[name]:.4g}" for name in parameters)
        kind = str(end["type"])
        return values if kind in {*named, PointType.RANGE_END.value} else f"{_word(kind)} {values}"

    over = ", ".join(SHORT[name] for name in parameters)

    columns = [
        Column("curve", "curve"),
        Column("type", "bifurcation", _word, left=True),
        Column("symmetric", "kind", kind_word, left=True),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("begin", f"from {over}", place, left=True),
        Column("end", f"to {over}", place, left=True),
    ]
    return Table("curves", curves, columns, most=100, kind=lambda row: _word(row["type"]))
