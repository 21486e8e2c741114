"""The glossary and the how-to pages: words that results print are explained, pages are whole."""

import re
from itertools import pairwise
from pathlib import Path

from rocksteady import DimensionlessBlock, Harmonic, find_orbits, outcomes
from rocksteady.branches import PointType
from rocksteady.dynamics.continuation.chains.point_types import BIFURCATIONS
from tests.every import every
from tools.manual.commands import commands_of

DOCS = Path(__file__).parents[2] / "docs"
GLOSSARY = (DOCS / "glossary.md").read_text("utf-8")
HOW_TO = DOCS / "how-to"
INDEX = (HOW_TO / "index.md").read_text("utf-8")
PAGES = {page.stem: page.read_text("utf-8") for page in sorted(HOW_TO.glob("*.md"))}
del PAGES["index"]

ENTRY = re.compile(r"^(?P<term>\S.*)\n(?P<meaning>(?: {2}\S.*(?:\n|\Z))+)", re.MULTILINE)
LINK = re.compile(r"\]\(([\w./-]+\.(?:md|rst))(?:#([\w-]+))?\)")
REFERENCE = re.compile(r"\{term\}`([^`<]+?)(?:\s+<([^`>]+)>)?`")
GENERATED = re.compile(r"reference/commands/[\w-]+\.md|gallery/index\.rst")
"""Pages that the build of the manual writes."""
COMMANDS = {"-".join(command.words) for command in commands_of()}


def entries(text: str) -> list[tuple[str, str]]:
    """Return the terms of a glossary with their meanings, in its order."""
    [body] = re.findall(r"^```\{glossary\}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    return [(entry["term"], " ".join(entry["meaning"].split())) for entry in ENTRY.finditer(body)]


TERMS = dict(entries(GLOSSARY))


def anchors(text: str) -> set[str]:
    """Return the anchors that headings of a page have."""
    headings = re.findall(r"^#{1,4} (.+)$", text, re.MULTILINE)
    plain = (re.sub(r"[^\w -]", "", heading.lower()) for heading in headings)
    return {heading.strip().replace(" ", "-") for heading in plain}


def test_terms_are_sorted_lower_case_and_there_once() -> None:
    terms = [term for term, _ in entries(GLOSSARY)]
    assert len(terms) >= 60
    assert all(first < second for first, second in pairwise(terms))
    assert [term for term in terms if term != term.lower()] == []


def test_entries_of_a_glossary_are_told_apart() -> None:
    text = "```{glossary}\nalpha\n  A tilt,\n  in rad.\n\nat rest\n  Stands.\n```\n"
    assert entries(text) == [("alpha", "A tilt, in rad."), ("at rest", "Stands.")]


def test_each_meaning_is_short_and_leads_somewhere_or_says_all() -> None:
    for term, meaning in TERMS.items():
        assert meaning.endswith((".", ")")), term
        assert 2 <= len(meaning.split()) <= 70, term


@every(
    "label",
    sorted(
        {status.label for status in outcomes.Status}
        | {event.label for event in outcomes.Event}
        | {str(kind) for kind in outcomes.AttractorKind}
        | {str(kind) for kind in BIFURCATIONS if kind is not PointType.GRAZING}
        | {outcomes.NO_START_LABEL}
    ),
)
def test_each_label_of_an_outcome_is_a_term(label: str) -> None:
    assert label.replace("-", " ") in TERMS


def test_terms_that_other_terms_and_pages_refer_to_exist() -> None:
    texts = {
        page: page.read_text("utf-8")
        for page in DOCS.rglob("*.md")
        if page.parent.name != "commands"
    }
    for page, text in texts.items():
        for shown, target in REFERENCE.findall(text):
            assert " ".join((target or shown).split()) in TERMS, (page, shown)


def test_a_word_of_the_literature_leads_to_one_of_ours() -> None:
    for term, meaning in TERMS.items():
        if meaning.startswith("See {term}"):
            [(target, _)] = REFERENCE.findall(meaning)
            assert not TERMS[target].startswith("See {term}"), term


@every(
    ("word", "page"),
    [
        ("coefficient of restitution", "guides/restitution"),
        ("earthquake", "guides/records"),
        ("fall", "guides/overturning"),
        ("fall", "how-to/does-it-fall"),
        ("ground motion", "guides/records"),
        ("limit cycle", "theory/orbits"),
        ("peak ground acceleration", "guides/measures"),
        ("pga", "guides/measures"),
        ("poincaré map", "theory/orbits"),
        ("return map", "theory/orbits"),
        ("seismic", "guides/records"),
        ("tip over", "guides/overturning"),
        ("tip over", "how-to/does-it-fall"),
        ("topple", "guides/overturning"),
        ("topple", "how-to/does-it-fall"),
        ("turn over", "guides/overturning"),
    ],
)
def test_a_search_for_a_synonym_finds_the_glossary_and_the_page(word: str, page: str) -> None:
    """Sphinx searches the terms of a glossary, and the keywords of a page: single words."""
    meaning = TERMS[word]
    if meaning.startswith("See {term}"):
        meaning = TERMS[REFERENCE.findall(meaning)[0][0]]
    [(target, _), *_] = LINK.findall(meaning)
    assert (DOCS / target).exists()
    front = (DOCS / f"{page}.md").read_text("utf-8").split("---\n")[1]
    [keywords] = re.findall(r"^ +keywords: (.+)$", front, re.MULTILINE)
    assert set(word.split()) - {"of"} <= set(keywords.lower().split(", "))


def test_what_the_glossary_says_of_orbits_is_so() -> None:
    """An unstable orbit has a multiplier above 1 in modulus, a stable one none."""
    orbits = find_orbits(
        DimensionlessBlock(restitution=0.95), Harmonic(amplitude=0.5, frequency_ratio=2.0)
    )
    assert {orbit.stable for orbit in orbits} == {True, False}
    for orbit in orbits:
        assert orbit.stable == all(abs(each) < 1.0 for each in orbit.multipliers)


def test_the_index_has_each_page_with_its_title_and_the_tree_has_them_in_this_order() -> None:
    listed = dict(re.findall(r"^- \[(.+)\]\(([\w-]+)\.md\): \S", INDEX, re.MULTILINE))
    titles = {text.split("# ", 1)[1].split("\n", 1)[0]: name for name, text in PAGES.items()}
    assert listed == titles
    [tree] = re.findall(r"^```\{toctree\}\n:hidden:\n\n(.*?)^```$", INDEX, re.DOTALL | re.MULTILINE)
    assert tree.split() == list(listed.values())
    assert len(listed) >= 25


@every("name", PAGES)
def test_a_page_has_code_a_trap_and_places_to_read_on(name: str) -> None:
    text = PAGES[name]
    assert re.search(r"^```(sh|\{code-cell\} ipython3)$", text, re.MULTILINE)
    assert text.count(":::{admonition} Trap\n:class: warning\n") == 1
    [after] = text.split("**Read on:**")[1:]
    assert LINK.search(after)
    assert "{py:obj}`rocksteady." in after
    prose = re.sub(r"^```.*?^```$|^---.*?^---$", "", text, flags=re.DOTALL | re.MULTILINE)
    assert 60 <= len(prose.split()) <= 270


@every("name", ["index", "glossary", *PAGES])
def test_links_of_a_page_lead_to_pages_and_headings(name: str) -> None:
    page = DOCS / "glossary.md" if name == "glossary" else HOW_TO / f"{name}.md"
    for target, anchor in LINK.findall(page.read_text("utf-8")):
        path = (page.parent / target).resolve()
        inside = path.relative_to(DOCS).as_posix()
        if GENERATED.fullmatch(inside):
            assert path.parent.name == "gallery" or path.stem in COMMANDS, target
            continue
        assert path.is_file(), target
        if anchor:
            assert anchor in anchors(path.read_text("utf-8")), (target, anchor)


def test_anchors_are_those_of_headings() -> None:
    assert anchors("# A block\n## What it is, and not\n") == {"a-block", "what-it-is-and-not"}
