"""Lines of a screen from fields: a quantity, its value, unit and band, its evidence, a condition.

What these cannot say is a row of a table.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from rocksteady.results.description import Fact, line
from rocksteady.results.numbers import CONFIDENCE, chance, number, plural, quantity

LEAST = 1e-3
"""Distance of an end of an interval to none or all, below which it is that."""
SHARE = "share"
"""Unit of a share, which is written in per cent."""


@dataclass(frozen=True, kw_only=True)
class Stated:
    """A quantity that is stated.

    Attributes
    ----------
    quantity
        What it is, as "lifts at": the label of its line.
    value, unit
        Its number and unit, `SHARE` of a share; None of what is stated in `text`.
    text
        What stands in place of a number.
    band
        Both ends of its 90 % interval, in the same unit; None without.
    evidence
        What it rests on, as "given 0.50".
    condition
        Under what it holds, or what limits it.
    """

    quantity: str
    value: float | None = None
    unit: str = ""
    text: str = ""
    band: tuple[float, float] | None = None
    evidence: str = ""
    condition: str = ""

    @property
    def number(self) -> str:
        """The value with its unit."""
        if self.value is None:
            return self.text
        if self.unit == SHARE:
            return chance(self.value)
        return quantity(self.value, self.unit) if self.unit else number(self.value)

    @property
    def interval(self) -> str:
        """The interval after it, its level first; empty without."""
        if self.band is None:
            return ""
        if self.unit == SHARE:
            return band_words(self.band)
        low, high = (number(end) for end in self.band)
        return f" ({100.0 * CONFIDENCE:g} %: {low} to {high})"

    @property
    def words(self) -> str:
        """All of it: ``value (90 %: a to b), evidence; condition``."""
        words = ", ".join(part for part in (self.number + self.interval, self.evidence) if part)
        return "; ".join(part for part in (words, self.condition) if part)


def facts_stated(lines: Iterable[Stated]) -> list[Fact]:
    """Return the lines that say something as facts of the first screen."""
    return [line(each.quantity, each.words) for each in lines if each.words]


def share_words(falls: int, runs: int, band: tuple[float, float], share: float) -> str:
    """Return a counted share and its band, as of "falls in ... at DEMAND: 11 % (...)".

    Of none, or of all, the number of runs is the count, and the band has one end.

    Examples
    --------
    >>> share_words(31, 280, (0.053, 0.198), 0.111), share_words(0, 280, (0.0, 0.052), 0.0)
    ('11 % (90 %: 5.3 to 20 %)', 'at most 5.2 %')
    """
    if not falls:
        return f"at most {chance(band[1])}"
    if falls == runs:
        return f"at least {chance(band[0])}"
    return chance(share) + band_words(band)


def band_words(band: tuple[float, float]) -> str:
    """Return the interval of a counted share after it, its level first.

    Ends are rounded outwards where they have no figure of their own.

    Examples
    --------
    >>> band_words((0.29, 0.428)), band_words((0.0003, 0.9997))
    (' (90 %: 29 to 43 %)', ' (90 %: 0 to 100 %)')
    """
    low, high = (
        chance(end) if LEAST <= end <= 1.0 - LEAST else f"{100.0 * end:.0f} %" for end in band
    )
    return f" ({100.0 * CONFIDENCE:g} %: {low.removesuffix(' %')} to {high})"


def runs_that(verb: str, falls: int, runs: int) -> str:
    """Return a count with its verb, as the beginning of a sentence.

    Examples
    --------
    >>> runs_that("Falls", 31, 280), runs_that("Falls", 0, 280), runs_that("Falls", 280, 280)
    ('Falls in 31 of 280 runs', 'Falls in none of 280 runs', 'Falls in all 280 runs')
    """
    if falls == runs and runs > 1:
        return f"{verb} in all {runs:,} runs"
    return f"{verb} in {f'{falls:,}' if falls else 'none'} of {plural(runs, 'run')}"
