"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

from rocksteady.kernels.core.returns import PERIODIC, Reference, compared, leapt
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES


@inlined
def reference_of(lanes: Floats, j: int) -> Reference:
    """Return the reference of a lane."""
    return Reference(
        lanes[lane.REF_PHASE + j],
        lanes[lane.REF_VELOCITY + j],
        lanes[lane.REF_LEFT + j],
        lanes[lane.REF_IMPACTS + j],
        lanes[lane.LAG + j],
        lanes[lane.WIDEST + j],
    )


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
        reference = reference_of(lanes, j)
        impacts = lanes[lane.IMPACTS + j]
        landed = (stage >= lane.LANDED) & (stage <= lane.SLOW)
        then = compared(
            reference,
            landed & (reference.lag >= 0.0) & (impacts <= most),
            lanes[lane.PHASE + j] + lanes[lane.APART + j] * lanes[lane.SIDE + j],
            lanes[lane.VELOCITY + j],
            lanes[lane.LEFT + j],
            impacts,
        )
        lanes[lane.REF_PHASE + j] = then.phase
        lanes[lane.REF_VELOCITY + j] = then.velocity
        lanes[lane.REF_LEFT + j] = then.left
        lanes[lane.REF_IMPACTS + j] = then.impacts
        lanes[lane.LAG + j] = then.lag
        lanes[lane.WIDEST + j] = then.widest
        count += 1 if then.lag == PERIODIC else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(LANES):
        before, side = lanes[lane.LEFT + j], lanes[lane.SIDE + j]
        left, impacts, lag = leapt(reference_of(lanes, j), before, lanes[lane.IMPACTS + j])
        lanes[lane.SIDE + j] = -side if (before - left) % 2.0 == 1.0 else side
        lanes[lane.LEFT + j] = left
        lanes[lane.IMPACTS + j] = impacts
        lanes[lane.LAG + j] = lag
