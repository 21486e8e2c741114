"""Times of first samples, in the forms that networks write."""

import contextlib
import re
from datetime import UTC, datetime, timedelta, timezone
from typing import Final

_MOMENT: Final = re.compile(
    r"(?:(?P<year>\d{4})[-/. ]?(?P<month>\d\d?)[-/. ]?(?P<day>\d\d?)"
    r"|(?P<first>\d\d?)[-/.](?P<second_>\d\d?)[-/.](?P<late>\d{4}))"
    r"[T_ ,;:-]+(?P<hour>\d\d?)[: ]?(?P<minute>\d\d)[: ]?(?P<second>\d\d(?:\.\d*)?)"
    r"\s*(?P<zone>Z\b|\(?(?:UTC|GMT)?\s*(?:[+-]\s*\d{1,2}(?::?\d\d)?)?\)?)"
)
_OFFSET: Final = re.compile(r"([+-])\s*(\d{1,2}):?(\d\d)?")


def moment(written: str, zone: str = "") -> datetime | None:
    """Return the time that a text states first (UTC), or None where it states none.

    Parameters
    ----------
    written
        Date and time of day, with its zone; UTC without one.
    zone
        The zone, where it stands elsewhere, as ``GMT+08``.

    Examples
    --------
    >>> moment("2001/01/01-23:50:29.000", "GMT+08").isoformat()
    '2001-01-01T15:50:29+00:00'
    >>> moment("13/02/2012 21:06:45 (GMT)").isoformat(), moment("unknown")
    ('2012-02-13T21:06:45+00:00', None)

    Notes
    -----
    Where day and month stand first and either may be which, the time is not known.
    """
    match = _MOMENT.search(written)
    if match is None:
        return None
    offset = _OFFSET.search(match["zone"]) or _OFFSET.search(zone)
    ahead = timedelta()
    if offset is not None:
        ahead = timedelta(hours=int(offset[2]), minutes=int(offset[3] or 0))
        ahead = -ahead if offset[1] == "-" else ahead
    if match["year"] is not None:
        orders = {(match["year"], match["month"], match["day"])}
    else:
        first, second, year = match["first"], match["second_"], match["late"]
        orders = {(year, first, second), (year, second, first)}
    times = set()
    for parts in orders:
        with contextlib.suppress(ValueError, OverflowError):
            year, month, day = map(int, parts)
            hour, minute = int(match["hour"]), int(match["minute"])
            local = datetime(year, month, day, hour, minute, tzinfo=timezone(ahead))
            seconds = timedelta(seconds=round(float(match["second"]), 6))
            times.add((local + seconds).astimezone(UTC))
    return times.pop() if len(times) == 1 else None
