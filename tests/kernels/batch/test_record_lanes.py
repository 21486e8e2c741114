"""Lanes of blocks on one record: each keeps its own numbers, and passes as its equation has it."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady.kernels.batch._record_lanes import (
    CELL,
    FLIGHTS,
    IMPACTS,
    SEGMENT,
    SIDE,
    WHOLES,
    empty_lanes,
    land,
    put_flight,
    step,
    taken,
)
from rocksteady.kernels.core import rides
from rocksteady.kernels.core.tables import (
    ALIKE,
    ALPHA,
    CEILING,
    CONSTANT,
    DURATION,
    LEAN,
    LEFT_OUT,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    PASSAGE_COLUMNS,
    RATE,
    RESTITUTION,
    SLOPE,
    March,
)
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.nonlinear.sample_lanes import FIELDS, LANES
from rocksteady.kernels.nonlinear.series import make_work

Floats = NDArray[np.float64]
SAMPLES = 12


class Case(NamedTuple):
    """All lanes with a flight each, and what they were made of."""

    lanes: Floats
    wholes: NDArray[np.int64]
    segments: Floats
    blocks: Floats
    states: list[March]
    held: Floats


def drawn(seed: int, step: float) -> Case:
    """Return lanes of unlike blocks, each in a sample of its own, many of them about to land."""
    rng = np.random.default_rng(seed)
    segments = np.zeros((SAMPLES + 1, NONLINEAR_SEGMENT_COLUMNS))
    flat, heave = rng.normal(0.0, 0.5, SAMPLES + 1), rng.normal(0.0, 0.2, SAMPLES + 1)
    segments[:-1, DURATION], segments[-1, DURATION] = step, math.inf
    segments[:-1, CONSTANT], segments[:-1, SLOPE] = flat[:-1], np.diff(flat) / step
    segments[:-1, LIFT], segments[:-1, LIFT_SLOPE] = heave[:-1], np.diff(heave) / step
    segments[:, CEILING], segments[:, LIFT_CEILING] = 5.0, 0.9
    segments[:-1, ALIKE] = np.arange(SAMPLES - 1, -1, -1)
    blocks = np.zeros((LANES, 2, NONLINEAR_SIDE_COLUMNS))
    blocks[:, :, RESTITUTION] = rng.uniform(0.4, 0.95, (LANES, 2))
    blocks[:, :, LEAN] = rng.uniform(0.7, 1.4, (LANES, 2))
    blocks[:, :, RATE] = rng.uniform(0.7, 1.4, (LANES, 2))
    blocks[:, :, ALPHA] = np.exp(rng.uniform(np.log(0.05), np.log(0.5), (LANES, 2)))
    blocks[:, :, LEFT_OUT] = 1e-15
    lanes, wholes = np.zeros(FIELDS * LANES), np.zeros((WHOLES, LANES), np.int64)
    empty_lanes(lanes, wholes)
    states, held = [], np.zeros((LANES, rides.RIDE_COLUMNS))
    for j in range(LANES):
        side = int(rng.choice([-1, 1]))
        state = March(
            side, 0.0, 0.0, int(rng.integers(0, SAMPLES - 2)), 0,
            float(rng.choice([0.0, rng.uniform(0.0, 0.8)])) * step,
            int(rng.integers(0, 50)), int(rng.integers(0, 90)),
        )  # fmt: skip
        angle, velocity = float(rng.uniform(0.1, 0.7)), float(rng.normal(0.0, 0.3))
        if j % 3 == 0:  # comes down
            angle, velocity = float(rng.uniform(0.0, 0.3 * step)), -float(rng.uniform(0.5, 1.0))
        if j % 3 == 1:  # hops for about as long as the sample lasts
            angle, velocity = 0.0, float(rng.uniform(0.05, 0.6)) * step
        held[j] = 1.0, angle, velocity, rng.choice([0.9, angle]), rng.choice([2.0, 1.1]), 0.0
        put_flight(lanes, wholes, j, Tables(segments, blocks[j]), state, held[j])
        wholes[CELL, j] = j
        states.append(state)
    return Case(lanes, wholes, segments, blocks, states, held)


def flown(case: Case, j: int) -> Any:
    """Return the flight over the rest of a lane's sample by DOP853, in the units of its side."""
    state, row = case.states[j], case.segments[case.states[j].segment]
    _, lean, rate, alpha, _ = case.blocks[j, 0 if state.side > 0 else 1]

    def slopes(t: float, y: Floats) -> list[float]:
        since = state.phase + t / rate
        push = state.side * (row[CONSTANT] + row[SLOPE] * since) / lean
        weight = 1.0 + row[LIFT] + row[LIFT_SLOPE] * since
        tilt = alpha * (1.0 - y[0])
        return [y[1], push * math.cos(tilt) - weight * math.sin(tilt) / alpha]

    def floor(_: float, y: Floats) -> float:
        return float(y[0])

    floor.direction = -1.0  # type: ignore[attr-defined]
    span = (row[DURATION] - state.phase) * rate
    start = case.held[j, [rides.ANGLE, rides.VELOCITY]]
    times = np.linspace(0.0, span, 33)
    return solve_ivp(
        slopes, (0.0, span), start, "DOP853", times, events=floor, rtol=1e-12, atol=1e-14
    )


def test_each_lane_gives_back_the_flight_that_it_was_given() -> None:
    case = drawn(1, 0.05)
    for j, state in enumerate(case.states):
        ride = np.zeros(rides.RIDE_COLUMNS)
        assert taken(case.lanes, case.wholes, j, ride) == state
        assert ride.tolist() == case.held[j].tolist()
    assert case.wholes[[SIDE, SEGMENT, IMPACTS, FLIGHTS]].T.tolist() == [
        [state.side, state.segment, state.impacts, state.flights] for state in case.states
    ]


def check_lanes(seed: int, sample: float, *, lands: bool) -> tuple[int, int]:
    """Compare a pass with the equation of motion; return how many lanes passed and landed."""
    case = drawn(seed, sample)
    before = case.lanes.copy()
    passages = np.zeros((LANES, PASSAGE_COLUMNS))
    if lands:
        waiting, landed = land(
            case.lanes, case.wholes, case.segments, case.blocks, passages, make_work(None), 1000
        )
    else:
        waiting, landed = step(case.lanes, case.wholes, case.segments, 1000), 0
    passed = touched = 0
    for j, state in enumerate(case.states):
        ride = np.zeros(rides.RIDE_COLUMNS)
        later = taken(case.lanes, case.wholes, j, ride)
        if later.flights == state.flights:
            assert later == state, j
            assert ride[1:5].tolist() == case.held[j, 1:5].tolist(), j
            continue
        run = flown(case, j)
        row = 0 if state.side > 0 else 1
        restitution, lean, rate, *_ = case.blocks[j, row]
        assert later.flights == state.flights + 1
        tops = case.held[j, [rides.TOP_ANGLE, rides.TOP_SPEED]]
        if later.segment == state.segment:
            touched += 1
            (time,), (end,) = run.t_events[0][:1], run.y_events[0][:1]
            assert later.side == -state.side
            assert abs(later.phase - state.phase - time / rate) < 1e-10
            there = case.blocks[j, 1 - row]
            out = -restitution * end[1] * lean * rate / (there[LEAN] * there[RATE])
            assert ride[1] == 0.0
            assert abs(ride[2] - out) < 1e-9
            assert later.impacts == state.impacts + 1
            unit = lean * rate / (there[LEAN] * there[RATE])
            fastest = max(tops[1], abs(case.held[j, 2]), abs(end[1]))
            assert abs(ride[4] - fastest * unit) < 1e-9
            continue
        passed += 1
        assert (later.segment, later.side) == (state.segment + 1, state.side)
        assert (later.phase, later.impacts) == (0.0, state.impacts)
        assert not len(run.t_events[0])
        assert np.abs(ride[1:3] - run.y[:, -1]).max() < 1e-10, j
        # A peak lies between two of the times by no more than the motion bends there.
        for top, values, kept in zip(tops, np.abs(run.y), ride[3:5], strict=True):
            between = np.abs(np.diff(values, 2)).max()
            assert -1e-9 < kept - max(top, values.max()) < 1e-9 + between
    assert (waiting, landed) == (LANES - passed - touched, touched)
    assert not np.array_equal(before, case.lanes)
    return passed, touched


def test_lanes_pass_and_land_as_the_equation_of_motion_has_it() -> None:
    plain = [check_lanes(seed, 0.005, lands=False) for seed in (2, 3)]
    longer = [check_lanes(seed, 0.05, lands=False) for seed in (4, 5)]
    landing = [check_lanes(seed, sample, lands=True) for seed, sample in ((6, 0.05), (7, 0.01))]
    coarse = [check_lanes(8, 0.6, lands=True)]
    assert all(passed > LANES // 6 for passed, _ in (*plain, *longer))
    assert all(min(counts) > LANES // 8 for counts in landing)
    assert coarse[0][0] > 2


def test_lanes_at_the_end_of_a_run_or_of_their_flights_and_empty_ones_wait() -> None:
    case = drawn(9, 0.005)
    whole = case.wholes.copy()
    free = step(case.lanes.copy(), whole, case.segments, 1000)
    assert free < LANES
    for limit, segment, cell in ((1, None, None), (1000, SAMPLES - 2, None), (1000, None, -1)):
        lanes, wholes = case.lanes.copy(), case.wholes.copy()
        if segment is not None:
            wholes[SEGMENT] = segment
        if cell is not None:
            wholes[CELL] = cell
        kept = wholes.copy()
        assert step(lanes, wholes, case.segments, limit) == LANES
        assert np.array_equal(wholes, kept)
    # The last flight below the limit is one less than it.
    for flights, waits in ((7, False), (8, True)):
        lanes, wholes = case.lanes.copy(), case.wholes.copy()
        wholes[FLIGHTS] = flights
        waiting = step(lanes, wholes, case.segments, 9)
        assert waiting == (LANES if waits else free)
