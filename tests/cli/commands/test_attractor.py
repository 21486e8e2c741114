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


# ----------------------------------------------------------------------------------- files


def test_a_motion_that_never_repeats_has_a_growth_and_a_cloud(tmp_path: Path) -> None:
    file = tmp_path / "impacts.csv"
    values = rocksteady(f"{CHAOS} --json --csv", file).json
    assert values["kind"] == "aperiodic"
    for name in ("reason", "period", "impacts_per_period", "multipliers", "states", "peaks"):
        assert values[name] is None, name
    growth = f"grows {math.exp(values['lyapunov']):.3g}-fold a period"
    assert growth in rocksteady(CHAOS).out.splitlines()[0]
    rows = list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))
    assert len(rows) > 1000
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
