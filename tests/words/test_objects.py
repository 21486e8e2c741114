"""Words of objects: sides, walls, parts and what is known of each."""

from typing import Any

import pytest

from rocksteady.risk.assess.described.facts import compute_object_facts
from tests.every import every
from tests.risk.assess.described.test_facts import facts_of
from tests.risk.assess.described.test_objects import SIZES, made


def test_facts_in_words_of_each_kind_of_block() -> None:
    """A table of both sides stands where they differ, and no wall is behind the object."""
    off = {"width_m": 0.4, "height_m": 1.2, "offset_m": 0.05}
    for geometry, keys, sides in (
        (None, {}, False),
        (off, {}, True),
        (off, {"against_wall": True, "restitution": 0.5}, False),
        (None, {"against_wall": True, "restitution": 0.5}, False),
    ):
        facts = facts_of(geometry, **keys)
        text = facts.summary(more=True)
        assert ("lifts at [g]" in text) == sides, (geometry, keys)
        walled = "against_wall" in keys
        assert ("restitution of the wall" in text) == walled
        rows = facts.to_dict()["sides"]
        assert len(rows) == (1 if walled else 2)
        if walled:
            assert rows[0]["restitution"] == facts.to_dict()["restitution"] == 0.5
    (table,) = facts_of(off).describe().tables
    assert [(column.heading, column.left) for column in table.columns] == [
        ("edge", True),
        *(
            (heading, False)
            for heading in ("alpha", "p [rad/s]", "R", "restitution", "lifts at [g]")
        ),
    ]
    text = " ".join(
        facts_of({"width_m": 0.32, "height_m": 1.8, "mass_kg": 90}).summary(more=True).split()
    )
    for words in ("mass 90 kg", "lifts at 0.178 g", "more than 0.178", "radius R 914 mm"):
        assert words in text, (words, text)
    shaken = {"vertical_g": 0.3, "pga_g": 0.4, "pgv_m_s": 0.4}
    facts = facts_of(demand=shaken)
    assert facts.uplift_pga_g == pytest.approx(0.7 * 0.32 / 1.8)
    assert "with 0.3 g of vertical motion downwards at the peak" in " ".join(
        facts.summary().split()
    )


@every(
    ("geometry", "keys", "words"),
    [
        (SIZES, {}, "(all parts as one body)"),
        (SIZES, {"against_wall": True}, "(all parts as one body)"),
        ({**SIZES, "mass_kg": 60.0}, {"content": {"mass_kg": 9.0, "mass_centre_height_m": 1.5}},
         "(object and content as one body)"),
        ({**SIZES, "columns": 1, "cap_mass_ratio": 2.0}, {}, "(pier and point cap as one body)"),
        ({**SIZES, "columns": 4, "cap_mass_ratio": 2.0}, {}, "(each column as one body)"),
    ],
)  # fmt: skip
def test_several_parts_are_named_as_one_body(
    geometry: dict[str, Any], keys: dict[str, Any], words: str
) -> None:
    """Wherever the block is named: of the object, of its ends and of changes to it."""
    described = made(geometry, fixed_parts=True, **keys)
    blocks = [described.block, described.block_of(described.body.wider(0.95))]
    for block in blocks:
        assert words in block.describe().headline
    facts = {fact.label: fact.text for fact in compute_object_facts(described).describe().facts}
    assert f"({facts['as one body']} as one body)" == words


def test_an_object_of_one_part_is_not_named_as_one_body() -> None:
    assert "as one body" not in made().summary() + compute_object_facts(made()).summary()
