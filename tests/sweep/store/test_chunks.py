"""Chunks: boxes that tile a grid, and ranges of cells that follow each other."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.sweep.store.chunks import FEWEST, MOST, USUAL, Chunks, suitable

SHAPES = st.lists(st.integers(1, 9), min_size=1, max_size=4).map(tuple)


@given(shape=SHAPES, cells=st.integers(1, 300))
def test_chunks_are_boxes_and_ranges_of_all_cells_in_their_order(
    shape: tuple[int, ...], cells: int
) -> None:
    numbers = np.arange(math.prod(shape)).reshape(shape)
    chunks = Chunks.of(shape, cells)
    after = 0
    for chunk in range(len(chunks)):
        first, stop = chunks.cells(chunk)
        assert first == after
        assert numbers[chunks.region(chunk)].ravel().tolist() == list(range(first, stop))
        assert stop - first <= cells
        assert {chunks.containing(cell) for cell in range(first, stop)} == {chunk}
        after = stop
    assert after == numbers.size


@given(shape=SHAPES, cells=st.integers(1, 300))
def test_no_chunk_could_be_twice_as_long_along_its_axis(shape: tuple[int, ...], cells: int) -> None:
    chunks = Chunks.of(shape, cells)
    partial = [axis for axis in range(len(shape)) if 1 < chunks.box[axis] < shape[axis]]
    assert len(partial) <= 1
    if len(chunks) > 1:
        (axis,) = partial or [max(a for a in range(len(shape)) if chunks.box[a] < shape[a])]
        longer = chunks.box[axis] + 1
        assert math.prod(chunks.box) // chunks.box[axis] * longer > cells


def test_a_grid_is_written_in_some_dozens_of_chunks_of_a_suitable_size() -> None:
    assert suitable(1) == FEWEST
    assert suitable(10**8) == USUAL
    assert suitable(10**9) == 244_141
    assert suitable(10**12) == MOST
    assert [len(Chunks.of(shape)) for shape in ((20, 30), (1000, 1000), (5000, 5000))] == [
        1,
        67,
        385,
    ]


def test_of_slow_cells_a_chunk_has_no_more_than_one_call_takes_or_a_64th_of_all() -> None:
    assert Chunks.of((120,), batch=4).box == (4,)
    assert Chunks.of((1000,), batch=4).box == (16,)
    assert Chunks.of((120,), batch=100_000).box == Chunks.of((120,)).box == (120,)
    assert Chunks.of((1000, 1000), batch=256).box == Chunks.of((1000, 1000)).box
