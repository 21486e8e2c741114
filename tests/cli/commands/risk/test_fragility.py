"""`rocksteady fragility`: its JSON, its files, folders with broken records, and refusals."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Block, compute_fragility, open_store, read_record
from rocksteady.risk import Levels, RestitutionBand
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady

BLOCK = "--width-m 0.32 --height-m 1.8"
FEW = f"fragility {BLOCK} -r housner --levels 0.3,0.8,2"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("suite")
    for seed in range(1, 5):
        at2(place / f"G{seed}090.AT2", samples(seed), dt_s=0.01 * (1 + seed))
    return place


def test_the_json_keeps_the_contract(folder: Path) -> None:
    ran = rocksteady(f"{FEW} --json --records", folder)
    assert (ran.code, ran.err) == (3, ""), "4 records are no answer"
    values = ran.json
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
    assert [row["file"] for row in values["files"]] == [str(file) for file in files]


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
def test_runs_are_kept_and_continued(folder: Path, tmp_path: Path) -> None:
    store = tmp_path / "runs.zarr"
    first = rocksteady(f"{FEW} --json --records {folder} --out {store}")
    assert "it exists" in refused(f"{FEW} --records {folder} --out {store}")
    again = rocksteady(f"{FEW} --json --records {folder} --out {store} --resume")
    assert again.json["shares"] == first.json["shares"]
    shown = rocksteady(f"{FEW} --records {folder} --out {store} --resume").out
    assert "--plot fragility.png" in shown
    assert "--resume" not in shown, "without its store nothing is resumed"
    assert int(np.prod(open_store(store).status.shape)) == 12


def test_restitutions_reach_from_that_of_the_block_to_its_root(folder: Path) -> None:
    default = rocksteady(f"fragility {BLOCK} --levels 1 --json --records", folder)
    e = Block.rectangle(width=0.32, height=1.8).restitution
    assert default.json["restitution"][0] == pytest.approx(np.linspace(e, math.sqrt(e), 5))
