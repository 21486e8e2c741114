"""Hazard curves from files: OpenQuake's, and two columns."""

import re
from os import PathLike
from pathlib import Path
from typing import Annotated

from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.records.core.text import as_text, file_bytes
from rocksteady.risk.hazard._hazard_text import HINT, HazardText
from rocksteady.risk.hazard._openquake_csv import find_names, read_sites
from rocksteady.risk.hazard._two_columns import read_columns
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import ground_measure
from rocksteady.seismic.measures.scalar import Measure


@checked
def read_hazard_curves(
    path: str | PathLike[str],
    *,
    measure: Measure | str | None = None,
    level_unit: str | None = None,
    poe_years: Annotated[float | None, Bounds(0.0, 1e6, "(]", "give a time in years")] = None,
) -> list[HazardCurve]:
    r"""Read the hazard curves of a file, one for each site.

    Two kinds of files are known.  OpenQuake's (mean, quantile or realisation) has a line with
    ``investigation_time`` and ``imt``, a line of names ``lon,lat,depth,poe-0.1,...`` and a row of
    probabilities for each site, with PGV in cm/s.  The other has two columns, level and annual
    rate (or return period, or probability), under their names: ``Sa(1.0) [g]``, ``PGA [m/s^2]``,
    ``PGV [cm/s]``.  A probability of exceedance P in T years is an annual rate -ln(1 - P)/T.
    Levels of probability 1, whose rate is infinite, and of rate 0 are left out with a remark.
    Levels rise throughout, or fall throughout; others are refused, as by `HazardCurve`.

    Parameters
    ----------
    path
        The file: separated by commas, semicolons, tabs or blanks.
    measure
        As for `HazardCurve`, where the file does not name it; default None, as stated in the file.
    level_unit
        Unit of the levels of two columns that do not name it, as ``"cm/s"``; default None.
    poe_years
        Time of the probabilities [years], where the file does not state it; default None.

    Returns
    -------
    list of HazardCurve
        In the order of the file, with g and m/s.

    Raises
    ------
    InputError
        If the file cannot be read, is not one of the two kinds, or leaves open what it holds; the
        line names the file, its line and the argument to give.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "site.csv"
    ...     _ = path.write_text("PGV [cm/s], annual rate\n10, 0.02\n50, 0.0004\n")
    ...     (curve,) = read_hazard_curves(path)
    >>> curve
    <HazardCurve: Hazard of PGV from 0.1 to 0.5 m/s: 0.02 to 0.0004 a year>
    """
    try:
        lines = as_text(Path(path), file_bytes(Path(path))).lines
    except RecordFileError as error:
        raise InputError("hazard", str(path), error.valid, HINT) from None
    # Excel's first line "sep=;" names the separator alone.
    empty = re.compile(r"[\s,;\"']*(?:sep=.*)?")
    text = HazardText(
        path=Path(path),
        lines={at: line for at, line in enumerate(lines, 1) if not empty.fullmatch(line)},
        measure=None if measure is None else ground_measure("measure", measure),
        level_unit=level_unit,
        poe_years=poe_years,
    )
    names = find_names(text)
    if names is None:
        return [read_columns(text)]
    if level_unit is not None:
        valid = "OpenQuake's levels are in g or, of PGV, cm/s"
        raise InputError("level_unit", level_unit, valid, "leave it out")
    return read_sites(text, *names)
