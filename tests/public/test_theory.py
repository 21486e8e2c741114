"""The pages of the theory: one symbol one meaning, and every link leads somewhere."""

import importlib
import re
from collections import Counter
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import rocksteady
from tests.every import every

FOLDER = Path(__file__).parents[2] / "docs" / "theory"
PAGES = {page.name: page.read_text(encoding="utf-8") for page in sorted(FOLDER.glob("*.md"))}
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
SYMBOL = re.compile(r"\$([^$]+)\$")
TAG = re.compile(r"\\tag\{([A-Z]\d*)\}")


def rows(page: str, title: str) -> list[list[str]]:
    """The cells of the first table of a section, without its head."""
    section = PAGES[page].split(f"## {title}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines[2:]]


def anchors(text: str) -> set[str]:
    """The places of a page that a link can name."""
    named = set(re.findall(r'<a id="([^"]+)"', text))
    for heading in HEADING.findall(text):
        words = re.sub(r"[^\w\- ]", "", heading.lower())
        named.add(words.replace(" ", "-"))
    return named


def test_each_symbol_is_defined_once() -> None:
    defined = [
        symbol.split("=")[0].strip()
        for cells in rows("README.md", "Notation")
        for symbol in SYMBOL.findall(cells[0])
    ]
    assert len(defined) > 60
    assert {symbol: count for symbol, count in Counter(defined).items() if count > 1} == {}
    assert {"h", "P", "T", "r", r"\Theta", r"\Sigma", r"\Pi", r"\Lambda", r"\chi"} <= set(defined)


def test_each_symbol_has_a_meaning_and_what_holds_it_is_there() -> None:
    for symbol, _, _, meaning, _, places in rows("README.md", "Notation"):
        assert meaning, symbol
        for place in re.findall(r"`([\w.]+)`", places):
            parts = place.split(".")
            found: Any = rocksteady
            length = 0
            while length < len(parts) and find_spec(f"{found.__name__}.{parts[length]}"):
                found = importlib.import_module(f"{found.__name__}.{parts[length]}")
                length += 1
                if not hasattr(found, "__path__"):
                    break
            for name in parts[length:]:
                fields = getattr(found, "__dataclass_fields__", {}) or getattr(found, "_fields", ())
                assert hasattr(found, name) or name in fields, place
                found = getattr(found, name, object)


def test_each_equation_of_ours_has_a_letter_of_its_own() -> None:
    letters = Counter(letter for text in PAGES.values() for letter in TAG.findall(text))
    assert len(letters) > 15
    assert set(letters.values()) == {1}


@every("page", PAGES)
def test_each_link_leads_to_a_place_that_there_is(page: str) -> None:
    for link in LINK.findall(PAGES[page]):
        if link.startswith("https://"):
            continue
        file, _, place = link.partition("#")
        target = (FOLDER / file) if file else FOLDER / page
        assert target.exists(), link
        if place:
            assert place in anchors(target.read_text(encoding="utf-8")), link


def test_each_work_is_cited_or_stands_for_a_page_outside() -> None:
    entries = re.findall(r'<a id="([^"]+)"', PAGES["literature.md"])
    assert len(entries) == len(set(entries)) > 30
    for doi, address in re.findall(r"\[doi:(\S+)\]\((\S+)\)", PAGES["literature.md"]):
        assert doi.startswith("10.")
        assert address.replace("%28", "(").replace("%29", ")") == f"https://doi.org/{doi}"
