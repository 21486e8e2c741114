"""Temper and coverage, from records that are left out in turn.

The true shaking is in no suite.  So each record is left out once: surveys are simulated under it,
at scales that agree with the real survey, and analysed with the other records.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.risk.back_analysis._chances import log_likelihoods
from rocksteady.risk.back_analysis._density import Plane, mass_above, tempered

TEMPERS = (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.12, 0.08, 0.05)
AGAIN = 50
"""Draws of a survey, of which one is to have outcomes of both kinds."""
BATCH = 64
"""Simulated surveys that are analysed at once."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeldOut:
    """Coverage of the region by simulated surveys under records that are left out.

    Attributes
    ----------
    temper
        Exponent of the likelihood.
    scores
        Mean logarithm of the density at the truth by temper.
    share
        Posterior probability of the region that covers the wanted share of truths.
    plain_coverage
        Coverage of the region whose posterior probability is the wanted share.
    tails
        For each measure the posterior probability of its central interval, shape (measures,).
    surveys
        Number of simulated surveys; 0 without a check.
    """

    temper: float
    scores: dict[float, float]
    share: float
    plain_coverage: float
    tails: Floats
    surveys: int


def hold_out(
    log_likelihood: Floats,
    chance: Floats,
    plane: Plane,
    *,
    temper: float | Literal["auto"],
    trials: int,
    seed: int,
    confidence: float,
) -> HeldOut:
    """Return the temper, and the posterior probability that a region must have.

    Parameters
    ----------
    log_likelihood
        Log-likelihood of the real survey, shape (signs, records, nodes).
    chance
        Chances of falling, shape (objects, signs, records, nodes).
    plane
        The measures.
    temper
        Exponent of the likelihood, or "auto" for that of the best held-out score.
    trials
        Simulated surveys for each record.
    seed
        Seed of the simulation.
    confidence
        Share of truths that a region must cover.
    """
    random = np.random.default_rng([seed, 23])
    truths, fell = _surveys(log_likelihood, chance, trials, random)
    if not len(truths):
        return unchecked(temper, confidence, plane.ratios.shape[1])
    _, record, node = truths.T
    each = np.arange(len(truths))
    simulated = log_likelihoods(fell, chance)
    simulated[each, :, record] = -np.inf
    ordinate = np.abs(plane.ordinates - plane.ratios[record, 1][:, np.newaxis]).argmin(axis=1)
    scores: dict[float, float] = {}
    above: dict[float, Floats] = {}
    for value in TEMPERS if temper == "auto" else (temper,):
        logs, beyond = np.empty(len(truths)), np.empty(len(truths))
        for first in range(0, len(truths), BATCH):
            here = slice(first, first + BATCH)
            masses = plane.masses(tempered(simulated[here], value))
            level = masses[np.arange(len(masses)), node[here], ordinate[here]]
            beyond[here] = mass_above(masses, level)
            logs[here] = np.log(np.maximum(level / plane.cell, 1e-300))
        scores[value], above[value] = float(logs.mean()), beyond
    best = max(scores, key=lambda value: scores[value])
    at = plane.nodes[node][:, np.newaxis] + plane.ratios[record]
    weights = tempered(simulated, best)
    off = [
        np.abs(2.0 * plane.distribution(weights, k, at[:, k, np.newaxis])[:, 0] - 1.0)
        for k in range(plane.ratios.shape[1])
    ]
    return HeldOut(
        temper=best,
        scores=scores,
        share=_covering(above[best], confidence),
        plain_coverage=float((above[best] <= confidence).mean()),
        tails=np.array([_covering(each, confidence) for each in off]),
        surveys=len(truths),
    )


def unchecked(temper: float | Literal["auto"], confidence: float, measures: int) -> HeldOut:
    """Return what is taken where no record is left out.

    Parameters
    ----------
    temper
        Exponent of the likelihood; "auto" is 1.
    confidence
        Posterior probability of the region.
    measures
        Their number.
    """
    return HeldOut(
        temper=1.0 if temper == "auto" else temper,
        scores={},
        share=confidence,
        plain_coverage=float("nan"),
        tails=np.full(measures, confidence),
        surveys=0,
    )


def _surveys(
    log_likelihood: Floats, chance: Floats, trials: int, random: np.random.Generator
) -> tuple[NDArray[np.int64], Floats]:
    """Return truths and simulated surveys.

    The scale of each record is drawn from its own posterior, without a temper.  As in the real
    survey some objects fall and some stand: others are drawn again, truth and survey, and at last
    left out.

    Returns
    -------
    tuple of numpy.ndarray
        Sign, record and node of each, shape (surveys, 3), and the outcomes, (surveys, objects).
    """
    _, records, nodes = log_likelihood.shape
    weights = np.exp(log_likelihood - log_likelihood.max(axis=(0, 2), keepdims=True))
    sums = np.cumsum(weights.transpose(1, 0, 2).reshape(records, -1), axis=1)
    record = np.repeat(np.arange(records), trials)
    truths = np.zeros((len(record), 3), dtype=np.int64)
    fell = np.zeros((len(record), len(chance)))
    lacking = np.arange(len(record))
    for _ in range(AGAIN):
        at = record[lacking]
        share = random.random(len(at)) * sums[at, -1]
        place = np.minimum((sums[at] <= share[:, np.newaxis]).sum(axis=1), sums.shape[1] - 1)
        truths[lacking] = np.stack([place // nodes, at, place % nodes], axis=1)
        uniform = random.random((len(at), len(chance)))
        fell[lacking] = uniform < chance[:, place // nodes, at, place % nodes].T
        count = fell[lacking].sum(axis=1)
        lacking = lacking[(count == 0) | (count == len(chance))]
        if not len(lacking):
            break
    good = np.setdiff1d(np.arange(len(record)), lacking)
    return truths[good], fell[good]


def _covering(shares: Floats, confidence: float) -> float:
    """Return the share that covers a part of the truths, as a conformal prediction counts them.

    It is at most 0.999: beyond lie the tails of the kernel alone.
    """
    ordered = np.sort(shares)
    place = int(np.ceil(confidence * (len(ordered) + 1))) - 1
    return float(min(0.999, ordered[min(place, len(ordered) - 1)]))
