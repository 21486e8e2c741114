"""`rocksteady attractor`: its contract, its text and its files."""

import csv
import math
from pathlib import Path

import pytest

from rocksteady import Block, DimensionlessBlock, find_attractor, simulate
from rocksteady.motions import FourierSeries
from tests.cli.program import refused, rocksteady
from tests.every import every

POINT = "attractor -A 2 -W 1.9 -r 0.8 --start steady --side -"
CHAOS = "attractor -A 6 -W 6 -r 0.25"
CONTRACT = {
    "kind",
    "reason",
    "period",
    "impacts_per_period",
    "rest_phases",
    "peaks",
    "multipliers",
    "lyapunov",
}


@every(
    ("command", "kind", "period", "peaks"),
    [
        (POINT, "unsymmetric", 1, (0.90035, -0.44427)),  # TW7
        (
            "attractor -A 2 -W 4.2 -r 0.8 --start steady -n 3 --side -",
            "unsymmetric",
            3,
            (0.53129, -0.44713),
        ),
        ("attractor -A 2 -W 4 -r 0.8", "symmetric", 1, (0.18550, -0.18550)),
        ("attractor -A 1 -W 4 -r 0.8", "rest", None, (0.0, 0.0)),
    ],
)
def test_published_attractors(
    command: str, kind: str, period: int | None, peaks: tuple[float, float]
) -> None:
    values = rocksteady(f"{command} --json").json
    assert (values["kind"], values["period"]) == (kind, period)
    assert values["peaks"] == pytest.approx(peaks, abs=5.1e-6)
    assert values["impacts_per_period"] == (None if period is None else 2)


def test_the_doubled_orbit_at_1_78_is_an_attractor() -> None:
    listed = rocksteady("orbits -A 2 -W 1.78 -r 0.8 --max-period 2 --json").json["orbits"]
    (stable,) = (orbit for orbit in listed if orbit["stable"])
    state = stable["states"][0]
    start = f"--start=0,{state['side'] * state['speed'] * 1.001} --phase {state['phase']}"
    values = rocksteady(f"attractor -A 2 -W 1.78 -r 0.8 {start} --json").json
    assert (values["kind"], values["period"], values["impacts_per_period"]) == ("unsymmetric", 2, 4)
    assert values["peaks"] == pytest.approx(stable["peaks"], abs=1e-9)


@every(
    ("command", "kind"),
    [
        ("attractor -A 1 -W 4 -r 0.8", "rest"),
        ("attractor -A 2 -W 1.7 -r 0.8 --start steady", "overturned"),
        (CHAOS, "aperiodic"),
    ],
)
def test_what_an_attractor_has_not_is_null(command: str, kind: str) -> None:
    values = rocksteady(f"{command} --json").json
    assert set(values) >= CONTRACT
    assert values["kind"] == kind
    for name in ("reason", "period", "impacts_per_period", "rest_phases", "multipliers", "states"):
        assert values[name] is None, name
    assert (values["peaks"] is None) == (kind != "rest")
    assert (values["lyapunov"] is None) == (kind != "aperiodic")


def test_an_orbit_that_comes_to_rest_has_infinitely_many_impacts() -> None:
    values = rocksteady("attractor -A 1.08 -W 0.6 -r 0.05 --json").json
    assert (values["kind"], values["period"]) == ("symmetric", 1)
    assert (values["impacts_per_period"], values["rest_phases"]) == (None, 2)
    assert values["multipliers"] == [[0.0, 0.0], [0.0, 0.0]]
    assert values["lyapunov"] is None
    text = rocksteady("attractor -A 1.08 -W 0.6 -r 0.05 --more").out
    assert "infinitely many" in text
    assert "2 times in a period" in text


def test_what_cannot_be_decided_says_why_and_ends_with_3(tmp_path: Path) -> None:
    file = tmp_path / "motion.png"
    command = "attractor -A 0.5 -W 4 -r 1 --start 0.1,0 --cycles 200"
    ran = rocksteady(f"{command} --json --plot", file)
    assert ran.code == 3
    assert ran.json["kind"] == "undecided"
    assert "restitution 1" in ran.json["reason"]
    assert file.exists(), "what was found is shown all the same"
    text = rocksteady(command)
    assert text.code == 3
    assert ran.json["reason"] in " ".join(text.out.split())


def test_a_real_block_is_in_radians_and_seconds() -> None:
    values = rocksteady("attractor --block tso-wong-1989 --accel-g 0.4 --freq-hz 4 --json").json
    block = Block.from_p(alpha=0.2, p=2.0 * math.pi, restitution=0.8)
    assert values["block"]["alpha_rad"] == block.alpha
    assert values["freq_hz"] == pytest.approx(4.0)
    assert values["period_s"] == pytest.approx(0.25)
    assert values["peaks_rad"] == [peak * block.alpha for peak in values["peaks"]]
    text = rocksteady("attractor --block tso-wong-1989 --accel-g 0.4 --freq-hz 4").out
    assert "0.25 s" in text
    assert "rad" in text
    rest = rocksteady("attractor --block tso-wong-1989 -A 0.5 -W 4 --json").json
    assert (rest["peaks_rad"], rest["period_s"]) == ([0.0, 0.0], None)


@every(
    ("command", "first"),
    [
        (POINT, "It settles to an unsymmetric steady motion, from 0.9 to -0.444 alpha."),
        ("attractor -A 1 -W 4 -r 0.8", "It never lifts under the motion."),
        (
            "attractor -A 2 -W 1.7 -r 0.8 --start steady",
            "It falls: from this start (steady) it reaches no steady motion.",
        ),
        (CHAOS, "It rocks on and never repeats: a small difference grows 1.46-fold a period."),
        (
            "attractor --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2",
            "It settles to a symmetric steady motion, up to 1.59° (0.14 alpha).",
        ),
    ],
)
def test_the_answer_is_what_it_settles_to(command: str, first: str) -> None:
    ran = rocksteady(command)
    lines = ran.out.splitlines()
    assert lines[0] == first
    assert len(lines) <= 8
    assert lines[-1].startswith("next: rocksteady basins ")
    values = rocksteady(f"{command} --json").json
    if values["kind"] == "aperiodic":
        assert f"{math.exp(values['lyapunov']):.3g}-fold" in first
    elif values["period"]:
        shrinks = math.exp(values["lyapunov"])
        assert f"shrinks to {100 * shrinks:.2g} % a period" in ran.out
        assert f"{values['period']} period of the base" in ran.out


def test_an_undecided_attractor_goes_on_with_more_periods() -> None:
    ran = rocksteady("attractor -A 6 -W 6 -r 0.25 --cycles 20")
    assert ran.code == 3
    assert ran.out.startswith("Undecided: ")
    command = ran.out.partition("next: rocksteady ")[2].replace("\\\n ", "")
    assert command.split()[-2:] == ["--cycles", "200"]
    assert rocksteady(command.strip()).code in (0, 3)


# ------------------------------------------------------------------------------- bad input


@every(
    ("flags", "needle"),
    [
        ("--start foo", "--start = 'foo'"),
        ("--start steady:3", "--start = 'steady:3'"),
        ("--start steady --phase 1", "--phase = 1.0"),
        ("--start steady:2", "--start = 'steady:2'"),
        ("--side left", "--side = 'left'"),
        ("--phase nan", "--phase = nan"),
        ("--kick 1e-3", "--kick = 0.001"),
        ("--start steady --kick 1", "--kick = 1.0"),
        ("-n 3", "--order/-n = 3"),
        ("--cycles 0", "--cycles = 0"),
        ("--cycles -1", "--cycles = -1"),
        ("--cycles 1.5", "'1.5'"),
        ("--cycles 99999999999999999999", "--cycles = 99999999999999999999"),
    ],
)
def test_a_bad_start_or_length_is_refused(flags: str, needle: str, tmp_path: Path) -> None:
    line = refused(f"attractor -A 2 -W 4 -r 0.8 {flags} --csv", tmp_path / "a.csv")
    assert needle in line
    assert list(tmp_path.iterdir()) == []


def test_an_axis_is_refused() -> None:
    assert "--amplitude/-A has 3 values" in refused("attractor -A 1:2:3 -W 4 -r 0.8")


# ----------------------------------------------------------------------------------- files


@every(
    ("command", "some"),
    [(CHAOS, True), ("attractor -A 1 -W 4 -r 0.8", False), ("attractor -A 9 -W 1 -r 0.8", False)],
)
def test_without_an_orbit_the_csv_holds_the_cloud_or_nothing(
    command: str, *, some: bool, tmp_path: Path
) -> None:
    file = tmp_path / "impacts.csv"
    assert rocksteady(f"{command} --csv", file).code == 0
    rows = list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))
    assert (len(rows) > 1000) == some
    assert bool(rows) == some
    for row in rows:
        assert row["side"] in ("1", "-1")
        assert 0.0 <= float(row["phase_rad"]) < 2.0 * math.pi
        assert float(row["speed_per_pivot_time"]) >= 0.0


def test_harmonics_are_those_of_a_fourier_series() -> None:
    point = "-A 1.05 -W 0.6 -r 0.4 --harmonic 2,0.3,0.5 --harmonic 1,0.8,0"
    motion = FourierSeries(
        amplitude=1.05, frequency_ratio=0.6, harmonics=((1, 0.8, 0.0), (2, 0.3, 0.5))
    )
    values = rocksteady(f"attractor {point} --json").json
    found = find_attractor(DimensionlessBlock(restitution=0.4), motion)
    assert values["harmonics"] == [[1, 0.8, 0.0], [2, 0.3, 0.5]]
    assert values["kind"] == found.kind.value
    assert values["peaks"] == list(found.peaks or ())
    run = rocksteady(f"simulate {point} --cycles 5 --json").json
    assert run["harmonics"] == values["harmonics"]
    assert run["peak"] == simulate(found.block, motion, cycles=5).peak
    for wrong, words in (
        ("2,0.5", "three numbers"),
        ("1.5,1,0", "whole number"),
        ("65,1,0", "from 1 to 64"),
        ("2,x,0", "--harmonic"),
        ("inf,1,0", "'inf,1,0' is not valid: its order must be a whole number"),
        ("nan,1,0", "its order must be a whole number"),
        ("65,1,0", "--harmonic = '65,1,0' is not valid: it must be a whole number from 1 to 64"),
        ("2,inf,0", "--harmonic = '2,inf,0'"),
    ):
        assert words in refused(f"attractor -A 1 -W 2 -r 0.8 --harmonic {wrong}")
    assert "endless shaking alone" in refused(
        "simulate -A 1 -W 2 -r 0.8 --pulse one-sine --harmonic 2,1,0"
    )
    assert "single sinusoid" in refused("map -A 1:2:2 -W 2 -r 0.8 --start steady --harmonic 2,1,0")


def test_of_a_fall_the_periods_until_it_was_known_are_not_said() -> None:
    ran = rocksteady("attractor -A 8 -W 1.9 -r 0.8 --json")
    assert (ran.json["kind"], ran.json["settled_after_periods"]) == ("overturned", 0)
    text = rocksteady("attractor -A 8 -W 1.9 -r 0.8").out
    assert "falls" in text
    assert "known after" not in text
