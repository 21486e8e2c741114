"""Replay of nonlinear flights: those that are not searched for peaks have none to show."""

import numpy as np

from rocksteady.kernels.nonlinear.drive import Drive
from rocksteady.kernels.nonlinear.replay import peaks_of, stays_below
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
        if not stays_below(drive, angle, velocity, span, *tops):
            continue
        skipped += 1
        assert peaks_of(drive, 0.0, angle, velocity, span, 1e-15, *tops) == tops
        highest, fastest = peaks_of(drive, 0.0, angle, velocity, span, 1e-15, 0.0, 0.0)
        close += highest > 0.9 * tops[0] or fastest > 0.9 * tops[1]
    assert skipped > close > 10


def test_flights_of_no_end_and_to_the_side_are_searched() -> None:
    drive = Drive(0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert stays_below(drive, 0.5, 0.0, 0.01, 1.0, 1.0)
    assert not stays_below(drive, 0.5, 0.0, np.inf, 1.0, 1.0)
    assert not stays_below(drive, 2.1, 0.0, 0.01, 9.0, 9.0)
