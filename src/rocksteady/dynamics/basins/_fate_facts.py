"""Facts and tables of fates over a window of initial states.

The class imports this module, so that its type has no name here.
"""

import math
from typing import Any

from rocksteady.dynamics.basins._fractions import BETWEEN, with_between
from rocksteady.dynamics.basins.basin_answers import fates_answer
from rocksteady.dynamics.basins.window import axis_facts, window_text
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import block_text, case_text
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import CONFIDENCE, number, number_or_none, quantity


def fates_headline(fates: Any) -> str:
    """Return what the fates are of, in a line."""
    words = motion_text(fates.block, fates.motion)
    return f"Fates under {words}: {case_text(fates.block)}, {fates.model.name} model"


def fates_described(fates: Any) -> Description:
    """Return the facts of fates: shares, integrity, window and case."""
    block = fates.block
    facts = [
        Fact("block", block.to_dict(), "block", block_text(block)),
        Fact("motion", motion_text(fates.block, fates.motion), "base motion"),
        *motion_facts(block, fates.motion),
        *_moment(fates),
        Fact("model", fates.model.name, "model"),
        Fact("", label="states", text=f"{fates.fate.size:,} of {window_text(fates)}"),
        Fact("safe_share", fates.safe_share, "safe", f"{100.0 * fates.safe_share:.2f} %"),
        Fact("still_share", fates.still_share),
        Fact(
            "global_integrity",
            number_or_none(fates.global_integrity),
            "global integrity",
            _text(fates.global_integrity),
        ),
        Fact(
            "integrity_factor",
            number_or_none(fates.integrity_factor),
            "integrity factor",
            _text(fates.integrity_factor),
        ),
        Fact("radius", fates.radius),
        Fact("still_radius", fates.still_radius),
        Fact("largest_safe_peak", number_or_none(fates.largest_safe_peak)),
        Fact("confidence", CONFIDENCE),
        *axis_facts(fates),
    ]
    rows = [part.to_dict() for part in fates.fractions()]
    columns = [
        Column("name", "fate", left=True),
        Column("states", "states", lambda states: f"{states:,}"),
        Column("share", "share", lambda share: f"{100.0 * share:.2f} %"),
        BETWEEN,
    ]
    notes = ["Integrity is 1 on a still base: the safe area, and the radius of its largest circle."]
    rare = (Status.LOST_CONTACT, Status.UNDECIDED)
    notes += [status.advice for status in rare if (fates.fate == status).any()]
    if (fates.fate == Status.ROCKING).any():
        notes.append("Still rocking: without loss (restitution 1), or balanced to rounding.")
    tables = [Table("fractions", rows), Table("", with_between(rows), columns)]
    return Description(fates_headline(fates), facts, tables, notes, fates_answer(fates))


def _moment(fates: Any) -> list[Fact]:
    """Return the moment of the states, in seconds too where the block has a size."""
    facts = [Fact("time_pt", fates.time_pt)]
    words = f"pt {number(fates.time_pt)}"
    if isinstance(fates.block, Block):
        seconds = fates.time_pt / fates.block.p
        facts.append(Fact("time_s", seconds))
        words = f"{quantity(seconds, 's')} ({words})"
    return [*facts, Fact("", label="states at", text=words)] if fates.time_pt else facts


def _text(value: float) -> str:
    return "none: no state is safe on a still base" if math.isnan(value) else f"{value:.4f}"
