"""Words of basins of attraction: of a window, its attractors and their shares."""

from typing import TYPE_CHECKING

from rocksteady.dynamics.basins.basins import Basins, BasinShare
from rocksteady.dynamics.basins.labels import BasinAttractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.steady.verdicts import BEYOND
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import (
    amplitude_text,
    attributes_of,
    block_text,
    case_text,
    frequency_text,
    harmonic_values,
    lean_text,
    solved_text,
    tilt_text,
)
from rocksteady.outcomes import INFINITELY_MANY, AttractorKind
from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import CONFIDENCE, number, plural
from rocksteady.results.result import describes
from rocksteady.words.orbits import beyond_alpha, plain_orbit
from rocksteady.words.windows import (
    BETWEEN,
    MOST_BASINS,
    axis_facts,
    basin_name,
    coordinates_of,
    ends_text,
    fraction_described,
    shares_sentence,
    window_text,
    with_between,
)

if TYPE_CHECKING:
    import xarray


ENDS = {AttractorKind.OVERTURNED: "fall", AttractorKind.REST: "come to rest"}
"""What becomes of the starts of a basin, besides rocking on."""
LONGER = "they balance for ever, or take more periods to follow"


@describes(Basins)
def describe_basins(basins: Basins) -> Description:
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
    sentence, screen = basins_answer(basins)
    shown = with_between(rows, basins.fractions()) if drawn else rows
    return Description(
        f"{plural(len(rows), 'basin')} at phase {number(motion.phase)} rad: {case}, "
        f"{case_text(block)}, {basins.model.name} model",
        [*screen, *facts],
        [Table("fractions", rows), Table("", shown, columns)],
        notes,
        sentence,
    )


def basins_answer(basins: Basins) -> tuple[str, list[Fact]]:
    """Return the shares of the basins, the largest listed."""
    shares = [part.share for part in basins.fractions()]
    pairs = sorted(zip(basins.attractors, shares, strict=True), key=lambda pair: -pair[1])
    ends = [
        (ENDS.get(each.kind, "are undecided" if _open(each) else "keep rocking"), share)
        for each, share in sorted(
            pairs, key=lambda pair: pair[0].kind is not AttractorKind.OVERTURNED
        )
    ]
    rows = []
    for each, share in pairs[:MOST_BASINS]:
        words, orbit = [f"{100.0 * share:.1f} %"], each.orbit
        does, further = basin_name(each.kind, each.period, each.name)
        if basins.seed is not None:
            part = basins.fractions()[each.label]
            words[0] += f" (90 %: {100.0 * part.low:.1f} to {100.0 * part.high:.1f} %)"
        if orbit is not None:
            words += [further] * bool(further) + [f"tilt {tilt_text(basins.block, _reach(orbit))}"]
        rows.append(line(does, ", ".join(words)))
    left = pairs[MOST_BASINS:]
    total = sum(share for _, share in left)
    beyond = sum(each.orbit is not None and beyond_alpha(each.orbit) for each in basins.attractors)
    settle = "without loss motions do not settle" if basins.block.lossless else LONGER
    facts = [
        line("undecided", settle if basins.undecided else ""),
        *rows,
        left_out(len(left), f"{100.0 * total:.1f} %"),
        line("beyond alpha", f"{plural(beyond, 'motion')}: {BEYOND}" if beyond else ""),
        line("starts", f"{basins.label.size:,}: {ends_text(basins)}"),
        line("computed", f"{basins.model.name}; at most {basins.max_cycles} periods"),
        line("boundary", "not measured: --entropy and --exponent measure it"),
    ]
    sentence = shares_sentence(ends, basins.undecided).removesuffix(".")
    return f"{solved_text(sentence, basins.block)}.", facts


def _open(attractor: BasinAttractor) -> bool:
    return bool(attractor.kind is AttractorKind.UNDECIDED)


def _reach(orbit: Orbit) -> float:
    """Return the largest tilt of an orbit."""
    return float(max(orbit.highest, -orbit.lowest))


def basins_dataset(basins: Basins) -> "xarray.Dataset":
    """Return labels and attractors, as `Basins.to_dataset` states."""
    import xarray

    names = [attractor.name for attractor in basins.attractors]
    flags = {"flag_values": list(range(len(names))), "flag_meanings": " ".join(names)}
    plane, along = ("velocity", "angle"), ("attractor",)
    fractions = basins.fractions()
    counts = (attractor.impacts for attractor in basins.attractors)
    impacts = [INFINITELY_MANY if count is None else count for count in counts]
    return xarray.Dataset(
        {
            "label": (plane, basins.label, {"long_name": "attractor", "units": "1", **flags}),
            "start_angle": (plane, basins.start_angle, {"units": "1"}),
            "start_velocity": (plane, basins.start_velocity, {"units": "1"}),
            "kind": (along, [str(attractor.kind.value) for attractor in basins.attractors]),
            "period": (along, [attractor.period or 0 for attractor in basins.attractors]),
            "impacts": (along, impacts, {"infinitely_many": INFINITELY_MANY}),
            "states": (along, basins.states),
            "share": (along, [fraction.share for fraction in fractions], {"units": "1"}),
        },
        coords={
            **coordinates_of(basins, "angle", "velocity", units="1"),
            "attractor": ("attractor", names),
        },
        attrs={
            "amplitude": basins.motion.amplitude,
            "frequency_ratio": basins.motion.frequency_ratio,
            "phase": basins.motion.phase,
            **attributes_of(basins.block, basins.model),
            "max_cycles": basins.max_cycles,
            "seed": "none" if basins.seed is None else str(basins.seed),
        },
    )


@describes(BasinShare)
def describe_share(share: BasinShare) -> Description:
    """Return the share with its interval."""
    return fraction_described(share, f"basin {share.label}", Fact("label", share.label, "label"))


@describes(BasinAttractor)
def describe_attractor(attractor: BasinAttractor) -> Description:
    """Return the kind, the period and the extrema of the attractor."""
    if attractor.orbit is None:
        return Description(str(attractor.kind.value), _attractor_facts(attractor))
    periods = plural(attractor.orbit.period, "period")
    extent = f"{number(attractor.orbit.lowest)} to {number(attractor.orbit.highest)} alpha"
    return Description(f"{attractor.kind.value}, {periods}, {extent}", _attractor_facts(attractor))


def _attractor_facts(attractor: BasinAttractor) -> list[Fact]:
    facts = [
        Fact("label", attractor.label, "label"),
        Fact("name", attractor.name, "name"),
        Fact("kind", str(attractor.kind.value), "kind"),
        Fact("period", attractor.period, "forcing periods"),
        Fact("impacts", attractor.impacts, "impacts in a period"),
        Fact("lowest", None if attractor.orbit is None else attractor.orbit.lowest),
        Fact("highest", None if attractor.orbit is None else attractor.orbit.highest),
    ]
    if attractor.orbit is not None:
        least, most = (
            lean_text(attractor.orbit.block, lean)
            for lean in (attractor.orbit.lowest, attractor.orbit.highest)
        )
        facts.append(Fact("", label="extrema", text=f"{least} to {most}"))
    return facts
