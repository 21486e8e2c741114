"""Words that branches share: what they name of a block and of its model."""

import math
from typing import Any

import pytest

from rocksteady import Block, DimensionlessBlock, Linear, Nonlinear
from rocksteady.model.equations import Model
from rocksteady.model.facts import AnyBlock
from rocksteady.words import _branch_cases
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
UNLIKE = DimensionlessBlock(restitution=0.8, alpha_ratio=1.2, p_ratio=0.9)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
SIDES = Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=(0.85, 0.8))
LINEAR, NONLINEAR = Linear(), Nonlinear()
LEANS = math.atan2(0.15, 0.6), math.atan2(0.2, 0.6)


def pull(foot: float) -> float:
    """Return p squared over g about a foot beside the middle of mass: R over the inertia."""
    square = foot**2 + 0.6**2
    return math.sqrt(square) / ((0.35**2 + 1.2**2) / 12.0 + square)


UNEQUAL = {
    "negative_restitution": 0.8,
    "alpha_ratio": LEANS[1] / LEANS[0],
    "p_ratio": math.sqrt(pull(0.2) / pull(0.15)),
}


@every(
    ("block", "model", "text", "expected"),
    [
        (BARE, LINEAR, "linear model", {}),
        (BARE, NONLINEAR, "nonlinear model", {}),
        (SIZED, LINEAR, "linear model", {}),
        (SIZED, NONLINEAR, "nonlinear model, alpha 0.321751 rad", {"alpha_rad": SIZED.alpha}),
        (UNLIKE, LINEAR, "linear model", {"alpha_ratio": 1.2, "p_ratio": 0.9}),
        (SIDES, LINEAR, "linear model", UNEQUAL),
        (
            SIDES,
            NONLINEAR,
            "nonlinear model, alpha 0.244979/0.321751 rad",
            {"alpha_rad": list(LEANS), **UNEQUAL},
        ),
    ],
)
def test_equations_name_what_they_need_of_a_block(
    block: AnyBlock, model: Model, text: str, expected: dict[str, Any]
) -> None:
    assert _branch_cases.model_text(block, model) == text
    facts = _branch_cases.model_facts(block, model)
    values = {fact.key: fact.value for fact in facts}
    assert values.pop("model") == model.name
    assert values.keys() == expected.keys()
    for key, value in expected.items():
        assert values[key] == pytest.approx(value, rel=1e-12)
    beside = _branch_cases.model_facts_over(block, model, ["restitution"])
    left = {"alpha_ratio", "p_ratio"} if block is UNLIKE else set()
    assert {fact.key for fact in beside} == {"model", *left}


def test_a_restitution_that_moves_is_none_of_a_block() -> None:
    unlike = SIDES.dimensionless()
    for moving, keys in ((["amplitude"], {"negative_restitution"}), (["restitution"], set())):
        facts = _branch_cases.model_facts_over(unlike, LINEAR, moving)
        assert {fact.key for fact in facts} == {"alpha_ratio", "p_ratio", "model", *keys}
    fixed, free = (_branch_cases.block_fact(SIDES, names) for names in ([], ["restitution"]))
    values: list[Any] = [each.value for each in (fixed, free)]
    assert [each["restitution"] for each in values] == [0.85, None]
    assert [each["negative"]["restitution"] for each in values] == [0.8, None]
    assert fixed.words == free.words + ", restitution 0.85/0.8"
    statue = _branch_cases.block_fact(Block.named("statue-on-plinth"), ["restitution"])
    assert statue.words.endswith(" rad/s, statue and plinth as one body")
    values = [_branch_cases.block_fact(SIZED, ["restitution"]).value]
    assert "negative" not in values[0]
    assert [_branch_cases.kept_text(block) for block in (SIDES, SIZED)] == ["0.85/0.8", "0.8"]
