"""Numbers and axes from the texts of flags."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.parsing import (
    MOST_AXIS_POINTS,
    axis,
    decimal,
    number,
    restitution_from,
    single,
)
from rocksteady.errors import InputError
from tests.cli.program import refused
from tests.every import every

ends = st.floats(-1e6, 1e6)
positive_ends = st.floats(1e-6, 1e6)
counts = st.integers(2, 300)


@given(ends, ends, counts)
def test_an_axis_is_even_with_both_ends(start: float, stop: float, count: int) -> None:
    values = axis("-A", f"{start!r}:{stop!r}:{count}")
    assert (len(values), values[0], values[-1]) == (count, start, stop)
    size = max(abs(start), abs(stop))
    np.testing.assert_allclose(values, np.linspace(start, stop, count), atol=1e-15 * size)


@given(positive_ends, positive_ends, counts)
def test_a_logarithmic_axis_has_one_ratio(start: float, stop: float, count: int) -> None:
    values = axis("-W", f"log:{start!r}:{stop!r}:{count}")
    assert (len(values), values[0], values[-1]) == (count, start, stop)
    ratio = (stop / start) ** (1.0 / (count - 1))
    assert [b / a for a, b in pairwise(values)] == pytest.approx([ratio] * (count - 1), rel=1e-9)


@given(ends)
def test_a_number_is_an_axis_of_one(value: float) -> None:
    assert axis("-A", repr(value)) == [value]
    assert number("-A", repr(value)) == decimal(repr(value)) == value


def test_the_longest_axis_is_a_million_and_zeros_before_a_count_do_not_matter() -> None:
    assert len(axis("-A", f"0:1:{MOST_AXIS_POINTS}")) == 1_000_000
    assert axis("-A", f"0:1:{'0' * 20}3") == [0.0, 0.5, 1.0]


@every(
    ("text", "words"),
    [
        ("two", "it must be a number;"),
        ("", "it must be a number;"),
        ("\N{ARABIC-INDIC DIGIT TWO}", "it must be a number;"),
        ("1:2", "it must be a number or an axis"),
        ("1:2:3:4", "it must be a number or an axis"),
        ("1:2:3.0", "it must be a number or an axis"),
        ("1:2:-3", "it must be a number or an axis"),
        ("1:2:\N{SUPERSCRIPT TWO}", "it must be a number or an axis"),
        ("log:1:2", "it must be a number or an axis"),
        ("one:2:3", "it must be a number;"),
        ("0:inf:3", "the ends must be finite"),
        ("nan:1:3", "the ends must be finite"),
        ("0:1:1", "from 2 to 1000000 points"),
        ("0:1:0", "from 2 to 1000000 points"),
        ("0:1:1000001", "from 2 to 1000000 points"),
        (f"0:1:{'9' * 5000}", "from 2 to 1000000 points"),
        ("log:0:1:3", "above 0"),
        ("log:1:-1:3", "above 0"),
        ("log:1e-300:1e300:3", "must not lie so far apart"),
        ("log:1e300:1e-300:3", "must not lie so far apart"),
    ],
)
def test_what_is_no_axis_is_refused_in_one_line(text: str, words: str) -> None:
    with pytest.raises(InputError) as refused:
        axis("-A", text)
    assert refused.value.name == "-A"
    assert str(refused.value.value) in text
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)


def test_only_the_digits_that_everyone_reads_are_numbers() -> None:
    assert float("\N{ARABIC-INDIC DIGIT TWO}") == 2.0
    with pytest.raises(ValueError, match="\N{ARABIC-INDIC DIGIT TWO}"):
        decimal("\N{ARABIC-INDIC DIGIT TWO}")
    with pytest.raises(ValueError, match="1_7"):
        decimal("1_7")
    assert math.isinf(decimal("inf"))


def test_a_restitution_is_a_number_a_pair_or_housners() -> None:
    assert restitution_from("0.8", default=None) == 0.8
    assert restitution_from("0.8,0.9", default=None) == (0.8, 0.9)
    assert restitution_from("housner", default="housner") == "housner"
    assert restitution_from(None, default="housner") == "housner"
    for text in ("housner*0.965", "0.965*housner", " housner * .965 "):
        assert restitution_from(text, default="housner") == ("housner", 0.965)


@every(
    ("text", "words"),
    [
        (None, "--restitution/-r is not given: without a block it is needed"),
        ("housner", "follows from a block's slenderness"),
        ("0.8,", "two of them, 'housner', or a factor"),
        ("0.8,0.9,0.7", "two of them, 'housner', or a factor"),
        ("housner*0.9", "follows from a block's slenderness"),
        ("housner*-1", "must be a finite number above 0"),
        ("housner0.9", r"write it as -r 'housner\*0.9'"),
        ("housner/2", "write it as -r 0.8 or"),
        ("housner*0,9", "write it as -r 0.8 or"),
        ("Housner", "two of them, 'housner', or a factor"),
    ],
)
def test_what_is_no_restitution_is_refused(text: str | None, words: str) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        restitution_from(text, default=None)


def test_a_single_value_is_no_axis() -> None:
    assert single("amplitude", [2.0]) == 2.0
    with pytest.raises(FlagError, match=r"^--amplitude/-A has 2 values: this command takes one"):
        single("amplitude", [2.0, 3.0])
    with pytest.raises(FlagError, match=r"^--scale has 3 values"):
        single("--scale", [1.0, 2.0, 3.0])


@every(
    ("flag", "unit"),
    [
        ("--width-m", "metres"),
        ("--offset-m", "metres"),
        ("--accel-m-s2", "m/s^2"),
        ("--pga-g", "g"),
        ("--freq-hz", "Hz"),
        ("--alpha-rad", "radians"),
    ],
)
def test_a_unit_that_is_typed_in_is_refused_with_that_of_the_flag(flag: str, unit: str) -> None:
    size = "" if flag == "--width-m" else "--width-m 0.5"
    shaking = "--accel-g 1" if flag == "--freq-hz" else "--freq-hz 2"
    line = refused(f"simulate {size} --height-m 2 {shaking} {flag} 600mm")
    assert f"{flag} = '600mm' is not valid: it must be a number; give it in {unit}, " in line
