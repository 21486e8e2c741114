"""Facts of blocks and motions: SI values and the words of engineers."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Pulse,
    Record,
    Still,
)
from rocksteady.model.facts import (
    amplitude_text,
    block_text,
    block_values,
    case_text,
    frequency_text,
    harmonic_values,
    lean_text,
    peak_unit,
    restitution_text,
    restitution_values,
    tilt_text,
)
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.motions import FourierSeries

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


def test_words_of_blocks_have_three_digits_and_restitutions_four() -> None:
    wall = Block.from_p(alpha=0.25, p=3.0).against_wall(0.470812)
    plain = Block.from_p(alpha=0.25, p=3.14159, restitution=0.912345, gravity=9.80665)
    pair = LEANING.with_restitution((0.812345, 0.912345))
    bare = DimensionlessBlock(restitution=0.812345, negative_restitution=0.912345)
    size = f"R {plain.radius * 1000:.3g} mm"
    rows = {
        restitution_text(wall): "against a wall, restitution 0.4708",
        restitution_text(plain): "restitution 0.9123",
        restitution_text(pair): "restitution 0.8123/0.9123",
        restitution_text(bare): "restitution 0.8123/0.9123",
        block_text(plain): f"alpha 14.3°, {size}, p 3.14 rad/s, restitution 0.9123",
        case_text(plain): "restitution 0.9123, alpha 14.3°, p 3.14 rad/s",
        case_text(pair): "restitution 0.8123/0.9123, alpha 14°/22.6°",
        case_text(wall): "against a wall, restitution 0.4708, alpha 14.3°, p 3 rad/s",
        block_text(bare): "restitution 0.8123/0.9123",
        frequency_text(BARE, 1.234567): "Ω = 1.235",
        frequency_text(BLOCK, 1.234567): "0.589 Hz (Ω = 1.235)",
        amplitude_text(BARE, 1.234567): "A = 1.235",
        amplitude_text(BLOCK, 1.234567): "0.309 g (A = 1.235)",
        lean_text(BLOCK, 0.142): "2.03° = 0.142 alpha",
        tilt_text(BLOCK, 0.142): "2.03° (0.142 alpha)",
        tilt_text(BARE, 0.142): "0.142 alpha",
        peak_unit(BLOCK, 1.234567): "0.309 g",
        peak_unit(BARE, 1.234567): "A = 1.23",
    }
    assert list(rows) == list(rows.values())


def test_values_name_a_wall_both_sides_a_cap_and_harmonics() -> None:
    wall, lopsided = BLOCK.against_wall(0.5), LEANING.against_wall(0.4)
    sides = {"alpha_rad", "radius_m", "p_rad_s", "restitution"}
    distances = {"left_m", "right_m", "height_m"}
    assert block_values(wall).keys() == sides | {"one_sided"}
    assert (block_values(wall)["restitution"], block_values(wall)["one_sided"]) == (0.5, True)
    assert block_values(lopsided).keys() == sides | distances | {"one_sided"}
    assert block_values(LEANING).keys() == sides | distances | {"negative"}
    assert block_values(LEANING)["height_m"] == pytest.approx(1.2)
    assert block_values(LEANING)["left_m"] == pytest.approx(0.15)
    capped = block_values(Block.frame(columns=4, cap_mass_ratio=2.0, width=0.4, height=2.0))
    assert capped.keys() == sides | {"columns", "cap_mass_ratio"}
    assert (capped["columns"], capped["cap_mass_ratio"]) == (4, 2.0)
    assert restitution_values(wall) == {"restitution": 0.5, "one_sided": True}
    series = FourierSeries(amplitude=1.2, frequency_ratio=3.0, harmonics=((2, 0.5, 0.1),))
    assert harmonic_values(BARE, series)["harmonics"] == [[2, 0.5, 0.1]]
    assert harmonic_values(BLOCK, series)["block"] == block_values(BLOCK)


def test_motions_are_named_with_what_they_are_in_g_and_hertz() -> None:
    record = Record(acceleration_m_s2=np.array([0.0, 1.961, -1.0, 0.0]), dt_s=0.1, name="a")
    floor = Record(acceleration_m_s2=np.array([0.0, 3.923, 0.0]), dt_s=0.1, ground=record)
    wave = Harmonic(amplitude=1.6, frequency_ratio=4.0, phase=0.3)
    pulse = Pulse(shape="one-sine", amplitude=1.6, frequency_ratio=4.0, reverse=True)
    series = FourierSeries(amplitude=1.2, frequency_ratio=3.0, harmonics=((2, 0.5, 0.1),))

    class Own:
        def segments(self) -> tuple[()]:
            return ()

    rows: dict[str, str] = {
        motion_text(BARE, wave): "harmonic shaking (A = 1.6, Ω = 4)",
        motion_text(BLOCK, wave): "harmonic shaking (0.4 g at 1.91 Hz, A = 1.6, Ω = 4)",
        motion_text(BARE, series): "periodic shaking (A = 1.2, Ω = 3)",
        motion_text(BARE, pulse): "a reversed one-sine pulse (A = 1.6, Ω = 4)",
        motion_text(BLOCK, record): "a (PGA 0.2 g)",
        motion_text(BLOCK, floor): "a record (PGA 0.2 g, of the floor 0.4 g)",
        motion_text(BLOCK, BaseMotion(record, record)): "a (PGA 0.2 g) with a vertical motion",
        motion_text(BARE, Still()): "a still base",
        motion_text(BARE, Piecewise()): "a piecewise motion",
        motion_text(BARE, Own()): "an Own motion",
    }
    assert list(rows) == list(rows.values())
    assert motion_text(BLOCK, BaseMotion(record)) == "a (PGA 0.2 g)"

    def facts(*given: Any) -> dict[str, Any]:
        return {fact.key: fact.value for fact in motion_facts(*given)}

    ratios = {"amplitude": 1.6, "frequency_ratio": 4.0}
    in_si = {"accel_g": pytest.approx(0.4), "freq_hz": pytest.approx(6.0 / math.pi)}
    lasts = 0.5 * math.pi
    assert facts(BARE, wave) == {**ratios, "phase": 0.3}
    assert facts(BLOCK, wave) == {**ratios, **in_si, "phase": 0.3}
    assert facts(BARE, pulse) == {
        "pulse": "one-sine", **ratios, "reversed": True, "duration_pt": pytest.approx(lasts),
    }  # fmt: skip
    assert facts(BLOCK, pulse) == {
        "pulse": "one-sine", **ratios, **in_si, "reversed": True,
        "duration_pt": pytest.approx(lasts), "duration_s": pytest.approx(lasts / 3.0),
    }  # fmt: skip
    assert facts(BARE, series)["harmonics"] == [[2, 0.5, 0.1]]
    assert facts(BLOCK, record) == {
        "record": "a", "npts": 4, "dt_s": 0.1, "duration_s": pytest.approx(0.3),
    }  # fmt: skip
    both = facts(BLOCK, BaseMotion(record, floor))
    assert (both["vertical"], both["vertical_pga_g"]) == (None, pytest.approx(0.4, rel=1e-3))
    (words,) = [fact.text for fact in motion_facts(BLOCK, record, floor) if fact.key == "vertical"]
    assert words == "a record (0.4 g)"
    assert facts(BARE, Still()) == {}
