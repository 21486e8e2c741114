"""Response spectra against an adaptive integrator, closed forms and Chopra's El Centro."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rocksteady import Record
from rocksteady.errors import InputError
from rocksteady.measures import compute_average_acceleration, compute_response_spectrum
from tests.every import every
from tests.records import el_centro
from tests.seismic.sines import Floats, noise, refined


def integrated(record: Record, period: float, damping: float) -> Floats:
    """Largest |u|, |u'|, |u'' + a| by DOP853, sample by sample, and a period of the free swing."""
    w = 2.0 * math.pi / period
    a, h = record.acceleration_m_s2, record.dt_s
    state, best = np.zeros(2), np.zeros(3)
    for i in range(len(a)):
        last = i + 1 == len(a)
        slope = 0.0 if last else (a[i + 1] - a[i]) / h
        start = 0.0 if last else a[i]
        span = period if last else h

        def speed(t: float, y: Floats, start: float = start, slope: float = slope) -> list[float]:
            return [y[1], -(start + slope * t) - 2.0 * damping * w * y[1] - w * w * y[0]]

        solution = solve_ivp(
            speed, (0.0, span), state, method="DOP853", rtol=3e-14, atol=1e-18, dense_output=True
        )
        assert solution.sol is not None
        count = 4001 if last else max(401, int(100 * w * h))
        u, v = solution.sol(np.linspace(0.0, span, count))
        total = 2.0 * damping * w * v + w * w * u
        best = np.maximum(best, [np.abs(x).max() for x in (u, v, total)])
        state = solution.y[:, -1]
    return best


@every("period", [0.004, 0.015, 0.05, 0.4, 3.0, 30.0])
@every("damping", [0.0, 0.05, 0.6])
def test_peaks_are_those_of_an_adaptive_integrator(period: float, damping: float) -> None:
    record = noise(4, samples=15)
    found = compute_response_spectrum(record, [period], damping=damping)
    truth = integrated(record, period, damping)
    values = (found.displacement_m, found.velocity_m_s, found.acceleration_m_s2)
    for value, expected in zip(values, truth, strict=True):
        # The truth is read off samples, which lie below the peak by their curvature.
        assert value[0] >= expected * (1.0 - 1e-9)
        assert value[0] == pytest.approx(expected, rel=1e-4)


@given(st.integers(0, 10_000), st.floats(0.01, 5.0), st.floats(0.0, 0.9))
def test_it_does_not_depend_on_where_the_lines_are_sampled(
    seed: int, period: float, damping: float
) -> None:
    record = noise(seed, samples=20)
    found, fine = (
        compute_response_spectrum(one, [period], damping=damping)
        for one in (record, refined(record, 9))
    )
    for name in ("displacement_m", "velocity_m_s", "acceleration_m_s2"):
        np.testing.assert_allclose(getattr(found, name), getattr(fine, name), rtol=1e-9)


def test_resonance_with_a_sine_without_damping() -> None:
    # u = (sin wt - wt cos wt)/(2 w^2) |a|: after N cycles the swing has the amplitude N pi/w^2.
    count = 200 * 40
    time = np.arange(count + 1) / 200.0
    w = 2.0 * math.pi
    record = Record(acceleration_m_s2=np.sin(w * time), dt_s=1.0 / 200.0)
    found = compute_response_spectrum(record, [1.0], damping=0.0)
    assert found.displacement_m[0] == pytest.approx(40 * math.pi / w**2, rel=2e-4)


def test_ends_of_the_spectrum() -> None:
    record = noise(2)
    stiff = compute_response_spectrum(record, [4e-4], damping=0.05)
    # A stiff oscillator moves with the ground; steep lines, and the step at the end, shake it.
    assert stiff.pseudo_acceleration_m_s2[0] >= record.peak_acceleration_m_s2
    soft = compute_response_spectrum(record, [5000.0], damping=0.0)
    from rocksteady.measures import integrate_record

    # The mass of a soft one stays where it is while the ground moves below it, then follows.
    assert soft.velocity_m_s[0] == pytest.approx(
        abs(integrate_record(record).peak_velocity.value), rel=1e-3
    )


def test_pseudo_spectra_are_the_displacement_in_other_units() -> None:
    found = compute_response_spectrum(noise(1), [0.3, 1.0], damping=0.0)
    w = 2.0 * math.pi / found.periods_s
    np.testing.assert_allclose(found.pseudo_velocity_m_s, w * found.displacement_m)
    np.testing.assert_allclose(found.pseudo_acceleration_m_s2, w * w * found.displacement_m)
    # Without damping the spring alone accelerates the mass.
    np.testing.assert_allclose(found.acceleration_m_s2, found.pseudo_acceleration_m_s2, rtol=1e-12)


@every(("period", "inches", "g"), [(0.5, 2.67, 1.09), (1.0, 5.97, 0.610), (2.0, 7.47, 0.191)])
def test_el_centro_as_chopra_prints_it(period: float, inches: float, g: float) -> None:
    """Dynamics of Structures, figs 6.4.1 and 6.6.2: 2 % damping, El Centro, north-south, 1940."""
    values, step = el_centro()
    record = Record(acceleration_m_s2=values, dt_s=step)
    found = compute_response_spectrum(record, [period], damping=0.02)
    assert found.displacement_m[0] / 0.0254 == pytest.approx(inches, rel=0.01)
    assert found.pseudo_acceleration_m_s2[0] / 9.80665 == pytest.approx(g, rel=0.01)


def test_the_average_is_a_geometric_mean() -> None:
    record = noise(3)
    periods = np.linspace(0.2, 3.0, 10) * 0.7
    values = compute_response_spectrum(record, periods).pseudo_acceleration_m_s2
    expected = math.prod(values.tolist()) ** 0.1
    assert compute_average_acceleration(record, 0.7) == pytest.approx(expected, rel=1e-12)


@every(
    ("given", "name"),
    [
        ({"periods_s": [0.0]}, "periods_s"),
        ({"periods_s": []}, "periods_s"),
        ({"periods_s": [[1.0]]}, "periods_s"),
        ({"periods_s": [1.0, math.nan]}, "periods_s"),
        ({"periods_s": [0.99 * 0.01 * 0.02]}, "periods_s"),
        ({"periods_s": [1e9 + 0.5]}, "periods_s"),
        ({"periods_s": [1.0], "damping": 1.0}, "damping"),
        ({"periods_s": [1.0], "damping": -0.1}, "damping"),
    ],
)
def test_what_is_refused(given: dict[str, Any], name: str) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        compute_response_spectrum(noise(1), **given)
    with pytest.raises(InputError, match="ascend"):
        compute_average_acceleration(noise(1), 1.0, factors=(3.0, 0.2))
    assert compute_response_spectrum(noise(1), [0.01 * 0.02, 1e9]).damping == 0.05
