"""The program for regions: alone, box by box, against the closed forms in 30 digits."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np

from rocksteady.certify import checker, region_checker
from rocksteady.certify.files import check_certificate, program
from rocksteady.certify.region import ProvedRegion, certify_region
from tests.every import every

STABLE = "0011000", "2"
"""A box around A = 2, W = 4, and its letter."""


def small(order: int) -> ProvedRegion:
    return certify_region((0.5, 6.0), (2.0, 8.0), "0.8", order=order, most_boxes=3000)


def truth(amplitude: float, ratio: float, order: int) -> str:
    """The letter of a point of branch 1, by (21) and by samples of (E2), restitution .8."""
    with mp.workdps(30):
        a, w, r = mp.mpf(amplitude), mp.mpf(ratio), mp.mpf("0.8")
        b, t, g = a / (1 + w * w), order * mp.pi / w, mp.mpf(1) / 9
        h = mp.tanh(t / 2)
        p, q = g * h * w, g * h * h
        if b * mp.sqrt(1 + p * p) < q:
            return "1"
        phase = mp.pi - mp.asin(q / (b * mp.sqrt(1 + p * p))) - mp.atan(p)
        s = b * mp.sin(phase)

        def height(u: Any) -> Any:
            ends = (1 - s) * mp.sinh(t - u) + (1 + s) * mp.sinh(u)
            return 1 - b * mp.sin(phase + w * u) - ends / mp.sinh(t)

        if min(height(t * k / 200) for k in range(1, 200)) < 0:
            return "4"
        speed = h + s / h - b * w * mp.cos(phase)
        trace = (1 + r) * mp.sinh(t) / speed - (1 + r) ** 2 / 2 * mp.cosh(t)
        trace += (1 - r) ** 2 / 2 * (1 - w * w * (mp.cosh(t) - 1))
        return "2" if abs(trace) < 1 + r * r else "3"


@every("order", [1, 3])
def test_boxes_hold_alone_with_the_letter_of_their_points_and_no_other(order: int) -> None:
    region, random = small(order), np.random.default_rng(order)
    paths = region_checker.leaves(json.loads(region.to_json()))
    boxes = [each for each in zip(region.boxes(), paths, strict=True) if each[0][1] != "0"]
    for number in random.choice(len(boxes), 40):
        (box, letter), path = boxes[number]
        point = random.uniform(box.low, box.high), random.uniform(box.slow, box.fast)
        values = json.loads(region.box_json(*path))
        assert truth(*point, order) == letter == values["claim"]["letter"], (point, values)
        assert checker.check(json.dumps(values), checker.arb) == "holds"
        assert checker.check(json.dumps(values), checker.iv) == "holds"
        for false in {*"01234"} - {letter}:
            tampered = values | {"claim": {"letter": false}}
            assert checker.check(json.dumps(tampered), checker.arb) != "holds"


def test_a_box_moved_to_where_another_letter_is_true_is_refused() -> None:
    values = json.loads(small(1).box_json(*STABLE))
    assert checker.check(json.dumps(values), checker.arb) == "holds"
    for change in (
        {"model": {"restitution": ["1.2"]}},
        {"order": 2},
        {"path": "1" * 201},
        {"claim": {"letter": ""}},
        {"amplitude": [3.0, 60.0]},
    ):
        assert checker.check(json.dumps(values | change), checker.arb) != "holds", change


def test_trees_are_read_whole_or_refused() -> None:
    region = small(1)
    found = region_checker.leaves(json.loads(region.to_json()))
    assert [letter for _, letter in found] == [letter for _, letter in region.boxes()]
    assert sum(0.5 ** len(path) for path, _ in found) == 1.0
    values = json.loads(region.to_json()) | {"tree": "AAAA"}
    assert checker.check(json.dumps(values), checker.arb).startswith("refused")


def test_a_box_is_checked_by_the_program_alone(tmp_path: Path) -> None:
    region = small(1)
    alone, file = tmp_path / "check.py", tmp_path / "box.json"
    alone.write_text(program("region"), encoding="utf-8")
    values = json.loads(region.box_json(*STABLE))
    for letter, code in (("2", 0), ("3", 1)):
        file.write_text(json.dumps(values | {"claim": {"letter": letter}}), encoding="utf-8")
        command = [sys.executable, "-I", str(alone), str(file)]
        assert subprocess.run(command, check=False, capture_output=True).returncode == code
        assert check_certificate(file).holds == (code == 0)
