"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

from rocksteady.kernels.core.law import UNKNOWN
from rocksteady.kernels.core.returns import Passage, leapt, watched
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._both_sides import other
from rocksteady.kernels.lanes._fields import LANES, working
from rocksteady.kernels.machine_code.compilation import compiled, inlined


@inlined
def passage_of(lanes: Floats, j: int) -> Passage:
    """Return the state of a lane at the start of its flight."""
    return Passage(
        lanes[lane.PHASE + j],
        lanes[lane.VELOCITY + j],
        lanes[lane.LEFT + j],
        lanes[lane.IMPACTS + j],
    )


@compiled
def compare(lanes: Floats, most: int) -> int:
    """Compare states about to be launched with earlier ones; count those that are periodic.

    A motion with more impacts than `most` is not: it is to be given up.
    """
    count = 0
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        launched = (stage > 0.0) & (stage <= lane.LANDED)
        now = passage_of(lanes, j)
        # A state of an unlike block returns on its own side alone.
        apart = lanes[lane.PHASE + j] + lanes[lane.APART + j] * lanes[lane.SIDE + j]
        now = Passage(apart, now.velocity, now.left, now.impacts)
        compares = launched & (lanes[lane.LAG + j] >= 0.0) & (now.impacts <= most)
        # Of the side that has been left; against a wall both have the same.
        delta = other(lanes, j, lane.DELTA)
        area = lanes[lane.AREA + j] * (delta * delta if stage == lane.LANDED else 1.0)
        # Of a flight by the march it is not counted.
        area = UNKNOWN if launched & (stage < lane.LANDED) else area
        count += 1 if watched(lanes, lane.REF_PHASE + j, LANES, compares, area, now) else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(working(lanes)):
        before = passage_of(lanes, j)
        after = leapt(lanes, lane.REF_PHASE + j, LANES, before)
        if after.left < before.left:
            lanes[lane.LEFT + j], lanes[lane.IMPACTS + j] = after.left, after.impacts
            put_state(lanes, j, after.phase, after.velocity)


@compiled
def put_state(lanes: Floats, j: int, phase: float, velocity: float) -> None:
    """Give a lane another phase and velocity at the start of its flight."""
    lanes[lane.PHASE + j], lanes[lane.VELOCITY + j] = phase, velocity
    lanes[lane.SINE + j], lanes[lane.COSINE + j] = sincos_near(phase)
