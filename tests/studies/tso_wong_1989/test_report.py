"""The study's report as a page: whole, alone, well formed, and with everything in it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser
from itertools import pairwise

import pytest
from matplotlib.figure import Figure

from rocksteady.show.export.files import figure_bytes
from rocksteady.show.report import svg_data_uri
from rocksteady.studies.tso_wong_1989._report import (
    ReportedPanel,
    figure_number,
    panel_verdict,
    report_html,
)
from rocksteady.studies.tso_wong_1989.claims.findings import Claim, Finding, Verdict
from rocksteady.studies.tso_wong_1989.figures.panel import Panel
from tests.every import every

VOID = {"meta", "link", "img", "br", "hr", "input", "col"}
HEADINGS = {f"h{level}": level for level in range(1, 7)}
PICTURE = svg_data_uri(figure_bytes(Figure(figsize=(2.0, 1.0)), "svg"))
NASTY = 'If A < 1 & Ω > 2, then "u" = θ/α </dd><script>alert(1)</script>'


@dataclass
class Element:
    """An element of a page."""

    tag: str
    attributes: dict[str, str | None]
    children: list["Element | str"] = field(default_factory=list)

    def all(self, tag: str = "", **attributes: str) -> Iterator["Element"]:
        """This element and those in it, in the order of the page."""
        if tag in {"", self.tag} and attributes.items() <= self.attributes.items():
            yield self
        for child in self.children:
            if isinstance(child, Element):
                yield from child.all(tag, **attributes)

    def one(self, tag: str = "", **attributes: str) -> "Element":
        (found,) = self.all(tag, **attributes)
        return found

    @property
    def text(self) -> str:
        parts = (child if isinstance(child, str) else child.text for child in self.children)
        return re.sub(r"\s+", " ", "".join(parts)).strip()

    def badges(self) -> list[str]:
        spans = [span for span in self.all("span") if "badge" in (span["class"] or "").split()]
        return [span.text for span in spans]

    def __getitem__(self, name: str) -> str | None:
        return self.attributes.get(name)


class Reader(HTMLParser):
    """Reads a page and insists that every element is closed where it was opened."""

    def __init__(self) -> None:
        super().__init__()
        self.open = [Element("page", {})]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert len(dict(attrs)) == len(attrs), "an attribute stands twice"
        element = Element(tag, dict(attrs))
        self.open[-1].children.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag: str) -> None:
        assert self.open[-1].tag == tag, (self.open[-1].tag, tag, self.getpos())
        self.open.pop()

    def handle_data(self, data: str) -> None:
        self.open[-1].children.append(data)


def read(html: str) -> Element:
    reader = Reader()
    reader.feed(html)
    reader.close()
    assert len(reader.open) == 1, "an element is not closed"
    return reader.open[0].one("html")


def claim(
    name: str,
    *,
    holds: bool | None,
    figures: tuple[str, ...] = (),
    see: tuple[str, ...] = (),
) -> Claim:
    return Claim(
        id=name,
        statement=f"Statement of {name}. {NASTY}",
        page=99,
        figures=figures,
        see=see,
        finding=Finding(holds=holds, detail=f"Result of {name}. {NASTY}"),
    )


def panel(name: str, *choices: str) -> ReportedPanel:
    subject = Panel(
        id=name,
        title=f"Title of {name}, A < 2",
        says=f"What the paper says of {name}. {NASTY}",
        computed=f"What came out for {name}. {NASTY}",
        choices=choices,
        header=("tau", "u"),
        rows=[],
        draw=Figure,
    )
    return ReportedPanel(panel=subject, picture=PICTURE, seconds=0.25)


CLAIMS = [
    claim("S1", holds=True, figures=("3a", "3b")),
    claim("E1", holds=False, figures=("3b",)),
    claim("S2", holds=None, figures=("10",)),
    claim("E2", holds=False),
    claim("S3", holds=True, figures=("2", "12b")),
    claim("S4", holds=True, figures=("3b",)),
    claim("E3", holds=False, figures=("3b",), see=("3a", "2")),
    claim("S5", holds=True, see=("3a",)),
]
PANELS = [panel("3a"), panel("3b", "One choice & another", "A second"), panel("10"), panel("12b")]


def made(claims: list[Claim] = CLAIMS, sections: list[ReportedPanel] = PANELS) -> str:
    return report_html(
        claims=claims,
        sections=sections,
        seconds=187.0,
        version="1.2.3",
        environment="Python 3.11, <another> machine",
    )


@pytest.fixture(scope="module")
def page() -> Element:
    return read(made())


def part(page: Element, name: str) -> Element:
    """One of the page's sections, by the name of its heading."""
    return page.one("section", **{"aria-labelledby": name})


def links(element: Element) -> list[str]:
    return [address for a in element.all("a") if (address := a["href"]) is not None]


def test_the_same_study_gives_the_same_bytes() -> None:
    assert made() == made()
    assert made().startswith("<!DOCTYPE html>\n<html lang=")


@every(
    ("claims", "sections"),
    [(CLAIMS, PANELS), (CLAIMS, PANELS[:1]), (CLAIMS[:1], PANELS), ([], []), (CLAIMS, [])],
)
def test_every_page_is_whole(claims: list[Claim], sections: list[ReportedPanel]) -> None:
    page = read(made(claims, sections))
    names = [element["id"] for element in page.all() if element["id"] is not None]
    assert len(set(names)) == len(names)
    assert not [name for name in names if re.search(r"\s|^$", name)]
    files = {
        f"figure-{s.panel.id}.{kind}" for s in sections for kind in ("csv", "png", "svg", "pdf")
    }
    targets = {f"#{name}" for name in names}
    assert set(links(page)) <= targets | files
    assert files <= set(links(page))
    for element in page.all():
        for attribute in ("aria-labelledby", "aria-describedby"):
            assert element[attribute] is None or f"#{element[attribute]}" in targets
        assert not {"style", "onclick", "onload"} & set(element.attributes)
        assert element.tag not in {"script", "iframe", "object", "form", "base"}
    levels = [HEADINGS[e.tag] for e in page.all() if e.tag in HEADINGS]
    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_nothing_comes_from_outside(page: Element) -> None:
    sources = [element["src"] for element in page.all() if element["src"] is not None]
    assert sources == [PICTURE] * len(PANELS)
    assert [element["href"] for element in page.all("link")] == ["data:,"]
    assert "://" not in made()


def test_every_picture_has_a_text(page: Element) -> None:
    texts = [image["alt"] for image in page.all("img")]
    assert texts == [f"Figure {s.panel.id}, computed again: {s.panel.title}" for s in PANELS]


def test_text_is_shown_as_it_stands(page: Element) -> None:
    in_table, in_discrepancies, in_panels, beneath_panels = 2 * len(CLAIMS), 2 * 3, 2 * 4, 7
    shown = in_table + in_discrepancies + in_panels + beneath_panels
    assert page.one("main").text.count(NASTY) == shown
    assert "Python 3.11, <another> machine" in page.text


def test_discrepancies_come_first_and_whole(page: Element) -> None:
    main = page.one("main")
    assert [s["aria-labelledby"] for s in main.children if isinstance(s, Element)] == [
        "discrepancies",
        "figures",
        "statements",
        "notation",
    ]
    told = list(part(page, "discrepancies").all("article"))
    assert [article["id"] for article in told] == ["claim-E1", "claim-E2", "claim-E3"]
    for article, corrected in zip(told, (CLAIMS[1], CLAIMS[3], CLAIMS[6]), strict=True):
        assert article.one("h3").text == corrected.id
        assert corrected.statement in article.text
        assert corrected.finding.detail in article.text
        assert "page 99" in article.text
        here = [name for name in corrected.figures + corrected.see if name != "2"]
        assert links(article) == [f"#figure-{name}" for name in here]


def test_panels_stand_under_the_papers_figures(page: Element) -> None:
    section = part(page, "figures")
    assert [heading.text for heading in section.all("h3")] == ["Figure 3", "Figure 10", "Figure 12"]
    shown = list(section.all("article"))
    assert [article["id"] for article in shown] == [f"figure-{s.panel.id}" for s in PANELS]
    for article, reported in zip(shown, PANELS, strict=True):
        subject = reported.panel
        for text in (subject.title, subject.says, subject.computed, *subject.choices):
            assert text in article.text
        assert ("Choices" in article.text) is bool(subject.choices)
        assert article.one("code").text == subject.command
        assert "Run time 250 ms" in article.text


def test_a_panel_shows_its_statements_and_the_verdict_that_follows(page: Element) -> None:
    badges = {name: page.one(id=f"figure-{name}").badges() for name in ("3a", "3b", "10", "12b")}
    assert badges == {
        "3a": ["reproduced", "reproduced"],
        # Corrected statements first, the others in their order.
        "3b": ["corrected", "corrected", "corrected", "reproduced", "reproduced"],
        "10": ["not checkable", "not checkable"],
        "12b": ["reproduced", "reproduced"],
    }
    inner = [address for address in links(page.one(id="figure-3b")) if address.startswith("#")]
    assert inner == ["#claim-E1", "#claim-E3", "#statement-S1", "#statement-S4"]


def test_a_statement_bears_on_further_panels_without_their_verdict(page: Element) -> None:
    article = page.one(id="figure-3a")
    assert "See also E3 (corrected), S5 (reproduced)" in article.text
    inner = [address for address in links(article) if address.startswith("#")]
    assert inner == ["#statement-S1", "#claim-E3", "#statement-S5"]
    assert "Figure 3b; see also 3a, 2" in page.one(id="claim-E3").text
    assert "(See figure 3a)" in page.one(id="statement-S5").text
    assert "See also" not in page.one(id="figure-3b").text


@every(
    ("holds", "verdict"),
    [
        ([], Verdict.REPRODUCED),
        ([True, None], Verdict.REPRODUCED),
        ([True, None, False], Verdict.CORRECTED),
        ([None, None], Verdict.NOT_CHECKABLE),
    ],
)
def test_the_verdict_on_a_panel(holds: list[bool | None], verdict: Verdict) -> None:
    claims = [claim(f"S{number}", holds=one) for number, one in enumerate(holds)]
    assert panel_verdict(claims) is verdict


def test_a_panel_links_to_all_its_tables() -> None:
    subject = replace(panel("3a").panel, more_tables={"other side": (("u",), [])})
    page = read(made(CLAIMS, [ReportedPanel(panel=subject, picture=PICTURE, seconds=1.0)]))
    files = [address for address in links(page.one(id="figure-3a")) if address[0] != "#"]
    assert files == [
        "figure-3a.csv",
        "figure-3a-other%20side.csv",
        "figure-3a.png",
        "figure-3a.svg",
        "figure-3a.pdf",
    ]


def test_all_statements_stand_in_one_table(page: Element) -> None:
    section = part(page, "statements")
    rows = list(section.one("tbody").all("tr"))
    assert [row["id"] for row in rows] == [f"statement-{one.id}" for one in CLAIMS]
    for row, one in zip(rows, CLAIMS, strict=True):
        cells = [cell.text for cell in (*row.all("th"), *row.all("td"))]
        assert cells[:2] == [one.id, "99"]
        assert cells[2].startswith(one.statement)
        assert cells[3:] == [one.verdict.replace("-", " "), one.finding.detail]


def test_tables_name_their_rows_and_columns(page: Element) -> None:
    for table in page.all("table"):
        assert table.one("caption").text
        head, body = table.one("thead"), table.one("tbody")
        columns = list(head.all("th"))
        assert {cell["scope"] for cell in columns} == {"col"}
        for row in body.all("tr"):
            assert [cell["scope"] for cell in row.all("th")] == ["row"]
            assert 1 + len(list(row.all("td"))) == len(columns)


def test_the_head_counts_and_says_how_to_make_it_again(page: Element) -> None:
    head = page.one("body").children
    header = next(e for e in head if isinstance(e, Element) and e.tag == "header")
    for text in (
        "W. K. Tso and C. M. Wong",
        "Earthquake Engineering and Structural Dynamics 18, 89–106 (1989)",
        "reproduced4 of 8 statements",
        "corrected3 of 8 statements",
        "not checkable1 of 8 statements",
        "3 min 7 s",
        "rocksteady 1.2.3",
    ):
        assert text in header.text, text
    assert header.one("code").text == "rocksteady paper --out DIR"


def test_the_contents_lead_to_every_part(page: Element) -> None:
    found = links(page.one("nav"))
    parts = ["#discrepancies", "#figures", "#statements", "#notation"]
    assert [address for address in found if address in parts] == parts
    assert {f"#figure-{s.panel.id}" for s in PANELS} | {
        "#claim-E1",
        "#claim-E2",
        "#claim-E3",
    } < set(found)


def test_a_panel_that_is_left_out_is_named_and_not_linked() -> None:
    page = read(made(CLAIMS, PANELS[:1]))
    row = page.one(id="statement-S1")
    assert "(Figures 3a, 3b)" in row.text
    assert links(row) == ["#figure-3a"]


def test_a_paper_without_discrepancies_is_told_so() -> None:
    page = read(made(CLAIMS[:1], PANELS[:1]))
    section = part(page, "discrepancies")
    assert "None: every statement that can be checked holds" in section.text


def test_a_panel_belongs_to_the_figure_that_its_name_begins_with() -> None:
    assert [figure_number(name) for name in ("3a", "10", "13d")] == ["3", "10", "13"]
