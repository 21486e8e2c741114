"""The march against 50 digits."""

import math
from itertools import pairwise

import numpy as np
import pytest

from rocksteady.kernels.core.tables import (
    COUNTED,
    ENDED_BY_IMPACT,
    ENDED_BY_UPLIFT,
    ROCKING,
    ROW_EVENT,
    ROW_SIDE,
)
from tests.every import every
from tests.kernels.tables import (
    Piece,
    Run,
    both_sides,
    exact_segments,
    harmonic,
    march_to,
    run,
    signs_hold,
    table,
)
from tests.oracles import ExactImpact, exact_march, mp
from tests.strategies import sample_size

TWO_PI = 2.0 * math.pi


# ---------------------------------------------------------------------------------- 50 digits

# Amplitude, frequency ratio, restitution, phase, velocity: all settle on periodic motion.
PERIODIC = [
    (2.0, 4.0, 0.8, 0.0, 0.3),
    (2.0, 6.0, 0.8, 1.78, 0.64),  # order 3
    (3.0, 8.0, 0.95, 2.88, 0.86),  # order 3
    (2.0, 1.9, 0.8, 2.8822, 1.2615),  # unsymmetric
    (2.0, 1.85, 0.8, 2.8843, 1.2831),  # unsymmetric, and above 1 for a while
    (0.109, 0.7, 0.9, 2.35, 0.96),
    (0.48, 1.0, 0.6, 1.89, 0.74),
    (6.0, 40.0, 0.7, 0.5, 0.1),
    (4.0, 300.0, 0.9, 3.0, 0.01),
    (0.6, 3.0, 0.85, 2.5, 0.2),  # never enough to lift a block at rest
]


def exact_harmonic(
    amplitude: float,
    frequency: float,
    restitution: float,
    phase: float,
    velocity: float,
    half_cycles: int,
) -> list[ExactImpact]:
    return exact_march(
        exact_segments(Piece(amplitude=amplitude, frequency=frequency, phase=phase)),
        half_cycles * mp.pi / mp.mpf(frequency),
        side=1,
        velocity=velocity,
        restitution=(mp.mpf(restitution),) * 2,
    ).impacts


def compare(ran: Run, exact: list[ExactImpact]) -> None:
    found = ran.impacts()
    assert len(found) == len(exact)
    assert len(found) > 5
    for (time, side, velocity), truth in zip(found, exact, strict=True):
        assert side == truth.side
        assert abs(time - truth.time) <= 1e-13 * truth.time
        assert abs(velocity - truth.velocity) <= 1e-12 * abs(truth.velocity)


@every("case", PERIODIC)
def test_impacts_lie_where_fifty_digits_put_them(
    case: tuple[float, float, float, float, float],
) -> None:
    amplitude, frequency, restitution, phase, velocity = case
    cycles = sample_size(20, 12)
    ran = run(
        harmonic(amplitude, frequency, phase),
        both_sides(restitution),
        side=1,
        velocity=velocity,
        half_cycles=2 * cycles,
        rest_velocity=0.0,
    )
    assert ran.status == ROCKING
    compare(ran, exact_harmonic(*case, half_cycles=2 * cycles))


@pytest.mark.slow
@every("case", sample_size(PERIODIC[:4], PERIODIC[1:2]))
def test_the_phase_is_right_to_1e_14_after_200_cycles(
    case: tuple[float, float, float, float, float],
) -> None:
    amplitude, frequency, restitution, phase, velocity = case
    exact = exact_harmonic(*case, half_cycles=400)
    end = march_to(
        harmonic(amplitude, frequency, phase), both_sides(restitution), len(exact), velocity
    )
    truth = phase + mp.mpf(frequency) * exact[-1].time
    assert abs(end.half_cycles * mp.pi + mp.mpf(end.phase) - truth) <= 1e-14
    assert abs(end.velocity - exact[-1].velocity) <= 1e-13 * abs(end.velocity)


# From rest: uplift, bounces that die out in infinitely many impacts, uplift again.
FROM_REST = [(1.2, 3.0, 0.4), (2.0, 4.0, 0.3), (1.5, 6.0, 0.5), (3.0, 50.0, 0.2), (1.05, 2.0, 0.6)]


@pytest.mark.slow
@every("case", FROM_REST)
def test_from_rest_the_march_follows_fifty_digits_through_chatter(
    case: tuple[float, float, float],
) -> None:
    amplitude, frequency, restitution = case
    piece = Piece(amplitude=amplitude, frequency=frequency, phase=0.25)
    half_cycles = 9
    ran = run(table(piece), both_sides(restitution), half_cycles=half_cycles)
    exact = exact_march(
        exact_segments(piece),
        half_cycles * mp.pi / mp.mpf(frequency),
        restitution=(mp.mpf(restitution),) * 2,
    )
    rests = int((ran.rows[:, ROW_SIDE] == 0.0).sum())
    assert rests > 0
    assert signs_hold(ran.rows)
    # The first uplift, before which the block stands still.
    times = ran.times()
    lifted = [times[i + 1] for i, row in enumerate(ran.rows) if row[ROW_EVENT] == ENDED_BY_UPLIFT]
    assert abs(lifted[0] - exact.uplifts[0]) <= 1e-15 * lifted[0]
    # Between uplifts: the same impacts, as long as the march has not yet said that it ends.
    edges = [*exact.uplifts, mp.mpf(1000)]
    for begin, end in pairwise(edges):
        found = [case for case in ran.impacts() if begin < case[0] <= end]
        truth = [impact for impact in exact.impacts if begin < impact.time <= end]
        assert 0 < len(found) <= len(truth)
        for (time, side, velocity), impact in zip(found, truth, strict=False):
            assert side == impact.side
            assert abs(time - impact.time) <= 1e-13 * impact.time
            if velocity != 0.0:
                assert abs(velocity - impact.velocity) <= 1e-11 * abs(impact.velocity) + 1e-15
    for one, other in zip(lifted, exact.uplifts, strict=False):
        assert abs(one - other) <= 1e-14 * other


def check_lists(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    compared = 0
    for _ in range(count):
        pieces = []
        for _ in range(rng.integers(2, 6)):
            wave = rng.random() < 0.6
            pieces.append(
                Piece(
                    duration=rng.uniform(0.1, 1.5),
                    constant=rng.uniform(-1.0, 1.0) if rng.random() < 0.6 else 0.0,
                    slope=rng.normal(0.0, 1.0) if rng.random() < 0.5 else 0.0,
                    amplitude=rng.uniform(0.2, 3.0) if wave else 0.0,
                    frequency=10.0 ** rng.uniform(-0.5, 1.3) if wave else 0.0,
                    phase=rng.uniform(-10.0, 10.0) if wave else 0.0,
                    jump=rng.normal(0.0, 0.1) if rng.random() < 0.3 else 0.0,
                )
            )
        pieces[0] = Piece(**{**vars(pieces[0]), "jump": 0.0})
        until = sum(piece.duration for piece in pieces)
        restitution = rng.uniform(0.5, 0.95)
        velocity = rng.choice([-1.0, 1.0]) * rng.uniform(0.1, 0.5)
        side = 1 if velocity > 0 else -1
        ran = run(
            table(*pieces),
            both_sides(restitution),
            side=side,
            velocity=velocity,
            until=until,
            rest_velocity=0.0,
            limit=40,
        )
        exact = exact_march(
            exact_segments(*pieces),
            until,
            side=side,
            velocity=velocity,
            restitution=(mp.mpf(restitution),) * 2,
            most_impacts=len(ran.impacts()) + 1,
        )
        assert signs_hold(ran.rows)
        found = ran.impacts()
        counted = sum(abs(after) >= COUNTED for _, _, after in found)
        if ran.rows[-1, ROW_EVENT] == ENDED_BY_IMPACT:
            counted += abs(ran.end.velocity) >= COUNTED
        assert ran.end.impacts == counted
        assert len(exact.impacts) >= len(found)
        for (time, at, after), truth in zip(found, exact.impacts, strict=False):
            assert at == truth.side
            # Rounded durations of earlier segments shift all that follows.
            assert abs(time - truth.time) <= 2e-13 * (1 + truth.time) * (1 + 1 / abs(after))
            compared += 1
    assert compared > 2 * count


@pytest.mark.slow
def test_a_random_list_of_segments_follows_fifty_digits() -> None:
    check_lists(7, sample_size(40, 10))


def test_a_few_lists_of_segments_follow_fifty_digits() -> None:
    check_lists(17, 4)
