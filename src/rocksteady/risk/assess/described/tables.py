"""Tables of objects: a CSV file with an object in each line."""

import csv
import difflib
import hashlib
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.described.objects import ObjectFile, content_of
from rocksteady.risk.assess.described.schema import Content, Geometry

COLUMNS: Mapping[str, tuple[str, str]] = {
    **{key: ("", key) for key in ("name", "kind", "friction", "restitution", "gravity_m_s2")},
    **{key: ("geometry", key) for key in Geometry.__struct_fields__},
    **{f"content_{key}": ("content", key) for key in Content.__struct_fields__},
}
"""Table and key of the object file for each column that is read."""

TEXTS = ("name", "kind")

DEMANDS = ("pga_g", "pgv_m_s")

NEAR = 0.8
"""Likeness from which on a column that is not read is taken for a slip of the pen."""

MOST_OBJECTS = 100_000


@checked
def read_objects(path: Path | str) -> list[ObjectFile]:
    r"""Read a table of objects in CSV, an object in each line.

    Parameters
    ----------
    path
        The file, in UTF-8, with the names of the columns in its first line: ``name``, and the keys
        of ``[geometry]`` of an object file, as ``width_m`` and ``height_m``; further ``kind``,
        ``friction``, ``restitution``, ``gravity_m_s2``, ``content_mass_kg`` and
        ``content_mass_centre_height_m``.  A cell holds a number, a range as ``0.3:0.5``, or
        nothing.  Cells are separated by commas, semicolons or tabs; other columns are kept in
        `ObjectFile.extra`.

    Returns
    -------
    list of ObjectFile
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
    file = Path(path)
    content = content_of(file)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            file.name,
            content[error.start : error.start + 1],
            f"byte {error.start + 1} is not UTF-8",
            "save the table as CSV in UTF-8",
        ) from None
    rows, header = _rows(text, file.name)
    sha256 = hashlib.sha256(content).hexdigest()
    lines: dict[str, int] = {}
    objects = []
    for line, row in rows:
        made = _object(header, row, f"{file.name}: line {line}", sha256)
        if made.name in lines:
            raise InputError(
                f"{file.name}: line {line}, name",
                made.name,
                f"line {lines[made.name]} has it too",
                "give each object another name, as its inventory number",
            )
        lines[made.name] = line
        objects.append(made)
    return objects


def _rows(text: str, source: str) -> tuple[list[tuple[int, list[str]]], list[str]]:
    """Return the lines with their numbers, and the names of the columns."""
    first = text.partition("\n")[0]
    separator = max(",;\t", key=first.count)
    # In quotes a cell has lines of its own; a line separator of Unicode ends no row.
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    hint = "give each line as many cells as the first, texts with commas in quotes"
    rows: list[tuple[int, list[str]]] = []
    header: list[str] = []
    try:
        for cells in reader:
            row = [cell.strip() for cell in cells]
            if not any(row):
                continue
            if not header:
                header = _header(row, source)
            elif len(row) != len(header):
                raise InputError(
                    f"{source}: line {reader.line_num}",
                    Words(f"has {len(row)} cells"),
                    f"the first line names {len(header)} columns",
                    hint,
                )
            else:
                rows.append((reader.line_num, row))
    except csv.Error as error:
        raise InputError(
            f"{source}: line {reader.line_num}", Words("is not CSV"), str(error), hint
        ) from None
    if not rows or len(rows) > MOST_OBJECTS:
        raise InputError(
            source,
            Words(f"has {len(rows)} objects" if header else "is empty"),
            f"a table has from 1 to {MOST_OBJECTS} objects below the names of its columns",
            "write name,width_m,height_m and a line for each object",
        )
    return rows, header


def _header(names: Sequence[str], source: str) -> list[str]:
    """Return the names of the columns, checked."""
    for place, name in enumerate(names):
        if name and name in names[:place]:
            raise InputError(
                f"{source}: line 1, column {place + 1}", name, "it occurs twice", "leave one out"
            )
        if name in COLUMNS:
            continue
        if name in DEMANDS:
            raise InputError(
                f"{source}: line 1, column {place + 1}",
                name,
                "all objects of a table meet one demand",
                "give it beside the table, as --pga-g and --pgv-m-s, and name the column otherwise",
            )
        near = difflib.get_close_matches(name.lower(), COLUMNS, n=1, cutoff=NEAR)
        if not name or near:
            raise InputError(
                f"{source}: line 1, column {place + 1}",
                name,
                "columns that are read are " + ", ".join(COLUMNS),
                f"did you mean {near[0]}? else give it another name" if near else "give it a name",
            )
    if "name" not in names:
        raise InputError(
            f"{source}: line 1",
            Words("has no column name"),
            "each object has a name",
            "add a column name, and width_m and height_m",
        )
    return list(names)


def _object(header: Sequence[str], row: Sequence[str], source: str, sha256: str) -> ObjectFile:
    """Return the object of a line."""
    values: dict[str, object] = {}
    extra: dict[str, str] = {}
    for column, cell in zip(header, row, strict=True):
        if column not in COLUMNS:
            extra[column] = cell
        elif cell:
            table, key = COLUMNS[column]
            place = values
            if table:
                place = values.setdefault(table, {})  # type: ignore[assignment]
            place[key] = cell if column in TEXTS else _value(cell, f"{source}, {column}")
    values.setdefault("geometry", {})
    return ObjectFile(values=values, source=source, extra=extra, sha256=sha256)


def _value(cell: str, name: str) -> object:
    """Return the number or the range of a cell; "housner" stays."""
    if cell == "housner":
        return cell
    try:
        numbers = [float(part) for part in cell.split(":")]
    except ValueError:
        numbers = []
    if len(numbers) not in (1, 2):
        comma = "write a point for a decimal comma" if "," in cell else "leave units to the column"
        raise InputError(
            name, cell, "it must be a number, or a range as 0.3:0.5", f"{comma}, or the cell empty"
        )
    return numbers[0] if len(numbers) == 1 else {"low": numbers[0], "high": numbers[1]}
