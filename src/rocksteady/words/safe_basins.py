"""Words of safe basins: of their erosion, and of fates under a base motion that ends."""

import math
from typing import TYPE_CHECKING

from rocksteady.dynamics.basins.erosion import Erosion, IntegrityDrop
from rocksteady.dynamics.basins.fate_basins import FateBasins, FateShare
from rocksteady.dynamics.batch.finite import OUTPUTS
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import (
    amplitude_text,
    attributes_of,
    block_text,
    case_text,
    frequency_text,
    harmonic_values,
    peak_unit,
)
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import CONFIDENCE, number, number_or_none, plural, quantity
from rocksteady.results.result import describes
from rocksteady.words.windows import (
    BETWEEN,
    axis_facts,
    coordinates_of,
    ends_text,
    fraction_described,
    left_text,
    shares_sentence,
    window_text,
    with_between,
)

if TYPE_CHECKING:
    import xarray


@describes(Erosion)
def describe_erosion(erosion: Erosion) -> Description:
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
    sentence, screen = erosion_answer(erosion)
    headline = erosion_headline(erosion)
    return Description(headline, [*screen, *facts], [table], [note], sentence)


def _no_tangency(erosion: Erosion) -> str:
    """Return why there is no amplitude of the heteroclinic tangency."""
    if erosion.block.one_sided:
        return "none: against a wall there is one saddle"
    return "no closed form in the nonlinear model"


def erosion_headline(erosion: Erosion) -> str:
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


def drop_text(erosion: Erosion, measure: str) -> str:
    """Return where a measure falls below the level, in words."""
    drop = erosion.drops[measure]
    if drop is None:
        return f"does not fall below 0.5 up to A = {number(float(erosion.amplitude[-1]))}"
    low, high = f"{drop.low:.4f}", f"{drop.high:.4f}"
    return f"falls below {drop.level:g} between A = {low} and {high}"


def erosion_answer(erosion: Erosion) -> tuple[str, list[Fact]]:
    """Return the amplitudes at which half of the safe basin is lost."""
    block = erosion.block
    last = peak_unit(block, float(erosion.amplitude[-1]))
    drops = {
        name: peak_unit(block, drop.high) if drop else "" for name, drop in erosion.drops.items()
    }
    area, radius = drops["global_integrity"], drops["integrity_factor"]
    sentence = f"Half of the safe area is lost at {area}"
    sentence += f", half of its radius at {radius}." if radius else "."
    if not area:
        sentence = f"Half or more of the safe area is left up to {last}"
        sentence += f"; half of its radius is lost at {radius}." if radius else "."
    tangency = erosion.heteroclinic
    ends = (erosion.global_integrity[-1], erosion.integrity_factor[-1])
    area_left, radius_left = (left_text(float(end)) for end in ends)
    left = f"{area_left} of the area, {radius_left} of the radius"
    return (
        sentence,
        [
            line(f"left at {last}", left),
            line("begins at", f"{peak_unit(block, tangency)}, the tangency" if tangency else ""),
            line(
                "safe", f"stands {plural(erosion.cycles, 'period')}; against that of a base at rest"
            ),
            line("starts", f"{erosion.safe[0].size:,}: {ends_text(erosion)}"),
            line("computed", f"{erosion.model.name}; {case_text(block)}"),
        ],
    )


def erosion_dataset(erosion: Erosion) -> "xarray.Dataset":
    """Return measures and basins, as `Erosion.to_dataset` states."""
    import xarray

    tangency = erosion.heteroclinic
    along = ("amplitude",)
    return xarray.Dataset(
        {
            "global_integrity": (along, erosion.global_integrity, {"units": "1"}),
            "integrity_factor": (along, erosion.integrity_factor, {"units": "1"}),
            "safe": (("amplitude", "velocity", "angle"), erosion.safe, {"units": "1"}),
        },
        coords={
            "amplitude": (along, erosion.amplitude, {"long_name": "a_max/(alpha g)"}),
            **coordinates_of(erosion, "velocity", "angle"),
        },
        attrs={
            "frequency_ratio": erosion.motion.frequency_ratio,
            "phase": erosion.motion.phase,
            **attributes_of(erosion.block, erosion.model),
            "cycles": erosion.cycles,
            **({} if tangency is None else {"heteroclinic_amplitude": tangency}),
            "still_share": erosion.still_share,
            "still_radius": erosion.still_radius,
        },
    )


@describes(IntegrityDrop)
def describe_drop(drop: IntegrityDrop) -> Description:
    """Return the two amplitudes and the measure at them."""
    words = drop.measure.replace("_", " ")
    between = f"{number(drop.low, 4)} to {number(drop.high, 4)}"
    facts = [
        Fact("measure", drop.measure, "measure", words),
        Fact("level", drop.level, "level"),
        Fact("low", drop.low, "amplitude A", between),
        Fact("high", drop.high),
        Fact("above", drop.above, "measure at these", f"{drop.above:.4f}, {drop.below:.4f}"),
        Fact("below", drop.below),
    ]
    return Description(f"{words} falls below {drop.level:g} at A = {between}", facts)


@describes(FateBasins)
def describe_fates(fates: FateBasins) -> Description:
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
    parts = fates.fractions()
    rows = [part.to_dict() for part in parts]
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
    tables = [Table("fractions", rows), Table("", with_between(rows, parts), columns)]
    sentence, screen = fates_answer(fates)
    return Description(fates_headline(fates), [*screen, *facts], tables, notes, sentence)


def fates_headline(fates: FateBasins) -> str:
    """Return what the fates are of, in a line."""
    words = motion_text(fates.block, fates.motion)
    return f"Fates under {words}: {case_text(fates.block)}, {fates.model.name} model"


def _moment(fates: FateBasins) -> list[Fact]:
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


def fates_answer(fates: FateBasins) -> tuple[str, list[Fact]]:
    """Return the share of each fate, and the safe states that remain."""
    parts = fates.fractions()
    words = {
        Status.OVERTURNED: "fall",
        Status.AT_REST: "come to rest",
        Status.ROCKING: "keep rocking",
        Status.LOST_CONTACT: "leave the base",
        Status.UNDECIDED: "are undecided",
    }
    order = [Status.OVERTURNED, *(status for status in Status if status != Status.OVERTURNED)]
    ends = [(words[p.fate], p.share) for status in order for p in parts if p.fate == status]
    sides = " and ".join(
        f"{100.0 * part.share:.1f} % to the {'positive' if part.side > 0 else 'negative'} side"
        for part in parts
        if part.fate == Status.OVERTURNED
    )
    still = fates.global_integrity
    safe = f"{left_text(still)} of the safe area without the motion"
    safe += f", {left_text(fates.integrity_factor)} of its radius"
    facts = [
        line("falls", sides),
        line("left of it", "" if math.isnan(still) else safe),
        line("starts", f"{fates.fate.size:,}: {ends_text(fates)}"),
        line("computed", f"{fates.model.name}; {case_text(fates.block)}"),
    ]
    return shares_sentence(ends, fates.undecided), facts


def fates_dataset(fates: FateBasins) -> "xarray.Dataset":
    """Return the fates, as `FateBasins.to_dataset` states."""
    import xarray

    plane = ("velocity", "angle")
    measures = {
        name: float(getattr(fates, name)) for name in ("global_integrity", "integrity_factor")
    }
    return xarray.Dataset(
        {
            **{each.name: (plane, getattr(fates, each.name), each.attributes) for each in OUTPUTS},
            "still_safe": (plane, fates.still_safe, {"units": "1"}),
        },
        coords=coordinates_of(fates, "velocity", "angle"),
        attrs={
            "title": fates_headline(fates),
            "time_pt": fates.time_pt,
            **attributes_of(fates.block, fates.model),
            "safe_share": fates.safe_share,
            "still_share": fates.still_share,
            **{name: value for name, value in measures.items() if not math.isnan(value)},
        },
    )


@describes(FateShare)
def describe_share(share: FateShare) -> Description:
    """Return the share with its interval."""
    return fraction_described(
        share,
        share.name,
        Fact("fate", share.fate.label),
        Fact("side", share.side),
        Fact("name", share.name, "fate"),
    )
