"""Where the top of a rotated block is, against the corners as complex numbers."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.errors import ModelError
from rocksteady.formulas import Outline
from rocksteady.model.blocks.tops import clearance, top_displacement


@given(st.floats(0.05, 2.0), st.floats(2.1, 9.0), st.floats(0.0, 1.2))
def test_corners_of_a_rotated_block(width: float, height: float, angle: float) -> None:
    """Positive rotation is about the left edge: both upper corners go left by these lengths."""
    block = Block.rectangle(width=width, height=height, restitution=0.9)
    left, right = (
        -(corner * cmath.exp(1j * angle) - corner).real
        for corner in (1j * height, width + 1j * height)
    )
    assert clearance(block, angle) == pytest.approx(left, rel=1e-9, abs=1e-12)
    assert top_displacement(block, [angle, -angle]) == pytest.approx([right] * 2, abs=1e-12)
    frame = block.capped(columns=2, cap_mass_ratio=1.0, restitution=0.9)
    assert clearance(frame, angle) == top_displacement(block, angle)
    assert np.isnan(top_displacement(block, np.nan))
    assert np.isnan(clearance(block, np.nan))


@given(
    left=st.floats(0.05, 0.6),
    right=st.floats(0.05, 0.6),
    height=st.floats(0.4, 4.0),
    part=st.floats(0.05, 1.0),
    beyond=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    angle=st.floats(-1.2, 1.2),
)
def test_corners_of_any_outline(
    left: float, right: float, height: float, part: float, beyond: tuple[float, float], angle: float
) -> None:
    """All four corners on the whole way to the angle: the furthest that one leans out is a gap."""
    block = Block.asymmetric(
        left=left, right=right, height=height, mass_centre_height=part * height, restitution=0.9
    )
    outline = Outline(height=height, left_overhang=beyond[0], right_overhang=beyond[1])
    block = Block(positive=block.positive, negative=block.negative, outline=outline)
    ends = np.array([-beyond[0], left + right + beyond[1]])
    corners = np.concatenate([ends, ends + 1j * height])
    pivot = 0.0 if angle > 0.0 else left + right
    way = np.linspace(0.0, angle, 4001)[:, np.newaxis]
    places = (pivot + (corners - pivot) * np.exp(1j * way)).real
    gap = ends[0] - places.min() if angle > 0.0 else places.max() - ends[1]
    # A furthest point between two angles of the way is missed by the square of their distance.
    assert clearance(block, angle) == pytest.approx(gap, abs=1e-6)
    if math.tan(abs(angle)) * beyond[angle < 0.0] < height:  # leans out further all the way
        assert clearance(block, angle) == pytest.approx(gap, abs=1e-9)
    moved = np.abs(places[-1, 2:] - corners[2:].real).max()
    assert top_displacement(block, angle) == pytest.approx(moved, abs=1e-9)


def test_a_bottom_heavy_body_leans_out_by_its_own_height() -> None:
    """By hand: 1.8 m times the sine of 127/1000 is 228 mm; of the mass centre's 1 m, 127 mm."""
    body = Block.asymmetric(left=0.25, right=0.25, height=1.8, mass_centre_height=0.5)
    angle = math.asin(0.12716)
    assert float(clearance(body, angle)) == pytest.approx(0.229, abs=5e-4)
    assert float(clearance(body, -angle)) == pytest.approx(0.229, abs=5e-4)


def test_the_gap_of_a_wide_top_is_that_of_the_way_and_not_of_its_end() -> None:
    """A top 1 m out on either side is furthest out at 45 degrees, then comes back in."""
    table = Block.asymmetric(left=0.4, right=0.4, height=1.0, mass_centre_height=0.3)
    wide = Outline(height=1.0, left_overhang=1.0, right_overhang=1.0)
    table = Block(positive=table.positive, negative=table.negative, outline=wide)
    assert clearance(table, 1.1) == pytest.approx(math.sqrt(2.0) - 1.0, rel=1e-14)
    assert clearance(table, [-0.3, 0.3]) == pytest.approx([math.sin(0.3) + math.cos(0.3) - 1.0] * 2)


def test_a_frame_has_no_columns_whose_cap_is_not_twice_as_high_as_their_mass() -> None:
    column = Block.asymmetric(left=0.25, right=0.25, height=1.8, mass_centre_height=0.5)
    with pytest.raises(ModelError, match=r"have their mass in mid-height"):
        column.capped(columns=2, cap_mass_ratio=1.0)
