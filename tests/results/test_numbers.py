"""Numbers as engineers write them: digits, units, signs and the values that are none."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.results.numbers import (
    angle,
    chance,
    counted,
    length,
    number,
    plural,
    quantity,
    share,
)
from tests.every import every

NUMBERS = st.floats(min_value=-1e300, max_value=1e300)


@given(NUMBERS)
def test_a_number_is_read_back_within_half_a_unit_of_its_third_digit(value: float) -> None:
    assert float(number(value)) == pytest.approx(value, rel=0.0051, abs=5e-324)


@given(st.floats(min_value=1e-4, max_value=999_000.0))
def test_no_exponent_where_people_write_none(value: float) -> None:
    assert "e" not in number(value)


@given(NUMBERS.filter(bool))
def test_the_sign_is_kept(value: float) -> None:
    assert number(-abs(value)) == f"-{number(abs(value))}"


def test_what_is_no_number_is_a_dash_or_a_word() -> None:
    assert [number(x) for x in (math.nan, math.inf, -math.inf)] == ["—", "infinite", "-infinite"]


@given(st.floats(min_value=0.0, max_value=1.0), st.integers(min_value=1, max_value=10_000))
def test_no_count_is_said_to_be_0_or_100_per_cent(share: float, trials: int) -> None:
    part = round(share * trials)
    words = chance(part / trials, trials)
    assert words not in ("0 %", "0.0 %", "100 %", "100.0 %")
    assert ("of" in words) == (part in (0, trials))


@every(
    ("text", "wanted"),
    [
        (quantity(0.8224892168, "alpha"), "0.822 alpha"),
        (quantity(56.0, "%"), "56 %"),
        (angle(math.pi / 6), "30°"),
        (length(0.0124), "12.4 mm"),
        (length(-0.5), "-500 mm"),
        (length(1.8), "1.8 m"),
        (share(7, 21), "33.3 %"),
        (share(0, 0), "—"),
        (chance(0.0, 12), "0 of 12"),
        (chance(1.0, 1200), "1,200 of 1,200"),
        (chance(1.0), "> 99 %"),
        (chance(1e-9), "< 0.1 %"),
        (chance(0.0994), "9.9 %"),
        (chance(0.0996), "10 %"),
        (counted(1, "12 runs"), "1 of 12 runs falls"),
        (counted(0, "12 runs"), "none of 12 runs fall"),
        (plural(1, "run"), "1 run"),
        (plural(0, "run"), "0 runs"),
        (plural(12345, "cell"), "12,345 cells"),
    ],
)
def test_quantities(text: str, wanted: str) -> None:
    assert text == wanted
