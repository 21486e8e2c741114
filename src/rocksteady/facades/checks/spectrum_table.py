"""Spectra in tables, of the ground or of a floor: Sa [g] over the period at some dampings."""

import functools
import math
from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.facades.checks.remark import Remark
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import UnfitError, numeric_array
from rocksteady.results.numbers import number
from rocksteady.risk.observations.files.csv_table import Columns, number_in, read_csv_table
from rocksteady.risk.spectra.elastic_spectrum import (
    DAMPING,
    LONGEST_S,
    PERIOD,
    damping_factor,
    displacement_of,
)
from rocksteady.risk.spectra.tabulated import (
    IN_G,
    MOST_DESIGN_G,
    RIGID_S,
    TabulatedSpectrum,
    tabulated,
)

HINT: Final = "write period_s,sa_g and a line for each period, the first one 0"
COLUMNS: Final = Columns(
    known=("period_s", "sa_g", "damping"),
    needed={
        "period_s": ("periods are in seconds", HINT),
        "sa_g": ("spectral accelerations are in g", HINT),
    },
    things="points",
    example="period_s,sa_g",
)


@checked
@dataclass(frozen=True, kw_only=True)
class SpectrumTable:
    """Acceleration spectrum of the ground or of a floor as a table.

    Between its rows ln Sa is linear in ln T; between two dampings in ln(damping).  At a damping
    outside of those given the nearest is scaled by ``eta = sqrt(10/(5 + xi)) >= 0.55``, xi in per
    cent, except in the row at period 0.  Beyond its rows a table is not continued.

    Parameters
    ----------
    periods_s
        Periods [s], ascending, shape (n,); the first is 0 where the peak is needed.
    values_g
        Spectral accelerations [g], shape (n,), or (n, k) for k dampings.
    damping
        1 being critical, as 0.05; k of them for k columns.

    Raises
    ------
    InputError
        If it is no such table.

    Examples
    --------
    >>> floor = SpectrumTable(periods_s=[0.0, 0.4, 4.0], values_g=[0.3, 1.2, 0.12], damping=0.05)
    >>> print(f"{floor.sa_g(0.0, 0.08):.3f} {floor.sa_g(1.2, 0.05):.3f}")
    0.300 0.400
    """

    periods_s: Any
    values_g: Any
    damping: Any

    def __post_init__(self) -> None:
        """Validate."""
        table = _tabulated(self.periods_s, self.values_g, self.damping)
        object.__setattr__(self, "periods_s", tuple(table.periods_s.tolist()))
        object.__setattr__(self, "values_g", tuple(map(tuple, table.values_g.tolist())))
        object.__setattr__(self, "damping", table.dampings)

    @functools.cached_property
    def _table(self) -> TabulatedSpectrum:
        return _tabulated(self.periods_s, self.values_g, self.damping)

    def sa_g(self, period_s: float, damping: float) -> float:
        """Return the spectral acceleration [g] at a period.

        Parameters
        ----------
        period_s
            T [s]; 0 for the peak of the acceleration.
        damping
            1 being critical, in (0, 1), as 0.08.

        Raises
        ------
        InputError
            If a number is outside its range.
        ModelError
            If the period is outside the table.
        """
        t, xi = PERIOD("period_s", period_s), DAMPING("damping", damping)
        first, last = self.periods_s[0], self.periods_s[-1]
        if t > last or (t < first and first > RIGID_S):
            raise ModelError(
                "period_s",
                Words(f"lies outside its table, at {number(t, 4)} s"),
                f"it goes from {number(first)} to {number(last)} s and is not continued",
                "add rows to the table" + (", the first at period 0" if t < first else ""),
            )
        chain, _ = self._table.at_damping(xi, last)
        return chain.at(t) / STANDARD_GRAVITY

    def displacement_m(self, period_s: float, damping: float) -> float:
        """Return the demand of displacement S_e T^2/(4 pi^2) [m] (C8.7.1.12).

        Parameters and errors are those of `sa_g`.
        """
        return displacement_of(self.sa_g(period_s, damping), period_s)

    def remark(self, damping: float) -> Remark:
        """Return how a damping follows from those of the table."""
        xi, given = DAMPING("damping", damping), self.damping
        wanted = number(100.0 * xi)
        if any(math.isclose(each, xi, rel_tol=1e-9) for each in given):
            return Remark("table_as_given", (wanted,))
        place = bisect_right(given, xi)
        if 0 < place < len(given):
            low, high = given[place - 1], given[place]
            return Remark("table_between", (number(100.0 * low), number(100.0 * high), wanted))
        nearest = given[0 if place == 0 else -1]
        factor = damping_factor(xi) / damping_factor(nearest)
        return Remark("table_scaled", (number(100.0 * nearest), wanted, number(factor)))


@checked
def read_spectrum_table(
    path: Path | str, *, spectrum_damping: float | None = None
) -> SpectrumTable:
    r"""Read an acceleration spectrum from a table in CSV.

    Parameters
    ----------
    path
        The file: columns ``period_s`` in s, ``sa_g`` in g and, where they are several, ``damping``.
    spectrum_damping
        Damping of a table without that column, as 0.05; None (default) with it.

    Returns
    -------
    SpectrumTable
        The spectrum.

    Raises
    ------
    InputError
        With line and column, if the file cannot be read or a cell is no number.
    ModelError
        If the damping is given twice or not at all.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "floor.csv")
    ...     _ = file.write_text("period_s,sa_g\n0,0.3\n0.4,1.2\n4,0.12\n", "utf-8")
    ...     floor = read_spectrum_table(file, spectrum_damping=0.05)
    >>> print(f"{floor.sa_g(0.4, 0.05):.2f}")
    1.20
    """
    file = Path(path)
    stated = None if spectrum_damping is None else DAMPING("damping", spectrum_damping)
    table = read_csv_table(file, COLUMNS, name="spectrum", hint=HINT)
    several = "damping" in table.header
    if several == (stated is not None):
        raise ModelError(
            f"{table.source}: damping",
            Words("is given twice" if several else "is not given"),
            "a table has one damping, or a column of them",
            "leave one out" if several else "give damping, as 0.05, or add a column",
        )
    curves: dict[float, dict[float, float]] = {}
    for place, cells in table.lines():
        period = number_in(place, "period_s", cells["period_s"])
        xi = number_in(place, "damping", cells["damping"]) if several else stated
        assert xi is not None
        curve = curves.setdefault(xi, {})
        if period in curve:
            hint = "give each period once for each damping"
            raise InputError(f"{place}, period_s", cells["period_s"], "it occurs twice", hint)
        curve[period] = number_in(place, "sa_g", cells["sa_g"])
    periods = list(next(iter(curves.values())))
    for xi, curve in curves.items():
        if list(curve) != periods:
            raise ModelError(
                f"{table.source}: damping",
                Words(f"{xi:g} has other periods than {next(iter(curves)):g}"),
                "each damping has the same periods in the same order",
                "give one sa_g for each period and damping",
            )
    rows = [[curve[period] for curve in curves.values()] for period in periods]
    try:
        return SpectrumTable(periods_s=periods, values_g=rows, damping=list(curves))
    except InputError as error:
        raise InputError(
            f"{table.source}: {error.name}", error.value, error.valid, error.hint
        ) from None


def _tabulated(periods: Any, values: Any, damping: Any) -> TabulatedSpectrum:
    """Return a validated table."""
    import numpy as np

    hint = "give periods_s and values_g, one number or one row for each period"
    columns = []
    for name, given in (("periods_s", periods), ("values_g", values)):
        try:
            columns.append(np.asarray(numeric_array(name, given), np.float64))
        except UnfitError as unfit:
            raise InputError(name, given, *unfit.args) from None
    first_column, second_column = columns
    try:
        rows = np.column_stack(columns)
    except ValueError:
        raise InputError("values_g", values, "there is one for each period", hint) from None
    if first_column.ndim != 1 or second_column.ndim not in (1, 2) or not rows.size:
        raise InputError("values_g", values, "there is one for each period", hint)
    if rows[:, 1:].max() > MOST_DESIGN_G:
        valid = f"it is at most {MOST_DESIGN_G:g} g"
        raise InputError("values_g", float(rows[:, 1:].max()), valid, IN_G)
    if first_column.max() > LONGEST_S:
        hint = "give periods in seconds, as 0.5"
        raise InputError(
            "periods_s", float(first_column.max()), f"it is at most {LONGEST_S:g} s", hint
        )
    row = isinstance(damping, list | tuple) or getattr(damping, "ndim", 0) == 1
    dampings = list(damping) if row else [damping]
    for each in dampings:
        DAMPING("damping", each)
    spectrum = tabulated(rows.tolist(), dampings)
    assert spectrum is not None
    return spectrum
