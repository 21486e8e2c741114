"""`rocksteady assess` with two numbers: its contract, its text, its files and its refusals."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from rocksteady import Block
from rocksteady.risk import assess_by_formula
from tests.cli.program import refused, rocksteady
from tests.descriptions import fits
from tests.every import every

WORKED = "assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4"


def test_the_worked_case() -> None:
    ran = rocksteady(f"{WORKED} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["schema"] == "rocksteady/assess/1"
    assert values["probability"] == pytest.approx(0.3992, abs=5e-5)
    assert values["median_pgv_m_s"] == pytest.approx(0.4653, abs=5e-5)
    assert values["beta"] == 0.592
    assert values["uplift_pga_g"] == pytest.approx(0.1778, abs=5e-5)
    assert values["friction_needed"] == pytest.approx(0.2199, abs=5e-5)
    assert values["sentence"].startswith("About 2 in 5 blocks of this shape and size would fall")


def test_the_text_begins_with_the_sentence_and_fits() -> None:
    ran = rocksteady(WORKED)
    assert ran.out.startswith("40 % of such blocks fall at 0.35 g and 0.4 m/s, by a formula.\n")
    assert fits(ran.out)
    assert len(ran.out.splitlines()) <= 8
    assert "About 2 in 5 blocks of this shape and size" in rocksteady(f"{WORKED} --more").out


def test_what_slides_or_rests_has_no_per_cent() -> None:
    assert rocksteady(f"{WORKED} --friction 0.1 --quiet").out == (
        "It slides at 0.35 g and 0.4 m/s: no probability of falling by rocking.\n"
    )
    weak = rocksteady(f"{WORKED.replace('0.35', '0.1')} --quiet").out
    assert weak == "It stands at 0.1 g and 0.4 m/s: this does not lift it.\n"


def test_any_block_is_taken() -> None:
    ran = rocksteady(
        "assess --left-m 0.1 --right-m 0.2 --height-m 1.8 --pga-g 1 --pgv-m-s 1 --json"
    )
    block = Block.asymmetric(left=0.1, right=0.2, height=1.8)
    assert ran.json["probability"] == assess_by_formula(block, 1.0, 1.0).probability


def test_where_it_slides_there_is_no_probability_and_check_is_negative() -> None:
    ran = rocksteady(f"{WORKED} --friction 0.1 --json --check")
    assert ran.code == 1
    assert (ran.json["probability"], ran.json["verdict"]) == (None, "slides")


@every(("target", "code"), [("0.1", 1), ("0.39", 1), ("0.4", 0)])
def test_check_compares_with_the_target(target: str, code: int) -> None:
    assert rocksteady(f"{WORKED} --check --target {target}").code == code
    assert rocksteady(f"{WORKED} --target {target}").code == 0


def test_the_answer_is_a_row_of_a_table(tmp_path: Path) -> None:
    file = tmp_path / "answer.csv"
    assert rocksteady(f"{WORKED} --csv", file).code == 0
    with file.open(encoding="utf-8", newline="") as stream:
        (row,) = csv.DictReader(stream)
    assert float(row["probability"]) == pytest.approx(0.3992, abs=5e-5)
    assert row["sentence"].startswith("About 2 in 5")


@every(
    ("flags", "words"),
    [
        ("assess --width-m 0.32 --height-m 1.8 --pga-g 0.35", ["--pgv-m-s", "not given"]),
        ("assess --width-m 0.32 --height-m 1.8 --pgv-m-s 0.35", ["--pga-g", "not given"]),
        ("assess object.toml", ["object.toml", "No such file", "TOML"]),
        (f"{WORKED} --friction nan", ["--friction", "nan"]),
        (f"{WORKED} --target 1.5", ["--target", "1.5"]),
        ("assess --width-m 0.32 --height-m 1.8 --pga-g 0 --pgv-m-s 1", ["--pga-g", "0.0"]),
    ],
)
def test_what_makes_no_sense_is_refused(flags: str, words: list[str]) -> None:
    line = refused(flags)
    assert all(word in line for word in words), line


def test_neither_scipy_nor_the_kernels_are_loaded() -> None:
    code = (
        "import sys; from rocksteady.cli.app import run; "
        f"run({WORKED.split()!r}); run({['screens', *WORKED.split()[1:]]!r}); "
        "print(sorted({'numba', 'scipy', 'matplotlib', 'xarray', 'pandas'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.endswith("[]\n")
