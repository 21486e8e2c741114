"""Quantity, unit and direction stated by the name of a table's column.

A name is understood as a whole: ``1000*acc (g)`` and ``acc (g x 10)`` state an acceleration whose
size is not certain, and ``SA (g)`` states none.
"""

import re
from dataclasses import dataclass
from typing import Final, Literal

from rocksteady.records.core.directions import direction, pointing, without_place
from rocksteady.records.core.numbers import number
from rocksteady.records.core.units import acceleration_unit, in_m_s2, in_seconds, quantity_of

_BRACKETS: Final = re.compile(r"[(\[]((?:[^()\[\]]|\([^()]*\))*)[)\]]")
_OF_UNITS: Final = re.compile(r"(?:units?\s*(?:of|in|[:=])*|in)\s+", re.IGNORECASE)
_GROUND: Final = re.compile(r"u_?g['.\"]*", re.IGNORECASE)
"""What the acceleration of the ground is called in theory, which is no millionth of g."""
_TIME: Final = re.compile(
    r"(?:(?:elapsed|relative|record(?:ing)?|sample|sampling)[\s_]+)?"
    r"(?:t|times?|timestamps?|date[ _]?time|utc|elapsed|zeit|temps|tempo|tiempo|zaman"
    r"|\u6642\u9593|\u65f6\u95f4)(?![A-Za-z])(?P<rest>.*)",
    re.IGNORECASE,
)
_OF_TIME: Final = re.compile(
    r"(?:(?:since|from|after|the|start|begin(?:ning)?|trigger|record(?:ing)?|first|sample|origin"
    r"|axis|vector|elapsed|values?|stamps?|base|code)\b[\s_]*)*",
    re.IGNORECASE,
)
"""Words behind time that leave it one."""
_ACCELERATION: Final = re.compile(
    r"(?<![a-z])a(?:cc|ccel\w*|cceler\w*|g|[xyz]|h|v)?(?![a-z])|acc", re.IGNORECASE
)
_OTHER: Final = re.compile(
    r"(?<![a-z])(?:vel\w*|disp\w*|speed|p?s[av]|sd|rsa|spa|rotd\w*|fft|fas|psd|jerk|abs|rms|log\w*|ln"
    r"|pg[avd]|err\w*|uncertain\w*|noise\w*|sigma|residuals?|misfit|diff\w*|coeff?\w*|tilt\w*"
    r"|rotation\w*|respon[sc]e|ratio|fraction|accuracy|var(?:iance)?|tolerance|threshold|weights?"
    r"|quality|phase|limit|bound|snr|strain|stress|force|drift|pressure|temp\w*|volt\w*"
    r"|std\w*|max\w*|min\w*|peak|mean|average|median|energy|sqrt|norm|srss|period)(?![a-z])"
    r"|spect|pseudo|fourier|envelope|husid|arias|cumul|integr|deriv|squared|intensity",
    re.IGNORECASE,
)
"""Words of quantities that are no acceleration against time."""

_QUANTITIES: Final = {"velocity", "displacement", "counts"}
OTHER: Final = "another quantity"
_NAMED: Final = {
    "velocity": re.compile(r"vel|speed|vitesse|geschwind", re.IGNORECASE),
    "displacement": re.compile(r"disp|drift|desplaz|d[ée]placem|spostam|verschieb", re.IGNORECASE),
    "spectra": re.compile(r"spect|fourier|fft|fas|p?s[avd]\b|pseudo", re.IGNORECASE),
}
_IN_SENTENCES: Final = re.compile(
    r"\b(?:velocit\w*|velocidad\w*(?! de m)|vitesse|geschwindigkeit|displacements?|d[ée]placement"
    r"|desplazamiento|spostamento|verschiebung)\b",
    re.IGNORECASE,
)

_PLOT: Final = re.compile(
    r"(?<=[)\]])\s*[-:,]?\s*(?:plot|graph|chart|trace|series|run|sheet)\s*\d+\s*$", re.IGNORECASE
)
"""What programs of laboratories write after the unit: where a column was drawn."""

_UNCERTAIN: Final = re.compile(
    r"[*^|²³⁻%=<>]|\d\s*[x×]|(?<![a-z])[x×]\s*\d|/\s*[\d(]|\d\s*/|10\s*-\s*\d|^\s*-|(?<![a-z])(?:"
    r"milli|micro|centi|kilo|nano|percent|thousand\w*|hundred\w*|per|times|multipl\w*|scal(?:e|ed|ing)"
    r"|factor|normali[sz]ed|divided|over|inverted|gain|counts?|lsb|volts?)(?![a-z])"
    r"|(?<![a-z])[mckuµμ][\s_-]*$",
    re.IGNORECASE,
)
"""Signs and words of a factor."""

_WORDS: Final = re.compile(
    r"a|acc|accn|linear|acce|accel|acceler|accelerogram|acceleration|accelerations"
    r"|accelerometer|beschleunigung\w*|accelerazione|acelera\w*|acc[ée]l[ée]ration|i|vme|\u52a0\u901f\u5ea6"
    r"|ag|üg|agx|agy|agz|ax|ay|az|ah|av|ug|ground|base|input|table|shaking"
    r"|free|field|surface|borehole|motion|time|history|histories|series|th|data"
    r"|value|values|sample|samples|signal|amplitude|amplitudes|record|recorded"
    r"|recording|measured|raw|filtered|unfiltered|corrected|uncorrected|processed"
    r"|horizontal|component|comp|channel|chan|ch|chn|sensor|station|sta|site|column"
    r"|col|number|no|nr|direction|dir|seismic|earthquake|eq|strong|units|unit|in"
    r"|of|the|at|is|positive|pos|deg|degrees|x|y|z|h|v|hor|horiz|transverse"
    r"|lateral|longitudinal|radial|axis|long|tran|trans|parallel|normal|fault"
    r"|bedrock|rock|outcrop|top|bottom|floor|roof"
)
"""Words that leave what they stand beside an acceleration of one size and sign."""
_PARTS: Final = re.compile(
    r"(?P<network>[A-Z0-9]{1,2}\.[A-Z0-9]{1,5}\.[A-Z0-9]{0,2}\.[A-Z]{2}[A-Z0-9](?!\w))"
    r"|(?P<theory>d\^?2\s*[uxyz]_?g?\s*/\s*dt\^?2|[uüxyz]_?g?(?:''|\"|\.\.|_?ddot))(?!\w)"
    r"|(?P<pair>(?<![A-Za-z])(?:n\s*/\s*s|e\s*[/-]\s*[wo]|u\s*/\s*d|k-g|d-b)(?![A-Za-z]))"
    r"|(?P<word>[^\W\d_]+)(?P<digits>\d*)(?P<end>[A-Za-z]?(?![^\W_]))"
    r"|(?P<number>\d+)(?![^\W_]|\.\d)|(?P<between>[\s_,:;.-]+)",
    re.IGNORECASE,
)
_NUMBERED: Final = re.compile(
    r"(?:a|acc|accel|acceleration|ch|chn|chan|channel|sensor|s|sta|station|col|column|comp|component"
    r"|h|hn|v|l|t|n|floor|level|data)",
    re.IGNORECASE,
)
_CODE: Final = re.compile(r"[A-Z]{2,5}")
_FACTOR_WORD: Final = re.compile(
    r"by|div|mul\w*|times?|gain|rev\w*|inv\w*|neg\w*|minus|scal\w*|fac\w*|exp|pow\w*|half|ten",
    re.IGNORECASE,
)
_TOWARDS: Final = re.compile(r"acc(?:el(?:eration)?)?(?:[xyzhvneu]|ns|ew|ud)")
_SIGNED: Final = re.compile(
    r"(?:^|[\s_(,])-\s*\w(?<!\s\d)(?<!-\s\w)|\w-(?:$|[)\]])"
    r"|(?<![^\W_])e\s*[-+]?\s*\d|\d\s*:|\d-\d",
    re.IGNORECASE,
)
"""A sign, a power of ten or a ratio."""

_NO_UNIT: Final = frozenset({"", "-", "--", "n/a", "none"})


@dataclass(frozen=True, kw_only=True)
class ColumnName:
    """What the name of a column states.

    Parameters
    ----------
    kind
        Its quantity; unknown where the name has none.
    label
        The name without its unit.
    unit
        Its unit of acceleration, where it states one.
    seconds
        Size of its unit of time, where it states one [s].
    uncertain
        What is not understood in it; nothing where all is.
    leftover
        Its first word or sign that is not known, of which the meaning may be any.
    quantity
        Velocity, displacement, spectra, counts or another quantity that it names.
    """

    kind: Literal["time", "acceleration", "other", "unknown"]
    label: str
    unit: str | None = None
    seconds: float | None = None
    uncertain: str = ""
    leftover: str = ""
    quantity: str = ""


def column_name(name: str) -> ColumnName:
    """Return what the name of a column states.

    Examples
    --------
    >>> [column_name(name).unit for name in ("acc (milli g)", "accel_cm/s2", "a_m_s2", "t (ms)")]
    ['mg', 'cm/s^2', 'm/s^2', None]
    >>> column_name("time (min)").seconds, column_name("1000*acc (g)").uncertain
    (60.0, '1000*acc')
    """
    name = _PLOT.sub("", name).replace("(+)", "")
    brackets = [_OF_UNITS.sub("", text.strip()) for text in _BRACKETS.findall(name)]
    if len(brackets) == 1 and not _BRACKETS.sub("", name).strip():
        name, brackets = brackets[0], []
    label = " ".join(_BRACKETS.sub(" ", name).split()).strip(" _,:;/")
    timed = _TIME.fullmatch(label)
    alone = in_seconds(label) if label and not brackets else None
    if alone is not None and 0.0 < alone <= 1.0:
        return ColumnName(kind="time", label=label, seconds=alone)
    if timed is not None:
        return _time(label, timed["rest"], brackets)
    if label.lower() in {"s", "sec", "secs", "second", "seconds"}:
        return _time(label, label, brackets)
    last = label.replace("_", " ").split()[-1:]
    measured = {quantity_of(written) for written in brackets}
    measured |= {quantity_of(word) for word in last if "/" in word or "count" in word.lower()}
    measured &= _QUANTITIES
    if any((in_seconds(written) or 0.0) < 0.0 for written in brackets):
        measured = {"spectra"}  # against frequencies
    if measured or _OTHER.search(name):
        quantity = measured.pop() if len(measured) == 1 else quantity_named(name) or OTHER
        return ColumnName(
            kind="other", label=label, unit=_of_brackets(brackets), quantity=quantity or OTHER
        )
    if brackets:
        return _acceleration(label, brackets)
    unit, shorter = _tail(label)
    known = unit is not None or _ACCELERATION.search(shorter) or direction(shorter)[0] is not None
    return ColumnName(
        kind="acceleration" if known else "unknown",
        label=shorter,
        unit=unit,
        uncertain=shorter if known and _uncertain(shorter) else "",
        leftover=_leftover(shorter),
    )


def _uncertain(label: str) -> bool:
    """Return whether a name may hold a factor; the letter of a direction alone is none."""
    label = without_place(label)[0]
    return _UNCERTAIN.search(label) is not None and label.upper() != "U"


def quantity_named(words: str) -> str | None:
    """Return the quantity other than acceleration that words name, or None."""
    return next((quantity for quantity, named in _NAMED.items() if named.search(words)), None)


def quantity_in(sentence: str) -> str | None:
    """Return the velocity or displacement that a sentence names in whole words, or None."""
    word = _IN_SENTENCES.search(sentence)
    return None if word is None else quantity_named(word[0])


def _time(label: str, rest: str, brackets: list[str]) -> ColumnName:
    """Return what the name of a column of times states."""
    rest = re.sub(r"^(?:in|of)\s+", "", rest.strip(" _/,:;-"), flags=re.IGNORECASE)
    sizes = {in_seconds(written) for written in brackets if written}
    uncertain = ""
    if rest:
        of_rest = in_seconds(rest.replace("_", " "))
        if of_rest is not None:
            sizes.add(of_rest)
        elif _OF_TIME.fullmatch(rest.replace("_", " ")) is None:
            uncertain = rest
    if len(sizes) > 1 or any(size is None or size <= 0.0 for size in sizes):
        uncertain = ", ".join(brackets) or rest
        sizes = set()
    seconds = next((size for size in sizes if size is not None), None)
    return ColumnName(kind="time", label=label, seconds=seconds, uncertain=uncertain)


def _of_brackets(brackets: list[str]) -> str | None:
    """Return the unit of acceleration in brackets, for a quantity that is chosen by hand."""
    units = [unit for written in brackets if (unit := acceleration_unit(written)) is not None]
    return units[0] if len(units) == 1 else None


def _acceleration(label: str, brackets: list[str]) -> ColumnName:
    """Return what a name with something in brackets states."""
    of_label, shorter = (None, label) if direction(label)[0] else _tail(label)
    units = [unit for written in brackets if (unit := acceleration_unit(written)) is not None]
    rest = [written for written in brackets if acceleration_unit(written) is None]
    directions = [written for written in rest if pointing(written).orientation is not None]
    rest = [word for word in rest if word not in directions and word.lower() not in _NO_UNIT]
    if of_label is not None:
        label = shorter
        units.append(of_label)
    known = bool(units) or _ACCELERATION.search(label) or direction(label)[0] is not None
    uncertain = label if _uncertain(label) else ""
    for written in rest:
        if not units or _UNCERTAIN.search(written) or re.match(r"[\dx×]", written):
            uncertain = written
    if "-" in brackets and direction(label)[0] is not None:
        uncertain = f"{label}(-)"
    if len({in_m_s2(unit) for unit in units}) > 1:
        uncertain = ", ".join(units)
    return ColumnName(
        kind="acceleration" if known or directions else "unknown",
        label=" ".join([label, *(f"({word})" for word in directions)]).strip(),
        unit=units[0] if units else None,
        uncertain=uncertain,
        leftover=next((odd for part in (label, *rest) if (odd := _leftover(part))), ""),
    )


def _leftover(label: str) -> str:
    """Return the first part of a name without its unit that is not known, or nothing."""
    label = without_place(label.strip())[0]
    if _SIGNED.search(label):
        return label
    if pointing(label).orientation is not None and not re.search(r"(?<!\w)100?(?!\w)", label):
        return ""
    at = 0
    while at < len(label):
        match = _PARTS.match(label, at)
        if match is None or not _known(match):
            return label[at:].split()[0]
        at = match.end()
    return ""


def _known(match: re.Match[str]) -> bool:
    """Return whether a part of a name leaves the acceleration its size and its sign."""
    if match["number"] is not None:
        # 10 and 100 are factors as well as azimuths.
        return match[0] not in {"10", "100"} and len(match[0]) in {1, 3} and int(match[0]) <= 360
    if match["word"] is None:
        return True
    word, digits = match["word"], match["digits"]
    if pointing(match[0]).orientation is not None:
        return True
    if not digits:
        whole = match[0].lower()
        return _WORDS.fullmatch(whole) is not None or _TOWARDS.fullmatch(whole) is not None
    numbered = _NUMBERED.fullmatch(word) is not None and len(digits) <= 2
    code = _CODE.fullmatch(word) is not None and _FACTOR_WORD.fullmatch(word) is None
    return numbered or code


def _tail(label: str) -> tuple[str | None, str]:
    """Return the unit of acceleration that a name ends with, and the name without it."""
    if _GROUND.fullmatch(label):
        return None, label
    starts = [0, *(match.end() for match in re.finditer(r"[\s_,:/-]+", label))]
    for start in starts:
        written = label[start:]
        spellings = dict.fromkeys((written, written.replace("_", " "), written.replace("_", "/")))
        unit = next((unit for spelling in spellings if (unit := acceleration_unit(spelling))), None)
        if unit is None:
            continue
        before = label[:start].rstrip(" _,:/-")
        last = re.split(r"[\s_]+", before)[-1]
        ten = re.match(r"10\s*[\^*]|1[.0]*e|0?\.0*1", written, re.IGNORECASE)
        # After a number it is the unit of that number: "acceleration in m/s^2, peak 0.3 g".
        if number(last) is not None or (re.match(r"[\d.]", written) and not ten):
            return None, label
        return unit, re.sub(r"\s+in$", "", before)
    return None, label
