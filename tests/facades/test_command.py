"""`rocksteady facade`: its contract, its runs, its files and its refusals."""

import json
import math
from pathlib import Path

import pytest

from rocksteady import read_record
from rocksteady.codes import run_facade
from rocksteady.facades.checks.read_facade import read_facade
from rocksteady.motions import make_synthetic_suite
from tests.cli.motion_files import at2
from tests.cli.program import refused, rocksteady
from tests.every import every

BARE = '[facade]\nname = "front"\nthickness_m = 0.3\nheight_m = 3.0\n'
SITE = 'f0 = 2.5\ntc_star_s = 0.35\nsoil = "B"\n'
WALL = f"{BARE}[demand.slv]\nag_g = 0.15\n{SITE}"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with walls, and with a suite of seven motions and one of three."""
    made = tmp_path_factory.mktemp("facade")
    (made / "wall.toml").write_text(WALL)
    (made / "bare.toml").write_text(BARE)
    (made / "stout.toml").write_text(BARE.replace("0.3", "1.0"))
    (made / "wrong.toml").write_text(WALL.replace("thickness_m", "thicknes_m"))
    (made / "bytes.toml").write_bytes(bytes(range(256)))
    (made / "empty.toml").touch()
    (made / "empty").mkdir()
    for name, count in (("seven", 7), ("three", 3)):
        (made / name).mkdir()
        for number, record in enumerate(make_synthetic_suite(count, seed=4), start=1):
            at2(
                made / name / f"m{number}.AT2", (record.acceleration_m_s2[:2500] / 9.80665).tolist()
            )
    return made


def test_runs_are_those_of_run_facade_on_the_files(folder: Path) -> None:
    ran = rocksteady("facade --json --scale 2 --records", folder / "seven", folder / "wall.toml")
    assert (ran.code, ran.err) == (0, "")
    records = [read_record(folder / "seven" / f"m{number}.AT2") for number in range(1, 8)]
    expected = run_facade(read_facade(folder / "wall.toml").facade, records, scale=2)
    assert ran.json["runs"] == json.loads(json.dumps(expected.to_dict()))
    assert len(ran.json["files"]) == 8
    (dynamic,) = [each for each in ran.json["checks"] if each["method"] == "dynamic"]
    assert dynamic["satisfied"] == expected.satisfied
    assert expected.mean_m is not None
    if math.isfinite(expected.mean_m):
        assert dynamic["demand"] == pytest.approx(expected.mean_m)


def test_records_give_the_static_checks_a_demand_where_the_file_has_none(folder: Path) -> None:
    command = "facade --json --pga-g 0.1 --records"
    own = rocksteady(command, folder / "seven", folder / "bare.toml").json
    given = rocksteady(command, folder / "seven", folder / "wall.toml").json

    def demand(values: dict[str, object], method: str) -> float:
        checks = values["checks"]
        assert isinstance(checks, list)
        (check,) = [
            each for each in checks if (each["limit_state"], each["method"]) == ("SLV", method)
        ]
        assert isinstance(check["demand"], float)
        return check["demand"]

    assert demand(own, "linear") == pytest.approx(0.1 / 2.0)
    assert demand(own, "nonlinear static") != demand(given, "nonlinear static")
    assert demand(own, "dynamic") > 0.0
    (dynamic,) = [each for each in given["checks"] if each["method"] == "dynamic"]
    assert dynamic["demand"] is None
    assert "mean PGA of 0.1 g" in dynamic["remark"]


def test_three_records_are_run_and_have_no_verdict(folder: Path) -> None:
    ran = rocksteady("facade --records", folder / "three", folder / "bare.toml")
    assert ran.code == 0
    assert "needs 7 records and there are 3 records" in " ".join(ran.out.split())
    values = rocksteady("facade --json --records", folder / "three", folder / "bare.toml")
    assert values.code == 0
    assert len(values.json["runs"]["runs"]) == 6


@pytest.mark.slow
@pytest.mark.parametrize(("pga", "code"), [("0.05", 0), ("2", 1)])
def test_check_is_negative_where_a_check_is_not_satisfied(
    folder: Path, pga: str, code: int
) -> None:
    command = f"facade --pga-g {pga} --records"
    assert rocksteady(command, folder / "seven", folder / "stout.toml").code == 0
    assert rocksteady(command, folder / "seven", folder / "stout.toml", "--check").code == code


@pytest.mark.slow
def test_flags_reach_the_runs(folder: Path) -> None:
    command = "facade --json --pga-g 0.4 --records"
    files = (folder / "seven", folder / "stout.toml")

    def shares(*flags: str) -> list[float]:
        ran = rocksteady(command, *files, *flags)
        assert ran.code == 0, ran.err
        return [row["share_d0"] for row in ran.json["runs"]["runs"]]

    both = shares()
    assert all(both), "every run lifts"
    assert both[::2] == shares("--directions", "recorded")
    assert both[1::2] == shares("--directions", "Reversed")
    assert both != shares("--restitution", "0.9")
    assert both != shares("--model", "linear")
    assert both == pytest.approx(shares("--model", "linear"), abs=0.1)
    assert rocksteady(command, *files, "--limit-state", "SLC").json["runs"][
        "limit_m"
    ] == pytest.approx(0.6 * 2.0 / 3.0)


READING = "--records seven; --pair; --units g"
"""Flags of records."""
OF_RUNS = (
    "--scale 2; --pga-g 0.3; --restitution 0.5; --model linear; --directions reversed; "
    "--limit-state SLC; --units g; --pair"
)
"""Flags that have no meaning without records."""
WRONG = (
    "--scale 0.0; --scale -1; --scale nan; --scale 1:2:3; --scale 1e+60; --pga-g 0.0; "
    "--pga-g inf; --pga-g fast; --restitution 1.1; --restitution -0.1; --restitution 0.8,0.9; "
    "--model cubic; --directions up; --limit-state SLD"
)
"""Flags with values that they refuse."""
HOSTILE = [
    ("", ["neither FILE nor --example is given"]),
    ("no.toml", ["no.toml", "No such file"]),
    ("seven", ["seven"]),
    ("wrong.toml", ["wrong.toml", "thicknes_m", "thickness_m"]),
    ("bytes.toml", ["bytes.toml"]),
    ("empty.toml", ["empty.toml", "is empty"]),
    ("wall.toml bare.toml", ["too much", "bare.toml"]),
    ("wall.toml --example", ["--example", "wall.toml"]),
    *((f"--example {flag}", [flag.split()[0], "reads no files"]) for flag in READING.split("; ")),
    *((f"wall.toml {flag}", [flag.split()[0], "--records"]) for flag in OF_RUNS.split("; ")),
    *((f"wall.toml --records seven {flag}", flag.split()) for flag in WRONG.split("; ")),
    ("wall.toml --records gone", ["--records", "gone", "does not exist"]),
    ("wall.toml --records empty", ["--records", "empty"]),
    ("wall.toml --records wall.toml", ["--records", "wall.toml"]),
    ("wall.toml --records seven --scale 2 --pga-g 0.3", ["--pga-g", "--scale"]),
    ("wall.toml --language fr", ["--language", "fr"]),
    ("wall.toml --language it", ["--language", "--out"]),
    ("wall.toml --out wall.toml", ["--out", "wall.toml"]),
    ("wall.toml --out no/such/folder", ["--out", "no/such"]),
    ("wall.toml --csv wall.toml --force", ["--csv", "wall.toml", "is read"]),
]


@every(("flags", "words"), HOSTILE)
def test_a_hostile_command_line_is_refused_in_a_line(
    flags: str, words: list[str], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    line = refused(f"facade {flags}")
    assert all(word in line for word in words), line
    assert before == {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def test_an_exit_code_of_a_check_without_a_verdict_is_no_yes(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    line = refused("facade --check", folder / "bare.toml", "--out", out)
    assert "no check has a verdict" in line
    assert not out.exists()
    line = refused("facade --check --records", folder / "three", folder / "wall.toml")
    assert "needs 7 records" in line
    assert "there are 3" in line
    assert rocksteady("facade --check", folder / "wall.toml").code == 1


def test_copies_of_a_record_are_no_more_records(folder: Path, tmp_path: Path) -> None:
    for number in range(7):
        copy = tmp_path / f"c{number}.AT2"
        copy.write_bytes((folder / "seven" / "m1.AT2").read_bytes())
    line = refused("facade --records", tmp_path, folder / "wall.toml")
    assert line.startswith("rocksteady: --records have one motion twice")
