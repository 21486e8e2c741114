"""Facts, tables and notes of basins and of their erosion.

The two classes import this module, so that their types have no name here.
"""

from typing import Any

from rocksteady.dynamics.basins._fractions import BETWEEN, with_between
from rocksteady.dynamics.basins.basin_answers import basins_answer, erosion_answer
from rocksteady.dynamics.basins.window import axis_facts, window_text
from rocksteady.dynamics.orbits.orbit_facts import plain_orbit
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import (
    amplitude_text,
    block_text,
    case_text,
    frequency_text,
    harmonic_values,
    lean_text,
)
from rocksteady.outcomes import AttractorKind
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import CONFIDENCE, number, plural


def basins_described(basins: Any) -> Description:
    """Return the facts of basins: shares, attractors, window and case."""
    block, motion = basins.block, basins.motion
    drawn = basins.seed is not None  # no probability belongs to the middles of the cells
    values = harmonic_values(block, motion)
    case = f"{amplitude_text(block, motion.amplitude)}, " + frequency_text(
        block, motion.frequency_ratio
    )
    facts = [
        Fact("block", values.pop("block"), "block", block_text(block))
        if isinstance(block, Block)
        else Fact("", label="block", text=block_text(block)),
        Fact("", label="base motion", text=f"{case}, phase {number(motion.phase)} rad"),
        *(Fact(key, value) for key, value in values.items()),
        Fact("phase", motion.phase),
        Fact("model", basins.model.name, "model"),
        Fact("", label="states", text=f"{basins.label.size:,} of {window_text(basins)}"),
        Fact("cycles", basins.max_cycles, "followed for", f"{basins.max_cycles} periods at most"),
        Fact("seed", basins.seed, "seed" if drawn else ""),
        Fact("confidence", CONFIDENCE if drawn else None),
        *axis_facts(basins),
        Fact("erosion"),
        Fact("drop"),
        Fact("shares"),
    ]
    rows = []
    for attractor, part in zip(basins.attractors, basins.fractions(), strict=True):
        orbit = attractor.orbit
        rows.append(
            {
                **attractor.to_dict(),
                **part.to_dict(),
                "stroboscopic": basins.stroboscopic[part.label].tolist(),
                "orbit": None if orbit is None else plain_orbit(orbit, block, motion),
            }
        )

    def lean(value: float | None) -> str:
        return "" if value is None else lean_text(block, value)

    columns = [
        Column("name", "basin", left=True),
        Column("share", "share", lambda share: f"{100.0 * share:.2f} %"),
        *([BETWEEN] if drawn else []),
        Column("period", "period", lambda period: str(period or "")),
        Column("lowest", "lowest", lean),
        Column("highest", "highest", lean),
    ]
    notes = []
    if any(attractor.kind is AttractorKind.APERIODIC for attractor in basins.attractors):
        notes.append(
            f"Aperiodic: not settled within {basins.max_cycles} periods, and neighbours part. More "
            "periods distinguish chaos from a long transient."
        )
    if basins.undecided and block.lossless:
        notes.append("Without loss (restitution 1) motions do not settle.")
    elif basins.undecided:
        notes.append("States are undecided: they balance for ever, or take more periods to follow.")
    return Description(
        f"{plural(len(rows), 'basin')} at phase {number(motion.phase)} rad: {case}, "
        f"{case_text(block)}, {basins.model.name} model",
        facts,
        [Table("fractions", rows), Table("", with_between(rows) if drawn else rows, columns)],
        notes,
        basins_answer(basins),
    )


def _no_tangency(erosion: Any) -> str:
    """Return why there is no amplitude of the heteroclinic tangency."""
    if erosion.block.one_sided:
        return "none: against a wall there is one saddle"
    return "no closed form in the nonlinear model"


def erosion_described(erosion: Any) -> Description:
    """Return the facts of an erosion: measures by amplitude, drops, window and case."""
    block, motion = erosion.block, erosion.motion
    sized = isinstance(block, Block)
    columns = {
        "amplitude": erosion.amplitude,
        **(
            {"accel_g": in_g(erosion.amplitude * block.uplift_acceleration)}
            if isinstance(block, Block)
            else {}
        ),
        "global_integrity": erosion.global_integrity,
        "integrity_factor": erosion.integrity_factor,
        "safe_share": erosion.safe_share,
        "radius": erosion.radius,
    }
    rows = [
        dict(zip(columns, row, strict=True))
        for row in zip(*(values.tolist() for values in columns.values()), strict=True)
    ]
    values = harmonic_values(block, motion)
    for name in ("amplitude", "accel_g"):  # there are many of them
        values.pop(name, None)
    tangency = erosion.heteroclinic
    facts = [
        Fact("block", values.pop("block"), "block", block_text(block))
        if sized
        else Fact("", label="block", text=block_text(block)),
        Fact(
            "",
            label="base motion",
            text=f"{frequency_text(block, motion.frequency_ratio)}, phase "
            f"{number(motion.phase)} rad, {plural(len(rows), 'amplitude')}",
        ),
        *(Fact(key, value) for key, value in values.items()),
        Fact("phase", motion.phase),
        Fact("model", erosion.model.name, "model"),
        Fact("", label="states", text=f"{erosion.safe[0].size:,} of {window_text(erosion)}"),
        Fact("cycles", erosion.cycles, "stand", plural(erosion.cycles, "period")),
        Fact(
            "heteroclinic_amplitude",
            tangency,
            "heteroclinic tangency",
            _no_tangency(erosion) if tangency is None else amplitude_text(block, tangency),
        ),
    ]
    if isinstance(block, Block):
        value = None if tangency is None else in_g(tangency * block.uplift_acceleration)
        facts.append(Fact("heteroclinic_accel_g", value))
    facts += [
        Fact("", label=drop_label(measure), text=drop_text(erosion, measure))
        for measure in erosion.drops
    ]
    facts += [
        Fact("drop", {name: drop and drop.to_dict() for name, drop in erosion.drops.items()}),
        Fact("still", {"safe_share": erosion.still_share, "radius": erosion.still_radius}),
        *axis_facts(erosion),
        Fact("fractions"),
        Fact("shares"),
    ]
    shown = [
        Column("amplitude", "amplitude A", lambda value: f"{value:.6g}"),
        *([Column("accel_g", "accel [g]")] if sized else []),
        Column("integrity_factor", "integrity factor", lambda value: f"{value:.4f}"),
        Column("global_integrity", "global integrity", lambda value: f"{value:.4f}"),
    ]
    note = "Both are 1 on a still base: the radius of the largest safe circle and the safe area."
    table = Table("erosion", rows, shown, most=max(len(rows), 1))
    return Description(erosion_headline(erosion), facts, [table], [note], erosion_answer(erosion))


def erosion_headline(erosion: Any) -> str:
    """Return what an erosion is of, in a line."""
    motion, block = erosion.motion, erosion.block
    return (
        f"Erosion of the safe basin at phase {number(motion.phase)} rad: "
        f"{frequency_text(block, motion.frequency_ratio)}, {case_text(block)}, "
        f"{erosion.model.name} model"
    )


def drop_label(measure: str) -> str:
    """Return a measure of integrity in words."""
    return measure.replace("_", " ")


def drop_text(erosion: Any, measure: str) -> str:
    """Return where a measure falls below the level, in words."""
    drop = erosion.drops[measure]
    if drop is None:
        return f"does not fall below 0.5 up to A = {number(float(erosion.amplitude[-1]))}"
    low, high = f"{drop.low:.4f}", f"{drop.high:.4f}"
    return f"falls below {drop.level:g} between A = {low} and {high}"
