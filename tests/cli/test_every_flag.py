"""Each flag of each command is used once at least: here, in a recorded line, or by a test."""

import ast
import math
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from rocksteady.cli.console import progress
from rocksteady.leaves import LEAVES
from tools.freeze.commands import flag_lines, freeze_line, program
from tools.freeze.records import FILE, FOLDER, apart, dumped, loaded

LITERALS = ("tests/cli", *(f"tests/{leaf}" for leaf in LEAVES), "tests/installation")
"""Folders of tests whose texts count as lines where they begin with a command."""
OF_A_PROCESSOR = (".svg", ".html", ".zarr")
"""Files whose hash alone is recorded, which the last bit of a number changes."""
SHORT = re.compile(r"-[A-Za-z](?=[\d.-])")
"""A flag of one letter that its value follows, as -A0.5."""


@cache
def commands() -> dict[str, Any]:
    """Return the commands by their paths."""
    every: dict[str, Any] = {}
    groups: list[tuple[str, Any]] = [("", program())]
    for path, group in groups:
        for name, command in group.commands.items():
            whole = f"{path} {name}".strip()
            if hasattr(command, "commands"):
                groups.append((whole, command))
            else:
                every[whole] = command
    return every


def flags(command: Any) -> dict[str, tuple[str, ...]]:
    """Return the flags of a command, each with its parameter's."""
    names = [tuple(each.opts) for each in command.params if each.opts[0].startswith("-")]
    return {name: every for every in names for name in every}


def used(line: str) -> set[tuple[str, str]]:
    """Return the flags that a line uses, each with its command; none of what is no line."""
    words = re.split(r"[\s'\"]+", line)
    for count in (2, 1):
        if (path := " ".join(words[:count])) in commands():
            known = flags(commands()[path])
            names = {short.group() if (short := SHORT.match(word)) else word for word in words}
            names = {name.partition("=")[0] for name in names}
            return {(path, flag) for name in names & known.keys() for flag in known[name]}
    return set()


@cache
def recorded() -> dict[str, str]:
    """Return what is recorded of lines, by line and file."""
    files = [FOLDER / f"{part}.txt" for part in ("commands", "long-commands")]
    return {name: text for file in files for name, text in loaded(file.read_text("utf-8")).items()}


def literals() -> Iterator[str]:
    """Yield the texts of tests and of their calls, as far as they are fixed."""
    for file in (file for folder in LITERALS for file in Path(folder).rglob("*.py")):
        module = ast.parse(file.read_text(encoding="utf-8"))
        constants: dict[str, str] = {}
        for node in module.body:
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                constants[node.targets[0].id] = fixed(node.value, constants)
        for part in ast.walk(module):
            words = part.args if isinstance(part, ast.Call) else [part]
            yield " ".join(fixed(word, constants) for word in words)


def fixed(node: ast.AST, constants: dict[str, str]) -> str:
    """Return what is fixed of a text: all, or of a formatted one what no variable stands for."""
    if isinstance(node, ast.JoinedStr):
        return "".join(fixed(part, constants) for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return fixed(node.value, constants)
    if isinstance(node, ast.Name):
        return constants.get(node.id, " ")
    value = getattr(node, "value", " ") if isinstance(node, ast.Constant) else " "
    return value if isinstance(value, str) else " "


def test_each_flag_of_each_command_is_used() -> None:
    lines = [name.partition(FILE)[0] for name in recorded()]
    known = {pair for line in (*lines, *literals()) for pair in used(line)}
    unused = [
        f"{path} {'/'.join(names)}"
        for path, command in commands().items()
        for names in dict.fromkeys(flags(command).values())
        if not any((path, name) in known for name in names)
    ]
    assert unused == [], "use it in tests/cli/every_flag/lines.txt"


@pytest.mark.parametrize("line", flag_lines())
def test_a_line_answers_as_recorded(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("QUIET", "LINE_AFTER"):  # of a slow machine too, as where lines are recorded
        monkeypatch.setattr(progress, name, math.inf)
    now = loaded(dumped(dict(freeze_line(line))))
    before = {name: text for name, text in recorded().items() if name.partition(FILE)[0] in now}
    assert before.keys() == now.keys()
    texts = [name for name in now if not name.partition(FILE)[2].endswith(OF_A_PROCESSOR)]
    differences = [words for name in texts if (words := apart(before[name], now[name]))]
    assert differences == [], "where that is meant: python -m tools.freeze record commands"
