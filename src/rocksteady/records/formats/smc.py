"""Reader of SMC, the format of the U.S. Geological Survey's strong-motion program.

Eleven lines of words, six of whole numbers and ten of real ones, whose first value each marks what
is missing, then lines of comment and the samples [cm/s^2] in columns of ten characters that run
together. An uncorrected file without a sampling rate holds times and samples in turn.
"""

import re
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.column_names import OTHER, quantity_named
from rocksteady.records.core.consistency import Lines, agreed, timing
from rocksteady.records.core.numbers import numbers, samples
from rocksteady.records.core.recording import Orientation, Recording
from rocksteady.records.core.sampling import evenly_spaced, places
from rocksteady.records.core.text import FETCH, RecordText

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

FORMAT: Final = "smc"

_GROW: Final = 0.95
"""Part of the times of a file that grow; fewer where some are damaged."""
_WORDS, _WHOLE, _REAL = 11, 6, 10
"""Lines of each part of the header."""

_STRUCTURES: Final = {1.0, 2.0, 3.0}
"""Codes of buildings, bridges and dams; a bridge's or a dam's place 0 is the free field."""
_KIND: Final = re.compile(
    r"\s*(?:\d+\s+(?:(?:UN)?CORRECTED\s+ACCELEROGRAM|UNKNOWN)|\*)\s*", re.IGNORECASE
)
_OTHER: Final = re.compile(r"\s*\d+\s+.*(VELOCITY|DISPLACEMENT|SPECTR)", re.IGNORECASE)
_HINT: Final = f"{FETCH}, as text"


def recognises(text: RecordText) -> bool:
    """Return whether a file is laid out like an SMC file."""
    first = text.heads[0]
    if _KIND.fullmatch(first) is None and _OTHER.match(first) is None:
        return False
    return sum(line.strip() == "*" for line in text.heads[:_WORDS]) >= 2


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the one channel of a file.

    Raises
    ------
    RecordFileError
        If it is not one of acceleration, its header cannot be understood or samples are missing.
    """
    if _KIND.fullmatch(text.heads[0]) is None:
        quantity = quantity_named(text.heads[0]) or OTHER
        raise other_quantity(text, quantity, "it must be an accelerogram", at=0)
    unknown = "unknown" in text.heads[0].lower()
    if unknown and given.units is None:
        valid = "the file states neither its quantity nor a unit"
        raise text.error(valid, "give units where it is an acceleration (TSPP: cm/s^2)", at=0)
    import numpy as np

    whole = _values(text, _WORDS, _WHOLE, 48)
    real = _values(text, _WORDS + _WHOLE, _REAL, 50)
    known = [None if value == whole[0] else value for value in whole]
    stated = [None if value == real[0] else value for value in real]
    comments = known[15] or 0.0
    if not (0.0 <= comments < len(text.lines) and comments.is_integer()):
        raise text.error("it states more comments than the file has lines", _HINT, at=_WORDS + 1)
    start = _WORDS + _WHOLE + _REAL + int(comments)
    start += sum(line.startswith("|") for line in text.heads[start : start + 1000])
    at = _WORDS + 2
    if known[16] is None or not known[16].is_integer():
        raise text.error("it must state the number of samples first", _HINT, at=at)
    count = int(known[16])
    values, end = samples(text.lines, start, at_most=max(count, 1))
    kept, warnings = agreed(text, values, count, Lines(stated=at, start=start, end=end))
    rate, interval = stated[1], None
    notes: tuple[str, ...] = ()
    if rate is not None and rate > 0.0:
        interval = 1.0 / rate
        sizes = [(abs(stated[place + 1] or 0.0), stated[place]) for place in (28, 30)]
        peak_at = max(sizes, key=lambda pair: pair[0])[1]
        warnings += timing(kept, interval, peak_at=peak_at)
    elif _in_turn(kept):
        kept = kept[: len(kept) // 2 * 2]
        rounding = places([f"{time:.4E}" for time in kept[0::2]])
        # Two times that are written alike lie within the last digit.
        alike = np.flatnonzero(np.diff(kept[0::2]) == 0.0) + 1
        times = kept[0::2].copy()
        times[alike] += 0.5 * rounding[alike]
        spaced = evenly_spaced(
            text,
            times,
            kept[1::2],
            given,
            rounding=rounding,
            line_of=lambda sample: start + sample // 4,
        )
        kept, interval, notes = spaced.values, spaced.dt_s, spaced.notes
        warnings += spaced.warnings
    elif given.dt_s is None:
        valid = "it must state a sampling rate above 0, as its second number"
        raise text.error(valid, "give dt_s, in seconds", at=_WORDS + _WHOLE)
    if text.heads[0].strip() == "*":
        warnings = (*warnings, "the file does not state its quantity: taken to be acceleration")
    orientation, azimuth, down = _pointing(known[12], known[13])
    channel = Channel(
        values=kept,
        units=None if unknown else "cm/s^2",
        dt_s=interval,
        stated_peak=max((abs(peak) for peak in (stated[29], stated[31]) if peak), default=None),
        component=_after(text, 5, "component") or None,
        orientation=orientation,
        azimuth_deg=azimuth,
        down=down,
        position="structure" if known[18] in _STRUCTURES and 0.0 not in known[26:28] else None,
        place=text.heads[5],
        station=_after(text, 5, "station", until="component") or text.heads[2].strip() or None,
        event=text.heads[3][25:].strip() or None,
        start_time=_start(known[1:7]),
        warnings=warnings,
        processing=notes,
    )
    return (built(text, FORMAT, channel, given),)


def _in_turn(values: "Floats") -> bool:
    """Return whether times and samples follow each other: every second number grows to the end."""
    import numpy as np

    times = values[0::2]
    grows = np.diff(times) >= 0.0
    return len(values) >= 4 and bool(grows.mean() >= _GROW and times[-1] == times.max() > times[0])


def _values(text: RecordText, start: int, lines: int, count: int) -> list[float]:
    """Return the numbers of a part of the header."""
    values: list[float] = []
    for at in range(start, start + lines):
        line = text.heads[at] if at < len(text.lines) else ""
        row = numbers(line, 15 if count == 50 else 10)
        if row is None or len(row) != count // lines:
            valid = f"it must hold {count // lines} numbers of the header"
            raise text.error(valid, _HINT, at=at)
        values += row
    return values


def _pointing(
    vertical: float | None, horizontal: float | None
) -> tuple[Orientation | None, float | None, bool | None]:
    """Return orientation, azimuth and sense from the angles from upward and from north."""
    if vertical in {0.0, 180.0}:
        return "vertical", None, vertical == 180.0
    if vertical == 90.0 and horizontal is not None and 0.0 <= horizontal <= 360.0:
        return "horizontal", horizontal, None
    return None, None, None


def _after(text: RecordText, at: int, key: str, until: str | None = None) -> str:
    """Return what stands after ``key =`` in a line of words."""
    _, _, rest = text.heads[at].partition(key)
    rest = rest.lstrip().removeprefix("=")
    if until is not None:
        rest = rest.partition(until)[0]
    return rest.strip()


def _start(parts: list[float | None]) -> datetime | None:
    """Return the start from year, day of the year, hour, minute, second and millisecond (UTC)."""
    year, day, hour, minute, second, milliseconds = (
        None if part is None else int(part) for part in parts
    )
    if None in (year, day, hour, minute) or not 1800 <= (year or 0) <= 9999:
        return None
    try:
        first = datetime(year or 1, 1, 1, tzinfo=UTC)
        return first + timedelta(
            days=(day or 1) - 1,
            hours=hour or 0,
            minutes=minute or 0,
            seconds=second or 0,
            milliseconds=milliseconds or 0,
        )
    except OverflowError:
        return None
