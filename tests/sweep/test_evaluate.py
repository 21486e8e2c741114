"""The loop over cases: any executor, workers and chunks give the same; nothing is swallowed."""

import concurrent.futures
import functools
import json
import re
import signal
import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import rocksteady
from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from tests.every import every

Floats = NDArray[np.float64]
Found = dict[str, NDArray[Any]]

GRID = Grid(
    axes=(
        Axis(name="a", values=np.linspace(0.1, 3.0, 7), units="rad", long_name="an angle"),
        Axis(name="b", values=[5.0, 1.0, 2.0]),
        Axis(name="c", values=np.arange(4)),
    )
)
OUTPUTS = (
    Output(name="sum", long_name="a sum", units="m"),
    Output(name="sign", dtype=np.int8, flags={-1: "negative", 0: "zero", 1: "positive"}),
)


def some(a: Floats, b: Floats, c: Floats, *, factor: float = 1.0) -> Found:
    total = factor * np.sin(a) * b - c
    return {"sum": total, "sign": np.sign(total).astype(np.int8), "more": total}


def failing(a: Floats, b: Floats, c: Floats) -> Found:
    if (c == 3.0).any() and a[0] > 1.0:
        raise ZeroDivisionError("as it happens")
    return some(a, b, c)


@pytest.fixture(scope="module")
def reference() -> Found:
    a, b, c = np.meshgrid(*(axis.points for axis in GRID.axes), indexing="ij")
    return some(a, b, c)


@given(
    executor=st.sampled_from(["threads", "serial"]),
    workers=st.integers(1, 5),
    batch=st.integers(1, 100),
)
def test_it_is_the_function_over_the_whole_grid_for_every_executor_and_batch(
    executor: str, workers: int, batch: int
) -> None:
    a, b, c = np.meshgrid(*(axis.points for axis in GRID.axes), indexing="ij")
    whole = some(a, b, c)
    told: list[int] = []
    data = evaluate(
        some,
        GRID,
        OUTPUTS,
        run=Execution(executor=executor, workers=workers, progress=told.append),
        batch=batch,
    )
    assert np.array_equal(data["sum"].values, whole["sum"])
    assert np.array_equal(data["sign"].values, whole["sign"])
    assert told[0] == 0
    assert sum(told) == GRID.size


def test_the_result_is_labelled(reference: Found) -> None:
    cases = functools.partial(some, factor=1.0)
    data = evaluate(cases, GRID, OUTPUTS, attributes={"restitution": 0.8})
    assert data["sum"].dims == ("a", "b", "c")
    assert data["sum"].attrs == {"long_name": "a sum", "units": "m"}
    assert data["sign"].dtype == np.int8
    assert data["sign"].attrs["flag_meanings"] == "negative zero positive"
    assert data["a"].attrs == {"long_name": "an angle", "units": "rad"}
    assert data["b"].values.tolist() == [5.0, 1.0, 2.0]
    assert data.attrs["restitution"] == 0.8
    assert data.attrs["rocksteady_version"] == rocksteady.__version__
    assert json.loads(data.attrs["inputs"])["constants"] == {"factor": 1.0}
    assert float(data["sum"].sel(a=0.1, b=1.0, c=2)) == reference["sum"][0, 1, 2]


def test_cells_know_their_numbers() -> None:
    def numbers(a: Floats, b: Floats, c: Floats, cell: NDArray[np.int64]) -> Found:
        assert a.shape == b.shape == c.shape == cell.shape
        return {"sum": cell}

    for batch in (1, 5, 64):
        data = evaluate(numbers, GRID, OUTPUTS[:1], batch=batch, numbered="cell")
        assert np.array_equal(data["sum"].values.ravel(), np.arange(GRID.size))


@pytest.mark.parametrize("executor", ["threads", "serial"])
def test_an_error_of_the_case_function_comes_out_and_says_where(executor: str) -> None:
    with pytest.raises(ZeroDivisionError, match="as it happens") as caught:
        evaluate(failing, GRID, OUTPUTS, run=Execution(executor=executor, workers=1), batch=4)
    (note,) = caught.value.__notes__
    told = re.match(
        r"in cells (\d+) to (\d+) of 84: a (\S+) to (\S+), b .+ to .+, c \d to \d", note
    )
    assert told is not None
    first, last = int(told[1]), int(told[2])
    cells = GRID.cells(first, last + 1)
    assert (float(told[3]), float(told[4])) == pytest.approx((cells["a"][0], cells["a"][-1]))
    with pytest.raises(ZeroDivisionError):
        failing(**cells)


@every(
    ("answer", "valid"),
    [
        ({"other": 1.0}, "mapping with the output 'sum'"),
        (None, "mapping with the output 'sum'"),
        ({"sum": np.zeros(3)}, "shape of the cells, here \\(1,\\)"),
        ({"sum": 0.0}, "shape of the cells"),
        ({"sum": np.zeros(1, dtype=np.complex128)}, "must fit float64"),
        ({"sum": np.array(["x"])}, "must fit float64"),
    ],
)
def test_what_is_not_returned_as_declared_is_named(answer: Any, valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        evaluate(lambda **_: answer, GRID, OUTPUTS[:1], run=Execution(executor="serial"))


@every(
    ("arguments", "valid"),
    [
        ({"run": "threads"}, "run = 'threads' is not valid"),
        ({"batch": 0}, "whole number"),
        ({"numbered": "a"}, "numbered = 'a' is not valid: no two of them"),
        ({"numbered": 3}, "name of an argument"),
        ({"cases": functools.partial(some, a=np.ones(1))}, "may not have the name of an axis"),
        ({"outputs": ()}, "one or more"),
        ({"outputs": (Output(name="a"),)}, "outputs = 'a'"),
        ({"outputs": (OUTPUTS[0], OUTPUTS[0])}, "outputs = 'sum'"),
    ],
)
def test_arguments_are_validated(arguments: dict[str, Any], valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        evaluate(**{"cases": some, "grid": GRID, "outputs": OUTPUTS, **arguments})


@pytest.mark.parametrize("executor", ["threads", "serial"])
def test_an_interruption_cancels_what_has_not_begun(
    executor: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[float] = []
    submitted, came = threading.Event(), threading.Event()

    def wait(*arguments: Any, **options: Any) -> Any:
        submitted.set()
        return concurrent.futures.wait(*arguments, **options)

    def note(*_: object) -> None:
        came.set()
        raise KeyboardInterrupt

    def interrupting(a: Floats, b: Floats, c: Floats) -> Found:
        begun.append(float(a[0]))
        if len(begun) == 3:
            assert executor == "serial" or submitted.wait(60.0)
            signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
        if len(begun) >= 3 and executor == "threads":
            came.wait(60.0)  # the other cells follow the interruption, on a slow machine too
        return some(a, b, c)

    monkeypatch.setattr("rocksteady.sweep.executors._threads.wait", wait)
    usual = signal.signal(signal.SIGINT, note)
    try:
        with pytest.raises(KeyboardInterrupt):
            evaluate(
                interrupting, GRID, OUTPUTS, run=Execution(executor=executor, workers=2), batch=1
            )
    finally:
        signal.signal(signal.SIGINT, usual)
    assert 3 <= len(begun) < GRID.size
    # Nothing goes on behind one's back.
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("sweep")]


def test_progress_is_told_in_the_calling_thread() -> None:
    threads: set[int] = set()
    evaluate(
        some,
        GRID,
        OUTPUTS,
        run=Execution(workers=3, progress=lambda _: threads.add(threading.get_ident())),
        batch=2,
    )
    assert threads == {threading.get_ident()}
