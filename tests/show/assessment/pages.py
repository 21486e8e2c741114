"""A page as its parts, read by the standard library's parser."""

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from html.parser import HTMLParser
from unittest import mock

from matplotlib.figure import Figure

from rocksteady.facades.page import _facade_pictures
from rocksteady.show import report
from rocksteady.show.assessment import _assessment_pictures
from rocksteady.show.style.page import SCREEN
from rocksteady.show.style.page import Page as Paper

VOID = {"meta", "link", "img", "source", "br", "input"}
TEXTLESS = {"style", "script"}


@contextmanager
def drawn_once() -> Iterator[None]:
    """Draw each picture of a page once, for light paper and a wide page: a quarter of the time.

    For tests of words; others hold what a dark screen and a phone are given.
    """

    def once(make: Callable[[Paper], Figure], words: str, **_: object) -> dict[str, str]:
        address = report.picture_address(make(SCREEN))
        sources = ("source", "source_dark", "narrow", "narrow_dark")
        return {"alt": words} | dict.fromkeys(sources, address)

    with ExitStack() as patches:
        for module in (report, _assessment_pictures, _facade_pictures):
            patches.enter_context(mock.patch.object(module, "twins", once))
        yield


class Page(HTMLParser):
    """Elements, texts and addresses of a page; refuses an element that is closed out of turn."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: Counter[str] = Counter()
        self.attributes: list[tuple[str, dict[str, str]]] = []
        self.headings: list[tuple[int, str]] = []
        self.open: list[str] = []
        self.style = ""
        self.words: list[str] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] += 1
        self.attributes.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in VOID:
            self.open.append(tag)
        if tag in ("h1", "h2", "h3"):
            self.headings.append((int(tag[1]), ""))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] in TEXTLESS:
            self.style += data
            return
        self.words.append(data)
        if {"h1", "h2", "h3"} & set(self.open):
            level, text = self.headings[-1]
            self.headings[-1] = (level, text + data)

    @property
    def text(self) -> str:
        """All that is read, with single spaces and plain minus signs."""
        whole = " ".join("".join(self.words).split())
        return whole.replace("\N{NO-BREAK SPACE}", " ").replace("−", "-")

    def of(self, tag: str) -> list[dict[str, str]]:
        """Return the attributes of each element of a name."""
        return [attributes for name, attributes in self.attributes if name == tag]


def check_alone(page: Page) -> None:
    """Check that a page runs nothing, fetches nothing, and has links that lead somewhere."""
    assert page.tags["script"] == page.tags["iframe"] == page.tags["object"] == 0
    ids = [attributes["id"] for _, attributes in page.attributes if "id" in attributes]
    assert len(ids) == len(set(ids))
    for tag, attributes in page.attributes:
        assert not [name for name in attributes if name.startswith("on")], tag
        for name in ("src", "srcset", "href", "action", "data", "poster"):
            address = attributes.get(name)
            if address is not None:
                assert address.startswith(("data:", "#")), address
                assert not address.startswith("#") or address[1:] in ids
    assert "@import" not in page.style
    assert "url(" not in page.style
    policy = next(each for each in page.of("meta") if "http-equiv" in each)["content"]
    assert policy.startswith("default-src 'none'")
    assert "script-src" not in policy
