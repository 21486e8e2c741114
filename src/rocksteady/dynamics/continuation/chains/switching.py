"""Branch switching: first orbit and initial direction of a branch born at a bifurcation.

Where a symmetry breaks or a period doubles, the orbit run through twice is an orbit of the new
branch too, and the new branch leaves it along the direction that comes back reversed.  At a graze
the new orbit has two impacts more, at the moment of the touch, or two fewer, where two merge.
"""

from dataclasses import replace

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.chain import MERGED, Chain
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.errors import ModelError
from rocksteady.kernels.core.clock import clock

REPEATED = 1e-6
"""Difference of phases [rad] up to which parts of a chain at a graze are the same."""


def switched(kind: PointType, chain: Chain) -> tuple[Chain, Floats | None]:
    """Return the first orbit of the branch that begins at a bifurcation, and where it goes.

    Parameters
    ----------
    kind, chain
        The bifurcation.

    Returns
    -------
    chain : Chain
        The orbit as one of the new branch.
    direction : ndarray, shape (m,), or None
        Displacement of its phases along the new branch; None where the equations themselves decide.

    Raises
    ------
    ModelError
        If nothing branches off there.
    """
    if kind in (PointType.SYMMETRY_BREAKING, PointType.PERIOD_DOUBLING):
        along = chain.null_direction(-1.0)
        return chain.doubled(), np.concatenate([along, -along])
    if kind is PointType.GRAZING:
        merged = np.abs(chain.durations) < MERGED
        if not merged.any():
            return _with_touch(chain), None
        if chain.impacts > 2:
            rest = _without(chain, int(np.argmax(merged)))
            # What is left may be symmetric, or an orbit of a shorter period run through again.
            return rest.primitive(REPEATED), None
    raise ModelError(
        "switch",
        kind.value,
        "no other branch begins there",
        "start from a symmetry breaking, a period doubling or a graze",
    )


def _with_touch(chain: Chain) -> Chain:
    """Return the chain with two impacts in the moment at which an arc of it touches the base."""
    row = int(np.nanargmin(chain.shape[:, 1]))
    passed = float(chain.parameters[1] * chain.shape[row, 2])
    further, phase = clock(float(chain.phases[row]) + passed)
    turn = int(chain.turns[row]) + further
    return replace(
        chain,
        turns=np.insert(chain.turns, row + 1, [turn, turn]),
        phases=np.insert(chain.phases, row + 1, [phase, phase]),
    )


def _without(chain: Chain, row: int) -> Chain:
    """Return the chain without the two impacts at the ends of an arc of no duration."""
    count = chain.impacts
    turns, phases = chain.turns, chain.phases
    if row == count - 1:  # the arc that closes the chain: begin two impacts later
        turns = np.concatenate([turns[2:], turns[:2] + chain.half_cycles])
        phases = np.concatenate([phases[2:], phases[:2]])
        row = count - 3
    keep = np.ones(count, dtype=np.bool_)
    keep[[row, row + 1]] = False
    return replace(chain, turns=turns[keep], phases=phases[keep])
