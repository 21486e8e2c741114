"""Files as they go wrong: cut, garbled, re-encoded, with counts that are not true; from a seed."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

Outcome = Literal["same", "refused", "any"]
"""What must come of a file: the same samples, an error, or either."""


@dataclass(frozen=True, kw_only=True)
class Mutation:
    """A file that is not as it should be."""

    kind: str
    data: bytes
    outcome: Outcome


def mutation(base: bytes, rng: np.random.Generator) -> Mutation:
    """Return one file made of another in a way that chance picks."""
    name = sorted(KINDS)[rng.integers(len(KINDS))]
    make, outcome = KINDS[name]
    return Mutation(kind=name, data=make(base, rng), outcome=outcome)


def _lines(base: bytes) -> list[bytes]:
    return base.split(b"\n")


def _cut(base: bytes, rng: np.random.Generator) -> bytes:
    return base[: rng.integers(len(base))]


def _cut_at_a_line(base: bytes, rng: np.random.Generator) -> bytes:
    lines = _lines(base)
    return b"\n".join(lines[: rng.integers(len(lines) - 1)])


def _without_a_line(base: bytes, rng: np.random.Generator) -> bytes:
    lines = _lines(base)
    del lines[rng.integers(len(lines))]
    return b"\n".join(lines)


def _line_twice(base: bytes, rng: np.random.Generator) -> bytes:
    lines = _lines(base)
    at = rng.integers(len(lines))
    return b"\n".join([*lines[:at], lines[at], *lines[at:]])


def _lines_swapped(base: bytes, rng: np.random.Generator) -> bytes:
    lines = _lines(base)
    one, other = rng.integers(len(lines), size=2)
    lines[one], lines[other] = lines[other], lines[one]
    return b"\n".join(lines)


def _garbled(base: bytes, rng: np.random.Generator) -> bytes:
    data = bytearray(base)
    for at in rng.integers(len(data), size=rng.integers(1, 20)):
        data[at] = rng.integers(256)
    return bytes(data)


def _garbled_header(base: bytes, rng: np.random.Generator) -> bytes:
    data = bytearray(base)
    for at in rng.integers(min(len(data), 2500), size=rng.integers(1, 8)):
        data[at] = rng.integers(32, 127)
    return bytes(data)


def _inserted(base: bytes, rng: np.random.Generator) -> bytes:
    at = rng.integers(len(base))
    return base[:at] + rng.bytes(int(rng.integers(1, 60))) + base[at:]


def _taken_out(base: bytes, rng: np.random.Generator) -> bytes:
    at, length = rng.integers(len(base)), rng.integers(1, 400)
    return base[:at] + base[at + length :]


def _number_replaced(base: bytes, rng: np.random.Generator) -> bytes:
    """Return the file with a number of its first lines made one that it cannot be."""
    found = list(re.finditer(rb"[0-9.]+", base[:3000]))
    number = found[rng.integers(len(found))]
    odd = [
        b"1000000000000",
        b"-5",
        b"0",
        b"nan",
        b"1e400",
        b"9" * 60,
        b"",
        b"*****",
        b"0.5",
        b"1E9",
    ]
    return base[: number.start()] + odd[rng.integers(len(odd))] + base[number.end() :]


def _starred(base: bytes, rng: np.random.Generator) -> bytes:
    """Return the file with one of its last numbers as Fortran writes what does not fit."""
    found = list(re.finditer(rb"[0-9]+\.[0-9]+|[0-9]{4,}", base))
    number = found[-int(rng.integers(1, len(found) // 6))]
    return base[: number.start()] + b"*" * len(number[0]) + base[number.end() :]


def _with_ends(end: bytes) -> Callable[[bytes, np.random.Generator], bytes]:
    return lambda base, _rng: base.replace(b"\n", end)


def _mixed_ends(base: bytes, rng: np.random.Generator) -> bytes:
    ends = (b"\n", b"\r\n", b"\r\r\n")
    lines = _lines(base)
    return b"".join(
        line + ends[n] for line, n in zip(lines, rng.integers(3, size=len(lines)), strict=True)
    )


def _with_mark(base: bytes, _rng: np.random.Generator) -> bytes:
    return b"\xef\xbb\xbf" + base


def _sixteen_bits(base: bytes, _rng: np.random.Generator) -> bytes:
    return base.decode("latin-1").encode("utf-16")


def _padded(base: bytes, rng: np.random.Generator) -> bytes:
    return base + (b"\x00", b"\x1a", b" \n", b"\n")[rng.integers(4)] * int(rng.integers(1, 3000))


def _spaced(base: bytes, _rng: np.random.Generator) -> bytes:
    return base.replace(b"\n", b"   \n")


def _binary(_base: bytes, rng: np.random.Generator) -> bytes:
    return rng.bytes(int(rng.integers(1, 9000)))


def _blank(_base: bytes, rng: np.random.Generator) -> bytes:
    return (b"", b" ", b"\n" * 50, b"\x00" * 900, b" \t \r\n")[rng.integers(5)]


def _long_line(base: bytes, rng: np.random.Generator) -> bytes:
    fill = (b" ", b"1", b"a", b"-", b"1 ", b"NPTS ", b":", b"(", b",")[rng.integers(9)]
    lines = _lines(base)
    at = int(rng.integers(min(len(lines), 30)))
    return b"\n".join([*lines[:at], lines[at] + fill * 200_000, *lines[at + 1 :]])


def _without_header(base: bytes, rng: np.random.Generator) -> bytes:
    lines = _lines(base)
    return b"\n".join(lines[rng.integers(1, len(lines) // 2) :])


def _words_garbled(base: bytes, rng: np.random.Generator) -> bytes:
    """Return the file with a letter of a foreign alphabet, in Latin-1, below its first line."""
    place = re.compile(rb"(?<=[a-z])[a-z](?=[a-z])")
    found = [one for one in place.finditer(base[:600]) if one.start() > base.index(b"\n")]
    if not found:
        return base
    at = found[rng.integers(len(found))].start()
    return base[:at] + b"\xe9" + base[at + 1 :]


KINDS: Final[dict[str, tuple[Callable[[bytes, np.random.Generator], bytes], Outcome]]] = {
    "binary": (_binary, "refused"),
    "blank": (_blank, "refused"),
    "byte order mark": (_with_mark, "same"),
    "carriage returns": (_with_ends(b"\r"), "same"),
    "cut": (_cut, "any"),
    "cut at a line": (_cut_at_a_line, "any"),
    "garbled": (_garbled, "any"),
    "garbled header": (_garbled_header, "any"),
    "inserted": (_inserted, "any"),
    "latin-1": (_words_garbled, "any"),
    "line twice": (_line_twice, "any"),
    "lines of DOS": (_with_ends(b"\r\n"), "same"),
    "lines of DOS, twice": (_with_ends(b"\r\r\n"), "same"),
    "lines swapped": (_lines_swapped, "any"),
    "long line": (_long_line, "any"),
    "mixed line ends": (_mixed_ends, "same"),
    "number replaced": (_number_replaced, "any"),
    "padded": (_padded, "same"),
    "sixteen bits": (_sixteen_bits, "same"),
    "spaces": (_spaced, "same"),
    "starred": (_starred, "refused"),
    "taken out": (_taken_out, "any"),
    "without a line": (_without_a_line, "any"),
    "without header": (_without_header, "any"),
}
