"""A writer for each kind of output, old content or new; figures that are saved unrendered."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

from rocksteady.results.description import Description
from rocksteady.show.export.csv_files import save_cells
from rocksteady.show.export.dataset import write_dataset
from rocksteady.show.export.files import save_csv, save_figure, save_text, save_whole

Writer = Callable[[Path, float], object]


EMPTY = b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"/>'


@contextmanager
def unrendered() -> Iterator[None]:
    """Save each figure as an empty picture, where a test looks at what stands around it.

    A figure is put together all the same, and rendering it takes longer than all else on a page.
    """

    render = Figure.savefig

    def savefig(figure: Figure, stream: BinaryIO, *, format: str, **more: Any) -> None:  # noqa: A002
        if format in {"pdf", "png", "svg"}:
            stream.write(EMPTY)
        else:  # a frame of a film
            render(figure, stream, format=format, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", savefig)
        yield


def _figure(value: float) -> Figure:
    figure = Figure(figsize=(1.0, 0.75))
    figure.add_subplot().plot([0.0, value])
    return figure


def _cells(value: float) -> xarray.Dataset:
    return xarray.Dataset(
        {"a": ("x", np.full(2000, value), {"units": "1"})}, coords={"x": np.arange(2000.0)}
    )


def _gif(file: Path, value: float) -> None:
    from PIL import Image

    frames = [Image.new("RGB", (20, 20), (int(100 * value) + k, 0, 0)) for k in range(3)]
    save_whole(
        "--animate",
        file,
        lambda target: frames[0].save(target, save_all=True, append_images=frames[1:]),
    )


WRITERS: dict[str, Writer] = {
    "a.csv": lambda file, value: save_csv("--csv", file, ("x",), ([value] for _ in range(2000))),
    "cells.csv": lambda file, value: save_cells("--csv", file, _cells(value)),
    "a.json": lambda file, value: save_text("--out", file, f"{value}\n" * 2000),
    "a.png": lambda file, value: save_figure("--plot", file, _figure(value)),
    "a.svg": lambda file, value: save_figure("--plot", file, _figure(value)),
    "a.pdf": lambda file, value: save_figure("--plot", file, _figure(value)),
    "a.nc": lambda file, value: write_dataset(_cells(value), file),
    "a.gif": _gif,
}


def lines_of(description: Description) -> dict[str, str]:
    """Return the words of each fact of the first screen by its label, empty ones too."""
    return {fact.label: fact.words for fact in description.facts if fact.first}
