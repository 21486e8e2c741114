"""Calibrate: from tests that fell or stood to posteriors, scores and verdicts."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.equations import Model, ModelChoice, Nonlinear, as_model
from rocksteady.risk.calibration._flips import count_flips
from rocksteady.risk.calibration.calibration import (
    Calibration,
    Conflict,
    Folds,
    codes_of,
    validation_of,
)
from rocksteady.risk.calibration.held_out.rivals import measures_of
from rocksteady.risk.calibration.identified import contradictions, parameters_of
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.bench import Bench
from rocksteady.risk.calibration.sampler.exact import softmax
from rocksteady.risk.calibration.sampler.mixture import Mixture
from rocksteady.risk.calibration.sampler.moments import error_moments, session_moments
from rocksteady.risk.calibration.sampler.outcome_likelihood import sessions_of
from rocksteady.risk.calibration.sampler.rounds import Fit, find_posterior
from rocksteady.risk.calibration.sampler.space import WIDEST, Space, widened
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import OutcomeErrors, Prior
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.sweep.run import Execution

PRIOR_DRAWS = 4096
"""Draws of the prior that the posterior is compared with; nothing is run for them."""
TOLERANCE = 1e-8
"""Default of the full equations here."""
MOST_RUNS: Final = 6000
FEWEST, MOST = 100, 1_000_000
WIDER: Final[Mapping[str, PriorRange]] = {
    "sigma_ln": PriorRange.between(0.01, 0.6),
    "session_ln": PriorRange.between(0.0, 1.0),
    "outliers": PriorRange.between(0.001, 0.2),
}
"""Priors of errors where tests contradict the default ones."""


@checked
def calibrate(
    tests: Observations,
    prior: Prior | None = None,
    *,
    folds: Folds = "group",
    seed: Annotated[int, Whole(0, None, "give a whole number, as 0")] = 0,
    most_runs: Annotated[int, Whole(FEWEST, MOST, "give a whole number, as 6000")] = MOST_RUNS,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> Calibration:
    """Calibrate objects by the shaking tests in which they fell or stood.

    A test falls with the probability (1 - eps) Q + eps/2: Q is the share of gains exp(s + sigma_ln
    z), z standard normal and s the gain of its session, at which a run of the block falls, and eps
    the share of outliers.  Q is a logistic surface of block and gain, fitted to complete runs.
    Draws of the block come in rounds, each from a mixture about the posterior that the surfaces of
    the round before see [1]; s, sigma_ln and eps are integrated on grids.

    What is not given of an object has a prior as wide as geometry allows: where tests contradict
    it, it is widened once more, and said so.

    Parameters
    ----------
    tests
        From `read_tests`, or made by hand.
    prior
        What is known of all objects and of the errors; default `Prior()`.
    folds
        What is held out together: "group" (default; the record's name where tests have none of
        their own), "record", "test" or "session".
    seed
        Seed of all draws, default 0.
    most_runs
        Most runs of a test, default 6000: rounds end before where the posterior is found.
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
    .. [1] O. Cappe, R. Douc, A. Guillin, J.-M. Marin and C. P. Robert, Stat. Comput. 18, 447-459
       (2008).

    Examples
    --------
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.3, height=1.2)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(3))
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> calibration.describe().sentence
    'No answer: 41 effective draws of the 200 that it takes, after 200 runs of a test.'
    """
    known = Prior() if prior is None else prior
    chosen = as_model("model", model)
    equations = Nonlinear(tolerance=TOLERANCE) if chosen is None else chosen
    if run is not None:
        run.in_memory("the draws of a round follow from the round before")
    plan = _Plan(seed=seed, most_runs=most_runs, model=equations, run=run)
    names, codes = codes_of(tests.tests, folds)
    fits: list[Fit] = []
    posteriors: dict[str, Posterior] = {}
    rows: list[dict[str, Any]] = []
    conflicts: list[Conflict] = []
    for number, (name, given) in enumerate(tests.objects.items()):
        shaken = tests.of(name)
        fit, contradicted = _fit(known.object_prior(given), known.noise, shaken, number, plan)
        posterior = _posterior(name, fit)
        ends = {each.parameter: each.side for each in contradicted if not each.widened}
        rows += parameters_of(
            posterior,
            _prior_columns(posterior),
            shaken.fell,
            contradictions(fit) | ends,
            given.outline_alpha_rad,
        )
        fits.append(fit)
        posteriors[name] = posterior
        conflicts += contradicted
    blocks = {name: each.space.block for name, each in posteriors.items()}
    observed, measures = replace(tests, objects=blocks), measures_of(tests.tests, blocks)
    validation = validation_of(observed, fits, measures, names, codes, folds=folds, seed=seed)
    new_day = None
    if folds != "session" and sessions_of(tests.tests):
        days, day = codes_of(tests.tests, "session")
        new_day = validation_of(
            observed, fits, measures, days, day, folds="session", seed=seed, learning=False
        )
    return Calibration(
        tests=observed,
        prior=known,
        seed=seed,
        most_runs=most_runs,
        model=equations,
        posteriors=posteriors,
        parameters=tuple(rows),
        validation=validation,
        new_day=new_day,
        conflicts=tuple(conflicts),
        flips=count_flips(list(posteriors.values()), tests.tests, model=equations, run=run),
        fits=tuple(fits),
        measures=measures,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Plan:
    """How the draws of an object are made and run."""

    seed: int
    most_runs: int
    model: Model
    run: Execution | None


def _fit(
    given: ObjectPrior, noise: OutcomeErrors, tests: Observations, number: int, plan: _Plan
) -> tuple[Fit, list[Conflict]]:
    """Return the draws of an object, with priors widened where its tests contradict them."""
    silent = dict.fromkeys(_silent(given, tests), False)
    usual = OutcomeErrors()
    errors = [name for name in WIDER if getattr(noise, name) == getattr(usual, name)]

    def fitted(noise: OutcomeErrors, turn: int) -> Fit:
        space, widest = Space(block=widened(given, silent)), noise.sigma_ln.high
        bench = Bench(space, tests.tests, plan.model, plan.run, sigma=widest)
        seed = (plan.seed, number, turn)
        return find_posterior(bench, noise, seed=seed, most_runs=plan.most_runs)

    fit = fitted(noise, 0)
    spreads = fit.bench.space.block.spreads
    conflicts = [
        Conflict(
            object=given.name,
            parameter=name,
            side=side,
            prior=getattr(noise, name) if name in WIDER else spreads[name],
            widened=name in silent or name in errors,
        )
        for name, side in contradictions(fit).items()
    ]
    wide = [each.parameter for each in conflicts if each.widened]
    if wide:
        silent |= {name: True for name in wide if name in silent}
        wider = {name: WIDER[name] for name in wide if name in errors}
        fit = fitted(replace(noise, **wider), len(conflicts))
    return fit, sorted(conflicts, key=lambda each: each.widened)


def _silent(given: ObjectPrior, tests: Observations) -> tuple[str, ...]:
    """Return the names of numbers that are not given, whose priors are as wide as geometry."""
    spreads, silent = given.spreads, list(given.defaults)
    if "width_m" in spreads and "mass_centre_height_m" not in spreads:
        silent.append("mass_centre_height_m")
    if "alpha_rad" not in spreads and "gyration_m" not in spreads:
        silent.append("gyration_m")
    several = any(test.transverse is not None for test in tests.tests)
    if several and "orientation_rad" not in spreads:
        silent.append("orientation_rad")
    return tuple(name for name in silent if name in WIDEST)


def _posterior(name: str, fit: Fit) -> Posterior:
    """Return the posterior of an object."""
    errors = error_moments(fit)
    return Posterior(
        object=name,
        space=fit.bench.space,
        values=fit.values,
        weights=fit.weights,
        prior_weights=softmax(fit.base),
        errors=errors,
        noise={key: getattr(fit.likelihood.noise, key) for key in errors},
        sessions=session_moments(fit),
    )


def _prior_columns(posterior: Posterior) -> dict[str, Floats]:
    """Return draws of the prior by name."""
    space = posterior.space
    values = space.values_of(Mixture(space.size).sample(PRIOR_DRAWS, (0,)))
    columns = {name: values[:, place] for place, name in enumerate(space.names)}
    shares = (np.arange(PRIOR_DRAWS) + 0.5) / PRIOR_DRAWS
    errors = {name: spread.quantile(shares) for name, spread in posterior.noise.items()}
    return columns | space.derived(values) | errors
