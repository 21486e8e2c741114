"""Stability of steady states: multipliers, what simulations do, and one whole period."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rocksteady import DimensionlessBlock, Harmonic, State, Steady, simulate
from rocksteady.errors import InputError
from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_steady_orbit
from tests.dynamics.formulae import (
    printed_trace,
)
from tests.dynamics.points import checked, orders, points, states_at
from tests.every import every
from tests.strategies import logarithmic

# ------------------------------------------------------------------------------- stability


def half_cycle_map(a: float, w: float, r: float, phase: float, velocity: float, n: int) -> Any:
    """Phase and du/ds after the next impact, seen from the other side, by a simulation."""
    run = simulate(
        DimensionlessBlock(restitution=r),
        Harmonic(amplitude=a, frequency_ratio=w, phase=phase),
        start=State(angle=0.0, velocity=velocity),
        cycles=n,
    )
    s, after = run.impacts.pt[0], run.impacts.velocity_after[0]
    return np.array([phase + w * s - n * math.pi, -after])


@every(
    ("point", "branch"),
    [
        ((2.0, 4.0, 0.8, 1), 1),
        ((2.0, 2.0, 0.8, 1), 1),
        ((2.0, 6.0, 0.8, 3), 1),
        ((4.0, 6.0, 0.8, 3), 1),
        ((1.0, 2.0, 0.5, 1), 1),
        ((0.75, 4.0, 0.5, 1), 1),
        ((3.0, 8.0, 0.95, 3), 1),
        ((3.0, 4.0, 1.0, 1), 1),
        ((1.0, 2.0, 0.8, 1), 2),
        ((1.0, 8.0, 0.8, 1), 2),
        ((2.0, 5.0, 0.8, 3), 2),
    ],
)
def test_multipliers_are_those_of_the_differentiated_half_cycle(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    states = states_at(point)
    assert checked(states.admissible)[branch - 1]
    phase, velocity = float(states.phase[branch - 1]), float(states.velocity[branch - 1])
    # It is a fixed point of the map ...
    np.testing.assert_allclose(
        half_cycle_map(a, w, r, phase, velocity, n), [phase, velocity], rtol=1e-12
    )
    # ... whose derivative has these eigenvalues.
    h = 3e-6
    columns = [
        (
            half_cycle_map(a, w, r, phase + h * x, velocity * (1.0 + h * y), n)
            - half_cycle_map(a, w, r, phase - h * x, velocity * (1.0 - h * y), n)
        )
        / (2.0 * h * (x + y * velocity))
        for x, y in ((1.0, 0.0), (0.0, 1.0))
    ]
    eigenvalues = np.linalg.eigvals(np.array(columns).T)
    eigenvalues = eigenvalues[np.lexsort((-eigenvalues.imag, -np.abs(eigenvalues).round(6)))]
    np.testing.assert_allclose(
        states.half_cycle_multipliers[branch - 1], eigenvalues, rtol=1e-6, atol=1e-7
    )


@given(points)
def test_multipliers_solve_their_quadratic_and_decide_stability(
    point: tuple[float, float, float, int],
) -> None:
    a, w, r, n = point
    assume(n * math.pi / w < 100.0)
    states = states_at(point)
    assume(states.region != 4)
    for which in (0, 1):
        first, second = states.half_cycle_multipliers[which]
        assert first * second == pytest.approx(r * r, rel=1e-12)
        assert first + second == pytest.approx(states.trace[which], rel=1e-12, abs=1e-14)
        assert abs(first) >= abs(second) * (1.0 - 1e-15)
        assert first.imag >= 0.0
        inside = abs(first) < 1.0
        if abs(abs(first) - 1.0) > 1e-9:
            stable = bool(inside and checked(states.admissible)[which])
            assert bool(states.stable[which]) is stable
        # TW5, where its difference keeps its digits
        sine = math.sin(states.phase[which])
        direct = printed_trace(a, w, r, n, sine, states.velocity_tau[which])
        assert states.trace[which] == pytest.approx(
            direct,
            abs=1e-9 * math.cosh(n * math.pi / w) * (1.0 + 1.0 / abs(states.velocity_tau[which])),
        )


@given(logarithmic(0.05, 12.0), logarithmic(0.3, 50.0), orders)
def test_restitution_1_makes_neutral_orbits_and_never_stable_ones(
    a: float, w: float, n: int
) -> None:
    states = steady_states(a, w, 1.0, order=n)
    assert states.region in (1, 2)
    assert not states.stable.any()
    for which in (0, 1):
        elliptic = abs(states.trace[which]) < 2.0 and checked(states.admissible)[which]
        assert bool(states.neutral[which]) is bool(elliptic)
        if elliptic:
            np.testing.assert_allclose(
                np.abs(states.half_cycle_multipliers[which]), 1.0, rtol=1e-14
            )
    # Branch 1 is exactly out of phase, branch 2 exactly in phase.
    assert states.phase.tolist() == [math.pi, 0.0]


def test_a_stable_orbit_is_no_neutral_one() -> None:
    states = steady_states(2.0, 4.0, 0.8)
    assert states.stable[0]
    assert not states.neutral.any()


def test_at_the_existence_boundary_the_two_branches_meet_with_a_multiplier_of_1() -> None:
    existence = float(steady_states(2.0, 4.0, 0.8).existence)
    states = steady_states(existence * (1.0 + 1e-12), 4.0, 0.8)
    assert states.phase[0] == pytest.approx(states.phase[1], abs=1e-5)
    np.testing.assert_allclose(states.trace, 1.64, atol=1e-4)


# ------------------------------------------------------------------------- one whole period


@given(points, st.sampled_from([1, 2]))
@settings(max_examples=50)
def test_an_orbit_closes_mirrors_itself_and_obeys_equation_4(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    assume(n * math.pi / w < 15.0)
    states = states_at(point)
    assume(states.region != 4)
    samples = 4001
    orbit = compute_steady_orbit(a, w, r, order=n, branch=branch, samples=samples)
    assert orbit.tau.shape == orbit.angle.shape == orbit.velocity.shape == (samples,)
    assert orbit.tau[[0, -1]] == pytest.approx([0.0, 2.0 * n * math.pi])
    half = samples // 2
    scale = np.abs(orbit.angle).max() + a / (1.0 + w * w)
    assert np.abs(orbit.angle[[0, half, -1]]).max() < 1e-11 * (1.0 + scale)
    np.testing.assert_array_equal(orbit.angle[half + 1 :], -orbit.angle[1 : half + 1])
    np.testing.assert_array_equal(orbit.velocity[half + 1 :], -orbit.velocity[1 : half + 1])
    assert orbit.velocity[0] == pytest.approx(states.velocity[branch - 1], rel=1e-9, abs=1e-14)
    # after the impact at the end of the half cycle the velocity is the first one mirrored (eq 9)
    assert r * orbit.velocity[half] == pytest.approx(
        -orbit.velocity[0], rel=1e-9, abs=1e-12 * (1.0 + scale)
    )
    # eqs 4 and 5 by differences: Omega^2 u'' = u - sign + a(tau)
    step = orbit.tau[1]
    u = orbit.angle[: half + 1]
    second = (u[2:] - 2.0 * u[1:-1] + u[:-2]) / step**2
    base = a * np.sin(orbit.tau[1:half] + states.phase[branch - 1])
    np.testing.assert_allclose(orbit.excitation[1:half], base, atol=1e-12 * (1.0 + a))
    error = np.abs(w * w * second - (u[1:-1] - 1.0 + base))
    fourth = 1.0 + a + np.abs(u).max() + a * w * w  # bound of d4u/ds4
    bound = fourth * (step / w) ** 2 / 10.0 + 1e-13 * (1.0 + scale) * (w / step) ** 2
    assert error.max() <= bound
    # and the velocity is the angle's derivative
    slope = (u[2:] - u[:-2]) / (2.0 * step)
    third = (np.abs(orbit.velocity).max() + a * w) / w**3
    np.testing.assert_allclose(
        orbit.velocity_tau[1:half], slope, atol=third * step**2 + 1e-12 * (1.0 + scale) / step
    )


def test_an_orbit_where_none_exists_is_refused_with_the_least_amplitude() -> None:
    with pytest.raises(InputError, match=r"^amplitude = 0\.2 .*0\.260201"):
        compute_steady_orbit(0.2, 4.0, 0.8)


@every("branch", [0, 3, -1])
def test_an_orbit_of_a_third_branch_is_refused(branch: int) -> None:
    with pytest.raises(InputError, match="two branches"):
        compute_steady_orbit(2.0, 4.0, 0.8, branch=branch)


@every("samples", [2, 4, 1, 0, -5])
def test_samples_of_an_orbit_must_be_odd_and_three_at_least(samples: int) -> None:
    with pytest.raises(InputError, match=r"^samples = "):
        compute_steady_orbit(2.0, 4.0, 0.8, samples=samples)


# --------------------------------------------------------------------------- in a simulation


@every(
    "point",
    [
        (2.0, 4.0, 0.8, 1),
        (2.0, 6.0, 0.8, 3),
        (3.0, 8.0, 0.95, 3),
        (1.0, 2.0, 0.5, 1),
        (0.75, 4.0, 0.5, 1),
        (1.7, 6.0, 0.8, 3),
    ],
)
def test_a_stable_steady_state_is_kept(point: tuple[float, float, float, int]) -> None:
    a, w, r, n = point
    states = states_at(point)
    run = simulate(
        DimensionlessBlock(restitution=r),
        Harmonic(amplitude=a, frequency_ratio=w),
        start=Steady(order=n),
        cycles=60 * n + 0.25,
    )
    assert run.status.label == "rocking"
    assert len(run.impacts) == 120
    assert run.peak == pytest.approx(checked(states.peak)[0], abs=1e-12)
    np.testing.assert_allclose(run.impacts.pt, np.arange(1, 121) * n * math.pi / w, rtol=1e-12)
    np.testing.assert_allclose(np.abs(run.impacts.velocity_after), states.velocity[0], rtol=1e-11)


@every(
    ("point", "branch"),
    [((1.0, 1.0, 0.8, 1), 2), ((1.0, 2.0, 0.8, 1), 2), ((2.0, 5.0, 0.8, 3), 2)],
)
def test_an_unstable_steady_state_is_left_on_the_named_side(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    states = states_at(point)
    velocity = float(states.velocity[branch - 1])
    growth = float(abs(states.half_cycle_multipliers[branch - 1, 0]))
    runs = {}
    for side in (1, -1):
        runs[side] = simulate(
            DimensionlessBlock(restitution=r),
            Harmonic(amplitude=a, frequency_ratio=w),
            start=Steady(branch=branch, order=n, side=side),
            cycles=40 * n,
        )
        departure = np.abs(runs[side].impacts.velocity_after) - velocity
        # the first few half cycles multiply the distance by the multiplier ...
        assert abs(departure[2] / departure[1]) == pytest.approx(growth, rel=1e-2)
        # ... and it begins on its side, with more velocity or less
        begin = runs[side](0.0)
        assert math.copysign(1.0, float(begin.velocity) - velocity) == side
        # along the unstable direction: from the very first half cycle on it only grows
        first_step = departure[0] / (float(begin.velocity) - velocity)
        assert abs(first_step) == pytest.approx(growth, rel=1e-2)
        # in the end it is far away
        assert abs(departure[:40]).max() > 0.1 * velocity
    first, second = (runs[side].impacts.velocity_after for side in (1, -1))
    assert abs(abs(first[3]) - abs(second[3])) > 1e-4 * velocity
    assert len(first) != len(second) or not np.allclose(first, second)


def test_leaving_along_the_unstable_direction_is_symmetric_to_first_order() -> None:
    states = steady_states(1.0, 2.0, 0.8)
    velocity = states.velocity[1]
    departures = [
        np.abs(
            simulate(
                DimensionlessBlock(restitution=0.8),
                Harmonic(amplitude=1.0, frequency_ratio=2.0),
                start=Steady(branch=2, side=side),
                cycles=2,
            ).impacts.velocity_after[:3]
        )
        - velocity
        for side in (1, -1)
    ]
    np.testing.assert_allclose(departures[0], -departures[1], rtol=0.01)
