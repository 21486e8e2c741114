"""Blocks on recorded ground: each fares as in a time history of its own."""

import math
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block, Record, Status, simulate
from rocksteady.errors import InputError
from rocksteady.histories import Trajectory
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.machine_code.device import Form, on_device
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.seismic.spectra.batch import (
    Fared,
    GroundShaking,
    rectangles_in_si,
    scattered_sides,
    shaken_fates,
    sides_in_si,
)
from tests.every import every
from tests.seismic.grounds import ground, lifting

BLOCKS = (
    Block.rectangle(width=0.4, height=1.6),
    Block.rectangle(width=0.5, height=1.2, restitution=0.7),
    Block.asymmetric(left=0.25, right=0.4, height=2.4),
    Block.asymmetric(left=0.4, right=0.25, height=1.6, restitution=(0.9, 0.7)),
    Block.general(mass=100.0, inertia=90.0, radius=0.8, alpha=0.2),
)
FACTORS = (0.5, 1.0, 2.0)


def fared(
    ground: GroundShaking, blocks: tuple[Block, ...], factors: tuple[float, ...], model: Model
) -> Fared:
    """Return how each block fares with each factor."""
    cases = list(product(blocks, factors))
    return shaken_fates(
        [ground],
        ground=np.zeros(len(cases), dtype=np.int64),
        scale=np.array([factor for _, factor in cases]),
        sides=np.stack([sides_in_si(block, model) for block, _ in cases]),
        gravity=np.full(len(cases), BLOCKS[0].gravity),
    )


def history(
    block: Block, record: Record, vertical: Record | None, factor: float, model: Model
) -> Trajectory:
    lifted = None if vertical is None else vertical.scaled(factor)
    return simulate(block, BaseMotion(record.scaled(factor), lifted), model=model)


@every(("model", "vertical"), [(Linear(), None), (Nonlinear(), None), (Nonlinear(), lifting())])
def test_blocks_of_any_kind_fare_as_in_time_histories(
    model: Model, vertical: Record | None
) -> None:
    record = ground(peak=9.0)
    found = fared(GroundShaking(record=record, vertical=vertical), BLOCKS, FACTORS, model)
    for cell, (block, factor) in enumerate(product(BLOCKS, FACTORS)):
        run = history(block, record, vertical, factor, model)
        assert found.status[cell] == run.status
        assert found.peak_angle[cell] == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
        assert found.peak_velocity[cell] == pytest.approx(run.peak_velocity, rel=1e-8, abs=1e-15)
        assert found.impacts[cell] == run.impact_count
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.tolist())


def test_a_base_that_falls_away_is_told() -> None:
    up = Record(acceleration_m_s2=np.array([0.0, -9.0, 0.0]), dt_s=1.0)
    found = fared(GroundShaking(record=ground(), vertical=up), BLOCKS[:1], (0.5, 1.5), Nonlinear())
    assert found.status.tolist() == [Status.AT_REST, Status.LOST_CONTACT]


@pytest.mark.slow
def test_a_block_without_loss_is_followed_for_long_and_no_longer() -> None:
    block = Block.rectangle(width=0.4, height=1.6, restitution=1.0)
    found = fared(GroundShaking(record=ground(peak=2.6)), (block,), (1.0,), Linear())
    run = history(block, ground(peak=2.6), None, 1.0, Linear())
    assert run.status is Status.ROCKING
    assert found.status.tolist() == [Status.ROCKING]
    assert found.peak_angle[0] == pytest.approx(run.peak, rel=1e-9)


@every("model", [Linear(), Nonlinear()])
@every("restitution", ["housner", 0.8])
def test_rectangles_are_blocks_from_alpha_and_p_to_the_last_bit(
    model: Model, restitution: float
) -> None:
    alpha, p = np.array([0.1, 0.2, 0.35]), np.array([1.0, 2.5, 4.0])
    sides = rectangles_in_si(alpha=alpha, p=p, restitution=restitution, gravity=9.81, model=model)
    for cell in range(3):
        block = Block.from_p(alpha=alpha[cell], p=p[cell], restitution=restitution, gravity=9.81)
        np.testing.assert_array_equal(sides[cell], sides_in_si(block, model))


def test_each_cell_takes_its_own_ground_in_any_order() -> None:
    grounds = [GroundShaking(record=ground(seed=seed), vertical=lifting()) for seed in (1, 2)]
    order, factors = np.array([0, 1, 1, 0, 1]), np.array([1.0, 1.0, 2.0, 2.0, 1.0])
    gravity = np.full(5, 9.80665)
    sides = np.repeat(sides_in_si(BLOCKS[0], Nonlinear())[np.newaxis], 5, axis=0)
    together = shaken_fates(grounds, ground=order, scale=factors, sides=sides, gravity=gravity)
    for cell in range(5):
        here = slice(cell, cell + 1)
        alone = shaken_fates(
            [grounds[order[cell]]],
            ground=np.zeros(1, dtype=np.int64),
            scale=factors[here],
            sides=sides[here],
            gravity=gravity[here],
        )
        assert [column[cell] for column in together] == [column[0] for column in alone]
    assert together.peak_angle[1] == together.peak_angle[4]
    assert len(set(together.peak_velocity.tolist())) == 4


def test_the_peak_velocity_is_that_of_the_sampled_time_history() -> None:
    models: tuple[Model, ...] = (Linear(), Nonlinear())
    for block, model in product(BLOCKS, models):
        run = simulate(block, ground(), model=model)
        end = run.end_time_pt if run.overturn_time_pt is None else run.overturn_time_pt
        sampled = float(np.abs(run(np.linspace(0.0, min(end, 40.0), 20_000)).velocity).max())
        before = np.abs(run.impacts.velocity_before[run.impacts.pt <= end])
        top = max(sampled, float(before.max(initial=0.0)))
        assert top <= run.peak_velocity * (1.0 + 1e-12)
        assert math.isclose(top, run.peak_velocity, rel_tol=1e-3)


class Every:
    """A device that has room for every other block only."""

    def __init__(self) -> None:
        self.ran: list[str] = []

    def run(self, form: Form, arguments: tuple[Any, ...]) -> None:
        self.ran.append(form.queued.__name__)
        record_fates(*arguments)
        arguments[-1].status[::2] = LEFT_OVER
        arguments[-1].peaks[::2] = np.nan


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_what_a_device_leaves_over_is_followed_on_the_host(model: Model) -> None:
    shaking, device = GroundShaking(record=ground(peak=9.0)), Every()
    wanted = fared(shaking, BLOCKS, FACTORS, model)
    with on_device(device):
        found = fared(shaking, BLOCKS, FACTORS, model)
    nonlinear = "nonlinear_" if model == Nonlinear() else ""
    assert device.ran == [f"queued_{nonlinear}record_fates"]
    for one, other in zip(found, wanted, strict=True):
        np.testing.assert_array_equal(one, other)


@every(("model", "vertical"), [(Linear(), None), (Nonlinear(), None), (Nonlinear(), lifting())])
def test_without_peaks_the_fates_are_the_same(model: Model, vertical: Record | None) -> None:
    """Also of blocks of two gravities, whose vertical motion counts in their own."""
    record = ground(peak=9.0)
    moon = Block.rectangle(width=0.4, height=1.6, gravity=4.0)
    cases = list(product((*BLOCKS, moon), FACTORS))
    whole, bare = (
        shaken_fates(
            [GroundShaking(record=record, vertical=vertical)],
            ground=np.zeros(len(cases), dtype=np.int64),
            scale=np.array([factor for _, factor in cases]),
            sides=np.stack([sides_in_si(block, model) for block, _ in cases]),
            gravity=np.array([block.gravity for block, _ in cases]),
            peaks=peaks,
        )
        for peaks in (True, False)
    )
    np.testing.assert_array_equal(whole.status, bare.status)
    np.testing.assert_array_equal(whole.impacts, bare.impacts)
    assert np.isnan(bare.peak_angle).all()
    assert np.isnan(bare.peak_velocity).all()
    for cell in range(len(cases) - len(FACTORS), len(cases)):
        run = history(moon, record, vertical, cases[cell][1], model)
        assert whole.status[cell] == run.status
        assert whole.peak_angle[cell] == pytest.approx(run.peak, rel=1e-8, abs=1e-15)


def test_no_cells_have_no_fates() -> None:
    none = np.empty(0)
    found = shaken_fates(
        [], ground=np.empty(0, dtype=np.int64), scale=none, sides=np.empty((0, 2, 3)), gravity=none
    )
    assert [len(column) for column in found] == [0] * 4


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_scatter_is_drawn_by_key_in_any_order_of_cells(model: Model) -> None:
    count = 24
    shaking = [GroundShaking(record=ground(peak=9.0))]
    number, gravity = np.zeros(count, dtype=np.int64), np.full(count, 9.80665)
    sides = np.repeat(sides_in_si(BLOCKS[3], model)[np.newaxis], count, axis=0)
    keys, factors = np.arange(count) // 2 + 2**52, np.ones(count)

    def found(deviation: float, keys: NDArray[np.int64]) -> Fared:
        wide = scattered_sides(sides, np.full(count, deviation), keys)
        return shaken_fates(shaking, ground=number, scale=factors, sides=wide, gravity=gravity)

    plain = shaken_fates(shaking, ground=number, scale=factors, sides=sides, gravity=gravity)
    for column, same in zip(plain, found(0.0, keys), strict=True):
        np.testing.assert_array_equal(column, same)
    one, other = found(0.08, keys), found(0.08, keys[::-1].copy())
    for column, turned in zip(one, other, strict=True):
        np.testing.assert_array_equal(column, turned[::-1])
        np.testing.assert_array_equal(column[::2], column[1::2])  # two cells have each key
    assert len(set(one.peak_velocity.tolist())) == count // 2


@every(
    ("deviation", "keys", "name"),
    [
        (-0.1, 0, "deviation"),
        (1.1, 0, "deviation"),
        (math.nan, 0, "deviation"),
        (0.1, -1, "keys"),
        (0.1, 2**53, "keys"),
    ],
)
def test_scatter_and_keys_have_bounds(deviation: float, keys: int, name: str) -> None:
    sides = sides_in_si(BLOCKS[0], Linear())[np.newaxis]
    with pytest.raises(InputError, match=name):
        scattered_sides(sides, np.array([deviation]), np.array([keys]))
