"""The only loop over cases: queues a grid's cells, stores the results and labels them."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.sweep.cases.axes import identifier
from rocksteady.sweep.cases.cells import Cells, cells_of
from rocksteady.sweep.cases.grid import Grid, each_once, within
from rocksteady.sweep.cases.inputs import attributes_of, constants_of, inputs_of
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.cases.outputs import Output, outputs_of
from rocksteady.sweep.cases.queue import Queue
from rocksteady.sweep.cases.task import Answer, Cases, CellRange, Task
from rocksteady.sweep.executors.choice import pool_for
from rocksteady.sweep.run import Execution, Progress
from rocksteady.sweep.store.store import Store

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.cases.cells import Labelled

MOST_CELLS = 50_000_000
"""Of a grid whose results have to fit into memory."""


class Memory:
    """Arrays over all cells.

    Parameters
    ----------
    task
        What is computed.
    attributes
        Attributes of the result.

    Raises
    ------
    InputError
        If there are more cells than memory is taken for.
    """

    def __init__(self, task: Task, attributes: Mapping[str, Any]) -> None:
        within("50 million", task.grid, MOST_CELLS, hint="take fewer points, or give a store")
        self._task = task
        self._attributes = attributes_of(inputs_of(task), attributes)
        size = task.grid.size
        self._arrays = {output.name: np.empty(size, output.dtype) for output in task.outputs}

    def missing(self) -> Sequence[CellRange]:
        """Return the ranges of cells that are to be computed: all of them."""
        return [(0, self._task.grid.size)]

    def put(self, answer: Answer) -> None:
        """Keep the results of a job."""
        for name, array in answer.arrays.items():
            self._arrays[name][answer.job[0] : answer.stop] = array

    def cells(self) -> Cells:
        """Return the result."""
        return cells_of(self._task.grid, self._task.outputs, self._arrays, self._attributes)


BATCH = 1024
"""Default largest number of cells in one call of the case function.  Calls grow to it only while
they are short."""
LARGEST_BATCH = 2**20


class Results(Protocol):
    """Results of a sweep, in memory or in a store."""

    def missing(self) -> Sequence[CellRange]:
        """Return the ranges of cells that are to be computed."""
        ...

    def put(self, answer: Answer) -> None:
        """Keep the results of a job."""
        ...

    def cells(self) -> "Labelled":
        """Return all results."""
        ...


@checked
def evaluate(
    cases: Cases,
    grid: Grid,
    outputs: Sequence[Output],
    *,
    run: Execution | None = None,
    batch: int = BATCH,
    numbered: str | None = None,
    attributes: Mapping[str, Any] | None = None,
) -> "xarray.Dataset":
    """Evaluate a function in every cell of a grid.

    The result is the same to the last bit for every executor, number of workers and batch, in
    memory and in a store, at once and resumed, as long as the case function treats its cells one
    by one.

    Parameters
    ----------
    cases
        Takes the coordinates of some cells, an array of shape (cells,) for each axis under the name
        of the axis, and returns a mapping with an array of shape (cells,) for each output.  A
        function at module level or a `functools.partial` of one, so that other processes find
        it; it is called from several threads at once.  Constants that a partial binds are
        written down as the inputs of the result.
    grid
        The cells.
    outputs
        What it returns.
    run
        Executor, number of workers, storage and progress; by default `Execution()`.
    batch
        The most cells that one call takes.  An interruption waits for calls under way.
    numbered
        Name of one more argument of the case function: the numbers of its cells in the grid, in C
        order, int64.  A random number that is keyed on it does not depend on who computes it: see
        `rocksteady.sweep.cases.draws.uniform`.
    attributes
        Attributes of the result, in finite numbers and texts: what a reader wants to know first.

    Returns
    -------
    xarray.Dataset
        The outputs over the axes, which are its coordinates, with units and long names; integer
        classes with ``flag_values`` and ``flag_meanings``.  Its attributes are those given; the
        package's version; ``source``, hashes of the sources; ``seed``, where a constant of the case
        function has that name; and ``inputs``, all that it follows from, in JSON.  That of a store
        reads its values where they are used.

    Raises
    ------
    InputError
        If an argument is not valid, or the case function does not return what it should.  An
        exception of its own comes out as it is, with a note of its cells.
    OutputError
        If the store cannot be written: it exists already, another process writes it, or it holds
        results of other inputs, which the message names.
    UnfinishedError
        If a store was begun and cannot be finished now: the disk is full, or a cluster is lost.

    Examples
    --------
    >>> from rocksteady.sweeps import Axis, Grid, Output, evaluate
    >>> def area(width, height):
    ...     return {"area": width * height}
    >>> grid = Grid(
    ...     axes=(Axis(name="width", values=[1, 2], units="m"), Axis(name="height", values=[3, 4]))
    ... )
    >>> result = evaluate(area, grid, [Output(name="area", units="m2")])
    >>> result.area.values
    array([[3., 4.],
           [6., 8.]])
    """
    cells = compute_cells(
        cases,
        grid,
        outputs,
        run=run,
        batch=batch,
        numbered=numbered,
        attributes=attributes,
    )
    return as_dataset(cells)


def compute_cells(
    cases: Cases,
    grid: Grid,
    outputs: Sequence[Output],
    *,
    run: Execution | None = None,
    batch: int = BATCH,
    numbered: str | None = None,
    attributes: Mapping[str, Any] | None = None,
) -> "Labelled":
    """Evaluate a function in every cell of a grid; a store alone makes a dataset.

    Parameters and errors are those of `evaluate`.
    """
    hint = "give a number of cells, as 64"
    task = Task(
        cases=cases,
        grid=grid,
        outputs=outputs_of(outputs, grid),
        numbered=numbered,
        batch=whole_number("batch", batch, at_least=1, at_most=LARGEST_BATCH, hint=hint),
    )
    _check_names(task)
    how = Execution() if run is None else run
    where = how.place
    if where is not None:
        where.check()
    # The pool first: if there is no cluster, no store is begun.
    with (
        pool_for(task, how.executor, how.workers) as pool,
        _results(task, where, attributes or {}) as results,
    ):
        queue = Queue(results.missing(), workers=pool.workers, batch=task.batch)
        _tell(how.progress, grid.size - queue.left)
        with closing(pool.answers(queue)) as answers:
            for answer in answers:
                results.put(answer)
                _tell(how.progress, answer.stop - answer.job[0])
        return results.cells()


def _tell(progress: Progress | None, cells: int) -> None:
    if progress is not None:
        progress(cells)


def _check_names(task: Task) -> None:
    """Refuse an argument of the case function that is given twice.

    Raises
    ------
    InputError
        If the numbers of the cells have the name of an axis or none, or a partial has bound one.
    """
    names = list(task.grid.names)
    if task.numbered is not None:
        identifier(task.numbered)
        names.append(task.numbered)
    each_once("numbered", names)
    bound = constants_of(task).keys() & set(names)
    if bound:
        raise InputError(
            "cases",
            min(bound),
            "a constant may not have the name of an axis",
            "leave it out of the functools.partial",
        )


@contextmanager
def _results(task: Task, where: Store | None, attributes: Mapping[str, Any]) -> Iterator[Results]:
    """Yield the results of a task, in memory or in a store."""
    if where is None:
        yield Memory(task, attributes)
        return
    with where.opened(task, attributes) as writer:
        yield writer
