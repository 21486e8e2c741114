"""Files written whole or not at all: figures, tables, text."""

import csv
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain, combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from rocksteady import durable
from rocksteady.errors import OutputError
from rocksteady.results.cells import written_cell
from rocksteady.results.description import plain
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure


FORMATS = ("png", "svg", "pdf")
"""Formats of pictures."""
STRAY = "backslashreplace"
"""Writes a byte of a file's name that is no UTF-8 as \\udcff; JSON reads the same name back."""
NUMBERS = {"calibrate": 2}
"""Number of each command's schema that is not its first; those of leaves add themselves."""


def check_writable(name: str, file: Path, *, force: bool) -> None:
    """Refuse a file that could not be written.

    Raises
    ------
    OutputError
        If it exists and `force` is off, its folder is missing or not writable, it is "-", a folder,
        a device or a pipe. A link counts as what it leads to, and as existing where that is
        missing.
    """
    problem = durable.obstacle(file)
    if file == Path("-"):  # which elsewhere means standard output
        valid, hint = "standard output is kept for text and --json", "name a file"
    elif problem is not None:
        valid, hint = problem
    elif not os.access(durable.place_of(file).parent, os.W_OK):
        valid, hint = "its folder is not writable", "choose another folder"
    elif os.path.lexists(file) and not force:
        missing = file.is_symlink() and not file.exists()
        valid = "it is a link to a file that is missing" if missing else "it exists"
        hint = "add --force to write it" if missing else "add --force to overwrite it"
    else:
        durable.expect(file, replace=force)
        return
    raise OutputError(name, file, valid, hint)


def check_apart(
    files: Mapping[str, Path | None],
    folders: Mapping[str, Path | None] | None = None,
    read: Iterable[Path] = (),
) -> None:
    """Refuse outputs of which one would overwrite another, or a file that is read.

    Parameters
    ----------
    files, folders
        What is written, by the names of the flags; None where a flag is not given.
    read
        Files that are read. What a folder holds of them is refused where it is checked.

    Raises
    ------
    OutputError
        If two names lead to one file, a file is read, or it lies in a folder of `folders`.
    """
    single = {name: file for name, file in files.items() if file is not None}
    filled = {name: folder for name, folder in (folders or {}).items() if folder is not None}
    outputs = single | filled
    for (earlier, its), (name, path) in combinations(outputs.items(), 2):
        if durable.same_file(its, path):
            raise OutputError(name, path, f"{earlier} writes the same file", "rename one")
    for folder_name, folder in filled.items():
        for name, path in outputs.items():
            if any(durable.same_file(folder, each) for each in durable.place_of(path).parents):
                raise OutputError(name, path, f"it lies in {folder_name}", "name another folder")
    for name, file in single.items():
        refuse_read(name, file, read)


def refuse_read(name: str, file: Path, read: Iterable[Path]) -> None:
    """Refuse to write a file that is read too, by whatever path.

    Raises
    ------
    OutputError
        If it is one of these.
    """
    if any(durable.same_file(file, each) for each in read):
        raise OutputError(name, file, "this file is read", "name another one")


def impossible_name(file: Path) -> str | None:
    """Return why the system takes no such name, as of too many characters; None where it does."""
    try:
        file.exists()
    except OSError as error:
        return error.strerror or str(error)
    return None


def save_whole(name: str, file: Path, write: Callable[[Path], object]) -> None:
    """Write a file that is whole, or leave the old file.

    Parameters
    ----------
    name
        Argument or flag of the file, for the error.
    file
        Where it goes; a link stays, and the file that it leads to is replaced.
    write
        Writes it to the path that it is given.

    Raises
    ------
    OutputError
        If it cannot be written, or there is something other than a file.
    """
    problem = durable.obstacle(file)
    if problem is not None:
        raise OutputError(name, file, problem[0], problem[1])
    try:
        durable.write(file, write)
    except FileExistsError as error:
        raise OutputError(
            name,
            file,
            "another program has written it meanwhile",
            "add --force to overwrite it, or name another file",
        ) from error
    except OSError as error:
        raise OutputError(
            name, file, error.strerror or str(error), "check the folder and the space that is left"
        ) from error


def figure_bytes(
    figure: "Figure", kind: str, *, command: str = "", transparent: bool = False
) -> bytes:
    """Return a figure as a file of a kind, "png", "svg" or "pdf", with its paper or without.

    The file says what made it: this version of the package, and a command line where there is one.

    A figure that has not been drawn before gives the same bytes each time; drawing it settles its
    layout, which may move by a pixel when it is drawn again.
    """
    from io import BytesIO

    from rocksteady.show.style import palette

    stream = BytesIO()
    with palette.style():
        figure.savefig(
            stream, format=kind, metadata=_origin(kind, command), transparent=transparent
        )
    return stream.getvalue()


def picture_files(figure: "Figure", *, command: str = "") -> dict[str, bytes]:
    """Return a figure as a file of each of `FORMATS`, all with the layout of the svg."""
    from matplotlib import rc_context

    engine, files = figure.get_layout_engine(), {}
    # Without these, None is no layout. To lay it out takes as long as to draw it.
    with rc_context({"figure.constrained_layout.use": False, "figure.autolayout": False}):
        try:
            for kind in sorted(FORMATS, reverse=True):
                files[kind] = figure_bytes(figure, kind, command=command)
                figure.set_layout_engine(None)
        finally:
            figure.set_layout_engine(engine)
    return {kind: files[kind] for kind in FORMATS}


def _origin(kind: str, command: str) -> dict[str, str | None]:
    """Return what a picture says of its origin, by the names of its format; it has no date."""
    from rocksteady import __version__

    maker, source, dates = {
        "png": ("Software", "Source", {}),
        "svg": ("Creator", "Source", {"Date": None}),
        "pdf": ("Creator", "Subject", {"CreationDate": None}),
    }[kind]
    made_by = {source: printable(command)} if command else {}
    return {maker: f"rocksteady {__version__}", **made_by, **dates}


def save_figure(name: str, file: Path, figure: "Figure", *, command: str = "") -> None:
    """Save a figure in the format of the file's ending, with the command that made it."""
    data = figure_bytes(figure, file.suffix.lower()[1:], command=command)
    save_whole(name, file, lambda target: target.write_bytes(data))


def save_csv(
    name: str, file: Path, header: Sequence[str], rows: Iterable[Sequence[object]]
) -> None:
    """Save a table as `write_rows` writes it."""

    def save(target: Path) -> None:
        with target.open("w", newline="", encoding="utf-8", errors=STRAY) as stream:
            write_rows(stream, header, rows)

    save_whole(name, file, save)


def write_rows(stream: TextIO, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table as CSV, which reads back as it was.

    Floats keep all their digits; texts that a spreadsheet would run have an apostrophe.
    """
    writer = csv.writer(stream, lineterminator="\n")
    for row in chain([header], rows):
        writer.writerow([written_cell(cell) for cell in row])


def save_text(name: str, file: Path, text: str) -> None:
    """Save a text as UTF-8."""
    save_whole(name, file, lambda target: target.write_text(text, encoding="utf-8", errors=STRAY))


def schema_of(command: str) -> str:
    """Return the schema of a command's object, with its number."""
    return f"rocksteady/{command}/{NUMBERS.get(command, 1)}"


def json_text(schema: str, values: dict[str, Any], *, indent: int | None = None) -> str:
    """Return one JSON object with its schema; NaN and infinity become null.

    Parameters
    ----------
    schema
        What the object holds, as ``rocksteady/simulate/1``.
    values
        Numbers, texts, arrays, and lists and dicts of them; complex numbers become [re, im].
    indent
        Spaces of indentation; all in one line without.
    """
    values = plain({"schema": schema, **values})
    return json.dumps(values, allow_nan=False, indent=indent, ensure_ascii=indent is None)
