"""The command that follows an answer is one that the program takes: its flags and values exist."""

import re
import shlex
from pathlib import Path

import typer

from rocksteady.cli import app
from tests.every import every

RECORDED = Path(__file__).parents[1] / "frozen" / "commands.txt"
"""What every example printed."""
FOLLOWING = sorted(
    {
        re.sub(r" \\\n +", " ", found)
        for found in re.findall(
            r"^  next: rocksteady ((?:.*\\\n)*.*)",
            RECORDED.read_text(encoding="utf-8"),
            re.MULTILINE,
        )
    }
)
COMMANDS = typer.main.get_command(app.app).commands  # type: ignore[attr-defined]


def test_most_examples_are_followed_by_a_command() -> None:
    assert len(FOLLOWING) > 50
    assert len({line.split()[0] for line in FOLLOWING}) > 10


@every("line", FOLLOWING)
def test_every_flag_of_a_command_that_follows_exists(line: str) -> None:
    name, *arguments = shlex.split(line)
    command = COMMANDS[name]
    context = typer.Context(command, info_name=name)
    values, rest, given = command.make_parser(context).parse_args(arguments)
    assert rest == []
    assert given or not arguments
    assert values.keys() <= {param.name for param in command.params} | {"help"}
