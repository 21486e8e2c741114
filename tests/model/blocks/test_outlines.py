"""The outline of a block: it travels with the block, and moves nothing."""

import math
import pickle
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.formulas import Outline
from rocksteady.model.facts import block_values
from rocksteady.sweep.cases.inputs import plain
from tests.every import every

TALL = {"left": 0.2, "right": 0.3, "height": 1.8, "mass_centre_height": 0.5}


def test_full_height_and_mass_centre_are_two_numbers() -> None:
    block = Block.asymmetric(**TALL)
    assert block.height == 1.8
    assert block.positive.centre_height == pytest.approx(0.5, rel=1e-14)
    half = replace(Block.asymmetric(left=0.2, right=0.3, height=1.0), outline=None)
    assert block.positive.alpha == half.positive.alpha
    square = (0.5**2 + 1.8**2) / 12.0  # the radius of gyration of the rectangle that it fills
    assert block.p == pytest.approx(
        math.sqrt(9.80665 * block.radius / (square + block.radius**2)), rel=1e-14
    )
    assert Block.asymmetric(left=0.2, right=0.3, height=1.8, mass_centre_height=0.9) == (
        Block.asymmetric(left=0.2, right=0.3, height=1.8)
    )


WAYS: dict[str, Callable[[Block], Block]] = {
    "wall": lambda block: block.against_wall(0.4),
    "restitution": lambda block: block.with_restitution(0.7),
    "wall and restitution": lambda block: block.against_wall(0.5).with_restitution(0.2),
    "replace": lambda block: replace(block, gravity=block.gravity),
    "pickle": lambda block: pickle.loads(pickle.dumps(block)),
}


@every("way", WAYS)
def test_it_travels_with_the_block(way: str) -> None:
    beyond = Outline(height=1.8, left_overhang=0.1, right_overhang=0.05)
    for block in (Block.asymmetric(**TALL), replace(Block.asymmetric(**TALL), outline=beyond)):
        made = WAYS[way](block)
        assert (made.height, made.overhangs) == (1.8, block.overhangs)


def test_another_mass_centre_leaves_a_rectangle_as_high() -> None:
    """Ballast at the foot of a rectangle does not shorten it."""
    block = Block.rectangle(width=0.5, height=1.8)
    low = Block.asymmetric(left=0.25, right=0.25, height=1.0)
    ballasted = replace(block, positive=low.positive, negative=low.negative)
    assert ballasted.height == block.height == pytest.approx(1.8, rel=1e-14)


def test_a_general_body_has_the_height_that_is_given() -> None:
    sizes = {"mass": 100.0, "inertia": 60.0, "radius": 0.6, "alpha": 0.3}
    assert Block.general(**sizes, height=1.5).height == 1.5
    assert Block.general(**sizes).height == pytest.approx(1.2 * math.cos(0.3), rel=1e-14)
    with pytest.raises(InputError, match=r"height = 0\.5 .* the mass centre, 0\.573202 m above"):
        Block.general(**sizes, height=0.5)


@pytest.mark.parametrize("centre", [1.2, 0.0, math.nan])
def test_a_mass_centre_outside_is_refused(centre: float) -> None:
    with pytest.raises(InputError, match="mass_centre_height"):
        Block.asymmetric(left=0.2, right=0.2, height=1.0, mass_centre_height=centre)


def test_an_outline_that_does_not_hold_its_body_is_refused() -> None:
    with pytest.raises(InputError, match="left_overhang"):
        Outline(height=1.0, left_overhang=-0.1)
    with pytest.raises(InputError, match="height"):
        Outline(height=0.0)
    with pytest.raises(InputError, match=r"height = 0\.8 .* mass centre, 0\.9 m above the base"):
        replace(Block.rectangle(width=0.5, height=1.8), outline=Outline(height=0.8))


def test_blocks_of_unlike_outlines_differ() -> None:
    """Their tops move differently, in a store too, whatever moves them alike."""
    one, other = Block.asymmetric(**TALL), Block.asymmetric(**TALL, gyration=0.6)
    higher = replace(other, outline=Outline(height=2.0))
    assert replace(one, positive=other.positive, negative=other.negative) == other != higher
    assert hash(other) != hash(higher)
    assert plain(other, "block") != plain(higher, "block")
    assert [other.positive, other.negative] == [higher.positive, higher.negative]


def test_a_height_that_is_twice_that_of_the_mass_centre_makes_no_other_block() -> None:
    """Whichever way it is given: 2 R cos(alpha) and the height differ by rounding."""
    for height in np.random.default_rng(8803).uniform(1.0, 3.0, 50).tolist():
        block = Block.rectangle(width=0.5, height=height)
        beyond = Outline(height=height * (1.0 + 1e-14), right_overhang=0.1)
        assert replace(block, outline=Outline(height=height * (1.0 + 1e-14))) == block
        assert replace(block, outline=beyond).height == block.height == pytest.approx(height)
        sizes = {"mass": 1.0, "inertia": 9.0, "radius": block.radius, "alpha": block.alpha}
        assert Block.general(**sizes, height=height) == Block.general(**sizes)


def test_the_values_in_json_make_the_block_again() -> None:
    """Sizes of the base, of the outline and of the body, and what is fixed to each other."""
    block = Block.asymmetric(**TALL, gyration=0.6)
    wide = Outline(height=1.8, left_overhang=0.1, right_overhang=0.2)
    block = replace(block, outline=wide, parts="bust and pedestal")
    values = block_values(block)
    alpha, radius, p = (values[key] for key in ("alpha_rad", "radius_m", "p_rad_s"))
    again = Block.asymmetric(
        left=radius * math.sin(alpha),
        right=values.get("right_m", radius * math.sin(alpha)),
        height=values["height_m"],
        mass_centre_height=values["mass_centre_height_m"],
        gyration=math.sqrt(9.80665 * radius / p**2 - radius**2),
    )
    assert again.positive.alpha == pytest.approx(alpha, rel=1e-12)
    assert again.positive.p == pytest.approx(p, rel=1e-12)
    assert tuple(values["overhangs_m"]) == (wide.left_overhang, wide.right_overhang)
    assert values["parts"] == "bust and pedestal"


@every("height", np.random.default_rng(8804).uniform(0.5, 3.0, 20).tolist())
def test_a_mass_centre_may_be_at_the_top(height: float) -> None:
    """Its height comes back from R cos(alpha) with a rounding."""
    block = Block.asymmetric(left=0.2, right=0.3, height=height, mass_centre_height=height)
    assert block.height == height


def test_a_description_has_height_and_mass_centre() -> None:
    block = Block.asymmetric(**TALL)
    values = block.to_dict()
    assert (values["height_m"], values["mass_centre_height_m"]) == pytest.approx((1.8, 0.5))
    assert "0.5 x 1.8 m block with its mass centre at 0.5 m" in repr(block)
    wide = replace(block, outline=Outline(height=1.8, left_overhang=0.1, right_overhang=0.1))
    assert "0.7 x 1.8 m block on a base of 0.5 m with its mass centre at 0.5 m" in repr(wide)
    assert "mass_centre_height_m" not in Block.asymmetric(left=0.2, right=0.3, height=1.0).to_dict()


@every("raised", [0.8, 1.0, 1.3, 1.6])
def test_a_wall_gives_no_energy_whatever_the_outline(raised: float) -> None:
    """Impacts that pass on their angular velocity keep at most all of it; no outline counts."""
    sizes = {"left": 0.15, "right": 0.15, "height": 3.0, "mass_centre_height": 1.5 * raised}
    body = Block.asymmetric(**sizes, gyration=0.7)
    low = Block.asymmetric(left=0.15, right=0.15, height=3.0 * raised, gyration=0.7)
    assert body.against_wall().restitution == low.against_wall().restitution < 1.0
