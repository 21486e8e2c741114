"""`rocksteady map --fate`: the contract of the command, asked whether the block falls."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, State, Steady, map_fates, open_store
from rocksteady.cli.flags.parsing import axis
from tests.cli.program import refused, rocksteady
from tests.every import every

MAP = "map -A 0.5:5:7 -W 1:8:9 -r 0.8 --start 0,0.3 --fate"
GRID = {"amplitude": axis("", "0.5:5:7"), "frequency_ratio": axis("", "1:8:9")}
BLOCK = DimensionlessBlock(restitution=0.8)
START = State(angle=0.0, velocity=0.3)


@pytest.mark.parametrize(("flags", "cycles"), [("", 200), ("--cycles 20", 20)])
def test_the_json_keeps_the_contract(flags: str, cycles: int) -> None:
    ran = rocksteady(f"{MAP} {flags} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["schema"] == "rocksteady/map/1"
    fate = map_fates(BLOCK, axes=GRID, start=START, cycles=cycles).fate
    words = ("rocking", "at-rest", "overturned", "undecided", "no-start")
    counts = [int((fate == code).sum()) for code in (0, 1, 2, 4, -1)]
    assert values["counts"] == dict(zip(words, counts, strict=True)) | {"not-computed": 0}
    assert values["cells"] == values["computed"] == sum(counts) == 63
    assert values["seconds"] > 0.0
    assert (values["store"], values["cycles"], values["fate"]) == (None, cycles, True)
    assert "subharmonic" not in values["counts"]


def test_without_the_flag_it_says_so() -> None:
    assert rocksteady("map -A 1:2:2 -W 3 -r 0.8 --json").json["fate"] is False


def test_the_text_says_what_there_is() -> None:
    ran = rocksteady(f"{MAP} --more")
    assert ran.code == 0
    lines = ran.out.splitlines()
    assert lines[0].startswith("From 0,0.3 it falls in ")
    assert "The block after 200 periods: restitution 0.8, from 0,0.3" in ran.out
    assert re.search(r"^fate +cells +share$", ran.out, re.MULTILINE)
    assert re.search(r"^rocking +\d+ +\d+\.\d\d %$", ran.out, re.MULTILINE)
    assert max(map(len, lines)) <= 80


def test_what_is_written_is_what_was_found(tmp_path: Path) -> None:
    files = {end: tmp_path / f"a.{end}" for end in ("png", "csv", "nc", "zarr")}
    ran = rocksteady(
        f"{MAP} --plot {files['png']} --csv {files['csv']} --netcdf {files['nc']}",
        "--out",
        files["zarr"],
    )
    assert ran.code == 0
    assert files["png"].read_bytes().startswith(b"\x89PNG")
    found = map_fates(BLOCK, axes=GRID, start=START)
    stored = open_store(files["zarr"])
    assert stored.equals(found)
    with files["csv"].open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    words = found.fate.attrs["flag_meanings"].split()
    assert [words.index(row["fate"]) for row in rows] == found.fate.values.ravel().tolist()
    again = rocksteady(f"{MAP} --json --resume --out", files["zarr"]).json
    assert again["computed"] == 0
    assert "holds another sweep" in refused(f"{MAP} --cycles 7 --resume --out", files["zarr"])
    assert "holds another sweep" in refused(MAP.replace("--fate", "--resume --out"), files["zarr"])


def test_a_steady_start_that_is_none_is_counted() -> None:
    values = rocksteady("map -A 0.5:4:5 -W 1:8:5 -r 0.8 --start steady:2 --fate --json").json
    axes = {"amplitude": np.linspace(0.5, 4.0, 5), "frequency_ratio": np.linspace(1.0, 8.0, 5)}
    found = map_fates(BLOCK, axes=axes, start=Steady(branch=2))
    assert values["counts"]["no-start"] == int((found.fate == -1).sum()) > 0


def test_a_refined_map_says_how_much_was_computed() -> None:
    values = rocksteady(f"{MAP.replace(':7', ':57').replace(':9', ':57')} --refine 8 --json").json
    assert values["cells"] == sum(values["counts"].values()) == 57 * 57
    assert 64 < values["computed"] < 57 * 57


@every(
    ("flags", "said"),
    [
        ("--cycles 0", "--cycles = 0 is not valid"),
        ("--cycles 1000001", "--cycles = 1000001 is not valid"),
        ("--refine 4 --out a.zarr", "a store holds every cell"),
    ],
)
def test_what_makes_no_map_is_refused(flags: str, said: str) -> None:
    assert said in refused(f"{MAP} {flags}")
