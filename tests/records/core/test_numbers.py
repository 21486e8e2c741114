"""Numbers as Fortran writes them: exact, in place, and never a guess."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.records.core.numbers import number, numbers, samples
from tests.every import every

FINITE = st.floats(-1e12, 1e12, allow_nan=False)


@every(
    ("written", "value"),
    [
        ("1", 1.0),
        ("-.5", -0.5),
        ("+3.", 3.0),
        (".1234D-02", 0.001234),
        ("1.5e+3", 1500.0),
        ("2d2", 200.0),
    ],
)
def test_a_number(written: str, value: float) -> None:
    assert number(written) == value


@every(
    "written",
    ["", "nan", "inf", "1_0", "0x10", "1.2.3", "1e", "--1", "\N{ARABIC-INDIC DIGIT ONE}", "1e999"],
)
def test_no_number(written: str) -> None:
    assert number(written) is None
    assert numbers(f"1.0 {written} 2.0") is None or not written


def test_numbers_that_run_together_are_told_apart_by_signs() -> None:
    assert numbers("1.234-5.678+9") == [1.234, -5.678, 9.0]
    assert numbers(" 1.0E-03-2.0E-03-3.0E+02 4.0") == [1e-3, -2e-3, -3e2, 4.0]
    assert numbers("-12085-12070") == [-12085.0, -12070.0]
    assert numbers("-0.1234-105 0.5") == [-0.1234e-105, 0.5]


def test_numbers_that_run_together_without_a_sign_need_their_width() -> None:
    assert numbers("12.3456712.34567") is None
    assert numbers("12.3456712.34567", 8) == [12.34567, 12.34567]
    assert numbers("1234567812345678", 8) == [12345678.0, 12345678.0]
    # A width that the file states wrongly does not cut numbers that stand apart.
    assert numbers("-123.45678 -123.45679", 8) == [-123.45678, -123.45679]
    assert numbers("1.0E+012.0E+01", 7) == [10.0, 20.0]
    # Nor does it cut numbers that did not fit and have pushed on the others.
    assert numbers("-262.345678-275.155934  1.000000", 10) == [-262.345678, -275.155934, 1.0]


@every("line", ["1.0 ******* 2.0", "1.0 abc", "1..2", "1.0 1e5e5", "1,5", "x" * 5000])
def test_a_line_with_anything_else_holds_no_numbers(line: str) -> None:
    assert numbers(line) is None
    assert numbers(line, 7) is None


@given(values=st.lists(FINITE, min_size=1, max_size=40), width=st.sampled_from([None, 24]))
def test_what_fortran_writes_is_read_back(values: list[float], width: int | None) -> None:
    line = "".join(f"{value:24.16E}" for value in values)
    assert numbers(line, width) == values
    stuck = "".join(f"{value:+.16E}" for value in values)
    assert numbers(stuck) == values
    assert numbers(stuck.replace("E", "D")) == values


@given(
    values=st.lists(FINITE, min_size=1, max_size=2000),
    per_line=st.integers(1, 9),
    at_most=st.integers(1, 2500),
)
def test_samples_of_lines(values: list[float], per_line: int, at_most: int) -> None:
    lines = [
        " ".join(map(repr, values[at : at + per_line])) for at in range(0, len(values), per_line)
    ]
    found, end = samples([*lines, "", "end of data 1"], 0)
    assert found.tolist() == values
    assert end == len(lines) + 1
    some, end = samples(lines, 0, at_most=at_most)
    wanted = min(-(-at_most // per_line) * per_line, len(values))
    assert some.tolist() == values[:wanted]
    assert end == -(-wanted // per_line)


def test_samples_stop_at_the_line_that_is_wrong() -> None:
    lines = ["1.0 2.0"] * 700
    lines[600] = "1.0 2.O"
    found, end = samples(lines, 0)
    assert (len(found), end) == (1200, 600)


def test_the_longest_number_and_the_widest_column() -> None:
    for zeros, known in ((58, True), (59, False)):
        text = f"1.{'0' * zeros}"
        assert number(text) == (1.0 if known else None)
        assert numbers(f"2 {text}") == ([2.0, 1.0] if known else None)
        assert numbers(f"2 {text}", 70) == ([2.0, 1.0] if known else None)
    for line, width, result in (
        *(("12345678", 8, [12345678.0]), ("123456789", 8, [12345678.0, 9.0])),
        *(("123456789", None, [123456789.0]), ("1.3456789", 8, [1.3456789])),
        *(("1234 5678", 4, [1234.0, 5678.0]), ("12  34", 2, [12.0, 34.0]), ("12x4", 2, None)),
        *(("", 4, []), ("  ", 4, []), ("", None, []), ("1.5E+0031.5E+003", 8, [1500.0, 1500.0])),
    ):
        assert numbers(line, width) == result, (line, width)


def test_words_behind_the_last_sample_wanted() -> None:
    lines = ["1 2 3", "", "4 5 end", "6"]
    for at_most, values, end in (
        *((3, [1, 2, 3], 1), (4, [1, 2, 3, 4], 3), (5, [1, 2, 3, 4, 5], 3), (6, [1, 2, 3], 2)),
        *((1, [1, 2, 3], 1), (None, [1, 2, 3], 2), (0, [], 0)),
    ):
        result, at = samples(lines, 0, at_most=at_most)
        assert (result.tolist(), at) == (values, end), at_most
    assert samples(lines, 3)[0].tolist() == [6.0]
    assert samples(lines, 4)[1] == 4


def test_samples_of_many_lines_end_where_they_should() -> None:
    """Lines are read in blocks: the ends of blocks are no ends of samples."""
    for count in (1, 255, 256, 257, 511, 512, 513, 700):
        lines = [f"{at}.5 -{at}.25" for at in range(count)]
        whole = np.array([[at + 0.5, -at - 0.25] for at in range(count)]).ravel()
        for text in (lines, [*lines, "end"], [line.replace(" ", "") for line in lines]):
            for at_most in (None, 2 * count, 2 * count - 1, 2 * count + 1):
                result, end = samples(text, 0, at_most=at_most)
                np.testing.assert_array_equal(result, whole)
                assert end == count, (count, at_most)
        result, end = samples(lines, 1, at_most=2)
        assert (result.tolist(), end) == (whole[2:4].tolist(), min(2, max(count, 1)))
    for wrong in (100, 300):
        lines = ["1.5 2.5"] * 600
        lines[wrong] = "1.5 nan"
        result, end = samples(lines, 0)
        assert (len(result), end) == (2 * wrong, wrong)
