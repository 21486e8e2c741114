"""Datasets made of the cells of a sweep."""

from typing import TYPE_CHECKING

from rocksteady.sweep.cases.cells import Cells

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.cases.cells import Labelled


def as_dataset(cells: "Labelled") -> "xarray.Dataset":
    """Return the cells of a sweep as a dataset."""
    if not isinstance(cells, Cells):
        return cells
    import xarray

    import rocksteady.sweep.cases.accessor  # noqa: F401 -- registers itself

    variables, coords = (
        {name: (each.dims, each.values, each.attrs) for name, each in some.items()}
        for some in (cells.data_vars, cells.coords)
    )
    dataset = xarray.Dataset(variables, coords=coords, attrs=cells.attrs)
    dataset.encoding = cells.encoding
    return dataset
