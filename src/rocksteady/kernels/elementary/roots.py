"""The root of an equation in a bracket, the same bits everywhere.

SciPy's are compiled: whether a product and a sum are rounded once or twice is up to its wheel.
"""

import math
from collections.abc import Callable


def root(equation: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes its sign, to the last digits.

    Chandrupatla's method [1]_: a parabola through three values of the inverse function where that
    is safe, and else a bisection.

    Parameters
    ----------
    equation
        The function; its values at the ends have unlike signs, or one of them is 0.
    low, high
        Ends of the bracket.

    References
    ----------
    .. [1] T. R. Chandrupatla, Adv. Eng. Software 28, 145-149 (1997).

    Examples
    --------
    >>> root(lambda x: x * x - 2.0, 1.0, 2.0) - 2.0**0.5
    0.0
    """
    a, b = high, low
    at_a, at_b = equation(a), equation(b)
    if at_a == 0.0 or at_b == 0.0:
        return a if at_a == 0.0 else b
    share = 0.5
    while True:  # the values at b and c have unlike signs
        x = a + share * (b - a)
        here = equation(x)
        if (here > 0.0) == (at_a > 0.0):
            c, at_c = a, at_a
        else:
            c, b, at_c, at_b = b, a, at_b, at_a
        a, at_a = x, here
        best, size = (a, abs(at_a)) if abs(at_a) < abs(at_b) else (b, abs(at_b))
        least = math.ulp(best) / abs(b - a)
        if size == 0.0 or least > 0.5:
            return best
        place, fall = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
        share = 0.5
        if fall * fall < place and (1.0 - fall) * (1.0 - fall) < 1.0 - place:
            share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
            share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        share = min(max(share, least), 1.0 - least)
