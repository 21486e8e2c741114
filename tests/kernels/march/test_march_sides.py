"""Blocks whose sides differ, against an integrated differential equation and 50 digits."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.tables import ROW_DURATION, ROW_EVENT, ROW_SIDE, ROW_VELOCITY
from tests.every import every
from tests.kernels.tables import (
    Piece,
    both_sides,
    exact_segments,
    harmonic,
    run,
    table,
)
from tests.oracles import exact_march, integrated_impacts, mp

TWO_PI = 2.0 * math.pi


# ------------------------------------------------------------------ unlike sides: an ODE oracle

LOPSIDED = [
    ((0.7, 0.9), (1.0, 0.6), (1.0, 1.0)),
    ((0.5, 0.8), (1.0, 1.1), (0.9, 1.4)),
    ((0.9, 0.6), (0.8, 1.3), (1.2, 0.9)),
]


@every(("restitution", "lean", "rate"), LOPSIDED)
@every("side", [1, -1])
def test_unlike_sides_against_an_integrator(
    side: int,
    restitution: tuple[float, float],
    lean: tuple[float, float],
    rate: tuple[float, float],
) -> None:
    for piece in (
        Piece(amplitude=1.6, frequency=5.0, phase=0.5),
        Piece(8.0, constant=0.1, slope=-0.05, amplitude=1.2, frequency=4.0, phase=2.0),
    ):
        truth = integrated_impacts(
            piece.base,
            6.0,
            side=side,
            velocity=0.3 * side,
            restitution=restitution,
            lean=lean,
            rate=rate,
            longest_step=0.05,
        )
        until = 6.0 if math.isinf(piece.duration) else 8.0
        ran = run(
            table(piece),
            both_sides(restitution, lean, rate),
            side=side,
            velocity=0.3 * side,
            until=until,
            rest_velocity=0.0,
            limit=len(truth) + 1,
        )
        found = ran.impacts()
        assert len(truth) > 1
        for (time, _, velocity), (at, after) in zip(found[: len(truth)], truth, strict=True):
            if abs(after) < 1e-3:  # from here on the integrator loses the short bounces
                break
            assert float(time) == pytest.approx(at, abs=2e-9)
            assert velocity == pytest.approx(after, abs=2e-8)


@every(("restitution", "lean", "rate"), LOPSIDED)
def test_unlike_sides_against_fifty_digits(
    restitution: tuple[float, float], lean: tuple[float, float], rate: tuple[float, float]
) -> None:
    piece = Piece(amplitude=1.6, frequency=5.0, phase=0.5)
    ran = run(
        table(piece),
        both_sides(restitution, lean, rate),
        side=-1,
        velocity=-0.3,
        half_cycles=12,
        rest_velocity=0.0,
        limit=30,
    )
    exact = exact_march(
        exact_segments(piece),
        12 * mp.pi / 5,
        side=-1,
        velocity=-0.3,
        restitution=(mp.mpf(restitution[0]), mp.mpf(restitution[1])),
        lean=(mp.mpf(lean[0]), mp.mpf(lean[1])),
        rate=(mp.mpf(rate[0]), mp.mpf(rate[1])),
        most_impacts=ran.end.impacts,
    )
    found = ran.impacts()
    assert len(found) > 1
    for (time, side, _), truth in zip(found, exact.impacts, strict=False):
        assert side == truth.side
        assert abs(time - truth.time) <= 1e-13 * truth.time


@pytest.mark.parametrize("start", ["flight", "rest"])
def test_a_block_told_in_other_units_moves_the_same(start: str) -> None:
    # Twice the reference slenderness and 1.5 times the reference p on both sides.
    side, velocity = (1, 0.3) if start == "flight" else (0, 0.0)
    limits = {"half_cycles": 60}
    plain = run(harmonic(2.0, 4.0, 0.5), both_sides(0.6), side=side, velocity=velocity, **limits)
    scaled = run(
        harmonic(4.0, 6.0, 0.5),
        both_sides(0.6, (2.0, 2.0), (1.5, 1.5)),
        side=side,
        velocity=3.0 * velocity,
        **limits,
    )
    assert scaled.status == plain.status
    assert np.array_equal(scaled.rows[:, ROW_SIDE], plain.rows[:, ROW_SIDE])
    assert np.array_equal(scaled.rows[:, ROW_EVENT], plain.rows[:, ROW_EVENT])
    for one, other in zip(scaled.phases(), plain.phases(), strict=True):
        assert abs(one - other) <= 1e-13 * (1 + other)
    assert np.allclose(
        scaled.rows[:, ROW_VELOCITY], 3.0 * plain.rows[:, ROW_VELOCITY], rtol=1e-11, atol=1e-16
    )
    assert np.allclose(
        scaled.rows[:, ROW_DURATION], plain.rows[:, ROW_DURATION] / 1.5, rtol=1e-11, atol=1e-16
    )
