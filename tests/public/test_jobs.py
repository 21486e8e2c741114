"""Six jobs of users, each one screen of Python and one command."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes

import rocksteady as rs
from tests.cli.program import rocksteady
from tests.every import every
from tests.records import ABSENT, FOLDER

ACROSS = FOLDER / "peer_at2" / "RSN77_SFERN_PUL164-hor1.AT2"
UP = FOLDER / "peer_at2" / "RSN77_SFERN_PULDWN-up.AT2"

needs_records = pytest.mark.skipif(not ACROSS.is_file(), reason=ABSENT)


@needs_records
def test_a_one_record_one_rack_with_its_vertical() -> None:
    rack = rs.Block.named("server-rack")
    motion = rs.BaseMotion(rs.read_record(ACROSS), rs.read_record(UP))
    trajectory = rs.simulate(rack, motion)
    neighbours = rs.check_neighbours(trajectory)

    assert trajectory.status in (rs.Status.AT_REST, rs.Status.OVERTURNED)
    assert trajectory.model == rs.Nonlinear()
    assert 0 <= neighbours.fall <= neighbours.runs == 26
    assert "nonlinear" in trajectory.summary()
    assert isinstance(trajectory.plot(), Axes)

    found = rocksteady(
        f"simulate --block server-rack --record {ACROSS} --vertical {UP} --json"
    ).json
    assert found["peak"] == trajectory.peak
    assert found["neighbours"] == {"runs": 26, "fall": neighbours.fall}
    assert found["model"] == "nonlinear"


@needs_records
def test_b_records_times_levels_of_pga_times_an_off_centre_statue() -> None:
    statue = rs.Block.asymmetric(left=0.25, right=0.35, height=1.8)
    records = [rs.read_record(file) for file in sorted(ACROSS.parent.glob("*hor1.AT2"))[:4]]
    levels = np.linspace(0.2, 1.4, 5)
    runs = rs.simulate_many(statue, records, pga_g=levels)
    share = (runs.status == rs.Status.OVERTURNED).mean("record")

    assert share.dims == ("level",)
    assert share.shape == (5,)
    scaled = records[2].scaled(levels[3] * 9.80665 / records[2].peak_acceleration_m_s2)
    alone = rs.simulate(statue, scaled)
    here = runs.isel(record=2, level=3)
    assert int(here.status) == alone.status
    assert float(here.peak_angle) == pytest.approx(alone.peak, rel=1e-9)


def test_c_a_steady_state_picked_from_basins_and_marched_on() -> None:
    block = rs.DimensionlessBlock(restitution=0.8)
    motion = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    window = np.linspace(-0.9, 0.9, 8)
    basins = rs.compute_basins(block, motion, angles=window, velocities=window)
    attractor = next(each for each in basins.attractors if each.orbit is not None)
    trajectory = rs.simulate(block, motion, start=attractor.start, cycles=20)

    assert attractor.orbit is not None
    first, later = (trajectory.state(tau=tau + 1.0) for tau in (0.0, 2.0 * math.pi))
    assert (later.angle, later.velocity) == pytest.approx((first.angle, first.velocity), abs=1e-9)
    highest = max(attractor.orbit.highest, -attractor.orbit.lowest)
    assert trajectory.peak == pytest.approx(highest, rel=1e-9)

    picked = basins.state(3, 5)  # a cell is a start too
    label = basins.attractors[basins.label[3, 5]]
    assert rs.find_attractor(block, motion, start=picked).kind == label.kind


@pytest.mark.slow
def test_d_the_diagram_over_the_amplitude_with_its_cascade(tmp_path: Path) -> None:
    block = rs.DimensionlessBlock(restitution=0.8)
    motion = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0)
    diagram = rs.find_bifurcations(block, motion, "amplitude", within=(1.5, 3.0))

    assert diagram.cascade is not None
    assert diagram.cascade.values[:2] == pytest.approx([2.624661, 2.681132], abs=2e-6)
    assert isinstance(diagram.plot(), Axes)

    picture = tmp_path / "diagram.png"
    found = rocksteady(f"bifurcate -A 1.5:3:16 -W 2 -r 0.8 --plot {picture} --json").json
    assert picture.stat().st_size > 10_000
    assert [point["type"] for point in found["points"]].count("symmetry-breaking") >= 1


def test_e_a_map_with_a_store_resumed(tmp_path: Path) -> None:
    block = rs.DimensionlessBlock(restitution=0.8)
    axes = {"amplitude": np.linspace(0.1, 6, 60), "frequency_ratio": np.linspace(0.5, 8, 60)}
    done: list[int] = []

    def stop(cells: int) -> None:
        done.append(cells)
        if sum(done) > 0:
            raise KeyboardInterrupt

    store = rs.Store(tmp_path / "map.zarr", resume=True, chunk=500)
    with pytest.raises(KeyboardInterrupt):
        rs.map_fates(block, axes=axes, run=rs.Execution(store=store, progress=stop))
    again: list[int] = []
    fates = rs.map_fates(block, axes=axes, run=rs.Execution(store=store, progress=again.append))

    assert again[0] > 0  # cells that were there already
    assert sum(again) == 3600
    assert fates.equals(rs.map_fates(block, axes=axes).load())
    assert "overturned" in fates.rocksteady.summary(more=True)
    assert isinstance(fates.rocksteady.plot(), Axes)


@needs_records
def test_f_draws_of_uncertain_restitution() -> None:
    rack = rs.Block.rectangle(width=0.6, height=2.0)
    draws = np.random.default_rng(1).uniform(0.85, 0.97, 40)
    blocks = [rack.with_restitution(float(ratio)) for ratio in draws]
    runs = rs.simulate_many(blocks, rs.read_record(ACROSS), scales=1.1)
    share = float((runs.status == rs.Status.OVERTURNED).mean())

    alone = [rs.simulate(block, rs.read_record(ACROSS).scaled(1.1)).status for block in blocks[:5]]
    assert runs.status.values[:5].tolist() == alone
    assert 0.0 <= share <= 1.0
    assert runs.sizes["block"] == 40


@every("job", [name for name in dir() if re.match(r"test_[a-f]_", name)])
def test_each_job_is_one_screen(job: str) -> None:
    lines = Path(__file__).read_text(encoding="utf-8").split(f"def {job}")[1]
    body = lines.split("\n    assert")[0]
    assert body.count("\n") <= 16
