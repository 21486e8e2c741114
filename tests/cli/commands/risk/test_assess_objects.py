"""`rocksteady assess` of object files and tables: its contract, its files and its refusals."""

from pathlib import Path

import pytest

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
CURVES = {
    "site": "PGA [g],annual rate\n0.02,0.05\n0.2,0.003\n2,3e-6\n",
    "rises": "PGA [g],annual rate\n0.1,0.001\n0.3,0.01\n",
    "single": "PGA [g],annual rate\n0.1,0.001\n",
    "pgv": "PGV [m/s],annual rate\n0.02,0.05\n2,3e-6\n",
    "several": "#,,,investigation_time=1,imt='PGA'\nlon,lat,depth,poe-0.1,poe-0.3\n"
    "1,2,0,0.01,0.001\n1,3,0,0.01,0.001\n",
}
"""Hazard curves, most of which are none."""
RATE = "assess statue.toml --records motions --out answer --hazard"


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


def test_the_folder_is_refused_before_anything_is_computed(place: Path) -> None:
    (place / "notes.txt").write_text("mine", encoding="utf-8")
    line = refused("assess statue.toml --records nowhere --out .")
    assert "which is no file of an assessment" in line


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
    assert place.is_dir()
    command = "assess objects.csv --records motions --pgv-m-s 0.45"
    ran = rocksteady(f"{command} --pga-g 0.4 --check --json")
    rows = {row["name"]: row for row in ran.json["objects"]}
    assert (ran.code, rows["vase"]["verdict"], rows["chest"]["verdict"]) == (1, "red", "stands")
    assert (ran.json["kinds"], rows["vase"]["share"]) == (2, rows["vase 2"]["share"])
    assert rocksteady(command).code == 0


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
def test_the_folder_of_a_table_is_replaced_with_force_alone(place: Path) -> None:
    command = "assess objects.csv --records motions --pga-g 0.4 --pgv-m-s 0.45 --out answers"
    assert rocksteady(command).code == 0
    assert "it holds" in refused(command)
    table = (place / "answers" / "answers.csv").read_bytes()
    assert rocksteady(f"{command} --force --workers 1").code == 0
    assert (place / "answers" / "answers.csv").read_bytes() == table


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
        ("assess one.toml", "--records is not given: urn states no pgv_m_s, and built-in"),
        ("assess bare.toml --records motions", "[demand] pga_g"),
        ("assess felt.toml --records motions --floor-hz 2", "--floor-hz = '2' is not accepted"),
        (f"{RATE} rises.csv", "line 3, '0.3,0.01': the rate of 0.3 is above that of 0.1"),
        (f"{RATE} single.csv", "the curve has 1 level"),
        (f"{RATE} several.csv", "it holds 2 curves, and an object stands at one site"),
        (f"{RATE} pgv.csv --no-stretch", "--hazard is over pgv_m_s"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(command: str, words: str, place: Path) -> None:
    one = OBJECT.replace("pgv_m_s = 0.45\n", "").replace("statue", "urn")
    (place / "one.toml").write_text(one, encoding="utf-8")
    bare = OBJECT.replace("pga_g = 0.4\npgv_m_s = 0.45\n", "")
    (place / "bare.toml").write_text(bare, encoding="utf-8")
    felt = OBJECT.replace("pga_g = 0.4", 'place = "floor"\npga_g = 0.4')
    (place / "felt.toml").write_text(felt, encoding="utf-8")
    for name, text in CURVES.items():
        (place / f"{name}.csv").write_text(text, encoding="utf-8")
    before = sorted(place.iterdir())
    assert words in refused(command)
    assert sorted(place.iterdir()) == before


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
