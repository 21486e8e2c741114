"""Numbers of impacts: every result counts those that a time history has."""

import math
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    State,
    compute_fate_basins,
    compute_rocking_spectrum,
    find_fatal_kicks,
    find_overturning_scales,
    find_overturning_windows,
    map_fates,
    simulate,
    simulate_many,
)
from rocksteady.dynamics.history.samples import COUNTED_IMPACTS
from rocksteady.histories import Trajectory
from rocksteady.overturning import OverturningWindow
from tests.records import synthetic

BARE = DimensionlessBlock(restitution=0.5)
BLOCK = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
LONG = Pulse(shape="type-c2", amplitude=3.0, frequency_ratio=1.5)
RECORD = Record(acceleration_m_s2=synthetic(np.random.default_rng(3), 400, 0.02, 5.0), dt_s=0.02)
WITHIN = 1.0 + 1e-12
"""Just inside a window."""


def chatters(run: Trajectory) -> bool:
    """Return whether a run has slow impacts, which a proof of rest might leave out."""
    return bool((np.abs(run.impacts.velocity_after) < 1e-3).any())


def wide(windows: tuple[OverturningWindow, ...]) -> list[OverturningWindow]:
    """Return the windows whose lower end is known well enough to run just inside."""
    return [window for window in windows if window.high > window.low * (1.0 + 1e-9)]


def named(dataset: xarray.Dataset) -> xarray.Dataset:
    assert dataset["impacts"].attrs["long_name"].startswith(COUNTED_IMPACTS)
    return dataset


def test_batches_on_records_count_the_impacts_of_the_run() -> None:
    cells: list[tuple[int, Trajectory]] = []
    scales = [0.6, 0.9, 1.2]
    for model in (Linear(), Nonlinear()):
        runs = [simulate(BLOCK, RECORD.scaled(scale), model=model) for scale in scales]
        many = named(simulate_many(BLOCK, RECORD, scales=scales, model=model))
        cells += zip(many["impacts"].values.ravel().tolist(), runs, strict=True)
        spectrum = named(
            compute_rocking_spectrum(
                RECORD,
                alpha=BLOCK.alpha,
                periods_s=2.0 * math.pi / BLOCK.p,
                restitution=0.8,
                scales=scales,
                model=model,
            )
        )
        cells += zip(spectrum["impacts"].values.ravel().tolist(), runs, strict=True)
    assert [count for count, _ in cells] == [run.impact_count for _, run in cells]
    assert sum(chatters(run) for _, run in cells) > len(cells) // 2


@pytest.mark.parametrize("block", [BARE, Block.from_p(alpha=0.2, p=2.0, restitution=0.5)])
def test_windows_count_the_impacts_of_the_run_at_their_lower_end(block: Any) -> None:
    model = Nonlinear() if isinstance(block, Block) else Linear()
    found = find_overturning_windows(block, LONG.shape, [1.5], within=(1.0, 12.0), model=model)
    named(found.to_dataset())
    chattered = 0
    for window in wide(found.at(0)):
        pulse = Pulse(shape=LONG.shape, amplitude=window.low * WITHIN, frequency_ratio=1.5)
        run = simulate(block, pulse, model=model)
        assert window.impacts == len(run.impacts)
        chattered += chatters(run)
    assert chattered > 3


def test_kicks_and_scales_count_the_impacts_of_the_run_at_their_lower_end() -> None:
    kicks = find_fatal_kicks(BARE, motion=LONG, times_pt=0.0)
    chattered = 0
    for row, sign in enumerate((1.0, -1.0)):
        for window in wide(kicks.at(row)):
            start = State(angle=0.0, velocity=sign * window.low * WITHIN)
            run = simulate(BARE, LONG, start=start)
            assert window.impacts == len(run.impacts)
            chattered += chatters(run)
    scales = find_overturning_scales(BLOCK, RECORD, within=(0.3, 4.0), model=Linear())
    named(scales.to_dataset())
    for window in wide(scales.at(0)):
        run = simulate(BLOCK, RECORD.scaled(window.low * WITHIN), model=Linear())
        assert window.impacts == len(run.impacts)
        chattered += chatters(run)
    assert chattered > 0


def test_fates_of_many_states_count_the_impacts_of_the_run() -> None:
    found = compute_fate_basins(BARE, LONG, angles=[-0.4, 0.0, 0.4], velocities=[-0.3, 0.0, 0.3])
    for cell in np.ndindex(found.fate.shape):
        run = simulate(BARE, LONG, start=found.state(*cell))
        assert found.impacts[cell] == run.impact_count
    named(found.to_dataset())


def test_fates_under_endless_shaking_have_no_number_of_impacts() -> None:
    axes = {"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 2.0]}
    assert list(map_fates(BARE, axes=axes, cycles=5).data_vars) == ["fate"]
