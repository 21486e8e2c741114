"""The safe basin: states beside time histories, and its measures beside brute force."""

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Execution, Harmonic, State, Status, simulate
from rocksteady.dynamics.basins._safe import measured, safe_states
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.every import every

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)


@every(
    ("block", "model"),
    [
        (DimensionlessBlock(restitution=0.8), Linear()),
        (LEANING, Linear()),
        (LEANING, Nonlinear()),
    ],
)
def test_a_state_is_safe_where_its_time_history_does_not_overturn(
    block: Block | DimensionlessBlock, model: Model
) -> None:
    amplitudes, angles, velocities = (
        [0.0, 1.5],
        np.linspace(-1.1, 1.1, 6),
        np.linspace(-0.5, 0.5, 4),
    )
    safe = safe_states(
        sides=model.sides(block),
        frequency_ratio=2.0,
        phase=0.7,
        harmonics=(),
        amplitudes=amplitudes,
        angles=angles,
        velocities=velocities,
        cycles=15,
        run=Execution(executor="serial", workers=None),
    )
    assert safe.shape == (2, 4, 6)
    for at, amplitude in enumerate(amplitudes):
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=2.0, phase=0.7)
        for row, rate in enumerate(velocities.tolist()):
            for column, angle in enumerate(angles.tolist()):
                start = State(angle=angle, velocity=rate)
                run = simulate(block, shaking, start=start, cycles=15, model=model)
                assert safe[at, row, column] == (run.status is not Status.OVERTURNED)
    assert safe.any()
    assert not safe.all()


@every("seed", range(8))
def test_the_largest_circle_is_that_of_brute_force(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angles, velocities = np.linspace(-1.0, 1.0, 13), np.linspace(-0.4, 0.4, 9)
    safe = rng.random((9, 13)) < 0.85
    share, radius = measured(safe, angles, velocities)
    assert share == safe.sum() / safe.size
    # The nearest state that is not safe; all beyond the window are none.
    du, dv = angles[1] - angles[0], velocities[1] - velocities[0]
    wide = np.pad(safe, 3)
    v, u = np.meshgrid(dv * np.arange(-3, 12), du * np.arange(-3, 16), indexing="ij")
    away = [
        np.hypot(u[~wide] - du * column, v[~wide] - dv * row).min()
        for row, column in zip(*np.nonzero(safe), strict=True)
    ]
    assert radius == pytest.approx(max(away))


def test_of_no_safe_state_there_is_no_circle() -> None:
    axis = np.linspace(-1.0, 1.0, 5)
    assert measured(np.zeros((5, 5), dtype=np.bool_), axis, axis) == (0.0, 0.0)
    share, radius = measured(np.ones((5, 5), dtype=np.bool_), axis, axis)
    assert share == 1.0
    assert radius == pytest.approx(1.5)  # three steps to what is not known
