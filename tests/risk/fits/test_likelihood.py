"""Likelihoods: both families in both tails, derivatives, and scores that have no root."""

from typing import Any

import mpmath
import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.fits._likelihood import (
    family_of,
    log_likelihood_of,
    maximise,
    slopes,
    solve_score,
)
from tests.every import every

DISTRIBUTIONS: dict[str, Any] = {"lognormal": stats.norm, "logistic": stats.logistic}
ETA = np.array([-30.0, -6.0, -1.3, 0.0, 0.4, 2.0, 7.0, 30.0])


def exact_cdf(name: str, eta: Any) -> Any:
    return mpmath.ncdf(eta) if name == "lognormal" else 1 / (1 + mpmath.exp(-eta))


@every("name", DISTRIBUTIONS)
def test_each_function_of_a_family_is_exact_in_both_tails(name: str) -> None:
    family = family_of(name)
    with mpmath.workdps(250):
        for eta in ETA.tolist():
            at = np.array([eta])

            def log_cdf(x: Any) -> Any:
                return mpmath.log(exact_cdf(name, x))

            hazard = float(mpmath.diff(log_cdf, mpmath.mpf(eta)))
            bend = float(mpmath.diff(log_cdf, mpmath.mpf(eta), 2))
            assert family.cdf(at)[0] == pytest.approx(float(exact_cdf(name, eta)), rel=1e-12)
            assert family.log_cdf(at)[0] == pytest.approx(float(log_cdf(eta)), rel=1e-12)
            assert family.hazard(at)[0] == pytest.approx(hazard, rel=1e-11)
            # In the far lower tail hazard + eta cancels, to the digits of the hazard.
            assert family.fall(at, family.hazard(at))[0] == pytest.approx(
                -bend, rel=1e-9, abs=1e-12 * hazard * (abs(eta) + 1.0)
            )
    assert family.quantile(family.cdf(ETA[1:6])) == pytest.approx(ETA[1:6], rel=1e-9)


@every("name", DISTRIBUTIONS)
def test_slopes_are_the_derivatives_of_the_binomial_log_likelihood(name: str) -> None:
    family, step = family_of(name), 1e-4
    eta = np.array([-2.0, -0.3, 0.0, 0.8, 2.5])
    failures, trials = np.array([0.0, 1.0, 3.0, 4.0, 5.0]), np.array([2.0, 6.0, 4.0, 9.0, 5.0])

    def each(shift: float) -> np.ndarray:
        rows = zip(eta + shift, failures, trials, strict=True)
        return np.array([log_likelihood_of(family, *map(np.atleast_1d, row)) for row in rows])

    whole = DISTRIBUTIONS[name]
    ways = stats.binom.logpmf(failures, trials, 0.5) + trials * np.log(2.0)
    binomial = stats.binom.logpmf(failures, trials, whole.cdf(eta))
    assert each(0.0) == pytest.approx(binomial - ways, rel=1e-10)
    first, second = slopes(family, eta, failures, trials)
    assert first == pytest.approx((each(step) - each(-step)) / (2.0 * step), rel=1e-6)
    bend = (each(step) - 2.0 * each(0.0) + each(-step)) / step**2
    assert second == pytest.approx(-bend, rel=1e-5)
    assert (second > 0.0).all()  # it is concave


def test_a_score_without_a_root_has_none() -> None:
    """Separated outcomes are the likelier the steeper the curve; overlapping ones have a root."""
    family, z = family_of("lognormal"), np.array([-1.0, -0.3, 0.3, 1.0])
    design, ones, start = np.column_stack([np.ones(4), z]), np.ones(4), np.array([0.0, 1.0])
    apart, over = np.array([0.0, 0.0, 1.0, 1.0]), np.array([0.0, 1.0, 0.0, 1.0])
    found = solve_score(family, design, over, ones, start)
    assert found is not None
    assert slopes(family, design @ found, over, ones)[0] @ design == pytest.approx(
        np.zeros(2), abs=1e-12
    )
    assert found == pytest.approx(maximise(family, design, over, ones, np.array([2.0, 0.1])))
    # By symmetry half fail in the middle.
    assert found[0] == pytest.approx(0.0, abs=1e-12)
    steep = solve_score(family, design, apart, ones, start)
    assert steep is None or steep[1] > 10.0
