"""Hazard curves as OpenQuake exports them: one row per site, probabilities in a time."""

import math
import re
from typing import Final

from rocksteady.errors import InputError
from rocksteady.records.core.numbers import number as read_number
from rocksteady.risk.hazard._hazard_text import (
    SEPARATORS,
    HazardText,
    fields_of,
    make_curve,
    number_of,
)
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import ground_measure, written
from rocksteady.seismic.measures.scalar import Measure

_POE: Final = "poe-"
_FEW: Final = 20
"""Lines in which the row of names is looked for."""
_TIME: Final = re.compile(r"investigation_time\s*=\s*[\"']*([^\s,\"']{1,40})")
_IMT: Final = re.compile(r"\bimt\s*=\s*[\"']*\s*([A-Za-z]\w{0,30}(?:\([^()\"']{0,30}\))?)")
_KIND: Final = re.compile(r"\bkind\s*=\s*[\"']*([\w.\-]{1,60})")


def find_names(text: HazardText) -> tuple[int, str | None] | None:
    """Return the index of the row of names and its separator; None of a file of another kind."""
    for at, (_, line) in enumerate(text.lines[:_FEW]):
        for separator in SEPARATORS:
            if any(name.lower().startswith(_POE) for name in fields_of(line, separator)):
                return at, separator
    return None


def read_sites(
    text: HazardText,
    names: tuple[int, str | None],
    measure: Measure | None,
    poe_years: float | None,
) -> list[HazardCurve]:
    """Return the curve of each site.

    Parameters
    ----------
    text
        The file.
    names
        What `find_names` returns.
    measure, poe_years
        As given, for a file without a header line; None else.

    Raises
    ------
    InputError
        If the file is incomplete or contradicts itself or the arguments.
    """
    at, separator = names
    number, line = text.lines[at]
    header = " ".join(line for _, line in text.lines[:at])[:4000]
    words, factor = _measure(text, header, measure)
    years = _years(text, header, poe_years)
    columns = [name.lower() for name in fields_of(line, separator)]
    of_levels = [place for place, name in enumerate(columns) if name.startswith(_POE)]
    levels = [number_of(columns[place][len(_POE) :], separator) for place in of_levels]
    if not {"lon", "lat"} <= set(columns):
        raise text.error("the columns lon and lat are missing", line=number)
    if any(level is None or level <= 0.0 for level in levels):
        raise text.error("each column of probabilities must name its level", line=number)
    kind = _KIND.search(header)
    curves = []
    for row, content in text.lines[at + 1 :]:
        if content.lstrip().startswith("#"):
            continue
        fields = fields_of(content, separator)
        if len(fields) != len(columns):
            raise text.error(
                f"it has {len(fields)} columns, and there are {len(columns)} names",
                "export the file again",
                line=row,
            )
        values = [number_of(fields[place], separator) for place in of_levels]
        lon, lat = (number_of(fields[columns.index(name)], separator) for name in ("lon", "lat"))
        if lon is None or lat is None or abs(lon) > 360.0 or abs(lat) > 90.0:
            raise text.error("longitude and latitude must be degrees", line=row)
        curves.append(
            make_curve(
                text,
                [factor * level for level in levels if level is not None],
                [rate_of(text, value, years, row) for value in values],
                line=row,
                measure=words,
                name=kind[1] if kind else "",
                site=(lon, lat),
            )
        )
    if not curves:
        raise text.error("it has no row of a site", line=number)
    return curves


def rate_of(text: HazardText, poe: float | None, years: float, line: int) -> float:
    """Return the annual rate of a probability of exceedance in a time: -ln(1 - poe)/T.

    Raises
    ------
    InputError
        If it is no probability.
    """
    if poe is None or not 0.0 <= poe <= 1.0:
        raise text.error("a probability of exceedance must lie in [0, 1]", line=line)
    return math.inf if poe == 1.0 else abs(math.log1p(-poe)) / years


def _measure(text: HazardText, header: str, measure: Measure | None) -> tuple[Measure, float]:
    """Return the measure, and the unit of the file's levels in that of the measure."""
    match = _IMT.search(header)
    if match is None:
        if measure is None:
            raise text.error(
                'no imt="PGA" or the like stands above the columns',
                "write it into that line, or give measure=",
            )
        return measure, _openquake_unit(measure)
    word, _, period = match[1].rstrip(")").partition("(")
    period_s = read_number(period)
    known = {"PGA": "pga_g", "PGV": "pgv_m_s"}.get(word.upper())
    if word.upper() == "SA" and period_s is not None:
        known = f"sa_g:{period_s!r}"
    if known is None or (period and word.upper() != "SA"):
        raise text.error(f"its imt is {match[1]}: known are PGA, PGV [cm/s] and SA(PERIOD)")
    try:
        stated = ground_measure("imt", known)
    except InputError as error:
        raise text.error(f"its imt is {match[1]}: {error.valid}") from None
    if measure is not None and measure != stated:
        raise InputError(
            "measure", written(measure), f"the file states {match[1]}", "leave out measure="
        )
    return stated, _openquake_unit(stated)


def _openquake_unit(measure: Measure) -> float:
    """Return the unit that OpenQuake has levels of a measure in: g, and cm/s."""
    return 0.01 if measure.name == "pgv_m_s" else 1.0


def _years(text: HazardText, header: str, poe_years: float | None) -> float:
    """Return the time of the probabilities [years]."""
    match = _TIME.search(header)
    if match is None:
        if poe_years is None:
            raise text.error("no investigation_time stands above the columns", "give poe_years=")
        return poe_years
    years = read_number(match[1])
    if years is None or not 0.0 < years <= 1e6:
        raise text.error(f"investigation_time = {match[1]} is no time in years")
    if poe_years is not None and poe_years != years:
        raise InputError(
            "poe_years", poe_years, f"the file states {years:g} years", "leave out poe_years="
        )
    return years
