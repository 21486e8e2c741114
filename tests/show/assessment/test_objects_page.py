"""The page of a table of objects: every object, every order, and no script."""

import re
from typing import Any

import pytest

from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.results.numbers import chance, number
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.objects_table import ObjectsTable, assess_objects
from rocksteady.show.assessment.object_report import report_html
from rocksteady.show.export.manifest import make_manifest
from tests.show.assessment.pages import Page, check_alone

SIZES = {
    "vase": (0.12, 0.5, None),
    "Chest": (0.9, 1.1, None),
    "<b>rack</b>": (0.6, 2.0, 0.9),
    "plank": (0.2, 1.9, 0.05),
}


@pytest.fixture(scope="module", name="table")
def _table() -> ObjectsTable:
    objects = []
    for name, (width, height, friction) in SIZES.items():
        values: dict[str, Any] = {"name": name, "geometry": {"width_m": width, "height_m": height}}
        objects.append(
            DescribedObject(values=values | ({} if friction is None else {"friction": friction}))
        )
    return assess_objects(objects, make_synthetic_suite(4), pga_g=0.4, pgv_m_s=0.5)


@pytest.fixture(scope="module", name="html")
def _html(table: ObjectsTable) -> str:
    return report_html(table, make_manifest(command="rocksteady assess objects.csv"))


def test_it_runs_and_fetches_nothing(html: str) -> None:
    page = Page(html)
    check_alone(page)
    assert page.tags["h1"] == 1
    assert page.tags["b"] == 0
    assert "rocksteady assess objects.csv" in page.text


def test_every_object_has_its_figures_and_its_sentence(table: ObjectsTable, html: str) -> None:
    text = Page(html).text
    for row in table.rows:
        assert row["name"] in text
        assert row["sentence"] in text
        assert number(row["uplift_pga_g"]) in text
        if row["probability"] is not None and 1e-4 < row["probability"] < 0.999:
            assert chance(row["probability"]) in text


def test_rows_stand_by_probability_those_without_one_last(table: ObjectsTable, html: str) -> None:
    text = Page(html).text
    places = {row["name"]: text.index(row["sentence"]) for row in table.rows}
    shares = {row["name"]: row["probability"] for row in table.rows}
    ranked = sorted(places, key=places.__getitem__)
    known = [shares[name] for name in ranked if shares[name] is not None]
    assert known == sorted(known, reverse=True)
    assert shares[ranked[-1]] is None
    assert ranked[-1] == "plank"


def test_each_order_gives_each_row_a_place(table: ObjectsTable, html: str) -> None:
    styles = [each["style"] for each in Page(html).of("tr") if "style" in each]
    assert len(styles) == len(SIZES)
    rows = table.sorted_by("probability")
    for key in ("probability", "uplift_pga_g", "name"):
        places = [int(re.search(rf"--{key}:(\d+)", style)[1]) for style in styles]  # type: ignore[index]
        assert sorted(places) == [*range(len(SIZES))]
        values = [rows[places.index(place)][key] for place in range(len(SIZES))]
        if key == "uplift_pga_g":
            assert values == sorted(values)
        elif key == "name":
            assert values == ["<b>rack</b>", "Chest", "plank", "vase"]
        assert f"main:has(#by-{key}:checked)" in html


def test_colours_come_with_their_words(table: ObjectsTable, html: str) -> None:
    words = {"red": "high", "amber": "raised", "green": "low", "grey": "no answer"}
    text = Page(html).text
    for row in table.rows:
        assert words[row["colour"]] in text
    assert html.count('class="badge') >= len(SIZES)


def test_the_same_table_gives_the_same_bytes(table: ObjectsTable, html: str) -> None:
    assert report_html(table, make_manifest(command="rocksteady assess objects.csv")) == html
