"""The page of a table of objects: every object, every order, and no script."""

import re
from dataclasses import replace
from typing import Any

import pytest

from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.results.numbers import chance, number
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.objects_table import ObjectsTable, assess_objects
from rocksteady.risk.counted.suite import Peaks
from rocksteady.show.assessment.object_report import report_html
from rocksteady.show.export.manifest import make_manifest
from tests.outputs import unrendered
from tests.show.assessment.pages import Page, check_alone

SUITE = make_synthetic_suite(11)
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
    objects += [
        replace(objects[0], values={**objects[0].values, "name": f"twin {k}"}) for k in "ab"
    ]
    return assess_objects(objects, SUITE, demand=Peaks(pga_g=0.4, pgv_m_s=0.5))


@pytest.fixture(scope="module", name="html")
def _html(table: ObjectsTable) -> str:
    return report_html(table, make_manifest(command="rocksteady assess objects.csv"))


def test_it_runs_and_fetches_nothing(html: str) -> None:
    page = Page(html)
    check_alone(page)
    assert page.tags["h1"] == 1
    assert page.tags["b"] == 0
    assert "rocksteady assess objects.csv" in page.text


def kinds_of(html: str) -> str:
    """Return the text of the table of kinds."""
    return Page(html).text.partition("friction needed")[2].partition("All objects")[0]


def test_every_kind_has_one_row_with_its_figures_and_its_sentence(
    table: ObjectsTable, html: str
) -> None:
    text = kinds_of(html)
    assert len(table.kinds) == len(SIZES)
    for row, count in table.kinds:
        assert text.count(row["sentence"]) == 1
        assert number(row["uplift_pga_g"]) in text
        assert (count == 3) == (f"{row['name']} and 2 alike" in text)
        if row["by"] == "runs":
            share = "all" if row["fall"] == row["runs"] else chance(row["share"])
            assert f"{share if row['fall'] else 'none'}" in text
    assert "twin" not in text


def test_every_object_has_a_row_with_the_verdict_of_its_kind(
    table: ObjectsTable, html: str
) -> None:
    part = Page(html).text.partition("2All objects")[2].partition("3What the answers")[0]
    places = [part.index(row["name"]) for row in table.worst]
    assert places == sorted(places)
    words = re.findall(r"red|green|stands|slides|not shown|no answer", part)
    assert words == [row["verdict"].replace("-", " ") for row in table.worst]


def test_objects_that_are_all_different_are_listed_once(table: ObjectsTable) -> None:
    few = replace(table, rows=table.rows[: len(SIZES)])
    text = Page(report_html(few, make_manifest())).text
    assert "All objects" not in text
    assert "alike" not in text


def test_each_order_gives_each_kind_a_place(table: ObjectsTable, html: str) -> None:
    styles = [each["style"] for each in Page(html).of("tr") if "style" in each]
    assert len(styles) == len(SIZES)
    rows = [row for row, _ in table.kinds]
    for key in ("verdict", "share", "uplift_pga_g", "name"):
        places = [int(re.search(rf"--{key}:(\d+)", style)[1]) for style in styles]  # type: ignore[index]
        assert sorted(places) == [*range(len(SIZES))]
        values = [rows[places.index(place)][key] for place in range(len(SIZES))]
        known = [value for value in values if value is not None]
        if key == "verdict":
            assert places == sorted(places)
        elif key == "name":
            assert values == ["<b>rack</b>", "Chest", "plank", "vase"]
        else:
            assert known == sorted(known, reverse=key == "share")
            assert values[: len(known)] == known, "rows without a value come last"
        assert f"main:has(#by-{key}:checked)" in html


def test_a_page_of_floors_has_their_plan_and_names_them() -> None:
    house = Building.of_first_mode("house", storeys=2, period_s=0.3)
    vase = {"geometry": {"width_m": 0.12, "height_m": 0.5}}
    objects = [
        DescribedObject(values={"name": f"vase {k}", "floor": floor, "building": "house"} | vase)
        for k, floor in enumerate((2, 2, 0))
    ]
    table = assess_objects(objects, SUITE, buildings=[house], demand=Peaks(pga_g=0.3, pgv_m_s=0.4))
    with unrendered():
        page = Page(report_html(table, make_manifest()))
    assert len(page.of("img")) == 1
    part = page.text.partition("2All objects")[2]
    assert part.count("house, floor 2") == 2
    assert part.count("house, ground") == 1


def test_the_same_table_gives_the_same_bytes(table: ObjectsTable, html: str) -> None:
    assert report_html(table, make_manifest(command="rocksteady assess objects.csv")) == html
