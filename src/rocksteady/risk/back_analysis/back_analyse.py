"""Back-analysis: which shakings agree with what fell and what stood at one place."""

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.risk.back_analysis._analysis import Tried, analyse
from rocksteady.risk.back_analysis._chances import Levels
from rocksteady.risk.back_analysis._fall_shares import POOL, Pools, draw_objects, fall_shares
from rocksteady.risk.back_analysis.back_analysis import BackAnalysis
from rocksteady.risk.back_analysis.scan import ScanOptions
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.prior import Prior
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.seismic.spectra.batch import GroundShaking
from rocksteady.seismic.spectra.grounds import grounds_of, names_of
from rocksteady.sweep.run import Execution

FEWEST_RECORDS = 4
"""For records that are left out in turn."""
NO_UPLIFT = 0.9
"""Of the uplift acceleration of the first object that lifts."""
ALL_FALL = 2.0
"""Over uplift in PGA and in p PGV: nearly all objects fall under half of the records."""

WIDER, MOST_WIDER, NEAR = 2.0, 3, 0.1
"""Factor on a limit that the interval reaches, how often, and how near is to reach it."""


@checked
def back_analyse(
    survey: Survey,
    motions: Sequence[Record | BaseMotion],
    *,
    measures: Sequence[Measure | str] = ("pga_g", "pgv_m_s"),
    prior: Prior | None = None,
    scan: ScanOptions | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> BackAnalysis:
    """Find the shakings that agree with what fell and what stood.

    All objects met one shaking.  It is taken for a record of a suite, each as likely as the others,
    times a scale whose logarithm is evenly spread between limits, with either sign.  An object of
    the survey falls with the chance ``P = (1 - eps) Q + eps/2``: Q is the share of its draws that
    fall, over what is known of its sizes, its restitution with its scatter, and an amplitude error
    sigma_ln from object to object; eps is the share of outliers.  The likelihood of the survey is
    the product over objects, to the power of a temper.

    The true shaking is in no suite, and the likelihood of many objects is far too sharp for that.
    So each record is left out in turn, surveys are simulated under it at scales that agree with the
    real one, and analysed with the other records.  The temper is that of the best mean logarithm of
    the density at the truth, and the region is the smallest one with that posterior probability
    which covers 90 % of these truths.  Intervals of the measures are found likewise.

    Limits that are not given double, three times at most, while the interval of the first measure
    ends near one of them: so it does not hang on them.

    Parameters
    ----------
    survey
        The objects and their outcomes.
    motions
        The suite: records, or `BaseMotion` with vertical components.
    measures
        Two or more measures that grow with the accelerations and need no block; default PGA and
        PGV.  The region is in the first two.
    prior
        Amplitude error, outliers, and defaults of the objects; default `Prior()`.
    scan
        Limits, levels, draws and temper; default `ScanOptions()`.
    model
        ``"nonlinear"`` (default) or ``"linear"``.
    run
        Executor, workers, store and progress; default `Execution()`.

    Returns
    -------
    BackAnalysis
        Region, intervals, weights of records, and the coverage that was found.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, a measure does not scale, or there are fewer than 4
        records and no temper.

    Examples
    --------
    Of five blocks under one of six synthetic motions the two slender ones fell:

    >>> from rocksteady import back_analyse
    >>> from rocksteady.calibration import ObjectPrior, ScanOptions, Survey
    >>> from rocksteady.motions import make_synthetic_suite
    >>> blocks = [
    ...     ObjectPrior(name=f"block {k}", width_m=0.1 + 0.05 * k, height_m=0.8, base=1.0)
    ...     for k in range(5)
    ... ]
    >>> survey = Survey(objects=blocks, fell=[True, True, False, False, False])
    >>> analysis = back_analyse(
    ...     survey, make_synthetic_suite(6), scan=ScanOptions(levels=8, draws=2)
    ... )
    >>> analysis.bound, bool(analysis.lows[0] < analysis.medians[0] < analysis.highs[0])
    ('interval', True)
    """
    options = ScanOptions() if scan is None else scan
    known = Prior() if prior is None else prior
    survey = replace(survey, objects=[known.object_prior(each) for each in survey.objects])
    words = _measures(measures)
    grounds = grounds_of(list(motions))
    if options.trials and len(grounds) < FEWEST_RECORDS:
        valid = f"records are left out in turn, of {FEWEST_RECORDS} or more"
        hint = "give more records, or rs.calibration.ScanOptions(temper=0.3, trials=0)"
        raise InputError("motions", f"{len(grounds)}", valid, hint)
    at_one = np.array(
        [[compute_measure(ground.record.reference, each) for each in words] for ground in grounds]
    )
    equations = chosen_model(model, survey.objects[0].middle_block)
    draws = options.draws_of(len(survey))
    pools = draw_objects(survey, equations, count=max(POOL, draws), seed=options.seed)
    begun = time.perf_counter()

    def tried(low: float, high: float) -> BackAnalysis:
        levels = Levels.between(low, high, options.levels, known.noise)
        scales = np.exp(levels.simulated) / at_one[:, :1]
        shares = fall_shares(pools, grounds, scales, draws=draws, run=run)
        made = Tried(
            names=tuple(names_of(ground.record for ground in grounds)),
            measures=words,
            at_one=at_one,
            levels=levels,
            shares=shares,
            draws=draws,
            seconds=time.perf_counter() - begun,
            model=equations,
        )
        return analyse(survey, made, known.noise, options)

    low, high = options.limits or _limits(pools, grounds, at_one[:, 0])
    analysis = tried(low, high)
    for _ in range(0 if options.limits else MOST_WIDER):
        below, above = _open_ends(analysis)
        if not (below or above):
            break
        low, high = low / WIDER**below, high * WIDER**above
        analysis = tried(low, high)
    return analysis


def _open_ends(analysis: BackAnalysis) -> tuple[bool, bool]:
    """Return whether the interval of the first measure reaches the limits, below and above.

    It does where it ends within a tenth of their ratio, in logarithms.
    """
    if analysis.bound != "interval":
        return False, False
    low, high = np.log(analysis.limits)
    near = NEAR * (high - low)
    return np.log(analysis.lows[0]) < low + near, np.log(analysis.highs[0]) > high - near


def _measures(given: Sequence[Measure | str]) -> tuple[Measure, ...]:
    """Return two or more measures that scale, each once."""
    intensities = tuple(each if isinstance(each, Measure) else Measure(each) for each in given)
    for each in intensities:
        if each.needs_block or not each.scales:
            what = "needs a block" if each.needs_block else "does not grow with the accelerations"
            raise InputError(
                "measures",
                each.key,
                f"{each.label} {what}",
                "give measures of the ground, as 'pga_g', 'pgv_m_s' or "
                "rs.measures.Measure('sa_g', 0.5)",
            )
    keys = [each.key for each in intensities]
    if len(keys) < 2 or len(set(keys)) < len(keys):
        valid, hint = "there are two or more, each once", "leave it out for PGA and PGV"
        raise InputError("measures", keys, valid, hint)
    return intensities


def _limits(pools: Pools, grounds: Sequence[GroundShaking], at_one: Floats) -> tuple[float, float]:
    """Return values of the first measure: where no object lifts, and where nearly all fall.

    Half of the records reach the upper one at least; of PGA the lower one holds for every record.
    """
    pga = np.array([ground.record.peak_acceleration_m_s2 for ground in grounds])
    pgv = np.array([compute_measure(ground.record, "pgv_m_s") for ground in grounds])
    uplifts = [block.uplift_acceleration for block in pools.blocks]
    slowest = min(block.p for block in pools.blocks)
    none = NO_UPLIFT * min(uplifts) / pga
    every = ALL_FALL * max(uplifts) * np.maximum(1.0 / pga, 1.0 / (slowest * pgv))
    low = float(np.quantile(none * at_one, 0.25))
    return low, max(4.0 * low, float(np.median(every * at_one)))
