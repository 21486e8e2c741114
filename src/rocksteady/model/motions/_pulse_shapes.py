"""Shapes of single pulses as segments, each with largest acceleration `a`.

Written with w = omega/p and pivot time s from the start of the pulse; T = 2 pi/w is its period.

References
----------
.. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).
.. [2] N. Makris and Y. S. Roussos, Geotechnique 50, 243-262 (2000).  Types A, B and C_n.
.. [3] N. Ricker, Geophysics 18, 10-40 (1953); in the form of M. F. Vassiliou and N. Makris, Bull.
   Seism. Soc. Am. 101, 596-618 (2011).
.. [4] G. P. Mavroeidis and A. S. Papageorgiou, Bull. Seism. Soc. Am. 93, 1099-1131 (2003).
"""

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, TypeVar

from rocksteady.kernels.elementary.arrays import atan2, exp, sin
from rocksteady.kernels.elementary.roots import root
from rocksteady.model.motions._sampled import polyline
from rocksteady.model.motions.combine import added, scale_motion
from rocksteady.model.motions.segments import Piecewise, Segment

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

NumberT = TypeVar("NumberT", float, "Floats")
Pieces = tuple[Segment, ...]
Shape = Callable[[float, float], Pieces]


def rectangle(a: float, w: float) -> Pieces:
    """Return a constant for half a period [1]_."""
    return (Segment(duration=math.pi / w, constant=a),)


def half_sine(a: float, w: float) -> Pieces:
    """Return ``a sin(w s)`` for half a period [1]_."""
    return (Segment(duration=math.pi / w, amplitude=a, frequency=w),)


def versed_sine(a: float, w: float) -> Pieces:
    """Return ``a (1 - cos 2 w s)/2`` for half a period: one lobe that begins and ends flat."""
    lobe = Segment(
        duration=math.pi / w,
        constant=0.5 * a,
        amplitude=0.5 * a,
        frequency=2.0 * w,
        phase=-0.5 * math.pi,
    )
    return (lobe,)


def triangle(a: float, w: float) -> Pieces:
    """Return lines from 0 to a and back, a quarter of a period each."""
    quarter = 0.5 * math.pi / w
    return (
        Segment(duration=quarter, slope=a / quarter),
        Segment(duration=quarter, constant=a, slope=-a / quarter),
    )


def decaying_ramp(a: float, w: float) -> Pieces:
    """Return a line from a down to 0 in half a period."""
    half = math.pi / w
    return (Segment(duration=half, constant=a, slope=-a / half),)


def one_sine(a: float, w: float) -> Pieces:
    """Return ``a sin(w s)`` for a period, type A of [2]_: the ground moves forward and stays."""
    return (Segment(duration=2.0 * math.pi / w, amplitude=a, frequency=w),)


def one_cosine(a: float, w: float) -> Pieces:
    """Return ``a cos(w s)`` for a period, type B of [2]_: the ground moves forward and back."""
    return (Segment(duration=2.0 * math.pi / w, amplitude=a, frequency=w, phase=0.5 * math.pi),)


def type_c(n: int) -> Shape:
    """Return ``a cos(w s + phi)`` for some n + 1/2 periods, type C_n of [2]_, from a and w.

    The phase ends the pulse with base velocity and displacement 0: it lasts
    ``((2 n + 1) pi - 2 phi)/w``, with ``2 cos(phi) = ((2 n + 1) pi - 2 phi) sin(phi)``.
    """

    def pieces(a: float, w: float) -> Pieces:
        phi = type_c_phase(n)
        return (
            Segment(
                duration=((2 * n + 1) * math.pi - 2.0 * phi) / w,
                amplitude=a,
                frequency=w,
                phase=phi + 0.5 * math.pi,
            ),
        )

    return pieces


@lru_cache
def type_c_phase(n: int) -> float:
    """Return the phase of a type C_n pulse [rad].

    Examples
    --------
    The two phases that [2]_ prints:

    >>> [round(type_c_phase(n) / math.pi, 4) for n in (1, 2)]
    [0.0697, 0.041]
    """
    phi = 0.0
    for _ in range(20):  # each step leaves less than a twentieth of the error
        phi = atan2(2.0, (2 * n + 1) * math.pi - 2.0 * phi)
    return phi


CLOSED: dict[str, tuple[Shape, str]] = {
    "rectangle": (rectangle, "constant for half a period"),
    "half-sine": (half_sine, "sine for half a period"),
    "versed-sine": (versed_sine, "(1 - cos)/2, one lobe in half a period"),
    "triangle": (triangle, "up and down along lines in half a period"),
    "decaying-ramp": (decaying_ramp, "at once up, down along a line in half a period"),
    "one-sine": (one_sine, "sine for a period (type A)"),
    "one-cosine": (one_cosine, "cosine for a period (type B)"),
    "type-c1": (type_c(1), "cosine for 1.43 periods from a phase at which the ground comes back"),
    "type-c2": (type_c(2), "the same for 2.46 periods"),
    "type-c3": (type_c(3), "the same for 3.47 periods"),
}
"""Shapes that segments hold exactly: their pieces, and what they are in words."""

WAVELETS: dict[str, str] = {
    "ricker": "second derivative of a Gaussian bell, one large lobe between two small ones",
    "ricker-antisymmetric": "third derivative, one lobe and its opposite between two small ones",
    "mavroeidis-papageorgiou": "a velocity cos(omega t + nu) under a bell of gamma periods",
}
"""Shapes that are sampled, in words."""


BENDS = {
    False: (math.sqrt(5.0 - math.sqrt(10.0)), math.sqrt(5.0 + math.sqrt(10.0))),
    True: (0.6167065902, 1.8891758778, 3.3242574336),
}
"""Values of u > 0 at which the second derivative has its extrema, of either Ricker wavelet."""
BEYOND = 1.0 + 1e-9
"""What rounding of these places may have lost."""
CUTS = {False: (0.4, 2.2, 4.2), True: (1.1, 2.6, 4.6)}
"""Values of u at which the lines change their length, chosen for few of them."""


def ricker(a: float, w: float, *, antisymmetric: bool, tolerance: float) -> Pieces:
    """Return straight lines along a Ricker wavelet [3]_ whose Fourier spectrum is largest at w.

    With u the time from its middle over ``sqrt(2)/w``, or ``sqrt(3)/w`` of the antisymmetric one,
    it is ``a (1 - u^2) exp(-u^2/2)`` or ``a (u^3 - 3 u) exp(-u^2/2)/1.38``.  It begins and ends
    where it stays below the tolerance for good.  The second derivative in u is Hermite's polynomial
    of the fourth or fifth degree times the bell, and has its extrema at the zeros of the next one.
    So its bound is known between any two u, and the lines are longer where it is less.

    Parameters
    ----------
    a, w
        Largest acceleration, and omega/p.
    antisymmetric
        Which of the two.
    tolerance
        As a part of a.
    """
    # Where the antisymmetric one is largest, u^4 - 6 u^2 + 3 = 0.
    crest = math.sqrt(3.0 - math.sqrt(6.0))
    peak = crest * (3.0 - crest * crest) * exp(-0.5 * crest * crest)

    def wave(u: NumberT) -> NumberT:
        bell = exp(-0.5 * u * u)
        return u * (u * u - 3.0) * bell / peak if antisymmetric else (1.0 - u * u) * bell

    def bend(u: float) -> float:
        square = u * u
        bell = exp(-0.5 * square)
        if antisymmetric:
            return abs(u * (square * (square - 10.0) + 15.0)) * bell / peak
        return abs(square * (square - 6.0) + 3.0) * bell

    def steepest(low: float, high: float) -> float:
        bends = BENDS[antisymmetric]
        return BEYOND * max(bend(u) for u in (low, high, *bends) if low <= u <= high)

    unit = math.sqrt(3.0 if antisymmetric else 2.0) / w
    # Beyond u = 2.5 both only fall off.
    reach = root(lambda u: abs(wave(u)) - tolerance, 2.5, 40.0)
    ends = [0.0, *(cut for cut in CUTS[antisymmetric] if cut < reach), reach]
    half = [
        (unit * (high - low), steepest(low, high) / (unit * unit)) for low, high in pairwise(ends)
    ]
    return polyline(
        lambda s: wave(s / unit - reach), [*reversed(half), *half], tolerance=tolerance, size=a
    )


def mavroeidis_papageorgiou(
    a: float, w: float, *, oscillations: float, phase: float, tolerance: float
) -> Pieces:
    """Return straight lines along the pulse of [4]_, scaled to a largest acceleration.

    Its velocity is ``(V/2) (1 + cos(w s/gamma)) cos(w s + nu)`` over ``|s| <= gamma pi/w``, a sum
    of three sinusoids.

    Parameters
    ----------
    a, w
        Largest acceleration, and omega/p.
    oscillations, phase
        gamma > 1, and nu [rad].
    tolerance
        Tolerance of the lines, as a part of a.
    """
    v = 1.0 / (w * peak_of_unit_velocity(oscillations, phase))  # for an acceleration of 1
    start = -oscillations * math.pi / w
    waves = []
    for share, frequency in _velocity_waves(oscillations):
        wave = Segment(
            duration=-2.0 * start,
            # d/ds of cos(W s + nu) is -W sin(W s + nu)
            amplitude=-v * share * frequency * w,
            frequency=frequency * w,
            phase=frequency * w * start + phase,
        )
        waves.append(Piecewise(pieces=(wave,)))
    return scale_motion(added(waves, tolerance, series=False), a).segments()


def _velocity_waves(oscillations: float) -> tuple[tuple[float, float], ...]:
    """Return the share of the velocity's amplitude and the frequency over w of its three waves."""
    return (
        (0.5, 1.0),
        (0.25, 1.0 + 1.0 / oscillations),
        (0.25, 1.0 - 1.0 / oscillations),
    )


@lru_cache
def peak_of_unit_velocity(oscillations: float, phase: float) -> float:
    """Return the largest acceleration of a Mavroeidis-Papageorgiou pulse with V = w = 1.

    Examples
    --------
    >>> round(peak_of_unit_velocity(2.0, 0.0), 6)
    0.906025
    """
    import numpy as np
    from scipy.optimize import minimize_scalar

    def size(s: "Floats") -> "Floats":
        waves = (v * w * sin(w * s + phase) for v, w in _velocity_waves(oscillations))
        return np.abs(sum(waves))

    end = oscillations * math.pi
    s = np.linspace(-end, end, 2 * math.ceil(200.0 * oscillations) + 1)
    best = int(np.argmax(size(s)))
    low, high = s[max(best - 1, 0)], s[min(best + 1, len(s) - 1)]
    peak = minimize_scalar(
        lambda s: -float(size(s)), bounds=(low, high), method="bounded", options={"xatol": 1e-10}
    )
    return float(max(-peak.fun, size(s)[best]))
