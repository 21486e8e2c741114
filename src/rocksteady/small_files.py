"""Files that a person has written: their bytes, text and TOML, or one line on what is wrong."""

import tomllib
from pathlib import Path
from typing import Any

from rocksteady.errors import InputError

MOST_BYTES = 100_000_000


def content_of(file: Path, name: str, hint: str) -> bytes:
    """Return the bytes of a file.

    Parameters
    ----------
    file
        The file.
    name, hint
        What it is called in messages, and what to do next.

    Raises
    ------
    InputError
        If it cannot be read, or is none of a person's making.
    """
    try:
        refuse_device(file, name, hint)
        if file.stat().st_size > MOST_BYTES:
            raise InputError(name, file, "it is larger than 100 MB", hint)
        return file.read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(name, file, getattr(error, "strerror", None) or str(error), hint) from None


def refuse_device(file: Path, name: str, hint: str) -> None:
    """Refuse a pipe, which may never end, and a device, whose zeros do not."""
    if file.is_fifo() or file.is_char_device() or file.is_block_device() or file.is_socket():
        raise InputError(name, file, "it is a pipe or a device, and no file", hint)


def text_of(content: bytes, source: str, kind: str) -> str:
    """Return the text of a file in UTF-8, with or without its mark.

    Parameters
    ----------
    content
        Its bytes.
    source, kind
        What the file is called in messages, and what it is: "TOML".

    Raises
    ------
    InputError
        If it is in another encoding, or not of text.
    """
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            source,
            content[error.start : error.start + 1],
            f"byte {error.start + 1} is not UTF-8, as {kind} must be",
            "save the file as UTF-8",
        ) from None
    if "\0" in text:
        line = text[: text.index("\0")].count("\n") + 1
        hint = "save the file as UTF-8"
        raise InputError(source, "\0", f"line {line} has a zero byte, as no text has", hint)
    return text


def toml_of(content: bytes, source: str) -> dict[str, Any]:
    """Return the values of a TOML file.

    Raises
    ------
    InputError
        If it is no TOML.
    """
    try:
        return tomllib.loads(text_of(content, source, "TOML"))
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        # Deep nesting and an integer of thousands of digits raise errors of Python itself.
        words = isinstance(error, tomllib.TOMLDecodeError)
        why = str(error) if words else "its lists are nested or its numbers are long beyond reason"
        raise InputError(
            source,
            source,
            f"it is not TOML: {why}",
            "write key = 0.5 (not .5) or key = 'text', each key and each [table] once",
        ) from None
