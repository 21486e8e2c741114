"""How arrays of motions end: each as its time history does."""

import numpy as np
import pytest

from rocksteady import Status, simulate
from rocksteady.arrays import Integers
from rocksteady.dynamics.batch import fates
from rocksteady.dynamics.batch.fates import ENDS, batch_size, ends_of
from rocksteady.histories import Trajectory
from rocksteady.kernels.machine_code.device import on_device
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.dynamics.batch.cells import Cells, random_cells
from tests.kernels.queued import Workers

CYCLES = 20
models = pytest.mark.parametrize(("model", "count"), [(Linear(), 120), (Nonlinear(), 40)])


def ended(cells: Cells, cycles: int = CYCLES) -> Integers:
    return ends_of(
        amplitude=cells.amplitude,
        frequency_ratio=cells.frequency_ratio,
        sides=cells.sides,
        angle=cells.angle,
        velocity=cells.velocity,
        phase=cells.phase,
        cycles=cycles,
        harmonics=(),
    )


def histories(cells: Cells) -> list[Trajectory]:
    return [
        simulate(block, shaking, start=start, cycles=CYCLES, model=cells.model)
        for block, shaking, start in zip(cells.blocks, cells.shakings, cells.starts, strict=True)
    ]


@models
def test_each_motion_ends_as_its_time_history_does(model: Model, count: int) -> None:
    # Cells of one call have equal and unequal sides in turn: in the linear model they are dealt to
    # two kernels.
    cells = random_cells(8, model, count)
    status = ended(cells)
    assert status.tolist() == [run.status for run in histories(cells)]
    assert {Status.ROCKING, Status.AT_REST, Status.OVERTURNED} <= set(status.tolist())
    assert set(status.tolist()) <= set(ENDS)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of kernels that nothing compiles
@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_a_device_runs_the_kernels_of_the_model_and_gives_the_same_ends(model: Model) -> None:
    cells, device = random_cells(3, model, 8), Workers(2)
    with on_device(device):
        found = ended(cells, 5)
    np.testing.assert_array_equal(found, ended(cells, 5))
    assert device.ran == ["lane_fates" if model == Linear() else "nonlinear_lane_fates"]


@models
def test_a_cell_depends_on_nothing_but_the_cell(model: Model, count: int) -> None:
    cells = random_cells(9, model, count)
    status = ended(cells)
    order = np.random.default_rng(1).permutation(count)
    for picked in (order, order[: count // 7], order[:1]):
        some = Cells(
            model=model,
            blocks=[cells.blocks[at] for at in picked],
            shakings=[cells.shakings[at] for at in picked],
            starts=[cells.starts[at] for at in picked],
        )
        np.testing.assert_array_equal(ended(some), status[picked])


@models
def test_a_motion_of_more_impacts_than_are_followed_is_undecided(
    model: Model, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    cells = random_cells(8, model, count)
    status = ended(cells)
    # Before slow impacts end, rest may be proved.
    speeds = [np.abs(run.impacts.velocity_after) for run in histories(cells)]
    impacts, fast = (np.array([np.sum(v >= least) for v in speeds]) for least in (0.0, 0.02))
    monkeypatch.setattr(fates, "MOST_IMPACTS", 8)
    given_up = ended(cells)
    many, few = fast > 12, impacts < 4
    assert many.any()
    assert few.any()
    np.testing.assert_array_equal(given_up[few], status[few])
    undecided = given_up == Status.UNDECIDED
    # Impacts of periods leapt over do not count; the march of unequal sides does not leap.
    leapt = many & ~undecided
    np.testing.assert_array_equal(given_up[leapt], status[leapt])
    assert isinstance(model, Nonlinear) or not leapt[1::2].any()
    assert np.count_nonzero(undecided) > np.count_nonzero(many) // 2


def test_the_longer_motions_are_followed_the_fewer_make_a_piece() -> None:
    assert [batch_size(cycles) for cycles in (1, 200, 1000, 10**6)] == [4096, 4096, 1000, 1]
