"""Demand spectra: tables at one or several dampings, or exact ones of a record, as power laws."""

import functools
import math
import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arrays import UnfitError, guard_result, numeric_array
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import plural
from rocksteady.risk.spectra.code_spectra import (
    SPECTRUM_DAMPING,
    CodeSpectrum,
    formula_of,
    formulas_words,
)
from rocksteady.risk.spectra.elastic_spectrum import damping_factor
from rocksteady.seismic.measures.response_spectrum import (
    LONGEST_S,
    SHORTEST,
    ResponseSpectrum,
    compute_response_spectrum,
)
from rocksteady.small_files import content_of, text_of

RIGID_S = 0.01
"""Period [s] up to which a spectrum has the value of its row at zero."""
FIRST_S = 0.03
"""Period of a first row [s] up to which its value is taken for the peak acceleration."""
RECORD_PERIODS = 200
"""Periods at which the spectrum of a record is computed."""
SHORTEST_S = 1e-6
"""Shortest period above 0 of a table [s]."""
LEAST_G, MOST_G = 1e-12, 1e12
"""Spectral accelerations of a table [g]."""
MOST_DESIGN_G = 10.0
"""Spectral acceleration [g] above which a spectrum is taken for one in m/s^2 or in per cent."""
IN_G = "give values in g: divide m/s^2 by 9.81 and per cent by 100"
MOST_BYTES = 10_000_000
"""Of a file with a spectrum."""
SHAPE_HINT = "give rows of period [s] and Sa [g], one column of Sa for each damping"


@dataclass(frozen=True)
class Chain:
    """Spectral acceleration [m/s^2] over the period, a power law between neighbouring points.

    Below the first point it is constant, beyond the last it is not known.
    """

    periods_s: tuple[float, ...]
    values_m_s2: tuple[float, ...]

    @property
    def last_s(self) -> float:
        """The longest period [s]."""
        return self.periods_s[-1]

    def at(self, period_s: float) -> float:
        """Return the value at a period [s], of the last point beyond it."""
        i = bisect_right(self.periods_s, period_s)
        if i == 0 or i == len(self.periods_s):
            return self.values_m_s2[0 if i == 0 else -1]
        start, power = self.periods_s[i - 1], self._power(i)
        return self.values_m_s2[i - 1] * math.pow(period_s / start, power)

    def pieces(self) -> Iterator[tuple[float, float]]:
        """Yield end [s] and power of each power law, the constant one first."""
        yield self.periods_s[0], 0.0
        for i in range(1, len(self.periods_s)):
            yield self.periods_s[i], self._power(i)

    def _power(self, i: int) -> float:
        value = math.log(self.values_m_s2[i] / self.values_m_s2[i - 1])
        return value / math.log(self.periods_s[i] / self.periods_s[i - 1])


@dataclass(frozen=True)
class RecordSpectrum:
    """Pseudo-acceleration of a record, computed at the damping itself."""

    record: Record

    def at_damping(self, damping: float, longest_s: float) -> tuple[Chain, str]:
        """Return the spectrum of the record up to a period."""
        shortest = max(RIGID_S, SHORTEST * self.record.dt_s)
        longest = max(min(longest_s, LONGEST_S), 2.0 * shortest)
        periods = np.geomspace(shortest, longest, RECORD_PERIODS)
        spectrum = compute_response_spectrum(self.record, periods, damping=damping)
        values = spectrum.pseudo_acceleration_m_s2
        how = f"spectrum of the record at {100.0 * damping:.3g} % damping"
        return Chain(tuple(periods.tolist()), tuple(values.tolist())), how


@guard_result
@dataclass(frozen=True)
class TabulatedSpectrum:
    """A table: periods [s], dampings and Sa [g] of shape (periods, dampings), both ascending.

    `source` is the file or the formula that it comes from; empty of none.
    """

    periods_s: Floats
    dampings: tuple[float, ...]
    values_g: Floats
    source: str = ""

    @property
    def peak_g(self) -> float | None:
        """Value of a row at period 0, or up to `FIRST_S`, at 5 % damping [g]; None without one."""
        values, _ = self.scaled(SPECTRUM_DAMPING)
        return float(values[0]) if self.periods_s[0] <= FIRST_S else None

    def at_damping(self, damping: float, longest_s: float) -> tuple[Chain, str]:  # noqa: ARG002
        """Return the table at a damping.

        Between two dampings ln Sa is interpolated over ln(damping).  Outside all of them the
        nearest is scaled by ``eta = sqrt(10/(5 + xi)) >= 0.55``, xi in per cent (EN 1998-1 eq.
        3.6), except in the row at period 0, which no damping changes.
        """
        values, how = self.scaled(damping)
        periods = self.periods_s.copy()
        if periods[0] == 0.0:
            periods[0] = RIGID_S if periods[1] > RIGID_S else 0.5 * periods[1]
        metres = STANDARD_GRAVITY * values
        return Chain(tuple(periods.tolist()), tuple(metres.tolist())), how

    def scaled(self, damping: float) -> tuple[Floats, str]:
        """Return the values of `at_damping` at the periods of the table [g], and how."""
        given = self.dampings
        percent = f"{100.0 * damping:.3g} %"
        for i, value in enumerate(given):
            if math.isclose(value, damping, rel_tol=1e-9):
                return self.values_g[:, i], f"spectrum as given at {percent} damping"
        i = bisect_right(given, damping)
        if 0 < i < len(given):
            low, high = given[i - 1], given[i]
            part = math.log(damping / low) / math.log(high / low)
            logs = np.log(self.values_g)
            logs = (1.0 - part) * logs[:, i - 1] + part * logs[:, i]
            ends = f"{100.0 * low:.3g} and {100.0 * high:.3g} %"
            return np.exp(logs), f"spectrum interpolated from {ends} to {percent} damping"
        nearest = 0 if i == 0 else len(given) - 1
        factor = damping_factor(damping) / damping_factor(given[nearest])
        values = self.values_g[:, nearest] * np.where(self.periods_s == 0.0, 1.0, factor)
        start, by = f"{100.0 * given[nearest]:.3g} %", f"{factor:.3g}"
        words = f"scaled from {start} to {percent} damping by {by}, eta of EN 1998-1 eq. 3.6"
        if by == "1":  # near a given damping, or where eta is at its least
            words = f"as given at {start}" + f", for {percent}" * (start != percent) + " damping"
        return values, f"spectrum {words}"


def tabulated(table: object, damping: Any, *, shown: object = None) -> TabulatedSpectrum | None:
    """Return a validated table; None where its damping is not known.

    Parameters
    ----------
    table
        Shape (periods, 1 + dampings): period [s], then Sa [g] at each damping.
    damping
        A number, or one for each column of Sa; None where it is not known.
    shown
        What an error names, as the file of the table; the table by default.

    Raises
    ------
    InputError
        If it is no such table.
    """
    shown = table if shown is None else shown
    try:
        rows = np.array(numeric_array("spectrum", table, "iuf"), dtype=np.float64)
    except UnfitError as unfit:
        raise InputError("spectrum", shown, *unfit.args) from None
    valid = ""
    if rows.ndim != 2 or rows.shape[0] < 2 or rows.shape[1] < 2:
        valid = "it must have two rows or more and two columns or more"
    elif not np.isfinite(rows).all():
        valid = "its numbers must be finite"
    elif rows[0, 0] < 0.0:
        valid = f"its periods must ascend from 0 or above, and the first is {rows[0, 0]:g} s"
    elif (steps := np.diff(rows[:, 0]) <= 0.0).any():
        low, high = rows[int(np.argmax(steps)) :, 0][:2]
        valid = f"its periods must ascend, and after {low:g} s follows {high:g} s"
    elif rows[1, 0] < SHORTEST_S or 0.0 < rows[0, 0] < SHORTEST_S or rows[-1, 0] > LONGEST_S:
        valid = f"its periods above 0 must lie in [{SHORTEST_S:g}, {LONGEST_S:g}] s"
    elif rows[:, 1:].min() < LEAST_G or rows[:, 1:].max() > MOST_G:
        valid = f"its spectral accelerations must lie in [{LEAST_G:g}, {MOST_G:g}] g"
    if valid:
        raise InputError("spectrum", shown, valid, SHAPE_HINT)
    if damping is None:
        return None
    columns = rows.shape[1] - 1
    several = isinstance(damping, Sequence) and not isinstance(damping, str)
    dampings = list(damping) if several else [damping]
    if len(dampings) != columns:
        raise InputError(
            "spectrum_damping",
            damping,
            f"the spectrum has {columns} column{'s' * (columns > 1)} of Sa",
            "give one for each, as 0.05, or 0.02, 0.05 for two",
        )
    hint = "give 0.05 for 5 % of critical"
    values = [in_range("spectrum_damping", each, 0.0, 1.0, "()", hint=hint) for each in dampings]
    if len(set(values)) < len(values):
        raise InputError("spectrum_damping", damping, "they must differ", "give each damping once")
    order = np.argsort(values)
    return TabulatedSpectrum(rows[:, 0], tuple(sorted(values)), rows[:, 1:][:, order])


def spectrum_from(source: Path | str, damping: Any = None) -> TabulatedSpectrum:
    """Return the table of a file or of a formula, whose damping must be known.

    Raises
    ------
    InputError
        As for `read_table` and `tabulated`, and if no damping is stated.
    """
    rows, stated = read_table(Path(source), damping)
    table = tabulated(rows, stated, shown=source)
    if table is None:
        hint = "write # damping 0.05 into it"
        raise InputError("spectrum", source, "it states no damping", hint)
    return replace(table, source=str(source))


def spectrum_of(spectrum: object, damping: object) -> RecordSpectrum | TabulatedSpectrum | None:
    """Return a demand's spectrum for any damping; None without one or without its damping."""
    if isinstance(spectrum, ResponseSpectrum | Record):
        return RecordSpectrum(spectrum if isinstance(spectrum, Record) else spectrum.record)
    return None if spectrum is None else tabulated(spectrum, damping)


_NUMBER = r"(?:\d+\.?\d*|\.\d+)"
_WORD = r"(?<![a-z])(?:damping|damped|smorzamento|zeta|xi(?=\s*=)|ζ|ξ)(?![a-z])"
_KIND = r"[\s_]|\b(?:of|critical|viscous|viscoso|del|ratio)\b"
_ONE = rf"(?>{_NUMBER}(?:\s*%)?)(?!\.?[a-z\d]|\s*(?:g|s|m|cm|hz|in|years?)\b)"
_NEXT = rf"(?:\s*[,;/]\s*|\s+and\s+|\s+){_ONE}(?!\s*(?!of\b|and\b|critical)[a-z])"
STATEMENTS = (
    rf"{_WORD}(?:[=:()\[\]%]|{_KIND})*{_ONE}(?:{_NEXT})*",
    rf"(?<![a-z\d.])(?:{_NUMBER}\s*%|0?\.\d+)-?(?:{_KIND})*{_WORD}",
)
"""A comment's dampings with numbers beside the word: ``damping 2 %, 5 %``, or ``5 %-damped``."""
PERIODS_HINT = "give periods in seconds, ascending: T = 1/f"
QUANTITIES = {
    r"(?<![a-z])freq\w*|[\[(_]hz": PERIODS_HINT,
    r"m/s\w*\s*[\^*]*\s*[2²]|m\s?s-2|m/s/s|(?<![a-z])gals?(?![a-z])": IN_G,
    r"(?<![a-z])(?:psv|sv|sd|psd)(?![a-z])|[\[(_](?:m|cm|mm)(?:/s)?(?![a-z])": "give Sa in g",
}
"""Frequencies, units and quantities in a comment that Sa over T does not have, and what to do."""
WHOLE_NUMBERS = re.compile(r"\d+(,\d+){2,},?")
"""A row whose commas may separate numbers, or be decimal ones."""


class HeaderDamping(tuple[float, ...]):
    """Dampings that the header of a file states."""

    __slots__ = ()


def read_table(path: Path, damping: Any = None) -> tuple[Floats, Any]:
    """Read a spectrum from a text file: rows of period [s] and Sa [g], and its damping.

    A name such as ``en1998-1:2004:type1:C:ag=0.25`` is a formula of `formula_of`.
    Lines that begin with # and lines of names at the top are comments.  A number beside the word
    in one of them, as ``damping 0.05``, ``zeta = 5 %`` or ``5 %-damped``, is the damping; several
    after the word are those of the columns in turn.  1 and above are per cent.

    A damping that is given is returned as it is, where the header is clear and states no other;
    without one it is the `HeaderDamping` of the file, None where it states none.

    Raises
    ------
    InputError
        If the file cannot be read, holds no such table, its header is not clear, or it states
        another damping or quantity.
    """
    if (formula := formula_of(str(path))) is not None:
        return _by_formula(formula, damping)
    refusal = functools.partial(InputError, "spectrum", path)
    hint = f"formulas are {formulas_words()}" if ":" in str(path) else SHAPE_HINT
    content = content_of(path, "spectrum", hint)
    if len(content) > MOST_BYTES:
        raise refusal("it is too large for a spectrum", SHAPE_HINT)
    lines = text_of(content, path.name, "a table").splitlines()
    _refuse_commas(path, lines)
    rows: list[list[float]] = []
    comments: dict[int, str] = {}
    for number, line in enumerate(lines, 1):
        text = line.strip()
        try:
            row = [float(word) for word in re.split(r"[\s,;]+", text.rstrip(",;"))] if text else []
        except ValueError:
            if rows and not text.startswith("#"):
                raise refusal(f"line {number} is no row of numbers", SHAPE_HINT) from None
            text = re.sub(r"(?<![\d.])0,(?=\d)", "0.", text.lower())
            comments[number] = re.sub(r"-?(per\s?cent\w?|pct\.?)", "%", text)
            continue
        if "." not in text and re.search(r"\d,\d", text) and re.search(r"\d[;\s]+\d", text):
            raise refusal(f"line {number} has decimal commas", "write points, as 0.5 for 0,5")
        if row and rows and len(row) != len(rows[0]):
            count = plural(len(row), "number")
            valid = f"line {number} has {count}, and the rows above {len(rows[0])}"
            raise refusal(valid, SHAPE_HINT)
        if row:
            rows.append(row)
    if not rows:
        raise refusal("it has no rows of numbers", SHAPE_HINT)
    _refuse_quantities(path, comments)
    stated = None
    with nullcontext() if damping is None else suppress(InputError):
        stated = _header_damping(path, comments, len(rows[0]) - 1)
    if damping is not None and stated is not None and {*np.ravel(damping)} != {*stated}:
        valid = f"{path} states {', '.join(f'{each:g}' for each in stated)}"
        raise InputError("spectrum_damping", damping, valid, "leave it out, or correct the file")
    return np.array(rows), stated if damping is None else damping


def _by_formula(formula: CodeSpectrum, damping: Any) -> tuple[Floats, tuple[float, ...]]:
    """Return rows and damping of a formula, which has its own."""
    if damping is not None:
        valid = f"formulas are for {100.0 * SPECTRUM_DAMPING:g} % damping"
        raise InputError("spectrum_damping", damping, valid, "leave it out")
    return formula.rows, (SPECTRUM_DAMPING,)


def _refuse_quantities(path: Path, comments: dict[int, str]) -> None:
    """Refuse a file whose comments name frequencies, or another unit or quantity than Sa in g."""
    in_g = any(re.search(r"(?<![a-z\d])g(?![a-z])", text) for text in comments.values())
    for number, text in comments.items():
        for pattern, hint in QUANTITIES.items():
            named = re.search(pattern, text)
            if named and (hint is PERIODS_HINT or not in_g):
                valid = f"line {number} names {named[0].strip('[(_ ')}: it takes T [s] and Sa [g]"
                raise InputError("spectrum", path, valid, hint)


def _refuse_commas(path: Path, lines: list[str]) -> None:
    """Refuse a file of whole numbers and commas: these separate numbers, or are decimal ones."""
    rows = [(k, line.strip()) for k, line in enumerate(lines, 1) if line.strip()[:1].isdigit()]
    if rows and all(WHOLE_NUMBERS.fullmatch(text) for _, text in rows):
        place, text = rows[0]
        valid = f"line {place}, {text}, has whole numbers and commas alone"
        hint = "write points for decimal commas, as 0.1,0.25 for 0,1,0,25"
        raise InputError("spectrum", path, valid, hint)


def _header_damping(path: Path, comments: dict[int, str], columns: int) -> HeaderDamping | None:
    """Return the dampings that comments state by their lines; None where they name none.

    Raises
    ------
    InputError
        If they state two different ones or not one a column, or name one without its number.
    """
    lines: dict[tuple[float, ...], int] = {}
    unclear = 0
    for number, text in comments.items():
        statements = [each[0] for form in STATEMENTS for each in re.finditer(form, text)]
        for words in statements:
            values = [float(each) for each in re.findall(_NUMBER, words)]
            share = 0.01 if "%" in words or max(values) >= 1.0 else 1.0
            lines[tuple(round(share * each, 12) for each in values)] = number
        if not statements and re.search(_WORD, text):
            unclear = number
    reason = "names a damping and has no number beside the word" if unclear and not lines else ""
    if len(lines) > 1:
        reason = "states a second damping"
    elif lines and (count := len(*lines)) != columns:
        reason = f"states {plural(count, 'damping')} for {plural(columns, 'column')} of Sa"
    if reason:
        number = max(lines.values(), default=unclear)
        hint = "write # damping 5 %, for two columns # damping 2 %, 5 %, or state it apart"
        raise InputError("spectrum", path, f"line {number} {reason}", f"{hint} from the file")
    return HeaderDamping(*lines) if lines else None
