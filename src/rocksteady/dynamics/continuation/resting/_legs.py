"""Motion from one uplift to the next, and the orbit with rest that such motions make."""

from dataclasses import dataclass
from typing import NamedTuple

from rocksteady.dynamics.continuation.resting.resting_types import NoRest
from rocksteady.dynamics.orbits.return_map import make_system
from rocksteady.dynamics.parameters import moved_to
from rocksteady.kernels.orbits.return_map import (
    FALL,
    IMPACT,
    STAY,
    STUCK,
    UPLIFT,
    Passage,
    Section,
    guess_after,
    next_passage,
    phase_between,
    uplift_after,
)
from rocksteady.kernels.orbits.settle import GENERIC, ROUNDED, Stretch, stretched
from rocksteady.kernels.orbits.systems import System
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.motions.segments import Harmonic

MOST_PASSAGES = 2000
"""Of a motion that is followed to its rest."""


Pattern = tuple[tuple[int, int], ...]
"""Side and half periods of the shaking of each leg of an orbit."""


class Leg(NamedTuple):
    """Motion from an uplift to the next."""

    states: tuple[Section, ...]  # the uplift, and after each impact until the rest is proved
    steps: tuple[Passage, ...]  # the passages that follow them
    following: Section | None  # the next uplift
    failure: NoRest | None  # why there is none
    growth: float  # logarithm of the largest growth of a small difference

    @property
    def side(self) -> int:
        """The side to which the block lifts."""
        return self.states[0].side

    @property
    def half_cycles(self) -> int:
        """Half periods of the shaking from uplift to uplift."""
        assert self.following is not None
        return self.following.half_cycles - self.states[0].half_cycles

    @property
    def phases(self) -> list[float]:
        """Phase of each impact, counted from the half cycle of the uplift."""
        start = Section(self.side, self.states[0].half_cycles, 0.0, 0.0)
        return [phase_between(start, state) for state in self.states]


class Sample(NamedTuple):
    """The orbit with rest through an uplift at one value of the parameter, or why there is none."""

    pattern: Pattern  # empty for none
    legs: tuple[Leg, ...]
    failure: NoRest | None
    decided: bool  # by more than rounding


def uplift_to(system: System, side: int) -> Section | None:
    """Return the uplift to a side; None where the shaking never lifts the block to it."""
    lifted = uplift_after(system._replace(free=side), 0, 0.0)
    return None if lifted.kind == STAY else lifted.state


def leg_from(system: System, begin: Section, longest: int) -> Leg:
    """Return the motion from an uplift, up to a number of half periods."""
    states: list[Section] = [begin]
    steps: list[Passage] = []
    guess, failure, following = -1.0, None, None
    while failure is None and following is None:
        step = next_passage(system, states[-1], guess)
        steps.append(step)
        late = step.state.half_cycles - begin.half_cycles > longest
        if step.kind == FALL:
            failure = NoRest.OVERTURNS
        elif step.kind in (STAY, STUCK) or late or len(states) > MOST_PASSAGES:
            failure = NoRest.NOT_WITHIN
        elif step.kind == UPLIFT:
            following = step.state
        else:
            states.append(step.state)
            guess = guess_after(step)
    growth = 0.0 if following is None else _growth(steps)
    return Leg(tuple(states), tuple(steps), following, failure, growth)


def _growth(steps: list[Passage]) -> float:
    """Return the logarithm of the largest growth of a small difference on a way."""
    stretch, growth = Stretch(GENERIC[0], GENERIC[1], 0.0, 0), 0.0
    for step in steps:
        if step.kind == IMPACT:
            stretch = stretched(stretch, step.jacobian)
            growth = max(growth, stretch.logarithm)
    return growth


def mirror_of(leg: Leg) -> Leg:
    """Return the mirror image of the motion of a symmetric block, half a period later."""

    def turned(state: Section) -> Section:
        return state._replace(side=-state.side, half_cycles=state.half_cycles + 1)

    return leg._replace(
        states=tuple(turned(state) for state in leg.states),
        steps=tuple(step._replace(state=turned(step.state)) for step in leg.steps),
        following=None if leg.following is None else turned(leg.following),
    )


@dataclass(frozen=True)
class Uplifts:
    """What follows from the uplifts of a block, as a function of one parameter.

    Attributes
    ----------
    block, motion, parameter, model
        What moves, by what, over what and in which equations.
    longest
        Longest period of an orbit [forcing periods].
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    parameter: str
    model: Model
    longest: int

    @property
    def sides(self) -> tuple[int, ...]:
        """The sides whose uplifts are looked at: of mirror images one is enough."""
        if self.block.one_sided:
            return (self.free,)
        return (1,) if self.block.symmetric else (1, -1)

    @property
    def free(self) -> int:
        """The one side of a block against a wall; 0 of another."""
        system: System = make_system(self.block, self.motion, self.model)
        return system.free

    def moved(self, value: float) -> tuple[Block | DimensionlessBlock, Harmonic]:
        """Return block and shaking at a value of the parameter."""
        return moved_to(self.block, self.motion, self.parameter, value)

    def system(self, value: float) -> System:
        """Return both as the kernels see them."""
        system: System = make_system(*self.moved(value), self.model)
        return system

    def lifted(self, value: float) -> tuple[bool, ...]:
        """Return which sides the shaking lifts the block to."""
        system = self.system(value)
        sides = (system.free,) if system.free else (1, -1)
        return tuple(uplift_to(system, side) is not None for side in sides)

    def sample(self, value: float, side: int) -> Sample:
        """Return the orbit with rest through an uplift; for one through both the first has it."""
        system = self.system(value)
        begin = uplift_to(system, side)
        if begin is None:
            return Sample((), (), NoRest.BELOW_UPLIFT, True)
        leg = leg_from(system, begin, 2 * self.longest)
        if leg.following is None:
            return Sample((), (leg,), leg.failure, True)
        legs = [leg]
        if leg.following.side != side:
            if self.block.symmetric and not self.block.one_sided:
                legs.append(mirror_of(leg))
            else:
                longer = leg_from(system, leg.following, 2 * self.longest)
                legs.append(longer)
                if longer.following is None:
                    return Sample((), tuple(legs), longer.failure, True)
                # Both uplifts lead to that of the other side, or the first of them has the orbit.
                if longer.following.side != side or side < 0:
                    return Sample((), tuple(legs), NoRest.ELSEWHERE, True)
        if sum(each.half_cycles for each in legs) > 2 * self.longest:
            return Sample((), tuple(legs), NoRest.NOT_WITHIN, True)
        pattern = tuple((each.side, each.half_cycles) for each in legs)
        decided = all(each.growth <= ROUNDED for each in legs)
        return Sample(pattern, tuple(legs), None if decided else NoRest.UNDECIDED, decided)


def apart(one: Sample, other: Sample) -> float:
    """Return the largest difference of the phases of like impacts of two orbits."""
    gap = 0.0
    for here, second_leg in zip(one.legs, other.legs, strict=True):
        pairs = zip(here.phases, second_leg.phases, strict=False)
        gap = max(gap, *(abs(first - second) for first, second in pairs))
    return gap


def bend(low: Sample, middle: Sample, high: Sample) -> float:
    """Return by how much the impacts of an orbit are off the mean of two others."""
    gap = 0.0
    for first, leg, last in zip(low.legs, middle.legs, high.legs, strict=True):
        rows = zip(first.phases, leg.phases, last.phases, strict=False)
        gap = max(gap, *(abs(phase - 0.5 * (a + b)) for a, phase, b in rows))
    return gap


def first_jump(one: Sample, other: Sample, least: float) -> tuple[int, int, float] | None:
    """Return leg, impact and difference of the first impact whose phases differ by that much."""
    for row, (here, second_leg) in enumerate(zip(one.legs, other.legs, strict=True)):
        for k, (a, b) in enumerate(zip(here.phases, second_leg.phases, strict=False)):
            if abs(a - b) > least:
                return row, k, b - a
    return None
