"""Numbers and names as the study writes them."""

import math
import re

from hypothesis import given
from hypothesis import strategies as st

from rocksteady.studies.tso_wong_1989.figures.words import (
    motion_name,
    multiplier_text,
    percent,
    series,
    sign,
    signed,
    times,
)


@given(st.floats(1e-8, 1.0))
def test_a_share_in_percent_has_two_figures_at_least(share: float) -> None:
    text = percent(share)
    assert text.endswith(" %")
    assert math.isclose(float(text[:-2]) / 100.0, share, rel_tol=0.051)
    assert "0.00 %" not in text


@given(st.floats(-1e3, 1e3))
def test_a_negative_number_has_a_true_minus_and_reads_back(value: float) -> None:
    text = signed(value, ".6f")
    assert "-" not in text
    assert math.isclose(float(text.replace("−", "-")), value, abs_tol=5.1e-7)


@given(st.floats(1.0, 1e30))
def test_a_growth_names_its_order_of_magnitude(growth: float) -> None:
    text = times(growth)
    assert text.endswith("-fold")
    if growth < 9.9e3:
        assert math.isclose(float(text.removesuffix("-fold")), growth, rel_tol=0.06)
    else:
        assert re.search(r"10", text)


def test_a_multiplier_is_signed_and_a_pair_is_given_by_its_modulus() -> None:
    assert multiplier_text(complex(-1.18227, 0.0)) == "−1.182"
    assert multiplier_text(complex(0.0, -0.8)).startswith("0.8 ")
    assert multiplier_text(complex(0.48, 0.64)) == multiplier_text(complex(-0.64, 0.48))


def test_names_and_series() -> None:
    assert [motion_name(order) for order in (1, 3, 5)] == [
        "harmonic motion", "1/3 subharmonic", "1/5 subharmonic",
    ]  # fmt: skip
    assert sign(1) != sign(-1)
    assert series([], "g") == ""
    assert series([math.nan, -1.0]) == "—, −1"
