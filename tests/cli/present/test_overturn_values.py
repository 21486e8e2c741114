"""What `overturn` prints of windows: values, table and rows."""

from functools import cache
from typing import Any

import pytest
from rocksteady.cli.present.overturn_values import (
    overturn_values,
    print_windows,
    title_of,
    window_rows,
)

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    OverturningWindows,
    find_overturning_windows,
    overturning_threshold,
)
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.cli.present.printed import as_json, fits, printed

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.9)


@cache
def windows_of(
    block: Block | DimensionlessBlock, pulse: str, highest: float, model: Model
) -> OverturningWindows:
    given: dict[str, Any] = {"amplitudes": (1.0, highest), "model": model}
    return find_overturning_windows(block, pulse, [1.0, 2.0, 8.0], **given)


def values_of(
    block: Block | DimensionlessBlock,
    pulse: str = "ricker",
    highest: float = 3.0,
    model: Model | None = None,
) -> dict[str, Any]:
    return overturn_values(windows_of(block, pulse, highest, model or Linear()), block)


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_the_values_keep_the_contract(block: Block | DimensionlessBlock) -> None:
    values = as_json(values_of(block))
    assert [row["frequency_ratio"] for row in values["windows"]] == [1.0, 2.0, 8.0]
    for row in values["windows"]:
        ends = [end for interval in row["intervals"] for end in interval]
        assert ends == sorted(ends)
        assert row["first"] == (ends[0] if ends else None)
        # Modes that touch are one interval; together they cover the same amplitudes.
        width = sum(high - low for low, high in row["intervals"])
        assert sum(high - low for low, high in (mode["interval"] for mode in row["modes"])) == (
            pytest.approx(width)
        )
        assert ("freq_hz" in row) == ("intervals_g" in row) == (block is LEANING)
        assert row["closed_form"] is None
    assert values["windows"][-1]["intervals"] == []
    assert len(values["windows"][0]["modes"]) > 0
    assert ("negative_restitution" in values) == (block is LEANING)


def test_windows_in_g_are_those_of_the_block() -> None:
    (row, *_) = values_of(LEANING)["windows"]
    for in_g, bare in zip(row["intervals_g"], row["intervals"], strict=True):
        for end_g, end in zip(in_g, bare, strict=True):
            shaking = Harmonic(amplitude=end, frequency_ratio=1.0)
            assert end_g * LEANING.gravity == pytest.approx(shaking.acceleration_m_s2(LEANING))
    assert row["freq_hz"] == pytest.approx(LEANING.p / 6.283185307179586)


def test_a_closed_form_stands_beside_its_windows_in_the_linear_model_alone() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    values = values_of(block, "rectangle", highest=9.0)
    closed = [row["closed_form"] for row in values["windows"]]
    assert closed == overturning_threshold("rectangle", [1.0, 2.0, 8.0]).tolist()
    assert values["windows"][0]["first"] == pytest.approx(closed[0], rel=1e-9)
    nonlinear = values_of(block, "rectangle", model=Nonlinear())
    assert {row["closed_form"] for row in nonlinear["windows"]} == {None}
    assert title_of(nonlinear).endswith(", nonlinear")


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_there_is_a_row_a_mode(block: Block | DimensionlessBlock) -> None:
    values = values_of(block)
    rows = window_rows(values)
    assert len(rows) == sum(len(row["modes"]) for row in values["windows"])
    assert all(row["low"] < row["high"] for row in rows)  # type: ignore[operator]
    assert ("freq_hz" in rows[0]) == (block is LEANING)
    text = printed(print_windows, values)
    assert fits(text)
    assert "stands" in text, "nothing overturns it at the highest frequency"
    assert ("Hz" in text) == (block is LEANING)
    # A frequency stands once, in the row of its first window.
    assert sum(line.lstrip().startswith("1 ") for line in text.splitlines()) == 1


def test_windows_of_any_kind_have_their_words() -> None:
    values = values_of(BARE)
    first, second, _ = values["windows"]
    mode = {"interval": [2.5, 4.0], "impacts": 10, "side": -1, "endless": True}
    first["modes"] = [mode, {**mode, "impacts": 3, "side": 1, "endless": False}]
    first |= {"left_out": 2, "left_out_width": 1e-6, "unsettled": 1}
    second |= {"left_out": 1, "left_out_width": 3e-5}
    text = printed(print_windows, values)
    lines = text.splitlines()
    assert fits("\n".join(lines[:-2])), "sentences may be longer than the table"
    endless, other = lines[3:5]
    assert endless.split() == ["1", "2.5", "the", "end", "10", "-"]
    assert other.split() == ["2.5", "4", "3", "+"]
    assert "3 narrower windows are left out, at no frequency more than 3e-05 wide" in text
    assert "At 1 of the frequencies there are so many windows" in text


def test_a_title_has_both_slendernesses_of_an_asymmetric_block() -> None:
    block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
    found = find_overturning_windows(block, "ricker", [2.0, 3.0], within=(1.0, 3.0))
    alphas = f"α = {block.alpha:.3g}/{block.negative.alpha:.3g} rad"
    assert alphas in title_of(overturn_values(found, block))
