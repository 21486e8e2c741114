"""Short steps of a nonlinear flight without a sinusoid, as between two samples of a record.

With ``S = sin(alpha (1 - y))/alpha``, ``C = cos(alpha (1 - y))``, and h and l linear in time, the
acceleration F and its derivatives by angle and by time are::

    F = h C - (1 + l) S,    E = dF/dy = (1 + l) C + alpha^2 h S,
    f = h' C - l' S,        e = df/dy = l' C + alpha^2 h' S,

with ``dE/dy = -alpha^2 F`` and ``de/dy = -alpha^2 f``.  Along the motion, by the chain rule::

    y^(2) = F,    y^(3) = f + E v,    y^(4) = v (E' + e) + E F,    E' = e - alpha^2 F v,
    y^(5) = 3 e F - alpha^2 v (v (2 f + y^(3)) + 3 F^2) + E y^(3),
    y^(6) = 4 e (y^(3) - c) - alpha^2 F (v (6 f + 10 y^(3) - c) + 3 F^2) + E y^(4),

with ``c = alpha^2 v^3``.  In the linear model ``y^(n + 2) = E y^(n)`` from n = 2 on, with E = 1:
its closed form.  What stands beside that here is of the order of alpha^2.  The next two derivatives
are taken from it, so that the step's polynomial has degree 8.

**Error.**  What is left out is mainly ``(y^(7) - E y^(5)) t^7/5040``, whose bracket is ``5 E' y^(4)
+ 6 E'' y^(3) + 4 E''' F + E'''' v`` but for smaller terms, and of the closed form ``E^2 y^(5)
t^9/362880``.  At the start any of these may be zero, as at a turning point or where the block lifts
off.  So the sum of their moduli is the estimate, each modulus with a fifth of what the next one
adds over the step.  The error is hardly ever more: of a million random steps about ten had more
than twice as much, none more than four times.
"""

from typing import NamedTuple

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near, small_sinc_cos
from rocksteady.kernels.machine_code.compilation import inlined
from rocksteady.kernels.nonlinear.drive import Instant

DEGREE = 8
ANGLE = 0
"""Row of the working space that holds the coefficients of y."""
LONGEST = 0.25
"""Longest step: beyond it the terms left out of the estimate would count."""
ONWARD = 0.2
"""Part of a step over which the moduli of the estimate grow: t^n n!/(8 ... (n + 7)) is less."""
SMALL = 0.785
"""Largest angle of `small_sinc_cos`, a little below pi/4."""


class StepDrive(NamedTuple):
    """What drives a side at the start of a step; all but alpha is linear in time."""

    alpha: float
    shaking: float  # h and h'
    shaking_slope: float
    weight: float  # 1 + l and l'
    weight_slope: float


class ShortStep(NamedTuple):
    """Taylor coefficients of y from the second on, and whether they are enough."""

    second: float
    third: float
    fourth: float
    fifth: float
    sixth: float
    seventh: float
    eighth: float
    exact: bool  # the error at the end of the step is as small as it has to be


@inlined
def short_step(drive: StepDrive, at: Instant, step: float, left_out: float) -> ShortStep:
    """Return the Taylor coefficients of a short step.

    Parameters
    ----------
    drive, at
        What drives the side at the start of the step, and its state there.
    step
        Length of the step.
    left_out
        Part of the motion that a step may leave out.
    """
    alpha, shaking, shaking_slope, weight, weight_slope = drive
    _, angle, v, _, _, lifting = at
    square = alpha * alpha
    tilt = alpha * (1.0 - angle)
    if abs(tilt) < SMALL:
        sinc, cosine = small_sinc_cos(tilt)
        sine = sinc * (1.0 - angle)
    else:
        sine, cosine = sincos_near(tilt)
        sine /= alpha
    force = shaking * cosine - weight * sine
    if lifting:
        force = max(force, 0.0)
    stiffness = weight * cosine + square * (shaking * sine)
    change = shaking_slope * cosine - weight_slope * sine
    drift = weight_slope * cosine + square * (shaking_slope * sine)
    third = change + stiffness * v
    stiffening = drift - square * (force * v)
    fourth = v * (stiffening + drift) + stiffness * force
    forces = force * force
    fifth = (
        3.0 * (drift * force)
        - square * (v * (v * (2.0 * change + third) + 3.0 * forces))
        + stiffness * third
    )
    cube = square * (v * v * v)
    sixth = (
        4.0 * (drift * (third - cube))
        - square * (force * (v * (6.0 * change + 10.0 * third - cube) + 3.0 * forces))
        + stiffness * fourth
    )
    turning = square * (v * (change + third) + forces)  # -E''
    twisting = square * (v * (drift * v + fourth) + force * (change + 3.0 * third))  # -E'''
    squared = step * step
    tail = stiffness * fifth
    # Moduli on the way, as at the start itself any of them may be zero.
    onward = ONWARD * step
    eighth = abs(stiffness * sixth)
    fourths = abs(fourth) + onward * abs(fifth)
    thirds = abs(third) + onward * fourths
    pulls = abs(force) + onward * thirds
    speeds = abs(v) + onward * pulls
    turns = square * (speeds * (abs(change) + thirds) + pulls * pulls)
    stiffens = abs(stiffening) + onward * turns
    twists = square * (
        speeds * (abs(drift) * speeds + fourths) + pulls * (abs(change) + 3.0 * thirds)
    )
    fifths = abs(fifth) + onward * abs(sixth)
    swings = square * (speeds * fifths + 4.0 * (fourths * pulls) + 3.0 * (thirds * thirds))
    beyond = (
        5.0 * stiffens * fourths
        + 6.0 * turns * thirds
        + 4.0 * twists * pulls
        + speeds * swings
        + squared * (abs(stiffness) * (abs(tail) + onward * eighth) * (1.0 / 72.0))
    )
    largest = max(
        abs(angle),
        abs(v) * step,
        squared * (0.5 * abs(force)),
        squared * step * (abs(third) * (1.0 / 6.0)),
    )
    allowed = left_out * largest
    sixth_power = squared * squared * squared
    exact = beyond * (sixth_power * step) * (1.0 / 5040.0) <= allowed
    seventh = tail
    if not exact:  # the next derivative as well
        turn = drift * force - square * (change * (v * v))  # f''
        pull = square * (drift * (v * v) + change * force)  # -e''
        sway = square * (v * turn + 2.0 * (drift * (v * force)) + change * third)  # -e'''
        swing = square * (v * fifth + 4.0 * (fourth * force) + 3.0 * (third * third))
        seventh += (
            4.0 * (stiffening * fourth)
            + drift * fourth
            - 6.0 * (turning * third)
            - 4.0 * (twisting * force)
            - v * (2.0 * sway + swing)
            - 3.0 * (pull * force)
            - 3.0 * (square * (change * (v * third)))
        )
        beyond = (
            6.0 * stiffens * fifths
            + 10.0 * turns * fourths
            + 10.0 * twists * thirds
            + 5.0 * (abs(sway) + swings) * pulls
            + step * (abs(stiffness) * (abs(seventh) + onward * eighth) * (1.0 / 9.0))
        )
        exact = beyond * (sixth_power * squared) * (1.0 / 40320.0) <= allowed
    return ShortStep(
        0.5 * force,
        third * (1.0 / 6.0),
        fourth * (1.0 / 24.0),
        fifth * (1.0 / 120.0),
        sixth * (1.0 / 720.0),
        seventh * (1.0 / 5040.0),
        stiffness * sixth * (1.0 / 40320.0),
        step <= LONGEST and exact,
    )


@inlined
def fill_short(short: ShortStep, angle: float, velocity: float, work: Floats) -> None:
    """Fill the coefficients of y."""
    work[ANGLE, 0], work[ANGLE, 1] = angle, velocity
    work[ANGLE, 2], work[ANGLE, 3], work[ANGLE, 4] = short.second, short.third, short.fourth
    work[ANGLE, 5], work[ANGLE, 6] = short.fifth, short.sixth
    work[ANGLE, 7], work[ANGLE, 8] = short.seventh, short.eighth
