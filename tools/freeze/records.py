"""Records of answers: one text file per part, in which each item has a name and a few lines."""

import difflib
import hashlib
import math
import re
from collections.abc import Mapping, Sequence
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
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_HEXADECIMAL, _HASH = r"-?0x[01](?:\.[0-9a-f]+)?p[+-]\d+", r"\b[0-9a-f]{16}\b"
_NUMBER = re.compile(rf"({_HEXADECIMAL}|{_HASH}|-?\b\d+(?:\.\d*(?:e[+-]?\d+)?|e[+-]?\d+))")
"""Numbers of a record that are not whole, and hashes."""
_CUT = re.compile(rf"… \d+ (?:characters|lines), {_HASH}, ({_HASH}) (\S+) ± (\S+)$")
"""Ends a line, or the lines, of an item that is not kept whole: with what stands for its rest."""

Items = Mapping[str, str]
"""Answers as text, by name."""


def digest(content: str | bytes) -> str:
    """Return a short hash of a text or of bytes."""
    if isinstance(content, str):
        content = content.encode("utf-8", "surrogatepass")
    return hashlib.sha256(content).hexdigest()[:16]


def abridged(text: str, longest: int = LONGEST, head: int = HEAD) -> str:
    """Return a text of few, short lines; hashes stand for the rest, so that all of it counts."""
    lines = [line.rstrip(" ") for line in text.splitlines()]
    kept = lines if len(lines) <= longest else lines[:head]
    short = [
        line
        if len(line) <= WIDEST
        else f"{line[:WIDEST]}… {len(line)} characters, {digest(line)}, {_rest(_parts(line)[1])}"
        for line in kept
    ]
    if len(kept) < len(lines):
        rest = _rest(_NUMBER.split("\n".join(lines[head:])))
        short.append(f"… {len(lines)} lines, {digest(text)}, {rest}")
    return "\n".join(short)


def _parts(line: str, kept: int | None = None) -> tuple[list[str], list[str]]:
    """Return words and numbers in turn: those of a line that are kept whole, and its rest."""
    pieces = _NUMBER.split(line)
    if kept is None:  # what is kept may end inside a word
        kept = len(_NUMBER.split(line[:WIDEST].rpartition(" ")[0])) - 1
    return pieces[:kept], pieces[kept:]


def _rest(pieces: Sequence[str]) -> str:
    """Return what stands for words and numbers in turn: a hash of the words, a sum of the numbers.

    Each number counts by its place and by its inverse hyperbolic sine, so that small ones count
    beside large ones; behind the sum stands by how much independent roundings may change it.
    """
    total, allowed = [], []
    for place, piece in enumerate(pieces[1::2]):
        value = _value(piece)
        if value is not None and math.isfinite(value):
            weight = 1.0 + place * GOLDEN % 1.0  # no two places weigh the same
            total.append(weight * math.asinh(value))
            allowed.append(weight * _rounding(piece, value) / math.hypot(1.0, value))
    return f"{digest('#'.join(pieces[::2]))} {math.fsum(total):.12g} ± {math.hypot(*allowed):.2g}"


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
        An item as it was recorded, abridged; of what is not kept there, words are compared by a
        hash and numbers by a sum.
    text
        The item now, whole.

    Returns
    -------
    str
        The line as it is now and as it was; empty where there is none.
    """
    before = recorded.splitlines()
    now = [line.rstrip(" ") for line in text.splitlines()]
    if before and before[-1].startswith("… "):
        last = before.pop()
        if last.split(",")[0] != f"… {len(now)} lines":
            return f"{len(now)} lines, not {last}"
        if not _same_rest(last, _NUMBER.split("\n".join(now[len(before) :]))):
            return f"other lines after the first {len(before)}, not {last}"
        now = now[: len(before)]
    if len(before) != len(now):
        return f"{len(now)} lines, not {len(before)}"
    for was, line in zip(before, now, strict=True):
        kept, rest = _NUMBER.split(was), [""]
        pieces = _NUMBER.split(line)
        if _CUT.search(was):
            kept, _ = _parts(was)
            pieces, rest = _parts(line, len(kept))
        if len(pieces) != len(kept) or not all(map(_same, kept, pieces)):
            return f"{line[:WIDEST]}, not {was}"
        if not _same_rest(was, rest):
            return f"another end of {line[:WIDEST]}, not {was}"
    return ""


def _same_rest(was: str, pieces: Sequence[str]) -> bool:
    """Return whether words and numbers in turn are those that are recorded, but for rounding."""
    before = _CUT.search(was)
    if before is None:
        return list(pieces) == [""]
    words, total, *_ = _rest(pieces).split(" ")
    return before[1] == words and abs(float(before[2]) - float(total)) <= float(before[3])


def _same(was: str, piece: str) -> bool:
    """Return whether two pieces of lines are the same words, or numbers but for rounding."""
    if was == piece or (re.fullmatch(_HASH, was) and re.fullmatch(_HASH, piece)):
        return True
    before, now = _value(was), _value(piece)
    if before is None or now is None or ("x" in was) != ("x" in piece):
        return False
    return abs(before - now) <= _rounding(was, before)


def _value(piece: str) -> float | None:
    """Return the number that a piece is; none where it is a hash or words."""
    if re.fullmatch(_HEXADECIMAL, piece):
        return float.fromhex(piece)
    return float(piece) if _NUMBER.fullmatch(piece) and not re.fullmatch(_HASH, piece) else None


def _rounding(piece: str, value: float) -> float:
    """Return by how much a number may differ on another processor."""
    digits, _, power = piece.partition("e")
    last = 0.0 if "x" in piece else float(f"1e{int(power or 0) - len(digits.partition('.')[2])}")
    shown = abs(value) >= 100.0 * last
    return max(ROUNDED * abs(value), TINY, shown * 1.01 * last)
