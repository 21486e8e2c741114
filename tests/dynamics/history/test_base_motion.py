"""Values of a base motion: its largest ones, of which one is exact and one a bound."""

import numpy as np
import pytest

from rocksteady import Piecewise
from rocksteady.dynamics.history.base_motion import (
    base_acceleration,
    largest_acceleration,
    peak_acceleration,
)
from rocksteady.dynamics.history.lowering import segment_table
from rocksteady.motions import Segment


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
