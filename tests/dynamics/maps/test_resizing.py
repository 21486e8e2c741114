"""Blocks of other sizes: many at once, to the last bit those of the constructors."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock
from rocksteady.dynamics.maps._resizing import (
    block_of,
    check_sizes,
    measures_of,
    resized,
    sizes_with,
)
from rocksteady.errors import ModelError
from rocksteady.formulas import Outline
from tests.every import every

BASE = Block.rectangle(width=0.4, height=1.2, restitution=0.9, gravity=9.8)
LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
RING = Block.general(mass=1.0, inertia=2.0, radius=1.0, alpha=0.3, restitution=0.9)
RANGES = {
    "width": (0.05, 0.4),
    "height": (0.5, 5.0),
    "alpha": (0.02, 0.6),
    "radius": (0.2, 8.0),
    "p": (0.5, 6.0),
}


@every("sizes", [("width", "height"), ("alpha", "radius"), ("alpha", "p")])
@every("housner", [1.0, 0.965, None])
def test_measures_of_many_are_those_of_each_block(
    sizes: tuple[str, str], housner: float | None
) -> None:
    rng = np.random.default_rng(2)
    given: dict[str, Any] = {name: rng.uniform(*RANGES[name], 200) for name in sizes}
    found = measures_of(BASE, sizes, given, housner=housner)
    for at in range(200):
        cell = {name: values.item(at) for name, values in given.items()}
        block = resized(BASE, sizes, cell, ("housner", housner) if housner else 0.9)
        assert block.gravity == 9.8
        uplift, p, alpha = (
            np.broadcast_to(x, 200)[at] for x in (found.uplift, found.p, found.alpha)
        )
        assert (uplift, p, alpha) == (block.uplift_acceleration, block.p, block.alpha)
        assert np.broadcast_to(found.restitution, 200)[at] == block.restitution


def test_without_sizes_a_block_keeps_its_own() -> None:
    found = measures_of(RING, (), {"amplitude": 2.0}, housner=None)
    assert found == (RING.uplift_acceleration, RING.p, 0.9, RING.alpha)
    assert block_of(RING, (), {"amplitude": 2.0}, None) == RING
    assert block_of(RING, (), {}, 0.7) == RING.with_restitution(0.7)


def test_one_size_keeps_the_other_that_goes_with_it() -> None:
    assert sizes_with(["height", "phase"]) == ("width", "height")
    assert sizes_with(["radius"]) == ("alpha", "radius")
    assert sizes_with(["alpha"]) == ("alpha", "radius")
    assert sizes_with(["alpha", "p"]) == ("alpha", "p")
    assert sizes_with(["restitution", "amplitude"]) == ()


def test_the_ratios_of_a_bare_block_are_moved_with_its_restitution() -> None:
    bare = DimensionlessBlock(restitution=0.8, negative_restitution=0.7)
    moved = block_of(bare, (), {"alpha_ratio": 1.3, "p_ratio": 0.9, "amplitude": 2.0}, None)
    assert moved == DimensionlessBlock(
        restitution=0.8, negative_restitution=0.7, alpha_ratio=1.3, p_ratio=0.9
    )
    assert block_of(bare, (), {}, 0.6) == bare.with_restitution(0.6)


@every(
    ("block", "names", "words"),
    [
        (BASE, ["alpha_ratio"], "the sides of a block with a size follow from its shape"),
        (DimensionlessBlock(restitution=0.8), ["width"], "has no size to measure by"),
        (DimensionlessBlock(restitution=0.8), ["frequency_hz"], "has no size to measure by"),
        (LEANING, ["width"], "the sides of this block differ"),
        (replace(BASE, outline=Outline(height=3.0)), ["width"], "mass centre in the middle"),
        (RING, ["radius"], "whose p.2 R/g is 3/4; of this block it is 0.5"),
    ],
)
def test_what_a_block_does_not_have_is_refused(
    block: Block | DimensionlessBlock, names: list[str], words: str
) -> None:
    with pytest.raises(ModelError, match=words):
        check_sizes(block, names)


def test_what_it_has_passes() -> None:
    check_sizes(BASE, ["width", "acceleration_m_s2", "restitution"])
    check_sizes(RING, ["acceleration_m_s2", "frequency_hz"])
    check_sizes(LEANING, ["restitution", "amplitude"])
    check_sizes(DimensionlessBlock(restitution=0.8), ["alpha_ratio", "p_ratio"])
