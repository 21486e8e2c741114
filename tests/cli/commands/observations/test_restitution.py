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
