"""`rocksteady edge`: its contract, its files and what it refuses."""

import csv
import re
from pathlib import Path

import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_edge_state
from tests.cli.program import rocksteady
from tests.every import every

POINT = "edge -A 0.2 -W 2 -r 0.9"
ASYMMETRIC = "--left-m .22 --right-m .16 --height-m 1.5"


def test_the_json_is_that_of_the_function_with_the_start() -> None:
    ran = rocksteady(f"{POINT} --direction - --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["schema"] == "rocksteady/edge/1"
    motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    found = find_edge_state(DimensionlessBlock(restitution=0.9), motion, kick=-1)
    assert values["kind"] == "hilltop"
    assert values["hilltop_side"] == -1
    assert values["least_kick"] == found.kick == pytest.approx(-1.08, abs=1e-9)
    assert values["outcomes"] == ["rest", "overturned to the negative side"]
    assert (values["start"], values["direction"], values["cycles"]) == ("rest", "-", 500)


@pytest.mark.slow
def test_manifolds_go_to_the_csv_and_into_the_picture(tmp_path: Path) -> None:
    plot, table = tmp_path / "edge.png", tmp_path / "edge.csv"
    ran = rocksteady(f"{POINT} --manifolds --length 2 --more --plot {plot} --csv {table}")
    assert ran.code == 0
    assert "Stable manifold of a hilltop saddle" in ran.out
    assert plot.stat().st_size > 5000
    with table.open() as lines:
        rows = list(csv.DictReader(lines))
    assert {row["kind"] for row in rows} == {"stable", "unstable"}
    # The least kick from rest is where the stable manifold crosses the axis of velocities.
    on_axis = [row for row in rows if row["kind"] == "stable" and abs(float(row["angle"])) < 0.02]
    assert any(abs(float(row["velocity"]) - 0.92) < 0.04 for row in on_axis)


def test_without_manifolds_the_csv_is_the_tracked_motion(tmp_path: Path) -> None:
    table = tmp_path / "edge.csv"
    assert rocksteady(f"{POINT} --csv {table}").code == 0
    assert table.read_text().splitlines()[0] == "period,angle,velocity"


@every(
    ("command", "least", "opposite", "unit"),
    [
        (f"{ASYMMETRIC} -A .5 -W 1.7 --model linear", -0.255, 0.44, "_m_s"),
        ("-A .6 -W 2 -r .9", -0.265, 0.425, ""),
    ],
)
def test_a_fractal_edge_has_the_least_kick_found_of_both_directions(
    command: str, least: float, opposite: float, unit: str
) -> None:
    values = rocksteady(f"edge {command} --json").json
    assert values[f"least_kick{unit}"] == pytest.approx(least, abs=1e-3)
    assert values[f"opposite_kick{unit}"] == pytest.approx(opposite, abs=1e-3)
    assert (values["direction"], values["fractal"], values["resolution"]) == ("both", True, 1e-4)
    text = " ".join(rocksteady(f"edge {command}").out.split())
    assert f"the least kick found that makes it fall is {least}" in text
    assert "in steps of 0.0001 alpha g/p; fractal" in text
    forward = " ".join(rocksteady(f"edge {command} --direction +").out.split())
    assert f"the least positive kick found that makes it fall is {opposite}" in forward


def test_a_direction_that_was_not_searched_is_told_from_one_without_a_fatal_kick() -> None:
    command = "edge -A .2 -W 2 -r .9 --one-sided"
    both, alone = (rocksteady(f"{command}{way} --json").json for way in ("", " --direction +"))
    assert both["opposite_kick"] is None
    assert alone["opposite_kick"] is None
    assert (both["direction"], alone["direction"]) == ("both", "+")
    between = rocksteady("edge -A 0.5 -W 2 -r 0.9 --other 0.2,0.3 --json").json
    assert between["direction"] is None


def test_both_commands_write_the_other_way_alike() -> None:
    """Without shaking the least kick is the same; two digits more follow with --more."""
    size = "--width-m 0.6 --height-m 1.8 --model linear --start 0.5,0"
    kick = rocksteady(f"overturn --kick {size}").out
    edge = rocksteady(f"edge {size} -A 1e-9 -W 2 --more").out
    ways = [re.findall(r"the other way +(.+)", text) for text in (kick, edge)]
    assert ways[0] == ways[1][:1]
    assert re.fullmatch(r"(-[\d.]+) m/s \((-[\d.]+) alpha g/p\)", ways[0][0])
    least, other = (
        re.findall(rf"^{label} +([-\d.]+)", edge, re.MULTILINE)[-1]
        for label in ("least kick", "the other way")
    )
    assert len(least.strip("-0.")) == len(other.strip("-0.")) == 6
    wall = "--width-m .4 --height-m 1.6 --one-sided --model linear"
    commands = "overturn --kick", "edge -A .2 -W 2"
    none = [rocksteady(f"{command} {wall}").out for command in commands]
    words = [re.findall(r"the other way +(.+)", " ".join(text.split())) for text in none]
    assert all("no kick up to 3.22 m/s (4 alpha g/p) makes it fall" in each[0] for each in words)
