"""Accessor ``rocksteady`` of datasets: gridded results describe themselves as other results do.

Importing this module registers it with xarray, as every function does that makes a dataset.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.gridded import described, kind_of
from rocksteady.results.numbers import number
from rocksteady.results.result import Result, plotting_function

if TYPE_CHECKING:
    import pandas as pd

SLAB = 4_000_000
"""Cells that are read from a store at once."""


@xr.register_dataset_accessor("rocksteady")
class Gridded(Result):
    """A gridded result: its description, summary, JSON object and plot.

    Parameters
    ----------
    dataset
        From `map_attractors`, `map_fates`, `evaluate`, `open_store` or another function.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def describe(self) -> Description:
        """Return the facts of the dataset, by its kind; of any other those of its variables."""
        return described(self._dataset) or outputs_described(self._dataset)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per cell."""
        return self._dataset.to_dataframe().reset_index()

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the dataset; arguments are those of the function `plot_*` of its kind."""
        kind = kind_of(self._dataset) or "Dataset of no known kind"
        return plotting_function(kind)(self._dataset, *arguments, **options)

    def __repr__(self) -> str:
        """Return one line, for which no cell is read."""
        kind = kind_of(self._dataset) or "gridded result"
        return f"<rocksteady {kind}: {cells_text(self._dataset)}>"


def outputs_described(dataset: xr.Dataset) -> Description:
    """Return what is in each variable: its range, or its cells by class."""
    facts = grid_facts(dataset)
    tables = []
    for name, variable in dataset.data_vars.items():
        if "flag_values" in variable.attrs:
            tables.append(_flag_table(dataset, str(name)))
        elif variable.dtype.kind in "iuf" and variable.size:
            words = str(variable.attrs.get("long_name", name))
            ends = [float(variable.min()), float(variable.max())]
            text = " to ".join(number(end) for end in ends)
            facts.append(Fact(str(name), ends, words, text))
    return Description(f"Gridded result: {cells_text(dataset)}", facts, tables)


def cells_text(dataset: xr.Dataset) -> str:
    """Return the number of cells and the axes in words, as "108 cells: 12 amplitude x 9 phase"."""
    axes = " x ".join(f"{size:,} {name}" for name, size in dataset.sizes.items())
    return f"{cell_count(dataset):,} cells: {axes}"


def cell_count(dataset: xr.Dataset) -> int:
    """Return the number of cells of a dataset."""
    return int(np.prod(list(dataset.sizes.values()), dtype=np.int64))


def grid_facts(dataset: xr.Dataset) -> list[Fact]:
    """Return cells, axes and store of a dataset, and how many of the cells were computed."""
    axes: dict[str, dict[str, Any]] = {}
    facts = [Fact("cells", cell_count(dataset), "cells")]
    for name, size in dataset.sizes.items():
        points = dataset[name].values  # without a coordinate they are counted
        ends = [end.item() for end in points[[0, -1]]] if size else [None, None]
        axes[str(name)] = {"start": ends[0], "stop": ends[1], "count": size}
        unit = str(dataset[name].attrs.get("units", "1"))
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


def class_counts(dataset: xr.Dataset, name: str) -> dict[str, int]:
    """Return how many cells there are of each class of a variable with flags."""
    words = flags_of(dataset[name])
    counts = dict.fromkeys(words.values(), 0)
    for (part,) in slabs(dataset, name):
        for code, word in words.items():
            counts[word] += int(np.count_nonzero(part == code))
    return counts


def flags_of(variable: xr.DataArray) -> dict[int, str]:
    """Return the meaning of each value of a variable with flags."""
    values = np.atleast_1d(variable.attrs["flag_values"]).tolist()
    return dict(zip(values, str(variable.attrs["flag_meanings"]).split(), strict=True))


def _flag_table(dataset: xr.Dataset, name: str) -> Table:
    """Return the table of a variable with flags; what has none of them is not computed."""
    counts, cells = class_counts(dataset, name), int(dataset[name].size)
    missing = cells - sum(counts.values())
    return count_table({**counts, "not-computed": missing}, cells=cells, heading=name)


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


def slabs(dataset: xr.Dataset, *names: str) -> Iterator[tuple[Any, ...]]:
    """Yield the values of variables of one shape in parts that fit into memory."""
    first = dataset[names[0]]
    if not first.dims or not first.size:
        yield tuple(dataset[name].values for name in names)
        return
    along = first.dims[0]
    rows = max(1, SLAB * dataset.sizes[along] // first.size)
    for row in range(0, dataset.sizes[along], rows):
        part = dataset[list(names)].isel({along: slice(row, row + rows)})
        yield tuple(part[name].values for name in names)
