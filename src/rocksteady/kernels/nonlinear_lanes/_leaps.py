"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

import numpy as np

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear_lanes._layout import (
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
    SLOW,
    STAGE,
    VELOCITY,
    WIDEST,
)

NEAR = 0.05  # phase and velocity that have come back as closely are watched ...
SAME = 1e-11  # ... until they repeat to this, each time more closely ...
NOISE = 1e-12  # ... and not because both are rounding

# What has become of the lag, in impacts, after which a motion is nearly back.
PERIODIC = -1.0
LEAPT = -2.0
MANTISSA = 2**52 - 1


@compiled
def compare(lanes: Floats, most: int) -> int:
    """Compare states after impacts with earlier ones and count the periodic lanes.

    A motion with more impacts than `most` is not: it is to be given up.
    """
    count = 0
    for j in range(LANES):
        stage = lanes[STAGE + j]
        lag = lanes[LAG + j]
        phase = lanes[PHASE + j]
        velocity = lanes[VELOCITY + j]
        impacts = np.float64(lanes[IMPACTS + j])
        landed = (stage >= LANDED) & (stage <= SLOW) & (lag >= 0.0) & (impacts <= most)
        ref_phase = lanes[REF_PHASE + j]
        ref_velocity = lanes[REF_VELOCITY + j]
        ref_impacts = lanes[REF_IMPACTS + j]
        since = impacts - ref_impacts
        gap = max(abs(phase - ref_phase), abs(velocity - ref_velocity))
        searching = lag == 0.0
        due = since == lag
        near = gap < NEAR
        lifting = velocity == 0.0
        # Chatter too comes back as closely, and a block that just lifts to its node: at once.
        later = lanes[REF_LEFT + j] > lanes[LEFT + j]
        widest = gap if searching else max(gap, lanes[WIDEST + j])
        periodic = (landed & later) & (
            (due & (gap < SAME) & (widest > 10.0 * gap) & (widest > NOISE))
            | (lifting & (gap == 0.0))
        )
        power_of_two = (impacts.view(np.int64) & MANTISSA) == 0
        marks = landed & (due | lifting | (searching & (near | power_of_two))) & (not periodic)
        lanes[WIDEST + j] = widest if marks else lanes[WIDEST + j]
        lanes[REF_PHASE + j] = phase if marks else ref_phase
        lanes[REF_VELOCITY + j] = velocity if marks else ref_velocity
        lanes[REF_LEFT + j] = lanes[LEFT + j] if marks else lanes[REF_LEFT + j]
        lanes[REF_IMPACTS + j] = impacts if marks else ref_impacts
        after = since if near & (searching | due) else 0.0
        after = after if marks else lag
        lanes[LAG + j] = PERIODIC if periodic else after
        count += 1 if periodic else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(LANES):
        periodic = lanes[LAG + j] == PERIODIC
        left = lanes[LEFT + j]
        impacts = lanes[IMPACTS + j]
        period = lanes[REF_LEFT + j] - left if periodic else 1.0
        times = max(np.floor(left / period) - 1.0, 0.0) if periodic else 0.0
        lanes[LEFT + j] = left - times * period
        since = impacts - lanes[REF_IMPACTS + j] if periodic else 0.0
        lanes[IMPACTS + j] = impacts + times * since
        lanes[LAG + j] = LEAPT if periodic else lanes[LAG + j]
