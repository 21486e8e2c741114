"""Sentences on an object: the least change is named with what it does, in its unit."""

from typing import Any

import pytest

from rocksteady.errors import InputError
from rocksteady.risk.assess._answers import _change_words, _row_words, demand_words
from rocksteady.risk.assess._probability import EXTRAPOLATED
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess.objects_table import ObjectsTable


def remedy(name: str, change: float | None, value: float | None, unit: str = "") -> Remedy:
    return Remedy(
        name=name,
        words=f"no {name} is enough",
        change=change,
        value=value,
        unit=unit,
        probability=0.02,
        basis="count",
        fell=1,
        trials=50,
    )


def test_the_least_relative_change_is_told_in_its_own_unit() -> None:
    width = remedy("width", 0.25, 0.5, "m")
    kilograms, share = remedy("ballast", 0.3, 120.0, "kg"), remedy("ballast", 0.2, 0.2)
    cap = remedy("friction cap", 0.1, 0.15)
    never = remedy("ballast", None, None)
    for remedies, words in (
        ([width, kilograms, never], "base from 0.4 to 0.5 m wide: "),
        ([kilograms, never], "120 kg of ballast at its base: "),
        ([width, share], "20 % of its mass of ballast at its base: "),
        ([cap, share], "let it slide on a base with a friction of at most 0.15: "),
    ):
        assert _change_words(remedies).startswith(words), words
        assert _change_words(remedies[::-1]) == _change_words(remedies)


def test_what_is_not_enough_is_told_once() -> None:
    never = [remedy("width", None, None), remedy("ballast", None, None)]
    assert _change_words([*never, never[0]]) == "no width is enough; no ballast is enough"
    assert _change_words([]) == ""


def test_a_certain_curve_is_no_count() -> None:
    row = {"colour": "red", "probability": 1.0, "tried": 12, "method": "curve", "basis": "curve"}
    assert _row_words(row) == "red, > 99 %"


def row(name: str, colour: str, **fields: Any) -> dict[str, Any]:
    usual = {"red": 0.5, "amber": 0.05, "green": 0.001, "grey": None}
    return {
        "name": name,
        "colour": colour,
        "verdict": {"green": "below target", "grey": "slides"}.get(colour, "above"),
        "probability": usual[colour],
        "by_curve": usual[colour],
        "basis": "curve",
        "method": "curve",
        "class": "",
        "tried": 20,
        "band_low": 0.1,
        "band_high": 0.4,
        "pga_g": 0.3,
        "pgv_m_s": 0.4,
        **fields,
    }


def table(rows: list[dict[str, Any]], records: int = 60, **fields: Any) -> ObjectsTable:
    usual: dict[str, Any] = {"pga_g": 0.3, "pgv_m_s": 0.4, "target_probability": 0.1}
    return ObjectsTable(rows=tuple(rows), records=records, seconds=1.0, **{**usual, **fields})


def test_objects_in_the_order_of_colours_and_probabilities() -> None:
    rows = [
        *(row("a", "green"), row("b", "red", probability=0.3), row("c", "grey")),
        *(row("d", "amber"), row("e", "red", probability=0.9), row("f", "red", probability=None)),
    ]
    result = table(rows)
    assert [each["name"] for each in result.worst] == ["e", "b", "f", "d", "c", "a"]
    by = [each["name"] for each in result.sorted_by("probability", descending=False)]
    assert by == ["a", "d", "b", "e", "c", "f"]
    assert [each["name"] for each in result.sorted_by("name")] == ["f", "e", "d", "c", "b", "a"]
    with pytest.raises(InputError, match=r"columns are name, colour, .*; give one"):
        result.sorted_by("x")
    assert not result.meets_target
    assert table([row("a", "green"), row("s", "green", verdict="stands")]).meets_target
    assert result.demand == (0.3, 0.4)
    assert table([row("a", "red"), row("b", "red", pga_g=0.2)]).demand is None


def test_a_table_of_objects_in_words() -> None:
    for rows, records, words in (
        ([row("a", "red")], 60, "1 of 1 object is above the target of 10 % at 0.3 g and 0.4 m/s."),
        ([row("a", "green")], 60, "None of 1 object is above the target of 10 %"),
        ([row("a", "green")] * 2, 60, "None of 2 objects are above the target of 10 %"),
        ([row("a", "red"), row("b", "grey")], 60, "1 of 2 objects is above the target of 10 % at "),
        ([row("a", "red")] * 3, 60, "3 of 3 objects are above"),
        ([row("b", "grey")] * 2, 60, "at 0.3 g and 0.4 m/s; 2 without an answer."),
        (
            [row("a", "red"), row("b", "red", pga_g=0.2)],
            60,
            "above the target of 10 % at the demand",
        ),
        ([row("a", "red")], 3, "3; a curve needs"),
        ([row("a", "red", pga_g=None)], 60, "60; the PGA is taken to lift each object"),
    ):
        text = " ".join(table(rows, records).summary().split())
        assert words in text, (words, text)
    for colours, shown, left in (
        *((["green"] * 5, 5, ""), (["green"] * 6, 5, "1 green"), (["red"] * 6, 6, "")),
        *((["red"] * 13 + ["amber"], 12, "1 red, 1 amber"), (["red", *["grey"] * 7], 5, "3 grey")),
    ):
        rows = [row(f"object{at}", colour) for at, colour in enumerate(colours)]
        text = " ".join(table(rows).summary().split())
        assert sum(f"object{at} " in f"{text} " for at in range(len(colours))) == shown, colours
        assert (left in text) if left else ("left out" not in text), text
    whole = table([row("a", "red"), row("b", "grey"), row("c", "red")])
    headline = "<ObjectsTable: 3 objects at 0.3 g of PGA and 0.4 m/s of PGV: 2 red, 1 grey>"
    assert repr(whole) == headline
    values = whole.to_dict()
    assert values["colours"] == {"red": 2, "amber": 0, "green": 0, "grey": 1}
    assert [each["name"] for each in values["objects"]] == ["a", "c", "b"]
    assert (values["records"], values["pga_g"], values["pgv_m_s"]) == (60, 0.3, 0.4)
    (shown_table,) = whole.describe().tables
    left_of = {column.heading: column.left for column in shown_table.columns}
    assert left_of == {"object": True, "P": False, "chance": True, "colour": True, "verdict": True}
    text = " ".join(whole.summary(more=True).split())
    assert "Red is a probability above 10 %, amber one above 2 %, green one below" in text
    alone = table([row("a", "red", pgv_m_s=None)], pgv_m_s=None)
    assert "1 object at 0.3 g of PGA: 1 red" in repr(alone)
    apart = table([row("a", "red"), row("b", "red", pga_g=0.2)])
    assert "2 objects at the demand of each: 2 red" in repr(apart)


def test_a_row_says_what_its_colour_follows() -> None:
    for fields, words in (
        ({"colour": "grey"}, "grey: slides, no probability"),
        ({"colour": "green", "basis": "statics"}, "green: the PGA does not lift it"),
        ({"colour": "red"}, "red, 50 %"),
        ({"colour": "red", "method": EXTRAPOLATED}, f"red, 50 %, {EXTRAPOLATED}"),
        (
            {"colour": "red", "basis": "count", "by_curve": None},
            "red, 50 % (90 %: 10 to 40 %), counted; no curve can be fitted",
        ),
        (
            {"colour": "red", "basis": "count", "by_curve": 0.2},
            "red, 50 % (90 %: 10 to 40 %), counted; 20 % by curve",
        ),
    ):
        made = row("a", **fields)
        assert _row_words(made) == words, fields


def test_peaks_of_a_demand() -> None:
    for pga, pgv, words in (
        *((0.35, 0.4, "0.35 g and 0.4 m/s"), (0.35, None, "0.35 g"), (None, 0.4, "0.4 m/s")),
        (None, None, ""),
    ):
        assert demand_words(pga, pgv) == words
