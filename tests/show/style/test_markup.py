"""Cells of tables: what is a name or a text is escaped, and what there is not leaves nothing."""

from rocksteady.show.style.markup import Cell, badge, beside, digest, figure, named, quiet, under
from rocksteady.show.style.wording import cleaned

SCRIPT = "<script>&\u202e"


def test_texts_are_escaped_in_every_form() -> None:
    cells = [named(SCRIPT).content, badge(SCRIPT, SCRIPT), digest(SCRIPT), quiet(SCRIPT)]
    for cell in [*cells, under(SCRIPT), beside(SCRIPT, SCRIPT), SCRIPT + under("")]:
        assert "<script" not in cell
        assert "&lt;script&gt;&amp;" in cell


def test_nothing_is_left_of_what_is_not_there() -> None:
    assert quiet(None) == under(None) == beside("", under(None)) == ""
    assert under("") == '<span class="under"></span>'
    assert "a < b" + under(None) == "a &lt; b"


def test_markup_stays_markup_when_it_is_cleaned() -> None:
    row = {"name": named(SCRIPT, "half", under("x")), "p": figure("1"), "q": None}
    assert cleaned(row) == {
        "name": {
            "content": '<bdi>&lt;script&gt;&amp;\\u202e</bdi><span class="under">x</span>',
            "look": "half name",
            "label": "",
        },
        "p": {"content": "1", "look": "figure", "label": ""},
        "q": None,
    }
    assert hasattr(cleaned(named(SCRIPT))["content"], "__html__")
    assert not hasattr(cleaned(Cell(SCRIPT))["content"], "__html__")
