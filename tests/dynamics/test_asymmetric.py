"""Blocks whose sides differ: against an integrator in seconds and radians, mirrors and energy."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    ImpactState,
    Impulses,
    ModelError,
    Piecewise,
    Record,
    ReturnMap,
    Segment,
    State,
    Status,
    Steady,
    Still,
    attractor,
    attractor_map,
    attractor_trail,
    basins,
    bifurcation_branches,
    continuation,
    erosion,
    fate_map,
    heteroclinic_amplitude,
    orbits,
    response_curve,
    simulate,
)
from rocksteady.dynamics.tangency import tangency_amplitude
from tests.dynamics.integrator import integrate_sides
from tests.strategies import sample_size

BLOCK = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = BLOCK.dimensionless()
UNLIKE = DimensionlessBlock(
    restitution=0.85, negative_restitution=0.75, alpha_ratio=1.3, p_ratio=0.95
)
HARD = Harmonic(amplitude=2.0, frequency_ratio=4.0)


def random_block(rng: np.random.Generator) -> Block:
    """Return a block of any offset, moment of inertia and restitutions, also against its own."""
    return Block.asymmetric(
        left=float(rng.uniform(0.05, 0.4)),
        right=float(rng.uniform(0.05, 0.4)),
        height=float(rng.uniform(1.0, 4.0)),
        gyration=float(rng.uniform(0.1, 1.0)),
        restitution=(float(rng.uniform(0.6, 0.98)), float(rng.uniform(0.6, 0.98))),
    )


def mirrored(block: Block) -> Block:
    """Return a block with its sides exchanged."""
    return replace(block, positive=block.negative, negative=block.positive)


# ------------------------------------------------------------------ an integrator


@pytest.mark.parametrize("seed", range(sample_size(6, 1)))
def test_impacts_are_those_of_an_integrator(seed: int) -> None:
    rng = np.random.default_rng(seed)
    block = random_block(rng)
    shaking = Harmonic(
        amplitude=float(rng.uniform(1.2, 2.5)),
        frequency_ratio=float(rng.uniform(2.5, 6.0)),
        phase=float(rng.uniform(0.0, 6.0)),
    )
    side = int(rng.choice([-1, 1]))
    start = State(angle=0.0, velocity=0.35 * side)
    run = simulate(block, shaking, start=start, cycles=6)
    peak, omega = shaking.acceleration_m_s2(block), 2.0 * math.pi * shaking.frequency_hz(block)
    truth = integrate_sides(
        lambda t: peak / block.gravity * math.sin(omega * t + shaking.phase),
        6.0 * 2.0 * math.pi / omega,
        sides=(block.positive, block.negative),
        velocity=start.velocity * block.alpha * block.p,
        longest_step=0.05 / block.p,
    )
    count = 0
    for time, before, after in zip(truth.impacts, truth.before, truth.after, strict=True):
        if abs(after) < 1e-3 * block.alpha * block.p:  # the integrator loses short bounces
            break
        at = run.impacts.s[count] / block.p
        assert at == pytest.approx(time, abs=1e-9)
        unit = block.alpha * block.p
        assert run.impacts.velocity_before[count] * unit == pytest.approx(before, abs=1e-8)
        assert run.impacts.velocity_after[count] * unit == pytest.approx(after, abs=1e-8)
        count += 1
    assert count > 0 or run.status is Status.OVERTURNED
    inside = truth.times <= run.end_s / block.p
    angles = run.at_time(truth.times[inside]).angle * block.alpha
    near = np.abs(truth.angles[inside]) < 1.5 * block.alpha
    apart = np.abs(angles - truth.angles[inside])[near]
    assert np.max(apart, initial=0.0) < 1e-6 * block.alpha


def test_an_impulse_of_the_base_turns_each_side_by_its_own_p() -> None:
    # An impulse is a short, strong push: a rectangle of the same area does the same in the limit.
    motion = Impulses.from_si(BLOCK, times_s=(0.1, 0.5), velocities_m_s=(-0.4, 0.25))
    run = simulate(BLOCK, motion)
    short = 1e-7

    def push(area: float) -> Segment:
        return Segment(duration=short, constant=area / short)

    still = [s.duration for s in motion.segments()]
    areas = [s.jump for s in motion.segments()]
    pieces: list[Segment] = []
    for duration, area in zip(still, areas, strict=True):
        if area:
            pieces.append(push(area))
        if math.isfinite(duration):
            pieces.append(Segment(duration=duration - (short if area else 0.0)))
    pushed = simulate(BLOCK, Piecewise(pieces=tuple(pieces)))
    assert len(run.impacts) > 3
    assert run.impacts.s[:3] == pytest.approx(pushed.impacts.s[:3], abs=1e-5)
    assert run.side_peaks == pytest.approx(pushed.side_peaks, abs=1e-5)


def test_a_record_moves_it_as_its_samples_do() -> None:
    rng = np.random.default_rng(4)
    samples = 6.0 * np.convolve(rng.normal(size=400), np.ones(8) / 8, mode="same")
    record = Record(acceleration_m_s2=samples, dt_s=0.01)
    run = simulate(BLOCK, record, start=State(angle=0.0, velocity=-0.3))
    grid = np.arange(len(samples)) * 0.01
    truth = integrate_sides(
        lambda t: float(np.interp(t, grid, samples)) / BLOCK.gravity,
        1.5,
        sides=(BLOCK.positive, BLOCK.negative),
        velocity=-0.3 * BLOCK.alpha * BLOCK.p,
        longest_step=0.002,
    )
    found = run.impacts.s[: len(truth.impacts)] / BLOCK.p
    assert len(truth.impacts) > 1
    assert found[:2] == pytest.approx(truth.impacts[:2], abs=1e-6)


# ------------------------------------------------------------------ mirrors and special cases

MOTIONS = [
    Harmonic(amplitude=1.8, frequency_ratio=3.0, phase=0.4),
    Harmonic(amplitude=0.9, frequency_ratio=0.8, phase=1.0),
    Piecewise(
        pieces=(
            Segment(duration=0.7, constant=1.5),
            Segment(duration=0.9, constant=-1.2, slope=0.3),
            Segment(duration=0.5, jump=-0.2),
        )
    ),
    Impulses(times=(0.0, 1.0), velocities=(0.4, -0.9)),
    Still(),
]


def reversed_motion(motion: Harmonic | Piecewise | Impulses | Still, alpha: float, p: float):  # type: ignore[no-untyped-def]
    """Return a motion of the ground the other way round, in units of another alpha and p."""
    if isinstance(motion, Harmonic):
        return Harmonic(
            amplitude=motion.amplitude / alpha,
            frequency_ratio=motion.frequency_ratio / p,
            phase=motion.phase + math.pi,
        )
    if isinstance(motion, Piecewise):
        return Piecewise(
            pieces=tuple(
                Segment(
                    duration=piece.duration * p,
                    constant=-piece.constant / alpha,
                    slope=-piece.slope / (alpha * p),
                    jump=-piece.jump * p / alpha,
                )
                for piece in motion.pieces
            )
        )
    if isinstance(motion, Impulses):
        return Impulses(
            times=tuple(time * p for time in motion.times),
            velocities=tuple(-velocity * p / alpha for velocity in motion.velocities),
        )
    return motion


@pytest.mark.parametrize("motion", MOTIONS, ids=lambda motion: type(motion).__name__)
@pytest.mark.parametrize("restitution", [(0.85, 0.75), (0.6, 0.95)])
def test_the_mirrored_block_on_the_reversed_ground_moves_mirrored(
    motion: Harmonic | Piecewise | Impulses | Still, restitution: tuple[float, float]
) -> None:
    # Ratios that are powers of two change no digit, so that the mirror image is exact.
    block = DimensionlessBlock(
        restitution=restitution[0],
        negative_restitution=restitution[1],
        alpha_ratio=2.0,
        p_ratio=0.5,
    )
    other = DimensionlessBlock(
        restitution=restitution[1],
        negative_restitution=restitution[0],
        alpha_ratio=0.5,
        p_ratio=2.0,
    )
    # Harmonic phases turn by pi, which rounds: without a sinusoid everything is exact.
    start = State(angle=0.0, velocity=0.25)
    turned = State(angle=0.0, velocity=-0.25 / 2.0 / 0.5)
    run = simulate(block, motion, start=start, cycles=20)
    image = simulate(other, reversed_motion(motion, 2.0, 0.5), start=turned, cycles=20)
    assert image.status is run.status
    assert image.side_peaks[::-1] == pytest.approx(run.side_peaks, rel=1e-10)
    assert len(image.impacts) == len(run.impacts)
    assert np.array_equal(image.flights.side, -run.flights.side)
    if isinstance(motion, Harmonic):
        assert image.impacts.s == pytest.approx(0.5 * run.impacts.s, rel=1e-9, abs=1e-12)
        return
    assert np.array_equal(image.impacts.s, 0.5 * run.impacts.s)
    assert np.array_equal(image.impacts.velocity_after, -run.impacts.velocity_after)
    assert image.rest_s == (None if run.rest_s is None else 0.5 * run.rest_s)


def test_the_mirror_image_under_harmonic_shaking_is_exact_too() -> None:
    # Half a period is added as a whole half cycle: the phases 0 and pi are both exact.
    block = DimensionlessBlock(restitution=0.8, alpha_ratio=2.0)
    other = DimensionlessBlock(restitution=0.8, alpha_ratio=0.5)
    shaking = Harmonic(amplitude=3.0, frequency_ratio=8.0)
    run = simulate(block, shaking, cycles=100)
    image = simulate(other, Harmonic(amplitude=1.5, frequency_ratio=8.0, phase=math.pi), cycles=100)
    assert len(run.impacts) > 20
    assert np.array_equal(image.impacts.phase, run.impacts.phase)
    assert np.array_equal(image.impacts.velocity_after, -0.5 * run.impacts.velocity_after)
    assert image.side_peaks == run.side_peaks[::-1]


@pytest.mark.parametrize("motion", MOTIONS, ids=lambda motion: type(motion).__name__)
def test_with_equal_sides_it_is_the_symmetric_block_to_the_last_bit(
    motion: Harmonic | Piecewise | Impulses | Still,
) -> None:
    one = Block.asymmetric(left=0.2, right=0.2, height=1.2, restitution=(0.8, 0.8))
    two = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
    runs = [
        simulate(block, motion, start=State(angle=0.3, velocity=0.1), cycles=30)
        for block in (one, two, DimensionlessBlock(restitution=0.8))
    ]
    for run in runs[1:]:
        assert np.array_equal(run.rows, runs[0].rows, equal_nan=True)
        assert (run.peak, run.rest_s) == (runs[0].peak, runs[0].rest_s)


def test_sides_that_hardly_differ_move_as_if_they_did_not() -> None:
    near = DimensionlessBlock(restitution=0.8, alpha_ratio=1.0 + 1e-12, p_ratio=1.0 - 1e-12)
    like = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    one, other = (simulate(block, shaking, cycles=20) for block in (near, like))
    assert one.impacts.s == pytest.approx(other.impacts.s, abs=1e-9)
    assert attractor(like, shaking).kind == "symmetric"
    found = attractor(near, shaking)
    assert found.kind == "unsymmetric"
    assert not any(orbit.symmetric for orbit in orbits(near, shaking, max_period=1, seeds=24))
    cells = attractor_map(near, shaking, axes={"phase": [0.0, 1.0]})
    assert set(cells.kind.values.tolist()) == {1}


# ------------------------------------------------------------------ energy and peaks


def test_without_loss_the_energy_stays_what_it_was() -> None:
    block = BLOCK.with_restitution(1.0)
    run = simulate(block, Still(), start=State(angle=0.6, velocity=0.0), flight_limit=1002)
    energy = run(run.impacts.s[:-1]).energy
    assert len(energy) >= 1000
    assert np.ptp(energy) < 1e-10 * energy[0]
    between = run(np.linspace(0.0, float(run.impacts.s[20]), 500)).energy
    assert between == pytest.approx(energy[0], rel=1e-12)
    assert run.side_peaks[0] == pytest.approx(0.6, rel=1e-12)
    # On the other side it rises to p2^2 (alpha2 theta - theta^2/2) = p1^2 (...).
    lean, rate = block.negative.alpha / block.alpha, block.negative.p / block.p
    square = (0.6 - 0.18) / rate**2
    expected = (lean - math.sqrt(lean**2 - 2.0 * square)) / lean
    assert run.side_peaks[1] == pytest.approx(expected, rel=1e-9)


def test_peaks_of_each_side_are_those_of_dense_samples() -> None:
    run = simulate(UNLIKE, HARD, start=State(angle=0.2, velocity=0.3), cycles=10)
    angle = run(np.linspace(0.0, run.end_s, 40_001)).angle
    assert run.side_peaks[0] == pytest.approx(angle.max(), rel=1e-5)
    assert run.side_peaks[1] == pytest.approx(-angle.min() / 1.3, rel=1e-5)
    assert run.peak == max(run.side_peaks)
    assert run.balances == (-1.3, 1.0)


@pytest.mark.parametrize("side", [-1, 1])
def test_it_overturns_past_the_balance_of_the_side_to_which_it_falls(side: int) -> None:
    lean = 1.3 if side < 0 else 1.0
    run = simulate(UNLIKE, Still(), start=State(angle=0.0, velocity=1.5 * side))
    assert run.status is Status.OVERTURNED
    assert run.overturn_s is not None
    assert float(run(run.overturn_s).angle) == pytest.approx(side * lean, rel=1e-12)
    assert run.side_peaks[0 if side > 0 else 1] == pytest.approx(1.0, rel=1e-12)
    assert float(run(run.end_s).angle) == pytest.approx(2.0 * lean * side, rel=1e-12)


@pytest.mark.parametrize("side", [-1, 1])
def test_it_comes_to_rest_when_all_its_bounces_are_over(side: int) -> None:
    run = simulate(UNLIKE, Still(), start=State(angle=0.0, velocity=0.3 * side))
    assert run.status is Status.AT_REST
    assert run.rest_s is not None
    # Free bounces in closed form: each lasts 2 artanh(v) in its own units and loses its part.
    velocity, here, total = 0.3, 0 if side > 0 else 1, 0.0
    for _ in range(400):
        restitution, lean, rate = UNLIKE.sides[here]
        total += 2.0 * math.atanh(velocity / (lean * rate)) / rate
        velocity, here = velocity * restitution, 1 - here
    assert run.rest_s == pytest.approx(total, rel=1e-13)


def test_a_block_at_rest_is_lifted_to_either_side_by_its_own_acceleration() -> None:
    for sign, least in ((1.0, 1.0), (-1.0, 1.3)):
        for share, status in ((0.999, Status.AT_REST), (1.001, Status.AT_REST)):
            push = Piecewise(pieces=(Segment(duration=0.01, constant=sign * share * least),))
            run = simulate(UNLIKE, push)
            assert run.status is status
            assert (len(run.impacts) > 0) == (share > 1.0)


# ------------------------------------------------------------------ orbits, attractors, maps


def test_the_return_map_has_the_derivative_of_its_differences() -> None:
    step = ReturnMap(UNLIKE, HARD)
    for side in (1, -1):
        state = ImpactState(side=side, phase=2.8, speed=0.7)
        jacobian = step(state).jacobian
        for column, (phase, speed) in enumerate(((1e-6, 0.0), (0.0, 1e-6))):
            ends = [
                step(replace(state, phase=2.8 + sign * phase, speed=0.7 + sign * speed))
                for sign in (1, -1)
            ]
            assert ends[0].state is not None
            assert ends[1].state is not None
            by_phase = (ends[0].phase - ends[1].phase + 2.0 * phase) / 2e-6
            by_speed = (ends[0].state.speed - ends[1].state.speed) / 2e-6
            assert jacobian[:, column] == pytest.approx([by_phase, by_speed], rel=1e-5, abs=1e-6)


def test_an_attractor_is_what_a_long_run_settles_to() -> None:
    found = attractor(UNLIKE, HARD)
    assert found.kind == "unsymmetric"
    assert found.orbit is not None
    late = simulate(UNLIKE, HARD, cycles=400).impacts
    assert np.abs(late.velocity_after[-2:]) == pytest.approx(
        [state.speed for state in found.orbit.states][-2:], rel=1e-9
    ) or np.abs(late.velocity_after[-2:]) == pytest.approx(
        [state.speed for state in found.orbit.states][::-1][-2:], rel=1e-9
    )
    product = np.prod(found.orbit.multipliers).real
    assert product == pytest.approx((0.85 * 0.75) ** 2, rel=1e-9)
    run = found.orbit.trajectory()
    assert max(found.orbit.highest, 0.0) == pytest.approx(run.side_peaks[0], rel=1e-9)
    assert -found.orbit.lowest == pytest.approx(1.3 * run.side_peaks[1], rel=1e-9)


def test_orbits_close_and_those_of_the_mirrored_block_mirror_them() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.5)
    block = DimensionlessBlock(restitution=0.85, negative_restitution=0.75, alpha_ratio=1.25)
    image = DimensionlessBlock(restitution=0.75, negative_restitution=0.85, alpha_ratio=0.8)
    found = orbits(block, shaking, max_period=1, max_impacts=2, seeds=32)
    other = orbits(image, replace(shaking, amplitude=1.6), max_period=1, max_impacts=2, seeds=32)
    assert len(found) == len(other) > 0
    for orbit in found:
        assert not orbit.symmetric
        assert orbit.branch is None
        assert orbit.residual < 1e-12
        run = simulate(block, orbit.shaking, start=orbit.start, cycles=1)
        assert float(run(run.end_s).angle) == pytest.approx(0.0, abs=1e-6)
        assert any(
            one.highest == pytest.approx(-orbit.lowest / 1.25, rel=1e-9)
            and one.lowest == pytest.approx(-orbit.highest / 1.25, rel=1e-9)
            for one in other
        )
        with pytest.raises(ModelError, match="mirrored block"):
            _ = orbit.mirrored


def test_every_cell_of_a_map_is_the_single_answer() -> None:
    amplitudes, ratios = [0.9, 1.5, 2.5], [1.0, 2.0, 4.0]
    axes = {"amplitude": amplitudes, "frequency_ratio": ratios}
    start = State(angle=0.0, velocity=0.3)
    for block in (UNLIKE, BLOCK):
        kinds = attractor_map(block, axes=axes, start=start)
        fates = fate_map(block, axes=axes, start=start, cycles=50)
        for amplitude in amplitudes:
            for ratio in ratios:
                shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
                here = {"amplitude": amplitude, "frequency_ratio": ratio}
                one = attractor(block, shaking, start=start)
                cell = kinds.sel(here)
                assert kinds.kind.attrs["flag_meanings"].split()[int(cell.kind)] == one.kind
                if one.peaks is not None:
                    assert (float(cell.highest), float(cell.lowest)) == one.peaks
                run = simulate(block, shaking, start=start, cycles=50)
                assert int(fates.fate.sel(here)) == int(run.status)
        assert kinds.attrs["alpha_ratio"] == block.dimensionless().alpha_ratio
        assert kinds.attrs["negative_restitution"] == block.dimensionless().negative_restitution


def test_the_asymmetry_of_a_dimensionless_block_may_be_an_axis() -> None:
    axes = {"alpha_ratio": [0.8, 1.0, 1.3], "restitution": [0.7, 0.85]}
    fates = fate_map(UNLIKE, HARD, axes=axes, start=State(angle=0.0, velocity=0.6), cycles=30)
    found = attractor_map(
        DimensionlessBlock(restitution=0.8), HARD, axes={**axes, "p_ratio": [0.9, 1.0]}
    )
    kinds = found.kind.attrs["flag_meanings"].split()
    for ratio in axes["alpha_ratio"]:
        for restitution in axes["restitution"]:
            block = replace(UNLIKE.with_restitution(restitution), alpha_ratio=ratio)
            run = simulate(block, HARD, start=State(angle=0.0, velocity=0.6), cycles=30)
            assert int(fates.fate.sel(alpha_ratio=ratio, restitution=restitution)) == int(
                run.status
            )
            for p_ratio in (0.9, 1.0):
                body = DimensionlessBlock(
                    restitution=restitution, alpha_ratio=ratio, p_ratio=p_ratio
                )
                cell = found.sel(alpha_ratio=ratio, restitution=restitution, p_ratio=p_ratio)
                assert kinds[int(cell.kind)] == attractor(body, HARD).kind
    other = attractor_map(
        DimensionlessBlock(restitution=0.8), HARD, axes={"negative_restitution": [0.7, 0.8]}
    )
    assert [kinds[kind] for kind in other.kind.values.tolist()] == ["unsymmetric", "symmetric"]


def test_basins_go_where_single_motions_go() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    window = np.linspace(-0.6, 0.6, 7)
    found = basins(UNLIKE, shaking, angles=window, velocities=window / 2.0)
    for i, velocity in enumerate(found.velocity.tolist()):
        for j, angle in enumerate(found.angle.tolist()):
            start = State(angle=angle, velocity=velocity * 2.0)
            one = attractor(UNLIKE, found.shaking, start=start, cycles=500)
            where = found.attractors[int(found.label[i, j])]
            assert where.kind == one.kind
            if one.orbit is not None:
                assert where.orbit is not None
                assert where.orbit.highest == pytest.approx(one.orbit.highest, abs=1e-9)
    wide = basins(UNLIKE, shaking, cycles=20, velocities=window)
    assert wide.angle[-1] > 1.3
    assert found.to_dataset().attrs["alpha_ratio"] == 1.3


def test_erosion_counts_the_states_that_single_runs_leave_standing() -> None:
    window = np.linspace(-1.435, 1.435, 15)
    found = erosion(UNLIKE, 2.0, [0.0, 1.0], angles=window, velocities=window, cycles=20)
    for k, amplitude in enumerate((0.0, 1.0)):
        for i, j in ((7, 7), (3, 9), (10, 2), (7, 1), (7, 13), (1, 7)):
            run = simulate(
                UNLIKE,
                Harmonic(amplitude=amplitude, frequency_ratio=2.0),
                start=State(angle=float(window[j]), velocity=2.0 * float(window[i])),
                cycles=20,
            )
            assert found.safe[k, i, j] == (run.status is not Status.OVERTURNED)
    # At rest on a still base it stands wherever it leans less than its own alpha.
    assert found.safe[0, 7].tolist() == [-1.3 < angle < 1.0 for angle in window.tolist()]
    assert f"{found.heteroclinic:.6g}" in found._repr_html_()


def reaches_over(block: DimensionlessBlock, amplitude: float, side: int) -> bool:
    """Return whether what falls from the upright motion of a side passes that of the other."""
    (_, lean, rate) = block.sides[0 if side > 0 else 1]
    own = 2.0 / rate
    size = lean * (amplitude / lean) / (1.0 + own * own)
    for phase in np.linspace(0.0, 2.0 * math.pi, 90, endpoint=False):
        # On the saddle's motion but for a growing part so small that it falls within some periods.
        tiny = 1e-7
        angle = side * (lean - tiny) - size * math.sin(phase)
        velocity = -side * tiny * rate - size * 2.0 * math.cos(phase)
        run = simulate(
            block,
            Harmonic(amplitude=amplitude, frequency_ratio=2.0, phase=float(phase)),
            start=State(angle=angle, velocity=velocity),
            cycles=20,
        )
        if run.status is Status.OVERTURNED and len(run.impacts) == 1:
            return True
    return False


@pytest.mark.parametrize(("ratio", "side"), [(1.1, -1), (0.95, 1)])
def test_manifolds_touch_at_the_heteroclinic_amplitude(ratio: float, side: int) -> None:
    block = DimensionlessBlock(
        restitution=0.8, negative_restitution=0.85, alpha_ratio=ratio, p_ratio=0.95
    )
    amplitude = tangency_amplitude(block.sides, 2.0)
    assert reaches_over(block, 1.01 * amplitude, side)
    assert not reaches_over(block, 0.99 * amplitude, side)
    assert not reaches_over(block, 0.99 * amplitude, -side)


def test_of_a_symmetric_block_it_is_the_known_tangency() -> None:
    for restitution, frequency in ((0.9, 2.0), (0.5, 6.0)):
        sides = DimensionlessBlock(restitution=restitution).sides
        expected = heteroclinic_amplitude(frequency, restitution)
        assert tangency_amplitude(sides, frequency) == pytest.approx(float(expected), rel=1e-14)


def test_a_trail_moves_the_restitution_of_both_impacts() -> None:
    trail = attractor_trail(UNLIKE, HARD, "restitution", [0.8, 0.7])
    assert trail.attractors[0].block == UNLIKE.with_restitution(0.8)
    assert set(trail.kinds) == {"unsymmetric"}


# ------------------------------------------------------------------ what there is not


def test_what_knows_symmetric_motions_alone_says_so_and_where_to_go() -> None:
    with pytest.raises(ModelError, match=r"mirrors the first.*`orbits`"):
        simulate(BLOCK, HARD, start=Steady())
    with pytest.raises(ModelError, match="`orbits`"):
        attractor(BARE, HARD, start=Steady())
    with pytest.raises(ModelError, match="`orbits`"):
        attractor_map(BARE, HARD, axes={"amplitude": [1.0, 2.0]}, start=Steady())
    with pytest.raises(ModelError, match="differ"):
        attractor_map(
            DimensionlessBlock(restitution=0.8),
            HARD,
            axes={"alpha_ratio": [1.0, 2.0]},
            start=Steady(),
        )
    with pytest.raises(ModelError, match="`orbits`"):
        response_curve(BLOCK, 2.0, frequency_ratio=[2.0, 3.0])
    orbit = attractor(UNLIKE, HARD).orbit
    assert orbit is not None
    with pytest.raises(ModelError, match="attractor_trail"):
        next(iter(continuation(orbit, "amplitude", (1.0, 3.0))))
    with pytest.raises(ModelError, match="attractor_trail"):
        bifurcation_branches([orbit], "amplitude", (1.0, 3.0))


def test_sizes_and_housners_value_move_with_symmetric_blocks_alone() -> None:
    with pytest.raises(ModelError, match="sides of this block differ"):
        attractor_map(BLOCK, HARD, axes={"width": [0.3, 0.4]})
    with pytest.raises(ModelError, match="differ"):
        attractor_map(BLOCK, HARD, axes={"amplitude": [1.0, 2.0]}, housner=True)
    with pytest.raises(ModelError, match=r"follow from its shape; take block.dimensionless"):
        attractor_map(BLOCK, HARD, axes={"alpha_ratio": [1.0, 2.0]})
