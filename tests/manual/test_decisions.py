"""Pages of decisions: short, each listed once, and none elsewhere."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
FOLDER = DOCS / "decisions"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(FOLDER.glob("*.md"))}
INDEX = PAGES.pop("index")
WORDS = 150


def test_a_page_of_decisions_has_at_most_150_words() -> None:
    longer = {name: len(text.split()) for name, text in PAGES.items()}
    assert {name: count for name, count in longer.items() if count > WORDS} == {}


def test_the_list_of_decisions_has_each_page_by_its_heading() -> None:
    listed = re.findall(r"^\| \[(.+)\]\((\S+)\.md\) \| \S.* \|$", INDEX, re.MULTILINE)
    headings = {name: text.splitlines()[0].removeprefix("# ") for name, text in PAGES.items()}
    assert {name: heading for heading, name in listed} == headings
    assert INDEX.split("```")[1].split()[2:] == [name for _, name in listed]


def test_decisions_are_pages_not_one_page() -> None:
    assert not (DOCS / "decisions.md").exists()
