"""Titles of pictures: what shakes which block, with the names and signs of records."""

import math

from rocksteady import Block, DimensionlessBlock, Harmonic, Pulse
from rocksteady.cli.console.titles import block_text, case_text
from rocksteady.model.facts import block_values, harmonic_values, restitution_values

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=(0.9, 0.8))
EVEN = Block.rectangle(width=0.4, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)


def test_a_title_names_what_shakes_which_block() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    assert case_text(harmonic_values(BARE, shaking)) == "A = 2, Ω = 4, restitution 0.8"
    assert case_text(restitution_values(BARE)) == "free rocking, restitution 0.8"
    pulse = Pulse(shape="ricker", amplitude=2.0, frequency_ratio=4.0)
    words = case_text(
        {"pulse": pulse.shape, "model": "nonlinear", **harmonic_values(EVEN, shaking)}
    )
    accel = 2.0 * EVEN.alpha
    frequency = 4.0 * EVEN.p / (2.0 * math.pi)
    units = f"{accel:.3g} g (A = 2), {frequency:.3g} Hz (Ω = 4)"
    assert words.startswith(f"ricker pulse, {units}, restitution ")
    assert words.endswith(f"{block_text(block_values(EVEN))}, nonlinear model")
    degrees = (f"{math.degrees(alpha):.3g}°" for alpha in (LEANING.alpha, LEANING.negative.alpha))
    alphas = f"α = {'/'.join(degrees)}"
    assert alphas in case_text(harmonic_values(LEANING, shaking))


def test_the_title_of_a_picture_names_the_changed_sign() -> None:
    values = {"record": "a", "vertical": "b", "pga_g": 0.5, "restitution": 0.9}
    assert "a and vertical, PGA" in case_text({**values, "vertical_processing": []})
    notes = ["sign changed: DWN is positive downwards, and vertical motion upwards"]
    assert "a and vertical (sign changed), PGA" in case_text(
        {**values, "vertical_processing": notes}
    )
