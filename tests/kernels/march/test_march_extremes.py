"""The march at rest, in chatter, at extreme parameters, and through jumps."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.kernels.core.tables import (
    AT_REST,
    ENDED_BY_IMPACT,
    ENDED_BY_NO_RETURN,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    OVERTURNED,
    ROCKING,
    ROW_ANGLE,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    ROW_VELOCITY,
    UNDECIDED,
)
from tests.every import every
from tests.kernels.tables import (
    Piece,
    both_sides,
    harmonic,
    run,
    signs_hold,
    table,
)
from tests.oracles import mp
from tests.strategies import sample_size

TWO_PI = 2.0 * math.pi


# ---------------------------------------------------------------------------- rest and extremes


@given(
    amplitude=st.floats(0.0, 1.0),
    frequency=st.floats(0.05, 1000.0),
    restitution=st.floats(1e-6, 1.0),
    phase=st.floats(0.0, 3.14),
)
def test_a_block_at_rest_stays_where_the_base_cannot_lift_it(
    amplitude: float, frequency: float, restitution: float, phase: float
) -> None:
    ran = run(harmonic(amplitude, frequency, phase), both_sides(restitution), half_cycles=200)
    assert ran.status == AT_REST
    assert ran.end.impacts == 0
    assert ran.end.flights == 1


@given(
    amplitude=st.floats(1.0, 12.0, exclude_min=True),
    frequency=st.floats(0.05, 1000.0),
    phase=st.floats(0.0, 3.14),
)
def test_uplift_happens_at_the_node_itself(
    amplitude: float, frequency: float, phase: float
) -> None:
    ran = run(harmonic(amplitude, frequency, phase), both_sides(0.5), half_cycles=4, limit=2)
    node = math.atan2(1.0, math.sqrt((amplitude - 1.0) * (amplitude + 1.0)))
    if node <= phase < math.pi - node:
        assert ran.rows[0, ROW_SIDE] == 1.0  # already above: it lifts at once
        assert ran.rows[0, ROW_PHASE] == phase
        return
    assert ran.rows[0, ROW_EVENT] == ENDED_BY_UPLIFT
    lifted = ran.rows[1]
    assert lifted[ROW_PHASE] == pytest.approx(node, rel=1e-15)
    assert lifted[ROW_HALF_CYCLES] == (0.0 if phase < node else 1.0)
    assert lifted[ROW_SIDE] == (1.0 if phase < node else -1.0)
    assert (lifted[ROW_ANGLE], lifted[ROW_VELOCITY]) == (0.0, 0.0)


@every("side", [1, -1])
@every("phase", [0.0, 0.3, 1.0, 2.7, 3.1])
def test_a_side_that_alone_can_lift_waits_for_its_own_node(side: int, phase: float) -> None:
    # The other side is five times as broad: it never lifts, and half of all nodes do nothing.
    lean = (1.0, 5.0) if side > 0 else (5.0, 1.0)
    ran = run(harmonic(2.0, 4.0, phase), both_sides(0.3, lean), half_cycles=4, limit=2)
    node, start = math.asin(0.5), phase if side > 0 else phase - math.pi
    if node <= start < math.pi - node:
        assert ran.rows[0, ROW_SIDE] == side
        return
    ahead = node - start if start < node else node - start + TWO_PI
    assert ran.rows[0, ROW_DURATION] == pytest.approx(ahead / 4.0, rel=1e-14)
    lifted = ran.phases()[1]
    assert float(lifted) == pytest.approx(phase + ahead, rel=1e-14)
    assert ran.rows[1, ROW_SIDE] == side


def test_a_start_exactly_at_uplift_lifts_at_once() -> None:
    node = math.asin(0.5)
    ran = run(harmonic(2.0, 4.0, node), both_sides(0.5), half_cycles=4, limit=1)
    assert (ran.rows[0, ROW_SIDE], ran.rows[0, ROW_PHASE]) == (1.0, node)
    assert ran.rows[0, ROW_EVENT] == ENDED_BY_IMPACT


def test_without_shaking_a_tilted_block_rocks_to_rest() -> None:
    for frequency in (0.0, 3.0):
        ran = run(
            table(Piece(frequency=frequency)), both_sides(0.9), side=-1, angle=-0.9, until=1e6
        )
        assert ran.status == AT_REST
        # Zeno: the whole chatter lasts the sum of its half periods (H3).
        energy, total = 0.81, mp.acosh(1 / (1 - mp.mpf(0.9)))
        for n in range(1, 2000):
            rest = mp.mpf(energy) ** n * (1 - (1 - mp.mpf(0.9)) ** 2)
            total += 2 * mp.atanh(mp.sqrt(rest))
        settled = ran.times()[-1]
        assert settled <= total * (1 + mp.mpf(10) ** -13)
        assert ran.rows[-1, ROW_SIDE] == 0.0


@every(
    ("angle", "velocity", "status"),
    [
        (1.2, 0.0, OVERTURNED),
        (1.2, -0.21, AT_REST),
        (1.2, -0.19, OVERTURNED),
        (0.9, 0.2, OVERTURNED),
        (0.9, 0.09, AT_REST),
        (-1.2, 0.0, OVERTURNED),
        (-1.2, 0.21, AT_REST),
        (-0.9, -0.2, OVERTURNED),
    ],
)
def test_beyond_the_critical_angle_it_may_come_back(
    angle: float, velocity: float, status: int
) -> None:
    # Free rocking: it falls where |x| + |x'| outwards exceeds 1.
    side = 1 if angle > 0 else -1
    ran = run(table(Piece()), both_sides(0.5), side=side, angle=angle, velocity=velocity)
    assert ran.status == status
    if status == OVERTURNED:
        assert ran.rows[-1, ROW_EVENT] == ENDED_BY_NO_RETURN


@pytest.mark.parametrize("frequency", [0.0, 2.0])
def test_a_block_balanced_exactly_neither_falls_nor_returns(frequency: float) -> None:
    ran = run(table(Piece(frequency=frequency)), both_sides(0.5), side=1, angle=1.0, until=100.0)
    assert ran.status == ROCKING
    assert ran.end.impacts == 0
    assert (ran.end.angle, ran.end.velocity) == (1.0, 0.0)


def test_the_limit_ends_a_march_undecided() -> None:
    ran = run(harmonic(2.0, 4.0), both_sides(0.8), side=1, velocity=0.3, limit=17)
    assert ran.status == UNDECIDED
    assert (ran.end.flights, ran.end.impacts, len(ran.rows)) == (17, 17, 17)


@every("restitution", [1.0, 0.999999, 1e-3, 1e-6])
@every("frequency", [0.05, 1.0, 30.0, 1000.0])
@every("amplitude", sample_size([0.9, 1.0, 1.0000001, 3.0, 12.0], [1.0, 12.0]))
def test_extreme_cases_end_soundly(restitution: float, frequency: float, amplitude: float) -> None:
    for side, velocity in ((0, 0.0), (1, 0.3 / frequency), (-1, -1e-9)):
        ran = run(
            harmonic(amplitude, frequency, 0.3),
            both_sides(restitution),
            side=side,
            velocity=velocity,
            half_cycles=20,
            limit=sample_size(20_000, 500),
        )
        if ran.status == UNDECIDED:
            # Chatter with next to no loss, or none, goes on and on.
            assert restitution > 0.999
        assert signs_hold(ran.rows)
        assert np.all(np.isfinite(ran.rows[:-1]))
        assert np.all(ran.rows[:, ROW_DURATION] >= 0.0)
        ends = set(ran.rows[:-1, ROW_EVENT])
        assert ends <= {float(ENDED_BY_IMPACT), float(ENDED_BY_UPLIFT)}
        assert ran.status != ROCKING or ran.rows[-1, ROW_EVENT] == ENDED_BY_SPAN


def test_a_run_of_no_length_ends_as_it_began() -> None:
    flying = run(harmonic(2.0, 4.0, 1.0), both_sides(0.8), side=1, velocity=0.3, half_cycles=0)
    assert (flying.status, flying.end.impacts, flying.end.velocity) == (ROCKING, 0, 0.3)
    resting = run(harmonic(2.0, 4.0, 1.0), both_sides(0.8), half_cycles=0)
    assert (resting.status, resting.end.impacts, resting.end.side) == (AT_REST, 0, 0)


# -------------------------------------------------------------------------------------- jumps


@every("jump", [0.2, -0.2, 1.001, -1.001])
def test_an_impulse_sets_a_block_at_rest_in_motion(jump: float) -> None:
    ran = run(table(Piece(0.5), Piece(jump=jump)), both_sides(0.7), limit=100_000)
    # On a still base energy decides: it falls where |x'| > 1.
    assert ran.status == (OVERTURNED if abs(jump) > 1.0 else AT_REST)
    lifted = ran.rows[1]
    assert lifted[ROW_SIDE] == math.copysign(1.0, jump)
    assert lifted[ROW_VELOCITY] == jump
    if abs(jump) < 1.0:
        assert lifted[ROW_DURATION] == pytest.approx(2.0 * math.atanh(abs(jump)), rel=1e-15)


def test_an_impulse_adds_to_the_velocity_in_flight() -> None:
    ran = run(table(Piece(0.3), Piece(jump=-0.25)), both_sides(0.7), side=1, velocity=0.4, limit=2)
    y = 0.4 * math.sinh(0.3) - 2.0 * math.sinh(0.15) ** 2
    v = 0.4 * math.cosh(0.3) - math.sinh(0.3)
    assert ran.rows[1, ROW_ANGLE] == pytest.approx(y, rel=1e-15)
    assert ran.rows[1, ROW_VELOCITY] == pytest.approx(v - 0.25, rel=1e-15)


def test_no_proof_of_falling_is_given_before_the_last_impulse() -> None:
    # It would fall, but an impulse that is still to come throws it back.
    pieces = Piece(5.0), Piece(5.0), Piece(jump=-1000.0)
    ran = run(table(*pieces), both_sides(0.5), side=1, velocity=1.01, limit=100_000)
    assert ran.end.impacts > 0
    ran = run(table(*pieces[:2], Piece()), both_sides(0.5), side=1, velocity=1.01)
    assert (ran.status, ran.end.impacts) == (OVERTURNED, 0)


def test_a_segment_list_overturns_no_later_than_it_must() -> None:
    # sigma x >= 1 + max |a| still to come, with sigma x' >= 0: proved at the end of a segment.
    pieces = [Piece(0.5, constant=2.0 * (-1.0) ** i) for i in range(200)]
    ran = run(table(*pieces, Piece()), both_sides(0.5), side=1, velocity=2.5)
    assert ran.status == OVERTURNED
    angle, velocity = ran.end.angle, ran.end.velocity
    assert angle >= 3.0
    assert velocity >= 0.0
    assert ran.end.flights < 10
