"""Flags of floors: the same motion as `floor_motion`, levels of the ground, one line a mistake."""

import itertools
import math
from pathlib import Path
from typing import Any

import pytest

from rocksteady import (
    Block,
    Nonlinear,
    Pulse,
    Record,
    find_attractor,
    find_overturning_windows,
    floor_motion,
    simulate,
)
from rocksteady.motions import Floor, FourierSeries
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady

BLOCK = Block.rectangle(width=0.4, height=1.6)
SIZE = "--width-m 0.4 --height-m 1.6"
FLOOR = "--floor-hz 1.5,4 --floor-damping 0.03,0.05 --participation 1.2,-0.3"
MODES: dict[str, Any] = {
    "frequencies_hz": [1.5, 4.0],
    "damping": [0.03, 0.05],
    "shapes": [1.2, -0.3],
}


@pytest.fixture(name="file")
def _file(tmp_path: Path) -> Path:
    return at2(tmp_path / "across.AT2", samples())


def test_a_record_is_that_of_the_floor_at_the_level_of_the_ground(file: Path) -> None:
    command = f"simulate {SIZE} --json --pga-g 0.3 {FLOOR} --record"
    values = rocksteady(command, file).json
    ground = Record(acceleration_m_s2=9.80665 * 0.5 * samples(), dt_s=0.02)  # of .6 g
    moved = floor_motion(ground, **MODES)
    truth = simulate(BLOCK, moved, model=Nonlinear())
    assert values["status"] == truth.status.label
    assert values["peak"] == pytest.approx(truth.peak, rel=1e-6)
    assert values["pga_g"] == pytest.approx(0.3, rel=1e-6)
    peak = moved.peak_acceleration_m_s2 / 9.80665
    assert values["floor_pga_g"] == pytest.approx(peak, rel=1e-9)
    assert values["record"] == "across (floor 1.5 Hz)"
    words = "floor of 1.5, 4 Hz, damping 3, 5 %, shape 1.2, -0.3"
    assert words in values["record_processing"]


def test_a_pulse_and_shaking_are_those_of_the_floor() -> None:
    shaken = f"{SIZE} --accel-g 0.3 --freq-hz 1 --json {FLOOR}"
    pulse = Pulse.from_si(
        BLOCK, shape="one-sine", acceleration_m_s2=0.3 * 9.80665, frequency_hz=1.0
    )
    found = rocksteady(f"simulate {shaken} --pulse one-sine").json
    truth = simulate(BLOCK, floor_motion(pulse, block=BLOCK, **MODES), model=Nonlinear())
    assert found["peak"] == pytest.approx(truth.peak, rel=1e-6)
    zeta = 0.05
    alone = f"simulate {SIZE} --accel-g 0.3 --freq-hz 2 --json --cycles 5"
    resonant = rocksteady(f"{alone} --floor-hz 2").json["amplitude"]
    closed = math.sqrt(1.0 + 4.0 * zeta**2) / (2.0 * zeta)
    assert resonant == pytest.approx(closed * rocksteady(alone).json["amplitude"], rel=1e-9)


@pytest.mark.parametrize(
    "command",
    [
        "attractor --cycles 200",
        "orbits --max-period 1 --seeds 8",
        "steady",
        "edge",
        "basins --cycles 60 --angles=-0.5:0.5:4 --velocities=-0.5:0.5:4",
        "explore --no-browser",
    ],
)
def test_lasting_shaking_is_that_of_the_floor(command: str) -> None:
    factor = Floor(frequencies_hz=3.0).amplification(2.0).item()
    floor, direct = (
        rocksteady(f"{command} {SIZE} --json --freq-hz 2 --accel-g {flags}")
        for flags in ("0.1 --floor-hz 3", repr(0.1 * factor))
    )
    assert f"{factor:.4g} times the amplitude of the ground" in floor.err
    wanted, found = (
        float(each.json["view"]["A"] if "explore" in command else each.json["amplitude"])
        for each in (direct, floor)
    )
    assert found == pytest.approx(wanted, rel=1e-9)


def test_a_series_is_turned_harmonic_by_harmonic() -> None:
    command = f"attractor {SIZE} --json --freq-hz 2 --accel-g 0.25 --cycles 200 --floor-hz 3"
    found = rocksteady(f"{command} --harmonic 1,1,0 --harmonic 3,0.2,1").json
    series = FourierSeries.from_si(
        BLOCK,
        acceleration_m_s2=0.25 * 9.80665,
        frequency_hz=2.0,
        harmonics=((1, 1.0, 0.0), (3, 0.2, 1.0)),
    )
    moved = floor_motion(series, block=BLOCK, frequencies_hz=3.0)
    truth = find_attractor(BLOCK, moved, max_cycles=200)
    assert found["kind"] == truth.kind.label
    assert found["peaks"] == pytest.approx(truth.peaks, rel=1e-9)


def test_the_next_command_of_orbits_starts_on_the_orbit() -> None:
    command = f"orbits {SIZE} --accel-g 0.1 --freq-hz 2 --floor-hz 2 --max-period 1 --seeds 8"
    further = rocksteady(command).out.partition("next: rocksteady ")[2].replace("\\\n", "")
    found = rocksteady(f"{further} --json").json
    (state, *_) = found["states"]
    assert state["phase"] == pytest.approx(found["phase"], abs=1e-5)


def test_measures_of_a_file_are_those_of_the_floor(file: Path) -> None:
    ground, floor = (
        rocksteady(f"record --json {each}", file).json["pga_g"] for each in ("", "--floor-hz 2")
    )
    moved = floor_motion(
        Record(acceleration_m_s2=9.80665 * samples(), dt_s=0.02), frequencies_hz=2.0
    )
    assert ground == pytest.approx(0.6, rel=1e-6)
    assert floor == pytest.approx(moved.peak_acceleration_m_s2 / 9.80665, rel=1e-6)


def test_the_vertical_component_stays_that_of_the_ground(file: Path, tmp_path: Path) -> None:
    up = at2(tmp_path / "up.AT2", samples(9, 0.4), component="UP")
    command = f"simulate {SIZE} --json --record {file} --vertical {up}"
    ground, floor = (rocksteady(f"{command}{each}").json for each in ("", " --floor-hz 2"))
    assert floor["vertical_pga_g"] == ground["vertical_pga_g"]
    assert floor["peak"] != ground["peak"]


def test_scales_of_a_record_are_those_of_the_ground(file: Path) -> None:
    command = f"overturn {SIZE} --json --record {file} --scales 2.3:2.4"
    ground, floor = (
        rocksteady(f"{command}{each}").json["records"][0] for each in ("", " --floor-hz 1")
    )
    assert ground["first"] is None
    assert floor["first_g"] == pytest.approx(0.6 * floor["first"], rel=5e-4)


def test_a_floor_stands_in_the_file_or_beside_it(tmp_path: Path) -> None:
    table, buildings = tmp_path / "objects.csv", tmp_path / "museum.toml"
    table.write_text("name,width_m,height_m,floor\nvase,0.2,0.6,1\n", encoding="utf-8")
    text = '[[buildings]]\nname = "museum"\nstoreys = 1\nperiod_s = 0.3\n'
    buildings.write_text(text, encoding="utf-8")
    records = at2(tmp_path / "across.AT2", samples())
    line = f"assess {table} --buildings {buildings} --records {records} --pga-g 0.3 --floor-hz 2"
    assert "--buildings has the floor of each object" in refused(line)


def test_windows_of_a_pulse_are_those_of_the_ground_below_the_floor() -> None:
    values = rocksteady(
        f"overturn {SIZE} --pulse one-sine --accel-g 0.8 --freq-hz 2 --json {FLOOR}"
    ).json
    found = find_overturning_windows(
        BLOCK,
        "one-sine",
        [4.0 * math.pi / BLOCK.p],
        within=(0.05, 0.8 * 9.80665 / BLOCK.uplift_acceleration),
        floor=Floor(**MODES),
    )
    for row, first in zip(values["windows"], found.first.tolist(), strict=True):
        assert row["first"] == pytest.approx(first, rel=5e-4)
    assert values["floor"] == Floor(**MODES).label


def test_cells_of_a_map_are_those_of_single_motions() -> None:
    axes = "--accel-g 0.05:0.2:2 --freq-hz 1.2:2:2"
    counts = rocksteady(f"map {SIZE} {axes} --json {FLOOR}").json["counts"]
    kinds: dict[str, int] = {}
    for size, hertz in itertools.product((0.05, 0.2), (1.2, 2.0)):
        alone = f"attractor {SIZE} --accel-g {size} --freq-hz {hertz} --json {FLOOR}"
        kind = rocksteady(alone).json["kind"]
        kinds[kind] = kinds.get(kind, 0) + 1
    assert {kind: count for kind, count in counts.items() if count} == kinds


@pytest.mark.parametrize("start", ["", "--start 0.1,0 "])
def test_an_axis_of_amplitudes_is_that_of_the_ground(start: str) -> None:
    factor = Floor(frequencies_hz=3.0).amplification(2.0).item()
    lows = {"": (0.05, 0.25), "--floor-hz 3": (0.05 / factor, 0.25 / factor)}
    direct, floor = (
        rocksteady(
            f"bifurcate {SIZE} {start}--accel-g {low!r}:{high!r}:9 --freq-hz 2 "
            f"--harmonic 1,1,0 {flags} --json --max-period 1 --max-branches 1"
        ).json["branches"]
        for flags, (low, high) in lows.items()
    )
    ends = [[end for each in branches for end in each["within"]] for branches in (direct, floor)]
    assert [factor * end for end in ends[1]] == pytest.approx(ends[0], rel=1e-6)


def test_a_safe_basin_erodes_as_on_the_ground_at_the_amplitude_of_the_floor() -> None:
    floor = Floor(frequencies_hz=3.0)
    factor, lead = floor.amplification(2.0).item(), floor.phase_lead(2.0).item()
    window = "--angles=-1:1:24 --velocities=-1:1:24 --cycles 20 --freq-hz 2 --json"
    found, direct = (
        rocksteady(f"basins {SIZE} {window} --accel-g 0:{high!r}:4 {flags}").json
        for high, flags in ((0.3, "--floor-hz 3"), (0.3 * factor, f"--harmonic 1,1,{lead!r}"))
    )
    for one, other in zip(found["erosion"], direct["erosion"], strict=True):
        assert one["safe_share"] == pytest.approx(other["safe_share"], rel=1e-12)
