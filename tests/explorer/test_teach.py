"""The teacher's kit: its links are states of the page, its solutions commands that run."""

import re
import shlex
from pathlib import Path

import pytest

from tests.cli.program import rocksteady
from tests.every import every
from tests.explorer.in_node import InNode

TEACH = Path(__file__).parents[2] / "docs" / "teach"
PAGES = "\n".join(page.read_text(encoding="utf-8") for page in sorted(TEACH.glob("*.md")))
LINKS = re.findall(r"`(#v=1[^`]*)`", PAGES)
COMMANDS = sorted(set(re.findall(r"^rocksteady (.*)$", PAGES, re.MULTILINE)))


def test_ten_exercises_have_a_link_and_a_solution_each() -> None:
    exercises = re.split(
        r"^## ", (TEACH / "exercises.md").read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    assert len(exercises) == 11
    for exercise in exercises[1:]:
        assert re.search(r"`#v=1&[^`]+`", exercise), exercise
        assert re.search(r"^(rocksteady |import rocksteady)", exercise, re.MULTILINE), exercise


def test_the_page_takes_each_link_whole(in_node: InNode) -> None:
    lines = """
    const { stateOfLink } = await import(parts('shell/link.mjs'));
    answer(asked.map((link) => stateOfLink(link)?.ignored ?? ['no state']));
    """
    assert len(LINKS) > 15
    for link, ignored in zip(LINKS, in_node(lines, LINKS), strict=True):
        assert ignored == [], link


@pytest.mark.slow
@every("line", COMMANDS)
def test_each_command_runs(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    ran = rocksteady("", *shlex.split(line))
    assert ran.code == 0, ran.err


@pytest.mark.slow
def test_the_script_says_what_the_scene_says(capsys: pytest.CaptureFixture[str]) -> None:
    (script,) = re.findall(r"```python\n(.*?)```", PAGES, re.DOTALL)
    exec(script, {})
    assert "0.5 falls 11 of 26 neighbours fall" in capsys.readouterr().out
