"""Blocks against a wall: its restitution from momentum, and what such a block is equal to."""

import json
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rocksteady import Block, DimensionlessBlock
from rocksteady.errors import InputError, ModelError
from rocksteady.model.facts import block_text, block_values, case_text, restitution_values
from tests.every import every
from tests.model.blocks.test_asymmetric import cloud, distances, heights, momentum, turned

FACADE = Block.rectangle(width=0.3, height=3.0)
LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)


@given(distances, distances, heights, st.integers(0, 1000))
def test_three_impacts_conserve_the_angular_momentum_of_a_cloud_of_points(
    left: float, right: float, height: float, seed: int
) -> None:
    """Base, wall and base again: each about the point that is struck, of any mass distribution.

    A block that falls back about its left edge strikes its base with the right one.  About that it
    strikes the wall with the corner above, about which it turns back.  That angular velocity it has
    about the right edge when its base strikes with the left one.
    """
    places, masses = cloud(np.random.default_rng(seed), left, 0.5 * height)
    arms = places - np.array([left, 0.5 * height])
    gyration = math.sqrt(float(masses @ (arms * arms).sum(axis=1)) / float(masses.sum()))
    block = Block.asymmetric(
        left=left, right=right, height=height, gyration=gyration, restitution=1.0
    )
    edges = {"left": np.zeros(2), "right": np.array([left + right, 0.0])}
    corner = np.array([left + right, height])
    rate = -1.0  # clockwise: back to the wall
    for before, after in (
        (edges["left"], edges["right"]),
        (edges["right"], corner),
        (edges["right"], edges["left"]),
    ):
        kept = momentum(places, masses, turned(places, before, rate), after)
        rate = kept / momentum(places, masses, turned(places, after, 1.0), after)
    assume(rate > 1e-3)
    try:
        found = block.against_wall().restitution
    except InputError:  # struck by the base alone it would turn about: no block to rock
        assume(False)
    assert found == pytest.approx(rate, rel=1e-9)


@given(st.floats(0.51, 0.99), st.floats(1e-3, 1.0))
def test_the_closed_form_of_a_symmetric_block_has_the_limits_of_the_literature(
    share: float, part: float
) -> None:
    stockiest = min(math.acos(math.sqrt(0.5 / share)), math.asin(math.sqrt(0.5 / share)))
    alpha = part * stockiest * (1.0 - 1e-9)
    block = Block.general(
        mass=1.0, inertia=1.0 / share, radius=1.0, alpha=alpha, restitution=1.0
    ).against_wall()
    sine, cosine = math.sin(alpha) ** 2, math.cos(alpha) ** 2
    expected = (1.0 - 2.0 * share * sine) ** 2 * abs(1.0 - 2.0 * share * cosine)
    assert block.restitution == pytest.approx(expected, rel=1e-6, abs=1e-9)


def test_a_slender_rectangle_keeps_half_and_the_stockiest_that_turns_back_nothing() -> None:
    slender = Block.rectangle(width=1e-3, height=10.0).against_wall()
    assert slender.restitution == pytest.approx(0.5, abs=1e-7)
    least = math.acos(math.sqrt(2.0 / 3.0))
    stocky = Block.from_radius(alpha=least * (1.0 - 1e-9), radius=1.0).against_wall()
    assert 0.0 <= stocky.restitution < 1e-8
    with pytest.raises(InputError, match="is not turned back by a wall"):
        Block.from_radius(alpha=least * (1.0 + 1e-6), radius=1.0).against_wall()
    # As published for a wall of slenderness 10: (1 - 1.5/101)^2 (150/101 - 1).
    assert FACADE.against_wall().restitution == pytest.approx(
        (1.0 - 1.5 / 101.0) ** 2 * (150.0 / 101.0 - 1.0), rel=1e-14
    )


@every("free", [FACADE, LEANING, Block.named("gas-cylinder")])
def test_a_wall_changes_nothing_but_side_and_restitution(free: Block) -> None:
    block = free.against_wall(0.4)
    assert (block.alpha, block.radius, block.p) == (free.alpha, free.radius, free.p)
    assert (block.width, block.height, block.uplift_acceleration) == (
        free.width,
        free.height,
        free.uplift_acceleration,
    )
    assert block.restitution == 0.4
    assert block.one_sided
    assert not block.symmetric
    assert not free.one_sided
    assert block != free
    assert block.dimensionless() == DimensionlessBlock(restitution=0.4, one_sided=True)
    assert block.dimensionless().dimensionless() == block.dimensionless()


def test_blocks_that_differ_in_what_no_longer_counts_are_equal() -> None:
    one = Block.rectangle(width=0.3, height=3.0, restitution=0.9).against_wall(0.5)
    other = Block.rectangle(width=0.3, height=3.0, restitution=0.8).against_wall(0.5)
    assert one == other
    assert hash(one) == hash(other)
    assert one != one.against_wall(0.6)
    assert one.with_restitution(0.6) == one.against_wall(0.6)
    assert one.with_restitution("housner") == FACADE.against_wall()
    assert one.with_restitution(("housner", 0.9)).restitution == pytest.approx(
        0.9 * FACADE.against_wall().restitution
    )
    assert replace(one, wall_restitution=0.6) == one.against_wall(0.6)
    assert pickle.loads(pickle.dumps(one)) == one
    assert one.lossless is False
    assert one.against_wall(1.0).lossless
    assert one.against_wall(1.0).dimensionless().lossless


@every("ratio", [-0.1, 1.1, math.nan, "0.5", None, True])
def test_a_restitution_of_no_wall_is_refused(ratio: object) -> None:
    with pytest.raises(InputError, match="restitution"):
        FACADE.against_wall(ratio)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="restitution"):
        DimensionlessBlock(restitution=ratio, one_sided=True)  # type: ignore[arg-type]


def test_a_wall_has_one_restitution_and_no_other_side() -> None:
    with pytest.raises(ModelError, match="a block against a wall has one restitution"):
        FACADE.against_wall().with_restitution((0.5, 0.6))
    for other in ({"negative_restitution": 0.5}, {"alpha_ratio": 1.5}, {"p_ratio": 0.9}):
        with pytest.raises(ModelError, match="rocks on its positive side alone"):
            DimensionlessBlock(restitution=0.5, one_sided=True, **other)


def test_a_description_has_the_wall_and_nothing_of_the_other_side() -> None:
    found = FACADE.against_wall(0.5).describe()
    assert found.headline == "0.3 x 3 m block against a wall, alpha 5.71°, restitution 0.5"
    values = json.loads(json.dumps(found.to_dict()))
    assert values == {
        "one_sided": True,
        "alpha_rad": FACADE.alpha,
        "radius_m": FACADE.radius,
        "p_rad_s": FACADE.p,
        "restitution": 0.5,
    }
    leaning = LEANING.against_wall(("housner", 0.9))
    values = leaning.describe().to_dict()
    assert "negative" not in values
    assert (values["left_m"], values["right_m"]) == pytest.approx((0.15, 0.25))
    assert values["housner_factor"] == 0.9
    assert "(0.9 of that from angular momentum)" in str(leaning)
    assert "one_sided" not in FACADE.describe().to_dict()
    bare = DimensionlessBlock(restitution=0.0, one_sided=True)
    assert bare.describe().to_dict() == {"restitution": 0.0, "one_sided": True}
    assert "against a wall" in str(bare)


def test_a_description_begins_with_what_a_block_is() -> None:
    first = [
        (FACADE, "size"),
        (LEANING, "sides"),
        (FACADE.against_wall(0.5), "sides"),
        (FACADE.capped(columns=2, cap_mass_ratio=1.0), "frame"),
        (FACADE.capped(columns=2, cap_mass_ratio=1.0).against_wall(0.5), "sides"),
    ]
    assert [block.describe().facts[0].label for block, _ in first] == [label for _, label in first]


@pytest.mark.parametrize("free", [FACADE, LEANING])
def test_results_and_titles_name_the_wall_and_one_side(free: Block) -> None:
    block = free.against_wall(0.5)
    values = block_values(block)
    shown = block.describe().to_dict()
    assert {name: shown[name] for name in values} == values
    assert restitution_values(block) == {"restitution": 0.5, "one_sided": True}
    for text in (block_text(block), case_text(block)):
        assert "against a wall, restitution 0.5" in text
        assert "/" not in text.replace("rad/s", "")


def test_a_restitution_of_minus_zero_is_zero() -> None:
    # Of a free side the kernels read -0 as a wall: no table or store has it for a number.
    block = Block.rectangle(width=0.3, height=3.0).against_wall(-0.0)
    assert str(block.restitution) == "0.0"
    assert str(DimensionlessBlock(restitution=-0.0, one_sided=True).restitution) == "0.0"
