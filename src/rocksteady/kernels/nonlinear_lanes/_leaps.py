"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

from rocksteady.kernels.core.returns import Passage, leapt, watched
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES
from rocksteady.kernels.nonlinear_lanes._two_sides import other


@compiled
def compare(lanes: Floats, most: int) -> int:
    """Compare states after impacts with earlier ones and count the periodic lanes.

    A motion with more impacts than `most` is not: it is to be given up.  A state of an unlike block
    returns on its own side alone; `APART` keeps the phases of the two farther apart than any two
    states that are near.
    """
    count = 0
    for j in range(LANES):
        stage = lanes[lane.STAGE + j]
        landed = (stage >= lane.LANDED) & (stage <= lane.SLOW)
        now = Passage(
            lanes[lane.PHASE + j] + lanes[lane.APART + j] * lanes[lane.SIDE + j],
            lanes[lane.VELOCITY + j],
            lanes[lane.LEFT + j],
            lanes[lane.IMPACTS + j],
        )
        compares = landed & (lanes[lane.LAG + j] >= 0.0) & (now.impacts <= most)
        delta = other(lanes, j, lane.DELTA)  # of the side that has been left
        area = lanes[lane.AREA + j] * (delta * delta if landed else 1.0)
        count += 1 if watched(lanes, lane.REF_PHASE + j, LANES, compares, area, now) else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(LANES):
        before = Passage(
            lanes[lane.PHASE + j],
            lanes[lane.VELOCITY + j],
            lanes[lane.LEFT + j],
            lanes[lane.IMPACTS + j],
        )
        after = leapt(lanes, lane.REF_PHASE + j, LANES, before)
        if after.left < before.left:
            lanes[lane.SIDE + j] *= 1.0 - 2.0 * ((before.left - after.left) % 2.0)
            lanes[lane.PHASE + j] = after.phase
            lanes[lane.VELOCITY + j] = lanes[lane.SPEED + j] = after.velocity
            lanes[lane.LEFT + j], lanes[lane.IMPACTS + j] = after.left, after.impacts
