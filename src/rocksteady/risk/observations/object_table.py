"""Tables of objects as they are known before the tests: an object in each line of a CSV file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from rocksteady.errors import RocksteadyError
from rocksteady.risk.observations.files.csv_table import (
    Columns,
    CsvTable,
    read_csv_table,
    refuse_doubled,
)
from rocksteady.risk.observations.object_prior import BOUNDS, ObjectPrior
from rocksteady.risk.observations.spread import PriorRange

OBJECT_COLUMNS: Final = ("name", *BOUNDS)
"""Columns of an object."""

NEEDED: Final = {"name": ("each object has a name", "add a column name, and width_m and height_m")}

OBJECTS: Final = Columns(
    known=OBJECT_COLUMNS, needed=NEEDED, things="objects", example="name,width_m,height_m"
)
_HINT: Final = "name a table of objects in CSV, with name, width_m and height_m"


def read_object_table(file: Path) -> tuple[dict[str, ObjectPrior], CsvTable]:
    """Read a table of objects, and return its priors by name beside the table.

    Raises
    ------
    InputError, ModelError
        With the line, as for `read_csv_table` and `ObjectPrior`, or where two objects have one
        name.
    """
    table = read_csv_table(file, OBJECTS, name="objects", hint=_HINT)
    lines: dict[str, str] = {}
    objects: dict[str, ObjectPrior] = {}
    for place, cells in table.lines():
        refuse_doubled(place, "name", cells["name"], lines, "give each object another name")
        objects[cells["name"]] = object_prior_of(cells, place)
    return objects, table


def object_prior_of(cells: Mapping[str, str], place: str) -> ObjectPrior:
    """Return the object of a line.

    Parameters
    ----------
    cells
        By column; those of other columns are left out, and empty ones.
    place
        File and line, for messages.

    Raises
    ------
    InputError, ModelError
        With the place, as for `ObjectPrior`.
    """
    given: dict[str, Any] = {
        key: PriorRange.parse(cells[key], name=f"{place}, {key}")
        for key in BOUNDS
        if cells.get(key)
    }
    try:
        return ObjectPrior(name=cells["name"], **given)
    except RocksteadyError as error:
        raise placed(error, place, error.name) from None


def placed(error: RocksteadyError, place: str, column: str) -> RocksteadyError:
    """Return an error with file, line and column in place of the name of its argument."""
    return type(error)(f"{place}, {column}", error.value, error.valid, error.hint)


def remarks_on(table: CsvTable, columns: Columns) -> tuple[str, ...]:
    """Return a sentence on columns that are not read; none without any."""
    names = table.unread(columns)
    if not names:
        return ()
    words = f"column {names[0]} is" if len(names) == 1 else f"columns {', '.join(names)} are"
    return (f"{table.source}: {words} not read.",)
