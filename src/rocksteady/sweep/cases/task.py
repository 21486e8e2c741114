"""A task: everything that a worker needs to compute any cells of a sweep."""

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.sweep.cases.axes import Array
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output

Cases = Callable[..., Mapping[str, Array]]
CellRange = tuple[int, int]
"""First cell, and the one after the last."""

LONG_ENOUGH = 0.1
"""Seconds of a call beside which what it costs to make one does not count."""
GROWTH = 8
"""How many times as many cells the next call takes where even that will be short."""
NAMED = 3
"""Ranges of cells that the note of an error names."""


class Answer(NamedTuple):
    """Results of a job, or of the first cells of it."""

    job: CellRange
    """Cells of the job."""
    stop: int
    """First cell that was not computed; the end of the job if all were."""
    arrays: dict[str, Array]
    """Array of shape (stop - job[0],) for each output."""
    many: int = 1
    """Cells with which the calls of another job may begin."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Task:
    """The case function, the cells and what is wanted of them.

    Attributes
    ----------
    cases
        Takes the coordinates of some cells, returns an array for each output.
    grid, outputs
        The cells and what is computed in each.
    numbered
        Argument of the case function that receives the numbers of its cells, if any.
    batch
        The most cells that one call takes.
    """

    cases: Cases
    grid: Grid
    outputs: tuple[Output, ...]
    numbered: str | None
    batch: int

    def run(self, job: CellRange, seconds: float, count: int = 1) -> Answer:
        """Compute the cells of a job until its time is over.

        Calls begin with `count` cells (default one) and take more each time, as long as they are
        short.  At least one call is made.  The cells that are left go back to the queue, so that no
        worker waits for another one that has met slow cells.
        """
        began = time.monotonic()
        first, stop = job
        here, count = first, min(count, self.batch)
        results: list[dict[str, Array]] = []
        while here < stop and (not results or time.monotonic() - began < seconds):
            called = time.monotonic()
            last = min(here + count, stop)
            results.append(self._call([(here, last)]))
            here = last
            took = time.monotonic() - called
            if took < LONG_ENOUGH:
                count = min((GROWTH if GROWTH * took < LONG_ENOUGH else 2) * count, self.batch)
            elif took > GROWTH * LONG_ENOUGH:
                count = 1
        names = [output.name for output in self.outputs]
        joined = {name: np.concatenate([part[name] for part in results]) for name in names}
        return Answer(job, here, joined, max(count // GROWTH, 1))

    def together(self, jobs: Sequence[CellRange]) -> list[Answer]:
        """Compute all cells of some jobs, one or more, in one call."""
        values = self._call(jobs)
        ends = np.cumsum([stop - first for first, stop in jobs])[:-1]
        parts = {name: np.split(array, ends) for name, array in values.items()}
        return [
            Answer(job, job[1], {name: arrays[place] for name, arrays in parts.items()})
            for place, job in enumerate(jobs)
        ]

    def _call(self, ranges: Sequence[CellRange]) -> dict[str, Array]:
        """Return what the case function finds in the cells of some ranges."""
        numbers = np.concatenate([np.arange(*cells, dtype=np.int64) for cells in ranges])
        cells = self.grid.at(numbers)
        if self.numbered is not None:
            cells[self.numbered] = numbers
        try:
            values = self.cases(**cells)
            return {output.name: _checked(output, values, len(numbers)) for output in self.outputs}
        except Exception as error:
            places = "; ".join(map(self.words_for, ranges[:NAMED]))
            error.add_note(f"in {places}{' and more' * (len(ranges) > NAMED)}")
            raise

    def words_for(self, cells: CellRange) -> str:
        """Return a range of cells in words: numbers and coordinates of the first and the last."""
        first, stop = cells
        ends = (np.unravel_index(cell, self.grid.shape) for cell in (first, stop - 1))
        places = zip(self.grid.axes, *ends, strict=True)
        where = ", ".join(
            f"{axis.name} {_short(axis.points[here].item())} to {_short(axis.points[last].item())}"
            for axis, here, last in places
        )
        return f"cells {first} to {stop - 1} of {self.grid.size}: {where}"


def _short(value: object) -> str:
    return f"{value:.15g}" if isinstance(value, float) else str(value)


def _checked(output: Output, value: object, cells: int) -> Array:
    """Return one output of the case function as what it is declared to be."""
    if not isinstance(value, Mapping) or output.name not in value:
        raise InputError(
            "cases",
            sorted(value) if isinstance(value, Mapping) else value,
            f"it must return a mapping with the output {output.name!r}",
            "return an array for each output, or leave the output out",
        )
    array = np.asarray(value[output.name])
    if array.shape != (cells,):
        raise InputError(
            output.name,
            array.shape,
            f"an output has the shape of the cells, here {(cells,)}",
            "return one value for each cell",
        )
    if not np.can_cast(array.dtype, output.dtype, casting="same_kind"):
        raise InputError(
            output.name,
            str(array.dtype),
            f"it must fit {output.dtype}, as which it is declared",
            "change the dtype of the output, or convert the array",
        )
    # Masked arrays come from numpy.ma alone, whose import takes longer than a small map.
    if "numpy.ma" in sys.modules and np.ma.isMaskedArray(value[output.name]):
        raise InputError(
            output.name,
            Words("hold a masked array"),
            "a result has no masks",
            "fill it with what stands for nothing",
        )
    return _fitting(output, array)


def _fitting(output: Output, array: Array) -> Array:
    """Return an array as the type of an output, which may be shorter: what does not fit is refused.

    What becomes a float may lose digits, but not become infinite.
    """
    if array.dtype == output.dtype:
        return array
    with np.errstate(over="ignore"):
        fitted: Array = array.astype(output.dtype)
    if output.dtype.kind == "f" and array.dtype.kind == "f":
        lost = np.isfinite(array) & ~np.isfinite(fitted)
    else:
        lost = fitted != array
    if lost.any():
        raise InputError(
            output.name,
            array[lost][0].item(),
            f"it must fit {output.dtype}, as which it is declared",
            "declare a longer type",
        )
    return fitted
