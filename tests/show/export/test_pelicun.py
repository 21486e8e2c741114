"""Fragility tables: read back by DLML, the library of pelicun's damage models."""

import csv
import importlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from rocksteady.errors import InputError, OutputError
from rocksteady.export import LossComponent, LossState, write_pelicun
from rocksteady.risk.counted.reach import RATIO
from tests.every import every
from tests.show.export.test_components import multilinear

dlml = importlib.import_module("dlml")
load_tabular = importlib.import_module("dlml._tabular").load_tabular
vocabulary = importlib.import_module("dlml.vocabulary")

pytestmark = [  # DLML sets options that pandas 3 no longer needs
    pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*"),
    pytest.mark.filterwarnings("ignore:.*copy_on_write.*"),
]

QUICK = (Phase.explicit, Phase.generate)
"""A failure is not made smaller: each example writes files to the disk."""


def falls(median: float = 0.466, beta: float = 0.592, **more: Any) -> LossState:
    return LossState(name="overturned", median=median, beta=beta, **more)


def component(*states: LossState, **more: Any) -> LossComponent:
    given: dict[str, Any] = {"identifier": "RS.cabinet", "measure": "pgv_m_s", "floor": True}
    return LossComponent(**{**given, "states": states or (falls(),), **more})


def test_head_is_that_of_the_p58_library(tmp_path: Path) -> None:
    (name,) = (each for each in dlml.list_datasets() if "FEMA P-58" in each)
    theirs = dlml.get_fragility(name)
    four = [LossState(name=f"state {k}", median=0.1 + 0.1 * k, beta=0.4) for k in range(4)]
    ours = load_tabular(write_pelicun(tmp_path / "a.csv", [component(*four)])[0])
    assert list(ours.columns) == list(theirs.columns)
    of_theirs, of_ours = dlml.get_metadata(name, "fragility"), read_json(tmp_path / "a.json")
    cabinet = of_theirs["E.20.22.102a"]
    assert set(of_ours["RS.cabinet"]) == set(cabinet)
    assert set(cabinet["LimitStates"]["LS1"]["DS1"]) >= {"Description"}
    general = set(of_theirs["_GeneralInformation"]) - {"ComponentGroups"}
    assert set(of_ours["_GeneralInformation"]) == general


def read_json(file: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(file.read_text(encoding="ascii"))
    return found


@given(median=st.floats(1e-6, 1e6), beta=st.floats(1e-3, 3.0))
@settings(max_examples=25, deadline=None, phases=QUICK)
def test_dlml_reads_the_same_numbers_but_for_the_last_digits_of_its_quick_parser(
    median: float, beta: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("dlml")
    table = load_tabular(write_pelicun(folder / "a.csv", [component(falls(median, beta))])[0])
    row = table.loc["RS.cabinet"]
    assert float(row["LS1", "Theta_0"]) == pytest.approx(median, rel=4e-15)
    assert float(row["LS1", "Theta_1"]) == pytest.approx(beta, rel=4e-15)
    assert row["LS1", "Family"] in vocabulary.DISTRIBUTION_FAMILIES
    assert row["Incomplete", ""] == row["Demand", "Offset"] == 0
    assert row["Demand", "Directional"] == 1


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
def test_demands_are_in_the_vocabulary(
    measure: str, floor: bool, demand: str, unit: str, tmp_path: Path
) -> None:
    made = component(measure=measure, floor=floor)
    table = load_tabular(write_pelicun(tmp_path / "a.csv", [made])[0])
    assert table["Demand"].iloc[0][["Type", "Unit"]].tolist() == [demand, unit]
    assert demand.partition("|")[0] in vocabulary.DEMAND_TYPES


def test_remarks_and_notes_are_in_the_companion(tmp_path: Path) -> None:
    made = component(falls(note="from 280 runs"), note="Half fall at 0.4 g.", description="A rack.")
    write_pelicun(tmp_path / "a.csv", [made])
    found = read_json(tmp_path / "a.json")["RS.cabinet"]
    for words in ("by 1.2", "\nHalf fall at 0.4 g.", "\noverturned: from 280 runs"):
        assert words in found["Comments"]
    assert found["LimitStates"]["LS1"]["DS1"]["Description"] == "overturned"
    assert found["Description"] == "A rack."


@every(
    ("levels", "shares", "written"),
    [
        ([0.1, 0.3], [0.0, 1.0], "0.1,0.3|0,1"),
        ([0.1, 0.2, 0.25, 0.3], [0.0, 0.0, 0.0, 1.0], "0.1,0.25,0.3|0,1e-06,1"),
        ([0.1, 0.2, 0.3, 0.4], [0.0, 0.5, 0.5, 1.0], "0.1,0.2,0.3,0.4|0,0.499999,0.5,1"),
        ([0.1, 0.2, 0.3, 0.4], [0.0, 1.0, 1.0, 1.0], "0.1,0.2|0,1"),
        ([0.1, 0.2], [0.0, 0.4], f"0.1,0.2,{0.2 * RATIO:.12g}|0,0.4,1"),
        ([0.1, 0.2], [0.0, 0.0], f"0.1,0.2,{0.2 * RATIO:.12g}|0,1e-06,1"),
    ],
)  # fmt: skip
def test_points_rise_from_0_to_1(
    levels: list[float], shares: list[float], written: str, tmp_path: Path
) -> None:
    """Both ends of a level part stay, and where runs end below 1 there is one more point."""
    made = component(LossState(name="uplift", levels=levels, shares=shares))
    row = load_tabular(write_pelicun(tmp_path / "a.csv", [made])[0]).loc["RS.cabinet"]
    assert (row["LS1", "Family"], row["LS1", "Theta_0"]) == ("multilinear_CDF", written)
    assert "the last point is added" in read_json(tmp_path / "a.json")["RS.cabinet"]["Comments"]


NUMBERS = st.floats(0.0, 1.0) | st.sampled_from([0.0, 1e-9, 1e-6, 0.5, 0.5 + 1e-7, 1.0])


@given(points=st.lists(st.tuples(st.floats(3e-5, 1.0), NUMBERS), min_size=2, max_size=30))
@settings(max_examples=50, deadline=None, phases=QUICK)
def test_any_points_rise_and_come_back(
    points: list[tuple[float, float]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    steps, numbers = zip(*points, strict=True)
    shares = [0.0, *sorted(numbers[1:])]
    levels = (0.01 * np.cumprod(1.0 + np.array(steps))).tolist()
    made = component(LossState(name="uplift", levels=levels, shares=shares))
    file, _ = write_pelicun(tmp_path_factory.mktemp("points") / "a.csv", [made])
    share = multilinear(load_tabular(file).loc["RS.cabinet", ("LS1", "Theta_0")], 9.80665)
    np.testing.assert_allclose(share(levels), shares, atol=1e-5)


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
    found = read_json(companion)["RS.cabinet"]
    assert found["Description"] == text.replace("\ud800", "?")


def test_one_identifier_twice_and_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"components have RS.cabinet twice"):
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


STATES = (LossState(name="uplift", median=0.3, beta=0.4), falls())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("made", "demand"),
    [
        (component(*STATES, measure="pga_g", floor=False), ("PGA", "g")),
        (component(falls(), measure="sa_g", period_s=1.0, floor=False), ("SA_1.0", "g")),
        (component(LossState(name="a", levels=[0.2, 0.4, 0.6, 1.2], shares=[0, 0.3, 0.3, 0.9])),
         ("PFV", "mps")),
    ],
)  # fmt: skip
def test_pelicun_finds_the_probabilities_of_the_curves(
    made: LossComponent, demand: tuple[str, str], pelicun: Path, tmp_path: Path
) -> None:
    table, _ = write_pelicun(tmp_path / "a.csv", [made])
    levels = [0.3, 0.466, 1.2]
    asked = Path(__file__).with_name("pelicun_asked.py")
    ran = subprocess.run(
        [*map(str, (pelicun, asked, table, made.identifier, *demand, *levels))],
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": ""},
    )
    shares = json.loads(ran.stdout.splitlines()[-1])
    for number, state in enumerate(made.states, start=1):
        found = [sum(each.get(str(k), 0.0) for k in range(number, 10)) for each in shares]
        assert found == pytest.approx(state.probability(levels), abs=0.01)
