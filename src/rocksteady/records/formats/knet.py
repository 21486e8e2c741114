"""Reader of Japan's K-NET and KiK-net: a header of 17 lines, then instrument counts.

The counts hold the offset of the instrument as well. The networks state the largest acceleration
after the mean of the record is taken off, and so it is taken off here, which a note on the
recording states: left in, it would be a constant acceleration of the base that never was.

A KiK-net station has two instruments: directions 1 to 3 (north, east, up) are in its borehole, 4 to
6 at the surface. The time of the record includes a delay of 15 s of its trigger.
"""

import re
from datetime import datetime, timedelta
from typing import Final

from rocksteady.records.core.assembling import Channel, Given, built
from rocksteady.records.core.consistency import Lines, agreed
from rocksteady.records.core.header_statements import time_value
from rocksteady.records.core.moments import moment
from rocksteady.records.core.numbers import NUMBER, number, samples
from rocksteady.records.core.positions import position_of
from rocksteady.records.core.recording import Position, Recording
from rocksteady.records.core.text import RecordText
from rocksteady.records.core.units import COUNTS

KNET: Final = "knet"
KIKNET: Final = "kiknet"

_WITHIN: Final = 40
_KEYS: Final = (
    "Origin Time",
    "Lat.",
    "Long.",
    "Depth. (km)",
    "Mag.",
    "Station Code",
    "Station Lat.",
    "Station Long.",
    "Station Height(m)",
    "Record Time",
    "Sampling Freq(Hz)",
    "Duration Time(s)",
    "Dir.",
    "Scale Factor",
    "Max. Acc. (gal)",
    "Last Correction",
    "Memo.",
)
_SCALE: Final = re.compile(rf"({NUMBER})\s*\(\s*gal\s*\)\s*/\s*({NUMBER})\s*", re.IGNORECASE)
_DELAY: Final = timedelta(seconds=15)
_DIRECTIONS: Final = ("N-S", "E-W", "U-D")
_SUFFIXES: Final = {"NS", "EW", "UD"}
"""Suffixes of the three files of one station, whose names are else the same."""


def recognises(text: RecordText) -> bool:
    """Return whether a file has the header of these networks."""
    # Half the keys are enough: with one of them garbled, the counts would pass for a table.
    return len(_header(text)) > len(_KEYS) // 2


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the one channel of a file.

    Raises
    ------
    RecordFileError
        If its header cannot be understood or samples are missing.
    """
    lines = _header(text, once=True)
    scale_at = _line(text, lines, "Scale Factor")
    scale = _SCALE.fullmatch(_value(text, lines, "Scale Factor"))
    parts = () if scale is None else tuple(number(part) or 0.0 for part in scale.groups())
    if not parts or min(parts) <= 0.0:
        hint = "it reads like 3920(gal)/6182761"
        raise text.error("it must state the scale of the counts, above 0", hint, at=scale_at)
    interval = _time(text, lines, "Sampling Freq(Hz)", "Hz")
    seconds = _time(text, lines, "Duration Time(s)", "s")
    start = max(lines.values()) + 1
    # So many cannot stand in the file: the header is not taken at its word before they are there.
    stated = round(min(seconds / interval, 1.0e12))
    counts, end = samples(text.lines, start, at_most=stated)
    at = _line(text, lines, "Duration Time(s)")
    kept, warnings = agreed(text, counts, stated, Lines(stated=at, start=start, end=end))
    if warnings and "more than" in warnings[0]:
        rates = f"{seconds:g} s at {1.0 / interval:g} Hz"
        warnings += (f"{rates} are {stated} samples: see whether duration and rate are right",)
    if "Dir." not in lines:
        warnings += ("its header has no line 'Dir.': where the channel points is not known",)
    gal = parts[0] / parts[1]
    offset = float(kept.mean())
    peak = _value(text, lines, "Max. Acc. (gal)")
    written = _value(text, lines, "Dir.")
    code, memo = _value(text, lines, "Station Code"), _value(text, lines, "Memo.")
    network, component, station, place = _named(written, code, memo)
    channel = Channel(
        values=(kept - offset) * gal,
        units="gal",
        units_in_file=COUNTS,
        dt_s=interval,
        stated_peak=number(peak),
        component=component,
        position=place,
        station=station,
        name=text.path.name if text.path.suffix[1:].rstrip("12").upper() in _SUFFIXES else None,
        event=_event(text, lines),
        start_time=_start(_value(text, lines, "Record Time")),
        warnings=warnings,
        processing=(_note(offset * gal * 0.01),),
    )
    return (built(text, network, channel, given),)


def _note(offset: float) -> str:
    """Return a remark on the offset that is taken off [m/s^2]."""
    return (
        f"mean of the counts taken off ({offset:.6g} m/s^2): the offset of the instrument, without "
        "which the network states the peak"
    )


def _header(text: RecordText, *, once: bool = False) -> dict[str, int]:
    """Return the index of the line of each key; a key that occurs twice is refused if `once`."""
    header: dict[str, int] = {}
    for at, line in enumerate(text.heads[:_WITHIN]):
        words = line.lstrip().lower()
        for key in _KEYS:
            if words.startswith(key.lower()):
                if once and key in header and key != "Memo.":
                    text.refuse_repeated(header[key], at)
                header.setdefault(key, at)
    return header


def _line(text: RecordText, lines: dict[str, int], key: str) -> int:
    """Return the index of a key's line, or raise."""
    if key not in lines:
        raise text.error(f"its header has no line {key!r}", "fetch the file again")
    return lines[key]


def _value(text: RecordText, lines: dict[str, int], key: str) -> str:
    """Return what stands after a key; nothing where the key is not there."""
    return text.heads[lines[key]].lstrip()[len(key) :].strip() if key in lines else ""


def _time(text: RecordText, lines: dict[str, int], key: str, unit: str) -> float:
    """Return the time above 0 that a line states [s], that between samples for a rate."""
    at = _line(text, lines, key)
    written = _value(text, lines, key)
    # `100Hz`: a unit goes before that of the key, which is the same.
    stated = re.sub(rf"(?<=[\d.])\s*{unit}\s*$", "", written, flags=re.IGNORECASE)
    return time_value(text, at, stated, unit, "correct the line")


def _named(written: str, station: str, memo: str) -> tuple[str, str | None, str | None, Position]:
    """Return network, component, station and position."""
    if written in {"1", "2", "3", "4", "5", "6"}:
        place: Position = "borehole" if int(written) <= 3 else "surface"
        component = _DIRECTIONS[(int(written) - 1) % 3]
        return KIKNET, component, f"{station} {place}".strip(), place
    place = position_of(memo)
    return KNET, written or None, station or None, "surface" if place == "unknown" else place


def _event(text: RecordText, lines: dict[str, int]) -> str | None:
    """Return origin time and magnitude, by which these networks identify an event."""
    time, magnitude = _value(text, lines, "Origin Time"), _value(text, lines, "Mag.")
    parts = [part for part in (time, f"M {magnitude}" if magnitude else "") if part]
    return ", ".join(parts) or None


def _start(written: str) -> datetime | None:
    """Return the time of the first sample (UTC)."""
    local = moment(written, "GMT+09")
    return None if local is None else local - _DELAY
