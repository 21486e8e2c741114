"""Temper and coverage, from records that are left out in turn.

The true shaking is in no suite.  So each record is left out once: surveys are simulated under it,
at scales that agree with the real survey, and analysed with the other records.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.risk.back_analysis._chances import log_likelihoods
from rocksteady.risk.back_analysis._density import Plane, tempered
from rocksteady.risk.back_analysis.scan import ScanOptions

TEMPERS = (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.12, 0.08, 0.05)
AGAIN = 50
"""Draws of a survey, of which one is to have outcomes of both kinds."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeldOut:
    """Coverage of the region by simulated surveys under records that are left out.

    Attributes
    ----------
    temper
        Exponent of the likelihood.
    tails
        For each measure the posterior probability of its central interval, shape (measures,).
    share
        Posterior probability of the region that covers the wanted share of truths.
    plain_coverage
        Coverage of the region whose posterior probability is the wanted share.
    scores
        Mean logarithm of the density at the truth by temper.
    surveys
        Number of simulated surveys; 0 without a check.
    """

    temper: float
    tails: Floats
    share: float = CONFIDENCE
    plain_coverage: float = math.nan
    scores: Mapping[float, float] = field(default_factory=dict)
    surveys: int = 0


def hold_out(log_likelihood: Floats, chance: Floats, plane: Plane, scan: ScanOptions) -> HeldOut:
    """Return the temper, and the posterior probability that a region must have.

    Parameters
    ----------
    log_likelihood
        Log-likelihood of the real survey, shape (signs, records, nodes).
    chance
        Chances of falling, shape (objects, signs, records, nodes).
    plane
        The measures.
    scan
        Temper, or "auto" for that of the best held-out score; trials for each record; seed.
    """
    random = np.random.default_rng([scan.seed, 23])
    record, node, fell = _surveys(log_likelihood, chance, scan.trials, random)
    if not len(record):
        return unchecked(plane, scan)
    each = np.arange(len(record))
    simulated = log_likelihoods(fell, chance)
    simulated[each, :, record] = -np.inf
    ordinate = np.abs(plane.ordinates - plane.ratios[record, 1][:, np.newaxis]).argmin(axis=1)
    scores: dict[float, float] = {}
    above: dict[float, Floats] = {}
    for value in TEMPERS if scan.temper == "auto" else (scan.temper,):
        masses = plane.masses(tempered(simulated, value))
        level = masses[each, node, ordinate]
        likelier = masses > level[:, np.newaxis, np.newaxis]
        above[value] = np.where(likelier, masses, 0.0).sum(axis=(1, 2))
        scores[value] = float(np.log(np.maximum(level / plane.cell, 1e-300)).mean())
    best = max(scores, key=lambda value: scores[value])
    at = plane.nodes[node][:, np.newaxis] + plane.ratios[record]
    weights = tempered(simulated, best)
    off = [
        np.abs(2.0 * plane.distribution(weights, k, at[:, k, np.newaxis])[:, 0] - 1.0)
        for k in range(plane.ratios.shape[1])
    ]
    return HeldOut(
        temper=best,
        tails=np.array([_covering(shares) for shares in off]),
        share=_covering(above[best]),
        plain_coverage=float((above[best] <= CONFIDENCE).mean()),
        scores=scores,
        surveys=len(record),
    )


def unchecked(plane: Plane, scan: ScanOptions) -> HeldOut:
    """Return the temper and the confidence as they are, where no record is left out."""
    temper = 1.0 if scan.temper == "auto" else scan.temper
    return HeldOut(temper=temper, tails=np.full(plane.ratios.shape[1], CONFIDENCE))


def _surveys(
    log_likelihood: Floats, chance: Floats, trials: int, random: np.random.Generator
) -> tuple[Integers, Integers, Floats]:
    """Return truths and simulated surveys.

    The scale of each record is drawn from its own posterior, without a temper.  As in the real
    survey some objects fall and some stand: others are drawn again, truth and survey, and at last
    left out.

    Returns
    -------
    tuple of numpy.ndarray
        Record and node of each, shape (surveys,), and the outcomes, (surveys, objects).
    """
    _, records, nodes = log_likelihood.shape
    weights = np.exp(log_likelihood - log_likelihood.max(axis=(0, 2), keepdims=True))
    sums = np.cumsum(weights.transpose(1, 0, 2).reshape(records, -1), axis=1)
    record = np.repeat(np.arange(records), trials)
    node = np.zeros_like(record)
    fell = np.zeros((len(record), len(chance)))
    lacking = np.arange(len(record))
    for _ in range(AGAIN):
        at = record[lacking]
        share = random.random(len(at)) * sums[at, -1]
        place = np.minimum((sums[at] <= share[:, np.newaxis]).sum(axis=1), sums.shape[1] - 1)
        sign, node[lacking] = np.divmod(place, nodes)
        uniform = random.random((len(at), len(chance)))
        fell[lacking] = uniform < chance[:, sign, at, node[lacking]].T
        lacking = lacking[np.ptp(fell[lacking], axis=1) == 0.0]
    good = np.setdiff1d(np.arange(len(record)), lacking)
    return record[good], node[good], fell[good]


def _covering(shares: Floats) -> float:
    """Return the share that covers a part of the truths, as a conformal prediction counts them.

    It is at most 0.999: beyond lie the tails of the kernel alone.
    """
    place = math.ceil(CONFIDENCE * (len(shares) + 1)) - 1
    return float(min(0.999, np.sort(shares)[min(place, len(shares) - 1)]))
