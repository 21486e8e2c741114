"""How motions end, distinguished as far as an edge needs it."""

import math
from dataclasses import replace
from typing import NamedTuple

from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.orbits.attractor import Attractor, find_attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.search import SAME
from rocksteady.outcomes import AttractorKind

TURN = 2.0 * math.pi


class Outcome(NamedTuple):
    """What a motion settles to.

    Attributes
    ----------
    name
        In words.
    falls
        Whether it overturns.
    number
        Number of the orbit among those seen; +1 or -1, the side of a fall; 0 otherwise.
    attractor
        Result of `find_attractor`.
    """

    name: str
    falls: bool
    number: int
    attractor: Attractor

    def same(self, other: "Outcome") -> bool:
        """Return whether two motions end alike."""
        return self.name == other.name and self.number == other.number


class Outcomes:
    """Outcomes of states, and which orbits have been seen.

    Parameters
    ----------
    flow
        Flow of the block, forward in time.
    max_cycles
        Forcing periods for which a motion is followed.
    """

    def __init__(self, flow: Flow, max_cycles: int) -> None:
        self.flow, self.max_cycles = flow, max_cycles
        self.orbits: list[Orbit] = []
        self.asked = 0

    def falls(self, angle: float, velocity: float, phase: float) -> bool:
        """Return whether a state overturns within the periods for which it is followed."""
        self.asked += 1
        return self.flow.carried(angle, velocity, phase, phase + TURN * self.max_cycles).fallen

    def of(self, angle: float, velocity: float, phase: float) -> Outcome:
        """Return the outcome of a state."""
        self.asked += 1
        flow = self.flow
        attractor = find_attractor(
            flow.block,
            replace(flow.motion, phase=phase % TURN),
            start=State(angle=angle, velocity=velocity),
            max_cycles=self.max_cycles,
            model=flow.model,
        )
        if attractor.kind is AttractorKind.OVERTURNED:
            end = phase + TURN * (attractor.after + 2)
            side = flow.carried(angle, velocity, phase, end).side
            word = "positive" if side > 0 else "negative"
            return Outcome(f"overturned to the {word} side", True, side, attractor)
        if attractor.orbit is None:
            return Outcome(str(attractor.kind.value), False, 0, attractor)
        orbit = attractor.orbit
        name = f"{orbit.kind} orbit of period {orbit.period}"
        return Outcome(name, False, self._number(orbit), attractor)

    def _number(self, orbit: Orbit) -> int:
        """Return the number of an orbit among those seen, from 1."""
        begin = orbit.states[0]
        for number, known in enumerate(self.orbits, start=1):
            if known.period != orbit.period:
                continue
            for state in known.states:
                apart = abs(state.phase - begin.phase)
                near = min(apart, TURN - apart) <= SAME and state.side == begin.side
                if near and abs(state.speed - begin.speed) <= SAME:
                    return number
        self.orbits.append(orbit)
        return len(self.orbits)
