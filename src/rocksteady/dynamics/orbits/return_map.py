"""The return map of periodic shaking, from impact to impact, with its exact derivative."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.errors import ModelError
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import LINEAR_LEFT_OUT, is_nonlinear
from rocksteady.kernels.orbits import return_map, systems
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import PeriodicMotion, shares_of
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import Event

MOST_STEPS = 100_000
"""Of one call of the map: some ten seconds."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Passage:
    """One or several steps of the return map.

    Attributes
    ----------
    kind
        Event that ended the last step.
    state
        State after the last step; None where no impact follows.
    impacts, uplifts
        Numbers of impacts and of uplifts on the way.
    phase
        Phase of the shaking that has passed [rad].
    time
        Pivot time that has passed.
    landing_speed
        |d(theta/alpha)/d(p t)| just before the last impact.
    jacobian
        Derivative of (phase, speed) after by (phase, speed) before, shape (2, 2); 0 after a rest,
        nan where there is none.
    """

    kind: Event
    state: ImpactState | None
    impacts: int
    uplifts: int
    phase: float
    time: float
    landing_speed: float
    jacobian: Floats


@checked
class ReturnMap:
    """The return map: from the state after one impact to the state after the next.

    Parameters
    ----------
    block
        Block; its sides and their restitution count; in the nonlinear model their slenderness too.
    motion
        Harmonic shaking or a Fourier series.  Its phase does not count: the states have theirs.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Raises
    ------
    InputError, ModelError
        If `block` is no block, or has no slenderness for the nonlinear model, the motion is not
        periodic, or there is no such model.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.formulas import steady_states
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> states = steady_states(2.0, 4.0, 0.8)
    >>> state = ImpactState(side=1, phase=states.phase[0], speed=states.velocity[0])
    >>> passage = ReturnMap(DimensionlessBlock(restitution=0.8), motion)(state)
    >>> print(passage.kind.label, f"{passage.phase:.6f}", f"{passage.state.speed:.6f}")
    impact 3.141593 0.732389
    >>> print(f"{passage.jacobian.trace():.6f} {states.trace[0]:.6f}")
    -0.521789 -0.521789
    """

    def __init__(
        self,
        block: Block | DimensionlessBlock,
        motion: PeriodicMotion,
        *,
        model: ModelChoice = None,
    ) -> None:
        self.block = block.dimensionless()
        self.motion = periodic_motion(motion)
        self.model = chosen_model(model, block)
        self.system = make_system(block, self.motion, self.model)

    def __call__(self, state: ImpactState, steps: int = 1) -> Passage:
        """Return the result of a number of steps from a state.

        Parameters
        ----------
        state
            Where to start.
        steps
            Impacts, or uplifts from rest, to pass, up to a million.

        Returns
        -------
        Passage
            It ends early where no impact follows.

        Raises
        ------
        InputError
            If `steps` is not a whole number from 1 to a million.
        """
        hint = "give the number of impacts"
        count = whole_number("steps", steps, at_least=1, at_most=MOST_STEPS, hint=hint)
        total, kind = np.eye(2), return_map.IMPACT
        here = begin = section_of(state)
        time = landing = 0.0
        impacts = uplifts = 0
        following = for_system(return_map.next_passage, self.system)
        for _ in range(count):
            step = following(self.system, here, -1.0)
            kind, landing = step.kind, step.landing
            time += step.time
            if kind not in (return_map.IMPACT, return_map.UPLIFT, return_map.GRAZE):
                break
            impacts += kind != return_map.UPLIFT
            uplifts += kind == return_map.UPLIFT
            if kind == return_map.GRAZE:
                total = np.full((2, 2), math.nan)
            else:  # the product of two matrices, whose sums BLAS may round otherwise
                total = (np.array(step.jacobian).reshape(2, 2, 1) * total).sum(axis=1)
            here = step.state
        ended = kind in (return_map.FALL, return_map.STAY, return_map.STUCK)
        return Passage(
            kind=Event(kind),
            state=None if ended else state_of(here),
            impacts=impacts,
            uplifts=uplifts,
            phase=math.inf if ended else return_map.phase_between(begin, here),
            time=time,
            landing_speed=landing,
            jacobian=np.full((2, 2), math.nan) if ended else total,
        )

    def passages(self, state: ImpactState) -> Iterator[Passage]:
        """Yield the steps that follow a state, one at a time, until no impact follows."""
        here: ImpactState | None = state
        while here is not None:
            passage = self(here)
            yield passage
            here = passage.state


def periodic_motion(motion: object) -> PeriodicMotion:
    """Return a motion that is periodic.

    Raises
    ------
    ModelError
        If it is not.
    """
    if not isinstance(motion, PeriodicMotion):
        raise ModelError(
            "motion",
            motion,
            "orbits and attractors are those of periodic shaking",
            "give a Harmonic(amplitude=..., frequency_ratio=...) or a FourierSeries",
        )
    return motion


def harmonic(motion: object) -> Harmonic:
    """Return a motion that is a single sinusoid.

    Raises
    ------
    ModelError
        If it is not.
    """
    if not isinstance(periodic_motion(motion), Harmonic):
        raise ModelError(
            "motion",
            motion,
            "this takes a single sinusoid, and no Fourier series",
            "give a Harmonic(amplitude=..., frequency_ratio=...)",
        )
    assert isinstance(motion, Harmonic)
    return motion


def has_mirror_images(block: Block | DimensionlessBlock, motion: PeriodicMotion) -> bool:
    """Return whether the mirror image of a motion, half a period later, is a motion too.

    The sides of the block have to be alike, and half a period has to turn the shaking round: of a
    Fourier series all orders are odd.
    """
    return block.symmetric and (isinstance(motion, Harmonic) or motion.antisymmetric)


def make_system(
    block: Block | DimensionlessBlock, motion: PeriodicMotion, model: Model
) -> systems.EitherSystem:
    """Return block and motion as the kernels see them.

    Raises
    ------
    ModelError
        If the nonlinear model meets a block without slenderness.
    """
    sides = model.sides(block)
    if isinstance(motion, Harmonic):
        return systems.make_system(motion.amplitude, motion.frequency_ratio, sides)
    total, shares = shares_of(motion.harmonics)
    amplitude = motion.amplitude * total
    bound = systems.make_system(amplitude, motion.frequency_ratio, sides)
    lifts = np.empty((2, len(shares) // 2))
    systems.fill_uplifts(bound, shares, lifts)
    left_out = bound.left_out if is_nonlinear(sides) else LINEAR_LEFT_OUT
    return systems.SeriesSystem(*bound[:-3], left_out, shares, lifts)


def section_of(state: ImpactState) -> return_map.Section:
    """Return a state as the kernels see it."""
    half, phase = clock(state.phase)
    return return_map.Section(state.side, half, phase, state.speed)


def state_of(here: return_map.Section) -> ImpactState:
    """Return a state of the kernels as the package's users see it."""
    phase = (here.half_cycles % 2) * math.pi + here.phase
    return ImpactState(side=here.side, phase=phase, speed=here.speed)
