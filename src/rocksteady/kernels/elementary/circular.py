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
QUARTER_REST = 2.563344151594519e-12  # pi/2 less its first 36 bits
SIXTH = -1.66666666666666324348e-01
NEAR = 2e5
"""Largest angle that is reduced in three parts."""
SMALL_ANGLE = 0.785
"""Largest angle of `small_sinc_cos`, a little below pi/4."""
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
def _sine_series(z: float) -> float:
    """Return (sin x - x + x^3/6)/x^5 for z = x^2 and |x| <= pi/4."""
    z2 = z * z
    return (8.33333333332248946124e-03 + z * -1.98412698298579493134e-04) + z2 * (
        (2.75573137070700676789e-06 + z * -2.50507602534068634195e-08)
        + z2 * 1.58969099521155010221e-10
    )


@inlined
def _cosine_series(z: float) -> float:
    """Return (cos x - 1 + x^2/2)/x^4 for z = x^2 and |x| <= pi/4."""
    z2 = z * z
    return (4.16666666666666019037e-02 + z * -1.38888888888741095749e-03) + z2 * (
        (2.48015872894767294178e-05 + z * -2.75573143513906633035e-07)
        + z2 * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)
    )


@inlined
def _sine_loss(x: float, tail: float) -> float:
    """Return x - sin(x + tail) for |x| <= pi/4."""
    z = x * x
    cube = z * x
    return (z * (0.5 * tail - cube * _sine_series(z)) - tail) - cube * SIXTH


@inlined
def _cosine_parts(x: float, tail: float) -> tuple[float, float]:
    """Return cos(x + tail) for |x| <= pi/4 as 1 - x^2/2, rounded, and the rest."""
    z = x * x
    half = 0.5 * z
    head = 1.0 - half
    return head, ((1.0 - head) - half) + (z * z * _cosine_series(z) - x * tail)


@inlined
def _turned(sine: float, cosine: float, n: int) -> tuple[float, float]:
    """Return sine and cosine of an angle that is larger by n pi/2."""
    odd = (n & 1) != 0
    one = cosine if odd else sine
    other = sine if odd else cosine
    return -one if (n & 2) != 0 else one, -other if ((n + 1) & 2) != 0 else other


@inlined
def _in_quarter(x: float, tail: float, n: int) -> tuple[float, float]:
    """Return sine and cosine of x + tail + n pi/2."""
    head, rest = _cosine_parts(x, tail)
    return _turned(x - _sine_loss(x, tail), head + rest, n)


@inlined
def sincos_short(angle: float) -> tuple[float, float]:
    """Return sine and cosine, both within 1.7e-16, for |angle| <= 2e5, which is not checked.

    The shortest form, for searches and vectorised loops: it leaves out what makes small results
    exact too.
    """
    shifted = angle * PER_QUARTER + ROUND
    n = shifted - ROUND
    x = (angle - n * QUARTER_HIGH) - n * QUARTER_REST
    z = x * x
    sine = x + x * z * (SIXTH + z * _sine_series(z))
    cosine = 1.0 - z * (0.5 - z * _cosine_series(z))
    return _turned(sine, cosine, bits_of(shifted) - ROUND_BITS)


@inlined
def small_sinc_cos(angle: float) -> tuple[float, float]:
    """Return sin(angle)/angle and the cosine for |angle| <= SMALL_ANGLE, which is not checked."""
    z = angle * angle
    sinc = 1.0 + z * (SIXTH + z * _sine_series(z))
    return sinc, 1.0 - z * (0.5 - z * _cosine_series(z))


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
