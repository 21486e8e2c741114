"""Predictions of tests without their groups: reweighted draws, or draws made anew on surfaces."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.results.doubts import ENOUGH_DRAWS, FEWEST_DRAWS
from rocksteady.risk.calibration.sampler.exact import effective, rounded, softmax
from rocksteady.risk.calibration.sampler.mixture import MOST_K, balance, pareto_k
from rocksteady.risk.calibration.sampler.outcome_likelihood import Likelihood
from rocksteady.risk.calibration.sampler.rounds import ROUGH, Fit, explore
from rocksteady.risk.calibration.sampler.surfaces import Surfaces

KEPT = 0.9995
"""Weight of the draws that predict."""
REFITTED = 768
"""Draws of a group that is predicted anew."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeldOut:
    """Predictions of tests without their groups, shape (tests,) each.

    Attributes
    ----------
    p
        Probability of a fall, outliers included.
    low, high
        5 and 95 % of it over the draws; nan below 50 effective draws.
    error
        Monte Carlo error of p: that of the draws, and that of the surfaces.
    effective
        Effective draws behind it.
    """

    p: Floats
    low: Floats
    high: Floats
    error: Floats
    effective: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """Tests that are left out, and tests that are asked for, by their numbers."""

    left: Integers
    asked: Integers


@dataclass(frozen=True, kw_only=True, eq=False)
class Draws:
    """Draws with what they say: properties of blocks, and ln(prior/density they came from)."""

    likelihood: Likelihood
    surfaces: Surfaces
    features: Floats
    base: Floats


def hold_out(fits: Sequence[Fit], tests: Sequence[Integers], codes: Integers) -> HeldOut:
    """Return predictions of each test from the tests of other groups.

    The draws are reweighted where they keep 100 effective ones and Pareto's k stays below 0.7;
    else the posterior without the group is found anew on the surfaces, without a run.

    Parameters
    ----------
    fits, tests
        Fit of each object, and the numbers of its tests among all.
    codes
        Number of each test's group.
    """
    held = blank(len(codes))
    for fit, places in zip(fits, tests, strict=True):
        groups = [np.flatnonzero(codes[places] == code) for code in np.unique(codes[places])]
        cases = [Case(left=group, asked=group) for group in groups]
        total = fit.base + fit.joint
        order = np.argsort(-total, kind="stable")
        count = int(np.searchsorted(np.cumsum(softmax(total)[order]), KEPT)) + 1
        heavy = np.sort(order[:count])
        draws = Draws(
            likelihood=fit.likelihood,
            surfaces=fit.surfaces,
            features=fit.features[heavy],
            base=fit.base[heavy],
        )
        for case, (part, k) in zip(cases, predict_cases(draws, cases), strict=True):
            few = part.effective[0] < ENOUGH_DRAWS or k > MOST_K
            fill(held, places[case.asked], refit(fit, case) if few else part)
        rough = Likelihood(fit.bench, fit.likelihood.noise, *ROUGH)
        halves = np.empty((2, len(places)))
        for side, surfaces in enumerate(fit.halves):
            parts = predict_cases(replace(draws, likelihood=rough, surfaces=surfaces), cases)
            for case, (part, _) in zip(cases, parts, strict=True):
                halves[side, case.asked] = part.p
        held.error[places] = with_surfaces(held.error[places], held.p[places], halves)
    return held


def with_surfaces(error: Floats, p: Floats, halves: Floats) -> Floats:
    """Return Monte Carlo errors with that of the surfaces in them.

    That is the difference between surfaces of halves of the draws, as a share of sqrt(p (1 - p)),
    one for all tests.  By chance alone it were twice the error of surfaces of all draws; but other
    seeds also fit their surfaces elsewhere, and their predictions differ by about as much.

    Parameters
    ----------
    error, p
        Errors by the draws alone, and probabilities, shape (tests,).
    halves
        Probabilities by either half, shape (2, tests).
    """
    spread = p * (1.0 - p)
    square = np.square(halves[0] - halves[1]).sum() / np.maximum(spread.sum(), 1e-9)
    total: Floats = np.sqrt(np.square(error) + square * spread)
    return total


def refit(fit: Fit, case: Case) -> HeldOut:
    """Return predictions by draws of their own, made without the tests that are left out."""
    space, bench = fit.bench.space, fit.bench
    rough = Likelihood(bench, fit.likelihood.noise, *ROUGH)
    kept = np.setdiff1d(np.arange(len(bench.tests)), case.left)
    mixture = explore(
        lambda x: rough.joint(fit.surfaces, space.features(space.values_of(x)), kept),
        fit.proposal,
        1.0,
        (*fit.seed, 77),
        sweeps=2,
    )
    scores = mixture.sample(REFITTED, (*fit.seed, 78))
    draws = Draws(
        likelihood=fit.likelihood,
        surfaces=fit.surfaces,
        features=space.features(space.values_of(scores)),
        base=balance(scores, [mixture], [1]),
    )
    return predict_cases(draws, [case])[0][0]


def predict_cases(draws: Draws, cases: Sequence[Case]) -> list[tuple[HeldOut, float]]:
    """Predict the asked tests of each case from its training tests, with Pareto's k.

    Tests are taken out of the sums of their sessions: so the gain of a session is learnt from its
    other tests, and comes from the prior where none is left.
    """
    like, count = draws.likelihood, len(draws.features)
    cells = [np.empty((count, *like.grid.shape)) for _ in cases]
    shares = [np.empty((count, len(case.asked), *like.grid.shape)) for case in cases]
    every = np.arange(len(like.member))
    for part in like.parts(count):
        falls = rounded(like.falls(draws.surfaces, draws.features[part]), 20)
        for place, share in enumerate(like.outliers.tolist()):
            logs = like.logs(falls, share)
            sums, alone = like.sums(logs, every)
            whole = like.integrated(sums)
            total = whole.sum(axis=1) + alone[:, :, np.newaxis]
            for number, case in enumerate(cases):
                out, out_alone = like.sums(logs, case.left)
                touched = np.unique(like.member[np.union1d(case.left, case.asked)])
                touched = touched[touched >= 0]
                rest = sums[:, touched] - out[:, touched]
                change = (like.integrated(rest) - whole[:, touched]).sum(axis=1)
                cells[number][part, :, :, place] = total + change - out_alone[:, :, np.newaxis]
                falling = _shares(like, falls, rest, touched, case.asked)
                shares[number][part, ..., place] = falling
    return [
        _weighed(like, draws.base, cell, share) for cell, share in zip(cells, shares, strict=True)
    ]


def _shares(
    like: Likelihood, falls: Floats, rest: Floats, touched: Integers, asked: Integers
) -> Floats:
    """Return P(fall) of tests with gains by the rest of their sessions.

    Returns
    -------
    ndarray
        Shape (draws, asked, sigma, between).
    """
    after = exp(rest - rest.max(axis=-1, keepdims=True))[:, :, :, np.newaxis] * like.prior
    after = rounded(after / after.sum(axis=-1, keepdims=True), 24)
    shape = (len(falls), len(asked), *like.grid.shape[:2])
    share = np.empty(shape)
    middle = len(like.gains) // 2
    for place, test in enumerate(asked.tolist()):
        falling = falls[:, like.column[test]]
        if like.member[test] < 0:
            share[:, place] = falling[:, :, middle, np.newaxis]
            continue
        number = int(np.flatnonzero(touched == like.member[test])[0])
        share[:, place] = (after[:, number] @ falling[..., np.newaxis])[..., 0]
    return share


def _weighed(like: Likelihood, base: Floats, cells: Floats, share: Floats) -> tuple[HeldOut, float]:
    """Return predictions weighted over draws and errors."""
    weights = softmax(cells + like.grid + base[:, np.newaxis, np.newaxis, np.newaxis])
    of_draws = weights.sum(axis=(1, 2, 3))
    # Over the errors of each draw, outliers included.
    sober = weights * (1.0 - like.outliers)
    noise = 0.5 * (weights * like.outliers).sum(axis=(1, 2, 3))
    mass = (share * sober[:, np.newaxis]).sum(axis=(2, 3, 4)) + noise[:, np.newaxis]
    of_each = mass / np.maximum(of_draws, 1e-300)[:, np.newaxis]
    return weighed(of_draws, of_each), pareto_k(of_draws)


def weighed(weights: Floats, share: Floats) -> HeldOut:
    """Return weighted means of probabilities, with bands and Monte Carlo errors.

    The error of a weighted mean is that of self-normalised importance sampling [1].

    Parameters
    ----------
    weights
        Shape (draws,), which sum to 1.
    share
        Probability at each draw, shape (draws, tests).

    References
    ----------
    .. [1] A. B. Owen, Monte Carlo Theory, Methods and Examples (2013), 9.2.
    """
    column, count = weights[:, np.newaxis], effective(weights)
    p = rounded(column * share, 50).sum(axis=0)
    error = np.sqrt(np.square(column * (share - p)).sum(axis=0))
    # Of a draw that has all the weight the formula gives 0, and of its error nothing is known.
    error = error / np.sqrt(1.0 - 1.0 / count) if count > 2.0 else np.full(len(p), 0.5)
    ends = weighted_quantiles(share, weights, (0.05, 0.95))
    low, high = ends if count >= FEWEST_DRAWS else np.full((2, len(p)), np.nan)
    return HeldOut(p=p, low=low, high=high, error=error, effective=np.full(len(p), count))


def weighted_quantiles(values: Floats, weights: Floats, at: Sequence[float]) -> Floats:
    """Return the least values that have so much weight at or below them, shape (at, columns)."""
    order = np.argsort(values, axis=0, kind="stable")
    ranked = np.take_along_axis(values, order, axis=0)
    below = np.cumsum(weights[order], axis=0)
    rows = [np.minimum((below < share).sum(axis=0), len(values) - 1) for share in at]
    return np.array([ranked[row, np.arange(values.shape[1])] for row in rows])


def blank(tests: int) -> HeldOut:
    """Return predictions that are not there yet."""
    return HeldOut(**{each.name: np.full(tests, np.nan) for each in fields(HeldOut)})


def fill(held: HeldOut, places: Integers | Bools, part: HeldOut) -> None:
    """Write predictions of some tests among those of all."""
    for each in fields(HeldOut):
        getattr(held, each.name)[places] = getattr(part, each.name)
