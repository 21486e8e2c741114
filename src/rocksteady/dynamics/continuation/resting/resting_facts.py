"""Facts of branches of orbits with rest, for texts, JSON and tables."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rocksteady.dynamics.continuation.branch_facts import SHORT, multiplier_columns, place_values
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import AnyBlock, block_text, block_values, case_text
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural

# The classes that use this module are named Any: to import them would close a circle.

ENDS = {
    "end-of-rest": "rest end",
    "end-of-range": "range end",
    "grazing": "graze",
    "uplift": "uplift",
}
"""The types of points, shorter."""
STABLE_NOTE = "Both multipliers of an orbit with rest are 0: it is stable wherever it exists."


def in_si(block: AnyBlock, motion: Harmonic) -> dict[str, float]:
    """Return harmonic motion in g and Hz where the block has a size, else nothing."""
    if not isinstance(block, Block):
        return {}
    accel_g = in_g(motion.acceleration_m_s2(block))
    return {"accel_g": accel_g, "freq_hz": motion.frequency_hz(block)}


def excursion_values(each: Any) -> dict[str, Any]:
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


def point_values(point: Any) -> dict[str, Any]:
    """Return a point of a branch in plain values, in SI too where the block has a size."""
    values: dict[str, Any] = {
        **place_values(point),
        "rest_phases": point.rest_phases,
        "symmetric": point.symmetric,
        "peaks": [point.highest, point.lowest],
        "rests": point.rests.tolist(),
        "gains": point.gains,
        **in_si(point.block, point.motion),
    }
    if isinstance(point.block, Block):
        values["peaks_rad"] = [peak * point.block.alpha for peak in values["peaks"]]
    return values


def resting_row(branch: int, point: Any) -> dict[str, Any]:
    """Return the row of a point of a branch in a file."""
    values = point_values(point)
    high, low = values.pop("peaks")
    rests = values.pop("rests")
    radians = values.pop("peaks_rad", None)
    first = point.excursions[0]
    row = {
        "branch": branch,
        **values,
        "stable": True,
        "highest": high,
        "lowest": low,
        "side": first.side,
        "uplift_phase_rad": first.uplift_phase,
        "impacts_followed": sum(len(each.impacts) for each in point.excursions),
        "chatter_end_rad": first.chatter_end,
        "shortest_rest_rad": min(rests),
    }
    if radians is not None:
        row |= {"highest_rad": radians[0], "lowest_rad": radians[1]}
    return row


def diagram_row(branch: int, point: Any) -> dict[str, Any]:
    """Return the row of a point in the file of a diagram, with the columns of other branches."""
    row: dict[str, Any] = {
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
        **in_si(point.block, point.motion),
    }
    if isinstance(point.block, Block):
        alpha = point.block.alpha
        row |= {"highest_rad": point.highest * alpha, "lowest_rad": point.lowest * alpha}
    return row


def resting_values(branch: Any) -> dict[str, Any]:
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


def model_facts(block: AnyBlock, model: Any) -> list[Fact]:
    """Return the facts of what moves, and in which model."""
    values = {"block": block_values(block)} if isinstance(block, Block) else {}
    return [
        Fact("block" if values else "", values.get("block"), "block", block_text(block)),
        Fact("model", model.name, "model"),
    ]


def fixed_facts(result: Any) -> list[Fact]:
    """Return the three parameters of a branch; None for the varied parameter."""
    fixed = {
        "amplitude": result.motion.amplitude,
        "frequency_ratio": result.motion.frequency_ratio,
        "restitution": result.block.dimensionless().restitution,
        result.parameter: None,
    }
    return [Fact(name, value) for name, value in fixed.items()]


def fixed_text(result: Any) -> str:
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


def point_description(point: Any) -> Description:
    """Describe a point of a branch."""
    values = point_values(point)
    kind = f"{ENDS.get(point.type.value, point.type.value)} point"
    words = {
        "amplitude": ("A", f"{point.amplitude:.10g}"),
        "frequency_ratio": ("Ω", f"{point.frequency_ratio:.10g}"),
        "restitution": ("restitution", f"{point.restitution:.10g}"),
        "period": ("period", plural(point.period, "forcing period")),
        "rest_phases": ("comes to rest", plural(point.rest_phases, "time") + " in a period"),
        "peaks": ("highest, lowest", ", ".join(map(number, values["peaks"])) + " alpha"),
        "rests": ("rests for", ", ".join(map(number, values["rests"])) + " rad"),
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


def branch_description(branch: Any) -> Description:
    """Describe a branch."""
    values, symbol = resting_values(branch), SYMBOLS[branch.parameter]
    low, high = branch.within
    words = {
        key: ("from" if key == "begin" else "to", ENDS.get(str(values[key]["type"]), ""))
        for key in ("begin", "end")
    }
    words["grazes"] = ("grazes", str(values["grazes"]))
    words["points"] = ("points", str(values["points"]))
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


def events_table(branches: Sequence[Any], *, key: str) -> Table:
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


def resting_table(branches: Sequence[Any], *, key: str = "branches") -> Table:
    """Return branches for people and for JSON."""
    rows = [{"branch": place, **resting_values(branch)} for place, branch in enumerate(branches, 1)]

    def end(values: dict[str, Any]) -> str:
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
