"""`rocksteady overturn`: its contract, its text, its files and what it refuses."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Record,
    find_fatal_kicks,
    find_overturning_scales,
)
from rocksteady.cli.commands import overturn
from rocksteady.formulas import overturning_impulse
from tests.cli.program import refused, rocksteady
from tests.every import every

POINT = "overturn --pulse one-sine -W 2:6:3 -r 0.9"


def test_a_block_is_told_in_g_and_hz() -> None:
    size = "--width-m 1 --height-m 3 -r 0.85 --gravity-m-s2 9.81"
    values = rocksteady(
        f"overturn --pulse one-sine {size} --accel-g 1 --freq-hz 1 --model linear --json"
    ).json
    (row,) = values["windows"]
    assert row["freq_hz"] == pytest.approx(1.0, rel=1e-14)
    standard = 9.80665 / 9.81
    assert row["intervals_g"][0][0] * standard == pytest.approx(0.451540, abs=5.1e-7)  # M1
    block = Block.rectangle(width=1, height=3, restitution=0.85, gravity=9.81)
    assert values["amplitudes"] == [1.0, pytest.approx(standard / block.alpha)]
    assert values["block"]["alpha_rad"] == block.alpha


@pytest.mark.slow
def test_the_full_equations_keep_the_contract(tmp_path: Path) -> None:
    table, picture = tmp_path / "w.csv", tmp_path / "w.png"
    size = "--alpha-rad 0.25 --p-rad-s 2.14 -r 0.9"
    point = f"overturn --pulse one-sine -W 5:5.5:2 {size} --model nonlinear"
    ran = rocksteady(f"{point} --csv {table} --plot {picture} --json")
    assert ran.code == 0
    assert ran.json["model"] == "nonlinear"
    first, _ = ran.json["windows"]
    ((low, high), (without, top)) = first["intervals"]
    assert (low, high) == (pytest.approx(3.0323392), pytest.approx(6.743019))
    assert (without, top) == (pytest.approx(7.4929997), 20.0)
    assert first["intervals_g"][0][0] == pytest.approx(0.25 * low, rel=1e-14)
    assert first["closed_form"] is None
    assert (first["undecided"], first["unsettled"]) == (0, 0)
    with table.open(encoding="utf-8", newline="") as file:
        assert float(next(csv.DictReader(file))["low"]) == low
    assert picture.stat().st_size > 5000
    text = rocksteady(f"{point} --more").out
    assert "nonlinear model" in " ".join(text.split())
    assert "3.03234" in text


@pytest.mark.slow
def test_the_files_hold_the_same(tmp_path: Path) -> None:
    names = ("w.csv", "w.nc", "w.png", "w.zarr")
    table, data, picture, store = (tmp_path / name for name in names)
    command = f"{POINT} --csv {table} --netcdf {data} --plot {picture} --out {store}"
    ran = rocksteady(f"{command} --json")
    assert ran.code == 0
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    modes = [mode for row in ran.json["windows"] for mode in row["modes"]]
    assert [float(row["low"]) for row in rows] == [mode["interval"][0] for mode in modes]
    assert [int(row["impacts"]) for row in rows] == [mode["impacts"] for mode in modes]
    with xarray.open_dataset(data) as kept:
        assert kept.low.sel(window=0).values.tolist() == [
            mode["interval"][0] for mode in modes[::2]
        ]
    assert picture.stat().st_size > 5000
    again = rocksteady(f"{command} --json --resume").json
    assert again["windows"] == ran.json["windows"]
    assert "exists" in refused(command)


@every("motion", ["--pulse one-sine --freq-hz 1", "--record example:near-fault"])
def test_the_answer_of_an_asymmetric_block_has_the_direction_that_governs(motion: str) -> None:
    command = f"overturn --left-m .22 --right-m .16 --height-m 1.5 --model linear {motion}"
    ahead, back = (rocksteady(f"{command}{way}").out.split("\n  ")[0] for way in ("", " --reverse"))
    values, other = (rocksteady(f"{command}{way} --json").json for way in ("", " --reverse"))
    (row,), (reversed_row,) = values["windows"], other["windows"]
    assert row["opposite"] == pytest.approx(reversed_row["first"], rel=1e-9)
    assert reversed_row["opposite"] == pytest.approx(row["first"], rel=1e-9)
    governs = "The other way it falls first at"
    assert governs in " ".join(ahead.split())
    assert row["opposite"] < row["first"]
    assert governs not in " ".join(back.split())
    assert " the other way    falls first at " in rocksteady(f"{command} --reverse").out
    symmetric = f"overturn --width-m .4 --height-m 1.5 --model linear {motion}"
    assert "other way" not in rocksteady(symmetric).out
    (even,) = rocksteady(f"{symmetric} --json").json["windows"]
    assert even["opposite"] == even["first"]


def test_a_reversed_pulse_is_the_same_pulse_for_the_mirrored_block() -> None:
    point = "overturn --pulse one-sine --freq-hz 1 --model linear --json --height-m 1.2"
    other = rocksteady(f"{point} --left-m 0.25 --right-m 0.15 --accel-g 1").json
    values = rocksteady(f"{point} --left-m 0.15 --right-m 0.25 --accel-g 1 --reverse").json
    (row,), (mirrored,) = values["windows"], other["windows"]
    assert (values["reversed"], other["reversed"]) == (True, False)
    assert row["intervals_g"] != []
    for ends, like in zip(row["intervals_g"], mirrored["intervals_g"], strict=True):
        assert ends == pytest.approx(like, rel=1e-9)
    assert [mode["side"] for mode in row["modes"]] == [-mode["side"] for mode in mirrored["modes"]]


WAVE = "0,0\n0.3,4\n0.6,-4\n0.9,0\n"
BODY = "--width-m 0.4 --height-m 1.6"


def test_the_scales_of_a_record_keep_the_contract(tmp_path: Path) -> None:
    file, table, picture = tmp_path / "wave.csv", tmp_path / "w.csv", tmp_path / "w.png"
    file.write_text("t (s),acc (m/s2)\n" + WAVE, encoding="utf-8")
    ran = rocksteady(
        f"overturn --record {file} {BODY} --scales 0.5:2 --csv {table} --plot {picture} --json"
    )
    assert ran.code == 0
    block = Block.rectangle(width=0.4, height=1.6)
    record = Record(acceleration_m_s2=np.array([0.0, 4.0, -4.0, 0.0]), dt_s=0.3)
    found = find_overturning_scales(block, record, within=(0.5, 2.0))
    (row,) = ran.json["windows"]
    assert row["intervals"] == [list(ends) for ends in found.intervals(0)]
    assert row["intervals_g"][0][0] == pytest.approx(row["first"] * 4.0 / 9.80665)
    assert ran.json["scales"] == [0.5, 2.0]
    with table.open(encoding="utf-8", newline="") as rows:
        assert float(next(csv.DictReader(rows))["low"]) == row["first"]
    assert picture.stat().st_size > 5000


def test_no_scale_above_the_first_that_falls_is_shown_as_standing() -> None:
    """A window too narrow to list, below the one that holds 1, is a fall all the same."""
    record = Record(acceleration_m_s2=np.array([0.0, 4.0, -4.0, 0.0]), dt_s=0.3)
    found = find_overturning_scales(Block.rectangle(width=0.3, height=1.6), record)
    assert any(low < 1.0 < high for low, high in found.intervals(0))
    stands = float(overturn.standing(found).split()[0])
    assert stands < found.first[0]
    narrow = replace(found, first=0.9 * stands * np.ones(1))
    assert overturn.standing(narrow) == ""


def test_a_kick_keeps_the_contract(tmp_path: Path) -> None:
    picture = tmp_path / "k.png"
    ran = rocksteady(f"overturn --kick {BODY} --at-s 0:1:2 --plot {picture} --json")
    assert ran.code == 0
    block = Block.rectangle(width=0.4, height=1.6)
    assert [row["first_m_s"] for row in ran.json["kicks"]] == pytest.approx(
        [overturning_impulse(block)] * 4
    )
    assert picture.stat().st_size > 5000
    assert ran.json["sizes"] == [0.0, 4.0]
    for row in ran.json["kicks"]:
        assert [mode["interval"] for mode in row["modes"]] == row["windows"]
        assert row["modes"][0]["side"] == row["direction"]
        assert row["left_out"] == len(row["left_out_within"]) == 0


def test_a_kick_at_the_begin_of_the_range_is_the_least_searched() -> None:
    found = find_fatal_kicks(DimensionlessBlock(restitution=0.9), within=(1.5, 4.0))
    text = " ".join(found.summary().split())
    assert "The least kick that fells it is 1.5 alpha g/p, the least searched." in text
    assert "the other way -1.5 alpha g/p, the least searched" in text
    assert "from 1.5 alpha g/p to 4 alpha g/p, both ways" in text
    wider = find_fatal_kicks(DimensionlessBlock(restitution=0.9), within=(0.9, 4.0))
    assert "least searched" not in wider.summary()
