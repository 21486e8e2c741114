"""Orbits, attractors, maps and basins of blocks whose sides differ, and what they do not have."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    State,
    Status,
    Steady,
    compute_basins,
    compute_erosion,
    compute_response_curve,
    find_attractor,
    find_orbits,
    map_attractors,
    map_fates,
    simulate,
)
from rocksteady.dynamics.steady.heteroclinic import tangency_amplitude
from rocksteady.errors import ModelError
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.histories import ImpactState
from rocksteady.orbits import ReturnMap, sweep_attractor
from tests.dynamics.asymmetric import ASYMMETRY, BARE, BLOCK, HARD

# ------------------------------------------------------------------ orbits, attractors, maps


def test_the_return_map_has_the_derivative_of_its_differences() -> None:
    step = ReturnMap(ASYMMETRY, HARD)
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
    found = find_attractor(ASYMMETRY, HARD)
    assert found.kind == "unsymmetric"
    assert found.orbit is not None
    late = simulate(ASYMMETRY, HARD, cycles=400).impacts
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
    found = find_orbits(block, shaking, max_period=1, max_impacts=2, seeds=32)
    other = find_orbits(
        image, replace(shaking, amplitude=1.6), max_period=1, max_impacts=2, seeds=32
    )
    assert len(found) == len(other) > 0
    for orbit in found:
        assert not orbit.symmetric
        assert orbit.branch is None
        assert orbit.residual < 1e-12
        run = simulate(block, orbit.motion, start=orbit.start, cycles=1)
        assert float(run(run.end_time_pt).angle) == pytest.approx(0.0, abs=1e-6)
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
    for block in (ASYMMETRY, BLOCK):
        kinds = map_attractors(block, axes=axes, start=start)
        fates = map_fates(block, axes=axes, start=start, cycles=50)
        for amplitude in amplitudes:
            for ratio in ratios:
                shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
                here = {"amplitude": amplitude, "frequency_ratio": ratio}
                one = find_attractor(block, shaking, start=start)
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
    fates = map_fates(ASYMMETRY, HARD, axes=axes, start=State(angle=0.0, velocity=0.6), cycles=30)
    found = map_attractors(
        DimensionlessBlock(restitution=0.8), HARD, axes={**axes, "p_ratio": [0.9, 1.0]}
    )
    kinds = found.kind.attrs["flag_meanings"].split()
    for ratio in axes["alpha_ratio"]:
        for restitution in axes["restitution"]:
            block = replace(ASYMMETRY.with_restitution(restitution), alpha_ratio=ratio)
            run = simulate(block, HARD, start=State(angle=0.0, velocity=0.6), cycles=30)
            assert int(fates.fate.sel(alpha_ratio=ratio, restitution=restitution)) == int(
                run.status
            )
            for p_ratio in (0.9, 1.0):
                body = DimensionlessBlock(
                    restitution=restitution, alpha_ratio=ratio, p_ratio=p_ratio
                )
                cell = found.sel(alpha_ratio=ratio, restitution=restitution, p_ratio=p_ratio)
                assert kinds[int(cell.kind)] == find_attractor(body, HARD).kind
    other = map_attractors(
        DimensionlessBlock(restitution=0.8), HARD, axes={"negative_restitution": [0.7, 0.8]}
    )
    assert [kinds[kind] for kind in other.kind.values.tolist()] == ["unsymmetric", "symmetric"]


def test_basins_go_where_single_motions_go() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    window = np.linspace(-0.6, 0.6, 7)
    found = compute_basins(ASYMMETRY, shaking, angles=window, velocities=window / 2.0)
    for i, velocity in enumerate(found.velocity.tolist()):
        for j, angle in enumerate(found.angle.tolist()):
            start = State(angle=angle, velocity=velocity)
            one = find_attractor(ASYMMETRY, found.motion, start=start, max_cycles=500)
            where = found.attractors[int(found.label[i, j])]
            assert where.kind == one.kind
            if one.orbit is not None:
                assert where.orbit is not None
                assert where.orbit.highest == pytest.approx(one.orbit.highest, abs=1e-9)
    wide = compute_basins(ASYMMETRY, shaking, max_cycles=20, velocities=window)
    assert wide.angle[-1] > 1.3
    assert found.to_dataset().attrs["alpha_ratio"] == 1.3


def test_erosion_counts_the_states_that_single_runs_leave_standing() -> None:
    window = np.linspace(-1.435, 1.435, 15)
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    found = compute_erosion(
        ASYMMETRY, motion, [0.0, 1.0], angles=window, velocities=window, cycles=20
    )
    for k, amplitude in enumerate((0.0, 1.0)):
        for i, j in ((7, 7), (3, 9), (10, 2), (7, 1), (7, 13), (1, 7)):
            run = simulate(
                ASYMMETRY,
                Harmonic(amplitude=amplitude, frequency_ratio=2.0),
                start=State(angle=float(window[j]), velocity=float(window[i])),
                cycles=20,
            )
            assert found.safe[k, i, j] == (run.status is not Status.OVERTURNED)
    # At rest on a still base it stands wherever it leans less than its own alpha.
    assert found.safe[0, 7].tolist() == [-1.3 < angle < 1.0 for angle in window.tolist()]
    assert f"A = {found.heteroclinic:.4g}" in found._repr_html_()


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
    trail = sweep_attractor(ASYMMETRY, HARD, "restitution", [0.8, 0.7])
    assert trail.attractors[0].block == ASYMMETRY.with_restitution(0.8)
    assert set(trail.kinds) == {"unsymmetric"}


# ------------------------------------------------------------------ what there is not


def test_what_knows_symmetric_motions_alone_says_so_and_where_to_go() -> None:
    with pytest.raises(ModelError, match=r"mirrors the first.*`find_orbits`"):
        simulate(BLOCK, HARD, start=Steady())
    with pytest.raises(ModelError, match="`find_orbits`"):
        find_attractor(BARE, HARD, start=Steady())
    with pytest.raises(ModelError, match="`find_orbits`"):
        map_attractors(BARE, HARD, axes={"amplitude": [1.0, 2.0]}, start=Steady())
    with pytest.raises(ModelError, match="differ"):
        map_attractors(
            DimensionlessBlock(restitution=0.8),
            HARD,
            axes={"alpha_ratio": [1.0, 2.0]},
            start=Steady(),
        )
    with pytest.raises(ModelError, match="`find_orbits`"):
        compute_response_curve(BLOCK, 2.0, frequency_ratio=[2.0, 3.0])


def test_sizes_and_housners_value_move_with_symmetric_blocks_alone() -> None:
    with pytest.raises(ModelError, match="sides of this block differ"):
        map_attractors(BLOCK, HARD, axes={"width": [0.3, 0.4]})
    with pytest.raises(ModelError, match="differ"):
        map_attractors(BLOCK, HARD, axes={"amplitude": [1.0, 2.0], "restitution": "housner"})
    with pytest.raises(ModelError, match=r"follow from its shape; take block.dimensionless"):
        map_attractors(BLOCK, HARD, axes={"alpha_ratio": [1.0, 2.0]})
