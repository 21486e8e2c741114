"""`rocksteady basins`: its contract, its text and its files."""

import csv
import io
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Pulse,
    compute_basins,
    compute_erosion,
    compute_fate_basins,
)
from rocksteady.basins import SamplingOptions, compute_basin_shares
from rocksteady.cli.app import run as run_program
from rocksteady.cli.flags.parsing import axis
from tests.cli.program import refused, rocksteady
from tests.every import every

WINDOW = "--angles=-1:1:30 --velocities=-1.2:1.2:30"
POINT = f"basins -A 0.5 -W 2 -r 0.95 {WINDOW}"
AXIS = f"basins -A 0.2:1:3 -W 2 -r 0.9 {WINDOW}"
AXES: dict[str, Any] = {"angles": axis("", "-1:1:30"), "velocities": axis("", "-1.2:1.2:30")}


def test_a_whole_period_later_nothing_has_changed() -> None:
    one = rocksteady(f"{POINT} --phase 0.7 --json").json
    other = rocksteady(f"{POINT} --phase {0.7 + 2.0 * np.pi} --json").json
    assert one == other


def test_a_seed_gives_the_same_twice() -> None:
    one, other = (rocksteady(f"{POINT} --seed 4 --json").json for _ in range(2))
    assert one == other
    assert one["seed"] == 4
    assert one != rocksteady(f"{POINT} --seed 5 --json").json


def test_an_axis_of_amplitudes_is_an_erosion() -> None:
    ran = rocksteady(f"{AXIS} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["fractions"] is None
    amplitudes = axis("", "0.2:1:3")
    found = compute_erosion(
        DimensionlessBlock(restitution=0.9),
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        amplitudes,
        **AXES,
    )
    assert [row["amplitude"] for row in values["erosion"]] == amplitudes
    for name in ("global_integrity", "integrity_factor"):
        assert [row[name] for row in values["erosion"]] == found.measure(name).tolist()
        drop = found.drop(name)
        assert drop is not None
        assert values["drop"][name] == {
            "measure": name,
            "level": 0.5,
            "low": drop.low,
            "high": drop.high,
            "above": drop.above,
            "below": drop.below,
        }
    assert values["heteroclinic_amplitude"] == found.heteroclinic
    assert "amplitude" not in values


def test_a_real_block_is_in_si() -> None:
    values = rocksteady(f"basins --block tso-wong-1989 -A 1 --freq-hz 2 {WINDOW} --json").json
    assert values["freq_hz"] == pytest.approx(2.0)
    (orbit,) = (part["orbit"] for part in values["fractions"] if part["orbit"])
    assert orbit["peaks_rad"] == [0.2 * peak for peak in orbit["peaks"]]
    over = f"basins --block tso-wong-1989 -A 0.1:1:2 --freq-hz 2 {WINDOW} --json"
    assert rocksteady(over).json["heteroclinic_amplitude"] is None
    values = rocksteady(f"{over} --model linear").json
    assert values["freq_hz"] == pytest.approx(2.0)
    assert "accel_g" not in values
    for row in values["erosion"]:
        assert row["accel_g"] == pytest.approx(0.2 * row["amplitude"])
    exact = 0.2 * values["heteroclinic_amplitude"]
    assert values["heteroclinic_accel_g"] == pytest.approx(exact)


def test_what_does_not_settle_is_said_and_has_its_code() -> None:
    ran = rocksteady(f"basins -A 0.3 -W 2 -r 1 --cycles 50 {WINDOW}")
    assert ran.code == 3
    assert ran.out.startswith("Undecided: of these starts ")
    assert "without loss motions do not settle" in ran.out
    ran = rocksteady(f"basins -A 6 -W 6 -r 0.25 --cycles 40 {WINDOW}")
    assert ran.code == 3
    assert "take more periods to follow" in ran.out


@pytest.mark.slow
def test_a_state_that_balances_for_ever_is_said_and_is_no_failure() -> None:
    # At phase 0 those with u + du/ds = 1 - beta Omega lie on the stable manifold of the saddle.
    ran = rocksteady(
        "basins -A 0.5 -W 2 -r 0.95 --angles=-1.2:1.2:400 --velocities=-1.2:1.2:400 --json"
    )
    (part,) = (part for part in ran.json["fractions"] if part["kind"] == "undecided")
    assert 0 < part["states"] < 10
    assert ran.code == 0


def test_an_axis_of_frequencies_is_shares(tmp_path: Path) -> None:
    table, picture = tmp_path / "s.csv", tmp_path / "s.png"
    command = f"basins -A 0.5 -W 1.9:2.1:3 -r 0.95 {WINDOW} --seed 3 --entropy 10"
    ran = rocksteady(command, "--csv", table, "--plot", picture, "--json")
    assert ran.err == f"wrote {table}\nwrote {picture}\n"
    found = compute_basin_shares(
        DimensionlessBlock(restitution=0.95),
        Harmonic(amplitude=0.5, frequency_ratio=2.0),
        "frequency_ratio",
        axis("", "1.9:2.1:3"),
        sampling=SamplingOptions(**AXES, seed=3),
    )
    values = ran.json
    assert (values["erosion"], values["fractions"]) == (None, None)
    assert values["values"] == found.values.tolist()
    entropies = found.entropies(10)
    assert [row["entropy"] for row in values["entropies"]] == entropies.entropy.tolist()
    for value, place in zip(found.values.tolist(), range(3), strict=True):
        rows = [row for row in values["shares"] if row["frequency_ratio"] == value]
        assert [row["share"] for row in rows] == found.share[:, place][
            [family.present[place] for family in found.families]
        ].tolist()
    with table.open(encoding="utf-8", newline="") as stream:
        assert len(list(csv.DictReader(stream))) == len(values["shares"])
    text = rocksteady(f"{command} --more").out
    assert "S_bb" in text
    assert max(map(len, text.splitlines())) <= 80
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("flags", ["-A 0.4:0.6:2 -W 2 -r 0.95 --shares", "-A 0.5 -W 2 -r 0.9:1:2"])
def test_shares_over_other_axes(flags: str) -> None:
    ran = rocksteady(f"basins {flags} {WINDOW} --cycles 20 --json")
    assert ran.json["parameter"] == ("amplitude" if "--shares" in flags else "restitution")
    assert ran.code == 3  # without loss, or for so few periods, not every motion settles


def test_measures_of_one_window() -> None:
    command = "basins -A 0.5 -W 2 -r 0.95 --angles=-1:1:80 --velocities=-1:1:80"
    values = rocksteady(f"{command} --entropy 20 --exponent --json").json
    found = compute_basins(
        DimensionlessBlock(restitution=0.95),
        Harmonic(amplitude=0.5, frequency_ratio=2.0),
        angles=axis("", "-1:1:80"),
        velocities=axis("", "-1:1:80"),
    )
    assert values["entropy"]["entropy"] == found.entropy(20).entropy
    assert [one["by"] for one in values["exponents"]] == ["states", "boxes"]
    assert values["exponents"][0]["exponent"] == found.uncertainty_exponent().exponent
    plain = rocksteady(f"{command} --json").json
    assert (plain["entropy"], plain["exponents"], plain["shares"]) == (None, None, None)


@every(
    ("command", "flag", "says"),
    [
        ("basins -W 2 -r 0.8", "--amplitude/-A", "exactly one"),
        ("basins -A 1:2:2 -W 1:2:3 -r 0.8", "-A, -W, -r and --phase", "at most one"),
        ("basins -A 1 -W 2:2:3 -r 0.8", "--frequency-ratio/-W", "must differ"),
        ("basins -A 1 -W 2 -r 0.8 --shares", "--shares", "over an axis"),
        ("basins -A 0:1:3 -W 2 -r 0.8 --entropy 20", "--entropy", "--shares"),
        ("basins -A 1 -W 2:3:3 -r 0.8 --exponent", "--exponent", "one window"),
        ("basins -A 1 -W 2 -r 0.8 --entropy 30", "--entropy", "4, 5, 8, 10, 20"),
        ("basins -A 1 -W 2:3:3 -r 0.8 --entropy 0", "--entropy", "whole number"),
        ("basins -A 1 -W 2 -r 0.8 --exponent --angles=-1:1:9 --velocities=-1:1:9", "--exp", "more"),
        ("basins -A 1 -W 2 -r 0.8 --phase 0:x:2", "--phase", "must be a number"),
        ("basins -A 1 -W 2 -r 0.5:1.5:3", "--restitution/-r", "inside"),
        ("basins -A 1 -W 2 -r 0.8 --angles 1", "--angles", "evenly spaced"),
        ("basins -A 1 -W 2 -r 0.8 --angles log:1:2:5", "--angles", "evenly spaced"),
        ("basins -A 1 -W 2 -r 0.8 --velocities 0:x:5", "--velocities", "must be a number"),
        ("basins -A 1 -W 2 -r 0.8 --cycles 0", "--cycles", "whole number"),
        ("basins -A 1 -W 2 -r 0.8 --seed -1", "--seed", "whole number"),
        ("basins -A 0:1:3 -W 2 -r 0.8 --seed 1", "--seed", "one amplitude"),
        ("basins -A 1:0:3 -W 2 -r 0.8", "--amplitude/-A", "must ascend"),
        ("basins -A -1 -W 2 -r 0.8", "--amplitude/-A", "must lie in"),
        ("basins -A 1 -W 2 -r 0.8 --phase nan", "--phase", "must lie in"),
        ("basins -A 0:1:2 -W 2 -r 0.8 --angles 3:4:5 --velocities 1:2:5", "--angles", "stands"),
    ],
)
def test_bad_input_is_one_line_and_leaves_nothing(
    command: str, flag: str, says: str, tmp_path: Path
) -> None:
    line = refused(command, "--plot", tmp_path / "x.png", "--csv", tmp_path / "x.csv")
    assert flag in line
    assert says in line
    assert list(tmp_path.iterdir()) == []


def test_an_interval_is_that_of_drawn_states_alone() -> None:
    point = "basins -A 0.5 -W 2 -r 0.95 --angles=-1:1:20 --velocities=-0.5:0.5:20 --cycles 100"
    assert "interval" not in rocksteady(f"{point} --more").out
    assert rocksteady(f"{point} --json").json["confidence"] is None
    assert "90 % interval" in rocksteady(f"{point} --seed 1 --more").out
    assert rocksteady(f"{point} --seed 1 --json").json["confidence"] == 0.9


FATES = "basins --pulse one-sine -A 2 -W 4 -r 0.9 --angles=-1.3:1.3:12 --velocities=-1.2:1.2:9"


def test_a_pulse_has_fates(tmp_path: Path) -> None:
    files = {name: tmp_path / f"fates.{name}" for name in ("csv", "png", "nc", "zarr")}
    written = f"--csv {files['csv']} --plot {files['png']} --netcdf {files['nc']}"
    ran = rocksteady(f"{FATES} --at-pt 0.3 --json {written} --out {files['zarr']}")
    assert ran.code == 0
    found = compute_fate_basins(
        DimensionlessBlock(restitution=0.9),
        Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0),
        angles=axis("", "-1.3:1.3:12"),
        velocities=axis("", "-1.2:1.2:9"),
        time_pt=0.3,
    )
    expected = found.to_dict()
    assert {name: ran.json[name] for name in expected} == expected
    assert len(files["csv"].read_text(encoding="utf-8").splitlines()) == 1 + found.fate.size
    assert all(file.exists() for file in files.values())
    assert rocksteady(f"{FATES} --at-pt 0.3 --json --out {files['zarr']} --resume").code == 0


def test_a_record_has_fates_from_a_moment_in_seconds(tmp_path: Path) -> None:
    file = tmp_path / "made.csv"
    rows = "".join(f"{0.1 * k:.1f},{3.0 * np.sin(0.6 * k)}\n" for k in range(40))
    file.write_text("t (s),acc (m/s2)\n" + rows, encoding="utf-8")
    command = f"basins --width-m 0.8 --height-m 3 --record {file} --scale 0.5 {WINDOW} --json"
    values = rocksteady(f"{command} --at-s 1.5").json
    assert values["model"] == "nonlinear"
    assert values["time_s"] == pytest.approx(1.5)
    assert values["record"] == "made"


@every(
    ("flags", "words"),
    [
        ("--seed 3", "--seed"),
        ("--cycles 3", "--cycles"),
        ("--at-s 1", "block of known size"),
        ("--at-pt -1", "--at-pt"),
        ("--at-pt 1 --at-s 1", "--at-s"),
        ("--vertical nothing.at2", "--vertical"),
    ],
)
def test_flags_of_another_motion_are_refused(flags: str, words: str) -> None:
    ran = rocksteady(f"{FATES} {flags}")
    assert (ran.code, ran.out) == (2, "")
    assert words in ran.err
    assert len(ran.err.splitlines()) == 1


def test_endless_shaking_has_a_phase_and_no_moment() -> None:
    ran = rocksteady(f"{POINT} --at-pt 1")
    assert ran.code == 2
    assert "--phase" in ran.err


class Terminal(io.StringIO):
    """What a terminal looks like to a program."""

    def isatty(self) -> bool:
        return True


@every("line", ["-A 0.2:1:2 --cycles 5", "-A 0.5 --cycles 20", "-A 0.2:1:2 --shares --cycles 20"])
def test_the_answer_goes_to_standard_output_below_a_bar_too(
    line: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setenv("TERM", "xterm-256color")
    few = "-W 2 -r 0.9 --angles=-1:1:4 --velocities=-1:1:4 --json"
    assert run_program(["basins", *line.split(), *few.split()]) in {0, 3}
    assert json.loads(capsys.readouterr().out)["schema"] == "rocksteady/basins/1"


def test_the_answer_of_a_window_adds_the_shares_of_what_the_starts_do() -> None:
    point = "basins -A 0.5 -W 2 -r 0.95 --angles=-1:1:40 --velocities=-1:1:40"
    lines = rocksteady(point).out.splitlines()
    fractions = rocksteady(f"{point} --json").json["fractions"]
    falls, rests = (
        sum(part["share"] for part in fractions if part["kind"] == kind)
        for kind in ("overturned", "rest")
    )
    rocks = 1.0 - falls - rests
    shares = [f"{100.0 * share:.2g} %" for share in (falls, rocks, rests)]
    first = "Of these starts {} fall, {} keep rocking and {} come to rest."
    assert lines[0] == first.format(*shares)
    largest = max(fractions, key=lambda part: part["share"])["share"]
    assert lines[1].split()[1:] == [f"{100.0 * largest:.1f}", "%"]
    assert len(lines) <= 8 + len(fractions)
    assert lines[-1].endswith("--plot basins.png")


HALF_LOST = (
    "Half of the safe area is lost at A = {global_integrity:.3g}, half of its radius at "
    "A = {integrity_factor:.3g}."
)


@pytest.mark.parametrize(
    ("command", "first"),
    [
        (
            "basins -A 0:1.6:9 -W 2 -r 0.9 --angles=-1.5:1.5:60 --velocities=-1.5:1.5:60",
            HALF_LOST,
        ),
        (
            "basins -A 0:0.2:3 -W 2 -r 0.9 --angles=-1.5:1.5:40 --velocities=-1.5:1.5:40",
            "Half or more of the safe area is left up to A = 0.2.",
        ),
    ],
)
def test_the_answer_of_an_erosion_is_where_half_is_lost(command: str, first: str) -> None:
    drops = rocksteady(f"{command} --json").json["drop"]
    ends = {name: drop and drop["high"] for name, drop in drops.items()}
    line = rocksteady(command).out.splitlines()[0]
    assert line == (first.format(**ends) if all(ends.values()) else first)


def test_the_answer_of_a_pulse_adds_both_sides() -> None:
    command = "basins -A 1.2 -W 3 -r 0.9 --pulse one-sine --angles=-1:1:20 --velocities=-1:1:20"
    lines = rocksteady(command).out.splitlines()
    fractions = rocksteady(f"{command} --json").json["fractions"]
    falls = sum(part["share"] for part in fractions if part["fate"] == "overturned")
    assert lines[0] == (
        f"Of these starts {100.0 * falls:.2g} % fall and {100.0 * (1.0 - falls):.2g} % "
        "come to rest."
    )
    assert len(lines) <= 8


def test_the_answer_over_an_axis_is_the_range_of_the_share_that_falls() -> None:
    command = "basins -A 0.5 -W 1.5:3:4 -r 0.95 --angles=-1:1:20 --velocities=-1:1:20 --entropy 10"
    lines = rocksteady(command).out.splitlines()
    families = rocksteady(f"{command} --json").json["families"]
    falls = next(each for each in families if each["name"] == "overturned")
    least, most = (100.0 * falls[end] for end in ("least", "most"))
    assert lines[0] == f"Over W 1.5 to 3, {least:.2g} to {most:.2g} % of these starts fall."
    assert any(line.startswith("  basin entropy ") for line in lines)
