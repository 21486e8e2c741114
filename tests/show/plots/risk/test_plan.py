"""The plan of floors: each object on its floor, in proportion, in the colour of its risk."""

import math
from dataclasses import replace
from typing import Any

import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocksteady import assess_objects, plots
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Building, DescribedObject, ObjectsTable, Peaks
from rocksteady.show.style.tokens import LIGHT

SIZES = {"vase": (0.12, 0.5), "stele": (0.3, 1.6), "case": (0.7, 1.9)}


@pytest.fixture(scope="module", name="table")
def _table() -> ObjectsTable:
    objects = [
        DescribedObject(
            values={
                "name": f"{name} {floor}",
                "floor": floor,
                "friction": 0.1 if name == "case" else 0.6,
                "geometry": {"width_m": width, "height_m": height},
                "assessment": {"draws": 1},
            }
        )
        for name, (width, height) in SIZES.items()
        for floor in (0, "attic")
    ]
    house = Building.of_first_mode("house", storeys=2, period_s=0.3, rooms={"attic": 2})
    suite = make_synthetic_suite(11)
    return assess_objects(objects, suite, buildings=[house], demand=Peaks(pga_g=0.3, pgv_m_s=0.3))


def drawn(table: ObjectsTable) -> tuple[Any, list[Rectangle]]:
    axes = plots.plan(table, Figure(figsize=(6.0, 4.0)).add_subplot())
    return axes, [patch for patch in axes.patches if isinstance(patch, Rectangle)]


def test_each_object_stands_on_its_floor_in_the_colour_of_its_risk(table: ObjectsTable) -> None:
    axes, boxes = drawn(table)
    assert [name.get_text() for name in axes.get_yticklabels()] == ["ground", "floor 2, attic"]
    ordered = sorted(table.worst, key=lambda row: row["storey"])  # a stable sort
    assert [text.get_text() for text in axes.texts] == [row["name"] for row in ordered]
    for box, row in zip(boxes, ordered, strict=True):
        assert box.get_y() == (1.0 if row["storey"] else 0.0)
        share = row["share"]
        colour = LIGHT.undecided if share is None else LIGHT.risk_step(share)
        assert to_hex(box.get_facecolor()) == colour
        assert bool(box.get_hatch()) == (share is None)
        above = row["verdict"] == "red"
        assert to_hex(box.get_edgecolor()) == (LIGHT.ink if above else LIGHT.edge)
    assert any(row["share"] is None for row in ordered)


def test_objects_are_in_proportion(table: ObjectsTable) -> None:
    _, boxes = drawn(table)
    ordered = sorted(table.worst, key=lambda row: row["storey"])
    sizes = [SIZES[row["name"].split()[0]] for row in ordered]
    units = {
        (round(box.get_width() / width, 6), round(box.get_height() / height, 6))
        for box, (width, height) in zip(boxes, sizes, strict=True)
    }
    assert len(units) == 1
    assert math.isclose(max(box.get_height() for box in boxes), 0.5)


def test_names_are_turned_and_then_left_out_where_they_do_not_fit(table: ObjectsTable) -> None:
    for times, turned in ((1, {0.0}), (4, {45.0}), (6, set())):
        axes, boxes = drawn(replace(table, rows=table.rows * times))
        assert {text.get_rotation() for text in axes.texts} == turned
        assert len(boxes) == 6 * times


def test_a_plan_needs_a_floor(table: ObjectsTable) -> None:
    ground = tuple(row for row in table.rows if not row["storey"])
    with pytest.raises(InputError, match="no object on a floor"):
        drawn(replace(table, rows=ground))
