"""Text of numbers and names in the study."""

import math
from collections.abc import Iterable

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def motion_name(order: int) -> str:
    """Return what a symmetric motion of an order is called.

    Examples
    --------
    >>> motion_name(1), motion_name(3)
    ('harmonic motion', '1/3 subharmonic')
    """
    return "harmonic motion" if order == 1 else f"1/{order} subharmonic"


def sign(side: int) -> str:
    """Return the sign of a side, with a true minus.

    Examples
    --------
    >>> sign(1), sign(-1)
    ('+', '−')
    """
    return "+" if side > 0 else "−"


def signed(value: float, form: str) -> str:
    """Return a formatted number with a true minus.

    Examples
    --------
    >>> signed(-0.27243, ".3f")
    '−0.272'
    """
    return format(value, form).replace("-", "−")


def percent(share: float) -> str:
    """Return a share in percent, with at least two figures however small it is.

    Examples
    --------
    >>> percent(0.11493), percent(0.0000071)
    ('11.49 %', '0.00071 %')
    """
    return f"{100.0 * share:.4g} %" if share >= 0.001 else f"{100.0 * share:.2g} %"


def scientific(value: float) -> str:
    """Return a number, 0 or above, with two figures, in powers of ten where it is small or large.

    Examples
    --------
    >>> scientific(3.4e-16), scientific(0.4), scientific(123.4), scientific(2.3e12)
    ('3.4·10⁻¹⁶', '0.40', '123', '2.3·10¹²')
    """
    if value == 0.0:
        return "0"
    if 0.01 <= value < 1000.0:
        return (
            f"{value:.0f}" if value >= 10.0 else f"{value:.2f}" if value < 1.0 else f"{value:.1f}"
        )
    digits, power = f"{value:.1e}".split("e")
    return f"{digits}·10{str(int(power)).translate(SUPERSCRIPTS)}"


def times(growth: float) -> str:
    """Return a factor of growth.

    Examples
    --------
    >>> times(35.6), times(3.2e12)
    ('36-fold', '3.2·10¹²-fold')
    """
    if growth < 1e4:
        return f"{growth:.2g}-fold" if growth < 10.0 else f"{growth:.0f}-fold"
    return f"{scientific(growth)}-fold"


def multiplier_text(value: complex) -> str:
    """Return a multiplier or, of a complex pair, the modulus.

    Examples
    --------
    >>> multiplier_text(-1.1823 + 0j), multiplier_text(0.48 + 0.64j)
    ('−1.182', '0.8 in modulus (a complex pair)')
    """
    if value.imag != 0.0:
        return f"{abs(value):.4g} in modulus (a complex pair)"
    return signed(value.real, ".4g")


def series(values: Iterable[float], form: str = "g") -> str:
    """Return numbers with commas between them; a dash where there is none.

    Examples
    --------
    >>> series([0.5, 0.95]), series([math.nan, 0.1448], ".3f")
    ('0.5, 0.95', '—, 0.145')
    """
    return ", ".join("—" if math.isnan(value) else signed(value, form) for value in values)
