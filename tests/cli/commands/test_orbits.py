"""`rocksteady orbits`: its contract, its text and its files."""

import csv
import math
from pathlib import Path

import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from tests.cli.program import refused, rocksteady
from tests.every import every

POINT = "orbits -A 2 -W 1.9 -r 0.8"
KEYS = {
    "kind",
    "period",
    "impacts_per_period",
    "rest_phases",
    "peaks",
    "multipliers",
    "lyapunov",
    "admissible",
    "stable",
    "neutral",
    "branch",
    "residual",
    "states",
}
BARE = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=1.9)


def test_the_json_keeps_the_contract() -> None:
    ran = rocksteady(f"{POINT} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert next(iter(values)) == "schema"
    assert values["schema"] == "rocksteady/orbits/1"
    assert (values["max_period"], values["max_impacts"], values["seeds"]) == (3, 6, 96)
    found = find_orbits(BARE, SHAKING)
    assert len(values["orbits"]) == len(found)
    for listed, orbit in zip(values["orbits"], found, strict=True):
        assert set(listed) == KEYS
        assert listed["kind"] == orbit.kind
        assert (listed["period"], listed["impacts_per_period"]) == (orbit.period, orbit.impacts)
        assert listed["peaks"] == ([orbit.highest, orbit.lowest] if orbit.admissible else None)
        assert listed["admissible"] == orbit.admissible
        assert listed["stable"] == (orbit.stable if orbit.admissible else None)
        assert listed["branch"] == orbit.branch
        assert len(listed["states"]) == len(orbit.states)
        first, second = (complex(*pair) for pair in listed["multipliers"])
        assert abs(first) >= abs(second) * (1.0 - 1e-15)
        assert {first, second} == {complex(m) for m in orbit.multipliers}


def test_the_only_stable_orbit_is_the_attractor() -> None:  # TW7
    listed = rocksteady(f"{POINT} --json").json["orbits"]
    (stable,) = (orbit for orbit in listed if orbit["stable"])
    assert stable["peaks"] == pytest.approx([0.90035, -0.44427], abs=5.1e-6)
    assert (stable["kind"], stable["period"], stable["branch"]) == ("unsymmetric", 1, None)
    settled = rocksteady("attractor -A 2 -W 1.9 -r 0.8 --start steady --side - --json").json
    assert settled["peaks"] == pytest.approx(stable["peaks"], abs=1e-12)


def test_the_closed_forms_are_those_of_steady() -> None:
    listed = rocksteady("orbits -A 2 -W 4 -r 0.8 --max-period 1 --json").json["orbits"]
    solutions = rocksteady("steady -A 2 -W 4 -r 0.8 --json").json["solutions"]
    for orbit, solution in zip(listed[:2], solutions, strict=True):
        assert (orbit["branch"], orbit["admissible"]) == (
            solution["branch"],
            solution["admissible"],
        )
        assert orbit["stable"] == solution["stable"]
        assert orbit["peaks"] == (
            [solution["peak"], -solution["peak"]] if solution["admissible"] else None
        )
        half = complex(*solution["half_cycle_multipliers"][0])
        assert abs(complex(*orbit["multipliers"][0])) == pytest.approx(abs(half) ** 2)
    assert listed[0]["peaks"][0] == pytest.approx(0.18550, abs=5.1e-6)
    assert (listed[1]["stable"], listed[1]["neutral"]) == (None, None), "no motion"


def test_of_a_conjugate_pair_the_one_above_the_axis_is_first() -> None:
    for ratio in ("1.9", "4"):
        for orbit in rocksteady(f"orbits -A 2 -W {ratio} -r 0.8 --json").json["orbits"]:
            first, second = orbit["multipliers"]
            assert first[1] >= 0.0
            assert second[1] == -first[1]


def test_without_loss_an_orbit_is_neutral_and_not_stable() -> None:
    first = rocksteady("orbits -A 2 -W 4 -r 1 --max-period 1 --json").json["orbits"][0]
    assert (first["stable"], first["neutral"]) == (False, True)
    assert "neutral" in rocksteady("orbits -A 2 -W 4 -r 1 --max-period 1").out


def test_the_limits_of_the_search_are_kept() -> None:
    command = f"{POINT} --max-period 1 --max-impacts 2 --seeds 24 --json"
    values = rocksteady(command).json
    assert (values["max_period"], values["max_impacts"], values["seeds"]) == (1, 2, 24)
    assert {orbit["period"] for orbit in values["orbits"]} == {1}
    assert {orbit["impacts_per_period"] for orbit in values["orbits"]} == {2}


def test_a_real_block_is_in_radians_and_seconds() -> None:
    values = rocksteady("orbits --block tso-wong-1989 -A 2 --freq-hz 4 --json").json
    assert values["block"]["alpha_rad"] == 0.2
    for orbit in values["orbits"]:
        radians = orbit["peaks"] and [0.2 * peak for peak in orbit["peaks"]]
        assert orbit["peaks_rad"] == radians
        assert (radians is None) == (not orbit["admissible"])
        assert orbit["period_s"] == pytest.approx(0.25 * orbit["period"])


def test_the_text_is_a_row_an_orbit_in_80_columns() -> None:
    ran = rocksteady(f"{POINT} --more")
    assert (ran.code, ran.err) == (0, "")
    lines = ran.out.splitlines()
    assert max(map(len, lines)) <= 80
    assert "…" not in ran.out, "no cell is cut off"
    count = len(rocksteady(f"{POINT} --json").json["orbits"])
    rows = [line for line in lines if line.split()[0].isdigit() and line.split()[1].isdigit()]
    assert [int(row.split()[0]) for row in rows] == [*range(1, count + 1)]
    assert "12 periodic motions up to 3 periods and 6 impacts, 1 stable" in ran.out
    for word in ("stable", "unstable", "inadmissible", "0.9004", "-0.4443", "0.394 ± 0.504i"):
        assert word in ran.out


@pytest.mark.slow
def test_where_nothing_moves_the_list_is_empty(tmp_path: Path) -> None:
    command = "orbits -A 0.1 -W 4 -r 0.8"
    assert rocksteady(f"{command} --json").json["orbits"] == []
    table, figure = tmp_path / "a.csv", tmp_path / "a.png"
    ran = rocksteady(f"{command} --more --csv", table, "--plot", figure)
    assert ran.code == 0
    assert "0 periodic motions" in ran.out
    assert len(table.read_text(encoding="utf-8").splitlines()) == 1
    assert figure.read_bytes().startswith(b"\x89PNG")


@every(
    ("flags", "needle"),
    [
        ("--max-period 0", "--max-period = 0"),
        ("--max-period -2", "--max-period = -2"),
        ("--max-period 1.5", "'1.5'"),
        ("--max-impacts 0", "--max-impacts = 0"),
        ("--max-impacts many", "'many'"),
        ("--seeds 0", "--seeds = 0"),
        ("--max-period 99999999999", "--max-period = 99999999999"),
        ("--max-impacts 99999999999", "--max-impacts = 99999999999"),
        ("--seeds 99999999999", "--seeds = 99999999999"),
        ("--start rest", "--start"),
    ],
)
def test_bad_limits_are_refused(flags: str, needle: str, tmp_path: Path) -> None:
    assert needle in refused(f"{POINT} {flags} --csv", tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


def test_an_axis_is_refused() -> None:
    assert "--frequency-ratio/-W has 5 values" in refused("orbits -A 1 -W 2:4:5 -r 0.8")


def test_the_csv_holds_every_orbit_to_the_last_digit(tmp_path: Path) -> None:
    file = tmp_path / "orbits.csv"
    ran = rocksteady("orbits --block tso-wong-1989 -A 2 -W 1.9 --json --csv", file)
    listed = ran.json["orbits"]
    assert ran.err == f"wrote {file}\n"
    rows = list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))
    assert len(rows) == len(listed)
    for number, (row, orbit) in enumerate(zip(rows, listed, strict=True), start=1):
        assert int(row["number"]) == number
        assert (row["kind"], int(row["period"])) == (orbit["kind"], orbit["period"])
        if orbit["admissible"]:
            assert [float(row["highest"]), float(row["lowest"])] == orbit["peaks"]
            degrees = math.degrees(orbit["peaks_rad"][0])
            assert float(row["highest_deg"]) == pytest.approx(degrees, rel=1e-14)
        else:
            assert row["highest"] == row["lowest"] == row["highest_deg"] == ""
        pairs = [
            [float(row[f"multiplier_{which}_re"]), float(row[f"multiplier_{which}_im"])]
            for which in (1, 2)
        ]
        assert pairs == orbit["multipliers"]
        begin = orbit["states"][0]
        assert int(row["side"]) == begin["side"]
        assert float(row["phase_rad"]) == begin["phase"]
        assert float(row["speed_per_pivot_time"]) == begin["speed"]
        assert row["stable"] == ("" if orbit["stable"] is None else str(orbit["stable"]))
        assert row["residual"] == ("" if orbit["residual"] is None else row["residual"])


@pytest.mark.slow
@every(
    ("command", "ending", "magic"),
    [
        (POINT, "png", b"\x89PNG\r\n"),
        ("orbits -A 2 -W 4 -r 1", "svg", b"<?xml"),
        ("orbits -A 0 -W 4 -r 0.8", "png", b"\x89PNG\r\n"),
    ],
)
def test_plots_are_written_whole(command: str, ending: str, magic: bytes, tmp_path: Path) -> None:
    file = tmp_path / f"orbits.{ending}"
    assert rocksteady(f"{command} --plot", file).code == 0
    assert file.read_bytes().startswith(magic)
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


def test_every_row_is_counted_as_a_motion_or_as_inadmissible() -> None:
    """Of an odd period a solution may pass through the floor: it has a row, and is no motion."""
    values = rocksteady(f"{POINT} --json").json["orbits"]
    text = " ".join(rocksteady(f"{POINT} --more").out.split())
    admissible = sum(orbit["admissible"] for orbit in values)
    others = len(values) - admissible
    assert (admissible, others) == (12, 1)
    assert f"found {admissible} periodic motions" in text
    assert f"; {others} inadmissible solution " in text


def test_the_answer_lists_the_stable_motions_first_and_starts_on_one() -> None:
    ran = rocksteady(POINT)
    lines = ran.out.splitlines()
    values = rocksteady(f"{POINT} --json").json["orbits"]
    assert lines[0].startswith("1 of 12 steady motions is stable")
    (stable,) = (each for each in values if each["stable"])
    assert lines[2].split()[1:3] == ["stable", stable["kind"]]
    assert lines[2].split()[5:7] == [f"{peak:.3f}" for peak in stable["peaks"]]
    beyond = sum(max(map(abs, each["peaks"])) > 1.0 for each in values if each["admissible"])
    assert f"{beyond} motions: no fall" in ran.out
    assert "11 more with --more: 10 unstable, 1 inadmissible" in ran.out
    command = ran.out.partition("next: rocksteady ")[2].replace("\\\n ", "").strip()
    reached = rocksteady(f"{command} --json").json
    assert reached["peaks"] == pytest.approx(stable["peaks"])


def test_the_answer_where_nothing_moves_is_that_none_was_found() -> None:
    first = rocksteady("orbits -A 0.1 -W 4 -r 0.8 --seeds 8").out.splitlines()[0]
    assert first == "No steady motion was found up to 3 periods and 6 impacts."


def test_infinitely_many_impacts_are_an_empty_cell_as_they_are_null_in_json(tmp_path: Path) -> None:
    file = tmp_path / "orbits.csv"
    point = f"orbits -A 1.08 -W 0.6 -r 0.05 --csv {file}"
    listed = rocksteady(f"{point} --json").json["orbits"]
    counts = [orbit["impacts_per_period"] for orbit in listed]
    assert None in counts
    with file.open(newline="", encoding="utf-8") as stream:
        cells = [row["impacts_per_period"] for row in csv.DictReader(stream)]
    assert cells == ["" if count is None else str(count) for count in counts]
