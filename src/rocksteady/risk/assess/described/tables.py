"""Tables of objects: a CSV file with an object in each line."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.described.objects import FILE_HINT, DescribedObject
from rocksteady.risk.assess.described.schema import Content, Geometry, Options
from rocksteady.risk.observations.files.csv_table import Columns, read_csv_table, refuse_doubled
from rocksteady.risk.observations.spread import parts_of
from rocksteady.risk.screens.demand import VERTICAL

COLUMNS: Mapping[str, tuple[str, str]] = {
    **{
        key: ("", key)
        for key in (
            *("name", "kind", "building", "floor", "friction", "restitution", "against_wall"),
            *("fixed_parts", "gravity_m_s2"),
        )
    },
    **{key: ("geometry", key) for key in Geometry.__struct_fields__},
    **{f"content_{key}": ("content", key) for key in Content.__struct_fields__},
    **{key: ("demand", key) for key in ("pga_g", "pgv_m_s", *VERTICAL)},
}
"""Table and key of the object file for each column that is read."""

OF_FILES = {*Options.__struct_fields__, "spectrum"}
"""Keys of an object file that a table would pass over in silence."""
TEXTS = ("name", "kind", "building", "floor")
ANSWERS = {"yes": True, "true": True, "no": False, "false": False}
"""Words of the columns against_wall and fixed_parts."""

TABLE = Columns(
    known=COLUMNS,
    needed={"name": ("each object has a name", "add a column name, and width_m and height_m")},
    things="objects",
    example="name,width_m,height_m",
)


@checked
def read_objects(path: Path | str) -> list[DescribedObject]:
    r"""Read a table of objects in CSV, an object in each line.

    Parameters
    ----------
    path
        The file, in UTF-8, with the names of the columns in its first line: ``name``, and the keys
        of ``[geometry]`` of an object file, as ``width_m`` and ``height_m``; further ``kind``,
        ``friction``, ``restitution``, ``against_wall`` and ``fixed_parts`` (yes or no),
        ``gravity_m_s2``,
        ``content_mass_kg``, ``content_mass_centre_height_m``, ``building`` and ``floor`` (of
        `read_buildings`), and ``pga_g``, ``pgv_m_s``, ``vertical_g`` and ``vertical_share`` of its
        own demand.  A cell holds a number, a range as
        ``0.3:0.5``, or nothing.  Cells are separated by commas, semicolons or tabs; other columns
        are kept in `DescribedObject.extra`.

    Returns
    -------
    list of DescribedObject
        In the order of the file.

    Raises
    ------
    InputError
        With line and column, if a cell is not valid, a column occurs twice or looks misspelt, two
        objects have one name, or the file has no object; and as for `read_object`.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "store.csv")
    ...     _ = file.write_text("name,width_m,height_m,room\nvase,0.12,0.5,4\n", "utf-8")
    ...     (vase,) = read_objects(file)
    >>> vase.name, dict(vase.extra)
    ('vase', {'room': '4'})
    """
    table = read_csv_table(Path(path), TABLE, name="object", hint=FILE_HINT)
    lines: dict[str, str] = {}
    objects = []
    for place, cells in table.lines():
        made = _object(cells, place, table.sha256)
        hint = "give each object another name, as its inventory number"
        refuse_doubled(place, "name", made.name, lines, hint)
        objects.append(made)
    return objects


def _object(cells: Mapping[str, str], source: str, sha256: str) -> DescribedObject:
    """Return the object of a line."""
    values: dict[str, Any] = {"geometry": {}}
    extra: dict[str, str] = {}
    for column, cell in cells.items():
        if cell and (column in OF_FILES or (column == "place" and cell == "floor")):
            raise InputError(
                f"{source}, {column}",
                cell,
                "it is a key of object files, which a table does not take",
                "write the object as a file of its own, or leave the column out",
            )
        if column not in COLUMNS:
            extra[column] = cell
        elif cell:
            table, key = COLUMNS[column]
            keys = values.setdefault(table, {}) if table else values
            keys[key] = _value(column, cell, f"{source}, {column}")
    return DescribedObject(values=values, source=source, extra=extra, sha256=sha256)


def _value(column: str, cell: str, name: str) -> object:
    """Return the number or the range of a cell; a text or a form of "housner" stays."""
    if column in TEXTS or "housner" in cell:  # the validation of the values checks it
        return cell
    if column in ("against_wall", "fixed_parts"):
        if cell.lower() not in ANSWERS:
            hint = "write yes where it is so, or leave the cell empty"
            raise InputError(name, cell, "it must be yes or no", hint)
        return ANSWERS[cell.lower()]
    parts = parts_of(cell)
    if parts is None or parts[1] in ("+-", "log:"):
        comma = "write a point for a decimal comma" if "," in cell else "leave units to the column"
        raise InputError(
            name, cell, "it must be a number, or a range as 0.3:0.5", f"{comma}, or the cell empty"
        )
    numbers, sign = parts
    if column == "columns" and sign == "" and numbers[0].is_integer():
        return int(numbers[0])
    return numbers[0] if sign == "" else {"low": numbers[0], "high": numbers[1]}
