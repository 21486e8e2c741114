"""Pages as the site shows them: what they link in the checkout is named there, and not linked."""

import re
from pathlib import Path

from sphinx.application import Sphinx

LINK = re.compile(r"\[([^\]\[]+)\]\(((?:\.\./)+[^)\s#]+)(#[^)]*)?\)")

NAMED = re.compile(r"\[`?(?:\w[\w/-]*\.md)`?\]\(([\w./-]+\.md)(#[^)]*)?\)")
ANCHOR = re.compile(r'^<a id="([\w-]+)"></a>\n', re.MULTILINE)


def unlink(text: str, page: Path, docs: Path) -> str:
    """Return a page whose links to files of the checkout outside the manual are their texts."""

    def replace(link: re.Match[str]) -> str:
        target = (page.parent / link[2]).resolve()
        return link[0] if target.is_relative_to(docs) else link[1]

    return LINK.sub(replace, text)


def entitle(text: str) -> str:
    """Return a page whose links by the name of a file have the title of its page instead."""
    return NAMED.sub(r"[](\1\2)", text)


def mark(text: str) -> str:
    """Return a page whose anchors in HTML are attributes of the paragraphs that follow."""
    return ANCHOR.sub(r"{#\1}\n", text)


def _read(app: Sphinx, name: str, source: list[str]) -> None:
    here, docs = Path(app.env.doc2path(name)), Path(app.srcdir)
    source[0] = entitle(mark(unlink(source[0], here, docs)))


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect the change to the reading of pages."""
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
