"""What a command leaves behind: JSON on standard output, and files that are whole or not there."""

import csv
import json
import math
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.errors import OutputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def check_writable(flag: str, file: Path, *, force: bool) -> None:
    """Refuse a file that could not be written.

    Raises
    ------
    OutputError
        If it exists and `force` is off, or its folder is missing or not writable.
    """
    folder = file.absolute().parent
    if not folder.is_dir():
        valid, hint = "its folder does not exist", "create the folder"
    elif file.is_dir():
        valid, hint = "it is a folder", "name a file"
    elif not os.access(folder, os.W_OK):
        valid, hint = "its folder is not writable", "choose another folder"
    elif file.exists() and not force:
        valid, hint = "it exists", "add --force to overwrite it"
    else:
        return
    raise OutputError(name=flag, value=file, valid=valid, hint=hint)


def announce_compilation() -> None:
    """Say on standard error that a first run takes longer, where this is one."""
    from rocksteady.kernels.compilation import must_compile

    if must_compile():
        print("compiling the kernels, once for each version: some ten seconds", file=sys.stderr)


def write_whole(flag: str, file: Path, write: Callable[[Path], None]) -> None:
    """Write a file beside its place and move it there, so that it is never half there.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    partial = file.with_name(f".{file.stem}.partial-{os.getpid()}{file.suffix}")
    try:
        write(partial)
        partial.replace(file)
    except OSError as error:
        raise OutputError(
            name=flag,
            value=file,
            valid=error.strerror or str(error),
            hint="check the folder and the space that is left",
        ) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)
    print(f"wrote {file}", file=sys.stderr)


def write_figure(file: Path, figure: "Figure") -> None:
    """Save a figure in the format of the file's ending."""
    from rocksteady.show import palette

    def save(target: Path) -> None:
        metadata = {"Date": None} if file.suffix.lower() == ".svg" else None
        with palette.style():
            figure.savefig(target, format=file.suffix.lower()[1:], metadata=metadata)

    write_whole("--plot", file, save)


def write_csv(file: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Save a table; floats are written so that reading them gives the same number."""

    def save(target: Path) -> None:
        with target.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(header)
            writer.writerows(rows)

    write_whole("--csv", file, save)


def print_json(command: str, values: dict[str, Any]) -> None:
    """Print one object with its schema; NaN and infinity become null."""
    print(json.dumps(_plain({"schema": f"rocksteady/{command}/1", **values}), allow_nan=False))


def _plain(value: Any) -> Any:
    """Return a value that JSON can say."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, complex):
        return [_plain(value.real), _plain(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
