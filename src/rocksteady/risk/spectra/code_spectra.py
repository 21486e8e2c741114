"""Design spectra by the formulas of codes, written as a text: EN 1998-1, ASCE 7 and NTC."""

import re
from collections.abc import Callable, Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.bounds import Bounds
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum

SPECTRUM_DAMPING: Final = 0.05
"""Damping ratio of code spectra and of the spectra that records are placed on."""
PERIODS_S: Final = np.concatenate([[0.0], np.geomspace(0.01, 10.0, 151)])
"""Periods of a code spectrum [s]; its corner periods are added."""
GROUND: Final[Mapping[str, tuple[float, float, float, float]]] = {
    "1A": (1.0, 0.15, 0.4, 2.0),
    "1B": (1.2, 0.15, 0.5, 2.0),
    "1C": (1.15, 0.2, 0.6, 2.0),
    "1D": (1.35, 0.2, 0.8, 2.0),
    "1E": (1.4, 0.15, 0.5, 2.0),
    "2A": (1.0, 0.05, 0.25, 1.2),
    "2B": (1.35, 0.05, 0.25, 1.2),
    "2C": (1.5, 0.1, 0.25, 1.2),
    "2D": (1.8, 0.1, 0.3, 1.2),
    "2E": (1.6, 0.05, 0.25, 1.2),
}
"""S, T_B, T_C and T_D [s] of types and grounds (EN 1998-1:2004 Tables 3.2 and 3.3)."""
NUMBERS: Final[Mapping[str, Bounds]] = {
    "ag": Bounds(0.0, 3.0, "(]", "give a_g in g, as 0.25: divide m/s^2 by 9.81"),
    "sds": Bounds(0.0, 5.0, "(]", "give S_DS in g, as 1.0"),
    "sd1": Bounds(0.0, 5.0, "(]", "give S_D1 in g, as 0.6"),
    "tl": Bounds(0.0, 20.0, "(]", "give the period in seconds, as 8"),
}
"""Range of each number, and what to do about others; that of NTC is of its class."""
FORMS: Final[Mapping[str, tuple[str, str]]] = {
    "en1998-1": (
        "en1998-1:2004:type1:C:ag=0.25",
        r"2004:type(?P<kind>[12]):(?P<ground>[A-E]):ag=(?P<ag>[^:]+)",
    ),
    "asce7-16": (
        "asce7-16:sds=1.0:sd1=0.6:tl=8",
        r"sds=(?P<sds>[^:]+):sd1=(?P<sd1>[^:]+):tl=(?P<tl>[^:]+)",
    ),
    "ntc2018": (
        "ntc2018:C:T1:ag=0.2:f0=2.5:tc=0.35",
        r"(?P<soil>[A-E]):(?P<topography>T[1-4]):ag=(?P<ag>[^:]+):f0=(?P<f0>[^:]+):tc=(?P<tc>[^:]+)",
    ),
}
"""An example of each code's text, and the form of what comes after its name."""


class CodeSpectrum(NamedTuple):
    """A spectrum by a formula at 5 % damping: rows of period [s] and Sa [g], and its source."""

    rows: Floats
    words: str

    @property
    def remark(self) -> str:
        """What it leaves to the engineer, as a sentence."""
        return f"The spectrum is that of {self.words}, not checked against the printed standard."


def formulas_words() -> str:
    """Return an example of each formula."""
    return " or ".join(example for example, _ in FORMS.values())


def formula_of(text: str) -> CodeSpectrum | None:
    """Return the spectrum of a text that is a formula; None of another, as the name of a file.

    Parameters
    ----------
    text
        The code, its words and its numbers, separated by colons, as
        ``en1998-1:2004:type1:C:ag=0.25``.

    Raises
    ------
    InputError
        If it has another form, or a number is outside its range.

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
    example, form = FORMS[code]
    match = re.fullmatch(form, rest.strip(), re.IGNORECASE)
    if match is None:
        raise InputError("spectrum", text, f"it has another form than {example}", "write it so")
    given: dict[str, Any] = {}
    for key, value in match.groupdict().items():
        given[key] = value.upper()
        if key not in ("kind", "ground", "soil", "topography"):
            given[key] = _number(text, key, value)
    try:
        spectrum = MAKERS[code](**given)
    except (InputError, ModelError) as error:
        raise InputError("spectrum", text, f"of {error.name}: {error.valid}", error.hint) from None
    return spectrum._replace(words=f"{spectrum.words} ({rest.strip().removeprefix('2004:')})")


def _number(text: str, key: str, value: str) -> float:
    """Return the number of a key."""
    try:
        number = float(value)
        return NUMBERS[key](key, number) if key in NUMBERS else number
    except (InputError, ValueError) as error:
        valid = f"of {key}: {getattr(error, 'valid', 'it must be a number')}"
        hint = getattr(error, "hint", "write points, as 0.25")
        raise InputError("spectrum", text, valid, hint) from None


def _en1998(kind: str, ground: str, ag: float) -> CodeSpectrum:
    """Return the elastic spectrum of EN 1998-1:2004, 3.2.2.2."""
    s, tb, tc, td = GROUND[kind + ground]
    return _spectrum("EN 1998-1:2004, 3.2.2.2", ag * s, 2.5 * ag * s, (tb, tc, td))


def _asce7(sds: float, sd1: float, tl: float) -> CodeSpectrum:
    """Return the two-period spectrum of ASCE 7-16, 11.4.6."""
    ts = sd1 / sds
    return _spectrum("ASCE 7-16, 11.4.6", 0.4 * sds, sds, (0.2 * ts, ts, tl))


def _ntc(soil: Any, topography: Any, ag: float, f0: float, tc: float) -> CodeSpectrum:
    """Return the elastic spectrum of NTC 2018, 3.2.3.2.1."""
    made = ElasticSpectrum(ag_g=ag, f0=f0, tc_star_s=tc, soil=soil, topography=topography)
    corners = made.tc_s / 3.0, made.tc_s, made.td_s
    return _spectrum("NTC 2018, 3.2.3.2.1", made.peak_g, f0 * made.peak_g, corners)


MAKERS: Final[Mapping[str, Callable[..., CodeSpectrum]]] = {
    "en1998-1": _en1998,
    "asce7-16": _asce7,
    "ntc2018": _ntc,
}
"""What makes the spectrum of each code."""


def _spectrum(
    clause: str, peak: float, plateau: float, corners: tuple[float, float, float]
) -> CodeSpectrum:
    """Return a spectrum that rises to a plateau, and falls with 1/T and then with 1/T^2."""
    tb, tc, td = corners
    if not tb < tc < td:
        valid = f"its corner periods must rise, and are {tb:.3g}, {tc:.3g} and {td:.3g} s"
        raise InputError("the numbers", corners, valid, "check them")
    t = np.unique(np.concatenate([PERIODS_S, corners]))
    rise = peak + (plateau - peak) * np.minimum(t / tb, 1.0)
    later = np.maximum(t, tc)
    return CodeSpectrum(
        np.column_stack([t, rise * tc / later * np.minimum(1.0, td / later)]), clause
    )
