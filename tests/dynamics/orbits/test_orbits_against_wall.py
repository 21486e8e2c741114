"""Orbits and attractors of a block against a wall: closed forms, an integrator, refusals."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Steady,
    compute_response_curve,
    find_attractor,
    find_bifurcations,
    find_orbits,
    simulate,
)
from rocksteady.branches import follow_branch
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import ModelName
from rocksteady.orbits import Orbit, find_attractors, sweep_attractor
from rocksteady.outcomes import AttractorKind
from tests.every import every

FACADE = Block.rectangle(width=0.3, height=3.0).against_wall(0.05)


class OneImpact(NamedTuple):
    """An orbit with one impact in a number of periods."""

    phase: float
    speed: float
    peak: float
    trace: float


def against_wall(e: float) -> DimensionlessBlock:
    return DimensionlessBlock(restitution=e, one_sided=True)


def closed_forms(a: float, w: float, e: float, periods: int) -> Iterator[OneImpact]:
    """Yield the orbits of y'' = y - 1 + A sin(w s + phi) from y(0) = 0 = y(T), v(0) = -e v(T)."""
    span = 2.0 * math.pi * periods / w
    half, b = math.tanh(0.5 * span), a / (1.0 + w * w)
    # v(0) = -b w cos(phi) - D half and v(T) = -b w cos(phi) + D half with D = b sin(phi) - 1.
    p, q = (1.0 - e) * half * b, (1.0 + e) * b * w
    size = math.hypot(p, q)
    if size < (1.0 - e) * half:
        return
    turn = math.asin((1.0 - e) * half / size)
    for angle in (turn, math.pi - turn):
        phi = (angle - math.atan2(q, p)) % (2.0 * math.pi)
        d, grown = b * math.sin(phi) - 1.0, math.exp(span)
        speed = -b * w * math.cos(phi) - d * half
        s = np.linspace(0.0, span, 4001)
        course = 1.0 - b * np.sin(w * s + phi)
        course += d / (1.0 + grown) * (np.exp(s) + grown * np.exp(-s))
        lands = -b * w * math.cos(phi) + d * half
        if speed < -1e-12 or lands >= 0.0 or (course[1:-1] <= 0.0).any():
            continue  # it passes through the wall
        # Of (phi, v) -> (phi', v') the determinant is e^2; the trace is that of the linearised
        # flight, whose landing time shifts with what it starts from.
        start = a * math.sin(phi) - 1.0  # y'' at both ends
        cosh, sinh = math.cosh(span), math.sinh(span)
        # y(T) moves by -(cosh v(0) + sinh y'') when the start comes later by 1, and by sinh when
        # v(0) grows by 1, v(T) by cosh then; the landing waits for -dy/v(T), in which y'' acts.
        later = (cosh * speed + sinh * start) / lands
        trace = later - e * (cosh - start * sinh / lands)
        yield OneImpact(phi, max(speed, 0.0), float(course.max()), trace)


CASES = [
    (3.0, 8.0, 0.5),
    (2.0, 7.0, 0.7),
    (2.5, 6.0, 1.0),
    (1.2, 5.0, 0.9),
    (2.9, 3.92, 0.0),
    (3.017, 4.8974, 0.02),
]


@every(("a", "w", "e"), CASES)
def test_orbits_with_one_impact_are_the_closed_forms(a: float, w: float, e: float) -> None:
    found = [
        orbit
        for orbit in find_orbits(
            against_wall(e), Harmonic(amplitude=a, frequency_ratio=w), max_impacts=1
        )
        if orbit.impacts == 1
    ]
    expected = [(periods, one) for periods in (1, 2, 3) for one in closed_forms(a, w, e, periods)]
    assert len(expected) == len(found) >= 1
    for periods, one in expected:
        (orbit,) = (
            each
            for each in found
            if each.period == periods and abs(each.start.phase - one.phase) < 1e-6
        )
        assert orbit.start.phase == pytest.approx(one.phase, abs=1e-10)
        assert orbit.start.speed == pytest.approx(one.speed, abs=1e-10)
        assert orbit.highest == pytest.approx(one.peak, abs=1e-5)
        assert orbit.lowest == 0.0
        assert math.copysign(1.0, orbit.lowest) == 1.0
        assert orbit.kind == "unsymmetric"
        assert [state.side for state in orbit.states] == [1]
        assert complex(np.prod(orbit.multipliers)) == pytest.approx(e * e, abs=1e-12)
        assert complex(orbit.multipliers.sum()) == pytest.approx(one.trace, rel=1e-9)


@every(("a", "w", "e"), [(2.0, 7.0, 0.7), (1.2, 5.0, 0.9), (3.0, 8.0, 0.5)])
def test_the_multipliers_of_n_impacts_have_the_product_e_to_the_2n(
    a: float, w: float, e: float
) -> None:
    orbits = find_orbits(
        against_wall(e), Harmonic(amplitude=a, frequency_ratio=w), max_period=2, max_impacts=3
    )
    several = [orbit for orbit in orbits if orbit.impacts is not None and orbit.impacts > 1]
    assert several
    for orbit in several:
        impacts = len(orbit.states)
        assert orbit.impacts == impacts
        assert complex(np.prod(orbit.multipliers)) == pytest.approx(e ** (2 * impacts), rel=1e-9)
        run = orbit.trajectory()
        pt = np.linspace(0.0, run.end_time_pt, 4000)
        angles = run(pt).angle
        assert angles.min() >= -1e-12
        assert orbit.highest == pytest.approx(angles.max(), abs=1e-4)
        assert len(run.impacts) == impacts


@pytest.mark.parametrize(("a", "w", "e"), [(2.9, 3.92, 0.0), (3.017, 4.8974, 0.02)])
def test_a_stable_closed_form_attracts(a: float, w: float, e: float) -> None:
    (stable,) = (one for one in closed_forms(a, w, e, 1) if abs(one.trace) < 1.0 + e * e)
    motion = Harmonic(amplitude=a, frequency_ratio=w)
    block = against_wall(e)
    near = State(angle=0.0, velocity=stable.speed + 1e-3, phase=stable.phase)
    found = find_attractor(block, motion, start=near)
    assert found.kind is AttractorKind.UNSYMMETRIC
    assert found.orbit is not None
    assert found.orbit.stable
    assert (found.period, found.orbit.impacts) == (1, 1)
    assert found.orbit.start.phase == pytest.approx(stable.phase, abs=1e-10)
    assert found.orbit.start.speed == pytest.approx(stable.speed, abs=1e-10)
    assert found.peaks == pytest.approx((stable.peak, 0.0), abs=1e-5)
    assert "wall" in found.describe().notes[0]
    values = found.to_dict()
    assert (values["period"], values["impacts_per_period"]) == (1, 1)
    assert [state["side"] for state in values["states"]] == [1]
    assert values["peaks"] == [found.orbit.highest, 0.0]


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_an_orbit_closes_by_an_adaptive_integrator(model: ModelName) -> None:
    # The restitution is small, so that an orbit with one impact attracts.
    motion = Harmonic(amplitude=3.017, frequency_ratio=4.8974)
    orbits = find_orbits(FACADE, motion, max_period=1, max_impacts=1, seeds=40, model=model)
    singles = [orbit for orbit in orbits if orbit.impacts == 1]
    assert singles
    alpha, e = FACADE.alpha, FACADE.restitution

    def flight(s: float, y: Any, phase: float) -> list[float]:
        push = motion.amplitude * math.sin(motion.frequency_ratio * s + phase)
        if model == "linear":
            return [y[1], y[0] - 1.0 + push]
        tilt = alpha * (1.0 - y[0])
        return [y[1], (-math.sin(tilt) + alpha * push * math.cos(tilt)) / alpha]

    for orbit in singles:
        span = 2.0 * math.pi / motion.frequency_ratio
        run = solve_ivp(
            flight,
            (0.0, span),
            [0.0, orbit.start.speed],
            method="DOP853",
            rtol=1e-12,
            atol=1e-13,
            args=(orbit.start.phase,),
            dense_output=True,
        )
        assert run.y[0, -1] == pytest.approx(0.0, abs=1e-9)
        assert -e * run.y[1, -1] == pytest.approx(orbit.start.speed, abs=1e-9)
        assert run.sol is not None
        course = run.sol(np.linspace(0.0, span, 3001))[0]
        assert course[1:-1].min() > 0.0
        assert orbit.highest == pytest.approx(course.max(), abs=1e-6)


def test_a_sweep_keeps_the_attractor_and_its_last_value_is_found_alone() -> None:
    block, motion = against_wall(0.02), Harmonic(amplitude=3.0, frequency_ratio=4.8974)
    (stable,) = (one for one in closed_forms(3.0, 4.8974, 0.02, 1) if abs(one.trace) < 1.0)
    start = State(angle=0.0, velocity=stable.speed, phase=stable.phase)
    values = [0.02, 0.015, 0.01, 0.0]
    sweep = sweep_attractor(block, motion, "restitution", values, start=start)
    assert list(sweep.periods) == [1] * 4
    for e, attractor, peaks in zip(values, sweep.attractors, sweep.peaks, strict=True):
        (one,) = (one for one in closed_forms(3.0, 4.8974, e, 1) if abs(one.trace) < 1.0)
        assert attractor.orbit is not None
        assert attractor.orbit.start.phase == pytest.approx(one.phase, abs=1e-9)
        assert peaks == pytest.approx([one.peak], abs=1e-5)


def test_many_motions_at_once_are_each_alone() -> None:
    rng = np.random.default_rng(5)
    count = 60
    a, w = rng.uniform(0.8, 4.0, count), rng.uniform(1.0, 8.0, count)
    e = np.concatenate([[0.0, 1.0], rng.uniform(0.0, 1.0, count - 2)])
    u, v = rng.uniform(0.0, 0.5, count), rng.uniform(-0.4, 0.4, count)
    found = find_attractors(a, w, e, angle=u, velocity=v, max_cycles=200, one_sided=True)
    agreed = 0
    for k in range(count):
        alone = find_attractor(
            against_wall(e[k]),
            Harmonic(amplitude=a[k], frequency_ratio=w[k]),
            start=State(angle=u[k], velocity=v[k]),
            max_cycles=200,
        )
        if alone.growth > 1e10:
            continue
        agreed += 1
        assert found.labels[k] == alone.kind.value
        assert found.period[k] == (alone.period or 0)
        if alone.orbit is not None:
            assert found.lowest[k] == alone.orbit.lowest == 0.0
            assert found.highest[k] == pytest.approx(alone.orbit.highest, abs=1e-10)
    assert agreed > 30
    assert {"overturned", "unsymmetric"} <= set(found.labels.tolist())


def test_without_loss_nothing_settles_and_nothing_is_aperiodic() -> None:
    found = find_attractors(
        [1.2, 1.3, 1.4], 9.0, 1.0, velocity=0.05, max_cycles=200, one_sided=True
    )
    assert set(found.labels.tolist()) <= {"undecided", "overturned"}
    alone = find_attractor(
        against_wall(1.0),
        Harmonic(amplitude=1.2, frequency_ratio=9.0),
        start=State(angle=0.0, velocity=0.05),
        max_cycles=200,
    )
    assert alone.kind.value == found.labels[0]


def an_orbit() -> Orbit:
    return find_orbits(
        against_wall(0.5), Harmonic(amplitude=3.0, frequency_ratio=8.0), max_period=1, seeds=40
    )[0]


MOTION = Harmonic(amplitude=2.0, frequency_ratio=4.0)
WALL = against_wall(0.5)


@every(
    ("refused", "instead"),
    [
        (lambda: find_attractor(WALL, MOTION, start=Steady()), "find_orbits"),
        (lambda: simulate(WALL, MOTION, start=Steady()), "find_orbits"),
        (lambda: find_bifurcations(WALL, MOTION, "amplitude"), "find_orbits"),
        (lambda: compute_response_curve(WALL, 2.0, frequency_ratio=[2.0, 3.0]), "find_orbits"),
        (lambda: follow_branch(an_orbit(), "amplitude", within=(2.0, 4.0)), "sweep_attractor"),
        (lambda: an_orbit().mirrored, "the orbit itself"),
        (lambda: find_attractor(WALL, MOTION, start=State(angle=-0.1, velocity=0.0)), "above 0"),
        (lambda: find_attractor(WALL, MOTION, start=State(angle=0.0, velocity=-0.1)), "above 0"),
        (lambda: find_attractors(2.0, 4.0, 0.5, angle=-0.1, one_sided=True), "above 0"),
        (lambda: find_attractors(2.0, 4.0, 0.5, velocity=[0, -1], one_sided=True), "above 0"),
    ],
)
def test_what_a_wall_rules_out_is_refused_with_what_to_take(refused: Any, instead: str) -> None:
    with pytest.raises(ModelError, match=instead) as error:
        refused()
    assert "wall" in str(error.value)
    assert "\n" not in str(error.value)


def test_a_wall_keeps_between_nothing_and_all() -> None:
    with pytest.raises(InputError, match=r"restitution = 1.5 is not valid.*\[0, 1\]"):
        find_attractors(2.0, 4.0, [0.5, 1.5], one_sided=True)
    with pytest.raises(InputError, match="restitution"):
        find_attractors(2.0, 4.0, [0.5, 0.0])
