"""Units of the page: factors, words and tables are those of Python."""

import random

import pytest

from rocksteady import Block
from rocksteady.explorer._palette import page_theme
from rocksteady.explorer._units import QUANTITIES
from rocksteady.model.units import CONVERSIONS, in_units
from rocksteady.show.style.scales import scale_of
from tests.explorer.in_node import InNode

IMPORTS = """
const { shownUnits, shakingWords } = await import(parts('shell/units.mjs'));
const { tableOf } = await import(parts('shell/tables.mjs'));
const { measuresOf } = await import(parts('physics/case.mjs'));
"""
SEED = 48
SIZES = [(0.5, 2.0), (0.001, 0.004), (30.0, 40.5)]


def sizes() -> list[tuple[float, float]]:
    """Return widths and heights, some of them extreme."""
    chance = random.Random(SEED)
    return SIZES + [(chance.uniform(0.05, 2.0), chance.uniform(0.1, 5.0)) for _ in range(40)]


def test_factors_are_those_of_the_python_table(in_node: InNode) -> None:
    lines = """
    const { table, sizes } = asked;
    answer(sizes.map(([b, h]) => [true, false].map((si) =>
        shownUnits(table, measuresOf(kernels, b, h), si))));
    """
    table = page_theme()["units"]
    found = in_node(IMPORTS + lines, {"table": table, "sizes": sizes()})
    for (width, height), (shown, plain) in zip(sizes(), found, strict=True):
        block = Block.rectangle(width=width, height=height, restitution=0.8)
        for name, (conversion, near, _) in QUANTITIES.items():
            factor = float(CONVERSIONS[conversion][1](block, 1.0))
            assert shown[name]["factor"] == pytest.approx(factor, rel=1e-15)
            assert shown[name]["far"]["factor"] == shown[name]["factor"]
            assert shown[name]["unit"].strip() == near_unit(near)
            assert plain[name]["factor"] == 1
            assert "far" not in plain[name]
        assert shown["frequency"]["label"] == scale_of("frequency_ratio", block).label


def near_unit(label: str) -> str:
    """Return the unit at the end of the label of a column."""
    names = {"g": "g", "hz": "Hz", "s": "s", "deg": "°"}
    words = label.removesuffix("_at_start").split("_")
    return "°/s" if words[-2:] == ["deg", "s"] else names[words[-1]]


def test_labels_have_no_marks_of_mathematics() -> None:
    words = [each[side] for each in page_theme()["units"].values() for side in ("near", "far")]
    assert [word for word in words if set(word) & set("\\${}")] == []
    assert "frequency ratio Ω = ω/p" in words
    assert "velocity at the start dθ/dt [°/s]" in words


def test_tables_have_both_columns_as_in_python(in_node: InNode) -> None:
    lines = """
    const [b, h] = asked.size, units = shownUnits(asked.table, measuresOf(kernels, b, h), asked.si);
    const sides = ['side', ['left', '']], highest = [units.angle, asked.angle, 'highest '];
    answer([tableOf([units.time, asked.pt], highest, sides),
        tableOf([units.angle, ['', 0]]), tableOf([units.time, []]),
        shakingWords(units, { A: 2, W: 3 })]);
    """
    asked = {"table": page_theme()["units"], "size": [0.5, 2.0], "pt": [0.0, 1.7]}
    asked |= {"angle": [0.25, -1 / 3], "si": True}
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    expected = in_units({"pt": asked["pt"], "angle": asked["angle"]}, block)
    table, missing, empty, words = in_node(IMPORTS + lines, asked)
    assert table["columns"] == [
        "time [s]", "pivot time pt", "highest tilt θ [°]", "highest angle θ/α", "side",
    ]  # fmt: skip
    for k, name in enumerate(("time_s", "pt", "angle_deg", "angle")):
        column = [row[k] for row in table["rows"]]
        assert column == pytest.approx(list(expected[name]), rel=1e-15)
        if name in {"pt", "angle"}:
            assert column == asked[name]
    assert [row[4] for row in table["rows"]] == ["left", ""]
    assert missing["rows"] == [["", ""], [0, 0]]
    assert empty["rows"] == []
    assert words == "0.49 g, 1.275 Hz"
    table, *_, words = in_node(IMPORTS + lines, asked | {"si": False})
    assert table["columns"] == ["pivot time pt", "highest angle θ/α", "side"]
    assert words == "A = 2, Ω = 3"
