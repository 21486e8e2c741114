"""`rocksteady fragility`: its JSON, its files, folders with broken records, and refusals."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
import xarray

from rocksteady import Block, compute_fragility, open_store, read_record
from rocksteady.risk import Levels, RestitutionBand
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every

BLOCK = "--width-m 0.32 --height-m 1.8"
FEW = f"fragility {BLOCK} -r housner --levels 0.3,0.8,2"
EXAMPLE = "fragility --example -r housner --levels 0.4,0.8,1.6"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("suite")
    for seed in range(1, 5):
        at2(place / f"G{seed}090.AT2", samples(seed), dt_s=0.01 * (1 + seed))
    return place


def test_the_json_keeps_the_contract(folder: Path) -> None:
    ran = rocksteady(f"{FEW} --json --records", folder)
    assert ran.err == ""
    values = ran.json
    assert values["schema"] == "rocksteady/fragility/1"
    files = sorted(folder.iterdir())
    found = compute_fragility(
        Block.rectangle(width=0.32, height=1.8),
        [read_record(file) for file in files],
        levels=Levels(levels=[0.3, 0.8, 2.0]),
        restitution=RestitutionBand(draws=1),
    )
    same = found.to_dict()
    for key in ("shares", "fits", "runs", "records", "levels", "warnings", "measure"):
        assert repr(values[key]) == repr(same[key]), key
    assert values["runs"] == 4 * 3
    assert values["seconds"] > 0.0
    for row in values["shares"]:
        assert {"damage_state", "measure", "level", "share", "low", "high", "runs"} <= set(row)
    for row in values["fits"]:
        assert set(row) == {"damage_state", "median", "beta", "misfit"}
    assert [row["file"] for row in values["files"]] == [str(file) for file in files]
    assert values["left_out"] == []
    assert values["synthetic"] is False


def test_fewer_than_11_records_are_no_answer(folder: Path) -> None:
    ran = rocksteady(f"{FEW} --records", folder)
    assert ran.code == 3
    assert ran.out.startswith("No answer: 4 records")
    assert rocksteady(f"{EXAMPLE} --quiet").code == 0


def test_levels_reach_from_where_nothing_lifts_to_where_nearly_all_fall() -> None:
    values = rocksteady("fragility --example -r 0.9 --json").json
    shares: dict[str, list[float]] = {row["damage_state"]: [] for row in values["shares"]}
    for row in values["shares"]:
        shares[row["damage_state"]].append(row["share"])
    assert shares["uplift"][0] == 0.0
    assert values["levels"][0] < values["uplift_level"] < values["levels"][1]
    assert shares["overturned"][-1] >= 0.95
    pairs = zip(shares["overturned"], shares["theta/alpha > 1"], strict=True)
    assert all(fell <= beyond for fell, beyond in pairs), "states are nested"


def test_levels_end_where_it_slides() -> None:
    free = rocksteady("fragility --example -r 0.9 --json").json
    values = rocksteady("fragility --example -r 0.9 --friction 0.3 --json").json
    assert values["friction_needed"] <= values["friction"] == 0.3
    assert values["levels"] == free["levels"][: len(values["levels"])]
    assert free["friction_needed"] > 0.3
    assert free["friction"] is None
    assert "rocking takes 0.178 or more" in refused("fragility --example --friction 0.1")


def test_a_broken_record_is_named_and_the_rest_is_run(folder: Path, tmp_path: Path) -> None:
    place = tmp_path / "suite"
    place.mkdir()
    for file in folder.iterdir():
        (place / file.name).write_bytes(file.read_bytes())
    cut = (place / "G2090.AT2").read_text()
    (place / "G2090.AT2").write_text(cut[: len(cut) // 2])
    (place / "README.md").write_text("Four records.\n")
    # Motion that no scale makes an earthquake's, as of a channel that was dead.
    at2(place / "G4090.AT2", 1e-300 * samples(4))
    (place / ".hidden").write_text("no record")
    ran = rocksteady(f"{FEW} --json --records", place)
    broken = {"G2090.AT2", "G4090.AT2", "README.md"}
    assert ran.json["records"] == 2
    assert {Path(row["file"]).name for row in ran.json["left_out"]} == broken
    # A file that is no record is counted, and named with --more alone.
    for name in broken - {"README.md"}:
        assert f"{place / name} is left out: " in ran.err
    assert "README" not in ran.err
    text = rocksteady(f"{FEW} --more --records", place).out
    assert "2 records; 3 files left out: 1 damaged, 1 no record, 1 not understood" in " ".join(
        text.split()
    )
    assert "README.md" in text
    assert ".hidden" not in text + ran.err


def test_a_folder_without_a_record_is_refused(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("No records.\n")
    assert "none of its files has a horizontal record; 1 file left out" in refused(
        f"{FEW} --records", tmp_path
    )
    assert "it does not exist" in refused(f"{FEW} --records", tmp_path / "no")
    assert list(tmp_path.iterdir()) == [tmp_path / "README.md"]


def test_the_same_record_twice_is_named(folder: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.AT2"
    copy.write_bytes((folder / "G1090.AT2").read_bytes())
    ran = rocksteady(f"{FEW} --json --records {folder} --records", copy)
    assert ran.json["records"] == 4
    assert "Left out, with the samples of other records: copy." in ran.json["warnings"]


def test_a_vertical_channel_is_run_with_its_station(tmp_path: Path) -> None:
    for name, seed, component in (("H1-N", 1, "000"), ("H1-W", 2, "090"), ("H1-V", 3, "UP")):
        part = 0.05 if component == "UP" else 1.0  # so weak that it keeps its contact at any level
        at2(tmp_path / f"{name}.AT2", part * samples(seed), component=component)
    alone = rocksteady(f"{FEW} --json --records", tmp_path)
    assert alone.json["vertical"] == ["without"]
    assert alone.json["records"] == 2
    assert [row["channel"] for row in alone.json["left_out"]] == ["UP"]
    paired = rocksteady(f"{FEW} --json --pair --records", tmp_path)
    assert paired.json["vertical"] == ["without", "with"]
    assert paired.json["records"] == 2
    assert paired.json["runs"] == 2 * alone.json["runs"]
    assert paired.json["left_out"] == []
    vertical = at2(tmp_path / "G2-V.AT2", 0.05 * samples(4), component="UP")
    vertical.write_text(vertical.read_text().replace("Hut", "Shed"))
    lone = rocksteady(f"{FEW} --more --pair --records", tmp_path)
    assert "2 records; 1 channel left out: 1 vertical" in lone.out
    assert "vertical, and no horizontal" in lone.out


def test_with_a_mass_the_runs_have_forces(folder: Path, tmp_path: Path) -> None:
    """Of a block that rocks and stands, between its weight and twice that."""
    table, given = tmp_path / "runs.csv", f"{FEW} --json --csv {tmp_path / 'runs.csv'}"
    assert rocksteady(f"{given} --mass-kg 200 --records", folder).code == 3
    with table.open(newline="") as lines:
        down = [float(row["base_force_down_kn"]) for row in csv.DictReader(lines)]
    known = [force for force in down if not math.isnan(force)]
    assert known
    assert all(0.9 * 200.0 < 1000.0 * force / 9.80665 < 2.0 * 200.0 for force in known)


@pytest.mark.slow
def test_runs_are_kept_continued_and_written(folder: Path, tmp_path: Path) -> None:
    names = ("runs.zarr", "runs.csv", "runs.nc", "curves.png")
    store, table, data, picture = (tmp_path / name for name in names)
    first = rocksteady(
        f"{FEW} --json --records {folder} --out {store} --csv {table} --netcdf {data} "
        f"--plot {picture}"
    )
    assert first.code == 3
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "it exists" in refused(f"{FEW} --records {folder} --out {store}")
    again = rocksteady(f"{FEW} --json --records {folder} --out {store} --resume")
    assert again.json["shares"] == first.json["shares"]
    shown = rocksteady(f"{FEW} --records {folder} --out {store} --resume").out
    assert "--plot fragility.png" in shown
    assert "--resume" not in shown, "without its store nothing is resumed"
    assert int(np.prod(open_store(store).status.shape)) == 12
    with table.open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) == 4 * 3 * 2
    assert {"record", "level_m_s", "direction", "status", "peak_angle", "uplift_time_s"} <= set(
        rows[0]
    )
    with xarray.open_dataset(data) as kept:
        assert kept.attrs["kind"] == "rocking ensemble"
        assert dict(kept.sizes)["record"] == 4
        fell = int((kept.status == 2).sum())
    assert sum(row["status"] == "overturned" for row in rows) == fell


@pytest.mark.slow
@every("workers", [1, 2, 3])
def test_workers_do_not_change_a_digit(folder: Path, workers: int) -> None:
    one = rocksteady(f"{FEW} --json --executor serial --records", folder).json
    other = rocksteady(f"{FEW} --json --workers {workers} --records", folder).json
    assert repr(one["shares"]) == repr(other["shares"])


def test_a_band_of_restitutions_and_a_measure_with_a_period(folder: Path) -> None:
    ran = rocksteady(
        f"fragility {BLOCK} -r 0.85:0.95 --draws 3 --measure sa_g:0.5 --levels 0.4:1.2:3 "
        f"--states overturned --no-reverse --json --records",
        folder,
    )
    values = ran.json
    assert values["restitution"] == [pytest.approx([0.85, 0.9, 0.95])]
    assert values["measure"] == "sa_g_0.5s"
    assert values["levels"] == pytest.approx([0.4, 0.8, 1.2])
    assert values["directions"] == ["as recorded"]
    assert values["runs"] == 4 * 3 * 3
    assert {row["damage_state"] for row in values["shares"]} == {"overturned"}
    factors = rocksteady(f"fragility {BLOCK} -r 0.9 --scale 1:3:3 --json --records", folder)
    assert factors.json["measure"] == "scale"
    assert factors.json["levels"] == [1.0, 2.0, 3.0]
    assert factors.json["scale_factor_max"] == 3.0
    default = rocksteady(f"fragility {BLOCK} --levels 1 --json --records", folder)
    e = Block.rectangle(width=0.32, height=1.8).restitution
    assert default.json["restitution"][0] == pytest.approx(np.linspace(e, math.sqrt(e), 5))


def test_the_example_says_that_its_motions_are_synthetic() -> None:
    short = rocksteady(EXAMPLE).out
    assert short.startswith("Falls in 13 of 24 runs at 0.4 m/s, the lowest level: 54 % (90 %: ")
    assert rocksteady("fragility --example -r housner --quiet").out.startswith("Half fall at ")
    assert len(short.splitlines()) <= 9
    ran = rocksteady(f"{EXAMPLE} --more")
    assert ran.code == 0
    assert "synthetic motions" in ran.out
    assert "24 records" in ran.out


@every(
    ("flags", "words"),
    [
        ("--measure pga", "--measure = 'pga' is not accepted: the measures are"),
        ("--measure pga_g:1", "has no period"),
        ("--measure sa_g:x", "it must be a number"),
        ("--measure significant_5_75_s", "scaling a record does not change it"),
        ("--levels 0,1", "--levels"),
        ("--levels 1,1", "--levels"),
        ("--levels x", "--levels = 'x'"),
        ("--scale 1:2:3 --levels 1", "--scale and --levels are both given"),
        ("-r 0.9:0.8", "--restitution = 0.9"),
        ("-r 0.9:x", "a band has two ends"),
        ("-r 0.9 --draws 3", "without --scatter"),
        ("--draws 0", "--draws = 0"),
        ("--mass-kg -3", "--mass-kg = -3.0 is not valid: it must lie in (0, 1000000000]"),
        ("--scatter 2", "--scatter = 2"),
        ("--states fallen", "the states without a peak"),
        ("--states uplift,uplift", "each once"),
        ("--measure sa_g:1e9", "--measure"),
        ("--seed -1", "--seed = -1"),
        ("--friction -1", "--friction = -1.0 is not valid"),
        ("--example", "--example has synthetic motions"),
        ("--include vertical", "--include = 'vertical' is not valid: it must be a kind of"),
        ("--resume", "without --out there is no store"),
    ],
)
def test_what_is_wrong_is_one_line(folder: Path, flags: str, words: str) -> None:
    assert words in refused(f"fragility {BLOCK} {flags} --records", folder)


def test_a_block_is_needed(folder: Path) -> None:
    assert "fragility is of a block with a size" in refused("fragility -r 0.9 --records", folder)
    assert "no block is described" in refused("fragility --width-m 0.3 --records", folder)
