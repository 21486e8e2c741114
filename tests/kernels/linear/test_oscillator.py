"""The states of oscillators, against a filter of complex numbers and a steady state."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from rocksteady.kernels.linear.oscillator import fill_largest, fill_oscillator
from tests.every import every

Floats = NDArray[np.float64]


def states(acceleration: NDArray[np.float64], *step: complex) -> NDArray[np.float64]:
    out = np.full((2, len(acceleration)), np.nan)
    fill_oscillator(acceleration, np.array([[one.real, one.imag] for one in step]), out)
    return out


@every("growth", [0.9 + 0.4j, 1j, 0.2 + 0.0j])
def test_they_are_those_of_a_filter(growth: complex) -> None:
    a = np.random.default_rng(2).standard_normal(500)
    early, late = 0.3 - 0.2j, -0.1 + 0.7j
    expected = lfilter([late, early], [1.0, -growth], a, zi=np.array([-late * a[0]]))[0]
    scale = float(np.abs(expected).max())
    found = states(a, growth, early, late)
    assert found == pytest.approx(np.stack([expected.real, expected.imag]), abs=1e-14 * scale)


def test_a_constant_push_ends_in_the_state_that_it_keeps() -> None:
    growth, early, late = 0.6 - 0.3j, 0.2j, 1.0 + 0.0j
    kept = 3.0 * (early + late) / (1.0 - growth)
    real, imaginary = states(np.full(200, 3.0), growth, early, late)
    assert (real[0], imaginary[0]) == (0.0, 0.0)
    assert (real[-1], imaginary[-1]) == pytest.approx((kept.real, kept.imag), rel=1e-14)


def swung(
    acceleration: Floats, h: float, w: float, zeta: float, after: float
) -> tuple[Floats, Floats]:
    """Return (u, u', u'' + a) at many times and while it swings on, and (u, u') at the samples."""
    dense, at, state = [], [np.zeros(2)], np.zeros(2)
    lines = [*zip(acceleration[:-1], np.diff(acceleration) / h, strict=True), (0.0, 0.0)]
    for number, (start, slope) in enumerate(lines):
        span = h if number + 1 < len(lines) else after

        def rate(t: float, y: Floats, start: float = start, slope: float = slope) -> Floats:
            return np.array([y[1], -2.0 * zeta * w * y[1] - w * w * y[0] - start - slope * t])

        times = np.linspace(0.0, span, 400)
        u, v = solve_ivp(rate, (0.0, span), state, "DOP853", times, rtol=1e-11, atol=1e-14).y
        dense.append(np.stack([u, v, -2.0 * zeta * w * v - w * w * u]))
        state = np.array([u[-1], v[-1]])
        at.append(state)
    return np.concatenate(dense, axis=1), np.array(at[:-1]).T


@every("zeta", [0.02, 0.6])
@every("w", [0.3, 4.0, 25.0])
@every("last", [0.0, 2.0])
def test_the_largest_motion_is_that_of_many_times(zeta: float, w: float, last: float) -> None:
    h = 0.1
    for seed in (1, 2):
        a = np.random.default_rng(seed).standard_normal(6)
        a[-1] = last
        wd = w * math.sqrt(1.0 - zeta * zeta)
        dense, (u, v) = swung(a, h, w, zeta, 1.2 * math.pi / wd)
        # u = Im z/wd and u' = Im(L z)/wd.
        imaginary = u * wd
        real = (v * wd + zeta * w * imaginary) / wd
        largest = np.zeros(3)
        fill_largest(a, np.stack([real, imaginary]), h, (-zeta * w, wd), largest)
        for found, values in zip(largest, np.abs(dense), strict=True):
            bend = np.abs(np.diff(values, 2)).max()
            assert values.max() * (1.0 - 1e-9) <= found <= values.max() * (1.0 + 1e-9) + bend


def test_a_push_that_ends_swings_on_to_its_largest_motion() -> None:
    # From rest a step of the base by 1 lasts too short to move far: the swing after it is larger.
    zeta, w, h = 0.05, 1.0, 0.2
    wd = math.sqrt(1.0 - zeta * zeta)
    dense, (u, v) = swung(np.ones(2), h, w, zeta, 2.0 * math.pi)
    largest = np.zeros(3)
    states_of = np.stack([(v * wd + zeta * w * u * wd) / wd, u * wd])
    fill_largest(np.ones(2), states_of, h, (-zeta * w, wd), largest)
    assert largest == pytest.approx(np.abs(dense).max(axis=1), rel=1e-4)
    assert largest[0] > 3.0 * abs(u[-1])
