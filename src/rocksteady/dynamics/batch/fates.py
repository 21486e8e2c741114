"""Fates of many motions under periodic shaking after a given time; chooses the kernel."""

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.batch.harmonic import series_fates
from rocksteady.kernels.core.tables import NONLINEAR_SIDE_COLUMNS, SIDE_COLUMNS
from rocksteady.kernels.core.tuples import Cells, Fates, SeriesCells, Starts
from rocksteady.kernels.devices import run_cells
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from rocksteady.model.equations import Linear, Model
from rocksteady.model.motions.fourier import shares_of
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.outcomes import Status

ENDS = (Status.ROCKING, Status.AT_REST, Status.OVERTURNED, Status.UNDECIDED)
"""How such a motion can end."""
MOST_IMPACTS = 4_000_000
"""Impacts after which a motion is given up as undecided: small bounces without loss have no end.
Those of periods leapt over do not count."""
BATCH = 4096
"""The most motions that the kernel follows in one call: it is given many, so that it may follow
some of them side by side,"""
MOST_PERIODS = 1_000_000
"""and the forcing periods that they may take together: a tenth of a second, for which an
interruption waits."""


def ends_of(
    *,
    amplitude: Floats,
    frequency_ratio: Floats,
    sides: Floats,
    angle: Floats,
    velocity: Floats,
    phase: Floats,
    cycles: int,
    harmonics: Harmonics,
) -> Integers:
    """Return how motions end.

    Motions are followed side by side, except all under a Fourier series and, in the nonlinear
    model, those of blocks against a wall: a cell's answer depends on nothing but the cell.

    Parameters
    ----------
    amplitude, frequency_ratio
        Shape (cells,).
    sides
        Sides of the block of each cell, as from `model.equations.Linear.sides`, shape
        (cells, 2, 3), or (cells, 2, 5) in the nonlinear model.
    angle, velocity, phase
        theta/alpha, its derivative by pivot time, and the phase of the shaking [rad] at the start.
    cycles
        Forcing periods that they are followed for, at most.
    harmonics
        Harmonics of a Fourier series, scaled by the amplitudes; by default a single sinusoid.

    Returns
    -------
    NDArray[int64], shape (cells,)
        Codes of `ENDS`.
    """
    count = len(amplitude)
    # Kernels take no views.
    starts, blocks = Starts(angle.copy(), velocity.copy(), phase.copy()), sides.copy()
    fates, limits = _room(count), (cycles, True, MOST_IMPACTS)
    if harmonics:
        total, shares = shares_of(harmonics)
        shaken = SeriesCells(total * amplitude, frequency_ratio.copy(), shares, blocks)
        series_fates(shaken, starts, cycles, MOST_IMPACTS, fates)
        return fates.status
    kernel = nonlinear_lane_fates if sides.shape[2] == NONLINEAR_SIDE_COLUMNS else lane_fates
    given = Cells(amplitude.copy(), frequency_ratio.copy(), blocks)
    run_cells(kernel, given, starts, *limits, fates)
    return fates.status


def _room(count: int) -> Fates:
    """Return the outcomes of a number of motions, which a kernel fills."""
    status, impacts = np.empty((2, count), dtype=np.int64)
    return Fates(status, impacts, np.empty((count, 3)))


def batch_size(cycles: int) -> int:
    """Return how many motions one call takes, each followed for a number of forcing periods."""
    return max(1, min(BATCH, MOST_PERIODS // cycles))


def load_kernel(model: Model) -> None:
    """Load the kernels, or compile them, so that what is timed afterwards is computation alone."""
    nothing = np.empty(0)
    columns = SIDE_COLUMNS if isinstance(model, Linear) else NONLINEAR_SIDE_COLUMNS
    ends_of(
        amplitude=nothing,
        frequency_ratio=nothing,
        sides=np.empty((0, 2, columns)),
        angle=nothing,
        velocity=nothing,
        phase=nothing,
        cycles=1,
        harmonics=(),
    )
