"""Steps of degree 10 against the long series, and landings in them against its search."""

import math

import numpy as np

from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.core.typed import FALSE
from rocksteady.kernels.linear.short import DOUBT, LANDS
from rocksteady.kernels.nonlinear._landing_step import first_landing
from rocksteady.kernels.nonlinear._middle import (
    DEGREE,
    bounds_over,
    fill_course,
    middle_step,
    state_after,
)
from rocksteady.kernels.nonlinear._short import StepDrive
from rocksteady.kernels.nonlinear.drive import Drive, Instant, SteppedFlight
from rocksteady.kernels.nonlinear.flight import fly
from rocksteady.kernels.nonlinear.series import (
    ANGLE,
    TERMS,
    WORK_ROWS,
    angle_at,
    expand_series,
)
from tests.every import every
from tests.kernels.nonlinear.test_short import TURNING_POINTS, drawn, spread
from tests.strategies import sample_size


def test_what_a_step_leaves_out_is_as_little_as_it_may() -> None:
    rng, work = np.random.default_rng(3), np.empty((WORK_ROWS, TERMS))
    exact = most = 0
    for _ in range(sample_size(20_000, 1_000)):
        alpha, step = 10.0 ** rng.uniform(-2.0, 0.0), 10.0 ** rng.uniform(-2.0, -0.3)
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
    assert exact > sample_size(10_000, 500)
    assert most < 1e-3 * exact


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
        for _ in range(sample_size(4_000, 300))
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
