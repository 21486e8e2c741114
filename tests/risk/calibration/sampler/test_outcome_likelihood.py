"""Likelihoods against sums over fine grids of gains and errors."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.calibration.sampler.outcome_likelihood import Likelihood, sessions_of
from tests.risk.calibration.toys import FEATURES, Known, chance, make_toy

FIVE = ("a", "a", "b", "a", "b")
FELL = (True, False, True, True, None)


def brute(toy: Likelihood, lean: float) -> float:
    """Return ln of the likelihood of a draw by midpoint sums, each error on its own grid."""
    tests, noise = toy.bench.tests, toy.noise
    z = np.linspace(-6.0, 6.0, 121)
    normal = stats.norm.pdf(z) / stats.norm.pdf(z).sum()
    middles = (np.arange(40) + 0.5) / 40.0
    sigmas, betweens = noise.sigma_ln.quantile(middles), noise.session_ln.quantile(middles)
    outliers = noise.outliers.quantile((np.arange(8) + 0.5) / 8.0)
    shift = np.linspace(-2.4, 2.4, 97)
    names = sessions_of(tests)
    prior = stats.norm.pdf(shift / betweens[:, np.newaxis])
    prior /= prior.sum(axis=1, keepdims=True)
    parts = []
    for sigma, share in itertools.product(sigmas, outliers):
        inside = np.ones(len(betweens))
        for name in (*names, None):
            product = np.ones(len(shift))
            for place, test in enumerate(tests):
                if (test.session if names else None) == name and test.fell is not None:
                    error = sigma if test.sigma_ln is None else test.sigma_ln
                    fall = chance(place, shift[:, np.newaxis] + error * z, lean) @ normal
                    p = (1.0 - share) * fall + 0.5 * share
                    product *= p if test.fell else 1.0 - p
            inside *= product[48] if name is None else prior @ product
        parts.append(inside.mean())
    return math.log(np.mean(parts))


@pytest.mark.parametrize("sessions", [FIVE, ("a",) * 5, (None,) * 5, ("a", None, "b", "c", None)])
def test_gains_and_errors_are_integrated(sessions: tuple[str | None, ...]) -> None:
    toy = make_toy(sessions, FELL)
    found = toy.joint(Known(), FEATURES[:3], np.arange(5))
    exact = [brute(toy, float(row[0])) for row in FEATURES[:3]]
    assert found == pytest.approx(exact, abs=0.01)


def test_a_test_may_have_an_error_of_its_own_and_share_its_runs() -> None:
    toy = make_toy(FIVE, FELL, sigma_ln=(None, 0.02, 0.5, None, None))
    found = toy.joint(Known(), FEATURES[:2], np.arange(5))
    assert found == pytest.approx([brute(toy, row[0]) for row in FEATURES[:2]], abs=0.01)
    # A gain that differs by 3 % from that of its motion: the surface is moved by it.
    first = toy.bench.tests[0]
    near = replace(first, name="near", gain=first.gain * 1.03)
    both = make_toy((None,) * 2, (True, True), tests=[first, near])
    assert both.bench.motion.tolist() == [0, 0]
    falls = both.falls(Known(), FEATURES[:1])[0, :, 0, len(both.gains) // 2]
    slope = (chance(0, 0.015, FEATURES[0, 0]) - chance(0, -0.015, FEATURES[0, 0])) / 0.03
    assert falls[1] - falls[0] == pytest.approx(0.03 * slope, rel=0.1)


def test_some_of_the_tests_are_the_likelihood_of_these_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole, part = make_toy(FIVE, FELL), make_toy(FIVE, (True, None, None, True, None))
    found = whole.joint(Known(), FEATURES, np.array([0, 3]))
    assert found == pytest.approx(part.joint(Known(), FEATURES, np.arange(5)), abs=1e-4)
    monkeypatch.setattr("rocksteady.risk.calibration.sampler.outcome_likelihood.CHUNK", 1)
    assert len(whole.parts(9)) == 9
    assert (whole.joint(Known(), FEATURES, np.array([0, 3])) == found).all()


def test_a_session_alone_has_no_gain_of_its_own() -> None:
    tests = make_toy(("a", "a", None), (True,) * 3).bench.tests
    assert sessions_of(tests) == ()
    assert sessions_of([*tests, replace(tests[0], name="x", session="b")]) == ("a", "b")
