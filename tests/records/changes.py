"""Files whose words or numbers are changed in a way whose consequence is known; from a seed."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

G: Final = 9.80665

Verdict = Literal["as before", "not same", "scaled", "same numbers", "prefix", "turned"]
"""What must come of a file that is neither refused nor warned about.

``as before``: the same samples at the same interval. ``not same``: nothing, it must be refused or
warned about. ``scaled``: the samples times a factor. ``same numbers``: the samples in any order.
``prefix``: as many of the samples as both have. ``turned``: the samples with the other sign, noted.
"""


@dataclass(frozen=True, kw_only=True)
class Change:
    """A file that is changed, and what must come of it."""

    kind: str
    data: bytes
    verdict: Verdict
    factor: float = 1.0


UNITS: Final = {
    "peer-at2": rb"(?<=UNITS OF )G\b",
    "peer-at2, old": rb"(?<=UNITS OF )G\b",
    "esm-ascii": rb"(?<=\nUNITS: )cm/s\^2",
    "csv": rb"(?<=acc \()g(?=\))",
    "columns with words": rb"(?<=units: )g\b",
    "csmip-v2": rb"(?<=sec, in )cm/sec2(?=\.)",
    "cosmos-v2": rb"(?<=units=)cm/sec2(?=\()",
}
OF_BASE: Final = {"esm-ascii": 0.01, "csmip-v2": 0.01, "cosmos-v2": 0.01}
"""Size of the unit of a file as it should be [m/s^2]; 1 g in the others."""
WORDS: Final[dict[str, float | None]] = {
    **dict.fromkeys(("milli g", "10^-3 g", "1e-3 g", "0.001 g", "MG", "g/1000"), 1e-3 * G),
    **dict.fromkeys(("% of g", "%g"), 1e-2 * G),
    **dict.fromkeys(("cm/s/s", "gal", "1e-2 m/s2"), 0.01),
    **dict.fromkeys(("m/s**2", "m per s per s", "ms-2"), 1.0),
    "micro g": 1e-6 * G,
    "mm s-2": 1e-3,
    "mGal": 1e-5,
    "in/s2": 0.0254,
    "ft/s^2": 0.3048,
    **dict.fromkeys(("g x 1000", "x1000 g", "counts", "g^2", "cm/s", "cm", "V", "kg", "g/Hz")),
    **dict.fromkeys(("cm/s2 x 10", "thousandths of g", "LSB", "1000*g", "g-s", "Mg")),
    "g (multiplied by 981)": None,
}
"""Units that may be written in place of that of a file [m/s^2]; None where none is understood."""
COUNTS: Final = {
    "peer-at2": rb"(?<=NPTS=)\s*\d+",
    "peer-at2, old": rb"(?<=\n)\d+(?= \S+ NPTS)",
    "esm-ascii": rb"(?<=\nNDATA: )\d+",
    "knet": rb"(?<=Duration Time\(s\))\s*\d+",
    "cosmos-v2": rb"(?<=\n)\s*\d+(?=\s+acceleration pts,)",
    "csmip-v2": rb"(?<=\n)\s*\d+(?= points of accel data)",
    "columns with words": rb"(?<=NUMBER OF DATA : )\d+",
}
INTERVALS: Final = {
    "esm-ascii": rb"(?<=\nSAMPLING_INTERVAL_S: )[\d.]+",
    "knet": rb"(?<=Sampling Freq\(Hz\))\s*\d+",
    "csmip-v2": rb"(?<=accel data equally spaced at)\s*[\d.]+",
    "smc": rb"(?<=\n)(?<=\n)\s*1\.7000000E\+38\s+[\d.]+E\+\d+",
}
DATA: Final = {
    "csv": 1,
    "columns": 0,
    "peer-at2": 4,
    "peer-at2, old": 4,
    "esm-ascii": 14,
    "knet": 17,
    "columns with words": 3,
}
"""Lines before the samples of formats that have one block of them."""
TABLES: Final = {"csv", "columns", "columns with words"}


def _replaced(pattern: bytes, base: bytes, new: bytes) -> bytes | None:
    found = re.search(pattern, base)
    return None if found is None else base[: found.start()] + new + base[found.end() :]


def _unit(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in UNITS:
        return None
    word = sorted(WORDS)[rng.integers(len(WORDS))]
    size = WORDS[word]
    data = _replaced(UNITS[name], base, word.encode())
    assert data is not None
    if size is None:
        return Change(kind="unit", data=data, verdict="not same")
    return Change(kind="unit", data=data, verdict="scaled", factor=size / OF_BASE.get(name, G))


def _count(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in COUNTS:
        return None
    found = re.search(COUNTS[name], base)
    assert found is not None
    old = int(found[0])
    new = int(old + (-1, 1, -old // 2, old, -2, 7)[rng.integers(6)])
    written = f"{new:{len(found[0])}d}".encode()
    data = base[: found.start()] + written + base[found.end() :]
    return Change(kind="count", data=data, verdict="not same")


def _interval(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in INTERVALS:
        return None
    factor = (0.5, 2.0, 10.0, 0.1)[rng.integers(4)]
    found = re.search(INTERVALS[name], base)
    assert found is not None
    *before, old = found[0].rsplit(maxsplit=1)
    new = f"{float(old) * factor:g}".rjust(len(old)).encode()
    head = before[0] + b" " if before else b" "
    data = base[: found.start()] + head + new + base[found.end() :]
    return Change(kind="interval", data=data, verdict="not same")


def _cut_in_the_last_number(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in DATA:
        return None
    text = base.rstrip()
    last = re.search(rb"[^\s,]+$", text)
    assert last is not None
    return Change(
        kind="cut inside the last number",
        data=text[: last.start() + int(rng.integers(1, len(last[0])))],
        verdict="not same",
    )


def _cut_inside_a_number(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in DATA:
        return None
    data_from = len(b"\n".join(base.split(b"\n")[: DATA[name] + 12]))
    at = int(rng.integers(data_from, len(base) - 1))
    return Change(
        kind="cut inside a number",
        data=base[:at],
        verdict="prefix" if name in TABLES - {"columns with words"} else "not same",
    )


def _surplus(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in DATA:
        return None
    lines = base.rstrip(b"\n").split(b"\n")
    more = lines[-1 - int(rng.integers(1, 30)) : -1]
    return Change(
        kind="surplus",
        data=b"\n".join([*lines, *more]) + b"\n",
        verdict="prefix" if name == "columns" else "not same",
    )


def _lines_swapped(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if name not in DATA:
        return None
    lines = base.rstrip(b"\n").split(b"\n")
    # The last line may be shorter than others.
    one, other = rng.choice(np.arange(DATA[name], len(lines) - 1), 2, replace=False)
    lines[one], lines[other] = lines[other], lines[one]
    return Change(
        kind="lines swapped",
        data=b"\n".join(lines) + b"\n",
        verdict="not same" if name == "csv" else "same numbers",
    )


def _header_swapped(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if DATA.get(name, 0) < 3:
        return None
    lines = base.split(b"\n")
    one, other = rng.choice(np.arange(DATA[name]), 2, replace=False)
    lines[one], lines[other] = lines[other], lines[one]
    return Change(kind="lines of the header swapped", data=b"\n".join(lines), verdict="as before")


def _across_swapped(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if DATA.get(name, 0) < 1:
        return None
    lines = base.split(b"\n")
    one, other = rng.integers(DATA[name]), rng.integers(DATA[name] + 1, len(lines) - 2)
    lines[one], lines[other] = lines[other], lines[one]
    return Change(kind="header and samples swapped", data=b"\n".join(lines), verdict="not same")


def _header_line_lost(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    if DATA.get(name, 0) < 3:
        return None
    lines = base.split(b"\n")
    del lines[rng.integers(DATA[name])]
    return Change(kind="line of the header lost", data=b"\n".join(lines), verdict="as before")


def _digit_lost(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    """Lose a digit of a sample where all have the same number of them."""
    if name not in DATA:
        return None
    start = len(b"\n".join(base.split(b"\n")[: DATA[name] + 12]))
    digits = [found.start() for found in re.finditer(rb"(?<=\.\d)\d", base[start:])]
    if name == "knet" or not digits:
        return None
    at = start + digits[rng.integers(len(digits))]
    return Change(kind="digit lost", data=base[:at] + base[at + 1 :], verdict="not same")


def _downwards(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    word = (b"DWN", b"Down", b"DN", b"down")[rng.integers(4)]
    places = {
        **dict.fromkeys(("peer-at2", "peer-at2, old"), rb"(?<=West, )090"),
        "esm-ascii": rb"(?<=STREAM: )HNE",
        "knet": rb"(?<=Dir\.)\s+N-S",
        "csv": rb"(?<=acc) (?=\(g)",
    }
    if name not in places:
        return None
    data = _replaced(places[name], base, b" " + word + b" ")
    assert data is not None
    return Change(kind="downwards", data=data, verdict="turned")


CHANGES: Final[tuple[Callable[[str, bytes, np.random.Generator], Change | None], ...]] = (
    _unit,
    _unit,
    _count,
    _interval,
    _cut_in_the_last_number,
    _cut_inside_a_number,
    _surplus,
    _lines_swapped,
    _header_swapped,
    _across_swapped,
    _header_line_lost,
    _digit_lost,
    _downwards,
)


def change(name: str, base: bytes, rng: np.random.Generator) -> Change | None:
    """Return a changed file; None where chance picks what this format does not state."""
    return CHANGES[rng.integers(len(CHANGES))](name, base, rng)
