"""Accessor ``rocksteady`` of datasets: gridded results describe themselves as other results do.

Importing this module registers it with xarray, as every function does that makes a dataset.
"""

from typing import TYPE_CHECKING, Any, Final

import xarray as xr

from rocksteady.results.result import Result, plotting_function
from rocksteady.sweep.cases.facts import cells_text

if TYPE_CHECKING:
    import pandas as pd

KINDS: Final = {
    "attractor map": {"kind", "period", "after"},
    "fate map": {"fate", "cycles"},
    "rocking ensemble": {"status", "peak_angle", "uplift_time_s"},
    "rocking spectrum": {"status", "peak_angle", "peak_velocity"},
}
"""Variables and attributes that a dataset of a kind has; the first kind that fits counts."""


def kind_of(dataset: xr.Dataset) -> str:
    """Return the kind of a dataset; empty where none fits."""
    names = {str(name) for name in (*dataset.data_vars, *dataset.attrs)}
    return next((kind for kind, needed in KINDS.items() if needed <= names), "")


@xr.register_dataset_accessor("rocksteady")
class Gridded(Result):
    """A gridded result: its description, summary, JSON object and plot.

    Parameters
    ----------
    dataset
        From `map_attractors`, `map_fates`, `evaluate`, `open_store` or another function.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self.dataset = dataset

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per cell."""
        return self.dataset.to_dataframe().reset_index()

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the dataset; arguments are those of the function `plot_*` of its kind."""
        kind = kind_of(self.dataset) or "Dataset of no known kind"
        return plotting_function(kind)(self.dataset, *arguments, **options)

    def __repr__(self) -> str:
        """Return one line, for which no cell is read."""
        kind = kind_of(self.dataset) or "gridded result"
        return f"<rocksteady {kind}: {cells_text(self.dataset)}>"
