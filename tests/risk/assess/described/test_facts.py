"""Derived facts of an object: numbers by hand, and the doubts that are due."""

import math
from typing import Any

import pytest

from rocksteady.risk.assess.described.facts import compute_object_facts
from rocksteady.risk.assess.described.objects import DescribedObject
from tests.every import every


def facts_of(geometry: dict[str, Any] | None = None, **keys: Any) -> Any:
    sizes = geometry or {"width_m": 0.32, "height_m": 1.8}
    return compute_object_facts(DescribedObject(values={"name": "x", "geometry": sizes, **keys}))


def test_the_numbers_of_the_worked_example() -> None:
    facts = facts_of(friction=0.4)
    values = facts.to_dict()
    assert values["uplift_pga_g"] == pytest.approx(0.32 / 1.8)  # practice: .1778 g
    assert values["friction_to_lift"] == pytest.approx(0.32 / 1.8)
    assert values["radius_m"] == pytest.approx(0.5 * math.hypot(0.32, 1.8))
    assert values["p_rad_s"] == pytest.approx(math.sqrt(0.75 * 9.80665 / values["radius_m"]))
    assert facts.friction == (0.4, 0.4)
    assert facts.warnings == ()


def test_the_weaker_side_of_an_off_centre_object_counts() -> None:
    facts = facts_of({"width_m": 0.4, "height_m": 1.2, "offset_m": 0.05})
    assert facts.uplift_pga_g == pytest.approx(0.15 / 0.6)
    rows = facts.to_dict()["sides"]
    assert [row["uplift_pga_g"] for row in rows] == pytest.approx([0.25 / 0.6, 0.15 / 0.6])
    assert "right" in facts.summary()


@every(
    ("geometry", "keys", "words"),
    [
        (None, {}, "with a coefficient below 0.178 the object slides"),
        ({"width_m": 1.0, "height_m": 1.8}, {}, "most objects slide before they rock"),
        ({"width_m": 0.06, "height_m": 1.8}, {}, "out of level by half a degree"),
        ({"width_m": 0.3, "height_m": 1.8, "mass_centre_height_m": 0.8}, {},
         "give its radius of gyration"),
        ({"width_m": 0.3, "height_m": 1.8, "mass_kg": 9},
         {"content": {"mass_kg": 3, "mass_centre_height_m": 1}, "fixed_parts": True},
         "one point mass, fixed"),
        (None, {"restitution": 0.99}, "leaves almost all velocity after an impact"),
        ({"width_m": {"low": 0.3, "high": 0.4}, "height_m": 1.8}, {}, "range of the width"),
        (None, {"restitution": {"low": 0.8, "high": 0.9}}, "The lowest restitution of its range"),
        (None, {"demand": {"place": "floor"}}, "the motions must be those of that floor"),
    ],
)  # fmt: skip
def test_what_is_assumed_is_written(
    geometry: dict[str, Any] | None, keys: dict[str, Any], words: str
) -> None:
    facts = facts_of(geometry, **keys)
    assert any(words in warning for warning in facts.warnings)
    assert not any(words in warning for warning in facts_of(friction=0.4).warnings)


@every(("alpha", "words"), [(0.0399, "is small"), (0.0401, ""), (0.3999, ""), (0.4001, "slide")])
def test_slender_and_stocky_begin_at_a_slenderness(alpha: float, words: str) -> None:
    facts = facts_of({"alpha_rad": alpha, "p_rad_s": 2.0}, friction=0.9)
    assert len(facts.warnings) == (1 if words else 0)
    assert all(words in warning for warning in facts.warnings)


def test_half_a_degree_is_compared_with_the_slenderness() -> None:
    alpha = math.radians(2.0)
    facts = facts_of({"alpha_rad": alpha, "p_rad_s": 2.0}, friction=0.9)
    assert "by half a degree changes it by 25 %" in facts.warnings[0]
    assert facts_of(friction=0.4, restitution=0.98).warnings == ()


def test_of_an_object_at_a_wall_the_free_side_and_the_wall_count() -> None:
    facts = facts_of({"left_m": 0.1, "right_m": 0.3, "mass_centre_height_m": 0.8},
                     friction=0.5, against_wall=True, restitution=0.4)  # fmt: skip
    values = facts.to_dict()
    assert values["restitution"] == 0.4
    assert [row["side"] for row in values["sides"]] == ["left"]
    assert values["sides"][0]["restitution"] == 0.4
    assert any("rocks about its left edge alone" in warning for warning in facts.warnings)
    assert values["uplift_pga_g"] == pytest.approx(0.1 / 0.8)
