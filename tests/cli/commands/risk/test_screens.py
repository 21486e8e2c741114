"""`rocksteady screens`: its contract, its text, its files and its refusals."""

from pathlib import Path

import pytest

from rocksteady import Demand, read_record
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady

BLOCK = "screens --width-m 0.32 --height-m 1.8"
TABLE = "# damping 0.05\n0 0.35\n0.1 0.8\n0.4 0.8\n1 0.32\n2 0.16\n4 0.04\n"


@pytest.fixture(name="table")
def _table(tmp_path: Path) -> Path:
    file = tmp_path / "floor.txt"
    file.write_text(TABLE, encoding="utf-8")
    return file


def test_a_spectrum_brings_its_damping_or_gets_it_from_a_flag(table: Path) -> None:
    bare = table.with_name("bare.csv")
    bare.write_text("".join(f"{row}\n" for row in TABLE.splitlines() if row[0] != "#"), "utf-8")
    stated = rocksteady(f"{BLOCK} --json --spectrum", table).json["screens"][6]
    given = rocksteady(f"{BLOCK} --damping 0.05 --json --spectrum", bare).json["screens"][6]
    other = rocksteady(f"{BLOCK} --damping 0.02 --json --spectrum", bare).json["screens"][6]
    assert stated.pop("verdict").replace("; 5 % by its header", "") == given.pop("verdict")
    assert stated == given
    assert stated["unit"] == "rad"
    assert 0.0 < other["value"] < stated["value"]  # the same table scaled by less
    assert "states 0.05" in refused(f"{BLOCK} --damping 0.02 --spectrum", table)


def test_a_record_is_the_demand_and_can_be_scaled_to_a_pga(tmp_path: Path) -> None:
    file = at2(tmp_path / "made.AT2", samples()[:200])
    record = read_record(file)
    values = rocksteady(f"{BLOCK} --json --record", file).json
    assert values["pga_g"] == pytest.approx(record.peak_acceleration_m_s2 / 9.80665)
    expected = Demand.from_record(record)
    assert values["pgv_m_s"] == pytest.approx(expected.pgv_m_s)
    scaled = rocksteady(f"{BLOCK} --pga-g 0.5 --json --record", file).json
    assert scaled["pga_g"] == pytest.approx(0.5)
    assert scaled["pgv_m_s"] / values["pgv_m_s"] == pytest.approx(0.5 / values["pga_g"])


def test_vertical_flags_reach_uplift_and_the_spectrum_row(table: Path) -> None:
    more = "--vertical-g 0.5 --vertical-share 0.4 --vertical-per-horizontal 0.67 --json --spectrum"
    values = rocksteady(f"{BLOCK} {more}", table).json
    assert values["screens"][0]["value"] == pytest.approx(0.8 * 0.32 / 1.8)
    assert values["sa_v_per_sa_h"] == 0.67
    words = rocksteady(f"{BLOCK} --vertical-g 0.5 --vertical-share 0.4 --pga-g 0.1 --pgv-m-s 1").out
    assert "with a vertical peak of 0.5 g" in " ".join(words.split())
