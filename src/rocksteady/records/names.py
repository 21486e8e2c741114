"""What the name of a table's column states: which quantity, in which unit, which way.

A name is understood as a whole: ``1000*acc (g)`` and ``acc (g x 10)`` state an acceleration whose
size is not certain, and ``SA (g)`` states none.
"""

import re
from dataclasses import dataclass
from typing import Final, Literal

from rocksteady.records.directions import direction, pointing
from rocksteady.records.numbers import number
from rocksteady.records.units import acceleration_unit, in_m_s2, in_seconds

__all__ = ["ColumnName", "column_name"]

_BRACKETS: Final = re.compile(r"[(\[]((?:[^()\[\]]|\([^()]*\))*)[)\]]")
_OF_UNITS: Final = re.compile(r"(?:units?\s*(?:of|in|[:=])*|in)\s+", re.IGNORECASE)
_GROUND: Final = re.compile(r"u_?g['.\"]*", re.IGNORECASE)
"""What the acceleration of the ground is called in theory, which is no millionth of g."""
_TIME: Final = re.compile(
    r"(?:t|time|times|zeit|temps|tempo|tiempo)(?![A-Za-z])(?P<rest>.*)", re.IGNORECASE
)
_ACCELERATION: Final = re.compile(
    r"(?<![a-z])a(?:cc|ccel\w*|cceler\w*|g|[xyz]|h|v)?(?![a-z])|acc", re.IGNORECASE
)
_OTHER: Final = re.compile(
    r"(?<![a-z])(?:vel\w*|disp\w*|speed|p?s[av]|sd|rsa|spa|rotd\w*|fft|fas|psd|jerk|abs|rms|log\w*|ln"
    r"|std\w*|max\w*|min\w*|peak|mean|average|median|energy|sqrt|norm|srss|period)(?![a-z])"
    r"|spect|pseudo|fourier|envelope|husid|arias|cumul|integr|deriv|squared|intensity",
    re.IGNORECASE,
)
"""Words of quantities that are no acceleration against time."""

_UNCERTAIN: Final = re.compile(
    r"[*^|²³⁻%=<>]|\d\s*[x×]|(?<![a-z])[x×]\s*\d|/\s*[\d(]|\d\s*/|10\s*-\s*\d|^\s*-|(?<![a-z])(?:"
    r"milli|micro|centi|kilo|nano|percent|thousand\w*|hundred\w*|per|times|multipl\w*|scal(?:e|ed|ing)"
    r"|factor|normali[sz]ed|divided|over|inverted|gain|counts?|lsb|volts?)(?![a-z])"
    r"|(?<![a-z])[mckuµμ][\s_-]*$",
    re.IGNORECASE,
)
"""Signs and words of a factor."""

_NO_UNIT: Final = frozenset({"", "-", "--", "n/a", "none"})


@dataclass(frozen=True, kw_only=True)
class ColumnName:
    """What the name of a column states.

    Parameters
    ----------
    kind
        Its quantity; unknown where the name tells none.
    label
        The name without its unit.
    unit
        Its unit of acceleration, where it states one.
    seconds
        Size of its unit of time [s].
    uncertain
        What is not understood in it; nothing where all is.
    """

    kind: Literal["time", "acceleration", "other", "unknown"]
    label: str
    unit: str | None = None
    seconds: float = 1.0
    uncertain: str = ""


def column_name(name: str) -> ColumnName:
    """Return what the name of a column states.

    Examples
    --------
    >>> [column_name(name).unit for name in ("acc (milli g)", "accel_cm/s2", "a_m_s2", "t (ms)")]
    ['mg', 'cm/s^2', 'm/s^2', None]
    >>> column_name("time (min)").seconds, column_name("1000*acc (g)").uncertain
    (60.0, '1000*acc')
    """
    brackets = [_OF_UNITS.sub("", found.strip()) for found in _BRACKETS.findall(name)]
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
        return _time(label, "", brackets)
    if _OTHER.search(name):
        return ColumnName(kind="other", label=label, unit=_of_brackets(brackets))
    if brackets:
        return _acceleration(label, brackets)
    unit, shorter = _tail(label)
    known = unit is not None or _ACCELERATION.search(shorter) or direction(shorter)[0] is not None
    return ColumnName(
        kind="acceleration" if known else "unknown",
        label=shorter,
        unit=unit,
        uncertain=shorter if _UNCERTAIN.search(shorter) and known else "",
    )


def _time(label: str, rest: str, brackets: list[str]) -> ColumnName:
    """Return what the name of a column of times states."""
    rest = re.sub(r"^(?:in|of)\s+", "", rest.strip(" _/,:;-"), flags=re.IGNORECASE)
    sizes = {in_seconds(written) for written in brackets if written not in _NO_UNIT}
    uncertain = ""
    if rest:
        of_rest = in_seconds(rest.replace("_", " "))
        if of_rest is not None:
            sizes.add(of_rest)
        elif re.search(r"[\d%^*]", rest) or any(in_seconds(word) for word in rest.split()):
            uncertain = rest
    if None in sizes or len(sizes) > 1 or min((size or 0.0 for size in sizes), default=1.0) <= 0.0:
        uncertain = ", ".join(brackets) or rest
        sizes = set()
    seconds = next((size for size in sizes if size is not None), 1.0)
    return ColumnName(kind="time", label=label, seconds=seconds, uncertain=uncertain)


def _of_brackets(brackets: list[str]) -> str | None:
    """Return the unit of acceleration in brackets, for a quantity that is chosen by hand."""
    units = [unit for written in brackets if (unit := acceleration_unit(written)) is not None]
    return units[0] if len(units) == 1 else None


def _acceleration(label: str, brackets: list[str]) -> ColumnName:
    """Return what a name with something in brackets states."""
    of_label, shorter = _tail(label)
    units = [unit for written in brackets if (unit := acceleration_unit(written)) is not None]
    rest = [written for written in brackets if acceleration_unit(written) is None]
    directions = [written for written in rest if pointing(written).orientation is not None]
    rest = [one for one in rest if one not in directions and one.lower() not in _NO_UNIT]
    if of_label is not None:
        label = shorter
        units.append(of_label)
    known = bool(units) or _ACCELERATION.search(label) or direction(label)[0] is not None
    uncertain = label if _UNCERTAIN.search(label) else ""
    for written in rest:
        if not units or _UNCERTAIN.search(written) or re.match(r"[\dx×]", written):
            uncertain = written
    if len({in_m_s2(unit) for unit in units}) > 1:
        uncertain = ", ".join(units)
    return ColumnName(
        kind="acceleration" if known or directions else "unknown",
        label=" ".join([label, *(f"({one})" for one in directions)]).strip(),
        unit=units[0] if units else None,
        uncertain=uncertain,
    )


def _tail(label: str) -> tuple[str | None, str]:
    """Return the unit of acceleration that a name ends with, and the name without it."""
    if _GROUND.fullmatch(label):
        return None, label
    starts = [0, *(found.end() for found in re.finditer(r"[\s_,:/-]+", label))]
    for start in starts:
        written = label[start:]
        spellings = dict.fromkeys((written, written.replace("_", " "), written.replace("_", "/")))
        unit = next((unit for one in spellings if (unit := acceleration_unit(one))), None)
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
