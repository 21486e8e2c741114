"""Columns of tables in the units of a block, against the block's own conversions."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady import Block, DimensionlessBlock, Harmonic
from rocksteady.model.units import CONVERSIONS, COORDINATES, framed, in_units, with_unit
from tests.cli.program import rocksteady

BLOCK = Block.rectangle(width=0.4, height=2.0, restitution=0.9)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.7)
SUFFIXES = ("_deg", "_deg_s", "_deg_s2", "_s", "_g", "_hz")


def one(name: str, block: Block = BLOCK) -> float:
    """Return how many of a unit one of a dimensionless quantity is."""
    return float(CONVERSIONS[name][1](block, 1.0))


def test_the_units_are_those_of_the_block_and_its_motions() -> None:
    mars = Block.rectangle(width=0.4, height=2.0, restitution=0.9, gravity=3.71)
    for block in (BLOCK, mars):
        # To the bit, as all other results have them.
        sized = in_units({"amplitude": [2.0], "frequency_ratio": [4.7], "pt": [1.1]}, block)
        # A level in g is that of records, in 9.80665 m/s^2, wherever the block stands.
        assert sized["accel_g"] == [SHAKING.acceleration_m_s2(block) / 9.80665]
        assert sized["freq_hz"] == [SHAKING.frequency_hz(block)]
        assert sized["time_s"] == [1.1 / block.p]
        run = rs.simulate(block, SHAKING, cycles=3)
        table = run.to_columns(20)
        base = SHAKING.acceleration_m_s2(block) / 9.80665
        found = np.abs(table["base_acceleration_g"]).max()
        assert found == pytest.approx(base, rel=1e-3)
        # Rates are derivatives by seconds of what stands beside them.
        fine = np.linspace(0.3, 0.4, 2001)
        angle = one("angle", block) * run.at_time(fine).angle
        rate = one("velocity", block) * run.at_time(fine).velocity
        turn = one("acceleration_per_pt2", block) * run.at_time(fine).acceleration
        assert np.gradient(angle, fine)[1:-1] == pytest.approx(rate[1:-1], rel=1e-4, abs=1e-4)
        assert np.gradient(rate, fine)[1:-1] == pytest.approx(turn[1:-1], rel=1e-3, abs=1e-2)


def test_degrees_are_those_of_alpha_and_rates_are_by_seconds() -> None:
    angle = math.degrees(BLOCK.alpha)
    sizes = {"_deg": angle, "_deg_s": angle * BLOCK.p, "_deg_s2": angle * BLOCK.p**2}
    for name, (unit_name, _) in CONVERSIONS.items():
        for suffix, size in sizes.items():
            if unit_name.endswith(suffix):
                assert one(name) == pytest.approx(size, rel=1e-14), name


def test_every_name_ends_in_its_unit_and_what_has_no_size_gains_nothing() -> None:
    assert all(
        unit_name.endswith(SUFFIXES)
        for unit_name, _ in [*CONVERSIONS.values(), *COORDINATES.values()]
    )
    columns = {name: [1.0] for name in CONVERSIONS}
    bare = DimensionlessBlock(restitution=0.9)
    assert in_units(columns, bare) == in_units(columns, None) == columns
    sized = in_units(columns, BLOCK)
    assert set(sized) == set(columns) | {unit_name for unit_name, _ in CONVERSIONS.values()}
    assert in_units(sized, BLOCK).keys() == sized.keys()


def test_angles_of_unlike_sides_are_angles_and_peaks_of_an_unknown_side_have_no_degrees() -> None:
    block = Block.asymmetric(left=0.15, right=0.3, height=1.0)
    table = rs.simulate(block, rs.Still(), start=rs.State(angle=-1.2, velocity=0.0)).to_columns()
    run = rs.simulate(block, rs.Still(), start=rs.State(angle=-1.2, velocity=0.0))
    own = math.degrees(run.side_peaks[1] * block.negative.alpha)
    assert -float(table["angle_deg"].min()) == pytest.approx(own)
    assert run.side_peaks[1] * math.degrees(block.alpha) < 0.6 * own
    assert list(in_units({"angle": [1.0], "peak": [1.0]}, block)) == ["angle_deg", "angle", "peak"]


def test_missing_values_stay_missing_and_counts_whole() -> None:
    rows: list[dict[str, Any]] = [
        {"period": 2, "highest": 0.5, "highest_rad": 0.1},
        {"period": None, "highest": None, "highest_rad": None},
    ]
    frame = framed(rows, BLOCK)
    assert list(frame) == ["period", "highest_deg", "highest"]
    assert frame["period"].tolist()[0] == 2
    assert str(frame["period"].dtype) == "Int64"
    assert frame.isna().to_numpy()[1].all()
    assert frame["highest_deg"][0] == pytest.approx(math.degrees(0.5 * BLOCK.alpha))
    assert list(framed([], BLOCK, "amplitude")) == ["accel_g", "amplitude"]
    assert with_unit("alpha", "rad") == "alpha_rad"


def test_a_branch_of_a_sized_block_has_its_units_too() -> None:
    start = rs.find_orbits(BLOCK, SHAKING, max_period=1, seeds=8)[:1]
    for branch in rs.branches.find_branches(start, "amplitude", (1.9, 2.1), max_period=1):
        frame = branch.to_dataframe()
        expected = one("amplitude") * frame["amplitude"]
        np.testing.assert_allclose(frame["accel_g"], expected, rtol=1e-14)
        np.testing.assert_allclose(frame["highest_deg"], one("highest") * frame["highest"])


SIZE = "--width-m 0.4 --height-m 2 -r 0.9"
POINT = f"{SIZE} --accel-g 0.4 --freq-hz 2"
PLANE = f"{SIZE} --accel-g 0.2:0.6:2 --freq-hz 1:3:2"


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        (f"simulate {POINT} --cycles 2", {"time_s", "angle_deg", "base_acceleration_g"}),
        (f"steady {POINT}", {"accel_g", "freq_hz", "velocity_deg_s", "peak_deg"}),
        (f"steady {PLANE}", {"accel_g", "freq_hz", "velocity_deg_s", "peak_deg"}),
        (f"attractor {POINT}", {"speed_deg_s"}),
        (f"orbits {POINT} --seeds 8 --max-period 1", {"highest_deg", "speed_deg_s"}),
        (
            f"bifurcate {SIZE} --accel-g 0.4 --freq-hz 1.9:2.1:3 --max-period 1",
            {"accel_g", "freq_hz", "highest_deg", "lowest_deg"},
        ),
        (
            f"basins {POINT} --angles=-1:1:4 --velocities=-1:1:4",
            {"angle_deg", "velocity_deg_s"},
        ),
        (
            f"basins {POINT} --pulse one-sine --angles=-1:1:4 --velocities=-1:1:4",
            {"angle_deg", "velocity_deg_s", "peak_deg"},
        ),
        (f"map {PLANE}", {"accel_g", "acceleration_m_s2", "frequency_hz"}),
    ],
)
def test_tables_of_a_sized_block_are_in_its_units_and_those_of_a_bare_one_are_not(
    command: str, expected: set[str], tmp_path: Path
) -> None:
    file = tmp_path / "table.csv"
    assert rocksteady(f"{command} --csv", file).code in (0, 3)
    with file.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert expected <= set(rows[0])
    dimensionless = {
        unit_name: name
        for name, (unit_name, _) in CONVERSIONS.items()
        if name in rows[0] and unit_name in expected
    }
    for row in rows:
        for unit_name, name in dimensionless.items():
            given, value = row[unit_name], row[name]
            assert (given == "") == (value == "")
            if value:
                block = BLOCK
                assert float(given) == pytest.approx(one(name, block) * float(value), rel=1e-12)
        if "acceleration_m_s2" in row:
            assert float(row["accel_g"]) * 9.80665 == pytest.approx(float(row["acceleration_m_s2"]))
