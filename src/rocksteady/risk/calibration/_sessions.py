"""Sessions: a gain and a restitution that tests of one set-up share, as random effects."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.risk.calibration._shares import Curves
from rocksteady.risk.calibration.held_out.folds import Evidence
from rocksteady.risk.observations.shaking_test import ShakingTest

REACH, NODES = 3.0, 15
"""Standard deviations of the gain of a session that its nodes span, and their number."""
RATIO_NODES = 3
ENOUGH = 20
"""Tests of a session from which on it has a restitution of its own."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Sessions:
    """What draws make of tests at nodes of what their sessions share.

    Each draw has the likelihood of its sessions, integrated over their gains and restitutions: no
    session adds a parameter to the draws.

    Attributes
    ----------
    names
        Names of the sessions.
    member
        Number of the session of each test, -1 of none and of a test with a measured peak, shape
        (tests,).
    column
        Column of each test in `falls`, shape (tests,).
    falls
        Probability of a fall without outliers, shape (columns, draws, nodes).
    gain
        ln of the gain at the nodes, shape (draws, nodes).
    weight
        ln of the prior of the nodes, for few and for many tests, shape (2, nodes).
    outliers
        Shape (draws,).
    fell
        Outcomes, nan of unknown ones, shape (tests,).
    """

    names: tuple[str, ...]
    member: Integers
    column: Integers
    falls: Floats
    gain: Floats
    weight: Floats
    outliers: Floats
    fell: Floats

    def likelihoods(self, session: int) -> tuple[Integers, Floats, Floats]:
        """Return the tests of a session, their ln likelihoods at the nodes, and ln of the prior."""
        tests = np.flatnonzero(self.member == session)
        fell = self.fell[tests]
        known, outliers = np.isfinite(fell), self.outliers[:, np.newaxis]
        # Tests of one motion and gain that ended alike have one likelihood.
        kinds, kind = np.unique(3 * self.column[tests] + known + (fell > 0.0), return_inverse=True)
        logs = np.zeros((len(kinds), *self.falls.shape[1:]))
        for row, (column, outcome) in enumerate(zip(*divmod(kinds, 3), strict=True)):
            if outcome:
                p = self.falls[column].astype(np.float64)
                likely = p if outcome == 2 else 1.0 - p
                logs[row] = np.log((1.0 - outliers) * likely + 0.5 * outliers + 1e-300)
        return tests, logs[kind], self.weight[int(known.sum() >= ENOUGH)]

    def gains(self) -> dict[str, Floats]:
        """Return mean and deviation of ln(gain) of each session at each draw, shape (draws, 2)."""
        gains = {}
        for number, name in enumerate(self.names):
            _, logs, prior = self.likelihoods(number)
            _, weights = _posterior(prior + logs.sum(axis=0))
            mean = (weights * self.gain).sum(axis=1)
            square = (weights * np.square(self.gain - mean[:, np.newaxis])).sum(axis=1)
            gains[name] = np.column_stack([mean, np.sqrt(square)])
        return gains

    def condition(self, evidence: Evidence, codes: Integers) -> Evidence:
        """Return the evidence with each test seen from the other groups of its session.

        The likelihood of a group is then p(session)/p(session without the group), and the share of
        its tests is that by the nodes' posterior without it.  So to leave one group out is exact;
        two groups out are nearly so.

        Parameters
        ----------
        evidence
            Evidence of the object whose sessions they are.
        codes
            Group of each test of the object, shape (tests,).
        """
        logs, share = evidence.log_likelihood.copy(), evidence.share.copy()
        alone = self.member < 0
        total = logs[:, alone].sum(axis=1)
        outliers = self.outliers[:, np.newaxis]
        for number in range(len(self.names)):
            tests, each, prior = self.likelihoods(number)
            every = prior + each.sum(axis=0)
            whole, _ = _posterior(every)
            total += whole
            logs[:, tests] = 0.0
            for group in np.unique(codes[tests]):
                members = codes[tests] == group
                rest, weights = _posterior(every - each[members].sum(axis=0))
                places = tests[members]
                logs[:, places] = ((whole - rest) / len(places))[:, np.newaxis]
                p = np.einsum("tdn,dn->dt", self.falls[self.column[places]], weights)
                share[:, places] = (1.0 - outliers) * p + 0.5 * outliers
        return replace(evidence, log_likelihood=logs, share=share, total=total)

    def total(self, logs: Floats) -> Floats:
        """Return ln of the likelihood of all tests at each draw, from that of each test alone."""
        total: Floats = logs[:, self.member < 0].sum(axis=1)
        for number in range(len(self.names)):
            _, each, prior = self.likelihoods(number)
            total = total + _posterior(prior + each.sum(axis=0))[0]
        return total


def session_nodes(deviation: Floats, ratio: float) -> tuple[Floats, Floats, Floats]:
    """Return gains, restitutions and ln weights of the nodes of a session.

    Parameters
    ----------
    deviation
        Standard deviation of ln(gain) between sessions, shape (draws,).
    ratio
        Standard deviation of the restitution between sessions.

    Returns
    -------
    tuple
        ln gains of shape (draws, nodes), offsets of shape (1, nodes), and ln weights of shape
        (2, nodes): without offsets, and with them.
    """
    z = np.linspace(-REACH, REACH, NODES)
    density = np.exp(-0.5 * z * z)
    offsets, shares = np.polynomial.hermite_e.hermegauss(RATIO_NODES)
    middle = (np.arange(RATIO_NODES) == RATIO_NODES // 2) + 1e-300
    weights = [np.log(np.outer(density / density.sum(), each)).ravel() for each in (
        middle, shares / shares.sum())]  # fmt: skip
    gains = deviation[:, np.newaxis] * np.repeat(z, RATIO_NODES)
    return gains, np.tile(ratio * offsets, NODES)[np.newaxis], np.array(weights)


def make_sessions(
    tests: Sequence[ShakingTest],
    curves: Curves,
    motion: Integers,
    shift: Floats,
    sigma: Floats,
    *,
    nodes: tuple[Floats, Floats, Floats],
    outliers: Floats,
) -> Sessions:
    """Return the sessions of the tests of an object.

    Parameters
    ----------
    tests
        All tests of the object.
    curves
        Curves of its motions.
    motion, shift
        Motion of each test, and ln of its gain over that of the motion's runs, shape (tests,).
    sigma
        Amplitude error of each test without that of its session, shape (tests, draws).
    nodes
        From `session_nodes`.
    outliers
        Shape (draws,).
    """
    names = tuple(dict.fromkeys(test.session for test in tests if test.session is not None))
    gains, ratios, weight = nodes
    keys: dict[tuple[int, float, float | None], int] = {}
    falls: list[NDArray[np.float32]] = []
    column: list[int] = []
    for place, test in enumerate(tests):
        key = (int(motion[place]), float(shift[place]), test.sigma_ln)
        if key not in keys:
            keys[key] = len(falls)
            falls.append(curves.at(key[0], key[1] + gains, ratios, sigma[place]).astype(np.float32))
        column.append(keys[key])
    return Sessions(
        names=names,
        member=np.array(
            [
                -1 if t.session is None or t.peak_rad is not None else names.index(t.session)
                for t in tests
            ]
        ),
        column=np.array(column),
        falls=np.array(falls),
        gain=gains,
        weight=weight,
        outliers=outliers,
        fell=np.array([np.nan if test.fell is None else float(test.fell) for test in tests]),
    )


def _posterior(logs: Floats) -> tuple[Floats, Floats]:
    """Return ln of the sum over the nodes, shape (draws,), and their weights."""
    most = logs.max(axis=1)
    weights = np.exp(logs - most[:, np.newaxis])
    sums = weights.sum(axis=1)
    return most + np.log(sums), weights / sums[:, np.newaxis]
