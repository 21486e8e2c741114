"""Arc: a flight between two impacts of known phase, well-conditioned for any duration.

With angle 0 at both ends the two exponentials of a flight are known from the ends, and nothing
grows: with ``f = beta sin psi - 1`` at the first and last phase psi0, psi1 and the pivot time ``T =
(psi1 - psi0)/Omega`` the speeds with which the block leaves its base and lands are::

    start   = (f1 - f0)/sinh T - f0 tanh(T/2) - beta Omega cos psi0
    landing = (f0 - f1)/sinh T - f1 tanh(T/2) + beta Omega cos psi1

Both are smooth in the two phases, in amplitude and in frequency, also where the landing grazes,
where the duration passes 0 into the negative, and where the arc lies below the base.  An orbit is a
closed chain of arcs whose speeds agree at every impact (`kernels.orbits.chains`), which is what
the continuation of orbits solves; the return map (`kernels.orbits.return_map`) has a pole at every
graze.  By either phase the derivatives of the other end are simple::

    d start/d psi1 = landing/(Omega sinh T),    d landing/d psi0 = -start/(Omega sinh T)
"""

from typing import NamedTuple

from rocksteady.kernels.core.forcing import Forcing
from rocksteady.kernels.elementary.circular import cos, sin, sincos_near
from rocksteady.kernels.elementary.exponential import exp, expm1
from rocksteady.kernels.elementary.hyperbolic import sinh, tanh
from rocksteady.kernels.linear.flight import LARGEST_EXPONENT, Flight, Parts, wrapped
from rocksteady.kernels.machine_code.compilation import compiled

SMALL = 0.25
"""Argument below which sin(x)/x and sinh(x)/x less 1 are their series: the next term is 1e-15."""


class Arc(NamedTuple):
    """Speeds at both ends of an arc and their derivatives, in the units of its side."""

    start: float
    landing: float
    start_by_first: float  # by the phase at the start ...
    start_by_last: float  # ... and at the landing
    landing_by_first: float
    landing_by_last: float
    start_by_amplitude: float
    landing_by_amplitude: float
    start_by_frequency: float  # the phases staying
    landing_by_frequency: float


@compiled
def series(square: float) -> float:
    """Return sinh(x)/x - 1 of a small x by x^2; of -x^2 it is sin(x)/x - 1."""
    inner = 1.0 + square / 72.0 * (1.0 + square / 110.0)
    return square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0 * inner))


@compiled
def sine_excess(x: float) -> float:
    """Return sin(x)/x - 1, with all its digits however small x is."""
    return series(-x * x) if abs(x) < SMALL else sin(x) / x - 1.0


@compiled
def sinh_excess(x: float) -> float:
    """Return x/sinh(x) - 1, with all its digits however small x is."""
    if abs(x) < SMALL:
        more = series(x * x)
        return -more / (1.0 + more)
    return sinh_ratio(x) - 1.0


@compiled
def sine_ratio(x: float) -> float:
    """Return sin(x)/x."""
    return sin(x) / x if x != 0.0 else 1.0


@compiled
def sinh_ratio(x: float) -> float:
    """Return x/sinh(x)."""
    if x == 0.0:
        return 1.0
    return x / sinh(x) if abs(x) <= LARGEST_EXPONENT else 0.0


@compiled
def make_arc(forcing: Forcing, duration: float, first: float, last: float) -> Arc:
    """Return the arc between two phases of its side's forcing.

    Parameters
    ----------
    forcing
        Harmonic: no slope, and -1 for its constant.
    duration
        T > 0; a negative one continues the formulae.
    first, last
        psi0 and psi1, whole periods left out as one likes.
    """
    beta, w = forcing.beta, forcing.frequency
    sine0, cosine0 = sincos_near(first)
    sine1, cosine1 = sincos_near(last)
    half_turn = 0.5 * w * duration
    middle = first + half_turn
    ratio = sinh_ratio(duration)  # T/sinh T
    chord = sine_ratio(half_turn)
    cosine_chord = -sin(middle) * w * chord * ratio  # (cos psi1 - cos psi0)/sinh T
    bend = tanh(0.5 * duration)
    # (sin psi1 - sin psi0)/sinh T less Omega cos psi0, or less Omega cos psi1, as a sum of small
    # numbers: in a short arc the speeds themselves are small.
    lacking, turned = sinh_excess(duration), ratio * half_turn * chord * chord
    straight = ratio * sine_excess(2.0 * half_turn) + lacking
    per_start = w * (straight * cosine0 - turned * sine0) - sine0 * bend
    per_landing = -w * (straight * cosine1 + turned * sine1) - sine1 * bend

    start = beta * per_start - forcing.constant * bend
    landing = beta * per_landing - forcing.constant * bend
    # Over sinh T, which may be 0 in the limit: only where the duration itself is 0.
    if duration != 0.0:
        inverse = ratio / duration
        start_by_last = inverse * landing / w
        landing_by_first = -inverse * start / w
    else:  # start and landing vanish like T/2 times the acceleration, upwards negative
        start_by_last = -0.5 * (forcing.constant + forcing.amplitude * sine1) / w
        landing_by_first = 0.5 * (forcing.constant + forcing.amplitude * sine0) / w
    start_by_first = -start_by_last + beta * cosine_chord - beta * cosine0 * bend + beta * w * sine0
    landing_by_last = (
        -landing_by_first - beta * cosine_chord - beta * cosine1 * bend - beta * w * sine1
    )
    share = 1.0 / (1.0 + w * w)  # beta/amplitude
    less = -2.0 * w * share * beta  # d beta/d Omega
    return Arc(
        start,
        landing,
        start_by_first,
        start_by_last,
        landing_by_first,
        landing_by_last,
        share * per_start,
        share * per_landing,
        less * per_start - beta * cosine0 - (ratio / w) * (landing - beta * w * cosine1),
        less * per_landing + beta * cosine1 - (ratio / w) * (start + beta * w * cosine0),
    )


@compiled
def exponentials(first: float, last: float, duration: float) -> tuple[float, float]:
    """Return G and H of ``G e^(t - T) + H e^-t`` from its values at 0 and at the duration T."""
    decay = exp(-duration)
    span = -expm1(-2.0 * duration)
    return (last - first * decay) / span, (first - last * decay) / span


@compiled
def arc_flight(forcing: Forcing, duration: float, first: float, last: float) -> Flight:
    """Return an arc of positive duration as a flight that knows its growing part from both ends.

    From the initial velocity alone the growing part would be lost to rounding in long arcs.
    """
    beta, w = forcing.beta, forcing.frequency
    sine, cosine = sincos_near(first)
    begin, end = forcing.constant + beta * sine, forcing.constant + beta * sin(last)
    growing, decaying = exponentials(begin, end, duration)
    chord = cos(first + 0.5 * w * duration) * w * sine_ratio(0.5 * w * duration)
    swing = beta * chord * sinh_ratio(duration) - begin * tanh(0.5 * duration)
    velocity = swing - beta * w * cosine
    parts = Parts(swing, begin, growing, duration, decaying)
    return Flight(0.0, velocity, wrapped(first), sine, cosine, parts)
