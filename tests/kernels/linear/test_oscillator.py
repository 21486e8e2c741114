"""The states of oscillators, against a filter of complex numbers and a steady state."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from rocksteady.kernels.linear.oscillator import fill_oscillator
from tests.every import every


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
