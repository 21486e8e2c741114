"""Help in three sizes: each fits its screen, and each word in it stands in the larger one."""

import re

import pytest
import typer

from rocksteady.cli import app
from rocksteady.cli._registration import questions
from rocksteady.cli.console.help import MOST
from tests.cli.program import rocksteady
from tests.every import every

COMMANDS = {
    name: command
    for name, command in typer.main.get_command(app.app).commands.items()  # type: ignore[attr-defined]
    if name != "study"
}
LINES = 60
"""Most lines of the short help of a command."""


@every("name", COMMANDS)
def test_short_help_shows_at_most_ten_flags_and_names_the_long_one(name: str) -> None:
    ran = rocksteady(f"{name} --help")
    assert (ran.code, ran.err) == (0, "")
    lines = ran.out.rstrip().splitlines()
    assert len(lines) <= LINES
    shown = [line for line in lines if re.match(r"  \S", line)]
    main = COMMANDS[name].shown
    if main:
        assert len(shown) == len(main) <= MOST
        assert f"All {len(COMMANDS[name].params)} options: rocksteady {name} --help-all" in lines
        assert max(map(len, lines[:-2])) <= 80
    assert lines[0] == (COMMANDS[name].help or "").split("\n\n")[0] or not main


@every("name", COMMANDS)
def test_both_names_of_help_show_the_same(name: str) -> None:
    assert rocksteady(f"{name} -h").out == rocksteady(f"{name} --help").out


def test_the_program_lists_every_command_once_in_80_columns() -> None:
    lines = rocksteady("--help").out.rstrip().splitlines()
    listed = [line.split()[0] for line in lines if line.startswith("  ")]
    assert sorted(listed) == sorted([*COMMANDS, "study"])
    assert max(map(len, lines)) <= 80
    assert all(line.endswith((".", ")", "s")) for line in lines if line.startswith("  "))


def test_the_program_alone_shows_questions_with_commands_that_exist() -> None:
    ran = rocksteady("")
    assert (ran.code, ran.err) == (0, "")
    assert ran.out.rstrip() == questions(app.COMMANDS)
    assert max(map(len, ran.out.splitlines())) <= 80
    assert len(ran.out.rstrip().splitlines()) <= 12


@pytest.mark.slow
def test_the_questions_of_the_program_run() -> None:
    text = questions(app.COMMANDS).replace("\\\n", " ")
    commands = re.findall(r"  rocksteady (.*)", text)
    runnable = [each for each in commands if "FILE" not in each and each != "explore"]
    assert len(runnable) == 5
    for command in runnable:
        ran = rocksteady(command)
        assert ran.code == 0, (command, ran.err)
