"""Attractors of many motions at once: `find_attractor` over arrays of points and states."""

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.dynamics.arrays import checked_array, real_array, validated_grid
from rocksteady.dynamics.batch.attractors import Attractors, settled_cells
from rocksteady.dynamics.batch.initial_states import at_phases
from rocksteady.dynamics.history.start import refuse_behind_wall
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS
from rocksteady.errors import InputError
from rocksteady.kernels.core.tables import RESTITUTION
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import WALL_RESTITUTION
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.linear_tables import symmetric_sides

MAX_CYCLES = 2000
"""Default largest number of forcing periods that a motion is followed."""


@checked
def find_attractors(
    amplitude: ArrayLike,
    frequency_ratio: ArrayLike,
    restitution: ArrayLike,
    *,
    angle: ArrayLike = 0.0,
    velocity: ArrayLike = 0.0,
    phase: ArrayLike = 0.0,
    max_cycles: int = MAX_CYCLES,
    one_sided: bool = False,
) -> Attractors:
    """Find the attractors of many motions under harmonic shaking.

    The blocks are symmetric, or all stand against walls.
    Each is what `find_attractor` finds of that motion alone, in the linear model (eqs 4, 5).

    Parameters
    ----------
    amplitude, frequency_ratio, restitution
        A, Omega and delta; they broadcast with each other and with the states.
    angle, velocity
        Initial u = theta/alpha and du/d(pt); default at rest.
    phase
        Phase of the forcing at the start [rad]; default 0.
    max_cycles
        The most forcing periods that a motion is followed; default 2000.
    one_sided
        Whether the blocks stand against walls, of which the restitutions are then those, in [0, 1];
        default False.

    Returns
    -------
    Attractors
        Arrays of shape (cells,), the broadcast arguments in C order.

    Raises
    ------
    InputError
        If the arguments do not broadcast, or a value is outside its range.

    Examples
    --------
    >>> from rocksteady.orbits import find_attractors
    >>> from rocksteady.outcomes import AttractorKind
    >>> attractors = find_attractors([0.5, 2.0, 6.0], 4.0, 0.8, velocity=0.2)
    >>> attractors.labels.tolist(), attractors.period.tolist()
    (['rest', 'symmetric', 'overturned'], [0, 1, 0])
    >>> attractors.are(AttractorKind.REST)
    array([ True, False, False])
    """
    bounce = restitution if not one_sided else 1.0
    a, w, r, _ = validated_grid(amplitude, frequency_ratio, bounce, 1)
    if one_sided:
        r = checked_array("restitution", restitution, WALL_RESTITUTION)
    states = {"angle": angle, "velocity": velocity, "phase": phase}
    arrays = [a, w, r, *(real_array(name, value) for name, value in states.items())]
    for (name, value), array in zip(states.items(), arrays[3:], strict=True):
        if not (np.abs(array) <= LARGEST).all():
            raise InputError(
                name, value, f"it must lie in [-{LARGEST:g}, {LARGEST:g}]", "give numbers"
            )
    try:
        cells = [each.ravel() for each in np.broadcast_arrays(*arrays)]
    except ValueError:
        raise InputError(
            "shapes",
            tuple(each.shape for each in arrays),
            "the arguments must broadcast against each other",
            "give arrays of one shape, or add axes with [:, np.newaxis]",
        ) from None
    a, w, r, angles, velocities, phases = (each.copy() for each in cells)
    if one_sided:
        for cell in np.flatnonzero((angles < 0.0) | ((angles == 0.0) & (velocities < 0.0)))[:1]:
            block = DimensionlessBlock(restitution=r[cell].item(), one_sided=True)
            refuse_behind_wall(block, angles[cell].item(), velocities[cell].item(), name="states")
    begin = at_phases(angles, velocities, phases)
    sides = symmetric_sides(r)
    if one_sided:
        sides[:, 0, RESTITUTION], sides[:, 1, RESTITUTION] = -r, 1.0
    return settled_cells(a, w, sides, begin, FORCING_PERIODS("max_cycles", max_cycles), ())
