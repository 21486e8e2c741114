"""Where the top of a rotated block is, against the corners as complex numbers."""

import cmath

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.model.blocks.tops import overhang, top_displacement


@given(st.floats(0.05, 2.0), st.floats(2.1, 9.0), st.floats(0.0, 1.2))
def test_corners_of_a_rotated_block(width: float, height: float, angle: float) -> None:
    """Positive rotation is about the left edge: both upper corners go left by these lengths."""
    block = Block.rectangle(width=width, height=height, restitution=0.9)
    left, right = (
        -(corner * cmath.exp(1j * angle) - corner).real
        for corner in (1j * height, width + 1j * height)
    )
    assert overhang(block, angle) == pytest.approx(left, rel=1e-9, abs=1e-12)
    assert top_displacement(block, [angle, -angle]) == pytest.approx([right] * 2, abs=1e-12)
    frame = block.capped(columns=2, cap_mass_ratio=1.0, restitution=0.9)
    assert overhang(frame, angle) == top_displacement(block, angle)
    assert np.isnan(top_displacement(block, np.nan))
