"""Calibrate: from tests that fell or stood to posteriors, scores and verdicts."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.model.equations import Model, ModelChoice, Nonlinear, as_model
from rocksteady.results.doubts import ENOUGH_DRAWS, FEWEST_DRAWS
from rocksteady.risk.calibration._draw_runs import (
    DrawRuns,
    log_likelihood,
    run_draws,
    shared_runs,
)
from rocksteady.risk.calibration._flips import count_flips
from rocksteady.risk.calibration._identified import LIMIT, parameters_of
from rocksteady.risk.calibration._importance import Proposal, base_weights, refine, smoothed
from rocksteady.risk.calibration._predicting import error_warnings
from rocksteady.risk.calibration._sessions import make_sessions, session_nodes
from rocksteady.risk.calibration._shares import Curves, fit_curves
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.calibration.calibration import (
    Calibration,
    Folds,
    codes_of,
    make_trial,
    why_not,
)
from rocksteady.risk.calibration.held_out.folds import Evidence, effective, hold_out, normalised
from rocksteady.risk.calibration.held_out.validate import (
    temper_of,
    validate_trial,
    without_scores,
)
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import DrawOptions
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import Prior
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

PRIOR_DRAWS = 4096
"""Draws of the prior that the posterior is compared with; nothing is run for them."""


TOLERANCE = 1e-8
"""Default of the full equations here."""
SURE = 500
"""Runs of a test in the first round that, all alike, settle its fate in the others."""


@checked
def calibrate(
    tests: Observations,
    prior: Prior | None = None,
    *,
    sampling: DrawOptions | None = None,
    folds: Folds = "group",
    temper: float | Literal["auto"] = "auto",
    recalibrate: bool | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> Calibration:
    """Calibrate objects by the shaking tests in which they fell or stood.

    A test falls with the probability (1 - eps) Q + eps/2: Q is the share of gains
    exp(sigma_ln z), z standard normal, at which a run of the block falls, and eps the share of
    outliers.  Draws of what is not known are weighted by the likelihood of all outcomes to the
    power of the temper [1].  They come in rounds from mixtures of the prior and of t distributions
    about the posterior before [2].  A prediction of a training test leaves out its group.  The
    temper is chosen among tempers from 1 to 0.05 by the held-out log score, for the score of a
    group among the other groups.

    Parameters
    ----------
    tests
        From `read_tests`, or made by hand.
    prior
        What is known of all objects and of the errors; default `Prior()`.
    sampling
        Draws, gains, rounds and seed; default `DrawOptions()`.
    folds
        What is held out together: "group" (default; the record's name where tests have none of
        their own), "record", "test" or "session".
    temper
        "auto" (default), or a number in (0, 1]; 1 is Bayes' rule, and no other is.
    recalibrate
        Whether a line over the log odds of held-out predictions [3], fitted without the group,
        mends them: True, False, or None (default) where the log score gains by it.
    model
        `Nonlinear(tolerance=1e-8)` (default), which takes a third less time than a tolerance of
        1e-10 and changes fewer fates than any amplitude error, or ``"linear"``.
    run
        Executor and workers, no store; default `Execution()`.  No number depends on it.

    Returns
    -------
    Calibration
        Posteriors, verdicts, held-out scores, and `predict` for other tests.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, or the linear model meets vertical motion.

    References
    ----------
    .. [1] P. Grünwald, The Safe Bayesian, Algorithmic Learning Theory (2012), on tempers.
    .. [2] J.-M. Cornuet, J.-M. Marin, A. Mira and C. P. Robert, Scand. J. Stat. 39, 798-812 (2012).
    .. [3] J. Platt, Advances in Large Margin Classifiers, 61-74 (1999).

    Examples
    --------
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import DrawOptions, make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.3, height=1.2)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(3))
    >>> calibration = calibrate(tests, sampling=DrawOptions(draws=60, gains=2), model=Linear())
    >>> [row["verdict"] for row in calibration.parameters if row["parameter"] == "scatter"]
    ['not identified']
    """
    options = DrawOptions() if sampling is None else sampling
    known = Prior() if prior is None else prior
    chosen = _temper(temper)
    chosen_model = as_model("model", model)
    equations = Nonlinear(tolerance=TOLERANCE) if chosen_model is None else chosen_model
    if run is not None:
        run.in_memory("the draws of a round follow from the round before")
    objects = {name: known.object_prior(given) for name, given in tests.objects.items()}
    given = replace(tests, objects=objects)
    names, codes = codes_of(given.tests, folds)
    _refuse_alone(given.tests)
    fits = [
        _fit(
            Space(block=block, noise=known.noise, sessions=_in_sessions(given.of(name).tests)),
            given,
            np.array([k for k, test in enumerate(given.tests) if test.object == name]),
            codes,
            _Plan(sampling=options, number=number, model=equations, run=run),
        )
        for number, (name, block) in enumerate(objects.items())
    ]
    evidence = tuple(fit.evidence for fit in fits)
    trial = make_trial(given, evidence, codes, chosen, recalibrate)
    reason = why_not(given.fell, codes, folds)
    power = (1.0 if chosen is None else chosen) if reason else temper_of(trial)
    if reason:
        validation = without_scores(trial, given.tests, names, folds=folds, reason=reason)
    else:
        validation = validate_trial(trial, given.tests, names, folds=folds, seed=options.seed)
    posteriors = {
        name: _posterior(name, fit, power) for name, fit in zip(objects, fits, strict=True)
    }
    rows = [
        row
        for name, posterior in posteriors.items()
        for row in parameters_of(posterior, _prior_columns(posterior), given.of(name).fell)
    ]
    flips = count_flips(list(posteriors.values()), given.tests, model=equations, run=run)
    calibration = Calibration(
        tests=given,
        prior=known,
        sampling=options,
        model=equations,
        folds=folds,
        temper=power,
        tempered_by_choice=chosen is None,
        posteriors=posteriors,
        parameters=tuple(rows),
        validation=validation,
        flips=flips,
        warnings=(),
        evidence=evidence,
        recalibrate=recalibrate,
    )
    return replace(calibration, warnings=_warnings(calibration, fits))


@dataclass(frozen=True, kw_only=True, eq=False)
class _Plan:
    """How the draws of an object are made and run."""

    sampling: DrawOptions
    number: int
    model: Model
    run: Execution | None


@dataclass(frozen=True, kw_only=True, eq=False)
class _Fit:
    """Draws of an object with what they make of its tests."""

    space: Space
    values: Floats
    runs: DrawRuns
    motion: Integers
    evidence: Evidence


def _fit(space: Space, tests: Observations, places: Integers, codes: Integers, plan: _Plan) -> _Fit:
    """Return the draws of an object, in rounds."""
    picked = [tests.tests[place] for place in places]
    shaken, motion, shift = shared_runs(picked)
    known: Floats | None = None
    sampling, seed = plan.sampling, (plan.sampling.seed, plan.number)
    proposals: list[Proposal] = []
    scores = np.empty((0, space.size))
    runs: DrawRuns | None = None
    fit: _Fit | None = None
    outline = space.block.outline_alpha_rad
    for place, draws in enumerate(sampling.per_round):
        if fit is None:
            proposal = Proposal(draws=draws)
        else:
            proposal = refine(scores, fit.evidence.base, fit.evidence.joint, draws)
        proposals.append(proposal)
        added = proposal.sample(space.size, (*seed, place))
        scores = np.concatenate([scores, added])
        more = run_draws(
            space,
            space.values_of(added),
            shaken,
            gains=sampling.gains,
            seed=(*seed, place, 1),
            model=plan.model,
            run=plan.run,
            known=known,
        )
        runs = more if runs is None else runs.beside(more)
        values = space.values_of(scores)
        if known is None and runs.fell[0].size >= SURE:
            alike = (runs.fell == runs.fell[:, :1, :1]).all(axis=(1, 2))
            alike &= [test.peak_rad is None for test in shaken]
            known = np.where(alike, runs.fell[:, 0, 0], np.nan)
        curves = fit_curves(runs.fell, runs.gain, runs.sigma, space.features(values))
        share, alone = _shares_of(curves, motion, shift, runs.sigma)
        outliers = space.outliers(values)
        likelihood = log_likelihood(picked, runs, motion, alone, outliers, outline)
        sessions = None
        if space.sessions:
            ratio = space.noise.session_restitution.middle
            nodes = session_nodes(space.between(values), ratio)
            spread = space.sigma(values, picked)
            sessions = make_sessions(
                picked, curves, motion, shift, spread, nodes=nodes, outliers=outliers
            )
        if space.size == 0:  # all draws are one block: what differs is noise
            likelihood = np.zeros_like(likelihood)
        evidence = Evidence(
            base=base_weights(scores, proposals),
            log_likelihood=likelihood,
            share=(1.0 - outliers)[:, np.newaxis] * share + 0.5 * outliers[:, np.newaxis],
            tests=places,
            total=None if sessions is None else sessions.total(likelihood),
            sessions=sessions,
        )
        fit = _Fit(space=space, values=values, runs=runs, motion=motion, evidence=evidence)
        grouped = np.unique(codes[places], return_inverse=True)[1]
        within = replace(evidence, tests=np.arange(len(places))).by_groups(grouped)
        held = hold_out([within], grouped, 1.0, ends=False)
        few = min(float(held.effective.min()), float(effective(evidence.weights())))
        if float(held.error.max()) < sampling.error and few >= ENOUGH_DRAWS:
            break
    assert fit is not None
    return fit


def _shares_of(
    curves: Curves, motion: Integers, shift: Floats, sigma: Floats
) -> tuple[Floats, Floats]:
    """Return the probability of a fall of each test, its session unknown, shape (draws, tests).

    The first counts the runs of each draw and is for predictions, the second is of the curve alone
    and is for likelihoods.  Without an error of the gain one run is all, and counts in both.
    """
    shares = curves.shares[:, motion]
    alone = shares.copy()
    for place in np.flatnonzero(sigma[motion].any(axis=1) | (shift != 0.0)).tolist():
        number, moved = motion[place], np.full((len(shares), 1), shift[place])
        alone[:, place] = curves.at(number, moved, np.zeros((1, 1)), sigma[number])[:, 0]
    return np.where(shift == 0.0, shares, alone), alone


def _in_sessions(tests: Sequence[ShakingTest]) -> bool:
    """Return whether tests of an object come in two sessions or more."""
    return len({test.session for test in tests if test.session is not None}) > 1


def _posterior(name: str, fit: _Fit, temper: float) -> Posterior:
    """Return the posterior of an object."""
    return Posterior(
        object=name,
        space=fit.space,
        values=fit.values,
        weights=smoothed(fit.evidence.weights(temper))[0],
        untempered_weights=fit.evidence.weights(),
        prior_weights=normalised(fit.evidence.base[:, np.newaxis])[:, 0],
        fates=fit.runs.fell.mean(axis=2).T[:, fit.motion],
        sessions={} if fit.evidence.sessions is None else fit.evidence.sessions.gains(),
    )


def _prior_columns(posterior: Posterior) -> dict[str, Floats]:
    """Return draws of the prior by name."""
    space = posterior.space
    scores = Proposal(draws=PRIOR_DRAWS).sample(space.size, (0,))
    values = space.values_of(scores)
    columns = {name: values[:, place] for place, name in enumerate(space.names)}
    return columns | space.derived(values)


def _refuse_alone(tests: Sequence[ShakingTest]) -> None:
    """Refuse a session of one test, which has no gain of its own, and tests that are all one.

    Raises
    ------
    InputError
        With the name of the first.
    """
    counts = Counter(test.session for test in tests if test.session is not None)
    lone = [name for name, count in counts.items() if count == 1]
    if lone and len(counts) > 1:
        raise InputError(
            "session",
            lone[0],
            "a session has two tests or more: one alone does not separate its gain from its error",
            "put the test in the session it belongs to, or leave its session empty",
        )


def _temper(value: object) -> float | None:
    """Return a temper, or None for one that is chosen.

    Raises
    ------
    InputError
        If it is neither a number in (0, 1] nor "auto".
    """
    if isinstance(value, str):
        if value != "auto":
            raise InputError("temper", value, "it must be 'auto' or in (0, 1]", "give 1 for none")
        return None
    return in_range("temper", value, 0.0, 1.0, "(]", hint="give 1 for none, or 'auto'")


def _warnings(calibration: Calibration, fits: Sequence[_Fit]) -> tuple[str, ...]:
    """Return what limits a calibration."""
    sentences = list(calibration.tests.warnings)
    for fit, (name, posterior) in zip(fits, calibration.posteriors.items(), strict=True):
        rows = [row for row in calibration.parameters if row["object"] == name]
        for row in rows:
            if row["verdict"] == LIMIT:
                sentences.append(
                    f"{row['parameter']} of {name} lies at the limit of its prior: widen the "
                    "prior, or doubt the model"
                )
            if row["bound_side"] is not None:
                outcome = "fell" if row["bound_side"] == "upper" else "stood"
                sentences.append(
                    f"all tests of {name} {outcome}: {row['bound']:.4g} rad is the "
                    f"{row['bound_side']} bound of alpha at 90 %, and no estimate"
                )
        if posterior.effective_draws < FEWEST_DRAWS:
            sentences.append(
                f"the posterior of {name} rests on {posterior.effective_draws:.0f} effective draws "
                f"of {len(posterior.values)}: make more draws"
            )
        if not (fit.runs.fell.any(axis=(1, 2)) & ~fit.runs.fell.all(axis=(1, 2))).any():
            sentences.append(
                f"no test of {name} is informative: in each of them all draws fall, or all stand"
            )
        if fit.runs.unknown:
            sentences.append(
                f"{fit.runs.unknown:,} of {fit.runs.fell.size:,} runs of {name} have no answer, "
                "and count as standing"
            )
    predictions = calibration.validation.predictions
    sentences += error_warnings(
        predictions.mc_error, predictions.effective_draws, calibration.sampling.error
    )
    sentences += calibration.validation.warnings
    return tuple(dict.fromkeys(sentences))
