"""Likelihood of the outcomes of a draw: gains of sessions and errors are integrated on grids."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.risk.calibration.sampler.bench import Bench
from rocksteady.risk.calibration.sampler.exact import log_sum_exp, rounded
from rocksteady.risk.calibration.sampler.surfaces import Surfaces
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.risk.observations.spread import PriorRange

REACH, FURTHEST = 2.25, 1.5
"""Largest gain of a session, in deviations at their largest and as a logarithm."""
BLURS = 2.75
"""Largest error of the gain of a test, in deviations."""
MOST_BLUR = 6.0
LEAST_DEVIATION = 1e-3
LEAST = 1e-30
"""Probability of what cannot happen."""
_Column = tuple[int, float, float | None, tuple[float, float] | None]
"""Motion, ln of the gain over that of the motion, sigma_ln of the test, and a measured peak."""
CHUNK = 2_000_000
"""Numbers of an array of P(fall): draws are taken in parts."""


def nodes_of(spread: PriorRange, count: int) -> tuple[Floats, Floats]:
    """Return nodes of Gauss and Legendre in shares of a prior, and ln of their weights."""
    if spread.fixed:
        return np.array([spread.low]), np.zeros(1)
    x, weights = np.polynomial.legendre.leggauss(count)
    shares = rounded(0.5 * (1.0 + x), 26)
    return spread.quantile(shares), log(rounded(0.5 * weights, 30))


@dataclass(eq=False)
class Likelihood:
    """Probability of outcomes, with grids of gains and errors.

    Attributes
    ----------
    bench, noise
        Runs of the tests, and the priors of their errors.
    step
        Of ln(gain) on the grid.
    counts
        Nodes of sigma_ln, of session_ln and of the share of outliers.
    sessions
        Names of the sessions; none of one session alone.
    member
        Session of each test, -1 of none, shape (tests,).
    sigma, between, outliers
        Nodes of the errors.
    gains
        ln of the gain of a session on the grid.
    prior
        Probability of each gain at each of `between`, shape (between, gains).
    grid
        ln of the prior of the errors, shape (sigma, between, outliers).
    kinds
        Column and outcome of each kind of tests, 0 stood, 1 fell, 2 unknown, 3 stood with a
        measured peak, shape (2, kinds).
    kind, column
        Kind and column of P(fall) of each test, shape (tests,).
    """

    bench: Bench
    noise: OutcomeErrors
    step: float = 0.05
    counts: tuple[int, int, int] = (3, 5, 2)
    sessions: tuple[str, ...] = field(init=False)
    member: Integers = field(init=False)
    sigma: Floats = field(init=False)
    between: Floats = field(init=False)
    outliers: Floats = field(init=False)
    gains: Floats = field(init=False)
    prior: Floats = field(init=False)
    grid: Floats = field(init=False)
    kinds: Integers = field(init=False)
    kind: Integers = field(init=False)
    column: Integers = field(init=False)

    def __post_init__(self) -> None:
        """Lay out the grids, and sort the tests into kinds."""
        tests, noise = self.bench.tests, self.noise
        self.sessions = sessions_of(tests)
        self.member = np.array(
            [-1 if t.session is None or not self.sessions else self.sessions.index(t.session)
             for t in tests]
        )  # fmt: skip
        self.sigma, sigma_logs = nodes_of(noise.sigma_ln, self.counts[0])
        self.between, between_logs = np.zeros(1), np.zeros(1)
        if self.sessions:
            self.between, between_logs = nodes_of(noise.session_ln, self.counts[1])
        self.outliers, outliers_logs = nodes_of(noise.outliers, self.counts[2])
        reach = min(FURTHEST, REACH * float(self.between.max()))
        count = int(np.ceil(reach / self.step))
        self.gains = np.arange(-count, count + 1) * np.float64(self.step)
        deviation = np.maximum(self.between, LEAST_DEVIATION)[:, np.newaxis]
        self.prior = _normal(self.gains / deviation, 22)
        self.grid = sigma_logs[:, np.newaxis, np.newaxis] + between_logs[:, np.newaxis]
        self.grid = self.grid + outliers_logs
        keys: dict[_Column, int] = {}
        column, kinds = [], []
        for place, test in enumerate(tests):
            key = (int(self.bench.motion[place]), float(self.bench.shift[place]), test.sigma_ln)
            column.append(keys.setdefault((*key, None), len(keys)))
            outcome = 2 if test.fell is None else int(test.fell)
            if test.peak_rad is None or test.sigma_rad is None:
                kinds.append(4 * column[-1] + outcome)
            else:
                peak = (test.peak_rad, test.sigma_rad)
                kinds.append(4 * keys.setdefault((*key, peak), len(keys)) + 3)
        self._columns = list(keys)
        self.column = np.array(column)
        sorts, self.kind = np.unique(np.array(kinds), return_inverse=True)
        self.kinds = np.stack([sorts // 4, sorts % 4])

    def falls(self, surfaces: Surfaces, features: Floats) -> Floats:
        """Return P(fall) without outliers, shape (draws, columns, sigma, gains).

        Of a test that stood with a measured peak a column more has the density of that.
        """
        falls = np.empty((len(features), len(self._columns), len(self.sigma), len(self.gains)))
        columns = self._columns
        for given, peak in dict.fromkeys(column[2:] for column in columns):
            places = np.array([k for k, each in enumerate(columns) if each[2:] == (given, peak)])
            deviation = self.sigma if given is None else np.full(len(self.sigma), given)
            far = min(MOST_BLUR, BLURS * float(deviation.max())) + float(self.gains[-1])
            count = int(np.ceil(far / self.step))
            moved = self.step * np.arange(-count, count + 1)
            wide = np.maximum(deviation, LEAST_DEVIATION)[:, np.newaxis, np.newaxis]
            blur = _normal((moved - self.gains[:, np.newaxis]) / wide, 24)
            motion = np.array([columns[k][0] for k in places.tolist()])
            at = moved + np.array([columns[k][1] for k in places.tolist()])[:, np.newaxis]
            if peak is None:
                curves = surfaces.curves(features, motion, at)
            else:
                curves = surfaces.standing(features, motion, at, peak)
            flat = rounded(curves, 20).reshape(-1, len(moved)) @ blur.reshape(-1, len(moved)).T
            falls[:, places] = flat.reshape(len(features), len(places), *falls.shape[2:])
        return falls

    def logs(self, falls: Floats, outliers: float) -> Floats:
        """Return ln of the probability of each kind's outcome, shape (draws, kinds, ...)."""
        column, outcome = self.kinds
        happened = falls[:, column]
        happened[:, outcome == 0] = 1.0 - happened[:, outcome == 0]
        # An outlier has any outcome, and any peak up to the alpha of the outline.
        alike = np.where(outcome == 3, 0.5 / self.bench.space.block.outline_alpha_rad, 0.5)
        chance = (1.0 - outliers) * happened + outliers * alike[:, np.newaxis, np.newaxis]
        chance[:, outcome == 2] = 1.0
        return rounded(log(np.maximum(chance, LEAST)), 20)

    def sums(self, logs: Floats, tests: Integers) -> tuple[Floats, Floats]:
        """Return sums of logarithms over some of the tests.

        Returns
        -------
        tuple
            Of each session, shape (draws, sessions, sigma, gains), and of all tests without one,
            whose gain has no error of a session, shape (draws, sigma).
        """
        counts = np.zeros((len(self.sessions) + 1, logs.shape[1]))
        np.add.at(counts, (self.member[tests], self.kind[tests]), 1.0)
        flat = counts[:-1] @ logs.reshape(len(logs), logs.shape[1], -1)
        middle = logs[..., len(self.gains) // 2]
        alone = (counts[-1][:, np.newaxis] * middle).sum(axis=1)
        return flat.reshape(len(logs), len(self.sessions), *logs.shape[2:]), alone

    def integrated(self, sums: Floats) -> Floats:
        """Return ln of likelihoods with the gain integrated, shape (..., sigma, between)."""
        most = sums.max(axis=-1, keepdims=True)
        total = rounded(exp(sums - most), 24) @ self.prior.T
        return np.asarray(log(np.maximum(total, LEAST)) + most)

    def cells(self, surfaces: Surfaces, features: Floats, tests: Integers) -> Floats:
        """Return ln p(outcomes of some tests | draw, errors) on the grid of errors."""
        cells = np.empty((len(features), *self.grid.shape))
        for part in self.parts(len(features)):
            falls = self.falls(surfaces, features[part])
            for place, share in enumerate(self.outliers.tolist()):
                sums, alone = self.sums(self.logs(falls, share), tests)
                inside = self.integrated(sums).sum(axis=1) + alone[:, :, np.newaxis]
                cells[part, :, :, place] = inside
        return cells

    def joint(self, surfaces: Surfaces, features: Floats, tests: Integers) -> Floats:
        """Return ln p(outcomes of some tests | draw), errors integrated, shape (draws,)."""
        return self.over_errors(self.cells(surfaces, features, tests))

    def over_errors(self, cells: Floats) -> Floats:
        """Return ln of likelihoods with the errors integrated, shape (draws,)."""
        return log_sum_exp((cells + self.grid).reshape(len(cells), -1))

    def parts(self, draws: int) -> list[slice]:
        """Return parts of the draws of which P(fall) has not too many numbers."""
        each = len(self._columns) * len(self.sigma) * len(self.gains) + 1
        step = max(1, CHUNK // each)
        return [slice(begin, min(draws, begin + step)) for begin in range(0, draws, step)]


def sessions_of(tests: Sequence[ShakingTest]) -> tuple[str, ...]:
    """Return the names of sessions; none of one alone, whose gain nothing tells from alpha."""
    names = tuple(dict.fromkeys(test.session for test in tests if test.session is not None))
    return names if len(names) > 1 else ()


def _normal(z: Floats, bits: int) -> Floats:
    """Return probabilities of a normal law on a grid, which is the last axis."""
    density = rounded(exp(-0.5 * np.square(z)), 40)
    return rounded(density / density.sum(axis=-1, keepdims=True), bits)
