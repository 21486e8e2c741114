"""Curves through counted shares: isotonic regression by its own formula, and what is exact."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import isotonic_regression

from rocksteady import Block, compute_fragility
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand
from rocksteady.risk.counted.curve import Curve
from tests.risk.counted.recorded import Floats, count_of

RECORDS = 12


def curve_of(falls: list[int], lifts_at: Any = (0.15,), ways: int = 5) -> Curve:
    """Return a curve over rising levels of as many falls, those of few records."""
    fell = [np.clip(each - ways * np.arange(RECORDS), 0, ways).tolist() for each in falls]
    levels = np.array([0.2 * 1.3**k for k in range(len(falls))])
    counts = [count_of(each, ways) for each in fell]
    return Curve(levels=levels, counts=counts, lifts_at=np.sort(np.array(lifts_at, float)))


def min_max(shares: Floats) -> list[float]:
    """Return the isotonic regression by its definition: max over starts of min over ends of means.

    Robertson, Wright and Dykstra, Order Restricted Statistical Inference, 1988, theorem 1.4.4.
    """
    n = len(shares)
    return [
        max(min(float(np.mean(shares[i : j + 1])) for j in range(k, n)) for i in range(k + 1))
        for k in range(n)
    ]


FALLS = st.lists(st.integers(0, 5 * RECORDS), min_size=1, max_size=9)


@given(FALLS)
def test_the_monotone_shares_are_the_nearest_ones(falls: list[int]) -> None:
    curve = curve_of(falls)
    np.testing.assert_allclose(curve.shares, np.array(falls) / 5 / RECORDS, atol=1e-15)
    np.testing.assert_allclose(curve.steps, min_max(curve.shares), atol=1e-12)
    np.testing.assert_allclose(curve.steps, isotonic_regression(curve.shares).x, atol=1e-15)
    assert (np.diff(curve.steps) >= 0.0).all()
    assert curve.is_monotone == (sorted(falls) == falls)
    if curve.is_monotone:
        np.testing.assert_allclose(curve.steps, curve.shares, atol=1e-15)


@given(FALLS, st.data())
def test_curves_of_nested_states_are_nested(falls: list[int], data: st.DataObject) -> None:
    """Equal weights keep their order, without a repair."""
    more = [data.draw(st.integers(each, 5 * RECORDS)) for each in falls]
    graver, milder = curve_of(falls), curve_of(more)
    assert (graver.steps <= milder.steps + 1e-12).all()
    at = np.geomspace(0.05, 5.0, 50)
    assert (graver.at(at) <= milder.at(at) + 1e-12).all()


def test_between_levels_shares_are_straight_over_the_logarithm_of_the_level() -> None:
    curve = curve_of([6, 18, 30])
    low, middle, high = curve.levels
    assert curve.at(curve.levels) == pytest.approx([0.1, 0.3, 0.5], abs=1e-12)
    assert curve.at(math.sqrt(low * middle)) == pytest.approx(0.2)
    assert curve.at(low**0.25 * middle**0.75) == pytest.approx(0.25)
    assert curve.at(10.0 * high) == pytest.approx(0.5)
    assert curve.at(math.sqrt(0.15 * low)) == pytest.approx(0.05)  # from none at the first uplift
    assert curve.at(0.15) == 0.0
    assert isinstance(curve.at(0.3), np.ndarray)


@given(
    FALLS,
    st.lists(st.floats(0.05, 4.0) | st.just(math.inf), min_size=1, max_size=8),
)
def test_no_share_is_above_the_share_that_lifts_and_none_below_the_lowest_uplift(
    falls: list[int], lifts_at: list[float]
) -> None:
    curve = curve_of(falls, lifts_at)
    at = np.unique([*np.geomspace(0.01, 10.0, 200), *curve.levels, *lifts_at])
    at = at[np.isfinite(at)]
    lifted = np.array([sum(each < level for each in lifts_at) / len(lifts_at) for level in at])
    np.testing.assert_allclose(curve.lifting(at), lifted, atol=1e-15)
    shares = curve.at(at)
    assert (shares <= lifted + 1e-15).all()
    assert (shares >= 0.0).all()
    assert (shares[at <= min(lifts_at)] == 0.0).all()
    assert (np.diff(shares) >= -1e-15).all()


def test_a_threshold_itself_does_not_lift() -> None:
    curve = curve_of([0, 0], [0.2, 0.3, math.inf])
    beside = 0.3 * np.array([1.0 - 1e-12, 1.0, 1.0 + 1e-12])
    assert curve.lifting(beside).tolist() == pytest.approx([1 / 3, 1 / 3, 2 / 3])
    assert curve.lifting([0.0, 0.2, 1e9]).tolist() == pytest.approx([0.0, 0.0, 2 / 3])


def test_the_curve_of_runs_goes_through_their_counts_where_these_are_monotone() -> None:
    fragility = compute_fragility(
        Block.rectangle(width=0.3, height=1.5),
        make_synthetic_suite(RECORDS),
        levels=Levels("pga_g", [0.15, 0.25, 0.5, 1.0, 4.0], beside=()),
        restitution=RestitutionBand(draws=2),
    )
    for state in fragility.states[1:]:
        curve = state.curve
        shares = state.share(curve.levels)
        if curve.is_monotone:
            np.testing.assert_allclose(shares, curve.shares, atol=1e-12)
        assert shares[0] == 0.0
    assert fragility.states[-1].curve.shares[-1] > 0.5
