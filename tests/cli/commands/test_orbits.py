"""`rocksteady orbits`: its contract, its text and its files."""

import csv
from pathlib import Path

import pytest

from tests.cli.program import rocksteady


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


def test_infinitely_many_impacts_are_an_empty_cell_as_they_are_null_in_json(tmp_path: Path) -> None:
    file = tmp_path / "orbits.csv"
    point = f"orbits -A 1.08 -W 0.6 -r 0.05 --csv {file}"
    listed = rocksteady(f"{point} --json").json["orbits"]
    counts = [orbit["impacts_per_period"] for orbit in listed]
    assert None in counts
    with file.open(newline="", encoding="utf-8") as stream:
        cells = [row["impacts_per_period"] for row in csv.DictReader(stream)]
    assert cells == ["" if count is None else str(count) for count in counts]
