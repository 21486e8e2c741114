"""`rocksteady simulate --pulse`: its contract, its files, and what it refuses."""

import csv
from pathlib import Path

import pytest
from PIL import Image

from rocksteady import Block, DimensionlessBlock, Pulse, simulate
from rocksteady.model.motions.pulses import PULSES
from tests.cli.program import rocksteady
from tests.every import every

BARE = DimensionlessBlock(restitution=0.9)
CABINET = "simulate --block zhang-makris-2001"
ONE_SINE = "simulate -A 2 -W 5 -r 0.9 --pulse one-sine"


@pytest.mark.slow
@every("name", [*PULSES, "type-c4"])
def test_the_json_of_every_pulse(name: str) -> None:
    ran = rocksteady(f"simulate -A 3 -W 4 -r 0.9 --pulse {name} --json")
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    pulse = Pulse(shape=name, amplitude=3.0, frequency_ratio=4.0)
    run = simulate(BARE, pulse)
    assert values["schema"] == "rocksteady/simulate/1"
    assert values["pulse"] == name
    assert values["status"] == run.status.label
    assert values["peak"] == run.peak
    assert values["impacts"] == len(run.impacts)
    assert values["overturn_time_pt"] == run.overturn_time_pt
    assert (values["amplitude"], values["frequency_ratio"]) == (3.0, 4.0)
    assert values["duration_pt"] == pulse.duration
    assert values["overturn_time_tau"] is None
    assert "phase" not in values


def test_a_pulse_on_a_block_is_in_g_hertz_and_seconds() -> None:
    values = rocksteady(f"{CABINET} --pulse one-sine --accel-g 2 --freq-hz 1.7 --json").json
    block = Block.named("zhang-makris-2001")
    pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=2 * 9.80665, frequency_hz=1.7)
    run = simulate(block, pulse)
    assert values["status"] == "overturned"
    assert values["overturn_time_s"] == run.overturn_time_s
    assert values["duration_s"] == pytest.approx(1.0 / 1.7)
    assert (values["accel_g"], values["freq_hz"]) == pytest.approx((2.0, 1.7))
    assert values["block"]["p_rad_s"] == block.p


def test_the_numbers_of_mavroeidis_and_papageorgiou() -> None:
    flags = "--pulse mavroeidis-papageorgiou --oscillations 2.5 --phase 1"
    values = rocksteady(f"simulate -A 2 -W 4 -r 0.9 {flags} --json").json
    pulse = Pulse(
        shape="mavroeidis-papageorgiou",
        amplitude=2.0,
        frequency_ratio=4.0,
        oscillations=2.5,
        phase=1.0,
    )
    assert values["peak"] == simulate(BARE, pulse).peak


def test_m1_at_its_printed_digits() -> None:
    command = "simulate --width-m 1 --height-m 3 -r 0.85 --gravity-m-s2 9.81 --pulse one-sine"
    for accel_g, status in ((0.451539, "at-rest"), (0.451541, "overturned")):
        level = f"--freq-hz 1 --accel-g {accel_g * 9.81 / 9.80665}"
        values = rocksteady(f"{command} {level} --model linear --json").json
        assert values["status"] == status


def test_a_start_before_a_pulse() -> None:
    at_rest = rocksteady(f"{ONE_SINE} --json").json
    let_go = rocksteady(f"{ONE_SINE} --start=-0.3,0 --json").json
    assert at_rest["status"] == let_go["status"] == "at-rest"
    assert at_rest["peak"] != let_go["peak"]


@pytest.mark.slow
def test_the_text_and_the_files(tmp_path: Path) -> None:
    plot, table, film = (tmp_path / name for name in ("run.png", "run.csv", "run.gif"))
    command = "simulate -A 2 -W 5 -r 0.5 --pulse one-sine --speed 3"
    ran = rocksteady(f"{command} --plot", plot, "--csv", table, "--animate", film)
    assert ran.code == 0
    assert ran.out.startswith("It comes to rest 2.72 periods into the pulse.")
    with Image.open(plot) as picture:
        assert picture.size[0] > 1000
    with Image.open(film) as picture:
        assert getattr(picture, "n_frames", 1) > 30
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    base = [float(row["base_acceleration_per_alpha_g"]) for row in rows]
    assert max(base) == pytest.approx(2.0, rel=1e-3)
    assert base[-1] == 0.0
    assert "tau" not in rows[0]


def test_the_help_names_every_pulse() -> None:
    text = " ".join(rocksteady("simulate --help-all").out.replace("│", " ").split())
    for name in PULSES:
        # rich may break a line after a hyphen
        assert name in text or name.replace("-", "- ") in text, name
