"""What a march amounts to: times of its flights, of its rest and of its fall, and its impacts."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    AT_REST,
    COUNTED,
    ENDED_BY_IMPACT,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    ORDERS,
    OVERTURNED,
    ROCKING,
    ROW_EVENT,
    ROW_PHASE,
    SEGMENT_COLUMNS,
    SHARES,
)
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.march.facts import (
    ELASTIC_TIME,
    LANDING_ROWS,
    LONGEST_REST,
    RunFacts,
    base_at,
    fill_landings,
    run_end,
    run_facts,
)
from rocksteady.kernels.march.replay import fill_states
from tests.every import every
from tests.kernels.tables import Piece, Run, both_sides, harmonic, run, table

Floats = NDArray[np.float64]


def facts_of(ran: Run, sides: Floats) -> tuple[Floats, RunFacts, Floats]:
    """Return the times at which rows begin, what the march amounts to, and its impacts."""
    starts, tables = np.zeros(len(ran.rows)), Tables(ran.segments, sides)
    facts = run_facts(tables, ran.rows, ran.status, starts)
    landings = np.zeros((LANDING_ROWS, len(ran.rows)))
    count = fill_landings(tables, ran.rows, starts, landings)
    return starts, facts, landings[:, :count]


def test_rows_begin_where_the_ones_before_end_and_impacts_are_between_them() -> None:
    pieces = (Piece(1.5, 0.1, -0.2, 1.2, 3.0, 0.4), Piece(1.0, jump=0.05), Piece(4.0))
    sides = both_sides(0.8)
    for ran in (
        run(harmonic(2.0, 4.0, 0.3), sides, side=1, velocity=0.3, half_cycles=30),
        run(table(*pieces, Piece()), sides, side=1, velocity=0.2, until=7.5, rest_velocity=1e-8),
    ):
        starts, facts, landings = facts_of(ran, sides)
        assert starts == pytest.approx(ran.times(), abs=1e-12)
        (ended,) = np.nonzero(ran.rows[:-1, ROW_EVENT] == ENDED_BY_IMPACT)
        count = len(ended)
        assert count > 3
        time, _, phase, side, before, after = landings[:, :count]
        assert time.tolist() == starts[ended + 1].tolist()
        assert phase.tolist() == ran.rows[ended + 1, ROW_PHASE].tolist()
        assert (np.sign(before) == -side).all()
        assert after == pytest.approx(0.8 * before, rel=1e-15)
        assert (facts.end, facts.passing) == (starts[-1] + facts.last, -1)
        assert math.isnan(facts.overturned)
        assert {type(value) for value in (*facts[:-1], *facts.peaks)} == {float, int}


@every(("push", "ratios"), [(0.0, (0.5, 0.5)), (0.3, (0.5, 0.5)), (-0.3, (0.4, 0.7))])
def test_a_block_rests_after_the_bounces_that_are_not_recorded(
    push: float, ratios: tuple[float, float]
) -> None:
    # A bounce of velocity v on a side that is pulled back by g lasts 2 atanh(v/g), and the next,
    # on the other side, has r v.
    sides = both_sides(ratios)
    base = table(Piece(constant=push))
    ran = run(base, sides, side=1, velocity=0.2, rest_velocity=1e-8)
    starts, facts, landings = facts_of(ran, sides)
    assert ran.status == AT_REST
    total, velocity = 0.0, 0.2
    for k in range(120):
        total += 2.0 * math.atanh(velocity / (1.0 + push if k % 2 else 1.0 - push))
        velocity *= ratios[k % 2]
    assert facts.rested == pytest.approx(total, rel=1e-12)
    assert starts[-1] < facts.rested < facts.end
    assert np.abs(landings[5, -1]) < COUNTED
    still = run(base, sides)
    assert facts_of(still, sides)[1].rested == 0.0


def test_the_base_at_any_time_is_that_of_its_segment() -> None:
    pieces = (Piece(1.5, 0.1, -0.2, 1.2, 3.0, 0.4), Piece(2.0, amplitude=2.0, frequency=5.0))
    segments = np.zeros((3, SHARES + 4))
    segments[:, :SEGMENT_COLUMNS] = table(*pieces, Piece(constant=-0.7))
    segments[1, ORDERS:] = 2, 0.3, -0.1, 0.4, 0.2
    segments[:, LIFT : LIFT_SLOPE + 1] = (0.1, 0.2), (0.3, -0.4), (-0.5, 0.6)
    for time in (0.0, 0.7, 1.49):
        lift = 0.1 + 0.2 * time
        assert base_at(segments, time) == pytest.approx((pieces[0].base(time), lift)), time
    for since in (0.0, 1.1, 1.99):
        swing = 0.3 * math.sin(5.0 * since) - 0.1 * math.cos(5.0 * since)
        swing += 0.4 * math.sin(10.0 * since) + 0.2 * math.cos(10.0 * since)
        expected = 2.0 * swing, 0.3 - 0.4 * since
        assert base_at(segments, 1.5 + since) == pytest.approx(expected), since
    assert base_at(segments, 3.5 + 2.0) == pytest.approx((-0.7, 0.7))


def test_a_fall_passes_the_slenderness_and_is_followed_to_twice_that() -> None:
    # y = 1 - cosh t + V sinh t: y = 1 where tanh t = 1/V, y = 2 where it is (1 + ...)/V.
    sides, velocity = both_sides(0.5), 1.3
    ran = run(table(Piece()), sides, side=-1, velocity=-velocity)
    assert ran.status == OVERTURNED
    _, facts, _ = facts_of(ran, sides)
    assert (facts.passing, facts.since) == (0, facts.overturned)
    assert facts.overturned == pytest.approx(math.atanh(1.0 / velocity), rel=1e-13)
    reached = 1.0 - math.cosh(facts.end) + velocity * math.sinh(facts.end)
    assert reached == pytest.approx(2.0, rel=1e-12)
    assert facts.peaks[:2] == (0.0, 1.0)
    assert facts.peaks[2] == pytest.approx(velocity)


def test_a_march_without_rows_has_no_times() -> None:
    sides = both_sides(0.5)
    tables = Tables(table(Piece()), sides)
    facts = run_facts(tables, np.zeros((0, 8)), ROCKING, np.zeros(0))
    assert (facts.end, facts.peaks) == (0.0, (0.0, 0.0, 0.0))


@every(
    ("segments", "restitution", "end"),
    [
        (table(Piece(2.0, 1.0), Piece()), 0.8, (0, LONGEST_REST)),
        (table(Piece(2.0, 1.0), Piece()), 1.0, (0, ELASTIC_TIME)),
        (harmonic(2.0, 4.0), 1.0, (14, 0.5 * math.pi)),
        (harmonic(2.0, 4.0, 0.75 * math.pi), 0.8, (15, 0.25 * math.pi)),
    ],
)
def test_where_a_run_of_seven_and_a_quarter_periods_ends(
    segments: Floats, restitution: float, end: tuple[int, float]
) -> None:
    half, phase = run_end(Tables(segments, both_sides(restitution)), 7.25)
    assert half == end[0]
    assert phase == pytest.approx(end[1])


def bounce_time(velocity: float, alpha: float, push: float, weight: float) -> float:
    """Return how long a bounce on a still base lasts, in a side's own units, by its energy.

    The motion is y'' = h cos(alpha (1 - y)) - k sin(alpha (1 - y))/alpha; alpha 0 is y - 1 + h.
    """
    if alpha == 0.0:
        return 2.0 * math.atanh(velocity / (1.0 - push))

    foot = weight * math.sin(alpha) / alpha - push * math.cos(alpha)
    if velocity < 1e-5 * foot:
        return 2.0 * velocity / foot

    def depth(top: float, y: Any) -> Any:
        """Return half the square of the speed at y below a top."""
        middle, half = alpha * (1.0 - 0.5 * (top + y)), 0.5 * alpha * (top - y)
        pull = weight * np.sin(middle) / alpha - push * np.cos(middle)
        return 2.0 * np.sin(half) * pull / alpha

    low, high = 0.0, min(1.0, velocity * velocity / foot)
    for _ in range(60):
        middle = 0.5 * (low + high)
        below = depth(middle, 0.0) < 0.5 * velocity * velocity
        low, high = (middle, high) if below else (low, middle)
    nodes, weights = np.polynomial.legendre.leggauss(24)
    u = 0.5 * (nodes + 1.0)  # y = top (1 - u^2) takes the root away
    speed = np.sqrt(2.0 * depth(high, high * (1.0 - u * u)))
    return 2.0 * float(np.sum(weights * high * u / speed))


def rest_by_bounces(sides: Floats, velocity: float, push: float, lift: float, free: bool) -> float:
    """Return when bounces from the floor of the positive side are over, in reference time."""
    total, side = 0.0, 0
    for _ in range(400):
        ratio, lean, rate, *more = sides[side]
        towards = push if side == 0 else -push
        alpha = more[0] if more else 0.0
        own = velocity / (lean * rate)
        total += bounce_time(own, alpha, towards / lean, 1.0 + lift) / rate
        velocity *= abs(ratio)
        side = side if free else 1 - side
        if velocity < 1e-12:
            break
    return total


@every(
    ("ratios", "lean", "rate", "alpha", "push", "lift"),
    [
        ((-0.5, 1.0), (1.0, 1.0), (1.0, 1.0), None, 0.0, 0.0),  # against a wall
        ((-0.6, 1.0), (1.0, 1.0), (1.0, 1.0), None, 0.4, 0.0),
        ((-0.6, 1.0), (1.0, 1.0), (1.0, 1.0), None, -0.4, 0.0),
        ((-0.5, 1.0), (1.0, 1.0), (1.0, 1.0), (0.4, 0.4), 0.2, 0.3),
        ((0.5, 0.6), (1.0, 0.7), (1.0, 1.3), None, 0.0, 0.0),
        ((0.6, 0.4), (1.0, 1.4), (1.0, 0.8), None, 0.3, 0.0),
        ((0.5, 0.5), (1.0, 1.0), (1.0, 1.0), (0.5, 0.5), 0.0, 0.0),
        ((0.5, 0.5), (1.0, 1.0), (1.0, 1.0), (0.5, 0.5), 0.3, -0.4),
        ((0.5, 0.5), (1.0, 1.0), (1.0, 1.0), (0.5, 0.5), -0.2, 0.4),
        ((0.6, 0.5), (1.0, 0.8), (1.0, 1.2), (0.5, 0.4), 0.2, 0.2),
    ],
)
def test_rest_comes_when_bounces_by_their_energy_are_over(
    ratios: tuple[float, float],
    lean: tuple[float, float],
    rate: tuple[float, float],
    alpha: tuple[float, float] | None,
    push: float,
    lift: float,
) -> None:
    sides = both_sides(ratios, lean, rate)
    if alpha is not None:
        sides = np.column_stack([sides, alpha, [1e-15] * 2])
    segments = table(Piece(constant=push))
    if alpha is not None:
        segments = np.column_stack([segments, np.zeros((1, LIFT_CEILING + 1 - SEGMENT_COLUMNS))])
        segments[0, LIFT], segments[0, LIFT_CEILING] = lift, abs(lift)
    ran = run(segments, sides, side=1, velocity=0.1, rest_velocity=1e-8)
    assert ran.status == AT_REST
    _, facts, _ = facts_of(ran, sides)
    expected = rest_by_bounces(sides, 0.1, push, lift, ratios[0] < 0.0)
    assert facts.rested == pytest.approx(expected, rel=1e-9)
    assert facts.rested < facts.end == facts.last + facts_of(ran, sides)[0][-1]


@every(
    ("alpha", "angle", "level"),
    [(None, 0.0, 2.0), (None, 0.5, 2.0), (None, 1.5, 2.5), (0.3, 0.2, 2.0), (1.2, 0.2, 1.309)],
)
def test_a_fall_is_followed_to_a_level_or_until_the_block_lies(
    alpha: float | None, angle: float, level: float
) -> None:
    for lean, side in ((1.0, 1), (0.8, -1)):
        sides = both_sides(0.5, (1.0, lean))
        segments = table(Piece())
        if alpha is not None:
            sides = np.column_stack([sides, [alpha] * 2, [1e-15] * 2])
            segments = np.column_stack(
                [segments, np.zeros((1, LIFT_CEILING + 1 - SEGMENT_COLUMNS))]
            )
            level = min(level, 0.5 * math.pi / alpha)
        own = 1.0 if side > 0 else lean
        ran = run(segments, sides, side=side, angle=side * angle * own, velocity=1.6 * side * own)
        assert ran.status == OVERTURNED
        _, facts, _ = facts_of(ran, sides)
        states, row = np.empty((3, 1)), np.array([len(ran.rows) - 1])
        fill_states(segments, sides, ran.rows, row, np.array([facts.last]), states)
        assert abs(states[0, 0]) == pytest.approx(level * own, rel=1e-9)
        assert facts.passing == 0


@every(
    ("ratios", "end"),
    [
        ((1.0, 1.0), ELASTIC_TIME),
        ((-1.0, 1.0), ELASTIC_TIME),
        ((1.0, 0.9), LONGEST_REST),
        ((0.9, 1.0), LONGEST_REST),
        ((-0.9, 1.0), LONGEST_REST),
    ],
)
def test_only_a_block_that_loses_nothing_is_followed_for_a_bounded_time(
    ratios: tuple[float, float], end: float
) -> None:
    assert run_end(Tables(table(Piece()), both_sides(ratios)), 3.0) == (0, end)


def test_half_cycles_and_phase_make_the_periods_asked_for() -> None:
    for phase in (-2.0, -0.3, 0.0, 0.3, 1.5, 3.0, 3.1415926, 7.0):
        for cycles in (0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 2.4, 100.5):
            half, rest = run_end(Tables(harmonic(2.0, 4.0, phase), both_sides(0.8)), cycles)
            assert 0.0 <= rest < math.pi
            assert half * math.pi + rest == pytest.approx(phase + 2.0 * math.pi * cycles, abs=1e-12)
