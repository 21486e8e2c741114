"""Short steps against 50 digits and against the whole series, at states of every kind."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.nonlinear._short import (
    ANGLE,
    DEGREE,
    LONGEST,
    ShortStep,
    StepDrive,
    fill_short,
    short_step,
)
from rocksteady.kernels.nonlinear.drive import Drive, Instant
from rocksteady.kernels.nonlinear.series import HIGHEST, TERMS, WORK_ROWS, expand_series
from tests.every import every
from tests.strategies import inner_sample_size

Floats = NDArray[np.float64]
LEFT_OUT = 1e-15
TURNING_POINTS = [
    (0.6, -0.0016, 1.66e-10),
    (0.8, -0.003, 6.6e-6),
    (0.057, -8.4, 7.3e-5),
    (0.0077, -4.0, 2.3e-5),
    (0.0186, 1.006, 8.3e-10),
    (0.35, 0.3, 0.4),
]
"""Alpha, shaking and angle at which terms of an estimate vanish."""

mp = mpmath.mp.clone()
mp.dps = 50


def coefficients(short: ShortStep, angle: float, velocity: float) -> Floats:
    work = np.zeros((WORK_ROWS, TERMS))
    fill_short(short, angle, velocity, work)
    row: Floats = work[ANGLE]
    return row


def stepped(drive: Drive, angle: float, velocity: float, step: float, left_out: float) -> ShortStep:
    driven = StepDrive(drive.alpha, drive.constant, drive.slope, 1.0 + drive.lift, drive.lift_slope)
    return short_step(driven, Instant(0.0, angle, velocity, 0.0, 1.0, False), step, left_out)


def spread(rng: np.random.Generator, low: float, high: float) -> float:
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def drawn(rng: np.random.Generator) -> tuple[Drive, float, float]:
    """Return a side's drive and a state; each part of them may be zero, tiny or large.

    A block at a turning point, at the instant of uplift or on a base that keeps still is where an
    estimate from the start of the step alone would be zero.
    """

    def part(low: float, high: float, none: float) -> float:
        return 0.0 if rng.random() < none else float(rng.normal() * spread(rng, low, high))

    alpha = spread(rng, 1e-3, 1.5)
    weight = 1.0 if rng.random() < 0.5 else float(rng.uniform(0.01, 3.0))
    lift_slope = part(0.01, 100.0, 0.5)
    angle = 0.0 if rng.random() < 0.3 else min(spread(rng, 1e-10, 3.0), 1.57 / alpha)
    shaking = part(1e-3, 30.0, 0.2)
    if rng.random() < 0.1:  # a foot that is just about to lift
        shaking = weight * math.tan(alpha) / alpha * (1.0 + 1e-9 * rng.normal())
    drive = Drive(alpha, shaking, part(0.01, 300.0, 0.2), 0.0, 0.0, weight - 1.0, lift_slope)
    return drive, angle, part(1e-8, 5.0, 0.1)


# ------------------------------------------------------------------------------ coefficients


def exact_coefficients(drive: Drive, angle: float, velocity: float, count: int) -> list[Any]:
    """Return Taylor coefficients of y by powers of series in 50 digits.

    sin and cos are composed by their own Taylor series about the first angle, not by a recurrence
    of products as the kernels do.
    """
    alpha, weight = mp.mpf(drive.alpha), 1 + mp.mpf(drive.lift)
    base = mp.mpf(drive.alpha) * (1 - mp.mpf(angle))
    y = [mp.mpf(angle), mp.mpf(velocity)]

    def times(a: list[Any], b: list[Any]) -> list[Any]:
        return [sum(a[j] * b[n - j] for j in range(n + 1)) for n in range(len(a))]

    while len(y) < count:
        size = len(y)
        turned = [mp.mpf(0)] + [-alpha * term for term in y[1:]]
        sine, cosine = [mp.mpf(0)] * size, [mp.mpf(0)] * size
        power = [mp.mpf(1)] + [mp.mpf(0)] * (size - 1)
        for k in range(size):
            for n in range(size):
                sine[n] += mp.sin(base + k * mp.pi / 2) * power[n] / mp.factorial(k)
                cosine[n] += mp.cos(base + k * mp.pi / 2) * power[n] / mp.factorial(k)
            power = times(power, turned)
        n = size - 2
        force = mp.mpf(drive.constant) * cosine[n] - weight * sine[n] / alpha
        if n:
            force += drive.slope * cosine[n - 1] - drive.lift_slope * sine[n - 1] / alpha
        y.append(force / ((n + 1) * (n + 2)))
    return y


@every("seed", range(40))
def test_coefficients_are_those_of_50_digits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    drive, angle, velocity = drawn(rng)
    exact = exact_coefficients(drive, angle, velocity, 9)
    # A step of which nothing may be left out has the seventh derivative whole.
    short = stepped(drive, angle, velocity, 0.1, 0.0)
    found = coefficients(short, angle, velocity)
    # What each is a sum of, with natural sizes of its parts, so that rounding has a measure.
    size = 1.0 + drive.alpha * (abs(velocity) + abs(drive.constant)) + abs(drive.lift_slope)
    rate = (1.0 + drive.lift + drive.alpha * abs(drive.constant)) ** 0.5
    rate = max(rate, drive.alpha * abs(velocity), size ** (1 / 3))
    pull = abs(drive.constant) + 2.0 + drive.lift + (abs(drive.slope) + size) / rate
    scale = max(angle, abs(velocity) / rate, pull / rate**2)
    for n in range(8):
        allowed = 3e-13 * scale * (2.0 * rate) ** n / math.factorial(n)
        assert abs(found[n] - exact[n]) <= allowed


@every("seed", range(20))
def test_a_slender_side_without_vertical_motion_moves_by_the_linear_closed_form(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    drive, angle, velocity = drawn(rng)
    drive = Drive(1e-9, *drive[1:5], 0.0, 0.0)
    short = stepped(drive, angle, velocity, 0.2, LEFT_OUT)
    # y + r = (y0 + r0) cosh t + (v0 + m) sinh t - m t with r = h - 1 and slope m.
    r, m = mp.mpf(drive.constant) - 1, mp.mpf(drive.slope)
    even, odd = mp.mpf(angle) + r, mp.mpf(velocity) + m
    expected = [(even, odd)[n % 2] / mp.factorial(n) for n in range(2, DEGREE + 1)]
    size = abs(angle) + abs(velocity) + abs(drive.constant) + abs(drive.slope) + 1.0
    for found, exact in zip(coefficients(short, angle, velocity)[2:], expected, strict=False):
        assert abs(found - exact) <= 1e-15 * size
    time = float(rng.uniform(0.0, 0.02))
    curve = np.polynomial.Polynomial(coefficients(short, angle, velocity)[: DEGREE + 1])
    y, v = curve(time), curve.deriv()(time)
    assert abs(y - (even * mp.cosh(time) + odd * mp.sinh(time) - r - m * time)) <= 1e-15 * size
    assert abs(v - (even * mp.sinh(time) + odd * mp.cosh(time) - m)) <= 2e-15 * size


# ------------------------------------------------------------------------------------- error


def left_out_of(drive: Drive, angle: float, velocity: float, short: ShortStep, h: float) -> float:
    """Return what a short step leaves out of y, by the whole series to its highest term."""
    work = np.zeros((WORK_ROWS, TERMS))
    at = Instant(0.0, angle, velocity, 0.0, 1.0, False)
    degree, _ = expand_series(drive, at, h, 1e-30, work)
    whole = np.where(np.arange(TERMS) <= degree, work[0], 0.0)
    # The first seven are those of both, but for rounding.
    rest = whole[7:].copy()
    rest[0] -= short.seventh
    rest[1] -= short.eighth
    terms = rest * h ** np.arange(7.0, HIGHEST + 1.0)
    assert np.abs(terms[-3:]).max() <= 1e-2 * np.abs(terms).max() + 1e-19, "the series ends in time"
    return abs(float(terms.sum()))


@pytest.mark.slow
def test_an_accepted_step_leaves_out_hardly_more_than_it_may() -> None:
    rng = np.random.default_rng(7)
    cases = inner_sample_size(40_000, 1_000)
    accepted, excess = 0, []
    for _ in range(cases):
        drive, angle, velocity = drawn(rng)
        h, left_out = spread(rng, 1e-4, LONGEST), spread(rng, 1e-15, 1e-8)
        short = stepped(drive, angle, velocity, h, left_out)
        if not short.exact:
            continue
        accepted += 1
        terms = (angle, velocity * h, short.second * h**2, short.third * h**3)
        allowed = left_out * max(abs(term) for term in terms)
        excess.append(left_out_of(drive, angle, velocity, short, h) / (allowed + 1e-300))
    assert accepted > 0.5 * cases
    assert max(excess) <= 5.0
    assert np.mean(np.array(excess) > 2.0) <= 1e-4
    assert np.mean(np.array(excess) > 0.01) > 0.02, "nor are steps refused that would do"


# A base that keeps still, or whose slope is small, and a block at its turning point: the odd
# derivatives are zero or nearly so, and with them every term of the first estimate.
@every("velocity", [0.0, 1e-10, -1e-7])
@every("slope", [0.0, 1e-6])
@every(("alpha", "shaking", "angle"), TURNING_POINTS)
def test_a_turning_point_is_no_reason_to_accept_a_long_step(
    alpha: float, shaking: float, angle: float, slope: float, velocity: float
) -> None:
    drive = Drive(alpha, shaking, slope, 0.0, 0.0, 0.0, 0.0)
    refused = 0
    for h in np.geomspace(1e-3, LONGEST, 60).tolist():
        short = stepped(drive, angle, velocity, h, LEFT_OUT)
        if not short.exact:
            refused += 1
            continue
        terms = (angle, velocity * h, short.second * h**2, short.third * h**3)
        allowed = 2.0 * LEFT_OUT * max(abs(term) for term in terms)
        assert left_out_of(drive, angle, velocity, short, h) <= allowed
    assert 0 < refused < 60


@every("seed", range(8))
def test_longer_steps_than_the_longest_are_refused(seed: int) -> None:
    drive, angle, velocity = drawn(np.random.default_rng(seed))
    slender = Drive(1e-9, *drive[1:5], 0.0, 0.0)
    for h in (math.nextafter(LONGEST, 1.0), 0.3, 8.0, 1e12, math.inf, math.nan):
        assert not stepped(slender, angle, velocity, h, 1.0).exact
    assert stepped(slender, angle, velocity, 1e-3, 1e-12).exact


@every("given", [(1e200, 0.3, 0.1), (math.nan, 0.3, 0.1), (0.5, 0.3, math.nan)])
def test_what_overflows_or_is_no_number_is_refused(given: tuple[float, float, float]) -> None:
    shaking, angle, velocity = given
    drive = Drive(0.3, shaking, 1.0, 0.0, 0.0, 0.0, 0.0)
    assert not stepped(drive, angle, velocity, 0.01, 1e-3).exact


def test_a_block_that_lifts_off_does_not_sink() -> None:
    alpha = 0.3
    level = math.tan(alpha) / alpha * (1.0 - 1e-15)
    for lifting, least in ((True, 0.0), (False, -1e-14)):
        at = Instant(0.0, 0.0, 0.0, 0.0, 1.0, lifting)
        short = short_step(StepDrive(alpha, level, 2.0, 1.0, 0.0), at, 0.01, LEFT_OUT)
        assert least <= short.second <= 0.0
        assert short.third == pytest.approx(2.0 * math.cos(alpha) / 6.0, rel=1e-15)
