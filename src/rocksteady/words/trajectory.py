"""Words of time histories: how a run ended, its block and base motion, peaks and times."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import ModelError
from rocksteady.kernels.core import tables as columns
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import ROUNDED
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion, Still
from rocksteady.outcomes import BALANCED, Status
from rocksteady.results.description import GIVEN, Description, Fact, line
from rocksteady.results.numbers import angle, force_words, length, number, plural, quantity

if TYPE_CHECKING:
    import xarray

DECIDED_BY_ROUNDING = 1e12
"""Growth of a small difference above which rounding decides how a run goes on."""
ROCKING_ALONE: Final = "without sliding"
"""Label of how a run ends that takes more friction than there is."""


def describe_trajectory(
    run: Trajectory, mass_kg: float | None, friction: float | None
) -> Description:
    """Return the facts and notes of a time history."""
    facts = [
        Fact("model", run.model.name),
        Fact("status", run.status.label, "status"),
        *_peaks(run),
        Fact("impacts", run.impact_count, "impacts"),
        Fact("flights", len(run.rows)),
        *_restitutions(run),
        *_times(run),
        *motion_facts(run.block, run.motion, run.vertical),
        *_body(run),
        *_demands(run, friction),
        *_qualification(run, mass_kg),
    ]
    grown = run.growth
    factor = grown if math.isfinite(grown) else None
    words = f"{number(grown)}-fold" if factor is not None else "without bound"
    facts.append(Fact("growth", factor, "a small difference grows", words))
    notes = [f"The block {BALANCED}." if run.balanced else run.status.advice]
    if grown > DECIDED_BY_ROUNDING:
        notes.append(
            f"A small difference grows {words}: rounding decides how the run goes on, and another "
            "way of computing it may end otherwise."
        )
    motion = motion_text(run.block, run.motion, run.vertical)
    words = f"{outcome(run)}: {run.block.describe().headline} on {motion}"
    texts = {fact.key or fact.label: fact.words for fact in facts}
    sentence, screen = answer_of(run, texts, friction)
    return Description(
        f"{words}, {run.model.name} model",
        [*screen, *facts],
        notes=notes,
        sentence=sentence,
    )


def outcome(run: Trajectory) -> str:
    """Return how a run ended, and when."""
    if run.balanced:
        return "balanced"
    if run.status is Status.OVERTURNED and run.overturn_time_pt is not None:
        return f"overturned at {time_words(run, run.overturn_time_pt)}"
    if run.status is Status.AT_REST and run.rest_time_pt is not None:
        return f"at rest from {time_words(run, run.rest_time_pt)}"
    words = {
        Status.ROCKING: "rocking until",
        Status.LOST_CONTACT: "lost contact at",
        Status.UNDECIDED: "undecided after",
    }[run.status]
    return f"{words} {time_words(run, run.end_time_pt)}"


def time_words(run: Trajectory, pt: float) -> str:
    """Return a pivot time: in seconds first where possible, and in periods of shaking."""
    parts = [f"pt {number(pt)}"]
    if isinstance(run.motion, PeriodicMotion):
        periods = pt * run.motion.frequency_ratio / (2.0 * math.pi)
        parts.append(f"{number(periods)} periods")
    if not isinstance(run.block, Block):
        return f"{parts[0]} ({parts[1]})" if len(parts) > 1 else parts[0]
    return f"{quantity(pt / run.block.p, 's')} ({', '.join(parts)})"


def peak_words(peak: float, alpha: float | None) -> str:
    """Return a peak in degrees and in units of alpha; in these alone without a size."""
    part = quantity(peak, "alpha")
    return part if alpha is None else f"{angle(peak * alpha)} = {part}"


def _peaks(run: Trajectory) -> Iterator[Fact]:
    """Yield the largest angle, that of either side where they differ, in radians too."""
    block = run.block
    until = ", up to overturning" if run.overturn_time_pt is not None else ""
    alphas = (block.positive.alpha, block.negative.alpha) if isinstance(block, Block) else None
    if block.symmetric or block.one_sided:
        words = peak_words(run.peak, None if alphas is None else alphas[0])
        yield Fact("peak", run.peak, "peak", words + until)
    else:
        yield Fact("peak", run.peak)
        peaks = [
            peak_words(peak, None if alphas is None else alphas[side])
            for side, peak in enumerate(run.side_peaks)
        ]
        yield Fact("side_peaks", list(run.side_peaks))
        yield Fact("", label="peak, left edge", text=peaks[0] + until)
        yield Fact("", label="peak, right edge", text=peaks[1] + until)
    if alphas is not None:
        # The larger angle may be the smaller part of its alpha.
        pairs = zip(run.side_peaks, alphas, strict=True)
        yield Fact("peak_rad", max(peak * alpha for peak, alpha in pairs))


def _restitutions(run: Trajectory) -> Iterator[Fact]:
    """Yield the restitution, or that of either impact where they differ; for a wall, its own."""
    if run.block.one_sided:
        yield Fact("restitution", run.block.restitution)
        yield Fact("one_sided", True)
        return
    first, second = run.sides[:, columns.RESTITUTION].tolist()
    yield Fact("restitution", first)
    if first != second:
        yield Fact("negative_restitution", second)


def _times(run: Trajectory) -> Iterator[Fact]:
    """Yield when it overturned and when it came to rest."""
    for name, label in (("overturn", "overturns at"), ("rest", "at rest from")):
        pt = getattr(run, f"{name}_time_pt")
        shown = ("", "") if pt is None else (label, time_words(run, pt))
        if isinstance(run.block, Block):
            yield Fact(f"{name}_time_s", getattr(run, f"{name}_time_s"), *shown)
            continue
        if name == "overturn":
            yield Fact("overturn_time_tau", run.overturn_time_tau)
        yield Fact(f"{name}_time_pt", pt, *shown)


def _body(run: Trajectory) -> Iterator[Fact]:
    """Yield the measures of the block."""
    if isinstance(run.block, Block):
        yield Fact("block", run.block.to_dict())


def _demands(run: Trajectory, friction: float | None) -> Iterator[Fact]:
    """Yield what lifts the block, what the base does, and the friction it takes."""
    shaken = run.uplift_g is not None and run.pga_g is not None
    if run.uplift_g is not None and run.pga_g is not None:
        reached = quantity(run.floor_pga_g or run.pga_g, "g")
        words = f"{quantity(run.uplift_g, 'g')}; the base reaches {reached}"
        yield Fact("uplift_g", run.uplift_g, "uplift at", words)
        yield Fact("pga_g", run.pga_g)
        if run.floor_pga_g is not None:
            yield Fact("floor_pga_g", run.floor_pga_g)
    if not shaken and friction is None:
        return
    needed = run.friction_needed
    if needed is None:
        raise ModelError(
            "friction",
            friction,
            "it is that of a Block on a base without impulses",
            "leave it out, or give a block with a size and a motion of finite acceleration",
        )
    text = number(needed)
    if run.block.one_sided:
        text += ", away from the wall"
    elif needed == run.friction_at_impacts:
        text += ", for impacts"
    shown = ("friction needed", text) if needed else ("", "")
    yield Fact("friction_needed", None if math.isinf(needed) else needed, *shown)
    yield Fact("friction_at_impacts", run.friction_at_impacts)
    if friction is not None:
        yield Fact("friction", friction, "friction", friction_words(run, friction))


def _qualification(run: Trajectory, mass_kg: float | None) -> Iterator[Fact]:
    """Yield what an engineer qualifies by: displacement, clearances, impact speed, base force."""
    if isinstance(run.block, Block):
        top, gaps, speed = run.top_displacement_m, run.clearances_m, run.impact_speed_m_s
        shown = ("top moves", f"{length(top)}, {length(run.block.height)} up") if top else ("", "")
        yield Fact("top_displacement_m", top, *shown)
        pairs = zip(gaps or (), ("left", "right"), strict=False)
        words = " and ".join(f"{length(gap)} {side}" for gap, side in pairs if gap)
        yield Fact("clearances_m", gaps and list(gaps), "clearance needed" if words else "", words)
        shown = ("strikes base at", quantity(speed, "m/s")) if speed else ("", "")
        yield Fact("impact_speed_m_s", speed, *shown)
    forces = [("forces_per_weight", "force over weight", run.forces_per_weight, "")]
    if mass_kg is not None:
        forces.append(("base_force_kn", "force on base", run.base_force_kn(mass_kg), "kN"))
    for key, label, parts, unit in forces:
        if parts is not None:
            yield Fact(key, list(parts), label, force_words(parts, unit))


def answer_of(
    run: Trajectory, words: Mapping[str, str], friction: float | None
) -> tuple[str, list[Fact]]:
    """Return the sentence and the facts of a run.

    Parameters
    ----------
    run
        The run.
    words
        Words of its facts by their JSON keys.
    friction
        Coefficient of friction that is given; None where it is not.
    """
    falls = run.status is Status.OVERTURNED
    tilt = words.get("peak") or " and ".join(
        words[key] for key in ("peak, left edge", "peak, right edge")
    )
    impacts = plural(run.impact_count, "impact")
    top = run.top_displacement_m if words.get("peak") else None  # both sides' tilts fill the line
    tilt += f"; {impacts}" + (f"; top moves {length(top)}" if top else "")
    needed = words.get("friction_needed")
    lifts = "" if run.uplift_g is None else quantity(run.uplift_g, "g")
    if isinstance(run.block, Block) and run.block.parts and lifts:
        lifts += " as one body"  # where there is no room for the block
    if run.pga_g is not None:
        lifts += f"; {name_of(run.motion)} reaches {quantity(run.floor_pga_g or run.pga_g, 'g')}"
    facts = [
        line("largest tilt", "" if falls or not run.peak else tilt),
        line("lifts at", lifts),
        line("friction needed", f"{needed}, or it slides" if needed and friction is None else ""),
        line("friction", friction_words(run, friction)),
        line(GIVEN, run.block.describe().headline),
        line("computed", run.model.name),
    ]
    return sliding_or(run, sentence(run), facts, friction)


def sliding_or(
    run: Trajectory,
    ended: str,
    facts: Sequence[Fact],
    friction: float | None,
) -> tuple[str, list[Fact]]:
    """Return the answer of a run, whose end is a fact alone where it slides.

    Parameters
    ----------
    run
        The run.
    ended
        How it ends by rocking alone, without a stop.
    facts
        Further facts of the motion.
    friction
        As for `answer_of`.
    """
    if not slides(run, friction):
        return f"{ended}.", [*facts]
    assert friction is not None
    assert run.friction_needed is not None
    needed = run.friction_needed
    takes = f"it needs a friction of {number(needed)}" if needed < math.inf else "no friction holds"
    alone = line(ROCKING_ALONE, ended[0].lower() + ended[1:])
    return f"It slides: {takes}, given {number(friction)}.", [alone, *facts]


def slides(run: Trajectory, friction: float | None) -> bool:
    """Return whether a run takes more friction than is given.

    Raises
    ------
    InputError
        If the friction is outside its range.
    """
    if friction is None:
        return False
    needed = run.friction_needed or 0.0
    return needed > FRICTION("friction", friction) * (1.0 + ROUNDED)


def friction_words(run: Trajectory, friction: float | None) -> str:
    """Return the friction that a run needs beside the one that is given; empty without."""
    falls_short = slides(run, friction)
    if friction is None or run.friction_needed is None:
        return ""
    words = f"needs {number(run.friction_needed)}, given {number(friction)}"
    return f"{words}: it slides" if falls_short else words


def sentence(run: Trajectory) -> str:
    """Return how a run ended, and when, without a stop."""
    if run.balanced:
        return f"It {BALANCED}"
    if run.status is Status.AT_REST and not run.peak:
        return f"It never lifts under {name_of(run.motion)}"
    if run.status is Status.OVERTURNED and run.overturn_time_pt == 0.0:
        return "It falls at once: it starts beyond its limit"
    if run.status is Status.UNDECIDED:
        return f"No answer yet: it is undecided {_when(run)}"
    verb = f"It {run.status.plain}"
    if run.status is Status.ROCKING:
        verb = f"It still {run.status.plain}"
    return f"{verb} {_when(run)}"


def name_of(motion: Motion | Record) -> str:
    """Return what moves the base, in a word or two."""
    if isinstance(motion, Record):
        return motion.name or "the record"
    return "the pulse" if isinstance(motion, Pulse) else "the motion"


def _when(run: Trajectory) -> str:
    """Return when a run ended: in seconds, else base periods, else pivot time."""
    pt = run.end_time_pt
    if run.status is Status.OVERTURNED and run.overturn_time_pt is not None:
        pt = run.overturn_time_pt
    if run.status is Status.AT_REST and run.rest_time_pt is not None:
        pt = run.rest_time_pt
    if isinstance(run.block, Block):
        time = quantity(pt / run.block.p, "s")
    elif isinstance(run.motion, PeriodicMotion | Pulse):
        time = f"{number(pt * run.motion.frequency_ratio / (2.0 * math.pi))} periods"
    else:
        return f"at pt {number(pt)}"
    after = "after it is let go" if isinstance(run.motion, Still) else f"into {name_of(run.motion)}"
    return f"{time} {after}"


def trajectory_dataset(run: Trajectory, samples: int) -> "xarray.Dataset":
    """Return the columns of a run over pivot time."""
    import xarray

    table = run.to_columns(samples)
    times = table.pop("pt")
    dataset = xarray.Dataset({name: ("pt", values) for name, values in table.items()})
    return dataset.assign_coords(pt=times).assign_attrs(
        title=run.describe().headline, model=run.model.name, status=run.status.label
    )
