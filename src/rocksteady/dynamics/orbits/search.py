"""Search for all periodic motions at one amplitude and frequency ratio."""

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.dynamics.orbits.orbit import Orbit, orbit_from
from rocksteady.dynamics.orbits.return_map import (
    has_mirror_images,
    make_system,
    periodic_motion,
    section_of,
)
from rocksteady.dynamics.steady.states import find_steady_states
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.kernels.orbits import periodic, return_map
from rocksteady.kernels.orbits.periodic import mirror
from rocksteady.kernels.orbits.return_map import (
    Jacobian,
    Passage,
    Section,
    guess_after,
    next_passage,
    uplift_after,
)
from rocksteady.kernels.orbits.settle import GENERIC, ROUNDED, Stretch, stretched
from rocksteady.kernels.orbits.systems import EitherSystem, SeriesSystem, for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Harmonic

ROOM = 4096
"""Most orbits that one search returns."""
MOST = 1000
"""Of each limit of the search: minutes, or hours where all three are near it."""
SAME = 1e-6
"""Difference in phase and relative speed below which two orbits are one."""


@checked
def find_orbits(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    *,
    max_period: int = 3,
    max_impacts: int = 6,
    seeds: int = 96,
    model: ModelChoice = None,
) -> tuple[Orbit, ...]:
    """Return the stable and unstable periodic motions at one amplitude and frequency ratio.

    Symmetric orbits with two impacts have a closed form for every odd number of forcing periods
    (eqs 19, 21, 22); orbits that would pass through the base are included, marked inadmissible.
    Orbits with a rest are followed from each uplift, of which a sinusoid has one for each side.
    All others are found by Newton's method from a grid of states after an impact, which is a
    search, not a proof that there are no more.  Of two mirror images only the orbit that leans to
    the positive side is returned; `Orbit.mirrored` is the other.  A block whose sides differ has
    neither symmetric orbits nor mirror images, nor has one against a wall: all of its orbits come
    from the search.

    In the nonlinear model the symmetric orbits are those to which the closed forms lead as the
    slenderness grows from 0 to that of the block, and keep their branch.

    Parameters
    ----------
    block
        Only its restitution and the ratios between its sides matter; in the nonlinear model its
        slenderness too.
    motion
        Amplitude and frequency ratio; its phase does not matter.
    max_period
        Longest period of an orbit [forcing periods].
    max_impacts
        Most impacts in a period of the orbit.
    seeds
        The search starts from ``seeds x seeds`` states: phases over a period, speeds up to
        1 + A/sqrt(1 + Omega^2), above which every flight of the linear model grows without bound.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    tuple of Orbit
        By period, then number of impacts, symmetric ones first, admissible ones before others,
        stable before unstable.

    Raises
    ------
    InputError, ModelError
        If a number is not a whole one from 1 to 1000, the shaking is not periodic, or the nonlinear
        model meets a block without slenderness.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    >>> for orbit in find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1):
    ...     print(orbit.kind, orbit.stable, orbit.admissible, f"{orbit.highest:.5f}")
    symmetric False True 0.68676
    symmetric False False nan
    unsymmetric True True 0.90035
    """
    block.dimensionless()  # refuses sides too unlike
    shaken = periodic_motion(motion)
    equations = chosen_model(model, block)
    system = make_system(block, shaken, equations)
    longest, most, count = (
        whole_number(name, value, at_least=1, at_most=MOST, hint=hint)
        for name, value, hint in (
            ("max_period", max_period, "give a number of forcing periods"),
            ("max_impacts", max_impacts, "give a number of impacts"),
            ("seeds", seeds, "give a number, as 96"),
        )
    )
    orbits: list[Orbit] = []
    mirrors = has_mirror_images(block, shaken)
    if block.symmetric and isinstance(shaken, Harmonic):
        orbits += _symmetric_orbits(block, shaken, equations, system, longest)
    searched = [
        orbit_from(block, shaken, table, periods, residual, equations)
        for table, periods, residual in (
            *_resting_orbits(system, longest),
            *_searched_orbits(system, shaken, longest, most, count, mirrors=mirrors),
        )
    ]
    for orbit in sorted(searched, key=lambda orbit: -orbit.highest):
        images = [orbit]
        if mirrors:
            leaning = orbit if orbit.highest >= -orbit.lowest else orbit.mirrored
            images = [leaning, leaning.mirrored]
        if not any(_same(image, known) for image in images for known in orbits):
            orbits.append(images[0])
    return tuple(sorted(orbits, key=_order))


def _order(orbit: Orbit) -> tuple[object, ...]:
    closed = orbit.branch if orbit.branch is not None else 3
    return (
        orbit.period,
        len(orbit.states),
        not orbit.symmetric,
        not orbit.admissible,
        closed,
        not orbit.stable,
        -orbit.highest,
    )


def _symmetric_orbits(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    model: Model,
    system: EitherSystem,
    longest: int,
) -> Iterable[Orbit]:
    """Yield the symmetric orbits with two impacts, the steady states of `find_steady_states`."""
    for order in range(1, longest + 1, 2):
        states = find_steady_states(block, motion, order=order, model=model)
        assert states.peak is not None
        assert states.admissible is not None
        for which in np.flatnonzero(np.isfinite(states.phase)).tolist():
            phase, velocity = float(states.phase[which]), float(states.velocity[which])
            admissible = bool(states.admissible[which])
            peak = float(states.peak[which]) if admissible else math.nan
            first = ImpactState(side=1, phase=phase, speed=abs(velocity))
            residual = math.nan
            if admissible:
                table = np.zeros((2, periodic.ORBIT_COLUMNS))
                begin = section_of(first)
                periodic.put(table, 0, begin)
                periodic.put(table, 1, mirror(begin, order))
                error = for_system(periodic.measured, system)(system, 2, order, table).residual
                residual = error if math.isfinite(error) else math.nan
            yield Orbit(
                block=block,
                motion=replace(motion, phase=first.phase),
                period=order,
                states=(first, first.mirrored),
                rest_phases=0,
                symmetric=True,
                highest=peak,
                lowest=-peak,
                multipliers=states.multipliers[which],
                residual=residual,
                admissible=admissible,
                branch=which + 1,
                model=model,
            )


Found = tuple[Floats, int, float]
"""An orbit as the kernels leave it: its table, periods and residual."""


def _uplifts(system: EitherSystem) -> list[Section]:
    """Return the uplifts that may end a rest, in the order of a period of the shaking."""
    sides = (system.free,) if system.free else (1, -1)
    if isinstance(system, SeriesSystem):
        series = [(side, system.lifts[0 if side > 0 else 1]) for side in sides]
        begins = [
            Section(side, *clock(phase), 0.0)
            for side, lifts in series
            for phase in lifts[np.isfinite(lifts)].tolist()
        ]
    else:
        lifted = [uplift_after(system._replace(free=side), 0, 0.0) for side in sides]
        begins = [each.state for each in lifted if each.kind != return_map.STAY]
    return sorted(begins, key=lambda begin: (begin.half_cycles, begin.phase))


def _resting_orbits(system: EitherSystem, longest: int) -> Iterable[Found]:
    """Yield the periodic orbits with rest phases, followed from each uplift until it comes again.

    An orbit comes once for each of its uplifts, and not at all where a small difference grows so
    much between two rests that rounding decides the motion.
    """
    for begin in _uplifts(system):
        standing = Jacobian(1.0, 0.0, 0.0, 1.0)
        passages, step = 0, Passage(return_map.UPLIFT, begin, 0.0, 0.0, standing)
        whole = nothing = Stretch(GENERIC[0], GENERIC[1], 0.0, 0)  # since the last rest
        while whole.logarithm <= ROUNDED:
            step = for_system(next_passage, system)(system, step.state, guess_after(step))
            halves = step.state.half_cycles - begin.half_cycles
            if step.kind in (return_map.FALL, return_map.STAY, return_map.STUCK):
                break
            if halves > 2 * longest:
                break
            passages += 1
            if step.kind == return_map.IMPACT:
                whole = stretched(whole, step.jacobian)
            if step.kind != return_map.UPLIFT:
                continue
            whole = nothing
            apart = abs(step.state.phase - begin.phase)
            if step.state.side == begin.side and halves % 2 == 0 and apart <= SAME:
                table = np.zeros((passages, periodic.ORBIT_COLUMNS))
                fixed = for_system(periodic.polish, system)(
                    system, begin, passages, halves // 2, table
                )
                if fixed.found:
                    yield table, halves // 2, fixed.residual
                break


def _swing_speed(motion: PeriodicMotion) -> float:
    """Return the speed that a block without impacts has under the shaking, or more."""
    w = motion.frequency_ratio
    if isinstance(motion, Harmonic):
        return float(motion.amplitude / hypot(1.0, w))
    return motion.amplitude * math.fsum(
        abs(size) / hypot(1.0, order * w) for order, size, _ in motion.harmonics
    )


def _searched_orbits(
    system: EitherSystem,
    motion: PeriodicMotion,
    longest: int,
    most: int,
    seeds: int,
    *,
    mirrors: bool,
) -> Iterable[Found]:
    """Yield the orbits that Newton's method finds."""
    fastest = 1.0 + _swing_speed(motion)
    steps = np.arange(seeds, dtype=np.float64)
    phases: Floats = steps * (2.0 * math.pi / seeds)
    speeds: Floats = (steps + 0.5) * (fastest / seeds)
    states, shape = np.zeros((ROOM, 2)), np.zeros((ROOM, 2), dtype=np.int64)
    orbits = periodic.Orbits(states, shape)
    table = np.zeros((most, periodic.ORBIT_COLUMNS))
    count = 0
    for column in range(seeds):
        for row in range(seeds):  # one state at a time, so that an interruption is heard
            phase, speed = phases[column : column + 1], speeds[row : row + 1]
            sought = periodic.Sought(phase, speed, most, longest, mirrors)
            count = for_system(periodic.search, system)(system, sought, table, orbits, count)
    for (turn, rate), (passages, periods) in zip(
        states[:count].tolist(), shape[:count].tolist(), strict=True
    ):
        begin = section_of(ImpactState(side=1, phase=turn, speed=rate))
        fixed = for_system(periodic.polish, system)(system, begin, passages, periods, table)
        if fixed.found:
            yield table[:passages].copy(), periods, fixed.residual


def _same(one: Orbit, other: Orbit) -> bool:
    """Return whether two orbits are one, started at different impacts."""
    if one.period != other.period or len(one.states) != len(other.states):
        return False
    if not (one.admissible and other.admissible):
        return False
    first = one.states[0]
    for state in other.states:
        apart = abs(state.phase - first.phase)
        apart = min(apart, 2.0 * math.pi - apart)
        slower = min(state.speed, first.speed)
        close = abs(state.speed - first.speed) <= SAME * max(slower, 1e-3)
        if state.side == first.side and apart <= SAME and close:
            return True
    return False
