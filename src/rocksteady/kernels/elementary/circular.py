"""Sine, cosine and tangent.

The nearest multiple of pi/2 is subtracted in three parts (Cody and Waite): the products with the
first two are exact up to 2^17 of them.  Polynomials of Sun's fdlibm (1993) do the rest.  Angles
beyond 2e5 go through `_turns`, which keeps as many digits of 2/pi as the angle needs.
"""

from rocksteady.kernels.elementary._turns import reduced_far
from rocksteady.kernels.elementary.bits import ROUND, ROUND_BITS, bits_of, lost_in_product
from rocksteady.kernels.machine_code.compilation import compiled, inlined

PER_QUARTER = 0.6366197723675814  # 2 / pi
QUARTER_HIGH = 1.5707963267923333  # pi/2: its first 36 bits,
QUARTER_MIDDLE = 2.5633441515839558e-12  # the next 36,
QUARTER_LOW = 1.0562999066987428e-23  # and the rest
NEAR = 2e5
"""Largest angle that is reduced in three parts."""
TINY = 2.0**-27


@inlined
def reduced_near(angle: float) -> tuple[float, float, int]:
    """Return x, its tail and n with angle = x + tail + n pi/2 and |x| <= pi/4; |angle| <= 2e5.

    The tail may exceed the last place of a small x; it stays below 2e-16.
    """
    shifted = angle * PER_QUARTER + ROUND
    n = shifted - ROUND
    a = angle - n * QUARTER_HIGH
    b = n * QUARTER_MIDDLE
    x = a - b
    back = a - x
    lost = (back - b) + (a - (x + back))
    return x, lost - n * QUARTER_LOW, bits_of(shifted) - ROUND_BITS


@inlined
def _sine_loss(x: float, tail: float) -> float:
    """Return x - sin(x + tail) for |x| <= pi/4."""
    z = x * x
    z2 = z * z
    r = (8.33333333332248946124e-03 + z * -1.98412698298579493134e-04) + z2 * (
        (2.75573137070700676789e-06 + z * -2.50507602534068634195e-08)
        + z2 * 1.58969099521155010221e-10
    )
    cube = z * x
    return (z * (0.5 * tail - cube * r) - tail) - cube * -1.66666666666666324348e-01


@inlined
def _cosine_parts(x: float, tail: float) -> tuple[float, float]:
    """Return cos(x + tail) for |x| <= pi/4 as 1 - x^2/2, rounded, and the rest."""
    z = x * x
    z2 = z * z
    r = (4.16666666666666019037e-02 + z * -1.38888888888741095749e-03) + z2 * (
        (2.48015872894767294178e-05 + z * -2.75573143513906633035e-07)
        + z2 * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)
    )
    half = 0.5 * z
    head = 1.0 - half
    return head, ((1.0 - head) - half) + (z2 * r - x * tail)


@inlined
def _in_quarter(x: float, tail: float, n: int) -> tuple[float, float]:
    """Return sine and cosine of x + tail + n pi/2."""
    sine = x - _sine_loss(x, tail)
    head, rest = _cosine_parts(x, tail)
    cosine = head + rest
    odd = (n & 1) != 0
    one = cosine if odd else sine
    other = sine if odd else cosine
    return -one if (n & 2) != 0 else one, -other if ((n + 1) & 2) != 0 else other


@inlined
def sincos_near(angle: float) -> tuple[float, float]:
    """Return sine and cosine for |angle| <= 2e5, which is not checked.

    There is no branch in it.  Beyond, up to 1e15, the error grows to some roundings of the angle.
    """
    x, tail, n = reduced_near(angle)
    return _in_quarter(x, tail, n)


@compiled
def _sincos_far(angle: float) -> tuple[float, float]:
    x, tail, n = reduced_far(angle)
    return _in_quarter(x, tail, n)


@inlined
def sincos(angle: float) -> tuple[float, float]:
    """Return sine and cosine."""
    angle = float(angle)
    if abs(angle) <= NEAR:
        return sincos_near(angle)
    return _sincos_far(angle)


@compiled
def sin(angle: float) -> float:
    """Return the sine."""
    angle = float(angle)
    x, tail, n = reduced_near(angle) if abs(angle) <= NEAR else reduced_far(angle)
    if (n & 1) != 0:
        head, rest = _cosine_parts(x, tail)
        value = head + rest
    else:
        value = x - _sine_loss(x, tail)
    return -value if (n & 2) != 0 else value


@compiled
def cos(angle: float) -> float:
    """Return the cosine."""
    angle = float(angle)
    x, tail, n = reduced_near(angle) if abs(angle) <= NEAR else reduced_far(angle)
    if (n & 1) != 0:
        value = x - _sine_loss(x, tail)
    else:
        head, rest = _cosine_parts(x, tail)
        value = head + rest
    return -value if ((n + 1) & 2) != 0 else value


@compiled
def tan(angle: float) -> float:
    """Return the tangent: a quotient of sine and cosine, each carried with what rounding lost."""
    angle = float(angle)
    if abs(angle) < TINY:
        return angle
    x, tail, n = reduced_near(angle) if abs(angle) <= NEAR else reduced_far(angle)
    loss = _sine_loss(x, tail)
    sine = x - loss
    sine_low = (x - sine) - loss
    head, rest = _cosine_parts(x, tail)
    cosine = head + rest
    cosine_low = (head - cosine) + rest
    if (n & 1) != 0:
        sine, sine_low, cosine, cosine_low = -cosine, -cosine_low, sine, sine_low
    quotient = sine / cosine
    product = quotient * cosine
    left = (sine - product) - lost_in_product(quotient, cosine, product)
    return quotient + (left + (sine_low - quotient * cosine_low)) / cosine
