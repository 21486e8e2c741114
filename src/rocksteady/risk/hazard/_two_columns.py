"""Hazard curves as two columns: level, and annual rate, probability or return period."""

import math
import re
from collections.abc import Callable
from typing import Final

from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.records.core.units import acceleration_unit, in_m_s2
from rocksteady.risk.hazard._hazard_text import SEPARATORS, HazardText, numbers, rate_of, split
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.seismic.measures.scalar import Measure

_KINDS: Final = {
    "probability": r"prob|wahrsch|\baep\b|\bp\s?\(|\b[a-z]?po?e\b",
    "return period": r"return|recurrence|\bt ?r\b|\brp\b|retour|retorno|ritorno|kehrperiode",
    "rate": r"rate|taux|tass[oi]|tasa|\bm?afo?e\b|fr[eé][qc]|häufig|lambda|λ|/ ?(?:y|a\b)|per y",
}
"""What the second column may hold, in words of five languages."""
_YEARS: Final = re.compile(r"(\d+(?:[.,]\d+)?)[ -]?(?:y|a\b|an|añ|jahr)")
_ANNUAL: Final = re.compile(r"annu|anual|yearly|jährl|\bapo?e\b|\baep\b|per y|/ ?y")
_OTHER_TIME: Final = re.compile(r"month|week|day|hour|decade|centur|millen|ka\b|kyr")
_PERCENT: Final = re.compile(r"%|per ?cent|prozent")
_REMARK: Final = re.compile(r"#.*|^\s*(?:%|//).*")
_BRACKETS: Final = re.compile(r"[\[(]([^\[\]()]*)[\])]")
_GAP: Final = re.compile(r"\s{2,}|(?<=[\])])\s+")
"""Between names that blanks separate."""


def read_columns(text: HazardText) -> HazardCurve:
    """Return the curve of two columns.

    Raises
    ------
    InputError
        If a line is no pair of numbers, or what they are is not clear.
    """
    bare = ((at, _REMARK.sub("", line)) for at, line in text.lines.items())
    rows = [(at, line) for at, line in bare if line.strip()]
    starts = ((at, each) for each in SEPARATORS for at, line in rows if _values(line, each)[1:])
    first, separator = next(starts, (0, None))
    if not first:
        raise text.error("it has no line of two numbers from 0 on, and no columns poe-LEVEL")
    head = [(at, line) for at, line in text.lines.items() if at < first]
    at, names = _names(head, separator)
    points = []
    for number, line in rows:
        if number > at:
            values = _values(line, separator)
            if len(values) != 2 or ("." in line and "," in line and separator != ","):
                hint = 'give a level and a rate, as 0.25 and 1e-3; begin remarks with "#"'
                raise text.error(
                    "it must be two numbers from 0 on, below two names", hint, line=number
                )
            points.append((number, values[0], values[1]))
    if _kind(names[0]) and not _kind(names[1]):
        names = (names[1], names[0])
        points = [(number, level, rate) for number, rate, level in points]
    measure, unit = _level(text, names[0] or "a column without a name")
    to_rate = _rate(text, names[1])
    points = [(number, unit * level, to_rate(rate)) for number, level, rate in points]
    assumed = [] if names[1] or text.poe_years else ["The second column is taken as annual rates."]
    return text.curve(points, assumed, measure=measure)


def _values(line: str, separator: str | None) -> list[float]:
    """Return the numbers of a line; none if there is another text, or a negative number."""
    values = numbers(split(line, separator)[:4], separator)
    return values if all(value >= 0.0 for value in values) else []


def _names(head: list[tuple[int, str]], separator: str | None) -> tuple[int, tuple[str, str]]:
    """Return the line that names the columns, and the names; 0 and "" without one.

    Of several lines of two texts it is the last of those with the most known words.
    """
    best = (0, 0, ("", ""))
    for number, line in head:
        plain = line.strip().lstrip("#%/ ")
        splits = [split(plain, each) for each in (separator, ",", "\t", ";")]
        for names in (*splits, _GAP.split(plain)):
            if len(names) == 2 and not any(_values(each, separator) for each in names):
                known = sum(1 for each in names if _kind(each))
                best = max(best, (known, number, (names[0][:60], names[1][:60])))
    return best[1:]


def _level(text: HazardText, name: str) -> tuple[Measure, float]:
    """Return the measure of the first column, and its unit in that of the measure."""
    name = re.sub(r"_g:([\d.]+)$", r"(\1) [g]", name)  # sa_g:1.0, as the package writes it
    measure, rest = text.named_measure(name)
    units = [*_BRACKETS.findall(rest or name), rest.strip(" _,:-/").removeprefix("in ")]
    sizes = (_size(each, measure) for each in units)
    stated = next((size for size in sizes if size is not None), None)
    kind = "velocity" if measure.unit == "m/s" else "acceleration"
    if text.level_unit is None:
        if stated is None and (text.measure is None or any(units)):
            hint = f'write it into the name, as "[{measure.unit}]", or give level_unit='
            raise text.error(f"{name!r} names no unit of {kind}", hint)
        return measure, stated or 1.0
    size = _size(str(text.level_unit), measure)
    if size is None or (stated is not None and abs(size - stated) > 1e-12 * size):
        valid = f"the file states {name!r}" if size else f"it must be a unit of {kind}"
        raise InputError("level_unit", text.level_unit, valid, f"give {measure.unit}, or none")
    return measure, size


def _size(unit: str, measure: Measure) -> float | None:
    """Return a unit in that of a measure; None if it is no unit of the same quantity."""
    base = STANDARD_GRAVITY
    if measure.unit == "m/s":
        # Units of acceleration are known, and a velocity per second is one.
        unit, base = f"({unit.lower().replace('kine', 'cm/s').replace('_', '/')})/s", 1.0
    known = acceleration_unit(unit)
    return None if known is None else in_m_s2(known) / base


def _kind(name: str) -> str:
    """Return the key of `_KINDS` for the name of a column; "" if it names none."""
    plain = name.lower().replace("_", " ")
    return next((kind for kind, words in _KINDS.items() if re.search(words, plain)), "")


def _rate(text: HazardText, name: str) -> Callable[[float], float]:
    """Return the function from values of the second column to annual rates."""
    kind, plain = _kind(name), name.lower()
    match, percent = _YEARS.search(plain), _PERCENT.search(plain) is not None
    span = float(match[1].replace(",", ".")) if match else None
    if kind == "probability" or (not kind and text.poe_years is not None):
        years = text.years(name, 1.0 if span is None and _ANNUAL.search(plain) else span)
        return lambda value: rate_of(value / 100.0 if percent else value, years)
    wrong = percent or span == 0.0 or _OTHER_TIME.search(plain)
    if wrong or (name and not kind) or (span and kind == "return period"):
        words = '"annual rate", "return period [years]" or "probability in 50 years"'
        raise text.error(f"{name!r} is not {words}", "name it so, or give poe_years=")
    if text.poe_years is not None:
        raise InputError("poe_years", text.poe_years, f"the file states {name!r}", "leave it out")
    if kind == "return period":
        return lambda value: 1.0 / value if value else math.nan
    return lambda value: value / (span or 1.0)
