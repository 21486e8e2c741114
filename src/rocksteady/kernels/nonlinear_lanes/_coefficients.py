"""Taylor coefficients of all lanes."""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes._layout import (
    ALPHA,
    AMPLITUDE,
    ANGLE,
    BY_COSINE,
    BY_SINE,
    COSINES,
    FORCE,
    FREQUENCY,
    HIGHEST,
    INVERSE,
    LANES,
    OFFSETS,
    PHASE,
    SHAKING,
    SINES,
    SPEED,
    SPEEDS,
    SQUARE,
    SWING_RATE,
    TIME,
    TURN,
)


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
        sine, cosine = sincos_short(lanes[PHASE + k] + lanes[FREQUENCY + k] * lanes[TIME + k])
        lanes[SHAKING + k] = lanes[AMPLITUDE + k] * sine
        lanes[SHAKING + LANES + k] = lanes[SWING_RATE + k] * cosine
    for k in range(LANES):
        sine, cosine = sincos_short(lanes[ALPHA + k] * (1.0 - lanes[ANGLE + k]))
        lanes[SINES + k] = sine * lanes[INVERSE + k]
        lanes[COSINES + k] = cosine
        lanes[SPEEDS + k] = lanes[SPEED + k]


@inlined
def first_sums(lanes: Floats, n: int, odd: int) -> None:
    """Begin the sums of order n with so many products, 0 to 3."""
    left = (n * LANES) & OFFSETS
    if odd == 0:
        for k in range(LANES):
            lanes[FORCE + k] = 0.0
            lanes[BY_COSINE + k] = 0.0
            lanes[BY_SINE + k] = 0.0
    elif odd == 1:
        for k in range(LANES):
            c0, s0 = lanes[COSINES + left + k], lanes[SINES + left + k]
            v0 = lanes[SPEEDS + k]
            lanes[FORCE + k] = lanes[SHAKING + k] * c0
            lanes[BY_COSINE + k] = v0 * c0
            lanes[BY_SINE + k] = v0 * s0
    else:
        back = ((n - 1) * LANES) & OFFSETS
        for k in range(LANES):
            c0, s0 = lanes[COSINES + back + LANES + k], lanes[SINES + back + LANES + k]
            c1, s1 = lanes[COSINES + back + k], lanes[SINES + back + k]
            v0, v1 = lanes[SPEEDS + k], lanes[SPEEDS + LANES + k]
            lanes[FORCE + k] = lanes[SHAKING + k] * c0 + lanes[SHAKING + LANES + k] * c1
            lanes[BY_COSINE + k] = v0 * c0 + v1 * c1
            lanes[BY_SINE + k] = v0 * s0 + v1 * s1
        if odd == 3:
            back = ((n - 2) * LANES) & OFFSETS
            for k in range(LANES):
                c2, s2 = lanes[COSINES + back + k], lanes[SINES + back + k]
                v2 = lanes[SPEEDS + 2 * LANES + k]
                lanes[FORCE + k] += lanes[SHAKING + 2 * LANES + k] * c2
                lanes[BY_COSINE + k] += v2 * c2
                lanes[BY_SINE + k] += v2 * s2


@inlined
def add_four(lanes: Floats, j: int, rest: int) -> None:
    """Add the products of terms j to j + 3 with terms `rest` to `rest` - 3."""
    up = (j * LANES) & OFFSETS
    down = ((rest - 3) * LANES) & OFFSETS
    for k in range(LANES):
        c0, s0 = lanes[COSINES + down + 3 * LANES + k], lanes[SINES + down + 3 * LANES + k]
        c1, s1 = lanes[COSINES + down + 2 * LANES + k], lanes[SINES + down + 2 * LANES + k]
        c2, s2 = lanes[COSINES + down + LANES + k], lanes[SINES + down + LANES + k]
        c3, s3 = lanes[COSINES + down + k], lanes[SINES + down + k]
        v0, v1 = lanes[SPEEDS + up + k], lanes[SPEEDS + up + LANES + k]
        v2, v3 = lanes[SPEEDS + up + 2 * LANES + k], lanes[SPEEDS + up + 3 * LANES + k]
        h0, h1 = lanes[SHAKING + up + k], lanes[SHAKING + up + LANES + k]
        h2, h3 = lanes[SHAKING + up + 2 * LANES + k], lanes[SHAKING + up + 3 * LANES + k]
        lanes[FORCE + k] += (h0 * c0 + h1 * c1) + (h2 * c2 + h3 * c3)
        lanes[BY_COSINE + k] += (v0 * c0 + v1 * c1) + (v2 * c2 + v3 * c3)
        lanes[BY_SINE + k] += (v0 * s0 + v1 * s1) + (v2 * s2 + v3 * s3)


@inlined
def next_terms(lanes: Floats, n: int) -> None:
    """Fill the coefficients n + 1 from the sums of order n, and n + 2 of h."""
    here = (n * LANES) & OFFSETS
    share = 1.0 / (n + 1)
    turn = share / (n + 2)
    for k in range(LANES):
        force = lanes[FORCE + k] - lanes[SINES + here + k]
        lanes[SINES + here + LANES + k] = -lanes[BY_COSINE + k] * share
        lanes[COSINES + here + LANES + k] = lanes[SQUARE + k] * lanes[BY_SINE + k] * share
        lanes[SPEEDS + here + LANES + k] = force * share
        lanes[SHAKING + here + 2 * LANES + k] = lanes[TURN + k] * lanes[SHAKING + here + k] * turn
