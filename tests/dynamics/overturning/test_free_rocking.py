"""Free rocking in closed form: published numbers, time histories, quadrature, bad input."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import elliprf

from rocksteady import Block, DimensionlessBlock, State, Still, simulate
from rocksteady.errors import InputError
from rocksteady.formulas import (
    equivalent_damping,
    free_rocking_peaks,
    free_rocking_period,
    housner_restitution,
)
from rocksteady.model.equations import Nonlinear
from tests.every import every


@every(("phi", "quarter_s"), [(0.1, 0.1722212971), (0.5, 0.4855195874), (0.9, 1.1035040108)])
def test_h1_a_quarter_of_the_period(phi: float, quarter_s: float) -> None:
    p = math.sqrt(0.75 * 9.81)  # R = 1 m
    assert float(free_rocking_period(phi)) / p / 4.0 == pytest.approx(quarter_s, abs=5.1e-11)


def test_h3_the_decay_of_the_peaks() -> None:
    printed = [0.4523, 0.2859, 0.1894, 0.1283, 0.0879]
    found = free_rocking_peaks(1.0, math.sqrt(0.7), 5)
    assert found[1:] == pytest.approx(printed, abs=5.1e-5)
    # alpha = .2, Housner's restitution, whose square is r
    delta = housner_restitution(0.2)
    peaks = free_rocking_peaks(0.8, delta, 3)
    assert peaks[1:] == pytest.approx([0.612305, 0.502064, 0.421766], abs=5.1e-7)
    seconds = 0.5 * free_rocking_period(peaks[1:]) / math.sqrt(0.75 * 9.81)  # R = 1 m
    assert seconds == pytest.approx([1.180321, 0.974559, 0.843764], abs=5.1e-7)


@pytest.mark.slow
@every("phi", [1e-6, 0.01, 0.3, 0.8, 0.98])
def test_the_period_is_that_of_a_time_history(phi: float) -> None:
    run = simulate(
        DimensionlessBlock(restitution=1.0), Still(), start=State(angle=phi, velocity=0.0)
    )
    times = run.impacts.pt[:5]
    period = float(free_rocking_period(phi))
    assert 4.0 * times[0] == pytest.approx(period, rel=1e-12)
    np.testing.assert_allclose(np.diff(times), 0.5 * period, rtol=1e-12)


@every("restitution", [0.3, 0.7, 0.95, 1.0])
def test_the_peaks_are_those_of_a_time_history(restitution: float) -> None:
    run = simulate(
        DimensionlessBlock(restitution=restitution), Still(), start=State(angle=0.8, velocity=0.0)
    )
    peaks = free_rocking_peaks(0.8, restitution, 6)
    # y = 1 - cosh t + v sinh t is highest at tanh t = v, where it is 1 - sqrt(1 - v^2)
    speed = np.abs(run.impacts.velocity_after[:6])
    tops = np.abs(run(run.impacts.pt[:6] + np.arctanh(speed)).angle)
    np.testing.assert_allclose(peaks[1:], tops, rtol=1e-12)
    halves = np.diff(run.impacts.pt[:7])
    np.testing.assert_allclose(halves, 0.5 * free_rocking_period(peaks[1:]), rtol=1e-12)


@every("alpha", [0.02, 0.2, 0.8, 1.5])
@every("phi", [1e-6, 0.01, 0.3, 0.8, 0.98])
def test_the_tilting_block_is_that_of_a_time_history(alpha: float, phi: float) -> None:
    start = State(angle=phi, velocity=0.0)
    block = Block.from_p(alpha=alpha, p=1.0, restitution=1.0)
    run = simulate(block, Still(), start=start, model=Nonlinear(), max_flights=8)
    period = float(free_rocking_period(phi, alpha=alpha))
    assert 4.0 * run.impacts.pt[0] == pytest.approx(period, rel=1e-11)
    np.testing.assert_allclose(np.diff(run.impacts.pt), 0.5 * period, rtol=1e-11)
    block = Block.from_p(alpha=alpha, p=1.0, restitution=0.8)
    run = simulate(block, Still(), start=start, model=Nonlinear())
    peaks = free_rocking_peaks(phi, 0.8, 6, alpha=alpha)
    halves = np.diff(run.impacts.pt[:7])
    np.testing.assert_allclose(halves, 0.5 * free_rocking_period(peaks[1:], alpha=alpha), rtol=2e-9)
    times = run.impacts.pt[:6] + 0.5 * halves[:6]
    np.testing.assert_allclose(peaks[1:], np.abs(run(times).angle), rtol=2e-9)


def test_the_tilting_period_is_housners_as_published_and_in_the_slender_limit() -> None:
    p = math.sqrt(0.75 * 9.81)  # R = 1 m
    quarters = free_rocking_period([0.1, 0.5, 0.9], alpha=0.2) / p / 4.0
    assert quarters == pytest.approx([0.172705182, 0.486089732, 1.103837474], abs=5.1e-10)
    phi = np.array([1e-12, 0.1, 0.5, 0.9, 1.0 - 1e-12])
    np.testing.assert_allclose(
        free_rocking_period(phi, alpha=1e-9), free_rocking_period(phi), rtol=1e-13
    )
    np.testing.assert_allclose(
        free_rocking_peaks(1.0, 0.9, 50, alpha=1e-9), free_rocking_peaks(1.0, 0.9, 50), rtol=1e-13
    )
    assert free_rocking_peaks(0.4, 1.0, 9, alpha=0.7) == pytest.approx(np.full(10, 0.4), rel=1e-14)


def test_the_period_is_the_integral_of_energy() -> None:
    # phi' = sqrt((1 - phi)^2 - (1 - phi0)^2) from phi0 to 0, with 1 - phi = (1 - phi0) cosh x
    for phi in (0.2, 0.7):
        end = math.acosh(1.0 / (1.0 - phi))
        quarter = quad(lambda x: math.sinh(x) / math.sqrt(math.cosh(x) ** 2 - 1.0), 1e-12, end)[0]
        assert float(free_rocking_period(phi)) == pytest.approx(4.0 * quarter, rel=1e-9)


@every("alpha", [1e-6, 0.3, 1.5])
def test_the_tilting_period_is_the_elliptic_integral_of_another_library(alpha: float) -> None:
    phi = np.concatenate(
        [[0.0], 10.0 ** np.linspace(-15, -0.01, 200), 1.0 - 2.0 ** -np.arange(2, 51)]
    )
    upright = np.sin(0.5 * alpha * (1.0 - phi))
    # sin^2(alpha/2) - sin^2(w0/2) as a product, which keeps the digits of a small phi
    square = np.sin(alpha * (1.0 - 0.5 * phi)) * np.sin(0.5 * alpha * phi)
    ratio = square / (upright * math.cos(0.5 * alpha)) ** 2
    expected = 4.0 * np.sqrt(ratio) * elliprf(1.0, 1.0 + ratio * upright**2, 1.0 + ratio)
    assert free_rocking_period(phi, alpha=alpha) == pytest.approx(expected, rel=5e-15)


def test_small_and_large_amplitudes_keep_their_digits() -> None:
    assert float(free_rocking_period(1e-20)) == pytest.approx(4.0 * math.sqrt(2e-20), rel=1e-13)
    assert float(free_rocking_period(0.0)) == 0.0
    assert float(free_rocking_period(1.0 - 2.0**-50)) == pytest.approx(
        4.0 * math.log(2.0**51), rel=1e-13
    )
    assert free_rocking_peaks(1e-20, 0.9, 1)[1] == pytest.approx(0.81e-20, rel=1e-13)
    assert free_rocking_peaks(0.37, 1.0, 9) == pytest.approx(np.full(10, 0.37), rel=1e-15)


@every("more", [{}, {"alpha": 0.3}, {"one_sided": True}])
def test_peaks_may_vanish_where_a_caller_lets_underflow_raise(more: dict[str, Any]) -> None:
    with np.errstate(all="raise"):
        assert free_rocking_peaks(0.5, 1e-3, 300, **more)[-1] == 0.0


@every(("degrees", "percent"), [(10, 3.147), (15, 7.201), (20, 13.120)])
def test_k1_equivalent_damping(degrees: float, percent: float) -> None:
    delta = housner_restitution(math.radians(degrees))
    assert 100.0 * float(equivalent_damping(delta)) == pytest.approx(percent, abs=5.1e-4)


def test_without_loss_there_is_no_damping_and_more_loss_damps_more() -> None:
    found = equivalent_damping(np.linspace(1.0, 0.1, 20))
    assert found[0] == 0.0
    assert not np.signbit(found[0])
    assert (np.diff(found) > 0.0).all()


def test_bad_input_is_refused() -> None:
    for value in (1.0, -0.1, math.nan, math.inf):
        with pytest.raises(InputError, match="amplitude_ratio"):
            free_rocking_period([0.5, value])
    for value in (0.0, 1.5, math.nan):
        with pytest.raises(InputError, match="restitution"):
            equivalent_damping([0.5, value])
    with pytest.raises(InputError, match="amplitude_ratio"):
        free_rocking_peaks(1.1, 0.9, 3)
    with pytest.raises(InputError, match="impacts"):
        free_rocking_peaks(0.5, 0.9, -1)
    with pytest.raises(InputError, match="restitution"):
        free_rocking_peaks(0.5, 0.0, 3)
    with pytest.raises(InputError, match=r"^alpha = 1\.6 "):
        free_rocking_period(0.5, alpha=1.6)
    with pytest.raises(InputError, match=r"^alpha = 0"):
        free_rocking_peaks(0.5, 0.9, 3, alpha=0.0)
