"""The program for bifurcation points: alone, and against the orbits that begin there."""

import copy
import json
import math
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import mpmath as mp
import numpy as np
import pytest
from flint import arb, arb_mat

import rocksteady as rs
from rocksteady.certify.proofs import checker, point_checker
from rocksteady.certify.proofs._balls import decimal, exact, mid, precision
from rocksteady.certify.proofs.files import check_certificate, program
from rocksteady.certify.proofs.point import certify_point
from tests.certify.proofs.test_point import BLOCK, branch_points
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


Equations = Callable[[list[arb]], list[arb]]


def solved(equations: Equations, start: list[arb]) -> list[arb]:
    """The zero near a start, by Newton's method with differences; 90 digits, without a proof."""
    x, count, h = start, len(start), arb("1e-25")
    for _ in range(12):
        f = equations(x)
        moved = [equations([each + h * (j == k) for k, each in enumerate(x)]) for j in range(count)]
        rows = [[(column[k] - f[k]) / h for column in moved] for k in range(count)]
        step = arb_mat(rows).mid().solve(arb_mat(count, 1, f))
        x = [mid(each - step[k, 0]) for k, each in enumerate(x)]
        if max(abs(float(step[k, 0].mid())) for k in range(count)) < 1e-45:
            return x
    raise ValueError


class Setting(NamedTuple):
    """Flights of a chain, frequency ratio and restitution: (E3) by the speeds of (E2)."""

    orders: list[int]
    ratio: arb
    loss: arb

    def flight(self, k: int, p: arb, q: arb, a: arb) -> tuple[arb, arb, arb, arb]:
        """Of a flight: both coefficients of (E2), its duration and b."""
        b = a / (1 + self.ratio**2)
        t = (q - p + self.orders[k] * arb.pi()) / self.ratio
        return 1 - b * p.sin(), 1 + b * q.sin(), t, b

    def mismatch(self, k: int, phases: list[arb], a: arb) -> arb:
        """Landing less lift-off at the impact k, from the phases before, at and after it."""
        p, q, s = phases
        near, far, t, b = self.flight(k - 1, p, q, a)
        landing = far * t.coth() - near * t.csch() - b * self.ratio * q.cos()
        near, far, t, b = self.flight(k, q, s, a)
        return self.loss * landing - near * t.coth() + far * t.csch() + b * self.ratio * q.cos()

    def chain(self, phases: list[arb], a: arb) -> tuple[list[arb], arb]:
        """The mismatches, and the trace of the linearised chain by differences."""
        power, h, found = arb_mat([[1, 0], [0, 1]]), arb("1e-25"), list[arb]()
        for k in range(len(phases)):
            ends = [phases[k - 1], phases[k], phases[(k + 1) % len(phases)]]
            found.append(self.mismatch(k, ends, a))
            pairs = (
                [
                    self.mismatch(k, [x + way * (i == j) for i, x in enumerate(ends)], a)
                    for way in (h, -h)
                ]
                for j in range(3)
            )
            before, at, after = (up - down for up, down in pairs)
            power = arb_mat([[-at / after, -before / after], [1, 0]]) * power
        return found, power[0, 0] + power[1, 1]

    def limit(self) -> arb:
        return 1 + self.loss ** (2 * len(self.orders))

    def point(self, start: list[arb], sign: int) -> list[arb]:
        """The point near a start: phases and amplitude."""

        def equations(x: list[arb]) -> list[arb]:
            found, trace = self.chain(x[:-1], x[-1])
            return [*found, trace - sign * self.limit()]

        return solved(equations, start)

    def opening(self, point: list[arb], sign: int) -> tuple[int, bool]:
        """The side to which orbits beside a point are found, and whether these are stable."""
        *middle, amplitude = point
        far, count = arb("0.001"), len(middle)
        many = self if sign == 1 else self._replace(orders=self.orders * 2)

        def phases_of(rest: list[arb]) -> list[arb]:
            if sign == 1:  # one phase is moved
                return [middle[0] + far, *rest]
            return [*rest[:count], rest[0] + far, *rest[count:]]

        start = middle[1:] if sign == 1 else [*(x - far / 2 for x in middle), *middle[1:]]
        *rest, a = solved(lambda x: many.chain(phases_of(x[:-1]), x[-1])[0], [*start, amplitude])
        off, trace = float(a - amplitude), many.chain(phases_of(rest), a)[1]
        assert 1e-9 < abs(off) < 1e-4
        return (1 if off > 0 else -1), bool(abs(trace) < many.limit())

    def above(self, phases: list[arb], a: arb) -> bool:
        """Whether samples of each flight by (E2) are above the floor."""
        for k, p in enumerate(phases):
            near, far, t, b = self.flight(k, p, phases[(k + 1) % len(phases)], a)
            if not t > 0:
                return False
            for u in (t * part / 64 for part in range(1, 64)):
                ends = (near * (t - u).sinh() + far * u.sinh()) / t.sinh()
                if 1 - b * (p + self.ratio * u).sin() < ends:
                    return False
        return True


def is_true(values: dict[str, Any]) -> bool | None:
    """Whether a certificate is true, by its equations in 90 digits; None if too near to tell."""
    orders, claim = values["half_periods"], values["claim"]
    sign = claim["sign"]
    if sign not in (1, -1) or any(n % 2 == 0 for n in orders):
        return False
    centres = [arb(x) for x in (*values["phases"], values["amplitude"])]
    for w, r in product(*(values["model"][name] for name in ("frequency_ratio", "restitution"))):
        setting = Setting(orders, arb(w), arb(r))
        try:
            point = setting.point(centres, sign)
        except (ValueError, ZeroDivisionError):
            return False
        ends = zip(point, centres, values["radii"], strict=True)
        off = [float(abs(x - c) / arb(radius)) for x, c, radius in ends]
        if any(0.5 < x < 2 for x in off):
            return None
        if max(off) > 1 or not setting.above(point[:-1], point[-1]):
            return False
        opens, stable = setting.opening(point, sign)
        critical = "supercritical" if stable else "subcritical"
        if opens != claim["opens"] or (sign == -1 and critical != claim["criticality"]):
            return False
    return True


@every("kind", TYPES)
def test_what_opens_is_where_the_orbits_are_found(kind: str) -> None:
    with precision(300):
        assert is_true(json.loads(certificate(kind)))


def tampered(values: dict[str, Any], random: np.random.Generator) -> dict[str, Any]:
    """A certificate with one thing changed."""
    other = copy.deepcopy(values)
    model, claim = other["model"], other["claim"]
    exponent, way = random.uniform(-45, -1), int(random.choice([-1, 1]))
    size = Fraction(way * round(10 ** (exponent % 1 + 3)), 10 ** (3 - math.floor(exponent)))
    k, name = int(random.integers(len(other["phases"]))), str(random.choice(list(model)))

    def moved(text: str) -> str:
        return decimal(exact(Fraction(text) + size), 60)

    match int(random.integers(9)):
        case 0:
            model[name] = [moved(model[name][0])]
        case 1:
            model[name].append(moved(model[name][0]))
        case 2:
            other["phases"][k] = moved(other["phases"][k])
        case 3:
            other["amplitude"] = moved(other["amplitude"])
        case 4:
            other["half_periods"][k] = int(random.integers(-1, 6))
        case 5:
            claim["opens"] = int(random.integers(-1, 2))
        case 6:
            claim["sign"] = int(random.integers(-1, 2))
            claim["criticality"] = str(random.choice(["supercritical", "subcritical"]))
            if claim["sign"] == 1:
                del claim["criticality"]
        case 7:
            k = int(random.integers(len(other["radii"])))
            other["radii"][k] = f"1e{exponent:.0f}"
        case _:  # true again: the point at other parameters
            model[name] = [moved(model[name][0])]
            numbers = (arb(model[each][0]) for each in ("frequency_ratio", "restitution"))
            start = [arb(x) for x in (*other["phases"], other["amplitude"])]
            point = Setting(other["half_periods"], *numbers).point(start, claim["sign"])
            *other["phases"], other["amplitude"] = (decimal(x, 50) for x in point)
    return other


def tamper(count: int, seed: int, *arithmetics: Callable[[int], Any]) -> Counter[str]:
    """Verdicts on tampered certificates, by whether the equations say that they are true."""
    random, seen = np.random.default_rng(seed), Counter[str]()
    originals = [json.loads(certificate(kind)) for kind in TYPES]
    for number in range(count):
        with precision(300):
            values = tampered(originals[number % len(originals)], random)
            truth = is_true(values)
        for arithmetic in arithmetics:
            with precision(64):
                answer = checker.check(json.dumps(values), arithmetic)
            seen[f"{truth} {answer.split(':')[0]}"] += 1
            assert truth is not False or answer != "holds", values
            assert not truth or not answer.startswith("refused"), (answer, values)
    return seen


def test_no_false_certificate_holds() -> None:
    seen = tamper(40, 1, checker.arb)
    assert seen["False refused"] > 15
    assert seen["True holds"] > 5


@pytest.mark.slow
def test_hundreds_of_false_certificates_are_refused() -> None:
    seen = tamper(440, 2, checker.arb, checker.iv)
    assert seen["False refused"] >= 400
    assert seen["False undecided"] <= 0.3 * seen["False refused"]  # a range, too small a box
    assert seen["True holds"] >= 80


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
        for coefficient, true in zip(ours.c, mp.taylor(function, 0, 3), strict=True):
            assert abs(float(local.mid(coefficient)) - float(true)) < 1e-9


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
        checker.solved(rows, [[local.num(1)]] * 2, lambda x: abs(float(local.mid(x))))
