"""`rocksteady assess` of object files and tables: its contract, its files and its refusals."""

import csv
import json
from pathlib import Path

import pytest

from rocksteady import assess_object, read_object, read_record
from rocksteady.motions import make_synthetic_suite
from tests.cli.program import refused, rocksteady
from tests.every import every

OBJECT = """
name = "statue"
friction = 0.6
[geometry]
width_m = 0.38
height_m = 1.8
[demand]
pga_g = 0.4
pgv_m_s = 0.45
[assessment]
damage_states = ["overturned"]
draws = 2
target_probability = 0.95
"""
HOUSE = """
[[buildings]]
name = "house"
storeys = 1
frequencies_hz = [2.0]
shapes = [[1.0]]
"""


@pytest.fixture(name="place")
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with an object, a table and twelve motions, in which the program runs."""
    folder = tmp_path / "motions"
    folder.mkdir()
    for record in make_synthetic_suite(12):
        rows = [f"{k * record.dt_s!r},{float(a)!r}" for k, a in enumerate(record.acceleration_m_s2)]
        text = "\n".join(["t (s),acc (m/s2)", *rows]) + "\n"
        (folder / f"{str(record.name).replace(' ', '-')}.csv").write_text(text, encoding="utf-8")
    (tmp_path / "statue.toml").write_text(OBJECT, encoding="utf-8")
    table = (
        "name,width_m,height_m,friction,room\n"
        "vase,0.12,0.5,0.9,4\nchest,1.0,1.2,0.9,5\nvase 2,0.12,0.5,0.9,6\n"
    )
    (tmp_path / "objects.csv").write_text(table, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_an_object_file_is_assessed_and_its_folder_is_filled(place: Path) -> None:
    ran = rocksteady("assess statue.toml --records motions --out answer --json")
    assert ran.code == 0, ran.err
    values = ran.json
    assert values["schema"] == "rocksteady/assess/1"
    assert values["by"] == "runs"
    names = {each.name for each in (place / "answer").iterdir()}
    assert {"report.html", "results.csv", "run.json"} <= names
    manifest = json.loads((place / "answer" / "run.json").read_text(encoding="utf-8"))
    assert manifest["command"].startswith("rocksteady assess statue.toml --records motions")
    assert [each["name"] for each in manifest["files"]][:1] == ["statue.toml"]
    assert len(manifest["files"]) == 13
    records = [read_record(file) for file in sorted((place / "motions").iterdir())]
    found = assess_object(read_object("statue.toml"), records)
    assert (values["share"], values["low"], values["high"]) == (found.share, *(found.band or ()))
    page = (place / "answer" / "report.html").read_text(encoding="utf-8")
    assert values["sentence"] in " ".join(page.split())


def test_the_folder_is_refused_before_anything_is_computed(place: Path) -> None:
    (place / "notes.txt").write_text("mine", encoding="utf-8")
    line = refused("assess statue.toml --records nowhere --out .")
    assert "which is no file of an assessment" in line


def test_without_records_built_in_motions_are_run(place: Path) -> None:
    assert place.is_dir()
    ran = rocksteady("assess statue.toml --json")
    assert (ran.code, ran.json["by"], ran.json["left_out"]) == (0, "built-in motions", [])
    assert ran.json["verdict"] != "green"
    found = assess_object(read_object("statue.toml"))
    assert (ran.json["share"], ran.json["sentence"]) == (found.share, found.sentence)


def test_the_motions_may_be_named_in_the_file(place: Path) -> None:
    text = OBJECT + 'records = "motions"\n'
    (place / "statue.toml").write_text(text, encoding="utf-8")
    ran = rocksteady("assess statue.toml --more")
    assert ran.code == 0, ran.err
    assert "records" in ran.out
    assert "no substitute for rules on anchorage" in " ".join(ran.out.split())


def test_check_compares_with_the_target_of_the_file_or_the_flag(place: Path) -> None:
    assert place.is_dir()
    ran = rocksteady("assess statue.toml --records motions --check --json")
    assert (ran.code, ran.json["verdict"]) == (0, "green")
    ran = rocksteady("assess statue.toml --records motions --check --target 0.001 --json")
    assert (ran.code, ran.json["target_probability"]) == (
        {"red": 1, "not-shown": 3}[ran.json["verdict"]],
        0.001,
    )


def test_a_floor_of_flags_is_a_building_of_one_floor(place: Path) -> None:
    """Both peaks are the ground's: motions are stretched before they reach the floor."""
    (place / "house.toml").write_text(HOUSE, encoding="utf-8")
    (place / "above.toml").write_text('building = "house"\nfloor = 1\n' + OBJECT, encoding="utf-8")
    command = "--records motions --json"
    floor = rocksteady(f"assess statue.toml --floor-hz 2 --participation 1 {command}")
    house = rocksteady(f"assess above.toml --buildings house.toml {command}")
    assert (floor.code, house.code) == (0, 0), floor.err + house.err
    for key in ("share", "low", "high", "share_1_1", "verdict", "sentence", "friction_needed",
                "median_stretch", "uplift_pga_g"):  # fmt: skip
        assert floor.json[key] == house.json[key], key
    ground = rocksteady(f"assess statue.toml {command}").json
    assert ground["share"] != floor.json["share"]
    rows = [
        rocksteady(f"assess {name} {flags} {command} --pga-g 0.2 --pgv-m-s 0.2").json["objects"]
        for name, flags in (("objects.csv", "--floor-hz 2"), ("objects.csv", ""))
    ]
    assert rows[0][0]["share"] != rows[1][0]["share"]


@pytest.mark.slow
def test_runs_are_kept_and_continued_and_do_not_depend_on_the_workers(place: Path) -> None:
    command = "assess statue.toml --records motions --json"
    plain = rocksteady(f"{command} --workers 1").json
    kept = rocksteady(f"{command} --runs runs.zarr --workers 2").json
    assert "--runs" in refused(f"{command} --runs runs.zarr")
    again = rocksteady(f"{command} --runs runs.zarr --resume")
    answers = [{**each, "seconds": None} for each in (plain, kept, again.json)]
    assert answers[0] == answers[1] == answers[2]
    assert (place / "runs.zarr").is_dir()
    assert "--runs" in refused(f"{command} --resume")


def test_a_table_is_assessed_row_by_row(place: Path) -> None:
    peaks = "--pga-g 0.4 --pgv-m-s 0.45"
    ran = rocksteady(f"assess objects.csv --records motions {peaks} --csv out.csv --json")
    assert ran.code == 0, ran.err
    rows = {row["name"]: row for row in ran.json["objects"]}
    assert rows["chest"]["verdict"] == "stands"
    assert (ran.json["kinds"], rows["vase"]["share"]) == (2, rows["vase 2"]["share"])
    with (place / "out.csv").open(encoding="utf-8", newline="") as stream:
        written = {row["name"]: row for row in csv.DictReader(stream)}
    assert [written[name]["room"] for name in ("vase", "chest")] == ["4", "5"]
    assert {name: row["verdict"] for name, row in written.items()} == {
        name: row["verdict"] for name, row in rows.items()
    }
    text = rocksteady(f"assess objects.csv --records motions {peaks} --check")
    assert (text.code, rows["vase"]["verdict"]) == (1, "red")
    assert "vase" in text.out
    assert rocksteady("assess objects.csv --records motions --pgv-m-s 0.45").code == 0
    built_in = rocksteady(f"assess objects.csv {peaks} --json")
    assert (built_in.code, built_in.json["built_in"]) == (0, True)


def test_a_table_leaves_with_the_code_of_its_worst_row(place: Path) -> None:
    """1 before 3 with --check; 3 where a row has no answer."""
    assert place.is_dir()
    few = " ".join(f"--records motions/synthetic-{number}.csv" for number in (1, 10, 11))
    command = f"assess objects.csv {few} --pga-g 0.4 --pgv-m-s 0.45"
    ran = rocksteady(f"{command} --json")
    assert (ran.code, ran.json["verdicts"]) == (3, {"no-answer": 2, "stands": 1})
    assert rocksteady(f"{command} --check").code == 3
    slides = (place / "objects.csv").read_text(encoding="utf-8") + "case,0.4,1.9,0.05,7\n"
    (place / "objects.csv").write_text(slides, encoding="utf-8")
    assert rocksteady(command).code == 3
    assert rocksteady(f"{command} --check").code == 1


@pytest.mark.slow
def test_the_answer_on_a_table_has_its_folder(place: Path) -> None:
    command = "assess objects.csv --records motions --pga-g 0.4 --pgv-m-s 0.45 --out answers"
    assert rocksteady(command).code == 0
    names = ["answers.csv", "report.html", "run.json"]
    assert sorted(each.name for each in (place / "answers").iterdir()) == names
    with (place / "answers" / "answers.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert {row["name"] for row in rows} == {"vase", "vase 2", "chest"}
    page = (place / "answers" / "report.html").read_text(encoding="utf-8")
    assert all(row["name"] in page for row in rows)
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
    assert ran.json["records"] == 12
    screen = " ".join(rocksteady("assess statue.toml --records motions").out.split())
    assert "; 1 file left out: 1 " in screen


@every(
    ("command", "words"),
    [
        ("assess none.toml --records motions", "No such file or directory"),
        ("assess one.toml", "--records is not given: urn states no pgv_m_s, and built-in"),
        ("assess one.csv --pga-g 0.3", "--records is not given: vase states no pgv_m_s"),
        ("assess bare.toml --records motions", "[demand] pga_g"),
        ("assess felt.toml --records motions --floor-hz 2", "--floor-hz = '2' is not accepted"),
        ("assess statue.toml --records motions --pga-g 0.3", "the object's file states it"),
        ("assess statue.toml --records motions --width-m 1", "the object's file states it"),
        ("assess statue.toml --no-stretch", "without --records it has no meaning"),
        ("assess statue.toml --hazard site.csv", "--hazard = 'site.csv' is not valid: rates of"),
        ("assess statue.toml --example", "leave one of them out"),
        ("assess --example --records motions", "--example reads no files"),
        ("assess --example --pga-g 0.3", "--example reads no files"),
        ("assess objects.csv --records motions", "--pgv-m-s"),
        ("assess objects.csv --records motions --pga-g 1 --friction 1", "a table of objects does"),
        ("assess objects.csv --pga-g 1 --pgv-m-s 1 --runs runs.zarr", "a table of objects keeps"),
        ("assess statue.toml --records motions --target 2", "--target"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(command: str, words: str, place: Path) -> None:
    one = OBJECT.replace("pgv_m_s = 0.45\n", "").replace("statue", "urn")
    (place / "one.toml").write_text(one, encoding="utf-8")
    bare = OBJECT.replace("pga_g = 0.4\npgv_m_s = 0.45\n", "")
    (place / "bare.toml").write_text(bare, encoding="utf-8")
    felt = OBJECT.replace("pga_g = 0.4", 'place = "floor"\npga_g = 0.4')
    (place / "felt.toml").write_text(felt, encoding="utf-8")
    (place / "one.csv").write_text("name,width_m,height_m\nvase,0.12,0.5\n", encoding="utf-8")
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
    assert "on built-in motions" in " ".join(ran.out.split())
    assert (tmp_path / "answer" / "report.html").is_file()


def test_a_file_and_a_table_of_one_object_print_one_answer(place: Path) -> None:
    """To the bit; a column of the table is a key of the file."""
    toml = (
        'name = "vase"\nfriction = 0.9\n[geometry]\nwidth_m = 0.12\nheight_m = 0.5\n[demand]\n'
        "pga_g = 0.3\npgv_m_s = 0.25\n[assessment]\ntarget_probability = 0.95\n"
    )
    (place / "vase.toml").write_text(toml, encoding="utf-8")
    row = "name,kind,width_m,height_m,friction\n"
    (place / "vase.csv").write_text(f"{row}vase,vase,0.12,0.5,0.9\n", encoding="utf-8")
    peaks = "--records motions --pga-g 0.3 --pgv-m-s 0.25 --target 0.95 --json"
    file = rocksteady("assess vase.toml --records motions --json").json
    ran = rocksteady(f"assess vase.csv {peaks}")
    assert ran.code == 0, ran.err
    (found,) = ran.json["objects"]
    for key in ("share", "low", "high", "share_1_1", "by", "verdict", "records", "runs", "fall",
                "uplift_pga_g", "friction_needed", "friction_cause", "median_stretch"):  # fmt: skip
        assert file[key] == found[key], key
    assert 0.0 < file["share"] < 1.0
    flags = "assess --width-m 0.12 --height-m 0.5 --pga-g 0.3 --pgv-m-s 0.25 --friction 0.9"
    block = rocksteady(f"{flags} --target 0.95 --records motions --json").json
    assert (block["share"], block["sentence"]) == (file["share"], file["sentence"])
    line = refused(f"assess vase.csv {peaks} --vertical-g 0.2")
    assert "vertical motion are columns of the table" in line
