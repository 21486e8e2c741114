"""Ball arithmetic of python-flint: numbers with proved errors, and decimals rounded outwards.

A comparison of balls is True only where it holds for all of their members: what is undecided is
False, so that every test of a proof is written as what must hold.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from threading import RLock

from flint import arb, ctx, fmpq

from rocksteady.certify.proofs import base_checker
from rocksteady.errors import InputError
from rocksteady.model.checks.validation import finite

BITS = (64, 128, 256, 512, 1024, 2048, 4096)
"""Precisions of a proof, each tried where the one before leaves the claim undecided."""

LOCK = RLock()
"""Held by the thread that has set the precision."""

Stated = tuple[str, ...]
"""A number of a claim: its decimal text, and that of its double where it is another number."""


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Compute with a number of bits, one thread at a time, and with the former number afterwards.

    The number of bits of python-flint is that of all threads.
    """
    with LOCK:
        before, cap = ctx.prec, ctx.cap
        ctx.prec = bits
        try:
            yield
        finally:
            ctx.prec, ctx.cap = before, cap


def stated(name: str, value: str | float | Fraction) -> Stated:
    """Return the decimals between which a given number lies: its text and its double.

    The text of a double is the shortest decimal that reads back as the double.

    Raises
    ------
    InputError
        If it is no finite number.

    Examples
    --------
    >>> stated("amplitude", 2.5), len(stated("amplitude", "0.8"))
    (('2.5',), 2)
    """
    hint = "give a decimal, as 2.65"
    text = str(value) if isinstance(value, str | Fraction) else repr(finite(name, value, hint=hint))
    try:
        written = base_checker.exact(text)
        double = Fraction(float(written))
    except (ValueError, OverflowError):
        raise InputError(name, value, "it must be a finite number", hint) from None
    return (text,) if written == double else (text, decimal_of(double))


def decimal_of(value: Fraction) -> str:
    """Return a fraction of powers of 2 as the decimal that it is exactly."""
    places = value.denominator.bit_length() - 1
    digits = str(abs(value.numerator) * 5**places).rjust(places + 1, "0")
    whole, part = digits[: len(digits) - places], digits[len(digits) - places :]
    return ("-" if value < 0 else "") + whole + ("." + part if part else "")


def ball(texts: Stated) -> arb:
    """Return a ball that holds each of the decimals, and so all numbers between them."""
    first, *rest = (exact(Fraction(text)) for text in texts)
    for member in rest:
        first = first.union(member)
    return first


def exact(value: Fraction) -> arb:
    """Return the ball of a fraction."""
    return arb(fmpq(value.numerator, value.denominator))


def hull(low: arb | float, high: arb | float) -> arb:
    """Return a ball that holds two balls and all between them."""
    return arb(low).union(arb(high))


def mid(x: arb) -> arb:
    """Return the centre of a ball, a number without error."""
    return arb(x.mid())


def below(x: arb) -> arb:
    """Return the lower end of a ball, a number without error."""
    return arb(x.lower())


def above(x: arb) -> arb:
    """Return the upper end of a ball, a number without error."""
    return arb(x.upper())


def around(centre: arb, radius: arb | float) -> arb:
    """Return a ball with a radius around a number."""
    return hull(centre - arb(radius), centre + arb(radius))


def halves(x: arb) -> tuple[arb, arb]:
    """Return the two halves of a ball."""
    middle = mid(x)
    return hull(below(x), middle), hull(middle, above(x))


def size(x: arb) -> float:
    """Return a double that no member of a ball exceeds in modulus."""
    return math.nextafter(float(abs(x).upper()), math.inf)


def fraction(x: arb) -> Fraction:
    """Return the fraction that a number without error is."""
    mantissa, exponent = (int(part) for part in x.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def decimal(x: arb, places: int) -> str:
    """Return the centre of a ball as a decimal with a number of places, rounded to nearest."""
    scaled = round(fraction(mid(x)) * 10**places)
    digits = str(abs(scaled)).rjust(places + 1, "0")
    text = f"{digits[:-places]}.{digits[-places:]}" if places else digits
    return ("-" if scaled < 0 else "") + text


def decimals_around(box: list[arb], slack: int = 16) -> tuple[list[str], list[str]]:
    """Return centres and radii, as decimals, of a box that holds another with slack.

    Parameters
    ----------
    box
        The balls.
    slack
        How many times wider than the widest ball the box is.
    """
    with precision(ctx.prec + 64):
        wide = max(float(above(x) - below(x)) for x in box)
        places = max(6, min(300, -math.floor(math.log10(max(wide * slack, 1e-300)))))
        return [decimal(x, places + 3) for x in box], [f"1e-{places - 1}"] * len(box)
