"""The fall to the ground: held against DOP853 in physical units, and against its energy."""

import math
from collections.abc import Callable
from copy import copy
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Record,
    State,
    Status,
    Still,
    simulate,
)
from rocksteady.dynamics.history.fall import fall_to_ground
from rocksteady.histories import Trajectory
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.segments import Motion
from rocksteady.motions import Impulses, Segment

G = 9.80665
SLENDER = Block.rectangle(width=0.3, height=1.5)
STOCKY = Block.rectangle(width=0.8, height=1.4)
UNLIKE = Block.asymmetric(left=0.15, right=0.25, height=1.2)
TIME = np.arange(401) * 0.01
STRONG = Record(acceleration_m_s2=6.0 * np.sin(5.0 * TIME), dt_s=0.01)
UPWARDS = Record(acceleration_m_s2=2.0 * np.cos(9.0 * TIME), dt_s=0.01)


def by_dop853(run: Trajectory, block: Block) -> tuple[Callable[[float], float], float]:
    """Return theta over t, in degrees and seconds, and when it is 90 degrees, of a second method.

    It takes the base as the functions that the motions are, not as the package's segments.
    """
    last = run(run.end_time_pt)
    begin = run.end_time_pt / block.p
    side = math.copysign(1.0, float(last.angle))
    own = block.positive if side > 0.0 else block.negative

    def across(t: float) -> float:
        if isinstance(run.motion, Harmonic):
            w = run.motion.frequency_ratio * block.p
            peak = run.motion.amplitude * block.alpha * G
            return peak * math.sin(w * t + run.motion.phase)
        if isinstance(run.motion, Record):
            return float(np.interp(t, TIME, STRONG.acceleration_m_s2, right=0.0))
        return 0.0

    def up(t: float) -> float:
        vertical = run.vertical is not None
        return float(np.interp(t, TIME, UPWARDS.acceleration_m_s2, right=0.0)) if vertical else 0.0

    def slopes(t: float, state: np.ndarray) -> list[float]:
        lean = own.alpha - side * state[0]
        push = across(t) / G * math.cos(lean) - side * (1.0 + up(t) / G) * math.sin(lean)
        return [state[1], own.p**2 * push]

    def lies(_: float, state: np.ndarray) -> float:
        return abs(float(state[0])) - 0.5 * math.pi

    lies.terminal = True  # type: ignore[attr-defined]
    state = [float(last.angle) * block.alpha, float(last.velocity) * block.alpha * block.p]
    found: Any = solve_ivp(
        slopes, (begin, begin + 20.0), state, method="DOP853", events=lies,
        rtol=1e-11, atol=1e-13, max_step=0.005, dense_output=True,
    )  # fmt: skip
    return lambda t: float(found.sol(t)[0]), float(found.t_events[0][0])


FALLS: dict[str, Callable[[], tuple[Trajectory, Block]]] = {
    "still": lambda: (
        simulate(SLENDER, Still(), start=State(angle=1.3, velocity=0.0)), SLENDER,
    ),
    "to the other side": lambda: (
        simulate(UNLIKE, Still(), start=State(angle=-2.2, velocity=-0.1)), UNLIKE,
    ),
    "harmonic, linear": lambda: (
        simulate(SLENDER, Harmonic(amplitude=3.0, frequency_ratio=2.0), model=Linear()), SLENDER,
    ),
    "harmonic, nonlinear": lambda: (
        simulate(SLENDER, Harmonic(amplitude=3.0, frequency_ratio=2.0), model=Nonlinear()), SLENDER,
    ),
    "record": lambda: (simulate(SLENDER, STRONG), SLENDER),
    "record, linear": lambda: (simulate(SLENDER, STRONG, model=Linear()), SLENDER),
    "vertical too": lambda: (
        simulate(SLENDER, BaseMotion(STRONG, UPWARDS), model=Nonlinear()), SLENDER,
    ),
    "wall": lambda: (
        simulate(SLENDER.against_wall(), STRONG), SLENDER.against_wall(),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FALLS)
def test_a_fall_is_that_of_another_integrator(name: str) -> None:
    run, block = FALLS[name]()
    assert run.status is Status.OVERTURNED
    fall = fall_to_ground(run, block.alpha)
    assert fall is not None
    theta, lies = by_dop853(run, block)
    assert fall.lands_pt / block.p == pytest.approx(lies, abs=1e-6)
    times = np.linspace(run.end_time_pt, fall.lands_pt, 60)
    expected = [theta(t / block.p) for t in times[:-1]]
    np.testing.assert_allclose(fall(times[:-1]), expected, atol=1e-6)
    assert abs(float(fall(fall.lands_pt))) == pytest.approx(0.5 * math.pi)
    assert abs(float(fall(fall.lands_pt + 5.0))) == pytest.approx(0.5 * math.pi), "it lies"
    assert float(fall(run.end_time_pt)) == pytest.approx(
        float(run(run.end_time_pt).angle) * block.alpha
    )


def test_a_fall_on_a_still_base_keeps_its_energy() -> None:
    run = simulate(STOCKY, Still(), start=State(angle=1.2, velocity=0.0))
    fall = fall_to_ground(run, STOCKY.alpha)
    assert fall is not None
    energy = 0.5 * fall.rate**2 + np.cos(STOCKY.alpha - fall.theta)
    np.testing.assert_allclose(energy[:-1], energy[0], rtol=1e-9)
    assert energy[-1] == pytest.approx(energy[0], rel=1e-5), "the rate on landing is between two"


def after_its_end(run: Trajectory, motion: Motion) -> Trajectory:
    """Return a run whose base goes on to do what its history does not know of."""
    assert run.end_time_pt > run.flights.pt[-1]  # both are known from now on
    other = copy(run)
    object.__setattr__(other, "segments", Nonlinear().lower(SLENDER, motion).segments)
    return other


def test_a_blow_to_the_base_during_the_fall_changes_its_rate() -> None:
    """The lever arm of the inertia force is R cos(alpha - theta), at that instant."""
    quiet = simulate(SLENDER, Still(), start=State(angle=1.2, velocity=0.0))
    blow = quiet.end_time_pt + 0.3
    struck = after_its_end(quiet, Impulses(velocities=(0.5,), times=(blow,)))
    alone, fall = (fall_to_ground(run, SLENDER.alpha) for run in (quiet, struck))
    assert alone is not None
    assert fall is not None
    assert struck.end_time_pt == quiet.end_time_pt < blow < fall.lands_pt < alone.lands_pt
    np.testing.assert_allclose(fall(blow), alone(blow), atol=1e-9)
    h = 1e-4
    gained = (fall(blow + h) - fall(blow) - alone(blow + h) + alone(blow)) / h
    lean = SLENDER.alpha - float(alone(blow))
    assert float(gained) == pytest.approx(0.5 * SLENDER.alpha * math.cos(lean), rel=1e-3)


def test_a_block_without_size_falls_as_one_of_the_given_slenderness() -> None:
    bare = DimensionlessBlock(restitution=0.8)
    block = Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
    start = State(angle=1.5, velocity=0.2)
    runs = [simulate(each, Still(), start=start, model=Linear()) for each in (bare, block)]
    one, other = (fall_to_ground(run, 0.3) for run in runs)
    assert one is not None
    assert other is not None
    np.testing.assert_allclose(one.theta, other.theta, rtol=1e-12)


def test_what_lies_already_lies_at_once() -> None:
    run = simulate(SLENDER, Still(), start=State(angle=-1e9, velocity=0.0), model=Linear())
    fall = fall_to_ground(run, SLENDER.alpha)
    assert fall is not None
    assert fall.lands_pt == run.end_time_pt
    assert float(fall(run.end_time_pt)) == -0.5 * math.pi


def test_what_does_not_overturn_has_no_fall() -> None:
    run = simulate(SLENDER, Still(), start=State(angle=0.5, velocity=0.0))
    assert fall_to_ground(run, SLENDER.alpha) is None


def test_a_block_that_is_pushed_back_onto_its_base_has_no_fall() -> None:
    quiet = simulate(SLENDER, Still(), start=State(angle=1.2, velocity=0.0))
    held = Segment(duration=quiet.end_time_pt + 0.1)
    pushed = after_its_end(quiet, Piecewise(pieces=(held, Segment(duration=9.0, constant=-50.0))))
    assert fall_to_ground(pushed, SLENDER.alpha) is None
