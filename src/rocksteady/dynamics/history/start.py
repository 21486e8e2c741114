"""Initial states: at rest, any angle and velocity, after an impact, or on a steady state."""

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Annotated, Protocol

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.departure import set_off, states_to_start_on
from rocksteady.dynamics.steady.states import refuse_asymmetric, validated_branch
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import ALPHA, LEAN, RATE, RESTITUTION, March, is_nonlinear
from rocksteady.kernels.nonlinear.drive import jump_share
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import (
    LARGEST,
    finite,
    odd_order,
    positive,
    side_value,
)
from rocksteady.model.linear_tables import only_side
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Harmonic, Motion, segments_of

KICK = 1e-6
"""Default distance from an unstable orbit at which a block is set off."""
LARGEST_KICK = 0.1
"""Further from an orbit its unstable direction means nothing."""
FARTHEST = 1e12
"""Largest angle and speed of a start: whether u + du/d(pt) is below 1 decides, to 1e-4 there."""


def _turned(name: str, value: float) -> float:
    """Return a phase from 0 to 2 pi."""
    phase = finite(name, value, hint="give the phase of the shaking in radians")
    turned = math.fmod(phase, 2.0 * math.pi) % (2.0 * math.pi)
    return turned if turned < 2.0 * math.pi else 0.0


@checked
@dataclass(frozen=True, kw_only=True)
class Rest:
    """Initial state at rest on the base."""


@checked
@dataclass(frozen=True, kw_only=True)
class State:
    """Initial state of any angle and velocity.

    Parameters
    ----------
    angle
        u = theta/alpha, with alpha of the positive side for both signs.
    velocity
        du/d(pt).  `per_tau` takes du/d(omega t), the paper's.
    phase
        Phase of harmonic shaking then [rad], taken modulo 2 pi; None (default) for the motion's.

    Raises
    ------
    InputError
        If a number is not finite, or an angle or velocity beyond 1e12.
    """

    angle: Annotated[float, Bounds(-FARTHEST, FARTHEST, "[]", "give theta/alpha")]
    velocity: Annotated[float, Bounds(-FARTHEST, FARTHEST, "[]", "give d(theta/alpha)/d(p t)")]
    phase: Annotated[float | None, _turned] = None

    @classmethod
    def per_tau(
        cls,
        *,
        angle: float,
        velocity_tau: Annotated[
            float, Bounds(-LARGEST, LARGEST, "[]", "give d(theta/alpha)/d(omega t)")
        ],
        frequency_ratio: Annotated[float, partial(positive, hint="give omega/p")],
        phase: float | None = None,
    ) -> "State":
        """Return the state whose velocity is given as du/d(omega t)."""
        return cls(angle=angle, velocity=velocity_tau * frequency_ratio, phase=phase)


@checked
@dataclass(frozen=True, kw_only=True)
class Steady:
    """Initial state on a symmetric steady state, at the impact that begins its positive half.

    Only of a block whose sides are alike.

    In the nonlinear model it is that model's own: the one to which the linear model's leads as the
    slenderness grows from 0 to the block's.

    A stable one is started on exactly.  An unstable one would be left by round-off; it is left
    instead along its unstable direction, on a named side, from a named distance.

    Parameters
    ----------
    branch
        1 or 2 (upper or lower signs of eqs 21, 22).
    order
        n = 1, 3, 5, ...
    kick
        Distance from an unstable orbit at which the block starts: the length of (phase shift [rad],
        velocity shift / velocity of the orbit), above 0 and up to 0.1.
    side
        +1 or -1, the side on which an unstable orbit is left.

    Raises
    ------
    InputError
        If a value is outside its range, or the order is even.
    """

    branch: Annotated[int, validated_branch] = 1
    order: Annotated[int, odd_order] = 1
    kick: Annotated[float, Bounds(0.0, LARGEST_KICK, "(]", "give a small number, as 1e-6")] = KICK
    side: Annotated[int, side_value] = 1


@checked
@dataclass(frozen=True, kw_only=True)
class ImpactState:
    """A state just after an impact, or at an uplift from rest, under harmonic shaking.

    As a start it decides on the phase of the shaking.

    Parameters
    ----------
    side
        +1 or -1: the side to which the block goes.
    phase
        Phase of the shaking then [rad]; taken modulo 2 pi.
    speed
        |d(theta/alpha)/d(p t)|; 0 where the block lifts from rest.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    side: Annotated[int, side_value]
    phase: Annotated[float, _turned]
    speed: Annotated[float, Bounds(0.0, FARTHEST, "[]", "give |d(theta/alpha)/d(p t)|")]

    @property
    def mirrored(self) -> "ImpactState":
        """Its mirror image: the other side, half a period of the shaking later."""
        return ImpactState(side=-self.side, phase=self.phase + math.pi, speed=self.speed)


Start = Rest | State | Steady | ImpactState


class HasStart(Protocol):
    """A result at whose start a run sets off: `Orbit`, `Attractor`, `BranchPoint` and others."""

    @property
    def start(self) -> Start | None:
        """Its start; None where it has none."""


def start_of(start: object, *, name: str = "start") -> Start:
    """Return a start: that of a result where one is given, at rest by default.

    Raises
    ------
    InputError
        If the value is no start and has none.
    """
    if start is None:
        return Rest()
    state = start if isinstance(start, Start) else getattr(start, "start", None)
    if not isinstance(state, Start):
        raise InputError(
            name,
            start,
            "it must be a Rest, a State, a Steady, an ImpactState, or a result that has a start",
            "give Rest(), State(angle=..., velocity=...) or Steady(branch=..., order=...)",
        )
    return state


def start_without_phase(start: object) -> Rest | State:
    """Return a start at pivot time 0: at rest, or a state.

    Raises
    ------
    InputError
        If it is another start, or no start.
    """
    begun = start_of(start)
    if not isinstance(begun, Rest | State) or getattr(begun, "phase", None) is not None:
        raise InputError(
            "start", start, "it must be Rest() or a State without a phase", "give State(angle=...)"
        )
    return begun


def refuse_behind_wall(
    block: Block | DimensionlessBlock, angle: float, velocity: float, *, name: str = "start"
) -> None:
    """Refuse a state in which a block against a wall would be in it, or move into it.

    Parameters
    ----------
    block
        Any; one without a wall has every state.
    angle, velocity
        The state: u and du/d(pt), or any others of their signs.
    name
        The argument that is refused.

    Raises
    ------
    ModelError
        If the angle is below 0, or 0 with a velocity below 0.
    """
    if block.one_sided and (angle < 0.0 or (angle == 0.0 and velocity < 0.0)):
        raise ModelError(
            name,
            Words(f"has angle {angle:g} and velocity {velocity:g}"),
            "a block against a wall rocks on its positive side alone",
            "give an angle above 0, or angle 0 with a velocity of 0 or above",
        )


def initial_march(
    start: Start,
    block: DimensionlessBlock,
    motion: Motion | Record,
    sides: Floats,
) -> tuple[Motion | Record, March]:
    """Return the motion, given its phase where the start decides on that, and the initial state.

    Parameters
    ----------
    start
        Where the block begins.
    block, motion
        What moves.
    sides
        Sides of the block, shape (2, 3) or (2, 5): in the nonlinear model its steady states are
        another's, and an impulse at the start turns it by the part that its angle lets act.

    Raises
    ------
    InputError
        If it is no start.
    ModelError
        If a start that decides on the phase has no harmonic shaking, there is no admissible steady
        state, or the start of a block against a wall lies behind it.
    """
    start = start_of(start)
    if isinstance(start, Steady):
        motion, state = _steady_state(start, block, motion, sides)
    elif isinstance(start, ImpactState):
        if not isinstance(motion, PeriodicMotion):
            raise ModelError(
                "start",
                start,
                "the state after an impact needs periodic shaking, whose phase it has",
                "give a Harmonic or a FourierSeries, or start from a State",
            )
        motion = replace(motion, phase=start.phase)
        state = State(angle=0.0, velocity=start.side * start.speed)
        # At an uplift there is no velocity, but a side.
        refuse_behind_wall(block, 0.0, state.velocity or float(start.side))
    elif isinstance(start, State):
        state = start
        if start.phase is not None:
            if not isinstance(motion, PeriodicMotion):
                raise ModelError(
                    "start",
                    start,
                    "the phase of a state is that of periodic shaking",
                    "give a Harmonic or a FourierSeries, or a State without a phase",
                )
            motion = replace(motion, phase=start.phase)
    else:
        state = State(angle=0.0, velocity=0.0)
    refuse_behind_wall(block, state.angle, state.velocity)
    half, phase, jump = 0, 0.0, 0.0
    # The march reads clock and jump of the later segments itself; a record has neither.
    for first in () if isinstance(motion, Record) else segments_of(motion)[:1]:
        jump = first.jump
        if first.frequency:
            half, phase = clock(first.phase)
    leans, velocity = set_going(state.angle, state.velocity, jump, sides)
    return motion, March(leans, state.angle, velocity, 0, half, phase, 0, 0)


def set_going(angle: float, velocity: float, jump: float, sides: Floats) -> tuple[int, float]:
    """Return the side on which a block begins, 0 at rest, and its velocity after an impulse.

    Parameters
    ----------
    angle, velocity
        Its state before.
    jump
        The impulse of the base at that moment, in units of alpha g/p.
    sides
        Sides of the block, shape (2, 3) or (2, 5).
    """
    walled = only_side(sides) > 0
    row = 0 if walled or (angle or velocity + jump) > 0.0 else 1
    lean, rate = float(sides[row, LEAN]), float(sides[row, RATE])
    turned = jump * (rate * rate)  # each side takes an impulse of the base by its own p^2
    if jump and is_nonlinear(sides):
        turned *= jump_share(sides, 1 if row == 0 else -1, abs(angle) / lean)
    later = velocity + turned
    if walled and angle == 0.0 and later < 0.0:  # thrown against the wall
        later = float(sides[0, RESTITUTION]) * later if velocity > 0.0 else 0.0
    standing = angle == 0.0 and later == 0.0
    return 0 if standing else (1 if (angle or later) > 0.0 else -1), later


def _steady_state(
    start: Steady,
    block: DimensionlessBlock,
    motion: Motion | Record,
    sides: Floats,
) -> tuple[Harmonic, State]:
    """Return the shaking with the orbit's phase, and the state on the orbit."""
    if not isinstance(motion, Harmonic):
        raise ModelError(
            "start",
            start,
            "a steady state needs harmonic shaking",
            "give a Harmonic motion, or start from a State",
        )
    if block.one_sided:
        raise ModelError(
            "start",
            Words("is a steady state"),
            "its second half mirrors the first, and a block against a wall has one side",
            "start at rest or from a State; `find_orbits` finds its periodic motions",
        )
    refuse_asymmetric(block, "start", "a steady state to start on")
    a, w, r = motion.amplitude, motion.frequency_ratio, block.restitution
    states, jacobian = states_to_start_on(
        np.array([a]), np.array([w]), sides[None], start.order, start.branch
    )
    which = start.branch - 1, 0
    if np.isnan(states.phase[which]):
        least = f"to {float(states.existence[0]):.6g} or above (eq 23)"
        slender = "" if jacobian is None else f", alpha {float(sides[0, ALPHA]):.6g}"
        raise ModelError(
            "start",
            start,
            f"at A = {a:.6g}, Omega = {w:.6g}, restitution {r:.6g}{slender} there is none of "
            f"order {start.order}",
            f"raise the amplitude {least}"
            if jacobian is None
            else "raise the amplitude, or take a State to start from",
        )
    if states.admissible is None or not states.admissible[which]:
        raise ModelError(
            "start",
            start,
            "that solution of the algebra passes through the floor and is no motion",
            "take the other branch or another order",
        )
    away = start.side * start.kick
    phase, velocity = set_off(states, jacobian, branch=start.branch, cell=0, away=away)
    shaken = Harmonic(amplitude=a, frequency_ratio=w, phase=phase)
    return shaken, State(angle=0.0, velocity=velocity)
