"""The full equations by an adaptive integrator with events, in seconds and radians."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853
from scipy.optimize import brentq

from rocksteady import Block, Harmonic, Pulse, Record, State, Status, simulate
from rocksteady.formulas import Side
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.segments import Motion

Ground = Callable[[float], float]
Floats = NDArray[np.float64]


def still(_t: float) -> float:
    return 0.0


@dataclass
class Whole:
    """A motion as far as it was followed, in seconds and radians."""

    impacts: list[float] = field(default_factory=list)
    peak: float = 0.0
    """Largest |theta| over the slenderness of the side."""
    falls: bool = False
    crossing: float | None = None
    """Last upward crossing of the slenderness in the last flight."""
    rests: bool = False
    side: float = 1.0
    state: tuple[float, float] = (0.0, 0.0)


@dataclass
class _Rocking:
    """A block on its way: what was seen of it, and the integrator of its present flight."""

    horizontal: Ground
    vertical: Ground
    sides: tuple[Side, Side | None]
    longest: float
    slowest: float
    seen: Whole
    solver: Any = None

    @property
    def own(self) -> Side:
        """The side on which it rocks."""
        right, left = self.sides
        return right if self.seen.side > 0.0 or left is None else left

    def lift(self, t: float) -> float:
        """Return what the base acceleration has beyond uplift, on the side where it is more."""
        right, left = self.sides
        a, weight = self.horizontal(t), 1.0 + self.vertical(t)
        beyond = a - weight * math.tan(right.alpha)
        return beyond if left is None else max(beyond, -a - weight * math.tan(left.alpha))

    def flight(self, t: float, end: float) -> Any:
        """Return an integrator of a flight from the state of a moment on."""
        s, alpha, p = self.seen.side, self.own.alpha, self.own.p

        def motion(t: float, y: Floats) -> Any:
            tilt = alpha - s * y[0]
            pull = -s * (1.0 + self.vertical(t)) * math.sin(tilt)
            return [y[1], p * p * (pull + self.horizontal(t) * math.cos(tilt))]

        first = min(self.longest, end - t, 0.05 / p)
        state: Any = self.seen.state
        if state[0] == 0.0:  # bounces may be short
            first = min(first, max(0.1 * abs(state[1]) / p**2, 1e-10 / p))
        how: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-15, "max_step": self.longest}
        return DOP853(motion, t, state, end, first_step=first, **how)

    def go_to(self, start: float, near: float, angle: float) -> float:
        """Step again, to where the angle is passed near a moment; return when."""
        again = self.flight(start, near)
        again.h_abs = near - start
        while again.status == "running":
            again.step()
        rate = again.fun(again.t, again.y)
        late = (angle - again.y[0]) / rate[0]
        self.seen.state = (angle, float(again.y[1] + late * rate[1]))
        return float(near + late)

    def kick(self, push: float) -> None:
        """Change the velocity of the base over g [s] suddenly."""
        seen = self.seen
        if seen.rests:
            seen.side, seen.rests = math.copysign(1.0, push), False
        gain = self.own.p**2 * push * math.cos(self.own.alpha - seen.side * seen.state[0])
        seen.state, self.solver = (seen.state[0], seen.state[1] + gain), None

    def wait(self, now: float, end: float) -> float:
        """Return when a block at rest lifts, at the end if it does not."""
        if max(self.lift(now), self.lift(end)) <= 0.0:
            return end
        if self.lift(now) <= 0.0:
            now = float(brentq(self.lift, now, end, xtol=1e-14))
        self.seen.side = 1.0 if self.sides[1] is None else math.copysign(1.0, self.horizontal(now))
        self.seen.state, self.seen.rests = (0.0, 0.0), False
        return now

    def landing(self, start: float) -> float:
        """Return when the last step lands, nan if it does not; see the top of its flight."""
        s, solver, path = self.seen.side, self.solver, self.solver.dense_output()
        first, last = s * self.seen.state[1], s * solver.y[1]
        off = start if s * self.seen.state[0] > 0.0 else math.nan
        landed = float(solver.t)
        if first * last < 0.0:
            turn = float(brentq(lambda t: path(t)[1], start, solver.t, xtol=1e-14))
            if first > 0.0:  # the top of a flight
                self.seen.peak = max(self.seen.peak, s * path(turn)[0] / self.own.alpha)
                off = turn
            else:  # its bottom
                landed = turn
        if s * path(landed)[0] > 0.0 or math.isnan(off):
            return math.nan
        return float(brentq(lambda t: path(t)[0], off, landed, xtol=1e-14))

    def land(self, start: float, near: float) -> float:
        """Impact; return when."""
        seen, own = self.seen, self.own
        now = self.go_to(start, near, 0.0)
        speed = own.restitution * seen.state[1]
        seen.side, speed = (1.0, -speed) if self.sides[1] is None else (-seen.side, speed)
        seen.impacts.append(now)
        seen.state, seen.crossing, self.solver = (0.0, speed), None, None
        if abs(speed) < self.slowest * own.alpha * own.p and self.lift(now) <= 0.0:
            seen.state, seen.rests = (0.0, 0.0), True
        return now

    def step(self, now: float, end: float) -> float:
        """Take a step of a flight, to its impact at most; return the time at its end."""
        seen, s, alpha = self.seen, self.seen.side, self.own.alpha
        if self.solver is None:
            self.solver = self.flight(now, end)
        self.solver.step()
        assert self.solver.status != "failed"
        last = (float(self.solver.y[0]), float(self.solver.y[1]))
        if min(s * last[0], seen.state[1] * last[1]) <= 0.0:
            landing = self.landing(now)
            if not math.isnan(landing):
                return self.land(now, landing)
            if s * last[0] <= 0.0:  # it did not lift
                seen.state, seen.rests = (0.0, 0.0), True
                now, self.solver = self.solver.t, None
                return now
        if s * seen.state[0] < alpha <= s * last[0]:
            path = self.solver.dense_output()
            near = brentq(lambda t: s * path(t)[0] - alpha, now, self.solver.t)
            seen.crossing = self.go_to(now, near, s * alpha)
        seen.state, seen.peak = last, max(seen.peak, s * last[0] / alpha)
        seen.falls = s * last[0] >= 0.5 * math.pi
        return float(self.solver.t)


def follow(
    horizontal: Ground,
    *,
    sides: tuple[Side, Side | None],
    breaks: Sequence[float],
    longest_step: float,
    angle: float = 0.0,
    velocity: float = 0.0,
    vertical: Ground = still,
    jumps: Mapping[float, float] | None = None,
    count: int | None = None,
    slowest: float = 1e-7,
) -> Whole:
    """Follow a block by DOP853 until it falls (|theta| = pi/2) or the last break has come.

    `horizontal` and `vertical` are base accelerations over g, smooth and, while it rests, monotone
    between neighbouring breaks.  The negative side is None against a wall.  `jumps` are sudden
    changes of the base's velocity over g [s] at breaks.  Below uplift a bounce slower than
    `slowest` alpha p is rest.  It ends after `count` impacts, too.
    """
    seen = Whole(side=math.copysign(1.0, angle if angle != 0.0 else velocity))
    seen.state, seen.rests = (angle, velocity), angle == velocity == 0.0
    block = _Rocking(horizontal, vertical, sides, longest_step, slowest, seen)
    for begin, end in pairwise(breaks):
        now = begin
        if jumps is not None and begin in jumps:
            block.kick(jumps[begin])
        if block.solver is not None:
            block.solver.t_bound, block.solver.status = end, "running"
            block.solver.f = block.solver.fun(now, block.solver.y)
        while now < end:
            now = block.wait(now, end) if seen.rests else block.step(now, end)
            if seen.falls or len(seen.impacts) == count:
                return seen
    return seen


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
    """Return the times of the first impacts [s] up to the last break, as `follow` finds them."""
    seen = follow(
        horizontal,
        sides=(block.positive, block.negative),
        breaks=breaks,
        longest_step=longest_step,
        angle=angle,
        velocity=velocity,
        vertical=vertical,
        jumps=jumps,
        count=count,
        slowest=0.0,
    )
    return seen.impacts


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
