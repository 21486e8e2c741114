"""No command line ends in another's exception, a hang, a NaN, or a refusal of several lines."""

import random
import re
import shlex
from pathlib import Path

import pytest

from tests.cli.fuzz import COMMANDS, command_line, fault, fill, run_apart, run_here

SHARDS, LINES = 2, 100
"""Each shard is drawn from its own seed, the same in each run."""
SLOW_LINES = 150
LONG = re.compile(r"^(?:calibrate|fragility) .*--example|^study atlas ")
"""Lines that take seconds where nothing is wrong with them."""
PROCESSES = 2


def found(seed: int, lines: int, *, long: bool) -> list[str]:
    """Return the faults of some command lines in this process, `long` ones among them or not."""
    draw, wrong = random.Random(seed), []
    for number in range(lines):
        arguments = command_line(draw, number)
        if not long and LONG.search(shlex.join(arguments)):
            continue
        what = fault(arguments, *(ran := run_here(arguments)))
        if what:
            wrong.append(f"{what}: {shlex.join(arguments)}\n{ran[2][-500:]}")
    return wrong


def found_apart(seed: int, lines: int, folder: Path) -> list[str]:
    """Return the faults of some command lines as processes."""
    draw, wrong = random.Random(seed), []
    for number in range(lines):
        arguments = command_line(draw, number)
        what = fault(arguments, *(ran := run_apart(draw, arguments, folder)))
        if what:
            wrong.append(f"{what}: {shlex.join(arguments)}\n{ran[2][-500:]}")
    return wrong


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    fill(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BROWSER", "true")  # which shows no page
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path


pytestmark = [
    pytest.mark.filterwarnings("ignore:Glyph"),
    # One line on standard error; as an error it would be another's.
    pytest.mark.filterwarnings("ignore:.*sizes are in metres"),
]


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("seed", range(SHARDS))
def test_no_command_line_ends_in_another_way(seed: int) -> None:
    assert found(seed, LINES, long=False) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1000, 1000 + PROCESSES))
def test_no_process_ends_in_another_way(seed: int, folder: Path) -> None:
    assert found_apart(seed, 10, folder) == []


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
def test_no_command_line_of_many_ends_in_another_way() -> None:
    assert found(2000, SLOW_LINES, long=True) == []


def test_every_command_and_every_flag_is_drawn() -> None:
    draw = random.Random(0)
    drawn = [command_line(draw, number) for number in range(12_000)]
    for path, command in COMMANDS.items():
        words = path.split()
        mine = {
            word.partition("=")[0]
            for line in drawn
            if line[: len(words)] == words
            for word in line[len(words) :]
        }
        missing = {
            option.opts[0]
            for option in command.params
            if option.param_type_name == "option" and not mine & set(option.opts)
        }
        assert missing == set(), path
