"""`rocksteady bifurcate`: its contract, its text and its files."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.branches import find_cascade
from rocksteady.formulas import symmetry_breaking_amplitude, symmetry_breaking_frequencies
from rocksteady.orbits import compute_region_boundaries
from tests.cli.program import ran_once, rocksteady

ALONG_W = "bifurcate -A 2 -W 1.6:2.4:41 -r 0.8"
ALONG_A = "bifurcate -A 0.1:3:30 -W 2 -r 0.8 --no-sweeps"
ALONG_R = "bifurcate -A 2 -W 2 -r 0.3:1:20"
REAL_A = "bifurcate --block tso-wong-1989 --accel-g 0.04:0.5:20 --freq-hz 2"
BARE = DimensionlessBlock(restitution=0.8)


def values_of(command: str) -> dict[str, Any]:
    ran = ran_once(f"{command} --json")
    assert ran.code == 0, ran
    return ran.json


def of_type(values: dict[str, Any], kind: str, **more: object) -> list[dict[str, Any]]:
    return [
        point
        for point in values["points"]
        if point["type"] == kind and all(point[key] == value for key, value in more.items())
    ]


# ---------------------------------------------------- published numbers and closed forms


def test_the_symmetry_breaks_where_the_closed_form_says() -> None:  # TW6
    (point,) = of_type(values_of(ALONG_W), "symmetry-breaking")
    assert point["frequency_ratio"] == pytest.approx(1.948378, abs=5e-7)
    exact = float(symmetry_breaking_frequencies(2.0, 0.8)[-1])
    assert point["frequency_ratio"] == pytest.approx(exact, abs=1e-12)
    assert (point["branches"], point["symmetric"], point["period"]) == ([1, 2], True, 1)
    # -1 for half of it, 1 for the whole.
    assert point["multipliers"][0] == pytest.approx([1.0, 0.0], abs=1e-6)
    values = values_of("bifurcate -A 2 -W 3.9:5:30 -r 0.8 -n 3 --no-sweeps")
    (third,) = of_type(values, "symmetry-breaking")
    assert third["frequency_ratio"] == pytest.approx(4.249471, abs=5e-7)
    assert (third["period"], values["max_period"]) == (3, 12)


def test_along_the_restitution_there_are_branches_and_sweeps() -> None:
    values = values_of(ALONG_R)
    assert [each["direction"] for each in values["sweeps"]] == ["up", "down"]
    assert (values["restitution"], values["within"]) == (None, [0.3, 1.0])
    (breaking,) = of_type(values, "symmetry-breaking")
    ratio = breaking["restitution"]
    assert float(symmetry_breaking_amplitude(2.0, ratio)) == pytest.approx(2.0, abs=1e-10)
    assert values["branches"][0]["stable_ranges"] == [[ratio, 1.0]]


# --------------------------------------------------------------------------------- sweeps


@pytest.mark.slow
def test_sweeps_show_hysteresis() -> None:
    up, down = values_of("bifurcate -A 0.1:1.9:19 -W 2 -r 0.8")["sweeps"]
    fold = float(compute_region_boundaries(2.0, 0.8).existence)
    assert (up["runs"][0]["kind"], up["start"]) == ("rest", "rest")
    assert up["runs"][0]["to"] > 0.9, "a block at rest is not lifted below 1"
    rests = [run for run in down["runs"] if run["kind"] == "rest"]
    assert [run["to"] for run in rests] == [0.1], "once at rest it stays"
    assert rests[0]["from"] < fold < rests[0]["from"] + 0.1 + 1e-9


@pytest.mark.slow
def test_after_a_fall_a_sweep_begins_again_on_the_steady_state_of_the_value() -> None:
    up, _ = values_of("bifurcate -A 2 -W 0.9:3:22 -r 0.9")["sweeps"]
    assert [run["kind"] for run in up["runs"]] == ["overturned", "unsymmetric", "symmetric"]
    breaking = float(symmetry_breaking_frequencies(2.0, 0.9)[-1])
    assert up["runs"][1]["to"] < breaking < up["runs"][2]["from"]


def test_what_a_sweep_settles_to_starts_a_branch() -> None:
    # In this range only unstable symmetric motions are known in closed form.
    command = "bifurcate -A 2 -W 1.77:1.795:26 -r 0.8"
    alone = values_of(f"{command} --no-sweeps")["branches"]
    assert [branch["stable_ranges"] for branch in alone] == [[]]
    values = values_of(command)
    doublings = of_type(values, "period-doubling")
    assert [point["period"] for point in doublings] == [1, 2, 4]
    expected = (1.7892720, 1.7746913, 1.7723039)
    for point, value in zip(doublings, expected, strict=True):
        assert point["frequency_ratio"] == pytest.approx(value, abs=5e-8)
    kinds = [(branch["period"], branch["symmetric"]) for branch in values["branches"]]
    assert len(set(kinds)) == len(kinds), "no branch is listed twice"


# -------------------------------------------------------------------------------- cascade


@pytest.mark.slow
def test_the_cascade_is_the_librarys() -> None:
    values = values_of(f"{ALONG_W} --cascade --doublings 5")
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    start = find_orbits(BARE, shaking, max_period=1, max_impacts=2)[0]
    within = (1.6, 2.4)
    found = find_cascade(start, "frequency_ratio", within, direction=-1, doublings=5)
    cascade = values["cascade"]
    assert cascade["values"] == pytest.approx(found.values.tolist(), abs=1e-11)
    assert cascade["periods"] == [1, 2, 4, 8, 16]
    assert cascade["ratios"][-1] == pytest.approx(4.6692, abs=0.05), "Feigenbaum's number"
    assert cascade["limit"] == pytest.approx(found.limit, abs=1e-9)
    assert len(cascade["distances"]) == 4
    text = ran_once(f"{ALONG_W} --cascade --doublings 5 --more").out
    assert "cascade of 5 period doublings" in text
    assert "1.789272022957" in text
    assert "Feigenbaum" in text


# ----------------------------------------------------------------------------- the search


@pytest.mark.slow
def test_the_search_finds_branches_that_hang_together_with_no_other() -> None:
    limits = "--max-period 2 --max-impacts 4"
    command = f"bifurcate -A 2 -W 1.6:2.4:5 -r 0.8 --no-sweeps {limits}"
    few, many = (values_of(f"{command}{more}")["branches"] for more in ("", " --search"))
    assert len(many) > len(few)
    assert many[: len(few)] == few
    assert all(branch["period"] <= 2 and branch["impacts"] <= 4 for branch in many)


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    ["bifurcate -A 1.2 -W 0.3:3:5 -r 0.5", "bifurcate -A 0.5:5:5 -W 2 -r 1"],
)
def test_grazes_at_a_dip_that_begins_at_an_impact_are_located(command: str) -> None:
    values = values_of(f"{command} --no-sweeps")
    assert of_type(values, "grazing")
    assert {"lost"} >= {
        branch[end]["type"] for branch in values["branches"] for end in ("begin", "end")
    } - {"end-of-range", "symmetry-breaking", "period-doubling", "grazing"}


@pytest.mark.slow
def test_too_many_branches_are_incomplete() -> None:
    ran = rocksteady(f"{ALONG_A} --max-branches 2 --json")
    assert ran.code == 3
    assert "--max-branches" in ran.err
    assert ran.json["complete"] is False
    assert len(ran.json["branches"]) == 2


def test_as_many_branches_as_there_are_is_no_end() -> None:
    whole = values_of(f"{ALONG_W} --no-sweeps")
    count = len(whole["branches"])
    same = values_of(f"{ALONG_W} --no-sweeps --max-branches {count}")
    assert same["complete"]
    assert same["branches"] == whole["branches"]
    fewer = rocksteady(f"{ALONG_W} --no-sweeps --max-branches {count - 1} --json")
    assert fewer.code == 3
    assert not fewer.json["complete"]
    assert fewer.json["branches"] == whole["branches"][:-1]


# ------------------------------------------------------------------------- text and files


@pytest.mark.slow
def test_a_stable_window_too_narrow_for_its_digits_has_its_width() -> None:
    out = ran_once(f"{ALONG_A} --more").out
    assert "1.081072 + 4e-07" in out
    assert "0.94952 to 0.96361" in out


@pytest.mark.slow
def test_a_real_block_is_in_g_and_hz_and_radians() -> None:
    values = values_of(REAL_A)
    assert values["accel_g"] is None
    assert values["freq_hz"] == pytest.approx(2.0)
    assert values["within"] == pytest.approx([0.2, 2.5])
    for point in values["points"]:
        assert point["accel_g"] == pytest.approx(0.2 * point["amplitude"])
        assert point["freq_hz"] == pytest.approx(2.0)
        assert point["peaks_rad"] == [0.2 * peak for peak in point["peaks"]]
    bare = values_of("bifurcate -A 0.2:2.5:20 -W 2 -r 0.8")
    for one, other in zip(values["points"], bare["points"], strict=True):
        assert one["amplitude"] == pytest.approx(other["amplitude"], abs=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "ending", "magic"),
    [(ALONG_R, "png", b"\x89PNG\r\n"), (f"{ALONG_A} --top 0.1", "svg", b"<?xml")],
)
def test_plots_are_written_whole(command: str, ending: str, magic: bytes, tmp_path: Path) -> None:
    file = tmp_path / f"diagram.{ending}"
    assert rocksteady(f"{command} --plot", file).code == 0
    assert file.read_bytes().startswith(magic)
    assert [path.name for path in tmp_path.iterdir()] == [file.name]
