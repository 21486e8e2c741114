"""The standalone program: alone, in two arithmetics, and no false certificate passes."""

import ast
import copy
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.proofs import checker
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs.files import program
from rocksteady.certify.proofs.orbit import certify_orbit
from tests.certify.proofs.test_orbit import closed_form
from tests.every import every
from tools.count import code_lines

CASES = (("2", "2", "0.8", 1), ("6", "4", "0.8", 1), ("2", "6", "0.8", 3), ("0.75", "4", "0.5", 1))


def certificate(amplitude: str, ratio: str, restitution: str, order: int) -> dict[str, Any]:
    block = rs.DimensionlessBlock(restitution=float(restitution))
    motion = rs.Harmonic(amplitude=float(amplitude), frequency_ratio=float(ratio))
    found = rs.find_orbits(block, motion, max_period=order, seeds=2)
    orbit = next(each for each in found if each.branch == 1 and each.period == order)
    values: dict[str, Any] = json.loads(certify_orbit(orbit).to_json())
    return values


def verdict(values: dict[str, Any], arithmetic: Any = checker.arb) -> str:
    with precision(64):
        return str(checker.check(json.dumps(values), arithmetic))


@every(
    "kind, longest",
    [("orbit", 201), ("region", 211), ("fate", 307), ("chaos", 261), ("point", 279)],
)
def test_the_programs_import_nothing_of_the_package_and_are_short(kind: str, longest: int) -> None:
    source = program(kind)
    names = {
        name
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in (
            [node.module] if isinstance(node, ast.ImportFrom) else [a.name for a in node.names]
        )
    }
    assert not any("rocksteady" in str(name) for name in names)
    assert code_lines(source) <= longest


@every("bits", [0, 128])
def test_the_precision_is_never_below_64_bits(bits: int) -> None:
    for arithmetic in (checker.arb, checker.iv):
        assert verdict(certificate(*CASES[0]) | {"bits": bits}, arithmetic) == "holds"


@every("case", CASES)
def test_both_arithmetics_accept_what_is_proved(case: tuple[str, str, str, int]) -> None:
    values = certificate(*case)
    assert verdict(values) == "holds"
    assert verdict(values, checker.iv) == "holds"


def is_true(values: dict[str, Any]) -> bool | None:
    """Whether a certificate of a symmetric motion is true, by the closed form; None if too near."""
    n = values["half_periods"][0]
    if n % 2 == 0 or n < 1:
        return False
    inside, stable = set(), set()
    with mp.workdps(60):
        for a in values["model"]["amplitude"]:
            for r in values["model"]["restitution"]:
                if not 0 < mp.mpf(r) < 1:
                    return False
                try:
                    phase, trace = closed_form(a, values["model"]["frequency_ratio"][0], r, n)
                except (AttributeError, TypeError, ValueError, ZeroDivisionError):
                    return False  # no solution
                off = abs(phase - mp.mpf(values["phases"][0]))
                radius = abs(mp.mpf(values["radii"][0]))
                if radius > 0 and 0.5 < off / radius < 2:
                    return None
                inside.add(bool(off < radius))
                limit = 1 + mp.mpf(r) ** 2
                if abs(abs(trace) - limit) < 1e-9:
                    return None
                stable.add("stable" if abs(trace) < limit else "unstable")
    return inside == {True} and stable == {values["claim"]["stability"]}


def tampered(values: dict[str, Any], random: np.random.Generator) -> dict[str, Any]:
    """A certificate with one thing changed."""
    other = copy.deepcopy(values)
    size = 10.0 ** random.uniform(-24, -1) * random.choice([-1, 1])

    def moved(text: str) -> str:
        return str(mp.nstr(mp.mpf(text) + mp.mpf(size), 40, strip_zeros=False))

    with mp.workdps(60):
        kind = int(random.integers(6))
        if kind in (0, 1):
            name = ("amplitude", "restitution")[kind]
            other["model"][name] = [moved(text) for text in other["model"][name]]
        elif kind == 2:
            other["phases"] = [moved(other["phases"][0])]
        elif kind == 3:
            other["half_periods"] = [int(random.integers(-1, 6))]
        elif kind == 4:
            flipped = {"stable": "unstable", "unstable": "stable"}
            other["claim"]["stability"] = flipped[other["claim"]["stability"]]
        else:
            other["radii"] = [mp.nstr(mp.mpf(10) ** random.uniform(-16, -9), 5)]
    return other


def tamper(count: int, seed: int) -> dict[str, int]:
    """Verdicts on tampered certificates, by whether the closed form says that they are true."""
    random = np.random.default_rng(seed)
    originals = [certificate(*case) for case in CASES]
    seen: dict[str, int] = {}
    for number in range(count):
        values = tampered(originals[number % len(originals)], random)
        truth = is_true(values)
        if truth is None:
            continue
        found = verdict(values).split(":")[0]
        key = f"{'true' if truth else 'false'} {found}"
        seen[key] = seen.get(key, 0) + 1
        assert truth or found != "holds", values
    return seen


def test_no_false_certificate_holds() -> None:
    seen = tamper(120, 1)
    assert seen.get("false holds", 0) == 0
    assert seen["false refused"] > 50
    assert seen["true holds"] > 5


@pytest.mark.slow
def test_a_thousand_false_certificates_are_refused() -> None:
    seen = tamper(2000, 2)
    assert seen.get("false holds", 0) == 0
    assert seen["false refused"] >= 1000
    assert seen.get("false undecided", 0) <= 0.02 * seen["false refused"]
    assert seen["true holds"] >= 100


def test_the_file_runs_alone_with_its_exit_codes(tmp_path: Path) -> None:
    alone = tmp_path / "check.py"
    alone.write_text(program("orbit"), encoding="utf-8")
    values = certificate(*CASES[0])
    good, bad = tmp_path / "good.json", tmp_path / "bad.json"
    good.write_text(json.dumps(values), encoding="utf-8")
    bad.write_text(json.dumps(values | {"claim": {"stability": "unstable"}}), encoding="utf-8")
    for flags in ([], ["--arithmetic", "iv"]):
        for file, code in ((good, 0), (bad, 1)):
            command = [sys.executable, "-I", str(alone), *flags, str(file)]
            assert subprocess.run(command, check=False, capture_output=True).returncode == code
