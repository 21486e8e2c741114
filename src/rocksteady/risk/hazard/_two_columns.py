"""Hazard curves as two columns: level, and annual rate, probability or return period."""

import re
from collections.abc import Callable, Sequence
from typing import Final

from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.records.core.units import acceleration_unit, in_m_s2
from rocksteady.risk.hazard._hazard_text import (
    SEPARATORS,
    HazardText,
    fields_of,
    make_curve,
    number_of,
)
from rocksteady.risk.hazard._openquake_csv import rate_of
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import ground_measure, written
from rocksteady.seismic.measures.scalar import Measure

VELOCITIES: Final = {
    "m/s": 1.0,
    "cm/s": 0.01,
    "mm/s": 0.001,
    "in/s": 0.0254,
    "ft/s": 0.3048,
    "kine": 0.01,
}
"""Units of velocity in m/s."""

_SPECTRAL: Final = re.compile(r"\bp?sa(?![a-z])")
_PERIOD: Final = re.compile(r"\bp?sa[\s(\[_:]{0,3}(?:t\s?=\s?)?(\d+\.?\d*|\.\d+)\s?s?\b")
_UNIT: Final = re.compile(
    r"[\[(]\s?([^\[\]()]{1,20}?)\s?[\])]\s?$|[_ ,]([a-z/^%.0-9]{1,8})$|_(cm_s|m_s)$"
)
_RATE: Final = re.compile(r"rate|\bm?afo?e\b|freq|lambda|1/y|/\s?yr|/\s?year|/\s?a\b|per year")
_POE: Final = re.compile(r"prob|\baep\b|\bp\s?\(|\b[a-z]?po?e\b")
_RETURN: Final = re.compile(r"return|recurrence")
_IN_YEARS: Final = re.compile(r"\bin (\d+(?:\.\d+)?) ?y")
_PERCENT: Final = re.compile(r"%|per ?cent")
_PER_YEARS: Final = re.compile(r"(?:\bper|\bin|/) ?(\d+(?:\.\d+)?) ?(?:y|a\b)")
_OTHER_TIME: Final = re.compile(r"month|week|day|hour|decade|centur|millen|ka\b|kyr")
_ANNUAL: Final = re.compile(r"annual|yearly|\bapo?e\b|\baep\b|per year|\bin 1 y")

_NAME_IT: Final = 'name the columns, as "PGA [g], annual rate", or give measure='


def read_columns(
    text: HazardText,
    measure: Measure | None,
    level_unit: str | None,
    poe_years: float | None,
) -> HazardCurve:
    """Return the curve of two columns.

    Parameters
    ----------
    text
        The file.
    measure, level_unit, poe_years
        As given, for columns without names or units; None else.

    Raises
    ------
    InputError
        If a line is no pair of numbers, or what they are is not clear.
    """
    separator = _separator(text)
    header: list[tuple[int, str]] = []
    points: list[tuple[int, float, float]] = []
    for number, line in text.lines:
        row = _pair(line, separator)
        if row is not None:
            points.append((number, *row))
        elif not points:
            _refuse_spoilt(text, number, line, separator)
            header.append((number, line))
        elif not line.lstrip().startswith("#"):
            raise text.error("it must be two numbers", "take out what is no point", line=number)
    names = _names(header, separator)
    if _swapped(names):
        names = names[::-1]
        points = [(number, second, first) for number, first, second in points]
    words, factor = _level(text, names[0], measure, level_unit)
    to_rate = _rate(text, names[1], poe_years)
    if len(points) > 1 and points[0][1] > points[-1][1]:
        points.reverse()
    for number, level, _ in points:
        if level <= 0.0:
            raise text.error("a level must be above 0", "take out the line", line=number)
    return make_curve(
        text,
        [factor * level for _, level, _ in points],
        [to_rate(value, number) for number, _, value in points],
        line=[number for number, _, _ in points],
        measure=words,
    )


def _separator(text: HazardText) -> str | None:
    """Return what stands between two numbers in most lines."""
    counts = [sum(_pair(line, each) is not None for _, line in text.lines) for each in SEPARATORS]
    if not max(counts):
        raise text.error("it has no line of two numbers, and no columns poe-LEVEL")
    return SEPARATORS[counts.index(max(counts))]


def _pair(line: str, separator: str | None) -> tuple[float, float] | None:
    """Return the two numbers of a line, or None."""
    values = [number_of(field, separator) for field in fields_of(line, separator)[:3]]
    if len(values) != 2 or values[0] is None or values[1] is None:
        return None
    return values[0], values[1]


def _refuse_spoilt(text: HazardText, number: int, line: str, separator: str | None) -> None:
    """Raise where a line above the first point begins as a point does."""
    fields = fields_of(line, separator)
    if fields and number_of(fields[0], separator) is not None:
        raise text.error("it must be two numbers", "take out what is no point", line=number)


def _names(header: Sequence[tuple[int, str]], separator: str | None) -> tuple[str, str]:
    """Return the names of the columns in small letters, empty where there are none."""
    for _, line in reversed(header):
        plain = line.strip().lstrip("#%/ ").lower()
        for each in (separator, ",", "\t", ";", "  "):
            fields = [field for field in fields_of(plain, each) if field]
            if len(fields) == 2:
                return fields[0], fields[1]
    return "", ""


def _swapped(names: tuple[str, str]) -> bool:
    """Return whether the rate stands before the level."""
    of_rates = [bool(_RATE.search(n) or _POE.search(n) or _RETURN.search(n)) for n in names]
    return of_rates == [True, False]


def _level(
    text: HazardText, name: str, given: Measure | None, level_unit: str | None
) -> tuple[Measure, float]:
    """Return the measure of a column's name, and its unit in that of the measure."""
    named = _measure_named(name)
    if named == "sa_g":
        period = _PERIOD.search(name)
        if period is None and given is None:
            raise text.error(
                f"{name!r} names no period",
                'write it into the name, as "Sa(1.0) [g]", or give measure="sa_g:1.0"',
            )
        named = f"sa_g:{period[1]}" if period else None
    known = None if named is None else ground_measure("measure", named)
    words = given or known
    if words is None:
        what = f"{name!r} is not one of" if name else "the columns have no names, as"
        raise text.error(f"{what} PGA, PGV and Sa(PERIOD)", _NAME_IT)
    if known is not None and given is not None and known != given:
        raise InputError(
            "measure", written(given), f"the file states {name!r}", "leave out measure="
        )
    match = _UNIT.search(name)
    of_name = next((part for part in match.groups() if part), "") if match else ""
    size = _size(of_name, words)
    if level_unit is None and size is None:
        if given is None or (match is not None and match[1] and _PERIOD.search(name) is None):
            raise text.error(
                f"{name!r} names no unit of {_kind(words)}",
                f'give level_unit=, as "{words.unit}"',
            )
        return words, 1.0
    wanted = size if level_unit is None else _size(level_unit, words)
    if wanted is None:
        raise InputError(
            "level_unit",
            level_unit,
            f"it must be a unit of {_kind(words)}",
            f"give one, as {words.unit}",
        )
    if size is not None and abs(wanted - size) > 1e-12 * size:
        raise InputError("level_unit", level_unit, f"the file states {name!r}", "leave it out")
    return words, wanted


def _kind(measure: Measure) -> str:
    """Return what the unit of a measure is of."""
    return "velocity" if measure.unit == "m/s" else "acceleration"


def _measure_named(name: str) -> str | None:
    """Return what a column's name is of."""
    if "pga" in name or "peak ground acc" in name:
        return "pga_g"
    if "pgv" in name or "peak ground vel" in name:
        return "pgv_m_s"
    return "sa_g" if _SPECTRAL.search(name) or "spectral acc" in name else None


def _size(written: object, measure: Measure) -> float | None:
    """Return a unit in that of a measure, or None of what is no such unit."""
    if not isinstance(written, str):
        return None
    if _kind(measure) == "acceleration":
        known = acceleration_unit(written) if written else None
        return None if known is None else in_m_s2(known) / STANDARD_GRAVITY
    plain = written.lower().replace(" ", "").replace("sec", "s").replace("m_s", "m/s")
    return VELOCITIES.get(plain.replace("mps", "m/s"))


def _rate(text: HazardText, name: str, poe_years: float | None) -> Callable[[float, int], float]:
    """Return the function that makes annual rates of the second column."""
    years = poe_years
    match = _IN_YEARS.search(name)
    if _OTHER_TIME.search(name):
        raise text.error(f"{name!r} is of a time that is not counted in years", _NAME_IT)
    part = 0.01 if _PERCENT.search(name) else 1.0
    if _POE.search(name):
        stated = float(match[1]) if match else 1.0 if _ANNUAL.search(name) else None
        if stated is None and years is None:
            raise text.error(f"{name!r} are probabilities in a time", "give poe_years=")
        if stated is not None and years is not None and stated != years:
            raise InputError("poe_years", years, f"the file states {name!r}", "leave it out")
        years = years if stated is None else stated
    elif _RETURN.search(name) or _RATE.search(name) or (name and years is None):
        if not (_RETURN.search(name) or _RATE.search(name)):
            raise text.error(
                f"{name!r} is not clear",
                'name the column "annual rate", or give poe_years= for probabilities',
            )
        if years is not None:
            raise InputError("poe_years", years, f"the file states {name!r}", "leave it out")
    if years is not None:
        time = years
        if not 0.0 < time <= 1e6:
            raise text.error(f"{time:g} years is no time", "give poe_years=")
        return lambda value, line: rate_of(text, part * value, time, line)
    if part != 1.0:
        raise text.error(f"{name!r} is in per cent, which is for probabilities", _NAME_IT)
    counted = _PER_YEARS.search(name)
    span = float(counted[1]) if counted and not _RETURN.search(name) else 1.0
    if span == 0.0:
        raise text.error(f"{name!r} is of no time", _NAME_IT)

    def to_rate(value: float, line: int) -> float:
        if value < 0.0 or (value == 0.0 and _RETURN.search(name)):
            raise text.error("a rate is not negative, a return period above 0", line=line)
        return 1.0 / value if _RETURN.search(name) and value > 1e-300 else value / span

    return to_rate
