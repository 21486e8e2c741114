"""Lengths of all lanes' steps, and whether a step has no impact or one."""

import math

import numpy as np

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import ROUND, ROUND_BITS, bits_of, float_of
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes._fields import (
    ABOVE,
    ALLOWED,
    ANGLE,
    BEFORE,
    BELOW,
    CHANGES,
    FREQUENCY,
    HIGHEST,
    LANES,
    LAST,
    LEFT,
    LIMIT,
    OFFSETS,
    PHASE,
    PLACE,
    POINTS,
    POWER,
    SPEEDS,
    STEP,
    STOP,
    TAYLOR,
    TERMS,
    TIME,
    TOTAL,
)

LONGEST = 8.0
"""Longest step of use."""
ROUNDING = 1e-14
"""As in `rocksteady.kernels.nonlinear._bernstein`: of some 24 additions."""
UNIT = 2.0**-40
BIAS = 1023.0
LOG2_DOUBT = 0.0861
"""What the logarithm below may be too small by, and the exponential too large."""
DIVISORS = np.array([float(math.comb(HIGHEST, i)) for i in range(TERMS)])
"""Of Taylor terms; the row of the triangle."""


@inlined
def low_log2(x: float) -> float:
    """Return log2 of |x|, or up to 0.0861 less: linear between powers of two; -1023 of 0."""
    return (float_of((bits_of(abs(x)) >> 12) + ROUND_BITS) - ROUND) * UNIT - BIAS


@inlined
def high_exp2(x: float) -> float:
    """Return 2^x, or up to 6 per cent more; |x| below 1000."""
    return float_of((bits_of((x + BIAS) * (1.0 / UNIT) + ROUND) - ROUND_BITS) << 12)


@compiled
def measure(lanes: Floats) -> None:
    """Find how far each polynomial serves, by the rule of `rocksteady.kernels.nonlinear.series`."""
    for k in range(LANES):
        # Of y_i; log2 of i is left out where it makes the step shorter.
        angle = low_log2(lanes[ANGLE + k])
        velocity = low_log2(lanes[SPEEDS + k])
        bend = low_log2(lanes[SPEEDS + LANES + k] * (1.0 / 2.0))
        third = low_log2(lanes[SPEEDS + 2 * LANES + k] * (1.0 / 3.0))
        last = low_log2(lanes[SPEEDS + (HIGHEST - 1) * LANES + k] * (1.0 / HIGHEST))
        before = low_log2(lanes[SPEEDS + (HIGHEST - 2) * LANES + k] * (1.0 / (HIGHEST - 1)))
        allowed = lanes[ALLOWED + k] - LOG2_DOUBT
        last -= allowed
        before -= allowed
        by_last = max(
            max((angle - last) * (1.0 / HIGHEST), (velocity - last) * (1.0 / (HIGHEST - 1))),
            max((bend - last) * (1.0 / (HIGHEST - 2)), (third - last) * (1.0 / (HIGHEST - 3))),
        )
        by_before = max(
            max(
                (angle - before) * (1.0 / (HIGHEST - 1)),
                (velocity - before) * (1.0 / (HIGHEST - 2)),
            ),
            max((bend - before) * (1.0 / (HIGHEST - 3)), (third - before) * (1.0 / (HIGHEST - 4))),
        )
        holds = high_exp2(min(max(min(by_last, by_before) - LOG2_DOUBT, -500.0), 3.5))
        turned = (lanes[LEFT + k] * PI_HIGH + lanes[STOP + k]) - lanes[PHASE + k]
        left = turned / lanes[FREQUENCY + k] - lanes[TIME + k]
        reach = min(min(holds, LONGEST), lanes[LIMIT + k])
        lanes[LAST + k] = 1.0 if left <= reach else 0.0
        lanes[STEP + k] = min(left, reach)


@compiled
def scale(lanes: Floats) -> None:
    """Fill the Taylor terms of y at the step's end, and their shares in the control points."""
    for k in range(LANES):
        angle = lanes[ANGLE + k]
        lanes[TAYLOR + k] = angle
        lanes[POINTS + k] = angle
        lanes[TOTAL + k] = abs(angle)
        lanes[POWER + k] = 1.0
    for i in range(1, TERMS):
        here = (i * LANES) & OFFSETS
        share = 1.0 / i
        part = 1.0 / DIVISORS[i]
        for k in range(LANES):
            power = lanes[POWER + k] * lanes[STEP + k]
            term = lanes[SPEEDS - LANES + here + k] * power * share
            lanes[POWER + k] = power
            lanes[TAYLOR + here + k] = term
            lanes[POINTS + here + k] = term * part
            lanes[TOTAL + k] += abs(term)


@compiled
def count_changes(lanes: Floats) -> None:
    """Count the changes of sign of the control points; a doubtful sign counts for many.

    With ``p_i = c_i T^i/C(N, i)`` the points are ``b_j = sum C(j, i) p_i``: sums along the
    triangle.  A flight from the floor has b_0 = 0, and the others have the signs of those of y/t.
    """
    for k in range(LANES):
        lanes[CHANGES + k] = 0.0
        lanes[BEFORE + k] = max(lanes[ANGLE + k], 1e-300)
        lanes[ABOVE + k] = 1.0
        lanes[BELOW + k] = 0.0
        lanes[PLACE + k] = 0.0
        lanes[TOTAL + k] *= ROUNDING
    for j in range(1, TERMS):
        count = TERMS - j  # sums of the row
        pairs = count // 2
        for i in range(0, 2 * pairs, 2):
            here = (i * LANES) & OFFSETS
            for k in range(LANES):
                middle = lanes[POINTS + here + LANES + k]
                lanes[POINTS + here + k] += middle
                lanes[POINTS + here + LANES + k] = middle + lanes[POINTS + here + 2 * LANES + k]
        if count % 2 == 1:
            here = ((count - 1) * LANES) & OFFSETS
            for k in range(LANES):
                lanes[POINTS + here + k] += lanes[POINTS + here + LANES + k]
        note_change(lanes, j)


@inlined
def note_change(lanes: Floats, j: int) -> None:
    """Compare the sign of point j with that before it."""
    for k in range(LANES):
        point, before = lanes[POINTS + k], lanes[BEFORE + k]
        changed = (point > 0.0) != (before > 0.0)
        more = 1.0 if changed else 0.0
        lanes[CHANGES + k] += more if abs(point) > lanes[TOTAL + k] else 4.0
        lanes[ABOVE + k] = before if changed else lanes[ABOVE + k]
        lanes[BELOW + k] = point if changed else lanes[BELOW + k]
        lanes[PLACE + k] = (j - 1.0) if changed else lanes[PLACE + k]
        lanes[BEFORE + k] = point
