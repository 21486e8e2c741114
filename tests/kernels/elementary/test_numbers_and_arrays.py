"""One number and an array of them: the same bits, whatever shape, type and memory they have."""

import subprocess
import sys

import numpy as np
import pytest

from rocksteady.kernels.elementary import arrays
from tests.every import every

OF_ONE = (
    *("exp", "expm1", "log", "log1p", "sin", "cos", "tan", "asin", "acos", "atan"),
    *("sinh", "cosh", "tanh", "asinh", "next_up"),
)
OF_TWO = ("atan2", "hypot")
NUMBERS = np.concatenate([np.random.default_rng(3).uniform(-1.0, 1.0, 200), [0.0, -0.0, 1e-310]])
OTHERS = NUMBERS[::-1] * 30.0


@every("name", OF_ONE)
def test_a_function_of_one_number(name: str) -> None:
    function = getattr(arrays, name)
    for given in (NUMBERS, *([] if name in {"asin", "acos"} else [OTHERS])):
        expected = [function(number) for number in given.tolist()]
        assert {type(number) for number in expected} == {float}
        np.testing.assert_array_equal(function(given), expected)


@pytest.mark.parametrize("name", OF_TWO)
def test_a_function_of_two_numbers(name: str) -> None:
    function = getattr(arrays, name)
    pairs = zip(NUMBERS.tolist(), OTHERS.tolist(), strict=True)
    np.testing.assert_array_equal(function(NUMBERS, OTHERS), [function(*pair) for pair in pairs])
    table = function(NUMBERS[:5, np.newaxis], OTHERS[:3])
    assert table.shape == (5, 3)
    assert table[4, 2] == function(float(NUMBERS[4]), float(OTHERS[2]))
    np.testing.assert_array_equal(
        function(NUMBERS, 0.5)[:9], function(NUMBERS[:9], np.full(9, 0.5))
    )


def test_any_memory_will_do() -> None:
    expected = arrays.sin(np.arange(12.0)).reshape(3, 4)
    whole = np.arange(12).reshape(3, 4)
    frozen = np.arange(12.0).reshape(3, 4)
    frozen.flags.writeable = False
    for given in (
        whole,
        frozen,
        np.asfortranarray(frozen),
        np.arange(24.0)[::2].reshape(3, 4) / 2.0,
    ):
        np.testing.assert_array_equal(arrays.sin(given), expected)
    sine, cosine = arrays.sincos(frozen)
    np.testing.assert_array_equal((sine, cosine), (expected, arrays.cos(frozen)))
    assert arrays.sincos(3) == (expected[0, 3], arrays.cos(3.0))
    assert arrays.exp(np.array(1.0)).shape == ()


def test_the_first_import_loads_nothing() -> None:
    code = (
        "import sys, rocksteady.kernels.elementary.arrays\n"
        "print({'numpy', 'numba', 'llvmlite'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
