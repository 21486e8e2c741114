"""Reader of PEER's AT2 acceleration files: header text, a line of counts, then samples.

The line with the counts has had several forms: ``NPTS= 5372, DT= .0100 SEC``, the same in lower
case, without SEC, with DT first or on a line of its own, and ``5372 .0100 NPTS, DT``. Files of
velocity (VT2) and displacement (DT2) look the same except for their units, and are refused.
"""

import re
from typing import TYPE_CHECKING, Final

from rocksteady.records.core.assembling import Channel, Given, built, other_quantity
from rocksteady.records.core.column_names import quantity_named
from rocksteady.records.core.consistency import Lines, agreed
from rocksteady.records.core.directions import Pointing, pointing, together
from rocksteady.records.core.header_statements import (
    count_value,
    find_values,
    interval_value,
    refuse_factors,
    stated_unit,
    unless_given,
)
from rocksteady.records.core.numbers import NUMBER, number, samples
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.text import CONTRADICTION, RecordText

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

FORMAT: Final = "peer-at2"

_MOST_WORDS: Final = 4
_WORDS: Final = re.compile(r"\s*[A-Za-z]{3}")
_WITHIN: Final = 40
"""Lines among which the one with the counts is looked for."""

_NUMBERS_FIRST: Final = re.compile(
    rf"[^\d.+-]*(?P<count>{NUMBER})[\s,;]+(?P<dt>{NUMBER})[\s,;]*(?P<after>[A-Z]*)[\s,;]*"
    r"NPTS\W*DT\s*(?:\((?P<unit>[^)]*)\))?",
    re.IGNORECASE,
)
_COUNTS: Final = re.compile(r"\bNPTS\b", re.IGNORECASE)
_COUNT: Final = re.compile(r"\bNPTS\s*[=:]?\s*(?P<value>[+-]?[\d.].*)", re.IGNORECASE)
_INTERVAL: Final = re.compile(
    r"(?<![A-Z])(?:DT|DELTA(?:\s*T)?)\s*(?:\((?P<unit>[^)]*)\))?\s*[=:]?\s*"
    r"(?P<value>[+-]?[\d.].*)",
    re.IGNORECASE,
)
_OTHER: Final = re.compile(
    r"\s*(VELOCITY|DISPLACEMENT|PSEUDO\W*\w+|ROTD\w*|(?:\w+\s+)?(?:RESPONSE|SPECTR\w*)|(?:PSEUDO[\s-]*)?(?:SPECTRAL|RESPONSE)\s+\w+)\b",
    re.IGNORECASE,
)
_UPRIGHT: Final = re.compile(r"\b(?:vertical|vert|up|dwn|down)\b", re.IGNORECASE)
_ACCELERATION: Final = re.compile(r"\s*acc", re.IGNORECASE)
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
    count, dt_s, last, doubts = _counts(text, at, given)
    if count is None or (dt_s is None and given.dt_s is None):
        raise text.error("it must state the number of samples and their interval", hint, at=at)
    last = _last_words(text, last)
    head = [line for line in text.heads[:at] if line.strip()]
    values, end = samples(text.lines, last + 1, at_most=count)
    _refuse_times(text, values, dt_s, last + 1)
    kept, warnings = agreed(text, values, count, Lines(stated=at, start=last + 1, end=end))
    event, station, component = _words(head[1] if len(head) > 1 else "")
    others = (_words(line)[2] for line in head[2:])
    component = together(name for name in (component, *others) if name) or component
    word = _UPRIGHT.search(" ".join(head[1:2]))
    if word is not None and pointing(component) == Pointing() and " / " not in (component or ""):
        component = word[0]
    units, unread = _units(text, last, given)
    channel = Channel(
        values=kept,
        units=units,
        dt_s=dt_s,
        component=component,
        station=station,
        place=station or "",
        event=event,
        warnings=warnings + doubts + unread,
    )
    return (built(text, FORMAT, channel, given),)


def _last_words(text: RecordText, last: int) -> int:
    """Return the index of the last line of words below the counts, where words follow them."""
    below = range(last + 1, min(last + 1 + _MOST_WORDS, len(text.heads)))
    return max((at for at in below if _WORDS.match(text.heads[at])), default=last)


def _line_of_counts(text: RecordText) -> int | None:
    """Return the index of the line that states the number of samples."""
    for at, line in enumerate(text.heads[:_WITHIN]):
        if _COUNTS.search(line):
            return at
    return None


def _counts(
    text: RecordText, at: int, given: Given
) -> tuple[int | None, float | None, int, tuple[str, ...]]:
    """Return number of samples, interval, the index of the last line that states them; warnings."""
    near = [place for place in (at, at + 1, at - 1) if 0 <= place < len(text.heads)]
    for pattern in (_COUNT, _INTERVAL):
        stated = (
            statement["value"]
            for place in near
            for statement in find_values(pattern, text.heads[place])
        )
        values = {number(match[0]) for value in stated if (match := re.match(NUMBER, value))}
        if len(values) > 1:
            valid, hint = "it is stated twice, with two values", "correct one of them"
            raise text.error(valid, hint, at=at, kind=CONTRADICTION)
    line = text.heads[at]
    numbers_first = _NUMBERS_FIRST.match(line)
    if numbers_first is not None:
        written = f"{numbers_first['dt']} {numbers_first['after']}"
        dt_s, doubts = interval_value(text, at, written, numbers_first["unit"], given.dt_s)
        return count_value(text, at, numbers_first["count"]), dt_s, at, doubts
    alone = _COUNT.search(line)
    count = None if alone is None else count_value(text, at, alone["value"])
    # The interval may stand before the count, or on a line of its own beside it.
    for place in near:
        if (statement := _INTERVAL.search(text.heads[place])) is not None:
            written, unit = statement["value"], statement["unit"]
            dt_s, doubts = interval_value(text, place, written, unit, given.dt_s)
            return count, dt_s, max(at, place), doubts
    return count, None, at, ()


def _units(text: RecordText, last: int, given: Given) -> tuple[str | None, tuple[str, ...]]:
    """Return the units that the header states, and warnings.

    Raises
    ------
    RecordFileError
        If they, or the header's words, are those of velocity or displacement, they are not
        understood as a whole, or a factor is stated.
    """
    for index, line in enumerate(text.heads[: last + 1]):
        if index > 0 and (match := _OTHER.match(line)):
            quantity = quantity_named(match[1]) or "spectra"
            raise other_quantity(text, quantity, "it is a file of another quantity", at=index)
    lines = list(range(last + 1))
    named = [at for at in lines if _ACCELERATION.match(text.heads[at])]

    def state() -> str | None:
        refuse_factors(text, lines)
        return stated_unit(text, lines, explicit=True) or stated_unit(text, named)

    return unless_given(given.units, state)


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
