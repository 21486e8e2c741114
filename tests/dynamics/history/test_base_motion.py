"""Values of a base motion: its largest ones, of which one is exact and one a bound."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from rocksteady import Harmonic, Piecewise, Pulse
from rocksteady.dynamics.history.base_motion import (
    base_acceleration,
    course_from_rest,
    largest_acceleration,
    peak_acceleration,
    swinging_course,
)
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.segments import Motion
from rocksteady.motions import FourierSeries, Segment
from tests.every import every

WAVES = FourierSeries(
    amplitude=0.7, frequency_ratio=3.0, phase=0.4, harmonics=((1, 1.0, 0.3), (2, 0.6, 1.0))
)
PIECES = (
    Segment(duration=1.0, slope=1.0),
    Segment(duration=1.5, constant=1.0, slope=-0.8, amplitude=0.4, frequency=20.0),
    Segment(duration=2.0, constant=0.3, amplitude=0.5, frequency=4.0, phase=2.0),
)
MIXED = Piecewise(
    pieces=(
        PIECES[1],
        Segment(duration=1.1, amplitude=0.7, frequency=3.0, phase=0.4, harmonics=WAVES.harmonics),
        PIECES[2],
        Segment(
            duration=1.3, amplitude=0.5, frequency=2.0, harmonics=((2, 0.4, 0.2), (3, 0.3, 1.0))
        ),
    )
)


def acceleration_at(pieces: tuple[Segment, ...], time: float) -> float:
    """Return the base acceleration of segments, one sine after another; 0 behind them."""
    for piece in pieces:
        if time < piece.duration:
            turned = piece.frequency * time + piece.phase
            waves = piece.harmonics or ((1, 1.0, 0.0),)
            swing = sum(size * math.sin(order * turned + lag) for order, size, lag in waves)
            return piece.constant + piece.slope * time + piece.amplitude * swing
        time -= piece.duration
    return 0.0


@every("motion", [Piecewise(pieces=PIECES), MIXED])
def test_an_acceleration_is_the_sum_of_its_sines_on_a_line(motion: Piecewise) -> None:
    at = np.linspace(0.003, 6.5, 400)
    expected = [acceleration_at(motion.pieces, time) for time in at.tolist()]
    table = segment_table(motion)
    np.testing.assert_allclose(base_acceleration(table, at), expected, atol=1e-13)
    assert peak_acceleration(table) == pytest.approx(np.abs(expected).max(), rel=0.01)


@every("motion", [Piecewise(pieces=PIECES), MIXED, WAVES])
def test_velocity_and_displacement_are_integrals_of_the_acceleration(motion: Motion) -> None:
    table = segment_table(motion)
    at = np.linspace(0.0, 4.0, 8001)
    force = base_acceleration(table, at)
    for course in (course_from_rest, swinging_course)[: 2 if motion is WAVES else 1]:
        velocity, displacement = course(table, at)
        for values, slope in ((velocity, force), (displacement, velocity)):
            if course is course_from_rest:
                assert values[0] == 0.0
            gained = cumulative_simpson(slope, x=at, initial=0.0)
            # A jump of the acceleration between two places costs a part of their distance.
            np.testing.assert_allclose(values - values[0], gained, atol=5e-4)


def test_shaking_that_goes_on_swings_about_nothing() -> None:
    period = np.linspace(0.0, 2.0 * math.pi / WAVES.frequency_ratio, 100, endpoint=False)
    for values in swinging_course(segment_table(WAVES), period):
        assert np.abs(values).max() > 0.01
        assert values.mean() == pytest.approx(0.0, abs=1e-15)


def test_the_largest_acceleration_is_that_of_lines_and_a_bound_of_sinusoids() -> None:
    generator = np.random.default_rng(3)
    for _ in range(50):
        line = [
            Segment(duration=0.5, constant=c, slope=m) for c, m in generator.normal(size=(3, 2))
        ]
        swing = Segment(duration=2.0, constant=0.3, slope=-0.8, amplitude=0.4, frequency=20.0)
        lines = segment_table(Piecewise(pieces=tuple(line)))
        ends = [(each.constant, each.constant + 0.5 * each.slope) for each in line]
        expected = float(np.abs(ends).max())
        assert largest_acceleration(lines) == pytest.approx(expected)
        assert peak_acceleration(lines) == pytest.approx(expected)
        both = segment_table(Piecewise(pieces=(*line, swing)))
        at = np.linspace(0.0, 3.5, 2000)
        seen = float(np.abs(base_acceleration(both, at)).max())
        assert seen <= peak_acceleration(both) < 1.01 * seen
        assert peak_acceleration(both) <= largest_acceleration(both)
        assert largest_acceleration(both) == pytest.approx(max(expected, 1.3 + 0.4))


@every(
    ("kind", "more"),
    [
        (Harmonic, {}),
        (Pulse, {"shape": "half-sine"}),
        (FourierSeries, {"harmonics": ((1, 0.5, 0.3), (2, 0.2, 1.0))}),
    ],
)
def test_the_smallest_amplitude_is_described_where_a_caller_lets_underflow_raise(
    kind: Any, more: dict[str, Any]
) -> None:
    motion = kind(amplitude=5e-324, frequency_ratio=3.0, **more)
    with np.errstate(all="raise"):
        assert motion.describe().headline
        assert len(motion.to_dataframe()) > 0
