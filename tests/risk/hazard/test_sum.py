"""Sums over a hazard curve against closed forms and against sums over many small steps."""

import math
from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.special import expit, ndtr

from rocksteady.risk import HazardCurve
from rocksteady.risk.hazard._sum import mass_of
from rocksteady.risk.hazard.fragile import fragile_of
from tests.every import every

Floats = NDArray[np.float64]

BENT = HazardCurve(
    measure="pgv_m_s",
    levels=np.array([0.02, 0.05, 0.1, 0.3, 0.8, 2.0]),
    rates=np.array([0.3, 0.1, 0.03, 0.002, 0.0001, 0.000002]),
)


def rate(median: float, beta: float, hazard: HazardCurve) -> float:
    fragile = fragile_of((median, beta), hazard, None, None)
    mass = mass_of(hazard, fragile.edges)
    return float(fragile.at(mass.levels) @ mass.rates)


def stieltjes(probability: Callable[[Floats], Floats], hazard: HazardCurve, steps: int) -> float:
    """Return the sum of P at the middle of each of many steps times the fall of H over it."""
    levels = np.geomspace(hazard.levels[0], hazard.levels[-1], steps + 1)
    levels[[0, -1]] = hazard.levels[[0, -1]]
    levels = np.unique(np.concatenate([levels, hazard.levels]))
    fall = -np.diff(hazard.rate(levels))
    middle = np.sqrt(levels[:-1] * levels[1:])
    return float(probability(middle) @ fall) + float(
        probability(hazard.levels[-1:])[0] * hazard.rates[-1]
    )


@given(st.floats(0.3, 4.0), st.floats(0.05, 3.0), st.floats(0.01, 1.0))
def test_a_power_law_and_a_lognormal_have_a_closed_form(
    k: float, median: float, beta: float
) -> None:
    levels = np.geomspace(1e-9, 1e9, 19)
    hazard = HazardCurve(measure="pgv_m_s", levels=levels, rates=1e-4 * levels**-k)
    exact = 1e-4 * median**-k * math.exp(0.5 * k * k * beta * beta)
    assert rate(median, beta, hazard) == pytest.approx(exact, rel=1e-9)


@every(("median", "beta"), [(0.46529, 0.592), (0.1, 0.05), (1.4, 0.9)])
def test_a_bent_curve_is_exact_to_eleven_digits(median: float, beta: float) -> None:
    """By parts each stretch is a difference of two normal distributions; in 40 digits."""
    with mpmath.workdps(40):
        m, b = mpmath.log(median), mpmath.mpf(beta)
        x = [mpmath.log(mpmath.mpf(level)) for level in BENT.levels.tolist()]
        h = [mpmath.mpf(value) for value in BENT.rates.tolist()]
        total = h[-1] * mpmath.ncdf((x[-1] - m) / b)
        for i in range(len(x) - 1):
            k = -mpmath.log(h[i + 1] / h[i]) / (x[i + 1] - x[i])
            scale = h[i] * mpmath.exp(k * (x[i] - m) + k * k * b * b / 2)
            ends = [mpmath.ncdf((u - m) / b + k * b) for u in (x[i], x[i + 1])]
            total += h[i] * mpmath.ncdf((x[i] - m) / b) - h[i + 1] * mpmath.ncdf((x[i + 1] - m) / b)
            total += scale * (ends[1] - ends[0])
    assert rate(median, beta, BENT) == pytest.approx(float(total), rel=1e-11)


@every("beta", [0.0, 1e-10, 1e-6])
@every("median", [0.021, 0.1, 0.17, 0.8, 1.99])
def test_a_step_fails_at_the_rate_of_its_median(median: float, beta: float) -> None:
    assert rate(median, beta, BENT) == pytest.approx(
        float(BENT.rate(median)), rel=2e-5 * (beta > 0) + 1e-12
    )


def logistic(at: Floats) -> Floats:
    found: Floats = expit(np.log(at / 0.4) / 0.2)
    return found


def stepped(at: Floats) -> Floats:
    found: Floats = ndtr(np.log(at / 0.4) / 0.6) * (at > 0.2345)
    return found


@pytest.mark.parametrize("probability", [logistic, stepped])
def test_any_curve_agrees_with_a_sum_over_a_million_steps(
    probability: Callable[[Floats], Floats],
) -> None:
    slow = stieltjes(probability, BENT, 1_000_000)
    mass = mass_of(BENT, np.array([0.2345]))
    assert probability(mass.levels) @ mass.rates == pytest.approx(slow, rel=2e-5)


def test_all_shaking_above_the_first_level_is_in_the_sum_and_none_twice() -> None:
    mass = mass_of(BENT, np.array([0.001, 0.07, 0.1, 77.0]))
    assert mass.rates.sum() == pytest.approx(BENT.rates[0], rel=1e-12)
    assert (np.diff(mass.levels) > 0.0).all()
    assert (mass.levels[-1], mass.rates[-1]) == (2.0, 2e-6)
    for low, high in ((0.02, 0.05), (0.3, 0.8)):
        part = mass.rates[:-1][(mass.levels[:-1] > low) & (mass.levels[:-1] < high)].sum()
        assert part == pytest.approx(float(np.diff(BENT.rate([high, low]))[0]), rel=1e-12)


def test_there_is_no_shaking_where_the_rate_does_not_fall() -> None:
    flat = HazardCurve(measure="pgv_m_s", levels=np.array([0.1, 1.0]), rates=np.full(2, 0.01))
    assert rate(0.3, 0.5, flat) == pytest.approx(0.01 * ndtr(math.log(1.0 / 0.3) / 0.5), rel=1e-12)
