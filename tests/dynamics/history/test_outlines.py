"""Tops and clearances of bodies with mass centres anywhere, against corners of another integrator.

The oracle knows a rigid body's torque about its pivot, and the corners as turned points.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady import Block, Nonlinear, Pulse, State, Status, simulate
from rocksteady.formulas import Outline

G = 9.80665
KEPT = 0.8, 0.75
"""Restitutions of both impacts."""
SPAN = 3.0
"""Of the oracle [s]."""
SLOWEST = 0.01
"""Velocity after an impact [rad/s] from which on it leans less: the base alone lifts no edge."""


def body_of(seed: int) -> tuple[Block, dict[str, Any]]:
    """Return a body with its mass centre anywhere, and its sizes."""
    rng = np.random.default_rng([8801, seed])
    left, right = rng.uniform(0.2, 0.4, 2).tolist()
    height = rng.uniform(1.2, 3.0)
    sizes = {
        "left": left,
        "right": right,
        "height": height,
        "mass_centre_height": height * rng.uniform(0.25, 0.95),
        "gyration": height * rng.uniform(0.25, 0.5),
    }
    beyond = (rng.uniform(0.0, 0.3, 2) * (seed % 2)).tolist()
    outline = Outline(height=height, left_overhang=beyond[0], right_overhang=beyond[1])
    block = replace(Block.asymmetric(**sizes, restitution=KEPT), outline=outline)
    return block, {**sizes, "beyond": beyond}


def turns(_t: float, state: np.ndarray) -> float:
    """Return the velocity, which is 0 where the body leans furthest."""
    return float(state[1])


def angles_of(sizes: dict[str, Any], peak: float, hertz: float, tilt: float) -> list[float]:
    """Return the rotations [rad] at which a body under one sine turns round, let go from a tilt."""
    t, y, w, side = 0.0, tilt, 0.0, math.copysign(1.0, tilt)
    found = [tilt]
    while t < SPAN and (w == 0.0 or abs(w) > SLOWEST):
        arm = complex(sizes["left"] if side > 0.0 else -sizes["right"], sizes["mass_centre_height"])
        inertia = sizes["gyration"] ** 2 + abs(arm) ** 2
        shaken = t < 1.0 / hertz

        def rates(at: float, state: np.ndarray) -> tuple[float, float]:
            place = arm * np.exp(1j * state[0])  # noqa: B023 -- of this flight
            base = peak * math.sin(2.0 * math.pi * hertz * at) if shaken else 0.0  # noqa: B023
            return float(state[1]), (base * place.imag - G * place.real) / inertia  # noqa: B023

        def landing(_t: float, state: np.ndarray) -> float:
            return side * float(state[0])  # noqa: B023

        landing.terminal, landing.direction = True, -1  # type: ignore[attr-defined]
        flight = solve_ivp(
            rates, (t, 1.0 / hertz if shaken else SPAN), (y, w), method="DOP853", rtol=1e-13,
            atol=1e-15, events=(landing, turns),
        )  # fmt: skip
        assert flight.y_events is not None
        found += [float(state[0]) for state in flight.y_events[1]]
        t, (y, w) = float(flight.t[-1]), flight.y[:, -1]
        if flight.status == 1:
            y, w, side = 0.0, KEPT[0 if side > 0.0 else 1] * w, -side
    return found


def motions_of(sizes: dict[str, Any], angles: list[float]) -> tuple[float, float, float]:
    """Return gaps on the left and right and motion of the top [m], by turned corners."""
    width = sizes["left"] + sizes["right"]
    ends = np.array([-sizes["beyond"][0], width + sizes["beyond"][1]])
    corners = np.concatenate([ends, ends + 1j * sizes["height"]])
    gaps, top = [0.0, 0.0], 0.0
    for angle in angles:
        pivot = 0.0 if angle > 0.0 else width
        places = (pivot + (corners - pivot) * np.exp(1j * angle)).real
        gaps = [max(gaps[0], ends[0] - places.min()), max(gaps[1], places.max() - ends[1])]
        top = max(top, np.abs(places[2:] - ends).max())
    return gaps[0], gaps[1], top


@pytest.mark.parametrize("seed", range(50))
def test_the_corners_of_a_body_with_its_mass_centre_anywhere(seed: int) -> None:
    block, sizes = body_of(seed)
    weaker = min(block.positive.alpha, block.negative.alpha)
    tilt = 0.4 * weaker * (-1.0 if seed % 4 < 2 else 1.0)
    peak, hertz = 0.4 * G * math.tan(weaker), 0.8 * block.p
    pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=peak, frequency_hz=hertz)
    start = State(angle=tilt / block.alpha, velocity=0.0)
    run = simulate(block, pulse, start=start, model=Nonlinear(tolerance=1e-13))
    assert run.status is Status.AT_REST
    left, right, top = motions_of(sizes, angles_of(sizes, peak, hertz, tilt))
    assert run.clearances_m == pytest.approx((left, right), rel=1e-9, abs=1e-9)
    assert run.top_displacement_m == pytest.approx(top, rel=1e-9)
    assert block.height == sizes["height"]
