"""Risk: the annual rate of failure of an object under the hazard of its site."""

import math
from dataclasses import dataclass
from typing import Annotated, Any, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE, Bounds
from rocksteady.results.numbers import chance, number, quantity
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.counted.band import TAIL
from rocksteady.risk.hazard._sum import Mass, mass_of
from rocksteady.risk.hazard.fragile import Fragile, Given, fragile_of, resampled
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.seismic.measures.scalar import Measure

LONGEST_YEARS = 1e9
MOST_OUTSIDE: Final = 0.1
"""Part of a rate that may lie beyond the runs, or beyond the hazard curve."""
LEAST_FOR_BAND: Final = 28
"""Records from which a rate has an interval."""
RESAMPLES: Final = 400
"""Of the records, for the interval of a rate."""
SHARES: Final = (0.05, 0.5, 0.95)
"""Of the rate, at whose levels it is divided."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Risk(Result):
    """Annual rate of failure of an object, from `rocksteady.compute_risk`.

    Attributes
    ----------
    fragile
        The fragility, over the measure of the hazard.
    hazard
        The hazard curve of the site.
    years
        Time [years].
    annual_rate
        Rate of failure [1/year].
    band
        Its 90 % interval over the records; None of fewer than 28, and of a curve that is given.
    outside
        What levels beyond the counted ones could add at most, over the rate: shares lie between
        that of the nearest one and none below, or all above.  0 of a curve that is given.
    unknown
        What shaking beyond the hazard curve could add, over the rate: above its last level at most,
        below its first one as much as falls there.
    contributing
        Levels below which 5, 50 and 95 % of the rate lie.
    contributions
        Rate of failure between each two levels of the hazard, and above the last [1/year].
    """

    fragile: Fragile
    hazard: HazardCurve
    years: Annotated[float, Label("Time", unit="years")]
    annual_rate: Annotated[float, Label("Annual rate of failure", number)]
    band: tuple[float, float] | None
    outside: Annotated[float, Label("Beyond the runs, at most", chance)]
    unknown: Annotated[float, Label("Beyond the hazard curve", chance)]
    contributing: Annotated[tuple[float, float, float], Label("5, 50 and 95 % of it below")]
    contributions: Floats

    @property
    def probability(self) -> Annotated[float, Label("Probability", chance)]:
        """Probability of a failure in the time: 1 - exp(-rate T)."""
        return in_years(self.annual_rate, self.years)

    @property
    def probability_band(self) -> tuple[float, float] | None:
        """The 90 % interval of the probability; None without one."""
        if self.band is None:
            return None
        low, high = (in_years(end, self.years) for end in self.band)
        return low, high

    @property
    def is_known(self) -> bool:
        """Whether no more than a tenth may lie beyond the runs, or beyond the hazard curve."""
        return max(self.outside, self.unknown) <= MOST_OUTSIDE

    def rows(self) -> list[dict[str, Any]]:
        """Return the rate of failure between each two levels of the hazard, as rows."""
        ends = [*self.hazard.levels.tolist(), None]
        rows = zip(ends[:-1], ends[1:], self.contributions.tolist(), strict=True)
        return [
            {"low": low, "high": high, "annual_rate": rate, "share": rate / self.annual_rate}
            for low, high, rate in rows
        ]


@checked
def compute_risk(
    fragility: Annotated[Given, INSIDE],
    hazard: HazardCurve,
    years: Annotated[float, Bounds(0.0, LONGEST_YEARS, "(]", "give a time in years")] = 50.0,
    *,
    measure: Measure | str | None = None,
    block: Block | None = None,
) -> Risk:
    r"""Compute the annual rate of failure of an object under a hazard curve.

    The rate is the sum of the shares that fail and the rate of shaking,
    :math:`\int P(x)\,|dH(x)|`.  Shaking above the last level of the curve counts with the share
    there.  Of counted shares the interval is that over the records, drawn anew 400 times.

    Parameters
    ----------
    fragility
        Counted shares, of a `Fragility` those of its last state; a curve of `fit_curve`; or
        (median, beta) of a lognormal one.
    hazard
        The hazard curve of the site.
    years
        Time of the probability [years]; default 50.
    measure
        What a curve or (median, beta) is over: a `Measure`, or its text as ``"sa_g:1.0"`` or, with
        a block, ``"p_pgv_per_uplift"``; default None, the hazard's own.
    block
        Block of a fragility over a dimensionless measure; none by default.

    Returns
    -------
    Risk
        Rate with its interval, probability, and where the rate comes from.

    Raises
    ------
    InputError
        If the measures do not fit, fewer than 11 records were counted, or more than a tenth of the
        rate may lie beyond the runs or beyond the hazard curve.

    References
    ----------
    C. A. Cornell, F. Jalayer, R. O. Hamburger and D. A. Foutch, J. Struct. Eng. 128, 526-533
    (2002).

    Examples
    --------
    >>> from rocksteady import compute_risk
    >>> from rocksteady.risk import HazardCurve
    >>> hazard = HazardCurve(measure="pgv_m_s", levels=[0.001, 100.0], rates=[100.0, 1e-8])
    >>> risk = compute_risk((0.4653, 0.592), hazard)
    >>> print(f"{risk.annual_rate:.5f}, {risk.probability:.4f} in 50 years")
    0.00093, 0.0455 in 50 years
    """
    return known(risk_of(fragile_of(fragility, hazard, measure, block), hazard, years))


def known(risk: Risk) -> Risk:
    """Return a risk that is known.

    Raises
    ------
    InputError
        If more than a tenth of it may lie beyond the runs or beyond the hazard curve.
    """
    if risk.is_known:
        return risk
    hint = "give a hazard curve that reaches further"
    raise InputError(
        "hazard",
        Words(f"gives no rate: {why_unknown(risk)}"),
        f"at most {MOST_OUTSIDE:.0%} of a rate may lie beyond the runs or beyond the hazard curve",
        "count at further levels" if risk.outside > MOST_OUTSIDE else hint,
    )


def risk_of(fragile: Fragile, hazard: HazardCurve, years: float) -> Risk:
    """Return the risk of a fragility, known or not; as `compute_risk`."""
    edges = fragile.edges / fragile.factor
    mass = mass_of(hazard, edges)
    shares = fragile.at(mass.levels)
    parts = shares * mass.rates
    total = math.fsum(parts.tolist())
    levels = fragile.factor * mass.levels
    below, above = levels < fragile.first, levels > fragile.last
    spread = np.where(above, 1.0 if fragile.slides else 1.0 - shares, 0.0)
    if below.any():
        spread[below] = (shares[below] > 0.0) * fragile.shares(np.array(fragile.first))
    places = np.searchsorted(hazard.levels, mass.levels, side="right") - 1
    unknown = float((1.0 - shares[-1]) * mass.rates[-1])
    unknown += float(fragile.at(hazard.levels[0]) * hazard.rates[0])
    return Risk(
        fragile=fragile,
        hazard=hazard,
        years=years,
        annual_rate=total,
        band=_band(fragile, mass),
        outside=math.fsum((spread * mass.rates).tolist()) / total if total else 0.0,
        unknown=unknown / total if total else math.inf,
        contributing=_contributing(mass.levels, parts),
        contributions=np.asarray(
            np.bincount(places, weights=parts, minlength=len(hazard.levels)), dtype=np.float64
        ),
    )


def _band(fragile: Fragile, mass: Mass) -> tuple[float, float] | None:
    """Return the 90 % interval of a rate over the records; None of fewer than 28."""
    curve = fragile.counted
    records = 0 if curve is None else min(count.records for count in curve.counts)
    if curve is None or records < LEAST_FOR_BAND:
        return None
    size = len(curve.counts[0].fell)
    rng = np.random.default_rng(0)
    drawn = rng.integers(0, size, (RESAMPLES, size))
    draws = np.stack([np.bincount(row, minlength=size) for row in drawn])
    rates = resampled(curve, draws, fragile.factor * mass.levels) @ mass.rates
    low, high = np.quantile(rates, (TAIL, 1.0 - TAIL)).tolist()
    return low, high


def _contributing(levels: Floats, parts: Floats) -> tuple[float, float, float]:
    """Return the levels below which 5, 50 and 95 % of a sum lie."""
    sums = np.cumsum(parts)
    first, half, last = (
        float(levels[min(int(np.searchsorted(sums, share * sums[-1])), len(levels) - 1)])
        for share in SHARES
    )
    return first, half, last


def why_unknown(risk: Risk) -> str:
    """Return why a rate is not known."""
    hazard = risk.hazard
    fragile = risk.fragile

    def where(level: float) -> str:
        share = float(fragile.at(level))
        falls = f"{chance(share)} fall" if share else "none falls"
        return f"{quantity(level, hazard.unit)}, where {falls}"

    first, last = fragile.first / fragile.factor, fragile.last / fragile.factor
    if risk.outside > MOST_OUTSIDE and fragile.slides:
        return f"above {quantity(last, hazard.unit)} it slides"
    if risk.outside > MOST_OUTSIDE:
        low = float(fragile.at(first)) * float(hazard.levels[0] < first)
        side, level = ("below", first) if low > 1.0 - float(fragile.at(last)) else ("above", last)
        return f"nothing is counted {side} {where(level)}"
    first, last = float(hazard.levels[0]), float(hazard.levels[-1])
    if float(fragile.at(first)) * hazard.rates[0] > MOST_OUTSIDE * risk.annual_rate:
        return f"the hazard curve begins at {where(first)}"
    return f"the hazard curve ends at {where(last)}"


def in_years(rate: float, years: float) -> float:
    """Return the probability of one event or more in some years, of an annual rate."""
    return -math.expm1(-rate * years)
