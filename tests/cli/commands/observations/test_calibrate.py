"""`rocksteady calibrate`: its contract, its folder, its refusals."""

import csv
import json
from pathlib import Path

import pytest

from rocksteady import Block, Linear
from rocksteady.calibration import make_synthetic_tests
from rocksteady.export import write_tests
from rocksteady.motions import make_synthetic_suite
from tests.cli.program import refused, rocksteady
from tests.descriptions import fits
from tests.show.calibrated import without_pictures

FEW = "--most-runs 100 --model linear"


@pytest.fixture(scope="module", name="table")
def _table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("shaken") / "tests"
    column = Block.rectangle(width=0.15, height=0.6)
    made = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    return write_tests(folder, made)


def test_json_has_the_scores_and_one_object(table: Path) -> None:
    ran = rocksteady(f"calibrate {FEW} --json --tests", table)
    assert (ran.code, ran.json["schema"]) == (3, "rocksteady/calibrate/2")
    values = ran.json
    assert set(values["scores"]) == {"predicted", "block", "logistic", "base rate"}
    assert values["tests"] == 16
    assert values["runs"] == {"synthetic block": 100}
    assert values["model"] == "linear"
    assert values["folds"] == "group"
    assert values["synthetic"] is False
    assert set(values["hashes"]) >= {"tests.csv", "objects.csv"}
    assert {row["parameter"] for row in values["parameters"]} >= {"alpha_rad", "restitution"}


def test_the_folder_predicts_without_the_records(table: Path, tmp_path: Path) -> None:
    out, rows = tmp_path / "fit", tmp_path / "rows.csv"
    with without_pictures():
        ran = rocksteady(f"calibrate {FEW} --seed 1 --tests", table, "--out", out, "--csv", rows)
    assert ran.code == 3
    assert fits("\n".join(line for line in ran.out.splitlines() if str(tmp_path) not in line))
    assert "report.html" in ran.err
    assert json.loads((out / "fit.json").read_text(encoding="utf-8"))["seed"] == 1
    assert rows.read_bytes() == (out / "predictions.csv").read_bytes()
    command = f"rocksteady calibrate {FEW} --seed 1 --tests"
    assert command in (out / "report.html").read_text(encoding="utf-8")

    record = next(table.parent.glob("synthetic*"))
    found = rocksteady("predict --json --fit", out, "--record", record, "--scale", "0.2,1,20")
    assert (found.code, found.json["schema"]) == (3, "rocksteady/predict/1")
    weak, even, strong = found.json["predictions"]
    assert [row["test"].partition(" x ")[2] for row in (weak, even, strong)] == ["0.2", "", "20"]
    assert weak["p"] < even["p"] < strong["p"]
    assert weak["block"] < strong["block"]
    assert not weak["held_out"]

    again = tmp_path / "again.csv"
    assert rocksteady("predict --fit", out, "--tests", table, "--csv", again).code == 0
    with again.open(encoding="utf-8", newline="") as stream:
        held = list(csv.DictReader(stream))
    with rows.open(encoding="utf-8", newline="") as stream:
        before = list(csv.DictReader(stream))
    assert [row["p"] for row in held] == [row["p"] for row in before]
    assert all(row["held_out"] == "True" for row in held)

    line = refused(f"calibrate {FEW} --tests", table, "--out", out)
    assert "it holds fit.json" in line
    line = refused("predict --fit", out, "--record", record, "--object", "vase")
    assert "--object = 'vase'" in line


def test_no_file_that_is_read_is_written_over(table: Path) -> None:
    record = next(table.parent.glob("synthetic*"))
    for file in (table, table.parent / "objects.csv", record):
        before = file.read_bytes()
        ran = rocksteady(f"calibrate {FEW} --force --tests", table, "--csv", file)
        assert ran.code == 2
        assert "this file is read" in ran.err
        assert file.read_bytes() == before


def test_the_flags_that_clean_a_record_clean_those_of_a_table(table: Path, tmp_path: Path) -> None:
    out = tmp_path / "fit"
    flags = "--baseline pre:0.5 --filter 0.2:15 --trim 0.5:"
    with without_pictures():
        ran = rocksteady(f"calibrate {FEW} {flags} --json --tests", table, "--out", out)
    remark = "Each record was cleaned: baseline pre:0.5, filter 0.2 to 15 Hz, trim from 0.5 s."
    assert remark in ran.json["warnings"]
    assert remark in (out / "report.html").read_text(encoding="utf-8")
    record = next(table.parent.glob("synthetic*"))
    for tests in (["--tests", table], ["--record", record]):
        assert remark in rocksteady(f"predict {flags} --json --fit", out, *tests).json["warnings"]
    run = rocksteady(f"simulate {flags} --width-m 0.15 --height-m 0.6 --json --record", record)
    steps = [words.partition(":")[0] for words in run.json["record_processing"]]
    assert steps[-3:] == ["baseline", "filter", "trim"]
    for flag, value in (("--filter", ":900"), ("--trim", "0:9999"), ("--baseline", "pre:999")):
        line = refused(f"calibrate {FEW} {flag} {value} --tests", table)
        assert line.startswith(f"rocksteady: {flag} = '{value}'")
