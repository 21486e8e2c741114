"""Risk: the annual rate of failure of an object under the hazard of its site."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from operator import itemgetter
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, number_or_none, quantity
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard._convolution import Integral, convolve
from rocksteady.risk.hazard._fragile import Converted, Fragile, Lognormal
from rocksteady.risk.hazard.hazard_curve import HIGHEST, HazardCurve
from rocksteady.risk.hazard.hazard_measures import (
    fragility_factor,
    intensity_named,
    measure_fact,
    written,
)
from rocksteady.seismic.measures.scalar import Measure

LONGEST_YEARS = 1e9
SHARES = (0.05, 0.5, 0.95)
"""Of the risk integral, at whose intensities it is divided."""
HCLPF_FACTOR = 1.645
"""Of both betas in the exponent of the HCLPF capacity."""
MUCH = 0.05
"""Share of the risk integral that is worth a sentence."""


def _rate(value: float) -> str:
    """Return a rate with the time between failures."""
    if not value > 1e-300:
        return f"{number(value)} a year"
    return f"{number(value)} a year, one in {number(1.0 / value)} years"


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Risk(Result):
    """Annual rate of failure of an object, from `rocksteady.compute_risk`.

    Attributes
    ----------
    fragility, hazard
        What was given.
    measure, factor
        The fragility's measure, and what an intensity of the hazard is multiplied by to be one.
    years, beta_u
        Time [years], and standard deviation of the logarithm of an unsure median.
    annual_rate
        Rate of failure [1/year].
    rate_below, rate_above
        What power-law tails of the hazard hold, below its first level and above its last [1/year];
        infinite where they have no bound.
    median, beta
        Median and beta of the fragility, in the hazard's unit; beta of a curve that is not
        lognormal is that from its median to its 5 %.
    k, closed_form_rate
        Slope of the hazard at the median, and H(median) exp(k^2 beta^2/2) [1/year]; nan where the
        hazard curve does not reach the median.
    hclpf
        median exp(-1.645(beta + beta_u)) in the hazard's unit: a 95 % confidence of less than 5 %.
    contributing
        Intensities below which 5, 50 and 95 % of the risk lie; infinite above the last level.
    contributions
        Rate of failure below the first level, between each two, and above the last [1/year].
    unsampled
        Share of the risk from intensities outside those of the fragility's runs; None where it
        does not state them.
    """

    fragility: Fragile
    hazard: HazardCurve
    measure: Measure
    factor: float
    years: float
    beta_u: Annotated[float, Label("beta_U", number)]
    annual_rate: Annotated[float, Label("Annual rate of failure", _rate)]
    rate_below: float
    rate_above: float
    median: Annotated[float, Label("Median capacity", plain=number_or_none)]
    beta: Annotated[float, Label(text=number, plain=number_or_none)]
    k: Annotated[float, Label("Slope k of the hazard at the median", number, plain=number_or_none)]
    closed_form_rate: Annotated[
        float, Label("H(median) exp(k^2 beta^2/2)", _rate, plain=number_or_none)
    ]
    hclpf: Annotated[float, Label("HCLPF capacity", plain=number_or_none)]
    contributing: Annotated[tuple[float, float, float], Label("", plain=number_or_none)]
    contributions: Floats
    unsampled: float | None
    remarks: tuple[str, ...] = ()

    @property
    def probability(self) -> Annotated[float, Label("Probability")]:
        """Probability of a failure in the time: 1 - exp(-rate T)."""
        return -math.expm1(-self.annual_rate * self.years)

    @property
    def survival(self) -> Annotated[float, Label("Survival", lambda p: f"{number(100.0 * p)} %")]:
        """Probability of none in the time: exp(-rate T)."""
        return math.exp(-self.annual_rate * self.years)

    @property
    def share_outside(self) -> float:
        """Share of the risk beyond the ends of the hazard curve, if those are power laws."""
        levels = float(self.contributions[1:-1].sum())
        outside = self.rate_below + self.rate_above
        return 1.0 if math.isinf(outside) else outside / (levels + outside) if outside else 0.0

    @checked
    def failure_probability(self, level: ArrayLike) -> Floats:
        """Return the probability of failure at intensities of the hazard, of their shape.

        Raises
        ------
        InputError
            If one is not positive.
        """
        return Converted(self.fragility, self.factor).probability(_positive(level))

    @checked
    def density(self, level: ArrayLike) -> Floats:
        """Return the rate of failure per unit of ln(intensity) [1/year], of the levels' shape.

        Between the ends of the hazard curve its integral is the annual rate from there.

        Raises
        ------
        InputError
            If a level is not positive, or beyond the ends of a curve without tails.
        """
        at = _positive(level)
        slopes = np.array([self.hazard.end_slopes[0], *self.hazard.slopes])
        slopes = np.append(slopes, self.hazard.end_slopes[1])
        # At an end of the curve the stretch inside counts.
        place = np.searchsorted(self.hazard.levels, at)
        place = np.where(at == self.hazard.levels[0], 1, place)
        density: Floats = self.hazard.rate(at) * slopes[place] * self.failure_probability(at)
        return density

    def describe(self) -> Description:
        """Return rate, probability, capacities and where the risk comes from."""
        label, unit = self.hazard.label, self.hazard.unit
        chance = f"{number(100.0 * self.probability)} % in {number(self.years)} years"
        facts = facts_of(
            self,
            measure_fact(self.hazard.intensity),
            "years annual_rate probability survival",
            Fact("return_period_years", self._return_period),
            "median beta beta_u hclpf k closed_form_rate contributing share_outside unsampled",
            Fact("", None, f"5, 50, 95 % of the risk below [{unit}]", self._contributing_words),
            probability=chance,
            median=_of(self.median, unit),
            hclpf=_of(self.hclpf, unit),
        )
        title = "Where the risk is"
        columns = (
            Column("low", f"{label} from"),
            Column("high", f"to [{unit}]"),
            Column("annual_rate", "1/year"),
            Column("share", "share of the risk", lambda part: f"{number(100.0 * part, 2)} %"),
        )
        return Description(
            headline=f"Fails at a rate of {number(self.annual_rate)} a year: {chance}",
            facts=facts,
            tables=[
                Table("contributions", self.rows(), columns, title, severity=itemgetter("share"))
            ],
            notes=list(self._notes()),
        )

    def rows(self) -> list[dict[str, Any]]:
        """Return the rate of failure between each two levels of the hazard, as rows."""
        ends = [None, *self.hazard.levels.tolist(), None]
        total = float(self.contributions.sum())
        return [
            {
                "low": ends[at],
                "high": ends[at + 1],
                "annual_rate": rate,
                "share": rate / total if total > 0.0 else 0.0,
            }
            for at, rate in enumerate(self.contributions.tolist())
        ]

    @property
    def _return_period(self) -> float | None:
        """Mean time between failures [years]; None where there are none."""
        return 1.0 / self.annual_rate if self.annual_rate > 1e-300 else None

    @property
    def _contributing_words(self) -> str:
        """Where the risk is, in words."""
        beyond = f"above {number(float(self.hazard.levels[-1]))}"
        return ", ".join(beyond if math.isinf(x) else number(x) for x in self.contributing)

    def _notes(self) -> Iterator[str]:
        """Yield what is to be known of the figures."""
        yield from self.remarks
        low, high = self.hazard.levels[0], self.hazard.levels[-1]
        ends = f"{number(low)} to {quantity(high, self.hazard.unit)}"
        percent = f"{number(100.0 * self.share_outside, 2)} %"
        if self.hazard.tail == "power-law":
            yield (
                f"The hazard curve has power-law tails: {percent} of the risk lie outside its "
                f"levels, {ends}."
            )
        else:
            yield (
                f"The hazard curve reaches from {ends}: shaking below it is left out, shaking "
                "above it counts with the probability at its last level. Were its ends power "
                f"laws, {percent} of the risk would lie outside"
                + (": compute the curve further out." if self.share_outside > MUCH else ".")
            )
        if self.unsampled is not None and self.unsampled > MUCH:
            yield (
                f"{number(100.0 * self.unsampled, 2)} % of the risk are from intensities that no "
                "trial of the fragility has: there the fitted curve alone counts."
            )
        if self.hazard.intensity.name == "pgv_m_s":
            yield (
                "A curve over PGV has no threshold of uplift: shaking too weak to lift the object "
                "counts as able to topple it, and the rate is too high rather than too low."
            )
        yield (
            "Failures are a Poisson process: independent, at a constant rate, the object set up "
            "again unchanged. The rate is of the fragility as given; beta_U is in the HCLPF alone."
        )


@checked
def compute_risk(
    fragility: FragilityCurve | tuple[float, float],
    hazard: HazardCurve,
    years: Annotated[float, Bounds(0.0, LONGEST_YEARS, "(]", "give a time in years")] = 50.0,
    *,
    measure: Measure | str | None = None,
    block: Block | None = None,
    beta_u: Annotated[float, Bounds(0.0, 20.0, "[]", "give 0, or .2 to .4")] = 0.0,
) -> Risk:
    r"""Compute the annual rate of failure of an object under a hazard curve.

    The rate is the integral of the probability of failure over the rate of shaking,
    :math:`\int P(x)\,|dH(x)|`, to 1e-9 of itself.  Shaking above the last level counts with the
    probability there; ``hazard.extended()`` gives the curve power-law tails.

    Parameters
    ----------
    fragility
        A fitted curve, or (median, beta) of a lognormal one.  Rates of counted shares, those of a
        `Fragility`, are not computed.
    hazard
        The hazard curve of the site.
    years
        Time of the probability [years]; default 50.
    measure
        What the fragility is over: an `Measure`, or its text as ``"sa_g:1.0"`` or, with a block,
        ``"p_pgv_per_uplift"``; default None, the hazard's own.
    block
        Block of a fragility over a dimensionless measure; none by default.
    beta_u
        Standard deviation of the logarithm of the median, which is not known well; default 0.  It
        lowers the HCLPF capacity alone: the rate is that of the fragility as it is.  For the mean
        rate give a fragility with beta sqrt(beta^2 + beta_u^2).

    Returns
    -------
    Risk
        Rate, probability, survival, HCLPF capacity, closed form, and where the risk comes from.

    Raises
    ------
    InputError
        If the measures do not fit, the curve does not rise, or its tail has no finite integral.

    References
    ----------
    C. A. Cornell, F. Jalayer, R. O. Hamburger and D. A. Foutch, J. Struct. Eng. 128, 526-533
    (2002), of the closed form; R. P. Kennedy and M. K. Ravindra, Nucl. Eng. Des. 79, 47-68 (1984),
    of the HCLPF capacity.

    Examples
    --------
    >>> from rocksteady import compute_risk
    >>> from rocksteady.risk import HazardCurve
    >>> hazard = HazardCurve(measure="pgv_m_s", levels=[0.001, 100.0], rates=[100.0, 1e-8])
    >>> risk = compute_risk((0.4653, 0.592), hazard)
    >>> print(f"{risk.annual_rate:.5f} {risk.closed_form_rate:.5f} {risk.hclpf:.4f}")
    0.00093 0.00093 0.1757
    """
    curve, words, remarks = fragility_over(fragility, hazard, measure, block)
    integral = failure_integral(curve, hazard)
    median, beta = curve.quantile(0.5), curve.beta if curve.quantile(0.5) > 0.0 else math.nan
    k, closed = _closed_form(hazard, median, beta)
    return Risk(
        fragility=curve.curve,
        hazard=hazard,
        measure=words,
        factor=curve.factor,
        years=years,
        beta_u=beta_u,
        annual_rate=integral.total,
        rate_below=integral.below,
        rate_above=integral.above,
        median=median,
        beta=beta,
        k=k,
        closed_form_rate=closed,
        hclpf=median * math.exp(-HCLPF_FACTOR * (beta + beta_u)),
        contributing=(integral.quantile(0.05), integral.quantile(0.5), integral.quantile(0.95)),
        contributions=integral.between(hazard.levels),
        unsampled=(
            None
            if curve.sampled is None
            else integral.share_outside(curve.sampled, float(hazard.levels[-1]))
        ),
        remarks=remarks,
    )


def fragility_over(
    fragility: FragilityCurve | tuple[float, float],
    hazard: HazardCurve,
    measure: Measure | str | None,
    block: Block | None,
) -> tuple[Converted, Measure, tuple[str, ...]]:
    """Return a fragility over the measure of a hazard, its own measure, and remarks.

    Raises
    ------
    InputError
        If the measures do not fit, or the fragility does not rise.
    """
    remarks = []
    given = _fragile(fragility)
    if measure is None:
        words = hazard.intensity
        name, kind = given.measure if isinstance(given, FragilityCurve) else ("", "")
        if kind != hazard.unit and name not in ("", "intensity"):
            raise InputError(
                "fragility",
                f"a curve over {name}",
                f"the hazard curve is over {hazard.label} [{hazard.unit}]",
                f"fit the fragility over {written(hazard.intensity)}, or give measure= and block= "
                "where the block makes one of the other",
            )
        if name != hazard.label:
            remarks.append(
                f"No measure is given: the fragility is taken to be over {hazard.label} "
                f"[{hazard.unit}], as the hazard is."
            )
    else:
        words = intensity_named("measure", measure)
    curve = Converted(given, fragility_factor(words, hazard.intensity, block))
    status = given.status if isinstance(given, FragilityCurve) else "fitted"
    if status == "not-rising":
        raise InputError(
            "fragility",
            status,
            "its probability of failure does not rise with the intensity",
            "fit it over another measure, or to more runs",
        )
    if status in ("never", "always"):
        remarks.append(
            "No trial of the fragility fails, or every one does: beyond the trials its probability "
            "is unknown and counts as 1, and the rate is an upper bound."
        )
    return curve, words, tuple(remarks)


def _fragile(given: object) -> Fragile:
    """Return what has a probability at each intensity, or raise."""
    if isinstance(given, FragilityCurve):
        return given
    if isinstance(given, tuple) and len(given) == 2:
        return Lognormal(*given)
    raise InputError(
        "fragility",
        Words("is counted") if isinstance(given, Fragility) else given,
        "rates are those of a FragilityCurve or of (median, beta), not of counted shares",
        "fit a curve to them, or give (median, beta)",
    )


def failure_integral(curve: Converted, hazard: HazardCurve) -> Integral:
    """Return the risk integral of a fragility over a hazard curve.

    Raises
    ------
    InputError
        If the hazard's lower tail rises faster than the fragility falls.
    """
    integral = convolve(curve.probability, curve.knots, hazard)
    if hazard.tail == "power-law" and math.isinf(integral.below):
        raise InputError(
            "tail",
            hazard.tail,
            "below its first level the hazard rises faster than the fragility falls, and the risk "
            "is infinite",
            "leave the hazard curve without tails",
        )
    return integral


def _closed_form(hazard: HazardCurve, median: float, beta: float) -> tuple[float, float]:
    """Return k, from beta below the median to beta above it, and the closed form of the rate."""
    inside = hazard.levels[0] <= median <= hazard.levels[-1]
    if not (inside or (hazard.tail == "power-law" and 0.0 < median < math.inf)):
        return math.nan, math.nan
    reach = max(beta, 1e-3)
    ends = median * np.exp(np.array([-reach, reach]))
    if hazard.tail == "none":
        ends = np.clip(ends, hazard.levels[0], hazard.levels[-1])
    low, high = np.log(hazard.rate(ends))
    k = float(low - high) / math.log(ends[1] / ends[0])
    return k, float(hazard.rate(median)) * math.exp(min(0.5 * (k * beta) ** 2, 700.0))


def _positive(level: ArrayLike) -> Floats:
    """Return intensities, or raise where one is not above 0."""
    at = real_array("level", level)
    bad = ~((at > 0.0) & (at <= HIGHEST))
    if bad.any():
        valid = f"it must lie in (0, {HIGHEST:g}]"
        raise InputError("level", at[bad].flat[0].item(), valid, "give an intensity")
    return at


def _of(value: float, unit: str) -> str:
    """Return a quantity, or a dash where there is none."""
    return quantity(value, unit) if math.isfinite(value) else "—"
