"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

from rocksteady.kernels.core.returns import PERIODIC, Reference, compared, leapt
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes._layout import (
    APART,
    IMPACTS,
    LAG,
    LANDED,
    LANES,
    LEFT,
    PHASE,
    REF_IMPACTS,
    REF_LEFT,
    REF_PHASE,
    REF_VELOCITY,
    SIDE,
    SLOW,
    STAGE,
    VELOCITY,
    WIDEST,
)


@inlined
def reference_of(lanes: Floats, j: int) -> Reference:
    """Return the reference of a lane."""
    return Reference(
        lanes[REF_PHASE + j],
        lanes[REF_VELOCITY + j],
        lanes[REF_LEFT + j],
        lanes[REF_IMPACTS + j],
        lanes[LAG + j],
        lanes[WIDEST + j],
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
        stage = lanes[STAGE + j]
        reference = reference_of(lanes, j)
        impacts = lanes[IMPACTS + j]
        landed = (stage >= LANDED) & (stage <= SLOW)
        then = compared(
            reference,
            landed & (reference.lag >= 0.0) & (impacts <= most),
            lanes[PHASE + j] + lanes[APART + j] * lanes[SIDE + j],
            lanes[VELOCITY + j],
            lanes[LEFT + j],
            impacts,
        )
        lanes[REF_PHASE + j] = then.phase
        lanes[REF_VELOCITY + j] = then.velocity
        lanes[REF_LEFT + j] = then.left
        lanes[REF_IMPACTS + j] = then.impacts
        lanes[LAG + j] = then.lag
        lanes[WIDEST + j] = then.widest
        count += 1 if then.lag == PERIODIC else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(LANES):
        before, side = lanes[LEFT + j], lanes[SIDE + j]
        left, impacts, lag = leapt(reference_of(lanes, j), before, lanes[IMPACTS + j])
        lanes[SIDE + j] = -side if (before - left) % 2.0 == 1.0 else side
        lanes[LEFT + j] = left
        lanes[IMPACTS + j] = impacts
        lanes[LAG + j] = lag
