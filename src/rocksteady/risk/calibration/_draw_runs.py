"""Runs of the draws of one object, and the likelihood of its outcomes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rocksteady.arrays import Bools, Floats, Integers
from rocksteady.model.equations import ModelChoice
from rocksteady.outcomes import Status
from rocksteady.risk.calibration._shares import normal_strata
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.observations.fates import Scatter, compute_test_fates
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

WIDTH = 0.1
"""Of ln(gain) of tests that share their runs."""


@dataclass(frozen=True, kw_only=True, eq=False)
class DrawRuns:
    """Runs of draws on tests.

    Attributes
    ----------
    fell
        Shape (tests, draws, gains).
    peak_rad
        Largest angle of each run, of alpha of the side that lifts first, same shape; nan where no
        test has a measured one.
    gain
        ln of the gain over that of the test, same shape.
    sigma
        Standard deviation of it, that between sessions included, shape (tests, draws).
    unknown
        Number of runs without an answer; they count as standing.
    """

    fell: Bools
    peak_rad: Floats
    gain: Floats
    sigma: Floats
    unknown: int

    def beside(self, other: "DrawRuns") -> "DrawRuns":
        """Return these runs and those of more draws."""
        return DrawRuns(
            fell=np.concatenate([self.fell, other.fell], axis=1),
            peak_rad=np.concatenate([self.peak_rad, other.peak_rad], axis=1),
            gain=np.concatenate([self.gain, other.gain], axis=1),
            sigma=np.concatenate([self.sigma, other.sigma], axis=1),
            unknown=self.unknown + other.unknown,
        )


def run_draws(
    space: Space,
    values: Floats,
    tests: Sequence[ShakingTest],
    *,
    gains: int,
    seed: Sequence[int],
    model: ModelChoice,
    run: Execution | None,
    known: Floats | None = None,
    shift: tuple[Floats, Floats] | None = None,
) -> DrawRuns:
    """Run draws of an object on tests at gains of their own.

    Parameters
    ----------
    space, values, tests, gains, seed, model, run
        The object, its draws, the tests, how many gains, and how they are run.
    known
        Fate of each test that all draws before have alike, else nan, shape (tests,): such a test is
        not run.
    shift
        Mean and deviation of ln(gain) of the session of each test, shape (tests, draws); by default
        0 and the spread between sessions.
    """
    rng = np.random.default_rng(list(seed))
    mean, between = (0.0, space.between(values)) if shift is None else shift
    sigma = np.hypot(space.sigma(values, tests), between)
    gain = np.asarray(mean)[..., np.newaxis] + sigma[:, :, np.newaxis] * normal_strata(
        len(values), len(tests), gains, rng
    )
    if known is not None and np.isfinite(known).any():
        left = np.flatnonzero(~np.isfinite(known))
        shape = (len(tests), len(values), gains)
        fell = np.broadcast_to((known > 0.0)[:, np.newaxis, np.newaxis], shape).copy()
        peaks = np.full(shape, np.nan)
        lost = 0
        if len(left):
            part = run_draws(
                space,
                values,
                [tests[place] for place in left.tolist()],
                gains=gains,
                seed=(*seed, 2),
                model=model,
                run=run,
            )
            fell[left], peaks[left], gain[left] = part.fell, part.peak_rad, part.gain
            lost = part.unknown
        return DrawRuns(fell=fell, peak_rad=peaks, gain=gain, sigma=sigma, unknown=lost)
    block_values = space.block_values(values)
    deviation = space.block.scatter_of(block_values)
    scatter = None
    if (deviation > 0.0).any():
        scatter = Scatter(deviation=deviation, draws=1, seed=int(rng.integers(2**31)))
    measured = any(test.peak_rad is not None for test in tests)
    dataset = compute_test_fates(
        space.block.blocks(block_values),
        tests,
        gains=np.exp(gain),
        scatter=scatter,
        outputs=("status", "peak_angle") if measured else ("status",),
        model=model,
        run=run,
    )
    status = dataset["status"].transpose("test", "block", "gain", "draw").values[..., 0]
    peaks = np.full(status.shape, np.nan)  # without a measured peak none is needed
    if measured:
        peaks = dataset["peak_angle"].transpose("test", "block", "gain", "draw").values[..., 0]
    unknown = np.isin(status, (Status.LOST_CONTACT, Status.UNDECIDED, Status.ROCKING))
    alpha = space.derived(values)["alpha_rad"]
    return DrawRuns(
        fell=status == Status.OVERTURNED,
        peak_rad=peaks * alpha[:, np.newaxis],
        gain=gain,
        sigma=sigma,
        unknown=int(unknown.sum()),
    )


def shared_runs(tests: Sequence[ShakingTest]) -> tuple[list[ShakingTest], Integers, Floats]:
    """Return tests whose runs do for all, the number of it of each test, and ln of its gain over.

    Tests of one motion whose gains are within 5 % of each other's middle share their runs; their
    curve is moved by what their gains differ.  A test with a measured peak has runs of its own.
    """
    keys: dict[tuple[object, ...], list[int]] = {}
    for place, test in enumerate(tests):
        level = round(np.log(test.gain) / WIDTH)
        alone = place if test.peak_rad is not None else None
        key = (id(test.record), id(test.vertical), test.reversed, test.sigma_ln, level, alone)
        keys.setdefault(key, []).append(place)
    made, motion, shift = [], np.zeros(len(tests), dtype=np.int64), np.zeros(len(tests))
    for number, places in enumerate(keys.values()):
        logs = np.log([tests[place].gain for place in places])
        same = bool((logs == logs[0]).all())
        middle = tests[places[0]].gain if same else float(np.exp(logs.mean()))
        made.append(replace(tests[places[0]], gain=middle))
        motion[places] = number
        shift[places] = 0.0 if same else logs - logs.mean()
    return made, motion, shift


def log_likelihood(
    tests: Sequence[ShakingTest],
    runs: DrawRuns,
    motion: Integers,
    share: Floats,
    outliers: Floats,
    outline_alpha_rad: float,
) -> Floats:
    """Return ln of the likelihood of each test at each draw, shape (draws, tests).

    `motion` is the number of each test's runs, and `share` is Q, the probability of a fall without
    outliers.  The likelihood is (1 - eps) Q + eps/2 of a test that fell, and that with 1 - Q of a
    test that stood.  With a measured peak, a run that stood counts with the normal density of the
    peak about its own, and an outlier with a uniform density up to the alpha of the outline.
    """
    total = np.zeros(share.shape)
    for place, test in enumerate(tests):
        if test.fell is None:
            continue
        likely, unlike = share[:, place] if test.fell else 1.0 - share[:, place], 0.5
        if test.peak_rad is not None and test.sigma_rad is not None:
            apart = (test.peak_rad - runs.peak_rad[motion[place]]) / test.sigma_rad
            density = np.exp(-0.5 * apart * apart) / (test.sigma_rad * np.sqrt(2.0 * np.pi))
            likely = np.where(runs.fell[motion[place]], 0.0, density).mean(axis=1)
            unlike /= outline_alpha_rad
        total[:, place] = np.log((1.0 - outliers) * likely + outliers * unlike + 1e-300)
    return total
