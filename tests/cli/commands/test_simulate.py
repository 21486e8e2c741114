"""`rocksteady simulate`: its contract, its starts, its text and its files."""

import math
from pathlib import Path

import pytest
from PIL import Image

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Pulse,
    State,
    Still,
    check_neighbours,
    simulate,
)
from tests.cli.program import refused, rocksteady
from tests.every import every

SHAKEN = "simulate -A 2 -W 4 -r 0.8"
BARE = DimensionlessBlock(restitution=0.8)


def test_the_json_of_a_real_block_is_in_seconds() -> None:
    values = rocksteady(
        "simulate --width-m 0.4 --height-m 1.2 --accel-g 1.2 --freq-hz 0.5 --json"
    ).json
    block = Block.rectangle(width=0.4, height=1.2)
    motion = Harmonic.from_si(block, acceleration_m_s2=1.2 * 9.80665, frequency_hz=0.5)
    run = simulate(block, motion)
    assert values["status"] == "overturned"
    assert values["overturn_time_s"] == run.overturn_time_s
    assert "overturn_time_tau" not in values
    assert values["peak_rad"] == pytest.approx(values["peak"] * math.atan(1.0 / 3.0))
    assert (values["accel_g"], values["freq_hz"]) == pytest.approx((1.2, 0.5))
    assert values["block"]["p_rad_s"] == block.p


def test_free_rocking_comes_to_rest() -> None:
    values = rocksteady("simulate --block zhang-makris-2001 --start 0.6,0 --json").json
    block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    run = simulate(block, Still(), start=State(angle=0.6, velocity=0.0))
    assert values["status"] == "at-rest"
    assert values["peak"] == 0.6
    assert run.rest_time_pt is not None
    assert values["rest_time_s"] == run.rest_time_pt / 2.14
    assert values["overturn_time_s"] is None
    assert "amplitude" not in values


def test_a_pulse_on_a_real_block_has_neighbours_uplift_and_friction() -> None:
    command = "simulate --block zhang-makris-2001 --pulse one-sine --accel-g 2 --freq-hz 1.7"
    block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    pulse = Pulse.from_si(
        block, shape="one-sine", acceleration_m_s2=2.0 * 9.80665, frequency_hz=1.7
    )
    run = simulate(block, pulse)
    found = check_neighbours(run)
    values, text = rocksteady(f"{command} --json").json, rocksteady(f"{command} --more").out
    assert values["neighbours"] == {"runs": 26, "fall": found.fall}
    assert values["friction_needed"] == pytest.approx(run.friction_needed)
    assert (values["uplift_g"], values["pga_g"]) == pytest.approx((math.tan(0.25), 2.0))
    assert f"falls in {found.fall} of 26 neighbours" in " ".join(text.split())
    assert ("not robust" in text) == (not found.agree)
    assert "neighbours" not in rocksteady(f"{SHAKEN} --json").json


# ---------------------------------------------------------------------------------- starts


@every(
    ("flags", "start", "phase"),
    [
        ("--start rest", State(angle=0.0, velocity=0.0), 0.0),
        ("--start 0.4,0", State(angle=0.4, velocity=0.0), 0.0),
        ("--start 0.1,tau=0.2", State(angle=0.1, velocity=0.8), 0.0),
        ("--start 0.1,0.2", State(angle=0.1, velocity=0.2), 0.0),
        ("--start -0.1,tau=-2e-1", State(angle=-0.1, velocity=-0.8), 0.0),
        ("--start=-0.1,-0.2 --phase 1.5", State(angle=-0.1, velocity=-0.2), 1.5),
        ("--start 0,0.3 --phase -1", State(angle=0.0, velocity=0.3), -1.0),
    ],
)
def test_every_form_of_a_start(flags: str, start: State, phase: float) -> None:
    values = rocksteady(f"{SHAKEN} --cycles 3 {flags} --json").json
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=phase)
    run = simulate(BARE, motion, start=start, cycles=3)
    assert values["peak"] == run.peak
    assert values["impacts"] == len(run.impacts)
    assert values["phase"] == phase


def test_a_steady_start_keeps_its_peak() -> None:
    values = rocksteady(f"{SHAKEN} --start steady --json").json
    assert values["peak"] == pytest.approx(0.1854991060, abs=5.1e-11)
    assert values["phase"] == pytest.approx(2.8465425429, abs=5.1e-11)
    third = rocksteady("simulate -A 2 -W 6 -r 0.8 --start steady:1 -n 3 --json").json
    assert third["peak"] == pytest.approx(0.2888312915, abs=5.1e-11)


def test_the_side_decides_the_fate_of_an_unstable_start() -> None:  # E6
    command = "simulate -A 1 -W 1 -r 0.8 --start steady:2 --json --side"
    assert rocksteady(command, "+").json["status"] == "overturned"
    assert rocksteady(command, "-").json["status"] == "at-rest"
    assert rocksteady(command[: -len(" --side")]).json["status"] == "overturned", "+ is the default"


def test_a_run_that_cannot_be_decided_ends_with_3(monkeypatch: pytest.MonkeyPatch) -> None:
    import rocksteady.dynamics.history.simulate as module

    whole = module.simulate
    monkeypatch.setattr(module, "simulate", lambda *a, **k: whole(*a, **k, max_flights=5))
    ran = rocksteady(f"{SHAKEN} --json")
    assert ran.code == 3
    assert ran.json["status"] == "undecided"


# ------------------------------------------------------------------------------------ text


def test_more_adds_to_the_answer_and_quiet_leaves_its_first_line() -> None:
    command = "simulate --width-m 0.4 --height-m 2 --pulse one-sine --accel-g 0.4 --freq-hz 1"
    answer = rocksteady(command).out
    assert len(answer.rstrip().splitlines()) <= 8
    assert rocksteady(f"{command} --more").out.startswith(answer)
    assert rocksteady(f"{command} --quiet").out == answer.splitlines(keepends=True)[0]
    for flag in ("--more", "--quiet"):
        assert rocksteady(f"{command} --json {flag}").out == rocksteady(f"{command} --json").out


# ------------------------------------------------------------------------------------ film

FALL = "simulate --block tso-wong-1989 -A 4 -W 1.5"


@pytest.mark.slow
def test_a_film_is_written_beside_the_other_outputs(tmp_path: Path) -> None:
    film, table = tmp_path / "fall.gif", tmp_path / "fall.csv"
    ran = rocksteady(f"{FALL} --json --csv", table, "--animate", film)
    assert ran.code == 0
    assert ran.json["status"] == "overturned"
    assert ran.err.splitlines() == [f"wrote {table}", f"wrote {film}"], (
        "and no bar without a terminal"
    )
    assert film.read_bytes().startswith(b"GIF89a")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fall.csv", "fall.gif"]


@pytest.mark.slow
def test_the_speed_of_a_film_changes_its_length(tmp_path: Path) -> None:
    lengths = []
    for speed in ("1", "0.5"):
        file = tmp_path / f"{speed}.gif"
        assert rocksteady(f"{FALL} --speed {speed} --animate", file).code == 0
        with Image.open(file) as picture:
            total = 0
            for frame in range(getattr(picture, "n_frames", 1)):
                picture.seek(frame)
                total += picture.info["duration"]
        lengths.append(total)
    # What is left of a second is its last picture; frames come in steps of 40 ms.
    assert lengths[1] - 1000 == pytest.approx(2 * (lengths[0] - 1000), abs=81)


@every(
    ("flags", "needles"),
    [
        ("--animate run.mp4", ["--animate", "'run.mp4'", ".gif"]),
        ("--animate run.gif --csv run.gif", ["--animate", "--csv writes the same file"]),
    ],
)
def test_a_film_that_cannot_be_is_refused_before_anything_is_computed(
    flags: str, needles: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import rocksteady.dynamics.history.simulate as module

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(module, "simulate", None)
    line = refused(f"{SHAKEN} {flags}")
    for needle in needles:
        assert needle in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_an_existing_film_is_left_alone_without_force(tmp_path: Path) -> None:
    file = tmp_path / "fall.gif"
    file.write_text("precious")
    assert "--force" in refused(f"{FALL} --animate", file)
    assert file.read_text() == "precious"
    assert rocksteady(f"{FALL} --force --animate", file).code == 0
    assert file.read_bytes().startswith(b"GIF89a")


def test_a_disk_that_fills_leaves_no_film(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import rocksteady.show.film.gif as module

    def full(_film: object, target: Path, _progress: object) -> None:
        target.write_bytes(b"GIF89a")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "save_gif", full)
    line = refused(f"{FALL} --animate", tmp_path / "fall.gif")
    assert "--animate = " in line
    assert "No space left on device" in line
    assert list(tmp_path.iterdir()) == []


def test_reverse_turns_a_pulse_round_and_needs_one_or_a_record() -> None:
    block = "--left-m 0.2 --right-m 0.4 --height-m 1.6"
    pulse = "--pulse one-sine --accel-m-s2 4 --freq-hz 1.2 --json"
    plain = rocksteady(f"simulate {block} {pulse}").json
    turned = rocksteady(f"simulate {block} {pulse} --reverse").json
    mirrored = rocksteady(f"simulate --left-m 0.4 --right-m 0.2 --height-m 1.6 {pulse}").json
    assert (plain["reversed"], turned["reversed"]) == (False, True)
    assert turned["status"] == mirrored["status"]
    assert turned["side_peaks"][::-1] == pytest.approx(mirrored["side_peaks"], rel=1e-6)
    assert turned["side_peaks"] != plain["side_peaks"]
    assert "without --record" in refused("simulate -A 2 -W 3 -r 0.8 --reverse")


# ------------------------------------------------------------------------------------ answer


def test_a_mass_gives_the_force_on_the_base_of_a_frame() -> None:
    """With the facts of a qualification, on a screen of eight lines; a mass of 0 is refused."""
    command = (
        "simulate --width-m 1.6 --height-m 9.6 --columns 4 --cap-mass-ratio 2 --pulse one-sine "
        "--accel-g 0.2 --freq-hz 0.5"
    )
    frame = Block.frame(columns=4, cap_mass_ratio=2.0, width=1.6, height=9.6)
    pulse = Pulse.from_si(
        frame, shape="one-sine", acceleration_m_s2=0.2 * frame.gravity, frequency_hz=0.5
    )
    run = simulate(frame, pulse)
    values = rocksteady(f"{command} --mass-kg 2000 --json").json
    assert values["base_force_kn"] == list(run.base_force_kn(2000.0) or ())
    assert values["top_displacement_m"] == run.top_displacement_m
    assert values["clearances_m"] == list(run.clearances_m or ())
    assert values["impact_speed_m_s"] == run.impact_speed_m_s
    assert (values["block"]["columns"], values["block"]["cap_mass_ratio"]) == (4, 2.0)
    screen = rocksteady(f"{command} --mass-kg 2000").out.splitlines()
    assert len(screen) <= 8
    assert any("; top moves 235 mm" in line for line in screen)
    more = rocksteady(f"{command} --mass-kg 2000 --more").out
    assert "force on base             3.35 kN across and 19.7 kN down" in more
    assert "give the mass in kg" in refused(f"{command} --mass-kg 0")
    assert "on a motion that ends" in refused(f"{SHAKEN} --mass-kg 5")
