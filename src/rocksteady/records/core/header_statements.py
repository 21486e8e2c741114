"""Unit, interval, count, duration and factors stated in the text above the samples.

A statement is understood as a whole or refused with its line, and several of one thing must agree.
"""

import math
import re
from collections.abc import Callable, Iterator
from typing import Final, TypeVar

from rocksteady.errors import RecordFileError
from rocksteady.records.core.numbers import NUMBER, number
from rocksteady.records.core.text import CONTRADICTION, CORRECT, RecordText
from rocksteady.records.core.units import (
    UNITS,
    acceleration_unit,
    in_m_s2,
    in_seconds,
    leading,
    modifies,
    quantity_of,
)

T = TypeVar("T")

_EXPLICIT: Final = re.compile(
    r"(?:(?:\b|(?<=_)|(?<=[a-z]))units?|\b(?:unidad(?:es)?|unit[aà]|unit[ée]s?|einheit(?:en)?|birim\w*))\b"
    r"\s*(?:(?:of|in(?!\s*/)|is|are|for|de|di|der|los|las|del)\b\s*)*(?:the\s+)?"
    r"(?:acc\w*|acel\w*|data|datos|dati|samples|values|misura)?\s*"
    r"(?:(?:of|in(?!\s*/)|is|are)\b\s*)*[:=(\[]*\s*(?:in\s+)?",
    re.IGNORECASE,
)
_IN: Final = re.compile(r"(?<![A-Za-z])in\s+(?!units?\b)|[(\[]\s*(?!units?\b)", re.IGNORECASE)
PEAK: Final = re.compile(r"pga|peak|\bpk\b|max(?![a-z]*\s*freq)|m[aá]xim", re.IGNORECASE)
"""Words of a largest value."""
_OF_ANOTHER: Final = re.compile(
    rf"(?:{PEAK.pattern}|\bmin\b|gravit|\bg\s*=|offset|clip|alarm|design|previous|soil|mass|format|trigger|threshold|umbral|sensor|sensit|full[\s-]?scale|\besc\.|escala"
    r"|\brange\b|resolution|noise|instr|rms|limit).*$",
    re.IGNORECASE,
)
"""Words before a unit that is not that of the samples."""
_EQUALS: Final = re.compile(r"\s*[(\[]\s*(?:1\s*)?(?:g\s*=\s*)?([^)\]=]*)[)\]]", re.IGNORECASE)
_POWER_OF_TEN: Final = re.compile(
    r"[x*×]\s*10\s*(?:\^|\*\*|e\s*[+-]?\d|[⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹])", re.IGNORECASE
)
_MULTIPLE: Final = re.compile(
    r"(?:^[#%!/*\s]*|\b(?:values?|data|acc\w*|samples?|amplitudes?|numbers?|units?|g|gal)\s*)"
    r"(?:[x×]\s*\d|[*·]\s*\d+(?:\.\d*)?\s*$)|\d\s*[x×*·]\s*(?:values?|data|acc\w*|samples?|g)\b"
    r"|\b(?:values?|data|acc\w*|samples?)\s+(?:are\s+)?(?:doubled|halved|negated)\b",
    re.IGNORECASE,
)
"""A factor without a word for it."""
_NOT_NOW: Final = re.compile(
    r"\b(?:not|was|were|been|originally|formerly|previously|from|before)\W+(?:\w+ed\s+)?$",
    re.IGNORECASE,
)
_TWO: Final = re.compile(
    r"\W*(?:or|to)\b|[^.]*\b(?:now|converted|instead|doubled|halved|negated)\b", re.IGNORECASE
)
"""What stands beside a unit that may not be that of the samples."""
_TWO_TIMES: Final = re.compile(
    r".*(?:resampl|interpolat|decimat|down-?sampl|up-?sampl|\bnow\b)", re.IGNORECASE
)
_GOES_ON: Final = re.compile(
    r"(?!\s*1\s*/\s*[A-Za-z])(?:[\^'\u2019_]|\.(?=\S)|\s*%|"
    r"[\s,;:|/*x×·^()\[\]+±=-]*(?:(?:or|to|and|now|then)\b[\s:=]*)?\.*\d)",
    re.IGNORECASE,
)
"""What may not follow a number: more of it, a power, percent, or a second number."""
_ANOTHER_THING: Final = re.compile(
    r"[\s,;(\[]*\d+[\s-]*(?P<word>[A-Za-z]{2,})\b(?!\s*[=:(])", re.IGNORECASE
)
"""A number of other things, behind the first: ``, 400 points``."""
_PER: Final = re.compile(r"\s*(?:per\b|percent\b)|\s*[A-Za-z]+/", re.IGNORECASE)
_PLAIN_UNIT: Final = re.compile(r"(?:1?\s*/)?\s*[A-Za-zµμ][^\d%]*(?:1\)?)?")
"""A unit without a number of its own: behind a number, that would be a second one."""
_RATE_ALONE: Final = re.compile(
    rf"[#%!/*\s]*(?P<value>(?:\d+,(?=\d))?{NUMBER}\s*(?P<unit>[A-Za-z/ ]+?))\W*$"
)
_COUNT_ALONE: Final = re.compile(
    r"[#%!/*\s]*(?:(?:samples|points|values|pts|n)\s*[=:]?\s*(?P<value>\d+)"
    r"|(?P<before>\d+)\s+(?:data\s+)?(?:points|samples|values|pts))\s*$",
    re.IGNORECASE,
)
_TIME_IN: Final = re.compile(
    r"(?<![A-Za-z])(?:times?|t)(?:\s+(?:is|are|values?|column))*\s*(?P<how>\bin\b|[(\[:=])\s*"
    r"(?P<rest>[A-Za-zµμ%\d][^\n]*)",
    re.IGNORECASE,
)
_OTHER_TIME: Final = re.compile(
    r"(?:sampl\w*|origin|start|delay|rise|record|total|trigger|local|end|date|d)[\s_/-]*$",
    re.IGNORECASE,
)
_FACTOR: Final = re.compile(
    r"\b(?:(?:amplitude|acc\w*|data)?[ _-]*scal(?:e|ing)(?:[ _-]*factors?)?|multiplier"
    r"|multipl(?:y|ied|ication)(?:[ _-]+(?:by|factor))?|(?:conversion|calibration)(?:[ _-]factor)?"
    r"|factor|(?:divided?|scaled?)[ _-]+by|gain|lsb)\b(?:\s*[(\[][^)\]]*[)\]])?"
    r"(?:\s+(?:of|is|applied|used|by|to|the|all|data|samples|values))*\s*[:=]?\s*"
    rf"(?P<number>{NUMBER}|nan\b|inf\b)(?P<rest>.*)",
    re.IGNORECASE,
)
_NAMES: Final = {
    "interval": r"dt|d\.t\.|Δt|delta(?:[ _]*t)?|time[ _-]?(?:step|interval|increment|spacing)"
    r"|sampl(?:e|ing)[ _-]?(?:interval|period|step|time|spacing)|sampl\w*:?[ _]every"
    r"|(?:equally|evenly)[ -]spaced[ -](?:at|intervals?)|digiti[sz]ation[ _]interval"
    r"|(?:intervall?o|pass?o?)(?:[ _]d[ei][ _]\w+)?|abtast(?:intervall|zeit)|zeitschritt"
    r"|[öo]rnekleme aral\w+",
    "rate": r"(?:data[ _])?sampl(?:e|ing)[ _-]?(?:rate|freq\w*)|fs|samples? ?(?:/|per) ?s(?:ec\w*)?"
    r"|(?:vel\w*\.?|frec\w*\.?|tasa)[ _]de[ _]muestreo|freq\w*[ _]di[ _]campionamento"
    r"|fr[ée]quence[ _]d.[ée]chantillonnage|abtast(?:rate|frequenz)|[öo]rnekleme (?!aral)\w+",
    "duration": r"duration|duraci[oó]n|durata|(?:record|total)[ _-]?length"
    r"|length[ _-]of[ _-]record",
}
_STATED: Final = {
    name: re.compile(
        rf"(?<![A-Za-z])(?:{words})(?:_(?P<tail>hz|s|sec|ms))?(?=[\s:=(\[,])\s*"
        r"(?:[(\[](?P<unit>[^)\]]*)[)\]])?\s*"
        r"(?:(?:is|of|at)\b)?\s*[:=,]?\s*(?P<value>[+-]?(?:[\d.]|nan\b|inf)[^\n]*)",
        re.IGNORECASE,
    )
    for name, words in _NAMES.items()
}
_OTHER_DURATION: Final = re.compile(
    r"(?:signif\w*|bracket\w*|strong|uniform|effective|d5|5-95)[^,;]*$", re.IGNORECASE
)
_COUNT: Final = re.compile(
    r"(?<![A-Za-z])(?:npts|ndata|n[ _]?samp\w*|(?:number|num|no\.?|nr\.?)[ _]of[ _](?:\w+[ _])?"
    r"(?:data|points|samples|values|records|steps)(?:[ _]points)?|samples|points|sample[ _]count"
    r"|n[uú]m\w*\.?[ _](?:total[ _])?d[ei][ _](?:\w+[ _])?(?:mues|dat|punt|camp)\w+"
    r"|nombre[ _]d(?:e[ _]|.)(?:points|[ée]chant\w+)|anzahl[ _](?:der[ _])?(?:werte|daten|punkte)"
    r"|(?:veri|[öo]rnek)[ _]say\w+|data[ _](?:length|count|points))"
    r"\s*[:=]\s*(?P<value>[+-]?(?:[\d.]|nan\b|inf)[^\n]*)",
    re.IGNORECASE,
)
_OTHER_COUNT: Final = re.compile(
    r"(?:skipped|lost|missing|event|bad|dropped|interpolated|spectral|fft|raw)\s*$", re.IGNORECASE
)
_OTHER_RATE: Final = re.compile(
    r"(?:raw|original|digiti[sz]er|newmark|gps|analysis|output)\W*$", re.IGNORECASE
)
"""Words before a count or an interval that is not that of the samples."""
_DECIMAL_COMMA: Final = re.compile(r"([+-]?\d+),(\d+)(?![\d,.])")
_THOUSANDS: Final = re.compile(r"\+?[1-9]\d{0,2}(?:,\d{3})+(?![\d,.])")
_FIRST_WORD: Final = re.compile(r"\s*[A-Za-zµμ%][\w/^%*-]*+(?!\s*[=:])")
_NEXT_KEY: Final = re.compile(r"\s+[A-Za-z]+\s+[A-Za-z]+\s*[=:]")
"""What may stand behind a number whose unit stands before it."""
_COARSEST: Final = 0.005
"""Part by which an interval and a rate may differ for the digits that they are written with."""
_HINT_UNITS: Final = f"give units: {', '.join(UNITS)}, with a factor before it where there is one"


def stated_unit(text: RecordText, lines: list[int], *, explicit: bool = False) -> str | None:
    """Return the unit of acceleration that lines of words state, or None.

    Where they state one of another quantity alone, it is returned as it is written.

    Parameters
    ----------
    text
        The file.
    lines
        Indices of its lines of words.
    explicit
        Whether only statements with the word unit count.

    Raises
    ------
    RecordFileError
        If a statement is not understood to its end, or two of them contradict each other.
    """
    units: dict[str, int] = {}
    for at in lines:
        for unit in _units_in(text, at, explicit=explicit):
            units.setdefault(unit, at)
    others = {unit: at for unit, at in units.items() if acceleration_unit(unit) is None}
    if others and (explicit or len(others) < len(units)):
        units = {unit: at for unit, at in units.items() if unit not in others}
    elif others:
        return next(iter(others))
    sizes = {in_m_s2(unit) for unit in units}
    if len(sizes) > 1:
        valid = f"its header states {' and '.join(units)}, which are not one unit"
        raise text.error(valid, CORRECT, at=max(units.values()), kind=CONTRADICTION)
    return next(iter(units), None)


def _units_in(text: RecordText, at: int, *, explicit: bool) -> Iterator[str]:
    """Yield the units that one line states."""
    line = text.heads[at]
    for statement in _EXPLICIT.finditer(line):
        phrase = line[statement.end() :]
        unit, rest = leading(phrase)
        if quantity_of(phrase.strip()) in {"velocity", "displacement"}:
            yield phrase.strip()
        elif unit is not None and not _modified(unit, rest):
            yield acceleration_unit(unit) or unit
        elif (listed := _of_a_list(phrase)) is not None:
            yield listed
        elif unit is None and (foreign := leading(phrase, quantity_of)[0]) is not None:
            yield foreign
        elif phrase.strip() and not _OTHER_QUANTITY.match(phrase):
            raise _not_understood(text, at)
    if explicit:
        return
    for statement in _IN.finditer(line):
        unit, rest = leading(line[statement.end() :])
        before = line[: statement.start()]
        if unit is None or _OF_ANOTHER.search(before) or re.search(r"\d\s*$", before):
            continue
        if _modified(unit, rest):
            raise _not_understood(text, at)
        if _NOT_NOW.search(line[: statement.start()]):
            raise _not_understood(text, at)
        # A value, (0.35 g), is no unit; nor is the number of a thing.
        power = r"(?:10\s*(?:\^|\*\*|[⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹])|0?"
        if not re.match(r"[\d.]", unit) or re.match(power + r"\.0*1|1(?:[.]0*)?[eE])", unit):
            yield acceleration_unit(unit) or unit


def _of_a_list(phrase: str) -> str | None:
    """Return the one unit of acceleration of a list of units, one for each column."""
    body = re.split(r"[)\].]", phrase)[0]
    pieces = [piece.strip() for piece in re.split(r"[,;&]|\band\b", body) if piece.strip()]
    units = [acceleration_unit(piece) for piece in pieces]
    named = {unit for unit in units if unit is not None}
    others = {piece for piece, unit in zip(pieces, units, strict=True) if unit is None}
    others = {piece for piece in others if in_seconds(piece) is None and piece not in _NO_UNIT}
    if not named and len(others) == 1:  # s, counts
        return next((piece for piece in others if quantity_of(piece) is not None), None)
    known = all(quantity_of(piece) is not None for piece in others)
    return named.pop() if len(named) == 1 and known else None


_NO_UNIT: Final = {"-", "UTC"}
_OTHER_QUANTITY: Final = re.compile(r"(?:of|in)?\s*(?:vel|disp|time|sec)", re.IGNORECASE)


def _modified(unit: str, rest: str) -> bool:
    """Return whether words after a unit change its size; ``g (9.81 m/s2)`` only explains it."""
    same = _EQUALS.match(rest)
    if same is not None and (other_unit := acceleration_unit(same[1])) is not None:
        return not math.isclose(in_m_s2(unit), in_m_s2(other_unit), rel_tol=0.005)
    beside, _ = leading(rest.lstrip(" ,/|-"))
    two = beside is not None and not re.match(r"[\d.]", beside)
    if two and not math.isclose(in_m_s2(unit), in_m_s2(beside or unit), rel_tol=1e-9):
        return True
    return modifies(rest) or _TWO.match(rest) is not None


def _not_understood(text: RecordText, at: int) -> RecordFileError:
    """Return the error that a unit is not understood as a whole."""
    return text.error("its unit is not understood as a whole", _HINT_UNITS, at=at)


def refuse_factors(text: RecordText, lines: list[int], *, names: int | None = None) -> None:
    """Raise where lines of words state a factor other than 1 on the samples.

    Whether it has been applied already, and whether it multiplies or divides, is not stated.

    Parameters
    ----------
    text
        The file.
    lines
        Indices of its lines of words.
    names
        Index of the line of columns' names, such as ``x1``, which are understood elsewhere.

    Raises
    ------
    RecordFileError
        As above; the caller has not called this where units are given.
    """
    for at in lines:
        line = text.heads[at]
        factor = _FACTOR.search(line)
        if (
            (factor is not None and not _is_unity(factor["number"], factor["rest"]))
            or _POWER_OF_TEN.search(line)
            or (at != names and _MULTIPLE.search(line))
        ):
            valid = "a factor on the samples is stated, and whether it is applied already is not"
            hint = "give units: 'g' where it is applied, else with the factor in them, as '0.5 g'"
            raise text.error(valid, hint, at=at)


def unless_given(given: object, state: Callable[[], T]) -> tuple[T | None, tuple[str, ...]]:
    """Return what a file states; None and a warning where it is not understood, but given.

    Raises
    ------
    RecordFileError
        If it is not understood and not given, contradicts itself or is of another quantity.
    """
    try:
        return state(), ()
    except RecordFileError as error:
        if given is None or error.kind:
            raise
        return None, (f"{error.valid}: {given}, as given, is taken",)


def _is_unity(written: str, rest: str) -> bool:
    """Return whether a factor is 1, and nothing behind it changes that."""
    return number(written) == 1.0 and not _GOES_ON.match(rest) and not _PER.match(rest)


def time_value(
    text: RecordText,
    at: int,
    written: str,
    unit: str | None = None,
    hint: str = "give dt_s, in seconds",
) -> float:
    """Return a time [s] by a number with its unit, at the start of a text; rates as intervals.

    One number, above 0, with a decimal point or comma; then its unit, seconds without one. A second
    number behind it is that of other things, as in ``.01 SEC, 400 POINTS``.

    Parameters
    ----------
    text
        The file.
    at
        Index of the line.
    written
        Number, unit and whatever follows them.
    unit
        Unit that stands before the number; seconds without either, or ``Hz`` for a rate.
    hint
        What to do where it is not understood.

    Raises
    ------
    RecordFileError
        If number or unit are not understood as a whole.
    """
    written = written.strip()
    nothing = "it must state a time or a rate above 0"
    digits, rest = _first_number(written)
    if not digits:
        raise text.error(nothing, hint, at=at)
    value = number(digits)
    after, beyond = leading(rest.lstrip(" ("), in_seconds)
    if value is None or _goes_on(rest) or (after is not None and not _PLAIN_UNIT.fullmatch(after)):
        raise text.error("its number of seconds is not understood as a whole", hint, at=at)
    before = None if unit is None or not unit.strip() else in_seconds(unit)
    unknown = unit is not None and unit.strip() != "" and before is None
    odd = _FIRST_WORD.match(rest) and not (before is not None and _NEXT_KEY.match(rest))
    if after is None and (unknown or odd):
        raise text.error("its unit of time is not understood as a whole", hint, at=at)
    if _TWO_TIMES.match(beyond) or _goes_on(beyond):
        raise text.error("it states two times", hint, at=at)
    # What stands behind a comma is of another thing: SEC, NPTS= 400.
    if modifies(beyond) and not re.match(r"\s*[,;]|\s*\d", beyond):
        raise text.error("its unit of time is not understood as a whole", hint, at=at)
    size = in_seconds(after) if after is not None else (1.0 if before is None else before)
    if size is None or (after is not None and before is not None and size != before):
        raise text.error("it states two units of time", hint, at=at)
    seconds = value * size if size > 0.0 else -size / value if value else math.inf
    if not 0.0 < seconds < math.inf:
        raise text.error(nothing, hint, at=at)
    return seconds


def interval_value(
    text: RecordText, at: int, written: str, unit: str | None, given: float | None
) -> tuple[float | None, tuple[str, ...]]:
    """Return a time [s] as `time_value`; None and a warning where another is given."""
    words = None if given is None else f"{given:g} s"
    return unless_given(words, lambda: time_value(text, at, written, unit))


def _goes_on(rest: str) -> bool:
    """Return whether what follows a number, or its unit, belongs to it or is a second number."""
    thing = _ANOTHER_THING.match(rest)
    if thing is not None and in_seconds(thing["word"]) is None:
        return False
    return _GOES_ON.match(rest) is not None


def stated_interval(text: RecordText, lines: list[int]) -> float | None:
    """Return the interval between samples that lines of words state [s], or None.

    Raises
    ------
    RecordFileError
        If a statement is not understood, or an interval and a rate contradict each other.
    """
    intervals: list[tuple[float, float, int]] = []
    for at in lines:
        for name in ("interval", "rate"):
            for stated in find_values(_STATED[name], text.heads[at]):
                if _OTHER_RATE.search(text.heads[at][: stated.start()]):
                    continue
                unit = stated["unit"] or stated["tail"]
                written = stated["value"]
                after = re.sub(rf"^\s*{NUMBER}\s*\(?", "", written)
                if name == "rate" and not unit and leading(after, in_seconds)[0] is None:
                    unit = "Hz"
                value = time_value(text, at, written, unit)
                intervals.append((_relative_place(written), value, at))
        alone = _RATE_ALONE.fullmatch(text.heads[at])
        if at > 0 and re.search("filter|corner|cut", text.heads[at - 1], re.IGNORECASE):
            alone = None
        if alone is not None and (in_seconds(alone["unit"]) or 0.0) < 0.0:
            value = time_value(text, at, alone["value"])
            intervals.append((_relative_place(alone["value"]), value, at))
    intervals.sort()
    for place, value, at in intervals[1:]:
        if abs(value - intervals[0][1]) > 1.01 * (place + intervals[0][0] + 1e-9) * value:
            valid = f"its header states {intervals[0][1]:g} s and {value:g} s between samples"
            raise text.error(valid, CORRECT, at=at, kind=CONTRADICTION)
    return intervals[0][1] if intervals else None


def find_values(pattern: re.Pattern[str], line: str) -> Iterator[re.Match[str]]:
    """Yield what a pattern finds in a line, each from the beginning of the value before on."""
    at = 0
    while (match := pattern.search(line, at)) is not None:
        yield match
        at = match.start("value") + 1


def stated_time_unit(text: RecordText, lines: list[int]) -> float | None:
    """Return the size of the unit of times that lines of words state [s], or None.

    Raises
    ------
    RecordFileError
        If a statement is not understood as a whole, or two of them contradict each other.
    """
    units: dict[float, int] = {}
    hint = "name the column of times with its unit, as time (ms)"
    for at in lines:
        for stated in _TIME_IN.finditer(text.heads[at]):
            if _OTHER_TIME.search(text.heads[at][: stated.start()]):
                continue
            unit, rest = leading(stated["rest"], in_seconds)
            clock = stated["how"] in {":", "="} or stated["rest"][:1].isdigit()
            if unit is None and clock:
                continue
            size = None if unit is None else in_seconds(unit)
            if size is None or size <= 0.0 or modifies(rest) or _TWO.match(rest):
                raise text.error("its unit of time is not understood as a whole", hint, at=at)
            units.setdefault(size, at)
    if len(units) > 1:
        raise text.error("it states another unit of time", hint, at=max(units.values()))
    return next(iter(units), None)


def stated_duration(text: RecordText, lines: list[int]) -> tuple[float, float] | None:
    """Return the duration that lines of words state, and half a unit of its last digit [s]."""
    for at in lines:
        stated = _STATED["duration"].search(text.heads[at])
        if stated is None or _OTHER_DURATION.search(text.heads[at][: stated.start()]):
            continue
        try:
            value = time_value(text, at, stated["value"], stated["unit"])
        except RecordFileError:
            continue
        return value, value * _relative_place(stated["value"])
    return None


def stated_count(text: RecordText, lines: list[int]) -> tuple[int, int] | None:
    """Return the number of samples that lines of words state, and the index of the line.

    Raises
    ------
    RecordFileError
        If it is no whole number, or two lines state different ones.
    """
    counts: dict[int, int] = {}
    for at in lines:
        for stated in find_values(_COUNT, text.heads[at]):
            if _OTHER_COUNT.search(text.heads[at][: stated.start()]):
                continue
            counts.setdefault(count_value(text, at, stated["value"]), at)
        if (alone := _COUNT_ALONE.fullmatch(text.heads[at])) is not None:
            counts.setdefault(int(alone["value"] or alone["before"]), at)
    if len(counts) > 1:
        valid = f"its header states {' and '.join(map(str, counts))} samples"
        raise text.error(valid, CORRECT, at=max(counts.values()), kind=CONTRADICTION)
    return next(iter(counts.items()), None)


def count_value(text: RecordText, at: int, written: str) -> int:
    """Return the whole number that a text begins with; commas may separate its thousands.

    Raises
    ------
    RecordFileError
        If there is none, or what follows is a unit, more of the number or a second one.
    """
    match = _THOUSANDS.match(written) or re.match(NUMBER, written)
    value = None if match is None else number(match[0].replace(",", ""))
    rest = "" if match is None else written[match.end() :]
    of_time, _ = leading(rest.lstrip(" ("), in_seconds)
    if value is None or value != int(value) or of_time is not None or _GOES_ON.match(rest):
        raise text.error("it must state a whole number, once", "correct the line", at=at)
    return int(value)


def _first_number(written: str) -> tuple[str, str]:
    """Return the number that a text begins with, with a decimal point, and what follows."""
    decimal = _DECIMAL_COMMA.match(written)
    if decimal is not None and (len(decimal[2]) != 3 or decimal[1].strip("+-") == "0"):
        return f"{decimal[1]}.{decimal[2]}", written[decimal.end() :]
    match = re.match(NUMBER, written)
    return ("", written) if match is None else (match[0], written[match.end() :])


def _relative_place(written: str) -> float:
    """Return half a unit of the last digit of a number above 0 that a text begins with, over it."""
    digits, _ = _first_number(written.strip())
    return min(0.5 * last_place(digits) / (number(digits) or math.inf), _COARSEST)


def last_place(written: str) -> float:
    """Return one unit of the last digit of a number.

    Examples
    --------
    >>> last_place("1.25"), last_place("1.5e-3")
    (0.01, 0.0001)
    """
    mantissa, _, exponent = written.lower().replace("d", "e").partition("e")
    decimals = len(mantissa.partition(".")[2])
    power = int(exponent) if re.fullmatch(r"[+-]?\d{1,3}", exponent) else 0
    return float(f"1e{power - decimals}")
