"""Descriptions of overturning windows: values, table and rows."""

import math
import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    find_overturning_windows,
)
from rocksteady.formulas import overturning_amplitude
from rocksteady.model.equations import Model
from rocksteady.overturning import OverturningWindows
from rocksteady.words._window_lists import verdict
from tests.descriptions import as_json, fits
from tests.every import every

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.9)


@cache
def windows_of(
    block: Block | DimensionlessBlock,
    pulse: str = "ricker",
    highest: float = 3.0,
    model: Model | None = None,
) -> OverturningWindows:
    given: dict[str, Any] = {"within": (1.0, highest), "model": model or Linear()}
    return find_overturning_windows(block, pulse, [1.0, 2.0, 8.0], **given)


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_the_values_keep_the_contract(block: Block | DimensionlessBlock) -> None:
    values = as_json(windows_of(block).to_dict())
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
    assert values["amplitudes"] == [1.0, 3.0]
    assert ("negative_restitution" in values) == (block is LEANING)


def test_windows_in_g_are_those_of_the_block() -> None:
    (row, *_) = windows_of(LEANING).to_dict()["windows"]
    for in_g, bare in zip(row["intervals_g"], row["intervals"], strict=True):
        for end_g, end in zip(in_g, bare, strict=True):
            motion = Harmonic(amplitude=end, frequency_ratio=1.0)
            assert end_g * LEANING.gravity == pytest.approx(motion.acceleration_m_s2(LEANING))
    assert row["freq_hz"] == pytest.approx(LEANING.p / 6.283185307179586)


def test_a_closed_form_stands_beside_its_windows_in_the_linear_model_alone() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    values = windows_of(block, "rectangle", highest=9.0).to_dict()
    closed = [row["closed_form"] for row in values["windows"]]
    assert closed == overturning_amplitude("rectangle", [1.0, 2.0, 8.0]).tolist()
    assert values["windows"][0]["first"] == pytest.approx(closed[0], rel=1e-9)
    nonlinear = windows_of(block, "rectangle", model=Nonlinear())
    assert {row["closed_form"] for row in nonlinear.to_dict()["windows"]} == {None}
    assert "nonlinear model" in repr(nonlinear)


@pytest.mark.parametrize("reverse", [False, True])
def test_the_closed_form_is_that_of_the_side_that_the_pulse_lifts(reverse: bool) -> None:
    pulse = Pulse(shape="rectangle", amplitude=1.0, frequency_ratio=1.0, reverse=reverse)
    found = find_overturning_windows(LEANING, pulse, [2.0], within=(0.2, 9.0), model=Linear())
    (row,) = found.to_dict()["windows"]
    (without,) = (mode for mode in row["modes"] if mode["impacts"] == 0)
    assert without["interval"][0] == pytest.approx(row["closed_form"], rel=1e-9)
    assert without["side"] == (-1 if reverse else 1)
    assert ("reversed rectangle pulse" in repr(found)) == reverse == found.to_dict()["reversed"]


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_there_is_a_row_a_window(block: Block | DimensionlessBlock) -> None:
    found = windows_of(block)
    rows = found.to_dataframe()
    assert len(rows) == sum(len(row["modes"]) for row in found.to_dict()["windows"])
    assert (rows.low < rows.high).all()
    assert ({"freq_hz", "low_g"} <= set(rows)) == (block is LEANING)
    text = found.summary(more=True)
    assert fits(text)
    assert "stands throughout at omega/p = 8." in text
    assert ("Hz" in text) == ("°" in text) == (block is LEANING)


def test_windows_of_any_kind_have_their_words() -> None:
    found = windows_of(BARE)
    changed = replace(
        found,
        low=np.array([[2.5, 2.7], [np.nan, np.nan], [np.nan, np.nan]]),
        high=np.array([[2.6, 3.0], [np.nan, np.nan], [np.nan, np.nan]]),
        impacts=np.array([[3, 10], [-1, -1], [-1, -1]]),
        side=np.array([[1, -1], [0, 0], [0, 0]]),
        left_out=np.array([2, 1, 0]),
        left_out_width=np.array([1e-6, 3e-5, 0.0]),
        unsettled=np.array([1, 0, 0]),
        first=np.array([2.5, np.nan, np.nan]),
        opposite=np.array([2.5, np.nan, np.nan]),
    )
    text = changed.summary(more=True)
    lines = [line.split() for line in text.splitlines()]
    assert ["1", "2.5", "2.6", "3", "+"] in lines
    assert ["1", "2.7", "the", "end", "10", "-"] in lines
    words = " ".join(text.split())
    assert "3 narrower windows are left out, at no frequency more than 3e-05 wide" in words
    assert "At 1 of the frequencies there are so many windows" in words
    assert "stands throughout at omega/p = 2, 8." in words


@every("highest", [1.5, 3.0, 9.0, 40.0])
def test_an_answer_says_nothing_of_what_was_not_searched(highest: float) -> None:
    for block in (BARE, LEANING):
        found = windows_of(block, "one-sine", highest)
        answer = found.describe()
        end = found.within[1] * (LEANING.uplift_acceleration / 9.80665 if block is LEANING else 1.0)
        for _, text in (("", answer.sentence), *answer.screen):
            assert isinstance(text, str)
            assert "above" not in text
            if "always" in text or "it stands" in text:
                assert float(re.findall(r" to (?:A = )?([\d.]+)", text)[-1]) == float(f"{end:.3g}")


def test_an_answer_tells_where_falling_begins_and_where_it_ends() -> None:
    made = windows_of(BARE)
    nan = math.nan
    for low, high, left_out, words in (
        ((2.5, nan), (2.6, nan), 0, "first at 2.5; it stands from 2.6 to 3"),
        ((2.5, nan), (2.6, nan), 1, "first at 2.5"),
        ((2.5, nan), (3.0, nan), 0, "at 2.5, and always up to 3"),
        ((2.5, nan), (3.0, nan), 1, "at 2.5, and always up to 3"),
        ((1.5, 2.5), (2.0, 3.0), 0, "first at 1.5; always from 2.5 to 3"),
        ((1.5, 2.5), (2.0, 3.0), 1, "first at 1.5; always from 2.5 to 3"),
        ((1.5, 2.2), (2.0, 2.5), 0, "first at 1.5; it stands from 2.5 to 3"),
        ((1.0, nan), (2.5, nan), 0, "first at 1, the least searched; it stands from 2.5 to 3"),
        ((1.0, nan), (3.0, nan), 0, "at 1, the least searched, and always up to 3"),
        ((1.5, nan), (2.9999, nan), 0, "first at 1.5"),
    ):
        lows = np.array([low, (nan, nan), (nan, nan)])
        windows = replace(
            made,
            first=np.array([low[0], nan, nan]),
            low=lows,
            high=np.array([high, (nan, nan), (nan, nan)]),
            impacts=np.where(np.isnan(lows), -1, 1),
            side=np.where(np.isnan(lows), 0, 1),
            left_out=np.array([left_out, 0, 0]),
        )
        assert verdict(windows, 0, "{:g}".format) == words, (low, high, left_out)
