"""The last passage of the slenderness, against the lowest that a flight can come to."""

import math

import numpy as np

from rocksteady.kernels.core.tables import (
    BEFORE_ANGLE,
    BEFORE_SPEED,
    PASSAGE_COLUMNS,
    PASSING_AGAIN,
    March,
    Rise,
    keep_passage,
    kept_passage,
)
from tests.strategies import sample_size

HERE = March(1, 1.2, -0.3, 7, 2, 0.1, 5, 9)


def is_doubtful(angle: float, velocity: float, span: float, ceiling: float) -> bool:
    """Return whether a flight that begins and ends above the slenderness leaves a doubt."""
    peaks = np.zeros(PASSAGE_COLUMNS)
    keep_passage(peaks, HERE, 0.4, 0.5, Rise(angle, velocity, 1.5, span, ceiling))
    assert (peaks[:PASSING_AGAIN] == 0.0).all()
    return bool(peaks[PASSING_AGAIN])


def test_a_flight_above_leaves_a_doubt_where_the_hardest_push_brings_it_back() -> None:
    rng = np.random.default_rng(20)
    doubts = 0
    for _ in range(sample_size(2_000, 300)):
        angle, span = 1.0 + 10.0 ** rng.uniform(-4.0, 0.0), 10.0 ** rng.uniform(-3.0, 0.0)
        velocity, ceiling = rng.normal() * 10.0 ** rng.uniform(-2.0, 0.0), rng.uniform(0.0, 3.0)
        times = np.linspace(0.0, span, 2_000)
        lowest = (angle + velocity * times - 0.5 * ceiling * times**2).min()
        if abs(lowest - 1.0) > 1e-9:
            assert is_doubtful(angle, velocity, span, ceiling) == (lowest < 1.0)
            doubts += lowest < 1.0
    assert doubts > 20


def test_an_endless_flight_leaves_a_doubt_unless_nothing_brings_it_back() -> None:
    assert is_doubtful(1.2, 0.5, math.inf, 0.1)
    assert is_doubtful(1.2, -0.5, math.inf, 0.0)
    assert not is_doubtful(1.2, 0.5, math.inf, 0.0)


def test_a_flight_from_below_is_the_passage_and_ends_all_doubt() -> None:
    peaks = np.zeros(PASSAGE_COLUMNS)
    keep_passage(peaks, HERE, 0.4, 0.5, Rise(1.1, -9.0, 1.5, 1.0, 1.0))
    assert peaks[PASSING_AGAIN] == 1.0
    keep_passage(peaks, HERE, 0.4, 0.5, Rise(0.9, 0.2, 0.99, 1.0, 1.0))  # stays below
    assert peaks[PASSING_AGAIN] == 1.0
    keep_passage(peaks, HERE, 0.6, 0.7, Rise(0.9, 2.0, 1.5, 1.0, 1.0))
    assert (peaks[PASSING_AGAIN], peaks[BEFORE_ANGLE], peaks[BEFORE_SPEED]) == (0.0, 0.6, 0.7)
    assert kept_passage(peaks) == HERE._replace(impacts=0, flights=0)
