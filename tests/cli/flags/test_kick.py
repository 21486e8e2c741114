"""`rocksteady simulate --kick`: how far from an unstable steady state a block is set off."""

import pytest

from rocksteady import DimensionlessBlock, Harmonic, Steady, simulate
from tests.cli.program import refused, rocksteady

LEFT = "simulate -A 2 -W 1.7 -r 0.8 --start steady --cycles 40 --json"


def overturned_at(*more: str) -> float:
    ran = rocksteady(LEFT, *more)
    assert ran.code == 0
    values = ran.json
    assert values["status"] == "overturned"
    assert isinstance(values["overturn_time_tau"], float)
    return values["overturn_time_tau"]


@pytest.mark.parametrize("side", ["+", "-"])
@pytest.mark.parametrize("kick", ["1e-3", "0.01", "1e-9"])
def test_the_flag_is_the_librarys_argument(kick: str, side: str) -> None:
    run = simulate(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.7),
        start=Steady(kick=float(kick)),
        cycles=40,
        side=1 if side == "+" else -1,
    )
    assert overturned_at("--kick", kick, "--side", side) == run.overturn_tau


def test_a_block_set_off_further_out_falls_sooner() -> None:
    far, near, nearer = (overturned_at("--kick", kick) for kick in ("1e-2", "1e-6", "1e-10"))
    assert far < near < nearer
    assert overturned_at() == near, "where nobody says it is 1e-6"


def test_the_other_branch_takes_it_too() -> None:
    command = "simulate -A 1 -W 8 -r 0.8 --start steady:2 --cycles 60 --json --kick 1e-4"
    fates = {side: rocksteady(command, "--side", side).json["status"] for side in "+-"}
    assert fates == {"+": "rocking", "-": "at-rest"}


@pytest.mark.parametrize("kick", ["0", "-1e-6", "0.2", "nan", "inf"])
def test_a_kick_out_of_range_is_refused(kick: str) -> None:
    line = refused("simulate -A 2 -W 1.7 -r 0.8 --start steady --kick", kick)
    assert "--kick = " in line
    assert "0.1" in line


@pytest.mark.parametrize("start", ["rest", "0.1,0", "0,w=0.2"])
def test_a_kick_without_a_steady_state_is_refused(start: str) -> None:
    line = refused(f"simulate -A 2 -W 1.7 -r 0.8 --kick 1e-4 --start {start}")
    assert "--kick = 0.0001" in line
    assert "--start steady" in line


def test_a_kick_that_is_no_number_is_refused() -> None:
    assert "--kick" in refused("simulate -A 2 -W 1.7 -r 0.8 --start steady --kick far")


def test_the_help_names_the_default() -> None:
    text = " ".join(rocksteady("simulate --help").out.split())
    assert "--kick" in text
    assert "1e-6" in text
