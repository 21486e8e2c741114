"""Fates in tests: each cell against a time history, draws, workers, stores, what is refused."""

import functools
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import BaseMotion, Block, Execution, Record, Status, Store, simulate
from rocksteady.calibration import Scatter, ShakingTest, compute_test_fates
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.risk.observations import fates as module
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.sweeps import evaluate
from tests.every import every
from tests.seismic.grounds import ground, lifting

NAMES = ("status", "peak_angle", "impacts")
SLOW = tuple(
    Record(acceleration_m_s2=each.acceleration_m_s2, dt_s=3.0 * each.dt_s, name=each.name)
    for each in (ground(seed, peak=5.0, samples=200, name=f"ground {seed}") for seed in (1, 2))
)


def drawn_blocks(count: int, seed: int = 3) -> list[Block]:
    """Return blocks of all kinds: two like sides, two unlike ones, another gravity."""
    rng = np.random.default_rng(seed)
    blocks = []
    for place in range(count):
        alpha, p = rng.uniform(0.1, 0.3), rng.uniform(1.5, 4.0)
        if place % 3 == 0:
            blocks.append(Block.from_p(alpha=alpha, p=p, restitution=rng.uniform(0.6, 0.95)))
        elif place % 3 == 1:
            left, right = rng.uniform(0.15, 0.4, 2)
            blocks.append(Block.asymmetric(left=left, right=right, height=rng.uniform(1.4, 3.0)))
        else:
            blocks.append(Block.from_p(alpha=alpha, p=p, gravity=rng.uniform(4.0, 12.0)))
    return blocks


def shaken(name: str, place: int = 0, **more: Any) -> ShakingTest:
    return ShakingTest(name=name, record=SLOW[place], object="column", **more)


TESTS = (
    shaken("as recorded"),
    shaken("turned", reversed=True, gain=1.3),
    shaken("other", 1, gain=0.8),
    shaken("weak", 1, gain=0.05),
)
LIFTED = (*TESTS, shaken("lifted", vertical=lifting()), shaken("both", 1, vertical=lifting(7)))
BLOCKS = drawn_blocks(6)
GAINS = (0.7, 1.0, 1.6)


def history(test: ShakingTest, block: Block, gain: float, model: Model) -> Any:
    """Return the time history of a cell, from the scaled records themselves."""
    factor = gain * test.gain * (-1.0 if test.reversed else 1.0)
    up = None if test.vertical is None else test.vertical.scaled(gain * test.gain)
    return simulate(block, BaseMotion(test.record.scaled(factor), up), model=model)


def assert_same(one: xarray.Dataset, other: xarray.Dataset) -> None:
    for name in NAMES:
        np.testing.assert_array_equal(one[name].values, other[name].values)


@pytest.mark.parametrize(("model", "tests"), [(Linear(), TESTS), (Nonlinear(), LIFTED)])
def test_each_cell_is_a_time_history(model: Model, tests: tuple[ShakingTest, ...]) -> None:
    found = compute_test_fates(BLOCKS, tests, gains=GAINS, model=model)
    assert dict(found.sizes) == {"test": len(tests), "block": 6, "gain": 3, "draw": 1}
    assert found.status.dtype == np.int8
    for (i, test), (j, block), (k, gain) in product(
        enumerate(tests), enumerate(BLOCKS), enumerate(GAINS)
    ):
        cell = found.isel(test=i, block=j, gain=k, draw=0)
        run = history(test, block, gain, model)
        assert cell.status == run.status
        assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
        assert cell.impacts == run.impact_count
        assert float(cell.scale) == pytest.approx(gain * test.gain, rel=1e-15)
    kinds = set(found.status.values.ravel().tolist())
    assert {Status.AT_REST, Status.OVERTURNED} <= kinds
    weak = found.sel(test="weak")
    assert (weak.peak_angle == 0.0).all()
    assert (weak.impacts == 0).all()


def test_observations_are_their_tests() -> None:
    column = ObjectPrior(name="column", width_m=0.3, height_m=1.2)
    known = Observations(tests=TESTS, objects={"column": column})
    assert_same(compute_test_fates(BLOCKS[:2], known), compute_test_fates(BLOCKS[:2], TESTS))


def test_coordinates_name_the_tests_and_their_objects() -> None:
    found = compute_test_fates(BLOCKS[0], TESTS, outputs=["status"])
    assert list(found.data_vars) == ["status"]
    assert found.test.values.tolist() == [test.name for test in TESTS]
    assert found.object.values.tolist() == ["column"] * 4
    assert found.status.attrs["flag_meanings"].split()[2] == "overturned"
    assert found.attrs["model"] == "nonlinear"
    assert "status" in found.rocksteady.summary()


@pytest.mark.parametrize("deviation", [0.0, 0.08])
def test_what_is_left_out_changes_nothing_else(deviation: float) -> None:
    scatter = Scatter(deviation, draws=2)
    whole = compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter)
    for name in NAMES:
        bare = compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter, outputs=[name])
        np.testing.assert_array_equal(bare[name], whole[name])


def test_gains_of_tests_and_of_blocks_are_those_of_single_calls() -> None:
    rng = np.random.default_rng(4)
    gains = rng.uniform(0.5, 2.0, (len(LIFTED), len(BLOCKS), 2))
    scatter = Scatter(0.05, draws=2, seed=5)
    found = compute_test_fates(BLOCKS, LIFTED, gains=gains, scatter=scatter)
    np.testing.assert_allclose(
        found.scale, gains * np.array([test.gain for test in LIFTED])[:, None, None], rtol=1e-15
    )
    for i, test in enumerate(LIFTED):
        each = np.broadcast_to(gains[i], (1, *gains[i].shape))
        alone = compute_test_fates(BLOCKS, [test], gains=each, scatter=scatter)
        assert_same(alone, found.isel(test=[i]))
    rows = gains[:, 0]
    found = compute_test_fates(BLOCKS, LIFTED, gains=rows)
    for i, test in enumerate(LIFTED):
        assert_same(compute_test_fates(BLOCKS, [test], gains=rows[i]), found.isel(test=[i]))


# ------------------------------------------------------------------------------------- scatter


@functools.cache
def scattered(model: Model | None = None) -> xarray.Dataset:
    return compute_test_fates(
        BLOCKS, LIFTED, gains=GAINS, scatter=Scatter(0.08, draws=3, seed=9), model=model
    )


def test_without_deviation_all_draws_are_the_run_without_scatter() -> None:
    still = compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=Scatter(0.0, draws=3))
    plain = compute_test_fates(BLOCKS, LIFTED, gains=GAINS)
    assert_same(still, plain.isel(draw=[0] * 3))
    impacts = plain.impacts.values[..., 0]
    differ = (scattered().peak_angle.values != plain.peak_angle.values).all(axis=-1)
    assert differ[impacts > 3].mean() > 0.8
    assert not differ[impacts == 0].any()


def test_only_blocks_with_a_deviation_scatter() -> None:
    deviation = np.array([0.0, 0.08, 0.0, 0.08, 0.08, 0.0])
    some = compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=Scatter(deviation, 3, 9))
    plain = compute_test_fates(BLOCKS, LIFTED, gains=GAINS).isel(draw=[0] * 3)
    places = deviation > 0.0
    assert_same(some.isel(block=places), scattered().isel(block=places))
    assert_same(some.isel(block=~places), plain.isel(block=~places))


def test_a_draw_keeps_its_bits_when_tests_blocks_gains_or_draws_are_added() -> None:
    scatter, more = Scatter(0.08, draws=2, seed=9), Scatter(0.08, draws=3, seed=9)
    assert_same(
        compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter),
        scattered().isel(draw=[0, 1]),
    )
    assert_same(
        compute_test_fates(BLOCKS[:4], LIFTED, gains=GAINS, scatter=more),
        scattered().isel(block=slice(4)),
    )
    assert_same(
        compute_test_fates(BLOCKS, LIFTED[3:1:-1], gains=GAINS, scatter=more),
        scattered().isel(test=[3, 2]),
    )
    # All gains of a block meet the same numbers: one gain twice is the same run twice.
    assert_same(
        compute_test_fates(BLOCKS, LIFTED, gains=[1.6, 1.6], scatter=more),
        scattered().isel(gain=[2, 2]),
    )


def test_tests_blocks_draws_and_seeds_draw_their_own_numbers() -> None:
    alike = [shaken(name) for name in ("one", "two", "three")]
    lively = Block.from_p(alpha=0.25, p=3.0, restitution=0.9)
    found = compute_test_fates([lively] * 3, alike, scatter=Scatter(0.05, draws=3, seed=1))
    assert len(set(found.peak_angle.values.ravel().tolist())) == 27
    other = compute_test_fates([lively] * 3, alike, scatter=Scatter(0.05, draws=3, seed=2))
    assert not set(other.peak_angle.values.ravel()) & set(found.peak_angle.values.ravel())


@every(
    "run",
    [
        Execution(executor="serial"),
        *(Execution(executor="threads", workers=count) for count in (1, 2, 3)),
    ],
)
@every("model", [Linear(), Nonlinear()])
def test_workers_do_not_change_a_bit(run: Execution, model: Model) -> None:
    tests = TESTS if isinstance(model, Linear) else LIFTED
    scatter = Scatter(0.08, draws=3, seed=9)
    found = compute_test_fates(BLOCKS, tests, gains=GAINS, scatter=scatter, model=model, run=run)
    if isinstance(model, Nonlinear):
        assert_same(found, scattered())
        return
    assert_same(found, linear())


@functools.cache
def linear() -> xarray.Dataset:
    scatter = Scatter(0.08, draws=3, seed=9)
    return compute_test_fates(BLOCKS, TESTS, gains=GAINS, scatter=scatter, model=Linear())


def test_small_batches_do_not_change_a_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "evaluate", functools.partial(evaluate, batch=5))
    scatter = Scatter(0.08, draws=3, seed=9)
    assert_same(compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter), scattered())


def test_a_store_is_resumed_after_an_interruption(tmp_path: Path) -> None:
    cells: list[int] = []

    def stop(count: int) -> None:
        cells.append(count)
        if sum(cells) > 40:
            raise KeyboardInterrupt

    scatter = Scatter(0.08, draws=3, seed=9)
    run = Execution(executor="serial", store=Store(tmp_path / "runs.zarr", chunk=20), progress=stop)
    with pytest.raises(KeyboardInterrupt):
        compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter, run=run)
    cells.clear()
    again = Execution(
        store=Store(tmp_path / "runs.zarr", chunk=20, resume=True), progress=cells.append
    )
    found = compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=scatter, run=again)
    assert 0 < cells[0] < sum(cells) == found.status.size
    assert_same(found, scattered())
    with pytest.raises(Exception, match="deviation"):
        compute_test_fates(BLOCKS, LIFTED, gains=GAINS, scatter=Scatter(0.07, 3, 9), run=again)


# ------------------------------------------------------------------------------------ refusals

COLUMN = BLOCKS[:2]


@every(
    ("arguments", "words"),
    [
        ({"tests": []}, "tests"),
        ({"tests": [SLOW[0]]}, "tests"),
        ({"tests": [TESTS[0], TESTS[0]]}, "two tests have this name"),
        ({"blocks": []}, "blocks"),
        ({"blocks": [0.2]}, "blocks"),
        ({"gains": 0.0}, "gains"),
        ({"gains": -1.0}, "gains"),
        ({"gains": np.nan}, "gains"),
        ({"gains": [1.0, 1e51]}, "gains"),
        ({"gains": []}, "gains"),
        ({"gains": np.ones((3, 2))}, r"gains has the shape \(3, 2\)"),
        ({"gains": np.ones((4, 3, 2))}, r"\(4, 2, gains\)"),
        ({"gains": np.ones((4, 2, 2, 1))}, "gains"),
        ({"gains": "strong"}, "gains"),
        ({"scatter": Scatter([0.1] * 3)}, "2 blocks"),
        ({"scatter": 0.1}, "scatter"),
        ({"outputs": []}, "outputs"),
        ({"outputs": ["peak"]}, "outputs"),
        ({"outputs": ["status", "status"]}, "outputs"),
        ({"model": "elastic"}, "model"),
    ],
)
def test_wrong_arguments_are_refused_in_one_line(arguments: dict[str, Any], words: str) -> None:
    given: dict[str, Any] = {"blocks": COLUMN, "tests": TESTS, **arguments}
    blocks, tests = given.pop("blocks"), given.pop("tests")
    with pytest.raises(InputError, match=words) as refused:
        compute_test_fates(blocks, tests, **given)
    assert "\n" not in str(refused.value)


def test_the_linear_model_has_no_vertical_motion() -> None:
    with pytest.raises(ModelError, match=r"test 'lifted' has vertical motion"):
        compute_test_fates(COLUMN, LIFTED, model=Linear())


@every(
    ("arguments", "words"),
    [
        ({"deviation": -0.1}, "deviation"),
        ({"deviation": 0.51}, "deviation"),
        ({"deviation": [0.1, np.nan]}, "deviation"),
        ({"deviation": [[0.1]]}, "shape"),
        ({"deviation": {"vase": 0.9}}, "deviation"),
        ({"deviation": "much"}, "deviation"),
        ({"deviation": 0.1, "draws": 0}, "draws"),
        ({"deviation": 0.1, "draws": 1.5}, "draws"),
        ({"deviation": 0.1, "seed": -1}, "seed"),
        ({"deviation": 0.1, "seed": 2**64}, "seed"),
    ],
)
def test_scatter_has_bounds(arguments: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        Scatter(**arguments)


@pytest.mark.parametrize("linear", [True, False])
def test_each_cell_of_a_block_against_a_wall_is_a_time_history(*, linear: bool) -> None:
    model: Model = Linear() if linear else Nonlinear()
    tests = TESTS if linear else LIFTED
    ratios = (0.0, 0.3, 0.6, 0.9, 0.5, 0.4)
    walls = [block.against_wall(ratio) for block, ratio in zip(BLOCKS, ratios, strict=True)]
    found = compute_test_fates(walls, tests, gains=GAINS, model=model)
    for (j, test), (i, block), (k, gain) in product(
        enumerate(tests), enumerate(walls), enumerate(GAINS)
    ):
        run = history(test, block, gain, model)
        cell = found.isel(test=j, block=i, gain=k, draw=0)
        assert int(cell.status) == run.status
        assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
        assert int(cell.impacts) == run.impact_count
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.values.ravel().tolist())
    free = compute_test_fates(BLOCKS, tests, gains=GAINS, model=model)
    assert (free.status != found.status).any()
