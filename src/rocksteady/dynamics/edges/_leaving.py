"""Motions that leave a saddle along its unstable direction, labelled by when they leave it.

A manifold at a phase of the shaking is one curve for each point of the saddle there and each sign:
the states that motions have reached which were at a small distance from the saddle a time before.
The label p of a point is that time in periods of the saddle, up to a constant, so that the map
over such a period takes the point p exactly to the point p + 1, and every point of the manifold has
one label.  Each is computed by itself, from beside the saddle: errors do not add up along the
curve.  Motions set off within 1e-6 of the saddle on the straight line along its direction, which
misses the manifold by the square of that; on the way to the point this error shrinks by the stable
multiplier.  Stable manifolds are those of the motion backward in time.
"""

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges._flow import Flow, Reached
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import harmonic, section_of
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import exp, hypot, log
from rocksteady.kernels.orbits.return_map import (
    Section,
    next_passage,
    phase_between,
)
from rocksteady.kernels.orbits.systems import make_system

TURN = 2.0 * math.pi

BESIDE = 1e-6
"""Distance from the saddle up to which motions set off: of (u, du/ds), or of the phase [rad] and
the speed relative to itself."""
LONGEST_WAIT = 500.0
"""Phase of the shaking, in periods, within which the impacts of a motion must come."""


class Images(NamedTuple):
    """Points of a manifold.

    Attributes
    ----------
    first, second
        u and du/d(pt), or phase [rad] and speed; nan where there is none.
    impacts
        Between leaving the saddle and the point.
    side
        Side to which the block leans, or goes.
    fallen
        Whether the block has overturned (of a stable manifold: has never had an impact before).
    """

    first: Floats
    second: Floats
    impacts: NDArray[np.int64]
    side: NDArray[np.int64]
    fallen: NDArray[np.bool_]


class FromHilltop:
    """Motions that leave a hilltop saddle.

    Parameters
    ----------
    saddle, backward
        Which, and whether time runs backward, along its stable direction.
    sign
        +1 towards larger u, -1 towards smaller.
    """

    def __init__(self, saddle: HilltopSaddle, *, backward: bool, sign: int) -> None:
        self.saddle, self.sign, self.backward = saddle, sign, backward
        self.flow = Flow(saddle.block, saddle.motion, saddle.model, backward=backward)
        self.growth = abs(saddle.lyapunov)
        self.kind: Literal["stable", "unstable"] = "stable" if backward else "unstable"

    def at_phase(self, label: float, phase: float) -> Reached:
        """Return the state at a phase of the motion that has left a label's periods before."""
        begin = phase + (TURN if self.backward else -TURN) * label
        return self.flow.carried(*self._beside(begin), begin, phase)

    def after_impacts(self, label: float, impacts: int) -> Reached:
        """Return the state after a number of impacts of the motion that leaves at a label."""
        begin = TURN * label
        longest = TURN * LONGEST_WAIT
        return self.flow.after(*self._beside(begin), begin, impacts, longest=longest)

    def _beside(self, phase: float) -> tuple[float, float]:
        angle, velocity = self.saddle.at(phase)
        along, across = self.saddle.direction(self.kind, phase)
        size = self.sign * BESIDE
        return float(angle) + size * along, float(velocity) + size * across


class FromOrbit:
    """Motions that leave an orbit with impacts.

    Parameters
    ----------
    orbit, backward
        Which, and whether time runs backward, along its stable direction.
    sign
        +1 or -1: the first impact of the orbit later or earlier.
    """

    def __init__(self, orbit: Orbit, *, backward: bool, sign: int) -> None:
        self.sign, self.backward = sign, backward
        self.period = orbit.period
        self.flow = Flow(orbit.block, harmonic(orbit.motion), orbit.model, backward=backward)
        self.states = [section_of(state) for state in orbit.states]
        if backward:
            first, *others = self.states
            self.states = [self._reversed(state) for state in (first, *others[::-1])]
        multiplier = float(orbit.multipliers[1 if backward else 0].real)
        self.multiplier = 1.0 / multiplier if backward else multiplier
        self.growth = abs(log(abs(self.multiplier)))
        self._follow(orbit)

    def _reversed(self, state: Section) -> Section:
        """Return a state just after an impact as time that runs backward sees it: just after it."""
        free = self.flow.sides[0, columns.RESTITUTION] < 0.0
        # The block left the other side by that impact; `inverse_sides` has exchanged both.
        ratio = abs(float(self.flow.sides[0 if state.side > 0 else 1, columns.RESTITUTION]))
        half, phase = clock(math.pi - (state.half_cycles * math.pi + state.phase))
        return Section(state.side if free else -state.side, half, phase, state.speed * ratio)

    def _follow(self, orbit: Orbit) -> None:
        """Find the phases of the states and the unstable direction at each."""
        sides = np.ascontiguousarray(self.flow.sides)
        motion = orbit.motion
        system = make_system(motion.amplitude, motion.frequency_ratio, sides)
        self.phases, jacobians = [], []
        passed = self.states[0].half_cycles * math.pi + self.states[0].phase
        for state in self.states:
            self.phases.append(passed)
            step = next_passage(system, state, -1.0)
            passed += phase_between(state, step.state)
            jacobians.append(np.array(step.jacobian).reshape(2, 2))
        whole = np.eye(2)
        for jacobian in jacobians:
            whole = jacobian @ whole
        speed = self.states[0].speed
        scaled = whole * np.array([[1.0, speed], [1.0 / speed, 1.0]])
        rest = scaled - self.multiplier * np.eye(2)
        row = rest[0] if hypot(*rest[0].tolist()) >= hypot(*rest[1].tolist()) else rest[1]
        x, y = -float(row[1]), float(row[0])
        # A later impact, or of the same phase a faster one.
        size = math.copysign(hypot(x, y), x if abs(x) > 1e-9 * abs(y) else y)
        direction = np.array([x / size, y / size * speed])
        if self.backward:  # towards later impacts in time that runs forward
            direction = -direction
        self.directions = []
        for jacobian in jacobians:
            self.directions.append(direction)
            direction = jacobian @ direction
        self.sizes = [
            hypot(float(turn), float(rate) / state.speed)
            for (turn, rate), state in zip(self.directions, self.states, strict=True)
        ]

    def at_phase(self, label: float, phase: float) -> Reached:
        """Return the state at a phase of the motion that has left a label's loops before."""
        end = math.pi - phase if self.backward else phase
        states = len(self.states)
        # The last state of the orbit before that phase.
        loops = math.floor((end - self.phases[0]) / (TURN * self.period))
        index = loops * states + states - 1
        while self._phase(index) > end:
            index -= 1
        while True:
            size, turn, speed, side = self._beside(index, label, loops)
            begin = self._phase(index) + turn
            if size <= BESIDE and begin <= end:
                break
            index -= 1
        if self.backward:
            return self.flow.carried(0.0, -side * speed, math.pi - begin, phase)
        return self.flow.carried(0.0, side * speed, begin, phase)

    def after_impacts(self, label: float, place: int) -> Reached:
        """Return the state at an impact of the motion that has left a label's loops before."""
        last = -place % len(self.states) if self.backward else place
        index = last
        while True:
            size, turn, speed, side = self._beside(index, label, 0)
            if size <= BESIDE:
                break
            index -= 1
        begin = self._phase(index) + turn
        if self.backward:
            velocity, begin = -side * speed, math.pi - begin
        else:
            velocity = side * speed
        if index == last:
            return Reached(0.0, velocity, begin, side, 0, False, False)
        longest = TURN * LONGEST_WAIT
        return self.flow.after(0.0, velocity, begin, last - index, longest=longest)

    def _phase(self, index: int) -> float:
        loops, place = divmod(index, len(self.states))
        return self.phases[place] + loops * self.period * TURN

    def _beside(self, index: int, label: float, loops: int) -> tuple[float, float, float, int]:
        """Return the distance, the shift in phase, the speed and the side beside a state."""
        before, place = divmod(index, len(self.states))
        before -= loops
        # |multiplier|^(label + before), with the sign of the loops.
        size = BESIDE * exp(self.growth * (label + before)) / max(self.sizes)
        if self.multiplier < 0.0 and before % 2:
            size = -size
        turn, rate = (self.sign * size * self.directions[place]).tolist()
        state = self.states[place]
        return abs(size) * self.sizes[place], turn, state.speed + rate, state.side


Departures = FromHilltop | FromOrbit
"""Motions that leave a saddle."""


def stroboscopic(leaving: Departures, labels: Floats, phase: float) -> Images:
    """Return the points of a manifold at a phase of the shaking."""
    return _images([leaving.at_phase(label, phase) for label in labels.tolist()])


def impacting(leaving: Departures, labels: Floats, place: int, forward: Floats) -> Images:
    """Return points of a manifold just after impacts: phase in [0, 2 pi) and speed.

    Parameters
    ----------
    leaving, labels
        The motions.
    place
        For an orbit, the number of the state near which the curve begins; for a hilltop saddle, the
        number of impacts since, or until.
    forward
        Side table of the block, forward in time.
    """
    reached = []
    for label in labels.tolist():
        images = leaving.after_impacts(label, place)
        velocity = abs(images.velocity)
        side = images.side
        if leaving.backward and math.isfinite(velocity):
            # Just before the impact in forward time: multiplied by the restitution just after it.
            ratio = float(forward[0 if side > 0 else 1, columns.RESTITUTION])
            velocity *= abs(ratio)
            side = side if forward[0, columns.RESTITUTION] <= 0.0 else -side
        reached.append(images._replace(angle=images.phase % TURN, velocity=velocity, side=side))
    return _images(reached)


def _images(reached: list[Reached]) -> Images:
    return Images(
        np.array([each.angle for each in reached]),
        np.array([each.velocity for each in reached]),
        np.array([each.impacts for each in reached], dtype=np.int64),
        np.array([each.side for each in reached], dtype=np.int64),
        np.array([each.fallen for each in reached], dtype=np.bool_),
    )
