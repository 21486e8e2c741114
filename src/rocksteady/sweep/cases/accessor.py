"""Accessor ``rocksteady`` of datasets: gridded results describe themselves as other results do.

Importing this module registers it with xarray, as every function does that makes a dataset.
"""

from typing import TYPE_CHECKING, Any

import xarray as xr

from rocksteady.results.description import Description, Fact, Table
from rocksteady.results.gridded import described, kind_of
from rocksteady.results.numbers import number
from rocksteady.results.result import Result, plotting_function
from rocksteady.sweep.cases.facts import cells_text, class_counts, count_table, grid_facts

if TYPE_CHECKING:
    import pandas as pd


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


def _flag_table(dataset: xr.Dataset, name: str) -> Table:
    """Return the table of a variable with flags; what has none of them is not computed."""
    counts, cells = class_counts(dataset, name), int(dataset[name].size)
    missing = cells - sum(counts.values())
    return count_table({**counts, "not-computed": missing}, cells=cells, heading=name)
