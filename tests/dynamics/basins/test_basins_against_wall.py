"""Basins and erosion of a block against a wall: each state as alone, a still base, refusals."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Rest,
    State,
    Status,
    compute_basins,
    compute_erosion,
    find_attractor,
    plots,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.every import every

Floats = NDArray[np.float64]

WALL = DimensionlessBlock(restitution=0.3, one_sided=True)
FACADE = Block.rectangle(width=0.3, height=3.0).against_wall()
SHAKING = Harmonic(amplitude=1.3, frequency_ratio=5.0, phase=0.4)
ANGLES = (np.arange(9) + 0.5) * 0.12
VELOCITIES = np.linspace(-1.2, 1.2, 13)
WINDOW: dict[str, Any] = {"angles": ANGLES, "velocities": VELOCITIES}


@every("seed", [None, 3])
@every(
    ("block", "model"),
    [(WALL, Linear()), (FACADE, Linear()), (FACADE, Nonlinear())],
)
def test_each_state_goes_where_it_goes_alone(block: Any, model: Model, seed: int | None) -> None:
    found = compute_basins(block, SHAKING, model=model, seed=seed, **WINDOW)
    assert (found.start_angle > 0.0).all()
    looked = 0
    for row in range(len(VELOCITIES)):
        for column in range(len(ANGLES)):
            start = found.state(row, column)
            alone = find_attractor(block, found.motion, start=start, max_cycles=500, model=model)
            if alone.growth > 1e10:
                continue
            looked += 1
            attractor = found.attractors[int(found.label[row, column])]
            assert attractor.kind is alone.kind
            if alone.orbit is not None:
                assert attractor.orbit is not None
                assert attractor.period == alone.period
                assert attractor.impacts == alone.orbit.impacts
                assert attractor.orbit.highest == pytest.approx(alone.orbit.highest, abs=1e-9)
                assert attractor.orbit.lowest == 0.0
    assert looked > 60
    assert len(found.attractors) >= 2
    text = str(found.describe().headline)
    assert "against a wall" in text


def test_by_default_the_window_begins_at_the_wall() -> None:
    found = compute_basins(WALL, Harmonic(amplitude=0.8, frequency_ratio=2.0), max_cycles=50)
    assert found.angle == pytest.approx((np.arange(144) + 0.5) * 1.2 / 144)
    half = 1.5 / 108
    assert found.velocity[[0, -1]] == pytest.approx([half - 1.5, 1.5 - half])
    axes = plots.basins(found)
    assert axes.get_xlim() == pytest.approx((0.0, 1.2))
    # Below uplift all that do not fall come to rest; which ones fall hangs on the shaking.
    names = [attractor.name for attractor in found.attractors]
    assert names == ["overturned", "rest"]
    assert isinstance(found.attractors[1].start, Rest)
    data = found.to_dataset()
    assert data.attrs["restitution"] == 0.3
    assert data.attrs["one_sided"] == 1
    assert "negative_restitution" not in data.attrs


@pytest.mark.slow
@every("e", [0.0, 0.5, 0.8])
def test_the_safe_basin_of_a_still_base_is_known(e: float) -> None:
    block = DimensionlessBlock(restitution=e, one_sided=True)
    motion = Harmonic(amplitude=1.0, frequency_ratio=3.0)
    found = compute_erosion(block, motion, [0.0, 0.1])
    assert (found.angle > 0.0).all()
    u, v = np.meshgrid(found.angle, found.velocity)
    landing = np.sqrt(np.maximum(v**2 - (1.0 - u) ** 2 + 1.0, 0.0))
    safe = (u + v < 1.0) & (e * landing < 1.0)
    assert (found.safe[0] == safe).all()
    # The largest circle between the wall, the line of those that fall at once and the hyperbola of
    # those that fall off the wall, by the distances of many centres from many points of each.
    edges = [np.column_stack([np.zeros(400), np.linspace(-4, 4, 400)])]
    edges.append(np.column_stack([np.linspace(0, 6, 600), 1.0 - np.linspace(0, 6, 600)]))
    if e > 0.0:
        ahead = np.linspace(0, 6, 600)
        edges.append(np.column_stack([ahead, -np.sqrt(1.0 / e**2 - 1.0 + (1.0 - ahead) ** 2)]))
        centres = np.stack(
            np.meshgrid(np.linspace(0.01, 2.0, 60), np.linspace(-2.0, 0.9, 88)), axis=-1
        ).reshape(-1, 2)
        inside = centres.sum(axis=1) < 1.0
        x = centres[:, 0]
        inside &= centres[:, 1] > -np.sqrt(1.0 / e**2 - 1.0 + (1.0 - x) ** 2)
        points = np.concatenate(edges)
        apart = np.linalg.norm(centres[inside, np.newaxis] - points, axis=2).min(axis=1)
        step = float(np.diff(found.velocity)[0])
        assert found.still_radius == pytest.approx(apart.max(), abs=0.05 + 2.0 * step)
    assert found.heteroclinic is None
    axes = plots.safe_basin(found, 0)
    assert axes.get_xlim()[0] == pytest.approx(0.0, abs=1e-9)


def test_each_state_is_as_safe_as_it_is_alone() -> None:
    found = compute_erosion(WALL, SHAKING, [0.8, 1.6], cycles=30, **WINDOW)
    for which, amplitude in enumerate(found.amplitude.tolist()):
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=5.0, phase=found.motion.phase)
        for row, velocity in enumerate(VELOCITIES.tolist()):
            for column, angle in enumerate(ANGLES.tolist()):
                run = simulate(
                    WALL, shaking, start=State(angle=angle, velocity=velocity), cycles=30
                )
                assert found.safe[which, row, column] == (run.status is not Status.OVERTURNED)
    assert 0.1 < found.safe.mean() < 0.9
    assert any("one saddle" in fact.words for fact in found.describe().facts)


def test_executors_agree_to_the_bit() -> None:
    def basins(run: Execution) -> Any:
        return compute_basins(FACADE, SHAKING, run=run, seed=1, **WINDOW).to_dataset()

    assert basins(Execution(executor="serial")).identical(basins(Execution(workers=2)))


@every(
    "given",
    [
        {"angles": np.linspace(-1.0, 1.0, 5)},
        {"angles": np.linspace(0.0, 1.0, 5)},
        {"angles": np.linspace(0.05, 1.0, 5), "seed": 1},
    ],
)
def test_states_behind_the_wall_are_refused(given: Any) -> None:
    with pytest.raises(ModelError, match=r"angles begin at.*against a wall.*above 0") as error:
        compute_basins(WALL, SHAKING, **given)
    assert "\n" not in str(error.value)
    if "seed" not in given:
        with pytest.raises(ModelError, match="angles begin at"):
            compute_erosion(WALL, SHAKING, [0.5], **given)


def test_at_angle_0_a_block_leaves_the_wall() -> None:
    axes: dict[str, Any] = {"angles": [0.0, 0.1, 0.2], "velocities": [0.0, 0.2, 0.4]}
    found = compute_basins(WALL, SHAKING, **axes)
    for row, velocity in enumerate(axes["velocities"]):
        alone = find_attractor(
            WALL, found.motion, start=State(angle=0.0, velocity=velocity), max_cycles=500
        )
        assert found.attractors[int(found.label[row, 0])].kind is alone.kind
