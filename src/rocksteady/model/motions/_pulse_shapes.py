"""Shapes of single pulses, each with largest acceleration `a`.

Written with w = omega/p and pivot time s from the start of the pulse; T = 2 pi/w is its period.
What a shape is in numbers stands here, and the segments that follow from them are filled by
`rocksteady.kernels.core.motions.fill_pulse`, for the package and for the explorer's page.

References
----------
.. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).
.. [2] N. Makris and Y. S. Roussos, Geotechnique 50, 243-262 (2000).  Types A, B and C_n.
"""

import math
import re
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from rocksteady.kernels.elementary.arrays import atan2, sin
from rocksteady.kernels.elementary.roots import root
from rocksteady.model.motions._sampled import refuse_many_lines
from rocksteady.model.motions.segments import Segment

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

CLOSED, RICKER, RICKER_ANTISYMMETRIC, MAVROEIDIS_PAPAGEORGIOU = range(4)
"""Forms of a pulse, as `rocksteady.kernels.core.motions` has them."""


class Piece(NamedTuple):
    """A segment of a pulse: it lasts turn/w, and its sinusoid has the frequency turns w.

    Constant, slope (times the duration) and size of the sinusoid are over `a`.
    """

    turn: float
    constant: float = 0.0
    slope: float = 0.0
    size: float = 0.0
    turns: float = 0.0
    phase: float = 0.0


class Shape(NamedTuple):
    """A named shape: how long it lasts, what it is in words, and in numbers."""

    lasts: str
    words: str
    pieces: tuple[Piece, ...] = ()
    form: int = CLOSED


HALF_A_PERIOD, A_PERIOD = "Half a period", "A period"
TYPE_C, WAVELETS = "About n + 1/2 periods", "Wavelets"

SHAPES: dict[str, Shape] = {
    "rectangle": Shape(  # [1]_
        HALF_A_PERIOD, "constant for half a period", (Piece(math.pi, constant=1.0),)
    ),
    "half-sine": Shape(  # [1]_
        HALF_A_PERIOD, "sine for half a period", (Piece(math.pi, size=1.0, turns=1.0),)
    ),
    "versed-sine": Shape(  # begins and ends flat
        HALF_A_PERIOD,
        "(1 - cos)/2, one lobe in half a period",
        (Piece(math.pi, constant=0.5, size=0.5, turns=2.0, phase=-0.5 * math.pi),),
    ),
    "triangle": Shape(
        HALF_A_PERIOD,
        "up and down along lines in half a period",
        (Piece(0.5 * math.pi, slope=1.0), Piece(0.5 * math.pi, constant=1.0, slope=-1.0)),
    ),
    "decaying-ramp": Shape(
        HALF_A_PERIOD,
        "at once up, down along a line in half a period",
        (Piece(math.pi, constant=1.0, slope=-1.0),),
    ),
    "one-sine": Shape(  # type A of [2]_: the ground moves forward and stays
        A_PERIOD, "sine for a period (type A)", (Piece(2.0 * math.pi, size=1.0, turns=1.0),)
    ),
    "one-cosine": Shape(  # type B of [2]_: the ground moves forward and back
        A_PERIOD,
        "cosine for a period (type B)",
        (Piece(2.0 * math.pi, size=1.0, turns=1.0, phase=0.5 * math.pi),),
    ),
    "type-c1": Shape(TYPE_C, "cosine for 1.43 periods from a phase at which the ground comes back"),
    "type-c2": Shape(TYPE_C, "the same for 2.46 periods"),
    "type-c3": Shape(TYPE_C, "the same for 3.47 periods"),
    "ricker": Shape(
        WAVELETS,
        "second derivative of a Gaussian bell, one large lobe between two small ones",
        form=RICKER,
    ),
    "ricker-antisymmetric": Shape(
        WAVELETS,
        "third derivative, one lobe and its opposite between two small ones",
        form=RICKER_ANTISYMMETRIC,
    ),
    "mavroeidis-papageorgiou": Shape(
        WAVELETS,
        "a velocity cos(omega t + nu) under a bell of gamma periods",
        form=MAVROEIDIS_PAPAGEORGIOU,
    ),
}
"""By name; type-c4 and so on go on in the same way."""


def listed() -> str:
    """Return the names of all shapes, by how long they last."""
    groups: dict[str, list[str]] = {}
    for name, shape in SHAPES.items():
        groups.setdefault(shape.lasts, []).append(name)
    groups[TYPE_C].append("..")  # and the full stop
    return ". ".join(f"{lasts}: {', '.join(names)}" for lasts, names in groups.items())


def type_c_of(name: str) -> int | None:
    """Return n of a type C_n pulse; None of another."""
    match = re.fullmatch(r"type-c([1-9][0-9]?)", name)
    return int(match[1]) if match else None


def pieces_of(name: str) -> tuple[Piece, ...]:
    """Return the pieces of a shape in closed form; none of a wavelet.

    Type C_n of [2]_ is ``a cos(w s + phi)`` for some n + 1/2 periods.  The phase ends the pulse
    with base velocity and displacement 0: it lasts ``((2 n + 1) pi - 2 phi)/w``, with
    ``2 cos(phi) = ((2 n + 1) pi - 2 phi) sin(phi)``.
    """
    n = type_c_of(name)
    if n is None:
        return SHAPES[name].pieces
    phi = type_c_phase(n)
    turn = (2 * n + 1) * math.pi - 2.0 * phi
    return (Piece(turn, size=1.0, turns=1.0, phase=phi + 0.5 * math.pi),)


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


def segments_of(
    name: str, a: float, w: float, *, tolerance: float, oscillations: float, phase: float
) -> tuple[Segment, ...]:
    """Return the segments of a pulse.

    Parameters
    ----------
    name
        Its shape.
    a, w
        Largest acceleration, and omega/p.
    tolerance
        Tolerance of the lines along a wavelet, as a part of a.
    oscillations, phase
        gamma > 1 and nu [rad] of a Mavroeidis-Papageorgiou pulse.

    Raises
    ------
    InputError
        If a wavelet needs more than 200 000 lines.
    """
    import numpy as np

    from rocksteady.kernels.core import tables as columns
    from rocksteady.kernels.core.motions import PIECE_COLUMNS, PulseNumbers, fill_pulse

    form = SHAPES[name].form if name in SHAPES else CLOSED
    pieces = np.array(pieces_of(name), dtype=np.float64).reshape(-1, PIECE_COLUMNS)
    reach = reach_of(form, tolerance) if form in (RICKER, RICKER_ANTISYMMETRIC) else 0.0
    peaked = form == MAVROEIDIS_PAPAGEORGIOU
    peak = peak_of_unit_velocity(oscillations, phase) if peaked else 1.0
    pulse = PulseNumbers(form, pieces, a, w, tolerance, reach, oscillations, phase, peak)
    count, needed = fill_pulse(pulse, np.zeros((0, columns.SEGMENT_COLUMNS)))
    refuse_many_lines(needed, tolerance)
    table = np.zeros((count, columns.SEGMENT_COLUMNS))
    fill_pulse(pulse, table)
    return tuple(
        Segment(
            duration=row[columns.DURATION],
            constant=row[columns.CONSTANT],
            slope=row[columns.SLOPE],
            amplitude=row[columns.AMPLITUDE],
            frequency=row[columns.FREQUENCY],
            phase=row[columns.PHASE],
        )
        for row in table.tolist()
    )


def reach_of(form: int, tolerance: float) -> float:
    """Return where a Ricker wavelet stays below a part of its amplitude for good, as u."""
    from rocksteady.kernels.core.motions import ricker_at

    odd = form == RICKER_ANTISYMMETRIC
    # Beyond u = 2.5 both only fall off.
    return root(lambda u: abs(ricker_at(odd, u)) - tolerance, 2.5, 40.0)


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
        waves = ((0.5, 1.0), (0.25, 1.0 + 1.0 / oscillations), (0.25, 1.0 - 1.0 / oscillations))
        return np.abs(sum(v * w * sin(w * s + phase) for v, w in waves))

    end = oscillations * math.pi
    s = np.linspace(-end, end, 2 * math.ceil(200.0 * oscillations) + 1)
    best = int(np.argmax(size(s)))
    low, high = s[max(best - 1, 0)], s[min(best + 1, len(s) - 1)]
    peak = minimize_scalar(
        lambda s: -float(size(s)), bounds=(low, high), method="bounded", options={"xatol": 1e-10}
    )
    return float(max(-peak.fun, size(s)[best]))
