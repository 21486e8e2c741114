"""Taylor coefficients of all lanes."""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import HIGHEST, LANES, OFFSETS


@compiled
def expand(lanes: Floats) -> None:
    """Fill the coefficients of h, y', C and S from the state of each lane on.

    The recurrences are those of `rocksteady.kernels.nonlinear.series`.  Two orders are summed at a
    time: a term that is read serves both.  Reading is the limit, not multiplying: adding eight
    products at a time in place of four gains nothing.
    """
    first_terms(lanes)
    for n in range(0, HIGHEST - 1, 2):
        first_sums(lanes, n)
        for j in range(1 + n % 4, n + 1, 4):
            add_four(lanes, j, n - j)
        next_terms(lanes, n)


@compiled
def first_terms(lanes: Floats) -> None:
    """Fill the coefficients that the state gives."""
    for k in range(LANES):
        sine, cosine = sincos_short(
            lanes[lane.PHASE + k] + lanes[lane.FREQUENCY + k] * lanes[lane.TIME + k]
        )
        lanes[lane.SHAKING + k] = lanes[lane.AMPLITUDE + k] * sine
        lanes[lane.SHAKING + LANES + k] = lanes[lane.SWING_RATE + k] * cosine
    for k in range(LANES):
        sine, cosine = sincos_short(lanes[lane.ALPHA + k] * (1.0 - lanes[lane.ANGLE + k]))
        lanes[lane.SINES + k] = sine * lanes[lane.INVERSE + k]
        lanes[lane.COSINES + k] = cosine
        lanes[lane.SPEEDS + k] = lanes[lane.SPEED + k]


@inlined
def first_sums(lanes: Floats, n: int) -> None:
    """Begin the sums of the orders n, an even one, and n + 1, with terms 0 or 0 to 2."""
    here = (n * LANES) & OFFSETS
    if n % 4 == 0:
        for k in range(LANES):
            c0, s0 = lanes[lane.COSINES + here + k], lanes[lane.SINES + here + k]
            v0 = lanes[lane.SPEEDS + k]
            lanes[lane.FORCE + k] = lanes[lane.SHAKING + k] * c0
            lanes[lane.BY_COSINE + k] = v0 * c0
            lanes[lane.BY_SINE + k] = v0 * s0
            lanes[lane.NEXT_FORCE + k] = 0.0
            lanes[lane.NEXT_BY_COSINE + k] = 0.0
            lanes[lane.NEXT_BY_SINE + k] = 0.0
    else:
        back = ((n - 2) * LANES) & OFFSETS
        for k in range(LANES):
            c0, s0 = lanes[lane.COSINES + here + k], lanes[lane.SINES + here + k]
            c1, s1 = (
                lanes[lane.COSINES + back + LANES + k],
                lanes[lane.SINES + back + LANES + k],
            )
            c2, s2 = lanes[lane.COSINES + back + k], lanes[lane.SINES + back + k]
            h0, h1 = lanes[lane.SHAKING + k], lanes[lane.SHAKING + LANES + k]
            h2 = lanes[lane.SHAKING + 2 * LANES + k]
            v0, v1 = lanes[lane.SPEEDS + k], lanes[lane.SPEEDS + LANES + k]
            v2 = lanes[lane.SPEEDS + 2 * LANES + k]
            lanes[lane.FORCE + k] = h0 * c0 + (h1 * c1 + h2 * c2)
            lanes[lane.BY_COSINE + k] = v0 * c0 + (v1 * c1 + v2 * c2)
            lanes[lane.BY_SINE + k] = v0 * s0 + (v1 * s1 + v2 * s2)
            lanes[lane.NEXT_FORCE + k] = h1 * c0 + h2 * c1
            lanes[lane.NEXT_BY_COSINE + k] = v1 * c0 + v2 * c1
            lanes[lane.NEXT_BY_SINE + k] = v1 * s0 + v2 * s1


@inlined
def add_four(lanes: Floats, j: int, rest: int) -> None:
    """Add terms j to j + 3 times terms `rest` to `rest` - 3, and the same of the next order."""
    up = (j * LANES) & OFFSETS
    down = ((rest - 3) * LANES) & OFFSETS
    for k in range(LANES):
        c0, s0 = (
            lanes[lane.COSINES + down + 4 * LANES + k],
            lanes[lane.SINES + down + 4 * LANES + k],
        )
        c1, s1 = (
            lanes[lane.COSINES + down + 3 * LANES + k],
            lanes[lane.SINES + down + 3 * LANES + k],
        )
        c2, s2 = (
            lanes[lane.COSINES + down + 2 * LANES + k],
            lanes[lane.SINES + down + 2 * LANES + k],
        )
        c3, s3 = lanes[lane.COSINES + down + LANES + k], lanes[lane.SINES + down + LANES + k]
        c4, s4 = lanes[lane.COSINES + down + k], lanes[lane.SINES + down + k]
        v0, v1 = lanes[lane.SPEEDS + up + k], lanes[lane.SPEEDS + up + LANES + k]
        v2, v3 = lanes[lane.SPEEDS + up + 2 * LANES + k], lanes[lane.SPEEDS + up + 3 * LANES + k]
        h0, h1 = lanes[lane.SHAKING + up + k], lanes[lane.SHAKING + up + LANES + k]
        h2, h3 = lanes[lane.SHAKING + up + 2 * LANES + k], lanes[lane.SHAKING + up + 3 * LANES + k]
        lanes[lane.FORCE + k] += (h0 * c1 + h1 * c2) + (h2 * c3 + h3 * c4)
        lanes[lane.BY_COSINE + k] += (v0 * c1 + v1 * c2) + (v2 * c3 + v3 * c4)
        lanes[lane.BY_SINE + k] += (v0 * s1 + v1 * s2) + (v2 * s3 + v3 * s4)
        lanes[lane.NEXT_FORCE + k] += (h0 * c0 + h1 * c1) + (h2 * c2 + h3 * c3)
        lanes[lane.NEXT_BY_COSINE + k] += (v0 * c0 + v1 * c1) + (v2 * c2 + v3 * c3)
        lanes[lane.NEXT_BY_SINE + k] += (v0 * s0 + v1 * s1) + (v2 * s2 + v3 * s3)


@inlined
def next_terms(lanes: Floats, n: int) -> None:
    """Fill the coefficients n + 1 and n + 2 from the sums of the orders n and n + 1.

    The sums of order n + 1 lack the products with terms n + 1.
    """
    here = (n * LANES) & OFFSETS
    share, next_share = 1.0 / (n + 1), 1.0 / (n + 2)
    turn, next_turn = share * next_share, next_share / (n + 3)
    for k in range(LANES):
        square, turning = lanes[lane.SQUARE + k], lanes[lane.TURN + k]
        before, ahead = lanes[lane.SHAKING + here + k], lanes[lane.SHAKING + here + LANES + k]
        sine = -lanes[lane.BY_COSINE + k] * share
        cosine = square * lanes[lane.BY_SINE + k] * share
        speed = (lanes[lane.FORCE + k] - lanes[lane.SINES + here + k]) * share
        v0, c0, s0 = lanes[lane.SPEEDS + k], lanes[lane.COSINES + k], lanes[lane.SINES + k]
        force = lanes[lane.NEXT_FORCE + k] + (lanes[lane.SHAKING + k] * cosine + ahead * c0)
        by_cosine = lanes[lane.NEXT_BY_COSINE + k] + (v0 * cosine + speed * c0)
        by_sine = lanes[lane.NEXT_BY_SINE + k] + (v0 * sine + speed * s0)
        lanes[lane.SINES + here + LANES + k] = sine
        lanes[lane.COSINES + here + LANES + k] = cosine
        lanes[lane.SPEEDS + here + LANES + k] = speed
        lanes[lane.SINES + here + 2 * LANES + k] = -by_cosine * next_share
        lanes[lane.COSINES + here + 2 * LANES + k] = square * by_sine * next_share
        lanes[lane.SPEEDS + here + 2 * LANES + k] = (force - sine) * next_share
        lanes[lane.SHAKING + here + 2 * LANES + k] = turning * before * turn
        lanes[lane.SHAKING + here + 3 * LANES + k] = turning * ahead * next_turn
