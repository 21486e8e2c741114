"""Validators of single arguments, called first by every constructor and public function.

Each takes the argument's name, its value and a hint, and returns a plain ``float`` (or ``int``),
so that what is stored never depends on the type that came in. Each raises
`~rocksteady.errors.InputError`, whose one line shows the value, what is valid and the hint.

A number is an ``int``, a ``float``, a fraction, a NumPy scalar or an array of shape ``()``. NaN,
infinity, ``bool``, strings, complex numbers and arrays of any other shape are refused: a silent
conversion of one of them is a wrong result later.
"""

import math
from collections.abc import Sequence
from numbers import Integral, Real
from typing import Any, Final, Literal, TypeGuard

from rocksteady.errors import InputError
from rocksteady.model.checks.arrays import scalar_of

LARGEST: Final = 1.0e50
"""The largest dimensionless number that the kernels accept: its powers do not overflow."""

_ODD_ORDER_HINT: Final = "use 1, 3, 5, ..."

MOST_NUMBERS: Final = 100_000_000
"""Of one array that follows from arguments: 800 MB."""

Ends = Literal["[]", "(]", "[)", "()"]
"""Which ends belong to an interval: a square bracket for one that does."""


def finite(name: str, value: object, *, hint: str) -> float:
    """Return `value` as a float where it is a finite real number.

    Parameters
    ----------
    name
        The argument's name, for the message.
    value
        What the caller gave.
    hint
        What to do next, as a clause ("give the angle in radians").

    Returns
    -------
    float
        The number, in the unit it came in.

    Raises
    ------
    InputError
        If `value` is not a real number, or is NaN or infinite.
    """
    return _finite(name, value, "it must be a finite number", hint)


def positive(name: str, value: object, *, hint: str) -> float:
    """Return `value` as a float where it is a finite number above 0.

    Parameters and errors are those of `finite`; zero and negative numbers are refused too.
    """
    valid = "it must be a finite number above 0"
    number = _finite(name, value, valid, hint)
    if number <= 0.0:
        raise InputError(name, value, valid, hint)
    return number


def non_negative(name: str, value: object, *, hint: str) -> float:
    """Return `value` as a float where it is a finite number, 0 or above; -0.0 becomes 0.0.

    Parameters and errors are those of `finite`; negative numbers are refused too.
    """
    valid = "it must be a finite number, 0 or above"
    number = _finite(name, value, valid, hint)
    if number < 0.0:
        raise InputError(name, value, valid, hint)
    return abs(number)


def in_range(
    name: str, value: object, low: float, high: float, ends: Ends = "(]", *, hint: str
) -> float:
    """Return `value` as a float where it lies in an interval.

    Parameters
    ----------
    name, value, hint
        As for `finite`.
    low, high
        The ends of the interval; ``high`` may be infinite, and the value is still finite.
    ends
        Which ends belong to it; by default the upper one, as for a restitution in (0, 1].

    Returns
    -------
    float
        The number, in the unit it came in.

    Raises
    ------
    InputError
        If `value` is not a finite real number of the interval.
    """
    if type(value) is float and low < value < high:
        return value  # most are
    valid = f"it must lie in {ends[0]}{low:.15g}, {high:.15g}{ends[1]}"
    number = _finite(name, value, valid, hint)
    above = number >= low if ends[0] == "[" else number > low
    below = number <= high if ends[1] == "]" else number < high
    if not (above and below):
        raise InputError(name, value, valid, hint)
    return number


def whole_number(
    name: str, value: object, *, at_least: int, at_most: int | None = None, hint: str
) -> int:
    """Return `value` as an int where it is a whole number of at least `at_least`.

    Floats are refused, 3.0 included: a count that comes out of a division is worth a look.

    Parameters
    ----------
    name, value, hint
        As for `finite`.
    at_least
        The smallest valid value.
    at_most
        The largest, where there is one.

    Returns
    -------
    int
        The number.

    Raises
    ------
    InputError
        If `value` is not an integer, or is outside these bounds.
    """
    number = scalar_of(value)
    valid = f"it must be a whole number of {at_least} or above"
    if at_most is not None:
        valid = f"it must be a whole number from {at_least} to {at_most}"
    if isinstance(number, bool) or not isinstance(number, Integral) or number < at_least:
        raise InputError(name, value, valid, hint)
    count = int(number)
    if at_most is not None and count > at_most:
        raise InputError(name, value, valid, hint)
    return count


def index_value(value: object, count: int, what: str, *, name: str = "index") -> int:
    """Return `value` as an index into `count` things; negative ones count from the end.

    Raises
    ------
    InputError
        If it is no whole number, or there is no such thing.
    """
    number = scalar_of(value)
    whole = isinstance(number, Integral) and not isinstance(number, bool)
    if not whole or not -count <= number < count:
        raise InputError(
            name,
            value,
            f"it must be a whole number from {-count} to {count - 1}",
            f"give the index of a {what}",
        )
    return int(number)


def within_memory(name: str, value: object, count: float, *, hint: str) -> None:
    """Refuse a value from which more numbers would follow than are kept in memory at once.

    Raises
    ------
    InputError
        If there would be more than 100 million, or their number is no number.
    """
    if not count <= MOST_NUMBERS:
        raise InputError(
            name,
            value,
            f"{count:.3g} numbers would follow from it, and {MOST_NUMBERS:.0e} are the most",
            hint,
        )


def span_value(
    name: str, value: object, low: float, high: float, *, hint: str
) -> tuple[float, float]:
    """Return `value` as two finite numbers, the first below the second, inside an interval.

    Raises
    ------
    InputError
        If it is anything else.
    """
    ends = list(value) if isinstance(value, list | tuple) else []
    numbers = [scalar_of(end) for end in ends]
    real = all(isinstance(end, Real) and not isinstance(end, bool) for end in numbers)
    if len(ends) != 2 or not real or not low <= numbers[0] < numbers[1] <= high:
        valid = f"it must be (start, end), start before end, inside [{low:.15g}, {high:.15g}]"
        raise InputError(name, value, valid, hint)
    return float(numbers[0]), float(numbers[1])


def rising(
    name: str, value: Sequence[Any], low: float, high: float, *, hint: str
) -> tuple[float, float]:
    """Return two numbers from one to another, the first below the second.

    Raises
    ------
    InputError
        If they are none; the first is looked at first.
    """
    first = in_range(name, value[0], low, high, "[)", hint=hint)
    return first, in_range(name, value[1], first, high, "(]", hint=hint)


def side_value(name: str, value: object) -> int:
    """Return `value` as 1 or -1, the positive side or the negative one.

    Raises
    ------
    InputError
        If it is neither.
    """
    plain = scalar_of(value)
    if isinstance(plain, bool) or not isinstance(plain, Real) or plain not in (1, -1):
        raise InputError(name, value, "it must be 1 or -1", "give 1 or -1")
    return 1 if plain == 1 else -1


def odd_order(name: str, value: object) -> int:
    """Return `value` as an int where it can be the order n of a symmetric orbit: 1, 3, 5, ...

    The order counts the half periods of the forcing in one half cycle of the rocking. After its
    half cycle a symmetric orbit repeats itself on the other side, which requires that the forcing
    has changed its sign: that is so after an odd number of half periods only.

    Parameters
    ----------
    name, value
        As for `finite`.

    Returns
    -------
    int
        The order.

    Raises
    ------
    InputError
        If `value` is not an integer, is below 1 or is even.
    """
    number = whole_number(name, value, at_least=1, hint=_ODD_ORDER_HINT)
    if number % 2 == 0:
        valid = "a symmetric orbit needs an odd number of half periods in its half cycle"
        raise InputError(name, value, valid, _ODD_ORDER_HINT)
    return number


def is_pair(value: object) -> TypeGuard[Sequence[Any]]:
    """Return whether `value` is a tuple, a list or an array of two items."""
    row = isinstance(value, tuple | list) or getattr(value, "ndim", 0) == 1
    return row and len(value) == 2  # type: ignore[arg-type]


def _finite(name: str, value: object, valid: str, hint: str) -> float:
    """Return `value` as a finite float, or raise with the caller's account of what is valid."""
    number = scalar_of(value)
    if not isinstance(number, bool) and isinstance(number, Real):
        try:
            result = float(number)
        except OverflowError:  # an integer or a fraction beyond the largest float
            result = math.inf
        if math.isfinite(result):
            return result
    raise InputError(name, value, valid, hint)
