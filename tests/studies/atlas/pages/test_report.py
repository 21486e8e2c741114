"""The page of an atlas: its template is found, and it shows all that it is given."""

import re

from rocksteady.show.report import prose
from rocksteady.studies.atlas.pages.findings import (
    coexistence_sentences,
    family_sentences,
    rest_sentences,
)
from rocksteady.studies.atlas.pages.report import command, report_html
from tests.studies.atlas.small import plane, small

PICTURES = ("families", "coexistence", "from-rest")


def test_the_page_shows_every_picture_and_every_sentence() -> None:
    whole = small()
    page = report_html(
        families=whole.families,
        bands=whole.bands,
        lines=whole.lines,
        coexisting=whole.found,
        strips=whole.strips,
        rest=whole.rest,
        pictures={name: f"data:,{name}" for name in PICTURES},
        seconds=61.0,
        version="1.2.3",
        environment="a machine",
    )
    assert re.findall(r'<img src="data:,([\w-]+)"', page) == list(PICTURES)
    texts = [
        *family_sentences(whole.families, whole.lines, whole.strips),
        *coexistence_sentences(whole.found),
        *rest_sentences(whole.rest, whole.families[0]),
    ]
    for text in texts:
        assert f"<p>{prose(text)}</p>" in page
    assert "rocksteady 1.2.3" in page
    assert "1 min 1 s" in page
    assert "a machine" in page


def test_the_command_on_the_page_makes_this_atlas() -> None:
    assert command(plane()) == (
        "rocksteady study atlas -r 0.8 -A 0.4:8:5 -W 0.6:12:5 -n 1 -n 3 -n 5 --out DIR"
    )
