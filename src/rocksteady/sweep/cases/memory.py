"""Results of a sweep held in memory."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rocksteady.sweep.cases.cells import Cells, cells_of
from rocksteady.sweep.cases.grid import within
from rocksteady.sweep.cases.inputs import attributes_of, inputs_of
from rocksteady.sweep.cases.task import Answer, CellRange, Task

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
