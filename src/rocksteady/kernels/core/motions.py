"""Tables of segments of single pulses and of sampled motions, and the bounds in both.

References
----------
.. [1] N. Ricker, Geophysics 18, 10-40 (1953); in the form of M. F. Vassiliou and N. Makris, Bull.
   Seism. Soc. Am. 101, 596-618 (2011).
.. [2] G. P. Mavroeidis and A. S. Papageorgiou, Bull. Seism. Soc. Am. 93, 1099-1131 (2003).
"""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import PI_LOW
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import ROUND
from rocksteady.kernels.elementary.circular import sincos
from rocksteady.kernels.elementary.exponential import exp
from rocksteady.kernels.elementary.lengths import hypot
from rocksteady.kernels.machine_code.compilation import allocating, compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2

# Columns of a piece of a pulse in closed form: turn/w is its duration, turns w its frequency.
TURN = 0
CONSTANT = 1  # over the amplitude of the pulse, as SLOPE (times the duration) and SIZE
SLOPE = 2
SIZE = 3
TURNS = 4
PHASE = 5
PIECE_COLUMNS = 6

CLOSED, RICKER, RICKER_ANTISYMMETRIC, MAVROEIDIS_PAPAGEORGIOU = range(4)
"""Forms of a pulse: pieces in closed form, or straight lines along a wavelet."""

BENDS = (math.sqrt(5.0 - math.sqrt(10.0)), math.sqrt(5.0 + math.sqrt(10.0)), math.inf)
ANTISYMMETRIC_BENDS = (0.6167065902, 1.8891758778, 3.3242574336)
"""Values of u > 0 at which the second derivative of a Ricker wavelet has its extrema."""
CUTS, ANTISYMMETRIC_CUTS = (0.4, 2.2, 4.2), (1.1, 2.6, 4.6)
"""Values of u at which the lines change their length, chosen for few of them."""
CREST = 1.3801190461607493
"""Largest value of ``(u^3 - 3 u) exp(-u^2/2)``, where u^4 - 6 u^2 + 3 = 0."""
BEYOND = 1.0 + 1e-9
"""What rounding of the places of extrema may have lost."""
FULL_TURN = 2.0 * math.pi
TURN_HIGH = float(int(FULL_TURN * 2.0**30)) * 2.0**-30
TURN_LOW = FULL_TURN - TURN_HIGH
"""A full turn in two parts, whose products with numbers of turns are exact."""


class PulseNumbers(NamedTuple):
    """A pulse in numbers.

    Attributes
    ----------
    form
        CLOSED, or which wavelet.
    pieces
        Shape (pieces, 6); of a wavelet (0, 6).
    amplitude, frequency_ratio
        Its largest acceleration over alpha g, and w = omega/p.
    tolerance
        Of the lines along a wavelet, as a part of the amplitude.
    reach
        Where a Ricker wavelet stays below the tolerance for good, as u.
    oscillations, phase, peak
        gamma and nu of a Mavroeidis-Papageorgiou pulse, and its largest acceleration for V = w = 1.
    """

    form: int
    pieces: Floats2
    amplitude: float
    frequency_ratio: float
    tolerance: float
    reach: float
    oscillations: float
    phase: float
    peak: float


@allocating
def fill_pulse(pulse: PulseNumbers, table: Floats2) -> tuple[int, float]:
    """Fill the segments of a pulse; return how many there are, and how many lines it needs.

    A table of no rows only counts them.  Columns that are 0 in every pulse are left as they are.
    """
    if pulse.form == MAVROEIDIS_PAPAGEORGIOU:
        return fill_mavroeidis_papageorgiou(pulse, table)
    if pulse.form != CLOSED:
        return fill_ricker(pulse, table)
    a, w = pulse.amplitude, pulse.frequency_ratio
    for row in range(min(len(pulse.pieces), len(table))):
        piece = pulse.pieces[row]
        duration = piece[TURN] / w
        table[row, columns.DURATION] = duration
        table[row, columns.CONSTANT] = piece[CONSTANT] * a
        table[row, columns.SLOPE] = piece[SLOPE] * a / duration
        table[row, columns.AMPLITUDE] = piece[SIZE] * a
        table[row, columns.FREQUENCY] = piece[TURNS] * w
        table[row, columns.PHASE] = piece[PHASE]
    return len(pulse.pieces), 0.0


@compiled
def fill_lines(samples: Floats1, step: float, table: Floats2) -> None:
    """Fill straight lines between evenly spaced samples, the still base after them, and bounds.

    The table has a row a sample, and its other columns are 0.
    """
    last = len(samples) - 1
    for row in range(last):
        put_line(table, row, step, samples[row], samples[row + 1])
    table[last, columns.DURATION] = math.inf
    fill_bounds(table)


@compiled
def fill_bounds(table: Floats2) -> None:
    """Fill an upper bound of |a| from each segment's start on, and how many alike follow at once.

    Before a jump to come the bound is infinite.
    """
    highest, alike, jumps = 0.0, 0.0, False
    for row in range(len(table) - 1, -1, -1):
        lasting, start = table[row, columns.DURATION], table[row, columns.CONSTANT]
        rise = 0.0 if lasting == math.inf else table[row, columns.SLOPE] * lasting
        here = max(abs(start), abs(start + rise)) + table[row, columns.AMPLITUDE]
        highest = max(highest, here)
        alike = alike + 1.0 if is_alike(table, row) else 0.0
        table[row, columns.CEILING] = math.inf if jumps else highest
        table[row, columns.ALIKE] = alike
        jumps = jumps or table[row, columns.JUMP] != 0.0


@compiled
def is_alike(table: Floats, row: int) -> bool:
    """Return whether the segment that follows is a sample like this one."""
    if row + 1 == len(table) or table[row, columns.DURATION] == math.inf:
        return False
    plain = table[row, columns.FREQUENCY] == 0.0 and table[row + 1, columns.FREQUENCY] == 0.0
    same = table[row, columns.DURATION] == table[row + 1, columns.DURATION]
    return bool(plain and same and table[row + 1, columns.JUMP] == 0.0)


@compiled
def put_line(table: Floats, row: int, step: float, here: float, there: float) -> None:
    """Put the line between two samples into a row."""
    table[row, columns.DURATION] = step
    table[row, columns.CONSTANT] = here
    table[row, columns.SLOPE] = (there - here) / step


@compiled
def sample_at(start: float, stop: float, count: int, k: int) -> float:
    """Return place k of as many even steps, the last one exact, as `numpy.linspace` has it."""
    return stop if k == count else k * ((stop - start) / count) + start


@compiled
def fill_ricker(pulse: PulseNumbers, table: Floats) -> tuple[int, float]:
    """Fill straight lines along a Ricker wavelet [1]_ whose Fourier spectrum is largest at w.

    With u the time from its middle over ``sqrt(2)/w``, or ``sqrt(3)/w`` of the antisymmetric one,
    it is ``a (1 - u^2) exp(-u^2/2)`` or ``a (u^3 - 3 u) exp(-u^2/2)/1.38``.  It begins and ends
    where it stays below the tolerance for good.  The second derivative in u is Hermite's polynomial
    of the fourth or fifth degree times the bell, and has its extrema at the zeros of the next one.
    So its bound is known between any two u, and the lines are longer where it is less.
    """
    odd = pulse.form == RICKER_ANTISYMMETRIC
    unit = math.sqrt(3.0 if odd else 2.0) / pulse.frequency_ratio
    cuts = ANTISYMMETRIC_CUTS if odd else CUTS
    parts = 1
    while parts <= len(cuts) and cuts[parts - 1] < pulse.reach:
        parts += 1
    rows, needed, start = 0, 0.0, 0.0
    for part in range(2 * parts):
        k = parts - 1 - part if part < parts else part - parts  # from its middle
        low = cuts[k - 1] if k > 0 else 0.0
        high = cuts[k] if k < parts - 1 else pulse.reach
        time = unit * (high - low)
        curvature = steepest(odd, low, high) / (unit * unit)
        least = time * math.sqrt(curvature / (8.0 * pulse.tolerance))
        count = max(1, int(np.ceil(least)))
        needed += least
        if rows + count <= len(table):
            here = ricker_at(odd, start / unit - pulse.reach)
            for line in range(count):
                at = sample_at(start, start + time, count, line + 1) / unit - pulse.reach
                there = ricker_at(odd, at)
                put_line(
                    table,
                    rows + line,
                    time / count,
                    pulse.amplitude * here,
                    pulse.amplitude * there,
                )
                here = there
        rows += count
        start += time
    return rows, needed


@compiled
def ricker_at(odd: bool, u: float) -> float:
    """Return a Ricker wavelet of amplitude 1."""
    bell = exp(-0.5 * u * u)
    return u * (u * u - 3.0) * bell / CREST if odd else (1.0 - u * u) * bell


@compiled
def steepest(odd: bool, low: float, high: float) -> float:
    """Return an upper bound of the second derivative of a Ricker wavelet between two u."""
    bends = ANTISYMMETRIC_BENDS if odd else BENDS
    largest = max(bend_at(odd, low), bend_at(odd, high))
    for bend in bends:
        if low <= bend <= high:
            largest = max(largest, bend_at(odd, bend))
    return BEYOND * largest


@compiled
def bend_at(odd: bool, u: float) -> float:
    """Return the absolute second derivative of a Ricker wavelet of amplitude 1."""
    square = u * u
    bell = exp(-0.5 * square)
    if odd:
        return abs(u * (square * (square - 10.0) + 15.0)) * bell / CREST
    return abs(square * (square - 6.0) + 3.0) * bell


@allocating
def fill_mavroeidis_papageorgiou(pulse: PulseNumbers, table: Floats) -> tuple[int, float]:
    """Fill straight lines along the pulse of [2]_, scaled to a largest acceleration.

    Its velocity is ``(V/2) (1 + cos(w s/gamma)) cos(w s + nu)`` over ``|s| <= gamma pi/w``, a sum
    of three sinusoids.
    """
    gamma, w = pulse.oscillations, pulse.frequency_ratio
    v = 1.0 / (w * pulse.peak)  # for an acceleration of 1
    start = -gamma * math.pi / w
    duration, curvature = -2.0 * start, 0.0
    waves = np.empty((3, 3))  # frequency, and shares of sine and cosine
    for k in range(3):
        share = 0.5 if k == 0 else 0.25
        turns = 1.0 if k == 0 else 1.0 + (1.0 if k == 1 else -1.0) / gamma
        # d/ds of cos(W s + nu) is -W sin(W s + nu): half a cycle on, towards a phase of 0.
        frequency, size = turns * w, v * share * turns * w
        phase = frequency * start + pulse.phase
        turn = -1.0 if phase > 0.0 else 1.0
        sine, cosine = sincos(less_whole_turns((phase + turn * math.pi) + turn * PI_LOW))
        waves[k, 0], waves[k, 1], waves[k, 2] = frequency, size * cosine, size * sine
        curvature += hypot(size * cosine, size * sine) * frequency * frequency
    needed = duration * math.sqrt(curvature / (8.0 * pulse.tolerance))
    count = max(1, int(np.ceil(needed)))
    here = sum_at(waves, 0.0)
    for line in range(min(count, len(table))):
        there = sum_at(waves, sample_at(0.0, duration, count, line + 1))
        put_line(table, line, duration / count, here, there)
        table[line, columns.CONSTANT] *= pulse.amplitude
        table[line, columns.SLOPE] *= pulse.amplitude
        here = there
    return count, needed


@compiled
def less_whole_turns(angle: float) -> float:
    """Return an angle within half a turn of 0, exactly, as `math.remainder` has it."""
    turns = (angle / FULL_TURN + ROUND) - ROUND
    rest = (angle - turns * TURN_HIGH) - turns * TURN_LOW
    if abs(rest) > math.pi:  # the quotient has been rounded to the other side of a half
        turns += 1.0 if rest > 0.0 else -1.0
        rest = (angle - turns * TURN_HIGH) - turns * TURN_LOW
    return rest


@compiled
def sum_at(waves: Floats, time: float) -> float:
    """Return the sum of sinusoids at a time."""
    total = 0.0
    for k in range(len(waves)):
        sine, cosine = sincos(waves[k, 0] * time)
        total += waves[k, 1] * sine + waves[k, 2] * cosine
    return total
