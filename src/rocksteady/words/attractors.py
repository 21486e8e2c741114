"""Words of attractors: of one, of many, and of those along a parameter."""

import math
from collections import Counter
from typing import TYPE_CHECKING

from rocksteady.dynamics.batch.attractors import Attractors
from rocksteady.dynamics.history.start import ImpactState, Rest, Start, Steady
from rocksteady.dynamics.orbits.attractor import KINDS, ROUNDED, Attractor
from rocksteady.dynamics.orbits.attractor_sweep import EXTREMES, AttractorSweep
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import has_mirror_images
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.dynamics.steady.verdicts import BEYOND
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import case_text, tilt_text
from rocksteady.outcomes import INFINITELY_MANY, NEVER_LIFTS, AttractorKind, motion_verb
from rocksteady.results.datasets import ColumnWords, padded, variables_of
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import angle, number, number_or_none, plural, quantity
from rocksteady.results.result import describes
from rocksteady.words.orbits import beyond_alpha, case_facts, kind_text, orbit_facts, where

if TYPE_CHECKING:
    import xarray

LESS = "less than 1 forcing period"
MOST_RUNS = 8
"""Runs of a sweep that a summary lists."""
MEANING = {
    "symmetric": "Half of the motion is the mirror image of the other half.",
    "unsymmetric": "The block leans to one side; the mirror image is an attractor too.",
    "asymmetric block": "The motion repeats; for a block whose sides differ none is symmetric.",
    "one-sided block": "The motion repeats, on the one side that the wall leaves to the block.",
    "even orders": "The motion repeats; shaking with even orders has no mirror images of motions.",
    "rest": "The block comes to rest, and the shaking does not lift it again.",
    "overturned": "The block falls: it is proved that it cannot come back to its base.",
    "aperiodic": "The motion does not repeat: motions beside it part at the rate of the exponent.",
}
_WORDS = {
    "kind": ColumnWords(
        long_name="what the motion settles to", flags=tuple(kind.value for kind in KINDS)
    ),
    "period": ColumnWords(long_name="forcing periods of the orbit; 0 without one", missing=0),
    "impacts": ColumnWords(
        long_name="impacts in a period of the orbit; 0 without one, -1 for infinitely many",
        missing=0,
    ),
    "highest": ColumnWords(long_name="largest theta/alpha of the orbit"),
    "lowest": ColumnWords(long_name="smallest theta/alpha of the orbit"),
    "lyapunov": ColumnWords(long_name="largest Lyapunov exponent per forcing period"),
    "after": ColumnWords(long_name="forcing periods until that was known", missing=0),
}


@describes(Attractor)
def describe_attractor(attractor: Attractor) -> Description:
    """Return what the motion settles to, its orbit, and when that was known."""
    names = ["kind", "reason", "period", "impacts_per_period", "rest_phases", "peaks"]
    names += ["multipliers", "lyapunov", "residual", "states"]
    if isinstance(attractor.block, Block):
        names += ["peaks_rad", "period_s"]
    facts = {name: Fact(name) for name in names[:6]}
    facts |= {"highest": Fact(""), "lowest": Fact("")}
    facts |= {name: Fact(name) for name in names[6:]}
    if attractor.orbit is not None:
        facts |= {fact.key or fact.label: fact for fact in orbit_facts(attractor.orbit)}
    elif attractor.peaks is not None:
        facts["peaks"] = Fact("peaks", list(attractor.peaks))
        if isinstance(attractor.block, Block):
            facts["peaks_rad"] = Fact(
                "peaks_rad", [u * attractor.block.alpha for u in attractor.peaks]
            )
    facts["kind"] = Fact("kind", attractor.kind.value, "kind")
    facts["reason"] = Fact("reason", attractor.reason or None)
    exponent = attractor.lyapunov if math.isfinite(attractor.lyapunov) else None
    text = "" if exponent is None else f"{number(exponent)} per forcing period"
    label = "" if exponent is None else "Lyapunov exponent"
    facts["lyapunov"] = Fact("lyapunov", exponent, label, text)
    periods = plural(attractor.after, "forcing period") if attractor.after else LESS
    # Of a fall with none the number is not known.
    unknown = attractor.kind is AttractorKind.OVERTURNED and not attractor.after
    known = ("", "") if unknown else ("known after", periods)
    meaning = attractor.kind.value
    if attractor.kind is AttractorKind.UNSYMMETRIC:
        if attractor.block.one_sided:
            meaning = "one-sided block"
        elif not attractor.block.symmetric:
            meaning = "asymmetric block"
        elif not has_mirror_images(attractor.block, attractor.motion):
            meaning = "even orders"
    notes = [attractor.reason or MEANING[meaning]]
    decided = (AttractorKind.APERIODIC, AttractorKind.UNDECIDED)
    if attractor.growth > ROUNDED and attractor.kind not in decided:
        notes.append(
            f"On the way small differences grew {attractor.growth:.0e}-fold: where several motions "
            "attract, a rounding may have chosen this one."
        )
    sentence, screen = attractor_answer(attractor)
    return Description(
        f"{kind_text(attractor.kind.value, attractor.period).capitalize()}: "
        + where(attractor.block, attractor.motion, attractor.model),
        [
            *screen,
            *facts.values(),
            Fact("settled_after_periods", attractor.after, *known),
            Fact("growth", attractor.growth),
            Fact("", label="start", text=start_text(attractor.initial)),
            *case_facts(attractor.block, attractor.motion, attractor.model),
        ],
        notes=notes,
        sentence=sentence,
    )


def attractor_answer(attractor: Attractor) -> tuple[str, list[Fact]]:
    """Return what a motion settles to, how stable that is and when it was known."""
    block, orbit, kind = attractor.block, attractor.orbit, attractor.kind
    start = start_text(attractor.initial)
    shrinks, rate = "", attractor.lyapunov
    if orbit is not None:
        left = "vanishes at each rest" if orbit.rest_phases else ""
        left = left or f"shrinks to {number(100.0 * math.exp(rate), 2)} % a period"
        shrinks = f"a disturbance {left}"
    mirrored = kind is AttractorKind.UNSYMMETRIC and has_mirror_images(block, attractor.motion)
    grown = ""
    decided = kind not in (AttractorKind.APERIODIC, AttractorKind.UNDECIDED)
    if decided and attractor.growth > ROUNDED:
        tens = round(math.log10(attractor.growth))
        grown = f"differences grew 10^{tens}-fold on the way: a rounding may have chosen"
    known = plural(attractor.after, "period") if attractor.after else ""
    facts = [
        line("rounding", grown),
        line("beyond alpha", BEYOND if orbit is not None and beyond_alpha(orbit) else ""),
        line("period", _period(orbit)),
        line("stable", shrinks),
        line("mirror image", "is an attractor too" if mirrored else ""),
        line("known after", f"{known}, from {start}" if known else ""),
        line("computed", f"{attractor.model.name}; {case_text(block)}"),
    ]
    return _settles(attractor), facts


def _settles(attractor: Attractor) -> str:
    """Return what a motion settles to, in a sentence."""
    kind, orbit, start = attractor.kind, attractor.orbit, start_text(attractor.initial)
    if orbit is not None:
        if orbit.symmetric:
            reach = f"{tilt_text(orbit.block, orbit.highest)} at most"
        elif isinstance(orbit.block, Block):
            ends = [angle(u * orbit.block.alpha) for u in (orbit.highest, orbit.lowest)]
            reach = f"from {ends[0]} to {ends[1]}"
        else:
            reach = f"from {number(orbit.highest)} to {number(orbit.lowest)} alpha"
        return f"It {motion_verb(kind, orbit.period)}, and leans {reach}."
    if kind is AttractorKind.UNDECIDED:
        return f"Undecided: {attractor.reason}."
    if kind is AttractorKind.OVERTURNED:
        return f"It falls: from this start ({start}) it reaches no steady motion."
    if kind is AttractorKind.REST:
        if isinstance(attractor.initial, Rest) and not attractor.after:
            return f"It {NEVER_LIFTS} under the motion."
        return f"It {kind.plain}, and the motion does not lift it again."
    grows = number(math.exp(attractor.lyapunov))
    return f"It {motion_verb(kind, None)}: a small difference grows {grows}-fold a period."


def _period(orbit: Orbit | None) -> str:
    """Return the period of an orbit and its impacts."""
    if orbit is None:
        return ""
    words = f"{plural(orbit.period, 'period')} of the base"
    if isinstance(orbit.block, Block):
        words += f" ({quantity(orbit.period / orbit.motion.frequency_hz(orbit.block), 's')})"
    if orbit.impacts is None:
        return f"{words}, {plural(orbit.rest_phases, 'rest')}, infinitely many impacts"
    return f"{words}, {plural(orbit.impacts, 'impact')}"


def start_text(start: Start) -> str:
    """Return a start in a word, as `--start` takes it where it can."""
    if isinstance(start, Rest):
        return "rest"
    if isinstance(start, Steady):
        return "steady" if start.branch == 1 else "steady:2"
    if isinstance(start, ImpactState):
        return f"impact at {number(start.phase)} rad"
    return f"{start.angle:.12g},{start.velocity:.12g}"


@describes(Attractors)
def describe_attractors(attractors: Attractors) -> Description:
    """Return the number of motions of each kind, with one row per motion."""
    counts = Counter(attractors.labels.tolist())
    words = ", ".join(f"{count:,} {name}" for name, count in counts.most_common())
    names = ("period", "impacts", "highest", "lowest", "lyapunov", "after")
    values = {"kind": attractors.labels.tolist()} | {
        name: [number_or_none(each) for each in getattr(attractors, name).tolist()]
        if getattr(attractors, name).dtype.kind == "f"
        else getattr(attractors, name).tolist()
        for name in names
    }
    rows = [dict(zip(values, row, strict=True)) for row in zip(*values.values(), strict=True)]
    columns = (
        Column("kind", "kind", left=True),
        Column("period", "period", str),
        Column("impacts", "impacts", lambda count: "inf" if count < 0 else str(count)),
        Column("highest", "highest", number),
        Column("lowest", "lowest", number),
        Column("after", "known after", str),
    )
    return Description(
        headline=f"{plural(len(rows), 'motion')}: {words}",
        facts=[
            Fact("motions", len(rows), "motions", f"{len(rows):,}"),
            Fact("kinds", dict(counts), "kinds", words),
            Fact("model", attractors.model.name, "model"),
        ],
        tables=[Table("attractors", rows, columns, kind=lambda row: str(row["kind"]))],
    )


@describes(AttractorSweep)
def describe_sweep(sweep: AttractorSweep) -> Description:
    """Return the runs of values that settle to one kind of motion."""
    name, symbol = sweep.parameter, SYMBOLS[sweep.parameter]
    ends = f"{symbol} from {sweep.values[0]:.6g} to {sweep.values[-1]:.6g}"
    counts = sweep.values_by_kind()
    met = ", ".join(f"{kind} {count}" for kind, count in counts.items())
    return Description(
        f"Attractors over {ends}: {met} of {plural(len(sweep.values), 'value')}, "
        f"{sweep.model.name} model",
        [
            Fact("parameter", name),
            Fact("direction", sweep.direction),
            Fact("start", start_text(sweep.start), "start"),
            Fact("values", len(sweep.values), "values", f"{len(sweep.values):,}: {ends}"),
            Fact("counts", counts),
            Fact("model", sweep.model.name, "model"),
        ],
        [Table("runs", sweep.run_rows()), sweep_table(sweep)],
    )


def sweep_table(sweep: AttractorSweep) -> Table:
    """Return the runs as people read them; of many the falls, then the longest."""
    way = "upward" if sweep.direction == "up" else "downward"
    listed = [{**row, "settles": kind_text(row["kind"], row["period"])} for row in sweep.run_rows()]
    falls = AttractorKind.OVERTURNED.value
    columns = [
        Column("from", SYMBOLS[sweep.parameter], lambda value: f"{value:.6g}"),
        Column("to", "to", lambda value: f"{value:.6g}"),
        Column("values", "values"),
        Column("settles", "settles to", left=True),
    ]
    return Table(
        "",
        listed,
        columns,
        f"{way} sweep from {start_text(sweep.start)}",
        most=MOST_RUNS,
        severity=lambda row: (row["kind"] == falls, row["values"]),
        kind=lambda row: str(row["kind"]),
        alarm=falls,
    )


def sweep_dataset(sweep: AttractorSweep) -> "xarray.Dataset":
    """Return the attractors over the parameter, and the peaks over flight too."""
    import xarray

    rows = [
        {
            "kind": attractor.kind.value,
            "period": attractor.period,
            "impacts": _impacts_code(attractor),
            **dict(zip(EXTREMES, attractor.peaks or (math.nan, math.nan), strict=True)),
            "lyapunov": attractor.lyapunov,
            "after": attractor.after,
        }
        for attractor in sweep.attractors
    ]
    name, flight = sweep.parameter, ("flight",)
    words = {"long_name": "extreme theta/alpha of each flight, with its side", "units": "1"}
    return xarray.Dataset(
        {
            **variables_of(rows, name, _WORDS),
            "peaks": ((name, *flight), padded(sweep.peaks), words),
        },
        coords={name: (name, sweep.values, {"units": "1"})},
        attrs={"parameter": name, "direction": sweep.direction, "model": sweep.model.name},
    )


def _impacts_code(attractor: Attractor) -> int:
    """Return the impacts in a period as maps code them."""
    if attractor.orbit is None:
        return 0
    return INFINITELY_MANY if attractor.orbit.impacts is None else attractor.orbit.impacts
