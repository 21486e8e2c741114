"""Landings within a sample against the search that isolates zeros on any segment."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.forcing import make_forcing
from rocksteady.kernels.core.tables import FOUND
from rocksteady.kernels.core.typed import FALSE
from rocksteady.kernels.linear.extrema import flight_peaks
from rocksteady.kernels.linear.flight import make_flight
from rocksteady.kernels.linear.short import (
    DOUBT,
    LANDS,
    LONGEST,
    NO_LANDING,
    first_landing,
    inner_peaks,
)
from rocksteady.kernels.linear.zeros import next_zero
from tests.every import every
from tests.strategies import sample_size


def test_landings_are_those_of_the_search() -> None:
    rng = np.random.default_rng(49)
    doubts = landings = 0
    cases = sample_size(20_000, 2_000)
    for _ in range(cases):
        span = LONGEST * 10.0 ** rng.uniform(-3.0, 0.0)
        angle = 0.0 if rng.random() < 0.5 else 10.0 ** rng.uniform(-6.0, 0.0)
        velocity = rng.normal() * 10.0 ** rng.uniform(-6.0, 0.0)
        if angle == 0.0:
            velocity = abs(velocity)
        start, end = rng.normal(-0.5, 1.5, 2).tolist()
        slope = (end - start) / span
        found = first_landing(angle, velocity, start, slope, span)
        forcing = make_forcing(start, slope, 0.0, 0.0)
        flight = make_flight(forcing, angle, velocity, 0.0, 0.0, 1.0)
        truth = next_zero(flight, forcing, span, FALSE, FALSE, -1.0)
        doubts += found.event == DOUBT
        if found.event == DOUBT:
            continue
        assert (found.event == LANDS) == (truth.event == FOUND)
        scale = max(abs(angle), abs(velocity) * span, span * span)
        assert abs(found.velocity - truth.velocity) <= 1e-13 * (abs(truth.velocity) + scale / span)
        if found.event == LANDS:
            landings += 1
            assert found.velocity <= 0.0
            slow = scale / max(abs(truth.velocity), 1e-300)
            assert abs(found.time - truth.time) <= 1e-14 * (span + slow)
        else:
            assert abs(found.angle - truth.angle) <= 1e-14 * scale
    assert doubts < 0.05 * cases
    assert landings > 0.2 * cases


@every("span", [LONGEST, 1e-2, 1e-4])
@every("slope", [1e-3, 1.0, 1e3])
def test_a_block_lifts_off_at_rest_where_the_forcing_is_zero_but_for_rounding(
    span: float, slope: float
) -> None:
    rise = slope * span
    lifted = first_landing(0.0, 0.0, -0.5e-9 * rise, slope, span)
    assert lifted.event == NO_LANDING
    cubic = slope * span**3 / 6.0  # of slope * (sinh(span) - span)
    assert lifted.angle == pytest.approx(cubic * (1.0 + span**2 / 20.0 + span**4 / 840.0), rel=1e-7)
    for start, end in [(-2e-9 * rise, rise), (-rise, 0.0), (0.0, -rise), (-0.1 * rise, 0.9 * rise)]:
        assert first_landing(0.0, 0.0, start, (end - start) / span, span).event == DOUBT
    assert first_landing(0.0, -1e-300, 0.0, slope, span).event != NO_LANDING


def test_peaks_within_a_sample_are_those_of_any_flight() -> None:
    rng = np.random.default_rng(7)
    for _ in range(sample_size(3_000, 200)):
        span = LONGEST * 10.0 ** rng.uniform(-1.0, 0.0)
        angle, velocity = 5.0 + rng.normal(), rng.normal(0.0, 0.5 * span)
        start, end = (-angle + rng.normal(0.0, 2.0, 2)).tolist()
        slope = (end - start) / span
        forcing = make_forcing(start, slope, 0.0, 0.0)
        flight = make_flight(forcing, angle, velocity, 0.0, 0.0, 1.0)
        landing = first_landing(angle, velocity, start, slope, span)
        ends = max(angle, landing.angle), max(abs(velocity), abs(landing.velocity))
        bend = landing.angle + end
        tops = inner_peaks(angle, velocity, start, slope, span, landing.velocity, bend, ends)
        truth = flight_peaks(flight, forcing, span, landing.angle, landing.velocity, 0.0, 0.0)
        assert math.isclose(tops[0], truth[0], rel_tol=1e-14)
        assert math.isclose(tops[1], truth[1], rel_tol=1e-12)
