"""A leaf is deleted with its folder: the rest is imported, lists its commands, and answers."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rocksteady.cli._registration import GROUPS
from rocksteady.leaves import LEAVES

PACKAGE = Path(__file__).parents[1] / "src" / "rocksteady"
LINES = (
    "--help",
    "simulate --width-m 0.5 --height-m 2 --pulse one-sine --accel-g 0.4 --freq-hz 1 --json",
    "attractor -A 2 -W 1.9 -r 0.8 --json",
    "screens --width-m 0.5 --height-m 2 --pga-g 0.3 --json",
)
PROGRAM = """
import contextlib, io, json, sys
import rocksteady
from rocksteady.cli.app import run
answers = []
for line in sys.argv[1:]:
    with contextlib.redirect_stdout(io.StringIO()) as out:
        answers.append((run(line.split()), out.getvalue()))
print(json.dumps([rocksteady.__file__, answers]))
"""


@pytest.fixture(scope="module")
def whole() -> list[tuple[int, str]]:
    """What the whole package answers."""
    return answers(PACKAGE.parent)


def answers(folder: Path) -> list[tuple[int, str]]:
    """Return exit code and output of each line, by the package in a folder."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *LINES],
        env={**os.environ, "PYTHONPATH": str(folder)},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    place, listed = json.loads(done.stdout)
    assert Path(place).is_relative_to(folder)
    return [(code, text) for code, text in listed]


@pytest.mark.parametrize("leaf", LEAVES)
def test_without_a_leaf_the_rest_answers_as_before(
    leaf: str, whole: list[tuple[int, str]], tmp_path: Path
) -> None:
    copy = tmp_path / PACKAGE.name
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.rmtree(copy / leaf)
    (copy / leaf / "__pycache__").mkdir(parents=True)  # as git leaves it behind
    (shown, *others), (_, *expected) = answers(tmp_path), whole
    commands = {
        name.partition(" ")[0]
        for places in GROUPS.values()
        for name, place in places.items()
        if not place.startswith(f"{leaf}.")
    }
    assert {*re.findall(r"^  ([a-z-]+)  ", shown[1], re.MULTILINE)} == commands
    assert shown[0] == 0
    assert others == expected
