"""The recurrence of damped oscillators against integrals in many digits."""

import cmath
import itertools
import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady.model.motions.oscillator import (
    Parts,
    grown,
    imaginary,
    inverse,
    rate_of,
    states,
    steady_line,
)
from tests.strategies import logarithmic

mp = mpmath.mp.clone()
mp.dps = 25

NUMBERS = st.complex_numbers(min_magnitude=1e-3, max_magnitude=1e3)


def of(parts: Parts) -> complex:
    """Return the number that two parts make."""
    return complex(float(parts.real), float(parts.imag))


def integral(rate: Parts, h: float, first: float, last: float) -> mpmath.mpc:
    """Return -int e^(L (h - t)) a(t) dt over a step, of a line from one value to another."""
    eigenvalue, slope = mp.mpc(*rate), (mp.mpf(last) - first) / h
    cuts = mp.linspace(0, h, 2 + int(abs(eigenvalue) * h))
    return -mp.quad(lambda t: mp.exp(eigenvalue * (h - t)) * (first + slope * t), cuts)


def test_each_step_is_the_integral_however_short_it_is() -> None:
    wrong = []
    for turn, damping in itertools.product((1e-7, 1e-3, 0.1, 0.49, 0.51, 2.0, 9.0), (1e-3, 0.6)):
        h = 0.01
        rate = rate_of(turn / h, damping)
        growth = mp.exp(mp.mpc(*rate) * h)
        for a in ((1.0, 0.0), (0.0, 1.0, -3.0)):
            z = states(np.array(a), h, rate)
            expected = [mp.mpc(0)]
            for first, last in itertools.pairwise(a):
                expected.append(growth * expected[-1] + integral(rate, h, first, last))
            size = max(map(abs, expected))
            for place, exact in enumerate(expected):
                error = abs(mp.mpc(z.real[place], z.imag[place]) - exact) / size
                if error > 4e-15:
                    wrong.append((turn, damping, a, place, float(error)))
    assert not wrong, wrong


@given(NUMBERS, NUMBERS, st.floats(-50.0, 50.0).filter(lambda real: abs(real) > 1e-3))
@settings(max_examples=50)
def test_parts_are_complex_numbers(x: complex, y: complex, real: float) -> None:
    one, other = Parts(x.real, x.imag), Parts(y.real, y.imag)
    close = pytest.approx
    assert of(one + other) == close(x + y, rel=1e-15, abs=1e-12)
    assert of(one - other) == close(x - y, rel=1e-15, abs=1e-12)
    assert of(one * other) == close(x * y, rel=1e-14, abs=1e-14 * abs(x * y))
    assert of(one / real) == close(x / real, rel=1e-15)
    assert of(inverse(one)) == close(1.0 / x, rel=1e-14)
    assert imaginary(one, other) == close((x * y).imag, abs=1e-14 * abs(x * y))


@given(logarithmic(1e-2, 1e2), st.floats(0.001, 0.99), st.floats(0.0, 3.0))
@settings(max_examples=50)
def test_a_free_swing_grows_by_its_eigenvalue(w: float, zeta: float, t: float) -> None:
    eigenvalue = w * complex(-zeta, math.sqrt(1.0 - zeta * zeta))
    rate = rate_of(w, zeta)
    assert of(rate) == pytest.approx(eigenvalue, rel=1e-15)
    exact = cmath.exp(eigenvalue * t)
    assert of(grown(rate, t)) == pytest.approx(exact, rel=1e-12, abs=1e-300)
    # A line without a swing keeps z' = L z - a with z' constant.
    z = of(steady_line(2.0, -3.0, rate))
    later = of(steady_line(2.0 - 3.0 * t, -3.0, rate))
    assert later == pytest.approx(z - 3.0 * t / eigenvalue, rel=1e-12)
    assert eigenvalue * z - 2.0 == pytest.approx(-3.0 / eigenvalue, rel=1e-9, abs=1e-13)
