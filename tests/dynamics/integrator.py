"""A whole time history by an adaptive integrator with events, in seconds and radians."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady.formulas import Side

Floats = NDArray[np.float64]


@dataclass
class History:
    """Impacts, and the angle at the times asked for, as far as the integration came."""

    impacts: list[float] = field(default_factory=list)
    before: list[float] = field(default_factory=list)
    after: list[float] = field(default_factory=list)
    times: Floats = field(default_factory=lambda: np.empty(0))
    angles: Floats = field(default_factory=lambda: np.empty(0))


def integrate(
    base_g: Callable[[float], float],
    until: float,
    *,
    alpha: float,
    p: float,
    restitution: float,
    angle: float,
    velocity: float,
    longest_step: float,
) -> History:
    """Follow a symmetric block."""
    side = Side(alpha=alpha, radius=1.0, p=p, restitution=restitution)
    return integrate_sides(
        base_g,
        until,
        sides=(side, side),
        angle=angle,
        velocity=velocity,
        longest_step=longest_step,
    )


def integrate_sides(
    base_g: Callable[[float], float],
    until: float,
    *,
    sides: tuple[Side, Side],
    angle: float = 0.0,
    velocity: float,
    longest_step: float,
) -> History:
    """Follow eqs 4 and 5, theta'' = p^2 (theta - side alpha + a/g), between impacts (eq 9).

    Each side has its own alpha, p and restitution.
    """
    history = History()
    side = math.copysign(1.0, angle if angle != 0.0 else velocity)
    now = 0.0
    state = np.array([angle, velocity])
    times, angles = [], []

    def landing(_t: float, state: Floats) -> float:
        return float(state[0])

    landing.terminal = True  # type: ignore[attr-defined]
    landing.direction = 0.0  # type: ignore[attr-defined]
    while now < until:
        own = sides[0] if side > 0.0 else sides[1]
        p, restitution = own.p, own.restitution

        def motion(
            t: float, state: Floats, edge: float = side * own.alpha, p: float = p
        ) -> list[float]:
            return [state[1], p * p * (state[0] - edge + base_g(t))]

        start = now
        if state[0] == 0.0:
            # Leave the zero by Taylor's series of order 4: the event would find it again.
            tiny = 1e-4 / p
            a0 = p * p * (-side * own.alpha + base_g(now))
            slope = (base_g(now + tiny) - base_g(now - tiny)) / (2.0 * tiny)
            a1 = p * p * (state[1] + slope)
            v = state[1]
            state = np.array(
                [
                    tiny * (v + tiny * (a0 / 2.0 + tiny * a1 / 6.0)),
                    v + tiny * (a0 + tiny * a1 / 2.0),
                ]
            )
            start = now + tiny
        run = solve_ivp(
            motion,
            (start, until),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
            events=landing,
            max_step=longest_step,
        )
        times.append(run.t)
        angles.append(run.y[0])
        assert run.t_events is not None
        assert run.y_events is not None
        if len(run.t_events[0]) == 0:
            break
        now = float(run.t_events[0][0])
        arrival = float(run.y_events[0][0][1])
        history.impacts.append(now)
        history.before.append(arrival)
        history.after.append(restitution * arrival)
        state = np.array([0.0, restitution * arrival])
        side = -side
    history.times, history.angles = np.concatenate(times), np.concatenate(angles)
    return history
