"""The program for regions: alone, box by box, against the closed forms in 30 digits."""

import base64
import json
import subprocess
import sys
import zlib
from collections import Counter, deque
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from rocksteady.certify.proofs import checker, region_checker
from rocksteady.certify.proofs.files import check_certificate, program
from rocksteady.certify.proofs.region import ProvedRegion, certify_region
from tests.every import every

STABLE = "0011000", "2"
"""A box around A = 2, W = 4, and its letter."""


@cache
def small(order: int) -> ProvedRegion:
    return certify_region((0.5, 6.0), (2.0, 8.0), "0.8", order=order, most_boxes=3000)


@cache
def truth(amplitude: Any, ratio: Any, order: int, loss: str = "0.8") -> str:
    """The letter of a point of branch 1, by (21) and by samples of (E2)."""
    with mp.workdps(30):
        a, w, r = mp.mpmathify(amplitude), mp.mpmathify(ratio), mp.mpf(loss)
        b, t, g = a / (1 + w * w), order * mp.pi / w, (1 - r) / (1 + r)
        h = mp.tanh(t / 2)
        p, q = g * h * w, g * h * h
        if b * mp.sqrt(1 + p * p) < q:
            return "1"
        phase = mp.pi - mp.asin(q / (b * mp.sqrt(1 + p * p))) - mp.atan(p)
        s = b * mp.sin(phase)

        u = np.arange(1, 128) * float(t) / 128
        near, far = (np.exp(-x) - np.exp(x - 2 * float(t)) for x in (u, float(t) - u))
        ends = (float(1 - s) * near + float(1 + s) * far) / (1 - np.exp(-2 * float(t)))
        if min(1 - float(b) * np.sin(float(phase) + float(w) * u) - ends) < 0:
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


def agrees(values: dict[str, Any]) -> bool:
    """Whether 9 points of a box, or of each box of a tree, have the letter that is claimed."""
    if "tree" in values:
        letters = zlib.decompress(base64.b64decode(values["tree"])).decode()
        queue, boxes = deque([""]), list[tuple[str, str]]()
        for letter in letters:
            if not queue:
                return False
            path = queue.popleft()
            if letter == "5":
                queue += [path + "0", path + "1"]
            else:
                boxes.append((path, letter))
        claims = [values | {"path": path, "claim": {"letter": x}} for path, x in boxes if x != "0"]
        claims = [{k: x for k, x in each.items() if k != "tree"} for each in claims]
        return not queue and all(map(agrees, claims))
    order, letter = values["order"], values["claim"]["letter"]
    if order < 1 or order % 2 == 0 or letter not in ("1", "2", "3", "4"):
        return False
    points = []
    for k, name in enumerate(("amplitude", "frequency_ratio")):
        low, high = map(Fraction, values[name])
        for half in values["path"][k::2]:
            middle = (low + high) / 2
            low, high = (low, middle) if half == "0" else (middle, high)
        if min(low, high) <= 0:
            return False
        points.append([(low, (low + high) / 2, high)[each] for each in (1, 0, 2)])
    losses = values["model"]["restitution"]
    return all(
        0 < float(loss) < 1 and truth(*point, order, loss) == letter
        for *point, loss in product(*points, losses)
    )


def tampered(region: ProvedRegion, random: np.random.Generator) -> tuple[dict[str, Any], bool]:
    """A certificate with one thing changed, and whether it is true by the way it is changed."""
    whole = json.loads(region.to_json())
    leaves = [each for each in region_checker.leaves(whole) if each[1] != "0"]
    path, letter = leaves[random.integers(len(leaves))]
    values: dict[str, Any] = json.loads(region.box_json(path, letter))
    size = float(10.0 ** random.uniform(-6, 0) * random.choice([-1, 1]))
    ends = values[str(random.choice(["amplitude", "frequency_ratio"]))]
    kind = int(random.integers(10 if len(region.tree) > 1000 else 14))
    match kind:
        case 0 | 1:
            values["claim"]["letter"] = str(random.choice(list("012345")))
        case 2:
            place = int(random.integers(len(path)))
            values["path"] = path[:place] + "10"[int(path[place])] + path[place + 1 :]
        case 3:
            values["path"] = path[: -int(random.integers(1, 4))]
        case 4:  # part of a true box
            values["path"] += "".join(random.choice(["0", "1"], random.integers(1, 4)))
        case 5:
            ends[int(random.integers(2))] *= 1 + size
        case 6:
            losses = values["model"]["restitution"]
            losses[int(random.integers(len(losses)))] = repr(0.8 + size)
        case 7:
            values["order"] = int(random.integers(-1, 6))
        case 8:
            values["path"] = leaves[random.integers(len(leaves))][0]
        case 9:  # the same claim with other bits
            values["bits"] = 80
        case _:  # a tree with one letter changed: it is true if it claims less
            place, new = int(random.integers(len(region.tree))), str(random.integers(6))
            tree = region.tree[:place] + new + region.tree[place + 1 :]
            whole["tree"] = base64.b64encode(zlib.compress(tree.encode())).decode()
            return whole, tree == region.tree or ("5" not in (region.tree[place]) and new == "0")
    return values, kind in (4, 9)


def tamper(count: int, seed: int, *arithmetics: Callable[[int], Any]) -> Counter[str]:
    """Verdicts on tampered boxes and trees, by what points of the closed forms say."""
    random, seen = np.random.default_rng(seed), Counter[str]()
    trees = [((1.0, 3.0), (4.0, 6.0)), ((0.2, 1.2), (1.5, 2.5))]
    few = [certify_region(*ranges, "0.8", order=3, most_boxes=200) for ranges in trees]
    regions = [small(1), small(3), *few]
    for number in range(count):
        values, true = tampered(regions[number % 4], random)
        known = "True" if true else str(agrees(values) and None)
        for arithmetic in arithmetics:
            answer = checker.check(json.dumps(values), arithmetic)
            seen[f"{known} {answer.split(':')[0]}"] += 1
            assert answer != "holds" or known != "False", values
            assert answer == "holds" or known != "True", (answer, values)
    return seen


def test_no_false_claim_holds_and_no_true_claim_is_refused() -> None:
    seen = tamper(40, 1, checker.arb)
    assert seen["False refused"] >= 10
    assert seen["True holds"] >= 4


@pytest.mark.slow
def test_hundreds_of_false_claims_are_refused() -> None:
    seen = tamper(1000, 2, checker.arb)
    assert seen["False refused"] >= 330
    assert seen["False undecided"] <= 0.3 * seen["False refused"]
    assert seen["True holds"] >= 130
    assert tamper(200, 3, checker.iv)["False refused"] >= 50


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
