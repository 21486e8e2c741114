"""The validators of single arguments."""

import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import (
    Ends,
    finite,
    in_range,
    index_value,
    is_pair,
    non_negative,
    odd_order,
    positive,
    rising,
    side_value,
    span_value,
    whole_number,
    within_memory,
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


def _taken(check: Callable[..., Any], *given: Any, **named: Any) -> Any:
    """Return what a check returns, or its refusal in two clauses."""
    try:
        return check(*given, **named)
    except InputError as error:
        return error.valid, error.hint


def test_an_index_counts_from_either_end() -> None:
    for count in (1, 2, 5):
        valid = f"it must be a whole number from {-count} to {count - 1}", "give the index of a row"
        for index in range(-count - 2, count + 2):
            expected = index if -count <= index < count else valid
            assert _taken(index_value, index, count, "row") == expected, (index, count)
        for wrong in (True, False, 0.0, "0", None, [0], math.nan):
            assert _taken(index_value, wrong, count, "row") == valid, wrong
    assert type(index_value(np.int8(-1), 2, "row")) is int
    with pytest.raises(InputError, match=r"^index = 1 .*"):
        index_value(1, 1, "row")
    with pytest.raises(InputError, match=r"^case = 1 .*"):
        index_value(1, 1, "row", name="case")


def test_a_span_is_two_numbers_in_order_inside_its_range() -> None:
    valid = "it must be (start, end), start before end, inside [0, 2]", HINT
    for fit in ((0.0, 2.0), [0, 1], (np.float32(0.5), Fraction(3, 2)), (0.0, 5e-324)):
        low, high = span_value("x", fit, 0.0, 2.0, hint=HINT)
        assert (low, high) == tuple(fit)
        assert type(low) is type(high) is float
    none: list[Any] = [
        (-1e-9, 1.0), (0.0, 2.1), (1.0, 1.0), (2.0, 1.0), (0.0,), (0.0, 1.0, 2.0), (), "ab", None,
        1.0, (False, 1.0), (0.0, True), ("0", 1.0), (0.0, None), (math.nan, 1.0), (0.0, math.nan),
        {0.0: 1.0, 1.0: 2.0},
    ]  # fmt: skip
    for wrong in none:
        assert _taken(span_value, "x", wrong, 0.0, 2.0, hint=HINT) == valid, wrong


def test_a_rising_pair_is_refused_by_its_first_wrong_number() -> None:
    for fit in ((0.0, 2.0), (1, 2), (0.0, 5e-324), (np.float32(1.5), 2.0)):
        assert rising("x", fit, 0.0, 2.0, hint=HINT) == fit
    for wrong, value, valid in (
        ((-0.1, 3.0), -0.1, "it must lie in [0, 2)"),
        ((2.0, 2.0), 2.0, "it must lie in [0, 2)"),
        ((1.0, 1.0), 1.0, "it must lie in (1, 2]"),
        ((1.0, 0.5), 0.5, "it must lie in (1, 2]"),
        ((1.0, 2.1), 2.1, "it must lie in (1, 2]"),
        ((True, 2.0), True, "it must lie in [0, 2)"),
    ):
        with pytest.raises(InputError) as caught:
            rising("x", wrong, 0.0, 2.0, hint=HINT)
        assert (caught.value.value, caught.value.valid) == (value, valid)


def test_a_side_is_plus_or_minus_one() -> None:
    for value, side in (
        (1, 1),
        (-1, -1),
        (1.0, 1),
        (-1.0, -1),
        (np.int8(-1), -1),
        (Fraction(1), 1),
    ):
        taken = side_value("side", value)
        assert (taken, type(taken)) == (side, int)
    for wrong in (True, False, 0, 2, -2, "1", None, math.nan, [1], 1j, -0.5):
        assert _taken(side_value, "side", wrong) == ("it must be 1 or -1", "give 1 or -1"), wrong


def test_a_hundred_million_numbers_are_the_most() -> None:
    for count in (0, 1e8, 1e8 - 1, 100_000_000):
        assert _taken(within_memory, "x", 1, count, hint=HINT) is None
    for count, words in (
        (100_000_001, "1e+08"),
        (3e9, "3e+09"),
        (math.inf, "inf"),
        (math.nan, "nan"),
    ):
        valid = f"{words} numbers would follow from it, and 1e+08 are the most"
        assert _taken(within_memory, "x", 1, count, hint=HINT) == (valid, HINT)


def test_a_pair_is_a_row_of_two() -> None:
    for pair in ((1, 2), [1, 2], np.array([1, 2]), ("a", None)):
        assert is_pair(pair)
    for other in ((1,), [1, 2, 3], (), "ab", {1: 2, 3: 4}, 1, None, np.zeros((2, 1)), np.zeros(3)):
        assert not is_pair(other)


def test_whole_numbers_have_a_lowest_and_perhaps_a_highest() -> None:
    for low, high in ((0, None), (0, 3), (-2, 5), (1, 1)):
        ends = f"of {low} or above" if high is None else f"from {low} to {high}"
        valid = f"it must be a whole number {ends}", HINT
        for value in range(-4, 9):
            inside = value >= low and (high is None or value <= high)
            taken = _taken(whole_number, "x", value, at_least=low, at_most=high, hint=HINT)
            assert taken == (value if inside else valid), (low, high, value)
            assert type(taken) is (int if inside else tuple)


def test_an_interval_has_its_upper_end_alone_unless_told() -> None:
    valid = "it must lie in (0, 2]", HINT
    for value in (0.0, 2.0, 1.0, 0, 2, 1, np.float32(2.0), -1e-300, 2.1):
        expected = float(value) if 0.0 < value <= 2.0 else valid
        assert _taken(in_range, "x", value, 0.0, 2.0, hint=HINT) == expected, value
    for wrong in (True, math.nan, math.inf, -math.inf, None):
        assert _taken(in_range, "x", wrong, -math.inf, math.inf, "[]", hint=HINT) == (
            "it must lie in [-inf, inf]", HINT,
        ), wrong  # fmt: skip
