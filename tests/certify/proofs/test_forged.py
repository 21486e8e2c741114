"""Forged certificates of every kind: what is not in the form that is written is refused."""

import base64
import itertools
import json
import os
import subprocess
import sys
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import pi, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.proofs import base_checker, fate_checker, region_checker
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs.certificate import Certificate
from rocksteady.certify.proofs.chaos import certify_chaos
from rocksteady.certify.proofs.fate import certify_edges, certify_fate
from rocksteady.certify.proofs.files import check_certificate, program
from rocksteady.certify.proofs.region import certify_region
from rocksteady.errors import InputError
from tests.certify.proofs.test_fate import BARE, BLOCK, SHAPES, synthetic
from tests.every import every
from tests.public.test_forms import CERTIFIED, WRITTEN

KINDS = (*CERTIFIED, "box", "edge", "record")


@cache
def record() -> Certificate:
    """The certificate of a run under a record."""
    return certify_fate(BLOCK, synthetic(1, 1.2, samples=101), model="linear")


@cache
def certificate(kind: str) -> dict[str, Any]:
    """A certificate of a kind."""
    if kind in CERTIFIED:
        with zipfile.ZipFile(WRITTEN) as archive:
            text = archive.read(f"certificates/{kind}.json").decode()
    elif kind == "box":
        text = certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1).box_json("0", "2")
    elif kind == "record":
        text = record().to_json()
    else:
        pulse = rs.Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0)
        windows = rs.find_overturning_windows(BARE, pulse, [2.0], within=(1.0, 2.0))
        text = certify_edges(windows, places=12)[0].to_json()
    values: dict[str, Any] = json.loads(text)
    return values


def answer(text: str, arithmetic: str = "arb") -> str:
    with precision(64):
        given = record().samples if '"sha256"' in text else ()
        return str(base_checker.check(text, getattr(base_checker, arithmetic), given))


WRONG: tuple[Any, ...] = (
    *(
        None,
        True,
        False,
        1.5,
        -1,
        10**30,
        float("nan"),
        float("inf"),
        "",
        "nan",
        "1_0",
        " 2",
        "1e99999",
    ),
    *(
        "1/0",
        "٢",
        [],
        {},
        [None],
        [[]],
        [["3"]],
        [["22", "1"]],
        [22],
        ["nan"],
        ["1", 2],
        {"0": "2"},
    ),
)
"""Values that stand nowhere in a certificate."""


def changed(values: Any, wrong: Any) -> Iterator[tuple[Any, str]]:
    """Yield a certificate with each of its parts replaced, and which it is."""
    yield wrong, ""
    items = enumerate(values) if isinstance(values, list) else ()
    for key, part in values.items() if isinstance(values, dict) else items:
        for other, name in changed(part, wrong):
            copy = values.copy()
            copy[key] = other
            yield copy, f"{key}/{name}"


@every("kind", KINDS)
def test_what_is_not_in_its_form_is_refused_in_both_arithmetics(kind: str) -> None:
    values = certificate(kind)
    for arithmetic in ("arb", "iv"):
        if (kind, arithmetic) != ("region", "iv"):  # its boxes take ten seconds
            assert answer(json.dumps(values), arithmetic) == "holds"
        for wrong in WRONG:
            for forged, where in changed(values, wrong):
                a_number = kind in ("region", "box") and where.count("/") == 2 and wrong == 1.5
                if forged != values and not a_number and (where, wrong) != ("path/", ""):
                    found = answer(json.dumps(forged), arithmetic)
                    allowed = ("refused", "undecided") if wrong == -1 else "refused"
                    assert found.startswith(allowed), (where, wrong, found)


@every("kind", ["orbit", "point"])
def test_there_is_one_radius_and_one_flight_for_each_phase(kind: str) -> None:
    values = certificate(kind)
    for key, word in (("phases", "radius"), ("radii", "radius"), ("half_periods", "flight")):
        forged = answer(json.dumps(values | {key: values[key] * 2}))
        assert forged.startswith("refused: it has not one ")
        assert word in forged


@every("kind", KINDS)
def test_a_key_is_missing_added_or_repeated(kind: str) -> None:
    values = certificate(kind)
    for key in values:
        found = answer(json.dumps({k: v for k, v in values.items() if k != key}))
        assert found.startswith("refused"), key
    assert answer(json.dumps(values | {"title": "proved"})).startswith("refused")
    repeated = json.dumps(values)[:-1] + f', "claim": {json.dumps(values.get("claim"))}}}'
    assert "repeated" in answer(repeated) or "claim" not in values


@every(
    "name, texts",
    [
        *(("restitution", [x]) for x in ("-3", "1.5", "0", "1.0000000000000000000001")),
        *(("frequency_ratio", [x]) for x in ("-5", "0")),
        ("amplitude", ["-2"]),
        ("restitution", ["0.8", "1.1"]),
    ],
)
def test_parameters_outside_their_bounds_are_refused(name: str, texts: list[str]) -> None:
    for kind in KINDS:
        values = certificate(kind)
        if name in values["model"]:
            for arithmetic in ("arb", "iv"):
                forged = values | {"model": values["model"] | {name: texts}}
                assert answer(json.dumps(forged), arithmetic).startswith("refused")


def test_of_restitutions_below_1_no_motion_is_neutral() -> None:
    values = certificate("orbit") | {"phases": [f"{pi:.20f}"], "radii": ["1e-9"]}
    values["claim"] = {"stability": "neutral"}
    for texts, holds in ((["1"], True), (["0.999999999999", "1"], False)):
        forged = values | {"model": values["model"] | {"restitution": texts}}
        assert (answer(json.dumps(forged)) == "holds") == holds


def test_the_pieces_are_those_of_the_pulse_that_is_named() -> None:
    for shape in SHAPES:
        for reverse in (False, True):
            pulse = rs.Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0, reverse=reverse)
            known = [list(map(Fraction, x)) for x in fate_checker.pieces(shape, reverse)]
            segments = pulse.segments()[: len(known)]
            for (turns, c, d, size, speed, phase), each in zip(known, segments, strict=True):
                quarter = pi / 2
                assert abs(each.duration - turns * quarter) < 1e-12
                for share in (0.0, 0.3, 1.0):
                    t = share * each.duration
                    wave = float(size) * sin(float(speed) * t + float(phase) * quarter)
                    theirs = each.constant + each.slope * t
                    theirs += each.amplitude * sin(each.frequency * t + each.phase)
                    assert abs(float(c) + share * float(d) + wave - theirs) < 1e-12
    values = certificate("fate")
    for name in ("one-cosine", "half-sine", "ricker"):
        assert answer(json.dumps(values | {"pulse": name})).startswith("refused")
    twice = values["pieces"] * 2
    assert "pieces" in answer(json.dumps(values | {"pieces": twice}))


def test_what_is_still_to_come_is_bounded_by_its_amplitude() -> None:
    """A sine may bring back any block: 10^9 was taken for the largest acceleration."""
    back = "-2.469782737656994487102484810791626374222358656530995187568957"
    half = [["1", "1", "0", "0", "0", "0"], ["2", "0", "0", back, "1", "0"]]
    model = {"amplitude": ["1e12"], "frequency_ratio": ["2"], "restitution": ["0.8"]}
    with precision(400):
        fate, _ = fate_checker.run(fate_checker.arb(400), {"pieces": half}, [], model)
    assert fate == "stands"


def test_the_answer_states_what_was_proved(tmp_path: Path) -> None:
    file, words = (
        tmp_path / "certificate.json",
        {
            "chaos": "entropy of 0.5970 per period or more: A = 0.6, W = 2.0, restitution = 0.8",
            "fate": "the block falls: one-sine pulse, A = 2.0, W = 2.0, restitution = 0.9",
            "orbit": "one stable motion that closes after 2 impacts: A = 2.0, W = 2.0",
            "point": "one supercritical symmetry breaking after 2 impacts, open to larger A",
            "region": " of A 1.9 to 2.1, W 1.9 to 2.1: order 1, branch 1, restitution 0.8",
            "box": "stable on all of A = 1.9 to 2.0, W = 3.9 to 4.1, restitution = 0.8",
            "edge": "the block stands at A = 1.225179423268 and falls at A = 1.225179423269: ",
            "record": "the block stands: record, alpha = 0.2",
        },
    )
    for kind, claim in words.items():
        values = certificate(kind)
        file.write_text(json.dumps(values), encoding="utf-8")
        given = record().samples if kind == "record" else ()
        found = check_certificate(file, accelerations_m_s2=given, leaves=None)
        assert found.holds, found.reason
        assert claim in found.claim
        assert found.claim in str(found.describe())
        assert (found.coverage != "") == (kind == "region")


@every("kind", ["orbit", "point"])
def test_a_motion_that_is_repeated_does_not_hold(kind: str) -> None:
    """Its phases three times over are 6 impacts of a motion of 2."""
    values = certificate(kind)
    flights = len(values["half_periods"])
    names = {"phases": flights, "radii": flights, "half_periods": flights}
    times = {k: values[k][:m] * 3 + values[k][m:] for k, m in names.items()}
    for arithmetic in ("arb", "iv"):
        found = answer(json.dumps(values | times), arithmetic)
        assert found == "refused: it closes after 2" if kind == "orbit" else found != "holds"


def test_decimals_are_decimals() -> None:
    for kind in ("orbit", "chaos", "fate"):
        values = certificate(kind)
        model = values["model"] | {"amplitude": ["2/1"]}
        assert answer(json.dumps(values | {"model": model})).startswith("refused: model is not in")


def forged(halves: str, false: str, depth: int) -> str:
    """A tree over A of 1.9 to 2.1 and W of 3.9 to 4.1, all stable, whose first half says else."""
    small = ["5" * 2**k for k in range(depth)]
    rows = [[false * 2**k if k == len(halves) else "5" * 2**k for k in range(len(halves) + 1)]]
    rows.append([*small, "2" * 2**depth])
    return "5" + "".join(a + b for a, b in itertools.zip_longest(*rows, fillvalue=""))


@every("halves", ["", "555"])
def test_a_region_is_drawn_by_area(halves: str, tmp_path: Path) -> None:
    """Half of the area is false, in one box or in eight, beside a thousand boxes that are true."""
    whole = certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1)
    file = tmp_path / "region.json"
    for false, holds in (("2", True), ("3", False)):
        region = replace(whole, tree=forged(halves, false, 10))
        assert region.decided == 1.0
        file.write_text(region.to_json(), encoding="utf-8")
        for leaves in (1, 60, None):
            found = check_certificate(file, leaves=leaves)
            assert found.holds == (holds and leaves is None)
            assert found.verdict == ("refused" if not holds else found.verdict)


def test_boxes_are_drawn_as_often_as_their_area(monkeypatch: pytest.MonkeyPatch) -> None:
    """After one of two quarters the other is a third of the area that is left."""
    region = replace(certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1),
                     tree=forged("5", "2", 10))  # fmt: skip
    drawn: list[str] = []

    def holds(text: str, _: object) -> str:
        drawn.append(text)
        return "holds"

    monkeypatch.setattr(base_checker, "check", holds)
    large = 0
    for _ in range(400):
        drawn.clear()
        assert region.check(2).startswith("sampled: 2 of 1,026 boxes checked, ")
        large += len(json.loads(drawn[1])["path"]) == 2
    assert 90 <= large <= 180


def test_a_tree_that_claims_nothing_is_refused(tmp_path: Path) -> None:
    region = replace(certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1), tree="500")
    file = tmp_path / "region.json"
    file.write_text(region.to_json(), encoding="utf-8")
    assert check_certificate(file).reason == "it claims nothing"
    assert answer(region.to_json()) == "refused: it claims nothing"


def test_a_tree_that_unpacks_to_more_than_is_read_is_refused() -> None:
    whole = json.loads(certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1).to_json())
    packed = base64.b64encode(zlib.compress(b"5" * (region_checker.MOST + 1), 9)).decode()
    found = answer(json.dumps(whole | {"tree": packed}))
    assert found == "refused: its tree has more than 4000000 letters"


def test_what_is_no_file_is_refused_at_once(tmp_path: Path) -> None:
    pipe, alone = tmp_path / "pipe", tmp_path / "check.py"
    os.mkfifo(pipe)
    alone.write_text(program("region"), encoding="utf-8")
    for file in (pipe, Path("/dev/zero"), tmp_path):
        with pytest.raises(InputError, match="certificate = "):
            check_certificate(file)
        ran = subprocess.run([sys.executable, "-I", str(alone), str(file)], check=False,
                             capture_output=True, text=True)  # fmt: skip
        assert (ran.returncode, "is no file" in ran.stderr) == (2, True)


def test_the_program_prints_the_share_of_each_letter(tmp_path: Path) -> None:
    region = replace(certify_region((1.9, 2.1), (3.9, 4.1), 0.8, most_boxes=1), tree="520")
    file, alone = tmp_path / "region.json", tmp_path / "check.py"
    alone.write_text(program("region"), encoding="utf-8")
    file.write_text(region.to_json(), encoding="utf-8")
    ran = subprocess.run([sys.executable, "-I", str(alone), str(file)], check=False,
                         capture_output=True, text=True)  # fmt: skip
    assert (ran.returncode, "0 0.5 1 0 2 0.5 3 0 4 0" in ran.stdout) == (0, True)


def test_the_programs_alone_refuse_forgeries_in_one_line(tmp_path: Path) -> None:
    file, alone = tmp_path / "forged.json", tmp_path / "check.py"
    for kind, change in (
        ("orbit", {"half_periods": [["22", "1"]]}),
        ("fate", {"model": certificate("fate")["model"] | {"amplitude": "22"}}),
    ):
        alone.write_text(program(kind), encoding="utf-8")
        for flags in ([], ["--arithmetic", "iv"]):
            file.write_text(json.dumps(certificate(kind) | change), encoding="utf-8")
            command = [sys.executable, "-I", str(alone), *flags, str(file)]
            ran = subprocess.run(command, check=False, capture_output=True, text=True)
            assert (ran.returncode, ran.stderr) == (1, "")
            assert "refused: " in ran.stdout
    command = [sys.executable, "-I", str(alone), str(tmp_path / "none")]
    ran = subprocess.run(command, check=False, capture_output=True, text=True)
    assert ran.returncode == 2
    assert "Traceback" not in ran.stderr


@every("wrong", [True, False])
def test_a_truth_value_is_no_number(wrong: bool) -> None:
    for given in (wrong, np.bool_(wrong)):
        for numbers in ((given, 2, 0.8), (2, given, 0.8), (2, 2, given), ((1, given), 2, 0.8)):
            with pytest.raises(rs.errors.InputError):
                certify_chaos(*numbers)
        for ranges in (((given, 2.0), (1.0, 2.0), 0.8), ((1.0, 2.0), (given, 2.0), 0.8)):
            with pytest.raises(rs.errors.InputError):
                certify_region(*ranges)
        with pytest.raises(rs.errors.InputError):
            certify_region((1.0, 2.0), (1.0, 2.0), given)  # type: ignore[arg-type]
