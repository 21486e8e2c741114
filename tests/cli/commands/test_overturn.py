"""`rocksteady overturn`: its contract, its text, its files and what it refuses."""

import csv
import re
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


def test_the_table_has_a_row_a_window() -> None:
    ran = rocksteady(f"{POINT} -A 8 --more")
    assert ran.code == 0
    lines = [" ".join(line.split()) for line in ran.out.splitlines()]
    assert "2 1.22518 2.3144 1 -" in lines
    assert "2 2.3499 the end 0 +" in lines
    assert "6 5.16416 7.66987 1 -" in lines
    assert all(len(line) <= 80 for line in ran.out.splitlines())
    assert "stands" in rocksteady("overturn --pulse one-sine -W 12 -r 0.9 -A 2").out
    many = rocksteady("overturn --pulse type-c2 -W 0.7 -r 0.9 -A 1.2 --resolution 0.01 --more")
    assert "narrower windows are left out" in many.out


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


@every(
    ("command", "words"),
    [
        ("overturn -W 2 -r 0.9", "--pulse"),
        (f"{POINT} --model nonlinear", "--alpha-rad"),
        (f"{POINT} --model exact", "model"),
        ("overturn --pulse bell -W 2 -r 0.9", "no pulse of that name"),
        ("overturn --pulse one-sine -r 0.9", "--frequency-ratio/-W"),
        (f"{POINT} --freq-hz 2", "--freq-hz"),
        (f"{POINT} -A 3:2", "ascend"),
        (f"{POINT} -A 1:20:30", "range"),
        (f"{POINT} -A many", "number"),
        (f"{POINT} -A nan", "ascend"),
        (f"{POINT} -A -1", "-1"),
        (f"{POINT} -A 0:inf", "--amplitude/-A"),
        ("overturn --pulse one-sine -W nan -r 0.9", "--frequency-ratio/-W"),
        ("overturn --pulse one-sine -W 1:6000:5 -r 0.9", "--frequency-ratio/-W"),
        ("overturn --pulse one-sine --freq-hz 0 --block tso-wong-1989", "--freq-hz"),
        ("overturn --pulse one-sine --freq-hz 2 --accel-g 0 --block tso-wong-1989", "--accel-g"),
        (f"{POINT} -A 1e9", "--amplitude/-A"),
        (f"{POINT} --accel-g 1", "needs a block"),
        (f"{POINT} -A 2 --accel-g 1", "both given"),
        (f"{POINT} --resolution 2", "--resolution"),
        (f"{POINT} --oscillations 3", "--oscillations"),
        ("overturn --pulse one-sine -W 0.001 -r 0.9", "--frequency-ratio/-W"),
        ("overturn --pulse one-sine -W 2 -r 0.9 --plot nowhere.png", "two frequencies"),
    ],
)
def test_what_is_refused_says_so_in_one_line(command: str, words: str) -> None:
    assert words in refused(command)


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


@every(
    ("motion", "begin"),
    [
        ("--pulse one-sine --freq-hz 1 --accel-g 0.3:0.5", "0.3 g"),
        ("--record example:near-fault --scales 0.7:1", "0.7 x"),
        ("--pulse one-sine --freq-hz 1:1.1:2 --accel-g 0.3:0.5", "0.3 g"),
        ("--record example:near-fault --record example:firm-ground --scales 0.7:1", "0.7 x"),
    ],
)
@every("way", ["", " --reverse"])
def test_a_fall_at_the_begin_of_the_range_is_called_the_least_searched(
    motion: str, begin: str, way: str
) -> None:
    block = "--left-m .22 --right-m .16 --height-m 1.5 --model linear"
    lines = rocksteady(f"overturn {block} {motion}{way}").out.split("next:")[0]
    said = re.findall(rf"first at {begin}[^,]*,? ?(.{{18}})", " ".join(lines.split()))
    assert said
    assert set(said) == {"the least searched"}


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


@every(
    ("flags", "word"),
    [
        ("--scales 1:2 --pulse one-sine -W 2 -r 0.9", "--scales"),
        ("--kick -r 0.9 -W 2", "--frequency-ratio"),
        ("--pulse one-sine -W 2 -r 0.9 --start 0.1,0", "--start"),
        ("--kick -r 0.9 --at-s 1", "--at-s"),
    ],
)
def test_flags_of_another_search_are_refused(flags: str, word: str) -> None:
    ran = rocksteady(f"overturn {flags}")
    assert ran.code == 2
    assert word.split("--")[1][:5] in ran.err or "-W" in ran.err


@every("text", ["-1", "0:1e9:3", "nan"])
def test_a_moment_of_no_record_is_refused_as_it_was_given(text: str) -> None:
    ran = rocksteady(f"overturn --kick {BODY} --at-s {text}")
    assert ran.code == 2
    assert f"--at-s = '{text}'" in ran.err


def answer(command: str) -> list[str]:
    """Return the lines of an answer, none of them longer than the screen."""
    ran = rocksteady(command)
    lines = ran.out.splitlines()
    assert ran.code == 0
    assert all(len(line) <= 80 for line in lines)
    return [" ".join(line.split()) for line in lines]


def test_the_answer_of_a_pulse_has_the_ends_of_its_windows() -> None:
    command = "overturn --pulse one-sine -W 3 -r 0.9"
    lines = answer(command)
    (row,) = rocksteady(f"{command} --json").json["windows"]
    (low, high), (above, _) = row["intervals"]
    first = f"It falls first at A = {low:.3g}; always from A = {above:.3g} to A = 20 ("
    assert " ".join(lines[:2]).startswith(first)
    assert f"falls A = {low:.3g}-{high:.3g}" in lines
    assert lines[-1] == f"next: rocksteady {command} --more"
    assert len(lines) <= 9


def test_the_answer_of_frequencies_counts_those_at_which_it_stands() -> None:
    lines = answer("overturn --pulse one-sine -W 0.5:12:9 -r 0.9 -A 9")
    rows = rocksteady("overturn --pulse one-sine -W 0.5:12:9 -r 0.9 -A 9 --json").json["windows"]
    falls = [row for row in rows if row["intervals"]]
    assert f"at {len(falls)} of 9 frequencies" in lines[0]
    shown = [line for line in lines if line.startswith("W = ")]
    left = len(falls) - len(shown)
    fall = f"{left} falling, " if left else ""
    more = f"not listed {9 - len(shown)} more with --more: {fall}{9 - len(falls)} standing"
    assert more in lines


def test_the_answer_of_a_kick_is_the_least_of_both_ways() -> None:
    command = "overturn --kick --start 0.5,0 -r 0.9"
    lines = answer(command)
    values = rocksteady(f"{command} --json").json
    assert lines[0] == f"The least kick that fells it is {values['least']:.3g} alpha g/p."
    other = max(row["first"] for row in values["kicks"])
    assert f"the other way -{other:.3g} alpha g/p" in lines


def test_a_kick_at_the_begin_of_the_range_is_the_least_searched() -> None:
    found = find_fatal_kicks(DimensionlessBlock(restitution=0.9), within=(1.5, 4.0))
    text = " ".join(found.summary().split())
    assert "The least kick that fells it is 1.5 alpha g/p, the least searched." in text
    assert "the other way -1.5 alpha g/p, the least searched" in text
    assert "from 1.5 alpha g/p to 4 alpha g/p, both ways" in text
    wider = find_fatal_kicks(DimensionlessBlock(restitution=0.9), within=(0.9, 4.0))
    assert "least searched" not in wider.summary()


def test_the_answer_says_that_it_stands() -> None:
    lines = answer("overturn --pulse one-sine -W 12 -r 0.9 -A 2")
    assert lines[0] == "It stands in the one-sine pulse at W = 12, up to A = 2."
