"""Rounds of runs, each where the surfaces see the posterior: population Monte Carlo.

All draws of a round are independent runs, which fill the kernel and all cores; a Markov chain waits
for its last step.  One group of tests less is another weight and no new run, which makes held-out
posteriors affordable.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.model.checks.arrays import guard_result
from rocksteady.risk.calibration.sampler.bench import GAINS, Bench
from rocksteady.risk.calibration.sampler.exact import effective, rounded, softmax
from rocksteady.risk.calibration.sampler.mixture import (
    MOST_K,
    Mixture,
    balance,
    fit_mixture,
    pareto_k,
    temper_of,
)
from rocksteady.risk.calibration.sampler.outcome_likelihood import Likelihood
from rocksteady.risk.calibration.sampler.surfaces import Surfaces
from rocksteady.risk.observations.prior import OutcomeErrors

FIRST, EACH, LAST = 512, 192, 320
"""Draws of the first round, of each until the temper is 1, and of each after that."""
LEAST_EFFECTIVE = 40.0
"""Draws that a proposal is fitted to: with fewer the likelihood is tempered until there are."""
GOAL = 300.0
"""Effective draws that end the rounds."""
ROUNDS = 3
"""Rounds at the whole likelihood before the end."""
APART = 2.0
"""Largest deviation of ln L between surfaces fitted to halves of the draws."""
ROUGH = (0.1, (2, 3, 1))
"""Step and nodes of the likelihood between rounds."""
HEAVY = 14.0
"""ln of the largest weight over that of a draw which still counts."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Round:
    """One round: its draws, temper, effective draws of all, and how far halves differ in ln L."""

    draws: int
    temper: float
    effective: float
    apart: float


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """Draws that have been run, weighted by all outcomes.

    Attributes
    ----------
    bench, likelihood, surfaces
        Runs, the likelihood of outcomes, and the surfaces that it takes.
    scores, values, features
        Draws as normal scores, as values, and as properties of blocks.
    base
        ln(prior/mixture of all rounds), shape (draws,).
    cells, joint
        ln of the likelihood on the grid of errors, and with errors integrated.
    proposal
        The mixture that the last round has been drawn from.
    rounds
        How they went.
    halves
        Surfaces fitted to halves of the draws.
    seed
        Of all draws.
    """

    bench: Bench
    likelihood: Likelihood
    surfaces: Surfaces
    halves: tuple[Surfaces, Surfaces]
    scores: Floats
    values: Floats
    features: Floats
    base: Floats
    cells: Floats
    joint: Floats
    proposal: Mixture
    rounds: tuple[Round, ...]
    seed: tuple[int, ...]

    @property
    def weights(self) -> Floats:
        """Weights of the draws, which sum to 1."""
        return softmax(self.base + self.joint)


def find_posterior(
    bench: Bench, noise: OutcomeErrors, *, seed: Sequence[int], most_runs: int
) -> Fit:
    """Return draws with weights, from rounds of runs.

    A round runs its draws, fits the surfaces anew, and explores them, where a draw costs nothing,
    for the mixture that the next round is drawn from.

    Parameters
    ----------
    bench
        Tests and motions.
    noise
        What is known of their errors.
    seed
        Of all draws.
    most_runs
        Most runs of a motion.
    """
    space, every, seed = bench.space, np.arange(len(bench.tests)), tuple(seed)
    size = space.size
    rough = Likelihood(bench, noise, *ROUGH)
    proposals: list[Mixture] = []
    counts: list[int] = []
    history: list[Round] = []
    scores, mixture = np.empty((0, size)), Mixture(size)
    live = np.ones(len(bench.shaken), dtype=bool)
    surfaces: Surfaces | None = None
    halves: tuple[Surfaces, Surfaces] | None = None
    while True:
        turn = len(history)
        whole = [each.temper >= 1.0 for each in history]
        draws = FIRST if not turn else LAST if any(whole) else EACH
        draws = min(draws, max((most_runs - bench.runs) // GAINS, 1))
        drawn = mixture.sample(draws, (*seed, turn))
        proposals.append(mixture)
        counts.append(draws)
        if not turn:
            live = bench.liftable(space.values_of(drawn))
        bench.add(space.values_of(drawn), (*seed, turn, 1), live)
        scores = np.vstack([scores, drawn])
        values = space.values_of(scores)
        features = space.features(values)
        base = balance(scores, proposals, counts)
        near = mixture.closeness(scores)
        surfaces = _surfaces(bench, near, surfaces)
        joint = _joint(rough, surfaces, features, near, every)
        temper = temper_of(base, joint, min(LEAST_EFFECTIVE, 0.2 * len(scores)))
        weights = softmax(base + joint)
        carried = effective(weights), pareto_k(weights)
        good = carried[0] >= GOAL and not carried[1] >= MOST_K and sum(whole) + 1 >= ROUNDS
        apart, halves = np.nan, None
        if temper >= 1.0 and (good or size == 0):
            halves = _halves(bench, near)
            apart = _apart(halves, rough, features, weights, seed)
        history.append(Round(draws=draws, temper=temper, effective=carried[0], apart=apart))
        if apart < APART or size == 0 or bench.runs + GAINS * 2 > most_runs:
            break
        begin = fit_mixture(scores, softmax(base + temper * joint), 3, (*seed, turn, 2), widen=1.4)
        mixture = explore(
            lambda x: rough.joint(surfaces, space.features(space.values_of(x)), every),  # noqa: B023
            begin,
            temper,
            (*seed, turn, 3),
        )
        live = _undecided(bench, surfaces, mixture, (*seed, turn, 4))
    fine = Likelihood(bench, noise)
    rank = base + joint
    heavy = np.flatnonzero(rank > rank.max() - HEAVY)
    cells = np.full((len(scores), *fine.grid.shape), -1e6)
    cells[heavy] = fine.cells(surfaces, features[heavy], every)
    total = np.full(len(scores), -1e6)
    total[heavy] = fine.over_errors(cells[heavy])
    return Fit(
        bench=bench,
        likelihood=fine,
        surfaces=surfaces,
        halves=_halves(bench, near) if halves is None else halves,
        scores=scores,
        values=values,
        features=features,
        base=base,
        cells=cells,
        joint=total,
        proposal=mixture,
        rounds=tuple(history),
        seed=seed,
    )


def explore(
    target: Callable[[Floats], Floats],
    mixture: Mixture,
    temper: float,
    seed: Sequence[int],
    *,
    draws: int = 768,
    sweeps: int = 3,
    parts: int = 4,
) -> Mixture:
    """Return a mixture for the posterior to the power of a temper, found on surfaces alone.

    Parameters
    ----------
    target
        Returns ln of the likelihood of scores.
    mixture
        Where to begin.
    temper, seed, draws, sweeps, parts
        Power of the likelihood, and how the mixture is found.
    """
    points, joint = np.empty((0, mixture.size)), np.empty(0)
    proposals: list[Mixture] = []
    for sweep in range(sweeps):
        proposals.append(mixture)
        drawn = mixture.sample(draws, (*seed, sweep))
        points, joint = np.vstack([points, drawn]), np.append(joint, target(drawn))
        logs = balance(points, proposals, [1] * len(proposals)) + temper * joint
        weights = softmax(logs)
        if effective(weights) < 25.0:  # too far for one step
            weights = softmax(0.3 * np.maximum(logs - logs.max(), -600.0))
        mixture = fit_mixture(points, weights, parts, (*seed, sweep, 9))
    return mixture


def _surfaces(bench: Bench, near: Floats, before: Surfaces | None) -> Surfaces:
    start = None if before is None else before.at
    weight = np.repeat(near, GAINS)
    return Surfaces(bench.features, bench.gain, bench.fell, bench.peaks, weight, start)


def _joint(
    likelihood: Likelihood, surfaces: Surfaces, features: Floats, near: Floats, tests: Integers
) -> Floats:
    """Return ln of the likelihood of the draws that surfaces were fitted to; others have none."""
    joint = np.full(len(features), -1e6)
    inside = near > 0.02
    joint[inside] = likelihood.joint(surfaces, features[inside], tests)
    return joint


def _halves(bench: Bench, near: Floats) -> tuple[Surfaces, Surfaces]:
    half = np.arange(len(near)) % 2
    first, second = (_surfaces(bench, near * (half == side), None) for side in (0, 1))
    return first, second


def _apart(
    halves: tuple[Surfaces, Surfaces],
    likelihood: Likelihood,
    features: Floats,
    weights: Floats,
    seed: Sequence[int],
) -> float:
    """Return the deviation of ln L over the posterior between surfaces of halves of the draws."""
    rng = np.random.default_rng([*seed, 5])
    chosen = rng.choice(len(weights), 96, p=weights)
    every = np.arange(len(likelihood.member))
    logs = [likelihood.joint(half, features[chosen], every) for half in halves]
    return float(np.std(rounded(logs[0] - logs[1], 20)))


def _undecided(bench: Bench, surfaces: Surfaces, mixture: Mixture, seed: Sequence[int]) -> Bools:
    """Return which motions some draw of a mixture can make fall and another stand."""
    space, sure = bench.space, 0.003
    features = space.features(space.values_of(mixture.sample(128, seed)))
    moved = bench.reach * np.array([[-1.0, -0.5, 0.0, 0.5, 1.0]])
    curves = surfaces.curves(features, np.arange(len(bench.shaken)), moved)
    low, high = curves.min(axis=(0, 2)), curves.max(axis=(0, 2))
    return np.asarray((high > sure) & (low < 1.0 - sure))
