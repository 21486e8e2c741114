"""Blocks whose sides differ: their constructors against a cloud of mass points."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady import Block, DimensionlessBlock
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import Side, housner_restitution, impact_restitution
from tests.every import every
from tests.strategies import logarithmic

Floats = NDArray[np.float64]

distances = logarithmic(0.05, 1.0)
heights = logarithmic(2.0, 10.0)
LEFT, RIGHT, HEIGHT = 0.15, 0.25, 1.2


def cloud(rng: np.random.Generator, left: float, height: float) -> tuple[Floats, Floats]:
    """Return places and masses of points whose centre is at (left, height) from the left edge."""
    places = rng.normal(0.0, 0.3 * height, (40, 2))
    masses = rng.uniform(0.1, 2.0, 40)
    places -= masses @ places / masses.sum()
    return places + np.array([left, height]), masses


def turned(places: Floats, pivot: Floats, rate: float) -> Floats:
    """Return the velocities of points that turn about a pivot."""
    arm = places - pivot
    return rate * np.column_stack([-arm[:, 1], arm[:, 0]])


def momentum(places: Floats, masses: Floats, velocities: Floats, about: Floats) -> float:
    """Return the angular momentum of points."""
    arm = places - about
    turning = arm[:, 0] * velocities[:, 1] - arm[:, 1] * velocities[:, 0]
    return float(masses @ turning)


@given(distances, distances, heights, st.integers(0, 10_000))
def test_the_restitution_keeps_the_angular_momentum_about_the_edge_that_is_struck(
    left: float, right: float, height: float, seed: int
) -> None:
    places, masses = cloud(np.random.default_rng(seed), left, 0.5 * height)
    centre = np.array([left, 0.5 * height])
    gyration = math.sqrt(float(masses @ ((places - centre) ** 2).sum(1)) / masses.sum())
    block = Block.asymmetric(left=left, right=right, height=height, gyration=gyration)
    edges = np.array([0.0, 0.0]), np.array([left + right, 0.0])
    for side, leaves, strikes in (
        (block.positive, edges[0], edges[1]),
        (block.negative, edges[1], edges[0]),
    ):
        before = momentum(places, masses, turned(places, leaves, 0.7), strikes)
        one = momentum(places, masses, turned(places, strikes, 1.0), strikes)
        assert side.restitution == pytest.approx(before / one / 0.7, rel=1e-11)
        # p^2 = M g R / I_0, I_0 about the pivot of the side
        inertia = momentum(places, masses, turned(places, leaves, 1.0), leaves)
        arm = centre - leaves
        radius = math.hypot(*arm)
        assert side.radius == pytest.approx(radius, rel=1e-13)
        assert side.alpha == pytest.approx(math.atan(abs(arm[0]) / arm[1]), rel=1e-13)
        square = masses.sum() * block.gravity * radius / inertia
        assert side.p == pytest.approx(math.sqrt(square), rel=1e-12)


@given(distances, distances, heights)
def test_without_a_gyration_it_is_that_of_the_rectangle(
    left: float, right: float, height: float
) -> None:
    block = Block.asymmetric(left=left, right=right, height=height, restitution=0.9)
    gyration = math.sqrt(((left + right) ** 2 + height**2) / 12.0)
    same = Block.asymmetric(
        left=left, right=right, height=height, gyration=gyration, restitution=0.9
    )
    for one, other in ((block.positive, same.positive), (block.negative, same.negative)):
        assert dataclasses.astuple(one) == pytest.approx(dataclasses.astuple(other), rel=1e-13)
    assert (block.width, block.height) == pytest.approx((left + right, height), rel=1e-13)


@given(distances, heights, st.sampled_from(["housner", 0.8]))
def test_with_its_mass_centre_in_the_middle_it_is_the_symmetric_block_to_the_last_bit(
    half: float, height: float, restitution: Any
) -> None:
    block = Block.asymmetric(left=half, right=half, height=height, restitution=restitution)
    assert block == Block.rectangle(width=2.0 * half, height=height, restitution=restitution)
    assert block.symmetric
    alpha = block.alpha
    by_angles = Block.from_alphas(positive=alpha, negative=alpha, radius=1.1)
    assert by_angles == Block.from_radius(alpha=alpha, radius=1.1)
    by_rate = Block.from_alphas(positive=alpha, negative=alpha, p=2.0)
    assert by_rate == Block.from_p(alpha=alpha, p=2.0)
    heavy = Block.asymmetric(left=half, right=half, height=height, gyration=0.1)
    assert heavy.symmetric
    assert heavy.restitution == pytest.approx(
        housner_restitution(alpha, p=heavy.p, radius=heavy.radius, gravity=heavy.gravity)
    )


@given(distances, distances, heights, logarithmic(0.5, 2.0))
def test_the_constructors_agree(left: float, right: float, height: float, gravity: float) -> None:
    assume(left != right)
    block = Block.asymmetric(left=left, right=right, height=height, gravity=gravity)
    angles = {"positive": block.positive.alpha, "negative": block.negative.alpha}
    for size in ({"radius": block.radius}, {"p": block.p}):
        other = Block.from_alphas(**angles, **size, gravity=gravity)
        for one, two in (
            (block.positive, other.positive),
            (block.negative, other.negative),
        ):
            assert dataclasses.astuple(one) == pytest.approx(dataclasses.astuple(two), rel=1e-12)
    assert block.positive.centre_height == pytest.approx(block.negative.centre_height, rel=1e-13)
    assert (block.positive.distance, block.negative.distance) == pytest.approx((left, right))


def test_swapping_the_edges_swaps_the_sides() -> None:
    one = Block.asymmetric(left=LEFT, right=RIGHT, height=HEIGHT)
    other = Block.asymmetric(left=RIGHT, right=LEFT, height=HEIGHT)
    assert (one.positive, one.negative) == (other.negative, other.positive)


def test_the_equal_sides_of_the_formula_are_housners() -> None:
    gyration = math.sqrt(1.0 / 3.0)  # of a rectangle with R = 1
    found = impact_restitution((0.3, 0.3), (1.0, 1.0), gyration=gyration)
    assert found == pytest.approx(housner_restitution(0.3), rel=1e-14)


def test_a_restitution_counts_for_both_impacts_and_a_pair_for_each() -> None:
    sizes = {"left": LEFT, "right": RIGHT, "height": HEIGHT}
    both = Block.asymmetric(**sizes, restitution=0.8)
    assert (both.positive.restitution, both.negative.restitution) == (0.8, 0.8)
    each = Block.asymmetric(**sizes, restitution=(0.8, 0.9))
    assert (each.positive.restitution, each.negative.restitution) == (0.8, 0.9)
    assert both.with_restitution((0.8, 0.9)) == each
    assert each.with_restitution(0.8) == both
    lopsided = Block.asymmetric(left=0.2, right=0.2, height=HEIGHT, restitution=(0.8, 0.9))
    assert not lopsided.symmetric
    assert not lopsided.lossless
    assert both.with_restitution(1.0).lossless


def test_what_the_equation_of_motion_sees_counts_in_units_of_the_positive_side() -> None:
    block = Block.asymmetric(left=LEFT, right=RIGHT, height=HEIGHT)
    bare = block.dimensionless()
    assert bare.sides[0] == (block.positive.restitution, 1.0, 1.0)
    assert bare.sides[1] == (
        block.negative.restitution,
        block.negative.alpha / block.alpha,
        block.negative.p / block.p,
    )
    assert not bare.symmetric
    assert block.uplift_acceleration == block.positive.alpha * block.gravity


def test_dimensionless_blocks_that_move_alike_are_equal() -> None:
    assert DimensionlessBlock(restitution=0.8, negative_restitution=0.8) == DimensionlessBlock(
        restitution=0.8
    )
    lopsided = DimensionlessBlock(restitution=0.8, negative_restitution=0.9, alpha_ratio=1.2)
    assert lopsided.sides == ((0.8, 1.0, 1.0), (0.9, 1.2, 1.0))
    assert lopsided.with_restitution(0.7).sides == ((0.7, 1.0, 1.0), (0.7, 1.2, 1.0))
    assert not DimensionlessBlock(restitution=1.0, negative_restitution=0.9).lossless


@every("name", ["left", "right", "height", "gyration", "gravity"])
@every("value", [0.0, -1.0, math.nan, math.inf, "0.3", True])
def test_a_size_that_is_no_positive_number_is_refused(name: str, value: Any) -> None:
    with pytest.raises(InputError, match=name):
        Block.asymmetric(**{"left": 0.1, "right": 0.2, "height": 1.0, name: value})


@every("value", [0.0, 1.2, (0.8,), (0.8, 0.9, 0.7), (0.8, 0.0), "Housner", None])
def test_a_restitution_that_is_none_is_refused(value: Any) -> None:
    with pytest.raises(InputError, match="restitution"):
        Block.asymmetric(left=0.1, right=0.2, height=1.0, restitution=value)


def test_a_block_too_stocky_to_rock_on_is_refused() -> None:
    with pytest.raises(InputError, match="angular momentum"):
        Block.asymmetric(left=1.0, right=1.2, height=0.5)


@every(
    ("sizes", "said"),
    [
        ({}, "are all missing: "),
        ({"gyration": 0.5}, "do not fit, with gyration given: "),
        ({"radius": 1.0, "p": 2.0}, "do not fit, with radius and p given: "),
        ({"p": 2.0, "gyration": 0.5}, "do not fit, with p and gyration given: "),
    ],
)
def test_one_length_or_rate_says_how_large_it_is(sizes: dict[str, float], said: str) -> None:
    with pytest.raises(ModelError, match=f"^radius, p, gyration {said}a radius, with or without"):
        Block.from_alphas(positive=0.2, negative=0.3, **sizes)


@pytest.mark.parametrize("angle", ["positive", "negative"])
def test_an_angle_outside_its_range_is_refused_by_its_own_name(angle: str) -> None:
    with pytest.raises(InputError, match=angle):
        Block.from_alphas(**{"positive": 0.2, "negative": 0.3, angle: 1.6}, radius=1.0)


def test_sides_of_no_one_body_are_refused() -> None:
    block = Block.asymmetric(left=LEFT, right=RIGHT, height=HEIGHT)
    higher = dataclasses.replace(block.negative, radius=1.01 * block.negative.radius)
    with pytest.raises(ModelError, match="height of the one mass centre"):
        Block(positive=block.positive, negative=higher)
    faster = dataclasses.replace(block.negative, p=1.01 * block.negative.p)
    with pytest.raises(ModelError, match="gyration"):
        Block(positive=block.positive, negative=faster)
    side = Side(alpha=0.3, radius=0.7, p=3.0, restitution=0.9)
    again = Block(positive=side, negative=dataclasses.replace(side, restitution=0.5))
    assert again.dimensionless().sides == ((0.9, 1.0, 1.0), (0.5, 1.0, 1.0))


@every("name", ["alpha_ratio", "p_ratio", "negative_restitution"])
def test_a_ratio_outside_its_range_is_refused(name: str) -> None:
    for value in (0.0, -1.0, 1000.0, math.nan, "1"):
        arguments: dict[str, Any] = {"restitution": 0.8, name: value}
        with pytest.raises(InputError, match=name):
            DimensionlessBlock(**arguments)


def test_a_notebook_shows_both_sides() -> None:
    block = Block.asymmetric(left=LEFT, right=RIGHT, height=HEIGHT)
    table = block._repr_html_()
    one, other = (math.degrees(side.alpha) for side in (block.positive, block.negative))
    assert f"{one:.3g}° and {other:.3g}°" in table
    assert "positive (left)" in table
    assert block.to_dict()["negative"] == block.negative.to_dict()


def test_the_ratios_of_the_sides_are_facts_of_a_dimensionless_block() -> None:
    block = DimensionlessBlock(restitution=0.8, alpha_ratio=1.25, p_ratio=0.75)
    described = block.describe()
    facts = {fact.key: fact.value for fact in described.facts}
    assert facts == {"restitution": 0.8, "alpha_ratio": 1.25, "p_ratio": 0.75}
    assert described.headline.endswith("restitution 0.8, alpha ratio 1.25, p ratio 0.75")
