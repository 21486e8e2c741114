"""Answer of a time history: whether it falls, rests or rocks, when, and why."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import ROUNDED
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Still
from rocksteady.outcomes import BALANCED, Status
from rocksteady.results.answer import GIVEN, Answer
from rocksteady.results.numbers import length, number, plural, quantity

if TYPE_CHECKING:
    from rocksteady.dynamics.history._physical import Physical
    from rocksteady.model.motions.segments import Motion


ROCKING_ALONE: Final = "without sliding"
"""Label of how a run ends that takes more friction than there is."""


def answer_of(run: "Physical", words: Mapping[str, str], friction: float | None) -> Answer:
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
        ("largest tilt", "" if falls or not run.peak else tilt),
        ("lifts at", lifts),
        ("friction needed", f"{needed}, or it slides" if needed and friction is None else ""),
        ("friction", friction_words(run, friction)),
        (GIVEN, run.block.describe().headline),
        ("computed", run.model.name),
    ]
    return sliding_or(run, sentence(run), facts, friction)


def sliding_or(
    run: "Physical",
    ended: str,
    facts: Sequence[tuple[str, str | Callable[[], str]]],
    friction: float | None,
) -> Answer:
    """Return the answer of a run, whose end is a fact alone where it slides.

    Parameters
    ----------
    run
        The run.
    ended
        How it ends by rocking alone, without a stop.
    facts
        What else is said of it.
    friction
        As for `answer_of`.
    """
    if not slides(run, friction):
        return Answer(f"{ended}.", facts)
    assert friction is not None
    assert run.friction_needed is not None
    needed = run.friction_needed
    takes = f"it needs a friction of {number(needed)}" if needed < math.inf else "no friction holds"
    alone = (ROCKING_ALONE, ended[0].lower() + ended[1:])
    return Answer(f"It slides: {takes}, given {number(friction)}.", [alone, *facts])


def slides(run: "Physical", friction: float | None) -> bool:
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


def friction_words(run: "Physical", friction: float | None) -> str:
    """Return the friction that a run needs beside the one that is given; empty without."""
    falls_short = slides(run, friction)
    if friction is None or run.friction_needed is None:
        return ""
    words = f"needs {number(run.friction_needed)}, given {number(friction)}"
    return f"{words}: it slides" if falls_short else words


def sentence(run: "Physical") -> str:
    """Return how a run ended, and when, without a stop."""
    if run.balanced:
        return f"It {BALANCED}"
    if run.status is Status.AT_REST and not run.peak:
        return f"It {Status.AT_REST.plain} throughout: {name_of(run.motion)} never lifts it"
    if run.status is Status.OVERTURNED and run.overturn_time_pt == 0.0:
        return "It falls at once: it starts beyond its limit"
    if run.status is Status.UNDECIDED:
        return f"No answer yet: it is undecided {_when(run)}"
    verb = f"It {run.status.plain}"
    if run.status is Status.ROCKING:
        verb = f"It still {run.status.plain}"
    return f"{verb} {_when(run)}"


def name_of(motion: "Motion | Record") -> str:
    """Return what moves the base, in a word or two."""
    if isinstance(motion, Record):
        return motion.name or "the record"
    return "the pulse" if isinstance(motion, Pulse) else "the motion"


def _when(run: "Physical") -> str:
    """Return when a run ended: in seconds, else in periods of the base, else in pivot time."""
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
