"""Fragility tables: read back by DLML, the library of pelicun's damage models."""

import csv
import importlib
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError, OutputError
from rocksteady.export import LossComponent, LossState, write_pelicun
from rocksteady.risk.counted.reach import RATIO
from tests.every import every
from tests.show.export.test_components import QUIET, load_tabular
from tests.show.export.test_openquake import component, falls

dlml = importlib.import_module("dlml")
vocabulary = importlib.import_module("dlml.vocabulary")
pytestmark = QUIET


def test_head_is_that_of_the_p58_library(tmp_path: Path) -> None:
    (name,) = (each for each in dlml.list_datasets() if "FEMA P-58" in each)
    theirs = dlml.get_fragility(name)
    four = [replace(falls(), name=f"state {k}") for k in range(4)]
    ours = load_tabular(write_pelicun(tmp_path / "a.csv", [component(*four)])[0])
    assert list(ours.columns) == list(theirs.columns)
    of_theirs, of_ours = dlml.get_metadata(name, "fragility"), read_json(tmp_path / "a.json")
    cabinet = of_theirs["E.20.22.102a"]
    assert set(of_ours["RS.vase"]) == set(cabinet)
    assert set(cabinet["LimitStates"]["LS1"]["DS1"]) >= {"Description"}
    general = set(of_theirs["_GeneralInformation"]) - {"ComponentGroups"}
    assert set(of_ours["_GeneralInformation"]) == general


def read_json(file: Path) -> dict[str, Any]:
    values: dict[str, Any] = json.loads(file.read_text(encoding="ascii"))
    return values


@every(
    ("measure", "floor", "demand", "unit"),
    [
        ("pgv_m_s", True, "Peak Floor Velocity", "mps"),
        ("pgv_m_s", False, "Peak Ground Velocity", "mps"),
        ("pga_g", True, "Peak Floor Acceleration", "g"),
        ("pga_g", False, "Peak Ground Acceleration", "g"),
        ("sa_g:1", False, "Spectral Acceleration|1.0", "g"),
    ],
)
def test_demands_and_families_are_in_the_vocabulary(
    measure: str, floor: bool, demand: str, unit: str, tmp_path: Path
) -> None:
    made = component(falls(1.0 / 3.0, 2.0 / 3.0), measure=measure, floor=floor)
    row = load_tabular(write_pelicun(tmp_path / "a.csv", [made])[0]).loc["RS.vase"]
    columns = {"Type": demand, "Unit": unit, "Offset": 0, "Directional": 1}
    assert row["Demand"].to_dict() == columns
    assert demand.partition("|")[0] in vocabulary.DEMAND_TYPES
    median, beta = map(float, row["LS1"][["Theta_0", "Theta_1"]])
    assert row["LS1", "Family"] in vocabulary.DISTRIBUTION_FAMILIES
    # Its quick parser loses the last digits.
    assert (median, beta) == pytest.approx((1.0 / 3.0, 2.0 / 3.0), rel=4e-15)


def test_the_remarks_and_the_note_are_in_the_companion(tmp_path: Path) -> None:
    made = component(note="56 records, made monotone.", description="A rack.")
    write_pelicun(tmp_path / "a.csv", [made])
    found = read_json(tmp_path / "a.json")["RS.vase"]
    assert "by 1.2" in found["Comments"]
    assert found["Comments"].endswith("\n56 records, made monotone.")
    assert found["LimitStates"]["LS1"]["DS1"]["Description"] == "overturned"
    assert found["Description"] == "A rack."


@every(
    ("levels", "shares", "written"),
    [
        ([0.1, 0.3], [0.0, 1.0], "0.1,0.3|0,1"),
        ([0.1, 0.2, 0.25, 0.3], [0.0, 0.0, 0.0, 1.0], "0.1,0.2,0.25,0.3|0,1e-06,2e-06,1"),
        ([0.1, 0.2, 0.3, 0.4], [0.0, 0.5, 0.5, 1.0], "0.1,0.2,0.3,0.4|0,0.499999,0.5,1"),
        ([0.1, 0.2, 0.3, 0.4], [0.0, 1.0, 1.0, 1.0], "0.1,0.2|0,1"),
        ([0.1, 0.2, 0.3], [0.0, 0.5, 0.9999999], "0.1,0.2,0.3|0,0.5,1"),
        ([0.1, 0.2], [0.0, 0.4], f"0.1,0.2,{0.2 * RATIO:.12g}|0,0.4,1"),
        ([0.1, 0.2], [0.0, 0.0], f"0.1,0.2,{0.2 * RATIO:.12g}|0,1e-06,1"),
    ],
)  # fmt: skip
def test_points_rise_from_0_to_1(
    levels: list[float], shares: list[float], written: str, tmp_path: Path
) -> None:
    """Equal shares rise by a millionth, and where runs end below 1 there is one more point."""
    made = component(LossState(name="uplift", levels=levels, shares=shares))
    row = load_tabular(write_pelicun(tmp_path / "a.csv", [made])[0]).loc["RS.vase"]
    assert (row["LS1", "Family"], row["LS1", "Theta_0"]) == ("multilinear_CDF", written)
    assert "the last point is added" in read_json(tmp_path / "a.json")["RS.vase"]["Comments"]


@every(
    "name",
    ["", "a-b", "=1+1", "@x", "+x", "-x", "1.5", "nan", "NA", "None", "inf", "True", "a b", "a,b",
     'a"b', "a\nb", "a\n", "波", "a/b", "<a>", "a" * 76],
)  # fmt: skip
def test_an_identifier_that_a_reader_would_change_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="identifier"):
        component(identifier=name)


@every("text", ['"a",b\nc', "=cmd|' /C calc'!A0", "\x00\ud800", "波 🏺", "<&>"])
def test_text_from_outside_is_in_the_companion_alone(text: str, tmp_path: Path) -> None:
    made = component(LossState(name=f"x {text}", median=0.2, beta=0.5), description=text)
    table, companion = write_pelicun(tmp_path / "a.csv", [made])
    with table.open(newline="", encoding="ascii") as stream:
        rows = list(csv.reader(stream))
    assert [len(row) for row in rows] == [10, 10]
    assert not any(cell[:1] in ("=", "+", "-", "@") for row in rows for cell in row)
    found = read_json(companion)["RS.vase"]
    assert found["Description"] == text


def test_one_identifier_twice_and_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"components have RS.vase twice"):
        write_pelicun(tmp_path / "a.csv", [component(), component()])
    with pytest.raises(InputError, match=r"components are none"):
        write_pelicun(tmp_path / "a.csv", [])
    with pytest.raises(InputError, match=r"ends in .csv"):
        write_pelicun(tmp_path / "a.json", [component()])
    assert list(tmp_path.iterdir()) == []


def test_a_companion_that_cannot_be_written_leaves_no_table(tmp_path: Path) -> None:
    (tmp_path / "a.json").mkdir()
    with pytest.raises(OutputError, match="it is a folder"):
        write_pelicun(tmp_path / "a.csv", [component()])
    assert [file.name for file in tmp_path.iterdir()] == ["a.json"]


# ------------------------------------------------------------------------- pelicun itself


@pytest.fixture(scope="module")
def pelicun() -> Path:
    """Return a Python with pelicun, whose dependencies are older than those of the package."""
    folder = Path(__file__).parents[3] / "build" / "pelicun"
    python = folder / "bin" / "python"
    try:
        if not python.exists():
            subprocess.run([sys.executable, "-m", "venv", folder], check=True, capture_output=True)
        install = [str(python), "-m", "pip", "install", "--quiet", "--only-binary", ":all:"]
        subprocess.run([*install, "pelicun==3.10.0"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("pelicun cannot be installed here")
    return python


POINTS = LossState(name="a", levels=[0.2, 0.4, 0.6, 1.2], shares=[0.0, 0.3, 0.3, 0.9])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("made", "demand"),
    [
        (component(replace(falls(), name="uplift"), falls(0.466, 0.592)), ("PGA", "g")),
        (component(falls(0.6), measure="sa_g:1"), ("SA_1.0", "g")),
        (component(POINTS, measure="pgv_m_s", floor=True), ("PFV", "mps")),
    ],
)
def test_pelicun_finds_the_probabilities_of_the_curves(
    made: LossComponent, demand: tuple[str, str], pelicun: Path, tmp_path: Path
) -> None:
    table, _ = write_pelicun(tmp_path / "a.csv", [made])
    levels = [0.3, 0.466, 1.2]
    script = Path(__file__).with_name("pelicun_asked.py")
    command = [*map(str, (pelicun, script, table, made.identifier, *demand, *levels))]
    alone = {**os.environ, "PYTHONPATH": ""}
    printed = subprocess.check_output(command, text=True, cwd=tmp_path, env=alone)
    shares = np.array(json.loads(printed.splitlines()[-1]))
    for reached, state in zip(shares.T, made.states, strict=True):
        assert reached == pytest.approx(state.probability(levels), abs=0.01)
