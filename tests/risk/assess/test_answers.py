"""Sentences on an object: the least change is named with what it does, in its unit."""

from rocksteady.risk.assess._answers import _change_words, _row_words
from rocksteady.risk.assess._remedies import Remedy


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
