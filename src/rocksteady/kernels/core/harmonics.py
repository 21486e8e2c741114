"""Periodic shaking as a Fourier series: its value, its bounds, and where it lifts a block at rest.

A base acceleration ``A S(psi)`` has the shape ``S``, the sum of ``p_k sin(k psi) + q_k cos(k psi)``
over the orders k = 1 ... K.  The *shares* are ``p_1, q_1, p_2, q_2, ...`` in a row, over the sum
of all ``sqrt(p_k^2 + q_k^2)``: so |S| is at most 1, and A bounds the acceleration.

**Uplift.**  A side lifts where ``f = sign S - level`` turns positive.  With B the sum of
``k^2 sqrt(p_k^2 + q_k^2)``, ``|f''| <= B``, and from a phase at which f < 0 it stays below the
parabola ``f + f' x + B x^2/2``.  The zero of that is therefore never beyond the next zero of f:
a walk from zero to zero of such parabolas passes none, and comes to a simple one as Newton's method
does.  It moves by `SHORTEST` at least, over which f rises by no more than rounding beside what its
slope gives; a crest that touches the level to rounding lifts nothing.
"""

import math

from rocksteady.kernels.core.forcing import EPSILON, TWO_PI, Forcing
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import compiled, inlined

AT_LIFT = 1e-12
"""Difference of a phase from that of uplift which is rounding."""
SHORTEST = 1e-8
"""Shortest step of the walk, over the highest order: its square is rounding."""


@compiled
def shape_at(shares: Floats, sine: float, cosine: float) -> tuple[float, float]:
    """Return S and its derivative at the phase that has this sine and cosine."""
    value = slope = 0.0
    order_sine, order_cosine = sine, cosine
    for k in range(len(shares) // 2):
        p, q = shares[2 * k], shares[2 * k + 1]
        value += p * order_sine + q * order_cosine
        slope += (k + 1) * (p * order_cosine - q * order_sine)
        order_sine, order_cosine = (
            order_sine * cosine + order_cosine * sine,
            order_cosine * cosine - order_sine * sine,
        )
    return value, slope


@compiled
def bound_of_order(shares: Floats, order: int) -> float:
    """Return an upper bound of the absolute derivative of S of an order."""
    bound = 0.0
    for k in range(len(shares) // 2):
        p, q = shares[2 * k], shares[2 * k + 1]
        size = math.sqrt(p * p + q * q)
        for _ in range(order):
            size *= k + 1
        bound += size
    return bound


@compiled
def is_antisymmetric(shares: Floats) -> bool:
    """Return whether half a period turns the shaking round: all orders are odd."""
    for k in range(1, len(shares) // 2, 2):
        if shares[2 * k] != 0.0 or shares[2 * k + 1] != 0.0:
            return False
    return True


@inlined
def level_of(forcing: Forcing) -> float:
    """Return the value of S, with the sign of the side, above which a block lifts."""
    return -forcing.constant / forcing.amplitude if forcing.amplitude > 0.0 else math.inf


@compiled
def above(shares: Floats, sign: float, level: float, phase: float) -> tuple[float, float]:
    """Return ``f = sign S - level`` and its derivative at a phase."""
    sine, cosine = sincos_near(phase)
    value, slope = shape_at(shares, sine, cosine)
    return sign * value - level, sign * slope


@compiled
def fill_lifts(shares: Floats, sign: float, level: float, lifts: Floats) -> None:
    """Fill the phases in [0, 2 pi) at which f turns positive, in order, infinite beyond the last.

    They are as many as the highest order at most, which is the length of `lifts`.
    """
    lifts[:] = math.inf
    if not level < 1.0:
        return
    bend = bound_of_order(shares, 2)
    shortest = SHORTEST / len(lifts)
    phase = 0.0
    value, slope = above(shares, sign, level, phase)
    began = positive = value > 0.0 or (value == 0.0 and slope > 0.0)
    count = 0
    while phase < TWO_PI:
        # Seen from the sign that f has, so that the next zero is always a rise.
        height, rise = (-value, -slope) if positive else (value, slope)
        root = math.sqrt(rise * rise - 2.0 * bend * min(height, 0.0))
        step = -2.0 * height / (rise + root) if rise > 0.0 else (root - rise) / bend
        later = min(phase + max(step, shortest), TWO_PI)
        value, slope = above(shares, sign, level, later)
        if (value > 0.0) != positive:
            low, high = phase, later
            for _ in range(100):
                middle = 0.5 * (low + high)
                if middle <= low or middle >= high:
                    break
                if (above(shares, sign, level, middle)[0] > 0.0) == positive:
                    low = middle
                else:
                    high = middle
            positive = not positive
            if positive and count < len(lifts) and high < TWO_PI:
                lifts[count] = high
                count += 1
        phase = later
    if began and not positive and count < len(lifts):
        # It rises through the level at 0, and rounding tells 0 from 2 pi.
        for j in range(count, 0, -1):
            lifts[j] = lifts[j - 1]
        lifts[0] = 0.0


@compiled
def lifts_at(shares: Floats, sign: float, level: float, lifts: Floats, phase: float) -> bool:
    """Return whether a block without speed lifts to a side at a phase in [-pi/2, 3 pi/2)."""
    if not level < 1.0:
        return False
    for j in range(len(lifts)):
        apart = abs(phase - lifts[j])
        if apart < AT_LIFT or abs(apart - TWO_PI) < AT_LIFT:
            return True
    value, slope = above(shares, sign, level, phase)
    if abs(value) <= 4.0 * EPSILON * (1.0 + level):
        return slope > 0.0
    return value > 0.0


@compiled
def next_lift(lifts: Floats, phase: float) -> tuple[float, int]:
    """Return the next phase of uplift after a phase in [0, 2 pi), and 1 if it is a period later.

    It is infinite where there is none.
    """
    for j in range(len(lifts)):
        if lifts[j] > phase:
            if lifts[j] < math.inf:
                return lifts[j], 0
            break
    return (lifts[0], 1) if len(lifts) > 0 else (math.inf, 0)


@compiled
def largest_ahead(shares: Floats, sign: float, phase: float, turn: float) -> tuple[float, float]:
    """Return upper bounds of ``sign S`` and of |S'| over the next `turn` of the phase."""
    sine, cosine = sincos_near(phase)
    value, slope = shape_at(shares, sine, cosine)
    value, slope = sign * value, sign * slope
    bend = bound_of_order(shares, 2)
    crest = max(value, value + turn * (slope + 0.5 * bend * turn))
    steepest = abs(slope) + bend * turn
    return min(crest, 1.0), min(steepest, bound_of_order(shares, 1))
