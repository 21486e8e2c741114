"""Grids computed only near the borders of their classes.

A coarse lattice of cells is computed first.  Then its spacing is halved until it is the grid.  Of
the cells that are new each time, those are computed around which the lattice holds more than one
class; the others take the class that is all around them.  So a border is followed once the lattice
has seen both of its sides; an island that it has not met, far from every border, is missed.
"""

import functools
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Bools, Integers
from rocksteady.errors import InputError
from rocksteady.model.checks.validation import whole_number
from rocksteady.sweep.cases.axes import Array, Axis
from rocksteady.sweep.cases.cells import Cells, cells_of
from rocksteady.sweep.cases.grid import Grid, within
from rocksteady.sweep.cases.inputs import attributes_of, inputs_of
from rocksteady.sweep.cases.outputs import Output, outputs_of
from rocksteady.sweep.cases.task import Cases, Task
from rocksteady.sweep.evaluate import BATCH, MOST_CELLS, compute_cells
from rocksteady.sweep.run import Execution, Progress

COARSEST = 1024
MET = Output(
    name="met",
    dtype=np.bool_,
    long_name="whether the cell was computed; else its class is that of the cells around it",
)


def refined(
    cases: Cases,
    grid: Grid,
    outputs: Sequence[Output],
    *,
    classes: Sequence[str],
    coarse: int,
    run: Execution | None = None,
    batch: int = BATCH,
    attributes: Mapping[str, Any] | None = None,
) -> Cells:
    """Evaluate a function in the cells of a grid that are near a border of its classes.

    Parameters
    ----------
    cases, grid, outputs, run, batch, attributes
        As for `rocksteady.sweep.evaluate.evaluate`; the run without a store.
    classes
        Names of the integer outputs that make a class.
    coarse
        Spacing of the first lattice in cells, a power of two: the first and the last cell along
        each axis, and multiples of the spacing between them.

    Returns
    -------
    Cells
        As of `evaluate`, with one more variable: ``met``, whether a cell was computed.  Where it
        was not, the outputs that make the class are those of the cells around it, and the others
        nan, their lowest integer, or False.

    Raises
    ------
    InputError
        As for `evaluate`, and if the spacing is no power of two, or a class no integer output.
    ModelError
        If the run has a store.

    Examples
    --------
    >>> def inside(x, y):
    ...     return {"inside": (x**2 + y**2 < 1.0).astype(np.int8)}
    >>> axes = tuple(Axis(name=name, values=np.linspace(0.0, 2.0, 129)) for name in "xy")
    >>> output = Output(name="inside", dtype=np.int8)
    >>> result = refined(inside, Grid(axes=axes), [output], classes=["inside"], coarse=8)
    >>> whole = compute_cells(inside, Grid(axes=axes), [output])
    >>> same = bool((result["inside"].values == whole["inside"].values).all())
    >>> same, f"{result['met'].values.mean():.2f}"
    (True, '0.07')
    """
    given = (run or Execution()).in_memory("a store holds every cell of its grid")
    wanted = outputs_of([*outputs, MET], grid)[:-1]
    _check_classes(classes, wanted)
    spacing = _spacing(coarse)
    within("50 million", grid, MOST_CELLS, hint="take fewer points")
    task = Task(cases=cases, grid=grid, outputs=wanted, numbered=None, batch=batch)
    attributes_given = attributes_of(inputs_of(task), {**(attributes or {}), "coarse": spacing})
    arrays = {output.name: np.full(grid.size, output.nothing, output.dtype) for output in wanted}
    met: Bools = np.zeros(grid.size, dtype=np.bool_)
    tell = _told_once(given.progress)
    how = replace(given, progress=tell)

    def compute(numbers: Integers) -> None:
        if not numbers.size:
            return
        cells = compute_cells(
            functools.partial(_numbered, cases=cases, grid=grid),
            Grid(axes=(Axis(name="number", values=numbers),)),
            wanted,
            run=how,
            batch=batch,
        )
        for name, array in arrays.items():
            array[numbers] = cells[name].values
        met[numbers] = True

    lattice = _lattice(grid.shape, spacing)
    compute(_numbers(lattice, grid.shape).ravel())
    while spacing > 1:
        spacing //= 2
        finer = _lattice(grid.shape, spacing)
        numbers = _numbers(finer, grid.shape)
        known = _numbers(lattice, grid.shape)
        near, old, beside = _compared(_codes(arrays, classes, known), lattice, finer)
        taken = ~old & ~near
        for name in classes:
            arrays[name][numbers[taken]] = arrays[name][known.ravel()[beside[taken]]]
        compute(numbers[~old & near])
        if tell is not None:
            tell(int(taken.sum()))
        lattice = finer
    return cells_of(grid, (*wanted, MET), {**arrays, MET.name: met}, attributes_given)


def _numbered(number: NDArray[np.float64], *, cases: Cases, grid: Grid) -> Mapping[str, Array]:
    """Call a case function for cells of a grid by their numbers."""
    return cases(**grid.at(number.astype(np.int64)))


def _lattice(shape: tuple[int, ...], spacing: int) -> list[Integers]:
    """Return which indices along each axis are in a lattice: the last one always is."""
    return [np.unique(np.append(np.arange(0, points, spacing), points - 1)) for points in shape]


def _numbers(lattice: Sequence[Integers], shape: tuple[int, ...]) -> Integers:
    """Return the numbers of the cells of a lattice, in its shape."""
    numbers: Integers = np.ravel_multi_index(np.ix_(*lattice), shape)
    return numbers


def _codes(arrays: Mapping[str, Array], classes: Sequence[str], numbers: Integers) -> Integers:
    """Return one integer for each class, shape of the numbers."""
    codes = np.zeros(numbers.shape, dtype=np.int64)
    for name in classes:
        _, part = np.unique(arrays[name][numbers], return_inverse=True)
        codes = codes * (int(part.max()) + 1) + part.reshape(numbers.shape)
    return codes


def _compared(
    codes: Integers, lattice: Sequence[Integers], finer: Sequence[Integers]
) -> tuple[Bools, Bools, Integers]:
    """Return which cells of a finer lattice are near a border, which are in the coarse one as well,
    and for each of them a cell beside it, by its place in the coarse one.
    """  # noqa: D205 -- one sentence
    from scipy.ndimage import maximum_filter, minimum_filter

    mixed = maximum_filter(codes, size=3) != minimum_filter(codes, size=3)
    below = [
        np.searchsorted(old, new, side="right") - 1 for old, new in zip(lattice, finer, strict=True)
    ]
    same = [old[at] == new for old, new, at in zip(lattice, finer, below, strict=True)]
    above = [at + ~halved for at, halved in zip(below, same, strict=True)]
    near = np.zeros([len(new) for new in finer], dtype=np.bool_)
    for corner in product(*zip(below, above, strict=True)):
        near |= mixed[np.ix_(*corner)]
    old: Bools = functools.reduce(np.logical_and.outer, same)
    beside: Integers = np.ravel_multi_index(np.ix_(*below), codes.shape)
    return near, old, beside


def _told_once(progress: Progress | None) -> Progress | None:
    """Return a progress callback that counts several sweeps as one."""
    begun = False

    def told(cells: int) -> None:
        nonlocal begun
        if progress is not None and (cells or not begun):
            progress(cells)
        begun = True

    return told if progress is not None else None


def _spacing(coarse: object) -> int:
    hint = "give 4, 8 or 16"
    spacing = whole_number("refine", coarse, at_least=1, at_most=COARSEST, hint=hint)
    if spacing & (spacing - 1):
        raise InputError("refine", coarse, "it must be a power of two", hint)
    return spacing


def _check_classes(classes: Sequence[str], outputs: Sequence[Output]) -> None:
    whole = [output.name for output in outputs if output.dtype.kind in "bi"]
    if not classes or not set(classes) <= set(whole):
        raise InputError(
            "classes",
            tuple(classes),
            f"a class is made of integer outputs, here {', '.join(whole) or 'none'}",
            "name one or more of them",
        )
