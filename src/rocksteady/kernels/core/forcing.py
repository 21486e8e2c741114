"""Forcing of a flight: base acceleration of one segment, seen from the block's side.

On one segment the base accelerates by ``c0 + c1 s + A sin(Omega s + phi)``.  Seen from one side,
and with gravity's pull back to rest subtracted, that is the forcing of ``y'' = y + r``::

    r(t) = constant + slope t + amplitude sin(psi),      psi = phase + frequency t,

with ``t`` counted from the start of the flight.  The first zero of a flight is found between
*nodes*, the times at which ``r`` changes sign; this module knows where they are.
"""

import math
from typing import NamedTuple

import numpy as np

from rocksteady.kernels.core import tables
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sin, sincos_near
from rocksteady.kernels.elementary.inverse import acos, atan2
from rocksteady.kernels.machine_code.compilation import compiled, inlined

HALF_PI = 0.5 * math.pi
TWO_PI = 2.0 * math.pi
EPSILON = 2.0**-52

GRAZING_SPEED = 1e-9
"""Landing speed up to which an impact grazes, in units of the speeds that the shaking gives."""

# How the sign of r is found.
ONE_SIGN = 0  # r never changes sign
SINE = 1  # closed form: sin(psi) = -constant / amplitude
LINE = 2  # closed form: t = -constant / slope
MIXED = 3  # between the closed-form stationary points of r


class Forcing(NamedTuple):
    """What a flight needs to know of one segment, from one side, in that side's own units."""

    kind: int
    constant: float
    slope: float
    amplitude: float
    frequency: float
    beta: float  # amplitude / (1 + frequency^2), of the particular solution
    swing: float  # amplitude / sqrt(1 + frequency^2), largest |beta (sin + frequency cos)|
    rising: float  # SINE: phase in [-pi/2, pi/2] at which r turns positive
    node_sine: float
    node_cosine: float


@inlined
def grazes(landing: float, amplitude: float, frequency: float) -> bool:
    """Return whether an impact is so slow that no derivative exists there.

    A derivative through a landing with speed v holds for differences of the angle up to some v^2,
    beyond which the impact is missed or another one added.  From 1.5e-8 down that is less than the
    rounding of the angle itself; 1e-9 leaves room for the speeds of slow shaking.  Fast shaking
    moves the block little: a speed counts against what a period's work can give.
    """
    return landing <= GRAZING_SPEED * min(1.0, (1.0 + amplitude) / max(1.0, frequency))


@compiled
def make_forcing(constant: float, slope: float, amplitude: float, frequency: float) -> Forcing:
    """Classify a forcing and work out its constants once; `amplitude` and `frequency` >= 0."""
    rising, node_sine, node_cosine = HALF_PI, 1.0, 0.0
    if amplitude == 0.0:
        kind = ONE_SIGN if slope == 0.0 else LINE
    elif slope != 0.0:
        kind = MIXED
    elif abs(constant) >= amplitude:
        kind = ONE_SIGN
    else:
        kind = SINE
        node_sine = -constant / amplitude
        # (1 - s)(1 + s) with 1 -+ s = (amplitude +- constant)/amplitude keeps the cosine exact
        # where the crest barely clears the threshold.
        node_cosine = math.sqrt((amplitude + constant) * (amplitude - constant)) / amplitude
        rising = atan2(node_sine, node_cosine)
    return Forcing(
        kind,
        constant,
        slope,
        amplitude,
        frequency,
        amplitude / (1.0 + frequency * frequency),
        amplitude / math.sqrt(1.0 + frequency * frequency),
        rising,
        node_sine,
        node_cosine,
    )


@compiled
def side_forcing(segments: Floats, index: int, sides: Floats, side: int, elapsed: float) -> Forcing:
    """Return the forcing of a segment seen from one side, its slope counted from `elapsed`."""
    row = 0 if side > 0 else 1
    lean, rate = sides[row, tables.LEAN], sides[row, tables.RATE]
    constant = segments[index, tables.CONSTANT] + segments[index, tables.SLOPE] * elapsed
    return make_forcing(
        side * constant / lean - 1.0,
        side * segments[index, tables.SLOPE] / (lean * rate),
        segments[index, tables.AMPLITUDE] / lean,
        segments[index, tables.FREQUENCY] / rate,
    )


@inlined
def forcing_at(forcing: Forcing, time: float, sine: float) -> float:
    """Return r."""
    return forcing.constant + forcing.slope * time + forcing.amplitude * sine


@inlined
def starts_positive(forcing: Forcing, phase: float) -> bool:
    """Return whether r is positive just after the start, at `phase` in [-pi/2, 3 pi/2)."""
    if forcing.kind == SINE:
        return forcing.rising <= phase < math.pi - forcing.rising
    if forcing.kind == MIXED:
        sine, cosine = sincos_near(phase)
        r = forcing.constant + forcing.amplitude * sine
        if abs(r) <= 4.0 * EPSILON * (abs(forcing.constant) + forcing.amplitude):
            # Zero but for rounding: where it is going decides.
            r = forcing.slope + forcing.amplitude * forcing.frequency * cosine
        return r > 0.0
    if abs(forcing.constant) <= 4.0 * EPSILON and forcing.slope != 0.0:
        # The constant is a base acceleration less 1, so that this too is zero but for rounding.
        return forcing.slope > 0.0
    return forcing.constant > 0.0


@compiled
def next_turn(forcing: Forcing, phase: float, time: float) -> float:
    """Return the first time after `time` at which a MIXED r is stationary, or infinity."""
    speed = forcing.amplitude * forcing.frequency
    if abs(forcing.slope) >= speed:
        return math.inf
    turn = acos(-forcing.slope / speed)
    now = phase + forcing.frequency * time
    up = turn + TWO_PI * float(np.ceil((now - turn) / TWO_PI))
    down = -turn + TWO_PI * float(np.ceil((now + turn) / TWO_PI))
    nearest = (min(up, down) - phase) / forcing.frequency
    if nearest <= time:  # the turn on which we stand
        nearest = (min(max(up, down), min(up, down) + TWO_PI) - phase) / forcing.frequency
    return nearest


@compiled
def mixed_node(forcing: Forcing, phase: float, time: float, positive: bool, span: float) -> float:
    """Return the first time in (time, span) at which a MIXED r leaves its sign, or `span`.

    Between neighbouring stationary points r is monotone, so that its signs at the two ends tell
    whether it changes sign in between, and bisection finds where.
    """
    sign = 1.0 if positive else -1.0
    low = time
    while low < span:
        high = min(next_turn(forcing, phase, low), span)
        sine = sin(phase + forcing.frequency * high)
        if sign * forcing_at(forcing, high, sine) < 0.0:
            for _ in range(200):
                middle = 0.5 * (low + high)
                if middle <= low or middle >= high:
                    break
                sine = sin(phase + forcing.frequency * middle)
                if sign * forcing_at(forcing, middle, sine) < 0.0:
                    high = middle
                else:
                    low = middle
            return high
        low = high
    return span


@compiled
def largest_forcing(forcing: Forcing, phase: float, span: float) -> float:
    """Return an upper bound of r over [0, span]; it is the maximum where the slope is zero."""
    if forcing.amplitude == 0.0:
        crest = 0.0
    else:
        # phase lies in [-pi/2, 3 pi/2): the first crest ahead is at pi/2 or at 5 pi/2.
        to_crest = HALF_PI - phase if phase <= HALF_PI else HALF_PI + TWO_PI - phase
        turned = forcing.frequency * span
        if turned >= to_crest:
            crest = forcing.amplitude
        else:
            crest = forcing.amplitude * max(sin(phase), sin(phase + turned))
    return forcing.constant + max(0.0, forcing.slope * span) + crest


@compiled
def steepest_forcing(forcing: Forcing) -> float:
    """Return an upper bound of |dr/dt|."""
    return abs(forcing.slope) + forcing.amplitude * forcing.frequency
