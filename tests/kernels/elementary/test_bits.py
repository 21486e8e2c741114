"""Bits of floats, and what a product loses, against whole numbers and fractions."""

import struct
from fractions import Fraction

import numpy as np

from rocksteady.kernels.elementary.bits import (
    bits_of,
    float_of,
    lost_in_product,
    nearest_whole,
    power_of_two,
)


def test_bits_there_and_back() -> None:
    for x in (0.0, -0.0, 1.0, -2.5, 5e-324, 1.7976931348623157e308, float("inf")):
        assert bits_of(x) == struct.unpack("<q", struct.pack("<d", x))[0]
        assert struct.pack("<d", float_of(bits_of(x))) == struct.pack("<d", x)


def test_powers_of_two() -> None:
    for exponent in range(-1022, 1024):
        assert power_of_two(exponent) == 2.0**exponent


def test_the_nearest_whole_number() -> None:
    for x in (-2.6, -2.4, 0.0, 0.4, 0.6, 1e6 + 0.3):
        assert nearest_whole(x) == round(x)


def test_a_product_and_what_it_lost_are_exact() -> None:
    rng = np.random.default_rng(13)
    for a, b in (rng.normal(size=(1000, 2)) * 10.0 ** rng.integers(-100, 100, (1000, 2))).tolist():
        lost = lost_in_product(a, b, a * b)
        assert Fraction(a * b) + Fraction(lost) == Fraction(a) * Fraction(b)
