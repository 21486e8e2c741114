"""A hazard file as lines and numbers, and what files of both kinds have in common."""

import math
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from rocksteady.errors import InputError
from rocksteady.records.core.numbers import number
from rocksteady.results.numbers import plural
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import GROUND, written
from rocksteady.seismic.measures.scalar import Measure

HINT: Final = "give a CSV file of OpenQuake's hazard curves, or of two columns: level and rate"
SEPARATORS: Final = (";", "\t", ",", None)
"""Between fields; None is blanks."""
MEASURE: Final = re.compile(
    r"(?P<pga_g>pga|peak ground acc\w*|\ba_?g\b)|(?P<pgv_m_s>pgv|peak ground vel\w*)"
    r"|(?:(?P<sa_avg_g>sa_?avg|avg_?sa)|(?P<sa_g>\bp?sa(?![a-z])|spectral acc\w*))"
    r"(?:[\s(\[_]*(?:(?:at|t\d?\s?=)\s?)?(?P<period>\d+[.,]?\d*|[.,]\d+)\s?s?\b(?!\s?%)[\s)\]]*)?",
    re.IGNORECASE,
)
"""A measure in the name of a column; each group but the period is a measure of the package."""
_STRONGEST: Final = 20.0
"""Level [g or m/s] above which the unit must be wrong."""


@dataclass(frozen=True, kw_only=True)
class HazardText:
    """The lines of a file that are not blank, and the arguments that it is read with.

    Parameters
    ----------
    path
        The file.
    lines
        Text of each line by its number, the first being 1.
    measure, level_unit, poe_years
        As given, for what the file does not state; None else.
    """

    path: Path
    lines: dict[int, str]
    measure: Measure | None
    level_unit: str | None
    poe_years: float | None

    def error(self, valid: str, hint: str = HINT, *, line: int | None = None) -> InputError:
        """Return the error about the file, or about the line of a number."""
        if line is not None:
            text = self.lines[line].strip()
            valid = f"line {line}, {text if len(text) <= 40 else f'{text[:40]}...'!r}: {valid}"
        return InputError("hazard", str(self.path), valid, hint)

    def named_measure(self, name: str) -> tuple[Measure, str]:
        """Return the measure of a name or else the one given, and the rest of a name of a measure.

        Raises
        ------
        InputError
            If there is none, or name and argument differ.
        """
        match = MEASURE.search(name)
        word = next((each for each in GROUND if match and match[each]), "")
        rest = name.replace(match[0], " ", 1) if match else ""
        period = float(match["period"].replace(",", ".")) if match and match["period"] else 0.0
        if not word or (GROUND[word] and period < 1e-6):
            if self.measure is None or word not in {"", self.measure.name}:
                hint = 'state it, as "PGA [g]" or "Sa(1.0) [g]", or give measure='
                raise self.error(f"{name!r} is not one of PGA, PGV and Sa(PERIOD)", hint)
            return self.measure, rest
        known = Measure(word, period if GROUND[word] else None)
        if self.measure is not None and self.measure != known:
            given = written(self.measure)
            raise InputError("measure", given, f"the file states {name!r}", "leave it out")
        return known, rest

    def years(self, name: str, stated: float | None) -> float:
        """Return the time of probabilities [years], as stated or else as given.

        Raises
        ------
        InputError
            If there is none, it is no time, or file and argument differ.
        """
        time = self.poe_years if stated is None else stated
        if time is None or not 0.0 < time <= 1e6:
            raise self.error(f"{name!r} has no time in years", "state it, or give poe_years=")
        if self.poe_years not in {None, time}:
            raise InputError(
                "poe_years", self.poe_years, f"the file states {name!r}", "leave it out"
            )
        return time

    def curve(
        self, points: Sequence[tuple[int, float, float]], remarks: Sequence[str] = (), **known: Any
    ) -> HazardCurve:
        """Return the curve of points, without those of infinite and of no rate.

        Parameters
        ----------
        points
            Line, level and rate of each.  Levels all rise or all fall; a rate may be infinite, 0,
            or NaN for what is no probability and no return period.
        remarks, known
            Further remarks, and what else the curve is made with.

        Raises
        ------
        InputError
            If a level is out of order or in another unit, a rate rises or is none, or fewer than
            two points remain.
        """
        low, high = 0.0, math.inf
        for line, level, rate in points if points[0][1] <= points[-1][1] else points[::-1]:
            if not level > low:
                hint = "sort the levels, give each once, and leave out 0"
                raise self.error(f"the level {level:g} is not above {low:g}", hint, line=line)
            if math.isnan(rate):
                hint = 'correct it, or state per cent as "[%]"; a return period is above 0'
                raise self.error("a probability must lie in [0, 1]", hint, line=line)
            if rate > high:
                valid = f"the rate of {level:g} is above that of {low:g}"
                hint = "give rates of exceedance of one curve, which never rise with the level"
                raise self.error(valid, hint, line=line)
            low, high = level, rate
        if low > _STRONGEST:
            hint = 'state the unit of the file, as "[% g]" or "[cm/s]", or leave out such levels'
            raise self.error(f"no ground shakes with {low:g} {known['measure'].unit}", hint)
        counts = Counter(rate for _, _, rate in points)
        notes = [
            f"{plural(counts[rate], 'level')} left out: {why}."
            for rate, why in ((math.inf, "a probability of 1, an infinite rate"), (0.0, "no rate"))
            if counts[rate]
        ]
        kept = np.array(sorted(point[1:] for point in points if 0.0 < point[2] < math.inf))
        if len(kept) < 2:
            valid = f"{plural(len(kept), 'level')} with a rate that is neither 0 nor infinite"
            raise self.error(f"the curve has {valid}", "give two or more", line=points[0][0])
        levels, rates = kept.T
        return HazardCurve(levels=levels, rates=rates, remarks=(*notes, *remarks), **known)


def split(line: str, separator: str | None) -> list[str]:
    """Return the fields of a line without quotes; separators at its end are none."""
    fields = [field.strip().strip("\"'").strip() for field in line.split(separator)]
    while fields and not fields[-1]:
        fields.pop()
    return fields


def numbers(fields: Sequence[str], separator: str | None) -> list[float]:
    """Return the numbers of fields, NaN of others; with decimal commas unless commas separate."""
    values = (number(field if separator == "," else field.replace(",", ".")) for field in fields)
    return [math.nan if value is None else value for value in values]


def rate_of(poe: float, years: float) -> float:
    """Return the annual rate of a probability of exceedance in a time, NaN of what is none."""
    if not 0.0 <= poe < 1.0:
        return math.inf if poe == 1.0 else math.nan
    return abs(math.log1p(-poe)) / years
