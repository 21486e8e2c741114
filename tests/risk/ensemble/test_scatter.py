"""Restitution that scatters from impact to impact, in an ensemble: draws, seeds, workers."""

import functools

import numpy as np
import pytest
import xarray

from rocksteady import BaseMotion, Execution, Record, run_ensemble
from rocksteady.risk import Levels, RestitutionBand
from rocksteady.sweeps import evaluate
from tests.every import every
from tests.risk.ensemble.test_runs import OFF_CENTRE, SYMMETRIC, assert_same
from tests.seismic.grounds import ground, lifting

BLOCKS = (SYMMETRIC, OFF_CENTRE, OFF_CENTRE.against_wall(0.5))
FIRST, *OTHERS = (ground(seed, peak=4.0, name=f"ground {seed}") for seed in range(3))
SUITE: tuple[Record | BaseMotion, ...] = (BaseMotion(FIRST, lifting()), *OTHERS)


def computed(scatter: float = 0.05, seed: int = 0, run: Execution | None = None) -> xarray.Dataset:
    band = RestitutionBand(low=0.9, high=0.9, draws=6, scatter=scatter, seed=seed)
    levels = Levels("scale", [0.8, 1.6], beside=())
    return run_ensemble(BLOCKS, SUITE, levels=levels, restitution=band, run=run)


scattered = functools.cache(computed)


def test_draws_of_one_mean_differ_and_without_scatter_are_one() -> None:
    still = scattered(0.0)
    np.testing.assert_array_equal(still.peak_angle, still.peak_angle.isel(draw=[0] * 6))
    found = scattered()
    rocked = still.impacts.isel(draw=0) > 2
    assert int(rocked.sum()) > 10
    peaks = found.peak_angle.transpose(..., "draw").values.reshape(-1, 6)
    several = [len(set(cell.tolist())) for cell in peaks]
    lively = rocked.values.ravel()
    assert np.mean(np.array(several)[lively] == 6) > 0.8
    assert (found.peak_angle.isel(block=2).std("draw") > 0.0).any()  # at a wall too
    # No impact, no draw: where nothing rocks, and until the first impact.
    np.testing.assert_array_equal(found.uplift_time_s, still.uplift_time_s)


def test_small_scatter_stays_near_the_run_without() -> None:
    still, near = scattered(0.0), scattered(1e-9)
    same = (still.status == near.status) & (still.status != 2)
    assert float(same.mean()) > 0.5
    differ = abs(still.peak_angle - near.peak_angle).where(same)
    assert float(differ.median()) < 1e-6


def test_a_seed_gives_its_own_draws_and_the_same_again() -> None:
    other = scattered(seed=1)
    assert_same(computed(), scattered())
    assert not np.array_equal(other.peak_angle, scattered().peak_angle)
    assert scattered().attrs["scatter"] == 0.05
    assert other.attrs["seed"] == "1"


@every(
    "run",
    [
        Execution(executor="serial"),
        *(Execution(executor="threads", workers=count) for count in (1, 2, 3)),
    ],
)
def test_workers_do_not_change_a_bit(run: Execution) -> None:
    assert_same(computed(run=run), scattered())


def test_small_batches_give_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    small = functools.partial(evaluate, batch=7)
    monkeypatch.setattr("rocksteady.risk.ensemble.runs.evaluate", small)
    assert_same(computed(), scattered())


def test_a_symmetric_blocks_mirror_image_has_the_same_draws() -> None:
    found = scattered().isel(block=0)
    assert_same(found.isel(direction=0), found.isel(direction=1))
