"""Words of gridded results: of a dataset by its kind, of any other those of its variables."""

import xarray as xr

from rocksteady.results.description import Description, Fact, Table
from rocksteady.results.numbers import number
from rocksteady.results.result import describes
from rocksteady.sweep.cases.accessor import Gridded, kind_of
from rocksteady.sweep.cases.facts import cells_text, class_counts, count_table, grid_facts
from rocksteady.words.ensembles import describe_ensemble
from rocksteady.words.maps import describe_map
from rocksteady.words.spectra import describe_spectrum


@describes(Gridded)
def describe_gridded(gridded: Gridded) -> Description:
    """Return the facts of the dataset, by its kind."""
    dataset = gridded.dataset
    match kind_of(dataset):
        case "attractor map" | "fate map":
            return describe_map(dataset)
        case "rocking ensemble":
            return describe_ensemble(dataset)
        case "rocking spectrum":
            return describe_spectrum(dataset)
    return _describe_outputs(dataset)


def _describe_outputs(dataset: xr.Dataset) -> Description:
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
