"""Styles of the terminal: by role, on a terminal alone, and hues for verdicts alone."""

import os
import pty
import re
import subprocess
import sys
from dataclasses import fields

import pytest
from rich.color import ColorType
from rich.style import Style

from rocksteady.cli.console._styles import HELP, PARTS, STYLES
from rocksteady.results.rendering import ROLES
from rocksteady.show.style.tokens import Inks
from tests.every import every

VERDICTS = {"green", "amber", "red"}
HUES = re.compile(r"\x1b\[(?:[\d;]*;)?(?:3[1-7]|9[1-7]|38;[\d;]+)(?:;[\d;]*)?m")
OWN = ("NO_COLOR", "FORCE_COLOR", "TTY_COMPATIBLE", "COLORTERM")


def on_terminal(*arguments: str, **environment: str) -> str:
    """Return what a command writes to a terminal of 80 columns."""
    ours, theirs = pty.openpty()
    kept = {name: value for name, value in os.environ.items() if name not in OWN}
    with subprocess.Popen(
        [sys.executable, "-m", "rocksteady", *arguments],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env={**kept, "TERM": "xterm-256color", "COLUMNS": "80", **environment},
    ):
        os.close(theirs)
        seen = b""
        try:
            while part := os.read(ours, 4096):
                seen += part
        except OSError:  # the other end is closed
            pass
        finally:
            os.close(ours)
    return seen.decode("utf-8").replace("\r\n", "\n")


def test_styles_are_those_of_roles() -> None:
    roles = {each.name for each in fields(Inks)}
    assert {"falls", "rest", "undecided"} <= roles & set(STYLES)
    assert set(ROLES) <= set(STYLES)


def test_hues_are_for_verdicts_alone() -> None:
    for role, words in {**STYLES, **PARTS, **HELP}.items():
        colour = Style.parse(words).color
        if role in VERDICTS:
            assert colour is not None, role
            assert colour.type is ColorType.STANDARD, "or a paper may make it illegible"
        elif colour is not None and not colour.is_default:
            red, green, blue = colour.get_truecolor()
            assert red == green == blue, role


@pytest.mark.slow
def test_a_terminal_shows_an_answer_in_the_styles_of_its_roles() -> None:
    text = on_terminal("attractor", "-A", "2", "-W", "1.9", "-r", "0.8")
    sentence, *rows, follow_up = text.splitlines()
    assert sentence.startswith("\x1b[1mIt settles")
    assert all(row.startswith("  \x1b[2m") for row in rows)
    assert follow_up.startswith("\x1b[4mnext:\x1b[0m rocksteady")
    assert not HUES.search(text)


@pytest.mark.slow
def test_a_verdict_has_a_hue_beside_its_word() -> None:
    assert "\x1b[31mred\x1b[0m: target 10 %" in on_terminal("assess", "--example")
    facade = on_terminal("facade", "--example")
    hues = HUES.findall(facade)
    assert len(hues) == facade.count("not satisfied\x1b") > 0


@pytest.mark.slow
@every("environment", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
@every("command", ["attractor -A 2 -W 1.9 -r 0.8", "attractor --help-all"])
def test_no_styles_where_they_are_not_wanted(environment: dict[str, str], command: str) -> None:
    arguments = command.split()
    assert "\x1b" in on_terminal(*arguments)
    assert "\x1b" not in on_terminal(*arguments, **environment)


@pytest.mark.slow
def test_help_of_all_flags_has_no_hue() -> None:
    assert not HUES.search(on_terminal("attractor", "--help-all"))


@pytest.mark.slow
def test_a_pipe_has_no_styles() -> None:
    ran = subprocess.run(
        [sys.executable, "-m", "rocksteady", "attractor", "-A", "2", "-W", "1.9", "-r", "0.8"],
        capture_output=True,
        text=True,
        check=True,
        env={name: value for name, value in os.environ.items() if name not in OWN},
    )
    assert "It settles" in ran.stdout
    assert "\x1b" not in ran.stdout + ran.stderr
