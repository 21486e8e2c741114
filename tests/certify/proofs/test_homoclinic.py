"""The saddle and the step of the search, against the kernels' return map."""

import math

import numpy as np

import rocksteady as rs
from rocksteady.certify.proofs._homoclinic import Model, entropy_of, find_saddle


def test_the_saddle_is_the_symmetric_orbit_with_its_multipliers() -> None:
    model = Model(2.698, 2.0, 0.8)
    saddle = find_saddle(model)
    assert saddle is not None
    motion = rs.Harmonic(amplitude=2.698, frequency_ratio=2.0)
    block = rs.DimensionlessBlock(restitution=0.8)
    orbit = rs.find_orbits(block, motion, max_period=1, seeds=2)[0]
    squares = sorted([saddle.unstable**2, saddle.stable**2], reverse=True)
    assert np.allclose(orbit.multipliers.real, squares, rtol=1e-9)
    assert abs(model.next_phase(saddle.phase, saddle.phase) - saddle.phase) < 1e-9
    assert find_saddle(Model(2.0, 2.0, 0.8)) is None


def test_the_entropy_counts_words() -> None:
    counts = [1]
    for length in range(1, 600):
        counts.append(counts[length - 1] + (counts[length - 25] if length >= 25 else 0))
    assert abs(entropy_of(25) - 2.0 * math.log(counts[599] / counts[499]) / 100.0) < 1e-3


def test_rows_in_floats_are_those_of_the_speeds_at_both_ends_and_their_slopes() -> None:
    model, phases = Model(2.698, 2.0, 0.8), np.array([2.9, 2.7, 3.1])

    def mismatch(x: float, y: float, z: float) -> float:
        b, r, w = 2.698 / 5.0, 0.8, 2.0
        speeds = []
        for p, q in ((x, y), (y, z)):
            t = (q - p + math.pi) / w
            low, high = 1.0 - b * math.sin(p), 1.0 + b * math.sin(q)
            up = (low * math.cosh(t) - high) / math.sinh(t) - b * w * math.cos(p)
            speeds.append((up, (high * math.cosh(t) - low) / math.sinh(t) - b * w * math.cos(q)))
        return (r * speeds[0][1] - speeds[1][0]) / b

    value, *slopes = model.row(*phases)
    assert abs(value - mismatch(*phases)) < 1e-13
    for k, slope in enumerate(slopes):
        step = 1e-6 * np.eye(3)[k]
        difference = mismatch(*(phases + step)) - mismatch(*(phases - step))
        assert abs(slope - difference / 2e-6) < 1e-8
