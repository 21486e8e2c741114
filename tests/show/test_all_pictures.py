"""Every picture and page is as recorded: words, forms, and places to a fiftieth of a point."""

import pytest

from tests.show.all_pictures import pages, pictures
from tools.freeze.records import FOLDER, loaded, short
from tools.freeze.results import freeze_pictures

RECORDED = loaded((FOLDER / "pictures.txt").read_text(encoding="utf-8"))
ANEW = "look at it (`make gallery`), then `python -m tools.freeze record pictures`"


def test_each_picture_has_a_record() -> None:
    assert sorted([*pictures(), *pages()]) == sorted(RECORDED), ANEW


@pytest.mark.parametrize("name", RECORDED)
def test_pictures_are_as_recorded(name: str) -> None:
    assert short(dict(freeze_pictures(name)))[name] == RECORDED[name], ANEW
