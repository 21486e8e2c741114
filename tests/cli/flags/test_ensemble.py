"""Suites of `--records`: what is a horizontal motion of the ground, and what is left out."""

from dataclasses import replace
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest

from rocksteady.records import read
from rocksteady.records.core.recording import Position
from rocksteady.records.suite import INCLUDABLE
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every
from tests.records.writers import knet

BLOCK = "--width-m 0.3 --height-m 1.8"
FEW = f"fragility {BLOCK} -r housner --levels 0.3,0.8 --no-reverse --records"


def table(file: Path, *names: str) -> Path:
    """Write a table of two seconds with a column for each name."""
    columns = [0.02 * np.arange(101), *(samples(seed)[:101] for seed in range(1, 1 + len(names)))]
    rows = [",".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True)]
    file.write_text("\n".join([",".join(["time (s)", *names]), *rows]) + "\n", "utf-8")
    return file


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of two stations, with channels and files of every kind."""
    place = tmp_path_factory.mktemp("suite")
    for name, seed, component in (("H-N", 1, "000"), ("H-W", 2, "270"), ("H-V", 3, "UP")):
        at2(place / f"{name}.AT2", 0.05 ** (component == "UP") * samples(seed), component=component)
    for name, component in (("F-R", "FN"), ("X", "XYZ")):
        file = at2(place / f"{name}.AT2", samples(4), component=component)
        file.write_text(file.read_text().replace("Hut", "Shed"))
    counts = np.rint(981.0 * samples(5)[:600] * 6182761 / 3920).astype(np.int64)
    (place / "B.NS1").write_text(knet(counts, rate=50, direction="1"))
    (place / "B.UD1").write_text(knet(counts, rate=50, direction="3"))
    table(place / "plain.csv", "acc (g)")
    table(place / "speed.csv", "vel (cm/s)")
    table(place / "open.csv", "acc")
    (place / "event.json").write_text('{"magnitude": 6}\n')
    (place / "README").write_text("About these files.\n")
    (place / "a.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(64))
    with ZipFile(place / "b.xlsx", "w") as sheet:
        sheet.writestr("xl/workbook.xml", "<workbook/>")
    return place


def test_a_suite_has_the_horizontal_motions_of_the_ground(folder: Path) -> None:
    ran = rocksteady(FEW, folder)
    assert (
        "3 records, 1 of unstated direction; 6 channels left out: 1 borehole, 1 rotated, "
        "1 unknown direction, 1 velocity, 2 vertical"
    ) in (words := " ".join(ran.out.split()))
    assert "6 runs, 3 records" in words
    assert "1 not understood" in words
    assert len(ran.out.splitlines()) <= 9
    # The one record that cannot be read; warnings are those of channels that are taken.
    assert ran.err == (
        f"rocksteady: {folder / 'open.csv'} is left out: the file does not state the unit of its "
        "numbers\n"
    )
    values = rocksteady(f"{FEW} {folder} --json").json
    assert values["unstated_direction"] == [str(folder / "plain.csv")]
    assert {(Path(each["file"]).name, each["channel"]) for each in values["left_out"]} == {
        *(("B.NS1", "N-S"), ("B.UD1", "U-D"), ("F-R.AT2", "FN"), ("H-V.AT2", "UP")),
        *(("X.AT2", "XYZ"), ("speed.csv", None), ("open.csv", None)),
        *((name, None) for name in ("README", "a.png", "b.xlsx", "event.json")),
    }
    more = rocksteady(f"{FEW} {folder} --more").out
    assert all(Path(each["file"]).name in more for each in values["left_out"])


@every(
    "command",
    [
        f"overturn {BLOCK} --resolution 0.1 --scales 1:2",
        "facade wall.toml",
        "back-analyse --survey survey.csv --levels 4 --draws 2 --trials 0 --temper 1",
    ],
)
def test_every_command_counts_them_alike(
    command: str, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wall.toml").write_text('[facade]\nname = "front"\nthickness_m = 0.3\nheight_m = 3.0\n')
    head = "name,width_m,height_m,outcome\n"
    Path("survey.csv").write_text(f"{head}A,0.15,0.9,fell\nB,0.3,0.9,stood\n")
    command = f"{command} --records {folder}"
    same = rocksteady(f"{FEW} {folder} --json").json
    values = rocksteady(f"{command} --json").json
    for key in ("left_out", "unstated_direction"):
        assert values[key] == same[key]
    words = " ".join(rocksteady(command).out.split())
    assert "3 records, 1 of unstated direction; 6 channels left out: 1 borehole" in words


@every(
    ("flags", "names"),
    [
        ("--include rotated", {"F-R"}),
        ("--include unknown,borehole", {"X", "B.NS1"}),
        ("--include unknown,borehole --pair", {"X", "B.NS1"}),
    ],
)
def test_kinds_are_included(flags: str, names: set[str], folder: Path) -> None:
    plain = rocksteady(f"{FEW} {folder} --json").json["files"]
    values = rocksteady(f"{FEW} {folder} --json {flags}").json
    added = {each["file"] for each in values["files"]} - {each["file"] for each in plain}
    assert {Path(file).name.removesuffix(".AT2") for file in added} == names


def test_pairs_take_verticals_of_the_ground_alone(folder: Path) -> None:
    """The two horizontal channels of the hut have a vertical one, a borehole's have none."""
    values = rocksteady(f"{FEW} {folder} --json --pair --include borehole").json
    assert values["vertical"] == ["without", "with"]
    assert len(values["files"]) == values["records"] == 4
    assert values["runs"] == 2 * 4 * 2, "what has no vertical counts twice: records weigh the same"
    left = {Path(each["file"]).name: each["why"] for each in values["left_out"]}
    assert "H-V.AT2" not in left
    assert "no horizontal channel goes with it" in left["B.UD1"]


@every(("position", "vertical"), [("surface", ["without", "with"]), ("borehole", ["without"])])
def test_a_vertical_below_ground_is_not_paired(
    position: Position, vertical: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (across,) = read.read_recordings(at2(tmp_path / "a.AT2", samples()))
    (up,) = read.read_recordings(at2(tmp_path / "b.AT2", 0.05 * samples(2), component="UP"))
    channels = (across, replace(up, path=across.path, position=position))
    monkeypatch.setattr(read, "read_recordings", lambda *_, **__: channels)
    values = rocksteady(FEW, across.path, "--pair", "--json").json
    assert values["vertical"] == vertical
    assert [row["channel"] for row in values["left_out"]] == ["UP"] * (position == "borehole")


def test_a_channel_that_is_named_is_taken_whatever_its_kind(tmp_path: Path) -> None:
    file = table(tmp_path / "two.csv", "radial acc (g)", "acc z (g)")
    assert "1 rotated, 1 vertical; add --include rotated" in refused(FEW, file)
    assert rocksteady(FEW, file, "--channel", 1, "--json").json["records"] == 1
    assert "1 vertical; see `rocksteady record" in refused(FEW, file, "--channel", 2)


def test_what_is_refused(folder: Path, tmp_path: Path) -> None:
    assert "save the sheet as CSV (UTF-8)" in refused(FEW, folder / "b.xlsx")
    assert "open.csv' is not valid: the file does not state the unit" in refused(
        FEW, folder / "open.csv"
    )
    line = refused(f"{FEW} {folder} --include borehole,roof")
    assert "--include = 'roof'" in line
    assert all(kind in line for kind in INCLUDABLE)
    assert "--include" in refused(f"{FEW.removesuffix(' --records')} --example --include rotated")
    assert "none of its files has a horizontal record" in refused(FEW, tmp_path)
