"""Reader of a table of shaking tests, with its objects and its records."""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from rocksteady.errors import InputError, RocksteadyError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.records.processing import Cleaning
from rocksteady.risk.observations.files.csv_table import (
    Columns,
    number_in,
    read_csv_table,
    refuse_doubled,
)
from rocksteady.risk.observations.files.record_files import Channel, RecordFiles
from rocksteady.risk.observations.object_table import OBJECTS, placed, read_object_table, remarks_on
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest

NUMBERS: Final = ("gain", "sigma_ln", "peak_rad", "sigma_rad")
CHANNELS: Final[Mapping[str, str]] = {
    "record": "channel", "vertical": "vertical_channel", "transverse": "transverse_channel"
}  # fmt: skip
"""Columns of files, and of the channel of each."""

TEST_COLUMNS: Final = (
    "test", "record", "object", "outcome", "gain", "sigma_ln", "group", "session", "peak_rad",
    "sigma_rad", "reversed", "channel", "vertical", "vertical_channel", "transverse",
    "transverse_channel",
)  # fmt: skip

OUTCOMES: Final[Mapping[str, bool | None]] = {
    "fell": True, "overturned": True, "toppled": True, "1": True,
    "stood": False, "standing": False, "survived": False, "0": False,
    "": None,
}  # fmt: skip
"""Whether an object fell, by the word of a table."""

_YES: Final[Mapping[str, bool]] = {
    "yes": True, "true": True, "1": True, "no": False, "false": False, "0": False, "": False,
}  # fmt: skip

_TABLE: Final = Columns(
    known=TEST_COLUMNS,
    needed={
        name: (f"a test has {what}", f"add a column {name}")
        for name, what in (
            ("test", "a name"),
            ("record", "a record"),
            ("object", "an object"),
            ("outcome", "an outcome, which may be an empty cell"),
        )
    },
    things="tests",
    example="test,record,object,outcome",
)


@checked
def read_tests(
    path: Path | str,
    *,
    records: Path | str | None = None,
    objects: Path | str | None = None,
    units: str | None = None,
    dt_s: float | None = None,
    column: str | int | None = None,
    resample: bool = False,
    cleaning: Cleaning | None = None,
) -> Observations:
    r"""Read shaking tests, their objects and their records.

    Parameters
    ----------
    path
        Table of tests in CSV and UTF-8, a test in each line, with the columns ``test`` (a name),
        ``record`` (a file, with or without its suffix), ``object`` (a name in the table of objects)
        and ``outcome`` (fell, overturned, toppled or 1; stood, standing, survived or 0; empty where
        it is not known); further ``gain``, ``sigma_ln``, ``group``, ``session``, ``peak_rad``,
        ``sigma_rad``, ``reversed`` (yes or no), ``channel`` of the record's file, ``vertical`` (a
        file) and ``vertical_channel``, ``transverse`` (the file of the second horizontal channel)
        and ``transverse_channel``, as for `ShakingTest`.
    records
        Folder of the records; default ``records`` beside the table, or else the table's own folder.
    objects
        Table of objects, whose columns are the keys of `ObjectPrior`; a cell holds a number,
        ``low:high`` or ``mean+-sd``.  Default ``objects.csv`` beside the table of tests.
    units, dt_s, column, resample, cleaning
        How all record files are read and cleaned, as for `read_record`.

    Returns
    -------
    Observations
        With the hash of each file.

    Raises
    ------
    InputError, ModelError
        With file, line and column, if a cell is not valid, a column is missing or looks misspelt, a
        file cannot be read, an object is unknown, or two tests have one name.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady.risk.observations.read_tests import read_tests
    >>> files = {
    ...     "tests.csv": "test,record,object,outcome,gain\n1,shock,column,stood,0.5\n",
    ...     "objects.csv": "name,width_m,height_m,base\ncolumn,0.15,0.58:0.62,0.8:1.0\n",
    ...     "shock.csv": "time (s),acceleration (g)\n0,0\n0.01,0.2\n0.02,-0.2\n0.03,0\n",
    ... }
    >>> with TemporaryDirectory() as folder:
    ...     for name, text in files.items():
    ...         _ = Path(folder, name).write_text(text, "utf-8")
    ...     read_tests(Path(folder, "tests.csv"))
    <Observations: 1 test of 1 object on 1 record: 1 stood>
    """
    file = Path(path)
    hint = "name a table of tests in CSV, with test, record, object and outcome"
    table = read_csv_table(file, _TABLE, name="tests", hint=hint)
    known, of_objects = read_object_table(Path(objects or file.parent / "objects.csv"))
    beside = file.parent / "records"
    folder = Path(records or (beside if beside.is_dir() else file.parent))
    if not folder.is_dir():
        raise InputError("records", folder, "it must be a folder", "name the folder of the records")
    cleaning = cleaning or Cleaning()
    files = RecordFiles(
        folder, cleaning=cleaning, units=units, dt_s=dt_s, column=column, resample=resample
    )
    names: dict[str, str] = {}
    rows: list[tuple[str, dict[str, Any], dict[str, Channel]]] = []
    remarks = [*remarks_on(table, _TABLE), *remarks_on(of_objects, OBJECTS)]
    coded = False
    for place, cells in table.lines():
        refuse_doubled(place, "test", cells["test"], names, "give each test another name")
        if cells["object"] not in known:
            near = difflib.get_close_matches(cells["object"], known, n=1)
            names_known = ", ".join([*known][:5])
            raise InputError(
                f"{place}, object",
                cells["object"] or Words("is empty"),
                f"{of_objects.source} has no such object",
                f"did you mean {near[0]}?" if near else f"its objects are {names_known}",
            )
        coded |= cells["outcome"] in ("0", "1")
        channels = {}
        for key, option in CHANNELS.items():
            name, channel = cells.get(key, ""), cells.get(option, "")
            if channel and not name:
                valid = f"it is a channel of the file in the column {key}, which is empty"
                raise InputError(f"{place}, {option}", channel, valid, "name the file, or empty it")
            if key == "record" or name:
                channels[key] = files.channel(
                    name, channel, f"{place}, {key}", f"{place}, {option}"
                )
        rows.append((place, _values(cells, place), channels))
    if coded:
        remarks.append(f"{table.source}: an outcome 1 is read as fell, and 0 as stood.")
    motions = files.records()
    tests = []
    for place, values, channels in rows:
        try:
            shaking = {key: motions[channel] for key, channel in channels.items()}
            tests.append(ShakingTest(**values | shaking))
        except RocksteadyError as error:
            raise placed(error, place, "test" if error.name == "name" else error.name) from None
    return Observations(
        tests=tests,
        objects=known,
        sources={each.source: each.sha256 for each in (table, of_objects)} | files.sources,
        remarks=[*remarks, *files.remarks, *filter(None, [cleaning.remark])],
    )


def _values(cells: Mapping[str, str], place: str) -> dict[str, Any]:
    """Return the arguments of a test but its motions."""
    values: dict[str, Any] = {
        "name": cells["test"],
        "object": cells["object"],
        "fell": _word(
            cells["outcome"],
            OUTCOMES,
            f"{place}, outcome",
            "write fell or stood, or leave the cell empty",
        ),
        "reversed": _word(cells.get("reversed", ""), _YES, f"{place}, reversed", "write yes or no"),
    }
    values |= {key: cells[key] for key in ("group", "session") if cells.get(key)}
    return values | {key: number_in(place, key, cells[key]) for key in NUMBERS if cells.get(key)}


def _word(cell: str, known: Mapping[str, Any], name: str, otherwise: str) -> Any:
    """Return what a word means, in capitals too."""
    word = cell.lower()
    if word not in known:
        words = [each for each in known if each]
        near = difflib.get_close_matches(word, words, n=1, cutoff=0.7)  # "not fell" is not fell
        hint = f"did you mean {near[0]}?" if near else otherwise
        raise InputError(name, cell, f"it must be one of {', '.join(words)}, or empty", hint)
    return known[word]
