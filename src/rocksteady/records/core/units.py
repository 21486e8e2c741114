"""Units written by files and users, understood as a whole or refused.

A unit is a number, or none, and units with prefixes and powers: ``10^-3 g``, ``cm/s/s``, ``% g``.
What is not consumed to its last character is no unit, so that no part of one is taken for it. One g
is standard gravity and one gal 1 cm/s^2, both by definition.
"""

import math
import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import repeat
from typing import Final

from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY

COUNTS: Final = "counts"
"""What a file holds whose numbers are an instrument's, with or without their scale."""

UNITS: Final = {
    "g": STANDARD_GRAVITY,
    "mg": 1.0e-3 * STANDARD_GRAVITY,
    "m/s^2": 1.0,
    "cm/s^2": 1.0e-2,
    "mm/s^2": 1.0e-3,
    "gal": 1.0e-2,
    "mgal": 1.0e-5,
    "in/s^2": 0.0254,
    "ft/s^2": 0.3048,
}
"""Units by name, each with its size in m/s^2."""

_ACCELERATION: Final = (1, -2)
_TIME: Final = (0, 1)
_RATE: Final = (0, -1)
_QUANTITIES: Final = {_ACCELERATION: "acceleration", (1, -1): "velocity", (1, 0): "displacement"}
_COUNTS: Final = re.compile(r"counts?|cnts?|lsb|(?:digital|ad|raw) ?counts?|bits?|m?v|volts?")
"""What an instrument's numbers are in before its scale is applied."""

_BASES: Final[dict[str, tuple[float, tuple[int, int]]]] = {
    **dict.fromkeys(("g", "gs", "g's", "gee", "gees", "gn", "g0", "gravity"), (9.80665, (1, -2))),
    **dict.fromkeys(("gal", "gals"), (0.01, (1, -2))),
    **dict.fromkeys(("m", "meter", "meters", "metre", "metres"), (1.0, (1, 0))),
    **dict.fromkeys(("in", "inch", "inches"), (0.0254, (1, 0))),
    **dict.fromkeys(("ft", "foot", "feet"), (0.3048, (1, 0))),
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "seg", "sek", "sn"), (1.0, (0, 1))),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), (60.0, (0, 1))),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), (3600.0, (0, 1))),
    **dict.fromkeys(("hz", "hertz", "sps", "cps"), (1.0, (0, -1))),
    **dict.fromkeys(("sample", "samples", "pts", "points", "cycles", "muestras"), (1.0, (0, 0))),
}
"""Size in SI and powers of length and time of what may have a prefix, or not."""

_PREFIXES: Final = {
    **dict.fromkeys(("milli", "m"), 1e-3),
    **dict.fromkeys(("micro", "u"), 1e-6),
    **dict.fromkeys(("centi", "c"), 1e-2),
    **dict.fromkeys(("deci", "d"), 1e-1),
    **dict.fromkeys(("kilo", "k"), 1e3),
}
_WITH_PREFIX: Final = frozenset(
    {"g", "gee", "gal", "gals", "m", "meter", "meters", "metre", "metres", "s", "sec", "secs"}
    | {"second", "seconds", "hz", "hertz"}
)
_NEVER: Final = frozenset({"kg", "ks", "ksec", "km", "kgal", "mhz", "dm", "um"})
"""Prefixes and units that mean another quantity, or that no record is written in."""

_MEGA: Final = re.compile(r"\bM(?:g|m|s|G?gal|Gal|Hz)")
"""A capital M before a small letter is no thousandth; in capitals alone, ``MG``, it is."""

_SUPERSCRIPTS: Final = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-")
_RAISED: Final = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+")
_LOOK_ALIKES: Final = str.maketrans({"×": "*", "·": "*", "⋅": "*", "∙": "*", "−": "-", "μ": "u"})
_TOKEN: Final = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)|(?P<percent>%|percent\b)(?:\s*of\b)?"
    r"|(?P<power>\*\*|\^|-?\bsquared\b)|(?P<over>/|\bper\b)|(?P<times>[*.x](?=\s*[\w%(]))"
    r"|(?P<open>\()|(?P<close>\))|(?P<sign>[+-](?=\d))|(?P<unit>[a-z]+0(?![\w.])|g's\b|[a-z]+))"
)
_SHORT: Final = re.compile(r"(?P<length>[cm]?m|in|ft)(?P<time>s(?:ec)?)-2")
"""``ms-2``: metres and seconds, which would else be a millisecond."""


class _NoUnitError(Exception):
    """A text that is no unit as a whole."""


@dataclass
class _Tokens:
    """The parts of a unit, and how many of them have been taken."""

    parts: list[tuple[str, str, bool]]
    at: int = 0

    def kind(self) -> str:
        """Return the kind of the next part; nothing at the end."""
        return self.parts[self.at][0] if self.at < len(self.parts) else ""

    def take(self) -> tuple[str, bool]:
        """Return the next part, and whether it follows the one before without a blank."""
        _, text, close = self.parts[self.at]
        self.at += 1
        return text, close


def _plain(written: str) -> str:
    """Return a unit in small letters of ASCII, powers behind ``^``."""
    if _MEGA.search(written):
        return ""
    raised = _RAISED.sub(lambda match: "^" + match[0].translate(_SUPERSCRIPTS), written.strip())
    text = unicodedata.normalize("NFKC", raised).translate(_LOOK_ALIKES).lower()
    text = text.translate(_LOOK_ALIKES).replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    text = re.sub(r"(milli|micro|centi)-(?=[a-z])", r"\1", text).strip(" \"'")
    while text[:1] + text[-1:] in {"()", "[]"} and "(" not in text[1:-1]:
        text = text[1:-1].strip()
    return re.sub(r"(?<=[a-z0-9])\.$", "", text)


@lru_cache(maxsize=1024)
def _parsed(written: str) -> tuple[float, tuple[int, int]] | None:
    """Return the size in SI of a unit and its powers of length and time, or None."""
    text = _plain(written)
    text = _SHORT.sub(r"\g<length> \g<time>-2", text)
    parts: list[tuple[str, str, bool]] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None or match.lastgroup is None:
            return None
        name = match.lastgroup
        parts.append((name, match[name], not match[0][:1].isspace()))
        at = match.end()
    if not parts or len(parts) > 24:
        return None
    motion = None
    for together in (False, True):
        tokens = _Tokens(parts)
        try:
            size, powers = _product(tokens, together=together)
        except (_NoUnitError, OverflowError, ZeroDivisionError):
            return None
        if tokens.kind() or not math.isfinite(size) or size <= 0.0:
            return None
        if powers in {_ACCELERATION, _TIME, _RATE}:
            return size, powers
        motion = motion or ((size, powers) if powers in _QUANTITIES else None)
    return motion


def _product(tokens: _Tokens, *, together: bool) -> tuple[float, tuple[int, int]]:
    """Return size and powers of factors, up to the end or a closing bracket.

    Parameters
    ----------
    tokens
        The unit.
    together
        Whether all that follows a stroke stands below it, as in ``cm/s.s``.
    """
    size, powers, below, units = 1.0, (0, 0), False, 0
    first, numbered = True, False
    while tokens.kind() not in {"", "close"}:
        divides = separated = False
        if tokens.kind() in {"over", "times"}:
            divides = tokens.kind() == "over"
            # 1/s and /s are rates; a factor alone before a unit is none.
            if first and not divides:
                raise _NoUnitError
            tokens.take()
            separated = True
        below = divides or (below and together)
        number = tokens.kind() in {"number", "percent"}
        # Behind a unit it is not clear which of the two it multiplies; 3 4 are no number.
        if number and not divides and (units or (numbered and not separated)):
            raise _NoUnitError
        numbered = number
        factor, exponents = _factor(tokens, together=together)
        if units and not divides and exponents == (0, 0):  # cm/sec2(04)
            raise _NoUnitError
        units += not number
        sign = -1 if below else 1
        size *= _raised(factor, sign)
        powers = (powers[0] + sign * exponents[0], powers[1] + sign * exponents[1])
        first = False
    if first:
        raise _NoUnitError
    return size, powers


def _factor(tokens: _Tokens, *, together: bool) -> tuple[float, tuple[int, int]]:
    """Return size and powers of a number or a unit with its power."""
    kind = tokens.kind()
    if kind == "open":
        tokens.take()
        size, powers = _product(tokens, together=together)
        if tokens.kind() != "close":
            raise _NoUnitError
        tokens.take()
    elif kind == "percent":
        tokens.take()
        return 0.01, (0, 0)
    elif kind == "number":
        size, powers = float(tokens.take()[0]), (0, 0)
    elif kind == "unit":
        size, powers = _unit(tokens)
    else:
        raise _NoUnitError
    power = _power(tokens, bare=kind == "unit")
    return _raised(size, power), (powers[0] * power, powers[1] * power)


def _raised(size: float, power: int) -> float:
    """Return a whole power as a product."""
    product = math.prod(repeat(size, abs(power)))
    return product if power >= 0 else 1.0 / product


def _unit(tokens: _Tokens) -> tuple[float, tuple[int, int]]:
    """Return size and powers of a unit with its prefix, which may stand apart."""
    word, _ = tokens.take()
    if word in {"milli", "micro", "centi"} and tokens.kind() == "unit":
        next_word, _ = tokens.take()
        if next_word not in _WITH_PREFIX:
            raise _NoUnitError
        size, powers = _BASES[next_word]
        return _PREFIXES[word] * size, powers
    if word == "standard" and tokens.kind() == "unit":
        word, _ = tokens.take()
    if word in _BASES:
        return _BASES[word]
    for prefix, factor in _PREFIXES.items():
        rest = word[len(prefix) :]
        if word.startswith(prefix) and rest in _WITH_PREFIX:
            if word in _NEVER:
                raise _NoUnitError
            size, powers = _BASES[rest]
            return factor * size, powers
    raise _NoUnitError


def _power(tokens: _Tokens, *, bare: bool) -> int:
    """Return the power that follows: ``^-2``, ``**2``, ``squared``, and behind a unit 2 or -2."""
    if tokens.kind() == "power":
        if "squared" in tokens.take()[0]:
            return 2
        bracket = tokens.kind() == "open"
        if bracket:
            tokens.take()
    elif not (bare and tokens.kind() in {"number", "sign"} and tokens.parts[tokens.at][2]):
        return 1
    else:
        bracket = False
    sign = 1
    if tokens.kind() == "sign":
        sign = -1 if tokens.take()[0] == "-" else 1
    if tokens.kind() != "number":
        raise _NoUnitError
    written, _ = tokens.take()
    if not written.isdecimal() or len(written) > 2:
        raise _NoUnitError
    if bracket:
        if tokens.kind() != "close":
            raise _NoUnitError
        tokens.take()
    return sign * int(written)


def acceleration_unit(written: str) -> str | None:
    """Return the name of a unit of acceleration, however it is written, or None.

    Parameters
    ----------
    written
        As written by a file or a user: ``CM/S/S``, ``cm/sec2``, ``Gal``, ``m s-2``, ``10^-3 g``.

    Examples
    --------
    >>> [acceleration_unit(text) for text in ("G", "cm/sec/sec", "m s-2", "milli g", "km/h")]
    ['g', 'cm/s^2', 'm/s^2', 'mg', None]
    >>> acceleration_unit("% of g"), acceleration_unit("cm/s2 x 10")
    ('% of g', None)
    """
    if len(written) > 60:
        return None
    parsed = _parsed(written)
    if parsed is None or parsed[1] != _ACCELERATION:
        return None
    plain = _plain(written)
    if plain in UNITS:
        return plain
    named = (name for name, size in UNITS.items() if math.isclose(size, parsed[0], rel_tol=1e-12))
    # A gal is a cm/s^2: the name is that of the word.
    word = {"gal": "gal", "gals": "gal", "mgals": "mgal"}.get(plain)
    return word or next(named, plain)


def in_seconds(written: str) -> float | None:
    """Return the size of a unit of time [s], or the time between samples at a unit of rates [s].

    Examples
    --------
    >>> [in_seconds(text) for text in ("ms", "min", "Hz", "kHz", "samples/min", "10^-3 s", "g")]
    [0.001, 60.0, -1.0, -0.001, -60.0, 0.001, None]

    Notes
    -----
    That of a rate is negative: 100 in such a unit are its size divided by 100.
    """
    parsed = _parsed(written) if len(written) <= 60 else None
    if parsed is None or parsed[1] not in {_TIME, _RATE}:
        return None
    return parsed[0] if parsed[1] == _TIME else -1.0 / parsed[0]


def quantity_of(written: str) -> str | None:
    """Return the quantity that a unit is one of: acceleration, velocity, displacement, counts.

    Examples
    --------
    >>> [quantity_of(unit) for unit in ("gal", "CM/SEC", "mm", "Counts", "kPa", "M")]
    ['acceleration', 'velocity', 'displacement', 'counts', None, 'displacement']
    """
    parsed = _parsed(written) if len(written) <= 60 else None
    if parsed is None:
        return "counts" if _COUNTS.fullmatch(_plain(written).rpartition("/")[2]) else None
    return _QUANTITIES.get(parsed[1])


_MODIFIES: Final = re.compile(
    r"[\s(\[,;]*(?:[*/^%]|x\s*[\d(]|(?:[\d.]+\s*[*x])|10\s*\^|\d+\s*[eE]|[-+]?(?:\d+\.?\d*|\.\d+)\.?(?:$|[\s)*x])"
    r"|(?:times|divided|multipl\w*|scaled?|factor|per\b|percent|milli|micro|raised|squared|cubed"
    r"|over\b|mult\b|to the)\b)",
    re.IGNORECASE,
)


def leading(
    text: str, known: Callable[[str], object] = acceleration_unit
) -> tuple[str | None, str]:
    """Return the longest unit that a text begins with, up to a blank or a mark, and the rest.

    Parameters
    ----------
    text
        What follows ``in`` or ``units:``.
    known
        Which units are looked for: `acceleration_unit`, `in_seconds` (of time and of rates) or
        `quantity_of` (of any motion).

    Examples
    --------
    >>> leading("G. FILTER POINTS: HP=0.2"), leading("of no kind")
    (('G.', ' FILTER POINTS: HP=0.2'), (None, 'of no kind'))
    """
    ends = [
        match.start() for match in re.finditer(r"$|[\s,;:)\]]|\.(?=\s|$)|\((?!\s*s)", text[:120])
    ]
    for end in sorted({*ends}, reverse=True):
        piece = text[:end]
        if piece.strip() and known(piece) is not None:
            return piece.strip(), text[end:]
    return None, text


def modifies(rest: str) -> bool:
    """Return whether what follows a unit changes its size: a number, a sign or a word for it.

    Examples
    --------
    >>> [modifies(rest) for rest in (" (MULTIPLIED BY 981)", " x 10", ". FILTER POINTS", ", HUT")]
    [True, True, False, False]
    """
    return _MODIFIES.match(rest) is not None


def unit_named(units: object, name: str = "units") -> str:
    """Return the package's word for a unit of acceleration that a caller names.

    Raises
    ------
    InputError
        If the unit is not known; the message calls it `name`.
    """
    factor = acceleration_unit(units) if isinstance(units, str) else None
    if factor is None:
        raise InputError(
            name, units, "it must be a unit of acceleration", f"use one of {', '.join(UNITS)}"
        )
    return factor


def in_m_s2(units: str) -> float:
    """Return the size of a unit of acceleration in m/s^2.

    Raises
    ------
    InputError
        If it is not a unit of acceleration.

    Examples
    --------
    >>> in_m_s2("g"), in_m_s2("cm/s/s"), in_m_s2("1e-2 m/s2")
    (9.80665, 0.01, 0.01)
    """
    name = unit_named(units)
    parsed = _parsed(name)
    return UNITS.get(name, parsed[0] if parsed else math.nan)
