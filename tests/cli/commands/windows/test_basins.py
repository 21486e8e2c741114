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
from tests.cli.program import rocksteady
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
