"""Length of a vector, and the next number."""

import math

from rocksteady.kernels.elementary.bits import bits_of, float_of, lost_in_product
from rocksteady.kernels.machine_code.compilation import compiled, inlined

LARGE, SHRINK = 2.0**400, 2.0**-600
SMALL, GROW = 2.0**-400, 2.0**600
FLAT = 2.0**-54


@compiled
def hypot(x: float, y: float) -> float:
    """Return sqrt(x^2 + y^2), also where the squares leave the range of floats."""
    more, less = abs(float(x)), abs(float(y))
    if less > more:
        more, less = less, more
    if math.isinf(more) or math.isinf(less):  # even beside NaN
        return math.inf
    if math.isnan(more) or math.isnan(less):
        return math.nan
    if less <= FLAT * more:
        return more + less
    scale = 1.0
    if more > LARGE:
        scale, more, less = GROW, more * SHRINK, less * SHRINK
    elif less < SMALL:
        scale, more, less = SHRINK, more * GROW, less * GROW
    square, other = more * more, less * less
    total = square + other
    lost = (square - total) + other
    lost += lost_in_product(more, more, square) + lost_in_product(less, less, other)
    root = math.sqrt(total)
    product = root * root
    lost += (total - product) - lost_in_product(root, root, product)
    return scale * (root + lost / (root + root))


@inlined
def next_up(x: float) -> float:
    """Return the least number above x; infinity and NaN stay."""
    x = float(x)
    if x == 0.0:
        return 5e-324
    if not x < math.inf:
        return x
    return float_of(bits_of(x) + (1 if x > 0.0 else -1))
