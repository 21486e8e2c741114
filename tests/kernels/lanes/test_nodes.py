"""The states at nodes and the doubt about them, against 50 digits."""

import numpy as np
import pytest

from rocksteady.kernels.core.tables import March
from rocksteady.kernels.lanes._fields import (
    AMPLITUDE,
    ANGLE_THERE,
    END_PHASE,
    FIELDS,
    FREQUENCY,
    LANES,
    NEXT_ANGLE,
    NEXT_DOUBT,
    NEXT_VELOCITY,
    OUTCOME,
    PHASE,
    RISING,
    VELOCITY,
    VELOCITY_THERE,
)
from rocksteady.kernels.lanes._launching import launch
from rocksteady.kernels.lanes._loading import load, put_lane
from rocksteady.kernels.lanes._nodes import node_state, passes_over, positive_length
from rocksteady.kernels.lanes._passes import fill_empty
from tests.every import every
from tests.kernels.fates import like_sides
from tests.oracles import ExactFlight, mp
from tests.strategies import sample_size


def lanes_in_flight(rng: np.random.Generator) -> np.ndarray:
    """Return lanes that have just been launched from the floor."""
    lanes, sides = np.zeros(FIELDS * LANES), like_sides(np.array([0.8]))[0]
    fill_empty(lanes, sides)
    for j in range(LANES):
        amplitude, frequency = 1.0 + 10.0 ** rng.uniform(-3, 1), 10.0 ** rng.uniform(-1, 2)
        load(lanes, j, j, amplitude, frequency, sides, 0.5)
        velocity = 10.0 ** rng.uniform(-3, 0)
        state = March(1, 0.0, velocity, 0, 0, rng.uniform(0.0, 3.1), 0, 0)
        put_lane(lanes, j, state, 100, sides)
    launch(lanes)
    return lanes


@every("seed", range(sample_size(20, 2)))
def test_states_at_nodes_are_off_by_less_than_the_doubt(seed: int) -> None:
    lanes = lanes_in_flight(np.random.default_rng(seed))
    node_state(lanes)
    known = 0
    for j in range(LANES):
        if lanes[OUTCOME + j] > 1.0:
            continue  # so far ahead that the lane knows nothing
        known += 1
        amplitude, frequency = mp.mpf(lanes[AMPLITUDE + j]), mp.mpf(lanes[FREQUENCY + j])
        phase = mp.mpf(lanes[PHASE + j])
        path = ExactFlight(-1, 0, amplitude, frequency, 0, mp.mpf(lanes[VELOCITY + j]), phase)
        # The node as it is, not as a double.
        rising = mp.asin(1 / amplitude)
        turns = mp.nint((mp.mpf(lanes[END_PHASE + j]) - rising) / (2 * mp.pi))
        node = rising + 2 * mp.pi * turns
        assert abs(node - mp.mpf(lanes[END_PHASE + j])) < 1e-14
        angle, velocity = path.state((node - phase) / frequency)
        doubt = lanes[OUTCOME + j]
        assert abs(angle - mp.mpf(lanes[ANGLE_THERE + j])) < doubt
        assert abs(velocity - mp.mpf(lanes[VELOCITY_THERE + j])) < doubt
        assert positive_length(lanes, j) == pytest.approx(np.pi - 2.0 * lanes[RISING + j])
        if lanes[NEXT_DOUBT + j] > 1.0:
            continue
        angle, velocity = path.state((node + mp.pi - 2 * rising - phase) / frequency)
        assert abs(angle - mp.mpf(lanes[NEXT_ANGLE + j])) < lanes[NEXT_DOUBT + j]
        assert abs(velocity - mp.mpf(lanes[NEXT_VELOCITY + j])) < lanes[NEXT_DOUBT + j]
    assert known > LANES // 3


def test_a_dip_passes_over_only_where_its_tangents_meet_above_the_floor() -> None:
    # A parabola (t - 1)^2 + depth on [0, 2]: the tangents of its ends meet 1 below its least.
    for depth in (-0.5, 0.5, 0.999, 1.001, 2.0):
        angle = 1.0 + depth
        assert passes_over(angle, -2.0, angle, 2.0, 2.0, 1e-12) == (depth > 1.0)
    # Rising from the start on, or still falling at the end.
    assert passes_over(0.1, 0.0, 1.0, 3.0, 2.0, 1e-12)
    assert passes_over(2.0, -2.5, 0.1, -0.1, 2.0, 1e-12)
    # Within the doubt nothing is sure.
    assert not passes_over(2.0, -2.0, 2.0, 2.0, 2.0, 1.0)
