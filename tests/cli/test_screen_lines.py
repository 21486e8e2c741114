"""The screen of every example: eight lines of 80 columns, and a command that follows and runs."""

import re
import shlex
import tempfile
from pathlib import Path

import pytest

from rocksteady.cli.flags import groups
from rocksteady.results import rendering
from rocksteady.results.description import Description
from rocksteady.results.rendering import MOST_LINES, MOST_ROWS, WIDTH
from tests.cli.program import rocksteady
from tests.manual.lines import shortened
from tests.outputs import unrendered
from tests.show.assessment.pages import drawn_once
from tools.freeze.commands import examples, fresh

LONG = re.compile(
    r"^(?:attractor -A 6|assess --example|basins --width-m|calibrate --example"
    r"|calibrate --tests .* --records|curves -W|edge -A (?:2|0\.5)|bifurcate -A 0\.1)"
)
"""Examples that take more than some three seconds with what follows them."""
ELSEWHERE = re.compile(r"^(?:paper|study) |--json|--animate")
"""Those that take minutes, whose own tests look at their screens, and those without a screen."""
ROWS = re.compile(r"^(?:screens|facade|record|restitution|assess) ")
"""Commands whose rows are the answer."""
LINES = [line for line in dict.fromkeys(map(shortened, examples())) if not ELSEWHERE.search(line)]
QUICK = {line.split()[0]: line for line in reversed(LINES) if not LONG.search(line)}
"""The first example of each command that is not long; the others are slow tests."""


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "line",
    [
        pytest.param(line, id=line, marks=[pytest.mark.slow] * (line not in QUICK.values()))
        for line in LINES
    ],
)
def test_a_screen_is_eight_lines_and_what_follows_it_runs(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fresh(tmp_path, line)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(groups, "print_answer", seen := Seen())
    words = shlex.split(line) + ["--no-browser"] * line.startswith("explore")
    with unrendered(), drawn_once():  # their own tests look at pictures
        ran = rocksteady("", *words)
    assert ran.code in (0, 3), ran.err  # 3 is no answer yet
    (answer,) = seen.answers
    lines, rows = ran.out.splitlines(), len(answer.rows)
    assert rows <= MOST_ROWS * bool(ROWS.search(line))
    assert len(lines) <= MOST_LINES + rows, ran.out
    widths = [len(line) for line in lines if str(tmp_path) not in line]  # a path is not broken
    assert max(widths) <= WIDTH, ran.out
    program, *follows = shlex.split(answer.follow_up) or [""]
    if program == "rocksteady":
        with unrendered(), drawn_once():
            after = rocksteady("", *follows)
        assert after.code in (0, 3), after.err
    elif program:
        assert (program, *follows[:-1]) == ("python3", "-m", "webbrowser")
        assert Path(follows[-1]).is_file()


class Seen:
    """Prints answers, and keeps them."""

    def __init__(self) -> None:
        self.answers: list[Description] = []
        self.printed = rendering.print_answer

    def __call__(self, answer: Description, console: object) -> None:
        """Print an answer."""
        self.answers.append(answer)
        self.printed(answer, console)  # type: ignore[arg-type]


def test_most_examples_are_followed_by_a_command() -> None:
    assert len(LINES) > 70
