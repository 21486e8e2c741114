"""Reader of the COSMOS format: text, integer and real headers, comments, samples.

Each part states how many values follow and in which Fortran format, channels follow each other, and
a file of corrected records may hold velocity and displacement too, of which the acceleration is
taken. The numbers in the header are known by their place (Consortium of Organizations for
Strong-Motion Observation Systems, *Strong Motion Data Format*, version 1.20, 2001, tables 3
and 4).
"""

import math
import re
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.column_names import OTHER, quantity_named
from rocksteady.records.core.consistency import Lines, agreed, timing
from rocksteady.records.core.directions import pointing
from rocksteady.records.core.fortran_format import fixed_values, stated_width
from rocksteady.records.core.header_statements import interval_value
from rocksteady.records.core.numbers import NUMBER, samples
from rocksteady.records.core.positions import of_station, position_of
from rocksteady.records.core.recording import Orientation, Position, Recording
from rocksteady.records.core.text import CONTRADICTION, RecordText
from rocksteady.records.core.units import acceleration_unit, in_m_s2, quantity_of

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

FORMATS: Final = ("cosmos-v1", "cosmos-v2")

_FIRST: Final = re.compile(r"\(\s*Format\s+v", re.IGNORECASE)
_VALUES: Final = re.compile(
    r"\s*(\d+)\s+(Integer|Real)-header values follow on\s+(\d+)\s+lines", re.IGNORECASE
)
_DATA: Final = re.compile(
    r"\s*(?P<count>\d+)\s+(?P<quantity>[A-Za-z]+)[A-Za-z ]*?\s+pts\s*,?\s*"
    r"(?:approx\s+(?P<lasts>.*?)|.*?)[\s,]*units\s*=\s*(?P<unit>[^,()]*)"
    r"(?:\((?P<code>\d+)\))?",
    re.IGNORECASE,
)
_UNKNOWN: Final = re.compile(
    rf"Values used when.*?:\s*({NUMBER})\s*,?\s*({NUMBER})?", re.IGNORECASE
)
_PLACE: Final = re.compile(r"\b(?:location|loc)\s*:", re.IGNORECASE)
_TYPES: Final[dict[int, Position]] = {
    **dict.fromkeys((1, 2, 4, 6, 8, 9), "surface"),
    **dict.fromkeys((5, 10, 11, 12, 13, 14, 15, 20), "structure"),
}
"""Codes of the types of stations; those of arrays are told by the words of each channel."""
_CODES: Final = {2: "g", 4: "cm/s^2", 7: "in/s^2", 10: "gal", 11: "mg"}
_COUNTS_CODES: Final = {50, 51}
_VERTICAL: Final[dict[int, bool | None]] = {400: False, 401: True, 402: None}
"""Codes of vertical channels: upwards, downwards, sense not stated."""
_HINT: Final = "fetch the file again"


@dataclass(frozen=True, kw_only=True)
class _Head:
    """What stands before the samples of one channel: lines of words, and numbers by their place."""

    words: tuple[str, ...]
    whole: tuple[float | None, ...]
    real: tuple[float | None, ...]
    comments: tuple[str, ...]

    def integer(self, place: int) -> int | None:
        """Return a whole number by its place from 1, or None where it is unknown."""
        value = self.whole[place - 1] if place <= len(self.whole) else None
        return None if value is None or not math.isfinite(value) else int(value)

    def number(self, place: int) -> float | None:
        """Return a real number by its place from 1, or None where it is unknown."""
        value = self.real[place - 1] if place <= len(self.real) else None
        return None if value is None or not math.isfinite(value) else value

    def word(self, pattern: str) -> str | None:
        """Return what a pattern's group finds in the lines of words or comments."""
        for line in (*self.words, *self.comments):
            if match := re.search(pattern, line, re.IGNORECASE):
                return match[1].strip() or None
        return None


def recognises(text: RecordText) -> bool:
    """Return whether the first line names the format."""
    return _FIRST.search(text.first) is not None


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the channels of acceleration of a file.

    Raises
    ------
    RecordFileError
        If there is none, its header cannot be understood or samples are missing.
    """
    recordings: list[Recording] = []
    start = 0
    others: list[str | None] = []
    while (at := _next_data(text, start)) is not None:
        described = _DATA.match(text.heads[at])
        head = _head(text, start, at)
        count = int(described["count"]) if described is not None else 0
        values, end = samples(
            text.lines, at + 1, at_most=max(count, 1), width=stated_width(text.heads[at])
        )
        if described is None or not described["quantity"].lower().startswith("accel"):
            others.append(quantity_named(described["quantity"]) if described else None)
            agreed(text, values, count, Lines(stated=at, start=at + 1, end=end, alone=False))
        else:
            where = Lines(stated=at, start=at + 1, end=end, alone=False)
            kept, warnings = agreed(text, values, count, where)
            recordings.append(_recording(text, given, head, at, kept, warnings))
        start = end
    if not recordings:
        if others:
            raise other_quantity(text, others[0] or OTHER, "it announces no acceleration")
        valid = "no line of it states samples (as in: 7000 acceleration pts, ... units=cm/sec2)"
        raise text.error(valid, "give a file of processed acceleration (V1 or V2)")
    if any("Integer-header" in line for line in text.heads[start:]):
        raise text.error("a channel begins, and its samples are missing", _HINT, at=len(text.lines))
    return tuple(recordings)


def _next_data(text: RecordText, start: int) -> int | None:
    """Return the index of the next line that announces samples."""
    for at in range(start, len(text.lines)):
        line = text.heads[at]
        if "pts" in line and _DATA.match(line) is not None:
            return at
    return None


def _head(text: RecordText, start: int, end: int) -> _Head:
    """Return what stands before the samples of a channel.

    Raises
    ------
    RecordFileError
        If there are fewer lines of numbers than announced.
    """
    # What ended the channel before stands above its first line.
    start = next((at for at in range(start, end) if _FIRST.search(text.heads[at])), start)
    lines = text.heads[start:end]
    unknown: set[float] = {-999.0}
    parts: dict[str, tuple[float | None, ...]] = {"integer": (), "real": ()}
    first_values = len(lines)
    for at, line in enumerate(lines):
        if markers := _UNKNOWN.search(line):
            unknown |= {float(marker) for marker in markers.groups() if marker}
        if announced := _VALUES.match(line):
            first_values = min(first_values, at)
            count, follow = int(announced[1]), int(announced[3])
            if at + follow >= len(lines):
                valid = f"{follow} lines of values must follow, and fewer do"
                raise text.error(valid, _HINT, at=start + at)
            width = stated_width(line) or (8 if announced[2].lower() == "integer" else 15)
            values = fixed_values(lines[at + 1 : at + 1 + follow], width)[:count]
            parts[announced[2].lower()] = tuple(values)
    known = {
        name: tuple(None if value in unknown else value for value in values)
        for name, values in parts.items()
    }
    return _Head(
        words=lines[:first_values],
        whole=known["integer"],
        real=known["real"],
        comments=tuple(line for line in lines if line.lstrip().startswith("|")),
    )


def _recording(
    text: RecordText,
    given: Given,
    head: _Head,
    at: int,
    values: "Floats",
    warnings: tuple[str, ...],
) -> Recording:
    """Return the recording of one channel."""
    described = _DATA.match(text.heads[at])
    if described is None:  # the caller has found this line by the same pattern
        raise text.error("it must announce samples", _HINT, at=at)
    code = int(described["code"]) if described["code"] else None
    written = described["unit"].strip()
    units = "counts" if code in _COUNTS_CODES else written
    if code in _CODES and quantity_of(written) in {None, "acceleration"}:
        of_words, units = acceleration_unit(written), _CODES[code]
        if of_words is not None and in_m_s2(of_words) != in_m_s2(units):
            valid = f"its words state {of_words}, and its code {code} {units}"
            raise text.error(valid, "correct one of them", at=at, kind=CONTRADICTION)
        if of_words is None:
            units = f"{written} ({code:02d})"  # not understood as a whole
    first = head.words[0].lower() if head.words else ""
    level = "cosmos-v1" if "uncorrected" in first or "raw" in first else "cosmos-v2"
    seconds = None
    if described["lasts"] is not None and not re.match(r"0+\b(?!\.)", described["lasts"]):
        seconds, unread = interval_value(text, at, described["lasts"], None, given.dt_s)
        warnings += unread
    interval, doubt = _interval(head, len(values), seconds, corrected=level == "cosmos-v2")
    if interval is None and given.dt_s is None:
        raise text.error(
            f"no interval of its header fits {len(values)} samples in some {seconds or 0:g} s",
            "give dt_s, in seconds",
            at=at,
        )
    warnings += timing(values, given.dt_s or interval, peak_at=head.number(65))
    component, orientation, azimuth, down = _pointing(head)
    station = head.word(r"Statn No:.*?Code:\s*(\S.*?)\s*$")
    place = " ".join(filter(_PLACE.search, head.words))
    words, kind = position_of(place), _TYPES.get(head.integer(19) or 0)
    channel = Channel(
        values=values,
        units=units,
        dt_s=interval,
        stated_peak=head.number(64),
        component=component,
        orientation=orientation,
        azimuth_deg=azimuth,
        down=down,
        alone=False,
        station=station,
        event=head.words[1].strip() or None if len(head.words) > 1 else None,
        position=kind or of_station(station or "", place) if words == "unknown" else words,
        start_time=_start(head),
        warnings=(*warnings, *doubt),
    )
    return built(text, level, channel, given)


def _interval(
    head: _Head, count: int, seconds: float | None, *, corrected: bool
) -> tuple[float | None, tuple[str, ...]]:
    """Return the interval of the samples [s], and a warning where the header contradicts itself.

    The header holds two: that of the raw record (real value 34, in s) and that of the processed one
    (62, in ms). Writers fill in either, or leave in one the interval of another stage; so the one
    is taken that fits the number of samples and the duration of their own line.
    """
    raw, processed = head.number(34), head.number(62)
    in_seconds = None if processed is None else processed / 1000.0
    order = (in_seconds, raw) if corrected else (raw, in_seconds)
    candidates = [value for value in order if value is not None and value > 0.0]
    if seconds is None:
        return (candidates[0] if candidates else None), ()
    # The duration is written in whole seconds, cut or rounded.
    fitting = [value for value in candidates if abs(count * value - seconds) <= 1.0 + value]
    if not fitting:
        return None, ()
    others = sorted({value for value in candidates if value not in fitting})
    if others:
        listed = ", ".join(f"{value:g}" for value in others)
        doubt = (
            f"the header states {listed} s between samples too; {fitting[0]:g} s fits their number"
        )
        return fitting[0], (doubt,)
    return fitting[0], ()


def _pointing(
    head: _Head,
) -> tuple[str | None, Orientation | None, float | None, bool | None]:
    """Return component, orientation, azimuth, and whether positive values are downwards."""
    code = head.integer(54)
    seed = head.word(r"<SCNL>\s*[^.\s]*\.([A-Za-z0-9]{3})\.")
    described = head.word(r"Sta Chan?\s*:?\s*\d*\s*:\s*(.*?)\s*\(")
    if code in _VERTICAL:
        return described or seed or "vertical", "vertical", None, _VERTICAL[code]
    if code is not None and 1 <= code <= 360:
        return described or seed or f"{code}", "horizontal", float(code), None
    component = seed or described
    result = pointing(component)
    # "Other" states no direction, and neither does a seed code with 3 for its direction.
    if result.orientation is None and described is not None:
        result = pointing(described)
    return component, result.orientation, result.azimuth_deg, result.down


def _start(head: _Head) -> datetime | None:
    """Return the time of the first sample (UTC)."""
    year, month, day, hour, minute = (head.integer(place) for place in (40, 42, 43, 44, 45))
    if year is None or month is None or day is None or hour is None or minute is None:
        return None
    try:
        whole = datetime(year, month, day, hour, minute, tzinfo=UTC)
        return whole + timedelta(seconds=head.number(30) or 0.0)
    except (ValueError, OverflowError):
        return None
