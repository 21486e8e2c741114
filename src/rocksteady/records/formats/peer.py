"""Reader of PEER's AT2 acceleration files: header text, a line of counts, then samples.

The line with the counts has had several forms: ``NPTS= 5372, DT= .0100 SEC``, the same in lower
case, without SEC, with DT first or on a line of its own, and ``5372 .0100 NPTS, DT``. Files of
velocity (VT2) and displacement (DT2) look the same except for their units, and are refused.
"""

import re
from typing import TYPE_CHECKING, Final

from rocksteady.errors import RecordFileError
from rocksteady.records.core.assembling import Channel, Given, built
from rocksteady.records.core.consistency import Lines, agreed
from rocksteady.records.core.header_statements import refuse_factors, stated_unit, time_value
from rocksteady.records.core.numbers import NUMBER, number, samples
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.text import RecordText

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

FORMAT: Final = "peer-at2"

_WITHIN: Final = 40
"""Lines among which the one with the counts is looked for."""

_NAMES_FIRST: Final = re.compile(
    rf"NPTS\s*[=:]?\s*(?P<count>{NUMBER})[\s,;]*(?:DT|DELTA(?:\s*T)?)"
    rf"\s*(?:\((?P<unit>[^)]*)\))?\s*[=:]?\s*(?P<dt>{NUMBER})",
    re.IGNORECASE,
)
_NUMBERS_FIRST: Final = re.compile(
    rf"(?<![\d.,])(?P<count>{NUMBER})[\s,;]+(?P<dt>{NUMBER})[\s,;]*(?P<after>[A-Z]*)[\s,;]*"
    r"NPTS\W*DT\s*(?:\((?P<unit>[^)]*)\))?",
    re.IGNORECASE,
)
_COUNTS: Final = re.compile(r"\bNPTS\b", re.IGNORECASE)
_COUNT_ALONE: Final = re.compile(
    rf"\bNPTS\s*[=:]?\s*(?P<count>{NUMBER})(?![\d.]*,\d)", re.IGNORECASE
)
_INTERVAL_ALONE: Final = re.compile(
    rf"\b(?:DT|DELTA(?:\s*T)?)\s*(?:\((?P<unit>[^)]*)\))?\s*[=:]?\s*(?P<dt>{NUMBER})",
    re.IGNORECASE,
)
_OTHER: Final = re.compile(
    r"\s*(VELOCITY|DISPLACEMENT|(?:PSEUDO[\s-]*)?(?:SPECTRAL|RESPONSE)\s+\w+)\b", re.IGNORECASE
)
_OWNER: Final = re.compile(
    r"\s*\((?![^()]*(?:posit|negat|\bup|\bdo?wn|\bdown|rever|invert|flip|turn|oppos|minus|sign))"
    r"[^()]*\)\s*$",
    re.IGNORECASE,
)
"""Who made the record; words of a direction in brackets belong to the component."""
_DATE: Final = re.compile(r"\d{1,4}[/-]\d{1,2}[/-]\d{1,4}")


def recognises(text: RecordText) -> bool:
    """Return whether a file looks like one of PEER's."""
    at = _line_of_counts(text)
    if at is None:
        return False
    # Other files of text contain NPTS as well, but not the interval in the same line.
    has_interval = "DT" in text.heads[at].upper()
    return has_interval or any("UNITS OF" in line.upper() for line in text.heads[:at])


def read(text: RecordText, given: Given) -> tuple[Recording, ...]:
    """Return the one channel of a file.

    Raises
    ------
    RecordFileError
        If it is not one of acceleration, its header cannot be understood or samples are missing.
    """
    at = _line_of_counts(text)
    hint = "write the line as NPTS= 5372, DT= .0100 SEC"
    if at is None:
        raise text.error("no line of its header states NPTS and DT", hint)
    count, dt_s, last = _counts(text, at, given)
    if count is None or (dt_s is None and given.dt_s is None):
        raise text.error("it must state the number of samples and their interval", hint, at=at)
    head = [line for line in text.heads[:at] if line.strip()]
    values, end = samples(text.lines, last + 1, at_most=count)
    _refuse_times(text, values, dt_s, last + 1)
    kept, warnings = agreed(text, values, count, Lines(stated=at, start=last + 1, end=end))
    event, station, component = _words(head[1] if len(head) > 1 else "")
    channel = Channel(
        values=kept,
        units=_units(text, at, given),
        dt_s=dt_s,
        component=component,
        station=station,
        event=event,
        warnings=warnings,
    )
    return (built(text, FORMAT, channel, given),)


def _line_of_counts(text: RecordText) -> int | None:
    """Return the index of the line that states the number of samples."""
    for at, line in enumerate(text.heads[:_WITHIN]):
        if _COUNTS.search(line):
            return at
    return None


def _counts(text: RecordText, at: int, given: Given) -> tuple[int | None, float | None, int]:
    """Return number of samples and interval, and the index of the last line that states them."""
    line = text.heads[at]
    for pattern, name in ((_COUNT_ALONE, "count"), (_INTERVAL_ALONE, "dt")):
        near = [text.heads[place] for place in (at - 1, at, at + 1) if 0 <= place < len(text.heads)]
        values = {number(match[name]) for head in near for match in pattern.finditer(head)}
        if len(values) > 1 and (name == "count" or given.dt_s is None):
            raise text.error("it is stated twice, with two values", "correct one of them", at=at)
    match = _NAMES_FIRST.search(line) or _NUMBERS_FIRST.search(line)
    if match is not None:
        return _whole(match["count"]), _seconds(text, at, match, given), at
    alone = _COUNT_ALONE.search(line)
    # The interval may stand before the count, or on a line of its own beside it.
    for place in (at, at + 1, at - 1):
        if 0 <= place < len(text.heads) and (stated := _INTERVAL_ALONE.search(text.heads[place])):
            count = None if alone is None else _whole(alone["count"])
            return count, _seconds(text, place, stated, given), max(at, place)
    return None if alone is None else _whole(alone["count"]), None, at


def _seconds(text: RecordText, at: int, match: re.Match[str], given: Given) -> float | None:
    """Return the interval that a line states, with the unit before or after it [s].

    Raises
    ------
    RecordFileError
        If number or unit are not understood as a whole, and no interval is given.
    """
    if given.dt_s is not None:
        return number(match["dt"])
    parts = match.groupdict()
    written = match.string[match.start("dt") :]
    if "after" in parts:
        written = f"{parts['dt']} {parts['after']}"
    return time_value(text, at, written, parts["unit"])


def _whole(written: str) -> int | None:
    """Return the whole number that a text is, or None."""
    value = number(written)
    return None if value is None or value != int(value) else int(value)


def _units(text: RecordText, at: int, given: Given) -> str | None:
    """Return the units that the header states.

    Raises
    ------
    RecordFileError
        If they, or the header's words, are those of velocity or displacement, they are not
        understood as a whole, or a factor is stated.
    """
    for index, line in enumerate(text.heads[:at]):
        if index > 0 and (match := _OTHER.match(line)):
            valid = f"it is a file of {match[1].lower()}, and the base moves by its acceleration"
            raise text.error(valid, "give the record's file of acceleration (AT2)", at=index)
    if given.units is None:
        refuse_factors(text, list(range(at + 2)))
        return stated_unit(text, list(range(at + 1)), explicit=True)
    try:
        return stated_unit(text, list(range(at + 1)), explicit=True)
    except RecordFileError:
        return None


def _refuse_times(text: RecordText, values: "Floats", dt_s: float | None, at: int) -> None:
    """Raise where times stand beside the samples, which the format does not have.

    Taken for samples they would be a ramp, and half the record would be left out.
    """
    import numpy as np

    first = values[:40:2]
    if dt_s and len(first) > 4 and np.allclose(np.diff(first), dt_s, rtol=1.0e-3, atol=0.0):
        valid = "times stand beside the samples, and a file of PEER's holds samples alone"
        raise text.error(valid, "take its header off, to have it read as a table", at=at)


def _words(line: str) -> tuple[str | None, str | None, str | None]:
    """Return event, station and component from ``EVENT DATE, STATION, COMPONENT (OWNER)``."""
    parts = [part.strip() for part in _OWNER.sub("", line).split(",")]
    if len(parts) < 3:
        return (line.strip() or None), None, None
    dated = [index for index, part in enumerate(parts[:-2]) if _DATE.search(part)]
    # The station's own name may have a comma in it: it begins after the date and its time.
    first = dated[-1] + 1 if dated else len(parts) - 2
    while first < len(parts) - 2 and re.fullmatch(r"[\d:. ]+", parts[first]):
        first += 1
    station, component = ", ".join(parts[first:-1]), parts[-1]
    return ", ".join(parts[:first]) or None, station or None, component or None
