"""`rocksteady steady`: its contract, its text and its files."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from rocksteady import (
    Block,
    Harmonic,
    find_steady_states,
)
from rocksteady.dynamics.steady.regions import REGIONS
from tests.cli.program import refused, rocksteady
from tests.every import every

POINT = "steady -A 2 -W 4 -r 0.8"


def solutions(command: str) -> list[dict[str, Any]]:
    found = rocksteady(f"{command} --json").json["solutions"]
    assert isinstance(found, list)
    return found


def test_multipliers_are_of_a_period_in_every_command() -> None:
    point = "-A 2 -W 4 -r 0.8"
    solution = solutions(f"steady {point}")[0]
    half = complex(*solution["half_cycle_multipliers"][0])
    whole = complex(*solution["multipliers"][0])
    assert whole in (pytest.approx(half**2), pytest.approx((half**2).conjugate()))
    settled = rocksteady(f"attractor {point} --start steady --json").json["multipliers"]
    assert complex(*settled[0]) == pytest.approx(whole, rel=1e-9)
    for command in (f"steady {point}", f"attractor {point} --start steady"):
        assert "multipliers of a period" in rocksteady(f"{command} --more").out
    assert "Multipliers are of a period." in rocksteady(f"orbits {point} --more").out


@every(
    ("point", "region"),
    [
        ("-A 1 -W 4 -r 0.8", 1),
        ("-A 2 -W 4 -r 0.8", 2),
        ("-A 0.75 -W 4 -r 0.5", 3),
        ("-A 0.1 -W 4 -r 0.8", 4),
        ("-A 5 -W 8 -r 0.5 -n 3", 5),
    ],
)
def test_every_region_is_named_and_region_4_has_no_solution(point: str, region: int) -> None:
    values = rocksteady(f"steady {point} --json").json
    assert values["region"] == region
    assert values["region_meaning"] == REGIONS[region]
    assert len(values["solutions"]) == (0 if region == 4 else 2)
    text = rocksteady(f"steady {point} --more")
    assert text.code == 0
    assert f"region {region}: {REGIONS[region]}" in " ".join(text.out.split())


def test_a_neutral_solution_is_not_stable() -> None:
    first, second = solutions("steady -A 1 -W 4 -r 1")
    assert (first["stable"], first["neutral"]) == (False, True)
    assert (second["stable"], second["neutral"]) == (False, False)
    assert first["phase"] == math.pi
    assert "neutral" in rocksteady("steady -A 1 -W 4 -r 1").out


def test_what_is_infinite_is_null() -> None:
    first, _ = solutions("steady -A 2 -W 0.01 -n 3 -r 0.8")
    assert first["half_cycle_multipliers"][0][0] is None
    assert first["half_cycle_trace"] is None


def test_long_and_short_flags_are_the_same() -> None:
    short = rocksteady("steady -A 2 -W 6 -r 0.8 -n 3 --json").out
    long = rocksteady(
        "steady --amplitude 2 --frequency-ratio=6 --restitution 0.8 --order 3 --json"
    ).out
    assert short == long
    assert '"order": 3' in short


# ---------------------------------------------------------------------------------- blocks


@every(
    ("flags", "block"),
    [
        ("--width-m 0.4 --height-m 1.2", Block.rectangle(width=0.4, height=1.2)),
        ("--alpha-rad 0.25 --radius-m 0.8", Block.from_radius(alpha=0.25, radius=0.8)),
        ("--alpha-rad 0.25 --p-rad-s 2.5", Block.from_p(alpha=0.25, p=2.5)),
        (
            "--width-m 0.4 --height-m 1.2 -r 0.7 --gravity-m-s2 9.81",
            Block.rectangle(width=0.4, height=1.2, restitution=0.7, gravity=9.81),
        ),
        (
            "--width-m 0.4 --height-m 1.2 -r housner",
            Block.rectangle(width=0.4, height=1.2),
        ),
        ("--block zhang-makris-2001", Block.from_p(alpha=0.25, p=2.14, restitution=0.9)),
        (
            "--block zhang-makris-2001 -r housner",
            Block.from_p(alpha=0.25, p=2.14),
        ),
    ],
)
def test_a_block_by_any_flags(flags: str, block: Block) -> None:
    values = rocksteady(f"steady {flags} --accel-g 0.9 --freq-hz 2 --json").json
    assert values["block"] == {
        "alpha_rad": block.alpha,
        "radius_m": block.radius,
        "p_rad_s": block.p,
        "restitution": block.restitution,
    }
    assert values["restitution"] == block.restitution
    # A = a_max/(alpha g), Omega = omega/p
    assert values["amplitude"] == pytest.approx(
        0.9 * 9.80665 / block.uplift_acceleration, rel=1e-14
    )
    assert values["frequency_ratio"] == pytest.approx(4.0 * math.pi / block.p, rel=1e-14)
    assert values["accel_g"] == pytest.approx(0.9, rel=1e-14)
    assert values["freq_hz"] == pytest.approx(2.0, rel=1e-14)
    for solution in values["solutions"]:
        assert solution["peak_rad"] == pytest.approx(solution["peak"] * block.alpha)


def test_dimensionless_and_si_measures_may_be_mixed() -> None:
    one = rocksteady("steady --alpha-rad 0.2 --p-rad-s 3 -A 2 --freq-hz 2 --json").json
    two = rocksteady("steady --alpha-rad 0.2 --p-rad-s 3 --accel-g 0.4 --freq-hz 2 --json").json
    assert one["amplitude"] == 2.0
    assert two["amplitude"] == pytest.approx(2.0, rel=1e-15)
    three = rocksteady("steady --alpha-rad 0.2 --p-rad-s 3 --accel-g 0.4 -W 4 --json").json
    assert three["frequency_ratio"] == 4.0
    assert three["amplitude"] == two["amplitude"]


# ------------------------------------------------------------------------------------ axes


def test_axes_include_both_ends_and_go_amplitude_first() -> None:
    values = rocksteady("steady -A 1:3:5 -W log:2:8:3 -r 0.8 --json").json
    assert values["schema"] == "rocksteady/steady/1"
    points = [(p["amplitude"], p["frequency_ratio"]) for p in values["points"]]
    expected = [(a, w) for a in (1.0, 1.5, 2.0, 2.5, 3.0) for w in (2.0, 4.0, 8.0)]
    np.testing.assert_allclose(points, expected, rtol=1e-15)
    assert points[0] == (1.0, 2.0)
    assert points[-1] == (3.0, 8.0)
    alone = rocksteady("steady -A 2 -W 8 -r 0.8 --json").json
    of_all = ("schema", "model")
    assert values["points"][8] == {k: v for k, v in alone.items() if k not in of_all}


@every(
    ("text", "reason"),
    [
        ("1:2", "start:stop:count"),
        ("1:2:3:4", "start:stop:count"),
        ("log:1:2", "start:stop:count"),
        ("lin:1:2:3", "start:stop:count"),
        ("1:2:1", "from 2 to"),
        ("1:2:0", "from 2 to"),
        ("1:2:99999999", "from 2 to"),
        ("1:2:2.5", "start:stop:count"),
        ("1:2:-3", "start:stop:count"),
        ("log:0:2:3", "above 0"),
        ("log:-1:2:3", "above 0"),
        ("nan:2:3", "finite"),
        ("1:inf:3", "finite"),
        ("a:2:3", "number"),
        ("", "number"),
    ],
)
def test_a_bad_axis_is_refused_with_the_form(text: str, reason: str) -> None:
    line = refused("steady -W 4 -r 0.8 -A", text)
    assert "--amplitude/-A" in line
    assert reason in line
    assert repr(text) in line or repr(text.partition(":")[0]) in line


def test_an_axis_through_a_bad_value_is_refused() -> None:
    assert "-1.0" in refused("steady -A -1:1:3 -W 4 -r 0.8")
    assert "--frequency-ratio/-W = 0.0" in refused("steady -A 1 -W 0:4:3 -r 0.8")


def test_the_text_of_axes_counts_what_was_found() -> None:
    ran = rocksteady("steady -A 0.1:2:2 -W 4:8:2 -r 0.8 --more")
    text = " ".join(ran.out.split())
    assert "points 4, 2 with solutions" in text
    assert "branch 1 2 admissible, 2 stable" in text


def answer(command: str) -> list[str]:
    ran = rocksteady(command)
    assert (ran.code, ran.err) == (0, "")
    lines = ran.out.splitlines()
    assert len(lines) <= 9
    assert max(map(len, lines)) <= 80
    return lines


def test_the_answer_of_a_point_is_its_stable_motion_in_the_units_given() -> None:
    size = "steady --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2"
    values = rocksteady(f"{size} --json").json
    first, *facts = answer(size)
    (stable,) = (each for each in values["solutions"] if each["stable"])
    degrees = math.degrees(stable["peak"] * values["block"]["alpha_rad"])
    assert f"at {degrees:.3g}° ({stable['peak']:.3g} alpha), out of phase" in first
    speed = stable["velocity"] * values["block"]["alpha_rad"] * values["block"]["p_rad_s"]
    assert f"{math.degrees(speed):.3g}°/s" in " ".join(facts)
    linear = values["closed_form"]["solutions"][0]["peak"]
    degrees = math.degrees(linear * values["block"]["alpha_rad"])
    text = f"at {degrees:.3g}° ({linear:.3g} alpha), out of phase, stable (linear)"
    assert text in " ".join(facts)
    least = values["closed_form"]["boundaries"]["existence"] * values["block"]["alpha_rad"]
    assert f"from {least:.3g} g up" in " ".join(answer(f"{size} --model linear"))


def test_the_answer_of_a_point_without_motion_is_the_least_amplitude() -> None:
    least = rocksteady("steady -A 0.1 -W 4 -r 0.8 --json").json["boundaries"]["existence"]
    assert f"needs A = {least:.3g}" in answer("steady -A 0.1 -W 4 -r 0.8")[0]


@every(
    ("axes", "first"),
    [
        ("-A 2 -W 1:5:100 -r 0.8", "A stable symmetric motion is possible at 76 of 100 points."),
        ("-A 0.01:0.1:5 -W 4 -r 0.8", "No stable symmetric motion is possible at any of 5 points."),
        ("-A 2 -W 4 -r 0.8 -n 1 -n 3", "A stable symmetric motion is possible at 1 of 2 points."),
    ],
)
def test_the_answer_of_axes_counts_points_with_a_stable_motion(axes: str, first: str) -> None:
    values = rocksteady(f"steady {axes} --json").json["points"]
    stable = sum(any(each["stable"] for each in point["solutions"]) for point in values)
    assert answer(f"steady {axes}")[0] == first
    assert f" {stable} of " in first or not stable


# ----------------------------------------------------------------------------------- files


def test_a_plot_of_amplitudes_at_one_frequency_is_refused_before_anything_is_written(
    tmp_path: Path,
) -> None:
    table, figure = tmp_path / "a.csv", tmp_path / "a.png"
    line = refused("steady -A 1:2:3 -W 4 -r 0.8 --csv", table, "--plot", figure)
    assert "--plot" in line
    assert list(tmp_path.iterdir()) == []


def test_axes_in_g_and_hertz_are_the_dimensionless_ones_of_the_block() -> None:
    in_si = rocksteady("steady --block tso-wong-1989 --accel-g 0.2:0.6:3 --freq-hz 2:8:4 --json")
    plain = rocksteady("steady --block tso-wong-1989 -A 1:3:3 -W 2:8:4 --json")
    pairs = zip(json.loads(in_si.out)["points"], json.loads(plain.out)["points"], strict=True)
    for one, other in pairs:
        assert one["amplitude"] == pytest.approx(other["amplitude"], rel=1e-12)
        assert one["frequency_ratio"] == pytest.approx(other["frequency_ratio"], rel=1e-12)
        assert one["closed_form"]["region"] == other["closed_form"]["region"]
        for mine, same in zip(one["solutions"], other["solutions"], strict=True):
            assert mine["peak"] == pytest.approx(same["peak"], rel=1e-9)


@every(
    "flags",
    [
        "--width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2",
        "--alpha-rad 0.6 --p-rad-s 2 -r 0.7 -A 2 -W 6 -n 3",
        "--alpha-rad 0.4 --p-rad-s 2 -r 0.8 -A 0.3 -W 8",  # a region with states, but none here
        "--alpha-rad 0.3 --p-rad-s 2 -r 0.8 -A 0 -W 4",
        "--alpha-rad 0.3 --p-rad-s 2 -r 1 -A 1 -W 4",
    ],
)
def test_the_closed_form_of_a_block_is_whole_beside_the_full_equations(flags: str) -> None:
    full = rocksteady(f"steady {flags} --json").json
    linear = rocksteady(f"steady {flags} --model linear --json").json
    assert (full["model"], linear["model"]) == ("nonlinear", "linear")
    assert {"schema": linear["schema"], **full["closed_form"]} == linear
    assert not {"region", "region_meaning", "boundaries"} & set(full)
    assert set(linear) - set(full) == {"region", "region_meaning", "boundaries"}
    for mine, same in zip(full["solutions"], linear["solutions"], strict=False):
        assert set(mine) == set(same)
        assert mine["branch"] == same["branch"]
    assert full != linear
    assert "(linear)" in rocksteady(f"steady {flags}").out
    assert "(linear)" not in rocksteady(f"steady {flags} --model linear").out


def test_the_full_equations_need_a_slenderness() -> None:
    line = refused(f"{POINT} --model nonlinear")
    assert "--model" in line
    assert "slenderness" in line


def test_on_a_floor_the_shaking_is_the_floors_in_both_models() -> None:
    flags = "--width-m 0.6 --height-m 2 --accel-g 0.2 --freq-hz 2 --floor-hz 4"
    full = rocksteady(f"steady {flags} --json").json
    block = Block.rectangle(width=0.6, height=2.0)
    motion = Harmonic(amplitude=full["amplitude"], frequency_ratio=full["frequency_ratio"])
    assert full["amplitude"] > 1.3 * 0.2 * 9.80665 / block.uplift_acceleration
    alone = find_steady_states(block, motion).to_dict()
    assert alone["solutions"][0]["peak"] == full["solutions"][0]["peak"]
    assert full["closed_form"]["amplitude"] == full["amplitude"]


def test_rows_and_curves_of_a_block_are_of_the_full_equations(tmp_path: Path) -> None:
    flags = "--alpha-rad 0.4 --p-rad-s 2 -r 0.8 -A 2 -W 2:8:7"
    points = rocksteady(f"steady {flags} --json").json["points"]
    table, figure = tmp_path / "a.csv", tmp_path / "a.svg"
    assert rocksteady(f"steady {flags} --csv", table, "--plot", figure).code == 0
    rows = pd.read_csv(table)
    assert "region" not in rows
    block = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
    for point in points:
        motion = Harmonic(amplitude=2.0, frequency_ratio=point["frequency_ratio"])
        first = find_steady_states(block, motion).to_dict()["solutions"][0]
        assert point["solutions"][0] == first
        mine = rows[(rows.branch == 1) & np.isclose(rows.frequency_ratio, motion.frequency_ratio)]
        assert mine.peak.item() == first["peak"]
        assert first["peak"] < 0.99 * point["closed_form"]["solutions"][0]["peak"]
    assert "branch 1, full equations" in figure.read_text()
    point = "--alpha-rad 0.4 --p-rad-s 2 -r 0.8 -A 2 -W 4"
    assert rocksteady(f"steady {point} --force --plot", figure).code == 0
    assert "regions of the linear ones" in figure.read_text()


def test_axes_too_long_together_are_refused_before_anything_is_computed() -> None:
    ran = rocksteady("steady -A 1:2:200000 -W 1:2:1000000 -r 0.8")
    assert (ran.code, ran.out) == (2, "")
    assert "200000 amplitudes x 1000000 frequencies" in ran.err
    assert len(ran.err.splitlines()) == 1


def test_several_orders_are_several_points(tmp_path: Path) -> None:
    points = rocksteady("steady -A 4 -W 8 -r 0.8 -n 3 -n 1 -n 3 --json").json["points"]
    assert [point["order"] for point in points] == [3, 1]
    for point in points:
        alone = rocksteady(f"steady -A 4 -W 8 -r 0.8 -n {point['order']} --json").json
        assert point == {key: alone[key] for key in point}
    assert "n = 1" not in refused("steady -A 4 -W 8 -r 0.8 -n 1 -n 2")
    picture = tmp_path / "a.png"
    why = refused("steady -A 4 -W 8 -r 0.8 -n 1 -n 3 --plot", picture)
    assert "a point is drawn for one order" in why
    assert rocksteady("steady -A 4 -W 6:9:5 -r 0.8 -n 1 -n 3 --plot", picture).code == 0
