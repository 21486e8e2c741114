"""Returns of motions to earlier states, by which lanes of either model know that they repeat."""

from typing import NamedTuple

import numpy as np

from rocksteady.kernels.machine_code.compilation import inlined

NEAR = 0.05  # phase and velocity that have come back as closely are watched ...
SAME = 1e-11  # ... until they repeat to this, each time more closely ...
NOISE = 1e-12  # ... and not because both are rounding

# What has become of the lag, in impacts, after which a motion is nearly back.
PERIODIC = -1.0
LEAPT = -2.0
MANTISSA = 2**52 - 1


class Reference(NamedTuple):
    """An earlier state after an impact, with which later states are compared."""

    phase: float
    velocity: float
    left: float  # half cycles that were left
    impacts: float
    lag: float
    widest: float


@inlined
def compared(
    reference: Reference, compares: bool, phase: float, velocity: float, left: float, impacts: float
) -> Reference:
    """Compare a state with the reference and return the next one; its lag may be PERIODIC.

    `compares` is false of a state that is not after an impact, or of a motion to be given up.
    """
    lag = reference.lag
    since = impacts - reference.impacts
    gap = max(abs(phase - reference.phase), abs(velocity - reference.velocity))
    searching = lag == 0.0
    due = since == lag
    near = gap < NEAR
    lifting = velocity == 0.0
    # Chatter too comes back as closely, and a block that just lifts to its node: at once.
    later = reference.left > left
    widest = gap if searching else max(gap, reference.widest)
    periodic = (compares & later) & (
        (due & (gap < SAME) & (widest > 10.0 * gap) & (widest > NOISE)) | (lifting & (gap == 0.0))
    )
    power_of_two = (np.float64(impacts).view(np.int64) & MANTISSA) == 0
    marks = compares & (due | lifting | (searching & (near | power_of_two))) & (not periodic)
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
def leapt(reference: Reference, left: float, impacts: float) -> tuple[float, float, float]:
    """Return half cycles left, impacts and lag after all but the last whole period."""
    periodic = reference.lag == PERIODIC
    period = reference.left - left if periodic else 1.0
    times = max(np.floor(left / period) - 1.0, 0.0) if periodic else 0.0
    since = impacts - reference.impacts if periodic else 0.0
    return left - times * period, impacts + times * since, LEAPT if periodic else reference.lag
