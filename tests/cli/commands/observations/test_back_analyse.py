"""`rocksteady back-analyse`: its JSON, its files, and refusals."""

import csv
from pathlib import Path

import pytest

from rocksteady import back_analyse, read_record, read_survey
from rocksteady.calibration import ScanOptions
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady

FEW = "back-analyse --levels 6 --draws 2 --trials 1"
TABLE = "name,width_m,height_m,base,outcome\nA,0.15,0.9,1,fell\nB,0.3,0.9,1,stood\n"


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("survey")
    (folder / "suite").mkdir()
    for seed in range(1, 6):
        at2(folder / "suite" / f"G{seed}090.AT2", samples(seed), dt_s=0.01 * (1 + seed))
    (folder / "cemetery.csv").write_text(TABLE)
    (folder / "prior.toml").write_text('[noise]\nsigma_ln = "0.1:0.3"\n')
    return folder


def test_the_json_is_what_the_function_finds(place: Path) -> None:
    ran = rocksteady(f"{FEW} --json --survey {place / 'cemetery.csv'} --records", place / "suite")
    assert ran.code == 0, ran.err
    assert ran.json["schema"] == "rocksteady/back-analyse/1"
    files = sorted((place / "suite").iterdir())
    found = back_analyse(
        read_survey(place / "cemetery.csv"),
        [read_record(file) for file in files],
        scan=ScanOptions(levels=6, draws=2, trials=1),
    )
    same = found.to_dict()
    for key in ("measures", "record_weights", "temper", "share", "limits", "runs", "bound"):
        assert repr(ran.json[key]) == repr(same[key]), key
    assert (ran.json["objects"], ran.json["fell"], ran.json["records"]) == (2, 1, 5)
    assert ran.json["synthetic"] is False
    assert ran.json["left_out"] == []


def test_files_are_written_and_kept(place: Path, tmp_path: Path) -> None:
    table, picture = tmp_path / "region.csv", tmp_path / "region.png"
    command = (
        f"{FEW} --survey {place / 'cemetery.csv'} --records {place / 'suite'} "
        f"--prior {place / 'prior.toml'} --limits 0.1:3 --temper 0.5 "
        f"--measure pgv_m_s --measure sa_g:0.5 --csv {table} --plot {picture}"
    )
    ran = rocksteady(command)
    assert ran.code == 0, ran.err
    assert "1 of 2 fell: PGV" in ran.out
    with table.open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["pgv_m_s", "sa_g_0.5s", "density", "in_region"]
    first = {float(row["pgv_m_s"]) for row in rows}
    assert min(first) == pytest.approx(0.1)
    assert max(first) == pytest.approx(3.0)
    assert picture.stat().st_size > 10_000
    assert "exists" in refused(command)


def test_a_survey_is_not_written_over_and_a_wrong_row_has_its_line(
    place: Path, tmp_path: Path
) -> None:
    suite = f"--records {place / 'suite'}"
    copy = tmp_path / "cemetery.csv"
    copy.write_text(TABLE)
    words = refused(f"{FEW} --survey {copy} {suite} --csv {copy} --force")
    assert "this file is read" in words
    assert copy.read_text() == TABLE
    copy.write_text(TABLE.replace("stood", "stod"))
    assert "line 3, outcome = 'stod'" in refused(f"{FEW} --survey {copy} {suite}")
    assert list(tmp_path.iterdir()) == [copy]


@pytest.mark.slow
def test_the_example_needs_no_file() -> None:
    ran = rocksteady("back-analyse --example --levels 8 --draws 2 --trials 1")
    assert ran.code == 0
    assert "made-up objects and motions" in ran.out
    assert "next: rocksteady back-analyse --example" in ran.out
