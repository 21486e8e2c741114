"""Tso and Wong's symmetric steady states in closed form (eqs 12 to 25), free of cancellation.

With ``D = (1 - restitution)/(1 + restitution)``, ``h = tanh(n pi / 2 Omega)``, ``beta = A/(1 +
Omega^2)``, ``P = D h Omega`` and ``Q = D h^2/beta`` the phase f of a symmetric orbit solves
``P cos f + sin f = Q`` (eq 20); eqs 12 and 13 with 14 and 15 put in are 16 and 17, and 18 and 19
are those solved for v.  Written as printed (eqs 19, 21, 22) the velocity cancels at low
and high frequency and is 0/0 at restitution 1.  Put ``sin f = D s``; eliminating cos f between eqs
18 and 19 then gives the velocity after impact, du/dtau, for every restitution in (0, 1]::

    v = 2 restitution beta s / ((1 + restitution) h Omega)
    branch 1: s = (Q' + P' S)/(1 + P^2),                cos f = (Q^2 - 1)/(Q P + S)
    branch 2: s = (Q'^2 - P'^2)/(Q' + P' S),            cos f = (Q P + S)/(1 + P^2)

with ``P = D P'``, ``Q = D Q'`` and ``S = sqrt(1 + P^2 - Q^2)``; differences of squares come from
the distances of A to the three boundaries, ``Q = A25/A``, ``Q/P = A24/A``, ``S^2 = (1 + P^2)
(1 - (A23/A)^2)``.  In the same terms the trace of the half-cycle map is::

    T = -2 restitution + (cosh(n pi/Omega) - 1) K
    K = (1 + restitution)^2/(2 beta s) - (1 - restitution)^2 (1 + Omega^2)/2 - 2 restitution

and its determinant restitution^2, so that T = -(1 + restitution^2) can be solved for A.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.forcing import EPSILON, Forcing, grazes, make_forcing
from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.core.typed import FALSE, ZERO
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.exponential import expm1
from rocksteady.kernels.elementary.hyperbolic import tanh
from rocksteady.kernels.elementary.inverse import atan2
from rocksteady.kernels.elementary.lengths import hypot
from rocksteady.kernels.linear.arcs import exponentials
from rocksteady.kernels.linear.extrema import inner_extrema
from rocksteady.kernels.linear.flight import LARGEST_EXPONENT, Flight, Parts, flight_state, wrapped
from rocksteady.kernels.linear.landing import landing_jacobian
from rocksteady.kernels.linear.zeros import Zero, next_zero
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Booleans2, Floats1, Floats2, Integers1, Integers2

Floats = NDArray[np.float64]


class Symmetric(NamedTuple):
    """One symmetric orbit of the algebra, whether or not the floor allows it."""

    phase: float  # f, in (-pi, pi]
    sine: float
    cosine: float
    velocity: float  # du/dtau after impact
    trace: float  # of the half-cycle map in (phase, velocity); nan where it grazes


@inlined
def damping(restitution: float) -> float:
    """Return D = (1 - restitution)/(1 + restitution), defined below eq 20."""
    return (1.0 - restitution) / (1.0 + restitution)


@inlined
def existence_amplitude(frequency_ratio: float, restitution: float, h: float) -> float:
    """Return the least amplitude with a symmetric orbit (eq 23); h = 1: the heteroclinic one."""
    d, square = damping(restitution), 1.0 + frequency_ratio * frequency_ratio
    p = d * h * frequency_ratio
    return square * d * h * h / math.sqrt(1.0 + p * p)


@inlined
def sign_amplitude(frequency_ratio: float, h: float) -> float:
    """Return the amplitude at which the phase of branch 2 changes sign, P = Q (eq 24)."""
    return h * (1.0 + frequency_ratio * frequency_ratio) / frequency_ratio


@inlined
def kind_amplitude(frequency_ratio: float, restitution: float, h: float) -> float:
    """Return the amplitude at which branch 1 turns from in-phase to out-of-phase, Q = 1 (eq 25)."""
    return damping(restitution) * h * h * (1.0 + frequency_ratio * frequency_ratio)


@inlined
def region_of(amplitude: float, existence: float, sign: float, kind: float) -> int:
    """Return Tso and Wong's region 1 to 5 (Figs 3, 4) of an amplitude among three boundaries."""
    if amplitude < existence or amplitude == 0.0:
        return 4
    if amplitude > kind:
        return 1 if amplitude < sign else 2
    return 3 if amplitude < sign else 5


class HalfCycle(NamedTuple):
    """What depends on frequency, restitution and order alone, whatever the amplitude."""

    tanh: float  # h
    growth: float  # cosh(n pi/Omega) - 1, infinite where it overflows
    existence: float  # amplitudes of eqs 23, 24 and 25
    sign: float
    kind: float


@inlined
def half_cycle(frequency_ratio: float, restitution: float, order: int) -> HalfCycle:
    """Return h and cosh(n pi/Omega) - 1, from one exponential, and the three boundaries."""
    length = order * math.pi / frequency_ratio
    if length < LARGEST_EXPONENT:
        grown = expm1(length)
        h = grown / (grown + 2.0)
        growth = 0.5 * grown * (grown / (1.0 + grown))
    else:
        h, growth = 1.0, math.inf
    return HalfCycle(
        h,
        growth,
        existence_amplitude(frequency_ratio, restitution, h),
        sign_amplitude(frequency_ratio, h),
        kind_amplitude(frequency_ratio, restitution, h),
    )


@compiled
def symmetric_orbit(
    amplitude: float, frequency_ratio: float, restitution: float, order: int, branch: int
) -> Symmetric:
    """Return branch 1 or 2 (upper or lower signs of eqs 21, 22); the amplitude must allow it."""
    half = half_cycle(frequency_ratio, restitution, order)
    return orbit_of(amplitude, frequency_ratio, restitution, half, branch)


@inlined
def orbit_of(
    amplitude: float, frequency_ratio: float, restitution: float, half: HalfCycle, branch: int
) -> Symmetric:
    """Return phase (eqs 21, 22), velocity (eqs 18, 19) and trace of one branch."""
    d = damping(restitution)
    beta = amplitude / (1.0 + frequency_ratio * frequency_ratio)
    p, q = half.tanh * frequency_ratio, half.tanh * half.tanh / beta  # P' and Q'
    length = 1.0 + d * d * p * p  # 1 + P^2
    # Ratios to the amplitude, not differences of squares over its square: that may underflow.
    above, total = amplitude - half.existence, amplitude + half.existence
    root = math.sqrt(length * (above / amplitude) * (total / amplitude))
    if branch == 1:
        s = (q + p * root) / length  # eq 21 over D, upper sign; the cosine is eq 22
        # Q^2 - 1 is P^2 - S^2 too: where P is small, near the fold, the distance from A25 is lost.
        cosine = (d * p - root) * (d * p + root)
        if d * p > 1.0:
            cosine = (half.kind - amplitude) / amplitude * ((half.kind + amplitude) / amplitude)
        cosine /= d * d * p * q + root
    else:
        # Eqs 21, over D, and 22, lower signs.
        s = p * p * ((half.sign - amplitude) / amplitude) * ((half.sign + amplitude) / amplitude)
        s /= q + p * root
        cosine = (d * d * p * q + root) / length
    sine = d * s + 0.0  # never -0.0, whose phase would be -0.0 or -pi
    # Eq 19: its cos f is taken out by eq 18, and with it all cancellation.
    velocity = 2.0 * restitution * beta * s / ((1.0 + restitution) * p)
    trace = math.nan
    landing = 2.0 * abs(beta * s) / ((1.0 + restitution) * p)  # not of the velocity: may underflow
    if not grazes(frequency_ratio * landing, amplitude, frequency_ratio):
        trace = half_cycle_trace(frequency_ratio, restitution, half.growth, beta * s)
    return Symmetric(atan2(sine, cosine), sine, cosine, velocity, trace)


@inlined
def half_cycle_trace(
    frequency_ratio: float, restitution: float, growth: float, scaled_sine: float
) -> float:
    """Return the trace T of the half-cycle map; `scaled_sine` is beta sin(f)/D."""
    more, less = 1.0 + restitution, 1.0 - restitution
    stretch = (
        more * more / (2.0 * scaled_sine)
        - less * less * (1.0 + frequency_ratio * frequency_ratio) * 0.5
        - 2.0 * restitution
    )
    if stretch == 0.0:  # however long the half cycle is
        return -2.0 * restitution
    return -2.0 * restitution + growth * stretch


@compiled
def symmetry_breaking(frequency_ratio: float, restitution: float, order: int) -> float:
    """Return the amplitude at which the half-cycle map of branch 1 has multiplier -1.

    Solving T = -(1 + restitution^2) for beta s, and eq 20 for beta cos f, gives beta as the length
    of a vector.  There is exactly one such amplitude, above the existence boundary.
    """
    w = frequency_ratio
    half = half_cycle(w, restitution, order)
    h = half.tanh
    more, less = 1.0 + restitution, 1.0 - restitution
    loss = less * less
    part = 0.5 * loss * (1.0 + w * w) + 2.0 * restitution - loss / half.growth  # > 0 always
    scaled_sine = more * more / (2.0 * part)  # beta s
    rest = h * h - scaled_sine
    if half.growth > 2.0:  # at low frequency both are nearly 1: what each lacks to 1 instead
        rest = loss * (w * w - 2.0 / half.growth) / (2.0 * part) - 2.0 / (half.growth + 2.0)
    return hypot(damping(restitution) * scaled_sine, rest / (h * w)) * (1.0 + w * w)


@compiled
def half_cycle_flight(
    amplitude: float, frequency_ratio: float, order: int, orbit: Symmetric
) -> tuple[Flight, Forcing]:
    """Return the half cycle as a flight whose growing part is known from both ends; its forcing.

    From the initial velocity alone the growing part would be lost to rounding in long half cycles.
    Angle 0 at both ends (eqs 10, 12) gives it instead.
    """
    w = frequency_ratio
    forcing = make_forcing(-1.0, 0.0, amplitude, w)
    beta = forcing.beta
    length = order * math.pi / w
    h = tanh(0.5 * length)
    first, last = beta * orbit.sine - 1.0, -beta * orbit.sine - 1.0  # eq 15, and that of the end
    growing, decaying = exponentials(first, last, length)
    phase, speed = wrapped(orbit.phase), w * orbit.velocity
    a = h - beta * orbit.sine / h  # eq 14 with the velocity of eq 19
    parts = Parts(a, first, growing, length, decaying)
    return Flight(0.0, speed, phase, orbit.sine, orbit.cosine, parts), forcing


@compiled
def half_cycle_jacobian(
    amplitude: float, frequency_ratio: float, restitution: float, order: int, orbit: Symmetric
) -> tuple[float, float, float, float]:
    """Return the derivative of the half-cycle map in (phase, du/ds after impact), row by row."""
    w = frequency_ratio
    flight, forcing = half_cycle_flight(amplitude, w, order, orbit)
    length, landing = order * math.pi / w, -w * orbit.velocity / restitution  # eq 13
    end = wrapped(orbit.phase + math.pi)
    zero = Zero(FOUND, length, ZERO, end, -orbit.sine, -orbit.cosine, 0.0, landing)
    return landing_jacobian(forcing, restitution, flight, zero)


@compiled
def half_cycle_shape(
    amplitude: float, frequency_ratio: float, restitution: float, order: int, orbit: Symmetric
) -> tuple[float, int, bool]:
    """Return largest extremum, number of extrema, and whether the floor allows the half cycle.

    It is admissible when it leaves the floor upwards and meets it again at its end, no earlier.
    """
    w = frequency_ratio
    length = order * math.pi / w
    flight, forcing = half_cycle_flight(amplitude, w, order, orbit)
    peak, _, _, extrema = inner_extrema(flight, forcing, length)
    if not orbit.velocity > 0.0:
        return peak, extrema, False
    zero = next_zero(flight, forcing, length, FALSE, FALSE, -1.0)
    # The zero at the end itself may be found, displaced by the rounding of y over its slope there.
    blur = 64.0 * EPSILON * (1.0 + forcing.beta) * restitution / (w * orbit.velocity)
    earlier = zero.event == FOUND and zero.time < length * (1.0 - 64.0 * EPSILON) - blur
    return peak, extrema, not earlier


@compiled
def fill_half_cycle(
    amplitude: float,
    frequency_ratio: float,
    order: int,
    orbit: Symmetric,
    time: Floats1,
    states: Floats2,
) -> None:
    """Fill angle and velocity (per pivot time), shape (2, times), at times of the half cycle."""
    flight, forcing = half_cycle_flight(amplitude, frequency_ratio, order, orbit)
    for i in range(len(time)):
        phase = orbit.phase + frequency_ratio * time[i]
        sine, cosine = sincos_near(phase)
        states[0, i], states[1, i] = flight_state(flight, forcing, time[i], sine, cosine)


class Points(NamedTuple):
    """Where steady states are wanted; arrays of shape (points,)."""

    amplitude: Floats1
    frequency_ratio: Floats1
    restitution: Floats1
    order: Integers1


class Steady(NamedTuple):
    """Receives both branches at every point; where there is no orbit the numbers are nan.

    `region` has shape (points,), `boundaries` (3, points): existence, sign, kind; all else
    (2, points).
    """

    region: Integers1
    boundaries: Floats2
    phase: Floats2
    velocity: Floats2
    trace: Floats2
    peak: Floats2
    extrema: Integers2
    admissible: Booleans2


@compiled
def fill_steady(points: Points, shapes: bool, steady: Steady) -> None:
    """Fill both branches at every point; without `shapes` the last three are left as they are."""
    amplitude, frequency_ratio, restitution, order = points
    region, boundaries, phase, velocity, trace, peak, extrema, admissible = steady
    for i in range(len(amplitude)):
        a, w, r, n = amplitude[i], frequency_ratio[i], restitution[i], order[i]
        half = half_cycle(w, r, n)
        boundaries[0, i] = half.existence
        boundaries[1, i] = half.sign
        boundaries[2, i] = half.kind
        region[i] = region_of(a, half.existence, half.sign, half.kind)
        for b in range(2):
            if region[i] == 4:
                phase[b, i] = velocity[b, i] = trace[b, i] = math.nan
                if shapes:
                    peak[b, i], extrema[b, i], admissible[b, i] = math.nan, 0, False
                continue
            orbit = orbit_of(a, w, r, half, b + 1)
            phase[b, i], velocity[b, i], trace[b, i] = orbit.phase, orbit.velocity, orbit.trace
            if shapes:
                peak[b, i], extrema[b, i], admissible[b, i] = half_cycle_shape(a, w, r, n, orbit)


@compiled
def fill_curves(
    frequency_ratio: Floats1, restitution: Floats1, order: Integers1, curves: Floats2
) -> None:
    """Fill the five curves of the plane, shape (5, points), at each frequency ratio.

    Existence, sign and kind (eqs 23, 24, 25), symmetry breaking, and the heteroclinic curve.
    """
    for i in range(len(frequency_ratio)):
        w, r = frequency_ratio[i], restitution[i]
        half = half_cycle(w, r, order[i])
        curves[0, i], curves[1, i], curves[2, i] = half.existence, half.sign, half.kind
        curves[3, i] = symmetry_breaking(w, r, order[i])
        curves[4, i] = existence_amplitude(w, r, 1.0)
