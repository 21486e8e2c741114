"""The named blocks of the literature and of common equipment."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.model.blocks.examples import SOURCES
from rocksteady.model.facts import block_text
from tests.every import every


@every("name", SOURCES)
def test_every_named_block_can_be_made_and_cites_its_year(name: str) -> None:
    block = Block.named(name)
    assert 0.0 < block.restitution <= 1.0
    assert re.search(r"\((19|20)\d\d\)", SOURCES[name])
    assert Block.named(name, restitution=0.5).restitution == 0.5
    housner = Block.named(name, restitution="housner")
    for one, other in ((housner.positive, housner.negative), (housner.negative, housner.positive)):
        # Angular momentum about the edge that is struck; 1 - 1.5 sin^2 alpha of a rectangle.
        gyration = housner.gravity * one.radius / one.p**2 - one.radius**2
        apart = one.radius * other.radius * math.cos(one.alpha + other.alpha)
        ratio = (gyration + apart) / (gyration + other.radius**2)
        assert one.restitution == pytest.approx(ratio)
    assert Block.named(name, gravity=5.0).gravity == 5.0


def test_the_numbers_of_the_sources() -> None:
    paper = Block.named("tso-wong-1989")
    assert (paper.p, paper.restitution) == (2.0 * math.pi, 0.8)
    makris = Block.named("makris-roussos-2000")
    assert (makris.width, makris.height, makris.restitution) == pytest.approx((1.0, 3.0, 0.85))
    zhang = Block.named("zhang-makris-2001")
    assert (zhang.p, zhang.alpha, zhang.restitution) == (2.14, 0.25, 0.9)
    cabinet = Block.named("fema-p58-cabinet")
    assert (cabinet.width, cabinet.height) == pytest.approx((0.47244, 1.72085))
    rack = Block.named("server-rack")
    assert (rack.width, rack.height) == pytest.approx((0.6, 2.0))
    assert rack.height > 42 * 0.04445, "42 units fit"
    cylinder = Block.named("gas-cylinder")
    assert (cylinder.width, cylinder.height) == pytest.approx((0.229, 1.64))
    assert math.pi / 4.0 * 0.229**2 * 1.64 > 0.05, "50 litres fit"
    assert cabinet.restitution == pytest.approx(1.0 - 1.5 * math.sin(cabinet.alpha) ** 2)


@every("name", ["", "tso", "Tso-Wong-1989", None])
def test_an_unknown_name_is_answered_with_the_known_ones(name: str) -> None:
    with pytest.raises(InputError) as caught:
        Block.named(name)
    for known in SOURCES:
        assert known in str(caught.value)


def test_the_statue_has_the_mass_centre_and_the_inertia_of_a_fine_grid_of_points() -> None:
    boxes = ((0.0, 0.6, 0.0, 0.9, 2.0), (0.1, 0.6, 0.9, 2.6, 1.0))
    points, masses = [], []
    for left, right, low, high, mass in boxes:
        x, y = np.meshgrid(*((np.arange(400) + 0.5) / 400 for _ in range(2)))
        points.append(np.stack([left + (right - left) * x, low + (high - low) * y]).reshape(2, -1))
        masses.append(np.full(x.size, mass / x.size))
    where, weight = np.concatenate(points, axis=1), np.concatenate(masses)
    centre = (where * weight).sum(axis=1) / weight.sum()
    statue = Block.named("statue-on-plinth")
    assert statue.positive.distance == pytest.approx(centre[0], rel=1e-12)
    assert statue.width == pytest.approx(0.6)
    assert statue.positive.centre_height == pytest.approx(centre[1])
    assert statue.height == 2.6
    square = float((((where - centre[:, None]) ** 2).sum(axis=0) * weight).sum() / weight.sum())
    side = statue.positive
    found = statue.gravity * side.radius / side.p**2 - side.radius**2
    assert found == pytest.approx(square, rel=1e-5)
    assert not statue.symmetric


def test_the_statue_and_its_plinth_are_named_as_one_body() -> None:
    """In the answer's line of the block, off a wall, with another restitution; of no other."""
    statue = Block.named("statue-on-plinth")
    words = "(statue and plinth as one body)"
    for block in (statue, statue.with_restitution(0.9), statue.against_wall(), replace(statue)):
        assert words in block.describe().headline
    assert "statue and plinth as one body" in block_text(statue)
    others = [Block.named(name) for name in SOURCES if name != "statue-on-plinth"]
    assert not any("as one body" in block.describe().headline for block in others)


def test_the_gas_cylinder_has_the_inertia_of_points_on_a_thin_tube() -> None:
    angle, height = np.meshgrid(
        2.0 * np.pi * np.arange(100) / 100, 1.64 * (np.arange(1000) + 0.5) / 1000
    )
    from_middle = (0.5 * 0.229 * np.cos(angle)) ** 2 + (height - 0.82) ** 2
    cylinder = Block.named("gas-cylinder")
    side = cylinder.positive
    found = cylinder.gravity * side.radius / side.p**2 - side.radius**2
    assert found == pytest.approx(from_middle.mean(), rel=2e-6)


@every("name", sorted(SOURCES))
def test_a_named_body_is_the_same_body_under_another_gravity(name: str) -> None:
    here, there = Block.named(name), Block.named(name, gravity=1.62)
    assert (there.width, there.height) == (here.width, here.height)
    assert there.p == pytest.approx(here.p * math.sqrt(1.62 / 9.80665), rel=1e-14)
    assert there == replace(here, gravity=1.62)
