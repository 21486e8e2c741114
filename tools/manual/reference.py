"""Pages of the reference: a block of names becomes the documentation of each.

A page has blocks `{api}` of public names, a name in each line. Where a block `{api-table}` stands,
it shows the table of them all, each with the first line of its docstring. Pictures of the gallery
that use a name are linked behind its docstring.
"""

import functools
import inspect
import re
from collections.abc import Collection
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer

from tools.namespace import PLACES, THINGS

BLOCK = re.compile(r"^```\{api\}\n(.*?)^```$", re.DOTALL | re.MULTILINE)
TABLE = "```{api-table}\n```"
PART = re.compile(r"^## ([^\n]*)$|^```\{api\}\n(.*?)^```$", re.DOTALL | re.MULTILINE)
DEFINED_NAMES = {place: name for name, place in PLACES.items()}
"""The name with which a public thing is defined, by where it is reached."""
NUMBERS = {
    "sweeps.INFINITELY_MANY": "rocksteady.outcomes",
    "sweeps.NO_START": "rocksteady.outcomes",
}
"""Public constants and the modules that define them."""
EXAMPLES = Path(__file__).parents[2] / "examples"
USE = re.compile(r"\brs((?:\.\w+)+)")
MOST = 3
"""Pictures linked from one name."""
HEAD = "```{eval-rst}\n.. py:currentmodule:: rocksteady\n.. highlight:: none\n\n"


def thing_of(place: str) -> Any:
    """Return what is public at a place, as ``histories.Trajectory``."""
    return THINGS[DEFINED_NAMES[place]]


def names_of(page: str) -> list[str]:
    """Return the public names that a page documents, in its order, as ``histories.Trajectory``."""
    return [name for block in BLOCK.findall(page) for name in block.split()]


def text_of(name: str) -> str:
    """Return the docstring of a public name."""
    if name in NUMBERS:
        found = ModuleAnalyzer.for_module(NUMBERS[name]).find_attr_docs()
        return "\n".join(found["", DEFINED_NAMES[name]]).strip()
    return inspect.getdoc(thing_of(name)) or ""


def row(name: str) -> str:
    """Return the row of a table: the name and the first line of its docstring."""
    brackets = "" if isinstance(thing_of(name), type | int) else "()"
    line = text_of(name).partition("\n\n")[0].replace("\n", " ")
    return f"   * - :py:obj:`{name}{brackets} <rocksteady.{name}>`\n     - {line}\n"


def table(page: str) -> str:
    """Return the tables of a page in RST, one for each of its parts."""
    parts, title = [], ""
    for heading, block in PART.findall(page):
        if heading:
            title = heading
            continue
        rows = "".join(row(name) for name in block.split())
        parts.append(f".. list-table:: {title}\n   :class: api\n   :widths: auto\n\n{rows}\n")
    return "".join(parts)


@functools.cache
def uses() -> dict[str, list[str]]:
    """Return the pages of the gallery that use each public name."""
    found: dict[str, list[str]] = {}
    for file in sorted(EXAMPLES.rglob("*.py")):
        page = f"gallery/{file.relative_to(EXAMPLES).with_suffix('')}"
        used = [text.split(".")[1:] for text in USE.findall(file.read_text(encoding="utf-8"))]
        for name in {".".join(parts[:k]) for parts in used for k in (1, 2)} & DEFINED_NAMES.keys():
            found.setdefault(name, []).append(page)
    return found


def pictures(name: str, pages: Collection[str]) -> str:
    """Return links to pictures of the gallery that use a name, of those that the site has."""
    links = [f":doc:`/{page}`" for page in uses().get(name, []) if page in pages][:MOST]
    return f"\n   In the gallery: {' · '.join(links)}\n" if links else ""


def directive(name: str, pages: Collection[str] = ()) -> str:
    """Return the directive that documents a name."""
    thing = thing_of(name)
    if name in NUMBERS:
        module, _, own = name.rpartition(".")
        head = f".. py:data:: {own}\n   :module: rocksteady.{module}\n   :value: {thing}\n\n"
        return f"{head}   {text_of(name)}\n\n"
    kind = "function"
    if isinstance(thing, type):
        kind = "exception" if issubclass(thing, Exception) else "class"
    return f".. auto{kind}:: rocksteady.{name}\n{pictures(name, pages)}\n"


def expand(page: str, pages: Collection[str] = ()) -> str:
    """Return a page with the tables and the documentation for its blocks of names.

    Parameters
    ----------
    page
        The page as it is written.
    pages
        All pages of the site.
    """

    def replace(block: re.Match[str]) -> str:
        return HEAD + "".join(directive(name, pages) for name in block[1].split()) + "```"

    return BLOCK.sub(replace, page.replace(TABLE, f"{HEAD}{table(page)}```"))


def _read(app: Sphinx, name: str, source: list[str]) -> None:
    if name.startswith("reference/api/"):
        source[0] = expand(source[0], app.env.found_docs)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect the change to the reading of pages, and add its style."""
    app.connect("source-read", _read)
    app.add_css_file("api.css")
    return {"parallel_read_safe": True, "parallel_write_safe": True}
