"""Arrays that are read where they are used: any part of them is that part of the whole."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
import zarr
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from xarray.core.indexing import LazilyIndexedArray

from rocksteady.errors import InputError
from rocksteady.sweep.store._lazy import Computed, Stored
from rocksteady.sweep.store.chunks import Chunks
from tests.sweep.indices import indexers

SHAPE = (7, 5, 3)
NAMES = ("length", "number", "word")
CHUNKS = Chunks.of(SHAPE, 6)
COMPLETE = np.arange(len(CHUNKS)) % 3 != 1
VALUES = np.random.default_rng(1).normal(size=SHAPE)


def known() -> NDArray[np.bool_]:
    """Return which cells have been computed, chunk by chunk."""
    whole = np.zeros(SHAPE, dtype=np.bool_)
    for chunk in np.flatnonzero(COMPLETE).tolist():
        whole[CHUNKS.region(chunk)] = True
    return whole


@cache
def in_memory(fill: float) -> Any:
    return zarr.create_array({}, data=VALUES, chunks=CHUNKS.box, fill_value=fill)


@given(index=st.tuples(*map(indexers, SHAPE)))
def test_any_part_of_an_unfinished_store_knows_what_it_has(index: tuple[Any, ...]) -> None:
    array = xarray.Variable(NAMES, known())
    lazy = xarray.Variable(NAMES, LazilyIndexedArray(Computed(CHUNKS, COMPLETE)))
    assert np.array_equal(lazy[index].values, array[index].values)


@given(index=st.tuples(*map(indexers, SHAPE)), fill=st.sampled_from([np.nan, -7.0]))
def test_what_is_not_computed_is_the_fill_value_whatever_the_file_holds(
    index: tuple[Any, ...], fill: float
) -> None:
    stored = Stored(Path("a"), "value", in_memory(fill), Computed(CHUNKS, COMPLETE))
    lazy = xarray.Variable(NAMES, LazilyIndexedArray(stored))
    whole = xarray.Variable(NAMES, np.where(known(), VALUES, fill))
    np.testing.assert_array_equal(lazy[index].values, whole[index].values)
    assert lazy.dtype == np.float64


@given(st.lists(st.tuples(*(st.integers(-n, n - 1) for n in SHAPE)), min_size=1, max_size=5))
def test_points_are_read_one_by_one(points: list[tuple[int, ...]]) -> None:
    columns = tuple(xarray.Variable("point", list(one)) for one in zip(*points, strict=True))
    for computed, whole in (
        (None, VALUES),
        (Computed(CHUNKS, COMPLETE), np.where(known(), VALUES, np.nan)),
    ):
        stored = Stored(Path("a"), "value", in_memory(np.nan), computed)
        found = xarray.Variable(NAMES, LazilyIndexedArray(stored))[columns]
        np.testing.assert_array_equal(found.values, [whole[point] for point in points])


@pytest.mark.parametrize("error", [OSError(5, "input/output\n error"), ValueError("it is damaged")])
def test_what_cannot_be_read_is_one_line_with_the_way_out(error: Exception) -> None:
    class Broken:
        shape, dtype = SHAPE, np.dtype(np.float64)

        @property
        def oindex(self) -> Any:
            raise error

    with pytest.raises(InputError) as refused:
        Stored(Path("a.zarr"), "value", Broken(), None).outer((0, 0, 0))
    line = str(refused.value)
    assert "\n" not in line
    assert "value cannot be read: " in line
    assert line.endswith("resume its sweep: chunks that are damaged are computed again")
