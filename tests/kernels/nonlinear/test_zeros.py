"""Zeros, levels and extrema of a step's polynomial against slow sampling and known roots."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from rocksteady.kernels.nonlinear._zeros import first_rise, first_zero, largest, last_rise
from rocksteady.kernels.nonlinear.series import TERMS, WORK_ROWS, angle_at, third_bound

Floats = NDArray[np.float64]


def space(given: Any) -> tuple[Floats, int]:
    coefficients = np.asarray(given, dtype=np.float64)
    work = np.zeros((WORK_ROWS, TERMS))
    work[0, : len(coefficients)] = coefficients
    return work, max(len(coefficients) - 1, 2)


def first_zero_of(work: Floats, degree: int, step: float, pull: float = math.inf) -> float:
    """First zero of a polynomial of whose bends nothing else is known than itself."""
    return first_zero(work, degree, step, third_bound(work, degree, step), pull)


def sampled_zero(polynomial: Polynomial, step: float) -> float:
    """First zero in (0, step] by 20 001 samples and bisection, or -1."""
    t = np.linspace(0.0, step, 20_001)[1:]
    below = np.flatnonzero(polynomial(t) <= 0.0)
    if len(below) == 0:
        return -1.0
    low, high = t[below[0]] - step / 20_000, t[below[0]]
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if polynomial(middle) <= 0.0 else (middle, high)
    return float(high)


@pytest.mark.parametrize("seed", range(60))
def test_first_zeros_are_those_of_slow_sampling(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(10):
        roots = np.sort(rng.uniform(-2.0, 2.0, rng.integers(3, 8)))
        wild = Polynomial.fromroots(roots) * (1.0 if rng.random() < 0.5 else -1.0)
        if wild(0.0) < 0.0:
            wild = -wild
        step = rng.uniform(0.1, 1.5)
        work, degree = space(wild.coef)
        found, expected = first_zero_of(work, degree, step), sampled_zero(wild, step)
        inside = roots[(roots > 0.0) & (roots <= step)]
        if len(inside) == 0:
            assert found == expected == -1.0
        else:
            assert found == pytest.approx(inside[0], abs=1e-9)
            assert abs(wild(found)) <= 1e-13 * np.abs(wild.coef).max()


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-9, 1e-12, 1e-14])
@pytest.mark.parametrize("place", [0.1, 0.37, 0.9])
def test_a_graze_is_found_however_shallow_and_no_more_than_that(place: float, depth: float) -> None:
    # (t - place)^2 (1 + t + t^2) -+ depth: below the floor for an instant, or just above it.
    shape = Polynomial([-place, 1.0]) ** 2 * Polynomial([1.0, 1.0, 1.0])
    for sign in (-1.0, 1.0):
        work, degree = space((shape + sign * depth).coef)
        found = first_zero_of(work, degree, 1.0)
        if sign > 0.0:
            assert found == -1.0
        else:
            half = math.sqrt(depth / (1.0 + place + place**2))
            assert found == pytest.approx(place - half, abs=2.0 * depth + 0.05 * half + 1e-9)


@pytest.mark.parametrize("speed", [1.0, 1e-4, 1e-8, 1e-16, 1e-80])
def test_a_bounce_keeps_its_digits_however_low(speed: float) -> None:
    work, degree = space(np.array([0.0, speed, -0.5]))
    assert first_zero_of(work, degree, 3.0) == pytest.approx(2.0 * speed, rel=1e-15)


@pytest.mark.parametrize("rest", [0.0, 1e-300, 1e-22, 1e-16])
def test_lifting_off_where_nothing_pulls_yet_is_no_zero_either(rest: float) -> None:
    work, degree = space([0.0, 0.0, rest, 0.4, -0.3, 0.05])
    assert first_zero_of(work, degree, 0.8) == -1.0
    expected = (0.3 - math.sqrt(0.3**2 - 4.0 * 0.05 * 0.4)) / 0.1  # 0.4 - 0.3 t + 0.05 t^2 = 0
    assert first_zero_of(work, degree, 2.5) == pytest.approx(expected, rel=1e-13)


def test_lifting_off_is_no_zero() -> None:
    work, degree = space(np.array([0.0, 0.0, 0.0, 1.0, -0.5]))
    assert first_zero_of(work, degree, 1.0) == -1.0
    assert first_zero_of(work, degree, 3.0) == pytest.approx(2.0, rel=1e-14)


@pytest.mark.parametrize("seed", range(20))
def test_levels_and_peaks_are_those_of_slow_sampling(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    curve = Polynomial(rng.normal(size=9) / np.array([math.factorial(n) for n in range(9)]))
    work, degree = space(curve.coef)
    step = 2.0
    t = np.linspace(0.0, step, 200_001)
    y, v = curve(t), curve.deriv()(t)
    top, fastest = largest(
        work, degree, step, third_bound(work, degree, step), *angle_at(work, degree, step), 0.0, 0.0
    )
    assert top == pytest.approx(max(y.max(), 0.0), abs=1e-9)
    assert fastest == pytest.approx(np.abs(v).max(), abs=1e-8)
    level = float(rng.uniform(y.min(), y.max()))
    rises = np.flatnonzero((y[:-1] <= level) & (y[1:] > level))
    expected = t[rises[-1]] if len(rises) else -1.0
    assert last_rise(work, degree, step, level) == pytest.approx(expected, abs=2e-5)
    if y[0] < level:
        first = t[rises[0]] if len(rises) else -1.0
        assert first_rise(work, degree, step, level) == pytest.approx(first, abs=2e-5)
