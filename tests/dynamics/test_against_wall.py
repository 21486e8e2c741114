"""Time histories of a block against a wall: an integrator, free rocking, records, both models."""

import json
import math
import pickle
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    Rest,
    State,
    Status,
    Steady,
    Still,
    check_neighbours,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.histories import ImpactState, Trajectory
from rocksteady.model.equations import Model
from rocksteady.motions import Impulses
from tests.every import every
from tests.records import synthetic

Floats = NDArray[np.float64]

FREE = Block.rectangle(width=0.3, height=3.0)
FACADE = FREE.against_wall()
MODELS: list[Model] = [Linear(), Nonlinear()]


def noise(seed: int, *, peak: float = 3.0, count: int = 400) -> Record:
    values = synthetic(np.random.default_rng(seed), count, 0.02, peak)
    return Record(acceleration_m_s2=values, dt_s=0.02, name=f"noise {seed}")


def impacts_by_integrator(
    block: Block, record: Record, model: Model, start: tuple[float, float], count: int
) -> list[float]:
    """Return the times of the first impacts [s] after a start of angle [rad] and velocity."""
    alpha, p, g = block.alpha, block.p, block.gravity
    samples, dt = record.acceleration_m_s2 / g, record.dt_s
    times = dt * np.arange(len(samples))

    def motion(t: float, y: Floats) -> list[float]:
        ground = float(np.interp(t, times, samples))
        if isinstance(model, Linear):
            return [y[1], p * p * (y[0] - alpha + ground)]
        left = alpha - y[0]
        return [y[1], p * p * (-math.sin(left) + ground * math.cos(left))]

    def landing(_t: float, y: Floats) -> float:
        return float(y[0])

    landing.terminal, landing.direction = True, -1.0  # type: ignore[attr-defined]
    state, found = list(start), list[float]()
    for begin, end in pairwise(times.tolist()):
        now = begin
        while now < end:
            run = solve_ivp(
                motion, (now, end), state, "DOP853", events=landing, rtol=1e-12, atol=1e-15
            )
            now, state = float(run.t[-1]), run.y[:, -1].tolist()
            if run.status == 1:
                found.append(now)
                if len(found) == count:
                    return found
                state = [0.0, -block.restitution * state[1]]
    return found


@every("model", MODELS)
@every("free", [FREE, Block.asymmetric(left=0.15, right=0.35, height=2.5)])
@every(("seed", "ratio"), [(1, "housner"), (2, 0.7), (5, 1.0)])
def test_impacts_are_those_of_an_adaptive_integrator(
    model: Model, free: Block, seed: int, ratio: Any
) -> None:
    block, record = free.against_wall(ratio), noise(seed, peak=1.2, count=80)
    run = simulate(block, record, start=State(angle=0.2, velocity=-0.1), model=model)
    start = (0.2 * block.alpha, -0.1 * block.alpha * block.p)
    expected = impacts_by_integrator(block, record, model, start, 3)
    assert len(expected) == 3
    np.testing.assert_allclose(run.impacts.pt[:3] / block.p, expected, rtol=0.0, atol=1e-9)


@every("model", MODELS)
@every("sign", [1.0, -1.0])
@every("seed", range(10))
def test_every_run_obeys_the_equation_of_motion_and_the_wall(
    model: Model, sign: float, seed: int
) -> None:
    record = noise(seed).scaled(sign)
    run = simulate(FACADE, record, model=model)
    assert len(run.impacts) > 0
    assert (run.impacts.side == 1).all()
    assert (run.impacts.velocity_before <= 0.0).all()
    np.testing.assert_array_equal(
        run.impacts.velocity_after, -FACADE.restitution * run.impacts.velocity_before
    )
    assert set(np.unique(run.flights.side)) <= {0, 1}
    assert run.side_peaks == (run.peak, 0.0)
    motion = run(run.times(400))
    assert (motion.angle >= -1e-12).all()
    assert run.peak >= motion.angle[motion.pt <= (run.overturn_time_pt or math.inf)].max() - 1e-12
    base = np.interp(
        motion.pt / FACADE.p,
        record.dt_s * np.arange(len(record.acceleration_m_s2)),
        record.acceleration_m_s2,
        right=0.0,
    )
    base /= FACADE.alpha * FACADE.gravity
    left = FACADE.alpha * (1.0 - motion.angle)
    expected = motion.angle - 1.0 + base
    if isinstance(model, Nonlinear):
        expected = -np.sin(left) / FACADE.alpha + base * np.cos(left)
    index = np.searchsorted(run.flights.pt, motion.pt, side="right") - 1
    flying = run.flights.side[index] == 1
    assert flying.any()
    np.testing.assert_allclose(
        motion.acceleration[flying], expected[flying], rtol=0.0, atol=1e-7 * np.abs(base).max()
    )
    assert not motion.angle[~flying].any()
    # It stands where the base does not lift it, and only there.
    lift = 1.0 if isinstance(model, Linear) else math.tan(FACADE.alpha) / FACADE.alpha
    assert (base[~flying] <= lift * (1.0 + 1e-9)).all()


@every("model", MODELS)
@every("ratio", [0.3, 0.8, 0.95])
def test_on_a_still_base_it_is_the_free_block_folded_to_one_side(
    model: Model, ratio: float
) -> None:
    """Both sides of a symmetric block are alike: its impacts are those on a wall, reflected."""
    start = State(angle=0.7, velocity=0.2)
    free = Block.rectangle(width=0.3, height=3.0, restitution=ratio)
    run = simulate(FREE.against_wall(ratio), Still(), start=start, model=model)
    other = simulate(free, Still(), start=start, model=model)
    assert run.status is other.status is Status.AT_REST
    assert len(run.impacts) == len(other.impacts) > 5
    np.testing.assert_allclose(run.impacts.pt, other.impacts.pt, rtol=1e-12)
    np.testing.assert_allclose(
        run.impacts.velocity_after, np.abs(other.impacts.velocity_after), rtol=1e-9
    )
    assert run.rest_time_pt == pytest.approx(other.rest_time_pt, rel=1e-12)
    times = np.linspace(0.0, 1.1 * (run.rest_time_pt or 0.0), 200)
    np.testing.assert_allclose(run(times).angle, np.abs(other(times).angle), rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(run(times).energy, other(times).energy, rtol=0.0, atol=1e-11)
    assert run.growth == pytest.approx(other.growth, rel=1e-6)
    assert run.peak == other.peak


@pytest.mark.parametrize("model", MODELS)
def test_a_wall_that_keeps_all_of_the_velocity_keeps_the_energy(model: Model) -> None:
    block = FREE.against_wall(1.0)
    run = simulate(block, Still(), start=State(angle=0.6, velocity=0.0), model=model)
    assert run.status is Status.ROCKING
    assert len(run.impacts) > 1000
    energy = run(np.linspace(0.0, 200.0, 2001)).energy
    np.testing.assert_allclose(energy, energy[0], rtol=1e-11)


@pytest.mark.parametrize("model", MODELS)
def test_a_wall_that_keeps_nothing_lets_each_rocking_begin_from_rest(model: Model) -> None:
    block = FREE.against_wall(0.0)
    run = simulate(block, noise(4), model=model)
    assert run.impact_count == 0  # none leaves with any velocity
    after = np.flatnonzero(run.flights.ended_by == 1) + 1
    assert len(after) > 1
    assert not run.flights.velocity[after].any()
    assert run.rest_time_pt == run.flights.pt[after[-1]]
    assert math.isfinite(run.growth)


def test_a_wall_that_keeps_nothing_keeps_no_difference() -> None:
    """Two starts a little apart are one run after the first impact, from which it rests."""
    run = simulate(
        DimensionlessBlock(restitution=0.0, one_sided=True),
        Still(),
        start=State(angle=0.5, velocity=0.0),
    )
    assert np.count_nonzero(run.flights.ended_by == 1) == 1
    # Before it: cosh and sinh of the flight, of which the march looks at the whole at its end.
    assert run.growth == 1.0 or run.growth < 10.0
    assert run.rest_time_pt == pytest.approx(math.acosh(1.0 / (1.0 - 0.5)))


@pytest.mark.parametrize("model", MODELS)
def test_growth_is_that_of_two_runs_a_little_apart(model: Model) -> None:
    shaking = Harmonic(amplitude=1.1, frequency_ratio=3.0)
    step = 1e-7

    def ended(angle: float, velocity: float) -> Floats:
        start = State(angle=angle, velocity=velocity)
        motion = simulate(FREE.against_wall(0.6), shaking, start=start, cycles=2, model=model)(3.0)
        return np.array([float(motion.angle), float(motion.velocity)])

    columns = [
        (ended(0.3 + da, 0.1 + dv) - ended(0.3 - da, 0.1 - dv)) / (2.0 * step)
        for da, dv in ((step, 0.0), (0.0, step))
    ]
    until = simulate(
        FREE.against_wall(0.6),
        shaking,
        start=State(angle=0.3, velocity=0.1),
        cycles=3.0 * 3.0 / (2.0 * math.pi),
        model=model,
    )
    assert len(until.impacts) == 1
    assert until.growth == pytest.approx(np.linalg.norm(np.array(columns)), rel=1e-5)


@every("block", [FACADE, FACADE.dimensionless()])
@every(
    ("start", "words"),
    [
        (State(angle=-0.1, velocity=0.0), "positive side alone"),
        (State(angle=0.0, velocity=-0.1), "positive side alone"),
        (ImpactState(side=-1, phase=0.0, speed=0.3), "positive side alone"),
        (ImpactState(side=-1, phase=0.0, speed=0.0), "positive side alone"),
        (Steady(), "one side"),
    ],
)
def test_a_start_behind_the_wall_or_mirrored_is_refused_by_name(
    block: Block | DimensionlessBlock, start: Any, words: str
) -> None:
    with pytest.raises(ModelError, match=words) as caught:
        simulate(block, Harmonic(amplitude=2.0, frequency_ratio=3.0), start=start)
    assert caught.value.name == "start"


@pytest.mark.parametrize("start", [Rest(), State(angle=0.0, velocity=0.0)])
def test_it_stays_at_rest_below_its_uplift_and_when_pushed_against_the_wall(start: Any) -> None:
    push = Pulse(shape="rectangle", amplitude=3.0, frequency_ratio=3.0, reverse=True)
    for motion in (push, Harmonic(amplitude=0.99, frequency_ratio=3.0)):
        run = simulate(FACADE, motion, start=start, model=Linear(), cycles=3)
        assert (run.peak, len(run.impacts), run.rest_time_pt) == (0.0, 0, 0.0)
    lifted = simulate(FREE, push, start=start, model=Linear())
    assert lifted.side_peaks[1] > 0.0


@pytest.mark.parametrize("model", MODELS)
def test_an_impulse_lifts_it_off_the_wall_or_throws_it_there(model: Model) -> None:
    block, v = FREE.against_wall(0.5), 0.4
    apart = simulate(block, Impulses(times=(0.0,), velocities=(v,)), model=model)
    assert apart.peak > 0.0
    held = simulate(block, Impulses(times=(0.0,), velocities=(-v,)), model=model)
    assert held.peak == 0.0
    assert not held.flights.side.any()
    # Moving off already, it is thrown back with the velocity that is left.
    start = State(angle=0.0, velocity=0.1)
    thrown = simulate(block, Impulses(times=(0.0,), velocities=(-v,)), start=start, model=Linear())
    assert thrown(0.0).velocity == pytest.approx(0.5 * (v - 0.1))


def test_a_run_describes_the_wall_and_one_side() -> None:
    run = simulate(FACADE, noise(4))
    values = json.loads(json.dumps(run.describe().to_dict()))
    assert values["restitution"] == FACADE.restitution
    assert values["one_sided"] is True
    assert values["block"]["one_sided"] is True
    assert "negative_restitution" not in values
    assert "side_peaks" not in values
    assert values["peak_rad"] == run.peak * FACADE.alpha
    assert values["uplift_g"] == pytest.approx(math.tan(FACADE.alpha) * FACADE.gravity / 9.80665)
    assert "block against a wall" in run.describe().headline
    assert "away from the wall" in str(run.describe())
    assert run.balances == (0.0, 1.0)
    assert run.uplifts == (-math.inf, math.tan(FACADE.alpha) / FACADE.alpha)
    again = pickle.loads(pickle.dumps(run))
    assert again.describe() == run.describe()


@pytest.mark.slow
@every("ratio", [0.0, 0.47, 1.0])
def test_neighbours_have_other_walls_and_the_reversed_record(ratio: float) -> None:
    run = simulate(FREE.against_wall(ratio), noise(4, peak=2.0))
    found = check_neighbours(run)
    assert found.runs == 27
    assert [case.sign for case in found.cases].count(-1) == 1
    ratios = sorted({case.restitution for case in found.cases})
    assert ratios == pytest.approx(
        sorted({max(ratio - 0.03, 0.5 * ratio), ratio, min(ratio + 0.03, 0.5 * (1.0 + ratio))})
    )
    (reverse,) = (case for case in found.cases if case.sign == -1)
    other = simulate(FREE.against_wall(ratio), noise(4, peak=2.0).scaled(-1.0))
    assert (reverse.status, reverse.peak) == (other.status, other.peak)


@pytest.mark.parametrize("model", MODELS)
def test_a_run_goes_on_from_a_state_of_another(model: Model) -> None:
    block, shaking = FREE.against_wall(0.8), Harmonic(amplitude=1.4, frequency_ratio=3.0)
    run = simulate(block, shaking, cycles=4, model=model)

    def later(pt: float) -> Trajectory:
        return simulate(block, shaking, start=run.state(pt=pt), cycles=2, model=model)

    for pt in (0.9, 1.7):
        assert float(later(pt)(0.4).angle) == pytest.approx(float(run(pt + 0.4).angle), abs=1e-9)
