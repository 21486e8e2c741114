"""Words of branches of orbits that come to rest."""

import math
from collections.abc import Sequence

import numpy as np

from rocksteady.dynamics.continuation.resting.find_resting import RestingBranches
from rocksteady.dynamics.continuation.resting.resting_branch import (
    Excursion,
    RestingBranch,
    RestingPoint,
)
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Model
from rocksteady.model.facts import AnyBlock, block_text, block_values, case_text
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import describes
from rocksteady.words._branch_cases import (
    SHORT,
    in_si,
    multiplier_columns,
    place_values,
)

ENDS = {
    "end-of-rest": "rest end",
    "end-of-range": "range end",
    "grazing": "graze",
    "uplift": "uplift",
}
"""The types of points, shorter."""
STABLE_NOTE = "Both multipliers of an orbit with rest are 0: it is stable wherever it exists."


@describes(RestingPoint)
def describe_point(point: RestingPoint) -> Description:
    """Describe a point of a branch."""
    values, peaks = point_values(point), (point.highest, point.lowest)
    kind = f"{ENDS.get(point.type.value, point.type.value)} point"
    words = {
        "amplitude": ("A", f"{point.amplitude:.10g}"),
        "frequency_ratio": ("Ω", f"{point.frequency_ratio:.10g}"),
        "restitution": ("restitution", f"{point.restitution:.10g}"),
        "period": ("period", plural(point.period, "forcing period")),
        "rest_phases": ("comes to rest", plural(point.rest_phases, "time") + " in a period"),
        "peaks": (
            "highest, lowest",
            ", ".join(map(number, peaks)) + " alpha",
        ),
        "rests": ("rests for", ", ".join(map(number, point.rests.tolist())) + " rad"),
    }
    return Description(
        f"Orbit with rest, {kind}: A = {point.amplitude:.8g}, "
        f"Ω = {point.frequency_ratio:.8g}, {case_text(point.block)}, {point.model.name} model",
        [
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            Fact("excursions", [excursion_values(each) for each in point.excursions]),
            Fact("multipliers", [0j, 0j], "multipliers", "0, 0"),
            Fact("stable", True, "stable"),
            *model_facts(point.block, point.model),
        ],
    )


def point_values(point: RestingPoint) -> dict[str, object]:
    """Return a point as plain values, in SI too where the block has a size."""
    peaks = [point.highest, point.lowest]
    values: dict[str, object] = {
        **place_values(point),
        "rest_phases": point.rest_phases,
        "symmetric": point.symmetric,
        "peaks": peaks,
        "rests": point.rests.tolist(),
        "gains": point.gains,
        **in_si(point.block, point.amplitude, point.frequency_ratio),
    }
    if isinstance(point.block, Block):
        values["peaks_rad"] = [peak * point.block.alpha for peak in peaks]
    return values


def excursion_values(each: Excursion) -> dict[str, object]:
    """Return an excursion in plain values."""
    return {
        "side": each.side,
        "uplift_phase": each.uplift_phase,
        "impact_phases": each.impact_phases.tolist(),
        "peaks": each.peaks.tolist(),
        "chatter_end": each.chatter_end,
        "chatter_error": each.chatter_error,
        "half_cycles": each.half_cycles,
        "rest": each.rest,
    }


def resting_row(branch: int, point: RestingPoint) -> dict[str, object]:
    """Return the row of a point of a branch in a file."""
    first, lists = point.excursions[0], ("peaks", "rests", "peaks_rad")
    return {
        "branch": branch,
        **{key: value for key, value in point_values(point).items() if key not in lists},
        "stable": True,
        "highest": point.highest,
        "lowest": point.lowest,
        "side": first.side,
        "uplift_phase_rad": first.uplift_phase,
        "impacts_followed": sum(len(each.impacts) for each in point.excursions),
        "chatter_end_rad": first.chatter_end,
        "shortest_rest_rad": float(point.rests.min()),
        **_extremes_rad(point),
    }


def _extremes_rad(point: RestingPoint) -> dict[str, float]:
    """Return the extremes of a point [rad] where the block has a size, else nothing."""
    if not isinstance(point.block, Block):
        return {}
    alpha = point.block.alpha
    return {"highest_rad": point.highest * alpha, "lowest_rad": point.lowest * alpha}


def resting_rows(branch: RestingBranch, place: int = 1) -> list[dict[str, object]]:
    """Return one row per point of a branch, with the number of the branch."""
    return [resting_row(place, point) for point in branch.points]


def diagram_row(branch: int, point: RestingPoint) -> dict[str, object]:
    """Return the row of a point in the file of a diagram."""
    return {
        "branch": branch,
        **place_values(point),
        "impacts": None,  # infinitely many
        "symmetric": point.symmetric,
        "stable": True,
        "admissible": True,
        **multiplier_columns((0.0, 0.0)),
        "highest": point.highest,
        "lowest": point.lowest,
        "arclength": math.nan,
        **in_si(point.block, point.amplitude, point.frequency_ratio),
        **_extremes_rad(point),
    }


@describes(RestingBranch)
def describe_branch(branch: RestingBranch) -> Description:
    """Describe a branch."""
    values, symbol = resting_values(branch), SYMBOLS[branch.parameter]
    low, high = branch.within
    words = {
        "begin": ("from", ENDS.get(branch.begin.type.value, "")),
        "end": ("to", ENDS.get(branch.end.type.value, "")),
        "grazes": ("grazes", str(values["grazes"])),
        "points": ("points", str(values["points"])),
    }
    return Description(
        f"Branch with rest, {branch.kind}, {plural(branch.period, 'period')}: "
        f"{symbol} from {low:.8g} to {high:.8g}, {fixed_text(branch)}",
        [
            Fact("parameter", branch.parameter),
            *fixed_facts(branch),
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            *model_facts(branch.block, branch.model),
        ],
        [events_table([branch], key="events")],
        [STABLE_NOTE],
    )


def resting_values(branch: RestingBranch) -> dict[str, object]:
    """Return what a branch is, and its ends."""
    name = branch.parameter
    begin, end = (
        {"type": point.type.value, name: branch.value(point)}
        for point in (branch.begin, branch.end)
    )
    return {
        "period": branch.period,
        "rest_phases": branch.rest_phases,
        "symmetric": branch.symmetric,
        "begin": begin,
        "end": end,
        "within": list(branch.within),
        "highest": float(np.nanmax(np.abs(branch.peaks))),
        "grazes": sum(point.type.value == "grazing" for point in branch.points),
        "points": len(branch.points),
    }


@describes(RestingBranches)
def describe_branches(branches: RestingBranches) -> Description:
    """Return the branches, the events on them, and the gaps."""
    low, high = branches.within
    count = plural(len(branches.branches), "branch").replace("branchs", "branches")
    gaps = [
        {"from": gap.low, "to": gap.high, "reasons": [each.value for each in gap.reasons]}
        for gap in branches.gaps
    ]
    columns = [
        Column("from", f"from {SYMBOLS[branches.parameter]}", lambda value: f"{value:.8f}"),
        Column("to", "to", lambda value: f"{value:.8f}"),
        Column("reasons", "why", ", ".join, left=True),
    ]
    return Description(
        f"Orbits with rest: {SYMBOLS[branches.parameter]} from {low:.6g} to {high:.6g}, "
        f"{fixed_text(branches)}: {count}",
        [
            Fact("parameter", branches.parameter),
            Fact("within", list(branches.within)),
            *fixed_facts(branches),
            Fact("max_period", branches.max_period, "longest", f"{branches.max_period} periods"),
            Fact("resolution", branches.resolution, "step", f"{branches.resolution:.4g}"),
            *model_facts(branches.block, branches.model),
        ],
        [
            resting_table(branches.branches),
            events_table(branches.branches, key="events"),
            Table("gaps", gaps, columns, "none of them" if gaps else ""),
        ],
        [f"{STABLE_NOTE} Branches and gaps narrower than a step may be missed."],
    )


def model_facts(block: AnyBlock, model: Model) -> list[Fact]:
    """Return the facts of what moves, and in which model."""
    values = {"block": block_values(block)} if isinstance(block, Block) else {}
    return [
        Fact("block" if values else "", values.get("block"), "block", block_text(block)),
        Fact("model", model.name, "model"),
    ]


def fixed_facts(result: RestingBranch | RestingBranches) -> list[Fact]:
    """Return the three parameters of a branch; None for the varied parameter."""
    fixed = {
        "amplitude": result.motion.amplitude,
        "frequency_ratio": result.motion.frequency_ratio,
        "restitution": result.block.dimensionless().restitution,
        result.parameter: None,
    }
    return [Fact(name, value) for name, value in fixed.items()]


def fixed_text(result: RestingBranch | RestingBranches) -> str:
    """Return what stays fixed along a branch, for a headline."""
    parts = []
    for name, value in (
        ("amplitude", result.motion.amplitude),
        ("frequency_ratio", result.motion.frequency_ratio),
    ):
        if name != result.parameter:
            parts.append(f"{SYMBOLS[name]} = {number(value, 6)}")
    if result.parameter != "restitution":
        parts.append(case_text(result.block))
    return ", ".join([*parts, f"{result.model.name} model"])


def events_table(branches: Sequence[RestingBranch], *, key: str) -> Table:
    """Return the events on branches."""
    rows = [
        {"branch": place, **point_values(point)}
        for place, branch in enumerate(branches, start=1)
        for point in branch.events
    ]
    name = branches[0].parameter if branches else "amplitude"
    columns = [
        Column("branch", "branch"),
        Column("type", "event", lambda kind: ENDS.get(str(kind), str(kind)), left=True),
        Column(name, SHORT[name], lambda value: f"{value:.10f}"),
        Column("peaks", "highest", lambda peaks: f"{peaks[0]:.5g}"),
        Column("peaks", "lowest", lambda peaks: f"{peaks[1]:.5g}"),
        Column("rests", "shortest rest", lambda rests: f"{min(rests):.4g} rad"),
    ]
    return Table(
        key,
        rows,
        columns,
        "events on orbits with rest" if rows else "",
        kind=lambda row: ENDS.get(str(row["type"]), str(row["type"])),
    )


def resting_table(branches: Sequence[RestingBranch], *, key: str = "branches") -> Table:
    """Return branches for people and for JSON."""
    rows = [{"branch": place, **resting_values(branch)} for place, branch in enumerate(branches, 1)]

    def end(values: dict[str, object]) -> str:
        return ENDS.get(str(values["type"]), str(values["type"]))

    name = branches[0].parameter if branches else "amplitude"
    columns = [
        Column("branch", "branch"),
        Column("period", "period"),
        Column("rest_phases", "rests"),
        Column("symmetric", "kind", lambda s: "symmetric" if s else "unsymmetric", left=True),
        Column("within", f"from {SHORT[name]}", lambda ends: f"{ends[0]:.8f}"),
        Column("within", "to", lambda ends: f"{ends[1]:.8f}"),
        Column("begin", "begin", end, left=True),
        Column("end", "end", end, left=True),
        Column("highest", "highest", lambda u: f"{u:.4f}"),
    ]
    title = "orbits that come to rest, all stable" if rows else ""
    return Table(key, rows, columns, title)
