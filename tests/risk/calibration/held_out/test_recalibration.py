"""Platt's line against a search, and where it helps."""

import numpy as np
import pytest
from scipy.optimize import minimize

from rocksteady.risk.calibration.held_out.recalibration import (
    SPREAD,
    Platt,
    fit_platt,
    it_helps,
    recalibrated,
)


def outcomes(slope: float, count: int = 600) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return predictions whose log odds are those of the truth over a slope, outcomes, groups."""
    rng = np.random.default_rng(4)
    odds = 2.0 * rng.normal(size=count)
    fell = (rng.random(count) < 1.0 / (1.0 + np.exp(-odds))).astype(float)
    return 1.0 / (1.0 + np.exp(-odds / slope)), fell, np.arange(count) % 20


def test_line_is_the_likeliest_with_its_prior() -> None:
    p, fell, _ = outcomes(0.5)
    odds = np.log(p / (1.0 - p))

    def lost(at: np.ndarray) -> float:
        z = at[0] + at[1] * odds
        prior = 0.5 * ((at - [0.0, 1.0]) ** 2 / np.square(SPREAD)).sum()
        return float((np.logaddexp(0.0, z) - fell * z).sum() + prior)

    best = minimize(lost, [0.0, 1.0], tol=1e-12).x
    found = fit_platt(p, fell)
    assert (found.intercept, found.slope) == pytest.approx(tuple(best), abs=1e-4)
    assert found.slope == pytest.approx(0.5, abs=0.1)


@pytest.mark.parametrize(("slope", "helps"), [(0.5, True), (2.0, True), (1.0, False)])
def test_a_line_is_chosen_where_predictions_are_too_sure_or_too_shy(
    slope: float, helps: bool
) -> None:
    p, fell, codes = outcomes(slope)
    assert it_helps(p, fell, codes) == helps
    assert not it_helps(p[:90], fell[:90], codes[:90])
    assert not it_helps(p, fell, codes % 5)


def test_a_group_has_the_line_of_the_others() -> None:
    p, fell, codes = outcomes(0.5)
    own = codes == 3
    turned = np.where(own, 1.0 - fell, fell)
    first, second = (recalibrated(p, each, codes)[0] for each in (fell, turned))
    assert (first[own] == second[own]).all()
    assert (first[~own] != second[~own]).all()
    assert Platt().of(p) is p


def test_a_line_is_chosen_from_a_hundred_tests_of_ten_groups_on() -> None:
    """Each bound by itself: tests whose outcome is not known count for neither."""
    p, fell, _ = outcomes(0.15, count=600)
    for tests, groups, chosen in (
        *((100, 20, True), (99, 20, False), (300, 10, True), (300, 9, False), (100, 10, True)),
    ):
        some = np.where(np.arange(600) < tests, fell, np.nan)
        codes = np.arange(600) % groups
        assert it_helps(p, some, codes) == chosen, (tests, groups)
        assert it_helps(p[:tests], fell[:tests], codes[:tests]) == chosen
    line = Platt(intercept=0.3, slope=0.5)
    at = np.array([0.0, 1e-9, 0.2, 0.5, 1.0])
    sure = np.clip(at, 1e-6, 1.0 - 1e-6)
    odds = 0.3 + 0.5 * np.log(sure / (1.0 - sure))
    assert line.of(at) == pytest.approx(1.0 / (1.0 + np.exp(-odds)), rel=1e-12)
    assert (Platt(intercept=0.3).of(at) != at).any()


def test_groups_whose_outcomes_are_not_known_have_a_line_too() -> None:
    p, fell, codes = outcomes(0.5)
    some = np.where(codes == 3, np.nan, fell)
    first, second = recalibrated(p, some, codes, p)
    assert (first == second).all()
    assert (first[codes == 3] != p[codes == 3]).any()
    line = fit_platt(p[codes != 3], fell[codes != 3])
    assert first[codes == 3] == pytest.approx(line.of(p[codes == 3]), rel=1e-12)
    none = recalibrated(p, np.full(len(p), np.nan), codes)[0]
    assert (none == p).all()
