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
from tests.cli.program import rocksteady
from tests.every import every


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


# ----------------------------------------------------------------------------------- files


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


def test_several_orders_are_several_points() -> None:
    points = rocksteady("steady -A 4 -W 8 -r 0.8 -n 3 -n 1 -n 3 --json").json["points"]
    assert [point["order"] for point in points] == [3, 1]
    for point in points:
        alone = rocksteady(f"steady -A 4 -W 8 -r 0.8 -n {point['order']} --json").json
        assert point == {key: alone[key] for key in point}
