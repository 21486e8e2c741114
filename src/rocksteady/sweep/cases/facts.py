"""Facts of gridded results: their cells, axes and classes, and how cells are read in parts."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.results.description import Column, Fact, Table
from rocksteady.results.numbers import number

if TYPE_CHECKING:
    import xarray as xr

    from rocksteady.sweep.cases.cells import Labelled, Variable

SLAB = 4_000_000
"""Cells that are read from a store at once."""


def cells_text(dataset: "Labelled") -> str:
    """Return the number of cells and the axes in words, as "108 cells: 12 amplitude x 9 phase"."""
    axes = " x ".join(f"{size:,} {name}" for name, size in dataset.sizes.items())
    return f"{cell_count(dataset):,} cells: {axes}"


def cell_count(dataset: "Labelled") -> int:
    """Return the number of cells of a dataset."""
    return int(np.prod(list(dataset.sizes.values()), dtype=np.int64))


def grid_facts(dataset: "Labelled") -> list[Fact]:
    """Return cells, axes and store of a dataset, and how many of the cells were computed."""
    axes: dict[str, dict[str, Any]] = {}
    facts = [Fact("cells", cell_count(dataset), "cells")]
    for name, size in dataset.sizes.items():
        axis = dataset[str(name)]
        points = axis.values  # without a coordinate they are counted
        ends = [end.item() for end in points[[0, -1]]] if size else [None, None]
        axes[str(name)] = {"start": ends[0], "stop": ends[1], "count": size}
        unit = str(axis.attrs.get("units", "1"))
        words = " to ".join(number(end) if isinstance(end, float) else str(end) for end in ends)
        unit = "" if unit == "1" else f" {unit}"
        facts.append(Fact("", label=str(name), text=f"{words}{unit}, {size:,} values"))
    facts.append(Fact("axes", axes))
    for name in ("met", "computed"):
        if name in dataset:
            computed = sum(int(np.count_nonzero(part)) for (part,) in slabs(dataset, name))
            facts.append(Fact("computed", computed, "computed", f"{computed:,} cells"))
    store = dataset.encoding.get("source")
    facts.append(Fact("store", store, "store" if store else ""))
    return facts


def class_counts(dataset: "Labelled", name: str) -> dict[str, int]:
    """Return how many cells there are of each class of a variable with flags."""
    words = flags_of(dataset[name])
    counts = dict.fromkeys(words.values(), 0)
    for (part,) in slabs(dataset, name):
        for code, word in words.items():
            counts[word] += int(np.count_nonzero(part == code))
    return counts


def flags_of(variable: "Variable | xr.DataArray") -> dict[int, str]:
    """Return the meaning of each value of a variable with flags."""
    values = np.atleast_1d(variable.attrs["flag_values"]).tolist()
    return dict(zip(values, str(variable.attrs["flag_meanings"]).split(), strict=True))


def count_table(counts: dict[str, int], *, cells: int, heading: str) -> Table:
    """Return a table of classes, their cells and shares of all cells, for people."""
    rows = [
        {"class": word, "cells": count, "share": f"{100.0 * count / cells:.2f} %"}
        for word, count in counts.items()
        if count
    ]
    columns = [
        Column("class", heading, left=True),
        Column("cells", "cells"),
        Column("share", "share"),
    ]
    return Table("", rows, columns)


def slabs(dataset: "Labelled", *names: str) -> Iterator[tuple[Any, ...]]:
    """Yield the values of variables of one shape in parts that fit into memory."""
    first = dataset[names[0]]
    if not first.dims or not first.size:
        yield tuple(dataset[name].values for name in names)
        return
    along = str(first.dims[0])
    rows = max(1, SLAB * dataset.sizes[along] // first.size)
    for row in range(0, dataset.sizes[along], rows):
        yield tuple(dataset[name][row : row + rows].values for name in names)
