"""Signs of all lanes' steps: no impact, one, or a step that is too long to tell."""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import LANES, TOP

ROUNDING = 1e-14
"""As in `rocksteady.kernels.nonlinear._bernstein`, of as many terms."""
MANY = 4.0
"""What a doubtful sign counts for."""
LEAST = 1e-300
LARGEST = 1e300
STEPS = 3
"""Newton's, of which the third is as good as the terms are."""
CLOSEST = 1e-3
"""Part of the guess below which no step may lead."""


Found = tuple[float, float, float, float, float]
"""Changes of sign, number of the last, the points before and after it, and the last point."""


@compiled
def count_changes(lanes: Floats) -> None:
    """Count changes of sign of the control points, and guess where the first zero is.

    With ``p_i = c_i T^i/C(N, i)`` the points are ``b_j = sum C(j, i) p_i``: sums along the
    triangle.  A flight from the floor has b_0 = 0, and the others have the signs of those of y/t.
    Lifting off, b_1 = 0 and b_2 is not negative, whatever rounding says.
    """
    for k in range(LANES):
        p0, p1 = lanes[lane.POINTS + k], lanes[lane.POINTS + LANES + k]
        p2, p3 = lanes[lane.POINTS + 2 * LANES + k], lanes[lane.POINTS + 3 * LANES + k]
        p4, p5 = lanes[lane.POINTS + 4 * LANES + k], lanes[lane.POINTS + 5 * LANES + k]
        p6, p7 = lanes[lane.POINTS + 6 * LANES + k], lanes[lane.POINTS + 7 * LANES + k]
        p8, p9 = lanes[lane.POINTS + 8 * LANES + k], lanes[lane.POINTS + 9 * LANES + k]
        p10 = lanes[lane.POINTS + 10 * LANES + k]
        lifting = (lanes[lane.ANGLE + k] == 0.0) & (lanes[lane.SPEED + k] == 0.0)
        off = ROUNDING * (lanes[lane.TOTAL + k] + lanes[lane.REST + k])
        start = -1.0 if lifting else off
        floor = LEAST if lifting else -LARGEST
        found = (0.0, 0.0, 1.0, 0.0, max(lanes[lane.ANGLE + k], LEAST))
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4, p5, p6, p7 = p4 + p5, p5 + p6, p6 + p7, p7 + p8
        p8, p9 = p8 + p9, p9 + p10
        found = noted(max(p0, floor), 1.0, start, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4, p5, p6, p7 = p4 + p5, p5 + p6, p6 + p7, p7 + p8
        p8 += p9
        found = noted(max(p0, floor), 2.0, start, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4, p5, p6, p7 = p4 + p5, p5 + p6, p6 + p7, p7 + p8
        found = noted(p0, 3.0, off, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4, p5, p6 = p4 + p5, p5 + p6, p6 + p7
        found = noted(p0, 4.0, off, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4, p5 = p4 + p5, p5 + p6
        found = noted(p0, 5.0, off, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        p4 += p5
        found = noted(p0, 6.0, off, found)
        p0, p1, p2, p3 = p0 + p1, p1 + p2, p2 + p3, p3 + p4
        found = noted(p0, 7.0, off, found)
        p0, p1, p2 = p0 + p1, p1 + p2, p2 + p3
        found = noted(p0, 8.0, off, found)
        p0, p1 = p0 + p1, p1 + p2
        found = noted(p0, 9.0, off, found)
        p0 += p1
        found = noted(p0, 10.0, off + lanes[lane.REST + k], found)
        changes, change, above, below, _ = found
        lanes[lane.CHANGES + k] = changes
        guess = (change - 1.0 + above / (above - below)) * (1.0 / TOP)
        lanes[lane.PLACE + k] = guess if changes == 1.0 else 1.0


@inlined
def noted(point: float, number: float, off: float, found: Found) -> Found:
    """Compare the sign of a point with that of the one before."""
    changes, change, above, below, before = found
    changed = (point > 0.0) != (before > 0.0)
    more = 1.0 if changed else 0.0
    return (
        changes + (more if abs(point) > off else MANY),
        number if changed else change,
        before if changed else above,
        point if changed else below,
        point,
    )


@compiled
def approach(lanes: Floats) -> None:
    """Take Newton's steps towards the zero, from the terms up to the TOP."""
    for k in range(LANES):
        a0, a1 = lanes[lane.TAYLOR + k], lanes[lane.TAYLOR + LANES + k]
        a2, a3 = lanes[lane.TAYLOR + 2 * LANES + k], lanes[lane.TAYLOR + 3 * LANES + k]
        a4, a5 = lanes[lane.TAYLOR + 4 * LANES + k], lanes[lane.TAYLOR + 5 * LANES + k]
        a6, a7 = lanes[lane.TAYLOR + 6 * LANES + k], lanes[lane.TAYLOR + 7 * LANES + k]
        a8, a9 = lanes[lane.TAYLOR + 8 * LANES + k], lanes[lane.TAYLOR + 9 * LANES + k]
        a10 = lanes[lane.TAYLOR + 10 * LANES + k]
        single = lanes[lane.CHANGES + k] == 1.0
        guess = lanes[lane.PLACE + k]
        place = guess
        for _ in range(STEPS):
            value, slope = a10 * place + a9, a10
            slope = slope * place + value
            value = value * place + a8
            slope = slope * place + value
            value = value * place + a7
            slope = slope * place + value
            value = value * place + a6
            slope = slope * place + value
            value = value * place + a5
            slope = slope * place + value
            value = value * place + a4
            slope = slope * place + value
            value = value * place + a3
            slope = slope * place + value
            value = value * place + a2
            slope = slope * place + value
            value = value * place + a1
            slope = slope * place + value
            value = value * place + a0
            near = place - value / slope if slope != 0.0 else 2.0  # flat: out of range
            place = near if (near > CLOSEST * guess) & (near < 1.0) else 0.5 * (place + guess)
        lanes[lane.PLACE + k] = place if single else guess
