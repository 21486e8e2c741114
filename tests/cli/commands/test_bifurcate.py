"""`rocksteady bifurcate`: its contract, its text and its files."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.branches import find_cascade
from rocksteady.formulas import symmetry_breaking_amplitude, symmetry_breaking_frequencies
from rocksteady.orbits import compute_region_boundaries
from tests.cli.program import ran_once, refused, rocksteady
from tests.every import every

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


def test_a_sweep_begins_where_it_is_told() -> None:
    command = "bifurcate -A 2 -W 3.9:5:12 -r 0.8"
    for flags, start, period in (
        ("", "steady", 1),
        ("-n 3", "steady", 3),
        ("-n 3 --start rest", "rest", 1),
        ("--start 0.1,0", "0.1,0", 1),
    ):
        down = values_of(f"{command} {flags}")["sweeps"][1]
        assert (down["start"], down["runs"][0]["period"]) == (start, period), flags


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


def test_without_a_doubling_there_is_no_cascade_and_a_line_says_so() -> None:
    command = "bifurcate -A 1 -W 2 -r 0.3:1:20 --cascade"
    assert values_of(command)["cascade"] is None
    assert "no cascade: no branch has a period doubling" in rocksteady(f"{command} --more").out


def test_a_cascade_cut_short_has_no_ratio() -> None:
    values = values_of("bifurcate -A 2 -W 1.78:2:10 -r 0.8 --cascade --no-sweeps")
    cascade = values["cascade"]
    assert len(cascade["values"]) == 1
    assert (cascade["distances"], cascade["ratios"], cascade["limit"]) == ([], [], None)
    text = rocksteady("bifurcate -A 2 -W 1.78:2:10 -r 0.8 --cascade --no-sweeps --more").out
    assert "fewer than three doublings have no ratio" in text


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


def test_where_nothing_moves_the_lists_are_empty(tmp_path: Path) -> None:
    command = "bifurcate -A 0.1 -W 2:3:5 -r 0.8 --no-sweeps"
    values = values_of(command)
    assert (values["points"], values["branches"]) == ([], [])
    table, figure = tmp_path / "a.csv", tmp_path / "a.png"
    ran = rocksteady(f"{command} --csv", table, "--plot", figure)
    assert ran.code == 0
    assert "0 branches" in ran.out
    assert len(table.read_text(encoding="utf-8").splitlines()) == 1
    assert figure.read_bytes().startswith(b"\x89PNG")


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


# ----------------------------------------------------- the nonlinear model, sides that differ


@every(
    ("flags", "needle"),
    [
        ("-A 2 -W 2 -r 0.8", "none of -A, -W and -r is an axis"),
        ("-A 1:2:5 -W 1:2:5 -r 0.8", "2 of -A, -W and -r are axes"),
        ("-A 1:2:5 -W 2 -r 0.5:0.8:5", "2 of -A, -W and -r are axes"),
        ("-A 2 -W 2:2:5 -r 0.8", "--frequency-ratio/-W is 2 at both ends: the ends"),
        ("-A -1:3:5 -W 2 -r 0.8", "--amplitude/-A = -1.0"),
        ("-A 2 -W 0:3:5 -r 0.8", "--frequency-ratio/-W = 0.0"),
        ("-A 2 -W 1:nan:5 -r 0.8", "--frequency-ratio/-W = '1:nan:5'"),
        ("-A 2 -W 1:2:1 -r 0.8", "'1:2:1'"),
        ("-A 2 -W 2 -r 0:1:5", "--restitution/-r = 0.0"),
        ("-A 2 -W 2 -r 0.5:1.2:5", "(0, 1]"),
        ("-A 2 -W 2 -r 0.5:1", "--restitution/-r = '0.5:1'"),
        ("-A 2 -r 0.8", "neither given"),
        ("-A 2 -W 1:2:5 -r 0.8 -n 2", "--order/-n = 2"),
        ("-A 2 -W 1:2:5 -r 0.8 -n 1001", "--order/-n = 1001"),
        ("-A 2 -W 1:2:5 -r 0.8 --max-period 0", "--max-period = 0"),
        ("-A 2 -W 1:2:5 -r 0.8 --max-period 99999999999", "--max-period = 99999999999"),
        ("-A 2 -W 1:2:5 -r 0.8 --max-impacts 0", "--max-impacts = 0"),
        ("-A 2 -W 1:2:5 -r 0.8 --max-branches 0", "--max-branches = 0"),
        ("-A 2 -W 1:2:5 -r 0.8 --cascade --doublings 9", "--doublings = 9"),
        ("-A 2 -W 1:2:5 -r 0.8 --doublings 3", "without --cascade"),
        ("-A 2 -W 1:2:5 -r 0.8 --cycles 0", "--cycles = 0"),
        ("-A 2 -W 1:2:5 -r 0.8 --top 2", "--top = 2.0"),
        ("-A 2 -W 1:2:5 -r 0.8 --side up", "--side = 'up'"),
        ("-A 2 -W 1:2:5 -r 0.8 --start nowhere", "--start = 'nowhere'"),
        ("-A 2 -W 1:2:5 -r 0.8 --start steady --phase 1", "--phase = 1.0"),
        ("-A 2 -W 1:2:5 -r 0.8 --start rest --kick 1e-3", "--kick = 0.001"),
        ("-A 2 -W 1:2:5 -r 0.8 --kick 5", "--kick = 5.0"),
        ("-A 2 -W 1:2:5 -r 0.8 --no-sweeps --start rest", "with --no-sweeps"),
        ("-A 2 -W 1:2:30000 -r 0.8", "--frequency-ratio/-W has 30000 values: sweeps"),
        ("-A 0.1:3:5 -W 2 -r 0.8 --start steady", "--start = 'steady'"),
        ("--accel-g 0.1:0.5:5 -W 2 -r 0.8", "--accel-g = '0.1:0.5:5'"),
        ("--block tso-wong-1989 -A 2 --freq-hz -1:2:5", "--freq-hz = -1.0"),
        ("-A 2 -W 1:2:5 -r 0.8 --model nonlinear", "--model = 'nonlinear'"),
        ("-A 2 -W 1:2:5 -r 0.8 --model cubic", "--model = 'cubic'"),
        ("-A 2 -W 1:2:5 -r 0.8 --one-sided", "--one-sided makes a block that rocks to one side"),
    ],
)
def test_bad_input_is_one_line_and_leaves_no_file(flags: str, needle: str, tmp_path: Path) -> None:
    assert needle in refused(f"bifurcate {flags} --csv", tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


def test_an_end_of_the_angles_must_be_positive(tmp_path: Path) -> None:
    assert "--top = -1.0" in refused(f"{ALONG_W} --top -1 --plot", tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []


def test_the_answer_is_where_a_steady_motion_is_stable() -> None:
    command = "bifurcate -A 2 -W 1.78:2.4:10 -r 0.8"
    lines = rocksteady(command).out.splitlines()
    ranges = [ends for branch in values_of(command)["branches"] for ends in branch["stable_ranges"]]
    assert max(high for _, high in ranges) == 2.4
    assert min(low for low, _ in ranges) == 1.78
    assert lines[0] == "A steady motion is stable throughout, for W = 1.78 to 2.4."
    breaking = next(p for p in values_of(command)["points"] if p["type"] == "symmetry-breaking")
    assert f"{breaking['frequency_ratio']:.5g} (symmetry breaks) to 2.4" in lines[1]
    assert lines[-1] == f"next: rocksteady {command} --plot diagram.png"


def test_the_answer_of_a_block_with_a_size_is_in_hertz() -> None:
    size = "bifurcate --block tso-wong-1989 -A 2 --freq-hz 1.78:2.4:4 --no-sweeps"
    first = rocksteady(size).out.splitlines()[0]
    assert first == "A steady motion is stable throughout, for 1.78 to 2.4 Hz."


def test_the_answer_where_nothing_moves_is_that_none_is_stable() -> None:
    first = rocksteady("bifurcate -A 0.1 -W 2:3:5 -r 0.8 --no-sweeps").out.splitlines()[0]
    assert first == "No steady motion was found to be stable for W = 2 to 3."
