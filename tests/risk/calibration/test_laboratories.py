"""Laboratories of known truth: enough draws, and predictions near those of the truth itself."""

import functools
from typing import Any

import numpy as np
import pytest

from tests.risk.calibration.laboratories import FAMILY, row_of

NUMBERS = (0, 11, 23, FAMILY)
"""Three of the family that is fitted, and another body."""


@functools.cache
def rows() -> list[dict[str, Any]]:
    return [row_of(number) for number in NUMBERS]


@pytest.mark.slow
def test_each_laboratory_has_an_answer() -> None:
    for row in rows():
        assert row["effective"] >= 200.0, row["number"]
        assert row["k"] < 0.7, row["number"]
        assert row["runs"] <= 6000, row["number"]


@pytest.mark.slow
def test_intervals_hold_the_truth_and_predictions_are_near_those_of_the_truth() -> None:
    """Of 27 intervals of 90 % in the family no fewer than 20; scores of all tests together."""
    ranks = [rank for row in rows()[:3] for rank in row["ranks"].values()]
    assert sum(0.05 < rank < 0.95 for rank in ranks) >= 0.75 * len(ranks)
    fell = np.concatenate([row["fell"] for row in rows()])
    p = {way: np.concatenate([row["ways"][way] for row in rows()]) for way in rows()[0]["ways"]}
    brier = {way: float(np.square(each - fell).mean()) for way, each in p.items()}
    right = {way: float(((each >= 0.5) == (fell > 0.0)).mean()) for way, each in p.items()}
    assert brier["predicted"] < min(brier["truth"] + 0.015, brier["logistic"])
    assert right["predicted"] > right["truth"] - 0.03
