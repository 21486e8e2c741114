"""The page as a file: what is inside, and what its policy allows."""

import base64
import gzip
import hashlib
import json
import re
from html.parser import HTMLParser

from rocksteady.explorer._page import document

NASTY = "</script><script>alert(1)</script><!--\u2028&amp;\"'"


class Reader(HTMLParser):
    """Elements with what is inside, as a browser takes them apart."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[str, str] = {}
        self.inside = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        self.inside = dict(attrs).get("id") or tag

    def handle_endtag(self, _: str) -> None:
        self.inside = ""

    def handle_data(self, data: str) -> None:
        self.texts[self.inside] = self.texts.get(self.inside, "") + data


def read(**given: object) -> Reader:
    made = {"state": {"A": "2"}, "motions": [], "module": b"\0asm"} | given
    return Reader(document(**made))  # type: ignore[arg-type]


def test_the_module_and_the_first_view_are_inside() -> None:
    page = read(module=b"\0asm" * 100, state={"A": "1.5"})
    packed = base64.b64decode(page.texts["kernels"])
    assert gzip.decompress(packed) == b"\0asm" * 100
    assert json.loads(page.texts["first-view"]) == {"A": "1.5"}


def test_the_policy_allows_what_is_inside_by_its_hash_and_nothing_else() -> None:
    page = read()
    (policy,) = (each["content"] for tag, each in page.found if "http-equiv" in each)
    assert policy is not None
    rules = {rule.split()[0]: rule.split()[1:] for rule in policy.split("; ")}
    assert rules["default-src"] == ["'none'"]
    for name, directive in (("program", "script-src"), ("style", "style-src")):
        digest = hashlib.sha256(page.texts[name].encode()).digest()
        assert f"'sha256-{base64.b64encode(digest).decode()}'" in rules[directive]
    assert set(rules["script-src"][1:]) == {"'wasm-unsafe-eval'"}
    assert not re.search(r"unsafe-inline|unsafe-eval'(?<!wasm-unsafe-eval')|https?:|\*", policy)


def test_names_of_motions_end_no_element_and_add_none() -> None:
    plain, nasty = read(), read(motions=[{"name": NASTY}], state={"A": NASTY})
    assert [tag for tag, _ in nasty.found] == [tag for tag, _ in plain.found]
    assert json.loads(nasty.texts["motions"]) == [{"name": NASTY}]
    assert json.loads(nasty.texts["first-view"]) == {"A": NASTY}


def test_nothing_in_the_page_points_elsewhere() -> None:
    for tag, attributes in read().found:
        for name in ("src", "href", "srcset", "action", "data"):
            value = attributes.get(name)
            assert value is None or value.startswith(("#", "data:,")), (tag, value)
        assert not [name for name in attributes if name.startswith("on") or name == "style"]


def test_one_state_gives_one_page() -> None:
    given = {"state": {"W": "3"}, "motions": [], "module": b"\0asm"}
    assert document(**given) == document(**given)  # type: ignore[arg-type]
