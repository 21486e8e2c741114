"""Spreads: SciPy's distributions as the oracle, and texts that say what they mean."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from rocksteady.errors import InputError
from rocksteady.risk.observations.spread import PriorRange
from tests.every import every

SHARES = np.linspace(0.0, 1.0, 41)


def test_a_uniform_spread_is_that_of_scipy() -> None:
    spread = PriorRange.parse("0.6:1.0")
    oracle = stats.uniform(0.6, 0.4)
    np.testing.assert_allclose(spread.quantile(SHARES), oracle.ppf(SHARES), rtol=1e-15)
    wide = PriorRange.parse("log:0.03:1.2")
    exact = stats.loguniform(0.03, 1.2).ppf(SHARES)
    np.testing.assert_allclose(wide.quantile(SHARES), exact, rtol=1e-12)
    assert [wide.quantile(end) for end in (0.0, 1.0)] == [0.03, 1.2]
    assert wide.middle == pytest.approx(0.036**0.5)
    assert wide.within("base", 0.01, 1.5) is wide
    for low, high in ((0.04, 1.5), (0.01, 1.0)):
        with pytest.raises(InputError, match="base = "):
            wide.within("base", low, high)


@every(
    ("mean", "sd", "low", "high"),
    [(0.4, 0.05, 0.0, 1.0), (0.02, 0.05, 0.0, 1.0), (0.9, 0.4, 0.05, 1.0), (3.0, 1e-3, 2.5, 3.5)],
)
def test_a_normal_spread_is_cut_off_as_that_of_scipy(
    mean: float, sd: float, low: float, high: float
) -> None:
    spread = PriorRange.around(mean, sd).within("base", low, high)
    oracle = stats.truncnorm((low - mean) / sd, (high - mean) / sd, mean, sd)
    np.testing.assert_allclose(spread.quantile(SHARES), oracle.ppf(SHARES), rtol=1e-8, atol=1e-9)


def test_far_tails_of_a_normal_spread_are_exact_on_both_sides() -> None:
    spread = PriorRange.around(0.0, 1.0)
    tiny = 1e-15
    assert spread.quantile(tiny) == pytest.approx(stats.norm.ppf(tiny), rel=1e-9)
    upper = PriorRange.around(0.0, 1.0, low=0.0).quantile(1.0 - 2.0**-50)
    assert upper == pytest.approx(stats.norm.isf(2.0**-51), rel=1e-9)


@given(
    mean=st.floats(-3.0, 3.0), sd=st.floats(0.05, 3.0), below=st.floats(0, 3), above=st.floats(0, 3)
)
def test_quantiles_rise_from_bound_to_bound(
    mean: float, sd: float, below: float, above: float
) -> None:
    spread = PriorRange.around(mean, sd, low=mean - below - 0.1, high=mean + above + 0.1)
    values = spread.quantile(SHARES)
    assert (np.diff(values) > 0.0).all()
    assert spread.low <= values[0] <= values[-1] <= spread.high


@every(
    ("text", "numbers"),
    [
        ("0.25", (0.25, 0.25, None, None)),
        (" -1e-2 ", (-0.01, -0.01, None, None)),
        ("0.6:1", (0.6, 1.0, None, None)),
        (" log:.03 : 1.2 ", (0.03, 1.2, None, None)),
        ("-.1 : .1", (-0.1, 0.1, None, None)),
        ("0.4+-0.05", (-math.inf, math.inf, 0.4, 0.05)),
        ("0.4 ± 0.05", (-math.inf, math.inf, 0.4, 0.05)),
        ("4e-1+/-5e-2", (-math.inf, math.inf, 0.4, 0.05)),
    ],
)
def test_a_text_is_read_and_written_again(text: str, numbers: tuple[float, ...]) -> None:
    spread = PriorRange.parse(text)
    assert (spread.low, spread.high, spread.mean, spread.sd) == numbers
    assert spread.logarithmic == ("log" in text)
    assert PriorRange.parse(str(spread)) == spread


@every(
    ("text", "line"),
    [
        ("", "it must be a number, a range as 0.3:0.5 or log:0.03:1.2, or mean"),
        ("0,25", "write a point for a decimal comma"),
        ("0.3 m", "leave units out"),
        ("0.5:0.3", "low: it must not be above high = 0.3; exchange the two"),
        ("0.3:0.4:0.5", "it must be a number"),
        ("log:0.3", "it must be a number"),
        ("log:0.3+-0.1", "it must be a number"),
        ("log:0:1", "low: a range in the logarithm lies above 0; give bounds above 0"),
        ("0.4+-0", "sd: it must be a finite number above 0"),
        ("0.4+--0.1", "sd: it must be a finite number above 0"),
        ("nan", "it must be a number"),
        ("inf", "it must be a number"),
        ("1_000", "it must be a number"),
        ("0x10", "it must be a number"),
        ("1e999", "it must lie in"),
        ("9" * 5000, "it must be a number"),
        ("9" * 150, "it must lie in"),
        ("٣", "it must be a number"),
    ],
)
def test_a_text_that_is_none_is_refused_in_one_line(text: str, line: str) -> None:
    with pytest.raises(InputError) as refusal:
        PriorRange.parse(text, name="base")
    assert str(refusal.value).startswith("base = ")
    assert line in str(refusal.value)
    assert len(str(refusal.value)) < 400


def test_what_is_impossible_is_cut_off_a_normal_spread_and_refused_of_others() -> None:
    cut = PriorRange.parse("0.9+-0.2").within("base", 0.05, 1.0)
    assert (cut.low, cut.high) == (0.05, 1.0)
    for text in ("0.9:1.2", "1.2", "1.2+-0.2"):
        with pytest.raises(InputError, match=r"base = 1\.2 is not valid: it must lie in \[0\.05"):
            PriorRange.parse(text).within("base", 0.05, 1.0)


def test_a_value_without_spread_has_all_its_mass_there() -> None:
    spread = PriorRange.exactly(0.3)
    assert spread.fixed
    assert spread.quantile([0.0, 0.4, 1.0]).tolist() == [0.3] * 3


@every("share", [-0.1, 1.1, math.nan])
def test_a_share_lies_between_0_and_1(share: float) -> None:
    with pytest.raises(InputError, match="uniforms"):
        PriorRange.between(0.0, 1.0).quantile([0.5, share])


def test_texts_of_spreads_and_what_they_say() -> None:
    for text, spread, middle, fixed in (
        ("0.3", PriorRange.exactly(0.3), 0.3, True),
        ("-0.0", PriorRange.exactly(0.0), 0.0, True),
        ("0.3:0.5", PriorRange.between(0.3, 0.5), 0.4, False),
        ("0.3:0.3", PriorRange.exactly(0.3), 0.3, True),
        (" 0.4 +- 0.1 ", PriorRange.around(0.4, 0.1), 0.4, False),
        ("0.4±0.1", PriorRange.around(0.4, 0.1), 0.4, False),
        ("0.4+/-0.1", PriorRange.around(0.4, 0.1), 0.4, False),
        ("1e50", PriorRange.exactly(1e50), 1e50, True),
        ("1" + "0" * 50 + " " * 149, PriorRange.exactly(1e50), 1e50, True),
    ):
        result = PriorRange.parse(text)
        assert result == spread, text
        assert result.middle == pytest.approx(middle)
        assert result.fixed == fixed
        assert PriorRange.parse(str(result)) == result
        assert repr(result) == f"<Spread {result}>"
    for text, words in (
        ("0,3", "write a point for a decimal comma"),
        ("0.3 m", "leave units out"),
        ("0.3:", "leave units out"),
        ("Housner*0.9", "give a factor of Housner's value as housner_factor, 1 for the value its"),
        ("0.5:0.3", "low: it must not be above high = 0.3; exchange the two"),
        ("0.5+-0", "sd: it must be"),
        ("1.1e50", "give numbers of usual size"),
        ("1" + "0" * 50 + " " * 150, "leave units out"),
    ):
        with pytest.raises(InputError, match=f"^size = .*{re.escape(words)}"):
            PriorRange.parse(text, name="size")
    for wrong, words in (
        ({"low": 0.0, "high": 1.0, "mean": 1.1, "sd": 0.1}, "it must lie in [0, 1], which is wha"),
        ({"low": 0.0, "high": 1.0, "mean": -0.1, "sd": 0.1}, "it must lie in [0, 1], which is wh"),
        ({"low": 1.0, "high": 1.0, "mean": 1.0, "sd": 0.1}, "it must lie in [1, 1], which is wha"),
        ({"low": -math.inf, "high": 1.0}, "low = -inf"),
        ({"low": 0.0, "high": 1.0, "mean": 0.5}, "sd = None"),
        ({"low": 0.0, "high": 1.0, "sd": 0.5}, "mean = None"),
        ({"low": 0.1, "high": 1.0, "mean": 0.5, "sd": 0.1, "logarithmic": True}, "lies above 0"),
    ):
        with pytest.raises(InputError, match=re.escape(words)):
            PriorRange(**wrong)  # type: ignore[arg-type]
    for ends in (0.0, 1.0):
        assert PriorRange(low=0.0, high=1.0, mean=ends, sd=0.1).middle == ends


def test_a_spread_inside_what_is_possible() -> None:
    for spread, low, high, expected in (
        (PriorRange.between(0.3, 0.5), 0.3, 0.5, PriorRange.between(0.3, 0.5)),
        (PriorRange.around(0.4, 0.1), 0.3, 0.5, PriorRange.around(0.4, 0.1, low=0.3, high=0.5)),
        (
            PriorRange.around(0.4, 0.1, low=0.35, high=0.9),
            *(0.3, 0.5, PriorRange.around(0.4, 0.1, low=0.35, high=0.5)),
        ),
        (PriorRange.around(0.5, 0.1), 0.3, 0.5, PriorRange.around(0.5, 0.1, low=0.3, high=0.5)),
    ):
        assert spread.within("x", low, high) == expected
    for spread in (
        *(PriorRange.between(0.29, 0.4), PriorRange.between(0.4, 0.51), PriorRange.exactly(0.6)),
        PriorRange.around(0.51, 0.1),
    ):
        with pytest.raises(InputError, match=r"^x = .*; give a number from 0\.3 to 0\.5"):
            spread.within("x", 0.3, 0.5)
    exact = PriorRange.exactly(0.3)
    assert exact.quantile([0.0, 0.5, 1.0]).tolist() == [0.3, 0.3, 0.3]
    for wrong in (-0.01, 1.01, math.nan):
        with pytest.raises(InputError, match="uniforms"):
            exact.quantile([0.5, wrong])
