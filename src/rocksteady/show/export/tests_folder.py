"""Shaking tests as a folder: the table of tests, the table of objects and the records."""

import io
import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Final

from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.record import Record
from rocksteady.risk.observations.object_prior import BOUNDS, ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.show.export.files import STRAY, write_rows
from rocksteady.show.export.folders import check_folder, fill_folder

TABLES: Final = ("tests.csv", "objects.csv")

_SAFE: Final = re.compile(r"[^\w .()+-]")
_LONGEST_NAME: Final = 80

_HEADER: Final = (
    "test", "record", "object", "outcome", "gain", "sigma_ln", "group", "session", "peak_rad",
    "sigma_rad", "reversed", "vertical", "transverse",
)  # fmt: skip


@checked
def write_tests(folder: Path | str, observations: Observations, *, force: bool = False) -> Path:
    """Write shaking tests as `read_tests` reads them, to the last bit.

    Parameters
    ----------
    folder
        Made if it does not exist, in an existing folder; receives ``tests.csv``, ``objects.csv``
        and a file for each record.
    observations
        The tests.
    force
        Whether CSV files in the folder are replaced; default False.

    Returns
    -------
    Path
        The table of tests.

    Raises
    ------
    OutputError
        If the folder cannot be written, or holds CSV files and `force` is off, or one of the files
        that the tests were read from.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, read_tests
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> made = make_synthetic_tests(
    ...     Block.rectangle(width=0.15, height=0.6), make_synthetic_suite(2)
    ... )
    >>> with TemporaryDirectory() as place:
    ...     table = write_tests(Path(place, "tests"), made)
    ...     again = read_tests(table)
    >>> again.fell.tolist() == made.fell.tolist(), again.tests[0].record == made.tests[0].record
    (True, True)
    """
    hashes = observations.sources.values()
    check = partial(check_folder, folder, r".*\.csv", force=force, hashes=hashes)
    files = _names(observations.tests)
    texts = {
        "tests.csv": _csv(_HEADER, [_row(test, files) for test in observations.tests]),
        "objects.csv": _objects(observations.objects),
    }
    for test in observations.tests:
        for record in (test.record, test.vertical, test.transverse):
            if record is not None:
                texts.setdefault(files[id(record)], _samples(record))

    def write(stage: Path) -> None:
        for name, text in texts.items():
            (stage / name).write_bytes(text.encode(errors=STRAY))

    fill_folder(folder, write, check)
    return Path(folder) / TABLES[0]


def _names(tests: Sequence[ShakingTest]) -> dict[int, str]:
    """Return the name of the file of each record, by its identity."""
    used = {name.removesuffix(".csv") for name in TABLES}
    files: dict[int, str] = {}
    for test in tests:
        for record in (test.record, test.vertical, test.transverse):
            if record is None or id(record) in files:
                continue
            stem = _SAFE.sub("_", record.name or "record").strip(" .")[:_LONGEST_NAME] or "record"
            number, candidate = 1, stem
            while candidate.casefold() in used:
                number += 1
                candidate = f"{stem} {number}"
            used.add(candidate.casefold())
            files[id(record)] = f"{candidate}.csv"
    return files


def _row(test: ShakingTest, files: Mapping[int, str]) -> list[object]:
    """Return the cells of a test."""
    outcomes = {True: "fell", False: "stood", None: ""}
    numbers = [test.gain, test.sigma_ln, test.peak_rad, test.sigma_rad]
    gain, sigma_ln, peak, sigma = ["" if each is None else repr(each) for each in numbers]
    more = ["" if each is None else files[id(each)] for each in (test.vertical, test.transverse)]
    return [
        test.name, files[id(test.record)], test.object, outcomes[test.fell], gain, sigma_ln,
        test.group, test.session or "", peak, sigma, "yes" if test.reversed else "", *more,
    ]  # fmt: skip


def _objects(objects: Mapping[str, ObjectPrior]) -> str:
    """Return the table of objects; what is a default has no value."""
    columns = [
        key for key in BOUNDS if any(getattr(prior, key) is not None for prior in objects.values())
    ]
    rows = []
    for name, prior in objects.items():
        cells = [getattr(prior, key) for key in columns]
        rows.append([name, *("" if cell is None else str(cell) for cell in cells)])
    return _csv(["name", *columns], rows)


def _samples(record: Record) -> str:
    """Return a record as a column with its unit and its interval."""
    head = f"acceleration [m/s^2], dt = {record.dt_s!r} s"
    return "\n".join([head, *map(repr, record.acceleration_m_s2.tolist()), ""])


def _csv(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return a table as text."""
    stream = io.StringIO()
    write_rows(stream, header, rows)
    return stream.getvalue()
