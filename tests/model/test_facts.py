"""Facts of blocks and motions: SI values and the words of engineers."""

import math

import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic
from rocksteady.model.facts import (
    amplitude_text,
    block_text,
    block_values,
    case_text,
    frequency_text,
    harmonic_values,
    lean_text,
    restitution_values,
)

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.from_p(alpha=0.25, p=3.0, restitution=0.9, gravity=9.80665)
LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)


def test_a_block_has_the_measures_of_each_of_its_sides() -> None:
    assert block_values(BLOCK) == {
        "alpha_rad": BLOCK.alpha,
        "radius_m": BLOCK.radius,
        "p_rad_s": BLOCK.p,
        "restitution": BLOCK.restitution,
    }
    values = block_values(LEANING)
    assert values["left_m"] + values["right_m"] == pytest.approx(0.4)
    assert values["negative"]["alpha_rad"] == LEANING.negative.alpha != values["alpha_rad"]
    assert restitution_values(LEANING).keys() == {"restitution", "negative_restitution"}


def test_what_is_given_in_g_and_hertz_comes_back() -> None:
    motion = Harmonic.from_si(BLOCK, acceleration_m_s2=0.4 * 9.80665, frequency_hz=2.0)
    values = harmonic_values(BLOCK, motion)
    assert values["accel_g"] == pytest.approx(0.4, rel=1e-14)
    assert values["freq_hz"] == pytest.approx(2.0, rel=1e-14)
    assert amplitude_text(BLOCK, motion.amplitude) == "0.4 g (A = 1.6)"
    assert frequency_text(BLOCK, motion.frequency_ratio) == "2 Hz (Ω = 4.189)"
    assert harmonic_values(BARE, motion).keys() == {"amplitude", "frequency_ratio", "restitution"}


def test_a_block_without_a_size_is_in_ratios() -> None:
    assert block_text(BARE) == case_text(BARE) == "restitution 0.8"
    assert amplitude_text(BARE, 1.5) == "A = 1.5"
    assert frequency_text(BARE, 4.0) == "Ω = 4"
    assert lean_text(BARE, 0.12345) == "0.123 alpha"


def test_an_angle_stands_in_degrees_first() -> None:
    degrees, alpha = lean_text(BLOCK, -0.5).split(" = ")
    assert float(degrees.removesuffix("°")) == pytest.approx(math.degrees(-0.125), rel=5e-3)
    assert alpha == "-0.5 alpha"
    for side in (LEANING.positive, LEANING.negative):
        assert f"{math.degrees(side.alpha):.3g}°" in case_text(LEANING)
        assert f"{math.degrees(side.alpha):.3g}°" in block_text(LEANING)
