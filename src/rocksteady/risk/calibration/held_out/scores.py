"""Scores of probabilities against outcomes, with intervals by a bootstrap of groups."""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.elementary.arrays import log
from rocksteady.model.checks.arrays import compare_by_value
from rocksteady.results.doubts import FEWEST_GROUPS
from rocksteady.results.result import Result
from rocksteady.risk.calibration.sampler.exact import rounded

Interval = tuple[float, float, float]
"""A value and the ends of its interval of 90 %."""

BINS = 10
"""Of the reliability and of its error: each a tenth wide."""
LEAST = 1e-12
"""A probability of 0 of what happened has this one in the log score."""
REPLICATES = 1000
NAMES = ("accuracy", "f1", "brier", "log_score", "ece")


@compare_by_value
@dataclass(frozen=True, kw_only=True, repr=False)
class Scores(Result):
    """Scores of predictions: value, low and high end of 90 % by a bootstrap of groups.

    Attributes
    ----------
    accuracy
        Share of outcomes that are the likelier one; 0.5 counts as a fall.
    f1
        Twice the hits over the predicted and the observed falls; nan where there are none.
    brier
        Mean of (p - fell)^2.
    log_score
        Mean of -ln(probability of what happened); smaller is better.
    ece
        Mean over the tests of abs(mean p - share that fell) of their tenth of p.
    tests, groups
        Number of tests and of groups that were scored.
    """

    accuracy: Interval
    f1: Interval
    brier: Interval
    log_score: Interval
    ece: Interval
    tests: int
    groups: int

    def values(self) -> dict[str, dict[str, float]]:
        """Return the scores as plain values for a file."""
        ends = ("value", "low", "high")
        return {key: dict(zip(ends, getattr(self, key), strict=True)) for key in NAMES}


def score_values(p: Floats, fell: Floats) -> dict[str, float]:
    """Return the scores of probabilities without intervals, by name."""
    sums = _sums(p, fell, np.zeros(len(p), dtype=np.int64))
    return dict(zip(NAMES, _from_sums(sums)[0].tolist(), strict=True))


def scores_of(p: Floats, fell: Floats, codes: Integers, *, seed: int = 0) -> Scores:
    """Return the scores of probabilities; `codes` are the numbers of the groups, from 0."""
    sums = _sums(p, fell, codes)
    groups = len(sums)
    values = _from_sums(sums.sum(axis=0)[np.newaxis])[0]
    ends = np.full((2, len(NAMES)), np.nan)
    if groups >= FEWEST_GROUPS:
        drawn = np.random.default_rng(seed).multinomial(
            groups, np.full(groups, 1.0 / groups), size=REPLICATES
        )
        scores = _from_sums(drawn @ sums)
        for place in range(len(NAMES)):
            known = scores[np.isfinite(scores[:, place]), place]
            # Scores that are all alike show nothing of their scatter.
            if len(known) and np.ptp(known) > 0.0:
                ends[:, place] = np.quantile(known, [0.05, 0.95])
    intervals = {
        key: (float(values[place]), float(ends[0, place]), float(ends[1, place]))
        for place, key in enumerate(NAMES)
    }
    return Scores(**intervals, tests=len(p), groups=groups)


def bin_of(p: Floats) -> Integers:
    """Return the tenth that each probability lies in, 0 to 9."""
    bins: Integers = np.minimum((BINS * p).astype(np.int64), BINS - 1)
    return bins


def _sums(p: Floats, fell: Floats, codes: Integers) -> Floats:
    """Return the sums of each group that all scores follow from, shape (groups, 6 + bins)."""
    called = p >= 0.5
    happened = np.where(fell > 0.0, p, 1.0 - p)
    columns = np.zeros((len(p), 6 + BINS))
    columns[:, 0] = 1.0
    columns[:, 1] = called == (fell > 0.0)
    columns[:, 2] = called & (fell > 0.0)
    columns[:, 3] = called + fell
    columns[:, 4] = np.square(p - fell)
    columns[:, 5] = -log(np.maximum(happened, LEAST))
    columns[np.arange(len(p)), 6 + bin_of(p)] = p - fell
    totals = np.zeros((int(codes.max()) + 1, columns.shape[1]))
    np.add.at(totals, codes, columns)
    return rounded(totals, 30)  # so that sums of redrawn groups are exact


def _from_sums(sums: Floats) -> Floats:
    """Return the five scores of rows of sums, in the order of NAMES."""
    count = sums[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        f1 = 2.0 * sums[:, 2] / sums[:, 3]
    ece = np.abs(sums[:, 6:]).sum(axis=1) / count
    return np.column_stack([sums[:, 1] / count, f1, sums[:, 4] / count, sums[:, 5] / count, ece])
