"""Cells left over by a device: in threads they are what one call of the kernel makes of them."""

from typing import Any, NamedTuple

import numpy as np
import pytest

from bench.gpu.work import classes, work
from rocksteady.dynamics.batch.left_over import PARTS, in_threads, run_left_over
from rocksteady.kernels.batch.attractors import settle_cells
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.machine_code.device import on_device

CELLS = 40


class Numbers(NamedTuple):
    numbers: Any


class Nowhere:
    """A device that is never called."""

    def run(self, form: object, arguments: tuple[Any, ...]) -> None:
        raise AssertionError(form, arguments)


@pytest.mark.parametrize(
    ("name", "kernel"), [("settle_cells", settle_cells), ("record_fates", record_fates)]
)
@pytest.mark.parametrize("device", [False, True])
def test_threads_give_what_one_call_gives(name: str, kernel: Any, device: bool) -> None:
    whole, parts = work(name, CELLS, 3), work(name, CELLS, 3)
    kernel(*whole)
    for each in parts[-1]:
        each[...] = -7
    if device:
        with on_device(Nowhere()):
            run_left_over(kernel, *parts)
    else:
        run_left_over(kernel, *parts)
    assert len(set(classes(whole).tolist())) > 1 or name == "record_fates"
    for one, other in zip(parts[-1], whole[-1], strict=True):
        np.testing.assert_array_equal(one, other)


def test_each_cell_is_given_to_one_call() -> None:
    calls: list[int] = []

    def kernel(shared: Any, cells: Any, results: Any) -> None:
        assert shared == 5
        calls.append(len(results[0]))
        results.numbers[...] = cells.numbers

    for count in (0, 1, 2, 3 * PARTS, 1000):
        calls.clear()
        results = Numbers(np.zeros(count))
        in_threads(kernel, (5, Numbers(np.arange(float(count))), results), 2)
        assert results.numbers.tolist() == list(range(count))
        assert sum(calls) == count
        assert len(calls) == min(2 * PARTS, count)
