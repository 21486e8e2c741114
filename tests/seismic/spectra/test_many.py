"""Many blocks on many records: each cell against a time history, levels, directions, refusals."""

import functools
import inspect
import math
from itertools import product

import numpy as np
import pytest
import xarray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Record,
    Status,
    open_store,
    simulate,
    simulate_many,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.measures import compute_suite_spectrum
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.seismic.spectra.many import cells_of_many
from tests.every import every
from tests.seismic.grounds import ground, lifting

G = 9.80665
BLOCKS = (  # levels are in units of 9.80665 m/s^2, whatever the gravity of a block
    Block.rectangle(width=0.4, height=1.6, gravity=8.0),
    Block.asymmetric(left=0.25, right=0.4, height=2.4, gravity=11.0),
    Block.asymmetric(left=0.4, right=0.25, height=1.6, restitution=(0.9, 0.7)),
    Block.general(mass=100.0, inertia=90.0, radius=0.8, alpha=0.2, gravity=9.0),
)
# Slow ones, which topple the blocks.
SUITE = tuple(
    Record(acceleration_m_s2=each.acceleration_m_s2, dt_s=3.0 * each.dt_s, name=name)
    for each, name in ((ground(1), None), (ground(2), "other"), (ground(3, peak=8.0), None))
)
LEVELS = (0.3, 0.8, 1.6)
# Against a wall: by angular momentum, without rebound, between, and of unlike sides.
WALLS = (
    BLOCKS[0].against_wall(),
    BLOCKS[0].against_wall(0.0),
    Block.rectangle(width=0.3, height=3.0).against_wall(0.75),
    BLOCKS[1].against_wall(0.5),
)
NAMES = ("status", "peak_angle", "peak_velocity", "impacts")


def scaled(motion: Record | BaseMotion, factor: float, *, reverse: bool) -> BaseMotion:
    base = motion if isinstance(motion, BaseMotion) else BaseMotion(motion)
    turned = base.reversed() if reverse else base
    return turned.scaled(factor)


def check_cell(cell: xarray.Dataset, block: Block, motion: BaseMotion, model: Model) -> None:
    run = simulate(block, motion, model=model)
    assert int(cell.status) == run.status
    assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
    assert float(cell.peak_velocity) == pytest.approx(run.peak_velocity, rel=1e-8, abs=1e-15)
    assert int(cell.impacts) == run.impact_count


@functools.cache
def shaken(*, linear: bool, vertical: bool) -> tuple[list[Record | BaseMotion], xarray.Dataset]:
    motions: list[Record | BaseMotion] = list(SUITE)
    if vertical:
        motions[1] = BaseMotion(SUITE[1], lifting())
    model: Model = Linear() if linear else Nonlinear()
    return motions, simulate_many(BLOCKS, motions, pga_g=LEVELS, reverse="both", model=model)


@every(("linear", "vertical"), [(True, False), (False, False), (False, True)])
def test_each_cell_is_a_time_history(*, linear: bool, vertical: bool) -> None:
    motions, result = shaken(linear=linear, vertical=vertical)
    assert dict(result.sizes) == {"block": 4, "record": 3, "direction": 2, "level": 3}
    model: Model = Linear() if linear else Nonlinear()
    for (i, block), (j, motion), k in product(
        enumerate(BLOCKS), enumerate(motions), range(len(LEVELS))
    ):
        for direction in ("as recorded", "reversed"):
            cell = result.isel(block=i, record=j, level=k).sel(direction=direction)
            factor = LEVELS[k] * G / SUITE[j].peak_acceleration_m_s2
            assert float(cell.scale) == pytest.approx(factor, rel=1e-14)
            assert float(cell.pga_g) == LEVELS[k]
            check_cell(cell, block, scaled(motion, factor, reverse=direction == "reversed"), model)
    assert {Status.AT_REST, Status.OVERTURNED} <= set(result.status.values.ravel().tolist())


@every(("linear", "vertical"), [(True, False), (False, False), (False, True)])
def test_each_cell_of_a_block_against_a_wall_is_a_time_history(
    *, linear: bool, vertical: bool
) -> None:
    model: Model = Linear() if linear else Nonlinear()
    motions: list[Record | BaseMotion] = list(SUITE)
    if vertical:
        motions[1] = BaseMotion(SUITE[1], lifting())
    found = simulate_many(WALLS, motions, pga_g=LEVELS, reverse="both", model=model)
    for (i, block), (j, motion), k, turned in product(
        enumerate(WALLS), enumerate(motions), range(len(LEVELS)), (0, 1)
    ):
        factor = LEVELS[k] * G / SUITE[j].peak_acceleration_m_s2
        cell = found.isel(block=i, record=j, level=k, direction=turned)
        check_cell(cell, block, scaled(motion, factor, reverse=bool(turned)), model)
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.values.ravel().tolist())
    one, other = (found.peak_angle.isel(direction=turned) for turned in (0, 1))
    assert (one != other).any("level").all()  # no direction is the mirror image of the other
    assert found.one_sided.values.all()
    assert found.restitution.values.tolist() == [block.restitution for block in WALLS]
    assert "negative_alpha" not in found.coords


@pytest.mark.slow
@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_without_loss_at_the_wall_each_status_is_that_of_a_time_history(model: Model) -> None:
    # It rocks on for p t = 1e4, through a thousand impacts that magnify what rounding does.
    block = WALLS[0].with_restitution(1.0)
    found = simulate_many(block, SUITE, pga_g=LEVELS, reverse="both", model=model)
    for j, k, turned in product(range(3), range(3), (0, 1)):
        factor = LEVELS[k] * G / SUITE[j].peak_acceleration_m_s2
        run = simulate(block, scaled(SUITE[j], factor, reverse=bool(turned)), model=model)
        cell = found.isel(record=j, level=k, direction=turned)
        assert int(cell.status) == run.status
        assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-5)
    assert Status.ROCKING in found.status.values


def test_a_push_into_the_wall_moves_nothing() -> None:
    push = Record(acceleration_m_s2=np.array([0.0, -9.0, -9.0, 0.0]), dt_s=0.2)
    still, moved = (
        simulate_many(WALLS, push, reverse=turned, model=model)
        for turned, model in ((False, Nonlinear()), (True, Nonlinear()))
    )
    assert not still.peak_angle.values.any()
    assert (still.status == Status.AT_REST).all()
    assert (moved.peak_angle > 0.01).all()


def test_beside_others_a_block_against_a_wall_has_no_negative_side() -> None:
    found = simulate_many([BLOCKS[1], WALLS[3]], SUITE[0], pga_g=0.8)
    assert found.one_sided.values.tolist() == [False, True]
    assert found.negative_alpha.values[0] == BLOCKS[1].negative.alpha
    assert np.isnan(found.negative_alpha.values[1])
    assert found.restitution.values[1] == 0.5
    alone = simulate_many(WALLS[3], SUITE[0], pga_g=0.8)
    np.testing.assert_array_equal(found.peak_angle[1], alone.peak_angle)


def test_threads_and_store_change_no_bits_at_a_wall(tmp_path: object) -> None:
    given = {"pga_g": LEVELS, "reverse": "both"}
    plain = simulate_many(WALLS, SUITE, **given, run=Execution(executor="serial"))  # type: ignore[arg-type]
    for run in (Execution(executor="threads", workers=3), Execution(store=f"{tmp_path}/kept.zarr")):
        other = simulate_many(WALLS, SUITE, **given, run=run)  # type: ignore[arg-type]
        for name in NAMES:
            np.testing.assert_array_equal(plain[name], other[name])


def test_scales_and_the_levels_of_pga_that_they_make_give_the_same_cells() -> None:
    record = SUITE[0]
    factors = [0.5, 1.0, 2.0]
    one = simulate_many(BLOCKS[1], record, scales=factors)
    peak = record.peak_acceleration_m_s2 / G
    other = simulate_many(BLOCKS[1], record, pga_g=[factor * peak for factor in factors])
    np.testing.assert_allclose(one.pga_g, other.pga_g, rtol=1e-14)
    np.testing.assert_allclose(other.scale, factors, rtol=1e-14)
    np.testing.assert_allclose(one.peak_velocity, other.peak_velocity, rtol=1e-7)
    assert one.peak_velocity.dims == ("level",)
    assert len(set(one.peak_velocity.values.tolist())) == 3


def test_a_reversed_record_tips_the_mirrored_block_alike() -> None:
    left = Block.asymmetric(left=0.2, right=0.35, height=1.8)
    right = Block.asymmetric(left=0.35, right=0.2, height=1.8)
    one = simulate_many(left, SUITE, pga_g=LEVELS)
    other = simulate_many(right, SUITE, pga_g=LEVELS, reverse=True)
    np.testing.assert_array_equal(one.status, other.status)
    np.testing.assert_allclose(one.peak_angle, other.peak_angle, rtol=1e-8)
    assert (one.status == Status.OVERTURNED).any()
    both = simulate_many(left, SUITE, pga_g=LEVELS, reverse="both")
    xarray.testing.assert_equal(both.peak_angle.sel(direction="as recorded"), one.peak_angle)


def test_single_things_are_no_dimension_and_blocks_have_their_measures() -> None:
    result = simulate_many(BLOCKS[0], SUITE[0])
    assert result.status.dims == ()
    assert float(result.scale) == 1.0
    assert float(result.pga_g) == pytest.approx(SUITE[0].peak_acceleration_m_s2 / G)
    assert float(result.alpha) == BLOCKS[0].alpha
    assert result.attrs["model"] == "nonlinear"
    assert "negative_alpha" not in result.coords
    ratios = [0.7, 0.8, 0.9]
    draws = simulate_many([BLOCKS[0].with_restitution(ratio) for ratio in ratios], SUITE[0])
    assert draws.status.dims == ("block",)
    assert draws.restitution.values.tolist() == ratios
    several = simulate_many(BLOCKS, [SUITE[0]], scales=[1.0])
    assert several.status.dims == ("block", "record", "level")
    assert several.negative_alpha.values.tolist() == [block.negative.alpha for block in BLOCKS]


def test_executor_store_and_batch_change_nothing(tmp_path: object) -> None:
    given = {"pga_g": LEVELS, "reverse": "both"}
    plain = simulate_many(BLOCKS, SUITE, **given, run=Execution(executor="serial"))  # type: ignore[arg-type]
    path = f"{tmp_path}/kept.zarr"
    kept = simulate_many(BLOCKS, SUITE, **given, run=Execution(workers=2, store=path))  # type: ignore[arg-type]
    for name in NAMES:
        np.testing.assert_array_equal(plain[name], kept[name])
    assert open_store(path).status.size == plain.status.size


def test_the_summary_of_a_suite_counts_those_that_fall() -> None:
    result = simulate_many(BLOCKS, SUITE, pga_g=LEVELS)
    summary = compute_suite_spectrum(result)
    fell = (result.status == Status.OVERTURNED).mean("record")
    np.testing.assert_array_equal(summary.overturned, fell)
    assert "scale" not in summary.coords
    assert 0.0 < float(fell.mean()) < 1.0


@every(
    ("given", "words"),
    [
        ({"blocks": []}, "list of them"),
        ({"blocks": DimensionlessBlock(restitution=0.8)}, "blocks"),
        ({"motions": []}, "motions"),
        ({"motions": Pulse(shape="half-sine", amplitude=2.0, frequency_ratio=2.0)}, "motions"),
        ({"pga_g": 0.3, "scales": 2.0}, "both given"),
        ({"pga_g": 0.0}, "pga_g"),
        ({"pga_g": []}, "pga_g"),
        ({"pga_g": [0.3, 0.3]}, "pga_g = .* once"),
        ({"scales": [[1.0, 2.0]]}, "scales = .* a list of numbers"),
        ({"scales": -1.0}, "scales"),
        ({"motions": [None]}, "it must be a Record or a BaseMotion; read one"),
        ({"reverse": "twice"}, "reverse"),
    ],
)
def test_refusals(given: dict[str, object], words: str) -> None:
    arguments = {"blocks": BLOCKS[0], "motions": SUITE[0]} | given
    with pytest.raises((InputError, TypeError), match=words):
        simulate_many(**arguments)  # type: ignore[arg-type]


def test_the_linear_model_has_no_vertical_motion() -> None:
    with pytest.raises(ModelError, match="vertical"):
        simulate_many(BLOCKS[0], BaseMotion(SUITE[0], lifting()), model=Linear())


@every("model", [Linear(), Nonlinear()])
@every("wall", [False, True])
def test_a_crest_that_just_touches_uplift_is_decided(model: Model, *, wall: bool) -> None:
    """To the last bits of the level a block lifts or not, and never stays between the two."""
    block = Block.rectangle(width=0.4, height=2.0)
    uplift = block.alpha if isinstance(model, Linear) else 0.2
    levels = np.unique(uplift * (1.0 + np.arange(-8, 9) * 2.0**-53))
    assert len(levels) > 8
    shape = np.array([0.0, -0.5, 0.3, 1.0, -0.7, 0.0])
    crests = [
        Record(acceleration_m_s2=top * shape, dt_s=0.02, name=f"crest {top:.3g}")
        for top in (1.0, 0.7654321, 1.0 / 3.0, math.pi)
    ]
    fates = simulate_many(
        [block.against_wall() if wall else block],
        crests,
        pga_g=levels,
        reverse="both",
        model=model,
    )
    assert (fates["status"] == int(Status.AT_REST)).all()
    assert int(fates["impacts"].max()) < 100


def test_a_crest_at_uplift_leaves_no_flight_without_end() -> None:
    """A peak sample that just reaches uplift lifts the block at no acceleration at all."""
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)  # lifts at 0.25 g
    bumps = (
        (0.1, 1.1, 0.3), (-0.18, 1.9, 0.45), (0.36, 2.8, 0.45), (-0.44, 3.5, 0.25),
        (0.48, 4.1, 0.35), (-0.48, 4.7, 0.3), (0.32, 5.4, 0.35), (-0.26, 6.2, 0.4),
        (0.16, 6.9, 0.3), (-0.06, 7.4, 0.25),
    )  # fmt: skip
    time = 0.01 * np.arange(1000)
    shapes = (c * np.maximum(0.0, 1.0 - ((time - m) / w) ** 2) ** 2 for c, m, w in bumps)
    record = Record(acceleration_m_s2=G * sum(shapes), dt_s=0.01)
    levels = [2.5, 2.5 / 1.8, 2.5 / 3.6, 2.5 / 4.8]
    for model in (Nonlinear(), Linear()):
        fates = simulate_many(block, record, scales=levels, model=model)
        for k, level in enumerate(levels):
            cell, run = fates.isel(level=k), simulate(block, record.scaled(level), model=model)
            assert int(cell.status) == run.status
            # Bounces on the crest are of the size of rounding, which differs with the units.
            assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8)
        assert int(fates.status[0]) == Status.OVERTURNED


def test_cells_are_made_with_the_defaults_of_the_runs() -> None:
    runs, cells = (
        {name: each.default for name, each in inspect.signature(function).parameters.items()}
        for function in (simulate_many, cells_of_many)
    )
    assert runs == cells
