"""Logarithms: errors in ulp, special values, rise where the parts meet."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from rocksteady.kernels.elementary.logarithm import LOG2_DOUBT, low_log2
from tests.kernels.elementary.oracle import (
    COUNT,
    MANY,
    SPECIAL,
    any_float,
    around,
    check,
    positive,
    same_as_math,
    spread,
    uniform,
)

LOG: list[Any] = [positive(any_float), uniform(0.5, 2.0), uniform(0.999, 1.001)]
LOG1P: list[Any] = [uniform(-0.5, 0.5), uniform(-0.999, 10.0), positive(spread(1e-17, 1e17))]


def test_errors_of_log() -> None:
    check("log", LOG, COUNT)


def test_errors_of_the_log_of_subnormal_numbers() -> None:
    check("log", [positive(spread(1e-320, 2e-308))], COUNT // 10)


def test_errors_of_log1p() -> None:
    check("log1p", LOG1P, COUNT)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "draws"), [("log", LOG), ("log1p", LOG1P)])
def test_errors_on_many(name: str, draws: list[Any]) -> None:
    check(name, draws, MANY)


@pytest.mark.parametrize("x", SPECIAL)
@pytest.mark.parametrize("name", ["log", "log1p"])
def test_special_values(name: str, x: float) -> None:
    assert same_as_math(name, x)


@pytest.mark.parametrize("point", [math.sqrt(0.5), 1.0, math.sqrt(2.0), 2.0, 2.0**-1022, 2.0**40])
def test_log_rises_where_its_parts_meet(point: float) -> None:
    assert (np.diff(arrays.log(around(point))) >= 0.0).all()


@pytest.mark.parametrize("point", [2.0**-54, math.sqrt(2.0) - 1.0, 1.0, 2.0])
def test_log1p_rises_where_its_parts_meet(point: float) -> None:
    assert (np.diff(arrays.log1p(around(point))) >= 0.0).all()


def test_powers_of_two_have_whole_multiples_of_one_logarithm() -> None:
    for k in range(-1074, 1024):
        assert arrays.log(2.0**k) == pytest.approx(k * math.log(2.0), rel=2.3e-16)


def test_the_rough_logarithm_is_a_lower_bound() -> None:
    x = np.exp(np.random.default_rng(4).uniform(-700.0, 700.0, 1000))
    lack = np.log2(x) - np.array([low_log2(each) for each in x.tolist()])
    assert lack.min() > -1e-12
    assert 0.08 < lack.max() <= LOG2_DOUBT
    assert low_log2(0.0) == -1023.0
    assert low_log2(8.0) == 3.0
