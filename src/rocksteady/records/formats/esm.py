"""Reader of European files (ESM, ITACA, AFAD): the DYNA header, then the samples.

The header is a line a key, ``UNITS: cm/s^2``, and ends where a line of numbers begins.
"""

import re
from typing import Final

from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.column_names import OTHER, quantity_named
from rocksteady.records.core.consistency import Lines, agreed, timing
from rocksteady.records.core.header_statements import (
    count_value,
    interval_value,
    last_place,
    refuse_factors,
    unless_given,
)
from rocksteady.records.core.moments import moment
from rocksteady.records.core.numbers import number, numbers, samples
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.text import RecordText

FORMAT: Final = "esm-ascii"

_WITHIN: Final = 200
_KEY: Final = re.compile(r"[A-Za-z][A-Za-z0-9_ /^().-]*")
_INTERVAL: Final = "SAMPLING_INTERVAL_S"
_COUNT: Final = "NDATA"


def recognises(text: RecordText) -> bool:
    """Return whether a file has DYNA's header."""
    header = _header(text)
    return _INTERVAL in header and _COUNT in header


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the one channel of a file.

    Raises
    ------
    RecordFileError
        If it is not one of acceleration, its header cannot be understood or samples are missing.
    """
    lines = _header(text, once=True)
    for key in (_COUNT, _INTERVAL):
        if key not in lines:
            raise text.error(f"its header does not state {key}", "fetch the file again")
    _refuse_other_quantities(text, lines)
    free = ("USER", "INSTRUMENT", "PROCESSING", "DATA_")
    stated = [at for key, at in lines.items() if not key.startswith(free)]

    def state() -> str | None:
        refuse_factors(text, stated)
        return _value(text, lines, "UNITS") or None

    units, unread = unless_given(given.units, state)
    count = count_value(text, lines[_COUNT], _value(text, lines, _COUNT))
    at = lines[_INTERVAL]
    interval, doubts = interval_value(text, at, _value(text, lines, _INTERVAL), "s", given.dt_s)
    start = max(lines.values()) + 1
    values, end = samples(text.lines, start, at_most=max(count, 1))
    where = Lines(stated=lines[_COUNT], start=start, end=end)
    kept, warnings = agreed(text, values, count, where)
    lasts = number(_value(text, lines, "DURATION_S"))
    duration = (
        None if lasts is None else (lasts, 0.5 * last_place(_value(text, lines, "DURATION_S")))
    )
    peak_at = number(_value(text, lines, "TIME_PGA_S"))
    warnings += unread + doubts
    warnings += timing(kept, given.dt_s or interval, duration=duration, peak_at=peak_at)
    channel = Channel(
        values=kept,
        units=units,
        dt_s=interval,
        # The key names the unit of the peak, whatever that of the samples is.
        stated_peak=_peak(_value(text, lines, "PGA_CM/S^2"), units),
        component=_value(text, lines, "STREAM") or None,
        place=f"{_value(text, lines, 'STATION_NAME')} {_value(text, lines, 'LOCATION')}",
        station=_value(text, lines, "STATION_CODE") or _value(text, lines, "STATION_NAME") or None,
        event=_value(text, lines, "EVENT_ID") or _value(text, lines, "EVENT_NAME") or None,
        start_time=moment(_value(text, lines, "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS")),
        position="borehole"
        if (number(_value(text, lines, "SENSOR_DEPTH_M")) or 0.0) > 0.0
        else None,
        warnings=warnings,
    )
    return (built(text, FORMAT, channel, given),)


def _header(text: RecordText, *, once: bool = False) -> dict[str, int]:
    """Return the index of the line of each key, up to the first line of numbers.

    A key that occurs twice with two values is refused if `once`; users' own lines may repeat.
    """
    header: dict[str, int] = {}
    for at, line in enumerate(text.heads[:_WITHIN]):
        key, colon, _ = line.partition(":")
        if colon and _KEY.fullmatch(key.strip()):
            name = re.sub(r"[ _]+", "_", key.strip().upper())
            if once and not name.startswith("USER"):
                text.refuse_repeated(header.get(name, at), at)
            header.setdefault(name, at)
        elif header and line.strip() and numbers(line):
            break
    return header


def _value(text: RecordText, lines: dict[str, int], key: str) -> str:
    """Return the value of a key; nothing where it is missing."""
    return text.heads[lines[key]].partition(":")[2].strip() if key in lines else ""


def _refuse_other_quantities(text: RecordText, lines: dict[str, int]) -> None:
    """Raise where a file holds velocity, displacement or a spectrum."""
    quantity = _value(text, lines, "DATA_TYPE").upper()
    if quantity and quantity != "ACCELERATION":
        valid = "it states what the samples are"
        raise other_quantity(text, quantity_named(quantity) or OTHER, valid, at=lines["DATA_TYPE"])


def _peak(written: str, units: str | None) -> float | None:
    """Return the stated peak in the unit of the samples, where that is known."""
    from rocksteady.records.core.units import acceleration_unit, in_m_s2

    value, name = number(written), acceleration_unit(units or "")
    return None if value is None or name is None else value * in_m_s2("cm/s^2") / in_m_s2(name)
