"""Loops over lanes: motion and steps against 50 digits, and what moves between lanes."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.batch import arrival
from rocksteady.kernels.core.tables import March
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._fields import FIELDS, GROUP, LANES, weight, working
from rocksteady.kernels.lanes._loading import at_the_end, load, put_lane, taken
from rocksteady.kernels.lanes._newton import approach, bounce, fly, shake
from rocksteady.kernels.lanes._passes import (
    at_nodes,
    census,
    draw_together,
    fill_empty,
    in_need,
)
from tests.kernels.fates import like_sides
from tests.kernels.lanes.test_nodes import lanes_in_flight
from tests.oracles import ExactFlight, mp

Floats = np.ndarray


def flight_of(lanes: Floats, j: int) -> ExactFlight:
    """Return the flight of a lane from its start, in many digits."""
    parts = [mp.mpf(lanes[field + j]) for field in (lane.AMPLITUDE, lane.FREQUENCY)]
    velocity, phase = (mp.mpf(lanes[field + j]) for field in (lane.VELOCITY, lane.PHASE))
    amplitude, frequency = parts
    return ExactFlight(mp.mpf(-1), mp.mpf(0), amplitude, frequency, mp.mpf(0), velocity, phase)


def test_lanes_fly_by_the_closed_form() -> None:
    rng = np.random.default_rng(1)
    lanes = lanes_in_flight(rng)
    times = rng.uniform(0.05, 2.0, LANES)
    lanes[lane.TIME : lane.TIME + LANES] = times
    shake(lanes)
    fly(lanes)
    with mp.workdps(30):
        for j, time in enumerate(times.tolist()):
            angle, velocity = flight_of(lanes, j).state(time)
            w, amplitude = lanes[lane.FREQUENCY + j], lanes[lane.AMPLITUDE + j]
            size = (1.0 + amplitude) * math.exp(time) * (1.0 + w * time)
            assert abs(lanes[lane.ANGLE_THERE + j] - angle) < 1e-14 * size, j
            assert abs(lanes[lane.VELOCITY_THERE + j] - velocity) < 1e-14 * size, j


def test_short_bounces_keep_their_digits_and_others_are_left_alone() -> None:
    rng = np.random.default_rng(2)
    lanes = lanes_in_flight(rng)
    lanes[lane.STAGE : lane.STAGE + LANES] = np.resize([lane.SHORT, lane.POLISH], LANES)
    for share in (1e-6, 1e-2, 0.3):
        w = lanes[lane.FREQUENCY : lane.FREQUENCY + LANES]
        lanes[lane.TIME : lane.TIME + LANES] = share / np.maximum(1.0, w)
        lanes[lane.ANGLE_THERE : lane.ANGLE_THERE + LANES] = 7.0
        lanes[lane.VELOCITY_THERE : lane.VELOCITY_THERE + LANES] = 8.0
        bounce(lanes)
        with mp.workdps(40):
            for j in range(LANES):
                found = lanes[lane.ANGLE_THERE + j], lanes[lane.VELOCITY_THERE + j]
                if j % 2:
                    assert found == (7.0, 8.0)
                    continue
                time = float(lanes[lane.TIME + j])
                angle, velocity = flight_of(lanes, j).state(time)
                start, amplitude = lanes[lane.VELOCITY + j], lanes[lane.AMPLITUDE + j]
                size = start + (1.0 + amplitude) * time
                assert abs(found[0] - angle) < 2e-15 * size * time, (share, j)
                assert abs(found[1] - velocity) < 2e-15 * size, (share, j)


def test_a_step_comes_nearer_to_the_landing_and_says_whether_it_is_there() -> None:
    rng = np.random.default_rng(3)
    lanes = lanes_in_flight(rng)
    final = onward = 0
    with mp.workdps(30):
        landings: list[Any] = []
        for j in range(LANES):
            velocity, amplitude = lanes[lane.VELOCITY + j], lanes[lane.AMPLITUDE + j]
            pull = 1.0 - amplitude * lanes[lane.SINE + j]
            good = pull > 0.2 and velocity * (1.0 + lanes[lane.FREQUENCY + j]) < 0.2 * pull
            landings.append(flight_of(lanes, j).zero_near(2.0 * velocity / pull) if good else None)
        known = [j for j, landing in enumerate(landings) if landing is not None]
        assert len(known) > 3
        for off in (0.1, -0.1, 1e-3, 1e-6):
            for j in range(LANES):
                near = float(landings[j]) if j in known else 0.1
                lanes[lane.TIME + j] = near * (1.0 + off)
            shake(lanes)
            fly(lanes)
            approach(lanes)
            for j in known:
                landing = landings[j]
                reached, outcome = lanes[lane.REACHED + j], lanes[lane.OUTCOME + j]
                assert outcome in (1.0, 2.0)
                assert reached == lanes[lane.TIME + j] + lanes[lane.STEP + j]
                before = abs(off) * float(landing)
                blur = 1e-14 * (1.0 + 1.0 / float(lanes[lane.VELOCITY + j]))
                assert abs(float(reached - landing)) < 0.05 * before + blur, (off, j)
                _, speed = flight_of(lanes, j).state(float(reached))
                assert abs(lanes[lane.VELOCITY_THERE + j] - speed) < 0.05 * abs(speed)
                final += outcome == 2.0
                onward += outcome == 1.0
                if outcome == 2.0:
                    assert abs(float(reached - landing)) < 1e-9 * float(landing) + blur
    assert min(final, onward) > 3
    # A block that does not fall has nowhere to step to.
    lanes[lane.VELOCITY_THERE : lane.VELOCITY_THERE + LANES] = np.resize([0.0, 0.3], LANES)
    approach(lanes)
    assert not lanes[lane.OUTCOME : lane.OUTCOME + LANES].any()


def test_lanes_with_work_move_to_the_front_with_all_their_fields() -> None:
    rng = np.random.default_rng(4)
    for busy in (0, 1, GROUP, GROUP + 1, LANES - 1, LANES):
        lanes = rng.normal(size=FIELDS * LANES)
        lanes[lane.GROUPS] = LANES // GROUP
        at = np.sort(rng.permutation(LANES)[:busy])
        stages = np.full(LANES, lane.EMPTY)
        stages[at] = rng.choice([lane.POLISH, lane.LAUNCH, lane.SHORT], busy)
        lanes[lane.STAGE : lane.STAGE + LANES] = stages
        fields = [field for field in range(0, FIELDS * LANES, LANES) if field != lane.GROUPS]
        before = np.array([lanes[field + at] for field in fields])
        draw_together(lanes)
        after = np.array([lanes[field : field + busy] for field in fields])
        np.testing.assert_array_equal(after, before)
        assert (lanes[lane.STAGE + busy : lane.STAGE + LANES] == lane.EMPTY).all()
        assert working(lanes) == GROUP * max(1, math.ceil(busy / GROUP))


def test_the_census_counts_each_kind_of_stage_apart() -> None:
    kinds = {
        "none": [lane.EMPTY],
        "flying": [lane.LAUNCH, lane.LIFTED, lane.LANDED, lane.POLISH, lane.KNOWN, *range(15, 34)],
        "short": [lane.SHORT, 35.0, 39.0],
        "node": [lane.DOWN, lane.UP, 10.0, 13.0],
        "waiting": [
            lane.LEAVE,
            lane.ENDED,
            lane.FALLEN,
            lane.RESTED,
            arrival.LOOKING,
            arrival.SETTLED,
            arrival.ASTRAY,
        ],
        "special": [lane.SPECIAL],
    }
    weights = {name: {weight(stage) for stage in stages} for name, stages in kinds.items()}
    assert weights["none"] == {0}
    assert weights["flying"] == {1}
    assert all(len(each) == 1 for each in weights.values()), weights
    assert len(set().union(*weights.values())) == len(kinds)
    lanes = np.zeros(FIELDS * LANES)
    fill_empty(lanes, like_sides(np.array([0.8]))[0])
    for flying, nodes, waiting in (
        (0, 0, 0),
        (5, 0, 2),
        (5, 0, 3),
        (0, 4, 0),
        (5, 5, 0),
        (5, 4, 0),
        (16, 10, 0),
        (16, 9, 0),
    ):
        stages = [lane.POLISH] * flying + [lane.DOWN] * nodes + [lane.LEAVE] * waiting
        lanes[lane.STAGE : lane.STAGE + LANES] = stages + [lane.EMPTY] * (LANES - len(stages))
        numbers = census(lanes)
        # Three that wait are worth a look, or none goes on.
        assert in_need(numbers) == (waiting >= 3 or flying + nodes == 0), (flying, nodes, waiting)
        # Ten at nodes are worth their loop, or as many as fly.
        worth = nodes > 0 and (nodes >= 10 or nodes >= flying)
        assert at_nodes(numbers) == worth, (flying, nodes, waiting)


def test_each_lane_gives_back_the_state_that_it_was_given() -> None:
    rng = np.random.default_rng(5)
    lanes = np.zeros(FIELDS * LANES)
    ratios = rng.uniform(0.3, 0.9, LANES)
    fill_empty(lanes, like_sides(ratios[:1])[0])
    states, blocks = [], []
    for j in range(LANES):
        sides = np.array([[ratios[j], 1.0, 1.0], [ratios[j] * 0.9, *rng.uniform(0.7, 1.4, 2)]])
        # The side of a state is that of its half cycle and phase: the block lifts there.
        half, phase = int(rng.integers(0, 9)), float(rng.uniform(0.1, 3.0))
        side = 1 if rng.random() < 0.5 else -1
        load(lanes, j, j, float(rng.uniform(1.1, 3.0)), float(rng.uniform(0.5, 9.0)), sides, 0.7)
        state = March(side, 0.0, side * float(rng.uniform(0.1, 0.5)), 0, half, phase, j, 0)
        put_lane(lanes, j, state, 200, sides)
        states.append(state)
        blocks.append(sides)
    for j, (state, sides) in enumerate(zip(states, blocks, strict=True)):
        assert lanes[lane.CELL + j] == j
        found = taken(lanes, j, 200, sides)
        assert found.side == state.side
        assert found.half_cycles * math.pi + found.phase == pytest.approx(
            state.half_cycles * math.pi + state.phase, abs=1e-13
        )
        assert found.velocity == pytest.approx(state.velocity)
        assert found.impacts == j
        assert found.angle == 0.0
        lanes[lane.START_ANGLE + j], lanes[lane.START_VELOCITY + j] = 0.3, -0.2
        end = at_the_end(lanes, j, 200, sides)
        _, lean, rate = sides[0 if state.side > 0 else 1]
        assert end.angle == pytest.approx(0.3 * state.side * lean)
        assert end.velocity == pytest.approx(-0.2 * state.side * lean * rate)
        assert (end.half_cycles, end.phase, end.impacts) == (200, 0.7, j)
