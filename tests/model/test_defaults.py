"""What is left out is what the documentation names."""

from collections.abc import Callable
from typing import Any

import numpy as np

import rocksteady as rs
from rocksteady.formulas import housner_restitution
from rocksteady.model.checks.confidence import share_interval
from rocksteady.model.motions.segments import Segment
from rocksteady.motions import (
    BandNoise,
    Floor,
    FourierSeries,
    Impulses,
    add,
    make_synthetic_suite,
)

BLOCK = rs.Block.rectangle(width=0.4, height=1.2)
WAVE: dict[str, Any] = {"amplitude": 1.0, "frequency_ratio": 2.0}
SERIES: dict[str, Any] = {**WAVE, "harmonics": ((1, 1.0, 0.5),)}
NOISE: dict[str, Any] = {"rms": 0.1, "band": (1.0, 5.0), "duration": 20.0, "seed": 1}
GROUND: dict[str, Any] = {"rms": 0.1, "frequency_ratio": 6.0, "duration": 20.0, "seed": 1}
JERK = np.array([0.0, 2.0, -1.0, 0.5, 0.0])
RECORD = rs.Record(acceleration_m_s2=JERK, dt_s=0.1)
G = {"gravity": 9.80665}
HOUSNER = {"restitution": "housner"}
SI = {"acceleration_m_s2": 1.0, "frequency_hz": 2.0}

LEFT_OUT: list[tuple[Callable[..., Any], dict[str, Any], dict[str, Any]]] = [
    (rs.Block.rectangle, {"width": 0.4, "height": 1.2}, G | HOUSNER),
    (rs.Block.from_radius, {"alpha": 0.3, "radius": 1.0}, G | HOUSNER),
    (rs.Block.from_p, {"alpha": 0.3, "p": 2.0}, G | HOUSNER),
    (
        rs.Block.general,
        {"mass": 2.0, "inertia": 3.0, "radius": 1.0, "alpha": 0.3},
        G | HOUSNER,
    ),
    (
        rs.Block.asymmetric,
        {"left": 0.2, "right": 0.3, "height": 1.2},
        G | HOUSNER | {"gyration": ((0.5**2 + 1.2**2) / 12.0) ** 0.5},
    ),
    (rs.Block.from_alphas, {"positive": 0.2, "negative": 0.3, "radius": 1.0}, G | HOUSNER),
    (rs.Block.from_alphas, {"positive": 0.2, "negative": 0.3, "p": 2.0}, G | HOUSNER),
    (
        rs.Block.frame,
        {"columns": 4, "cap_mass_ratio": 2.0, "width": 0.4, "height": 2.0},
        G | HOUSNER,
    ),
    (rs.Block.named, {"name": "tso-wong-1989"}, G),
    (BLOCK.against_wall, {}, HOUSNER),
    (BLOCK.capped, {"columns": 3, "cap_mass_ratio": 0.5}, HOUSNER),
    (
        rs.Block,
        {"positive": BLOCK.positive, "negative": BLOCK.negative},
        G | {"housner_factor": None, "wall_restitution": None, "cap": None},
    ),
    (
        rs.DimensionlessBlock,
        {"restitution": 0.8},
        {"negative_restitution": 0.8, "alpha_ratio": 1.0, "p_ratio": 1.0, "one_sided": False},
    ),
    (housner_restitution, {"alpha": 0.3}, {"p": 1.0, "radius": 0.75, "gravity": 1.0}),
    (rs.Nonlinear, {}, {"tolerance": 1e-10}),
    (rs.Harmonic, WAVE, {"phase": 0.0}),
    (rs.Harmonic.from_si, {"block": BLOCK, **SI}, {"phase": 0.0}),
    (FourierSeries, SERIES, {"phase": 0.0}),
    (
        FourierSeries.from_si,
        {"block": BLOCK, **SI, "harmonics": ((1, 1.0, 0.0),)},
        {"phase": 0.0},
    ),
    (
        FourierSeries.from_samples,
        {"samples": np.eye(1, 99)[0], "frequency_ratio": 1.0},
        {"orders": 16},
    ),
    (
        Segment,
        {"duration": 1.0},
        dict.fromkeys(("constant", "slope", "amplitude", "frequency", "phase", "jump"), 0.0),
    ),
    (rs.Piecewise, {}, {"pieces": ()}),
    (rs.Pulse, {"shape": "ricker", **WAVE}, {"tolerance": 1e-6, "reverse": False}),
    (
        rs.Pulse.from_si,
        {"block": BLOCK, "shape": "one-sine", **SI},
        {"oscillations": None, "phase": None, "reverse": False},
    ),
    (Impulses, {"velocities": (1.0,)}, {"times": (0.0,)}),
    (Impulses.from_si, {"block": BLOCK, "velocities_m_s": (1.0,)}, {"times_s": (0.0,)}),
    (BandNoise, NOISE, {"number": 0}),
    (
        rs.SyntheticMotion,
        GROUND,
        {"filter_damping": 0.6, "high_pass_ratio": 0.1, "rise": 0.15, "decay": 0.5},
    ),
    (
        rs.SyntheticMotion.from_si,
        {"block": BLOCK, "rms_m_s2": 1.0, "frequency_hz": 2.5, "duration_s": 9.0, "seed": 1},
        {"filter_damping": 0.6},
    ),
    (make_synthetic_suite, {"count": 2}, {"seed": 0}),
    (Floor, {"frequencies_hz": 2.0}, {"damping": 0.05, "shapes": 1.0}),
    (
        rs.floor_motion,
        {"motion": RECORD, "frequencies_hz": 2.0},
        {"damping": 0.05, "shapes": 1.0, "tolerance": 1e-3, "block": None},
    ),
    (Floor(frequencies_hz=2.0).motion, {"motion": RECORD}, {"tolerance": 1e-3, "block": None}),
    (rs.Record, {"acceleration_m_s2": JERK, "dt_s": 0.1}, {"name": None, "ground": None}),
    (rs.BaseMotion, {"horizontal": RECORD}, {"vertical": None}),
]
"""What is called, with what, and the values that stand for what is left out."""


def test_what_is_left_out_is_what_the_documentation_names() -> None:
    wrong = []
    for call, given, stated in LEFT_OUT:
        short = call(**given)
        for name, value in stated.items():
            if call(**given, **{name: value}) != short:
                wrong.append((call, name, value))
        if call(**given, **stated) != short:
            wrong.append((call, "all", stated))
    assert not wrong, wrong


def test_the_peakedness_of_a_pulse_and_the_error_of_a_sum_have_defaults() -> None:
    shaped: dict[str, Any] = {"shape": "mavroeidis-papageorgiou", **WAVE}
    plain = rs.Pulse(**shaped).segments()
    assert plain == rs.Pulse(**shaped, oscillations=2.0, phase=0.0).segments()
    assert plain != rs.Pulse(**shaped, oscillations=2.0, phase=1.0).segments()
    assert plain != rs.Pulse(**shaped, oscillations=3.0).segments()
    pulses = [
        rs.Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=ratio)
        for ratio in (2.0, 8.0**0.5)
    ]
    assert add(*pulses) == add(*pulses, tolerance=1e-6)
    assert len(add(*pulses).pieces) > len(add(*pulses, tolerance=1e-5).pieces)
    for ends, stated in zip(share_interval(0.3, 10), share_interval(0.3, 10, 0.9), strict=True):
        assert ends == stated
    assert len(make_synthetic_suite()) == 24
    assert rs.DimensionlessBlock(restitution=0.8).negative_restitution is None


def test_measures_of_a_block_turn_into_its_own_and_back() -> None:
    for block in (BLOCK, rs.Block.asymmetric(left=0.1, right=0.3, height=1.1, gravity=1.62)):
        unit, rate = block.alpha * block.gravity, block.p
        hertz = rate / (2.0 * np.pi)
        wave = rs.Harmonic.from_si(block, acceleration_m_s2=1.2, frequency_hz=2.0, phase=0.3)
        pulse = rs.Pulse.from_si(
            block, shape="one-sine", acceleration_m_s2=1.2, frequency_hz=2.0, reverse=True
        )
        series = FourierSeries.from_si(
            block, acceleration_m_s2=1.2, frequency_hz=2.0, harmonics=((2, 0.5, 0.1),), phase=0.4
        )
        noise = BandNoise.from_si(
            block, rms_m_s2=1.2, band_hz=(1.0, 2.0), duration_s=9.0, seed=4, number=5
        )
        ground = rs.SyntheticMotion.from_si(
            block, rms_m_s2=1.2, frequency_hz=2.0, duration_s=9.0, seed=4, filter_damping=0.4
        )
        kicks = Impulses.from_si(block, velocities_m_s=(0.2, -0.3), times_s=(0.5, 2.0))
        pairs: list[tuple[Any, Any]] = [
            (wave.amplitude * unit, 1.2),
            (wave.acceleration_m_s2(block), 1.2),
            (wave.frequency_hz(block), 2.0),
            (wave.frequency_ratio * hertz, 2.0),
            (wave.phase, 0.3),
            (pulse.amplitude * unit, 1.2),
            (pulse.acceleration_m_s2(block), 1.2),
            (pulse.frequency_hz(block), 2.0),
            (pulse.frequency_ratio * hertz, 2.0),
            (pulse.duration / rate, 0.5),
            (pulse.reverse, True),
            (series.amplitude * unit, 1.2),
            (series.acceleration_m_s2(block), 0.6),
            (series.frequency_hz(block), 2.0),
            (series.phase, 0.4),
            (noise.rms * unit, 1.2),
            (noise.band[0] * hertz, 1.0),
            (noise.band[1] * hertz, 2.0),
            (noise.duration / rate, 9.0),
            ((noise.seed, noise.number), (4, 5)),
            (ground.rms * unit, 1.2),
            (ground.frequency_ratio * hertz, 2.0),
            (ground.duration / rate, 9.0),
            ((ground.seed, ground.filter_damping), (4, 0.4)),
            (kicks.velocities[0] * unit / rate, 0.2),
            (kicks.velocities[1] * unit / rate, -0.3),
            (kicks.times[0] / rate, 0.5),
            (kicks.times[1] / rate, 2.0),
        ]
        found, expected = (np.hstack(each) for each in zip(*pairs, strict=True))
        np.testing.assert_allclose(found, expected, rtol=1e-13)
