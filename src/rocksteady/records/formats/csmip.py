"""Reader of older Californian files (CSMIP, CDMG), volumes 1 and 2, before COSMOS.

A line in each channel announces its samples, ``12000 points of accel data equally spaced at .005
sec, in cm/sec2. (8f10.6)`` in volume 2 and ``13200 Accelerogram points at 200 pts/sec in units of
g`` in volume 1. Older files of volume 1 announce nothing: times and accelerations follow in turn,
in columns of seven, unevenly spaced as they were digitised from film.
"""

import re
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.column_names import OTHER, quantity_named
from rocksteady.records.core.consistency import Lines, agreed, timing
from rocksteady.records.core.directions import together
from rocksteady.records.core.fortran_format import stated_width
from rocksteady.records.core.header_statements import interval_value
from rocksteady.records.core.numbers import NUMBER, number, samples
from rocksteady.records.core.positions import of_station
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.sampling import evenly_spaced
from rocksteady.records.core.text import RecordText
from rocksteady.records.core.units import acceleration_unit, in_m_s2, leading, modifies, quantity_of

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

FORMATS: Final = ("csmip-v1", "csmip-v2")

_FIRST: Final = re.compile(r"(UN)?CORRECTED ACCELEROGRAM", re.IGNORECASE)
_VOLUME_2: Final = re.compile(
    r"\s*(?P<count>\d+)\s+points of\s+(?P<quantity>\w+)\s+data\s+equally spaced at\s+"
    r"(?P<dt>[+-]?[\d.].*?)(?:[\s.,(]+(?:in|units?\s*[:=]?)\s+(?P<unit>\S.*)"
    r"|[\s.,]*\(\s*\d*[fe]\d.*)?$",
    re.IGNORECASE,
)
_VOLUME_1: Final = re.compile(
    r"\s*(?P<count>\d+)\s+Accelerogram points at\s+(?P<dt>[+-]?[\d.].*?)"
    r"(?:[\s,]+in units of\s+(?P<unit>\S.*))?$",
    re.IGNORECASE,
)
_POINTS: Final = re.compile(r"No\.? of Points\s*=\s*(\d+)", re.IGNORECASE)
_UNITS: Final = re.compile(r"Units of uncor\w*\s+\w+ are sec and\s+(\S.*)", re.IGNORECASE)
_PEAK: Final = re.compile(
    rf"Peak\s+acceleration\s*=\s*({NUMBER})\s*([A-Za-z/0-9^]+)(?:\s+at\s+({NUMBER})\s*sec)?",
    re.IGNORECASE,
)
_MAX: Final = re.compile(rf"Max\s*=\s*({NUMBER})\s*([A-Za-z/0-9^]+)", re.IGNORECASE)
_SPACED: Final = re.compile(rf"equally-spaced intervals of\s+({NUMBER})\s*sec", re.IGNORECASE)
_CHANNEL: Final = re.compile(r"\bChan\s+\d+\s*:\s*(.*?)(?:\s+from)?\s*$", re.IGNORECASE)
_NAMED: Final = re.compile(r"^\s*Chan\s+\d+\s*:\s*(.*?)\s*$", re.IGNORECASE)
_PLACE: Final = re.compile(r"\b(?:location|loc)\s*:|^\s*chan\s+\d+\s*:", re.IGNORECASE)
_STATION: Final = re.compile(r"\s*Station\s+(?:No|Id)\.?\s*(\S+)", re.IGNORECASE)
_START: Final = re.compile(
    r"Start time:\s*(\d+)[/-](\d+)[/-](\d+),\s*(\d+):\s*(\d+):\s*([\d.]+)\s*(?:UTC|GMT)",
    re.IGNORECASE,
)
_TEXT_LINES, _NUMBER_LINES = 13, 14
"""Lines of words and of numbers before the samples of an old volume 1."""


def recognises(text: RecordText) -> bool:
    """Return whether the first line names an accelerogram of these volumes."""
    if _FIRST.search(text.first) is None:
        return False
    return any(_announced(line) or _UNITS.search(line) for line in text.heads[:200])


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the channels of acceleration of a file.

    Raises
    ------
    RecordFileError
        If there is none, its header cannot be understood or samples are missing.
    """
    recordings: list[Recording] = []
    others: list[str] = []
    start = 0
    while (at := _next_announced(text, start)) is not None:
        announced = _announced(text.heads[at])
        if announced is None:
            break
        count = int(announced["count"])
        values, end = samples(
            text.lines, at + 1, at_most=max(count, 1), width=stated_width(text.heads[at])
        )
        where = Lines(stated=at, start=at + 1, end=end, alone=False)
        kept, warnings = agreed(text, values, count, where)
        if _is_acceleration(announced):
            recordings.append(_recording(text, given, range(start, at + 1), kept, warnings))
        else:
            others.append(quantity_named(announced["quantity"]) or OTHER)
        start = end
    if not recordings and start:
        raise other_quantity(text, others[0], "it announces no samples of acceleration")
    if not recordings:
        recordings = _old_volume_1(text, given)
    return tuple(recordings)


def _announced(line: str) -> re.Match[str] | None:
    """Return what a line announces, or None where it announces no samples."""
    if "points" not in line.lower():
        return None
    return _VOLUME_2.match(line) or _VOLUME_1.match(line)


def _next_announced(text: RecordText, start: int) -> int | None:
    """Return the index of the next line that announces samples."""
    for at in range(start, len(text.lines)):
        if _announced(text.heads[at]):
            return at
    return None


def _is_acceleration(announced: re.Match[str]) -> bool:
    """Return whether the samples announced are of acceleration."""
    return announced.re is _VOLUME_1 or announced["quantity"].lower().startswith("acc")


def _recording(
    text: RecordText,
    given: Given,
    lines: range,
    values: "Floats",
    warnings: tuple[str, ...],
) -> Recording:
    """Return the recording of a channel; the last line of its head announces the samples."""
    head = text.heads[lines.start : lines.stop]
    announced = _announced(head[-1])
    if announced is None:  # the caller has found this line by the same patterns
        raise text.error("no line announces samples", "fetch the file again")
    volume_2 = announced.re is _VOLUME_2
    interval, unread = interval_value(text, lines[-1], announced["dt"], None, given.dt_s)
    units: str | None = announced["unit"]
    peak = _first(_PEAK if volume_2 else _MAX, head)
    if units is not None:
        units = _whole_unit(units)
    elif peak is not None:
        units = peak[2]
    at_peak = number(peak[3] or "") if volume_2 and peak is not None else None
    warnings += unread + timing(values, given.dt_s or interval, peak_at=at_peak)
    warnings += _second_interval(head, given.dt_s or interval)
    channel = _channel(
        head,
        values,
        units=units,
        dt_s=interval,
        corrected=volume_2,
        warnings=warnings,
    )
    return built(text, "csmip-v2" if volume_2 else "csmip-v1", channel, given)


def _channel(
    head: tuple[str, ...],
    values: "Floats",
    *,
    units: str | None,
    dt_s: float | None,
    corrected: bool,
    warnings: tuple[str, ...],
    processing: tuple[str, ...] = (),
) -> Channel:
    """Return what the lines of words state about a channel."""
    component = together(match[1] for line in head if (match := _CHANNEL.search(line)))
    channel = _first(_NAMED, head)
    station = next((at for at, line in enumerate(head) if _STATION.match(line)), None)
    name = None
    if station is not None:
        name = head[station + 1][:40].strip() if station + 1 < len(head) else ""
        code = _STATION.match(head[station])
        name = name or (code[1] if code else None)
    peak = _first(_PEAK if corrected else _MAX, head)
    value, of_peak = (number(peak[1]), acceleration_unit(peak[2])) if peak else (None, None)
    of_file = acceleration_unit(units or "")
    stated = None
    if value is not None and of_peak is not None and of_file is not None:
        stated = value * in_m_s2(of_peak) / in_m_s2(of_file)
    return Channel(
        values=values,
        units=units,
        dt_s=dt_s,
        stated_peak=stated,
        component=component or (channel[1] if channel else None),
        alone=False,
        station=name,
        position=of_station(name or "", " ".join(filter(_PLACE.search, head))),
        event=_event(head),
        start_time=_start(head),
        warnings=warnings,
        processing=processing,
    )


def _second_interval(head: tuple[str, ...], interval: float | None) -> tuple[str, ...]:
    """Return a warning where the words of the header state another interval than its numbers."""
    stated = _first(_SPACED, head)
    second = None if stated is None else number(stated[1])
    if interval is None or second is None or abs(second - interval) <= 1.0e-6 * interval:
        return ()
    return (f"the header states {second:g} s between samples too; {interval:g} s are taken",)


def _whole_unit(written: str) -> str:
    """Return the unit that words begin with; all of them where it is not understood as a whole."""
    unit, rest = leading(re.split(r"\(\s*\d*[fFeE]\d|\s{3}", written)[0], quantity_of)
    return written.strip() if unit is None or modifies(rest) else unit


def _old_volume_1(text: RecordText, given: Given) -> list[Recording]:
    """Return the channels of a file of times and accelerations in turn.

    Raises
    ------
    RecordFileError
        If samples are missing, or they are unevenly spaced and resampling is not allowed.
    """
    recordings: list[Recording] = []
    start = 0
    while start < len(text.lines):
        if _FIRST.search(text.heads[start]) is None:
            start += 1
            continue
        head = text.heads[start : start + _TEXT_LINES]
        points, units = _first(_POINTS, head), _first(_UNITS, head)
        if points is None or units is None:
            hint = "give a file of volume 1 or 2 of CSMIP"
            raise text.error("its header states no number of points or no unit", hint, at=start)
        data = start + _TEXT_LINES + _NUMBER_LINES
        count = int(points[1])
        values, end = samples(text.lines, data, at_most=max(2 * count, 1), width=7)
        where = Lines(stated=start, start=data, end=end, alone=False)
        pairs, warnings = agreed(text, values, 2 * count, where)
        spaced = evenly_spaced(
            text,
            pairs[0::2],
            pairs[1::2],
            given,
            rounding=5.0e-4,
            line_of=lambda sample, data=data: data + sample // 5,  # type: ignore[misc]
        )
        channel = _channel(
            head,
            spaced.values,
            units=_whole_unit(units[1]),
            dt_s=spaced.dt_s,
            corrected=False,
            warnings=(*warnings, *spaced.warnings),
            processing=spaced.notes,
        )
        recordings.append(built(text, "csmip-v1", channel, given))
        start = end
    if not recordings:
        raise text.error("it holds no acceleration", "give a file of volume 1 or 2 of CSMIP")
    return recordings


def _first(pattern: re.Pattern[str], lines: tuple[str, ...]) -> re.Match[str] | None:
    """Return the first find of a pattern."""
    return next((match for line in lines if (match := pattern.search(line))), None)


def _event(head: tuple[str, ...]) -> str | None:
    """Return the line that states what was recorded."""
    return next(
        (line[:40].strip() for line in head if re.match(r"\s*(?:Record|Rcrd) of", line)), None
    )


def _start(head: tuple[str, ...]) -> datetime | None:
    """Return the time of the first sample (UTC)."""
    match = _first(_START, head)
    if match is None:
        return None
    month, day, year, hour, minute = (int(match[group]) for group in range(1, 6))
    try:
        whole = datetime(
            # Two digits of a year: the program began in 1972.
            year + (1900 if year >= 70 else 2000) if year < 100 else year,
            month,
            day,
            hour,
            minute,
            tzinfo=UTC,
        )
        return whole + timedelta(seconds=float(match[6]))
    except (ValueError, OverflowError):
        return None
