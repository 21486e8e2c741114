"""Steps of degree 8 and 10 against 50 digits and the long series, landings against its search."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.linear.short import DOUBT, LANDS
from rocksteady.kernels.nonlinear._expansion import (
    BRIEF,
    DEGREE,
    Course,
    Stretch,
    bends_after,
    bounds_over,
    fill_course,
    landing_step,
    middle_step,
    most_over,
    shortened,
    state_after,
)
from rocksteady.kernels.nonlinear._landing_step import first_landing, landing_at_once
from rocksteady.kernels.nonlinear.drive import Drive, Instant, StepDrive, SteppedFlight
from rocksteady.kernels.nonlinear.flight import fly
from rocksteady.kernels.nonlinear.series import (
    ANGLE,
    TERMS,
    WORK_ROWS,
    angle_at,
    expand_series,
)
from tests.every import every
from tests.strategies import inner_sample_size, sample_size

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


def stepped(
    drive: Drive, angle: float, velocity: float, h: float, left: float
) -> tuple[Course, bool]:
    driven = StepDrive(drive.alpha, drive.constant, drive.slope, 1.0 + drive.lift, drive.lift_slope)
    return middle_step(driven, Instant(0.0, angle, velocity, 0.0, 1.0, FALSE), h, left)


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
    exact = exact_coefficients(drive, angle, velocity, DEGREE + 1)
    course, _ = stepped(drive, angle, velocity, 0.1, 0.0)
    # What each is a sum of, with natural sizes of its parts, so that rounding has a measure.
    size = 1.0 + drive.alpha * (abs(velocity) + abs(drive.constant)) + abs(drive.lift_slope)
    rate = (1.0 + drive.lift + drive.alpha * abs(drive.constant)) ** 0.5
    rate = max(rate, drive.alpha * abs(velocity), size ** (1 / 3))
    pull = abs(drive.constant) + 2.0 + drive.lift + (abs(drive.slope) + size) / rate
    scale = max(angle, abs(velocity) / rate, pull / rate**2)
    for n in range(2, DEGREE + 1):
        allowed = 3e-13 * scale * (2.0 * rate) ** n / math.factorial(n)
        assert abs(course[n - 2] - exact[n]) <= max(allowed, 1e-15 * abs(exact[n])), n


@every("given", [(1e200, 0.3, 0.1), (math.nan, 0.3, 0.1), (0.5, 0.3, math.nan), (1e35, 0.3, 1e80)])
def test_what_overflows_or_is_no_number_is_refused(given: tuple[float, float, float]) -> None:
    shaking, angle, velocity = given
    drive = Drive(0.3, shaking, 1.0, 0.0, 0.0, 0.0, 0.0)
    assert not stepped(drive, angle, velocity, 0.01, 1e-3)[1]


def test_a_block_that_lifts_off_does_not_sink() -> None:
    alpha = 0.3
    level = math.tan(alpha) / alpha * (1.0 - 1e-15)
    for lifting, least in ((True, 0.0), (False, -1e-14)):
        at = Instant(0.0, 0.0, 0.0, 0.0, 1.0, lifting)
        course, _ = middle_step(StepDrive(alpha, level, 2.0, 1.0, 0.0), at, 0.01, 1e-15)
        assert least <= course.second <= 0.0
        assert course.third == pytest.approx(2.0 * math.cos(alpha) / 6.0, rel=1e-15)


def test_what_a_step_leaves_out_is_as_little_as_it_may() -> None:
    rng, work = np.random.default_rng(3), np.empty((WORK_ROWS, TERMS))
    exact, most, count = 0, 0, inner_sample_size(20_000, 1_000)
    for _ in range(count):
        alpha, step = 10.0 ** rng.uniform(-2.0, 0.0), 10.0 ** rng.uniform(-3.0, -0.3)
        shaking, slope = rng.normal(0.0, 2.0), rng.normal() * 10.0 ** rng.uniform(-1.0, 2.0)
        weight, weight_slope = rng.uniform(0.3, 1.7), rng.normal()
        angle = rng.uniform(0.0, 1.2) * 10.0 ** -rng.uniform(0.0, 6.0)
        velocity = rng.normal() * 10.0 ** -rng.uniform(0.0, 4.0)
        at = Instant(0.0, angle, velocity, 0.0, 1.0, FALSE)
        driven = StepDrive(alpha, shaking, slope, weight, weight_slope)
        course, enough = middle_step(driven, at, step, 1e-12)
        if not enough:
            continue
        exact += 1
        drive = Drive(alpha, shaking, slope, 0.0, 0.0, weight - 1.0, weight_slope)
        degree, _ = expand_series(drive, at, step, 1e-30, work)
        truth, _ = angle_at(work, degree, step)
        moved = max(angle, abs(velocity) * step, step * step * abs(course.second))
        moved = max(moved, step * step * step * abs(course.third))
        error = abs(state_after(course, angle, velocity, step)[0] - truth)
        assert error <= 4e-12 * moved
        most += error > 1e-12 * moved
    assert exact > 0.5 * count
    assert most < 1e-3 * exact


def test_a_brief_step_takes_degree_8_where_that_is_exact() -> None:
    rng, work = np.random.default_rng(8), np.empty((WORK_ROWS, TERMS))
    cases, longer = inner_sample_size(4_000, 200), 0
    for _ in range(cases):
        alpha, step = rng.uniform(0.05, 0.5), rng.uniform(0.2, 2.0) * BRIEF
        angle, velocity = 10.0 ** -rng.uniform(0.0, 9.0), rng.normal() * 10.0 ** -rng.uniform(0, 4)
        shaking, slope = rng.normal(), rng.normal() * 100.0
        at = Instant(0.0, angle, velocity, 0.0, 1.0, FALSE)
        course, enough = middle_step(StepDrive(alpha, shaking, slope, 1.0, 0.0), at, step, 1e-15)
        expand_series(Drive(alpha, shaking, slope, 0.0, 0.0, 0.0, 0.0), at, step, 1e-30, work)
        terms = np.abs(work[ANGLE, :11]) * step ** np.arange(11)
        most = 1e-15 * terms[:4].max()
        left = terms[8] + step * step * terms[7]
        if abs(left / most - 1.0) < 1e-6:
            continue  # either
        eighth = step <= BRIEF and left <= most
        assert (course.ninth == course.tenth == 0.0) == eighth
        assert enough or not eighth
        longer += step <= BRIEF and not eighth
    assert longer > 0.02 * cases


def test_what_lanes_take_from_a_course_is_what_a_step_gives() -> None:
    rng = np.random.default_rng(51)
    brief, cases = 0, sample_size(4_000, 200)
    for _ in range(cases):
        drive, angle, velocity = drawn(rng)
        step, left = spread(rng, 1e-3, 0.5), spread(rng, 1e-16, 1e-10)
        whole, _ = stepped(drive, angle, velocity, 2.0 * BRIEF, 0.0)  # never enough: of degree 10
        course, exact = stepped(drive, angle, velocity, step, left)
        assert shortened(whole, angle, velocity, step, left, FALSE) == (course, exact)
        if step <= BRIEF and course.tenth == 0.0:
            assert shortened(course, angle, velocity, step, left, TRUE) == (course, exact)
            brief += exact
    assert brief > 0.02 * cases


def test_a_landing_found_at_once_is_that_of_the_search_to_the_last_bit() -> None:
    rng = np.random.default_rng(52)
    at_once = landings = 0
    for _ in range(sample_size(10_000, 500)):
        alpha, step = 10.0 ** rng.uniform(-2.0, 0.0), 10.0 ** rng.uniform(-3.0, -1.0)
        shaking, slope = rng.normal(0.0, 1.5), rng.normal() * 10.0 ** rng.uniform(0.0, 2.0)
        angle = 0.0 if rng.random() < 0.5 else 10.0 ** rng.uniform(-8.0, -1.0)
        velocity = rng.normal() * 10.0 ** rng.uniform(-6.0, -1.0)
        if angle == 0.0:
            velocity = abs(velocity)
        drive = Drive(alpha, shaking, slope, 0.0, 0.0, 0.0, 0.0)
        course, _ = stepped(drive, angle, velocity, step, 1e-15)
        _, fourths = bounds_over(course, step)
        end = state_after(course, angle, velocity, step)
        found = first_landing(course, angle, velocity, step, fourths, *end)
        if found.event != LANDS:
            continue
        landings += 1
        time, speed, there = landing_at_once(course, angle, velocity, step)
        if there:
            assert (time, speed) == (found.time, found.velocity)
            at_once += 1
    assert at_once > 0.9 * landings > 0.0


def test_landings_are_those_of_the_search() -> None:
    rng, work = np.random.default_rng(49), np.empty((WORK_ROWS, TERMS))
    cases, doubts, landings = sample_size(10_000, 500), 0, 0
    for _ in range(cases):
        alpha, step = 10.0 ** rng.uniform(-2.0, 0.0), 10.0 ** rng.uniform(-3.0, -1.3)
        shaking, later = rng.normal(0.0, 1.5, 2).tolist()
        slope = (later - shaking) / step
        angle = 0.0 if rng.random() < 0.5 else 10.0 ** rng.uniform(-6.0, 0.0)
        velocity = rng.normal() * 10.0 ** rng.uniform(-6.0, 0.0)
        if angle == 0.0:
            velocity = abs(velocity)
        at = Instant(0.0, angle, velocity, 0.0, 1.0, FALSE)
        course, enough = middle_step(StepDrive(alpha, shaking, slope, 1.0, 0.0), at, step, 1e-15)
        if not enough:
            doubts += 1
            continue
        _, fourths = bounds_over(course, step)
        end = state_after(course, angle, velocity, step)
        found = first_landing(course, angle, velocity, step, fourths, *end)
        doubts += found.event == DOUBT
        if found.event == DOUBT:
            continue
        drive = Drive(alpha, shaking, slope, 0.0, 0.0, 0.0, 0.0)
        flight = SteppedFlight(drive, 0.0, angle, velocity, step, 1e-15)
        nothing = np.zeros(0)
        truth = fly(flight, FALSE, np.inf, FALSE, nothing, 1.0, 1.0, work, np.empty((0, TERMS)))
        assert (found.event == LANDS) == (truth.event == FOUND)
        scale = max(angle, abs(velocity) * step, step * step)
        speed = abs(truth.velocity)
        assert abs(found.velocity - truth.velocity) <= 1e-12 * (speed + scale / step)
        if found.event == LANDS:
            landings += 1
            assert abs(found.time - truth.time) <= 1e-13 * (step + scale / max(speed, 1e-300))
    assert doubts < 0.5 * cases
    assert landings > 0.1 * cases


# The odd derivatives are zero or nearly so, and one of the two last terms with them.
def test_a_turning_point_is_no_reason_to_accept_a_long_step() -> None:
    rng, work = np.random.default_rng(5), np.empty((WORK_ROWS, TERMS))
    cases = [*TURNING_POINTS] + [
        (spread(rng, 1e-3, 1.5), rng.normal() * spread(rng, 1e-3, 30.0), spread(rng, 1e-10, 2.0))
        for _ in range(inner_sample_size(4_000, 300))
    ]
    accepted = refused = 0
    for alpha, shaking, angle in cases:
        for velocity in (0.0, 1e-10, -1e-7):
            drive = Drive(alpha, shaking, rng.choice([0.0, 1e-6]), 0.0, 0.0, 0.0, 0.0)
            at, step = Instant(0.0, angle, velocity, 0.0, 1.0, FALSE), spread(rng, 1e-3, 1.0)
            driven = StepDrive(alpha, shaking, drive.slope, 1.0, 0.0)
            course, enough = middle_step(driven, at, step, 1e-15)
            refused += not enough
            if not enough:
                continue
            accepted += 1
            degree, _ = expand_series(drive, at, step, 1e-30, work)
            powers = step ** np.arange(TERMS)
            rest = np.where(np.arange(TERMS) <= degree, work[ANGLE], 0.0) * powers
            # The first ones are those of both, but for rounding.
            rest[:9] = 0.0
            rest[9:11] -= np.array(course[-2:]) * powers[9:11]
            moved = max(angle, abs(velocity) * step, step * step * abs(course.second))
            assert abs(rest.sum()) <= 2e-15 * max(moved, step**3 * abs(course.third))
    assert min(accepted, refused) > 0.2 * (accepted + refused)


@every("seed", range(30))
def test_bounds_hold_and_state_and_rows_are_one_polynomial(seed: int) -> None:
    rng, work = np.random.default_rng(300 + seed), np.zeros((WORK_ROWS, TERMS))
    drive, angle, velocity = drawn(rng)
    h = spread(rng, 1e-4, 0.25)
    driven = StepDrive(drive.alpha, drive.constant, drive.slope, 1.0 + drive.lift, drive.lift_slope)
    at = Instant(0.0, angle, velocity, 0.0, 1.0, FALSE)
    course, _ = middle_step(driven, at, h, 1e-15)
    fill_course(course, angle, velocity, work)
    curve = np.polynomial.Polynomial(work[ANGLE, : DEGREE + 1])
    times = np.linspace(0.0, h, 200)
    for order, bound in zip((3, 4), bounds_over(course, h), strict=True):
        assert np.abs(curve.deriv(order)(times)).max() <= bound * (1.0 + 1e-14)
    part = float(rng.uniform(0.0, h))
    y, v = state_after(course, angle, velocity, part)
    for found, exact in ((y, curve), (v, curve.deriv())):
        size = np.polynomial.Polynomial(np.abs(exact.coef))(part)
        assert math.isclose(found, exact(part), rel_tol=0.0, abs_tol=2e-15 * size)


def cubic_over(span: float, speeds: tuple[float, float, float]) -> tuple[Stretch, float, float]:
    """Return a flight of degree 3 by its speeds at start, middle and end, its top and its speed."""
    first, middle, last = speeds
    slope = np.polynomial.Polynomial(
        [first, 4.0 * middle - 3.0 * first - last, 2.0 * (first + last - 2.0 * middle)]
    )
    angle = 1.0 + slope.integ()
    bend, third = slope.deriv()(0.0) / span, 2.0 * abs(slope.coef[2]) / span**2
    heights, rates = 1.0 + span * (angle - 1.0)(TIMES), np.abs(slope(TIMES))
    stretch = Stretch(1.0, first, heights[-1], last, bend, third, span)
    return stretch, float(heights.max()), float(rates.max())


TIMES = np.linspace(0.0, 1.0, 4001)


def test_no_peak_within_a_step_surpasses_its_bounds() -> None:
    rng = np.random.default_rng(8)
    inside = np.zeros(2, dtype=np.int64)
    for _ in range(sample_size(3000, 600)):
        speeds = rng.normal(size=3) * spread(rng, 1e-3, 1.0) + rng.choice([0.0, 1.0])
        stretch, top, swift = cubic_over(spread(rng, 1e-4, 0.25), tuple(speeds.tolist()))
        fastest, highest = most_over(stretch)
        assert fastest >= swift * (1.0 - 1e-15)
        assert highest >= top * (1.0 - 1e-15)
        inside += (
            swift > max(abs(stretch.velocity), abs(stretch.later_velocity)),
            top > max(stretch.angle, stretch.later_angle),
        )
    assert inside.min() > sample_size(300, 60)


def test_bounds_of_a_step_are_reached_and_are_its_ends_where_nothing_turns() -> None:
    h = 0.125
    # A top halfway, of a parabola; a speed that is largest halfway.
    stretch, top, _ = cubic_over(h, (0.5, 0.0, -0.5))
    assert most_over(stretch)[1] == pytest.approx(top, rel=1e-15)
    assert top - 1.0 == pytest.approx(0.5 * h / 4.0)
    stretch, _, swift = cubic_over(h, (0.25, 1.0, 0.25))
    assert most_over(stretch)[0] == pytest.approx(swift, rel=1e-15)
    # y' keeps away from 0, y'' too; then y' dips below 0 between ends above it.
    stretch, _, _ = cubic_over(h, (0.5, 0.75, 1.0))
    assert most_over(stretch) == (1.0, stretch.later_angle)
    stretch, top, _ = cubic_over(h, (0.25, -1.0, 0.25))
    assert top > max(1.0, stretch.later_angle)
    assert most_over(stretch)[1] >= top


def test_bends_are_the_derivatives_of_the_polynomial() -> None:
    """The second derivative has all terms, the next ones those up to the seventh and sixth."""
    rng = np.random.default_rng(61)
    wrong = []
    for case in range(60):
        for order, degree in ((2, DEGREE), (3, 7), (4, 7), (5, 6)):
            terms = np.zeros(DEGREE + 1)
            terms[2 : degree + 1] = rng.normal(size=degree - 1)
            if case < DEGREE - 1:  # each term alone
                terms[[n for n in range(2, DEGREE + 1) if n != case + 2]] = 0.0
            time = float(rng.uniform(0.3, 1.5))
            found = bends_after(Course(*terms[2:].tolist()), time)[order - 2]
            curve = np.polynomial.Polynomial(terms).deriv(order)
            size = np.polynomial.Polynomial(np.abs(curve.coef))(time)
            if abs(found - curve(time)) > 4e-15 * size:
                wrong.append((case, order, found, curve(time)))
    assert not wrong, wrong


def test_bounds_are_those_of_each_term_alone() -> None:
    rng, time = np.random.default_rng(62), 0.7
    for n in range(3, DEGREE + 1):
        terms = np.zeros(DEGREE + 1)
        terms[n] = rng.normal()
        curve = np.polynomial.Polynomial(np.abs(terms))
        third, fourths = bounds_over(Course(*terms[2:].tolist()), time)
        most = curve.deriv(3)(0.0) + time * curve.deriv(4)(time)  # by the mean value theorem
        assert curve.deriv(3)(time) * (1.0 - 1e-14) <= third <= most * (1.0 + 1e-14)
        assert fourths == pytest.approx(curve.deriv(4)(time) if n > 3 else 0.0, rel=1e-14)


def test_a_step_to_a_landing_ends_soon_after_it_or_with_the_span() -> None:
    # y = y0 + v t + a t^2 comes down where a t^2 + v t + y0 = 0.
    for angle, velocity, second in (
        (0.5, 0.3, -2.0),
        (0.0, 0.3, -2.0),
        (0.5, -1.0, 0.1),
        (0.2, 0.0, -1.0),
    ):
        roots = np.roots([second, velocity, angle]).real
        down = min(root for root in roots if root > 1e-12)
        step = landing_step(angle, velocity, second, 100.0)
        assert down < step < 1.5 * down
        assert landing_step(angle, velocity, second, 0.5 * down) == 0.5 * down
