"""Predictions of each group from the others, from one set of draws, and the choice of a temper."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.results.doubts import FEWEST_DRAWS

LADDER = (1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.1, 0.05)
"""Tempers that are compared."""
MOST_FOLDS = 20
"""Folds of the training tests among which a temper is chosen."""
LEAST_FOLDS = 10
"""With fewer the error of a score is not known well enough, and the temper stays at 1."""
MOST_WEIGHTS = 6_000_000
"""Numbers of one array of weights: held-out folds are computed in parts."""


class Shared(Protocol):
    """What tests of a session share."""

    def gains(self) -> dict[str, Floats]:
        """Return mean and deviation of ln(gain) of each session at each draw."""

    def condition(self, evidence: "Evidence", codes: Integers) -> "Evidence":
        """Return the evidence with each test seen from the other groups of its session."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Evidence:
    """What the draws of an object make of its tests.

    Attributes
    ----------
    base
        ln(prior density/density that the draws came from), shape (draws,).
    log_likelihood
        ln of the probability of each outcome, 0 of unknown ones, shape (draws, tests).
    share
        Probability of a fall, outliers included, shape (draws, tests).
    tests
        Numbers of the tests among all.
    total
        ln of the probability of all outcomes, where that is not the sum of each, shape (draws,).
    sessions
        What tests of a session share; None without sessions.
    """

    base: Floats
    log_likelihood: Floats
    share: Floats
    tests: Integers
    total: Floats | None = None
    sessions: "Shared | None" = None

    @property
    def joint(self) -> Floats:
        """Logarithm of the probability of all outcomes at each draw, shape (draws,)."""
        return self.log_likelihood.sum(axis=1) if self.total is None else self.total

    def by_groups(self, codes: Integers) -> "Evidence":
        """Return the evidence with each test seen from the other groups of its session."""
        return self if self.sessions is None else self.sessions.condition(self, codes[self.tests])

    def weights(self, temper: float = 1.0, kept: Bools | None = None) -> Floats:
        """Return the weights of the draws by all tests, or by the tests that are kept."""
        given = self.joint if kept is None else self.log_likelihood[:, kept].sum(axis=1)
        return normalised((self.base + temper * given)[:, np.newaxis])[:, 0]


@dataclass(frozen=True, kw_only=True, eq=False)
class HeldOut:
    """Predictions of tests without their groups, shape (tests,) each.

    Attributes
    ----------
    p
        Probability of a fall.
    low, high
        5 and 95 % of it over the draws.
    error
        Monte Carlo error of p.
    effective
        Effective draws behind it.
    """

    p: Floats
    low: Floats
    high: Floats
    error: Floats
    effective: Floats


def normalised(logs: Floats) -> Floats:
    """Return weights that sum to 1 along the first axis, from their logarithms."""
    weights: Floats = np.exp(logs - logs.max(axis=0))
    weights /= weights.sum(axis=0)
    return weights


def effective(weights: Floats) -> Floats:
    """Return how many equal weights are worth as much, 1/sum(w^2), along the first axis."""
    counts: Floats = 1.0 / np.square(weights).sum(axis=0)
    return counts


def hold_out(
    evidence: Sequence[Evidence],
    codes: Integers,
    temper: float | Floats,
    *,
    ends: bool = True,
) -> HeldOut:
    """Return predictions of each test from the tests of other groups.

    The weight of a draw without a group is that with it over the group's likelihood: no run is
    made again.  The error of a weighted mean is that of self-normalised importance sampling [1];
    the noise of few gains is in it, for every draw has its own.

    Parameters
    ----------
    evidence
        Evidence of each object.
    codes
        Number of each test's group, from 0.
    temper
        Exponent of the likelihood, one for all or one for each group.
    ends
        Whether the band of p is wanted too, which takes a sort.

    References
    ----------
    .. [1] A. B. Owen, Monte Carlo Theory, Methods and Examples (2013), 9.2.
    """
    total = len(codes)
    columns = {key: np.full(total, np.nan) for key in ("p", "low", "high", "error", "effective")}
    exponent = np.broadcast_to(np.asarray(temper, dtype=np.float64), int(codes.max()) + 1)
    for each in evidence:
        groups, place = np.unique(codes[each.tests], return_inverse=True)
        sums = _sums_by(each.log_likelihood, place, len(groups))
        rest = each.joint[:, np.newaxis] - sums
        weights = normalised(each.base[:, np.newaxis] + exponent[groups] * rest)
        parts = predict_with(weights[:, place], each.share, ends=ends)
        for key, values in parts.items():
            columns[key][each.tests] = values
    return HeldOut(**columns)


def predict_with(weights: Floats, share: Floats, *, ends: bool = True) -> dict[str, Floats]:
    """Return weighted means of shares with their errors and bands, shape (tests,) each.

    Parameters
    ----------
    weights, share
        Weight and share of each draw and test, shape (draws, tests); one column of weights may
        stand for all.
    ends
        Whether the band is wanted too; it is NaN below 50 effective draws.
    """
    p = (weights * share).sum(axis=0)
    count = np.broadcast_to(effective(weights), p.shape)
    error = np.sqrt((np.square(weights) * np.square(share - p)).sum(axis=0))
    with np.errstate(divide="ignore", invalid="ignore"):
        error = error / np.sqrt(1.0 - 1.0 / count)
    # Of a draw that has all the weight the formula gives 0, and of its error nothing is known.
    error = np.where(count < 2.0, 0.5, error)
    columns = {"p": p, "error": error, "effective": count}
    if ends:
        wide = np.broadcast_to(weights, share.shape)
        ends_of = weighted_quantiles(share, wide, (0.05, 0.95))
        columns["low"], columns["high"] = np.where(count < FEWEST_DRAWS, np.nan, ends_of)
    return columns


def weighted_quantiles(values: Floats, weights: Floats, at: Sequence[float]) -> Floats:
    """Return the least values that have so much weight at or below them, shape (at, columns)."""
    order = np.argsort(values, axis=0, kind="stable")
    ranked = np.take_along_axis(values, order, axis=0)
    below = np.cumsum(np.take_along_axis(weights, order, axis=0), axis=0)
    rows = [np.minimum((below < share).sum(axis=0), len(values) - 1) for share in at]
    return np.array([ranked[row, np.arange(values.shape[1])] for row in rows])


def choose_tempers(
    evidence: Sequence[Evidence], codes: Integers, fell: Floats, ladder: Sequence[float] = LADDER
) -> Floats:
    """Return the temper for each group, chosen among the tests of the others.

    For a held-out group the others are dealt into at most 20 folds, and each fold is predicted
    from the rest of them at each temper; `preferred` chooses.

    Returns
    -------
    ndarray
        Shape (groups,).
    """
    groups = int(codes.max()) + 1
    folds = np.arange(groups) % min(groups, MOST_FOLDS)
    scores = np.zeros((len(ladder), int(folds.max()) + 1, groups))
    for each in evidence:
        scores += _nested_scores(each, codes[each.tests], folds, fell[each.tests], ladder)
    return np.array([ladder[preferred(scores[:, :, group])] for group in range(groups)])


def preferred(scores: Floats) -> int:
    """Return the row of the temper that log scores of folds prefer, rows from 1 downwards.

    It is 1 unless the best temper is better by twice the standard error of the difference, from
    fold to fold; then it is the largest that is within a standard error of the best [1].  The best
    score itself would often be that of a small temper by chance, and its intervals too wide.  With
    fewer than ten folds it is 1.

    Parameters
    ----------
    scores
        Sums of ln(probability of what happened), shape (tempers, folds).

    References
    ----------
    .. [1] T. Hastie, R. Tibshirani and J. Friedman, The Elements of Statistical Learning (2009),
       7.10.
    """
    if scores.shape[1] < LEAST_FOLDS:
        return 0
    lost = scores[np.argmax(scores.sum(axis=1))] - scores
    error = lost.std(axis=1, ddof=1) * np.sqrt(lost.shape[1])
    if lost[0].sum() <= 2.0 * error[0] + 1e-9:
        return 0
    return int(np.argmax(lost.sum(axis=1) <= error + 1e-9))


def _nested_scores(
    each: Evidence, codes: Integers, folds: Integers, fell: Floats, ladder: Sequence[float]
) -> Floats:
    """Return sums of the log score of folds without a group, shape (tempers, folds, groups)."""
    groups, draws = len(folds), len(each.base)
    known = np.isfinite(fell)
    sums = _sums_by(each.log_likelihood, codes, groups)
    total = each.joint
    scores = np.zeros((len(ladder), int(folds.max()) + 1, groups))
    step = max(1, MOST_WEIGHTS // draws)
    for fold in np.unique(folds[codes]):
        inside = np.flatnonzero((folds[codes] == fold) & known)
        if len(inside) == 0:
            continue
        left = total - sums[:, folds == fold].sum(axis=1)
        for begin in range(0, groups, step):
            outer = np.arange(begin, min(groups, begin + step))
            without = left[:, np.newaxis] - sums[:, outer] * (folds[outer] != fold)
            # Groups whose tests are of other objects, or lie in the fold, change nothing here.
            same, back = np.unique(
                np.where((folds[outer] != fold) & np.isin(outer, codes), outer, -1),
                return_index=True,
                return_inverse=True,
            )[1:]
            counted = codes[inside][np.newaxis] != outer[:, np.newaxis]
            for row, temper in enumerate(ladder):
                weights = normalised(each.base[:, np.newaxis] + temper * without[:, same])
                p = (weights.T @ each.share[:, inside])[back]
                happened = np.where(fell[inside] > 0.0, p, 1.0 - p)
                logs = np.log(np.maximum(happened, 1e-12))
                scores[row, fold, outer] += (logs * counted).sum(axis=1)
    return scores


def _sums_by(values: Floats, place: Integers, groups: int) -> Floats:
    """Return the sums of columns of the same group, shape (rows, groups)."""
    member = np.zeros((values.shape[1], groups))
    member[np.arange(values.shape[1]), place] = 1.0
    sums: Floats = values @ member
    return sums
