"""Fragility in two stages: whether an object uplifts, and whether it then fails."""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import positive
from rocksteady.results.description import Description, Fact
from rocksteady.results.doubts import with_misfit
from rocksteady.results.numbers import number, number_or_none
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of
from rocksteady.risk.fits._banding import PriorRange, spread_of
from rocksteady.risk.fits._maximum import Maximum, maximum_of
from rocksteady.risk.fits._status import ALWAYS, FITTED, SEPARATED
from rocksteady.risk.fits._stripes import Row, compare_stripes, stripe_table
from rocksteady.risk.fits._trial_counts import SAME_LEVEL, counts_of, same_length, values_of
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
from rocksteady.risk.fits.fragility_curve import FragilityCurve, band_facts, curve_of

ROUNDING = 1e-9
"""Of ln im at the ends of the search for a quantile."""
LEAST_GAIN = 1e-6
"""Of a log-likelihood: what is below it is rounding."""
FARTHEST = 3.0
STEPS = 121
"""How far from the median, in ln im, the band's ends are searched for .5, and in how many steps."""


def _stage(words: str) -> Label:
    """Return the label of a curve with facts of its own."""
    return Label(words, lambda curve: curve.describe().headline, plain=FragilityCurve.to_dict)


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class TwoStageCurve(Result):
    """Fragility curve in two stages, from `rocksteady.risk.fit_two_stages`.

    P(failure | im) = P(uplift | im) P(failure | uplift, im - offset).

    Attributes
    ----------
    uplift, given_uplift
        The curves of the two factors; the second is fitted to trials with uplift alone, and its
        intensity is im - offset.
    plain
        One curve without stages.
    log_likelihood
        Log-likelihood of both stages together: of the three outcomes of each trial.
    gain
        What two stages add to the log-likelihood of the failures alone; NaN where the product is
        unknown.
    misfit
        Largest difference of the share of failures and the product over the stripes.
    stripes
        Intensity, trials, failures and probability of each stripe.
    sampled
        Lowest and highest intensity.
    median_band
        Confidence interval of the median, where the band crosses .5; None without.
    bands, spread
        Options of the bands, and redrawn suites of both stages; None without.
    measure
        Name and unit of the intensity.
    warnings
        Sentences on what limits the curves.
    gate
        Intensity of uplift, where it is known exactly; None otherwise.
    offset
        The gate where the second stage is a curve of the excess over it, im - gate; 0 otherwise.

    Examples
    --------
    >>> from rocksteady.risk import fit_two_stages
    >>> curve = fit_two_stages([0.2, 0.4, 0.8], [0, 15, 15], [0, 9, 14], [15, 15, 15])
    >>> curve.uplift.status, curve.given_uplift.status
    ('separated', 'fitted')
    """

    uplift: Annotated[FragilityCurve, _stage("uplift")]
    given_uplift: Annotated[FragilityCurve, _stage("failure given uplift")]
    plain: Annotated[FragilityCurve, _stage("one curve")]
    log_likelihood: Annotated[float, LOG_LIKELIHOOD]
    gain: Annotated[float, Label("gain over one curve", number, plain=number_or_none)]
    misfit: Annotated[float, MISFIT]
    stripes: tuple[Row, ...]
    sampled: Annotated[tuple[float, float], Label()]
    median_band: tuple[float, float] | None = None
    bands: BandOptions | None = None
    spread: PriorRange | None = None
    measure: tuple[str, str] = ("intensity", "")
    warnings: tuple[str, ...] = ()
    gate: float | None = None
    offset: float = 0.0

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of failure at intensities.

        Parameters
        ----------
        intensity
            0 or above, of any shape.

        Returns
        -------
        ndarray
            The product, of the same shape; 0 where one factor is, NaN where a factor is unknown.
            Fitted stages go on beyond `sampled` as their family does.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        at = intensities(intensity)
        first, second = self._lifts(at), self.given_uplift.probability(self._excess(at))
        return np.where((first == 0.0) | (second == 0.0), 0.0, first * second)

    @property
    def best(self) -> "FragilityCurve | TwoStageCurve":
        """The curve of all runs: in stages where these gain or the gate is exact."""
        return self if self.gate is not None or self.gain > LEAST_GAIN else self.plain

    def over(self, given_uplift: bool) -> "FragilityCurve | TwoStageCurve":
        """Return the curve to use: that of the runs that lift, or the best one of all runs."""
        return self.given_uplift if given_uplift else self.best

    @property
    def median(self) -> Annotated[float, MEDIAN]:
        """Intensity of probability .5, the root of the product; NaN without one."""
        return self.quantile(0.5)

    def probability_band(self, intensity: ArrayLike) -> tuple[Floats, Floats] | None:
        """Return the confidence band of the probability at intensities.

        Parameters
        ----------
        intensity
            0 or above, of any shape.

        Returns
        -------
        tuple of ndarray or None
            Lower and upper end, each of the same shape; None without bands.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        at = intensities(intensity)
        if self.spread is None:
            return None
        low, high = self.spread.probability(self._excess(at))
        return (low, high) if self.gate is None else (low * self._lifts(at), high * self._lifts(at))

    def _lifts(self, at: Floats) -> Floats:
        """Return the probability of uplift; for an exact gate 0 at the gate itself."""
        return (
            self.uplift.probability(at) if self.gate is None else np.where(at > self.gate, 1.0, 0.0)
        )

    def _excess(self, at: Floats) -> Floats:
        """Return the intensity of the second stage, 0 up to the offset."""
        return np.maximum(at - self.offset, 0.0)

    def quantile(self, probability: float) -> float:
        """Return the intensity of a probability.

        Parameters
        ----------
        probability
            In (0, 1).

        Returns
        -------
        float
            Where a step jumps over the probability, the step; NaN without a curve, infinite where
            a flat one reaches it at no number.
        """
        from scipy.optimize import brentq

        p = SHARE("probability", probability)
        stages = [s for s in (self.uplift, self.given_uplift) if s.status != ALWAYS]
        if any(s.status not in (FITTED, SEPARATED) for s in stages) or not stages:
            return math.nan
        if self.gate is not None:
            return max([self.gate, *(self.offset + stage.quantile(p) for stage in stages[1:])])
        # The product is below each factor, and above p where both are above the root of p.
        low = max(stage.quantile(p) for stage in stages)
        if len(stages) == 1 or any(stage.status == SEPARATED for stage in stages):
            return low
        high = max(stage.quantile(math.sqrt(p)) for stage in stages)

        def excess(log_intensity: float) -> float:
            return float(self.probability(math.exp(log_intensity))) - p

        top = math.log(sys.float_info.max)
        low, high = math.log(low) - ROUNDING, min(math.log(high) + ROUNDING, top)
        if high == top and excess(high) < 0.0:  # a nearly flat stage
            return math.inf
        return math.exp(brentq(excess, low, high, xtol=1e-14, rtol=1e-14, maxiter=1000))

    def describe(self) -> Description:
        """Return both stages, the product and the plain curve's misfit."""
        name, unit = self.measure
        facts = facts_of(
            self,
            measure_fact(self.measure),
            "median median_band",
            *band_facts(self.bands),
            *self._gate_facts(),
            "uplift given_uplift plain log_likelihood gain misfit",
            Fact("", None, "the same of one curve", number(self.plain.misfit)),
            "sampled warnings",
            median=value_words(self.median, unit, self.median_band),
            sampled=range_words(self.sampled, unit),
        )
        return Description(
            headline=with_misfit(
                f"{name}: median {value_words(self.median, unit, None)} in two stages", self.misfit
            ),
            facts=facts,
            tables=[stripe_table(self.stripes)],
            notes=list(self.warnings),
        )

    def _gate_facts(self) -> list[Fact]:
        """Return the gate and what the second stage is over; words where the gate is exact."""
        if self.gate is None:
            return [Fact("gate", None), Fact("offset", self.offset)]
        name, unit = self.measure
        over = self.given_uplift.measure[0]
        kept, compared = (
            (f"the excess over uplift, {over}", name) if self.offset else (name, "the excess")
        )
        middle = value_words(self.given_uplift.median, unit, self.given_uplift.median_band)
        return [
            Fact("gate", self.gate, "uplift above", value_words(self.gate, unit, None)),
            Fact(
                "offset",
                self.offset,
                "second stage",
                f"in {kept}, at least as likely as in {compared}",
            ),
            Fact("", None, f"median of {kept}" if self.offset else "median given uplift", middle),
        ]


@checked
def fit_two_stages(
    intensity: ArrayLike,
    uplifted: ArrayLike,
    failures: ArrayLike,
    trials: ArrayLike | None = None,
    *,
    family: Literal["lognormal", "logistic"] = "lognormal",
    groups: ArrayLike | Sequence[str] | None = None,
    bands: BandOptions | None = None,
    measure: tuple[str, str] = ("intensity", ""),
) -> TwoStageCurve:
    """Fit fragility in two stages, uplift and failure given uplift.

    Each stage is a curve of the largest likelihood, which are independent of each other as the
    likelihood of a trial is a product: P(stands), P(uplift) P(rocks | uplift) or P(uplift)
    P(fails | uplift).

    Where the intensity of uplift is known exactly, the second stage is a curve of the excess over
    it, P(fails | uplift) = F(ln((im - gate)/median)/beta), which is 0 at the gate, or a curve of
    im as otherwise, whichever has the larger likelihood; both have two parameters.

    Parameters
    ----------
    intensity
        Intensity of each observation, above 0, shape (n,).
    uplifted
        Number of trials with uplift in each observation, shape (n,); where the gate is exact, its
        intensity, a number: trials above it lift, and no others.
    failures
        Number of these with failure, shape (n,).
    trials
        Their number in each observation, shape (n,); default 1 each.
    family
        Distribution of ln im of both; default "lognormal".
    groups
        Record of each observation, as for `rocksteady.risk.fit_curve`.
    bands
        Options of the confidence bands; default none.
    measure
        Name and unit of the intensity, for texts, as ("PGA", "g").

    Returns
    -------
    TwoStageCurve
        With one curve without stages beside it.

    Raises
    ------
    InputError
        As for `rocksteady.risk.fit_curve`, and if failures are above uplifted or a gate is not
        above 0.

    Examples
    --------
    A gate at 0.3, above which half of the trials fail at 0.6:

    >>> from rocksteady.risk import fit_two_stages
    >>> curve = fit_two_stages(
    ...     [0.2, 0.4, 0.8, 1.6], [0, 40, 40, 40], [0, 9, 27, 39], [40, 40, 40, 40]
    ... )
    >>> curve.uplift.status, curve.uplift.step, f"{curve.median:.3f}"
    ('separated', (0.2, 0.4), '0.608')

    The same of a block that lifts above 0.3 exactly:

    >>> curve = fit_two_stages([0.2, 0.4, 0.8, 1.6], 0.3, [0, 4, 30, 39], [40, 40, 40, 40])
    >>> curve.offset, f"{curve.median:.3f}", curve.probability([0.3, 0.4]).round(2)
    (0.3, '0.584', array([0. , 0.1]))
    """
    at = values_of("intensity", intensity, positive=True)
    gate = None
    if np.ndim(uplifted) == 0:
        gate = positive("uplifted", uplifted, hint="give the intensity above which trials lift")
        tried = np.ones_like(at) if trials is None else values_of("trials", trials)
        same_length("trials", len(tried), len(at))
        uplifted = np.where(at > gate, tried, 0.0)
    given = (("trials", trials), ("uplifted", uplifted), ("failures", failures))
    stages = counts_of(at, given, groups)
    (whole,) = counts_of(at, (given[0], given[2]), groups)
    best, offset = [maximum_of(counts, family) for counts in stages], 0.0
    name, unit = measure
    if gate is not None:
        best, offset = _behind_gate(best, gate)
    over = (f"{name} - {value_words(offset, unit, None)}", unit) if offset else measure
    uplift, given_uplift = (
        curve_of(stage, family, label, bands)
        for stage, label in zip(best, (measure, over), strict=True)
    )
    single = curve_of(maximum_of(whole, family), family, measure, bands)
    if gate is None:
        spread, sentences = spread_of(best, bands)
    else:  # the first stage is certain, and what limits the second one is among its sentences
        spread, sentences = given_uplift.spread, []
        few = [text for text in uplift.warnings if "separated" not in text]
        uplift = replace(uplift, warnings=tuple(few))
    limits = (f"uplift: {sentence}" for sentence in uplift.warnings)
    given_limits = (f"failure given uplift: {sentence}" for sentence in given_uplift.warnings)
    curve = TwoStageCurve(
        uplift=uplift,
        given_uplift=given_uplift,
        plain=single,
        log_likelihood=uplift.log_likelihood + given_uplift.log_likelihood,
        gain=math.nan,
        misfit=math.nan,
        stripes=(),
        sampled=single.sampled,
        bands=bands if spread else None,
        spread=spread,
        measure=measure,
        warnings=(*limits, *given_limits, *sentences),
        gate=gate,
        offset=offset,
    )
    share = curve.probability(whole.levels)
    rows, misfit = compare_stripes(whole, share)
    gain = _likelihood(share, *whole.totals) - single.log_likelihood
    middle = curve.median if gate is None else given_uplift.median
    band = None if spread is None else _crossings(spread, middle)
    if band is not None and gate is not None:
        band = max(gate, offset + band[0]), max(gate, offset + band[1])
    return replace(curve, gain=gain, stripes=rows, misfit=misfit, median_band=band)


def _likelihood(share: Floats, failures: Floats, trials: Floats) -> float:
    """Return the log-likelihood of single trials with given probabilities; NaN of unknown ones."""
    from scipy.special import xlog1py, xlogy

    return float((xlogy(failures, share) + xlog1py(trials - failures, -share)).sum())


def _behind_gate(stages: Sequence[Maximum], gate: float) -> tuple[list[Maximum], float]:
    """Return both stages behind an exact gate, and the offset of the second one.

    The second is that of the larger likelihood: of the excess over the gate, or of the intensity.
    """
    uplift, whole = stages
    counts = whole.counts
    excess = np.maximum(counts.levels - gate, SAME_LEVEL * gate)
    shifted = maximum_of(replace(counts, levels=excess), whole.name)
    exact = replace(uplift, status=SEPARATED, step=(gate, gate))
    if shifted.log_likelihood >= whole.log_likelihood:
        return [exact, shifted], gate
    return [exact, whole], 0.0


def _crossings(spread: PriorRange, median: float) -> tuple[float, float] | None:
    """Return where the ends of the band cross .5 next to the median; None where one does not."""
    from scipy.optimize import brentq

    if math.isnan(median):
        return None

    def excess(logs: ArrayLike, end: int) -> Floats:
        return spread.probability(np.exp(np.asarray(logs)))[end] - 0.5

    sides = []
    for end, away in ((1, -1.0), (0, 1.0)):
        logs = math.log(median) + away * np.linspace(0.0, FARTHEST, STEPS)
        beyond = away * excess(logs, end) > 0.0
        first = int(np.argmax(beyond))
        if not beyond[first]:
            return None
        if first == 0:  # a step, on both sides of .5
            sides.append(median)
            continue
        low, high = sorted((float(logs[first - 1]), float(logs[first])))
        root = brentq(lambda at, side=end: float(excess(at, side)), low, high, xtol=1e-12)
        sides.append(math.exp(root))
    return sides[0], sides[1]
