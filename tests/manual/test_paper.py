"""The paper for JOSS, its references, and the entry by which the program is cited."""

import re
import tomllib
from pathlib import Path
from typing import Any

import msgspec

import rocksteady as rs
from tests.every import every

ROOT = Path(__file__).parents[2]
PAPER = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
BIBLIOGRAPHY = (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8")
CITATION = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
CITE_PAGE = (ROOT / "docs" / "start" / "cite.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

_, FRONT, BODY = PAPER.split("---\n", 2)
ENTRY = re.compile(r"^@(\w+)\{([\w-]+),\n(.*?)^\}$", re.MULTILINE | re.DOTALL)
FIELD = re.compile(r"^  (\w+)\s*= \{(.*)\},$", re.MULTILINE)
ENTRIES = {
    key: {"kind": kind, **dict(FIELD.findall(fields))}
    for kind, key, fields in ENTRY.findall(BIBLIOGRAPHY)
}
WORDS = range(750, 1001)
"""JOSS takes 750 to 1,750 words; ours is to be read in a few minutes."""
SECTIONS = (
    "Summary",
    "Statement of need",
    "State of the field",
    "Functionality",
    "Software design",
    "Quality control",
    "Research impact and limits",
    "Acknowledgements",
    "References",
)
CFF_KEYS = {
    *("abstract", "authors", "cff-version", "commit", "contact", "date-released", "doi"),
    *("identifiers", "keywords", "license", "license-url", "message", "preferred-citation"),
    *("references", "repository", "repository-artifact", "repository-code", "title", "type"),
    *("url", "version"),
}
"""What the Citation File Format 1.2.0 knows at the top of a file."""


def yaml(text: str) -> dict[str, Any]:
    return msgspec.yaml.decode(text.encode(), type=dict[str, Any])


def test_the_front_matter_has_what_joss_asks_for() -> None:
    front = yaml(FRONT)
    assert front["title"].startswith(f"{PROJECT['name']}: ")
    assert len(front["tags"]) >= 3
    assert front["bibliography"] == "paper.bib"
    assert re.fullmatch(r"[1-9]\d? [A-Z][a-z]+ 20\d\d", front["date"])
    places = {str(place["index"]): place["name"] for place in front["affiliations"]}
    for author in front["authors"]:
        assert author["name"]
        assert set(re.findall(r"\d+", str(author["affiliation"]))) <= set(places)
    assert [author["name"] for author in front["authors"]] == [
        author["name"] for author in PROJECT["authors"]
    ]


def test_the_sections_stand_in_their_order_and_each_has_text() -> None:
    headings = re.findall(r"^# (.+)$", BODY, re.MULTILINE)
    assert tuple(headings) == SECTIONS
    texts = re.split(r"^# .+$", BODY, flags=re.MULTILINE)[1:-1]
    assert all(len(text.split()) > 10 for text in texts)


def test_the_paper_is_as_long_as_joss_wants_it() -> None:
    assert len(BODY.split()) in WORDS


def test_what_is_cited_is_what_the_bibliography_has() -> None:
    cited = re.findall(r"@([\w-]+)", BODY)
    assert set(cited) == set(ENTRIES)
    assert len(ENTRIES) == BIBLIOGRAPHY.count("\n@") + BIBLIOGRAPHY.startswith("@")


@every("key", ENTRIES)
def test_an_entry_is_complete(key: str) -> None:
    entry = ENTRIES[key]
    assert {"author", "title", "year"} <= set(entry)
    assert re.fullmatch(r"(18|19|20)\d\d", entry["year"])
    assert key.endswith(entry["year"])
    match entry["kind"]:
        case "article":
            assert {"journal", "volume", "pages"} <= set(entry)
        case "inproceedings":
            assert {"booktitle", "publisher"} <= set(entry)
        case kind:
            assert kind in {"book", "misc"}
            assert "publisher" in entry
    assert re.fullmatch(r"10\.\d{4,}/\S+", entry.get("doi", "10.0000/none"))


def test_a_doi_of_a_work_in_the_theory_is_the_one_that_stands_there() -> None:
    folder = ROOT / "docs" / "theory"
    theory = "\n".join(page.read_text(encoding="utf-8") for page in sorted(folder.glob("*.md")))
    there = {
        key for key, entry in ENTRIES.items() if "doi" in entry and f"doi:{entry['doi']}" in theory
    }
    assert {"jorba2005", "lenci2005"} <= there


def test_times_of_other_solvers_are_those_of_the_benchmarks() -> None:
    page = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    linear, nonlinear = page.split("## Beside other solvers", 1)[1].split("### The nonlinear model")

    def column(part: str, solver: str, place: int) -> float:
        (row,) = (line for line in part.splitlines() if line.startswith(f"| {solver} |"))
        return float(row.strip("|").split("|")[place].replace(" ", "").rstrip("%"))

    text = " ".join(BODY.split())
    assert f"{column(linear, 'rocksteady', 4):.1f} µs a trajectory" in text
    assert f"takes {column(linear, 'heyoka, batch', 6):.0f} times as long" in text
    assert f"some {column(linear, 'scipy solve_ivp', 6) // 1000:.0f},000 times" in text
    runge = "Runge-Kutta 4, 100 steps a period"
    assert f"takes {column(linear, runge, 6):.0f} times" in text
    assert f"wrongly in {100 - column(linear, runge, 9):.1f} % of the cells" in text
    ratios = [
        float(line.strip("|").split("|")[6])
        for line in nonlinear.splitlines()
        if line.startswith("| heyoka")
    ]
    assert f"heyoka takes {min(ratios):.0f} to {max(ratios):.0f} times as long" in text


# ------------------------------------------------------------------------------ CITATION.cff


def test_the_citation_file_is_valid_and_fits_the_project() -> None:
    citation = yaml(CITATION)
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= set(citation) <= CFF_KEYS
    assert citation["type"] == "software"
    assert citation["version"] == rs.__version__
    assert citation["license"] == PROJECT["license"]
    assert citation["authors"] == PROJECT["authors"]
    assert set(PROJECT["keywords"]) == set(citation["keywords"])
    name, _, subject = citation["title"].partition(": ")
    assert name == PROJECT["name"]
    assert PROJECT["description"].lower().startswith(subject)
    for reference in citation["references"]:
        assert {"type", "title", "authors"} <= set(reference)


def test_the_page_on_citing_and_the_paper_have_the_title_and_the_version_of_the_citation() -> None:
    citation = yaml(CITATION)
    assert yaml(FRONT)["title"] == citation["title"]
    assert f"title   = {{{citation['title']}}}" in CITE_PAGE
    assert f"version = {{{citation['version']}}}" in CITE_PAGE


# ------------------------------------------------------------------------------ claims

ROW = re.compile(r"^\| (?!the paper|---)(.+?) \| (.+) \|$", re.MULTILINE)
PLACE = re.compile(r"`((?:docs|tests)/[\w./]+)`(?:: ((?:`\w+`(?:, )?)+))?")
CLAIMS = (ROOT / "paper" / "claims.md").read_text(encoding="utf-8")


@every("row", ROW.findall(CLAIMS))
def test_a_claim_of_the_registry_stands_in_the_paper_and_its_tests_exist(
    row: tuple[str, str],
) -> None:
    claim, held = row
    assert claim.lower() in " ".join(BODY.split()).lower()
    places = PLACE.findall(held)
    assert places
    for path, names in places:
        assert (ROOT / path).exists(), path
        for name in re.findall(r"\w+", names):
            assert f"def {name}(" in (ROOT / path).read_text(encoding="utf-8"), name


def test_every_line_of_the_functionality_has_a_claim_of_the_registry() -> None:
    part = BODY.split("# Functionality\n", 1)[1].split("\n# ", 1)[0]
    lines = [
        " ".join(each.split()).lower() for each in re.split(r"^- |\.\s", part, flags=re.MULTILINE)
    ]
    claims = [claim.lower() for claim, _ in ROW.findall(CLAIMS)]
    bare = [each for each in lines if each and not any(claim in each for claim in claims)]
    assert bare == ["the functions cover"]
