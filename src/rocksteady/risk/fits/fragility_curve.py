"""Fragility curves by maximum likelihood: the probability of an event against intensity."""

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import non_negative
from rocksteady.results.numbers import number_or_none
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.fits._totals import Totals, totals_of
from rocksteady.risk.fits.maximum import ALWAYS, FITTED, NEVER, NOT_RISING, SEPARATED, maximum_of

Row = tuple[float, int, int, float | None]
FEWEST = 10
"""Trials of a stripe, on average, and the number of stripes that are made otherwise."""


SHARE = Bounds(0.0, 1.0, "()", "give a share, as 0.5")
QUANTILE = 1.645
"""Standard normal deviate of 95 %, with the digits of its source."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class FragilityCurve(Result):
    """Fragility curve P(failure | im), from `rocksteady.risk.fit_curve`.

    P = F((ln im - ln median)/beta), F the normal distribution [1]_.

    Attributes
    ----------
    status
        "fitted"; "separated": a step; "never" and "always": without a failure, without a survival;
        "not-rising": failures lie at no higher intensities than survivals, and no curve is forced.
    median
        Intensity of probability .5; for a step the geometric mean of its two sides; NaN without a
        curve.
    beta
        Standard deviation of ln im; NaN of a step, which does not identify it, and without a curve.
    step
        Highest intensity with a survival and lowest with a failure; None unless separated.
    log_likelihood
        Log-likelihood of single trials: binomial coefficients are left out, so that grouping does
        not matter.
    misfit
        Largest difference of share and curve over the stripes; NaN without a curve.
    trials, failures
        Their numbers.
    sampled
        Lowest and highest intensity.
    stripes
        Intensity, trials, failures and probability of each stripe, None without a curve.
    measure
        Name and unit of the intensity.

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

    status: Annotated[str, Label()]
    median: Annotated[float, Label(plain=number_or_none)]
    beta: Annotated[float, Label(plain=number_or_none)]
    step: tuple[float, float] | None = None
    log_likelihood: Annotated[float, Label("log-likelihood")]
    misfit: Annotated[float, Label("largest misfit of a stripe", plain=number_or_none)]
    trials: Annotated[int, Label()]
    failures: Annotated[int, Label()]
    sampled: Annotated[tuple[float, float], Label()]
    stripes: tuple[Row, ...]
    measure: tuple[str, str] = ("intensity", "")

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
            and of data that do not rise.  A fitted curve goes on beyond `sampled`.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        from scipy.special import ndtr

        at = np.asarray(intensity, dtype=np.float64)
        bad = ~(at >= 0.0)
        if bad.any():
            raise InputError(
                "intensity", float(at[bad].flat[0]), "it must be 0 or above", "give an intensity"
            )
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
        return np.asarray(ndtr(eta))

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
        from scipy.special import ndtri

        p = SHARE("probability", probability)
        if self.status != FITTED:
            return self.median
        try:
            return self.median * math.exp(self.beta * float(ndtri(p)))
        except OverflowError:
            return math.inf

    def hclpf(self, beta_u: float = 0.0) -> float:
        """Return the intensity of high confidence of a low probability of failure (HCLPF).

        It is median exp(-1.645 (beta + beta_u)) [1]_: with 95 % confidence at most 5 % fail.

        Parameters
        ----------
        beta_u
            Standard deviation of ln median, which is of knowledge; beta is of chance.  Default 0.

        Returns
        -------
        float
            NaN without a beta.

        Raises
        ------
        InputError
            If `beta_u` is negative or not finite.

        Examples
        --------
        >>> from rocksteady.risk import fit_curve
        >>> curve = fit_curve([0.2, 0.4, 0.8], [1, 9, 14], [15, 15, 15])
        >>> print(f"{curve.hclpf(0.3):.3f}")
        0.108

        References
        ----------
        .. [1] R. P. Kennedy and M. K. Ravindra, Nuclear Engineering and Design 79, 47-68 (1984).
        """
        uncertainty = non_negative("beta_u", beta_u, hint="give that of ln median")
        return self.median * math.exp(-QUANTILE * (self.beta + uncertainty))


@checked
def fit_curve(
    intensity: ArrayLike,
    failures: ArrayLike,
    trials: ArrayLike | None = None,
    *,
    measure: tuple[str, str] = ("intensity", ""),
) -> FragilityCurve:
    """Fit a fragility curve to counts of failures by maximum likelihood.

    P = F((ln im - ln median)/beta), F the normal distribution [1].  Labels enter as they are, in
    any order, and are not made monotone.  Runs of one record depend on each other, so that no
    confidence follows from the number of trials.

    Parameters
    ----------
    intensity
        Intensity of each observation, above 0, shape (n,).
    failures
        Their number in each observation, shape (n,).
    trials
        Their number in each observation, shape (n,); default 1 each.
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
    totals = totals_of(intensity, failures, trials)
    best = maximum_of(totals)
    stripes, misfit = compare_stripes(totals, best.shares)
    return FragilityCurve(
        status=best.status,
        median=best.median,
        beta=best.beta,
        step=best.step,
        log_likelihood=best.log_likelihood,
        misfit=misfit,
        trials=int(totals.trials.sum()),
        failures=int(totals.failures.sum()),
        sampled=(float(totals.levels[0]), float(totals.levels[-1])),
        stripes=stripes,
        measure=measure,
    )


def compare_stripes(totals: Totals, probability: Floats) -> tuple[tuple[Row, ...], float]:
    """Return intensity, trials, failures and probability by stripe, and the largest misfit.

    Levels are stripes where they have ten trials each on average; of scattered intensities,
    neighbours are joined to about ten stripes, each at the mean of ln im and with the mean of the
    probabilities.
    """
    levels, failures, trials = totals
    total, place = trials.sum(), np.arange(len(trials))
    if total < FEWEST * len(trials):
        number_of = max(1, min(FEWEST, int(total) // FEWEST))
        middle = np.cumsum(trials) - 0.5 * trials
        place = np.unique((number_of * middle / total).astype(np.intp), return_inverse=True)[1]
    weight = np.bincount(place, weights=trials)
    at = np.exp(np.bincount(place, weights=trials * np.log(levels)) / weight)
    failed = np.bincount(place, weights=failures)
    curve = np.bincount(place, weights=trials * probability) / weight
    rows = zip(at.tolist(), weight.tolist(), failed.tolist(), curve.tolist(), strict=True)
    return (
        tuple((x, int(n), int(k), number_or_none(p)) for x, n, k, p in rows),
        float(np.abs(failed / weight - curve).max()),
    )
