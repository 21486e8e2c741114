"""Fragility curves by maximum likelihood: the probability of an event against intensity."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.results.description import Description, Fact
from rocksteady.results.doubts import FEW_RECORDS, NOT_IDENTIFIED, with_misfit
from rocksteady.results.numbers import number, number_or_none, plural
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of
from rocksteady.risk.fits._banding import PriorRange, spread_of
from rocksteady.risk.fits._goodness import goodness_of
from rocksteady.risk.fits._likelihood import family_of
from rocksteady.risk.fits._maximum import Maximum, maximum_of
from rocksteady.risk.fits._status import ALWAYS, FITTED, NEVER, NOT_RISING, SEPARATED
from rocksteady.risk.fits._stripes import Row, compare_stripes, stripe_table
from rocksteady.risk.fits._trial_counts import counts_of, values_of
from rocksteady.risk.fits._values import (
    LOG_LIKELIHOOD,
    MEDIAN,
    MISFIT,
    SHARE,
    intensities,
    measure_fact,
    range_words,
    value_words,
)
from rocksteady.risk.fits.bands import BandOptions


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class FragilityCurve(Result):
    """Fragility curve P(failure | im), from `rocksteady.risk.fit_curve`.

    P = F((ln im - ln median)/beta), F the normal distribution [1]_ or the logistic one.

    Attributes
    ----------
    family
        "lognormal" or "logistic".
    status
        "fitted"; "separated": a step; "never" and "always": without a failure, without a survival;
        "not-rising": failures lie at no higher intensities than survivals, and no curve is forced.
    median
        Intensity of probability .5; for a step the geometric mean of its two sides; NaN without a
        curve.
    beta
        Standard deviation of ln im (lognormal) or its scale (logistic); NaN of a step, which does
        not identify it, and without a curve.
    step
        Highest intensity with a survival and lowest with a failure; None unless separated.
    log_likelihood
        Log-likelihood of single trials: binomial coefficients are left out, so that grouping does
        not matter.
    deviance
        Twice the log-likelihood that the shares at each distinct intensity have above the curve.
    misfit
        Largest difference of share and curve over the stripes; NaN without a curve.
    goodness
        Probability of a departure as large by chance; None where it cannot be computed.
    trials, failures, records
        Their numbers.
    sampled
        Lowest and highest intensity; 0 without trials.
    stripes
        Intensity, trials, failures and probability of each stripe, None without a curve.
    median_band, beta_band
        Confidence intervals (low, high); None without.
    bands, spread
        Options of the bands, and redrawn suites; None without.
    measure
        Name and unit of the intensity.
    warnings
        Sentences on what limits the curve.

    Examples
    --------
    >>> from rocksteady.risk import fit_curve
    >>> curve = fit_curve([0.2, 0.4, 0.8], [1, 9, 14], [15, 15, 15])
    >>> print(curve.status, f"{curve.median:.3f} {curve.beta:.3f}")
    fitted 0.376 0.459

    References
    ----------
    .. [1] J. W. Baker, Earthquake Spectra 31, 579-599 (2015), equations 11 and 12.
    """

    family: Annotated[str, Label()]
    status: Annotated[str, Label()]
    median: Annotated[float, MEDIAN]
    beta: Annotated[float, Label(plain=number_or_none)]
    step: tuple[float, float] | None = None
    log_likelihood: Annotated[float, LOG_LIKELIHOOD]
    deviance: Annotated[float, Label()]
    misfit: Annotated[float, MISFIT]
    goodness: Annotated[float | None, Label("goodness of fit, p-value")] = None
    trials: Annotated[int, Label()]
    failures: Annotated[int, Label()]
    records: Annotated[int, Label()]
    sampled: Annotated[tuple[float, float], Label()]
    stripes: tuple[Row, ...]
    median_band: tuple[float, float] | None = None
    beta_band: tuple[float, float] | None = None
    bands: BandOptions | None = None
    spread: PriorRange | None = None
    measure: tuple[str, str] = ("intensity", "")
    warnings: tuple[str, ...] = ()

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of failure at intensities.

        Parameters
        ----------
        intensity
            0 or above, of any shape.

        Returns
        -------
        ndarray
            Probability, of the same shape.  A step has .5 at its median.  Without a failure it is 0
            up to the highest intensity, without a survival 1 from the lowest on, and NaN elsewhere
            and of data that do not rise.  A fitted curve goes on beyond `sampled` as its family
            does.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        at = intensities(intensity)
        if self.status == SEPARATED:
            return np.select([at < self.median, at > self.median], [0.0, 1.0], 0.5)
        if self.status == NEVER:
            return np.where(at <= self.sampled[1], 0.0, math.nan)
        if self.status == ALWAYS:
            return np.where(at >= self.sampled[0], 1.0, math.nan)
        if self.status == NOT_RISING:
            return np.full(at.shape, math.nan)
        with np.errstate(divide="ignore", over="ignore"):  # of ln 0 the probability is 0
            eta = (np.log(at) - math.log(self.median)) / self.beta
        return np.asarray(family_of(self.family).cdf(eta))

    def probability_band(self, intensity: ArrayLike) -> tuple[Floats, Floats] | None:
        """Return the confidence band of the probability at intensities.

        Parameters
        ----------
        intensity
            0 or above, of any shape.

        Returns
        -------
        tuple of ndarray or None
            Lower and upper end, each of the same shape; None without bands.  For a step they are
            0 and 1 between its sides; without a failure the upper end, without a survival the
            lower one, is a bound from one side, of that confidence.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        at = intensities(intensity)
        return None if self.spread is None else self.spread.probability(at)

    def quantile(self, probability: float) -> float:
        """Return the intensity of a probability.

        Parameters
        ----------
        probability
            In (0, 1).

        Returns
        -------
        float
            NaN without a curve, infinite where a flat one reaches it at no number.
        """
        p = SHARE("probability", probability)
        if self.status != FITTED:
            return self.median
        eta = float(family_of(self.family).quantile(np.array(p)))
        try:
            return self.median * math.exp(self.beta * eta)
        except OverflowError:
            return math.inf

    @property
    def aic(self) -> float:
        """Akaike's criterion, 2 q - 2 ln L, with the q = 2 coefficients of a curve."""
        return 4.0 - 2.0 * self.log_likelihood

    @property
    def log_likelihood_per_trial(self) -> float:
        """The log-likelihood over the number of trials: measures of one ensemble compare by it."""
        return self.log_likelihood / self.trials if self.trials else 0.0

    def describe(self) -> Description:
        """Return the curve, its bands and its stripes."""
        unit = self.measure[1]
        beta = value_words(self.beta, "", self.beta_band)
        facts = facts_of(
            self,
            measure_fact(self.measure),
            "family status median beta median_band beta_band",
            *band_facts(self.bands),
            "step log_likelihood deviance misfit goodness trials failures records sampled warnings",
            median=value_words(self.median, unit, self.median_band),
            beta=NOT_IDENTIFIED if math.isnan(self.beta) else beta,
            sampled=range_words(self.sampled, unit),
        )
        return Description(
            headline=self._headline(),
            facts=facts,
            tables=[stripe_table(self.stripes)],
            notes=list(self.warnings),
        )

    def _headline(self) -> str:
        """Return the curve in a line."""
        name, unit = self.measure
        low, high = (value_words(end, unit, None) for end in self.sampled)
        if self.status == FITTED:
            return with_misfit(
                f"{self.family} in {name}: median {value_words(self.median, unit, None)}, "
                f"beta {number(self.beta)}, {plural(self.records, 'record')}",
                self.misfit,
            )
        if self.step is not None:
            ends = list(dict.fromkeys(value_words(end, unit, None) for end in self.step))
            place = f"between {' and '.join(ends)}" if len(ends) > 1 else f"at {ends[0]}"
            return f"step in {name} {place}"
        if self.status == NEVER:
            return f"no failure in {plural(self.trials, 'trial')}, {name} up to {high}"
        if self.status == ALWAYS:
            return f"no survival in {plural(self.trials, 'trial')}, {name} from {low}"
        return f"no curve: failures do not become more frequent with {name}"


@checked
def fit_curve(
    intensity: ArrayLike,
    failures: ArrayLike,
    trials: ArrayLike | None = None,
    *,
    family: Literal["lognormal", "logistic"] = "lognormal",
    groups: ArrayLike | Sequence[str] | None = None,
    bands: BandOptions | None = None,
    within: tuple[float, float] | None = None,
    measure: tuple[str, str] = ("intensity", ""),
) -> FragilityCurve:
    """Fit a fragility curve to counts of failures by maximum likelihood.

    P = F((ln im - ln median)/beta), F the normal distribution [1] or the logistic one.  Labels
    enter as they are, in any order, and are not made monotone.

    Parameters
    ----------
    intensity
        Intensity of each observation, above 0, shape (n,).
    failures
        Their number in each observation, shape (n,).
    trials
        Their number in each observation, shape (n,); default 1 each.
    family
        Distribution of ln im; default "lognormal".
    groups
        Record of each observation, as numbers or names, shape (n,): trials of one record depend on
        each other, and bands draw records.  Default: each trial is a record of its own.
    bands
        Options of the confidence bands; default none.
    within
        Lowest and highest intensity that enter; default all.
    measure
        Name and unit of the intensity, for texts, as ("PGV", "m/s").

    Returns
    -------
    FragilityCurve
        Its status marks data that have no such curve.

    Raises
    ------
    InputError
        If a row is empty or of another length, an intensity is not finite and above 0, a count is
        no whole number from 0, or failures are above trials; the message has the place.

    References
    ----------
    .. [1] J. W. Baker, Earthquake Spectra 31, 579-599 (2015), equations 11 and 12.

    Examples
    --------
    >>> from rocksteady.risk import fit_curve
    >>> curve = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40, 40, 40, 40])
    >>> print(f"{curve.median:.3f} {curve.beta:.3f}")
    0.591 0.582
    """
    at = values_of("intensity", intensity, positive=True)
    counts = (("trials", trials), ("failures", failures))
    (stage,) = counts_of(at, counts, groups, within)
    return curve_of(maximum_of(stage, family), family, measure, bands)


def curve_of(
    best: Maximum, family: str, measure: tuple[str, str], bands: BandOptions | None
) -> FragilityCurve:
    """Return the result of a maximum."""
    spread, sentences = spread_of([best], bands)
    drawn = spread.drawn if spread else None
    median, beta = math.nan, math.nan
    if best.status == FITTED:
        a, b = best.coefficients
        median, beta = math.exp(best.centre - best.scale * a / b), best.scale / float(b)
    elif best.step is not None:
        low, high = best.step  # at one level with both outcomes that level, to the last bit
        median = low if low == high else math.sqrt(low) * math.sqrt(high)
    failures, trials = (counts.sum() for counts in best.counts.totals)
    levels = best.counts.levels
    flat = best.status == NOT_RISING
    shares = np.full(len(levels), math.nan) if flat else best.shares
    rows, misfit = compare_stripes(best.counts, shares)
    return FragilityCurve(
        family=family,
        status=best.status,
        median=median,
        beta=beta,
        step=best.step,
        log_likelihood=best.log_likelihood,
        deviance=best.deviance,
        misfit=misfit,
        trials=int(trials),
        failures=int(failures),
        records=best.counts.records,
        sampled=(float(levels[0]), float(levels[-1])) if len(levels) else (0.0, 0.0),
        goodness=goodness_of(best),
        stripes=rows,
        median_band=drawn.median() if drawn else None,
        beta_band=drawn.beta() if drawn else None,
        bands=bands if spread else None,
        spread=spread,
        measure=measure,
        warnings=(*warnings_of(best, measure), *sentences),
    )


def band_facts(bands: BandOptions | None) -> list[Fact]:
    """Return what the bands are; nothing without."""
    if bands is None:
        return []
    words = f"{number(100.0 * bands.confidence)} %, {plural(bands.replicates, 'redrawn suite')}"
    return [
        Fact("confidence", bands.confidence, "bands", words),
        Fact("replicates", bands.replicates),
        Fact("seed", bands.seed),
    ]


def warnings_of(best: Maximum, measure: tuple[str, str]) -> list[str]:
    """Return what limits a curve."""
    name, unit = measure
    records, levels = best.counts.records, best.counts.levels
    sentences = []
    if best.status == NOT_RISING and len(levels) == 1:
        sentences.append(f"one {name} alone shows no rise: a curve needs two or more")
    elif best.status == NOT_RISING:
        sentences.append(f"failures do not become more frequent with {name}: no curve is fitted")
    elif best.status == NEVER and len(levels):
        highest = value_words(float(levels[-1]), unit, None)
        sentences.append(f"no trial fails: the median is above the highest {name}, {highest}")
    elif best.status == NEVER:
        sentences.append("there is no trial, and nothing is known")
    elif best.status == ALWAYS:
        lowest = value_words(float(levels[0]), unit, None)
        sentences.append(f"every trial fails: the median is below the lowest {name}, {lowest}")
    elif best.status == SEPARATED:
        sentences.append(f"failures and survivals are separated in {name}: the curve is a step")
    if records < FEW_RECORDS:
        few = f"{plural(records, 'record')}, fewer than {FEW_RECORDS}"
        sentences.append(f"{few}: another suite may give another curve")
    return sentences
