"""Fourier series in `simulate`, the return map and what is built on it.

Oracles: DOP853 with events, the closed form of a single sinusoid, finite differences, symmetries.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import rocksteady as rs
from tests.every import every
from tests.strategies import sample_size

LINEAR, NONLINEAR = rs.Linear(), rs.Nonlinear()
BARE = rs.DimensionlessBlock(restitution=0.8)
BODY = rs.Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
CASES: list[tuple[Any, Any]] = [(BARE, LINEAR), (BODY, NONLINEAR)]
TWO = rs.motions.FourierSeries(
    amplitude=1.5, frequency_ratio=2.0, harmonics=((1, 1.0, 0.3), (2, 0.6, 1.0))
)
MILD = replace(TWO, amplitude=0.9)
ODD = rs.motions.FourierSeries(
    amplitude=1.5, frequency_ratio=2.0, harmonics=((1, 1.0, 0.3), (3, 0.6, 1.0))
)


def drawn(rng: np.random.Generator) -> rs.motions.FourierSeries:
    orders = rng.choice(np.arange(1, 9), rng.integers(2, 6), replace=False)
    return rs.motions.FourierSeries(
        amplitude=rng.uniform(0.3, 3.0),
        frequency_ratio=rng.uniform(0.3, 4.0),
        harmonics=tuple((int(k), rng.normal(), rng.uniform(-3.0, 3.0)) for k in orders),
        phase=rng.uniform(-5.0, 5.0),
    )


def flown(
    motion: rs.motions.FourierSeries,
    side: int,
    own: tuple[float, float, float],
    alpha: float,
    span: tuple[float, float],
    state: NDArray[np.float64],
) -> Any:
    """Integrate one flight up to its landing, to |u| = 4 or to the end of a span."""
    _, lean, rate = own

    def equations(s: float, x: NDArray[np.float64]) -> list[float]:
        turned = motion.frequency_ratio * s + motion.phase
        waves = (a * math.sin(k * turned + phi) for k, a, phi in motion.harmonics)
        shaking = motion.amplitude * sum(waves)
        if alpha == 0.0:
            return [x[1], rate**2 * (x[0] - side * lean + shaking)]
        tilt = alpha * (1.0 - side * x[0])
        return [x[1], -side * math.sin(tilt) / alpha + shaking * math.cos(tilt)]

    def lands(_: float, x: NDArray[np.float64]) -> float:
        return float(side * x[0])

    def falls(_: float, x: NDArray[np.float64]) -> float:
        return float(abs(x[0]) - 4.0)

    lands.terminal, lands.direction, falls.terminal = True, -1.0, True  # type: ignore[attr-defined]
    options: Any = {"rtol": 1e-13, "atol": 1e-15, "events": [lands, falls], "max_step": 0.05}
    return solve_ivp(equations, span, state, method="DOP853", **options)


def integrated(
    motion: rs.motions.FourierSeries,
    sides: Any,
    start: tuple[float, float],
    alpha: float,
    end: float,
) -> tuple[list[float], NDArray[np.float64] | None]:
    """Return impact times, and the state at the end unless the block falls or hardly bounces."""
    time, state = 0.0, np.array(start)
    times: list[float] = []
    side = 1 if start[0] > 0.0 else -1
    while True:
        own = sides[0 if side > 0 else 1]
        run = flown(motion, side, own, alpha, (time, end), state)
        if run.t_events[1].size:
            return times, None
        if not run.t_events[0].size:
            return times, run.y[:, -1]
        time = float(run.t_events[0][0])
        times.append(time)
        state = np.array([0.0, own[0] * run.y_events[0][0][1]])
        side = -side
        if abs(state[1]) < 0.02:
            return times, None


@pytest.mark.parametrize("alpha", [0.0, 0.35])
def test_time_histories_are_those_of_a_general_integrator(alpha: float) -> None:
    rng = np.random.default_rng(7)
    for _ in range(sample_size(12, 4)):
        motion, start = drawn(rng), (rng.uniform(-0.7, 0.7), rng.uniform(-0.4, 0.4))
        ratio = rng.uniform(0.5, 0.95)
        block: Any = rs.DimensionlessBlock(restitution=ratio)
        sides = ((ratio, 1.0, 1.0),) * 2
        if alpha > 0.0:
            block = rs.Block.from_p(alpha=alpha, p=1.0, restitution=ratio)
        times, end = integrated(motion, sides, start, alpha, 5.0)
        run = rs.simulate(
            block,
            motion,
            start=rs.State(angle=start[0], velocity=start[1]),
            cycles=5.0 * motion.frequency_ratio / (2.0 * math.pi),
            model=NONLINEAR if alpha > 0.0 else LINEAR,
        )
        assert run.impacts.pt[: len(times)] == pytest.approx(np.array(times), abs=1e-9)
        if end is not None and run.status is not rs.Status.OVERTURNED:
            assert len(run.impacts) == len(times)
            here = run(run.end_time_pt)
            assert [float(here.angle), float(here.velocity)] == pytest.approx(end, abs=1e-8)


def test_sides_that_differ_see_the_series_each_in_its_own_way() -> None:
    block = rs.Block.from_alphas(positive=0.2, negative=0.3, radius=1.0, restitution=(0.7, 0.8))
    sides = block.dimensionless().sides
    times, _ = integrated(MILD, sides, (0.3, 0.0), 0.0, 8.0)
    start = rs.State(angle=0.3, velocity=0.0)
    run = rs.simulate(
        block, MILD, start=start, cycles=8.0 * MILD.frequency_ratio / (2.0 * math.pi), model=LINEAR
    )
    assert len(times) > 1
    assert run.impacts.pt[: len(times)] == pytest.approx(np.array(times), abs=1e-9)
    # Its mirror image: the block with its sides exchanged, under minus the series.
    turned = replace(MILD, harmonics=tuple((k, -a, phi) for k, a, phi in MILD.harmonics))
    image = rs.Block(positive=block.negative, negative=block.positive)
    for model in (LINEAR, NONLINEAR):
        one = rs.simulate(block, MILD, start=start, cycles=3, model=model)
        scale = block.positive.alpha / image.positive.alpha
        # Pivot times and angles are in units of the positive side of either block.
        rate = image.positive.p / block.positive.p
        other = rs.simulate(
            image,
            replace(
                turned,
                amplitude=turned.amplitude * scale,
                frequency_ratio=turned.frequency_ratio / rate,
            ),
            start=rs.State(angle=-0.3 * scale, velocity=0.0),
            cycles=3,
            model=model,
        )
        count = min(len(one.impacts), len(other.impacts), 4)
        assert count > 1
        assert one.impacts.pt[:count] == pytest.approx(other.impacts.pt[:count] / rate, rel=1e-10)


@every(("block", "model"), CASES)
@every("order", [1, 3])
def test_a_single_order_is_harmonic_shaking(block: Any, model: Any, order: int) -> None:
    series = rs.motions.FourierSeries(
        amplitude=2.0, frequency_ratio=4.0 / order, harmonics=((order, 1.0, 0.3),), phase=0.2
    )
    plain = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=0.3 + order * 0.2)
    runs = [
        rs.simulate(block, motion, cycles=cycles, model=model)
        for motion, cycles in ((series, 4), (plain, 4 * order))
    ]
    assert len(runs[0].impacts) == len(runs[1].impacts) > 5
    pt = np.linspace(0.0, runs[1].end_time_pt, 200)
    assert runs[0](pt).angle == pytest.approx(runs[1](pt).angle, abs=1e-11)
    assert runs[0].peak == pytest.approx(runs[1].peak, rel=1e-12)
    here, there = (rs.find_attractor(block, motion, model=model) for motion in (series, plain))
    assert here.peaks == pytest.approx(there.peaks, rel=1e-9)
    assert here.kind is there.kind is rs.outcomes.AttractorKind.SYMMETRIC
    assert here.orbit is not None
    assert there.orbit is not None
    if order == 1:
        assert here.orbit.multipliers == pytest.approx(there.orbit.multipliers, rel=1e-7)


@every(("block", "model"), CASES)
@every("side", [1, -1])
def test_the_derivative_of_a_passage_is_that_of_differences(
    block: Any, model: Any, side: int
) -> None:
    turn = rs.orbits.ReturnMap(block, MILD, model=model)
    for phase, speed in ((1.3, 0.3), (0.2, 0.2), (4.0, 0.3)):
        passage = turn(rs.histories.ImpactState(side=side, phase=phase, speed=speed))
        assert passage.kind is rs.outcomes.Event.IMPACT
        step = 1e-6
        columns = []
        for turned, faster in ((step, 0.0), (0.0, step)):
            ends = [
                turn(
                    rs.histories.ImpactState(
                        side=side, phase=phase + sign * turned, speed=speed + sign * faster
                    )
                )
                for sign in (1.0, -1.0)
            ]
            moved = ends[0].phase - ends[1].phase + 2.0 * turned
            gained = ends[0].state.speed - ends[1].state.speed  # type: ignore[union-attr]
            columns.append([moved / (2.0 * step), gained / (2.0 * step)])
        assert passage.jacobian == pytest.approx(np.array(columns).T, abs=1e-7)
        # Between impacts the flow keeps phase times kinetic energy.
        assert passage.state is not None
        determinant = float(np.linalg.det(passage.jacobian))
        assert determinant == pytest.approx(0.64 * speed / passage.state.speed, rel=1e-9)


def test_a_rest_ends_at_the_uplift_of_the_series_and_forgets_what_was_before() -> None:
    motion = rs.motions.FourierSeries(
        amplitude=1.05, frequency_ratio=0.6, harmonics=((1, 0.8, 0.0), (2, 0.3, 0.5))
    )
    block = rs.DimensionlessBlock(restitution=0.4)
    found = [
        rs.simulate(block, motion, start=rs.State(angle=0.01 * k, velocity=0.0), cycles=4)
        for k in (1, 2, 3)
    ]
    rests = [run for run in found if (run.rows[:, 3] == 0.0).any()]
    assert len(rests) == 3
    lifted = []
    for run in rests:
        after = np.flatnonzero(run.rows[:-1, 3] == 0.0) + 1
        lifted.append(run.rows[after[-1], 2])
        side = run.rows[after[-1], 3]
        pt = float(run.flights.pt[after[-1]])
        assert side * float(run.base_acceleration(pt)) == pytest.approx(1.0, abs=1e-12)
    assert len(set(lifted)) == 1
    resting = rs.find_attractor(block, motion)
    assert resting.orbit is not None
    assert resting.orbit.rest_phases > 0
    assert resting.orbit.largest_multiplier == 0.0


@pytest.mark.parametrize(("block", "model"), CASES)
def test_mirror_images_are_there_where_all_orders_are_odd(block: Any, model: Any) -> None:
    start = rs.histories.ImpactState(side=1, phase=0.4, speed=0.3)
    odd, even = (rs.orbits.ReturnMap(block, motion, model=model) for motion in (ODD, MILD))
    here, image = odd(start), odd(start.mirrored)
    assert here.state is not None
    assert image.state is not None
    assert image.state.speed == pytest.approx(here.state.speed, rel=1e-12)
    assert image.phase == pytest.approx(here.phase, rel=1e-12)
    here, image = even(start), even(start.mirrored)
    assert here.state is not None
    assert image.state is None or abs(image.state.speed - here.state.speed) > 1e-3


def test_orbits_of_even_orders_have_no_mirror_image() -> None:
    found = rs.find_orbits(BARE, TWO, max_period=1, max_impacts=2, seeds=sample_size(24, 6))
    assert found
    for orbit in found:
        assert not orbit.symmetric
        assert orbit.residual < 1e-10
        with pytest.raises(rs.errors.ModelError, match="even orders"):
            _ = orbit.mirrored
        run = rs.simulate(BARE, orbit.motion, start=orbit.start, cycles=1)
        assert float(run(run.end_time_pt).angle) == pytest.approx(0.0, abs=1e-6)


def test_batches_are_the_runs_one_by_one() -> None:
    axes = {"amplitude": [0.6, 1.4, 2.2, 3.0], "frequency_ratio": [1.5, 3.0]}
    for block, model in CASES:
        fates = rs.map_fates(block, TWO, axes=axes, cycles=20, model=model)
        attractors = rs.map_attractors(block, TWO, axes=axes, max_cycles=150, model=model)
        for i, amplitude in enumerate(axes["amplitude"]):
            for j, ratio in enumerate(axes["frequency_ratio"]):
                motion = replace(TWO, amplitude=amplitude, frequency_ratio=ratio)
                run = rs.simulate(block, motion, cycles=20, model=model)
                assert int(fates.fate.values[i, j]) == int(run.status)
                one = rs.find_attractor(block, motion, max_cycles=150, model=model)
                kinds = attractors.kind.attrs["flag_meanings"].split()
                values = list(attractors.kind.attrs["flag_values"])
                kind = kinds[values.index(attractors.kind.values[i, j])]
                assert kind == str(one.kind.value)
                assert attractors.period.values[i, j] == (one.period or 0)


def test_basins_and_erosion_take_a_series() -> None:
    window: dict[str, Any] = {
        "angles": np.linspace(-0.9, 0.9, 7),
        "velocities": np.linspace(-0.9, 0.9, 7),
    }
    basins = rs.compute_basins(BARE, TWO, max_cycles=100, **window)
    for row, column in ((3, 3), (1, 5), (5, 2)):
        begin = rs.State(angle=float(basins.angle[column]), velocity=float(basins.velocity[row]))
        one = rs.find_attractor(BARE, TWO, start=begin, max_cycles=100)
        assert basins.attractors[int(basins.label[row, column])].kind is one.kind
    erosion = rs.compute_erosion(BARE, TWO, [0.0, 0.3, 1.5], cycles=10, **window)
    assert (np.diff(erosion.safe_share) <= 0.0).all()
    assert erosion.safe_share[0] > erosion.safe_share[2]
    still = rs.compute_erosion(
        BARE, rs.Harmonic(amplitude=1.0, frequency_ratio=2.0), [0.0], cycles=10, **window
    )
    assert erosion.safe_share[0] == still.safe_share[0]
    assert erosion.heteroclinic is None
