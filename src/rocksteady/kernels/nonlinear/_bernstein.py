"""Bernstein form of a step's polynomial, whose coefficients bound its sign.

Over a step of length T a polynomial of degree N or less is ``sum b_j B_j(t/T)``, j = 0 ... N, with
``B_j(x) = C(N, j) x^j (1 - x)^(N - j)``, which are not negative and add up to 1.  So it stays
between the least and the largest of the *control points* b_j, and its zeros in (0, T) are as many
as the changes of sign in their row, or fewer by an even number.  No change: no zero.  One: one, in
which it crosses.  With ``a_i = c_i T^i`` from the Taylor coefficients ::

    b_j = sum over i <= j of a_i C(j, i)/C(N, i),

whose weights lie between 0 and 1, so that rounding is a few times ``2^-52 sum |a_i|``.  The sign of
a control point that is smaller is not known, and then nothing is concluded.

Differences of neighbouring points are those of the derivative, over N/T.

References
----------
R. T. Farouki and V. T. Rajan, On the numerical condition of polynomials in Bernstein form, Computer
Aided Geometric Design 4, 191-216 (1987).
"""

import math

import numpy as np

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import whole
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.nonlinear.series import ANGLE, HIGHEST, POINTS, TERMS

WEIGHTS = np.array(
    [[math.comb(j, i) / math.comb(HIGHEST, i) for j in range(TERMS)] for i in range(TERMS)]
)
"""C(j, i)/C(N, i), shape (i, j); 0 for j < i."""

ROUNDING = 1e-14
"""More than 2^-52 times the 24 terms of a sum and the products in each, of which 3 matter."""

CONTROL_POINTS = whole(TERMS)
"""Of a polynomial."""

NO_CHANGE, RISES, FALLS, UNKNOWN = 0, 1, 2, 3


@compiled
def control_points(work: Floats, degree: int, step: float, dropped: int) -> float:
    """Fill the row `POINTS` for y over t^dropped, whose first coefficients have to be 0.

    Returns
    -------
    float
        How far rounding may have moved a point.
    """
    total, power = 0.0, 1.0
    for j in range(TERMS):
        work[POINTS, j] = 0.0
    for i in range(degree - dropped + 1):
        term = work[ANGLE, i + dropped] * power
        power *= step
        total += abs(term)
        for j in range(TERMS):  # a loop of fixed length is fastest; weights before i are 0
            work[POINTS, j] += WEIGHTS[i, j] * term
    return ROUNDING * total


@compiled
def differences(work: Floats, count: int) -> None:
    """Replace the first `count` control points by their `count - 1` differences."""
    for j in range(count - 1):
        work[POINTS, j] = work[POINTS, j + 1] - work[POINTS, j]


@compiled
def change_of_sign(work: Floats, count: int, doubt: float) -> tuple[int, float]:
    """Return how the sign of the first `count` control points changes, and where about.

    Returns
    -------
    tuple
        NO_CHANGE, RISES or FALLS (once, so that there is exactly one zero inside), or UNKNOWN; and
        the place at which the line through the points is zero, as a part of the step.
    """
    before = work[POINTS, 0]
    if not abs(before) > doubt:
        return UNKNOWN, 0.0
    kind, place = NO_CHANGE, 0.0
    for j in range(1, count):
        point = work[POINTS, j]
        if not abs(point) > doubt:
            return UNKNOWN, 0.0
        if (point > 0.0) != (before > 0.0):
            if kind != NO_CHANGE:
                return UNKNOWN, 0.0
            kind = RISES if point > 0.0 else FALLS
            place = (j - 1 + before / (before - point)) / (count - 1)
        before = point
    return kind, place


@compiled
def hull(work: Floats, count: int) -> tuple[float, float]:
    """Return the least and the largest of the first `count` control points."""
    least = most = work[POINTS, 0]
    for j in range(1, count):
        least, most = min(least, work[POINTS, j]), max(most, work[POINTS, j])
    return least, most
