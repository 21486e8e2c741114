"""Options of the confidence bands."""

from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.confidence import CONFIDENCE, Confidence

LEAST_REPLICATES = 100
"""Redrawn suites, below which the ends of an interval are too rough."""


@checked
@dataclass(frozen=True, kw_only=True)
class BandOptions:
    """Hold the options of a bootstrap by record.

    Records are drawn with replacement, all trials of a record together, and each redrawn suite is
    fitted.  Intervals are studentised: deviations are measured in the standard deviation of their
    own suite, from the scores of its records.  A redrawn suite without a curve is left out; above 5
    % of them there is a warning, above half of them and below 11 records no band.

    Of 500 synthetic suites of 11, 22 and 56 records, intervals of 90 % held the median in .884,
    .906 and .904, beta in .890, .858 and .868, and probabilities of .1, .5 and .9 in .860 to .894,
    .878 to .914 and .864 to .914.  Percentiles of the redrawn curves held beta in .658, .748 and
    .806, with bias correction and acceleration in .744, .810 and .848.

    Attributes
    ----------
    confidence
        Confidence of the bands, in (0, 1); default 0.9.
    replicates
        Suites that are drawn from the records, with replacement; default 1000, at least 100, or 0
        for no bands.
    seed
        Seed of the draws, a whole number from 0; default 0.

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> from rocksteady.risk import BandOptions
    >>> BandOptions(confidence=0.95)
    BandOptions(confidence=0.95, replicates=1000, seed=0)
    """

    confidence: Confidence = CONFIDENCE
    replicates: Annotated[int, Whole(0, 1_000_000, "give 1000")] = 1000
    seed: Annotated[int, Whole(0, None, "give a whole number, as 0")] = 0

    def __post_init__(self) -> None:
        """Refuse bands of too few suites."""
        if 0 < self.replicates < LEAST_REPLICATES:
            valid = f"it must be 0 for no bands, or {LEAST_REPLICATES} or more"
            raise InputError("replicates", self.replicates, valid, "give 1000")
