"""Tables that a person has written in CSV: columns, lines and cells, with the line of a fault."""

import csv
import difflib
import hashlib
import io
import math
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from rocksteady.errors import InputError, Words
from rocksteady.results.cells import read_cell
from rocksteady.small_files import content_of, text_of

NEAR: Final = 0.8
"""Likeness from which on a column that is not read is taken for a slip of the pen."""

MOST_ROWS: Final = 100_000


@dataclass(frozen=True, kw_only=True)
class Columns:
    """Columns that a table may have.

    Attributes
    ----------
    known
        Those that are read.
    needed
        Those that must be there, each with what is valid and what to do.
    refused
        Those that must not be there, likewise.
    things, example
        What is in the lines ("objects"), and the first line of an example.
    """

    known: Collection[str]
    needed: Mapping[str, tuple[str, str]]
    things: str
    example: str
    refused: Mapping[str, tuple[str, str]] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class CsvTable:
    """Lines of a table.

    Attributes
    ----------
    source
        Name of the file, for messages.
    header
        Names of the columns.
    rows
        Number of each line, and its cells without blanks around them.
    sha256
        Hash of the file.
    """

    source: str
    header: tuple[str, ...]
    rows: Sequence[tuple[int, tuple[str, ...]]]
    sha256: str

    def lines(self) -> list[tuple[str, dict[str, str]]]:
        """Return, of each line, its place for messages and its cells by column."""
        return [
            (f"{self.source}: line {line}", dict(zip(self.header, cells, strict=True)))
            for line, cells in self.rows
        ]

    def unread(self, columns: Columns) -> tuple[str, ...]:
        """Return the names of columns that are not read."""
        return tuple(name for name in self.header if name not in columns.known)


def read_csv_table(file: Path, columns: Columns, *, name: str, hint: str) -> CsvTable:
    """Read a table in CSV, with cells separated by commas, semicolons or tabs.

    Parameters
    ----------
    file
        The file, in UTF-8, with the names of the columns in its first line.
    columns
        Those that it may have; others are kept, unless they look like a slip of the pen.
    name, hint
        What the file is called where it cannot be read, and what to do next.

    Raises
    ------
    InputError
        With line and column, if it cannot be read, has no lines, a column is missing, occurs twice
        or looks misspelt, or a line has another number of cells.
    """
    content = content_of(file, name, hint)
    text = text_of(content, file.name, "a table")
    rows, header = _rows(text, file.name, columns)
    return CsvTable(
        source=file.name,
        header=tuple(header),
        rows=rows,
        sha256=hashlib.sha256(content).hexdigest(),
    )


def number_in(place: str, column: str, cell: str) -> float:
    """Return the number of a cell.

    Raises
    ------
    InputError
        With file, line and column, if it is no number: of Python's numbers only finite ones that
        everyone reads, so that neither "1_7" is 17 nor a digit of another script a number.
    """
    try:
        value = float(cell) if cell.isascii() and "_" not in cell else math.nan
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        hint = "write a point for a decimal comma" if "," in cell else "write it without a unit"
        raise InputError(f"{place}, {column}", cell, "it must be a finite number", hint)
    return value


def refuse_doubled(place: str, column: str, value: str, lines: dict[str, str], hint: str) -> None:
    """Note the place of a name, and refuse one that an earlier line has.

    Raises
    ------
    InputError
        With both lines.
    """
    if value in lines:
        earlier = lines[value].rpartition(": ")[2]
        raise InputError(f"{place}, {column}", value, f"{earlier} has it too", hint)
    lines[value] = place


def _rows(
    text: str, source: str, columns: Columns
) -> tuple[list[tuple[int, tuple[str, ...]]], list[str]]:
    """Return the lines with their numbers, and the names of the columns."""
    first = next((line for line in text.splitlines() if line.strip()), "")
    separator = max(",;\t", key=first.count)
    # In quotes a cell has lines of its own; a line separator of Unicode ends no row.
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    hint = "give each line as many cells as the first, texts with commas in quotes"
    rows: list[tuple[int, tuple[str, ...]]] = []
    header: list[str] = []
    try:
        for cells in reader:
            row = tuple(read_cell(cell.strip()) for cell in cells)
            if not any(row):
                continue
            if not header:
                header = _header(row, f"{source}: line {reader.line_num}", columns)
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
    things = columns.things
    if not rows or len(rows) > MOST_ROWS:
        raise InputError(
            source,
            Words(f"has {len(rows)} {things}" if header else "is empty"),
            f"a table has from 1 to {MOST_ROWS} {things} below the names of its columns",
            f"write {columns.example} and a line for each",
        )
    return rows, header


def _header(names: Sequence[str], place: str, columns: Columns) -> list[str]:
    """Return the names of the columns, checked."""
    for number, name in enumerate(names, 1):
        here = f"{place}, column {number}"
        if name and name in names[: number - 1]:
            raise InputError(here, name, "it occurs twice", "leave one out")
        if name in columns.known:
            continue
        if name in columns.refused:
            raise InputError(here, name, *columns.refused[name])
        near = _meant(name, columns.known, names)
        if not name or near:
            raise InputError(
                here,
                name,
                "columns that are read are " + ", ".join(columns.known),
                f"did you mean {near}? else give it another name" if near else "give it a name",
            )
    for name, (valid, hint) in columns.needed.items():
        if name not in names:
            raise InputError(place, Words(f"has no column {name}"), valid, hint)
    return list(names)


def _meant(name: str, known: Collection[str], names: Sequence[str]) -> str | None:
    """Return the column that a name which is not read seems to mean; None if it seems to mean none.

    Besides names that look alike, those with the letters of a column or of its quantity in another
    order, and names that begin with the quantity of a column which the table does not
    have: "gain [%]", "peak_deg".
    """
    word = name.lower()
    near = difflib.get_close_matches(word, known, n=1, cutoff=NEAR)
    quantity = re.split(r"[^a-z0-9]", word, maxsplit=1)[0]
    near += [each for each in known if sorted(each) == sorted(word)]
    for each in known:
        measured = each.partition("_")[0]
        turned = measured != quantity and sorted(measured) == sorted(quantity)
        if turned or (measured == quantity and each not in names):
            near.append(each)
    return near[0] if word and near else None
