"""What a tolerance promises: errors of impacts on records, sinusoids and pulses, by 256 bits."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    DURATION,
    LEFT_OUT,
    LIFT,
    NONLINEAR_SIDE_COLUMNS,
    UNDECIDED,
)
from rocksteady.model.nonlinear_tables import SHARE_OF_TOLERANCE, lifted_table
from tests.every import every
from tests.kernels.nonlinear.balls import BITS, Base, horner, natural_step, seen
from tests.kernels.tables import Piece, both_sides, one_by_one, run, sampled, table
from tests.records import synthetic
from tests.strategies import PLAIN

pytestmark = pytest.mark.skipif(PLAIN, reason="takes minutes uncompiled")

Floats = NDArray[np.float64]
Impact = tuple[Any, Any]  # time and velocity after it

ORDER = 26
FEWEST, MOST = 3, 12


def flown(base: Base, angle: Any, velocity: Any, span: float) -> tuple[bool, Any, Any, Any]:
    """Return whether a flight lands within a span, when it ends, and y and y' there."""
    time, end = arb(0), arb(span)
    while time < end:
        length = min(0.25 * natural_step(base, velocity), float(end - time) + 1e-300)
        tau = min(arb(length), end - time) if math.isfinite(span) else arb(length)
        powers = [power.mid() for power in base.coefficients(time, angle, velocity, ORDER)]
        rates = [n * power for n, power in enumerate(powers)][1:]
        curve = Polynomial([float(power) for power in powers])
        at = np.linspace(0.0, float(tau), 60)[1:]
        below = np.flatnonzero(curve(at) < 0.0)
        if len(below):
            landing = arb(float(at[below[0]]))
            for _ in range(8):
                landing = (landing - horner(powers, landing) / horner(rates, landing)).mid()
            return True, time + landing, arb(0), horner(rates, landing).mid()
        angle, velocity = horner(powers, tau).mid(), horner(rates, tau).mid()
        time = (time + tau).mid()
        if time > 50:
            break
    return False, time, angle, velocity


def exact_impacts(segments: Floats, sides: Floats, velocity: float, nudge: float) -> list[Impact]:
    """Return the first impacts of a block thrown off, the base motion scaled by 1 + nudge."""
    before = ctx.prec
    ctx.prec = BITS
    try:
        factor = arb(1) + arb(nudge)
        side, angle, speed, impacts, start = 1, arb(0), arb(velocity), [], arb(0)
        for row in segments:
            base = Base(
                arb(0),
                arb(float(row[2])) * factor,
                arb(float(row[3])) * factor,
                arb(float(row[4])) * factor,
                arb(float(row[6])),
                arb(float(row[5])),
                arb(float(row[LIFT])),
                arb(float(row[LIFT + 1])),
            )
            elapsed = arb(0)
            while elapsed < float(row[DURATION]):
                own = sides[0 if side > 0 else 1]
                unit = arb(float(own[1])) * float(own[2])
                there = seen(base, own, side, elapsed)
                left = float(arb(float(row[DURATION])) - elapsed) * float(own[2])
                lands, after, y, v = flown(
                    there, side * angle / float(own[1]), side * speed / unit, left
                )
                elapsed = (elapsed + after / float(own[2])).mid() if lands else arb(math.inf)
                angle, speed = side * y * float(own[1]), side * v * unit
                if lands:
                    angle, speed = arb(0), speed * float(own[0])
                    impacts.append((start + elapsed, speed))
                    side = -side
                    if len(impacts) == MOST or abs(float(speed)) < 0.02:
                        return impacts
                elif not math.isfinite(row[DURATION]):
                    return impacts
            start = start + arb(float(row[DURATION]))
        return impacts
    finally:
        ctx.prec = before


def drawn_motion(kind: str, rng: np.random.Generator) -> Floats:
    if kind == "harmonic":
        piece = Piece(
            amplitude=rng.uniform(0.3, 1.8),
            frequency=rng.uniform(2.0, 9.0),
            phase=rng.uniform(0, 6),
        )
        return lifted_table(table(piece))
    if kind == "pulse":
        frequency = rng.uniform(1.5, 5.0)
        piece = Piece(
            2.0 * math.pi / frequency, amplitude=rng.uniform(0.5, 1.6), frequency=frequency
        )
        return lifted_table(table(piece, replace(piece, amplitude=0.4), Piece()))
    step = rng.uniform(0.01, 0.12)
    flat = sampled(synthetic(rng, 150, 0.02, rng.uniform(0.8, 2.0)), step)
    if kind == "record":
        return lifted_table(flat)
    return lifted_table(flat, sampled(synthetic(rng, 120, 0.02, 0.5), 0.9 * step))


@pytest.mark.slow
@every(
    ("kind", "seed"),
    [("harmonic", 0), ("pulse", 1), ("record", 2), ("lifted record", 1)],
)
def test_errors_of_impacts_stay_within_the_tolerance(kind: str, seed: int) -> None:
    rng = np.random.default_rng([seed, len(kind)])
    alpha = [0.02, 0.25, 0.9][seed] * rng.uniform(0.8, 1.2)
    sides = np.zeros((2, NONLINEAR_SIDE_COLUMNS))
    sides[:, :3] = both_sides((0.9, 0.85), (1.0, rng.uniform(0.8, 1.2)), (1.0, 1.05))
    sides[:, 3] = alpha, alpha * sides[1, 1]
    while True:
        segments, velocity = drawn_motion(kind, rng), rng.uniform(0.2, 0.6)
        truth = exact_impacts(segments, sides, velocity, 0.0)
        if len(truth) >= FEWEST:
            break
    # What a relative change of the base motion makes of them: errors grow as it does.
    nudge = 1e-25
    moved = exact_impacts(segments, sides, velocity, nudge)
    growth = [
        max(abs(float(a - b)) for a, b in zip(one, other, strict=True)) / nudge
        for one, other in zip(moved, truth, strict=True)
    ]
    worst = np.maximum.accumulate(growth) + 1.0
    compared = 0
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13):
        sides[:, LEFT_OUT] = SHARE_OF_TOLERANCE * tolerance
        for own in (segments, one_by_one(segments)):
            ran = run(own, sides, side=1, velocity=velocity, rest_velocity=0.0, limit=3000)
            impacts = [(arb(str(time)), speed) for time, _, speed in ran.impacts()]
            assert len(impacts) >= len(truth) or ran.status == UNDECIDED
            for (time, speed), (exact, after), swell in zip(impacts, truth, worst, strict=False):
                error = max(abs(float(time - exact)), abs(speed - float(after)))
                assert error <= (tolerance + 1e-15) * swell
                compared += 1
    assert compared >= 12 * FEWEST
