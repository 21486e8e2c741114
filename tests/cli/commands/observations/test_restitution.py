"""`rocksteady restitution`: from a table of peaks to a restitution, and back into `simulate`."""

import json
from pathlib import Path

import pytest

from rocksteady import Block
from rocksteady.formulas import free_rocking_peaks
from tests.cli.program import rocksteady

BLOCK = Block.rectangle(width=0.05, height=0.5)
SIZE = ("--width-m", "0.05", "--height-m", "0.5")


@pytest.fixture
def peaks(tmp_path: Path) -> Path:
    file = tmp_path / "peaks.csv"
    values = 1e3 * BLOCK.alpha * free_rocking_peaks(0.6, 0.95, 12, alpha=BLOCK.alpha)
    file.write_text("peak_mrad\n" + "".join(f"{value!r}\n" for value in values.tolist()), "utf-8")
    return file


def test_json_has_the_estimates_and_the_block(peaks: Path) -> None:
    ran = rocksteady("restitution", "--peaks", str(peaks), *SIZE, "--json")
    assert ran.code == 0, ran.err
    found = json.loads(ran.out)
    assert found["schema"] == "rocksteady/restitution/1"
    assert found["restitution"] == pytest.approx([0.95, 0.95], abs=1e-10)
    assert found["factor"] == pytest.approx([0.95 / BLOCK.restitution] * 2, rel=1e-9)
    assert len(found["impacts"]) == 12
    assert found["block"]["alpha_rad"] == BLOCK.alpha
    # The factor gives the block that was measured, in the form that other commands take.
    form = f"housner*{found['factor'][0]!r}"
    again = rocksteady(
        "simulate", *SIZE, "-r", form, "--accel-g", "0.2", "--freq-hz", "2", "--json"
    )
    block = json.loads(again.out)["block"]
    assert block["restitution"] == pytest.approx(0.95, abs=1e-10)
    assert block["housner_factor"] == found["factor"][0]


def test_text_table_and_picture_are_written(peaks: Path, tmp_path: Path) -> None:
    plot, table = tmp_path / "fit.png", tmp_path / "impacts.csv"
    flags = ("--plot", str(plot), "--csv", str(table), "--width", "84mm")
    ran = rocksteady("restitution", "--peaks", str(peaks), *SIZE, *flags, "--more")
    assert ran.code == 0, ran.err
    assert "restitution 0.95, 0.964 of Housner's, from 12 impacts of 1 release" in ran.out
    assert plot.stat().st_size > 10_000
    rows = table.read_text("utf-8").splitlines()
    assert len(rows) == 13
    assert rows[0].startswith("release,number,side,peak_rad")


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (SIZE, "--peaks is not given"),
        (("--peaks", "peaks.csv"), "an object needs a size"),
        (("--peaks", "peaks.csv", *SIZE, "-r", "0.9"), "is what this command finds"),
        (("--peaks", "none.csv", *SIZE), "none.csv"),
        (("--peaks", "peaks.csv", *SIZE, "--csv", "peaks.csv", "--force"), "this file is read"),
        (("--peaks", "peaks.csv", *SIZE, "--model", "cubic"), "two equations of motion"),
        (("--peaks", "peaks.csv", "--width-m", "0.01", "--height-m", "0.5"), "--peaks = 0"),
    ],
)
@pytest.mark.usefixtures("peaks")
def test_what_cannot_be_fitted_has_one_line(
    flags: tuple[str, ...], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    ran = rocksteady("restitution", *flags)
    assert ran.code == 2
    assert words in ran.err
    assert len(ran.err.strip().splitlines()) == 1


def test_the_answer_has_the_interval_and_housners_value(peaks: Path) -> None:
    command = ("restitution", "--peaks", str(peaks), *SIZE)
    values = json.loads(rocksteady(*command, "--json").out)
    first = " ".join(rocksteady(*command).out.splitlines()[:1])
    assert first.startswith(f"Restitution {values['restitution'][0]:.4g} (90 %: ")
    assert f"{values['factor'][0]:.3f} of Housner's {values['housner'][0]:.4g}." in first
