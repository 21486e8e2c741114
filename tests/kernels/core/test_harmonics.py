"""Uplift under a Fourier series against roots in 50 digits, and bounds against many samples."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady.kernels.core.harmonics import (
    bound_of_order,
    fill_lifts,
    is_antisymmetric,
    largest_ahead,
    next_lift,
    shape_at,
)
from tests.every import every

WAVES = st.dictionaries(
    st.integers(1, 9),
    st.tuples(st.floats(0.05, 1.0), st.floats(-math.pi, math.pi)),
    min_size=1,
    max_size=4,
)


def shares_of(waves: dict[int, tuple[float, float]]) -> np.ndarray:
    total = sum(size for size, _ in waves.values())
    shares = np.zeros(2 * max(waves))
    for order, (size, phase) in waves.items():
        shares[2 * order - 2] = size * math.cos(phase) / total
        shares[2 * order - 1] = size * math.sin(phase) / total
    return shares


def exact(shares: np.ndarray, phase: Any, order: int = 0) -> Any:
    """Return S, or its derivative of an order, in many digits."""
    quarter = order * mpmath.pi / 2
    return mpmath.fsum(
        mpmath.mpf(k + 1) ** order
        * (
            mpmath.mpf(float(shares[2 * k])) * mpmath.sin((k + 1) * phase + quarter)
            + mpmath.mpf(float(shares[2 * k + 1])) * mpmath.cos((k + 1) * phase + quarter)
        )
        for k in range(len(shares) // 2)
    )


@settings(max_examples=40)
@given(WAVES, st.floats(0.01, 0.99), st.sampled_from([1.0, -1.0]))
def test_uplifts_are_the_rising_roots(
    waves: dict[int, tuple[float, float]], level: float, sign: float
) -> None:
    shares = shares_of(waves)
    lifts = np.empty(max(waves))
    fill_lifts(shares, sign, level, lifts)
    found = lifts[np.isfinite(lifts)]
    grid = np.linspace(0.0, 2.0 * math.pi, 1001)
    values = np.array(
        [sign * shape_at(shares, *sc)[0] for sc in zip(np.sin(grid), np.cos(grid), strict=True)]
    )
    values -= level
    rising = grid[:-1][(values[:-1] <= 0.0) & (values[1:] > 0.0)]
    with mpmath.workdps(30):
        for phase in found:
            slope = sign * exact(shares, mpmath.mpf(float(phase)), 1)
            miss = sign * exact(shares, mpmath.mpf(float(phase))) - level
            assert slope > -1e-6
            assert abs(miss) < 1e-15 * (1.0 + 10.0 * max(waves))
    # Each rise that samples see is there, and others are so low that samples miss them.
    for low in rising:
        assert np.min(np.abs(found - low)) < 2.0 * grid[1]
    assert (np.diff(found) > 0.0).all()


@every("order", [1, 2, 7, 64])
def test_a_crest_at_the_level_lifts_nothing_and_one_above_it_does(order: int) -> None:
    shares = np.zeros(2 * order)
    shares[2 * order - 2] = 1.0
    lifts = np.empty(order)
    fill_lifts(shares, 1.0, 1.0, lifts)
    assert np.isinf(lifts).all()
    fill_lifts(shares, 1.0, 1.0 - 1e-12, lifts)
    crests = (0.5 * math.pi + 2.0 * math.pi * np.arange(order)) / order
    assert lifts == pytest.approx(crests - math.acos(1.0 - 1e-12) / order, abs=1e-8 / order)
    assert next_lift(lifts, 0.0) == (lifts[0], 0)
    assert next_lift(lifts, float(lifts[-1])) == (lifts[0], 1)


def test_a_rise_through_the_level_at_phase_0_is_found_once() -> None:
    for turn in (0.0, 1e-17, -1e-17, 3e-16, -3e-16):
        shares = np.array([math.cos(math.pi / 6.0), 0.5 + turn]) / (1.0 + turn)
        lifts = np.empty(1)
        fill_lifts(shares, 1.0, 0.5, lifts)
        assert min(lifts[0], 2.0 * math.pi - lifts[0]) < 1e-15


@given(WAVES, st.floats(0.0, 6.0), st.floats(1e-6, 2.0), st.sampled_from([1.0, -1.0]))
def test_bounds_hold_over_what_is_ahead(
    waves: dict[int, tuple[float, float]], phase: float, turn: float, sign: float
) -> None:
    shares = shares_of(waves)
    crest, steepest = largest_ahead(shares, sign, phase, turn)
    for ahead in np.linspace(0.0, turn, 40):
        value, slope = shape_at(shares, math.sin(phase + ahead), math.cos(phase + ahead))
        assert sign * value <= crest + 1e-13
        assert abs(slope) <= steepest + 1e-13 * bound_of_order(shares, 1)
    assert is_antisymmetric(shares) == all(order % 2 == 1 for order in waves)
