"""`rocksteady orbits`: its contract, its text and its files."""

import csv
from pathlib import Path

import pytest

from tests.cli.program import refused, rocksteady
from tests.every import every

POINT = "orbits -A 2 -W 1.9 -r 0.8"


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


def test_the_answer_lists_the_stable_motions_first_and_starts_on_one() -> None:
    ran = rocksteady(POINT)
    lines = ran.out.splitlines()
    values = rocksteady(f"{POINT} --json").json["orbits"]
    assert lines[0].startswith("1 of 12 steady motions is stable")
    (stable,) = (each for each in values if each["stable"])
    assert lines[2].split()[1:3] == ["stable", stable["kind"]]
    assert lines[2].split()[5:7] == [f"{peak:.3f}" for peak in stable["peaks"]]
    beyond = sum(max(map(abs, each["peaks"])) > 1.0 for each in values if each["admissible"])
    assert f"{beyond} motions: the base carries it back: no fall" in ran.out
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
