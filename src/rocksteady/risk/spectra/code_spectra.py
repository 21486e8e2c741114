"""Design spectra by the formulas of codes, written as a text: EN 1998-1, ASCE 7 and NTC."""

import re
from collections.abc import Mapping
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.bounds import Bounds
from rocksteady.risk.spectra.elastic_spectrum import (
    SOIL_FACTORS,
    TOPOGRAPHY_FACTORS,
    ElasticSpectrum,
)

SPECTRUM_DAMPING: Final = 0.05
"""Damping of spectra by formula, and of those that motions are placed on."""
PERIODS_S: Final = np.concatenate([[0.0], np.geomspace(0.01, 10.0, 151)])
"""Periods of the tables of formulas, beside those of their corners [s]."""
GROUND: Final[Mapping[str, Mapping[str, tuple[float, float, float, float]]]] = {
    "type1": {
        "A": (1.0, 0.15, 0.4, 2.0),
        "B": (1.2, 0.15, 0.5, 2.0),
        "C": (1.15, 0.2, 0.6, 2.0),
        "D": (1.35, 0.2, 0.8, 2.0),
        "E": (1.4, 0.15, 0.5, 2.0),
    },
    "type2": {
        "A": (1.0, 0.05, 0.25, 1.2),
        "B": (1.35, 0.05, 0.25, 1.2),
        "C": (1.5, 0.1, 0.25, 1.2),
        "D": (1.8, 0.1, 0.3, 1.2),
        "E": (1.6, 0.05, 0.25, 1.2),
    },
}
"""S, T_B, T_C and T_D [s] of types and grounds (EN 1998-1:2004 Tables 3.2 and 3.3)."""
CORNERS: Final = ("s", "tb", "tc", "td")
PERIOD: Final = Bounds(0.0, 20.0, "(]", "give the period in seconds, as 0.5")
NUMBERS: Final[Mapping[str, Bounds]] = {
    "ag": Bounds(0.0, 3.0, "(]", "give a_g in g, as 0.25: divide m/s^2 by 9.81"),
    "s": Bounds(0.0, 5.0, "(]", "give the soil factor S, as 1.2"),
    "sds": Bounds(0.0, 5.0, "(]", "give S_DS in g, as 1.0"),
    "sd1": Bounds(0.0, 5.0, "(]", "give S_D1 in g, as 0.6"),
    "f0": Bounds(1.0, 10.0, "[]", "give F_0, as 2.5"),
    **dict.fromkeys(("tb", "tc", "td", "tl"), PERIOD),
}
"""Range of each number, and what to do about others."""


class CodeSpectrum(NamedTuple):
    """A spectrum by a formula at 5 % damping: rows of period [s] and Sa [g], and its source."""

    rows: Floats
    words: str


class _Form(NamedTuple):
    """How a formula is written: an example, its words in groups, and its numbers."""

    example: str
    choices: tuple[tuple[str, ...], ...]
    needed: tuple[str, ...]
    further: tuple[str, ...] = ()


FORMS: Final[Mapping[str, _Form]] = {
    "en1998-1": _Form(
        "en1998-1:2004:type1:A:ag=0.25",
        (("2004",), tuple(GROUND), tuple(GROUND["type1"])),
        ("ag",),
        CORNERS,
    ),
    "asce7-16": _Form("asce7-16:sds=1.0:sd1=0.6:tl=8", (), ("sds", "sd1", "tl")),
    "ntc2018": _Form(
        "ntc2018:A:T1:ag=0.2:f0=2.5:tc=0.35",
        (tuple(SOIL_FACTORS), tuple(TOPOGRAPHY_FACTORS)),
        ("ag", "f0", "tc"),
    ),
}


def formulas_words() -> str:
    """Return an example of each formula."""
    return " or ".join(form.example for form in FORMS.values())


def formula_of(text: str) -> CodeSpectrum | None:
    """Return the spectrum of a text that is a formula; None of another, as the name of a file.

    Parameters
    ----------
    text
        The code, its words and its numbers, separated by colons, as
        ``en1998-1:2004:type1:A:ag=0.25``.

    Raises
    ------
    InputError
        If a word or a number is missing, unknown or outside its range.

    Examples
    --------
    >>> formula_of("asce7-16:sds=1.0:sd1=0.6:tl=8").rows[0].tolist()
    [0.0, 0.4]
    >>> formula_of("design.csv") is None
    True
    """
    name, _, rest = text.partition(":")
    code = name.strip().lower()
    if code not in FORMS:
        return None
    form, words, numbers = FORMS[code], dict[int, str](), dict[str, float]()
    refusal = partial(InputError, "spectrum", text)
    for part in filter(None, re.split(r"[:,\s]+", rest.strip())):
        key, equals, value = part.lower().partition("=")
        if equals and key in (*form.needed, *form.further) and key not in numbers:
            numbers[key] = _number(text, key, value)
            continue
        place = next((n for n, each in enumerate(form.choices) if _word(part, each)), None)
        if equals or place is None or place in words:
            raise refusal(f"{part} is unknown or given twice", f"write {form.example}")
        words[place] = _word(part, form.choices[place])
    for place, choices in enumerate(form.choices):
        if place not in words:
            choice = "2004" if choices == ("2004",) else f"one of {', '.join(choices)}"
            raise refusal(f"it lacks {choice}", f"write {form.example}")
    for key in form.needed:
        if key not in numbers:
            raise refusal(f"it lacks {key}=", f"write {form.example}")
    return FORMULAS[code](text, [words[place] for place in sorted(words)], numbers)


def _word(part: str, choices: tuple[str, ...]) -> str:
    """Return the choice that a word is, in whatever case; empty of none."""
    return next((each for each in choices if each.lower() == part.lower()), "")


def _number(text: str, key: str, value: str) -> float:
    """Return the number of a key."""
    bounds = NUMBERS[key]
    try:
        return bounds("spectrum", float(value))
    except (InputError, ValueError) as error:
        valid = getattr(error, "valid", "it must be a number")
        raise InputError("spectrum", text, f"of {key}: {valid}", bounds.hint) from None


def _en1998(text: str, words: list[str], numbers: Mapping[str, float]) -> CodeSpectrum:
    """Return the elastic spectrum of EN 1998-1:2004, 3.2.2.2."""
    _, kind, ground = words
    table = dict(zip(CORNERS, GROUND[kind][ground], strict=True)) | dict(numbers)
    ag, s, tb, tc, td = (table[key] for key in ("ag", *CORNERS))
    t = _periods(text, tb, tc, td)
    top = 2.5 * ag * s
    rise = ag * s * (1.0 + 1.5 * t / tb)
    sa = _falling(np.where(t < tb, rise, top), t, tc, td)
    source = f"EN 1998-1:2004, 3.2.2.2, {kind[:4]} {kind[4]}, ground {ground}"
    return CodeSpectrum(np.column_stack([t, sa]), source)


def _asce7(text: str, words: list[str], numbers: Mapping[str, float]) -> CodeSpectrum:  # noqa: ARG001
    """Return the two-period spectrum of ASCE 7-16, 11.4.6."""
    sds, sd1, tl = (numbers[key] for key in ("sds", "sd1", "tl"))
    ts = sd1 / sds
    t = _periods(text, 0.2 * ts, ts, tl)
    sa = np.where(t < 0.2 * ts, sds * (0.4 + 3.0 * t / ts), sds)
    return CodeSpectrum(np.column_stack([t, _falling(sa, t, ts, tl)]), "ASCE 7-16, 11.4.6")


def _ntc(text: str, words: list[str], numbers: Mapping[str, float]) -> CodeSpectrum:
    """Return the elastic spectrum of NTC 2018, 3.2.3.2.1."""
    soil, topography = words
    options: Any = {"soil": soil, "topography": topography}
    try:
        made = ElasticSpectrum(
            ag_g=numbers["ag"], f0=numbers["f0"], tc_star_s=numbers["tc"], **options
        )
    except (InputError, ModelError) as error:
        raise InputError("spectrum", text, error.valid, error.hint) from None
    t = _periods(text, made.tc_s / 3.0, made.tc_s, made.td_s)
    sa = [made.sa_g(period, SPECTRUM_DAMPING) for period in t.tolist()]
    source = f"NTC 2018, 3.2.3.2.1, ground {soil}, {topography}"
    return CodeSpectrum(np.column_stack([t, sa]), source)


FORMULAS: Final = {"en1998-1": _en1998, "asce7-16": _asce7, "ntc2018": _ntc}


def _periods(text: str, *corners: float) -> Floats:
    """Return periods that hold the corners of a spectrum, which must rise."""
    if list(corners) != sorted(set(corners)):
        shown = ", ".join(f"{each:g}" for each in corners)
        valid = f"its corner periods must rise, and are {shown} s"
        raise InputError("spectrum", text, valid, "check the numbers")
    return np.unique(np.concatenate([PERIODS_S, corners]))


def _falling(values: Floats, t: Floats, tc: float, td: float) -> Floats:
    """Return values that fall with 1/T from a corner on, and with 1/T^2 from the next."""
    safe = np.maximum(t, tc)
    return np.asarray(values * tc / safe * np.minimum(1.0, td / safe))
