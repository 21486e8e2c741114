"""Tables of objects as they are known before the tests: an object in each line of a CSV file."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from rocksteady.errors import RocksteadyError
from rocksteady.risk.observations.files.csv_table import Columns, read_csv_table, refuse_doubled
from rocksteady.risk.observations.object_prior import BOUNDS, ObjectPrior
from rocksteady.risk.observations.spread import PriorRange

OBJECT_COLUMNS: Final = ("name", *BOUNDS)
"""Columns of an object."""

NEEDED: Final = {"name": ("each object has a name", "add a column name, and width_m and height_m")}

_TABLE: Final = Columns(
    known=OBJECT_COLUMNS, needed=NEEDED, things="objects", example="name,width_m,height_m"
)
_HINT: Final = "name a table of objects in CSV, with name, width_m and height_m"


@dataclass(frozen=True, kw_only=True)
class ObjectTable:
    """Objects of a table, by name.

    Attributes
    ----------
    objects
        What is known of each.
    source, sha256
        Name and hash of the file.
    remarks
        Sentences on columns that are not read.
    """

    objects: Mapping[str, ObjectPrior]
    source: str
    sha256: str
    remarks: tuple[str, ...]


def read_object_table(file: Path) -> ObjectTable:
    """Read a table of objects.

    Raises
    ------
    InputError, ModelError
        With the line, as for `read_csv_table` and `ObjectPrior`, or where two objects have one
        name.
    """
    table = read_csv_table(file, _TABLE, name="objects", hint=_HINT)
    lines: dict[str, str] = {}
    objects: dict[str, ObjectPrior] = {}
    for place, cells in table.lines():
        refuse_doubled(place, "name", cells["name"], lines, "give each object another name")
        objects[cells["name"]] = object_prior_of(cells, place)
    return ObjectTable(
        objects=objects,
        source=table.source,
        sha256=table.sha256,
        remarks=unread_remark(table.source, table.unread(_TABLE)),
    )


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
    given: dict[str, Any] = {}
    for key in BOUNDS:
        cell = cells.get(key, "")
        if cell:
            given[key] = PriorRange.parse(cell, name=f"{place}, {key}")
    try:
        return ObjectPrior(name=cells["name"], **given)
    except RocksteadyError as error:
        raise placed(error, place, error.name) from None


def placed(error: RocksteadyError, place: str, column: str) -> RocksteadyError:
    """Return an error with file, line and column in place of the name of its argument."""
    return type(error)(f"{place}, {column}", error.value, error.valid, error.hint)


def unread_remark(source: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return a sentence on columns that are not read; none without any."""
    if not names:
        return ()
    columns = f"column {names[0]} is" if len(names) == 1 else f"columns {', '.join(names)} are"
    return (f"{source}: {columns} not read.",)
