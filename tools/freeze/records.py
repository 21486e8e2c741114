"""Records of answers: one text file per part, in which each item has a name and a few lines."""

import difflib
import hashlib
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
