"""`rocksteady certify`: what it proves, writes, checks and refuses."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every


def test_an_orbit_is_proved_written_and_checked(tmp_path: Path) -> None:
    file = tmp_path / "orbit.json"
    ran = rocksteady("certify orbit -A 2 -W 2 -r 0.8 --number 1 --json --out", file)
    assert ran.code == 0
    assert ran.json["proved"] is True
    assert ran.json["file"] == str(file)
    assert ran.json["bits"] == 64
    assert "one stable symmetric motion" in ran.json["claim"]
    for arithmetic in ("arb", "iv"):
        held = rocksteady(f"certify --json --arithmetic {arithmetic} --check", file)
        assert (held.code, held.json["holds"]) == (0, True)
    assert "give arb or iv" in refused("certify --arithmetic 1 --check", file)
    values = json.loads(file.read_text(encoding="utf-8"))
    values["claim"]["stability"] = "unstable"
    file.write_text(json.dumps(values), encoding="utf-8")
    ran = rocksteady("certify --check", file)
    assert ran.code == 1
    assert "is refused: orbit; it is stable" in ran.out
    values["radii"], values["claim"]["stability"] = ["0.7"], "stable"
    file.write_text(json.dumps(values), encoding="utf-8")
    assert rocksteady("certify --check", file).code == 3


def test_several_orbits_are_a_list() -> None:
    ran = rocksteady("certify orbit -A 2 -W 4 -r 0.8 --json")
    verdicts = [each["verdict"] for each in ran.json["certificates"]]
    assert "proved" in verdicts
    assert "refuted" in verdicts
    assert rocksteady("certify orbit -A 2 -W 4 -r 0.8").out.startswith("Proved ")


@pytest.mark.slow
def test_a_fate_region_and_chaos_are_written_and_hold(tmp_path: Path) -> None:
    for number, (command, claim) in enumerate(
        (
            (
                "fate --pulse one-sine -A 2 -W 2 -r 0.9",
                "the block falls: one-sine pulse, A = 2.0, W = 2.0, restitution = 0.9",
            ),
            (
                f"region -A 1.9:2.1 -W 1.9:2.1 -r 0.8 --plot {tmp_path / 'region.png'}",
                "of A 1.9 to 2.1, W 1.9 to 2.1: order 1, branch 1, restitution 0.8; 1,000 of ",
            ),
            ("chaos -A 0.6 -W 2 -r 0.8", "0.5970 per period or more: A = 0.6, W = 2.0"),
        )
    ):
        file = tmp_path / f"{number}.json"
        assert rocksteady(f"certify {command} --out", file).code == 0
        ran = rocksteady("certify --check", file)
        assert (ran.code, ran.err) == (0, "")
        assert ran.out.startswith("The certificate holds: ")
        assert claim in " ".join(ran.out.split())
    assert (tmp_path / "region.png").stat().st_size > 5000


def test_what_is_undecided_has_exit_code_3_and_no_file(tmp_path: Path) -> None:
    file = tmp_path / "none.json"
    ran = rocksteady("certify chaos -A 0.4 -W 2 -r 0.8 --out", file)
    assert ran.code == 3
    assert "A_het" in " ".join(ran.out.split())
    assert not file.exists()


@pytest.mark.slow
def test_points_over_a_range_are_proved() -> None:
    ran = rocksteady("certify point -A 1.9:2.3 -W 2 -r 0.8 --json")
    assert "symmetry breaking" in ran.json["claim"]


@pytest.mark.slow
def test_the_points_include_the_cascade_to_32_impacts() -> None:
    rows = rocksteady("certify point -A 1:2.7 -W 2 -r 0.8 --json").json["certificates"]
    assert {each["verdict"] for each in rows} == {"proved"}
    assert [each["claim"].partition(" with ")[2].split()[0] for each in rows] == [
        *("2", "2", "4", "8", "16")
    ]


@every("kind", ["", "fate"])
def test_the_printed_program_runs_alone(kind: str, tmp_path: Path) -> None:
    program, file = tmp_path / "check.py", tmp_path / "certificate.json"
    program.write_text(rocksteady(f"certify {kind} --print-checker").out, encoding="utf-8")
    what = "fate --pulse one-sine -A 2" if kind else "chaos -A 0.6"
    rocksteady(f"certify {what} -W 2 -r 0.8 --out", file)
    command = [sys.executable, "-I", str(program), str(file)]
    assert subprocess.run(command, check=False, capture_output=True).returncode == 0


@every(
    "command, words",
    [
        ("certify", "WHAT is not given"),
        ("certify theorem", "there is no such proof"),
        ("certify orbit -A 2 -W 2 -r 0.8,0.7", "flights of two kinds for sides that differ"),
        ("certify orbit -A 2 -W 2 -r 0.8 --number 99", "there are"),
        ("certify fate -r 0.9 -A 2 -W 2", "a pulse or a record is needed"),
        ("certify region -A 2 -W 1:2 -r 0.8", "a range LOW:HIGH is needed"),
        ("certify chaos -A 2 -W 2 -r 0.8 --kind other", "hilltop"),
        ("certify orbit --check none.json", "reads a certificate alone"),
        ("certify --check none.json", "No such file or directory; give a file that"),
        ("certify chaos -A 2 -W 2 -r 0.8 --leaves 5", "--check"),
        ("certify chaos -A 2 -W 2 -r 0.8 --plot chaos.png", "a picture is one of a region"),
    ],
)
def test_bad_input_is_refused_in_one_line(command: str, words: str) -> None:
    assert words in refused(command)


def test_without_python_flint_the_line_says_what_to_install() -> None:
    code = (
        "import sys\nsys.modules['flint'] = None\n"
        "from rocksteady.cli.app import run\n"
        "sys.exit(run(['certify', 'chaos', '-A', '2', '-W', '2', '-r', '0.8']))"
    )
    ran = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert ran.returncode == 2
    assert "install it: pip install 'rocksteady[proof]'" in ran.stderr
    assert ran.stderr.count("\n") == 1


def test_samples_of_a_record_replace_no_file_of_another(tmp_path: Path) -> None:
    """They stand beside the certificate under its name, where the record itself may lie."""
    record, out = tmp_path / "run.txt", tmp_path / "run.json"
    at2(record, samples()[:200])
    kept = record.read_bytes()
    command = "certify fate --width-m 0.4 --height-m 2 --model linear --record"
    assert "this file is read" in refused(command, record, "--out", out, "--force")
    assert record.read_bytes() == kept
    assert not out.exists()
    other = tmp_path / "other.at2"
    other.write_bytes(kept)
    assert "it exists" in refused(command, other, "--out", out)
    assert rocksteady(command, other, "--out", out, "--force").code == 0
    assert "holds" in rocksteady("certify --check", out, "--samples", record).out
    record.write_text(record.read_text(encoding="ascii").replace("0", "1", 1), encoding="ascii")
    assert rocksteady("certify --check", out, "--samples", record).code == 1
    assert "extension" in refused(command, other, "--out", tmp_path / "run.pdf")


def test_where_there_is_no_orbit_none_is_proved() -> None:
    ran = rocksteady("certify orbit -A 0.01 -W 2 -r 0.8")
    assert (ran.code, ran.out) == (0, "There is no orbit to be proved here\n")
    assert rocksteady("certify orbit -A 0.01 -W 2 -r 0.8 --json").json["proved"] is False
