"""Output of a command: JSON on standard output, and files written whole or not at all."""

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.progress import progress
from rocksteady.results.rendering import printable
from rocksteady.show.export.files import json_text, save_csv, save_figure, save_whole

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from rocksteady.show.film.animation import Film


INCOMPLETE = 3
"""Exit code of a command that could not decide the question."""


def announce_compilation(kernel: str) -> None:
    """Say on standard error that a first run takes longer, where this is one.

    Parameters
    ----------
    kernel
        What the command calls for its work, as "march.march": module and function.
    """
    from rocksteady.kernels.machine_code.compilation import must_compile

    if must_compile(kernel):
        what = "compiling what this needs with numba, once for each version: up to a minute"
        print(what, file=sys.stderr)


def write_figure(file: Path, figure: "Figure") -> None:
    """Save the picture of --plot."""
    save_figure("--plot", file, figure)
    announce_file(file)


def write_csv(file: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Save the table of --csv."""
    save_csv("--csv", file, header, rows)
    announce_file(file)


def write_cells(file: Path, dataset: "xarray.Dataset") -> None:
    """Save a sweep as the file of --csv: one row per cell."""
    from rocksteady.show.export.csv_files import save_cells

    save_cells("--csv", file, dataset)
    announce_file(file)


def write_netcdf(file: Path, dataset: "xarray.Dataset") -> None:
    """Save the dataset of --netcdf."""
    from rocksteady.show.export.netcdf import save_netcdf

    save_netcdf("--netcdf", file, dataset)
    announce_file(file)


def write_film(file: Path, film: "Film") -> None:
    """Save the film of --animate."""
    from rocksteady.show.film.gif import save_gif

    with progress("drawing the film", film.frames, lines=False) as done:
        save_whole("--animate", file, lambda target: save_gif(film, target, done))
    announce_file(file)


def announce_file(file: Path) -> None:
    """Print the name of a written file on standard error."""
    print(f"wrote {printable(file)}", file=sys.stderr)


def print_json(command: str, values: dict[str, Any]) -> None:
    """Print one object with its schema; NaN and infinity become null."""
    print(json_text(f"rocksteady/{command}/1", values))
