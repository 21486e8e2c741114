"""The risk integral against closed forms and against sums over many small steps."""

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
from rocksteady.risk.hazard._convolution import Integral, convolve
from rocksteady.risk.hazard._fragile import Converted, Lognormal
from tests.every import every

Floats = NDArray[np.float64]

BENT = HazardCurve(
    measure="pgv_m_s",
    levels=np.array([0.02, 0.05, 0.1, 0.3, 0.8, 2.0]),
    rates=np.array([0.3, 0.1, 0.03, 0.002, 0.0001, 0.000002]),
)


def power_law(k: float, low: float = 1e-4, high: float = 1e4, points: int = 9) -> HazardCurve:
    levels = np.geomspace(low, high, points)
    return HazardCurve(measure="pgv_m_s", levels=levels, rates=1e-4 * levels**-k)


def rate(median: float, beta: float, hazard: HazardCurve) -> float:
    curve = Converted(Lognormal(median, beta), 1.0)
    return convolve(curve.probability, curve.knots, hazard).total


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
    exact = 1e-4 * median**-k * math.exp(0.5 * k * k * beta * beta)
    assert rate(median, beta, power_law(k).extended()) == pytest.approx(exact, rel=1e-9)


def test_a_bent_curve_is_exact_to_twelve_digits() -> None:
    """By parts each stretch is a difference of two normal distributions; in 40 digits."""
    median, beta = 0.46529, 0.592
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
    assert rate(median, beta, BENT) == pytest.approx(float(total), rel=1e-12)


@every("beta", [0.0, 1e-9, 1e-6])
@every("median", [0.021, 0.1, 0.17, 0.8, 1.99])
def test_a_step_fails_at_the_rate_of_its_median(median: float, beta: float) -> None:
    assert rate(median, beta, BENT) == pytest.approx(
        float(BENT.rate(median)), rel=2e-5 * (beta > 0) + 1e-12
    )


def logistic(at: Floats) -> Floats:
    """Return a logistic fragility."""
    found: Floats = expit(np.log(at / 0.4) / 0.2)
    return found


def stepped(at: Floats) -> Floats:
    """Return a lognormal behind a step that no knot speaks of."""
    found: Floats = ndtr(np.log(at / 0.4) / 0.6) * (at > 0.2345)
    return found


KNOTS = np.log([0.1, 0.3, 0.4, 0.5, 1.0])


@pytest.mark.parametrize("probability", [logistic, stepped])
def test_any_curve_agrees_with_a_sum_over_a_million_steps(
    probability: Callable[[Floats], Floats],
) -> None:
    slow = stieltjes(probability, BENT, 1_000_000)
    assert convolve(probability, KNOTS, BENT).total == pytest.approx(slow, rel=2e-5)


@pytest.mark.parametrize("hazard", [BENT, BENT.extended()])
def test_parts_add_up_and_quantiles_divide_the_integral(hazard: HazardCurve) -> None:
    curve = Converted(Lognormal(0.3, 0.5), 1.0)
    found = convolve(curve.probability, curve.knots, hazard)
    parts = found.between(hazard.levels)
    assert parts.sum() == pytest.approx(found.total, rel=1e-12)
    assert (parts[0] > 0.0) == (hazard.tail == "power-law")
    for share in (0.05, 0.5, 0.95):
        at = found.quantile(share)
        cut = np.array([hazard.levels[0], at, hazard.levels[-1]])
        below = HazardCurve(measure="pgv_m_s", levels=cut[:2], rates=hazard.rate(cut[:2]))
        inner = hazard.levels[(hazard.levels > cut[0]) & (hazard.levels < at)]
        levels = np.array([cut[0], *inner, at])
        below = HazardCurve(measure="pgv_m_s", levels=levels, rates=hazard.rate(levels))
        # What is below a level: the integral up to it, without what counts beyond it.
        part = convolve(curve.probability, curve.knots, below)
        assert (part.total - part.lump + parts[0]) / found.total == pytest.approx(share, rel=1e-9)


def test_the_lump_lies_at_the_last_level() -> None:
    ends = np.log([[1.0, 2.0], [2.0, 4.0]])
    found = Integral(
        ends=ends, values=np.array([1.0, 2.0]), lump=1.0, below=0.0, above=0.0, density=np.ones_like
    )
    for span, last, share in (
        ((1.0, 4.0), 4.0, 0.25),
        ((1.0, 4.0), 3.9, 0.0),
        ((1.0, 2.0), 4.0, 0.75),
        ((2.0, 4.0), 3.9, 0.25),
    ):
        assert found.share_outside(span, last) == share
    assert found.quantile(0.75) <= 4.0 * (1.0 + 1e-12) < found.quantile(0.76) == math.inf


def test_what_lies_outside_is_that_of_power_laws() -> None:
    k, median, beta = 2.5, 0.4, 0.6
    hazard = power_law(k, 0.1, 1.0)
    curve = Converted(Lognormal(median, beta), 1.0)
    found = convolve(curve.probability, curve.knots, hazard)
    exact = 1e-4 * median**-k * math.exp(0.5 * k * k * beta * beta)
    inside = found.total - found.lump
    assert found.below + inside + found.above == pytest.approx(exact, rel=1e-9)
    # By parts, as above: the share below u of a lognormal under a power law.
    share = float(ndtr((math.log(0.1 / median) + k * beta**2) / beta)) * exact
    below = share - 1e-4 * 0.1**-k * float(ndtr(math.log(0.1 / median) / beta))
    assert found.below == pytest.approx(below, rel=1e-9)


def test_a_lower_tail_that_rises_faster_than_the_fragility_falls_has_no_end() -> None:
    steep, flat = power_law(6.0, 0.1, 1.0), power_law(3.0, 0.1, 1.0)
    assert math.isinf(convolve(logistic, KNOTS, steep).below)
    assert 0.0 < convolve(logistic, KNOTS, flat).below < math.inf


def test_a_flat_curve_has_no_shaking_between_its_levels() -> None:
    flat = HazardCurve(measure="pgv_m_s", levels=np.array([0.1, 1.0]), rates=np.full(2, 0.01))
    assert rate(0.3, 0.5, flat) == pytest.approx(0.01 * ndtr(math.log(1.0 / 0.3) / 0.5), rel=1e-12)


def test_there_is_no_shaking_where_the_rate_does_not_fall_nor_below() -> None:
    rates = np.array([0.01, 0.01, 0.01, 0.001])
    flat = HazardCurve(measure="pgv_m_s", levels=np.geomspace(0.1, 1.0, 4), rates=rates).extended()
    curve = Converted(Lognormal(0.3, 0.5), 1.0)
    found = convolve(curve.probability, curve.knots, flat)
    assert found.below == 0.0
    *none, last, above = found.between(flat.levels).tolist()
    assert none == [0.0, 0.0, 0.0]
    assert last + above == pytest.approx(found.total, rel=1e-12)
    assert above == found.above
