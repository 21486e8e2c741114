"""Tables of measured free rocking: a CSV file with a peak in each line."""

import math
from collections.abc import Callable, Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.risk.free_rocking.release import Release
from rocksteady.risk.observations.files.csv_table import (
    Columns,
    number_in,
    read_csv_table,
    refuse_doubled,
)
from rocksteady.risk.observations.files.toml_tables import in_file

UNITS: Mapping[str, float] = {
    "peak_rad": 1.0,
    "peak_deg": math.pi / 180.0,
    "peak_mrad": 1e-3,
}
"""Columns of the peak, and radians in one of each."""

SIDES: Mapping[str, int] = {
    **dict.fromkeys(("1", "+1", "+", "positive", "left"), 1),
    **dict.fromkeys(("-1", "-", "negative", "right"), -1),
}
"""Words of the column side: the edge that the block rocks about, or its sign."""

COLUMNS = Columns(
    known=(*UNITS, "sigma_rad", "test", "side", "t_s"),
    needed={},
    things="peaks",
    example="peak_rad,test",
)


@checked
def read_peaks(path: Path | str) -> list[Release]:
    r"""Read a table of measured free rocking in CSV, a peak in each line.

    Parameters
    ----------
    path
        The file, in UTF-8, with the names of the columns in its first line: ``peak_rad``,
        ``peak_deg`` or ``peak_mrad``, without sign; further ``sigma_rad``, the measuring error;
        ``test``, the name of the release, which lets a block be let go several times; ``side``,
        as + or -, left or right, of the edge that it rocks about; and ``t_s``, the time.  Peaks of
        a test follow each other.  Other columns are not read.

    Returns
    -------
    list of Release
        In the order of the file.

    Raises
    ------
    InputError
        With line and column, if a cell is not valid, a column occurs twice or looks misspelt, or
        the peak has no column or two; and as for `Release`.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "peaks.csv")
    ...     _ = file.write_text("test,peak_mrad\na,80\na,61\nb,75\nb,57\n", "utf-8")
    ...     releases = read_peaks(file)
    >>> [(each.name, each.peaks_rad.tolist()) for each in releases]
    [('a', [0.08, 0.061]), ('b', [0.075, 0.057])]
    """
    file = Path(path)
    hint = "name a table in CSV with a column peak_rad and a line for each peak"
    table = read_csv_table(file, COLUMNS, name="peaks", hint=hint)
    given = [name for name in UNITS if name in table.header]
    if len(given) != 1:
        raise InputError(
            f"{file.name}: line 1",
            Words(f"has the columns {' and '.join(given)}" if given else "has no column peak_rad"),
            f"a peak is given in one of {', '.join(UNITS)}",
            "leave one out" if given else "add it, or give the column of the peaks that name",
        )
    lines: dict[str, str] = {}
    tests = []
    for name, group in groupby(table.lines(), key=lambda line: line[1].get("test", "release")):
        rows = list(group)
        place, _ = rows[0]
        if not name:
            valid = "each peak belongs to a test"
            raise InputError(f"{place}, test", Words("is empty"), valid, "name it")
        hint = "put the peaks of each test in a row, or give the second test another name"
        refuse_doubled(place, "test", name, lines, hint)
        tests.append((name, rows))
    return [_release(name, rows, given[0]) for name, rows in tests]


def _release(name: str, rows: list[tuple[str, dict[str, str]]], peak: str) -> Release:
    """Return the release of a test; what it refuses names the lines."""
    hint = "give abs(theta), and its side in a column side"
    peaks = []
    for place, cells in rows:
        number, most = number_in(place, peak, cells[peak]), 0.5 * math.pi / UNITS[peak]
        peaks.append(UNITS[peak] * in_range(f"{place}, {peak}", number, 0.0, most, "()", hint=hint))
    more: dict[str, Any] = {
        key: [read(place, column, cells[column]) for place, cells in rows]
        for key, (column, read) in _MORE.items()
        if any(cells.get(column) for _, cells in rows)
    }
    with in_file(f"{rows[0][0]}, test {name}"):
        return Release(peaks_rad=peaks, name=name, **more)


def _side(place: str, column: str, cell: str) -> int:
    """Return the side of a cell."""
    if cell.lower() not in SIDES:
        raise InputError(
            f"{place}, {column}",
            cell,
            "a side is one of " + ", ".join(SIDES),
            "give the edge that the block rocks about, or leave the column out",
        )
    return SIDES[cell.lower()]


_MORE: Mapping[str, tuple[str, Callable[[str, str, str], float]]] = {
    "sigma_rad": ("sigma_rad", number_in),
    "times_s": ("t_s", number_in),
    "sides": ("side", _side),
}
"""Column of each further argument of `Release`, and its reader."""
