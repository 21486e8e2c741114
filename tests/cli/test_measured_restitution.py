"""--restitution housner*0.9 means the same number in every command that takes it."""

import json
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Block
from tests.cli.motion_files import at2, samples
from tests.cli.program import rocksteady

BLOCK = Block.rectangle(width=0.4, height=2.0)
SIZE = "--width-m 0.4 --height-m 2"
NUMBER = repr(0.9 * BLOCK.restitution)
SHAKING = "--accel-g 0.3 --freq-hz 2"


@pytest.fixture(autouse=True)
def record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    at2(tmp_path / "a.at2", samples()[:60])


@pytest.mark.parametrize(
    "line",
    [
        f"simulate {SIZE} {SHAKING}",
        f"simulate {SIZE} --record a.at2",
        f"steady {SIZE} {SHAKING}",
        f"attractor {SIZE} {SHAKING}",
        f"orbits {SIZE} {SHAKING} --max-period 1 --max-impacts 2 --seeds 5",
        f"basins {SIZE} {SHAKING} --angles=-1:1:3 --velocities=-0.3:0.3:3 --cycles 20",
        f"map {SIZE} --accel-g 0.2:0.4:2 --freq-hz 2 --cycles 20",
        f"overturn {SIZE} --pulse half-sine --freq-hz 1:2:2 --accel-g 0.1:1",
        f"screens {SIZE} --pga-g 0.3",
        "spectrum --record a.at2 --width-m 0.4 --height-m 2",
    ],
)
def test_a_factor_gives_what_its_number_gives(line: str) -> None:
    found = []
    for form in ("housner*0.9", NUMBER):
        ran = rocksteady("", *line.split(), "--restitution", form, "--json")
        assert ran.code in (0, 3), ran.err
        found.append(_numbers(json.loads(ran.out)))
    assert found[0] == found[1]
    assert len(found[0]) > 3


def _numbers(value: object) -> list[float]:
    """Return all numbers of a JSON object in order, but for times of the clock and the form."""
    if isinstance(value, dict):
        named = {key: each for key, each in value.items() if key not in SKIPPED}
        return [number for each in named.values() for number in _numbers(each)]
    if isinstance(value, list):
        return [number for each in value for number in _numbers(each)]
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    return [float(value)] if plain else []  # type: ignore[arg-type]


SKIPPED = {"seconds", "housner_factor", "restitution"}


def test_over_slendernesses_each_block_has_its_own() -> None:
    flags = ("--record", "a.at2", "--alpha-rad", "0.2:0.3:2", "--periods-s", "2", "--json")
    found = json.loads(rocksteady("spectrum", *flags, "-r", "housner*0.9").out)
    assert found["restitution"] == "housner*0.9"
    for alpha in (0.2, 0.3):
        block = Block.from_p(alpha=alpha, p=np.pi)
        single = ("--record", "a.at2", "--alpha-rad", str(alpha), "--periods-s", "2", "--json")
        ran = rocksteady("spectrum", *single, "-r", repr(0.9 * block.restitution))
        (row,) = json.loads(ran.out)["values"]
        own = [each for each in found["values"] if each["alpha_rad"] == alpha]
        assert [each["peak"] for each in own] == [row["peak"]]


def test_an_axis_of_widths_keeps_the_form() -> None:
    flags = ("--width-m", "0.4:0.8:2", "--height-m", "2", *SHAKING.split(), "--json")
    ran = rocksteady("map", *flags, "--cycles", "20", "-r", "housner*0.9")
    assert ran.code in (0, 3), ran.err
    assert json.loads(ran.out)["restitution"] == "housner*0.9"
