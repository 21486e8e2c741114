"""The validators of single arguments."""

import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import (
    Ends,
    finite,
    in_range,
    non_negative,
    odd_order,
    positive,
    whole_number,
)
from tests.every import every

Validator = Callable[[object], float]

HINT = "give it in metres"

FLOATS: dict[str, Validator] = {
    "finite": lambda value: finite("width", value, hint=HINT),
    "positive": lambda value: positive("width", value, hint=HINT),
    "non_negative": lambda value: non_negative("width", value, hint=HINT),
    "in_range": lambda value: in_range("width", value, -1e9, math.inf, hint=HINT),
}
INTEGERS: dict[str, Validator] = {
    "whole_number": lambda value: whole_number("width", value, at_least=1, hint=HINT),
    "odd_order": lambda value: odd_order("width", value),
}
NOT_REAL = [
    True,
    False,
    np.True_,
    "1.0",
    b"1",
    1j,
    np.complex128(1.0),
    None,
    [1.0],
    np.array([1.0]),
    np.array(["1"])[0],
    Decimal(1),
    math.nan,
    math.inf,
    -math.inf,
    np.float64("nan"),
    np.array(np.inf),
]


def unit(value: object, ends: Ends = "(]") -> float:
    return in_range("restitution", value, 0.0, 1.0, ends, hint="give a ratio")


@every("validator", [*FLOATS.values(), *INTEGERS.values()])
@every("value", NOT_REAL)
def test_what_is_not_a_finite_real_number_is_refused(validator: Validator, value: object) -> None:
    with pytest.raises(InputError) as caught:
        validator(value)
    assert caught.value.value is value


@every("validator", FLOATS.values())
@every(
    "value",
    [2, 2.0, Fraction(2), np.float32(2.0), np.int8(2), np.longdouble(2.0), np.array(2.0)],
)
def test_any_real_number_comes_back_as_a_plain_float(validator: Validator, value: object) -> None:
    result = validator(value)
    assert result == 2.0
    assert type(result) is float


@every("validator", FLOATS.values())
@every("value", [10**400, Fraction(10**400), -(10**400)])
def test_a_number_beyond_the_largest_float_is_refused(validator: Validator, value: object) -> None:
    with pytest.raises(InputError):
        validator(value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_each_validator_accepts_exactly_its_own_numbers(value: float) -> None:
    def accepts(validator: Validator) -> bool:
        try:
            assert validator(value) == value
        except InputError:
            return False
        return True

    assert accepts(FLOATS["finite"])
    assert accepts(FLOATS["positive"]) is (value > 0.0)
    assert accepts(FLOATS["non_negative"]) is (value >= 0.0)
    assert accepts(lambda v: unit(v, "[]")) is (0.0 <= value <= 1.0)
    assert accepts(lambda v: unit(v, "(]")) is (0.0 < value <= 1.0)
    assert accepts(lambda v: unit(v, "[)")) is (0.0 <= value < 1.0)
    assert accepts(lambda v: unit(v, "()")) is (0.0 < value < 1.0)


@every(
    ("ends", "zero", "one"),
    [("[]", True, True), ("(]", False, True), ("[)", True, False), ("()", False, False)],
)
def test_the_brackets_say_which_ends_belong_to_an_interval(
    ends: Ends, zero: bool, one: bool
) -> None:
    for value, belongs in ((0.0, zero), (1.0, one)):
        if belongs:
            assert unit(value, ends) == value
        else:
            with pytest.raises(InputError):
                unit(value, ends)


def test_a_positive_fraction_that_rounds_to_zero_is_refused() -> None:
    with pytest.raises(InputError):
        FLOATS["positive"](Fraction(1, 10**400))


def test_minus_zero_becomes_zero() -> None:
    assert math.copysign(1.0, FLOATS["non_negative"](-0.0)) == 1.0


@every(
    ("validator", "value", "message"),
    [
        (FLOATS["finite"], "a", "width = 'a' is not valid: it must be a finite number; "),
        (FLOATS["positive"], -1, "width = -1 is not valid: it must be a finite number above 0; "),
        (
            FLOATS["non_negative"],
            -0.5,
            "width = -0.5 is not valid: it must be a finite number, 0 or above; ",
        ),
        (
            INTEGERS["whole_number"],
            0,
            "width = 0 is not valid: it must be a whole number of 1 or above; ",
        ),
    ],
)
def test_the_line_says_the_value_what_is_valid_and_what_to_do(
    validator: Validator, value: object, message: str
) -> None:
    with pytest.raises(InputError) as caught:
        validator(value)
    assert str(caught.value) == message + HINT


def test_the_line_of_an_interval() -> None:
    with pytest.raises(InputError) as caught:
        unit(1.2)
    assert str(caught.value) == (
        "restitution = 1.2 is not valid: it must lie in (0, 1]; give a ratio"
    )


@given(st.integers(min_value=0, max_value=10**6))
def test_every_odd_order_is_accepted_and_every_even_one_refused(half: int) -> None:
    assert odd_order("order", 2 * half + 1) == 2 * half + 1
    with pytest.raises(InputError):
        odd_order("order", 2 * half)


def test_an_even_order_is_told_why() -> None:
    with pytest.raises(InputError) as caught:
        odd_order("--order", 2)
    assert str(caught.value) == (
        "--order = 2 is not valid: a symmetric orbit needs an odd number of half periods in its "
        "half cycle; use 1, 3, 5, ..."
    )


@every("value", [0, -1, -3, 3.0, np.float64(3.0), Fraction(3)])
def test_an_order_is_a_whole_number_above_zero(value: object) -> None:
    with pytest.raises(InputError):
        odd_order("order", value)


@every("value", [3, np.int64(3), np.uint8(3), np.array(3)])
def test_an_order_comes_back_as_a_plain_int(value: object) -> None:
    result = odd_order("order", value)
    assert result == 3
    assert type(result) is int
