"""Returns of motions to earlier states, by which lanes of either model know that they repeat."""

from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core.law import Law, after_return, drawn_near, law_of, put_law
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined

NEAR = 0.05  # phase and velocity that have come back as closely are watched ...
SAME = 1e-11  # ... until they repeat to this, each time more closely ...
NOISE = 1e-12  # ... and not because both are rounding
NEARER = 0.9  # part of the last gap down to which a return has come no nearer
LATE = 32.0  # gap times squared impacts at which it ought to have

# What has become of the lag, in impacts, after which a motion is nearly back.
PERIODIC = -1.0
LEAPT = -2.0
ATTRACTED = -3.0  # the motion surely settles to an orbit

RECENT = 8.0  # impacts after which a reference that was not met again is replaced, and an 8th ...
LASTING = 64.0  # ... of all; those after which an uplift is, and as many as there were before it


class Reference(NamedTuple):
    """An earlier state after an impact, with which later states are compared."""

    phase: float
    velocity: float
    left: float  # half cycles that were left
    impacts: float
    lag: float
    widest: float


REFERENCE_FIELDS = len(Reference._fields)
"""Fields of a lane for its reference; those of the law of its returns follow."""


class Passage(NamedTuple):
    """A state at the start of a flight."""

    phase: float
    velocity: float
    left: float
    impacts: float


@inlined
def reference_of(lanes: Floats, first: int, count: int) -> Reference:
    """Return the reference in the fields of one of so many lanes, from a place on."""
    return Reference(
        lanes[first],
        lanes[first + count],
        lanes[first + 2 * count],
        lanes[first + 3 * count],
        lanes[first + 4 * count],
        lanes[first + 5 * count],
    )


@inlined
def compared(reference: Reference, gap: float, compares: bool, now: Passage) -> Reference:
    """Compare a state with the reference and return the next one; its lag may be PERIODIC.

    `gap` is the distance of the two.  `compares` is false of a state that is not after an impact,
    or of a motion to be given up.
    """
    lag = reference.lag
    phase, velocity, left, impacts = now
    since = impacts - reference.impacts
    searching = lag == 0.0
    due = since == lag
    near = gap < NEAR
    lifting = velocity == 0.0
    # Chatter before a lift comes near to the last one, as does a lift to the other side.
    lifted = reference.velocity == 0.0
    free = not (lifted & searching)
    # Chatter too comes back as closely, and a block that just lifts to its node: at once.
    later = reference.left > left
    widest = gap if searching else max(gap, reference.widest)
    closer = due & (widest > 10.0 * gap) & (widest > NOISE)
    periodic = (compares & later & (gap < SAME)) & (closer | (lifting & lifted))
    stale = since >= (RECENT + 0.125 * impacts if free else LASTING + reference.impacts)
    searched = searching & ((near & free) | stale)
    marks = compares & (due | (lifting & free) | searched) & (not periodic)
    after = since if near & (searching | due) else 0.0
    after = after if marks else lag
    return Reference(
        phase if marks else reference.phase,
        velocity if marks else reference.velocity,
        left if marks else reference.left,
        impacts if marks else reference.impacts,
        PERIODIC if periodic else after,
        widest if marks else reference.widest,
    )


@inlined
def watched(
    lanes: Floats, first: int, count: int, compares: bool, area: float, now: Passage
) -> bool:
    """Compare a state with the reference and the law of its returns; return whether it repeats.

    Parameters
    ----------
    lanes, first, count
        The fields of a lane from that of the reference's phase on, and how many lanes there are.
    compares
        Whether the state is at the start of a flight, of a motion that is not to be given up.
    area
        What an area has shrunk to since the last return, or `UNKNOWN`.
    now
        The state.
    """
    reference = reference_of(lanes, first, count)
    further, faster = now.phase - reference.phase, now.velocity - reference.velocity
    gap = max(abs(further), abs(faster))
    then = compared(reference, gap, compares, now)
    back = compares & (reference.lag > 0.0) & (now.impacts - reference.impacts == reference.lag)
    law_first = first + REFERENCE_FIELDS * count
    before = law_of(lanes, law_first, count, area)
    law, attracted = after_return(before, back, further if back else 0.0, faster if back else 0.0)
    attracted &= (reference.left > now.left) & (then.lag > 0.0)
    # Late in a motion, and no nearer than the last time: every second return may come nearer.
    last = max(abs(before.last_phase), abs(before.last_velocity))
    late = min(gap, NEAR) * now.impacts * now.impacts > LATE
    halves = (last > 0.0) & (gap >= NEARER * last) & late
    halves &= back & (then.lag > 0.0) & (not attracted)
    lag = 2.0 * then.lag if halves else then.lag
    afresh = lag != reference.lag
    marked = (then.impacts != reference.impacts) & (not attracted)
    put_law(
        lanes,
        law_first,
        count,
        Law(
            law.product,
            0.0 if afresh else law.square,
            1.0 if marked else law.area,
            0.0 if afresh else law.last_phase,
            0.0 if afresh else law.last_velocity,
            0.0 if afresh else law.before_phase,
            0.0 if afresh else law.before_velocity,
        ),
    )
    lag = ATTRACTED if attracted else lag
    lanes[first] = then.phase
    lanes[first + count] = then.velocity
    lanes[first + 2 * count] = reference.left if attracted else then.left
    lanes[first + 3 * count] = reference.impacts if attracted else then.impacts
    lanes[first + 4 * count] = lag
    lanes[first + 5 * count] = then.widest
    return (lag == PERIODIC) | (lag == ATTRACTED)


@compiled
def leapt(lanes: Floats, first: int, count: int, now: Passage) -> Passage:
    """Return the state after all but the last whole period of a lane that repeats."""
    reference = reference_of(lanes, first, count)
    phase, velocity, left, impacts = now
    attracted = reference.lag == ATTRACTED
    if not attracted and reference.lag != PERIODIC:
        return now
    period = reference.left - left
    times = max(np.floor(left / period) - 1.0, 0.0)
    lanes[first + 4 * count] = LEAPT
    if attracted:
        law_first = first + REFERENCE_FIELDS * count
        area = lanes[law_first + 2 * count]
        further, faster = drawn_near(law_of(lanes, law_first, count, area), times)
        phase += further
        velocity += faster
    since = impacts - reference.impacts
    return Passage(phase, velocity, left - times * period, impacts + times * since)
