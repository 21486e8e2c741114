"""Blocks whose sides differ on the command line: flags, what is echoed, and refusals."""

import csv
from pathlib import Path

import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Still,
    find_attractor,
    find_orbits,
    simulate,
)
from rocksteady.dynamics.steady.heteroclinic import tangency_amplitude
from tests.cli.program import rocksteady

FLAGS = "--left-m 0.15 --right-m 0.25 --height-m 1.2"
BLOCK = Block.asymmetric(left=0.15, right=0.25, height=1.2)


def test_simulate_echoes_both_sides() -> None:
    values = rocksteady(f"simulate {FLAGS} --accel-g 0.45 --freq-hz 2 --json").json
    shaking = Harmonic.from_si(BLOCK, acceleration_m_s2=0.45 * 9.80665, frequency_hz=2.0)
    run = simulate(BLOCK, shaking)
    assert values["status"] == run.status.label
    assert values["side_peaks"] == list(run.side_peaks)
    assert values["overturn_time_s"] == run.overturn_time_s
    block = values["block"]
    assert block["alpha_rad"] == BLOCK.alpha
    assert block["negative"]["alpha_rad"] == BLOCK.negative.alpha
    assert block["negative"]["p_rad_s"] == BLOCK.negative.p
    assert (block["left_m"], block["right_m"], block["height_m"]) == pytest.approx(
        (0.15, 0.25, 1.2)
    )
    assert values["restitution"] == BLOCK.restitution
    assert values["negative_restitution"] == BLOCK.negative.restitution


def test_the_peak_in_radians_is_the_largest_angle() -> None:
    values = rocksteady(f"simulate {FLAGS} --start=-1.4,0 --json").json
    assert values["side_peaks"][1] < 1.0
    assert values["peak_rad"] == pytest.approx(1.4 * BLOCK.alpha)


def test_a_gyration_and_a_pair_of_restitutions() -> None:
    values = rocksteady(f"simulate {FLAGS} --gyration-m 0.5 -r 0.8,0.9 --start 0.5,0 --json").json
    block = Block.asymmetric(
        left=0.15, right=0.25, height=1.2, gyration=0.5, restitution=(0.8, 0.9)
    )
    run = simulate(block, Still(), start=State(angle=0.5, velocity=0.0))
    assert values["peak"] == run.peak
    assert values["block"]["p_rad_s"] == block.p
    bare = rocksteady("simulate -r 0.8,0.9 --start 0.5,0 --json").json
    same = simulate(
        DimensionlessBlock(restitution=0.8, negative_restitution=0.9),
        Still(),
        start=State(angle=0.5, velocity=0.0),
    )
    assert bare["side_peaks"] == list(same.side_peaks)


def test_equal_distances_are_the_symmetric_block() -> None:
    sizes = "--left-m 0.2 --right-m 0.2 --height-m 1.2"
    one = rocksteady(f"simulate {sizes} -A 2 -W 4 --json").json
    other = rocksteady("simulate --width-m 0.4 --height-m 1.2 -A 2 -W 4 --json").json
    assert one == other
    assert "side_peaks" not in one


def test_a_summary_names_the_edges(tmp_path: Path) -> None:
    out = rocksteady(
        f"simulate {FLAGS} -A 2 -W 5 --cycles 3 --more",
        "--plot",
        tmp_path / "a.png",
        "--csv",
        tmp_path / "a.csv",
    )
    assert out.code == 0
    assert "peak, left edge" in out.out
    assert "peak, right edge" in out.out
    with (tmp_path / "a.csv").open() as file:
        assert len(list(csv.reader(file))) > 100


def test_attractors_and_orbits_are_those_of_the_library(tmp_path: Path) -> None:
    shaking = Harmonic(amplitude=1.5, frequency_ratio=6.0)
    values = rocksteady(f"attractor {FLAGS} -A 1.5 -W 6 --json").json
    found = find_attractor(BLOCK, shaking)
    assert (values["kind"], values["period"]) == (found.kind.value, found.period)
    assert values["negative_restitution"] == BLOCK.negative.restitution
    words = rocksteady(f"attractor {FLAGS} -A 3.5 -W 8 --more", "--plot", tmp_path / "a.png").out
    assert "none is symmetric" in words
    listed = rocksteady(f"orbits {FLAGS} -A 1.5 -W 6 --max-period 1 --seeds 16 --json").json
    assert len(listed["orbits"]) == len(find_orbits(BLOCK, shaking, max_period=1, seeds=16))
    text = rocksteady(f"orbits {FLAGS} -A 1.5 -W 6 --max-period 1 --seeds 16 --more").out
    assert "mirror" not in text


@pytest.mark.slow
def test_an_aperiodic_motion_is_drawn_with_its_own_block(tmp_path: Path) -> None:
    ran = rocksteady(f"attractor {FLAGS} -A 2 -W 5 --cycles 400", "--plot", tmp_path / "cloud.png")
    assert ran.code == 0
    assert (tmp_path / "cloud.png").stat().st_size > 10_000


def test_maps_and_basins_of_it(tmp_path: Path) -> None:
    for fate in ("", " --fate"):
        values = rocksteady(
            f"map {FLAGS} -A 0.5:3:5 -W 4:8:5 --cycles 100 --json{fate}",
            "--plot",
            tmp_path / f"map{len(fate)}.png",
        ).json
        assert values["cells"] == 25
        assert values["block"]["negative"]["alpha_rad"] == BLOCK.negative.alpha
        assert values["counts"].get("symmetric", 0) == 0
    moved = rocksteady(f"map {FLAGS} -A 2 -W 5 -r 0.7:0.9:3 --cycles 50 --fate --json").json
    assert moved["restitution"] is None
    assert "negative_restitution" not in moved  # the axis is of both impacts
    erosion = rocksteady(
        f"basins {FLAGS} -A 0:1:2 -W 5 --angles=-1:1:10 --velocities=-0.2:0.2:10 --cycles 5 --json "
        "--model linear"
    ).json
    expected = tangency_amplitude(BLOCK.dimensionless().sides, 5.0)
    assert erosion["heteroclinic_amplitude"] == expected
