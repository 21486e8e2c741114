"""Replay of nonlinear flights: those that are not searched for peaks have none to show."""

import math

import numpy as np
import pytest

from rocksteady.kernels.nonlinear.drive import Drive, SteppedFlight
from rocksteady.kernels.nonlinear.replay import last_rise_of, peaks_of, stays_below
from tests.every import every
from tests.strategies import inner_sample_size


def test_a_flight_that_is_not_searched_stays_below_the_tops() -> None:
    rng = np.random.default_rng(8)
    skipped = close = 0
    for _ in range(inner_sample_size(20_000, 2_000)):
        alpha, span = rng.uniform(0.05, 0.5), 10.0 ** rng.uniform(-3.0, 0.0)
        drive = Drive(
            alpha,
            rng.normal(0.0, 3.0),
            rng.normal(0.0, 1.0) / span,
            0.0,
            0.0,
            rng.uniform(-0.5, 0.5),
            rng.uniform(-0.3, 0.3) / span,
        )
        angle, velocity = rng.uniform(0.0, 1.5), rng.normal()
        tops = rng.uniform(0.0, 2.5), rng.uniform(0.0, 3.0)
        flight = SteppedFlight(drive, 0.0, angle, velocity, span, 1e-15)
        if not stays_below(flight, *tops):
            continue
        skipped += 1
        assert peaks_of(flight, *tops) == tops
        highest, fastest = peaks_of(flight, 0.0, 0.0)
        close += highest > 0.9 * tops[0] or fastest > 0.9 * tops[1]
    assert skipped > close > 10


def test_flights_of_no_end_and_to_the_side_are_searched() -> None:
    drive = Drive(0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert stays_below(SteppedFlight(drive, 0.0, 0.5, 0.0, 0.01, 1e-15), 1.0, 1.0)
    assert not stays_below(SteppedFlight(drive, 0.0, 0.5, 0.0, np.inf, 1e-15), 1.0, 1.0)
    assert not stays_below(SteppedFlight(drive, 0.0, 2.1, 0.0, 0.01, 1e-15), 9.0, 9.0)


@every("share", [1e-15, 1e-12, 1e-6, 0.1])
def test_a_flight_of_no_end_that_falls_back_never_rises_through_the_top(share: float) -> None:
    """On a still base it needs ``2 sin(alpha/2)/alpha``; with less it turns, and passes 0 again."""
    drive = Drive(0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    barrier = 2.0 * math.sin(0.1) / 0.2
    slower, faster = barrier * (1.0 - share), barrier * (1.0 + 2.0 * share)
    assert last_rise_of(SteppedFlight(drive, 0.0, 0.0, slower, math.inf, 1e-15), 1.0, 1.0) == -1.0
    if share > 1e-14:
        assert last_rise_of(SteppedFlight(drive, 0.0, 0.0, faster, math.inf, 1e-15), 1.0, 1.0) > 1.0


@pytest.mark.slow
def test_a_flight_of_ever_so_many_steps_has_no_peaks() -> None:
    """Hung up, with a weight of -1e12 M g, a block swings for ever about 1."""
    drive = Drive(0.3, 0.0, 0.0, 0.0, 0.0, -1e12, 0.0)
    assert np.isnan(peaks_of(SteppedFlight(drive, 0.0, 0.9, 0.0, 1.0, 1e-15), 0.0, 0.0)).all()
    assert 0.0 < last_rise_of(SteppedFlight(drive, 0.0, 0.9, 0.0, 1.0, 1e-15), 1.0, 2.0) < 0.1


def test_only_a_short_flight_that_starts_low_is_said_to_stay_below() -> None:
    still = Drive(0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    rows = [
        (0.1, 0.1, 0.5, 2.0, 2.0, True),
        (0.1, 0.1, 0.999, 2.0, 2.0, True),
        (0.1, 0.1, 1.0, 9.0, 9.0, False),  # too long
        (0.1, 0.1, math.inf, 9.0, 9.0, False),
        (1.9, 0.5, 0.9, 9.0, 9.0, False),  # the bound of y'' holds up to y = 2
        (0.1, 0.5, 0.1, 0.11, 9.0, False),
        (0.1, -0.5, 0.1, 0.19, 0.7, True),
        (0.1, -0.5, 0.1, 9.0, 0.55, False),
    ]
    for angle, velocity, span, top, fastest, expected in rows:
        flight = SteppedFlight(still, 0.0, angle, velocity, span, 1e-15)
        assert stays_below(flight, top, fastest) == expected, (angle, velocity, span)
    for field, value in (
        ("constant", 3.0),
        ("slope", -9.0),
        ("amplitude", 3.0),
        ("lift", 3.0),
        ("lift_slope", -9.0),
    ):
        pushed = SteppedFlight(still._replace(**{field: value}), 0.0, 0.1, 0.1, 0.5, 1e-15)
        assert not stays_below(pushed, 2.0, 2.0), field
