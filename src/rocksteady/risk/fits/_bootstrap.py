"""Bootstrap by record: curves of redrawn suites, each with its covariance."""

import hashlib
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.risk.fits._likelihood import slopes, solve_score
from rocksteady.risk.fits._maximum import Maximum
from rocksteady.risk.fits._status import FITTED, kinds_of
from rocksteady.risk.fits.bands import BandOptions

Pair = tuple[float, float]
Quantity = Callable[[Floats], tuple[Floats, Floats]]
"""From coefficients (..., q): quantities (..., m) and their derivatives (..., m, q)."""
MOST_CELLS = 4_000_000
"""Numbers of one array: redrawn suites are computed in parts."""
LEAST_VARIANCE = 1e-300
STEPS = 12
"""Steps of Newton's method, at most."""
ARRIVED = 1e-13
"""Largest score of a trial at the maximum, rounding included."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Replicates:
    """Coefficients of fitted stages and of redrawn suites, with their covariance.

    Attributes
    ----------
    stages
        What was fitted; the probability is the product of their curves.
    confidence
        Confidence of the intervals.
    value, covariance
        Estimate and covariance of the suite, shapes (q,) and (q, q): a and b of each stage in turn.
    values, covariances
        Estimates and covariances of the redrawn suites, shapes (r, q) and (r, q, q).
    """

    stages: tuple[Maximum, ...]
    confidence: float
    value: Floats
    covariance: Floats
    values: Floats
    covariances: Floats

    def interval(self, quantity: Quantity) -> tuple[Floats, Floats]:
        """Return the studentised confidence interval of quantities [1], shape (m,) each.

        With t* = (q* - q)/s* of each redrawn suite, from q - t*(upper) s to q - t*(lower) s, where
        s is the standard deviation by the delta method, from the covariance of clustered scores.

        References
        ----------
        .. [1] B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap (1993), 12.5.
        """
        value, error = _with_error(quantity, self.value, self.covariance)
        values, errors = _with_error(quantity, self.values, self.covariances)
        outside = 0.5 * (1.0 - self.confidence)
        low, high = np.quantile((values - value) / errors, [outside, 1.0 - outside], axis=0)
        return value - high * error, value - low * error

    def median(self) -> Pair:
        """Return the interval of the median of the first stage, from that of -a/b."""
        first = self.stages[0]
        low, high = (first.centre + first.scale * end for end in self.interval(_log_median))
        return math.exp(low[0]), math.exp(high[0])

    def beta(self) -> Pair:
        """Return the interval of beta of the first stage, from that of -ln b."""
        low, high = (self.stages[0].scale * np.exp(end) for end in self.interval(_log_beta))
        return float(low[0]), float(high[0])

    def probability(self, at: Floats) -> tuple[Floats, Floats]:
        """Return the band of the probability at intensities of any shape.

        Intervals are those of the predictor, of two stages those of ln(P/(1 - P)).
        """
        ends = np.where(at > 0.0, 1.0, 0.0), np.where(at > 0.0, 1.0, 0.0)
        inside = (at > 0.0) & np.isfinite(at)
        logs = np.log(at[inside])

        def quantity(coefficients: Floats) -> tuple[Floats, Floats]:
            if len(self.stages) == 1:
                return _predictor(self.stages[0], logs, coefficients)
            return _log_odds(self.stages, logs, coefficients)

        for end, bound in zip(ends, self.interval(quantity), strict=True):
            end[inside] = (
                self.stages[0].family.cdf(bound)
                if len(self.stages) == 1
                else 1.0 / (1.0 + np.exp(-np.maximum(bound, -700.0)))
            )
        return ends


def _with_error(quantity: Quantity, at: Floats, covariance: Floats) -> tuple[Floats, Floats]:
    """Return quantities and their standard deviations."""
    value, slope = quantity(at)
    variance = np.einsum("...mi,...ij,...mj->...m", slope, covariance, slope)
    return value, np.sqrt(np.maximum(variance, LEAST_VARIANCE))


def _log_median(at: Floats) -> tuple[Floats, Floats]:
    a, b = at[..., :1], at[..., 1:2]
    return -a / b, np.stack([-1.0 / b, a / b**2], axis=-1)


def _log_beta(at: Floats) -> tuple[Floats, Floats]:
    b = at[..., 1:2]
    return -np.log(b), np.stack([np.zeros_like(b), -1.0 / b], axis=-1)


def _predictor(stage: Maximum, logs: Floats, at: Floats) -> tuple[Floats, Floats]:
    z = (logs - stage.centre) / stage.scale
    value = at[..., :1] + at[..., 1:2] * z
    slope = np.stack([np.ones_like(z), z], axis=-1)
    return value, np.broadcast_to(slope, (*value.shape, 2))


def _log_odds(stages: Sequence[Maximum], logs: Floats, at: Floats) -> tuple[Floats, Floats]:
    """Return ln(P/(1 - P)) of the product P of stages."""
    log_p = np.zeros((*at.shape[:-1], len(logs)))
    parts = []
    for place, stage in enumerate(stages):
        eta, slope = _predictor(stage, logs, at[..., 2 * place : 2 * place + 2])
        log_p = log_p + stage.family.log_cdf(eta)
        parts.append(stage.family.hazard(eta)[..., None] * slope)
    stands = -np.expm1(np.minimum(log_p, -1e-300))
    return log_p - np.log(stands), np.concatenate(parts, axis=-1) / stands[..., None]


def draw_replicates(stages: Sequence[Maximum], bands: BandOptions) -> Replicates:
    """Return the fits of suites redrawn from the records of fitted stages.

    Records are drawn with replacement, all trials of a record together and the same records for
    all stages.  A redrawn suite without a curve (separated, without failures or survivals, or not
    rising) is left out.
    """
    weight = stages[0].counts.multiplicity
    value = np.concatenate([stage.coefficients for stage in stages])
    size = int(weight.sum())
    rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence(bands.seed)))
    widest = max(len(weight), *(len(stage.counts.levels) for stage in stages))
    part = max(1, MOST_CELLS // widest)
    values, covariances = [], []
    for first in range(0, bands.replicates, part):
        count = min(part, bands.replicates - first)
        drawn = rng.multinomial(size, weight / size, size=count).astype(np.float64)
        solved = np.concatenate([_solved(Redrawn(stage, drawn)) for stage in stages], axis=1)
        known = np.isfinite(solved).all(axis=1)
        solved, drawn = solved[known], drawn[known]
        spread = covariance_of(stages, solved, drawn)
        usable = np.isfinite(spread).all(axis=(1, 2))
        usable &= (np.diagonal(spread, axis1=1, axis2=2) > 0.0).all(axis=1)
        values.append(solved[usable])
        covariances.append(spread[usable])
    return Replicates(
        stages=tuple(stages),
        confidence=bands.confidence,
        value=value,
        covariance=covariance_of(stages, value[None], weight[None])[0],
        values=np.concatenate(values),
        covariances=np.concatenate(covariances),
    )


class Redrawn:
    """A stage and how often a redrawn suite has each record, equal to any of the same numbers.

    Stages come again: uplift in every damage state, and both in the band of their product.
    """

    def __init__(self, stage: Maximum, drawn: Floats) -> None:
        self.stage, self.drawn = stage, drawn
        counts = stage.counts
        whole = hashlib.sha256(repr((stage.family, stage.centre, stage.scale)).encode())
        for array in (counts.levels, stage.coefficients, drawn):
            whole.update(repr(array.shape).encode() + array.tobytes())
        for table in (counts.failures, counts.trials):
            for part in (table.indptr, table.indices, table.data):
                whole.update(np.ascontiguousarray(part).tobytes())
        self.digest = whole.digest()

    def __eq__(self, other: object) -> bool:
        """Return whether stage and suites are the same."""
        return isinstance(other, Redrawn) and self.digest == other.digest

    def __hash__(self) -> int:
        """Return a hash that equal ones share."""
        return hash(self.digest)


@lru_cache(maxsize=16)
def _solved(task: Redrawn) -> Floats:
    """Return what `_solve` does, kept; callers must not change it."""
    return _solve(task.stage, task.drawn)


def _solve(stage: Maximum, drawn: Floats) -> Floats:
    """Return a and b of redrawn suites, shape (r, 2); NaN without a curve.

    Newton's method goes from the estimate of the whole suite, for all at once; a suite for which it
    does not arrive is solved alone.
    """
    failures, trials = drawn @ stage.counts.failures, drawn @ stage.counts.trials
    fitted = kinds_of(stage.design[:, 1], failures, trials).status == FITTED
    at, near = np.tile(stage.coefficients, (len(drawn), 1)), ARRIVED * trials.sum(axis=1)
    arrived = np.zeros(len(drawn), dtype=np.bool_)
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            first, second = slopes(stage.family, at @ stage.design.T, failures, trials)
            # A suite's sums are the same beside any others.
            score = np.einsum("rl,li->ri", first, stage.design)
            arrived = np.abs(score).max(axis=1) < near
            if arrived[fitted].all():
                break
            step = np.einsum("rij,rj->ri", _inverse(_bread(stage, second)), score)
            at = np.where(arrived[:, None], at, at + step)
    solved = np.where((fitted & arrived)[:, None], at, np.nan)
    for row in np.flatnonzero(fitted & ~arrived):
        alone = solve_score(
            stage.family, stage.design, failures[row], trials[row], stage.coefficients
        )
        solved[row] = np.nan if alone is None else alone
    solved[~(solved[:, 1] > 0.0)] = np.nan
    return solved


def _bread(stage: Maximum, second: Floats) -> Floats:
    """Return negative Hessians of the log-likelihood, from negative second derivatives."""
    bread: Floats = np.einsum("rl,li,lj->rij", second, stage.design, stage.design)
    return bread


def covariance_of(stages: Sequence[Maximum], at: Floats, weight: Floats) -> Floats:
    """Return the covariance of coefficients from clustered scores, shape (r, q, q).

    A^-1 (sum of w u u^T) A^-1, u the score of a cluster with weight w at the coefficients, A the
    negative Hessian of the log-likelihood [1].

    References
    ----------
    .. [1] K.-Y. Liang and S. L. Zeger, Biometrika 73, 13-22 (1986).
    """
    rows, size = len(at), at.shape[1]
    inverse = np.zeros((rows, size, size))
    scores = np.empty((rows, weight.shape[1], size))
    for place, stage in enumerate(stages):
        block = slice(2 * place, 2 * place + 2)
        design = stage.design
        eta = at[:, block] @ design.T
        counts = stage.counts
        failures, trials = weight @ counts.failures, weight @ counts.trials
        second = slopes(stage.family, eta, failures, trials)[1]
        inverse[:, block, block] = _inverse(_bread(stage, second))
        up, down = stage.family.hazard(eta), stage.family.hazard(-eta)
        for column in range(2):
            of_failure = counts.failures @ (up * design[:, column]).T
            of_survival = (counts.trials - counts.failures) @ (down * design[:, column]).T
            scores[:, :, 2 * place + column] = (of_failure - of_survival).T
    meat = np.einsum("rc,rci,rcj->rij", weight, scores, scores)
    covariance: Floats = np.einsum("rij,rjk,rkl->ril", inverse, meat, inverse)
    return covariance


def _inverse(matrix: Floats) -> Floats:
    """Return the inverses of 2 x 2 matrices; NaN or infinite of singular ones."""
    (a, b), (_, d) = matrix.transpose(1, 2, 0)
    with np.errstate(all="ignore"):
        rows: Floats = np.array([[d, -b], [-b, a]]) / (a * d - b * b)
    return np.moveaxis(rows, 2, 0)
