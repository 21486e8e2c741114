"""The full equations by an adaptive integrator with events, in seconds and radians."""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rocksteady import Block, Harmonic, Pulse, Record, State, Status, simulate
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.segments import Motion

Ground = Callable[[float], float]
Floats = NDArray[np.float64]


def still(_t: float) -> float:
    return 0.0


def impacts_by_integrator(
    horizontal: Ground,
    *,
    block: Block,
    angle: float,
    velocity: float,
    breaks: Sequence[float],
    vertical: Ground = still,
    longest_step: float,
    count: int,
    jumps: Mapping[float, float] | None = None,
) -> list[float]:
    """Return the times of the first impacts [s] up to the last break.

    `horizontal` and `vertical` are base accelerations over g, smooth between neighbouring breaks;
    angle [rad] and velocity [rad/s] are not both zero.  `jumps` are sudden changes of the base's
    velocity over g [s] at breaks.
    """
    side = math.copysign(1.0, angle if angle != 0.0 else velocity)
    state = [angle, velocity]
    found: list[float] = []
    for begin, end in pairwise(breaks):
        now = begin
        own = block.positive if side > 0.0 else block.negative
        push = 0.0 if jumps is None else jumps.get(begin, 0.0)
        state[1] += own.p**2 * push * math.cos(own.alpha - side * state[0])
        while now < end:
            own = block.positive if side > 0.0 else block.negative
            alpha, p = own.alpha, own.p

            def motion(
                t: float, y: np.ndarray, side: float = side, alpha: float = alpha, p: float = p
            ) -> list[float]:
                tilt = alpha - side * y[0]
                pull = -side * (1.0 + vertical(t)) * math.sin(tilt)
                return [y[1], p * p * (pull + horizontal(t) * math.cos(tilt))]

            def landing(_t: float, y: np.ndarray) -> float:
                return float(y[0])

            landing.terminal = True  # type: ignore[attr-defined]
            landing.direction = -side  # type: ignore[attr-defined]
            run = solve_ivp(
                motion,
                (now, end),
                state,
                method="DOP853",
                rtol=1e-12,
                atol=1e-15,
                events=landing,
                max_step=longest_step,
            )
            now = float(run.t[-1])
            state = [float(run.y[0, -1]), float(run.y[1, -1])]
            if run.status == 1:
                found.append(now)
                if len(found) == count:
                    return found
                state = [0.0, own.restitution * state[1]]
                side = -side
    return found


def full(block: Block, motion: Motion | Record | BaseMotion, **given: object) -> Trajectory:
    """Return the run of the nonlinear model."""
    return simulate(block, motion, **{"model": Nonlinear(), **given})  # type: ignore[arg-type]


def same_impacts(run: Trajectory, expected: list[float]) -> None:
    """Hold a run's first impacts to those of the integrator [s], of which there are some."""
    assert isinstance(run.block, Block)
    assert len(expected) > 1 or run.status is Status.OVERTURNED
    assert len(run.impacts) >= len(expected) > 0
    found = run.impacts.pt[: len(expected)] / run.block.p
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9)


def pulse_ground(pulse: Pulse, block: Block) -> tuple[Ground, tuple[float, ...]]:
    """Return the base acceleration over g of a pulse, and the times of its breaks [s]."""
    segments = pulse.segments()
    ends = np.concatenate([[0.0], np.cumsum([segment.duration for segment in segments])])

    def ground(t: float) -> float:
        s = t * block.p
        k = int(np.searchsorted(ends, s, side="right")) - 1
        if k >= len(segments):
            return 0.0
        part, since = segments[k], s - ends[k]
        wave = part.amplitude * math.sin(part.frequency * since + part.phase)
        return float(block.alpha * (part.constant + part.slope * since + wave))

    # A break belongs to the segment that ends at it, too: step a little aside of it.
    last = ends[-1] / block.p * (1.0 + 1e-15)
    return ground, (*(ends[:-1] / block.p).tolist(), float(last))


def agree_on_harmonic(block: Block, state: State, shaking: Harmonic) -> None:
    """Assert that the first impacts under harmonic shaking are the integrator's."""
    a, w, phase = shaking.amplitude, shaking.frequency_ratio, shaking.phase
    expected = impacts_by_integrator(
        lambda t: a * block.alpha * math.sin(w * block.p * t + phase),
        block=block,
        angle=state.angle * block.alpha,
        velocity=state.velocity * block.alpha * block.p,
        breaks=(0.0, 6.0 / block.p),
        longest_step=0.02 / block.p,
        count=8,
    )
    same_impacts(full(block, shaking, start=state), expected)


def agree_on_pulse(block: Block, state: State, pulse: Pulse) -> None:
    """Assert that the first impacts under a pulse are the integrator's."""
    ground, breaks = pulse_ground(pulse, block)
    expected = impacts_by_integrator(
        ground,
        block=block,
        angle=state.angle * block.alpha,
        velocity=state.velocity * block.alpha * block.p,
        breaks=(*breaks, 8.0 / block.p),
        longest_step=0.02 / block.p,
        count=6,
    )
    same_impacts(full(block, pulse, start=state), expected)


def agree_on_samples(
    block: Block, state: State, flat: Floats, up: Floats | None, dt: float
) -> None:
    """Assert that the first impacts on samples [m/s^2], vertical ones too, are the integrator's."""
    times = dt * np.arange(len(flat))
    g = block.gravity
    expected = impacts_by_integrator(
        lambda t: float(np.interp(t, times, flat / g)),
        vertical=still if up is None else lambda t: float(np.interp(t, times, up / g)),
        block=block,
        angle=state.angle * block.alpha,
        velocity=state.velocity * block.alpha * block.p,
        breaks=tuple(times),
        longest_step=0.01,
        count=6,
    )
    record = Record(acceleration_m_s2=flat, dt_s=dt)
    vertical = None if up is None else Record(acceleration_m_s2=up, dt_s=dt)
    same_impacts(full(block, BaseMotion(record, vertical), start=state), expected)
