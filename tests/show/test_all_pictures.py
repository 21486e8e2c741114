"""Every page and kind of picture is as recorded: words, forms, and places to a fiftieth of a point.

`make frozen-all` compares all others: narrow ones, and those of other options and data.
"""

import pytest

from tests.show.all_pictures import pages, usual_pictures
from tools.freeze.records import FOLDER, loaded, short
from tools.freeze.results import freeze_pictures

RECORDED = loaded((FOLDER / "pictures.txt").read_text(encoding="utf-8"))
USUAL = [
    name
    for name in RECORDED
    if f"{name}, 84 mm" in RECORDED
    or name.startswith("page ")
    or (name.startswith("plot_") and "," not in name)
]
ANEW = "look at it (`make gallery`), then `python -m tools.freeze record pictures`"


def test_each_picture_has_a_record() -> None:
    assert sorted([*usual_pictures(), *pages()]) == sorted(USUAL), ANEW


@pytest.mark.parametrize("name", USUAL)
def test_pictures_are_as_recorded(name: str) -> None:
    assert short(dict(freeze_pictures(name)))[name] == RECORDED[name], ANEW
