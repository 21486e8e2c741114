"""Taylor coefficients of all lanes."""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import HIGHEST, LANES, OFFSETS


@compiled
def expand(lanes: Floats) -> None:
    """Fill the coefficients of h, y', C and S from the state of each lane on.

    The recurrences are those of `rocksteady.kernels.nonlinear.series`.
    """
    first_terms(lanes)
    for n in range(HIGHEST - 1):
        odd = (n + 1) % 4
        first_sums(lanes, n, odd)
        for j in range(odd, n + 1, 4):
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
def first_sums(lanes: Floats, n: int, odd: int) -> None:
    """Begin the sums of order n with so many products, 0 to 3."""
    left = (n * LANES) & OFFSETS
    if odd == 0:
        for k in range(LANES):
            lanes[lane.FORCE + k] = 0.0
            lanes[lane.BY_COSINE + k] = 0.0
            lanes[lane.BY_SINE + k] = 0.0
    elif odd == 1:
        for k in range(LANES):
            c0, s0 = lanes[lane.COSINES + left + k], lanes[lane.SINES + left + k]
            v0 = lanes[lane.SPEEDS + k]
            lanes[lane.FORCE + k] = lanes[lane.SHAKING + k] * c0
            lanes[lane.BY_COSINE + k] = v0 * c0
            lanes[lane.BY_SINE + k] = v0 * s0
    else:
        back = ((n - 1) * LANES) & OFFSETS
        for k in range(LANES):
            c0, s0 = lanes[lane.COSINES + back + LANES + k], lanes[lane.SINES + back + LANES + k]
            c1, s1 = lanes[lane.COSINES + back + k], lanes[lane.SINES + back + k]
            v0, v1 = lanes[lane.SPEEDS + k], lanes[lane.SPEEDS + LANES + k]
            lanes[lane.FORCE + k] = (
                lanes[lane.SHAKING + k] * c0 + lanes[lane.SHAKING + LANES + k] * c1
            )
            lanes[lane.BY_COSINE + k] = v0 * c0 + v1 * c1
            lanes[lane.BY_SINE + k] = v0 * s0 + v1 * s1
        if odd == 3:
            back = ((n - 2) * LANES) & OFFSETS
            for k in range(LANES):
                c2, s2 = lanes[lane.COSINES + back + k], lanes[lane.SINES + back + k]
                v2 = lanes[lane.SPEEDS + 2 * LANES + k]
                lanes[lane.FORCE + k] += lanes[lane.SHAKING + 2 * LANES + k] * c2
                lanes[lane.BY_COSINE + k] += v2 * c2
                lanes[lane.BY_SINE + k] += v2 * s2


@inlined
def add_four(lanes: Floats, j: int, rest: int) -> None:
    """Add the products of terms j to j + 3 with terms `rest` to `rest` - 3."""
    up = (j * LANES) & OFFSETS
    down = ((rest - 3) * LANES) & OFFSETS
    for k in range(LANES):
        c0, s0 = (
            lanes[lane.COSINES + down + 3 * LANES + k],
            lanes[lane.SINES + down + 3 * LANES + k],
        )
        c1, s1 = (
            lanes[lane.COSINES + down + 2 * LANES + k],
            lanes[lane.SINES + down + 2 * LANES + k],
        )
        c2, s2 = lanes[lane.COSINES + down + LANES + k], lanes[lane.SINES + down + LANES + k]
        c3, s3 = lanes[lane.COSINES + down + k], lanes[lane.SINES + down + k]
        v0, v1 = lanes[lane.SPEEDS + up + k], lanes[lane.SPEEDS + up + LANES + k]
        v2, v3 = lanes[lane.SPEEDS + up + 2 * LANES + k], lanes[lane.SPEEDS + up + 3 * LANES + k]
        h0, h1 = lanes[lane.SHAKING + up + k], lanes[lane.SHAKING + up + LANES + k]
        h2, h3 = lanes[lane.SHAKING + up + 2 * LANES + k], lanes[lane.SHAKING + up + 3 * LANES + k]
        lanes[lane.FORCE + k] += (h0 * c0 + h1 * c1) + (h2 * c2 + h3 * c3)
        lanes[lane.BY_COSINE + k] += (v0 * c0 + v1 * c1) + (v2 * c2 + v3 * c3)
        lanes[lane.BY_SINE + k] += (v0 * s0 + v1 * s1) + (v2 * s2 + v3 * s3)


@inlined
def next_terms(lanes: Floats, n: int) -> None:
    """Fill the coefficients n + 1 from the sums of order n, and n + 2 of h."""
    here = (n * LANES) & OFFSETS
    share = 1.0 / (n + 1)
    turn = share / (n + 2)
    for k in range(LANES):
        force = lanes[lane.FORCE + k] - lanes[lane.SINES + here + k]
        lanes[lane.SINES + here + LANES + k] = -lanes[lane.BY_COSINE + k] * share
        lanes[lane.COSINES + here + LANES + k] = (
            lanes[lane.SQUARE + k] * lanes[lane.BY_SINE + k] * share
        )
        lanes[lane.SPEEDS + here + LANES + k] = force * share
        lanes[lane.SHAKING + here + 2 * LANES + k] = (
            lanes[lane.TURN + k] * lanes[lane.SHAKING + here + k] * turn
        )
