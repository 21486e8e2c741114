"""Taylor steps against 25 digits, and against the equation of motion itself."""

import math

import mpmath
import numpy as np
import pytest

from rocksteady.kernels.nonlinear._expansion import expand
from rocksteady.kernels.nonlinear.drive import Drive, Instant, acceleration, foot_forcing
from rocksteady.kernels.nonlinear.series import (
    HIGHEST,
    SHAKING,
    TERMS,
    WORK_ROWS,
    angle_at,
    fill_shaking,
    make_work,
    root_of_parabola,
)
from tests.every import every

mp = mpmath.mp.clone()
mp.dps = 25


def drawn(seed: int) -> tuple[Drive, float, float, float]:
    rng = np.random.default_rng(seed)
    drive = Drive(
        alpha=rng.uniform(0.01, 1.2),
        constant=rng.normal(),
        slope=rng.normal(),
        amplitude=rng.uniform(0.0, 4.0) if seed % 3 else 0.0,
        frequency=rng.uniform(0.5, 30.0) if seed % 3 else 0.0,
        lift=0.3 * rng.normal() if seed % 2 else 0.0,
        lift_slope=rng.normal() if seed % 2 else 0.0,
    )
    return drive, rng.uniform(0.0, 1.5), rng.normal(), rng.uniform(0.0, 6.0)


@pytest.mark.slow
@every("seed", range(6))
def test_a_step_is_as_exact_as_asked_for(seed: int) -> None:
    drive, angle, velocity, phase = drawn(seed)
    work = np.zeros((WORK_ROWS, TERMS))
    at = Instant(0.0, angle, velocity, math.sin(phase), math.cos(phase), False)
    degree, step = expand(drive, at, 10.0, 1e-15, work)
    assert 0.0 < step < 10.0

    def motion(t: mpmath.mpf, y: list[mpmath.mpf]) -> list[mpmath.mpf]:
        tilt = drive.alpha * (1 - y[0])
        h = drive.constant + drive.slope * t
        h += drive.amplitude * mp.sin(mp.mpf(phase) + drive.frequency * t)
        weight = 1 + drive.lift + drive.lift_slope * t
        return [y[1], h * mp.cos(tilt) - weight * mp.sin(tilt) / drive.alpha]

    exact = mp.odefun(motion, 0, [mp.mpf(angle), mp.mpf(velocity)], tol=mp.mpf(10) ** -19)
    for part in (0.5, 1.0):
        state = exact(mp.mpf(part * step))
        y, v = angle_at(work, degree, part * step)
        scale = max(abs(angle), abs(velocity) * step)
        assert abs(y - state[0]) <= 2e-14 * scale
        assert abs(v - state[1]) <= 4e-13 * scale / step


@every("seed", range(12))
def test_the_first_curvature_is_the_equation_of_motion(seed: int) -> None:
    drive, angle, velocity, phase = drawn(seed)
    work = np.zeros((WORK_ROWS, TERMS))
    sine = math.sin(phase)
    at = Instant(0.0, angle, velocity, sine, math.cos(phase), False)
    expand(drive, at, 1.0, 1e-15, work)
    assert 2.0 * work[0, 2] == pytest.approx(acceleration(drive, 0.0, angle, sine), rel=1e-14)
    r = foot_forcing(drive)
    assert r.constant + r.amplitude * sine == pytest.approx(
        acceleration(drive, 0.0, 0.0, sine), rel=1e-13, abs=1e-14
    )


def test_the_shaking_of_a_series_is_that_of_its_sinusoids() -> None:
    drive = Drive(0.3, 0.0, 0.0, 2.0, 3.0, 0.0, 0.0, series=-1.0)
    shares, phase = np.array([0.7, -0.2, 0.0, 0.0, 0.0, 0.4, 0.3, 0.0]), 0.8
    work = make_work(shares)
    fill_shaking(drive, math.sin(phase), math.cos(phase), work)
    for n in range(HIGHEST - 1):
        terms = [
            (3.0 * k) ** n * (p * math.sin(turned) + q * math.cos(turned)) / math.factorial(n)
            for k, (p, q) in enumerate(shares.reshape(-1, 2), 1)
            for turned in [k * phase + 0.5 * math.pi * n]
        ]
        rounding = 1e-14 * sum(map(abs, terms))
        assert work[SHAKING, n] == pytest.approx(-2.0 * sum(terms), rel=0, abs=10 * rounding), n


def test_short_steps_take_few_terms() -> None:
    drive = Drive(0.3, -0.4, 30.0, 0.0, 0.0, 0.0, 0.0)
    work = np.zeros((WORK_ROWS, TERMS))
    degree, step = expand(drive, Instant(0.0, 0.5, 0.3, 0.0, 1.0, False), 0.01, 1e-15, work)
    assert step == 0.01
    assert degree <= 10


@every("velocity", [1e-300, 1e-160, 6.8e-34, 1e-16, 1e-6])
@every("angle", [0.0, 1e-200, 1e-50])
def test_a_step_from_an_acceleration_of_zero_leads_on(velocity: float, angle: float) -> None:
    """What leaves the floor without acceleration has no parabola that leads back to it."""
    drive = Drive(0.24497866312686414, 1.0204970376156208, -0.08484947470971271, 0.0, 0.0, 0.0, 0.0)
    work = np.zeros((WORK_ROWS, TERMS))
    at = Instant(0.0, angle, velocity, 0.0, 1.0, False)
    degree, step = expand(drive, at, 0.0267, 1e-15, work)
    assert work[0, 2] == 0.0
    assert degree >= 2
    assert 0.0 < step <= 0.0267
    assert root_of_parabola(angle, velocity, 0.0, True) == math.inf


def test_the_crossing_of_a_straight_line_is_ahead_or_nowhere() -> None:
    assert root_of_parabola(2.0, -0.5, 0.0, True) == 4.0
    assert root_of_parabola(-2.0, 0.5, 0.0, False) == 4.0
    assert root_of_parabola(2.0, 0.5, 0.0, True) == math.inf
    assert root_of_parabola(-2.0, -0.5, 0.0, False) == math.inf
