"""Ensembles: each cell against a time history, mirror images, workers, stores, warnings."""

import functools
import json
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import (
    BaseMotion,
    Block,
    Execution,
    Record,
    Status,
    Store,
    run_ensemble,
    simulate,
    simulate_many,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.measures import compute_measure
from rocksteady.model.equations import Linear
from rocksteady.risk import Levels, RestitutionBand, Ways, count_fragility
from rocksteady.risk.ensemble.qualification import FORCES, SHARE
from tests.every import every
from tests.seismic.grounds import ground, lifting

SYMMETRIC = Block.rectangle(width=0.4, height=1.6)
GENERAL = Block.general(mass=100.0, inertia=90.0, radius=0.8, alpha=0.2, height=2.2, gravity=9.0)
OFF_CENTRE = Block.asymmetric(left=0.25, right=0.4, height=2.4)
BLOCKS = (SYMMETRIC, OFF_CENTRE, GENERAL)
# Slow ones, which topple the blocks.
SUITE = tuple(
    Record(acceleration_m_s2=each.acceleration_m_s2, dt_s=3.0 * each.dt_s, name=name)
    for each, name in ((ground(1), None), (ground(2), "other"), (ground(3, peak=8.0), None))
)
MOTIONS: tuple[Record | BaseMotion, ...] = (SUITE[0], BaseMotion(SUITE[1], lifting()), SUITE[2])
LEVELS = (0.4, 0.9, 2.5)
ONE = Levels("scale", [1.0], beside=())
NAMES = (
    "status",
    "peak_angle",
    "impacts",
    "uplift_time_s",
    "top_displacement_m",
    "clearance_m",
    "edge_speed_m_s",
)


TWO = RestitutionBand(draws=2)


def ran(blocks: Any = BLOCKS, motions: Any = MOTIONS, **how: Any) -> xarray.Dataset:
    """Return the runs of two restitutions at three levels, unless others are given."""
    levels = Levels("pga_per_uplift", LEVELS)
    return run_ensemble(blocks, motions, **{"levels": levels, "restitution": TWO, **how})


@functools.cache
def ensemble() -> xarray.Dataset:
    return ran()


def assert_same(one: xarray.Dataset, other: xarray.Dataset) -> None:
    """Check that two ensembles have the same bits."""
    for name in NAMES:
        np.testing.assert_array_equal(one[name], other[name])


def test_each_cell_is_a_time_history() -> None:
    found = ensemble()
    assert dict(found.sizes) == {
        "block": 3,
        "record": 3,
        "direction": 2,
        "vertical": 2,
        "draw": 2,
        "level": 3,
    }
    for (i, block), (j, motion) in product(enumerate(BLOCKS), enumerate(MOTIONS)):
        base = BaseMotion(motion) if isinstance(motion, Record) else motion
        assert isinstance(base.horizontal, Record)
        for k, level in enumerate(LEVELS):
            factor = level / compute_measure(base.horizontal, "pga_per_uplift", block)
            assert float(found.scale[i, j, k]) == pytest.approx(factor, rel=1e-14)
            for direction, lift, draw in product((0, 1), (0, 1), (0, 1)):
                cell = found.isel(
                    block=i, record=j, direction=direction, vertical=lift, draw=draw, level=k
                )
                shaken = base.scaled(factor)
                if not lift:
                    shaken = BaseMotion(shaken.horizontal)
                ratios = TWO.ratios(block)[draw]
                run = simulate(
                    block.with_restitution((float(ratios[0]), float(ratios[1]))),
                    shaken.reversed() if direction else shaken,
                )
                assert int(cell.status) == run.status
                assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
                assert int(cell.impacts) == run.impact_count
                top, speed = run.top_displacement_m, run.impact_speed_m_s
                assert speed is not None
                if top is None or block.symmetric:
                    moved = np.nan if top is None else top
                    gap = np.nan if run.clearances_m is None else max(run.clearances_m)
                    for found_m, truth in (
                        (cell.top_displacement_m, moved),
                        (cell.clearance_m, gap),
                    ):
                        assert float(found_m) == pytest.approx(
                            truth, rel=1e-8, abs=1e-15, nan_ok=True
                        )
                else:  # the side of the peak is not known, and the worse one is taken
                    assert float(cell.top_displacement_m) >= top * (1.0 - 1e-8)
                fastest = run.peak_velocity * block.alpha * block.p * block.width
                assert float(cell.edge_speed_m_s) == pytest.approx(fastest, rel=1e-8, abs=1e-15)
                assert float(cell.edge_speed_m_s) >= speed * (1.0 - 1e-8)
                lifted = np.flatnonzero(run.flights.side)
                first = run.flights.pt[lifted[0]] / block.p if len(lifted) else np.nan
                assert float(cell.uplift_time_s) == pytest.approx(first, rel=1e-9, nan_ok=True)
    assert {Status.AT_REST, Status.OVERTURNED} <= set(found.status.values.ravel().tolist())


def test_forces_of_a_mass_are_those_of_each_time_history() -> None:
    """Nan of a fall and without uplift; twice the mass has twice the force."""
    blocks, motions, masses = BLOCKS[:2], MOTIONS[:2], [120.0, 300.0]
    levels = Levels("pga_per_uplift", [0.9, 1.05, 1.3], beside=())
    found = ran(blocks, motions, levels=levels, mass_kg=masses)
    assert not set(FORCES) & set(ensemble().data_vars)
    assert found["base_force_down_kn"].attrs["units"] == "kN"
    finite = 0
    for i, j, lift, draw, k in product(range(2), range(2), range(2), range(2), range(3)):
        cell = found.isel(block=i, record=j, direction=0, vertical=lift, draw=draw, level=k)
        motion = motions[j]
        base = BaseMotion(motion) if isinstance(motion, Record) else motion
        if not lift:
            base = BaseMotion(base.horizontal)
        ratios = TWO.ratios(blocks[i])[draw].tolist()
        run = simulate(blocks[i].with_restitution(tuple(ratios)), base.scaled(float(cell["scale"])))
        forces = run.base_force_kn(masses[i])
        if forces is None or run.status is Status.OVERTURNED:
            forces = (np.nan, np.nan)
        finite += bool(np.isfinite(forces).all())
        got = [float(cell[name]) for name in FORCES]
        assert got == pytest.approx(forces, rel=1e-9 * run.growth, nan_ok=True)
    assert finite > 10
    description = found.isel(level=[1]).rocksteady.describe()
    (row,) = description.tables[0].rows
    known = found["base_force_down_kn"].isel(level=1).values
    assert row["base_force_down_kn"] == np.quantile(known[np.isfinite(known)], SHARE)
    heavier = ran(blocks[0], motions, levels=levels, mass_kg=240.0)
    one = found["base_force_across_kn"].isel(block=[0])
    np.testing.assert_allclose(heavier["base_force_across_kn"], 2.0 * one, rtol=1e-12)


@every("mass", [0.0, -1.0, np.nan, [100.0], [100.0, 0.0], [1.0, 2.0, 3.0]])
def test_a_mass_that_is_none_or_of_another_number_of_blocks_is_refused(mass: Any) -> None:
    with pytest.raises(InputError, match=r"^mass_kg"):
        run_ensemble(BLOCKS[:2], SUITE, levels=ONE, mass_kg=mass)


@pytest.mark.parametrize("model", [Linear(), None])
def test_each_cell_of_a_block_against_a_wall_is_a_time_history(model: Linear | None) -> None:
    block = OFF_CENTRE.against_wall()
    motions = MOTIONS if model is None else SUITE
    for band in (TWO, RestitutionBand(low=0.0, high="housner", draws=3)):
        found = ran(block, motions, restitution=band, model=model)
        ways = (4 if model is None else 3) * 2
        assert found.attrs["runs"] == ways * band.draws * len(LEVELS)  # no mirror images
        for (j, motion), k, direction, draw in product(
            enumerate(motions), range(3), (0, 1), range(band.draws)
        ):
            base = BaseMotion(motion) if isinstance(motion, Record) else motion
            assert isinstance(base.horizontal, Record)
            shaken = base.scaled(
                LEVELS[k] / compute_measure(base.horizontal, "pga_per_uplift", block)
            )
            run = simulate(
                block.with_restitution(float(band.ratios(block)[draw, 0])),
                shaken.reversed() if direction else shaken,
                model=model,
            )
            cell = found.isel(block=0, record=j, direction=direction, draw=draw, level=k)
            cell = cell.isel(vertical=-1)
            assert int(cell.status) == run.status
            assert float(cell.peak_angle) == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
            lifted = np.flatnonzero(run.flights.side)
            first = run.flights.pt[lifted[0]] / block.p if len(lifted) else np.nan
            assert float(cell.uplift_time_s) == pytest.approx(first, rel=1e-9, nan_ok=True)
        assert found.restitution.values[0].tolist() == band.ratios(block)[:, 0].tolist()


def test_a_free_block_has_no_restitution_of_0() -> None:
    with pytest.raises(InputError, match=r"low .*\(0, 1\]"):
        run_ensemble(SYMMETRIC, SUITE, levels=ONE, restitution=RestitutionBand(low=0.0, draws=1))


def test_a_mirror_image_has_the_bits_of_its_run() -> None:
    both = ran(SYMMETRIC)
    one = ran(SYMMETRIC, ways=Ways(reverse=True))
    assert both.attrs["runs"] == one.attrs["runs"] == 4 * 3 * 2
    assert_same(both.sel(direction=["reversed"]), one)
    # Beside an unequal block the mirror image is copied too.
    beside = ensemble()
    assert_same(beside.isel(block=[0]), both)
    assert not np.array_equal(
        beside.peak_angle.isel(block=1, direction=0), beside.peak_angle.isel(block=1, direction=1)
    )
    assert beside.attrs["runs"] == (1 + 2 + 1) * 4 * 3 * 2


def test_plain_factors_are_the_runs_of_simulate_many() -> None:
    factors = (0.5, 1.0, 2.0)
    found = run_ensemble(
        BLOCKS,
        MOTIONS,
        levels=Levels("scale", factors, beside=()),
        restitution=RestitutionBand(draws=1),
        ways=Ways(vertical=True),
    )
    other = simulate_many(BLOCKS, MOTIONS, scales=factors, reverse="both")
    for name in ("status", "peak_angle", "impacts"):
        np.testing.assert_array_equal(found[name].isel(vertical=0, draw=0), other[name])


def test_an_interrupted_ensemble_goes_on_from_its_store(tmp_path: Path) -> None:
    place = tmp_path / "runs.zarr"
    kept: list[int] = []

    def stop(cells: int) -> None:
        kept.append(cells)
        if sum(kept) > 30:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ran(run=Execution(executor="serial", store=Store(place, chunk=16), progress=stop))
    kept.clear()
    again = Execution(store=Store(place, resume=True, chunk=16), progress=kept.append)
    assert_same(ran(run=again), ensemble())
    assert kept[0] >= 16  # what was there already


def test_measures_stand_beside_the_runs_as_they_are_measured() -> None:
    found = ensemble()
    for name in ("pga_g", "pgv_m_s", "p_pgv_per_uplift", "sa_g", "sa_avg_g", "pgv_per_pga_s"):
        values = [[compute_measure(record, name, block) for record in SUITE] for block in BLOCKS]
        np.testing.assert_allclose(found[f"im_{name}"], values, rtol=1e-14)
    # What the levels are in, at each of them.
    reached = found.im_pga_per_uplift * found.scale
    np.testing.assert_allclose(reached, np.broadcast_to(LEVELS, (3, 3, 3)), rtol=1e-14)


def test_copies_of_runs_without_vertical_motion_are_marked() -> None:
    found = ensemble()
    assert found.copied.dims == ("record", "vertical")
    assert found.copied.values.tolist() == [[False, True], [False, False], [False, True]]
    repeated = found.isel(record=[0, 2]).status
    assert (repeated.isel(vertical=0) == repeated.isel(vertical=1)).all()
    (words,) = (each for each in json.loads(found.attrs["warnings"]) if "vertical" in each)
    assert words.startswith("2 of 3 records have no vertical component")
    levels = Levels(levels=[0.5], beside=())
    for motions, ways in (((MOTIONS[1],), None), (SUITE, None), (MOTIONS, Ways(vertical=True))):
        other = run_ensemble(SYMMETRIC, motions, levels=levels, ways=ways)
        assert "copied" not in other.coords


def test_vertical_motion_needs_a_record_and_full_equations() -> None:
    with pytest.raises(InputError, match="no motion has a vertical component"):
        run_ensemble(SYMMETRIC, SUITE, levels=ONE, ways=Ways(vertical=True))
    with pytest.raises(ModelError, match="vertical"):
        run_ensemble(SYMMETRIC, MOTIONS, levels=ONE, model=Linear())
    flat = run_ensemble(SYMMETRIC, MOTIONS, model=Linear(), ways=Ways(vertical=False), levels=ONE)
    assert flat.attrs["model"] == "linear"
    assert flat.vertical.values.tolist() == ["without"]


def test_blocks_of_an_ensemble_keep_their_gravity_when_some_are_taken() -> None:
    """Of the Moon and of the Earth: each is counted as it is alone."""
    bodies = [Block.rectangle(width=0.4, height=1.6, gravity=each) for each in (1.62, 9.80665)]
    levels = Levels("pga_per_uplift", (0.5, 1.3, 1.8, 2.5, 4.0), beside=())
    together = run_ensemble(bodies, SUITE, levels=levels)
    for place, body in enumerate(bodies):
        taken = together.isel(block=[place])
        assert float(taken["gravity"].item()) == body.gravity
        alone = run_ensemble(body, SUITE, levels=levels)
        one, other = (count_fragility(each).to_dict()["shares"] for each in (taken, alone))
        assert one == other


def test_an_ensemble_describes_itself() -> None:
    found = ensemble().rocksteady.describe()
    assert found.headline.startswith("Ensemble: 3 blocks, 3 records at 3 levels")
    values = found.to_dict()
    assert values["runs"] == 96
    assert values["cells"] == sum(values["counts"].values()) == 3 * 3 * 2 * 2 * 2 * 3
    shares = [row["overturned"] for row in values["stripes"]]
    assert sum(shares) * 72 == pytest.approx(values["counts"]["overturned"])
    assert all(row["uplift"] >= row["overturned"] for row in values["stripes"])
    # Below PGA = g tan alpha no block lifts without vertical motion.
    assert values["stripes"][0]["uplift"] <= 0.5
