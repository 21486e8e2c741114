"""Hazard curves as OpenQuake exports them: one row per site, probabilities in a time."""

import math
import re
from itertools import islice
from typing import Final

from rocksteady.records.core.numbers import number
from rocksteady.risk.hazard._hazard_text import SEPARATORS, HazardText, numbers, rate_of, split
from rocksteady.risk.hazard.hazard_curve import HazardCurve

_TIME: Final = re.compile(r"investigation_time\s*=\s*[\"']*([^\s,\"']{1,40})")
_IMT: Final = re.compile(r"\bimt\s*=\s*[\"']*\s*([A-Za-z]\w{0,30}(?:\([^()\"']{0,30}\))?)")
_KIND: Final = re.compile(r"\bkind\s*=\s*[\"']*([\w.\-]{1,60})")


def find_names(text: HazardText) -> tuple[int, str | None] | None:
    """Return the line of the names and its separator; None of a file of another kind."""
    for at, line in islice(text.lines.items(), 20):  # no header has more lines
        for separator in SEPARATORS:
            if any(name.lower().startswith("poe-") for name in split(line, separator)):
                return at, separator
    return None


def read_sites(text: HazardText, at: int, separator: str | None) -> list[HazardCurve]:
    """Return the curve of each site.

    Parameters
    ----------
    text
        The file.
    at, separator
        What `find_names` returns.

    Raises
    ------
    InputError
        If the file is incomplete or contradicts itself or the arguments.
    """
    header = " ".join(line for number, line in text.lines.items() if number < at)[:4000]
    imt, time, kind = (pattern.search(header) for pattern in (_IMT, _TIME, _KIND))
    measure, rest = text.named_measure(imt[1] if imt else "a file without imt")
    if imt and not rest:
        raise text.error(f"its imt is {imt[1]}", "export PGA, PGV or SA(PERIOD)")
    stated = (number(time[1]) or math.nan) if time else None
    years = text.years(time[0] if time else "a file without investigation_time", stated)
    columns = [name.lower() for name in split(text.lines[at], separator)]
    places = [place for place, name in enumerate(columns) if name.startswith("poe-")]
    levels = numbers([columns[place].removeprefix("poe-") for place in places], separator)
    if not {"lon", "lat"} <= set(columns) or not all(level > 0.0 for level in levels):
        raise text.error("its names must be lon, lat and poe-LEVEL, each with its level", line=at)
    factor = 0.01 if measure.name == "pgv_m_s" else 1.0
    curves = []
    for row, line in text.lines.items():
        if row <= at or line.lstrip().startswith("#"):
            continue
        values = numbers(split(line, separator), separator)
        if len(values) != len(columns):
            valid = f"it has {len(values)} columns, and there are {len(columns)} names"
            raise text.error(valid, "export the file again", line=row)
        rates = [rate_of(values[place], years) for place in places]
        points = [(row, factor * x, y) for x, y in zip(levels, rates, strict=True)]
        lon, lat = (values[columns.index(name)] for name in ("lon", "lat"))
        if not (abs(lon) <= 360.0 and abs(lat) <= 90.0):
            raise text.error("lon and lat must be degrees", "export the file again", line=row)
        name = kind[1] if kind else ""
        curves.append(text.curve(points, measure=measure, name=name, site=(lon, lat)))
    if not curves:
        raise text.error("it has no row of a site", line=at)
    return curves
