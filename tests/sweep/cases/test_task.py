"""A task: as far as a time lasts, call by call, and never less than one call."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.cases.task import LONG_ENOUGH, Task
from tests.every import every

GRID = Grid(axes=(Axis(name="a", values=np.arange(1000.0)),))
UNIT = 25.0 * LONG_ENOUGH
"""Seconds here, in which a call of 1/25 is long enough."""


def task_of(cases: Any, batch: int = 64) -> Task:
    outputs = (Output(name="double", dtype=np.float32),)
    return Task(cases=cases, grid=GRID, outputs=outputs, numbered=None, batch=batch)


@every(
    ("seconds_a_cell", "sizes"),
    [
        (0.0, [1, 8, 64, 64, 64]),
        (1 / 2048, [1, 8, 64, 64, 64]),
        (1 / 256, [1, 8, 16, 16, 16]),
        (1 / 128, [1, 2, 4, 8, 8]),
        (1 / 16, [1, 1, 1, 1, 1]),
    ],
)
def test_calls_grow_while_they_are_short(
    seconds_a_cell: float, sizes: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    called: list[int] = []
    monkeypatch.setattr(
        f"{Task.__module__}.time.monotonic", lambda: UNIT * seconds_a_cell * sum(called)
    )

    def double(a: NDArray[np.float64]) -> dict[str, Any]:
        called.append(len(a))
        return {"double": 2.0 * a}

    answer = task_of(double).run((10, 1000), 99.0 * UNIT)
    assert answer.stop == 1000
    assert called[:5] == sizes
    assert sum(called) == 990
    assert answer.arrays["double"].dtype == np.float32
    assert answer.arrays["double"].tolist() == list(range(20, 2000, 2))


@every(
    ("seconds_a_cell", "many", "sizes", "next_many"),
    [
        (1 / 256, 2, [2, 4, 8, 16, 16], 2),
        (1 / 256, 500, [64, 64], 8),
        (1 / 64, 32, [32, 1, 2], 1),
    ],
)
def test_a_job_begins_where_another_has_come_to(
    seconds_a_cell: float,
    many: int,
    sizes: list[int],
    next_many: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    called: list[int] = []
    monkeypatch.setattr(
        f"{Task.__module__}.time.monotonic", lambda: UNIT * seconds_a_cell * sum(called)
    )

    def double(a: NDArray[np.float64]) -> dict[str, Any]:
        called.append(len(a))
        return {"double": 2.0 * a}

    answer = task_of(double).run((0, sum(sizes)), 60.0 * UNIT, many)
    assert called == sizes
    assert answer.many == next_many


@every(("seconds", "calls"), [(0.0, 1), (1 / 16, 1), (3 / 16, 3), (0.2, 4)])
def test_slow_cells_are_left_to_others_when_the_time_is_over(
    seconds: float, calls: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    called: list[int] = []
    monkeypatch.setattr(f"{Task.__module__}.time.monotonic", lambda: UNIT * sum(called) / 16)

    def slow(a: NDArray[np.float64]) -> dict[str, Any]:
        called.append(len(a))
        return {"double": 2.0 * a}

    answer = task_of(slow).run((0, 1000), UNIT * seconds)
    assert called == [1] * calls
    assert answer.stop == calls
    assert answer.arrays["double"].tolist() == list(range(0, 2 * calls, 2))


@every(
    ("dtype", "value", "valid"),
    [
        (np.int8, np.array([200]), "must fit int8"),
        (np.uint8, np.array([-1]), "must fit uint8"),
        (np.float32, np.array([1e300]), "must fit float32"),
        (np.int8, np.ma.array([1], mask=[True]), "has no masks"),
    ],
)
def test_a_value_that_does_not_fit_is_refused(dtype: Any, value: Any, valid: str) -> None:
    task = Task(
        cases=lambda **_: {"x": value},
        grid=GRID,
        outputs=(Output(name="x", dtype=dtype),),
        numbered=None,
        batch=1,
    )
    with pytest.raises(InputError, match=valid):
        task.run((0, 1), 1.0)


@every(
    ("dtype", "value"),
    [(np.float32, 0.1), (np.float32, math.inf), (np.int8, np.int64(-128)), (np.float64, 2**53)],
)
def test_a_value_that_fits_is_converted(dtype: Any, value: Any) -> None:
    task = Task(
        cases=lambda **_: {"x": np.array([value])},
        grid=GRID,
        outputs=(Output(name="x", dtype=dtype),),
        numbered=None,
        batch=1,
    )
    assert task.run((0, 1), 1.0).arrays["x"].tolist() == [dtype(value).item()]
