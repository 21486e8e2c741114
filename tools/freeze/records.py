"""Records of answers: one text file per part, in which each item has a name and a few lines."""

import difflib
import hashlib
import math
import re
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "tests" / "frozen"
LONGEST, HEAD = 200, 24
"""Lines of an item that are kept whole, and first lines that are kept of a longer one."""
WIDEST = 160
"""Characters of a line that is kept whole."""
FILE = " > "
"""Stands before the name of a file that a command or a call leaves."""
SHOWN = 12
"""Lines of a difference that are printed."""
ROUNDED = 1e-6
"""Relative difference of numbers that count as the same on two processors."""
TINY = 1e-9
"""Likewise in absolute terms. Of a number of three digits or more the last may be another by 1."""
_HEXADECIMAL, _HASH = r"-?0x[01](?:\.[0-9a-f]+)?p[+-]\d+", r"\b[0-9a-f]{16}\b"
_NUMBER = re.compile(rf"({_HEXADECIMAL}|{_HASH}|-?\b\d+(?:\.\d*(?:e[+-]?\d+)?|e[+-]?\d+))")
"""Numbers of a record that are not whole, and hashes."""
_CUT = re.compile(r"… \d+ (?:characters|lines), [0-9a-f]{16}$")
"""Ends a line, or the lines, of an item that is not kept whole."""

Items = Mapping[str, str]
"""Answers as text, by name."""


def digest(content: str | bytes) -> str:
    """Return a short hash of a text or of bytes."""
    if isinstance(content, str):
        content = content.encode("utf-8", "surrogatepass")
    return hashlib.sha256(content).hexdigest()[:16]


def abridged(text: str, longest: int = LONGEST, head: int = HEAD) -> str:
    """Return a text of few, short lines; hashes stand for the rest, so that all of it counts."""
    lines = text.splitlines()
    kept = lines if len(lines) <= longest else lines[:head]
    short = [
        line if len(line) <= WIDEST else f"{line[:WIDEST]}… {len(line)} characters, {digest(line)}"
        for line in kept
    ]
    if len(kept) < len(lines):
        short.append(f"… {len(lines)} lines, {digest(text)}")
    return "\n".join(short)


def short(items: Items) -> dict[str, str]:
    """Return items abridged, files above all: what a command prints shows their numbers too."""
    return {
        name: abridged(text, 12, 6) if FILE in name else abridged(text)
        for name, text in items.items()
    }


def dumped(items: Items) -> str:
    """Return the content of a file of records."""
    parts = []
    for name in sorted(items):
        parts += [f"== {name}", *(f"  {line}".rstrip(" ") for line in items[name].splitlines())]
    return "\n".join(parts) + "\n"


def loaded(content: str) -> dict[str, str]:
    """Return the items of a file of records."""
    found: dict[str, list[str]] = {}
    lines: list[str] = []
    for line in content.split("\n")[:-1]:
        if line.startswith("== "):
            lines = found.setdefault(line[3:], [])
        else:
            lines.append(line[2:])
    return {name: "\n".join(kept) for name, kept in found.items()}


def moved(before: Items, now: Items) -> dict[str, str]:
    """Return the items that are new, gone or different, with the first lines that differ."""
    found = {}
    for name in sorted(before.keys() | now.keys()):
        if name not in now:
            found[name] = f"gone: {name}"
        elif name not in before:
            found[name] = f"new: {name}"
        elif before[name] != now[name]:
            pair = before[name].splitlines(), now[name].splitlines()
            lines = list(difflib.unified_diff(*pair, lineterm="", n=0))[2:]
            lines = [line for line in lines if not line.startswith("@@")]
            more = [f"… {len(lines) - SHOWN} more lines"] if len(lines) > SHOWN else []
            found[name] = "\n".join([f"moved: {name}", *(f"  {x}" for x in lines[:SHOWN] + more)])
    return found


def apart(recorded: str, text: str) -> str:
    """Return the first line of an item that differs from its record by more than rounding.

    Parameters
    ----------
    recorded
        An item as it was recorded, abridged; hashes and what they stand for are not compared.
    text
        The item now, whole.

    Returns
    -------
    str
        The line as it is now and as it was; empty where there is none.
    """
    before, now = recorded.splitlines(), text.splitlines()
    if before and before[-1].startswith("… "):
        if before[-1].split(",")[0] != f"… {len(now)} lines":
            return f"{len(now)} lines, not {before[-1]}"
        before.pop()
        now = now[: len(before)]
    if len(before) != len(now):
        return f"{len(now)} lines, not {len(before)}"
    for was, line in zip(before, now, strict=True):
        pieces, others = _NUMBER.split(line.rstrip(" ")), _NUMBER.split(was)
        if _CUT.search(was):  # what is kept may end inside a word
            others = _NUMBER.split(was[:WIDEST].rpartition(" ")[0])[:-1]
            pieces = pieces[: len(others)]
        if len(pieces) != len(others) or not all(map(_same, others, pieces)):
            return f"{line[:WIDEST]}, not {was}"
    return ""


def _same(was: str, piece: str) -> bool:
    """Return whether two pieces of lines are the same words, or numbers but for rounding."""
    if was == piece or (re.fullmatch(_HASH, was) and re.fullmatch(_HASH, piece)):
        return True
    if re.fullmatch(_HEXADECIMAL, was) and re.fullmatch(_HEXADECIMAL, piece):
        before, now = float.fromhex(was), float.fromhex(piece)
        return math.isclose(before, now, rel_tol=ROUNDED, abs_tol=TINY)
    try:
        before, now = float(was), float(piece)
    except ValueError:
        return False
    digits, _, power = was.partition("e")
    last = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
    shown = abs(before) >= 100.0 * last
    return math.isclose(before, now, rel_tol=ROUNDED, abs_tol=max(TINY, shown * 1.01 * last))
