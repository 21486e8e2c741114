"""Bands of restitution: their ends, by default and given."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.risk import RestitutionBand
from tests.every import every

BLOCK = Block.rectangle(width=0.4, height=1.6)


def test_a_band_begins_with_the_blocks_own_value_and_ends_at_its_root() -> None:
    e = BLOCK.restitution
    found = RestitutionBand(draws=5).ratios(BLOCK)
    assert found[0].tolist() == [e, e]
    assert found[-1] == pytest.approx([math.sqrt(e)] * 2, rel=1e-15)
    assert np.diff(found[:, 0]) == pytest.approx([(math.sqrt(e) - e) / 4] * 4, rel=1e-12)
    assert RestitutionBand(draws=1).ratios(BLOCK).tolist() == [[e, e]]


def test_the_upper_end_is_at_most_098() -> None:
    slender = Block.rectangle(width=0.2, height=3.0)
    assert slender.restitution > 0.98
    assert RestitutionBand().ratios(slender)[-1].tolist() == [0.98, 0.98]
    assert RestitutionBand(draws=1).ratios(slender)[0, 0] == slender.restitution


def test_each_side_has_its_own() -> None:
    block = Block.asymmetric(left=0.25, right=0.4, height=2.4)
    found = RestitutionBand(draws=2).ratios(block)
    own = [block.positive.restitution, block.negative.restitution]
    assert found[0].tolist() == own
    assert found[1] == pytest.approx(np.sqrt(own), rel=1e-15)
    given = RestitutionBand(low=0.5, high=0.7, draws=3).ratios(block)
    assert given == pytest.approx(np.array([[0.5, 0.5], [0.6, 0.6], [0.7, 0.7]]), rel=1e-15)


def test_ends_may_be_factors_of_each_sides_own_housner_value() -> None:
    block = Block.asymmetric(left=0.25, right=0.4, height=2.4, restitution=0.5)
    own = Block.asymmetric(left=0.25, right=0.4, height=2.4)
    whole = np.array([own.positive.restitution, own.negative.restitution])
    found = RestitutionBand(low=("housner", 0.9), high="housner", draws=3).ratios(block)
    assert found == pytest.approx(np.outer([0.9, 0.95, 1.0], whole), rel=1e-15)
    with pytest.raises(InputError, match=r"low .*exchange the two"):
        RestitutionBand(low=0.95, high="housner").ratios(own)


@every(
    "wrong",
    [
        {"low": "housner", "high": ("housner", 0.9)},
        {"low": -0.1},
        {"high": 1.1},
        {"low": 0.9, "high": 0.8},
        {"draws": 0},
        {"scatter": -0.1},
        {"scatter": 0.6},
        {"seed": -1},
        {"draws": 2.0},
    ],
)
def test_what_is_no_band_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(InputError, match="|".join(wrong)):
        RestitutionBand(**wrong)


def test_of_a_block_against_a_wall_the_band_is_the_walls_which_may_be_0() -> None:
    wall = BLOCK.against_wall(0.49)
    found = RestitutionBand(draws=2).ratios(wall)
    assert found == pytest.approx(np.array([[0.49, 0.49], [0.7, 0.7]]), rel=1e-15)
    assert RestitutionBand(low=0.0, high=0.5, draws=3).ratios(wall)[:, 0].tolist() == [0, 0.25, 0.5]
    # Angular momentum on base, wall and base of a rectangle.
    square = math.sin(BLOCK.alpha) ** 2
    own = (1.0 - 1.5 * square) ** 2 * (1.5 * (1.0 - square) - 1.0)
    form = RestitutionBand(low=("housner", 0.9), high="housner", draws=2).ratios(wall)
    assert form[:, 0] == pytest.approx([0.9 * own, own], rel=1e-14)
    with pytest.raises(InputError, match=r"low .*\(0, 1\]"):
        RestitutionBand(low=0.0, high=0.5).ratios(BLOCK)
