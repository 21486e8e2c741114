"""Design spectra that motions are placed on: 5 % damping, with the peak acceleration."""

from dataclasses import dataclass
from os import PathLike
from typing import Annotated, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.numbers import number, quantity
from rocksteady.risk.spectra.code_spectra import PERIODS_S, SPECTRUM_DAMPING, formula_of
from rocksteady.risk.spectra.tabulated import (
    IN_G,
    MOST_DESIGN_G,
    RIGID_S,
    TabulatedSpectrum,
    spectrum_from,
    tabulated,
)
from rocksteady.seismic.measures.response_spectrum import LONGEST_S

PLACED_S: Final = (0.2, 4.0)
"""Periods over which a motion is placed on a spectrum [s]."""
LEAST_END_S: Final = 2.0
"""Period that a spectrum reaches at least [s]."""
SAME_PEAK: Final = 0.02
"""Part by which a peak may differ from that of the row at period 0."""
PLATEAU: Final = (1.8, 5.0)
"""Largest Sa over the PGA: below the first a spectrum may be divided by q or R, above the second
its PGA or its unit may be wrong, unless it is that of a floor."""
PERIODS: Final = Bounds(0.0, LONGEST_S, "[]", "give periods in seconds, as 0.5")
PGA: Final = Bounds(0.0, MOST_DESIGN_G, "(]", "give the peak in g; 0.3 is usual")


@checked
@dataclass(frozen=True, kw_only=True)
class DesignSpectrum:
    """A design spectrum that records are placed on.

    Parameters
    ----------
    table
        Periods and accelerations, from `make_design_spectrum`.
    pga_g
        Peak acceleration [g]; by default that of the row at period 0.

    Raises
    ------
    InputError
        If no peak is known, two differ, Sa is above 10 g or it ends below 2 s.
    """

    table: TabulatedSpectrum
    pga_g: Annotated[float | None, PGA] = None

    def __post_init__(self) -> None:
        """Validate, and take the peak from the table."""
        periods, values = self.table.periods_s, self.table.scaled(SPECTRUM_DAMPING)[0]
        first, last = float(periods[0]), float(periods[-1])
        if values.max() > MOST_DESIGN_G:
            valid = f"it reaches {number(values.max())} g, and {MOST_DESIGN_G:g} g is the most"
            raise InputError("spectrum", self.words_of_source, valid, IN_G)
        if last < LEAST_END_S:
            valid = f"it ends at {number(last)} s, and motions are placed up to {LEAST_END_S:g} s"
            raise InputError("spectrum", self.words_of_source, valid, "add rows")
        peak = self.table.peak_g
        if self.pga_g is None:
            if peak is None:
                valid = f"it begins at {number(first)} s"
                hint = "add its row at period 0, or state the PGA apart from it"
                raise InputError("spectrum", self.words_of_source, valid, hint)
            object.__setattr__(self, "pga_g", PGA("spectrum", peak))
        elif first <= RIGID_S and abs(self.pga_g - values[0]) > SAME_PEAK * values[0]:
            valid = f"the spectrum has {number(values[0])} g at period {number(first)} s"
            raise InputError("pga_g", self.pga_g, valid, "leave it out, or correct the spectrum")

    @property
    def peak_g(self) -> float:
        """Peak acceleration [g]."""
        assert self.pga_g is not None
        return self.pga_g

    @property
    def pgv_m_s(self) -> None:
        """Peak velocity, which a spectrum leaves to the motions."""
        return

    @property
    def words(self) -> str:
        """The demand, as "the spectrum of 0.25 g"."""
        return f"the spectrum of {quantity(self.peak_g, 'g')}"

    @property
    def where(self) -> str:
        """The same after a verb."""
        return f"on {self.words}"

    @property
    def kept(self) -> str:
        """What is the same at all multiples of it."""
        return "the spectrum keeps its shape"

    @property
    def words_of_source(self) -> str:
        """Where it comes from: a file, a formula with its clause, or a table."""
        formula = formula_of(self.table.source)
        return formula.words if formula is not None else self.table.source or "a table"

    @property
    def range_s(self) -> tuple[float, float]:
        """Periods over which motions are placed on it [s]."""
        return PLACED_S[0], min(PLACED_S[1], float(self.table.periods_s[-1]))

    @property
    def values(self) -> dict[str, Any]:
        """What JSON says of it."""
        given = self.table.dampings
        return {
            "file": self.table.source or None,
            "damping": given[0] if len(given) == 1 else list(given),
            "pga_g": self.pga_g,
            "range_s": list(self.range_s),
        }

    @property
    def plateau(self) -> float:
        """Its largest acceleration over the PGA."""
        return float(self.table.scaled(SPECTRUM_DAMPING)[0].max()) / self.peak_g

    @property
    def peak_words(self) -> str:
        """What is doubtful of its largest acceleration beside the PGA; empty of nothing."""
        words = f"its largest Sa is {number(self.plateau, 2)} times the PGA: "
        if self.plateau < PLATEAU[0]:
            return f"{words}divided by q or R? give the elastic spectrum"
        return f"{words}check PGA and unit" * (self.plateau > PLATEAU[1])

    @property
    def damping_words(self) -> str:
        """How its acceleration follows from other dampings than 5 %; empty of 5 % itself."""
        given = self.table.dampings
        if SPECTRUM_DAMPING in given:
            return ""
        ends = " and ".join(number(100.0 * each) for each in (given[0], given[-1])[: len(given)])
        return f"taken from {ends} to {number(100.0 * SPECTRUM_DAMPING)} % damping"

    @property
    def remark(self) -> str:
        """What a formula leaves to the engineer, as a sentence; empty of a table."""
        formula = formula_of(self.table.source)
        return "" if formula is None else formula.remark

    def accelerations_g(self, periods_s: ArrayLike) -> Floats:
        """Return its acceleration at periods in s [g]; beyond its end that of its last row.

        Raises
        ------
        InputError
            If one is below 0 or above 1e9 s.
        """
        periods = checked_array("periods_s", periods_s, PERIODS)
        chain, _ = self.table.at_damping(SPECTRUM_DAMPING, PLACED_S[1])
        values = [chain.at(t) for t in periods.ravel().tolist()]
        return np.reshape(values, periods.shape) / STANDARD_GRAVITY


@checked
def make_design_spectrum(
    spectrum: Any,
    *,
    spectrum_damping: float | None = None,
    pga_g: Annotated[float | None, PGA] = None,
) -> DesignSpectrum:
    """Return a design spectrum of a file, a formula, rows, or another kind of spectrum.

    Parameters
    ----------
    spectrum
        A file of rows of period in s and Sa in g that states its damping; a formula, as
        ``en1998-1:2004:type1:C:ag=0.25``, ``asce7-16:sds=1.0:sd1=0.6:tl=8`` or
        ``ntc2018:C:T1:ag=0.2:f0=2.5:tc=0.35``; rows, shape (periods, 2); an `ElasticSpectrum` or a
        `SpectrumTable`.
    spectrum_damping
        Damping of rows, or of a file that states none, 1 being critical; default 0.05 of rows.
    pga_g
        Peak acceleration [g]; by default that of the row at period 0.

    Raises
    ------
    InputError
        If it is no such spectrum, ends below 2 s, is above 10 g, or has no peak or two.

    Examples
    --------
    >>> soft = make_design_spectrum("en1998-1:2004:type1:C:ag=0.25")
    >>> soft.words, soft.words_of_source
    ('the spectrum of 0.287 g', 'EN 1998-1:2004, 3.2.2.2 (type1:C:ag=0.25)')
    """
    classes = isinstance(spectrum, DesignSpectrum) or hasattr(spectrum, "sa_g")
    if classes and spectrum_damping is not None:
        valid = "a class of spectra has its own damping"
        raise InputError("spectrum_damping", spectrum_damping, valid, "leave it out")
    if isinstance(spectrum, DesignSpectrum):
        return spectrum if pga_g is None else DesignSpectrum(table=spectrum.table, pga_g=pga_g)
    if isinstance(spectrum, str | PathLike):
        return DesignSpectrum(table=spectrum_from(str(spectrum), spectrum_damping), pga_g=pga_g)
    if hasattr(spectrum, "sa_g"):  # as `ElasticSpectrum` and `SpectrumTable`
        usual = [*PERIODS_S[PLACED_S[1] > PERIODS_S].tolist(), PLACED_S[1]]
        given = getattr(spectrum, "periods_s", usual)
        spectrum = [[t, spectrum.sa_g(t, SPECTRUM_DAMPING)] for t in given]
    table = tabulated(spectrum, SPECTRUM_DAMPING if spectrum_damping is None else spectrum_damping)
    assert table is not None
    return DesignSpectrum(table=table, pga_g=pga_g)
