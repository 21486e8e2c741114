"""One question has one number: on the screen, in JSON, CSV, Python, pictures and pages.

Each test asks one question through every door, and holds what people read to what files say, to the
digits that are printed.
"""

import csv
import html
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.motions import make_synthetic_suite
from rocksteady.results.numbers import chance
from rocksteady.results.rendering import as_html
from tests.cli.program import Ran, rocksteady

SIZE = "--width-m 0.4 --height-m 2 -r 0.9"
POINT = f"{SIZE} --accel-g 0.4 --freq-hz 2"
BLOCK = rs.Block.rectangle(width=0.4, height=2.0, restitution=0.9)
MOTION = rs.Harmonic.from_si(BLOCK, acceleration_m_s2=0.4 * 9.80665, frequency_hz=2.0)

OBJECT = """
name = "cabinet"
friction = 0.9
[geometry]
width_m = {width}
height_m = 1.8
[demand]
pga_g = 0.35
pgv_m_s = 0.4
[assessment]
damage_states = ["overturned"]
"""


def asked(command: str, folder: Path) -> tuple[Ran, dict[str, Any], list[dict[str, str]]]:
    """Return the screen, the JSON object and the rows of --csv of a command."""
    table = folder / "table.csv"
    screen = rocksteady(f"{command} --force --csv", table)
    with table.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return screen, rocksteady(f"{command} --json").json, rows


def printed(pattern: str, text: str) -> float:
    """Return the number that a pattern finds in what people read."""
    found = re.search(pattern, " ".join(html.unescape(text).split()))
    assert found, (pattern, text)
    return float(found[1].replace(",", ""))


def agree(read: float, exact: float, digits: int = 3) -> bool:
    """Return whether a number is another one to the digits that are printed."""
    return math.isclose(read, exact, rel_tol=0.51 * 10.0 ** (1 - digits), abs_tol=1e-12)


def test_the_time_of_a_fall(tmp_path: Path) -> None:
    pulse = rs.Pulse.from_si(
        BLOCK, shape="one-sine", acceleration_m_s2=0.4 * 9.80665, frequency_hz=1.0
    )
    run = rs.simulate(BLOCK, pulse)
    assert run.overturn_time_s is not None
    command = f"simulate {SIZE} --pulse one-sine --accel-g 0.4 --freq-hz 1"
    screen, values, rows = asked(command, tmp_path)
    assert values["overturn_time_s"] == run.overturn_time_s
    for text in (screen.out, run.summary(), as_html(run.describe())):
        assert agree(printed(r"([\d.]+) s", text), run.overturn_time_s)
    fallen = next(row for row in rows if abs(float(row["angle_deg"])) >= math.degrees(BLOCK.alpha))
    assert float(fallen["time_s"]) == pytest.approx(run.overturn_time_s, abs=0.02)
    axes = run.plot()
    words = " ".join(text.get_text() for text in axes.texts)
    assert agree(printed(r"falls at ([\d.]+) s", words), run.overturn_time_s)
    marks = [float(np.ravel(line.get_xdata())[0]) for line in axes.lines]
    assert pytest.approx(run.overturn_time_s) in marks


def test_the_tilt_of_a_steady_motion(tmp_path: Path) -> None:
    states = rs.find_steady_states(BLOCK, MOTION)
    assert states.peak is not None
    peak = float(states.peak.ravel()[0])
    degrees = math.degrees(peak * BLOCK.alpha)
    screen, values, rows = asked(f"steady {POINT}", tmp_path)
    assert values["solutions"][0]["peak"] == peak
    assert float(rows[0]["peak_deg"]) == pytest.approx(degrees)
    assert float(states.to_dataframe()["peak_deg"][0]) == pytest.approx(degrees)
    assert float(states.to_dataset().peak.values.ravel()[0]) == peak
    for text in (screen.out, states.summary(), states._repr_html_()):
        assert agree(printed(r"([\d.]+)° (?:=|\()", text), degrees)
        assert agree(printed(r"\(?([\d.]+) alpha", text), peak)
    # What it settles to is the same motion, by another command.
    other, found, _ = asked(f"attractor {POINT}", tmp_path)
    assert found["peaks"][0] == pytest.approx(peak, rel=1e-9)
    assert agree(printed(r"([\d.]+) alpha", other.out), peak)


def test_the_share_of_starts_that_fall(tmp_path: Path) -> None:
    window = "--angles=-1:1:40 --velocities=-1:1:40"
    command = f"basins {POINT} {window}"
    screen, values, rows = asked(command, tmp_path)
    found = rs.compute_basins(
        BLOCK, MOTION, angles=np.linspace(-1, 1, 40), velocities=np.linspace(-1, 1, 40)
    )
    counted = sum(row["attractor"] == "overturned" for row in rows) / len(rows)
    in_json = {each["name"]: each["share"] for each in values["fractions"]}
    names = [attractor.name for attractor in found.attractors]
    in_python = {names[fraction.label]: fraction.share for fraction in found.fractions()}
    assert in_json["overturned"] == in_python["overturned"] == counted
    assert (found.to_dataframe()["attractor"] == "overturned").mean() == counted
    assert agree(printed(r"falls ([\d.]+) %", screen.out), 100 * counted)
    assert agree(printed(r"([\d.]+) % fall", screen.out), 100 * counted, 2)
    labels = [text.get_text() for text in found.plot().get_legend().get_texts()]
    assert agree(printed(r"falls ([\d.]+) %", " ".join(labels)), 100 * counted)


def test_the_cells_of_a_map(tmp_path: Path) -> None:
    screen, values, rows = asked(f"map {SIZE} --accel-g .1:1:12 --freq-hz .5:4:12", tmp_path)
    # A steady motion of several periods is counted as subharmonic, whatever its symmetry.
    steady = {"symmetric", "unsymmetric"}
    kinds = [
        "subharmonic" if row["kind"] in steady and int(row["period"]) > 1 else row["kind"]
        for row in rows
    ]
    assert {kind: kinds.count(kind) for kind in set(kinds)} == {
        kind: count for kind, count in values["counts"].items() if count
    }
    axes = {
        "acceleration_m_s2": 9.80665 * np.linspace(0.1, 1.0, 12),
        "frequency_hz": np.linspace(0.5, 4.0, 12),
    }
    cells = rs.map_attractors(BLOCK, axes=axes)
    falls = kinds.count("overturned")
    assert cells.rocksteady.to_dict()["counts"] == values["counts"]
    assert printed(r"falls ([\d,]+) of", screen.out) == falls
    assert agree(printed(r"falls in ([\d.]+) %", screen.out), 100 * falls / 144)
    labels = [text.get_text() for text in cells.rocksteady.plot().get_legend().get_texts()]
    assert agree(printed(r"falls ([\d.]+) %", " ".join(labels)), 100 * falls / 144)
    accelerations = sorted({float(row["accel_g"]) for row in rows})
    assert accelerations == pytest.approx(list(np.linspace(0.1, 1.0, 12)))


def test_the_least_pulse_that_fells(tmp_path: Path) -> None:
    screen, values, rows = asked(f"overturn --pulse one-sine {SIZE} --freq-hz 2", tmp_path)
    found = rs.find_overturning_windows(
        BLOCK, "one-sine", [MOTION.frequency_ratio], model=rs.Nonlinear()
    )
    low = values["windows"][0]["intervals"][0][0]
    assert float(rows[0]["low"]) == low == found.to_dataframe()["low"][0]
    in_g = low * BLOCK.alpha
    assert float(rows[0]["low_g"]) == pytest.approx(in_g)
    for text in (screen.out, found.summary()):
        assert agree(printed(r"([\d.]+) g", text), in_g)


@pytest.mark.parametrize("width", [0.32, pytest.param(0.4, marks=pytest.mark.slow)])
def test_the_share_of_runs_in_which_an_object_falls(
    width: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("motions").mkdir()
    for record in make_synthetic_suite(12):
        samples = record.acceleration_m_s2.tolist()
        lines = [f"{k * record.dt_s!r},{sample!r}" for k, sample in enumerate(samples)]
        text = "\n".join(["t (s),acc (m/s2)", *lines])
        Path(f"motions/{record.name}.csv").write_text(f"{text}\n", encoding="utf-8")
    Path("cabinet.toml").write_text(OBJECT.format(width=width), encoding="utf-8")
    Path("cabinets.csv").write_text(
        f"name,width_m,height_m,friction\ncabinet,{width},1.8,0.9\n", encoding="utf-8"
    )
    command = "assess cabinet.toml --records motions"
    screen, values, rows = asked(command, tmp_path)
    share, band = values["share"], (values["low"], values["high"])
    assert 0.0 < share < 1.0
    assert values["by"] == "runs"
    assert values["fall"] / values["runs"] == pytest.approx(share)
    assert float(rows[0]["share"]) == share
    answer = rs.assess_object(rs.read_object("cabinet.toml"), rs.read_records("motions"))
    assert (answer.share, answer.band, answer.verdict) == (share, band, values["verdict"])
    assert answer.cases[0].share == share
    assert answer.fragility is not None
    fallen = answer.fragility.state("overturned")
    (row,) = (row for row in fallen.rows if row["level"] == 0.35)
    assert (row["share"], row["low"], row["high"]) == (share, *band)
    # In a table with others it is the same object.
    table = "assess cabinets.csv --records motions --pga-g .35 --pgv-m-s .4"
    crowd, _, (one,) = asked(table, tmp_path)
    assert float(one["share"]) == share
    assert one["verdict"] == values["verdict"]
    assert rocksteady(f"{command} --out answer").code == 0
    page = Path("answer/report.html").read_text(encoding="utf-8")
    page = re.sub(r"<(style|script)\b.*?</\1>", " ", page, flags=re.DOTALL)
    page = " ".join(html.unescape(re.sub(r"<[^>]*>", " ", page)).split())
    words = f"{chance(share)} (90 %: "
    for text in (screen.out, crowd.out, answer.summary(), page):
        assert words in " ".join(text.split()), words
    with Path("answer/shares.csv").open(encoding="utf-8", newline="") as stream:
        kept = [each for each in csv.DictReader(stream) if float(each["level"]) == 0.35]
    assert [float(each["share"]) for each in kept if each["damage_state"] == "overturned"] == [
        share
    ]
    labels = " ".join(text.get_text() for text in answer.plot().texts)
    assert chance(share) in labels
