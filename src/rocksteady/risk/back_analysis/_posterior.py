"""From shares of draws that fall to a back-analysis: all but the runs."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rocksteady.risk.back_analysis._chances import Levels, chances, log_likelihoods
from rocksteady.risk.back_analysis._density import Plane, level_of, tempered
from rocksteady.risk.back_analysis._held_out import HeldOut, hold_out
from rocksteady.risk.back_analysis._remarks import remarks_on
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis, Bound
from rocksteady.risk.back_analysis.scan import Scan
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.prior import Noise
from rocksteady.seismic.measures.scalar import Intensity

Floats = NDArray[np.float64]

CONFIDENCE = 0.9


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
    """

    names: tuple[str, ...]
    measures: tuple[Intensity, ...]
    at_one: Floats
    levels: Levels
    shares: Floats
    draws: int
    seconds: float


def analyse(survey: Survey, tried: Tried, noise: Noise, scan: Scan) -> BackAnalysis:
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
    bound = _bound(survey)
    held = _held_out(logs[0], chance, plane, scan)
    weights = tempered(logs, held.temper)[0]
    masses = plane.masses(weights[np.newaxis])[0]
    ends = _ends(plane, weights, logs[0], held, bound)
    medians = _medians(plane, weights)
    halved = [
        _medians(
            plane,
            tempered(log_likelihoods(outcomes, chances(half, tried.levels, noise)), held.temper)[0],
        )
        for half in tried.shares
    ]
    result = BackAnalysis(
        survey=survey,
        measures=tried.measures,
        records=tried.names,
        values_at_one=tried.at_one,
        first_values=np.exp(plane.nodes),
        weights=weights,
        density=masses / plane.cell,
        ratios=np.exp(plane.ordinates),
        threshold=level_of(masses, held.share) / plane.cell,
        confidence=CONFIDENCE,
        share=held.share,
        plain_coverage=held.plain_coverage,
        held_out_surveys=held.surveys,
        temper=held.temper,
        temper_scores=held.scores,
        bound=bound,
        medians=medians,
        lows=np.array([low for low, _ in ends]),
        highs=np.array([high for _, high in ends]),
        # Each half has half of the draws: the mean of both is off by half their difference.
        mc_errors=0.5 * np.abs(np.log(halved[0] / halved[1])),
        effective_records=float(1.0 / (weights.sum(axis=1) ** 2).sum()),
        draws=tried.draws,
        runs=int(tried.draws * tried.shares[0].size),
        seconds=tried.seconds,
    )
    return replace(result, warnings=remarks_on(result))


def _bound(survey: Survey) -> Bound:
    """Return what outcomes of one kind leave open."""
    if all(survey.fell):
        return "lower bound"
    return "interval" if any(survey.fell) else "upper bound"


def _held_out(logs: Floats, chance: Floats, plane: Plane, scan: Scan) -> HeldOut:
    """Return temper and probabilities of regions, checked or as they are given."""
    if scan.trials:
        return hold_out(
            logs,
            chance,
            plane,
            temper=scan.temper,
            trials=scan.trials,
            seed=scan.seed,
            confidence=CONFIDENCE,
        )
    assert scan.temper != "auto"
    return HeldOut(
        temper=scan.temper,
        scores={},
        share=CONFIDENCE,
        plain_coverage=float("nan"),
        tails=np.full(plane.ratios.shape[1], CONFIDENCE),
        surveys=0,
    )


def _ends(
    plane: Plane, weights: Floats, logs: Floats, held: HeldOut, bound: Bound
) -> list[tuple[float, float]]:
    """Return the ends of the interval of each measure; NaN for an open one.

    Where outcomes are of one kind the posterior reaches to a limit, and so would its interval.  But
    then the survey is the most extreme one there is: its chance itself, the mean over records, is
    the probability of what has been seen or more, and ends where it falls below 1 - confidence.
    """
    nan = float("nan")
    count = plane.ratios.shape[1]
    if bound == "interval":
        found = []
        for measure in range(count):
            half = 0.5 * held.tails[measure]
            low, high = plane.quantiles(weights, measure, np.array([0.5 - half, 0.5 + half]))
            found.append((float(low), float(high)))
        return found
    seen = np.exp(logs).mean(axis=0)
    ends = [_extreme(plane, seen, k, bound) for k in range(count)]
    return [(nan, end) if bound == "upper bound" else (end, nan) for end in ends]


def _extreme(plane: Plane, seen: Floats, measure: int, bound: Bound) -> float:
    """Return where the chance of the survey comes to 1 - confidence; NaN where it does not.

    Parameters
    ----------
    plane, measure
        The measures, and the number of one.
    seen
        Chance of the survey under each record, shape (records, nodes).
    bound
        Which of the ends.
    """
    ratios = plane.ratios[:, measure]
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
        return float("nan")
    place = likely[-1] if bound == "upper bound" else likely[0]
    inside = 0 < place < len(values) - 1
    return float(np.exp(values[place])) if inside else float("nan")


def _medians(plane: Plane, weights: Floats) -> Floats:
    """Return the median of each measure."""
    middle = np.array([0.5])
    count = plane.ratios.shape[1]
    return np.array([plane.quantiles(weights, k, middle)[0] for k in range(count)])
