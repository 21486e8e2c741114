"""Impacts that barely happen, or barely do not, against dense sampling of the free flight."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from rocksteady import Block, Harmonic, State, simulate

Floats = NDArray[np.float64]


@pytest.mark.parametrize(
    ("alpha", "amplitude", "ratio", "angle"),
    [
        (0.1, 3.0, 3.0, 0.3),
        (0.3, 3.0, 3.0, 0.2),
        (0.5, 4.0, 4.0, 0.2),
        (0.8, 5.0, 3.0, 0.3),
        (0.2, 6.0, 6.0, 0.1),
    ],
)
def test_grazes_are_neither_missed_nor_made_up(
    alpha: float, amplitude: float, ratio: float, angle: float
) -> None:
    phase = math.pi  # pushed back first, then away
    span = 1.9 * math.pi / ratio

    def dip(velocity: float) -> tuple[float, float]:
        """Lowest angle of the flight on one side, as if there were no floor, and its time."""

        def motion(s: float, y: Floats) -> list[float]:
            tilt = alpha * (1.0 - y[0])
            h = amplitude * math.sin(ratio * s + phase)
            return [y[1], h * math.cos(tilt) - math.sin(tilt) / alpha]

        run = solve_ivp(
            motion,
            (0.0, span),
            [angle, velocity],
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
            dense_output=True,
            max_step=0.02 * span,
        )
        assert run.sol is not None
        course = run.sol
        s = np.linspace(0.0, span, 4001)
        near = float(s[np.argmin(course(s)[0])])
        found = minimize_scalar(
            lambda t: float(course(t)[0]),
            bounds=(near - 1e-3 * span, near + 1e-3 * span),
            method="bounded",
            options={"xatol": 1e-10},
        )
        return float(found.fun), float(found.x)

    touching = brentq(lambda v: dip(v)[0], -1.5, 3.0, xtol=1e-12)
    _, when = dip(touching)
    assert 0.05 * span < when < 0.95 * span
    block = Block.from_p(alpha=alpha, p=1.0, restitution=0.9)
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)
    for off in (1e-3, 1e-6, 1e-9, 1e-10):
        for sign, lands in ((-1.0, True), (1.0, False)):
            start = State(angle=angle, velocity=touching + sign * off)
            run = simulate(block, shaking, start=start, cycles=2, model="nonlinear")
            early = run.impacts.s[run.impacts.s < span]
            first = float(early[0]) if len(early) else math.inf
            assert (first <= when) is lands
            if lands:
                assert first == pytest.approx(when, abs=10.0 * math.sqrt(off))
