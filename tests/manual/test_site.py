"""What the build changes in pages, and the explorer inside them."""

from pathlib import Path

import pytest
from sphinx.application import Sphinx

from rocksteady.errors import MissingKernelsError
from tests.every import every
from tests.strategies import PLAIN
from tools.manual import mathematics, pages

DOCS = Path("/site/docs")


@every(
    ("link", "shown"),
    [
        ("[the code](../src/a.py)", "the code"),
        ("[the code](../src/a.py#L3)", "the code"),
        ("[`a`](../../src/a.py)", "[`a`](../../src/a.py)"),  # from docs/x.md beyond the checkout
        ("[theory](theory/march.md)", "[theory](theory/march.md)"),
        ("[theory](../docs/theory/march.md#x)", "[theory](../docs/theory/march.md#x)"),
        ("[two](../a) and [three](../b)", "two and three"),
        ("![picture](../out/a.png)", "!picture"),
    ],
)
def test_a_link_out_of_the_manual_is_its_text(link: str, shown: str) -> None:
    outside = link.startswith("[`a`]")
    assert pages.unlink(link, DOCS / "x.md", DOCS) == ("`a`" if outside else shown)


def test_an_anchor_of_html_marks_the_paragraph_that_follows() -> None:
    text = '<a id="tw"></a>\n**[TW]** Tso\n\n<a id="h-63"></a>\n**[H]** Housner\n'
    assert pages.mark(text) == "{#tw}\n**[TW]** Tso\n\n{#h-63}\n**[H]** Housner\n"
    assert pages.mark('a <a id="tw"></a>\n') == 'a <a id="tw"></a>\n'


def test_a_link_by_the_name_of_a_file_has_the_title_of_its_page() -> None:
    assert pages.entitle("as [march.md](march.md#time) and [`a/b-c.md`](../a/b-c.md)") == (
        "as [](march.md#time) and [](../a/b-c.md)"
    )
    assert pages.entitle("[the march](march.md)") == "[the march](march.md)"


def test_the_typesetter_is_in_the_site() -> None:
    [folder] = mathematics.static_path()
    assert (Path(folder) / mathematics.SCRIPT).stat().st_size > 1e6


@pytest.mark.slow
def test_the_explorer_stands_in_a_page_of_any_depth(tmp_path: Path) -> None:
    if PLAIN:
        pytest.skip("no library is loaded")
    from tools.manual import page_explorer

    try:
        page_explorer.static_path()
    except MissingKernelsError as error:
        pytest.skip(str(error))
    source = tmp_path / "source"
    (source / "deep").mkdir(parents=True)
    (source / "conf.py").write_text(
        "from tools.manual import page_explorer\n"
        "extensions = ['myst_parser', 'tools.manual.page_explorer']\n"
        "html_static_path = page_explorer.static_path()\n",
        "utf-8",
    )
    page = '```{explorer}\n:state: A=2&W="6"\n:title: a "b" <c>\n```\n'
    (source / "index.md").write_text("# Top\n\n```{toctree}\ndeep/page\n```\n\n" + page, "utf-8")
    (source / "deep" / "page.md").write_text("# Deep\n\n" + page, "utf-8")
    out = tmp_path / "out"
    Sphinx(source, source, out, tmp_path / "trees", "html", status=None, warning=None).build()
    for name, way in (("index.html", ""), ("deep/page.html", "../")):
        text = (out / name).read_text("utf-8")
        assert f'<iframe src="{way}_static/explorer.html#v=1&amp;A=2&amp;W=&quot;6&quot;"' in text
        assert 'title="a &quot;b&quot; &lt;c&gt;"' in text
    assert (out / "_static" / "explorer.html").read_text("utf-8").startswith("<!doctype html>")
