"""The named blocks of the literature."""

import math
import re

import pytest

from rocksteady import InputError, named_block
from rocksteady.model.blocks.examples import SOURCES


@pytest.mark.parametrize("name", SOURCES)
def test_every_named_block_can_be_made_and_cites_its_year(name: str) -> None:
    block = named_block(name)
    assert 0.0 < block.restitution <= 1.0
    assert re.search(r"\((19|20)\d\d\)", SOURCES[name])
    assert named_block(name, restitution=0.5).restitution == 0.5
    assert named_block(name, restitution="housner").restitution == pytest.approx(
        1.0 - 1.5 * math.sin(block.alpha) ** 2
    )
    assert named_block(name, gravity=5.0).gravity == 5.0


def test_the_numbers_of_the_sources() -> None:
    paper = named_block("tso-wong-1989")
    assert (paper.p, paper.restitution) == (2.0 * math.pi, 0.8)
    makris = named_block("makris-roussos-2000")
    assert (makris.width, makris.height, makris.restitution) == pytest.approx((1.0, 3.0, 0.85))
    zhang = named_block("zhang-makris-2001")
    assert (zhang.p, zhang.alpha, zhang.restitution) == (2.14, 0.25, 0.9)
    cabinet = named_block("fema-p58-cabinet")
    assert (cabinet.width, cabinet.height) == pytest.approx((0.47244, 1.72085))
    assert cabinet.restitution == pytest.approx(1.0 - 1.5 * math.sin(cabinet.alpha) ** 2)


@pytest.mark.parametrize("name", ["", "tso", "Tso-Wong-1989", None])
def test_an_unknown_name_is_answered_with_the_known_ones(name: str) -> None:
    with pytest.raises(InputError) as caught:
        named_block(name)
    for known in SOURCES:
        assert known in str(caught.value)
