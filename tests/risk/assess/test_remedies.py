"""Remedies: the least change of a known probability, what is in reach, and words."""

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from scipy.special import ndtr, ndtri

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.risk.assess._remedies import ROUNDS, Remedy, Search, cheapest
from rocksteady.risk.assess._sensitivity import Case

BEFORE = 0.2
"""Width of the object as it is [m]."""


class Known(Search):
    """A search over widths of which the probability of falling is known.

    The curve of the runs about the demand is that probability times a bias of its argument.
    """

    def __init__(
        self,
        falls: Callable[[float], float],
        target: float,
        *,
        bias: float = 1.0,
        most: float = 9.0,
    ) -> None:
        self.falls, self.target, self.bias = falls, target, bias
        self.unknown = False
        self.tried: list[float] = []

        def block_of(width: float) -> Block:
            if width > most:
                raise InputError("width", width, "it is too wide", "narrow it")
            return Block.rectangle(width=width, height=1.0, restitution=0.5)

        self.described: Any = SimpleNamespace(block_of=block_of)

    @staticmethod
    def width(block: Block) -> float:
        return 2.0 * block.positive.distance

    def case(self, block: Block) -> Case:
        self.tried.append(self.width(block))
        falls = self.falls(self.width(block))
        return Case(
            parameter="",
            change="",
            fitted=falls,
            counted=falls,
            basis="curve",
            fell=0,
            trials=10,
            median=math.nan,
        )

    def runs(self, block: Block) -> Any:
        return block

    def curve_of(self, counts: Any, block: Block) -> Any:  # noqa: ARG002
        return None

    def fitted(self, block: Block, curve: Any) -> float:  # noqa: ARG002
        falls = self.falls(self.bias * self.width(block))
        return 0.0 if math.isnan(falls) else falls


def made(change: float) -> Any:
    return BEFORE * (1.0 + change)


def normal(median: float, beta: float) -> Callable[[float], float]:
    """Return the probability that a width is not enough: lognormal."""
    return lambda width: float(ndtr(math.log(median / width) / beta))


def test_the_least_change_is_enough_and_one_of_a_hundredth_less_is_not() -> None:
    for median in (0.21, 0.3, 0.5):
        for beta in (0.02, 0.3, 1.0):
            for target in (0.01, 0.1, 0.5):
                for bias in (1.0, 0.8, 1.3):
                    search = Known(normal(median, beta), target, bias=bias)
                    exact = median * math.exp(-beta * float(ndtri(target))) / BEFORE - 1.0
                    change, case = search.least(made, 20.0)
                    where = (median, beta, target, bias)
                    if exact > 20.0:
                        assert change is None, where
                        continue
                    if exact <= 0.0:
                        assert change == 0.0, where
                        continue
                    assert change is not None, where
                    assert case.probability <= target
                    assert case.probability == pytest.approx(search.falls(made(change)))
                    assert change >= exact * (1.0 - 1e-9), where
                    assert len(search.tried) <= ROUNDS
                    if len(search.tried) < ROUNDS:
                        assert (1.0 + change) / (1.0 + exact) <= 1.01 + 1e-9, where
                    assert not search.unknown


def test_the_largest_change_that_is_not_enough_is_none() -> None:
    falls = normal(0.5, 0.3)
    search = Known(falls, 0.01)
    change, case = search.least(made, 1.0)
    assert change is None
    assert case.probability == pytest.approx(falls(made(1.0)))
    assert case.probability > 0.01
    assert search.tried[0] == pytest.approx(BEFORE)
    assert search.tried[-1] == pytest.approx(2.0 * BEFORE)
    # What stands at the target itself is within it, and there is nothing to change.
    same = Known(lambda _: 0.25, 0.25)
    assert same.least(made, 1.0)[0] == 0.0
    assert len(same.tried) == 1
    for share in (0.2501, 1.0):
        never = Known(lambda _, share=share: share, 0.25)  # type: ignore[misc]
        assert never.least(made, 1.0)[0] is None
        assert never.tried[-1] == pytest.approx(2.0 * BEFORE)


def test_a_probability_that_is_not_known_ends_the_search() -> None:
    search = Known(lambda width: 0.9 if width < 0.25 else math.nan, 0.1)
    change, case = search.least(made, 2.0)
    assert change is None
    assert math.isnan(case.probability)
    assert search.unknown


def test_a_change_is_in_reach_where_a_block_of_it_rocks() -> None:
    for most in (0.25, 0.5, 0.5999):
        result = Known(normal(0.5, 0.3), 0.1, most=most).reach(made, 2.0)
        assert 0.0 <= most / BEFORE - 1.0 - result <= 0.01, most
    for most in (0.6 + 1e-12, 0.7):
        assert Known(normal(0.5, 0.3), 0.1, most=most).reach(made, 2.0) == 2.0


def remedy(**fields: Any) -> Remedy:
    usual: dict[str, Any] = {"name": "width", "words": "widen", "probability": 0.25}
    return Remedy(**{**usual, "basis": "curve", **fields})


def test_a_remedy_in_words_and_in_keys() -> None:
    for fields, words in (
        ({}, "widen"),
        ({"value": 0.3}, "widen; the probability is then 25 %"),
        ({"value": 0.0}, "widen; the probability is then 25 %"),
        ({"value": 0.3, "basis": "statics"}, "widen; the demand then does not lift it"),
        ({"basis": "statics"}, "widen"),
        (
            {"value": 0.3, "basis": "count", "fell": 2, "trials": 8},
            "widen; then 2 of 8 runs fall at the demand",
        ),
        (
            {"value": 0.3, "basis": "count", "fell": 1, "trials": 1},
            "widen; then 1 of 1 run falls at the demand",
        ),
    ):
        result = remedy(**fields).result
        assert result.replace("0.25", "25 %") == words or result == words, (fields, result)
    values = remedy(value=0.3, unit="m", change=0.5, fell=0, trials=8).to_dict()
    assert (values["probability"], values["value"], values["unit"]) == (0.25, 0.3, "m")
    assert values["confirmed"] is False
    assert remedy(probability=math.nan).to_dict()["probability"] is None


def test_the_cheapest_remedy_changes_least() -> None:
    far, near, none = remedy(change=0.5), remedy(change=0.2), remedy()
    assert cheapest([far, none, near]) is near
    assert cheapest([none, far]) is far
    assert cheapest([remedy(change=0.0), near]) == remedy(change=0.0)
    assert cheapest([none]) is None
    assert cheapest([]) is None
