"""Platt's recalibration: a line over the log odds of held-out predictions."""

from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.risk.calibration.held_out.scores import LEAST

SPREAD = (1.0, 0.5)
"""Prior deviations of the intercept about 0 and of the slope about 1."""
FEWEST_TESTS, LEAST_GROUPS = 100, 10
"""Below which a line is not chosen: its own error is as large as what it mends."""
STEPS = 30


@dataclass(frozen=True, kw_only=True)
class Platt:
    """A line over log odds: logit of the new p = intercept + slope * logit p [1].

    References
    ----------
    .. [1] J. Platt, Advances in Large Margin Classifiers, 61-74 (1999).
    """

    intercept: float = 0.0
    slope: float = 1.0

    def of(self, p: Floats) -> Floats:
        """Return recalibrated probabilities."""
        if self == PLAIN:
            return p
        line = self.intercept + self.slope * _log_odds(p)
        probability: Floats = 1.0 / (1.0 + np.exp(-line))
        return probability


PLAIN = Platt()
"""No change."""


def fit_platt(p: Floats, fell: Floats) -> Platt:
    """Return the likeliest line, by Newton's method with a normal prior about no change."""
    design = np.column_stack([np.ones(len(p)), _log_odds(p)])
    precision, usual = 1.0 / np.square(SPREAD), np.array([0.0, 1.0])
    at = usual.copy()
    for _ in range(STEPS):
        now = 1.0 / (1.0 + np.exp(-np.clip(design @ at, -30.0, 30.0)))
        slope = design.T @ (fell - now) - precision * (at - usual)
        bend = (design.T * (now * (1.0 - now))) @ design + np.diag(precision)
        step = np.linalg.solve(bend, slope)
        at = at + np.clip(step, -1.0, 1.0)
        if float(np.abs(step).max()) < 1e-9:
            break
    return Platt(intercept=float(at[0]), slope=float(at[1]))


def recalibrated(p: Floats, fell: Floats, codes: Integers, *others: Floats) -> list[Floats]:
    """Return p and other probabilities of each group by the line of the other groups' p.

    Outcomes may be nan.
    """
    results, known = [each.copy() for each in (p, *others)], np.isfinite(fell)
    for group in np.unique(codes):
        members = codes == group
        used = known & ~members
        if used.any():
            line = fit_platt(p[used], fell[used])
            for result, given in zip(results, (p, *others), strict=True):
                result[members] = line.of(given[members])
    return results


def it_helps(p: Floats, fell: Floats, codes: Integers) -> bool:
    """Return whether lines of other groups make held-out predictions better.

    The log score has to gain more than the standard error of the gain from group to group, and the
    Brier score too has to gain.
    """
    known = np.isfinite(fell)
    groups = np.unique(codes[known], return_inverse=True)[1]
    if known.sum() < FEWEST_TESTS or groups.max() + 1 < LEAST_GROUPS:
        return False
    scores, squares = [], []
    for each in (p, *recalibrated(p, fell, codes)):
        squares.append(np.square(each - fell)[known].sum())
        happened = np.where(fell > 0.0, each, 1.0 - each)[known]
        scores.append(np.bincount(groups, np.log(np.maximum(happened, LEAST))))
    gain = scores[1] - scores[0]
    return bool(squares[1] < squares[0] and gain.sum() > gain.std(ddof=1) * np.sqrt(len(gain)))


def _log_odds(p: Floats) -> Floats:
    sure: Floats = np.clip(p, 1e-6, 1.0 - 1e-6)
    return np.asarray(np.log(sure / (1.0 - sure)))
