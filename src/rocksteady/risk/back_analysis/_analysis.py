"""From shares of draws that fall to a back-analysis: all but the runs."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.equations import Model
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.risk.back_analysis._chances import Levels, chances, log_likelihoods
from rocksteady.risk.back_analysis._density import Plane, level_of, tempered
from rocksteady.risk.back_analysis._held_out import HeldOut, hold_out, unchecked
from rocksteady.risk.back_analysis._remarks import remarks_on
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis, Bound
from rocksteady.risk.back_analysis.scan import ScanOptions
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.seismic.measures.scalar import Measure

ROWS = {"interval": 0, "lower bound": 1, "upper bound": 2}
"""Median, lower or upper end: what is found of a survey, by its bound."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Tried:
    """Shakings that were tried, and the shares of draws that fell.

    Attributes
    ----------
    names, measures, at_one
        Records, measures, and measures of the records as they are, shape (records, measures).
    levels
        Levels of the first measure.
    shares
        As `fall_shares` returns them.
    draws, seconds
        Draws of each object at each scale, and the time of the runs.
    model
        Equations of motion of the runs.
    """

    names: tuple[str, ...]
    measures: tuple[Measure, ...]
    at_one: Floats
    levels: Levels
    shares: Floats
    draws: int
    seconds: float
    model: Model


def analyse(survey: Survey, tried: Tried, noise: OutcomeErrors, scan: ScanOptions) -> BackAnalysis:
    """Return the shakings that agree with a survey.

    Parameters
    ----------
    survey
        The objects, in the order of `tried.shares`.
    tried
        The shakings.
    noise
        Amplitude error and outliers.
    scan
        Temper and trials.
    """
    outcomes = survey.outcomes[np.newaxis]
    plane = Plane(nodes=tried.levels.nodes, ratios=np.log(tried.at_one / tried.at_one[:, :1]))
    sizes = np.array([tried.draws // 2, tried.draws - tried.draws // 2]) / tried.draws
    shares = np.tensordot(sizes, tried.shares, axes=1)
    chance = chances(shares, tried.levels, noise)
    logs = log_likelihoods(outcomes, chance)
    bound: Bound = "interval"
    if len(set(survey.fell)) == 1:
        bound = "lower bound" if survey.fell[0] else "upper bound"
    held = hold_out(logs[0], chance, plane, scan) if bound == "interval" else unchecked(plane, scan)
    weights = tempered(logs, held.temper)[0]
    if bound == "interval":
        density = plane.masses(weights[np.newaxis])[0] / plane.cell
        threshold = level_of(density, held.share)
    else:
        density, threshold = plane.local_mean(np.exp(logs[0]).mean(axis=0)), 1.0 - CONFIDENCE
    medians, lows, highs = _values(plane, logs, held, bound)
    halves = [
        _values(plane, log_likelihoods(outcomes, chances(half, tried.levels, noise)), held, bound)
        for half in tried.shares
    ]
    first, second = (half[ROWS[bound]] for half in halves)
    result = BackAnalysis(
        survey=survey,
        measures=tried.measures,
        records=tried.names,
        values_at_one=tried.at_one,
        first_values=np.exp(plane.nodes),
        weights=weights,
        density=density,
        ratios=np.exp(plane.ordinates),
        threshold=threshold,
        confidence=CONFIDENCE,
        share=held.share,
        plain_coverage=held.plain_coverage,
        held_out_surveys=held.surveys,
        temper=held.temper,
        temper_scores=held.scores,
        bound=bound,
        medians=medians,
        lows=lows,
        highs=highs,
        # Each half has half of the draws: the mean of both is off by half their difference.
        mc_errors=0.5 * np.abs(np.log(first / second)),
        effective_records=float(1.0 / (weights.sum(axis=1) ** 2).sum()),
        draws=tried.draws,
        runs=int(tried.draws * tried.shares[0].size),
        seconds=tried.seconds,
        model=tried.model,
    )
    return replace(result, warnings=remarks_on(result))


def _values(plane: Plane, logs: Floats, held: HeldOut, bound: Bound) -> Floats:
    """Return medians and ends of the intervals of all measures; NaN for what is open.

    Where outcomes are of one kind the posterior reaches to a limit, and so would its interval.  But
    then the survey is the most extreme one there is: its chance itself, the mean over records, is
    the probability of what has been seen or more, and ends where it falls below 1 - confidence.

    Returns
    -------
    numpy.ndarray
        Shape (3, measures).
    """
    ends = np.full((3, len(held.tails)), np.nan)
    if bound == "interval":
        weights = tempered(logs, held.temper)[0]
        for measure, tail in enumerate(held.tails.tolist()):
            shares = np.array([0.5, 0.5 - 0.5 * tail, 0.5 + 0.5 * tail])
            ends[:, measure] = plane.quantiles(weights, measure, shares)
    else:
        seen = np.exp(logs[0]).mean(axis=0)
        ends[ROWS[bound]] = [_extreme(plane, seen, ratios, bound) for ratios in plane.ratios.T]
    return ends


def _extreme(plane: Plane, seen: Floats, ratios: Floats, bound: Bound) -> float:
    """Return where the chance of the survey comes to 1 - confidence; NaN where it does not.

    Parameters
    ----------
    plane
        The measures.
    seen
        Chance of the survey under each record, shape (records, nodes).
    ratios
        Of a measure, from `plane`, shape (records,).
    bound
        Which of the ends.
    """
    values = np.linspace(plane.nodes[0] + ratios.min(), plane.nodes[-1] + ratios.max(), 1001)
    chance = np.mean(
        [
            np.interp(values - ratio, plane.nodes, each)
            for ratio, each in zip(ratios.tolist(), seen, strict=True)
        ],
        axis=0,
    )
    likely = np.flatnonzero(chance >= 1.0 - CONFIDENCE)
    if not len(likely):
        return math.nan
    place = likely[-1] if bound == "upper bound" else likely[0]
    return float(np.exp(values[place])) if 0 < place < len(values) - 1 else math.nan
