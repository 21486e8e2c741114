"""What a launch writes into memory, and the order in which workers take cells."""

import ctypes
import math
import struct
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady.gpu._launch import (
    ALIGNED,
    STEPS,
    Launch,
    longest_first,
    queue_of,
)
from rocksteady.kernels.core import queue as kernels_queue
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1
from tests.every import every

DEVICE, ROOM = 10_000_000 * ALIGNED, 50_000_000 * ALIGNED
CELLS = 3
LENGTHS = st.floats(-1e100, 1e100) | st.sampled_from([math.nan, math.inf, -math.inf])


class Pair(NamedTuple):
    values: Floats1
    number: int


class Results(NamedTuple):
    status: Integers1
    final: Floats2


@dataclass(frozen=True)
class Form:
    queued: Any
    room: tuple[tuple[int, ...], ...] = ()
    shared: Any = None
    length: Any = None


def queued_mixed(
    queue: Integers1,
    small: Floats2,
    large: Floats3,
    table: Floats1,
    pair: Pair,
    flag: bool,
    scale: float,
    root: complex,
    results: Results,
) -> None:
    raise NotImplementedError


MIXED = Form(
    queued=queued_mixed,
    room=((4,), (3, 5)),
    shared=lambda pair, *_: (pair.values * 2.0,),
    length=lambda pair, *_: pair.values,
)


def mixed_arguments() -> tuple[Any, ...]:
    values = np.array([1.0, 3.0, 2.0])
    results = Results(np.full(CELLS, 7), np.full((CELLS, 2), 0.5))
    return Pair(values, 11), True, 0.25, 3.0 - 4.0j, results


class Memory:
    """Memory at an address that is aligned."""

    def __init__(self, size: int) -> None:
        self._block = (ctypes.c_uint8 * (size + ALIGNED))()
        self.address = -(-ctypes.addressof(self._block) // ALIGNED) * ALIGNED

    def array(self, place: int, shape: tuple[int, ...], dtype: Any = np.float64) -> NDArray[Any]:
        size = 8 * int(np.prod(shape))
        memory: Any = (ctypes.c_char * size).from_address(self.address + place)
        return np.ndarray(shape, dtype, memory)


def test_cells_and_arrays_are_laid_out_as_an_entry_of_the_library_takes_them() -> None:
    launch = Launch(queued_mixed, MIXED, mixed_arguments(), workers=64)
    memory = Memory(launch.size)
    launch.write(memory.address, DEVICE, ROOM)
    layout = struct.Struct("=2q3q4q2q2qq?7xddd2q3q")
    cells = layout.unpack(memory.array(0, (layout.size // 8,), np.int64).tobytes())
    addresses = {"queue": cells[0], "table": cells[9], "values": cells[11]}
    assert cells[1:9] == (CELLS + 2, ROOM, 64, 4, ROOM + 64 * 4 * 8, 64, 3, 5)
    assert cells[10] == cells[12] == CELLS
    assert cells[13:18] == (11, True, 0.25, 3.0, -4.0)
    status, final = cells[18], cells[20]
    assert cells[19] == CELLS
    assert cells[21:] == (CELLS, 2)
    arrays = [*addresses.values(), status, final]
    assert sorted(arrays) == arrays
    assert all(address % ALIGNED == 0 for address in arrays)
    assert launch.results == (status - DEVICE, launch.size - (status - DEVICE))
    assert launch.room_size == 64 * 4 * 8 + 64 * 15 * 8
    places = [address - DEVICE for address in arrays]
    assert memory.array(places[0], (5,), np.int64).tolist() == [0, 0, 1, 2, 0]
    assert memory.array(places[1], (3,)).tolist() == [2.0, 6.0, 4.0]
    assert memory.array(places[2], (3,)).tolist() == [1.0, 3.0, 2.0]
    assert memory.array(places[3], (3,), np.int64).tolist() == [7, 7, 7]
    assert memory.array(places[4], (3, 2)).tolist() == [[0.5, 0.5]] * 3


def test_results_alone_are_read_back() -> None:
    arguments = mixed_arguments()
    launch = Launch(queued_mixed, MIXED, arguments, workers=64)
    memory = Memory(launch.size)
    launch.write(memory.address, DEVICE, ROOM)
    everything = memory.array(0, (launch.size // 8,), np.int64)
    everything[launch.results[0] // 8 :] = [*range(5, 5 + launch.results[1] // 8)]
    everything[: launch.results[0] // 8] = -1
    launch.read(memory.address)
    assert arguments[0].values.tolist() == [1.0, 3.0, 2.0]
    assert arguments[4].status.tolist() == [5, 6, 7]
    assert arguments[4].final.view(np.int64).ravel().tolist() == [*range(37, 43)]


def test_arrays_without_elements_have_an_address_and_take_no_memory() -> None:
    def queued(queue: Integers1, results: Results) -> None:
        raise NotImplementedError

    form = Form(queued=queued)
    status, peaks = np.zeros(2, dtype=np.int64), np.empty((2, 0))
    launch = Launch(queued, form, (Results(status, peaks),), workers=64)
    memory = Memory(launch.size)
    launch.write(memory.address, DEVICE, ROOM)
    launch.read(memory.address)
    assert launch.results[1] == ALIGNED
    assert memory.array(0, (7,), np.int64).tolist()[5:] == [2, 0]
    assert launch.room_size == 0


@every(
    ("place", "wrong"),
    [
        ("status", np.zeros(CELLS, dtype=np.int32)),
        ("status", np.zeros((CELLS, 1), dtype=np.int64)),
        ("final", np.zeros((2, CELLS)).T),
        ("final", [[0.0, 0.0]] * CELLS),
    ],
)
def test_what_is_no_array_of_the_kernel_is_refused(place: str, wrong: Any) -> None:
    *others, results = mixed_arguments()
    arguments = (*others, results._replace(**{place: wrong}))
    with pytest.raises(TypeError, match="it must be a writable, C-contiguous array of"):
        Launch(queued_mixed, MIXED, arguments, workers=64)


def test_without_expected_lengths_cells_are_taken_in_order() -> None:
    form = Form(queued=queued_mixed)
    assert queue_of(form, mixed_arguments()).tolist() == [0, 0, 0, 1, 2]


@given(st.lists(LENGTHS, min_size=1, max_size=60))
def test_long_cells_are_taken_first(lengths: list[float]) -> None:
    order = longest_first(np.array(lengths))
    assert sorted(order.tolist()) == list(range(len(lengths)))
    finite = [length for length in lengths if np.isfinite(length)]
    low, high = (min(finite), max(finite)) if finite else (0.0, 0.0)
    step = (high - low) / STEPS
    taken = np.nan_to_num(np.array(lengths)[order], nan=high, posinf=high, neginf=low)
    assert (np.diff(taken) <= 2.0 * step).all()


def test_cells_of_one_length_stay_in_order() -> None:
    assert longest_first(np.array([2.0, 5.0, 2.0, 5.0, 2.0])).tolist() == [1, 3, 0, 2, 4]
    assert longest_first(np.full(300, 4.0)).tolist() == list(range(300))


def test_a_queue_is_laid_out_as_kernels_read_it() -> None:
    plain = Form(queued=queued_mixed)
    made = queue_of(plain, ((np.zeros(CELLS),),))
    assert np.array_equal(made, kernels_queue.queue_of(CELLS))
    assert len(made) == kernels_queue.HEAD + CELLS
