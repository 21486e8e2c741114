"""Lengths of all lanes' steps, and the terms of y over them."""

import math

import numpy as np

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import ROUND, ROUND_BITS, bits_of, float_of
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import HIGHEST, LANES, OFFSETS, TERMS, TOP

LONGEST = 8.0
"""Longest step of use."""
LEAST, MOST = -500.0, 3.5
"""Of log2 of a step."""
UNIT = 2.0**-40
BIAS = 1023.0
LOG2_DOUBT = 0.0861
"""What the logarithm below may be too small by, and the exponential too large."""
DIVISORS = np.array([float(math.comb(TOP, i)) for i in range(TOP + 1)])
"""Of Taylor terms in the control points."""


@inlined
def low_log2(x: float) -> float:
    """Return log2 of |x|, or up to 0.0861 less: linear between powers of two; -1023 of 0."""
    return (float_of((bits_of(abs(x)) >> 12) + ROUND_BITS) - ROUND) * UNIT - BIAS


@inlined
def high_exp2(x: float) -> float:
    """Return 2^x, or up to 6 per cent more; |x| below 1000."""
    return float_of((bits_of((x + BIAS) * (1.0 / UNIT) + ROUND) - ROUND_BITS) << 12)


@inlined
def longest(
    angle: float, velocity: float, bend: float, third: float, last: float, degree: float
) -> float:
    """Return log2 of the step at which the last term is as large as the first ones allow."""
    return max(
        (angle - last) / degree,
        (velocity - last) / (degree - 1.0),
        (bend - last) / (degree - 2.0),
        (third - last) / (degree - 3.0),
    )


@compiled
def measure(lanes: Floats) -> None:
    """Find how far each polynomial serves, by the rule of `rocksteady.kernels.nonlinear.series`."""
    for k in range(LANES):
        angle = low_log2(lanes[lane.ANGLE + k])
        velocity = low_log2(lanes[lane.SPEEDS + k])
        bend = low_log2(lanes[lane.SPEEDS + LANES + k] * (1.0 / 2.0))
        third = low_log2(lanes[lane.SPEEDS + 2 * LANES + k] * (1.0 / 3.0))
        last = low_log2(lanes[lane.SPEEDS + (HIGHEST - 1) * LANES + k] * (1.0 / HIGHEST))
        before = low_log2(lanes[lane.SPEEDS + (HIGHEST - 2) * LANES + k] * (1.0 / (HIGHEST - 1)))
        allowed = lanes[lane.ALLOWED + k] - LOG2_DOUBT
        by_last = longest(angle, velocity, bend, third, last - allowed, float(HIGHEST))
        by_before = longest(angle, velocity, bend, third, before - allowed, HIGHEST - 1.0)
        holds = high_exp2(min(max(min(by_last, by_before) - LOG2_DOUBT, LEAST), MOST))
        turned = (lanes[lane.LEFT + k] * PI_HIGH + lanes[lane.STOP + k]) - lanes[lane.PHASE + k]
        left = turned / lanes[lane.FREQUENCY + k] - lanes[lane.TIME + k]
        reach = min(holds, LONGEST, lanes[lane.LIMIT + k])
        lanes[lane.REMAINING + k] = left
        lanes[lane.STEP + k] = min(left, reach)


@compiled
def scale(lanes: Floats) -> None:
    """Fill the Taylor terms of y at the step's end, and their shares in the control points."""
    for k in range(LANES):
        angle = lanes[lane.ANGLE + k]
        lanes[lane.TAYLOR + k] = angle
        lanes[lane.POINTS + k] = angle
        lanes[lane.TOTAL + k] = abs(angle)
        lanes[lane.REST + k] = 0.0
        lanes[lane.CURVING + k] = 0.0
        lanes[lane.POWER + k] = 1.0
    for i in range(1, TOP + 1):
        here = (i * LANES) & OFFSETS
        share = 1.0 / i
        part = 1.0 / DIVISORS[i]
        curving = float(i * (i - 1))
        for k in range(LANES):
            power = lanes[lane.POWER + k] * lanes[lane.STEP + k]
            term = lanes[lane.SPEEDS - LANES + here + k] * power * share
            size = abs(term)
            lanes[lane.POWER + k] = power
            lanes[lane.TAYLOR + here + k] = term
            lanes[lane.POINTS + here + k] = term * part
            lanes[lane.TOTAL + k] += size
            lanes[lane.CURVING + k] += size * curving
    for i in range(TOP + 1, TERMS):
        here = (i * LANES) & OFFSETS
        share = 1.0 / i
        curving = float(i * (i - 1))
        for k in range(LANES):
            power = lanes[lane.POWER + k] * lanes[lane.STEP + k]
            term = lanes[lane.SPEEDS - LANES + here + k] * power * share
            size = abs(term)
            lanes[lane.POWER + k] = power
            lanes[lane.TAYLOR + here + k] = term
            lanes[lane.REST + k] += size
            lanes[lane.CURVING + k] += size * curving
