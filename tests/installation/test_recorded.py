"""Files of recorded calls: what is written is read again, and each differing bit is found."""

import gzip
import struct
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.installation._recorded import (
    Call,
    Difference,
    arguments_of,
    differences,
    dumped,
    flat,
    loaded,
    recorded,
    replayed,
    save,
)
from tests.every import every

Floats = NDArray[np.float64]
QUIET, OTHER = (
    np.array([bits], dtype=np.uint64).view(np.float64)[0]
    for bits in (0x7FF8000000000000, 0xFFF8000000000123)
)
"""Two NaN of other bits."""


class Pair(NamedTuple):
    one: int
    other: float


class Nest(NamedTuple):
    pair: Pair
    both: tuple[float, float]


def doubled(nest: Nest, flag: bool, values: Floats) -> tuple[float, Pair, complex]:
    """Be a kernel: fill an array, return numbers."""
    assert isinstance(nest.pair, Pair)
    assert isinstance(flag, bool)
    values *= 2.0
    return nest.both[1], Pair(nest.pair.one + 1, nest.pair.other), complex(1.0, -2.0)


def arguments() -> tuple[Any, ...]:
    return Nest(Pair(3, 0.5), (1.5, 2.5)), True, np.array([[1.0, -0.0], [np.inf, 0.25]])


def a_call() -> Call:
    return recorded("doubled", doubled, arguments())[0]


def test_a_record_holds_flat_arguments_before_and_after_and_flat_results() -> None:
    call, result = recorded("doubled", doubled, arguments())
    assert call.before[:6] == (3, 0.5, 1.5, 2.5, 1, call.before[5])
    np.testing.assert_array_equal(call.before[5], [[1.0, -0.0], [np.inf, 0.25]])
    np.testing.assert_array_equal(call.after[5], [[2.0, -0.0], [np.inf, 0.5]])
    assert call.results == (2.5, 4, 0.5, 1.0, -2.0)
    assert result == (2.5, Pair(4, 0.5), 1.0 - 2.0j)


def test_arguments_are_put_together_as_the_annotations_have_them() -> None:
    given = arguments()
    again = arguments_of(doubled, flat(given))
    assert again[:2] == list(given[:2])
    assert type(again[0].pair) is Pair
    # A whole number for a float, as Python callers may pass it, is a float in the record.
    assert recorded("doubled", doubled, (Nest(Pair(3, 1), (1, 2)), 1, np.ones((1, 1))))[0].before[
        1:4
    ] == (1.0, 1.0, 2.0)
    assert (
        type(arguments_of(doubled, flat((Nest(Pair(3, 1), (1, 2)), 1, 0)))[0].pair.other) is float
    )


def test_the_bytes_are_as_documented() -> None:
    call = Call(
        "march", (7, -0.5, np.array([True, False])), (7, -0.5, np.array([True, True])), (2,)
    )
    numbers = struct.pack("<qq qd", 0, 7, 1, -0.5)
    array = struct.pack("<qqq8sq8s", 4, 1, 2, b"\1\0", 1, b"\1\1")
    expected = struct.pack("<8sqq8sq", b"RSCALLS1", 1, 5, b"march", 3) + numbers + array
    assert dumped([call]) == expected + struct.pack("<qqq", 1, 0, 2)


def drawn_calls(rng: np.random.Generator) -> list[Call]:
    calls = []
    for name in ("a", "exactly8", "longer_than_8"):
        shapes = [tuple(rng.integers(0, 4, size)) for size in (1, 2, 3)]
        reals = rng.normal(size=shapes[2])
        reals[rng.random(reals.shape) < 0.3] = np.nan
        arrays = [rng.random(shapes[0]) < 0.5, rng.integers(-9, 9, shapes[1]), reals]
        after = [arrays[0], arrays[1] + 1, arrays[2].copy()]
        numbers = (2**62, -1, 5e-324, float(-np.inf))
        calls.append(Call(name, (*numbers, *arrays), (*numbers, *after), numbers))
    return calls


@every("seed", range(5))
def test_what_is_written_is_read_again(seed: int, tmp_path: Path) -> None:
    calls = drawn_calls(np.random.default_rng(seed))
    for compress in (False, True):
        save(tmp_path / "file", calls, compress=compress)
        again = loaded((tmp_path / "file").read_bytes())
        assert [call.entry for call in again] == [call.entry for call in calls]
        for one, other in zip(calls, again, strict=True):
            assert one.results == other.results
            for a, b in zip((*one.before, *one.after), (*other.before, *other.after), strict=True):
                assert np.asarray(a).dtype == np.asarray(b).dtype
                np.testing.assert_array_equal(a, b)
                assert not isinstance(b, np.ndarray) or b.flags.carray
    assert gzip.decompress((tmp_path / "file").read_bytes()) == dumped(calls)


@every("content", [b"", b"RSCALLS", b"\x1f\x8bjunk", dumped([a_call()])[:-8]])
def test_another_file_and_a_part_of_one_are_refused(content: bytes) -> None:
    with pytest.raises((ValueError, gzip.BadGzipFile, EOFError)):
        loaded(content)


def test_a_call_made_again_is_the_same_and_leaves_its_record_alone() -> None:
    call = a_call()
    assert differences(call, replayed(call, doubled)) == (14, 0, None)
    assert differences(call, replayed(call, doubled)) == (14, 0, None)


@every(
    ("recorded_value", "computed", "differs"),
    [
        (1.0, 1.0, False),
        (1.0, np.nextafter(1.0, 2.0), True),
        (0.0, -0.0, True),
        (np.nan, 1.0, True),
        (QUIET, OTHER, False),
        (np.inf, np.inf, False),
        (3, 3, False),
        (3, 4, True),
        (True, False, True),
    ],
)
def test_values_differ_by_any_bit_but_those_of_a_nan(
    recorded_value: Any, computed: Any, differs: bool
) -> None:
    values = np.array([5, recorded_value, 5], dtype=np.asarray(recorded_value).dtype)
    others = values.copy()
    others[1] = computed
    one, other = (Call("k", (0,), (0,), (array[1].item(),)) for array in (values, others))
    count = int(differs)
    assert differences(one, other)[:2] == (2, count)
    found = differences(Call("k", (), (values,), ()), Call("k", (), (others,), ()))
    first = Difference(0, (1,), values[1].item(), others[1].item())
    # As texts: a NaN equals none.
    assert repr(found) == repr((3, count, first if differs else None))


def test_the_first_difference_is_named_and_all_are_counted() -> None:
    one = np.arange(6.0).reshape(2, 3)
    other = one.copy()
    other[1, 1:] += 1.0
    found = differences(Call("k", (), (1, one), (2.0,)), Call("k", (), (1, other), (3.0,)))
    assert found == (8, 3, Difference(1, (1, 1), 4.0, 5.0))
