"""Zeros, levels and extrema of a step's polynomial against slow sampling and proved roots."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpz_poly
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from rocksteady.kernels.nonlinear._expansion import DEGREE, expand
from rocksteady.kernels.nonlinear._zeros import first_rise, first_zero, largest, last_rise
from rocksteady.kernels.nonlinear.drive import Drive, Instant, hardest_pull
from rocksteady.kernels.nonlinear.series import (
    HIGHEST,
    TERMS,
    WORK_ROWS,
    angle_at,
    third_bound,
)
from tests.every import every
from tests.strategies import inner_sample_size, rest_slow

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


def check_first_zeros(seed: int) -> None:
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


@pytest.mark.slow
@every("seed", range(60))
def test_first_zeros_are_those_of_slow_sampling(seed: int) -> None:
    check_first_zeros(seed)


@every("seed", range(100, 104))
def test_a_few_first_zeros_are_those_of_slow_sampling(seed: int) -> None:
    check_first_zeros(seed)


@every("depth", [1e-3, 1e-6, 1e-9, 1e-12, 1e-14])
@every("place", [0.1, 0.37, 0.9])
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


@every("speed", [1.0, 1e-4, 1e-8, 1e-16, 1e-80])
def test_a_bounce_keeps_its_digits_however_low(speed: float) -> None:
    work, degree = space(np.array([0.0, speed, -0.5]))
    assert first_zero_of(work, degree, 3.0) == pytest.approx(2.0 * speed, rel=1e-15)


@every("rest", [0.0, 1e-300, 1e-22, 1e-16])
def test_lifting_off_where_nothing_pulls_yet_is_no_zero_either(rest: float) -> None:
    work, degree = space([0.0, 0.0, rest, 0.4, -0.3, 0.05])
    assert first_zero_of(work, degree, 0.8) == -1.0
    expected = (0.3 - math.sqrt(0.3**2 - 4.0 * 0.05 * 0.4)) / 0.1  # 0.4 - 0.3 t + 0.05 t^2 = 0
    assert first_zero_of(work, degree, 2.5) == pytest.approx(expected, rel=1e-13)


def test_lifting_off_is_no_zero() -> None:
    work, degree = space(np.array([0.0, 0.0, 0.0, 1.0, -0.5]))
    assert first_zero_of(work, degree, 1.0) == -1.0
    assert first_zero_of(work, degree, 3.0) == pytest.approx(2.0, rel=1e-14)


@every("seed", range(20))
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


# ------------------------------------------- polynomials of flights, against proved roots


def exact_roots(work: Floats, degree: int, step: float) -> list[float]:
    """Return the zeros in (0, step], but for zeros at the start, isolated by exact arithmetic."""
    fractions = [Fraction(float(c)) for c in work[0, : degree + 1]]
    while fractions and fractions[0] == 0:
        del fractions[0]
    # In units of a power of two near the step, so that the integers stay short.
    unit = Fraction(2) ** math.frexp(step)[1]
    scaled = [c * unit**n for n, c in enumerate(fractions)]
    common = max(c.denominator for c in scaled)
    polynomial: Any = fmpz_poly([int(c * common) for c in scaled])
    found = polynomial.complex_roots()
    times = [float(root.real) * float(unit) for root, _ in found if root.imag == 0]
    return sorted(t for t in times if 0.0 < t <= step)


def doubt_of(work: Floats, degree: int, time: float) -> float:
    """Return what rounding may make of y at a time."""
    return 1e-14 * float(np.abs(work[0, : degree + 1]) @ time ** np.arange(degree + 1.0))


def lowest(work: Floats, degree: int, step: float) -> float:
    curve = Polynomial(work[0, : degree + 1])
    turns = curve.deriv().roots()
    inside = turns.real[(np.abs(turns.imag) < 1e-9) & (turns.real > 0.0) & (turns.real < step)]
    return float(min(curve(np.append(inside, step))))


def drawn_step(
    rng: np.random.Generator, back: bool
) -> tuple[Drive, float, float, tuple[float, float], float, float]:
    """Return a drive, y and y', sine and cosine of the shaking, a step and what it leaves out.

    What is thrown `back` comes down fast upon a base that pulls it up again.
    """
    shaken = rng.random() < 0.5
    alpha = math.exp(rng.uniform(math.log(0.003), math.log(1.3)))
    drive = Drive(
        alpha,
        rng.uniform(1.5, 4.0) if back else 2.0 * rng.normal(),
        10.0 * rng.normal(),
        rng.uniform(0.0, 5.0) if shaken and not back else 0.3 * shaken,
        rng.uniform(0.3, 40.0) if shaken else 0.0,
        0.3 * rng.normal() if rng.random() < 0.5 else 0.0,
        rng.normal() if rng.random() < 0.5 else 0.0,
    )
    phase = rng.uniform(0.0, 6.0)
    reach = math.exp(rng.uniform(math.log(0.01), math.log(3.0 if shaken else 0.25)))
    velocity = float(rng.normal())
    if back:
        velocity = -reach * rng.uniform(0.2, 1.5)
    angle = abs(velocity) * reach * rng.uniform(0.0, 2.0)
    if rng.random() < 0.2 and not back:
        angle, velocity = 0.0, abs(velocity)
    return drive, angle, velocity, (math.sin(phase), math.cos(phase)), reach, 1e-15


def verdict_is_exact(work: Floats, degree: int, step: float, pull: float) -> bool | None:
    """Compare the first zero with the proved one; return whether there is one, None in doubt."""
    third = third_bound(work, degree, step)
    found = first_zero(work, degree, step, third, pull)
    assert found == -1.0 or 0.0 < found <= step
    roots = exact_roots(work, degree, step)
    curve = Polynomial(work[0, : degree + 1])
    if not roots:
        # A zero where there is none is one that rounding makes, at the floor.
        assert found < 0.0 or abs(curve(found)) <= doubt_of(work, degree, found)
        return False if found < 0.0 else None
    first = roots[0]
    if found < 0.0:
        assert lowest(work, degree, step) >= -doubt_of(work, degree, step)
        return None
    slope = abs(curve.deriv()(first))
    if doubt_of(work, degree, first) > 1e-3 * slope * first:
        assert abs(curve(found)) <= doubt_of(work, degree, found)
        return None
    rounding = 0.04 * doubt_of(work, degree, first) / slope  # two roundings of its terms
    grazing = abs(curve.deriv(2)(first)) * rounding > 0.1 * slope
    if not grazing:
        assert abs(found - first) <= 2.0 * math.ulp(first) + 2.0 * rounding
    assert abs(found - first) <= 100.0 * rounding + 2.0 * math.ulp(first)
    return True


@pytest.mark.parametrize("seed", rest_slow(range(8), 3))
def test_first_zeros_of_flights_are_the_proved_ones(seed: int) -> None:
    rng = np.random.default_rng(900 + seed)
    hits = misses = 0
    degrees = set()
    for _ in range(inner_sample_size(600, 30)):
        drive, angle, velocity, swing, reach, left_out = drawn_step(rng, rng.random() < 0.5)
        work = np.zeros((WORK_ROWS, TERMS))
        at = Instant(0.0, angle, velocity, *swing, False)
        degree, step = expand(drive, at, reach, left_out, work)
        degrees.add(degree)
        for pull in (math.inf, hardest_pull(drive, 0.0, step)):
            verdict = verdict_is_exact(work, degree, step, pull)
            hits, misses = hits + (verdict is True), misses + (verdict is False)
    assert {DEGREE, HIGHEST} <= degrees
    assert min(hits, misses) > inner_sample_size(30, 3)


def check_grazes(depth: float, count: int) -> None:
    rng = np.random.default_rng(round(-100.0 * math.log10(depth)))
    verdicts: list[bool | None] = []
    for case in range(count):
        drive, angle, velocity, swing, reach, left_out = drawn_step(rng, True)
        work = np.zeros((WORK_ROWS, TERMS))
        degree, step = DEGREE, reach
        aim = depth * abs(velocity) * reach * (-1.0 if case % 2 else 1.0)
        for _ in range(6):  # set it down by as much as its lowest point misses the aim
            at = Instant(0.0, angle, velocity, *swing, False)
            degree, step = expand(drive, at, reach, left_out, work)
            angle += aim - lowest(work, degree, step)
        if angle <= 0.0:
            continue
        for pull in (math.inf, hardest_pull(drive, 0.0, step)):
            verdict = verdict_is_exact(work, degree, step, pull)
            verdicts.append(verdict)
            if depth > 1e-12 and lowest(work, degree, step) * aim > 0.0:
                assert verdict is (aim < 0.0)
    assert len(verdicts) > 10
    if depth > 1e-12:
        assert min(verdicts.count(True), verdicts.count(False)) > 5


@pytest.mark.slow
@every("depth", [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14])
def test_flights_that_graze_touch_or_pass_as_their_polynomials_do(depth: float) -> None:
    check_grazes(depth, inner_sample_size(200, 20))


@every("depth", [1e-3, 1e-9, 1e-14])
def test_a_few_flights_graze_touch_or_pass_as_their_polynomials_do(depth: float) -> None:
    check_grazes(depth, 22)
