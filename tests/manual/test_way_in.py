"""The way in: README, start page and lists of pages are short, and lead to each answer."""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from typer.main import get_command

from rocksteady.cli.app import app
from tests.cli.program import rocksteady
from tests.every import every

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
START = DOCS / "index.md"
PAGES = (
    START,
    *sorted((DOCS / "start").glob("*.md")),
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
)
COMMANDS = set(getattr(get_command(app), "commands", ()))

LINK = re.compile(r"\]\((?!https?:|mailto:)([^)\s#]*)(?:#([^)\s]*))?\)")
CARD = re.compile(r"^:link: (\S+)$", re.MULTILINE)
DOC = re.compile(r"\{doc\}`(?:[^`<]*<)?([^`<>]+)>?`")
TOCTREE = re.compile(r"^```\{toctree\}\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FENCED = re.compile(r"^```(?!\{toctree\}).*?^```$", re.MULTILINE | re.DOTALL)
INCLUDE = re.compile(r"^```\{include\} (\S+)$", re.MULTILINE)

GENERATED = {
    DOCS / "gallery" / "index.rst",
    *(DOCS / "reference" / "commands" / f"{command}.md" for command in COMMANDS),
}
"""What the build of the manual writes."""


def page_of(name: str, page: Path) -> Path:
    """Return the file that a card, a toctree or a role names without its ending."""
    base = DOCS / name.lstrip("/") if name.startswith("/") else page.parent / name
    for ending in (".md", ".rst"):
        found = base.with_name(base.name + ending).resolve()
        if found.exists() or found in GENERATED:
            return found
    return base.with_name(base.name + ".md").resolve()


@cache
def targets(page: Path) -> tuple[Path, ...]:
    """Return the files that a page links, in sentences, on cards and in lists of pages."""
    return tuple(_targets(page))


def _targets(page: Path) -> Iterator[Path]:
    text = page.read_text(encoding="utf-8")
    for included in INCLUDE.findall(text):
        yield (page.parent / included).resolve()
    for tree in TOCTREE.findall(text):
        for line in tree.splitlines():
            if ":glob:" in tree and "*" in line:
                yield from (each.resolve() for each in sorted(page.parent.glob(f"{line}.md")))
            elif line and not line.startswith(":"):
                yield page_of(line, page)
    text = TOCTREE.sub("", text)
    for name in (*CARD.findall(text), *DOC.findall(text)):
        yield page_of(name, page)
    for path, _ in LINK.findall(FENCED.sub("", text)):
        if path:
            yield (page.parent / path).resolve()


def clicks(goal: Path) -> int:
    """Return how many links lie between the start page and a page of the manual."""
    seen, edge, steps = {START}, {START}, 0
    while goal not in edge:
        steps += 1
        edge = {
            target
            for page in edge
            if page.suffix == ".md" and page.exists()
            for target in targets(page)
            if target.is_relative_to(DOCS)
        } - seen
        assert edge, f"no link leads to {goal}"
        seen |= edge
    return steps


def row_of(question: str) -> str:
    """Return the row of the page of questions that has some words."""
    page = (DOCS / "start" / "questions.md").read_text(encoding="utf-8")
    (row,) = (line for line in page.splitlines() if line.startswith("|") and question in line)
    return row


# ------------------------------------------------------------------------------------ how long


def test_the_readme_can_be_read_in_five_minutes() -> None:
    assert len((ROOT / "README.md").read_text(encoding="utf-8").split()) <= 1050


def test_the_lines_of_the_readme_print_what_stands_beside_them(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (lines,) = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    exec(lines, {})
    assert lines.rpartition("# ")[2] == capsys.readouterr().out


def readme_answers() -> list[tuple[str, str]]:
    """Return the commands in the table of the README, each with the answer beside it."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(r"^\| .*\? \| `rocksteady (.*)` \| (.*) \|$", text, re.MULTILINE)


@pytest.mark.parametrize(
    ("command", "answer"),
    [
        pytest.param(*row, marks=[pytest.mark.slow] * row[0].startswith(("assess", "paper")))
        for row in readme_answers()
    ],
)
def test_a_command_of_the_readme_answers_what_stands_beside_it(
    command: str, answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert rocksteady(command).out.startswith(f"{answer}\n")


def test_the_table_of_the_readme_is_read() -> None:
    assert len(readme_answers()) >= 5


def test_the_changelog_has_what_a_user_notices_in_short_lines() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    unreleased = text.split("## [Unreleased]", 1)[1].split("\n## ", 1)[0]
    parts = re.split(r"^### Answers .*\n|^### (?=Block)", unreleased, flags=re.MULTILINE)
    _, one, two, unreleased = parts
    assert max(len(one.split()), len(two.split())) <= 800
    assert len(unreleased.split()) <= 1600
    entries = re.findall(r"^- (.*?)(?=^- |^#|\Z)", unreleased, re.MULTILINE | re.DOTALL)
    assert len(entries) > 40
    assert max(len(entry.split()) for entry in entries) <= 45


# -------------------------------------------------------------------------------- three clicks


@every(
    ("question", "page"),
    [
        (
            "fragility of an off-centre statue with vertical motion",
            "fragility-with-vertical-motion",
        ),
        ("resume a map", "resume-a-map"),
        ("*undecided*", "undecided"),
    ],
)
def test_a_question_leads_to_its_page_in_two_clicks(question: str, page: str) -> None:
    assert f"(../how-to/{page}.md)" in row_of(question)
    assert clicks(DOCS / "how-to" / f"{page}.md") <= 2


def test_equation_19_is_two_clicks_away_and_its_code_is_named() -> None:
    row = row_of("equation 19")
    assert "(../theory/steady.md#conditions)" in row
    assert clicks(DOCS / "theory" / "steady.md") <= 2
    steady = (DOCS / "theory" / "steady.md").read_text(encoding="utf-8")
    conditions = steady.split("## Conditions\n", 1)[1].split("\n## ", 1)[0]
    assert r"\tag{19}" in conditions
    path, function = re.findall(r"`([\w/.]+)`", row)
    code = (ROOT / "src" / "rocksteady" / path).read_text(encoding="utf-8")
    assert f"def {function}(" in code


def test_undecided_is_in_the_glossary_one_click_away() -> None:
    assert "{term}`undecided`" in row_of("*undecided*")
    glossary = DOCS / "glossary.md"
    assert clicks(glossary) == 1
    assert re.search(r"^undecided$", glossary.read_text(encoding="utf-8"), re.MULTILINE)


def test_the_start_page_has_a_block_to_push_before_the_first_line_to_type() -> None:
    first = re.findall(r"^```(.*)$", START.read_text(encoding="utf-8"), re.MULTILINE)[0]
    assert first == "{scene} push"


def test_every_part_of_the_manual_is_one_click_away() -> None:
    for part in ("start", "tutorials", "how-to", "guides", "evidence", "reference"):
        assert clicks(DOCS / part / "index.md") == 1, part
    assert clicks(DOCS / "explorer.md") == 1
    assert clicks(DOCS / "gallery" / "index.rst") == 1
    assert clicks(DOCS / "theory" / "README.md") == 1


@pytest.mark.slow
def test_every_page_is_three_clicks_away_at_the_most() -> None:
    folders = ("start", "tutorials", "how-to", "guides", "theory", "evidence", "reference")
    for folder in (*folders, "decisions"):
        for page in sorted((DOCS / folder).rglob("*.md")):
            assert clicks(page) <= 3, page


def test_every_command_has_a_question() -> None:
    page = (DOCS / "start" / "questions.md").read_text(encoding="utf-8")
    assert len(COMMANDS) > 20
    assert set(re.findall(r"`rocksteady ([\w-]+)", page)) == COMMANDS


# ------------------------------------------------------------------------------- whole and right


def test_the_list_of_guides_is_complete() -> None:
    index = DOCS / "guides" / "index.md"
    text = index.read_text(encoding="utf-8")
    guides = {page.stem for page in index.parent.glob("*.md")} - {"index"}
    (tree,) = TOCTREE.findall(text)
    listed = [line for line in tree.splitlines() if line and not line.startswith(":")]
    assert sorted(listed) == sorted(guides)
    rows = re.findall(r"^\| \[[^\]]+\]\((\S+)\.md\) \| \S.* \|$", text, re.MULTILINE)
    assert rows == listed  # in one order, and each with its line


@every("page", PAGES)
def test_every_link_leads_to_a_file(page: Path) -> None:
    lost = [target for target in targets(page) if not target.exists() and target not in GENERATED]
    assert not lost
