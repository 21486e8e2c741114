"""The program for bifurcation points: alone, and against the orbits that begin there."""

import json
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import mpmath as mp
import pytest

import rocksteady as rs
from rocksteady.certify import checker, point_checker
from rocksteady.certify.files import check_certificate, program
from rocksteady.certify.point import certify_point
from tests.certify.test_point import BLOCK, branch_points
from tests.every import every

TYPES = ("fold", "symmetry-breaking", "period-doubling")


@cache
def certificate(kind: str) -> str:
    if kind == "period-doubling":
        motion = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
        orbit = rs.find_orbits(BLOCK, motion, max_period=1, seeds=2)[0]
        points = rs.branches.find_cascade(orbit, "amplitude", (0.5, 3.0), doublings=1).points
    else:
        points = tuple(branch_points(-1 if kind == "fold" else 1))
    return certify_point(next(each for each in points if each.type == kind)).to_json()


def mismatches(phases: list[Any], orders: list[int], amplitude: Any) -> list[Any]:
    """(E3) at W = 2, restitution .8 by the speeds at both ends of (E2), in 40 digits."""
    r, w, m = mp.mpf("0.8"), mp.mpf(2), len(phases)
    b = amplitude / (1 + w * w)
    speeds = []
    for k, n in enumerate(orders):
        p, q = phases[k], phases[(k + 1) % m]
        t = (q - p + n * mp.pi) / w
        i, j = 1 - b * mp.sin(p), 1 + b * mp.sin(q)
        up = i * mp.coth(t) - j * mp.csch(t) - b * w * mp.cos(p)
        speeds.append((up, j * mp.coth(t) - i * mp.csch(t) - b * w * mp.cos(q)))
    return [r * speeds[k - 1][1] - speeds[k][0] for k in range(m)]


@every("kind", TYPES)
def test_what_opens_is_where_the_orbits_are_found(kind: str) -> None:
    values = json.loads(certificate(kind))
    with mp.workdps(40):
        amplitude = mp.mpf(values["amplitude"])
        middle = [mp.mpf(x) for x in values["phases"]]
        far, sign = mp.mpf("0.001"), values["claim"]["sign"]
        orders = values["half_periods"] * (1 if sign == 1 else 2)

        def system(*unknowns: Any) -> list[Any]:
            *rest, a = unknowns
            if sign == 1:  # one phase is moved
                return mismatches([middle[0] + far, *rest], orders, a)
            phases = [*rest[: len(middle)], rest[0] + far, *rest[len(middle) :]]
            return mismatches(phases, orders, a)

        start = middle[1:] if sign == 1 else [*(x - far / 2 for x in middle), *middle[1:]]
        found = mp.findroot(system, [*start, amplitude + far**2], tol=1e-60, verify=False)
        assert max(map(abs, system(*found))) < 1e-30
        off = found[len(found) - 1] - amplitude
        assert 1e-9 < abs(off) < 1e-4
        assert mp.sign(off) == values["claim"]["opens"]
        if sign == -1:  # stable, by its multipliers from differences
            rest = list(found)[:-1]
            phases = [*rest[: len(middle)], rest[0] + far, *rest[len(middle) :]]
            if len(phases) == 2:  # twice, so that the phases before and after are two
                phases, orders = phases * 2, orders * 2
            step, count = mp.mpf(10) ** -15, len(phases)
            power = mp.eye(2)
            for k in range(count):
                slopes = []
                for j in (k - 1, k, (k + 1) % count):
                    pair = []
                    for way in (1, -1):
                        moved = list(phases)
                        moved[j] += way * step
                        pair.append(mismatches(moved, orders, found[len(found) - 1])[k])
                    slopes.append((pair[0] - pair[1]) / (2 * step))
                if (
                    count == 2
                ):  # the phases before and after are one, and the sum of both stands there
                    return
                power = (
                    mp.matrix([[-slopes[1] / slopes[2], -slopes[0] / slopes[2]], [1, 0]]) * power
                )
            limit = 1 + mp.mpf("0.8") ** (2 * count)
            stable = abs(power[0, 0] + power[1, 1]) < limit
            assert stable == (values["claim"]["criticality"] == "supercritical")


@every("kind", TYPES)
def test_both_arithmetics_hold_and_no_false_claim_does(kind: str) -> None:
    values = json.loads(certificate(kind))
    assert checker.check(json.dumps(values), checker.iv) == "holds"
    claim = values["claim"]
    changes: list[dict[str, Any]] = [
        {"claim": claim | {"opens": -claim["opens"]}},
        {"claim": claim | {"sign": -claim["sign"]}},
        {"claim": claim | {"sign": 0}},
        {"amplitude": values["amplitude"][:-9] + "123456789"},
        {"model": values["model"] | {"restitution": ["0.81"]}},
    ]
    if claim["sign"] == -1:
        changes.append({"claim": claim | {"criticality": "subcritical"}})
    for change in changes:
        answer = checker.check(json.dumps(values | change), checker.arb)
        assert answer.startswith("refused") or "amplitude" in change, (change, answer)
        assert answer != "holds"


def test_series_are_those_of_taylor() -> None:
    local = checker.arb(80)
    lifted: Any = point_checker.series(local)
    x: Any = point_checker.Series(*map(local.num, ("0.3", "0.7", "-0.2", "0.5")))

    def course(s: Any) -> Any:
        return 0.3 + 0.7 * s - 0.2 * s**2 + 0.5 * s**3

    cases: tuple[tuple[Any, Callable[[Any], Any]], ...] = (
        (lifted.exp(x), lambda s: mp.exp(course(s))),
        (lifted.sin_cos(x)[0], lambda s: mp.sin(course(s))),
        (lifted.sin_cos(x)[1], lambda s: mp.cos(course(s))),
        (1 / x, lambda s: 1 / course(s)),
        (2 - x * x / local.num(3), lambda s: 2 - course(s) ** 2 / 3),
    )
    for ours, function in cases:
        for coefficient, exact in zip(ours.c, mp.taylor(function, 0, 3), strict=True):
            assert abs(float(local.mid(coefficient)) - float(exact)) < 1e-9


def test_the_program_runs_alone(tmp_path: Path) -> None:
    alone, file = tmp_path / "check.py", tmp_path / "point.json"
    alone.write_text(program("point"), encoding="utf-8")
    for text, code in (
        (certificate("fold"), 0),
        (certificate("fold").replace('opens": 1', 'opens": -1'), 1),
    ):
        file.write_text(text, encoding="utf-8")
        command = [sys.executable, "-I", str(alone), str(file)]
        assert subprocess.run(command, check=False, capture_output=True).returncode == code
        assert check_certificate(file).holds == (code == 0)


def test_elimination_refuses_what_may_be_singular() -> None:
    local = checker.arb(64)
    rows = [[local.num(1), local.num(2)], [local.num(2), local.num(4)]]
    with pytest.raises(ArithmeticError):
        point_checker.solved(local, rows, [local.num(1), local.num(1)])
