"""Direction, station, start and unit of the peak stated in the words above a table."""

import re
from collections.abc import Iterator
from datetime import datetime
from typing import Final

from rocksteady.records.core.directions import pointing, tells_nothing, together
from rocksteady.records.core.header_statements import PEAK
from rocksteady.records.core.moments import moment
from rocksteady.records.core.numbers import NUMBER, number
from rocksteady.records.core.text import RecordText
from rocksteady.records.core.units import acceleration_unit, in_m_s2

_KEYS: Final = {
    "direction": r"comp(?:onent\w*|\.)?|orient(?:a\w+(?:[ _]of[ _]\w+)?|ierung|\.)"
    r"|dire(?:c|z)\w*|dir\.?|azimut\w*|chan(?:nel)?(?:[ _](?:code|name))?|canal\w*|komponente?"
    r"|composante|bile[sş]en|stream|rumbo|sid|(?:seed[ _])?id|trace|code"
    r"|nslc|sncl|kcmpnm|cmpt?|eje|asse|axe|axis|kanal|richtung|\u6210\u5206",
    "station": r"(?:recording[ _])?station(?:[ _]?(?:code|name|id|no))?(?:[ _/]+name)?"
    r"|site[ _]?code|(?:c\w+[ _]de[ _](?:la[ _])?)?estaci[oó]n|stazione|istasyon\w*",
    "start": r"(?:data[ _])?start(?:[ _]?(?:date|time))?|record(?:ing)?[ _]?time|initial[ _]?time"
    r"|(?:date[ _&/]*)?time[ _]of[ _](?:the[ _])?first[ _](?:sample|point)"
    r"|first[ _]sample(?:[ _]time)?|hora[ _]de[ _](?:la[ _]primera[ _]\w+|inicio)",
}
_VALUE: Final = (
    r"\s*(?:\((?P<zone>[^)]*)\))?(?:\s*[:=]|(?<=[prt]\.)(?=\s))\s*(?P<value>\S.*?)"
    r"\s*(?:;|,?\s+[\w/]+\s?[:=]|\s{3,}|$)"
)
_STATED: Final = {
    name: re.compile(rf"(?:^|[\s,;#|*])(?P<key>{words}){_VALUE}", re.IGNORECASE)
    for name, words in _KEYS.items()
}
_LONGEST: Final = 30
_OF_EVENT: Final = re.compile(
    r"\b(?:epicent\w*|back|source|event|hypocent\w*|fault|strike|rupture|wind|slip|distance)\b",
    re.IGNORECASE,
)
_UPRIGHT: Final = re.compile(r"(?:[:=]|\bID\b)\s*(\S{2,12}|[zZ])\s*$")
_UPRIGHT_ANGLE: Final = re.compile(r"\bdip\W{1,3}-?90\b|\bcmpinc\W+(?:0|180)\b", re.IGNORECASE)
"""What states a vertical direction under whatever key."""
_TITLES: Final = re.compile(r"\b(vertical|horizontal)\b", re.IGNORECASE)


def _values(text: RecordText, lines: list[int], name: str) -> Iterator[re.Match[str]]:
    """Yield what lines of words state under a name."""
    for at in lines:
        yield from _STATED[name].finditer(text.heads[at])


def stated_station(text: RecordText, lines: list[int]) -> str | None:
    """Return the station that lines of words state first, or None."""
    return next((match["value"] for match in _values(text, lines, "station")), None)


def stated_start(text: RecordText, lines: list[int]) -> datetime | None:
    """Return the time of the first sample that lines of words state (UTC), or None."""
    times = (moment(each["value"], each["zone"] or "") for each in _values(text, lines, "start"))
    return next((time for time in times if time is not None), None)


def stated_direction(text: RecordText, lines: list[int]) -> str | None:
    """Return the direction of the one channel as lines of words name it, or None.

    A line that is nothing but a direction, as ``090 DEGREES``, states it too; where two differ,
    both are returned, as ``UP / 090``.
    """
    written = [
        match["value"]
        for match in _values(text, lines, "direction")
        # The number of a channel is no azimuth, nor is the direction of an epicentre.
        if not _OF_EVENT.search(match.string[: match.start("key")])
        and not (match["value"].isdecimal() and match["key"].lower().startswith(("ch", "can")))
    ]
    alone = (text.heads[at].strip(" \t#%!*/") for at in lines)
    written += [
        line
        for line in alone
        if len(line) <= _LONGEST and not line.isdecimal() and pointing(line).orientation is not None
    ]
    written += [
        match[1]
        for at in lines
        if (match := _UPRIGHT.search(text.heads[at]))
        and pointing(match[1]).orientation == "vertical"
    ]
    written += ["vertical" for at in lines if _UPRIGHT_ANGLE.search(text.heads[at])]
    if together(written) is None:
        written += [word for at in lines for word in _TITLES.findall(text.heads[at])]
    return together(written) or next((name for name in written if not tells_nothing(name)), None)


def unit_of_peaks(text: RecordText, lines: list[int], peaks: list[float]) -> str | None:
    """Return the unit in which a line of words states the peak of one of the channels, or None.

    Parameters
    ----------
    text
        The file.
    lines
        Indices of its lines of words.
    peaks
        Largest absolute number of each channel.
    """
    units: dict[float, str] = {}
    for at in lines:
        line = text.heads[at]
        if PEAK.search(line) is None:
            continue
        before = re.search(r"[(\[]([A-Za-z%][^)\]]*)[)\]]", line)
        for value in re.finditer(rf"({NUMBER})\s*([A-Za-z%][\w/^*]*)?", line):
            unit = acceleration_unit(value[2] or (before[1] if before else ""))
            size = abs(number(value[1]) or 0.0)
            if unit is not None and any(abs(size - peak) <= 0.005 * peak for peak in peaks):
                units[in_m_s2(unit)] = unit
    return next(iter(units.values())) if len(units) == 1 else None
