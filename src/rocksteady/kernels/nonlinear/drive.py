"""Nonlinear equation of motion on one side, and the base motion that drives it.

With ``y = |theta|/alpha`` in the side's own units and side time t (eqs 1, 2 of Tso and Wong, with
vertical motion added)::

    y'' = -(1 + l) sin(alpha (1 - y))/alpha + h cos(alpha (1 - y)),

where l is the vertical acceleration of the base over g and h the horizontal one over alpha g, seen
from the side.  In the linear model, whose alpha is 0 here, it is ``y'' = y - 1 + h``.  The same,
written around the base::

    y'' = r cos(alpha y) + k sin(alpha y)/alpha,
    r = h cos(alpha) - (1 + l) sin(alpha)/alpha,    k = (1 + l) cos(alpha) + alpha h sin(alpha).

At y = 0 only r is left: it decides on uplift, and takes the place that the forcing has in the
linear model, ``y'' = r + y``, which is the limit of small alpha.
"""

import math
from typing import NamedTuple

from rocksteady.kernels.core import tables
from rocksteady.kernels.core.forcing import Forcing, make_forcing
from rocksteady.kernels.core.harmonics import shape_at
from rocksteady.kernels.core.tables import Floats, is_series, slenderness
from rocksteady.kernels.elementary.circular import cos, sin, sincos_near
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2

WEIGHTLESS = 1e-14
"""Weight over M g that counts as none: a sample of -g in the units of a block is -g to rounding."""


class Drive(NamedTuple):
    """Base motion of one segment seen from one side, time counted from a flight's start."""

    alpha: float
    constant: float  # h = constant + slope t + amplitude sin(phase + frequency t)
    slope: float
    amplitude: float
    frequency: float
    lift: float  # l = lift + lift_slope t
    lift_slope: float
    # Of a Fourier series the side, +1 or -1: its phase is that of the base, and the amplitude times
    # its shape, as the side sees it, takes the sinusoid's place.  0 of a sinusoid.
    series: float = 0.0


class Instant(NamedTuple):
    """State of a flight at the start of a step."""

    time: float  # side time since the start of the flight
    angle: float
    velocity: float
    sine: float  # of the sinusoid's phase
    cosine: float
    lifting: bool  # off from rest just now, so that it does not sink, whatever rounding says


class StepDrive(NamedTuple):
    """What drives a side at the start of a step without a sinusoid, linear in time."""

    alpha: float
    shaking: float  # h and h'
    shaking_slope: float
    weight: float  # 1 + l and l'
    weight_slope: float


class SteppedFlight(NamedTuple):
    """A flight in steps, in the units of its side."""

    drive: Drive
    phase: float  # of the shaking at the start, in [-pi/2, 3 pi/2)
    angle: float  # at the start, 0 or more
    velocity: float
    span: float  # side time to its end, or to that of the segment
    left_out: float  # part of the motion that a step may leave out


@compiled
def side_drive(segments: Floats, index: int, sides: Floats, side: int, elapsed: float) -> Drive:
    """Return what drives a side on a segment, from the time `elapsed` since the segment's start."""
    row = 0 if side > 0 else 1
    lean, rate = sides[row, tables.LEAN], sides[row, tables.RATE]
    slope, lift_slope = segments[index, tables.SLOPE], segments[index, tables.LIFT_SLOPE]
    return Drive(
        slenderness(sides, row),
        side * (segments[index, tables.CONSTANT] + slope * elapsed) / lean,
        side * slope / (lean * rate),
        segments[index, tables.AMPLITUDE] / lean,
        segments[index, tables.FREQUENCY] / rate,
        segments[index, tables.LIFT] + lift_slope * elapsed,
        lift_slope / rate,
        float(side) if is_series(segments, index) else 0.0,
    )


@compiled
def foot_forcing(drive: Drive) -> Forcing:
    """Return r, the acceleration of a block that stands on its base."""
    sine, cosine = 1.0, 1.0
    if drive.alpha > 0.0:
        sine, cosine = sincos_near(drive.alpha)
        sine /= drive.alpha
    return make_forcing(
        drive.constant * cosine - (1.0 + drive.lift) * sine,
        drive.slope * cosine - drive.lift_slope * sine,
        drive.amplitude * cosine,
        drive.frequency,
    )


@compiled
def acceleration(drive: Drive, time: float, angle: float, sine: float) -> float:
    """Return y'' at `time`, where the sinusoid has this sine, or the series this value."""
    if drive.alpha == 0.0:
        return angle - 1.0 + drive.constant + drive.slope * time + drive.amplitude * sine
    tilt = drive.alpha * (1.0 - angle)
    h = drive.constant + drive.slope * time + drive.amplitude * sine
    weight = 1.0 + drive.lift + drive.lift_slope * time
    sine_of_tilt, cosine_of_tilt = sincos_near(tilt)
    return h * cosine_of_tilt - weight * sine_of_tilt / drive.alpha


@compiled
def swing_at(drive: Drive, shares: Floats | None, phase: float) -> float:
    """Return the sine of a phase, or the value of the series as the side sees it."""
    if shares is None:
        return sin(phase)
    if drive.series == 0.0:
        return sin(phase)
    sine, cosine = sincos_near(phase)
    return drive.series * shape_at(shares, sine, cosine)[0]


@inlined
def hardest_pull(drive: Drive, time: float, step: float) -> float:
    """Return an upper bound of -y'' over a step from `time` on, as long as y >= 0.

    There ``sin(alpha (1 - y))/alpha <= 1``.
    """
    end = time + step
    h = max(abs(drive.constant + drive.slope * time), abs(drive.constant + drive.slope * end))
    weight = 1.0 + max(drive.lift + drive.lift_slope * time, drive.lift + drive.lift_slope * end)
    return (h + drive.amplitude + weight) * (1.0 + 1e-9)


@compiled
def loss_of_contact(segments: Floats, index: int) -> float:
    """Return the time since a segment's start at which the base falls away: 1 + l is 0; or inf."""
    weight: float = 1.0 + segments[index, tables.LIFT]
    slope: float = segments[index, tables.LIFT_SLOPE]
    if weight <= WEIGHTLESS:
        return 0.0
    if slope >= 0.0 or weight + slope * segments[index, tables.DURATION] > WEIGHTLESS:
        return math.inf
    duration: float = segments[index, tables.DURATION]
    return min(-weight / slope, duration)


@compiled
def jump_share(sides: Floats2, side: int, angle: float) -> float:
    """Return the part of a horizontal impulse that turns the block: cos(alpha (1 - y))."""
    return cos(sides[0 if side > 0 else 1, tables.ALPHA] * (1.0 - angle))
