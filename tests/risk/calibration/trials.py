"""Synthetic tests of known blocks, and how often the posterior of alpha covers the truth."""

import sys
import time
from dataclasses import dataclass, replace

import numpy as np

from rocksteady import Linear, Nonlinear, Record, Status, calibrate
from rocksteady.calibration import (
    DrawOptions,
    ObjectPrior,
    Observations,
    OutcomeErrors,
    Prior,
    PriorRange,
    ShakingTest,
)
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.calibration.calibrate import _fit, _Plan, _posterior
from rocksteady.risk.observations.fates import Scatter, compute_test_fates

ALPHA, RATE = 0.25, 4.0
LINEAR = Linear()
PRIOR = ObjectPrior(name="block", alpha_rad="0.17:0.33", p_rad_s="3:5")


@dataclass(frozen=True)
class Case:
    """A kind of trial: how many tests, with which errors, of which truth."""

    name: str
    tests: int = 40
    gain_error: float = 0.2
    sigma: str | None = None
    """What is known of the gain error; None for the default of the package."""
    factor: float | None = None
    """Housner's factor of the truth; None for one of the prior."""
    scatter: float | None = None
    model: Linear | Nonlinear = LINEAR


CASES = (
    Case("40 tests"),
    Case("40 tests, error known", sigma="0.2"),
    Case("20 tests", tests=20),
    Case("200 tests", tests=200),
    Case("gain error .1", gain_error=0.1),
    Case("gain error .4, of which .05 to .2 is known", gain_error=0.4),
    Case("gain error .4, known", gain_error=0.4, sigma="0.4"),
    Case("restitution .7 of Housner's", factor=0.7),
    Case("scatter .1", scatter=0.1),
    Case("nonlinear", model=Nonlinear()),
)


def make_records(count: int, seed: int = 0) -> list[Record]:
    """Return short strong motions: decaying sines of two frequencies, 2 s at 50 Hz."""
    rng = np.random.default_rng([seed, 1])
    t = 0.02 * np.arange(100)
    found = []
    for number in range(count):
        first, second = rng.uniform(3.0, 14.0, size=2)
        wave = np.sin(first * t + rng.uniform(0.0, 6.0)) + np.sin(
            second * t + rng.uniform(0.0, 6.0)
        )
        samples = wave * np.sin(np.pi * t / 2.0)
        scale = 2.0 * RATE / np.abs(np.cumsum(samples) * 0.02).max() * 9.81 * ALPHA / RATE**2 / 2.0
        found.append(
            Record(acceleration_m_s2=scale * samples, dt_s=0.02, name=f"motion {number + 1}")
        )
    return found


def make_tests(case: Case, seed: int) -> tuple[Observations, float]:
    """Return tests of a block drawn from the prior, and its alpha."""
    rng = np.random.default_rng([seed, 2])
    prior = PRIOR
    truth = prior.draw(rng.random((1, len(prior.parameters))))
    names = list(prior.parameters)
    if case.factor is not None:
        block = ObjectPrior(
            name="truth",
            alpha_rad=float(truth[0, names.index("alpha_rad")]),
            p_rad_s=float(truth[0, names.index("p_rad_s")]),
            housner_factor=case.factor,
        )
        truth_block = block.blocks(np.zeros((1, 1)))[0]
    else:
        truth_block = prior.blocks(truth)[0]
    deviation = float(prior.scatter_of(truth)[0]) if case.scatter is None else case.scatter
    records = make_records(case.tests // 4, seed)
    gains = np.geomspace(0.5, 2.0, 4) * np.exp(0.15 * rng.normal(size=(len(records), 4)))
    tests = [
        ShakingTest(name=f"{r.name}, {k}", record=r, object="block", gain=float(g))
        for r, row in zip(records, gains, strict=True)
        for k, g in enumerate(row)
    ]
    error = np.exp(case.gain_error * rng.normal(size=(len(tests), 1)))
    found = compute_test_fates(
        truth_block,
        tests,
        gains=error,
        scatter=Scatter(deviation, seed=seed) if deviation else None,
        model=case.model,
    )
    fell = (found["status"].values == Status.OVERTURNED).reshape(len(tests))
    other = rng.random(len(tests)) < 0.03
    fell = np.where(other, rng.random(len(tests)) < 0.5, fell)
    tests = [replace(test, fell=bool(f)) for test, f in zip(tests, fell, strict=True)]
    return Observations(tests=tests, objects={"block": prior}), truth_block.alpha


def prior_of(case: Case) -> Prior:
    """Return what is known of the errors."""
    if case.sigma is None:
        return Prior()
    return Prior(noise=OutcomeErrors(sigma_ln=PriorRange.parse(case.sigma)))


def coverage(case: Case, trials: int, *, sampling: DrawOptions) -> dict[str, float]:
    """Return how often the 90 % interval of alpha holds the truth, and how wide it is."""
    hits, widths, effective = [], [], []
    for seed in range(trials):
        tests, truth = make_tests(case, seed)
        low, high, draws = interval_of(tests, prior_of(case), replace(sampling, seed=seed), case)
        hits.append(low <= truth <= high)
        widths.append((high - low) / truth)
        effective.append(draws)
    return {
        "covered": float(np.mean(hits)),
        "width": float(np.mean(widths)),
        "effective": float(np.median(effective)),
        "least": float(np.min(effective)),
    }


def interval_of(
    tests: Observations, prior: Prior, sampling: DrawOptions, case: Case
) -> tuple[float, float, float]:
    """Return the 90 % interval of alpha without tempering, and the effective draws."""
    space = Space(block=tests.objects["block"], noise=prior.noise)
    plan = _Plan(sampling=sampling, number=0, model=case.model, run=None)
    own = np.arange(len(tests))
    codes = np.unique(tests.groups, return_inverse=True)[1]
    posterior = _posterior("block", _fit(space, tests, own, codes, plan), 1.0)
    _, low, high = posterior.interval("alpha_rad")
    return low, high, posterior.effective_draws


def seed_difference(case: Case, seeds: int, *, draws: int) -> list[float]:
    """Return the held-out accuracy of the same tests with several seeds."""
    tests, _ = make_tests(case, 0)
    found = []
    for seed in range(seeds):
        made = calibrate(
            tests, prior_of(case), sampling=DrawOptions(draws=draws, seed=seed), model=case.model
        )
        assert made.validation is not None
        found.append(made.validation.rows["calibrated"].accuracy[0])
    return found


if __name__ == "__main__":  # python -m tests.risk.calibration.trials 200: figures of the documents
    wanted = sys.argv[2:]
    for case in CASES:
        if wanted and case.name not in wanted:
            continue
        began = time.perf_counter()
        shares = coverage(case, int(sys.argv[1]), sampling=DrawOptions(draws=450))
        text = {name: round(share, 3) for name, share in shares.items()}
        sys.stdout.write(f"{case.name}: {text} in {time.perf_counter() - began:.0f} s\n")
        sys.stdout.flush()
