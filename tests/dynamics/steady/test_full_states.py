"""Steady states of the full equations beside shots of their half cycle by DOP853."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Steady,
    compute_response_curve,
    find_attractor,
    find_orbits,
    find_steady_states,
    map_attractors,
    simulate,
)
from rocksteady.dynamics.steady.states import full_states, orbit_of
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from tests.every import every

Floats = NDArray[np.float64]


class Case(NamedTuple):
    """A block, its shaking, and how many of its two states are motions."""

    alpha: float
    a: float
    w: float
    delta: float
    n: int
    motions: int

    @property
    def half(self) -> float:
        return self.n * math.pi / self.w

    def shots(self, phase: float, speed: float, times: Floats, rtol: float = 1e-13) -> Floats:
        """Angles and velocities at pivot times after an impact, as if there were no floor.

        In theta and in the units of the equations: uplift where a/g is tan(alpha).
        """

        def equation(s: float, y: Floats) -> list[float]:
            tilt = self.alpha - y[0]
            base = self.a * self.alpha * math.sin(self.w * s + phase)
            return [y[1], -math.sin(tilt) + base * math.cos(tilt)]

        run = solve_ivp(
            equation,
            (0.0, float(times[-1])),
            [0.0, self.alpha * speed],
            method="DOP853",
            t_eval=times,
            rtol=rtol,
            atol=1e-15,
        )
        return np.array(run.y / self.alpha)

    def shot(self, phase: float, speed: float, span: float, rtol: float = 1e-13) -> Floats:
        """Angle and velocity a pivot time after an impact."""
        return self.shots(phase, speed, np.array([span]), rtol)[:, 0]

    def miss(self, state: Floats) -> list[float]:
        """What a state fails to be a steady state by."""
        angle, velocity = self.shot(float(state[0]), float(state[1]), self.half)
        return [angle, state[1] + self.delta * velocity]

    def image(self, phase: float, speed: float) -> Floats:
        """Phase and speed after the impact that ends the half cycle, near its own end."""
        span = self.half
        for _ in range(4):
            angle, velocity = self.shot(phase, speed, span)
            span -= angle / velocity
        _, velocity = self.shot(phase, speed, span)
        return np.array([phase + self.w * span - self.n * math.pi, -self.delta * velocity])


CASES = [
    Case(0.05, 2.0, 4.0, 0.8, 1, 1),
    Case(0.1, 1.0, 2.0, 0.5, 1, 2),
    Case(0.2, 2.0, 1.9, 0.8, 1, 1),  # branch 1 unstable
    Case(0.3, 2.0, 4.0, 0.8, 3, 2),
    Case(0.3, 1.0, 4.0, 1.0, 1, 2),  # no loss
    Case(0.35, 0.8, 1.2, 0.7, 1, 2),
    Case(0.4, 1.0, 2.0, 0.8, 1, 2),
    Case(0.45, 4.0, 6.0, 0.9, 3, 2),
    Case(0.5, 0.6, 3.0, 0.6, 1, 2),
    Case(0.55, 1.5, 5.0, 0.95, 3, 2),
    Case(0.6, 2.0, 4.0, 0.9, 1, 1),
    Case(0.6, 2.0, 8.0, 0.5, 1, 1),
    Case(0.6, 1.3, 2.0, 1.0, 1, 2),
    Case(0.5, 0.2556, 2.0, 0.8, 1, 2),  # 0.1 % above its fold
    Case(0.6, 1.2105, 4.0, 0.5, 1, 2),
]
cases = every("case", CASES)


@cases
def test_both_states_are_where_shots_close(case: Case) -> None:
    states, _ = full_states(case.a, case.w, case.delta, case.alpha, order=case.n)
    assert states.admissible is not None
    assert states.peak is not None
    assert states.extrema is not None
    assert int(states.admissible.sum()) == case.motions
    for which in (0, 1):
        found = np.array([states.phase[which], states.velocity[which]])
        shot = root(case.miss, found * 1.0001 + 1e-5, tol=1e-13).x
        np.testing.assert_allclose(found, shot, rtol=1e-8, atol=1e-9)
        times = np.linspace(0.0, case.half, 401)[1:-1]
        course = case.shots(float(found[0]), float(found[1]), times)[0]
        assert (course.min() > 0.0) == bool(states.admissible[which])
        inner = course if found[1] > 0.0 else -course
        assert abs(states.peak[which]) == pytest.approx(inner.max(), rel=2e-4)


@cases
def test_the_derivative_of_the_half_cycle_is_that_of_shots(case: Case) -> None:
    states, jacobian = full_states(case.a, case.w, case.delta, case.alpha, order=case.n)
    for which in (0, 1):
        found = np.array([states.phase[which], states.velocity[which]])
        columns = [
            (case.image(*(found + step)) - case.image(*(found - step))) / 4e-6
            for step in (np.array([2e-6, 0.0]), np.array([0.0, 2e-6]))
        ]
        derivative = np.array(columns).T
        size = np.abs(derivative).max()
        assert float(states.trace[which]) == pytest.approx(np.trace(derivative), abs=1e-5 * size)
        assert np.linalg.det(derivative) == pytest.approx(case.delta**2, abs=1e-5 * size**2)
        mine = jacobian[:, which].reshape(2, 2)
        np.testing.assert_allclose(
            mine / np.abs(mine).max(), derivative / size, rtol=0.0, atol=1e-5
        )
        pair = np.linalg.eigvals(derivative)
        pair = pair[np.argsort(-np.abs(pair), kind="stable")]
        squares = states.multipliers[which]
        assert squares[0].real == pytest.approx((pair[0] ** 2).real, abs=3e-5 * size**2)


def count_of_shots(case: Case) -> int:
    """How many phases have a flight that closes, from 30 phases and their flights."""

    def gap(phase: float) -> float:
        def end(speed: float) -> float:
            return float(case.shot(phase, speed, case.half, 1e-10)[0])

        speed = float(brentq(end, -3.0, 3.0, xtol=1e-12))
        return speed + case.delta * float(case.shot(phase, speed, case.half, 1e-10)[1])

    gaps = [gap(phase) for phase in np.linspace(0.1, 0.1 + 2.0 * math.pi, 31)]
    return int((np.diff(np.sign(gaps)) != 0.0).sum())


@every(
    "case",
    [
        Case(0.3, 2.0, 4.0, 0.8, 1, 2),
        Case(0.5, 0.27, 2.0, 0.8, 1, 2),
        Case(0.5, 0.25, 2.0, 0.8, 1, 0),  # the closed form has two
        Case(0.6, 0.5, 8.0, 0.6, 1, 0),
        Case(0.6, 4.5, 6.0, 0.8, 3, 2),
        Case(0.6, 2.5, 6.0, 0.7, 3, 0),
        Case(0.6, 1.3, 2.0, 1.0, 1, 2),
    ],
)
def test_there_are_as_many_states_as_a_search_over_all_phases_finds(case: Case) -> None:
    states, _ = full_states(case.a, case.w, case.delta, case.alpha, order=case.n)
    there = int(np.isfinite(states.phase).sum())
    assert there == count_of_shots(case) == case.motions


def test_near_a_fold_both_states_come_together_at_one_amplitude() -> None:
    # The amplitude of the fold by halving; beside it the states lie as far apart as its root.
    def pair(a: float) -> Floats:
        states, _ = full_states(a, 2.0, 0.8, 0.5)
        return states.phase

    none, both = 0.2, 0.4
    while both - none > 1e-12:
        middle = 0.5 * (none + both)
        none, both = (none, middle) if np.isfinite(pair(middle)).all() else (middle, both)
    apart = [float(np.subtract(*pair(both * (1.0 + part)))) for part in (1e-8, 1e-6, 1e-4)]
    np.testing.assert_allclose(np.array(apart[1:]) / apart[:-1], 10.0, rtol=0.01)
    closed = float(steady_states(1.0, 2.0, 0.8).existence)
    assert both > 1.02 * closed


@every(
    ("a", "w", "delta", "n"),
    [(2.0, 4.0, 0.8, 1), (1.0, 2.0, 0.5, 1), (2.0, 6.0, 0.8, 3), (2.0, 4.0, 1.0, 1)],
)
def test_they_go_to_the_closed_form_with_the_square_of_the_slenderness(
    a: float, w: float, delta: float, n: int
) -> None:
    closed = steady_states(a, w, delta, order=n)
    slender = full_states(a, w, delta, 1e-6, order=n)[0]
    errors = []
    for alpha in (0.02, 0.04):
        states, _ = full_states(a, w, delta, alpha, order=n)
        errors.append(
            [getattr(states, name) - getattr(closed, name) for name in ("velocity", "peak")]
        )
    np.testing.assert_allclose(np.array(errors[1]) / errors[0], 4.0, rtol=0.02)
    for name in ("velocity", "peak", "trace"):
        np.testing.assert_allclose(
            getattr(slender, name), getattr(closed, name), rtol=1e-9, atol=1e-11
        )
    np.testing.assert_allclose(np.exp(1j * slender.phase), np.exp(1j * closed.phase), atol=1e-10)
    np.testing.assert_array_equal(slender.admissible, closed.admissible)
    np.testing.assert_array_equal(slender.extrema, closed.extrema)


@every(("alpha", "peak"), [(0.05, 0.185377), (0.1, 0.185013), (0.2, 0.183552), (0.3, 0.181107)])
def test_published_peaks(alpha: float, peak: float) -> None:
    states, _ = full_states(2.0, 4.0, 0.8, alpha)
    assert states.peak is not None
    assert float(states.peak[0]) == pytest.approx(peak, abs=1.1e-6)


def test_a_point_alone_has_the_bits_that_it_has_among_others() -> None:
    rng = np.random.default_rng(89)
    given = (
        rng.uniform(0.3, 4.0, 40),
        np.geomspace(0.3, 20.0, 40),
        rng.uniform(0.5, 1.0, 40),
        rng.uniform(0.05, 0.6, 40),
    )
    order = rng.choice([1, 3], 40)
    together, jacobian = full_states(*given, order=order)
    for k in range(0, 40, 3):
        alone, row = full_states(*(x[k] for x in given), order=order[k])
        for name in ("phase", "velocity", "trace", "peak", "extrema", "admissible"):
            np.testing.assert_array_equal(getattr(together, name)[:, k], getattr(alone, name))
        np.testing.assert_array_equal(jacobian[..., k], row)


@every(
    ("alpha", "a", "w", "delta", "n", "branch"),
    [
        (0.3, 2.0, 4.0, 0.8, 1, 1),
        (0.6, 2.0, 4.0, 0.9, 1, 1),
        (0.3, 2.0, 4.0, 0.8, 3, 2),
        (0.4, 1.0, 2.0, 0.8, 1, 2),
        (0.3, 1.0, 4.0, 1.0, 1, 1),
    ],
)
def test_runs_orbits_and_maps_begin_on_the_state_itself(
    alpha: float, a: float, w: float, delta: float, n: int, branch: int
) -> None:
    block = Block.from_p(alpha=alpha, p=1.7, restitution=delta)
    motion = Harmonic(amplitude=a, frequency_ratio=w)
    states = find_steady_states(block, motion, order=n)
    phase, velocity = float(states.phase[branch - 1]), float(states.velocity[branch - 1])
    stable = bool(states.stable[branch - 1] or states.neutral[branch - 1])
    # A kick of 1e-300 along the unstable direction is less than a rounding.
    run = simulate(
        block,
        motion,
        start=Steady(branch=branch, order=n, kick=1e-300),
        cycles=n,
        model="nonlinear",
    )
    assert isinstance(run.motion, Harmonic)
    assert (run.motion.phase, float(run(0.0).velocity)) == (phase, velocity)
    orbits = find_orbits(block, motion, max_period=n, seeds=1, model="nonlinear")
    (orbit,) = (each for each in orbits if (each.branch, each.period) == (branch, n))
    assert orbit.start.speed == velocity
    assert orbit.start.phase == pytest.approx(phase % (2.0 * math.pi), rel=1e-15)
    assert states.peak is not None
    assert orbit.highest == float(states.peak[branch - 1])
    assert orbit.stable == bool(states.stable[branch - 1])
    drawn = orbit_of(states, branch)
    assert drawn.angle.max() == pytest.approx(orbit.highest, rel=1e-4)
    assert drawn.verdict == ("stable" if orbit.stable else "neutral" if stable else "unstable")
    if stable and delta < 1.0:
        axes = {"amplitude": [a], "frequency_ratio": [w]}
        start = Steady(branch=branch, order=n)
        cell = map_attractors(block, axes=axes, start=start, model="nonlinear")
        alone = find_attractor(block, motion, start=start, model="nonlinear")
        assert float(cell.highest[0, 0]) == pytest.approx(alone.orbit.highest, rel=1e-12)  # type: ignore[union-attr]
        assert alone.orbit.highest == pytest.approx(orbit.highest, rel=1e-12)  # type: ignore[union-attr]


@every(
    ("alpha", "a", "w", "delta", "n", "branch"),
    [
        (0.4214, 1.249, 2.31, 0.4947, 1, 2),
        (0.5744, 1.378, 10.53, 0.4919, 1, 2),
        (0.374, 2.959, 2.83, 0.766, 3, 2),
        (0.585, 7.367, 3.4, 0.714, 3, 1),
    ],
)
def test_a_motion_that_the_closed_form_has_not_can_be_started_on(
    alpha: float, a: float, w: float, delta: float, n: int, branch: int
) -> None:
    block = Block.from_p(alpha=alpha, p=2.0, restitution=delta)
    motion = Harmonic(amplitude=a, frequency_ratio=w)
    states = find_steady_states(block, motion, order=n)
    assert states.closed_form is not None
    assert states.closed_form.admissible is not None
    assert not states.closed_form.admissible[branch - 1]
    start = Steady(branch=branch, order=n, kick=1e-300)
    run = simulate(block, motion, start=start, cycles=0.6 * n, model="nonlinear")
    assert float(run.impacts.pt[0]) == pytest.approx(n * math.pi / w, abs=1e-9)
    after = -float(run.impacts.velocity_after[0])
    assert after == pytest.approx(float(states.velocity[branch - 1]), rel=1e-8)


def test_a_curve_is_that_of_its_points() -> None:
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    curve = compute_response_curve(block, 1.0, frequency_ratio=[1.5, 2.0, 6.0], branch=2)
    for k, w in enumerate((1.5, 2.0, 6.0)):
        states = find_steady_states(block, Harmonic(amplitude=1.0, frequency_ratio=w))
        assert states.admissible is not None
        assert states.peak is not None
        expected = float(states.peak[1]) if states.admissible[1] else math.nan
        np.testing.assert_equal(float(curve.peak[k]), expected)


def test_a_bare_block_keeps_the_closed_form_and_has_no_other() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    bare = DimensionlessBlock(restitution=0.8)
    states = find_steady_states(bare, motion)
    assert (states.model.name, states.closed_form) == ("linear", None)
    assert states.to_dict() == find_steady_states(bare, motion, model="linear").to_dict()
    with pytest.raises(ModelError, match="slenderness"):
        find_steady_states(bare, motion, model="nonlinear")


@every("amplitude", [0.0, 1e-320, 1e50])
def test_extreme_amplitudes_have_no_state_and_raise_no_warning(amplitude: float) -> None:
    block = Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
    states = find_steady_states(block, Harmonic(amplitude=amplitude, frequency_ratio=4.0))
    assert states.to_dict()["solutions"] == []
    assert "have none" in states.summary()


@every(("w", "n"), [(0.01, 3), (0.05, 1), (300.0, 1), (9000.0, 5)])
def test_slow_and_fast_shaking(w: float, n: int) -> None:
    states, _ = full_states(2.0, w, 0.8, 0.2, order=n)
    closed = steady_states(2.0, w, 0.8, order=n)
    np.testing.assert_allclose(states.velocity, closed.velocity, rtol=0.1)
