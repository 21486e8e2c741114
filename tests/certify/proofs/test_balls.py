"""Decimals of claims, and ends of balls rounded outwards."""

import math
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from time import sleep

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.certify.proofs._balls import (
    decimal,
    decimal_of,
    decimals_around,
    exact,
    fraction,
    hull,
    precision,
    size,
    stated,
)
from rocksteady.errors import InputError


@given(st.floats(min_value=1e-3, max_value=1e3))
def test_a_double_is_stated_by_its_text_and_by_itself(value: float) -> None:
    texts = stated("amplitude", value)
    assert float(texts[0]) == value
    assert Fraction(texts[-1]) == Fraction(value)
    assert Fraction(decimal_of(Fraction(value))) == Fraction(value)


def test_a_decimal_that_is_a_double_is_stated_once() -> None:
    assert stated("amplitude", "2.5") == ("2.5",)
    assert len(stated("amplitude", "0.8")) == 2
    with pytest.raises(InputError, match="finite number"):
        stated("amplitude", "two")
    with pytest.raises(InputError, match="finite number"):
        stated("amplitude", math.inf)
    with pytest.raises(InputError, match="finite number"):  # of which float() makes a timedelta
        stated("amplitude", np.timedelta64(3, "s"))  # type: ignore[arg-type]


def test_precision_is_set_and_restored_even_after_an_error() -> None:
    before = ctx.prec
    seen = []
    try:
        with precision(200):
            seen.append(ctx.prec)
            raise ValueError
    except ValueError:
        seen.append(ctx.prec)
    assert seen == [200, before]


def test_threads_compute_one_after_the_other_each_with_its_bits() -> None:
    def bits_kept(bits: int) -> bool:
        with precision(bits):
            sleep(0.002)
            return ctx.prec == bits

    with ThreadPoolExecutor(4) as threads:
        assert all(threads.map(bits_kept, range(64, 104)))


@given(st.integers(-(10**9), 10**9), st.integers(1, 10**6))
def test_size_is_rounded_outwards(top: int, bottom: int) -> None:
    with precision(100):
        value = exact(Fraction(top, bottom))
        assert Fraction(size(value)) >= abs(Fraction(top, bottom))


def test_a_box_of_decimals_holds_the_balls() -> None:
    with precision(128):
        box = [exact(Fraction(2, 7)), -exact(Fraction(1, 3)) + hull(-1, 1) * arb(1e-20)]
        centres, radii = decimals_around(box)
        for x, centre, radius in zip(box, centres, radii, strict=True):
            ends = fraction(arb(x.lower())), fraction(arb(x.upper()))
            assert Fraction(centre) - Fraction(radius) < ends[0]
            assert ends[1] < Fraction(centre) + Fraction(radius)
    assert decimal(arb(-0.5), 3) == "-0.500"
