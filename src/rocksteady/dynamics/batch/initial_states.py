"""Initial states of many motions as arrays, the batch form of `dynamics.history.start`."""

import numpy as np

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.batch.attractors import starting
from rocksteady.dynamics.history.departure import set_off, states_to_start_on
from rocksteady.dynamics.history.start import Steady
from rocksteady.errors import ModelError
from rocksteady.kernels.batch.attractors import fill_clocks
from rocksteady.kernels.core.tuples import States


def at_phases(angle: Floats, velocity: Floats, phase: Floats) -> States:
    """Return any angles and velocities, each at a phase of its own.

    Parameters
    ----------
    angle, velocity
        theta/alpha, and its derivative by pivot time, shape (cells,).
    phase
        Phase of the shaking [rad], shape (cells,).

    Examples
    --------
    >>> import math
    >>> upright = np.zeros(2)
    >>> begin = at_phases(upright, upright, np.array([1.0, 1.0 - math.pi]))
    >>> print(begin.side, begin.half_cycles, begin.phase.round(12))
    [0 0] [ 0 -1] [1. 1.]
    """
    half_cycles, rest = np.empty(len(phase), dtype=np.int64), np.empty(len(phase))
    fill_clocks(phase, half_cycles, rest)
    # The motions' own jump at the start is added to the velocity, 0 here: it leaves no -0.0.
    return starting(angle, velocity + 0.0, half_cycles, rest)


def on_orbits(
    start: Steady,
    kick: Floats,
    amplitude: Floats,
    frequency_ratio: Floats,
    sides: Floats,
) -> tuple[Floats, Floats, Bools]:
    """Return velocity and phase on a steady state at many points, and where it is a start.

    Parameters
    ----------
    start
        Its branch, order and side count.
    kick
        Kicks in place of the start's own, shape (cells,).
    amplitude, frequency_ratio
        Parameters of the shaking, shape (cells,).
    sides
        As `model.equations.Linear.sides` has them, shape (cells, 2, 3) or
        (cells, 2, 5) in the nonlinear model.

    Returns
    -------
    velocity, phase
        d(theta/alpha)/d(p t) and the phase of the shaking [rad] at an impact, the angle being 0;
        both 0 where there is no such state, or it is no motion.
    there
        Where there is one.

    Examples
    --------
    >>> one = np.ones(2)
    >>> sides = np.tile([0.8, 1.0, 1.0], (2, 2, 1))
    >>> points = np.array([0.1, 2.0]), 4 * one, sides
    >>> velocity, phase, there = on_orbits(Steady(), 1e-6 * one, *points)
    >>> print(there, velocity.round(6), phase.round(6))
    [False  True] [0.       0.732389] [0.       2.846543]
    """
    states, jacobian = states_to_start_on(
        amplitude, frequency_ratio, sides, start.order, start.branch
    )
    assert states.admissible is not None
    which = start.branch - 1
    admissible = states.admissible[which].copy()
    phase = np.where(admissible, states.phase[which], 0.0)
    velocity = np.where(admissible, states.velocity[which], 0.0)
    unstable = admissible & ~(states.stable[which] | states.neutral[which])
    for cell in np.flatnonzero(unstable).tolist():
        away = start.side * kick.item(cell)
        try:
            phase[cell], velocity[cell] = set_off(
                states, jacobian, branch=start.branch, cell=cell, away=away
            )
        except ModelError:  # there is none, or no number determines how it is left
            admissible[cell] = False
    return np.where(admissible, velocity, 0.0), np.where(admissible, phase, 0.0), admissible
