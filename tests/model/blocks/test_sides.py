"""Sides of a block: friction at an impact, and which sides belong to one body."""

import math

import pytest

from rocksteady import Block
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import impact_restitution
from rocksteady.model.blocks.caps import Cap
from rocksteady.model.blocks.sides import (
    Side,
    check_one_body,
    impact_friction,
    same_shape,
    wall_ratio,
)


def test_the_friction_of_an_impact_is_that_of_its_impulses() -> None:
    """The mass centre moves at right angles to the line to its pivot, before and after."""
    for left, right, height, ratio in (
        (0.2, 0.2, 1.2, 0.85),
        (0.15, 0.3, 1.0, 0.7),
        (0.4, 0.1, 2.0, 0.95),
        (0.2, 0.2, 1.2, 1.0),
    ):
        block = Block.asymmetric(left=left, right=right, height=height, restitution=ratio)
        for from_side, to_side, b, struck in (
            (block.positive, block.negative, left, right),
            (block.negative, block.positive, right, left),
        ):
            h = 0.5 * height
            # Rotation about the left pivot towards the floor: the centre goes across and down.
            before = (h, -b)
            after = (ratio * h, ratio * struck)
            across, upwards = before[0] - after[0], after[1] - before[1]
            assert impact_friction(from_side, to_side) == pytest.approx(across / upwards, rel=1e-12)
    like = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
    closed = 0.2 / 1.8 / math.tan(like.alpha)
    assert impact_friction(like.positive, like.negative) == pytest.approx(closed, rel=1e-12)


def test_two_sides_are_of_one_body_to_a_millionth() -> None:
    block = Block.asymmetric(left=0.15, right=0.3, height=1.0)
    one, other, g = block.positive, block.negative, block.gravity
    check_one_body(one, other, g)
    check_one_body(one, one, g)
    for off, fit in ((5e-7, True), (-5e-7, True), (2e-6, False), (-2e-6, False)):
        taller = Side(
            alpha=math.atan2(0.3, 0.5 * (1.0 + off)),
            radius=math.hypot(0.3, 0.5 * (1.0 + off)),
            p=other.p,
            restitution=other.restitution,
        )
        # g R/p^2 moves by twice as much as p, of which the other half is the moment about R.
        slower = Side(
            alpha=other.alpha,
            radius=other.radius,
            p=other.p * (1.0 + 0.3 * off),
            restitution=other.restitution,
        )
        if fit:
            check_one_body(one, slower, g)
        else:
            with pytest.raises(ModelError, match=r"height of the one mass centre"):
                check_one_body(one, taller, g)
            steeper = Side(
                alpha=other.alpha,
                radius=other.radius,
                p=other.p * (1.0 + 2.0 * off),
                restitution=other.restitution,
            )
            with pytest.raises(ModelError, match="squared radius of gyration"):
                check_one_body(one, steeper, g)


def test_sides_have_one_shape_where_their_restitutions_alone_differ() -> None:
    side = Block.rectangle(width=0.4, height=1.2).positive
    values = {"alpha": side.alpha, "radius": side.radius, "p": side.p, "restitution": 0.5}
    assert same_shape(side, Side(**values))
    for name in ("alpha", "radius", "p"):
        assert not same_shape(side, Side(**(values | {name: values[name] * 1.001})))


def test_a_wall_turns_back_blocks_up_to_a_slenderness() -> None:
    # 2 (3/4) cos^2 alpha - 1 = 0 where cos^2 alpha = 2/3; the base's own factor ends later.
    border = math.acos(math.sqrt(2.0 / 3.0))
    for alpha in (0.05, 0.3, border * (1.0 - 1e-9)):
        side = Block.from_p(alpha=alpha, p=2.0, restitution=1.0).positive
        sine, cosine = math.sin(alpha), math.cos(alpha)
        expected = (1.0 - 1.5 * sine * sine) ** 2 * (1.5 * cosine * cosine - 1.0)
        assert wall_ratio(side, side, 9.80665) == pytest.approx(expected, rel=1e-9, abs=1e-12)
    beyond = Block.from_p(alpha=border * (1.0 + 1e-9), p=2.0, restitution=1.0).positive
    with pytest.raises(InputError, match="is not turned back by a wall"):
        wall_ratio(beyond, beyond, 9.80665)


def test_a_restitution_is_refused_where_it_is_not_above_zero() -> None:
    # With the mass in one point the ratio is cos(alpha1 + alpha2) R1/R2, 0 at a right angle.
    assert impact_restitution((0.7, 0.8), (1.0, 1.0), gyration=1e-9) > 0.0
    with pytest.raises(InputError, match="the restitution that conserves angular momentum is"):
        impact_restitution((0.8, 0.8), (1.0, 1.0), gyration=1e-9)


def test_the_centre_of_a_frame_moves_with_its_columns_and_its_cap() -> None:
    for ratio in (0.0, 0.5, 2.0, 1000.0):
        # Columns of mass 1 move by 1, the cap of mass `ratio` by 2.
        expected = (1.0 + 2.0 * ratio) / (1.0 + ratio)
        assert Cap(columns=3, cap_mass_ratio=ratio).lever == pytest.approx(expected)
        assert 1.0 <= Cap(columns=3, cap_mass_ratio=ratio).lever < 2.0
