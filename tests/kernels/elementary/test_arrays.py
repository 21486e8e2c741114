"""The functions for callers in Python: types, shapes, and the same bits as plain Python's."""

import inspect
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.elementary import (
    arrays,
    circular,
    exponential,
    hyperbolic,
    inverse,
    lengths,
    logarithm,
    loops,
)
from tests.every import every
from tests.kernels.elementary.oracle import BOUNDS, SPECIAL, any_float, bits, plain, spread

MODULES = (exponential, logarithm, circular, inverse, hyperbolic, lengths)
NAMES = [name.removeprefix("fill_") for name in vars(loops) if name.startswith("fill_")]
TWO = ("atan2", "hypot")
ONE = [name for name in NAMES if name not in TWO]


def kernel_of(name: str) -> Any:
    return next(getattr(module, name) for module in MODULES if hasattr(module, name))


def test_each_function_has_a_loop_and_a_bound() -> None:
    offered = {
        name
        for name, one in inspect.getmembers(arrays, inspect.isfunction)
        if one.__module__ == arrays.__name__ and not name.startswith("_")
    }
    assert offered == {*NAMES, "sincos"}  # which takes the loops of its two parts
    assert set(BOUNDS) == set(NAMES) - {"next_up"}
    assert len(NAMES) == 17


def drawn() -> Any:
    rng = np.random.default_rng(14)
    wide = [any_float(rng, 300), spread(1e-17, 1e5)(rng, 700), rng.uniform(-1.0, 1.0, 700)]
    return np.concatenate([*wide, np.array(SPECIAL)])


@every("name", ONE)
def test_plain_python_gives_the_bits_of_machine_code(name: str) -> None:
    x = drawn()
    function = plain(kernel_of(name))
    assert bits(getattr(arrays, name)(x)) == bits([function(each) for each in x.tolist()])


@pytest.mark.parametrize("name", TWO)
def test_plain_python_gives_the_bits_of_machine_code_of_two(name: str) -> None:
    x = drawn()
    y = np.random.default_rng(15).permutation(x)
    function = plain(kernel_of(name))
    found = [function(*pair) for pair in zip(x.tolist(), y.tolist(), strict=True)]
    assert bits(getattr(arrays, name)(x, y)) == bits(found)


@every("name", ONE)
def test_a_number_gives_a_number_and_an_array_an_array(name: str) -> None:
    function = getattr(arrays, name)
    for one in (0.75, np.float64(0.75), np.float32(0.75)):
        assert type(function(one)) is float
        assert function(one) == function(0.75)
    assert type(function(1)) is float
    table = np.linspace(0.1, 0.9, 24).reshape(2, 3, 4)
    for given in (table, table.transpose(2, 0, 1), table[:, ::2, 1:], table.astype(np.float32)):
        found = function(given)
        assert found.dtype == np.float64
        assert found.shape == given.shape
        assert found.ravel().tolist() == [function(float(x)) for x in given.ravel()]
    assert function(np.array([1, 0, 1])).tolist() == [function(n) for n in (1, 0, 1)]
    assert function(np.zeros((0, 3))).shape == (0, 3)
    assert function(np.array(0.5)).shape == ()


@pytest.mark.parametrize("name", TWO)
def test_two_arguments_are_broadcast(name: str) -> None:
    function = getattr(arrays, name)
    assert type(function(1, np.float64(0.5))) is float
    rows, columns = np.arange(1.0, 4.0)[:, np.newaxis], np.arange(5)
    found = function(rows, columns)
    assert found.shape == (3, 5)
    assert found.tolist() == [[function(y, x) for x in range(5)] for y in (1.0, 2.0, 3.0)]
    assert function(rows, 2.0).shape == function(2.0, rows).shape == (3, 1)
    with pytest.raises(ValueError, match="broadcast"):
        function(np.ones(2), np.ones(3))
