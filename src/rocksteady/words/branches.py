"""Words of branches of periodic orbits: of points, branches and cascades."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.continuation.cascade import Cascade
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.points import Branch, BranchPoint, extremes
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.dynamics.steady.verdicts import (
    MULTIPLIERS,
    multipliers_text,
    multipliers_value,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.facts import AnyBlock
from rocksteady.results.datasets import ColumnWords, Variable, padded, variables_of
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import describes
from rocksteady.words._branch_cases import (
    SHORT,
    UNITS,
    in_si,
    kind_word,
    model_facts,
    model_text,
    multiplier_columns,
    orbit_values,
    orders_text,
    series_facts,
)

if TYPE_CHECKING:
    import xarray


BARE = DimensionlessBlock(restitution=1.0)
"""What has no size, for texts in units of alpha."""
MOST_ROWS = 100
"""Bifurcations and branches that a summary lists."""


@describes(BranchPoint)
def describe_point(point: BranchPoint) -> Description:
    """Return where the point is, what is special about it, and its orbit."""
    values, peaks = point_values(point, 1.0, BARE), extremes(point, 1.0)
    kind = f"{point.type.value.replace('-', ' ')} point"
    place = f"A = {point.amplitude:.8g}, Ω = {point.frequency_ratio:.8g}"
    words = {
        "amplitude": ("A", f"{point.amplitude:.8g}"),
        "frequency_ratio": ("Ω", f"{point.frequency_ratio:.8g}"),
        "restitution": ("restitution", f"{point.restitution:.8g}"),
        "period": ("period", plural(point.period, "forcing period")),
        "impacts": ("impacts", f"{point.impacts} in a period"),
        "symmetric": ("kind", point.kind),
        "peaks": ("highest, lowest", ", ".join(map(number, peaks)) + " alpha"),
        "multipliers": (MULTIPLIERS, multipliers_text(point.multipliers)),
    }
    return Description(
        f"{kind.capitalize()}: {place}, {point_case(point)}",
        [
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            Fact("stable", point.stable, "stable"),
            Fact("admissible", point.admissible),
            Fact("arclength", point.arclength),
            *series_facts(point.chain.harmonics),
            *model_facts(point.block, point.model),
        ],
        notes=[point.reason] if point.reason else [],
    )


def point_case(point: BranchPoint) -> str:
    """Return restitution and equations of motion of a point in a few words."""
    kept = f"{point.restitution:.8g}"
    negative = point.block.dimensionless().sides[1][0]
    if negative != point.restitution and not point.block.symmetric:
        kept += f"/{negative:.8g}"
    model = model_text(point.block, point.model)
    return f"restitution {kept}{orders_text(point.chain.harmonics)}, {model}"


def point_values(point: BranchPoint, lean: float, block: AnyBlock) -> dict[str, object]:
    """Return a point as plain values, in SI too where the block has a size."""
    peaks = extremes(point, lean)
    values: dict[str, object] = {
        **orbit_values(point),
        "peaks": peaks,
        "multipliers": multipliers_value(point.multipliers),
    }
    values |= in_si(block, point.amplitude, point.frequency_ratio)
    if isinstance(block, Block):
        values["peaks_rad"] = [peak * block.alpha for peak in peaks]
    return values


def point_row(branch: int, point: BranchPoint, lean: float, block: AnyBlock) -> dict[str, object]:
    """Return the row of a point of a branch in a file."""
    high, low = extremes(point, lean)
    row: dict[str, object] = {
        "branch": branch,
        **orbit_values(point),
        "stable": point.stable,
        "admissible": point.admissible,
        **multiplier_columns(point.multipliers),
        "highest": high,
        "lowest": low,
        "arclength": point.arclength,
        **in_si(block, point.amplitude, point.frequency_ratio),
    }
    if isinstance(block, Block):
        row |= {"highest_rad": high * block.alpha, "lowest_rad": low * block.alpha}
    return row


@describes(Branch)
def describe_branch(branch: Branch) -> Description:
    """Return what the branch is, its ends, where it is stable, and its bifurcations."""
    values, symbol = branch_values(branch), SYMBOLS[branch.parameter]
    low, high = branch.values.min(), branch.values.max()
    begin, end = branch.points[0].type.value, branch.points[-1].type.value
    special = [
        {"branch": 1, **point_values(point, branch.lean, BARE)} for point in branch.bifurcations
    ]
    kind = "Symmetric" if branch.symmetric else "Unsymmetric"
    words = {
        "begin": ("from", begin.replace("-", " ")),
        "end": ("to", end.replace("-", " ")),
        "stable_ranges": ("stable", stable_text(stable_ranges(branch))),
        "points": ("points", str(len(branch.points))),
    }
    return Description(
        f"{kind} branch, {plural(branch.period, 'period')}, {plural(branch.impacts, 'impact')}: "
        f"{symbol} from {low:.6g} to {high:.6g}{orders_text(branch.points[0].chain.harmonics)}, "
        f"{model_text(branch.block, branch.model)}",
        [
            Fact("parameter", branch.parameter),
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            *series_facts(branch.points[0].chain.harmonics),
            *model_facts(branch.block, branch.model),
        ],
        [bifurcations_table(special, branch.parameter, BARE, key="bifurcations")],
    )


def branch_values(branch: Branch) -> dict[str, object]:
    """Return what a branch is, its ends, and where it is stable."""
    name = branch.parameter
    begin, end = (
        {"type": point.type.value, name: getattr(point, name)}
        for point in (branch.points[0], branch.points[-1])
    )
    return {
        "period": branch.period,
        "impacts": branch.impacts,
        "symmetric": branch.symmetric,
        "begin": begin,
        "end": end,
        "within": [float(branch.values.min()), float(branch.values.max())],
        "stable_ranges": [list(ends) for ends in stable_ranges(branch)],
        "points": len(branch.points),
    }


def stable_ranges(branch: Branch) -> list[tuple[float, float]]:
    """Return the ranges in which a branch is stable, from low to high."""
    ends = [
        (float(branch.values[part.first]), float(branch.values[part.last]))
        for part in branch.stretches
        if part.stable
    ]
    return sorted((min(pair), max(pair)) for pair in ends)


def range_text(low: float, high: float) -> str:
    """Return a range; for one too narrow for five digits its lower end and its width."""
    first, last = f"{low:.5g}", f"{high:.5g}"
    return f"{low:.7g} + {high - low:.0e}" if first == last else f"{first} to {last}"


def stable_text(ranges: Sequence[Sequence[float]]) -> str:
    """Return the first range in which a branch is stable, and the number of others."""
    texts = [range_text(low, high) for low, high in ranges]
    return texts[0] + (f" +{len(texts) - 1}" if len(texts) > 1 else "") if texts else "—"


def bifurcations_table(
    points: Sequence[dict[str, object]], parameter: str, block: AnyBlock, *, key: str = ""
) -> Table:
    """Return bifurcations for people: where they are with the digits that are known."""
    unit, heading = UNITS.get(parameter, ("", ""))
    sized = isinstance(block, Block)

    def angle(u: float) -> str:
        if isinstance(block, Block):
            return f"{math.degrees(u * block.alpha):.2f}°"
        return f"{u:.4f}"

    columns = [
        Column("branch", "branch"),
        Column("type", "bifurcation", lambda kind: str(kind).replace("-", " "), left=True),
        Column(parameter, SHORT[parameter], lambda value: f"{value:.8f}"),
        # The unit takes the place of the kind, which the branches' table has too.
        Column(unit, heading, lambda value: f"{value:.6g}")
        if sized and unit
        else Column("symmetric", "kind", kind_word, left=True),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("peaks", "highest", lambda peaks: angle(peaks[0])),
        Column("peaks", "lowest", lambda peaks: angle(peaks[1])),
    ]
    return Table(
        key,
        points,
        columns,
        most=MOST_ROWS,
        kind=lambda row: str(row["type"]).replace("-", " "),
    )


@describes(Cascade)
def describe_cascade(cascade: Cascade) -> Description:
    """Return the doublings, the distances between them, and their ratios."""
    symbol = SYMBOLS[cascade.parameter]
    waves = cascade.points[0].chain.harmonics
    return Description(
        f"Cascade of {plural(len(cascade.points), 'period doubling')}: {symbol} from "
        f"{cascade.values[0]:.6g} to {cascade.values[-1]:.6g}{orders_text(waves)}, "
        f"{model_text(cascade.block, cascade.model)}",
        [
            Fact("parameter", cascade.parameter),
            *(Fact(key, value) for key, value in cascade.values_by_name().items()),
            *series_facts(waves),
            *model_facts(cascade.block, cascade.model),
        ],
        [cascade_table(cascade)],
        cascade_notes(cascade),
    )


def cascade_table(cascade: Cascade) -> Table:
    """Return the doublings of a cascade for people."""
    rows, count, parameter = _doublings(cascade), len(cascade.points), cascade.parameter
    columns = [
        Column("period", "period", lambda period: f"{period} -> {2 * period}"),
        Column(parameter, SHORT[parameter], lambda value: f"{value:.12f}"),
        Column("distance", "distance", lambda d: "" if d is None else f"{abs(d):.3e}"),
        Column("ratio", "ratio", lambda r: "" if r is None else f"{r:.4f}"),
    ]
    return Table("", rows, columns, f"cascade of {plural(count, 'period doubling')}")


def _doublings(cascade: Cascade) -> list[dict[str, object]]:
    """Return each doubling, the distance to the next one and the ratio of two distances."""
    count = len(cascade.points)
    return [
        {
            "period": point.period,
            cascade.parameter: value,
            "distance": distance,
            "ratio": ratio,
        }
        for point, value, distance, ratio in zip(
            cascade.points,
            cascade.values.tolist(),
            [*cascade.distances.tolist(), None],
            [None, *cascade.ratios.tolist(), None][:count],
            strict=True,
        )
    ]


def cascade_notes(cascade: Cascade) -> list[str]:
    """Return what follows from the distances of a cascade for its limit."""
    if len(cascade.points) < 3:
        return ["fewer than three doublings have no ratio"]
    limit = f"limit {cascade.limit:.12f}, if the distances go on shrinking by the last ratio"
    return [f"{limit}; the ratios tend to Feigenbaum's 4.6692"]


PARAMETER_WORDS = {
    "amplitude": ColumnWords(long_name="a_max/(alpha g)"),
    "frequency_ratio": ColumnWords(long_name="omega/p"),
    "restitution": ColumnWords(long_name="angular velocity after an impact over that before it"),
}
ORBIT_WORDS = {
    "period": ColumnWords(long_name="forcing periods of the orbit", missing=0),
    "impacts": ColumnWords(long_name="impacts in a period of the orbit", missing=0),
    "symmetric": ColumnWords(long_name="whether half of it mirrors the other half", units=""),
}
MULTIPLIER_WORDS = {
    f"multiplier_{number}_{part}": ColumnWords(
        long_name=f"{words} part of the {size} Floquet multiplier of the whole orbit"
    )
    for number, size in ((1, "larger"), (2, "smaller"))
    for part, words in (("re", "real"), ("im", "imaginary"))
}
EXTREMES = {
    "highest": ColumnWords(long_name="largest theta/alpha of the orbit"),
    "lowest": ColumnWords(long_name="smallest theta/alpha of the orbit"),
}
SI = {
    "accel_g": ColumnWords(long_name="largest base acceleration", units="g"),
    "freq_hz": ColumnWords(long_name="frequency of the shaking", units="Hz"),
    "highest_rad": ColumnWords(long_name="largest rotation of the orbit", units="rad"),
    "lowest_rad": ColumnWords(long_name="smallest rotation of the orbit", units="rad"),
}


def branch_rows(branch: Branch) -> list[dict[str, object]]:
    """Return one row per point."""
    return [point_row(1, point, branch.lean, BARE) for point in branch.points]


def branch_dataset(branch: Branch) -> "xarray.Dataset":
    """Return the points, as `Branch.to_dataset` states."""
    data = branches_dataset([branch], BARE).drop_vars("branch")
    return data.assign_attrs(parameter=branch.parameter, model=branch.model.name)


def branches_dataset(branches: Sequence[Branch], block: AnyBlock) -> "xarray.Dataset":
    """Return the points of branches, one branch after another.

    Parameters
    ----------
    branches
        In the order of their numbers, from 1.
    block
        In whose g, Hz and radians values stand beside, if it has a size.
    """
    import xarray

    rows, peaks = [], []
    for place, branch in enumerate(branches, start=1):
        for point, flights in zip(branch.points, branch.peaks, strict=True):
            rows.append(point_row(place, point, branch.lean, block))
            peaks.append(branch.lean * flights)
    words = {
        "branch": ColumnWords(long_name="number of the branch, from 1", missing=0),
        "type": ColumnWords(long_name="what is special about the point", flags=tuple(PointType)),
        **PARAMETER_WORDS,
        **ORBIT_WORDS,
        "stable": ColumnWords(long_name="whether it is a stable motion", units=""),
        "admissible": ColumnWords(long_name="whether no flight passes the floor", units=""),
        **MULTIPLIER_WORDS,
        **EXTREMES,
        "arclength": ColumnWords(long_name="arclength from the start of the branch"),
        **(SI if rows else {}),
    }
    variables = variables_of(rows, "point", words)
    along = {name: variables.pop(name) for name in PARAMETER_WORDS}
    sides: Variable = (
        ("point", "flight"),
        padded(peaks),
        {"long_name": "extreme theta/alpha of each flight, with its side", "units": "1"},
    )
    return xarray.Dataset({**variables, "peaks": sides}, coords=along)


def cascade_dataset(cascade: Cascade) -> "xarray.Dataset":
    """Return the doublings of a cascade, with the distances between them and their ratios."""
    import xarray

    rows = [
        {
            **{name: getattr(point, name) for name in PARAMETER_WORDS},
            **row,
            "impacts": point.impacts,
        }
        for row, point in zip(_doublings(cascade), cascade.points, strict=True)
    ]
    words = {
        **PARAMETER_WORDS,
        "period": ColumnWords(long_name="forcing periods of what is doubled", missing=0),
        "impacts": ColumnWords(long_name="impacts in a period of it", missing=0),
        "distance": ColumnWords(long_name="from this doubling to the next in the parameter"),
        "ratio": ColumnWords(long_name="distance to this doubling over that to the next"),
    }
    variables = variables_of(rows, "doubling", words)
    along = {name: variables.pop(name) for name in PARAMETER_WORDS}
    number: Variable = (
        ("doubling",),
        np.arange(1, len(rows) + 1),
        {"long_name": "number of the doubling", "units": "1"},
    )
    attributes = {
        "parameter": cascade.parameter,
        "limit": cascade.limit,
        "model": cascade.model.name,
    }
    return xarray.Dataset(variables, coords={"doubling": number, **along}, attrs=attributes)
