"""`rocksteady assess` of object files and tables: its contract, its files and its refusals."""

import csv
import json
from pathlib import Path

import pytest

from rocksteady import assess_object, read_object
from rocksteady.motions import make_synthetic_suite
from tests.cli.program import refused, rocksteady
from tests.every import every

OBJECT = """
name = "statue"
friction = 0.5
[geometry]
width_m = 0.38
height_m = 1.8
[demand]
pga_g = 0.4
pgv_m_s = 0.45
[assessment]
damage_states = ["overturned"]
draws = 1
levels = 10
replicates = 0
target_probability = 0.95
"""


@pytest.fixture(name="place")
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with an object, a table and four motions, in which the program runs."""
    folder = tmp_path / "motions"
    folder.mkdir()
    for record in make_synthetic_suite(4):
        rows = [f"{k * record.dt_s!r},{float(a)!r}" for k, a in enumerate(record.acceleration_m_s2)]
        text = "\n".join(["t (s),acc (m/s2)", *rows]) + "\n"
        (folder / f"{record.name}.csv").write_text(text, encoding="utf-8")
    (tmp_path / "statue.toml").write_text(OBJECT, encoding="utf-8")
    table = "name,width_m,height_m,room\nvase,0.12,0.5,4\nchest,1.0,1.2,5\n"
    (tmp_path / "objects.csv").write_text(table, encoding="utf-8")
    (tmp_path / "site.csv").write_text(
        "PGV [m/s],rate [1/year]\n0.05,0.1\n0.5,0.001\n5,0.00001\n", encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_an_object_file_is_assessed_and_its_folder_is_filled(place: Path) -> None:
    ran = rocksteady("assess statue.toml --records motions --hazard site.csv --out answer --json")
    assert ran.code == 0, ran.err
    values = ran.json
    assert values["schema"] == "rocksteady/assess/1"
    assert values["verdict"] == "below target"
    assert 0.0 < values["probability"] < 0.95
    assert 0.0 < values["risks"][0]["annual_rate"] < 0.1
    assert values["synthetic"] is False
    assert sorted(each.name for each in (place / "answer").iterdir())[-2:] == [
        "results.csv",
        "run.json",
    ]
    manifest = json.loads((place / "answer" / "run.json").read_text(encoding="utf-8"))
    assert manifest["command"].startswith("rocksteady assess statue.toml --records motions")
    assert [each["name"] for each in manifest["files"]][:2] == ["statue.toml", "site.csv"]
    assert len(manifest["files"]) == 6
    found = assess_object(read_object("statue.toml"), make_synthetic_suite(4))
    assert values["probability"] == pytest.approx(found.probability, rel=1e-3)


def test_the_folder_is_refused_before_anything_is_computed(place: Path) -> None:
    (place / "notes.txt").write_text("mine", encoding="utf-8")
    line = refused("assess statue.toml --records nowhere --out .")
    assert "which is no file of an assessment" in line


def test_a_hazard_curve_is_refused_with_a_step_that_the_command_knows(place: Path) -> None:
    for text in ("0.1,0.01\n0.4,0.001\n", "Sa [g],rate\n0.1,0.01\n0.4,0.001\n"):
        (place / "bare.csv").write_text(text, encoding="utf-8")
        line = refused("assess statue.toml --records motions --hazard bare.csv")
        assert "name" in line
        assert "measure=" not in line


def test_the_motions_may_be_named_in_the_file(place: Path) -> None:
    text = OBJECT + 'records = "motions"\n'
    (place / "statue.toml").write_text(text, encoding="utf-8")
    ran = rocksteady("assess statue.toml --more")
    assert ran.code == 0, ran.err
    assert "records" in ran.out
    assert "no substitute for rules on anchorage" in " ".join(ran.out.split())


@pytest.mark.slow
def test_check_compares_with_the_target_of_the_file_or_the_flag(place: Path) -> None:
    assert place.is_dir()
    assert rocksteady("assess statue.toml --records motions --check").code == 0
    ran = rocksteady("assess statue.toml --records motions --check --target 0.01 --json")
    assert ran.code == 1
    assert ran.json["target_probability"] == 0.01
    assert ran.json["remedies"]


@pytest.mark.slow
def test_runs_are_kept_and_continued_and_do_not_depend_on_the_workers(place: Path) -> None:
    command = "assess statue.toml --records motions --json"
    plain = rocksteady(f"{command} --workers 1").json
    kept = rocksteady(f"{command} --runs runs.zarr --workers 2").json
    assert "--runs" in refused(f"{command} --runs runs.zarr")
    again = rocksteady(f"{command} --runs runs.zarr --resume")
    answers = [{**each, "seconds": None} for each in (plain, kept, again.json)]
    assert answers[0] == answers[1] == answers[2]
    assert "100 %" not in again.err, "nothing is run again"
    assert (place / "runs.zarr").is_dir()
    assert "--runs" in refused(f"{command} --resume")


def test_a_table_is_assessed_row_by_row(place: Path) -> None:
    ran = rocksteady(
        "assess objects.csv --records motions --pga-g 0.4 --pgv-m-s 0.45 --csv out.csv --json"
    )
    assert ran.code == 0, ran.err
    rows = ran.json["objects"]
    assert [row["name"] for row in rows] == ["vase", "chest"]
    assert rows[1]["verdict"] == "stands"
    with (place / "out.csv").open(encoding="utf-8", newline="") as stream:
        written = list(csv.DictReader(stream))
    assert [row["room"] for row in written] == ["4", "5"]
    assert [row["colour"] for row in written] == [row["colour"] for row in rows]
    text = rocksteady("assess objects.csv --records motions --pgv-m-s 0.45 --check")
    assert text.code == 1
    assert "vase" in text.out


@pytest.mark.slow
def test_the_answer_on_a_table_has_its_folder(place: Path) -> None:
    command = "assess objects.csv --records motions --pga-g 0.4 --pgv-m-s 0.45 --out answers"
    assert rocksteady(command).code == 0
    names = ["answers.csv", "report.html", "run.json"]
    assert sorted(each.name for each in (place / "answers").iterdir()) == names
    with (place / "answers" / "answers.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert {row["name"] for row in rows} == {"vase", "chest"}
    page = (place / "answers" / "report.html").read_text(encoding="utf-8")
    assert all(row["sentence"].split()[0] in page for row in rows)
    assert "it holds" in refused(command)
    before = {each: (place / "answers" / each).read_bytes() for each in names}
    assert rocksteady(f"{command} --force --workers 1").code == 0
    after = {each: (place / "answers" / each).read_bytes() for each in names}
    assert {each for each in names if before[each] != after[each]} <= {"report.html", "run.json"}


def test_a_file_among_the_motions_that_is_no_record_is_left_out(place: Path) -> None:
    (place / "motions" / "broken.AT2").write_text("nothing\n", encoding="utf-8")
    ran = rocksteady("assess objects.csv --records motions --pgv-m-s 0.45 --json")
    assert ran.code == 0
    assert [row["file"] for row in ran.json["left_out"]] == [str(Path("motions/broken.AT2"))]
    assert ran.json["records"] == 4


@every(
    ("command", "words"),
    [
        ("assess none.toml --records motions", "No such file or directory"),
        ("assess statue.toml", "--records"),
        ("assess statue.toml --records motions --pga-g 0.3", "the object's file states it"),
        ("assess statue.toml --records motions --width-m 1", "the object's file states it"),
        ("assess statue.toml --example", "leave one of them out"),
        ("assess --example --records motions", "--example reads no files"),
        ("assess --example --pga-g 0.3", "--example reads no files"),
        ("assess objects.csv --records motions", "--pgv-m-s"),
        ("assess objects.csv --records motions --pga-g 1 --friction 1", "a table of objects does"),
        (
            "assess objects.csv --records motions --pga-g 1 --hazard site.csv",
            "a table of objects does not",
        ),
        ("assess --width-m 1 --height-m 3 --pga-g 1 --pgv-m-s 1 --out x", "name an object FILE"),
        ("assess --width-m 1 --height-m 3 --pga-g 1 --pgv-m-s 1 --records motions", "name an obj"),
        ("assess statue.toml --records motions --target 2", "--target"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(command: str, words: str, place: Path) -> None:
    before = sorted(place.iterdir())
    assert words in refused(command)
    assert sorted(place.iterdir()) == before


def test_a_key_that_is_unknown_is_named_with_the_nearest(place: Path) -> None:
    text = OBJECT.replace("width_m", "width_mm")
    (place / "statue.toml").write_text(text, encoding="utf-8")
    line = refused("assess statue.toml --records motions")
    assert "statue.toml: [geometry] width_mm is unknown" in line
    assert line.endswith("did you mean width_m?")


@pytest.mark.slow
def test_the_example_needs_no_file(tmp_path: Path) -> None:
    ran = rocksteady("assess --example --out", tmp_path / "answer")
    assert ran.code == 0, ran.err
    assert " of such objects fall at " in ran.out.splitlines()[0]
    assert "made-up objects and motions, no earthquake's" in ran.out
    assert (tmp_path / "answer" / "fragility.xml").is_file()


@pytest.mark.slow
def test_a_file_and_a_table_of_one_object_print_one_answer(place: Path) -> None:
    """To the bit; a column of the table is a key of the file."""
    toml = (
        'name = "vase"\nfriction = 0.9\n[geometry]\nwidth_m = 0.12\nheight_m = 0.5\n[demand]\n'
        "pga_g = 0.4\npgv_m_s = 0.15\nvertical_g = 0.3\nvertical_share = 0.4\n[assessment]\n"
        "replicates = 0\ntarget_probability = 0.95\n"
    )
    (place / "vase.toml").write_text(toml, encoding="utf-8")
    row = "name,kind,width_m,height_m,friction,vertical_g,vertical_share\n"
    (place / "vase.csv").write_text(f"{row}vase,vase,0.12,0.5,0.9,0.3,0.4\n", encoding="utf-8")
    peaks = "--records motions --pga-g 0.4 --pgv-m-s 0.15 --target 0.95 --json"
    file = rocksteady("assess vase.toml --records motions --json").json
    ran = rocksteady(f"assess vase.csv {peaks}")
    assert ran.code == 0, ran.err
    (found,) = ran.json["objects"]
    for key in ("probability", "basis", "method", "verdict", "colour", "uplift_pga_g",
                "friction_needed", "friction_cause", "vertical_g", "vertical_share"):  # fmt: skip
        assert file[key] == found[key], key
    assert file["uplift_pga_g"] == pytest.approx(0.88 * 0.12 / 0.5)
    assert 0.0 < file["probability"] < 0.95
    line = refused(f"assess vase.csv {peaks} --vertical-g 0.2")
    assert "vertical motion are columns of the table" in line
