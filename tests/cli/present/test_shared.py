"""Values and words of blocks, shaking and orbits that several commands print."""

import math
from dataclasses import replace

import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Pulse, find_orbits
from rocksteady.cli.present.shared import (
    block_text,
    block_values,
    case_text,
    orbit_values,
    plural,
    restitution_text,
    restitution_values,
    shaking_values,
)
from tests.cli.present.printed import as_json

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=(0.9, 0.8))
EVEN = Block.rectangle(width=0.4, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
SIDE = {"alpha_rad", "radius_m", "p_rad_s", "restitution"}


def test_a_symmetric_block_has_one_side_and_any_other_both() -> None:
    even, leaning = block_values(EVEN), block_values(LEANING)
    assert even.keys() == SIDE
    assert leaning.keys() == SIDE | {"left_m", "right_m", "height_m", "negative"}
    assert leaning["negative"].keys() == SIDE
    # The geometry gives both back: tan alpha is the distance of an edge over half of the height.
    for side, distance in ((leaning, "left_m"), (leaning["negative"], "right_m")):
        height = side["radius_m"] * math.cos(side["alpha_rad"])
        assert 2.0 * height == pytest.approx(leaning["height_m"])
        assert height * math.tan(side["alpha_rad"]) == pytest.approx(leaning[distance])


def test_a_mirrored_block_has_its_values_exchanged() -> None:
    one = block_values(LEANING)
    turned = replace(LEANING, positive=LEANING.negative, negative=LEANING.positive)
    other = block_values(turned)
    assert other["negative"] == {name: one[name] for name in SIDE}
    assert {name: other[name] for name in SIDE} == one["negative"]
    assert (other["left_m"], other["right_m"]) == (one["right_m"], one["left_m"])


def test_one_restitution_stands_for_both_impacts_unless_they_differ() -> None:
    assert restitution_values(BARE) == {"restitution": 0.8}
    values = restitution_values(LEANING)
    assert values == {"restitution": 0.9, "negative_restitution": 0.8}
    assert restitution_text(values) == "restitution 0.9/0.8"
    assert restitution_text(restitution_values(BARE)) == "restitution 0.8"


@pytest.mark.parametrize("block", [EVEN, LEANING])
def test_shaking_in_si_makes_the_same_motion_again(block: Block) -> None:
    shaking = Harmonic(amplitude=1.7, frequency_ratio=3.1)
    values = shaking_values(block, shaking)
    again = Harmonic.from_si(
        block,
        acceleration_m_s2=values["accel_g"] * block.gravity,
        frequency_hz=values["freq_hz"],
    )
    assert again.amplitude == pytest.approx(1.7)
    assert again.frequency_ratio == pytest.approx(3.1)
    assert shaking_values(BARE, shaking).keys() == {"amplitude", "frequency_ratio", "restitution"}


def test_an_orbit_keeps_the_contract_and_becomes_json() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    found = [
        orbit
        for orbit in find_orbits(EVEN, shaking, max_period=1, max_impacts=4)
        if orbit.admissible
    ]
    assert found
    for orbit in found:
        values = as_json(orbit_values(orbit, EVEN))
        assert values["period_s"] * shaking.frequency_hz(EVEN) == pytest.approx(orbit.period)
        assert values["peaks_rad"] == [EVEN.alpha * u for u in (orbit.highest, orbit.lowest)]
        assert len(values["states"]) == values["impacts_per_period"]
        # Two numbers for each multiplier; their product is the loss of all impacts.
        product = complex(*values["multipliers"][0]) * complex(*values["multipliers"][1])
        loss = EVEN.restitution ** (2 * values["impacts_per_period"])
        assert product == pytest.approx(loss, rel=1e-6)
        assert orbit_values(orbit, BARE).keys() == values.keys() - {"peaks_rad", "period_s"}


def test_an_inadmissible_orbit_has_no_peaks() -> None:
    # Of both branches of order 3 one passes through the floor.
    shaking = Harmonic(amplitude=4.0, frequency_ratio=2.0)
    found = find_orbits(EVEN, shaking, max_period=3, max_impacts=2)
    wrong = next(orbit for orbit in found if not orbit.admissible)
    assert math.isnan(wrong.highest)
    values = as_json(orbit_values(wrong, EVEN))
    assert values["peaks"] is None
    assert values["peaks_rad"] is None


def test_the_words_of_numbers() -> None:
    assert plural(1, "impact") == "1 impact"
    assert plural(0, "impact") == "0 impacts"


def test_a_title_names_what_shakes_which_block() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    assert case_text(shaking_values(BARE, shaking)) == "A = 2, Ω = 4, restitution 0.8"
    assert case_text(restitution_values(BARE)) == "free rocking, restitution 0.8"
    pulse = Pulse(shape="ricker", amplitude=2.0, frequency_ratio=4.0)
    words = case_text({"pulse": pulse.shape, "model": "nonlinear", **shaking_values(EVEN, pulse)})
    assert words.startswith("ricker pulse, A = 2, Ω = 4, restitution ")
    assert words.endswith(f"{block_text(block_values(EVEN))}, nonlinear model")
    alphas = f"α = {LEANING.alpha:.3g}/{LEANING.negative.alpha:.3g} rad"
    assert alphas in case_text(shaking_values(LEANING, shaking))


def test_the_title_of_a_picture_names_the_changed_sign() -> None:
    values = {"record": "a", "vertical": "b", "pga_g": 0.5, "restitution": 0.9}
    assert "a and vertical, PGA" in case_text({**values, "vertical_processing": []})
    notes = ["sign changed: DWN is positive downwards, and vertical motion upwards"]
    assert "a and vertical (sign changed), PGA" in case_text(
        {**values, "vertical_processing": notes}
    )
