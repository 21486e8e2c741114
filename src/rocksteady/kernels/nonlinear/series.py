"""One step of a nonlinear flight: its Taylor polynomial, and the length of the step.

With ``S = sin(alpha (1 - y))/alpha`` and ``C = cos(alpha (1 - y))`` the equation of motion (see
`rocksteady.kernels.nonlinear.drive`) is a system of products only::

    y'' = -(1 + l) S + h C,    S' = -C y',    C' = alpha^2 S y',

so that each Taylor coefficient follows from those before it by sums of products, and nothing is
lost for small alpha.  The polynomial is the dense output as well: events are its zeros.

**Error.**  The terms fall off geometrically within the radius of convergence.  A step ends where
the last two terms are still below a given part (`LEFT_OUT` of the side table, 1e-15 by default) of
the largest of the first four, that is of the motion within the step: what is left out is about as
much as the last term.  That rule does not depend on the scale of the motion, so that a bounce of
1e-8 alpha is as exact as one of alpha.  Where the end of the span comes first, no more terms are
worked out than reach it: six or seven across a sample of a record.  The rule is that of A. Jorba
and M. Zou, Experimental Mathematics 14, 99-117 (2005).

A step is longer than one of DOP853.  Under a sinusoid the series takes 750 to 1200 products a
radian of the shaking.  Collocation on the linear closed form would take some 500, but gives no
polynomial of the step, on which all proofs rest.
"""

import math

import numpy as np

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.elementary.exponential import exp_clamped
from rocksteady.kernels.elementary.logarithm import LN2, LOG2_DOUBT, low_log2
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined
from rocksteady.kernels.nonlinear.drive import Drive, Instant

TERMS = 24
HIGHEST = TERMS - 1  # degree of the longest polynomial
ROW = 31  # mask of an index into a row

SHARED = np.array([1.0 / (n + 1) for n in range(TERMS)])
"""1/(n + 1)."""
TWICE_SHARED = np.array([0.0, 0.0] + [1.0 / (n * (n - 1)) for n in range(2, TERMS)])
"""1/(n (n - 1))."""
THRICE = np.array([float(n * (n - 1) * (n - 2)) for n in range(TERMS)])
"""n (n - 1) (n - 2)."""

HUGE = 1e200
"""Coefficients from which on no more are worked out: the next might overflow."""
BEYOND = 1.1
"""Length of a step to a zero that is only known roughly, over the time to it."""

# Rows of the working space, shape (6, TERMS).
ANGLE = 0  # coefficients of y: what the other modules read
SPEED = 1  # of y'
SINE = 2  # of S
COSINE = 3  # of C
SHAKING = 4  # of h
POINTS = 5  # control points of `rocksteady.kernels.nonlinear._bernstein`
WORK_ROWS = 6
SHARES = 6  # and from here on, a row for each order of a Fourier series, its two shares


@allocating
def make_work(shares: Floats | None) -> Floats:
    """Return working space for steps under shaking with these shares, or with none.

    It is made once a march or passage, since numba has no arrays on the stack.
    """
    if shares is None:
        return np.empty((WORK_ROWS, TERMS))
    work = np.empty((WORK_ROWS + len(shares) // 2, TERMS))
    load_shares(shares, work)
    return work


@compiled
def load_shares(shares: Floats, work: Floats) -> None:
    """Write the shares of a Fourier series into working space that has room for them."""
    for k in range(len(shares) // 2):
        work[SHARES + k, 0], work[SHARES + k, 1] = shares[2 * k], shares[2 * k + 1]


@inlined
def root_of_parabola(above: float, velocity: float, bend: float, falling: bool) -> float:
    """Return when ``above + velocity t + bend t^2/2`` first falls, or rises, through 0; or inf.

    A bounce is one but for its last digits.  A straight line that leaves 0 never comes back to it.
    """
    root = velocity * velocity - 2.0 * bend * above
    if root > 0.0:
        far = abs(velocity) + math.sqrt(root)
        # The root in the direction of the crossing, without cancellation.
        if falling == (velocity > 0.0):
            return far / abs(bend) if bend != 0.0 else math.inf
        if far > 0.0:
            return 2.0 * abs(above) / far
    return math.inf


@compiled
def expand_series(
    drive: Drive, at: Instant, reach: float, left_out: float, work: Floats
) -> tuple[int, float]:
    """Fill the coefficients of y from an instant on; return their degree and the step they take.

    Parameters
    ----------
    drive
        The side and its base motion.
    at
        The instant.
    reach
        The longest step of use.
    left_out
        Part of the motion that may be left out.
    work
        Working space, shape (6, 24).

    Returns
    -------
    tuple
        Degree of the polynomial and length of the step, `reach` at most.
    """
    time, angle, velocity, sine, cosine, lifting = at
    square = drive.alpha * drive.alpha
    tilt = drive.alpha * (1.0 - angle)
    weight = 1.0 + drive.lift + drive.lift_slope * time
    shaken = drive.amplitude != 0.0
    work[ANGLE, 0] = angle
    work[ANGLE, 1] = work[SPEED, 0] = velocity
    work[SINE, 0], work[COSINE, 0] = sincos_near(tilt)
    work[SINE, 0] /= drive.alpha
    swing, swing_speed = drive.amplitude * sine, drive.amplitude * drive.frequency * cosine
    if drive.series != 0.0:
        fill_shaking(drive, sine, cosine, work)
    else:
        work[SHAKING, 0] = drive.constant + drive.slope * time + swing
        work[SHAKING, 1] = drive.slope + swing_speed
    if (
        shaken and drive.series == 0.0
    ):  # the derivatives of the sinusoid over the factorials, two by two
        turn = -drive.frequency * drive.frequency
        for n in range(2, HIGHEST - 1, 2):
            swing *= turn * TWICE_SHARED[n]
            swing_speed *= turn * TWICE_SHARED[n + 1]
            work[SHAKING, n], work[SHAKING, n + 1] = swing, swing_speed
    power = reach  # reach^(n + 1)
    largest = max(abs(angle), abs(velocity) * reach)
    small = 0  # terms in a row that are negligible at the reach
    for n in range(HIGHEST - 1):
        if shaken:
            force, by_cosine, by_sine = sums_of_three(work, n)
        else:
            by_cosine, by_sine = sums_of_two(work, n)
            force = work[SHAKING, 0] * work[COSINE, n]
            if n > 0:
                force += work[SHAKING, 1] * work[COSINE, n - 1]
        force -= weight * work[SINE, n]
        if n > 0:
            force -= drive.lift_slope * work[SINE, n - 1]
        if n == 0 and lifting:
            force = max(force, 0.0)
        share = SHARED[n]
        work[SINE, n + 1] = -by_cosine * share
        work[COSINE, n + 1] = square * by_sine * share
        work[SPEED, n + 1] = force * share
        work[ANGLE, n + 2] = force * TWICE_SHARED[n + 2]
        if not abs(work[ANGLE, n + 2]) < HUGE:
            return n + 1, min(reach, _step(left_out, n + 1, work))
        power *= reach
        term = abs(work[ANGLE, n + 2]) * power
        if n < 2:
            largest = max(largest, term)
        elif term <= left_out * largest:
            small += 1
            if small == 2:
                return n + 2, reach
        else:
            small = 0
    return HIGHEST, min(reach, _step(left_out, HIGHEST, work))


@compiled
def fill_shaking(drive: Drive, sine: float, cosine: float, work: Floats) -> None:
    """Fill the coefficients of a Fourier series, each order's derivatives over the factorials.

    `sine` and `cosine` are those of the phase of its period.
    """
    for n in range(HIGHEST):
        work[SHAKING, n] = 0.0
    order_sine, order_cosine = sine, cosine
    size = drive.series * drive.amplitude
    for k in range(len(work) - WORK_ROWS):
        p, q = size * work[SHARES + k, 0], size * work[SHARES + k, 1]
        if p != 0.0 or q != 0.0:
            turn = (k + 1) * drive.frequency
            swing = p * order_sine + q * order_cosine
            swing_speed = turn * (p * order_cosine - q * order_sine)
            work[SHAKING, 0] += swing
            work[SHAKING, 1] += swing_speed
            turn *= -turn
            for n in range(2, HIGHEST - 1, 2):
                swing *= turn * TWICE_SHARED[n]
                swing_speed *= turn * TWICE_SHARED[n + 1]
                work[SHAKING, n] += swing
                work[SHAKING, n + 1] += swing_speed
        order_sine, order_cosine = (
            order_sine * cosine + order_cosine * sine,
            order_cosine * cosine - order_sine * sine,
        )


@compiled
def expand_linear(
    drive: Drive, at: Instant, reach: float, left_out: float, work: Floats
) -> tuple[int, float]:
    """Fill the coefficients of the linear y under a Fourier series: ``y'' = y - 1 + h``.

    Parameters and results are those of `expand_series`, which needs the time of a slope too; the
    rows of S and C stay as they are.
    """
    _, angle, velocity, sine, cosine, lifting = at
    fill_shaking(drive, sine, cosine, work)
    work[ANGLE, 0], work[ANGLE, 1] = angle, velocity
    power = reach
    largest = max(abs(angle), abs(velocity) * reach)
    small = 0
    for n in range(HIGHEST - 1):
        force = work[ANGLE, n] + work[SHAKING, n]
        if n == 0:
            force -= 1.0
            if lifting:
                force = max(force, 0.0)
        work[ANGLE, n + 2] = force * TWICE_SHARED[n + 2]
        if not abs(work[ANGLE, n + 2]) < HUGE:
            return n + 1, min(reach, _step(left_out, n + 1, work))
        power *= reach
        term = abs(work[ANGLE, n + 2]) * power
        if n < 2:
            largest = max(largest, term)
        elif term <= left_out * largest:
            small += 1
            if small == 2:
                return n + 2, reach
        else:
            small = 0
    return HIGHEST, min(reach, _step(left_out, HIGHEST, work))


@inlined
def sums_of_three(work: Floats, n: int) -> tuple[float, float, float]:
    """Return coefficient n of h C, y' C and y' S; even and odd terms by themselves, for speed."""
    force = work[SHAKING, 0] * work[COSINE, n]
    by_cosine = work[SPEED, 0] * work[COSINE, n]
    by_sine = work[SPEED, 0] * work[SINE, n]
    odd_force = odd_by_cosine = odd_by_sine = 0.0
    for j in range(1, n, 2):
        # Masks change nothing; they tell the compiler that no index is negative.
        odd, even = j & ROW, (j + 1) & ROW
        from_odd, from_even = (n - j) & ROW, (n - j - 1) & ROW
        odd_force += work[SHAKING, odd] * work[COSINE, from_odd]
        odd_by_cosine += work[SPEED, odd] * work[COSINE, from_odd]
        odd_by_sine += work[SPEED, odd] * work[SINE, from_odd]
        force += work[SHAKING, even] * work[COSINE, from_even]
        by_cosine += work[SPEED, even] * work[COSINE, from_even]
        by_sine += work[SPEED, even] * work[SINE, from_even]
    if n % 2 == 1:
        odd_force += work[SHAKING, n] * work[COSINE, 0]
        odd_by_cosine += work[SPEED, n] * work[COSINE, 0]
        odd_by_sine += work[SPEED, n] * work[SINE, 0]
    return force + odd_force, by_cosine + odd_by_cosine, by_sine + odd_by_sine


@inlined
def sums_of_two(work: Floats, n: int) -> tuple[float, float]:
    """Return coefficient n of y' C and y' S; even and odd terms by themselves, for speed."""
    by_cosine = work[SPEED, 0] * work[COSINE, n]
    by_sine = work[SPEED, 0] * work[SINE, n]
    odd_by_cosine = odd_by_sine = 0.0
    for j in range(1, n, 2):
        odd, even = j & ROW, (j + 1) & ROW
        from_odd, from_even = (n - j) & ROW, (n - j - 1) & ROW
        odd_by_cosine += work[SPEED, odd] * work[COSINE, from_odd]
        odd_by_sine += work[SPEED, odd] * work[SINE, from_odd]
        by_cosine += work[SPEED, even] * work[COSINE, from_even]
        by_sine += work[SPEED, even] * work[SINE, from_even]
    if n % 2 == 1:
        odd_by_cosine += work[SPEED, n] * work[COSINE, 0]
        odd_by_sine += work[SPEED, n] * work[SINE, 0]
    return by_cosine + odd_by_cosine, by_sine + odd_by_sine


@compiled
def _step(left_out: float, degree: int, work: Floats) -> float:
    """Return the step at which the last two terms are just negligible; e^700 without motion."""
    # In logarithms: of the smallest that each of the first four terms lets the last ones be.
    part = low_log2(left_out)
    angle = low_log2(abs(work[ANGLE, 0])) + part
    velocity = low_log2(abs(work[ANGLE, 1])) + part
    bend = low_log2(abs(work[ANGLE, 2])) + part
    third = low_log2(abs(work[ANGLE, 3])) + part
    step = math.inf
    for n in range(degree - 1, degree + 1):
        if work[ANGLE, n] != 0.0:
            last = low_log2(abs(work[ANGLE, n])) + LOG2_DOUBT
            holds = max(
                (angle - last) / n,
                (velocity - last) / (n - 1),
                (bend - last) / (n - 2),
                (third - last) / (n - 3),
            )
            step = min(step, holds)
    return exp_clamped(LN2 * step)


@inlined
def angle_at(work: Floats, degree: int, time: float) -> tuple[float, float]:
    """Return y and y' of the polynomial."""
    angle, velocity = work[ANGLE, degree], 0.0
    for n in range(degree - 1, -1, -1):
        velocity = velocity * time + angle
        angle = angle * time + work[ANGLE, n]
    return angle, velocity


@inlined
def speed_at(work: Floats, degree: int, time: float) -> tuple[float, float]:
    """Return y' and y'' of the polynomial."""
    velocity, bend = degree * work[ANGLE, degree], 0.0
    for n in range(degree - 1, 0, -1):
        bend = bend * time + velocity
        velocity = velocity * time + n * work[ANGLE, n]
    return velocity, bend


@inlined
def bend_at(work: Floats, degree: int, time: float) -> tuple[float, float]:
    """Return y'' and the third derivative of the polynomial."""
    bend, third = degree * (degree - 1) * work[ANGLE, degree], 0.0
    for n in range(degree - 1, 1, -1):
        third = third * time + bend
        bend = bend * time + n * (n - 1) * work[ANGLE, n]
    return bend, third


@inlined
def third_bound(work: Floats, degree: int, step: float) -> float:
    """Return an upper bound of |y'''| of the polynomial over the step."""
    bound, power = 0.0, 1.0
    for n in range(3, degree + 1):
        bound += THRICE[n & ROW] * power * abs(work[ANGLE, n & ROW])
        power *= step
    return bound


@compiled
def angle_bound(work: Floats, degree: int, step: float) -> float:
    """Return an upper bound of |y| of the polynomial over the step."""
    bound = 0.0
    for n in range(degree, -1, -1):
        bound = bound * step + abs(work[ANGLE, n])
    return bound
