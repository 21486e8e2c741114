"""A ground-motion file as lines of text, with any line ending and encoding."""

import contextlib
import re
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Final

from rocksteady.errors import RecordFileError

if TYPE_CHECKING:
    from rocksteady.arrays import Integers

LARGEST_FILE: Final = 64 * 2**20
"""Bytes of the largest file that is read; three channels of an hour at 200 Hz take some 26 MB."""

FETCH: Final = "fetch the file again"
"""What a hint about a damaged file begins with."""

CORRECT: Final = "take out the line that is wrong"
"""What to do about two lines of a header that differ."""

DAMAGED: Final = "damaged"
NO_RECORD: Final = "no record"
CONTRADICTION: Final = "contradiction"
"""Kinds of faults: a file is cut or garbled; it is none of ground motion; it states two things, or
another than its reader is told."""

_SHEET: Final = ("it is a spreadsheet", "save the sheet as CSV (UTF-8), and give that")
_SHEETS: Final = (b"xl/work", b"opendocument.spreadsheet", b"W\0o\0r\0k\0b\0o\0o\0k")
_ARCHIVE: Final = ("it is an archive", "unpack it, and give a record of it")
_NO_TEXT: Final = {
    **dict.fromkeys(
        (b"PK\x03\x04", b"\x1f\x8b", b"BZh", b"7z\xbc\xaf", b"\xfd7zXZ", b"Rar!"), _ARCHIVE
    ),
    b"\xd0\xcf\x11\xe0": ("it is a document of an office program", "give a record as text"),
    b"%PDF": ("it is a PDF", "give a record as text"),
    **dict.fromkeys((b"{", b"<"), ("it is JSON, XML or HTML", "give a record as text")),
}
"""What files that are no records begin with, and what to say of them."""

_BEGINNING: Final = 4096
_FAR_EAST: Final = re.compile(
    r"[\u6642\u65f6][\u9593\u95f4]|\u52a0\u901f\u5ea6|\u5357\u5317|[\u6771\u4e1c]\u897f|\u4e0a\u4e0b"
)
"""Time, acceleration, NS, EW, UD: what a header in Japanese or Chinese has."""
_LONGEST_HEAD: Final = 400
_DIGITS: Final = str.maketrans("123456789", "000000000")
_BLOCK: Final = 1024
"""Lines that are translated at once: those of one script alone are fast."""
# More than one \r is what a conversion to DOS makes of a file that was one already.
_LINE_ENDS: Final = re.compile(r"\r+\n|\n|\r")
# What nothing but text files end with: a fill of zeros, and the mark that DOS wrote.
_PADDING: Final = "\x00\x1a"


@dataclass(frozen=True, kw_only=True)
class RecordText:
    """The lines of a file; errors about it name the line that they are about.

    Parameters
    ----------
    path
        The file.
    lines
        Its lines without their ends.
    ended
        Whether the last of them that is not blank has an end.
    """

    path: Path
    lines: tuple[str, ...]
    ended: bool = True

    @cached_property
    def heads(self) -> tuple[str, ...]:
        """The lines, each cut to its first 400 characters: what the headers' patterns look at.

        No header has longer lines, and some of the patterns take a time that grows with the square
        of a line's length.
        """
        if max(map(len, self.lines), default=0) <= _LONGEST_HEAD:
            return self.lines
        return tuple(line[:_LONGEST_HEAD] for line in self.lines)

    @cached_property
    def layouts(self) -> "tuple[tuple[str, ...], Integers]":
        """The distinct layouts, lines with all digits as 0, and the index of that of each line.

        A file of many rows has few, and nearly all checks of a row depend on its layout alone.
        """
        import numpy as np

        known: defaultdict[str, int] = defaultdict(lambda: len(known))
        of_lines = np.empty(len(self.lines), dtype=np.int64)
        for at in range(0, len(of_lines), _BLOCK):
            block = "\n".join(self.lines[at : at + _BLOCK]).translate(_DIGITS).split("\n")
            of_lines[at : at + _BLOCK] = [*map(known.__getitem__, block)]
        return tuple(known), of_lines

    def by_layout(self, of_layout: Callable[[str], int]) -> "Integers":
        """Return what a function of a line that disregards its digits gives for each line."""
        import numpy as np

        layouts, of_lines = self.layouts
        return np.array([*map(of_layout, layouts)], dtype=np.int64)[of_lines]

    @property
    def first(self) -> str:
        """The first line that is not blank, cut as `heads` are."""
        return next((line for line in self.heads if line.strip()), "")

    def error(
        self, valid: str, hint: str, *, at: int | None = None, kind: str = ""
    ) -> RecordFileError:
        """Return the error about a line.

        Parameters
        ----------
        valid, hint, kind
            As for `~rocksteady.errors.RecordFileError`; one whose hint is to fetch the file again
            is about a damaged file.
        at
            Index of the line, the first one being 0; one past the last means the end of the file.
        """
        kind = kind or (DAMAGED if hint.startswith(FETCH) else "")
        if at is None:
            return RecordFileError(path=self.path, valid=valid, hint=hint, kind=kind)
        if at >= len(self.lines):
            return RecordFileError(
                path=self.path,
                line=len(self.lines),
                valid=f"the file ends here: {valid}",
                hint=hint,
                kind=kind,
            )
        text = self.heads[at].strip()
        return RecordFileError(
            path=self.path, line=at + 1, found=text, valid=valid, hint=hint, kind=kind
        )

    def refuse_repeated(self, first: int, at: int) -> None:
        """Raise where a line repeats the key of an earlier line of the header with another value.

        Parameters
        ----------
        first, at
            Index of either line; both begin with the key.

        Raises
        ------
        RecordFileError
            As above.
        """
        first_text, second_text = (
            " ".join(self.heads[line].split()).lower() for line in (first, at)
        )
        if first_text != second_text:
            valid = f"line {first + 1} states the same with another value"
            raise self.error(valid, CORRECT, at=at, kind=CONTRADICTION)


def file_bytes(path: Path) -> bytes:
    """Return what a file holds.

    Raises
    ------
    RecordFileError
        If it is not there, not a file, empty, too large or cannot be read.
    """
    try:
        problem, size, data = _problem(path), 0, b""
        if not problem:
            size = path.stat().st_size
            data = b"" if size > LARGEST_FILE else path.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a path with a zero in it
        reason = getattr(error, "strerror", None) or str(error)
        hint = "see whether the path is right and may be read"
        raise RecordFileError(path=path, valid=str(reason), hint=hint) from error
    if problem:
        raise RecordFileError(path=path, valid=problem, hint="give the path of a record")
    if size > LARGEST_FILE:
        valid = f"it has {size} bytes, and {LARGEST_FILE} are the most"
        raise RecordFileError(path=path, valid=valid, hint="give a file of one record")
    if not data.strip(b"\x00\x1a \t\r\n"):
        raise RecordFileError(path=path, valid="it is empty", hint="fetch it again", kind=DAMAGED)
    return data


def _problem(path: Path) -> str:
    """Return what keeps a path from being a file; nothing where it is one."""
    if path.is_file():
        return ""
    if path.is_dir():
        return "it is a folder"
    return "it is not a regular file" if path.exists() else "there is no such file"


def _decoded(data: bytes) -> str:
    """Return the characters of a file."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", errors="replace")
    for encoding in ("utf-8-sig", "cp932", "gb18030"):
        with contextlib.suppress(UnicodeDecodeError):
            content = data.decode(encoding)
            if encoding == "utf-8-sig" or _FAR_EAST.search(content[:_BEGINNING]):
                return content
    return data.decode("latin-1")


def as_text(path: Path, data: bytes) -> RecordText:
    """Return the lines of a file: UTF-8, UTF-16 with its mark, Shift-JIS, GBK, else Latin-1.

    Raises
    ------
    RecordFileError
        If it is not text.
    """
    content = _decoded(data)
    filled = content.rstrip(_PADDING + " \t\r\n")
    ended = any(end in content[len(filled) :] for end in "\r\n")
    content = filled
    valid, hint = next(
        (words for mark, words in _NO_TEXT.items() if data.startswith(mark)), ("", "")
    )
    if valid:
        sheet = any(part in data for part in _SHEETS)
        valid, hint = _SHEET if sheet else (valid, hint)
        raise RecordFileError(path=path, valid=valid, hint=hint, kind=NO_RECORD)
    beginning = content[:_BEGINNING]
    odd = sum(character < " " and character not in "\t\r\n\f\v" for character in beginning)
    if odd > len(beginning) // 100:
        raise RecordFileError(
            path=path,
            valid="it is not text",
            hint="give a record as its network publishes it",
            kind=NO_RECORD,
        )
    plain = content.replace("\r\n", "\n")
    lines = _LINE_ENDS.split(plain) if "\r" in plain else plain.split("\n")
    return RecordText(path=path, lines=tuple(lines), ended=ended)
