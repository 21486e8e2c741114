"""Numbers of object files: taken up to the ends of their ranges and refused beyond."""

import math
from typing import Any

import pytest

from rocksteady.errors import InputError, ModelError
from rocksteady.risk.assess.described._validation import validated

OUTLINE: dict[str, Any] = {"width_m": 0.4, "height_m": 1.6}
ANGLES: dict[str, Any] = {"alpha_rad": 0.2, "p_rad_s": 2.0}
OBJECT: dict[str, Any] = {"name": "cabinet", "geometry": OUTLINE}


def made(table: str, key: str, value: object) -> dict[str, Any]:
    """Return an object with one more number in a table, or at the top."""
    if not table:
        return {**OBJECT, key: value}
    if table == "geometry":
        usual = ANGLES if key in {"alpha_rad", "alpha_deg", "p_rad_s"} else OUTLINE
        kept = {name: each for name, each in usual.items() if name[:5] != key[:5]}
        return {**OBJECT, "geometry": {**kept, key: value}}
    return {**OBJECT, table: {key: value}}


NUMBERS = (
    ("geometry", "alpha_rad", 0.0, 0.5 * math.pi, "()"),
    ("geometry", "alpha_deg", 0.0, 90.0, "()"),
    ("geometry", "p_rad_s", 0.3, 100.0, "[]"),
    ("", "friction", 0.0, 3.0, "(]"),
    ("", "restitution", 0.0, 1.0, "(]"),
    ("demand", "pga_g", 0.0, 10.0, "(]"),
    ("demand", "pgv_m_s", 0.0, 10.0, "(]"),
    ("demand", "vertical_g", 0.0, 10.0, "[]"),
    ("demand", "vertical_share", 0.0, 1.0, "[]"),
    ("assessment", "target_probability", 0.0, 1.0, "()"),
)


def test_numbers_reach_the_ends_of_their_ranges_and_no_further() -> None:
    wrong = []
    for table, key, low, high, ends in NUMBERS:
        step = 1e-6 * (high - low)
        for value, taken in (
            *((low - step, False), (low, ends[0] == "["), (low + step, True)),
            *((high - step, True), (high, ends[1] == "]"), (high + step, False)),
            *((math.nan, False), (math.inf, False)),
        ):
            try:
                validated(made(table, key, value), "object")
                result = True
            except InputError:
                result = False
            if result != taken:
                wrong.append((table, key, value))
    assert wrong == []


def test_restitutions_are_one_to_a_thousand() -> None:
    for draws, taken in ((0, False), (1, True), (1000, True), (1001, False)):
        values = made("assessment", "draws", draws)
        if taken:
            assert validated(values, "x").assessment.draws == draws
        else:
            with pytest.raises(InputError, match="whole number from 1 to 1000; give the number"):
                validated(values, "x")


def test_ranges_ascend_and_spectra_have_two_points() -> None:
    for low, high, taken in (
        (0.3, 0.4, True),
        (0.3, 0.3, True),
        (0.4, 0.3, False),
        (0.3, 3.1, False),
    ):
        values = made("", "friction", {"low": low, "high": high})
        if taken:
            assert validated(values, "x").name == "cabinet"
        else:
            with pytest.raises(InputError, match=r"low must not be above high|it must lie in"):
                validated(values, "x")
    for periods, accelerations, taken in (
        *(([0.1, 0.2], [0.5, 0.4], True), ([0.1], [0.5], False), ([0.1, 0.2], [0.5], False)),
        *(([0.2, 0.1], [0.5, 0.4], False), ([0.1, 0.1], [0.5, 0.4], False)),
        *(([0.1, 60.0], [0.5, 30.0], True), ([0.1, 60.1], [0.5, 0.4], False)),
        *(([0.1, 1.0], [0.5, 30.1], False), ([0.0, 1.0], [0.5, 0.4], True)),
    ):
        spectrum = {"period_s": periods, "sa_g": accelerations, "damping": 0.05}
        given = {**OBJECT, "demand": {"spectrum": spectrum}}
        if taken:
            assert validated(given, "x").name == "cabinet"
        else:
            with pytest.raises((InputError, ModelError)):
                validated(given, "x")
    for key in ("name", "kind"):
        for text in ("", " "):
            with pytest.raises(InputError, match="must not be empty; give a text, or leave it out"):
                validated({**OBJECT, key: text}, "x")
    for text, taken in (("housner", True), ("housner*0.965", True), ("house", False)):
        values = made("", "restitution", text)
        if taken:
            assert validated(values, "x").name == "cabinet"
        else:
            with pytest.raises(InputError, match="it must be 'housner', a factor of it as"):
                validated(values, "x")
    with pytest.raises(InputError, match="is empty"):
        validated({}, "x")
