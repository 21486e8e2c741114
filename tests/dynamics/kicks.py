"""What becomes of a small kick to an orbit, and how near the orbit comes to grazing."""

import math
from itertools import islice

import numpy as np

from rocksteady.histories import ImpactState
from rocksteady.orbits import Orbit, ReturnMap

KICK = 1e-4
DIRECTIONS = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (-0.7, 0.7)]


def apart(one: ImpactState | None, other: ImpactState) -> float:
    """Return how far apart two states are, in radians or relative speed; infinite where unlike."""
    if one is None or one.side != other.side:
        return math.inf
    turn = abs(one.phase - other.phase)
    turn = min(turn, 2.0 * math.pi - turn)
    return max(turn, abs(one.speed - other.speed) / max(other.speed, 1e-3))


def around(orbit: Orbit) -> ReturnMap:
    return ReturnMap(orbit.block, orbit.motion)


def clearance(orbit: Orbit) -> float:
    """Return the least impact speed of an orbit and depth that its flights keep from the floor."""
    a, w = orbit.motion.amplitude, orbit.motion.frequency_ratio
    beta, returns = a / (1.0 + w * w), around(orbit)
    least = math.inf
    for state in orbit.states:
        step = returns(state)
        least = min(least, step.landing_speed, state.speed)
        phase = state.phase + (math.pi if state.side < 0 else 0.0)
        s = np.linspace(0.0, step.time, 2000)
        y = (
            (state.speed + beta * w * math.cos(phase)) * np.sinh(s)
            + (beta * math.sin(phase) - 1.0) * np.cosh(s)
            + 1.0
            - beta * np.sin(w * s + phase)
        )
        dips = y[1:-1][(y[1:-1] < y[:-2]) & (y[1:-1] <= y[2:])]
        least = min(least, dips.min(initial=math.inf))
    return least


def departures(orbit: Orbit, direction: tuple[float, float]) -> list[float]:
    """Return how far a kicked motion is from the orbit each time the orbit is round.

    For as long as the multipliers ask for to grow or shrink ten thousandfold, or until the motion
    has left.
    """
    first, returns = orbit.states[0], around(orbit)
    state: ImpactState | None = ImpactState(
        side=first.side,
        phase=first.phase + KICK * direction[0],
        speed=first.speed * (1.0 + KICK * direction[1]),
    )
    rate = abs(math.log(orbit.largest_multiplier)) if orbit.largest_multiplier > 0.0 else math.inf
    found: list[float] = []
    for _ in range(math.ceil(math.log(1e4) / rate) + 3):
        assert state is not None
        state = returns(state, len(orbit.states)).state
        found.append(apart(state, first))
        if found[-1] > 100.0 * KICK:
            break
    return found


def keeps(orbit: Orbit) -> bool:
    """Return whether the orbit gets every kicked motion back."""
    return all(departures(orbit, direction)[-1] < 0.1 * KICK for direction in DIRECTIONS)


def loses(orbit: Orbit) -> bool:
    """Return whether every kicked motion leaves the orbit.

    A direction may happen to be the stable one; these are not.
    """
    return all(max(departures(orbit, direction)) > 30.0 * KICK for direction in DIRECTIONS)


def follow(orbit: Orbit) -> list[ImpactState | None]:
    """Return the states that follow each of an orbit's states, by the map alone."""
    returns = around(orbit)
    return [next(islice(returns.passages(state), 1)).state for state in orbit.states]
