"""Export of gridded results to files for other programs."""

from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.show.export.csv_files import save_cells
from rocksteady.show.export.netcdf import save_netcdf

if TYPE_CHECKING:
    import xarray


@checked
def write_dataset(dataset: "xarray.Dataset", file: Path | str) -> None:
    """Save a gridded result as NetCDF or CSV, according to the file's extension.

    Parameters
    ----------
    dataset
        Dataset of numbers, booleans and names, as sweeps return it.
    file
        It appears when it is whole, and replaces an existing file.

        ``.nc`` is NetCDF-4: every variable with its type, units, names and flags, compressed
        without loss.  Booleans are bytes of 0 and 1, which xarray reads as booleans.

        ``.csv`` has a row for each cell, the last axis fastest: its coordinates, then the outputs.
        Classes are written as the words of their flags, booleans as True and False, floats so that
        reading them gives the same number, also nan.  It has no units and attributes.

    Raises
    ------
    InputError
        If the ending is another one, a type cannot be written, or, for CSV, the variables are not
        all over the same axes.
    OutputError
        If the file cannot be written; NetCDF needs the extra ``stores``.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import DimensionlessBlock, map_attractors
    >>> from rocksteady.export import write_dataset
    >>> axes = {"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 4.0]}
    >>> result = map_attractors(DimensionlessBlock(restitution=0.8), axes=axes)
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "map.csv"
    ...     write_dataset(result[["kind", "period"]], file)
    ...     print(file.read_text(encoding="utf-8"))
    amplitude,frequency_ratio,kind,period
    0.5,1.0,rest,0
    0.5,4.0,rest,0
    2.0,1.0,overturned,0
    2.0,4.0,symmetric,1
    <BLANKLINE>
    """
    path = Path(file)
    match path.suffix.lower():
        case ".nc":
            save_netcdf("file", path, dataset)
        case ".csv":
            save_cells("file", path, dataset)
        case _:
            raise InputError(
                "file", file, "its extension sets the format: .nc or .csv", "name it as map.nc"
            )
