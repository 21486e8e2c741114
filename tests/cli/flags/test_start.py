"""Where a motion begins: texts of --start, what goes with them, and how --kick sets a block off."""

import pytest

from rocksteady import DimensionlessBlock, Harmonic, Rest, State, Steady, simulate
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.start import StartFlags, refuse_without_shaking, state_from
from rocksteady.errors import InputError, ModelError
from tests.cli.program import refused, rocksteady
from tests.every import every

LEFT = "simulate -A 2 -W 1.7 -r 0.8 --start steady --cycles 40 --json"


def overturned_at(*more: str) -> float:
    ran = rocksteady(LEFT, *more)
    assert ran.code == 0
    values = ran.json
    assert values["status"] == "overturned"
    assert isinstance(values["overturn_time_tau"], float)
    return values["overturn_time_tau"]


@every("side", ["+", "-"])
@every("kick", ["1e-3", "0.01", "1e-9"])
def test_the_flag_is_the_librarys_argument(kick: str, side: str) -> None:
    run = simulate(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.7),
        start=Steady(kick=float(kick), side=1 if side == "+" else -1),
        cycles=40,
    )
    assert overturned_at("--kick", kick, "--side", side) == run.overturn_time_tau


def test_a_block_set_off_further_out_falls_sooner() -> None:
    far, near, nearer = (overturned_at("--kick", kick) for kick in ("1e-2", "1e-6", "1e-10"))
    assert far < near < nearer
    assert overturned_at() == near, "where nobody says it is 1e-6"


def test_the_other_branch_takes_it_too() -> None:
    command = "simulate -A 1 -W 8 -r 0.8 --start steady:2 --cycles 60 --json --kick 1e-4"
    fates = {side: rocksteady(command, "--side", side).json["status"] for side in "+-"}
    assert fates == {"+": "rocking", "-": "at-rest"}


@every("kick", ["0", "-1e-6", "0.2", "nan", "inf"])
def test_a_kick_out_of_range_is_refused(kick: str) -> None:
    line = refused("simulate -A 2 -W 1.7 -r 0.8 --start steady --kick", kick)
    assert "--kick = " in line
    assert "0.1" in line


@every("start", ["rest", "0.1,0", "0,0.2"])
def test_a_kick_without_a_steady_state_is_refused(start: str) -> None:
    line = refused(f"simulate -A 2 -W 1.7 -r 0.8 --kick 1e-4 --start {start}")
    assert "--kick = 0.0001" in line
    assert "--start steady" in line


def test_a_kick_that_is_no_number_is_refused() -> None:
    assert "--kick" in refused("simulate -A 2 -W 1.7 -r 0.8 --start steady --kick far")


def test_the_help_names_the_default() -> None:
    text = " ".join(rocksteady("simulate --help-all").out.split())
    assert "--kick" in text
    assert "1e-6" in text


# --------------------------------------------------------------------------- texts of --start


@every(
    ("flags", "start"),
    [
        (StartFlags(), Rest()),
        (StartFlags(start="0.4,-0.1"), State(angle=0.4, velocity=-0.1)),
        (StartFlags(start="0.4,tau=-0.5"), State(angle=0.4, velocity=-1.5)),
        (StartFlags(start="-1e-3,0"), State(angle=-1e-3, velocity=0.0)),
        (StartFlags(start="steady"), Steady()),
        (StartFlags(start="steady:1"), Steady()),
        (StartFlags(start="steady:2", order=3, kick=1e-3), Steady(branch=2, order=3, kick=1e-3)),
    ],
)
def test_every_text_is_its_start(flags: StartFlags, start: Rest | State | Steady) -> None:
    assert flags.of(3.0) == start


def test_the_velocity_by_tau_needs_a_frequency_and_that_by_pivot_time_none() -> None:
    assert StartFlags(start="0.4,0.1").of(None) == State(angle=0.4, velocity=0.1)
    with pytest.raises(InputError, match=r"du/d\(omega t\) needs harmonic shaking; give du/d"):
        StartFlags(start="0.4,tau=0.1").of(None)


@every(
    ("text", "words"),
    [
        ("stand", "it is no known start"),
        ("steady:3", "it is no known start"),
        ("0.4", "it is no known start"),
        ("0.4,", "it is not two numbers"),
        ("0.4,tau=", "it is not two numbers"),
        ("0.4,w=0.1", "it is not two numbers"),
        ("0.4,0.1,0.2", "it is not two numbers"),
        ("\N{ARABIC-INDIC DIGIT TWO},0", "it is not two numbers"),
        ("nan,0", "its numbers must be finite"),
        ("0,inf", "its numbers must be finite"),
    ],
)
def test_what_is_no_start_is_refused_with_all_that_are(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as refused:
        state_from(text, 2.0)
    assert (refused.value.name, refused.value.value) == ("start", text)
    assert "write rest, steady, steady:2" in str(refused.value)


@every(
    ("flags", "shaken", "words"),
    [
        (StartFlags(side="left"), True, "it must be [+] or -"),
        (StartFlags(start="steady", phase=1.0), True, "a steady state decides its phase"),
        (StartFlags(start="steady:2"), False, "a steady state needs shaking"),
        (StartFlags(start="0.5,0", phase=1.0), False, "without shaking it has no meaning"),
    ],
)
def test_flags_that_contradict_each_other_are_refused(
    flags: StartFlags, shaken: bool, words: str
) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        flags.check(shaken=shaken)


def test_flags_that_go_together_pass() -> None:
    StartFlags(start="steady:2", side="-").check(shaken=True)
    StartFlags(start="0.5,0").check(shaken=False)
    refuse_without_shaking("--phase", None)
    with pytest.raises(FlagError, match="only a steady start has an order"):
        StartFlags(order=3).of(2.0)


def test_the_start_is_repeated_with_the_phase_it_had() -> None:
    flags = StartFlags(start="steady", side="-", kick=1e-3)
    assert (flags.sign, flags.first_phase) == (-1, 0.0)
    assert StartFlags(phase=2.5).first_phase == 2.5
    assert flags.values(0.7) == {
        "start": "steady",
        "order": 1,
        "side": "-",
        "kick": 1e-3,
        "phase": 0.7,
    }


def test_an_error_about_the_start_shows_what_was_typed() -> None:
    flags = StartFlags(start="steady:2")
    wrong = {"value": Steady(branch=2), "valid": "there is none", "hint": "take another"}
    with (
        pytest.raises(FlagError, match="'steady:2' is not accepted: there is none"),
        flags.as_typed(),
    ):
        raise ModelError(name="start", **wrong)  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="there is none") as other, flags.as_typed():
        raise ModelError(name="motion", **wrong)  # type: ignore[arg-type]
    assert other.value.name == "motion"
