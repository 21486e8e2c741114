"""Ensembles as a table: a row for each run."""

import math
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.show.export.files import save_csv

if TYPE_CHECKING:
    import xarray

DIMENSIONS = ("block", "record", "direction", "vertical", "draw", "level")
OUTCOMES = (
    "status", "peak_angle", "impacts", "top_displacement_m", "clearance_m", "edge_speed_m_s",
    "uplift_time_s",
)  # fmt: skip
HEAD = (
    "block", "record", "direction", "vertical", "level", "scale", "stretch", "restitution",
    *OUTCOMES,
)  # fmt: skip


@checked
def write_runs_csv(path: Path | str, ensemble: "xarray.Dataset") -> Path:
    """Write an ensemble as a table, a row for each run.

    Parameters
    ----------
    path
        The file, which is replaced.
    ensemble
        From `rocksteady.run_ensemble`; a coordinate ``stretch`` of its records is written too.

    Returns
    -------
    Path
        The file. Its columns are the block (from 1), record, direction, vertical component, level,
        scale of the record's accelerations and stretch of its time, restitution, status, largest
        theta/alpha, impacts, largest motion of the top and clearance [m], empty of a fall, largest
        speed of the lifted edge [m/s], and time of uplift [s], empty without one. Floats are
        written so that reading gives the same number. A name that a spreadsheet would run as a
        formula has an apostrophe before it.

    Raises
    ------
    InputError
        If the dataset is no ensemble.
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, Record, run_ensemble
    >>> from rocksteady.risk import Levels, RestitutionBand
    >>> cabinet = Block.rectangle(width=0.4, height=1.6)
    >>> shock = Record(acceleration_m_s2=[0.0, 1.0, -1.0, 0.0], dt_s=0.3, name="shock")
    >>> levels = Levels("pga_g", [0.2], beside=())
    >>> runs = run_ensemble(cabinet, shock, levels=levels, restitution=RestitutionBand(draws=1))
    >>> with TemporaryDirectory() as folder:
    ...     head = write_runs_csv(f"{folder}/results.csv", runs).read_text().splitlines()[0]
    >>> head.split(",")[-4:]
    ['top_displacement_m', 'clearance_m', 'edge_speed_m_s', 'uplift_time_s']
    """
    file = Path(path)
    check_ensemble(ensemble)
    save_csv("path", file, HEAD, _rows(ensemble))
    return file


def _rows(ensemble: "xarray.Dataset") -> Iterator[tuple[object, ...]]:
    """Yield the runs, the level fastest, then the restitution; one record in memory at a time."""
    flags = ensemble["status"].attrs
    values, meanings = flags["flag_values"], str(flags["flag_meanings"]).split()
    words = dict(zip(map(int, values), meanings, strict=True))
    for block, record in np.ndindex(ensemble.sizes["block"], ensemble.sizes["record"]):
        part = ensemble.isel(block=block, record=record).transpose(*DIMENSIONS[2:])
        stretch = float(part["stretch"]) if "stretch" in part else 1.0
        run = int(part["block"]), str(part["record"].values)
        names = (part[key].values.tolist() for key in ("direction", "vertical"))
        ratios = part["restitution"].values.tolist()
        scales = zip(part["level"].values.tolist(), part["scale"].values.tolist(), strict=True)
        cells = product(*names, ratios, scales)
        outcomes = zip(*(part[key].values.ravel().tolist() for key in OUTCOMES), strict=True)
        for (direction, vertical, ratio, scaled), (status, *values) in zip(
            cells, outcomes, strict=True
        ):
            numbers = ("" if math.isnan(value) else value for value in values)
            inputs = (*run, str(direction), str(vertical), *scaled, stretch, ratio)
            yield (*inputs, words.get(status, status), *numbers)


def check_ensemble(ensemble: "xarray.Dataset") -> None:
    """Refuse a dataset that is no ensemble.

    Raises
    ------
    InputError
        If it is none.
    """
    if ensemble.attrs.get("kind") != "rocking ensemble" or "status" not in ensemble:
        raise InputError(
            "ensemble",
            Words("is no rocking ensemble"),
            "it must be what run_ensemble returns",
            "give fragility.ensemble, or call run_ensemble(...)",
        )
